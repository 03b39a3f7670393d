import math

import pytest

from tests.robots.test_robot import TEXT
from tests.world.nodes.harness import After, At, log_texts, new_world, play
from tftool.base.errors import ExtrapolationException, LookupException, UsageError
from tftool.base.stamps import seconds
from tftool.geometry.conversions import rpy_from_quaternion
from tftool.robots.joint_motion import JointStates
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description
from tftool.world.nodes.joints import (
    LATCHED,
    JointStatePublisher,
    MovingRobot,
    RobotStatePublisher,
    description_type,
    joint_state,
    joint_state_type,
)

FIXED = TEXT.replace(
    "</robot>",
    '<link name="plate"/><joint name="bolt" type="fixed"><origin xyz="1 2 3"/>'
    '<parent link="base"/><child link="plate"/></joint></robot>',
)


@pytest.fixture
def robot():
    return Robot(parse_description(FIXED))


@pytest.fixture
def world():
    return new_world()


def yaw(world, target, source, stamp=0):
    found = world.buffer.lookup_transform(target, source, stamp)
    return rpy_from_quaternion(found.transform.rotation)[2]


def sends(world, *positions, names=("turn", "reach"), offset=0.0):
    """Send joint states a tenth of a second apart; `offset` shifts their stamps to the future."""

    def send(values):
        stamp = world.clock.now() + seconds(offset)
        message = joint_state(stamp, dict(zip(names, values, strict=True)))
        world.topic("joint_states", joint_state_type()).publish(message)

    steps = [
        (0.1 + 0.1 * n, lambda values=values: send(values)) for n, values in enumerate(positions)
    ]
    return At(world, *steps)


def test_fixed_joints_are_static_and_moving_ones_follow_the_messages(world, robot):
    RobotStatePublisher(world, robot=robot)
    sends(world, (0.1, 2.0), (0.2, 2.0))
    play(world, 1.0)
    start = world.clock.epoch

    plate = world.buffer.lookup_transform("base", "plate")
    assert plate.transform.translation == (1.0, 2.0, 3.0)
    assert yaw(world, "base", "boom", start + seconds(0.1)) == pytest.approx(0.1)
    assert yaw(world, "base", "boom", start + seconds(0.15)) == pytest.approx(0.15)
    x, y, z, w = world.buffer.lookup_transform("hook", "claw").transform.rotation
    assert (x, z) == (0.0, 0.0)
    assert 2 * math.atan2(y, w) % math.tau == pytest.approx((-2 * 2.0 + 0.5) % math.tau)


def test_a_joint_that_no_message_names_has_no_frame(world, robot):
    RobotStatePublisher(world, robot=robot)
    sends(world, (0.1,), names=("turn",))
    play(world, 1.0)

    with pytest.raises(LookupException):
        world.buffer.lookup_transform("boom", "hook")


def test_the_publish_frequency_limits_how_often_a_joint_is_broadcast(world, robot):
    RobotStatePublisher(world, robot=robot, publish_frequency=4.0)
    sends(world, *[(0.1 * n, 1.0) for n in range(10)])
    play(world, 2.0)

    stamps = (world.buffer.samples("boom").stamps - world.clock.epoch).tolist()
    assert stamps == [seconds(0.1), seconds(0.4), seconds(0.7), seconds(1.0)]


def test_every_message_counts_at_frequency_zero(world, robot):
    RobotStatePublisher(world, robot=robot, publish_frequency=0.0)
    sends(world, *[(0.1 * n, 1.0) for n in range(10)])
    play(world, 2.0)

    assert len(world.buffer.samples("boom")) == 10


def test_frame_prefix_stands_before_every_link(world, robot):
    RobotStatePublisher(world, robot=robot, frame_prefix="left/")
    sends(world, (0.1, 2.0))
    play(world, 1.0)

    assert world.buffer.can_transform("left/base", "left/hook")
    assert world.buffer.can_transform("left/base", "left/plate")
    assert not world.buffer.frame_exists("base")


@pytest.mark.parametrize(
    ("positions", "told"),
    [([], "without positions"), ([1.0], "2 names and 1 positions")],
)
def test_a_message_whose_positions_do_not_fit_is_ignored_and_said_once(
    world, robot, positions, told
):
    RobotStatePublisher(world, robot=robot)

    def send():
        message = joint_state_type()(name=["turn", "reach"], position=positions)
        world.topic("joint_states", joint_state_type()).publish(message)

    At(world, (0.1, send), (0.2, send))
    play(world, 1.0)

    assert not world.buffer.frame_exists("boom")
    assert sum(told in text for text in log_texts(world)) == 1


def test_late_subscribers_get_the_description(world, robot):
    RobotStatePublisher(world, robot=robot)
    heard = []
    At(
        world,
        (
            0.5,
            lambda: world.subscribe(
                "late", "robot_description", description_type(), heard.append, LATCHED
            ),
        ),
    )
    play(world, 1.0)

    assert [one.data for one in heard] == [FIXED]


def test_a_new_description_takes_the_place_of_the_old_one(world, robot):
    node = RobotStatePublisher(world, robot=robot)
    other = FIXED.replace("1 2 3", "7 8 9")
    At(world, (0.5, lambda: node.set_parameter("robot_description", other)))
    At(world, (0.6, lambda: node.set_parameter("robot_description", "<robot")), name="breaks")
    play(world, 1.0)

    plate = world.buffer.lookup_transform("base", "plate")
    assert plate.transform.translation == (7.0, 8.0, 9.0)
    assert any("the new robot_description is rejected" in text for text in log_texts(world))


@pytest.mark.parametrize("frequency", [-1.0, 1001.0, math.nan])
def test_a_frequency_that_ros_refuses_is_refused(world, robot, frequency):
    with pytest.raises(UsageError, match="between 0 and 1000 Hz"):
        RobotStatePublisher(world, robot=robot, publish_frequency=frequency)


def test_joint_state_publisher_begins_at_rest_and_moves(world, robot):
    RobotStatePublisher(world, robot=robot)
    sliders = JointStatePublisher(world, robot=robot, positions={"turn": 0.5})
    At(world, (1.05, lambda: sliders.move("turn", 1.0)))
    play(world, 2.0)
    start = world.clock.epoch

    assert yaw(world, "base", "boom", start + seconds(0.5)) == pytest.approx(0.5)
    assert yaw(world, "base", "boom") == pytest.approx(1.0)
    assert world.buffer.lookup_transform("boom", "hook").transform.translation == (
        pytest.approx((0, 3, 0))
    )
    assert sliders.positions["look"] == pytest.approx(3 * (-2 * 3.0 + 0.5) + 1.0)


def test_joint_state_publisher_waits_for_a_description(world, robot):
    sliders = JointStatePublisher(world, positions={"turn": 0.5, "nothing": 1.0})
    RobotStatePublisher(world, robot=robot)
    play(world, 2.0)

    assert sliders.positions["turn"] == 0.5
    assert yaw(world, "base", "boom") == pytest.approx(0.5)
    assert "robot 'crane' has no joint 'nothing' that moves" in log_texts(world)


def test_joint_state_publisher_takes_over_what_others_say(world, robot):
    sliders = JointStatePublisher(world, robot=robot, sources=["hand"])
    At(
        world,
        (
            0.5,
            lambda: world.topic("hand", joint_state_type()).publish(
                joint_state(0, {"turn": 0.25, "other": 3.0, "reach": math.nan})
            ),
        ),
    )
    play(world, 1.0)

    assert sliders.positions["turn"] == 0.25
    assert sliders.positions["reach"] == 3.0


def test_no_joint_is_moved_that_is_not_there(world, robot):
    sliders = JointStatePublisher(world, robot=robot)

    with pytest.raises(UsageError, match="did you mean 'turn'"):
        sliders.move("turm", 1.0)


def test_a_robot_swings_between_its_limits(world, robot):
    MovingRobot(world, file=robot, motion="sine", cycle=seconds(4), joints={"turn": 0.25})
    seen = []
    After(
        world,
        *(
            (
                0.05 * tick,
                lambda: seen.append(
                    world.buffer.lookup_transform("boom", "hook").transform.translation.y
                ),
            )
            for tick in range(1, 100)
        ),
    )
    play(world, 6.0)

    # reach is the first joint that is not fixed: from 1 m to 5 m and back in 4 s
    assert min(seen) == pytest.approx(1.0, abs=0.01)
    assert max(seen) == pytest.approx(5.0, abs=0.01)
    assert yaw(world, "base", "boom") == pytest.approx(0.25)


def test_a_robot_steps_from_limit_to_limit(world, robot):
    MovingRobot(world, file=robot, motion="steps", cycle=seconds(4), joints={"turn": 0.0})
    play(world, 5.0)
    start = world.clock.epoch

    reached = [
        world.buffer.lookup_transform("boom", "hook", start + seconds(at)).transform.translation.y
        for at in (0.5, 1.5, 2.5, 3.5)
    ]
    assert reached == pytest.approx([3.0, 5.0, 3.0, 1.0])


def test_a_robot_repeats_what_was_recorded(world, robot):
    recorded = JointStates(("turn",), [1_000, 500_001_000, 900_001_000], [[0.1], [0.2], [0.3]])
    MovingRobot(world, file=robot, motion="recorded", recording=[recorded])
    play(world, 2.0)

    held = world.buffer.samples("boom")
    assert (held.stamps - world.clock.epoch).tolist() == [0, 500_000_000, 900_000_000]
    with pytest.raises(ExtrapolationException):
        world.buffer.lookup_transform("base", "boom", world.clock.epoch + seconds(1.5))


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ({"motion": "recorded"}, "needs a recording with joint states"),
        ({"joints": {"turm": 1.0}}, "did you mean 'turn'"),
        (
            {"recording": [JointStates(("turn",), [1], [[0.0]])]},
            "'recording' is only allowed together with 'motion: recorded'",
        ),
    ],
)
def test_a_robot_whose_motion_makes_no_sense_is_refused(world, robot, words, told):
    with pytest.raises(UsageError, match=told):
        MovingRobot(world, file=robot, **words)
