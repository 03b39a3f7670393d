import json
import re

import pytest

from tests.recordings.writers import SECOND, Sent, numbers, write_mcap


def test_a_lookup_between_two_samples_is_refused_with_the_wait_it_needs(tftool):
    result = tftool("explain", "turtle2", "turtle1", "turtles", "--at", "5")
    assert result.status == 4
    lines = result.out.splitlines()
    assert lines[0] == (
        "turtle1 in turtle2 at 1005.000000000: refused, would answer 8 ms later; a live robot has "
        "only the data received so far, but echo uses the whole recording and succeeds"
    )
    assert "REFUSES: newest is 8 ms too old" in result.out
    assert "cure   a timeout of 10 ms (least: 8.0)" in result.out


@pytest.mark.parametrize("option", [("--at", "1005"), ("--message", "/tf@1005")])
def test_a_stamp_that_is_no_number_of_seconds_is_refused_as_by_echo(tftool, tmp_path, option):
    file = tmp_path / "carrot.mcap"
    assert tftool("export", "carrot", "-o", file).status == 0

    result = tftool("explain", "world", "turtle1", file, *option)
    assert (result.status, result.out) == (2, "")
    assert "the time 1005 s is after its end. " in result.err
    assert result.err.endswith("for this stamp, write 5.\n")
    scenario = tftool("explain", "world", "turtle1", "carrot", "--at", "1005").err
    assert scenario.startswith("tftool: scenario 'carrot' lasts ")
    assert tftool("echo", "world", "turtle1", "carrot", "--at", "1005").err == scenario
    assert tftool("explain", "world", "turtle1", file, "--at", "900").status == 4


def test_a_question_before_a_frame_begins_is_told_what_to_ask_for(tftool):
    result = tftool("explain", "turtle2", "turtle1", "turtles", "--at", "0.5")
    assert result.status == 4
    # turtle2 is spawned after a second, so `echo` refuses too.
    assert result.out.splitlines()[0].endswith("a live robot has only the data received so far")
    assert "turtle2 in world begins 508 ms after the requested time, at 1001.008" in result.out
    assert "cure   look up 1001.008 or later" in result.out
    assert "pruned" not in result.out


def test_a_lookup_that_answers_ends_with_status_0(tftool):
    result = tftool("explain", "turtle2", "turtle1", "turtles", "--at", "5", "--timeout", "0.01")
    assert result.status == 0
    assert result.out.startswith("turtle1 in turtle2 at 1005.000000000: answers\n")
    assert tftool("explain", "turtle2", "turtle1", "turtles").status == 0


def test_the_links_of_a_recording_count_from_where_the_moment_asked_for_does(tftool, tmp_path):
    start = 1_750_000_000 * SECOND + SECOND // 2
    run = [
        Sent(start + at, "/tf", ((start + at, "map", "base", numbers(1)),))
        for at in range(0, 3 * SECOND, SECOND)
    ]

    told = tftool("explain", "map", "base", write_mcap(tmp_path / "a.mcap", run), "--at", "7").out

    assert re.search(r"held, s since the start +samples +at 7\.000\n", told)
    assert re.search(r"0\.000 … 2\.000 +3 ", told)


def test_programs_get_whole_nanoseconds(tftool):
    result = tftool("explain", "turtle2", "turtle1", "turtles", "--at", "5", "--json")
    found = json.loads(result.out)
    assert found["schema"] == "tftool.explain/1"
    assert (found["stamp"], found["asked"]) == (1_005_000_000_000, 1_005_000_000_000)
    assert [link["publisher"] for link in found["links"]] == ["broadcaster1", "broadcaster2"]
    assert found["remedies"][0]["least"] == 8_000_000


def test_a_name_that_is_none_is_explained_too(tftool):
    result = tftool("explain", "turtle2", "turtle9", "turtles", "--at", "5")
    assert result.status == 4
    assert "no transform contains the frame turtle9" in result.out


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["a", "b", "turtles", "--message", "/scan@4", "--at", "4"], 2, "leave out --at"),
        (["a", "b", "turtles", "--message", "/scan@x"], 2, "'x' is not a time"),
        (["a", "b", "turtles", "--message", "/scan"], 3, "No message with a header"),
        (["a", "b", "nothing.mcap"], 3, "There is no file"),
    ],
)
def test_explain_refuses_invalid_arguments_with_a_reason(tftool, words, status, told):
    result = tftool("explain", *words)
    assert result.status == status
    assert told in result.err


ARM = """<robot name="arm"><link name="base"/><link name="tool"/><link name="ball"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="tool"/></joint>
  <joint name="free" type="floating"><parent link="tool"/><child link="ball"/></joint>
</robot>"""


@pytest.fixture
def arm(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(ARM)
    return str(path)


def test_a_description_is_explained_joint_by_joint(tftool, arm):
    result = tftool("explain", "base", "tool", arm, "--joint", "turn=90deg")
    assert result.status == 0
    assert result.out.startswith("tool in base: answers\n")
    assert "1.571 rad" in result.out

    refused = tftool("explain", "base", "ball", arm)
    assert refused.status == 4
    assert "REFUSES: the pose is unknown" in refused.out


def test_programs_get_the_joints_of_a_description(tftool, arm):
    found = json.loads(tftool("explain", "base", "ball", arm, "--json").out)
    assert found["schema"] == "tftool.explain/1"
    assert found["available"] is False
    assert found["refusing"] == ["tool", "ball"]
    assert [link["joint"] for link in found["links"]] == ["free", "turn"]


def test_explain_refuses_a_message_with_a_description_and_a_joint_with_a_scenario(tftool, arm):
    result = tftool("explain", "base", "tool", arm, "--message", "/scan")
    assert result.status == 2
    assert "leave out --message" in result.err
    result = tftool("explain", "turtle1", "turtle2", "turtles", "--joint", "turn=1")
    assert result.status == 2
    assert "leave out --joint turn=1" in result.err


def test_a_chain_deeper_than_a_screen_is_counted_in_its_middle(tftool, tmp_path):
    links = tuple((SECOND, f"f{link}", f"f{link + 1}", numbers(1)) for link in range(1500))
    deep = write_mcap(tmp_path / "deep.mcap", [Sent(SECOND, "/tf_static", links)])

    told = tftool("explain", "f0", "f1500", deep).out

    assert "f1500 in f1499" in told
    assert "f1 in f0" in told
    assert "f800 in f799" not in told
    assert re.search(r"… 1,100 more links …", told)
    assert re.search(r"… 1,\d\d\d lines more …", told), (
        "tf2 names each frame of what it calls a loop"
    )


def test_the_sentence_of_a_deep_chain_is_counted_in_its_middle(tftool, tmp_path):
    links = tuple((SECOND, f"f{link}", f"f{link + 1}", numbers(1)) for link in range(1500))
    deep = write_mcap(tmp_path / "deep.mcap", [Sent(SECOND, "/tf_static", links)])

    result = tftool("echo", "f0", "f1500", deep)

    assert result.status == 4
    assert "contains a loop" in result.err
    assert "lines more" in result.err
    assert len(result.err.splitlines()) < 450
