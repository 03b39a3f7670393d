"""Tests of `tftool calibrate`, from options to files."""

import json
import re

import numpy as np
import pytest

import tftool as library
from tests.frames.motions import errors, world
from tftool import Transform
from tftool.scenario import builtin

URDF = """<?xml version="1.0"?>
<robot name="rover">
  <link name="base_link"/>
  <link name="camera_link"/>
  <link name="camera"/>
  <!-- measured with a ruler -->
  <joint name="camera_mount" type="fixed">
    <parent link="base_link"/><child link="camera_link"/>
    <origin rpy="0 0 0"   xyz="0.1 0 0"/>
  </joint>
  <joint name="optical" type="fixed">
    <parent link="camera_link"/><child link="camera"/>
    <origin xyz="0.01 0 0" rpy="-1.5707963267948966 0 -1.5707963267948966"/>
  </joint>
</robot>
"""


def write_poses(file, path):
    rows = [
        f"{stamp // 10**9}.{stamp % 10**9:09d} " + " ".join(f"{one:.12f}" for one in (*t, *q))
        for stamp, t, q in zip(path.stamps.tolist(), path.translations, path.rotations, strict=True)
    ]
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def made():
    return world(11, seconds=30.0, rates=(50.0, 20.0))


@pytest.fixture
def words(made, tmp_path):
    """Write the two motions as pose files; return their paths and frames as options."""
    a = write_poses(tmp_path / "a.tum", made.a)
    b = write_poses(tmp_path / "b.tum", made.b)
    return ["calibrate", a, "--frames", "odom:base_link", b, "--frames", "world:camera"]


def record(made, file):
    """Write both motions to one recording, each with a separate tree."""
    with library.write_recording(file) as recording:
        for path in (made.a, made.b):
            for one in path:
                recording.transforms([one])
    return file


def near(found, made):
    mount = Transform(tuple(found["translation"]), tuple(found["rotation"]))
    shift, turn = errors(mount, made.mount)
    return np.linalg.norm(shift) < 0.003 and np.linalg.norm(turn) < 0.3


def test_two_pose_files_give_mount_offset_and_intervals(tftool, words, made):
    result = tftool(*words, "--json")
    found = json.loads(result.out)

    assert result.status == 0
    assert found["verdict"] == "solved"
    assert (found["moving"], found["fixed"]) == (["base_link", "camera"], ["odom", "world"])
    assert near(found["mount"], made)
    assert found["clock_offset"]["seconds"] == pytest.approx(made.offset, abs=0.002)
    assert len(found["interval95"]["translation"]) == 3
    assert found["unseen"] == []
    assert found["check"] is None


def test_people_get_the_mount_as_tf2_prints_it(tftool, words):
    told = tftool(*words).out

    assert "Mount: camera in base_link" in told
    assert "- Rotation: in RPY (degree)" in told
    assert "Fixed frames: world in odom" in told
    assert "Clock offset: t_A = t_B +0.3" in told
    assert told.endswith("it determines the whole mount.\n")


def test_one_recording_holds_both_chains(tftool, made, tmp_path):
    run = record(made, tmp_path / "run.mcap")
    result = tftool(
        "calibrate", run, "--moving", "odom:base_link", "--moving", "world:camera", "--json"
    )

    assert result.status == 0, result.err
    assert near(json.loads(result.out)["mount"], made)


def test_a_word_for_one_motion_is_that_of_the_file_that_has_it(tftool, words, made, tmp_path):
    run = record(made, tmp_path / "run.mcap")
    options = ["--moving", "world:camera", "--json"]

    second = tftool(*words[:4], run, *options)
    assert second.status == 0, second.err
    assert near(json.loads(second.out)["mount"], made)
    neither = tftool("calibrate", run, run, *options)
    assert neither.status == 2
    assert "several motions: name one motion with --moving" in neither.err


def test_chains_that_share_the_mount_are_refused_by_name(tftool, tmp_path):
    made = world(12, seconds=10.0)
    run = tmp_path / "run.mcap"
    with library.write_recording(run) as recording:
        for one in made.a:
            recording.transforms([one])
        mount = library.TransformStamped(int(made.a.stamps[0]), "base_link", "camera", made.mount)
        recording.static_transforms([mount])
    result = tftool("calibrate", run, "--moving", "odom:base_link", "--moving", "odom:camera")

    assert result.status == 2
    assert "--moving odom:camera passes through base_link → camera" in result.err
    assert "the result would be this published transform" in result.err


def test_one_origin_of_a_description_changes_and_no_other_byte(tftool, words, made, tmp_path):
    robot, new = tmp_path / "robot.urdf", tmp_path / "new.urdf"
    robot.write_text(URDF, encoding="utf-8")

    result = tftool(*words, "--urdf", robot, "-o", new)

    assert result.status == 0, result.err
    assert "joint 'camera_mount' has <origin" in result.err
    text = new.read_text(encoding="utf-8")
    before, after = URDF.split('<origin rpy="0 0 0"   xyz="0.1 0 0"/>')
    assert text.startswith(before)
    assert text.endswith(after)
    changed = text[len(before) : -len(after)]
    assert re.fullmatch(r'<origin xyz="[^"]+" rpy="[^"]+" ?/>', changed)
    mount = library.load_urdf(new).buffer().lookup_transform("base_link", "camera").transform
    shift, turn = errors(mount, made.mount)
    assert np.linalg.norm(shift) < 0.003
    assert np.linalg.norm(turn) < 0.3


@pytest.mark.parametrize("name", ["mount.launch.py", "mount.launch.yaml", "mount.sh"])
def test_files_that_publish_the_mount_are_read_again(tftool, words, made, tmp_path, name):
    result = tftool(*words, "-o", tmp_path / name)

    assert result.status == 0, result.err
    with library.open(tmp_path / name) as frames:
        mount = frames.buffer.lookup_transform("base_link", "camera").transform
    assert np.linalg.norm(errors(mount, made.mount)[0]) < 0.003


def test_check_names_the_axes_that_the_motion_contradicts(tftool, words, made, tmp_path):
    quarter = library.quaternion_from_rpy(0.0, 0.0, 0.05)
    wrong = made.mount @ Transform((0.0, 0.0, 0.0), quarter)
    files = {}
    for name, mount in (("right", made.mount), ("wrong", wrong)):
        rpy = library.rpy_from_quaternion(mount.rotation)
        files[name] = tmp_path / f"{name}.urdf"
        files[name].write_text(
            '<robot name="r"><link name="base_link"/><link name="camera"/>'
            '<joint name="m" type="fixed"><parent link="base_link"/><child link="camera"/>'
            f'<origin xyz="{" ".join(map(repr, mount.translation))}" '
            f'rpy="{" ".join(map(repr, rpy))}"/></joint></robot>',
            encoding="utf-8",
        )

    right = tftool(*words, "--urdf", files["right"], "--check")
    wrong = tftool(*words, "--urdf", files["wrong"], "--check")
    told = json.loads(tftool(*words, "--urdf", files["wrong"], "--check", "--json").out)

    assert right.status == 0, right.out
    assert "inside of the interval" in right.out
    assert wrong.status == 1
    assert re.search(r"camera: yaw differs by -?2\.[789]° ± 0\.\d+°", wrong.out)
    assert told["check"]["outside"] == ["yaw"]
    assert tftool(*words, "--check").status == 2


def test_the_clock_offset_alone(tftool, words, made):
    result = tftool(*words, "--time-only", "--json")

    assert json.loads(result.out)["clock_offset"]["seconds"] == pytest.approx(
        made.offset, abs=0.003
    )
    assert tftool("diff", *words[1:], "--clock-offset").out.startswith("t_A = t_B +0.3")


def test_a_refusal_has_the_motion_to_record_next_and_status_1(tftool, tmp_path):
    still = world(13, kind="still", seconds=20.0)
    a, b = write_poses(tmp_path / "a.tum", still.a), write_poses(tmp_path / "b.tum", still.b)

    result = tftool("calibrate", a, b)
    told = json.loads(tftool("calibrate", a, b, "--json").out)

    assert result.status == 1
    assert "To record next: turn" in result.out
    assert (told["verdict"], told["mount"]) == ("refused", None)
    assert tftool("diff", a, b, "--clock-offset").status == 1


def test_a_report_is_one_page_with_the_curves(tftool, words, tmp_path):
    page = tmp_path / "report.html"

    result = tftool(*words, "--report", page)

    text = page.read_text(encoding="utf-8")
    assert result.status == 0
    assert text.count("<svg") == 6
    assert "Correlation of the rotations" in text
    assert "<script" not in text


@pytest.mark.parametrize(
    ("more", "told"),
    [
        (["--moving", "odom"], "takes FIXED:MOVING"),
        (["--moving", "a:b", "--moving", "c:d", "--moving", "e:f"], "at most twice"),
        (["--time-only", "--check"], "leave out the options of the mount"),
        (["-o", "mount.txt"], "end it in .urdf"),
        (["-o", "new.urdf"], "add --urdf FILE"),
        (["--report", "page.pdf"], "end it in .html"),
        (["--joint", "mount"], "--joint is only allowed with -o FILE"),
    ],
)
def test_options_that_do_not_fit_are_refused(tftool, words, more, told):
    result = tftool(*words, *more)

    assert result.status == 2
    assert told in result.err


def test_one_file_needs_two_motions(tftool, words):
    result = tftool(*words[:4])

    assert result.status == 2
    assert "must contain both motions" in result.err


def test_the_scenario_shows_its_wrong_mount_and_holds_when_that_is_mended(tftool, tmp_path):
    motions = ["--moving", "odom:base_link", "--moving", "scan_start:scan_laser"]
    motions += ["--mounted", "laser_link"]
    script = tmp_path / "mount.sh"

    wrong = tftool("calibrate", "calibrate", *motions, "--check", "-o", script)
    assert wrong.status == 1
    found = re.search(r"laser_link: yaw differs by (.+)° ± (.+)°", wrong.out)
    assert found is not None
    assert abs(float(found[1]) - 3.0) <= 0.2
    assert float(found[2]) < 0.3
    assert "--frame-id base_link --child-frame-id laser_link" in script.read_text()

    text = builtin.path_of("calibrate").read_text()
    mended = tmp_path / "mended.yaml"
    mended.write_text(text.replace("published_yaw: 10 deg", "published_yaw: 13 deg"))
    assert tftool("calibrate", mended, *motions, "--check").status == 0
