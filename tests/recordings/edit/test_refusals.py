"""Tests of refused edits, and of the files that an interrupted edit leaves."""

import os
from pathlib import Path

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.full_disk import full_disk
from tests.recordings.edit.outcomes import NEW_POSE, SENT, messages
from tests.recordings.writers import CONTAINERS, write_mcap
from tftool import Buffer, Transform, TransformStamped, export
from tftool.base.errors import InputError, UsageError
from tftool.recordings.edit.changes import Edits
from tftool.recordings.edit.rewrite import edit
from tftool.recordings.recording_writer import write_recording


def test_the_input_and_what_is_there_are_never_written_to(tmp_path, mcap):
    link, other = tmp_path / "link.mcap", tmp_path / "other.mcap"
    os.link(mcap, link)
    other.write_bytes(b"precious")
    before = mcap.read_bytes()

    for output in (mcap, link):
        with pytest.raises(UsageError, match="is the input"):
            edit([str(mcap)], output, Edits(), force=True)
    with pytest.raises(UsageError, match="not a name of a file"):
        edit([str(mcap)], Path(), Edits(), force=True)
    with pytest.raises(UsageError, match="exists"):
        edit([str(mcap)], other, Edits())

    assert mcap.read_bytes() == before
    assert other.read_bytes() == b"precious"
    edit([str(mcap)], other, Edits(), force=True)
    assert messages(other) == messages(mcap)


def test_a_folder_is_replaced_only_if_it_holds_nothing_but_a_recording(tmp_path, mcap):
    out, mine = tmp_path / "out", tmp_path / "out.old"
    mine.write_bytes(b"precious")
    edit([str(mcap)], out, Edits(drop=(("*", "arm"),)))

    edit([str(mcap)], out, Edits(), force=True)

    assert messages(out) == messages(mcap)
    assert sorted(os.listdir(tmp_path)) == ["a.mcap", "out", "out.old"]
    (out / "notes.txt").write_bytes(b"precious")
    with pytest.raises(UsageError, match="more than a recording"):
        edit([str(mcap)], out, Edits(), force=True)
    assert (out / "notes.txt").read_bytes() == mine.read_bytes() == b"precious"


@pytest.mark.parametrize(
    ("edits", "told"),
    [
        (Edits(drop=(("base_link", "lasr"),)), r"; did you mean base_link:laser.*\?$"),
        (
            Edits(poses={("map", "laser"): NEW_POSE}),
            r"'laser' is 'base_link': name base_link:laser\.$",
        ),
        (Edits(rename={"lasr": "x"}), "No frame 'lasr'"),
        (Edits(rename={"laser": "camera"}), "Two frames would have the name 'camera'"),
        (Edits(reparent={("base_link", "laser"): "moon"}), "No frame 'moon'"),
        (Edits(start=5, end=3), "--to is before --from"),
    ],
)
def test_edits_that_do_not_fit_the_recording_are_refused_and_write_nothing(
    tmp_path, mcap, edits, told
):
    with pytest.raises(UsageError, match=told):
        edit([str(mcap)], tmp_path / "out.mcap", edits)

    assert sorted(os.listdir(tmp_path)) == ["a.mcap"]


@pytest.mark.parametrize("name", ["out.mcap", "out.db3", "out.bag"])
def test_a_shift_after_which_a_stamp_is_not_above_0_is_refused(tmp_path, name):
    buffer = Buffer()
    for second in (10, 11):
        buffer.set_transform(TransformStamped(second * 10**9, "map", "base", Transform()), "test")
    export(buffer, path=tmp_path / "a.mcap")
    path = str(tmp_path / "a.mcap")

    for shift, told in ((-10, "stamp 10 s to 0 s"), (-11, "to -1 s"), (2**31 - 11, "2147483648 s")):
        with pytest.raises(InputError, match=told):
            edit([path], tmp_path / name, Edits(shift=shift * 10**9))

    assert sorted(os.listdir(tmp_path)) == ["a.mcap"]
    assert edit([path], tmp_path / name, Edits(shift=-9 * 10**9)).counts["stamps changed"] == 2


def test_a_stamp_below_0_is_refused_where_ros_1_cannot_store_it(tmp_path):
    path = tmp_path / "early.mcap"
    with write_recording(path) as recording:
        for second in (-2, 3):
            moved = TransformStamped(second * 10**9, "map", "odom", Transform())
            recording.transforms([moved], log_time=100 * 10**9 + second)

    with pytest.raises(InputError, match="'/tf' has a value that a ROS 1 bag cannot store"):
        edit([path], tmp_path / "out.bag", Edits())
    assert [file.name for file in tmp_path.iterdir()] == ["early.mcap"]
    assert edit([path], tmp_path / "out.bag", Edits(restamp=True)).messages == 2
    assert edit([path], tmp_path / "out.db3", Edits()).messages == 2


def test_of_a_recording_without_transforms_it_is_said_that_there_are_none(tmp_path):
    plain = write_mcap(tmp_path / "a.mcap", [one for one in SENT if "/tf" not in one.topic])

    for edits in (Edits(rename={"laser": "x"}), Edits(drop=(("a", "b"),))):
        with pytest.raises(
            UsageError, match=r"was recorded; the recording contains no transforms\.$"
        ):
            edit([str(plain)], tmp_path / "out.mcap", edits)


@pytest.mark.parametrize("name", ["mcap none", "db3", "ros 1 none"])
def test_an_interrupt_leaves_nothing_behind(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)
    before = sorted(os.listdir(tmp_path))

    def interrupt(_done, _total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        edit([str(path)], tmp_path / f"out{path.suffix}", Edits(), progress=interrupt)

    assert sorted(os.listdir(tmp_path)) == before


def test_a_full_disk_is_said_and_leaves_nothing_behind(tmp_path, mcap):
    with full_disk(10_000), pytest.raises(InputError, match="cannot be written"):
        edit([str(mcap)], tmp_path / "out.mcap", Edits())

    assert sorted(os.listdir(tmp_path)) == ["a.mcap"]


def test_a_dry_run_says_the_same_and_writes_nothing(tmp_path, mcap):
    edits = Edits(drop=(("*", "arm"),), rename={"odom": "odometry"})

    tried = edit([str(mcap)], tmp_path / "b.mcap", edits, dry_run=True)

    assert sorted(os.listdir(tmp_path)) == ["a.mcap"]
    done = edit([str(mcap)], tmp_path / "b.mcap", edits)
    assert (tried.counts, tried.messages, tried.notes) == (done.counts, done.messages, done.notes)
