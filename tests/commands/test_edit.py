"""Tests of `tftool edit` as a user types it."""

import json
import math
import os

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from mcap.writer import CompressionType

from tests.recordings.writers import SECOND, content, write_mcap
from tftool import Transform, TransformStamped, seconds, write_recording
from tftool.app.main import main
from tftool.recordings.recording import open_recording

SENT = content(30)
URDF = """<robot name="r"><link name="base_link"/><link name="laser"/><link name="wheel"/>
<joint name="a" type="fixed"><parent link="base_link"/><child link="laser"/>
<origin xyz="0.5 0 0"/></joint>
<joint name="b" type="continuous"><parent link="base_link"/><child link="wheel"/></joint>
</robot>"""


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_mcap(tmp_path / "a.mcap", SENT)
    return tmp_path


def test_a_link_is_set_in_degrees_and_the_result_is_told(run, capsys):
    status = main(["edit", "a.mcap", "-o", "b.mcap", "--set", "base_link:laser=1,2,3,0,0,90deg"])

    told = capsys.readouterr()
    assert status == 0
    assert told.err == ""
    assert told.out.splitlines() == [
        "        1 transform set",
        f"{len(SENT):>9} messages written, read again and found equal: b.mcap",
    ]
    with open_recording("b.mcap") as recording:
        found = recording.buffer.lookup_transform("base_link", "laser").transform
    assert tuple(found.translation) == (1, 2, 3)
    assert tuple(found.rotation) == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))


def test_a_recording_with_options_of_pose_files_is_named_with_its_article(run, capsys):
    assert main(["tree", "a.mcap", "--inverted"]) == 2
    assert "'a.mcap' is an MCAP recording, not a pose file" in capsys.readouterr().err
    assert main(["tree", "r1=a.mcap"]) == 3
    assert "'r1=a.mcap' is an MCAP recording, but" in capsys.readouterr().err


def test_edit_and_play_refuse_a_robot_description(run, tmp_path, capsys):
    (tmp_path / "arm.urdf").write_text("<robot name='arm'><link name='base'/></robot>")

    assert main(["edit", "arm.urdf", "-o", "b.mcap"]) == 2
    assert "name a recording instead" in capsys.readouterr().err
    assert main(["play", "arm.urdf"]) == 2
    assert "name a recording instead" in capsys.readouterr().err


def test_a_cut_by_seconds_since_the_start_and_json(run, capsys):
    assert main(["edit", "a.mcap", "-o", "b", "--from", "0.1", "--to", "0.3", "--json"]) == 0

    told = json.loads(capsys.readouterr().out)
    assert told["files"] == ["b_0.mcap"]
    assert told["changes"]["statics put first"] == 2
    with open_recording("b") as recording, open_recording("a.mcap") as whole:
        assert told["messages"] == sum(topic.count for topic in recording.topics)
        assert recording.start <= whole.start + SECOND // 10
        assert recording.end >= whole.start + 3 * SECOND // 10
        assert recording.end < whole.start + SECOND // 2


def test_statics_come_from_a_robot_description_its_fixed_joints_alone(run, capsys):
    (run / "robot.urdf").write_text(URDF)

    assert main(["edit", "a.mcap", "-o", "b.mcap", "--statics-from", "robot.urdf"]) == 0

    with open_recording("b.mcap") as recording:
        found = recording.buffer.lookup_transform("base_link", "laser").transform
        assert {edge.child for edge in recording.edges if edge.static} == {"laser", "camera"}
    assert tuple(found.translation) == (0.5, 0, 0)


def test_a_dry_run_writes_nothing(run, capsys):
    assert main(["edit", "a.mcap", "-o", "b.mcap", "--rename", "odom=o", "--dry-run"]) == 0

    told = capsys.readouterr()
    assert "would be written: b.mcap" in told.out
    assert "'/scan'" not in told.err
    assert os.listdir() == ["a.mcap"]


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["-o", "a.mcap", "--force"], 2, "is the input"),
        (["-o", "b.txt"], 2, "does not end in the suffix of a recording"),
        (["-o", "-"], 2, "'-' means stdout, but this output"),
        (["-o", "nowhere/b.mcap"], 3, "there is no folder"),
        (["-o", "b.mcap", "--split-every", "5"], 2, "name the output 'b', not 'b.mcap'"),
        (["-o", "b.mcap", "--set", "base_link:laser=1,2"], 2, "takes 6 numbers"),
        (["-o", "b.mcap", "--set", "base_link:laser=1,2,3,x,0,0"], 2, "'x' is not a number"),
        (["-o", "b.mcap", "--set", "a:b=1,2,nan,0,0,0"], 2, "not a finite number"),
        (["-o", "b.mcap", "--set", "a:b=1,2,3,0,0,0,2"], 2, "length is 2, not 1"),
        (["-o", "b.mcap", "--drop", "laser"], 2, "PARENT:CHILD"),
        (["-o", "b.mcap", "--rename", "laser"], 2, "OLD=NEW"),
        (["-o", "b.mcap", "--rename", "odom=/"], 2, "has an empty frame name"),
        (["-o", "b.mcap", "--rename", "odom=//o"], 2, "an empty part between two slashes"),
        (["-o", "b.mcap", "--rename", "odom=o\n"], 2, "is not a valid name of a frame"),
        (["-o", "b.mcap", "--prefix", ""], 2, "has an empty frame name"),
        (["-o", "b.mcap", "--prefix", " "], 2, "has an empty frame name"),
        (["-o", "b.mcap", "--prefix", "x//y/"], 2, "an empty part between two slashes"),
        (["-o", "b.mcap", "--prefix", "r1/ "], 2, "is not a valid name of a frame"),
        (["-o", "b.mcap", "--prefix", "/r1"], 2, "rename base_link to r1base_link: end the"),
        (["-o", "b.mcap", "--restamp", "now"], 2, "takes only 'log'"),
        (["-o", "b.mcap", "--everywhere"], 2, "--everywhere is only allowed with"),
        (["-o", "b.mcap", "--record-time"], 2, "--record-time is only allowed with"),
        (["-o", "b.mcap", "--from", "9", "--to", "3"], 2, "--to is before --from"),
        (
            ["-o", "b.mcap", "--from", "900"],
            2,
            "Nothing was recorded after --from: the recording ends ",
        ),
        (["-o", "b.mcap", "--from", "900", "--record-time"], 2, "recorded after --from"),
        (
            ["-o", "b.mcap", "--to", "100000000"],
            2,
            "Nothing was recorded before --to: the recording begins at ",
        ),
        (["./a.mcap", "-o", "b.mcap"], 2, "'./a.mcap' is already an input, as 'a.mcap'"),
        (["a.mcap", "-o", "b.mcap", "--force"], 2, "'a.mcap' is already an input, as 'a.mcap'"),
        (["missing.mcap", "-o", "b.mcap"], 3, "There is no file"),
    ],
)
def test_edit_refuses_invalid_arguments_and_leaves_the_folder_unchanged(
    run, capsys, words, status, told
):
    before = (run / "a.mcap").read_bytes()

    assert main(["edit", "a.mcap", *words]) == status

    assert told in capsys.readouterr().err
    assert os.listdir() == ["a.mcap"]
    assert (run / "a.mcap").read_bytes() == before


SET = ["--set", "base_link:laser=1,2,3,0,0,0"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            [*SET, "--set", "/base_link:laser=4,5,6,0,0,0"],
            "--set is given twice for base_link:laser",
        ),
        (["--rename", "laser=a", "--rename", "laser=b"], "--rename is given twice for laser,"),
        (["--prefix", "r1/", "--prefix", "r2/"], "--prefix is given twice for every frame"),
        (
            ["--reparent", "base_link:arm=odom", "--reparent", "base_link:arm=map"],
            "--reparent is given twice for base_link:arm",
        ),
        (
            [*SET, "--set", "*:laser=4,5,6,0,0,0"],
            "--set base_link:laser and --set *:laser give one link different poses",
        ),
        (
            ["--set", "base_link:*=4,5,6,0,0,0", "--set", "*:laser=1,2,3,0,0,0"],
            "--set base_link:* and --set *:laser give one link different poses",
        ),
        ([*SET, "--drop", "*:laser"], "--drop removes base_link:laser, which --set"),
        (
            ["--drop", "base_link:arm", "--reparent", "base_link:arm=odom"],
            "--drop removes base_link:arm, which --set or --reparent",
        ),
        (
            [*SET, "--statics-from", "a.mcap"],
            "--statics-from replaces base_link:laser, which --set",
        ),
    ],
)
def test_options_that_contradict_each_other_are_refused(run, capsys, words, told):
    assert main(["edit", "a.mcap", "-o", "b.mcap", *words]) == 2

    assert told in capsys.readouterr().err
    assert os.listdir() == ["a.mcap"]


def test_options_that_do_not_contradict_each_other_are_accepted(run, capsys):
    words = [*SET, *SET, "--drop", "base_link:arm", "--set", "*:arm=4,5,6,0,0,0"]
    words += ["--set", "*:laser=1,2,3,0,0,0"]

    assert main(["edit", "a.mcap", "-o", "b.mcap", *words]) == 0


@pytest.mark.parametrize(
    "words", [["edit", "-o", "b.mcap"], ["edit", "-o", "b.mcap", "--record-time"], ["doctor"]]
)
def test_a_stamp_that_is_no_number_of_seconds_is_told_as_seconds(tmp_path, tftool, words):
    path = tmp_path / "run.mcap"
    with write_recording(path) as recording:
        for second in (1000, 1030):
            moved = TransformStamped(seconds(second), "map", "odom", Transform())
            recording.transforms([moved], log_time=seconds(second))
    command, *options = words

    told = tftool(command, path, *options, "--from", "1012.5").err
    assert "for this stamp, write 12.5." in told
    assert "for this stamp" not in tftool(command, path, *options, "--from", "900").err


@pytest.mark.parametrize("others", [[], ["none.mcap"]])
@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ["--from", "100"],
            "Nothing was recorded after --from: the recording ends 48.000 s after its start",
        ),
        (
            ["--to", "1600000000"],
            "Nothing was recorded before --to: the recording begins at 1700000000.000000.",
        ),
    ],
)
def test_an_unset_stamp_is_no_beginning_of_what_is_cut(tmp_path, tftool, others, words, told):
    with write_recording(tmp_path / "none.mcap"):
        pass
    with write_recording(tmp_path / "run.mcap") as recording:
        for second in range(49):
            stamp = seconds(1_700_000_000 + second)
            moved = [TransformStamped(stamp, "map", "odom", Transform())]
            unset = [TransformStamped(0, "odom", "base", Transform())] if second == 5 else []
            recording.transforms(moved + unset, log_time=stamp)

    result = tftool(
        "edit", tmp_path / "run.mcap", *(tmp_path / one for one in others),
        "-o", tmp_path / "cut.mcap", *words,
    )  # fmt: skip

    assert result.status == 2
    assert told in result.err


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (["--prefix", "r1/"], "r1/laser"),
        (["--prefix", "/r1/"], "r1/laser"),
        (["--prefix", "old_"], "old_laser"),
        (["--rename", "laser=/lidar"], "lidar"),
    ],
)
def test_new_names_can_be_asked_for_as_tf2_keeps_names(run, words, name):
    write_mcap(run / "a.mcap", SENT, compression=CompressionType.NONE)

    assert main(["edit", "a.mcap", "-o", "b.mcap", *words]) == 0

    with open_recording("b.mcap") as recording:
        assert name in {edge.child for edge in recording.edges}
    # The name is stored without a slash, for readers that strip nothing.
    assert f"/{name}".encode() not in (run / "b.mcap").read_bytes()


def test_a_folder_without_permission_is_said(run, capsys):
    (run / "locked").mkdir(mode=0o500)
    if os.access(run / "locked", os.W_OK):
        pytest.skip("this user, probably root, may write to every folder")

    assert main(["edit", "a.mcap", "-o", "locked/b.mcap"]) == 3

    assert "'locked/b.mcap' cannot be written: permission denied" in capsys.readouterr().err
