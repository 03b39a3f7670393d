"""Tests of several robots in one recording, each with its own topics of transforms."""

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

import tftool as library
from tests.recordings.writers import SECOND, Sent, write_mcap
from tftool.base.errors import InputError
from tftool.recordings.recording import open_recording

START = 1_750_000_000 * SECOND


def pose(x):
    return (x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def two_robots(root="map"):
    """Return two robots, one 10 m ahead; each has a laser of the same name, 1 m or 2 m up."""
    sent = []
    for number, robot in enumerate(("r1", "r2")):
        mount = (0.0, 0.0, 1.0 + number, 0.0, 0.0, 0.0, 1.0)
        sent.append(Sent(START, f"/{robot}/tf_static", ((0, "base_link", "laser", mount),)))
    for tick in range(40):
        stamp = START + tick * SECOND // 10
        for number, robot in enumerate(("r1", "r2")):
            place = pose(0.1 * tick + 10.0 * number)
            sent.append(Sent(stamp, f"/{robot}/tf", ((stamp, root, "base_link", place),)))
            if tick % 4 == 0:
                sent.append(Sent(stamp, f"/{robot}/scan", scan=(stamp, "laser")))
    return sent


@pytest.fixture
def run(tmp_path):
    return write_mcap(tmp_path / "run.mcap", two_robots())


BOTH = ("--tf-topic", "/r1/tf", "--tf-topic", "/r2/tf")


def test_one_robot_keeps_its_names(run):
    with library.open(run, tf_topics=["/r2/tf"]) as frames:
        found = frames.buffer.lookup_transform("map", "laser", frames.at(1.0))

    assert found.transform.translation == pytest.approx((11.0, 0.0, 2.0))


def test_a_single_topic_needs_no_list(run):
    with (
        library.open(run, tf_topics="/r2/tf") as frames,
        open_recording(run, tf_topics="/r2/tf") as recording,
    ):
        assert set(frames.buffer.frames()) == {"map", "base_link", "laser"}
        assert recording.buffer.frames() == frames.buffer.frames()


def test_equal_names_of_two_robots_get_their_namespace(run):
    with library.open(run, tf_topics=["/r1/tf", "/r2/tf"]) as frames:
        found = frames.buffer.lookup_transform("r1/base_link", "r2/laser", frames.at(1.0))
        names = set(frames.buffer.frames())

    assert found.transform.translation == pytest.approx((10.0, 0.0, 2.0))
    assert names == {"map", "r1/base_link", "r1/laser", "r2/base_link", "r2/laser"}


def test_a_root_that_belongs_to_one_robot_is_not_shared(tmp_path):
    run = write_mcap(tmp_path / "run.mcap", two_robots(root="odom"))

    with library.open(run, tf_topics=["/r1/tf", "/r2/tf"]) as frames:
        assert {"r1/odom", "r2/odom"} <= set(frames.buffer.frames())


def test_commands_ask_both_robots_and_say_what_was_renamed(tftool, run):
    echoed = tftool("echo", "r1/base_link", "r2/laser", run, "--at", "1", *BOTH)
    drawn = tftool("tree", run, *BOTH)
    told = tftool("info", run, *BOTH)

    assert echoed.status == drawn.status == told.status == 0
    assert "Translation: [10.000, 0.000, 2.000]" in echoed.out
    assert "2 frames of several robots (base_link, laser) got the prefix 'r1/', 'r2/'" in echoed.err
    assert "r2/laser" in drawn.out
    assert "r2/laser" in told.out


def test_without_a_choice_the_robots_mix_and_with_both_the_doctor_is_content(tftool, run):
    mixed = tftool("doctor", run)
    chosen = tftool("doctor", run, *BOTH)

    assert mixed.status == 1
    assert chosen.status == 0, chosen.out


def test_a_topic_without_transforms_is_refused_with_those_there_are(run):
    with pytest.raises(InputError, match=r"no transforms on '/r3/tf'; there is /r[12]/tf"):
        library.open(run, tf_topics=["/r3/tf"])


def test_a_session_and_a_description_take_no_topic(tftool):
    result = tftool("tree", "turtles", "--tf-topic", "/r1/tf")

    assert result.status == 2
    assert "leave out --tf-topic" in result.err
