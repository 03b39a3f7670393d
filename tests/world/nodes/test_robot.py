import math

import pytest

from tests.world.nodes.harness import After, At, log_texts, new_world, play
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Pose, Twist, twist
from tftool.world.nodes.broadcasters import StaticBroadcaster
from tftool.world.nodes.mobile_robot import TRUTH, LaserPoint, MapCorrection, RobotOdometry

LANDMARK = (3.0, 1.0, 0.2)
# The laser hangs upside down, as lasers do.
LASER = TransformStamped(0, "base_link", "laser_link", Transform((0.1, 0, 0.2), (1, 0, 0, 0)))


def robot_world(**options):
    world = new_world()
    robot = RobotOdometry(world, **options)
    MapCorrection(world)
    StaticBroadcaster(world, "laser_mount", transforms=[LASER])
    LaserPoint(world, landmark=LANDMARK)
    return world, robot


def seen_every_second(world, until, frame):
    found = []

    def look():
        found.append(world.buffer.lookup_transform(frame, "laser_point").transform.translation)

    After(world, *((second, look) for second in range(1, until + 1)), name=f"{frame} watcher")
    return found


def test_a_laser_point_stays_put_in_the_map_and_wanders_in_odom():
    world, _ = robot_world()
    in_map = seen_every_second(world, 30, "map")
    in_odom = seen_every_second(world, 30, "odom")
    play(world, 30.0)

    assert max(math.dist(point, LANDMARK) for point in in_map) < 0.15
    assert max(math.dist(point, LANDMARK) for point in in_odom) > 0.5


def test_without_errors_odometry_is_the_truth():
    world, robot = robot_world(scale_error=0.0, turn_error=0.0)
    in_odom = seen_every_second(world, 10, "odom")
    play(world, 10.0)

    assert robot.believed == robot.truth
    assert max(math.dist(point, LANDMARK) for point in in_odom) < 1e-9


def test_the_correction_jumps_now_and_then_and_stands_still_in_between():
    world, _ = robot_world()
    offsets = []
    After(
        world,
        *(
            (
                0.5 * half,
                lambda: offsets.append(world.buffer.lookup_transform("map", "odom").transform),
            )
            for half in range(1, 12)
        ),
    )
    play(world, 6.0)

    assert offsets[0] == Transform.identity()
    jumps = [k for k in range(1, len(offsets)) if offsets[k] != offsets[k - 1]]
    # The corrections at 2 s and 4 s are visible at the same instants.
    assert jumps == [3, 7]


def test_right_after_a_correction_the_robot_is_where_it_truly_is():
    world, robot = robot_world()
    play(world, 4.0)

    found = world.buffer.lookup_transform("map", "base_link", seconds(1004)).transform
    assert found.translation[:2] == pytest.approx(robot.truth[:2], abs=1e-9)


def test_a_robot_told_to_stand_stands_in_truth_and_belief():
    world, robot = robot_world()
    At(
        world,
        (1.0, lambda: world.topic("base_link/cmd_vel", Twist).publish(twist())),
        (1.5, lambda: (robot.truth, robot.believed)),
        (1.5, lambda: world.topic("base_link/cmd_vel", Twist).publish(twist(math.nan))),
    )
    hands = world.node("hands")
    play(world, 3.0)

    assert (robot.truth, robot.believed) == hands.answers[1]
    assert any("Ignoring a velocity command" in text for text in log_texts(world))


def test_a_straight_way_is_an_arc_too():
    world, robot = robot_world(turn_rate=0.0, turn_error=0.0)
    play(world, 2.0)

    assert robot.truth == pytest.approx((1.0, 0.0, 0.0))
    assert robot.believed.x == pytest.approx(1.02)


def test_nothing_is_measured_before_the_laser_is_mounted_and_the_robot_known():
    world = new_world()
    LaserPoint(world)
    MapCorrection(world)
    At(
        world,
        (1.0, lambda: world.topic(f"base_link/{TRUTH}", Pose).publish(build(Pose, 0.0, 0.0, 0.0))),
    )
    play(world, 3.0)

    assert "laser_point" not in world.buffer.frames()
    # The true pose was published, but there is no odometry to correct.
    assert [one.level for one in world.log.records] == ["WARN"]
    assert "Cannot correct the map" in log_texts(world)[0]
