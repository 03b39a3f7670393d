"""Tests that the differences between two sets of frames are found and measured."""

import math

import numpy as np
import pytest

import tftool
from tftool import Buffer, InputError, Transform, TransformStamped, UsageError, seconds
from tftool.frames.differences import Behaviour, Change
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.robots.robot_model import parse_robot

SECOND = seconds(1)
START = 1_700_000_000 * SECOND


def frames(start=START, period=SECOND // 10, count=100, *, off=0.0, laser=None):
    """Return map -moving- base -static- laser; `off` moves base sideways in the later half."""
    found = Buffer(seconds(1000))
    for n in range(count):
        late = off if 2 * n >= count else 0.0
        turn = quaternion_from_rpy(0.0, 0.0, 0.01 * n * period / (SECOND // 10))
        pose = Transform((0.1 * n * period / (SECOND // 10), late, 0.0), turn)
        found.set_transform(TransformStamped(start + n * period, "map", "base", pose))
    still = laser or Transform((0.1, 0.2, 0.3), quaternion_from_rpy(0.1, 0.2, 0.3))
    found.set_transform_static(TransformStamped(0, "base", "laser", still))
    return found


def changes(found):
    return {one.child: tuple(one.changes) for one in found.changed}


def test_the_same_frames_do_not_differ():
    found = tftool.diff(frames(), frames(), mm=0.0, deg=0.0)

    assert not found
    assert changes(found) == {}
    assert [one.child for one in found.links] == ["base", "laser"]


def test_a_static_is_measured_in_millimetres_and_degrees():
    moved = Transform((0.1, 0.2, 0.3125), quaternion_from_rpy(0.1, 0.2, 0.3 + math.radians(0.5)))

    found = tftool.diff(frames(), frames(laser=moved))

    assert changes(found) == {"laser": (Change.pose,)}
    (one,) = found.changed
    assert one.displacement.millimetres == pytest.approx(12.5)
    assert one.displacement.moved_mm == pytest.approx((0.0, 0.0, 12.5), abs=1e-9)
    assert one.displacement.degrees == pytest.approx(0.5)
    assert not tftool.diff(frames(), frames(laser=moved), mm=13, deg=0.6)
    assert tftool.diff(frames(), frames(laser=moved), mm=13, deg=0.4)
    assert tftool.diff(frames(), frames(laser=moved), mm=12, deg=0.6)


def test_a_moving_link_is_measured_with_its_worst_displacement_and_when():
    found = tftool.diff(frames(), frames(off=0.02))

    (one,) = found.changed
    assert (one.child, one.changes) == ("base", (Change.pose,))
    assert one.displacement.moments == 100
    assert one.displacement.millimetres == pytest.approx(20 / math.sqrt(2))
    assert one.displacement.worst_millimetres == pytest.approx(20)
    assert one.displacement.worst_at == START + 50 * SECOND // 10


def test_other_stamps_are_compared_between_the_samples():
    # Half the rate and later stamps: a straight motion and a steady turn can be interpolated
    # exactly.
    found = tftool.diff(frames(), frames(START + 1234, SECOND // 5, 50), mm=0.1, deg=0.01)

    assert not found.changed or found.changed[0].displacement.millimetres < 0.2
    assert found.links[0].before.rate == pytest.approx(10.0)
    assert found.links[0].after.rate == pytest.approx(5.0)


def test_rates_count_where_they_are_asked_for():
    slower = frames(START, SECOND // 5, 50)

    assert not tftool.diff(frames(), slower, rate_percent=60)
    assert changes(tftool.diff(frames(), slower, rate_percent=40)) == {"base": (Change.rate,)}


def test_links_that_come_go_and_hang_elsewhere_are_named():
    other = frames()
    other.set_transform_static(TransformStamped(0, "base", "imu", Transform()))
    other.set_transform_static(TransformStamped(0, "imu", "laser", Transform((0.1, 0.2, 0.3))))

    found = tftool.diff(frames(), other)

    # The laser is at the same position but turned, as seen from its former parent.
    laser = next(one for one in found.links if one.child == "laser")
    assert changes(found) == {
        "imu": (Change.added,),
        "laser": (Change.reparented, Change.pose),
    }
    assert laser.displacement.millimetres == pytest.approx(0.0, abs=1e-9)
    assert laser.displacement.degrees > 10
    assert changes(tftool.diff(other, frames()))["imu"] == (Change.gone,)


def test_static_here_and_moving_there_is_a_change_of_kind():
    other = Buffer(seconds(1000))
    for n in range(100):
        pose = Transform((0.1 * n, 0.0, 0.0), quaternion_from_rpy(0.0, 0.0, 0.01 * n))
        other.set_transform(TransformStamped(START + n * SECOND // 10, "map", "base", pose))
        pose = Transform((0.1, 0.2, 0.3 + 0.001 * n), quaternion_from_rpy(0.1, 0.2, 0.3))
        other.set_transform(TransformStamped(START + n * SECOND // 10, "base", "laser", pose))

    for found in (tftool.diff(frames(), other), tftool.diff(other, frames())):
        (one,) = found.changed
        assert one.changes == (Change.kind, Change.pose)
        assert one.displacement.worst_millimetres == pytest.approx(99)


def test_two_clocks_each_count_from_their_own_start():
    found = tftool.diff(frames(), frames(start=5 * SECOND))

    assert not found
    assert found.shift == 5 * SECOND - START
    assert "different clocks" in found.notes[0]


def test_spans_apart_are_compared_when_asked_to():
    later = frames(start=START + 1000 * SECOND, off=0.05)

    apart = tftool.diff(frames(), later)
    aligned = tftool.diff(frames(), later, align_starts=True)

    assert apart
    assert [one.child for one in apart.changed] == ["base"]
    assert apart.links[0].changes == ("not compared",)
    assert apart.links[0].displacement is None
    assert "--align start" in apart.notes[0]
    assert changes(aligned) == {"base": (Change.pose,)}


def test_a_joint_of_a_description_is_no_difference_to_what_moves(tmp_path):
    (tmp_path / "robot.urdf").write_text(
        '<robot name="r"><link name="map"/><link name="base"/><link name="laser"/>'
        '<joint name="drive" type="prismatic"><parent link="map"/><child link="base"/>'
        '<axis xyz="1 0 0"/><limit lower="0" upper="9" effort="1" velocity="1"/></joint>'
        '<joint name="fix" type="fixed"><parent link="base"/><child link="laser"/>'
        '<origin xyz="0.1 0.2 0.3" rpy="0.1 0.2 0.3"/></joint></robot>'
    )

    found = tftool.diff(frames(), tmp_path / "robot.urdf")

    assert not found
    assert found.links[0].after.kind is Behaviour.joint
    assert not tftool.diff(tftool.load_urdf(tmp_path / "robot.urdf"), tmp_path / "robot.urdf")


ELBOW = (
    '<robot name="r"><link name="base"/><link name="arm"/><link name="hand"/>'
    '<joint name="slide" type="prismatic"><parent link="base"/><child link="arm"/>'
    '<axis xyz="1 0 0"/><limit lower="0" upper="9" effort="1" velocity="1"/></joint>'
    '<joint name="elbow" type="continuous"><parent link="arm"/><child link="hand"/>'
    '<origin xyz="0 0 0.5"/><axis xyz="0 1 0"/></joint></robot>'
)


@pytest.mark.parametrize(
    ("old", "new", "change", "note"),
    [
        ("0 0 0.5", "0 0 0.7", Change.pose, ""),
        ("0 1 0", "0 0 1", Change.joint, "the axis is turned by 90°"),
        ("0 1 0", "0 -1 0", Change.joint, "the axis is turned by 180°"),
        ('"continuous"', '"prismatic"', Change.joint, "continuous → prismatic"),
        (
            '<axis xyz="0 1 0"/>',
            '<axis xyz="0 1 0"/><mimic joint="slide" multiplier="2"/>',
            Change.joint,
            "independent → 2 times slide +0",
        ),
    ],
)
def test_joints_of_two_descriptions_are_compared(old, new, change, note):
    limit = '<limit lower="0" upper="9" effort="1" velocity="1"/></joint></robot>'
    text = ELBOW.replace("</joint></robot>", limit)
    first, second = parse_robot(text), parse_robot(text.replace(old, new))

    found = tftool.diff(first, second)

    assert not tftool.diff(first, first)
    assert changes(found) == {"hand": (change,)}
    assert found.changed[0].note == note
    assert found.changed[0].displacement.millimetres == pytest.approx(200 if not note else 0)


def test_files_of_every_kind_are_compared_with_each_other(tmp_path):
    names = ["run.mcap", "statics.launch.py", "statics.sh", "robot.urdf"]
    for name in names:
        tftool.export(frames(), path=tmp_path / name)

    for first in names:
        for second in names:
            found = tftool.diff(tmp_path / first, tmp_path / second)
            (laser,) = [one for one in found.links if one.child == "laser"]
            assert laser.is_same
            assert laser.displacement.millimetres < 1e-9


def test_inputs_without_frames_are_refused(tmp_path):
    with pytest.raises(InputError, match="A has no frames"):
        tftool.diff(Buffer(), frames())
    (tmp_path / "s.yaml").write_text("nodes: []\n")
    with pytest.raises(UsageError, match="played first"):
        tftool.diff(tmp_path / "s.yaml", frames())


def test_every_moment_of_a_long_recording_need_not_be_asked(monkeypatch):
    monkeypatch.setattr("tftool.frames.differences.MOST_MOMENTS", 7)

    found = tftool.diff(frames(), frames(off=0.02))

    assert found.links[0].displacement.moments <= 7
    assert np.isfinite(found.links[0].displacement.millimetres)


@pytest.mark.filterwarnings("error")
def test_displacements_that_overflow_are_infinite_without_a_warning():
    far = Transform((1e300, 0.2, 0.3), quaternion_from_rpy(0.1, 0.2, 0.3))

    (still,) = tftool.diff(frames(), frames(laser=far)).changed
    (moving,) = tftool.diff(frames(), frames(off=1e300)).changed

    assert still.displacement.millimetres == math.inf
    assert moving.displacement.worst_millimetres == math.inf
