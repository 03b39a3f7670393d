"""Tests of recordings with a robot description: joint states become frames that tf lacks."""

import math

import numpy as np
import pytest

import tftool
from tests.recordings.writers import SECOND, Sent, write_mcap, write_rosbag1, write_rosbag2
from tests.robots.test_robot import TEXT
from tftool.robots.joint_motion import JointStates
from tftool.robots.urdf import parse_description

START = 1_750_000_000 * SECOND
HOOK = (1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0)


def states(moments, names=("turn", "reach"), topic="/joint_states"):
    """Return joint states a tenth of a second apart, with the positions in `moments`."""
    return [
        Sent(
            START + number * SECOND // 10 + 5,
            topic,
            joints=(START + number * SECOND // 10, names, positions),
        )
        for number, positions in enumerate(moments)
    ]


DESCRIBED = Sent(START, "/robot_description", text=TEXT)
MOVES = states([(0.1 * n, 1.0 + 0.2 * n) for n in range(10)])


@pytest.fixture
def recorded(tmp_path):
    """Return a function that writes messages, and opens the recording."""

    def write(sent, writer=write_mcap, **words):
        place = tmp_path / ("run" if writer is write_rosbag2 else "run.file")
        return tftool.open_recording(writer(place, sent), **words)

    return write


@pytest.mark.parametrize("writer", [write_mcap, write_rosbag1, write_rosbag2])
def test_joint_states_move_the_frames_of_the_description_in_every_container(recorded, writer):
    with recorded([DESCRIBED, *MOVES], writer) as recording:
        found = recording.buffer.lookup_transform("base", "hook", START + SECOND // 2)

    expected = tftool.Transform((0, 0, 2), tftool.quaternion_from_rpy(0, 0, 0.5)) @ (
        tftool.Transform((0, 0, 0), tftool.quaternion_from_rpy(0, 0, math.pi / 2))
        @ tftool.Transform((2.0, 0, 0))
    )
    assert found.transform.translation == pytest.approx(expected.translation)
    assert found.transform.rotation == pytest.approx(expected.rotation)
    assert recording.described.moving == ("boom", "hook", "claw", "eye")
    assert recording.described.gaps == ()


def test_frames_of_tf_stay_as_they_are(recorded):
    hook = Sent(START + 9, "/tf", ((START + SECOND // 2, "boom", "hook", HOOK),))
    with recorded([DESCRIBED, hook, *MOVES]) as recording:
        found = recording.buffer.lookup_transform("boom", "hook", START + SECOND // 2)

    assert found.transform.translation == HOOK[:3]
    assert "hook" not in recording.described.moving


def test_a_joint_that_nothing_moves_is_a_gap(recorded):
    with recorded([DESCRIBED, *states([(0.5,)], names=("turn",))]) as recording:
        assert recording.described.gaps == ("hook", "claw", "eye")
        assert not recording.buffer.frame_exists("hook")


def test_a_mimic_has_its_own_position_where_the_message_says_one(recorded):
    own = states([(2.0, 0.25)], names=("reach", "grip"))
    with recorded([DESCRIBED, *own]) as recording:
        claw = recording.buffer.lookup_transform("hook", "claw", START)
        eye = recording.buffer.lookup_transform("claw", "eye", START)

    assert claw.transform.rotation == pytest.approx(tftool.quaternion_from_rpy(0, 0.25, 0))
    # look mimics grip, with the position that grip really has.
    assert eye.transform.rotation == pytest.approx(tftool.quaternion_from_rpy(0, 3 * 0.25 + 1, 0))


def test_positions_that_are_not_numbers_are_gaps_in_time(recorded):
    moves = states([(0.1, 1.0), (math.nan, 1.0), (0.3, 1.0)])
    with recorded([DESCRIBED, *moves]) as recording:
        held = recording.buffer.samples("boom")

    assert held.stamps.tolist() == [START, START + 2 * SECOND // 10]


@pytest.mark.parametrize(
    ("names", "positions", "told"),
    [
        (("turn", "reach"), (1.0,), "with 2 names and 1 positions: the message is ignored"),
        ((), (), "without a joint"),
        (("turn", "turn"), (1.0, 1.0), "that names a joint twice"),
    ],
)
def test_a_message_that_says_no_positions_is_ignored_and_counted(recorded, names, positions, told):
    odd = Sent(START + 7, "/joint_states", joints=(START, names, positions))
    with recorded([DESCRIBED, *MOVES, odd, odd]) as recording:
        assert recording.oddities[f"'/joint_states' has a message {told}"] == 2
        assert len(recording.buffer.samples("boom")) == len(MOVES)


def test_messages_of_several_publishers_come_together(recorded):
    turn = states([(0.1 * n,) for n in range(5)], names=("turn",))
    reach = states([(1.0 + n,) for n in range(3)], names=("reach",))
    with recorded([DESCRIBED, *sorted([*turn, *reach], key=lambda one: one.log_time)]) as recording:
        assert len(recording.buffer.samples("boom")) == 5
        assert len(recording.buffer.samples("hook")) == 3


def test_joint_states_of_the_descriptions_own_namespace_count(recorded):
    described = Sent(START, "/arm/robot_description", text=TEXT)
    own = states([(0.5, 1.0)], topic="/arm/joint_states")
    other = states([(0.9, 1.0)], topic="/other/joint_states")
    with recorded([described, *own, *other]) as recording:
        found = recording.buffer.lookup_transform("base", "boom", START)

    assert tftool.rpy_from_quaternion(found.transform.rotation)[2] == pytest.approx(0.5)


def test_a_frame_prefix_is_found_out(recorded):
    boom = Sent(START + 9, "/tf", ((START, "left/base", "left/boom", HOOK),))
    with recorded([DESCRIBED, boom, *MOVES]) as recording:
        assert recording.described.prefix == "left/"
        assert recording.described.moving == ("left/hook", "left/claw", "left/eye")


def test_a_broken_description_inside_is_told_and_nothing_is_lost(recorded):
    broken = Sent(START, "/robot_description", text=TEXT.replace("</robot>", ""))
    hook = Sent(START + 9, "/tf", ((START, "boom", "hook", HOOK),))
    with recorded([broken, hook]) as recording:
        assert recording.robot is None
        assert recording.buffer.frame_exists("hook")
        assert any("'/robot_description' cannot be read" in text for text in recording.oddities)


def test_a_placeholder_and_a_broken_one_do_not_hide_the_description_after_them(recorded):
    placeholder = Sent(START, "/robot_description", text='<robot name=""><link name=""/></robot>')
    broken = Sent(START + 1, "/robot_description", text="<robot>")
    later = Sent(START + 2, "/robot_description", text=TEXT)
    with recorded([placeholder, broken, later]) as recording:
        assert recording.robot is not None
        assert "boom" in recording.robot.links
    with recorded([placeholder, Sent(START + 9, "/tf", ((START, "a", "b", HOOK),))]) as recording:
        assert recording.robot is None
        assert not any("robot_description" in text for text in recording.oddities)
        assert "urdf-invalid" not in [one.id for one in tftool.diagnose(recording)]


def test_a_description_can_be_given_from_outside(recorded, tmp_path):
    path = tmp_path / "crane.urdf"
    path.write_text(TEXT)
    with recorded(MOVES, robot=tftool.load_urdf(path)) as recording:
        assert recording.buffer.can_transform("base", "eye", START)
        assert (recording.start, recording.end) == (START, START + 9 * SECOND // 10)


def test_a_robots_buffer_of_joint_states_is_its_transforms_at_each_moment():
    robot = tftool.Robot(parse_description(TEXT))
    draw = np.random.default_rng(3)
    moved = JointStates(("turn", "reach"), START + np.arange(20), draw.normal(size=(20, 2)))

    buffer = robot.buffer(moved)

    for row in range(20):
        given = dict(zip(moved.names, moved.positions[row].tolist(), strict=True))
        for one in robot.transforms(given):
            found = buffer.lookup_transform(one.frame_id, one.child_frame_id, START + row)
            place, turn = found.transform
            assert place == pytest.approx(one.transform.translation, abs=1e-15)
            assert abs(np.dot(turn, one.transform.rotation)) == pytest.approx(1.0)


def test_joint_states_of_the_wrong_shape_are_refused():
    with pytest.raises(ValueError, match=r"2 joints need \(n,\) and \(n, 2\)"):
        JointStates(("turn", "reach"), np.arange(3), np.zeros((3, 1)))
