"""Tests of the scenario node `robot`: an arm from its description."""

import re

import pytest

from tests.recordings.writers import SECOND, Sent, write_mcap
from tests.world.nodes.test_joints import FIXED
from tftool.app.main import main
from tftool.base.errors import ScenarioError
from tftool.scenario.load import load


@pytest.fixture
def scenario(tmp_path):
    """Return a function that writes a scenario with a robot beside its description."""
    (tmp_path / "crane.urdf").write_text(FIXED)

    def write(robot, expect="[]"):
        path = tmp_path / "arm.yaml"
        path.write_text(
            f"about: an arm.\nduration: 5 s\nnodes:\n  - robot: {robot}\nexpect: {expect}\n"
        )
        return path

    return write


def checked(path):
    """Return whether a scenario meets its expectations."""
    return main(["check", str(path)])


def test_a_robot_stands_where_its_joints_are_put(scenario):
    path = scenario(
        "{file: crane.urdf, joints: {turn: 90 deg, reach: 200 cm}}",
        "[{at: 1 s, distance: {from: base, to: hook}, is: 2.8284271 m, tolerance: 1 mm},"
        " {at: 1 s, distance: {from: base, to: plate}, is: 3.7416574 m, tolerance: 1 mm}]",
    )

    assert checked(path) == 0


def test_a_robot_swings_and_two_runs_are_equal(scenario):
    path = scenario(
        "{file: crane.urdf, motion: sine, cycle: 4 s, joints: {turn: 0}}",
        "[{at: 1 s, distance: {from: boom, to: hook}, is: 5 m, tolerance: 1 mm},"
        " {at: 3 s, distance: {from: boom, to: hook}, is: 1 m, tolerance: 1 mm}]",
    )

    assert checked(path) == 0


def test_a_robot_steps(scenario):
    path = scenario(
        "{file: crane.urdf, motion: steps, cycle: 4 s, joints: {turn: 0}}",
        "[{at: 1.5 s, distance: {from: boom, to: hook}, is: 5 m, tolerance: 1 mm}]",
    )

    assert checked(path) == 0


def test_a_robot_repeats_a_recording(scenario, tmp_path):
    start = 1_750_000_000 * SECOND
    write_mcap(
        tmp_path / "run.mcap",
        [
            Sent(stamp, "/joint_states", joints=(stamp, ("reach",), (1.0 + tick,)))
            for tick, stamp in enumerate((start, start + SECOND, start + 2 * SECOND))
        ],
    )
    path = scenario(
        "{file: crane.urdf, motion: recorded, recording: run.mcap}",
        "[{at: 1 s, distance: {from: boom, to: hook}, is: 2 m, tolerance: 1 mm}]",
    )

    assert checked(path) == 0


@pytest.mark.parametrize(
    ("robot", "told"),
    [
        ("{file: none.urdf}", "there is no file 'none.urdf' beside the scenario"),
        ("{}", "file"),
        ("{file: crane.urdf, joints: {turn: 3 s}}", "not an angle"),
        ("{file: crane.urdf, joints: [1]}", "a mapping"),
        ("{file: crane.urdf, motion: dance}", "dance"),
        ("{file: broken.urdf}", "broken.urdf:1:"),
        ("{file: some.xacro}", "contains xacro, which scenarios do not expand"),
    ],
)
def test_mistakes_are_told_with_their_place(scenario, tmp_path, robot, told):
    (tmp_path / "broken.urdf").write_text("<robot/>")
    (tmp_path / "some.xacro").write_text('<robot name="a"><link name="${1 + 1}"/></robot>')

    with pytest.raises(ScenarioError, match=told) as refused:
        load(scenario(robot))
    assert "arm.yaml:4:" in str(refused.value)


def test_a_joint_that_is_not_there_is_told(scenario, capsys):
    assert checked(scenario("{file: crane.urdf, joints: {turm: 1}}")) in (2, 3)
    assert "did you mean 'turn'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("joints", "told"),
    [
        ("{reach: 20 deg}", "so its position is a length in metres, not an angle"),
        ("{turn: 20 cm}", "so its position is an angle in radians or degrees, not a length"),
    ],
)
def test_a_position_with_the_unit_of_another_joint_is_told(scenario, capsys, joints, told):
    assert checked(scenario(f"{{file: crane.urdf, joints: {joints}}}")) == 3
    assert told in capsys.readouterr().err


def test_a_joint_beyond_its_limits_is_a_warning(scenario, capsys):
    assert checked(scenario("{file: crane.urdf, joints: {reach: 900 m}}")) == 0

    told = capsys.readouterr()
    assert "arm.yaml:4:5: Joint 'reach' at 900 m is beyond its limits" in told.err
    assert "ok, 1 warning" in told.out


def two(first, second, expect="[]"):
    """Return the text of a scenario with two nodes."""
    return f"duration: 5 s\nnodes:\n  - {first}\n  - {second}\nexpect: {expect}\n"


def test_two_robots_with_prefixes_keep_their_own_joint_positions(scenario):
    path = scenario("{file: crane.urdf}")
    path.write_text(
        two(
            "robot: {file: crane.urdf, frame_prefix: l/, joints: {reach: 2}}",
            "robot: {file: crane.urdf, frame_prefix: r/, joints: {reach: 4}}",
            "[{during: [0.1 s, 5 s], distance: {from: l/boom, to: l/hook}, is: 2 m},"
            " {during: [0.1 s, 5 s], distance: {from: r/boom, to: r/hook}, is: 4 m}]",
        )
    )

    assert checked(path) == 0


def test_two_robots_keep_their_own_poses(scenario):
    path = scenario("{file: crane.urdf}")
    path.write_text(
        "duration: 5 s\nnodes:\n"
        "  - odometry: {odom: a/odom, base: a/base, speed: 0, turn_rate: 0}\n"
        "  - odometry: {odom: b/odom, base: b/base, speed: 0, turn_rate: 0, start: {x: 7}}\n"
        "  - localization: {odom: a/odom, base: a/base, correct_every: 1 s}\n"
        "  - static: {parent: a/base, child: a/laser}\n"
        "  - laser: {base: a/base, laser: a/laser, landmark: {x: 3, y: 0, z: 0}}\n"
        "  - scan_matcher: {base: b/base, position: 0, angle: 0}\n"
        "expect:\n"
        "  - {at: [3 s, 5 s], lookup: {target: map, source: a/base}, value: {x: 0}}\n"
        "  - {at: [3 s, 5 s], distance: {from: a/laser, to: laser_point}, is: 3 m}\n"
        "  - {at: [3 s, 5 s], distance: {from: scan_start, to: scan_laser}, is: 0 m}\n"
    )

    assert checked(path) == 0


@pytest.mark.parametrize(
    ("first", "second", "told"),
    [
        (
            "robot: {file: crane.urdf, frame_prefix: l/}",
            "robot: {file: crane.urdf, frame_prefix: l/}",
            "the node of line 3 also moves joint 'l/turn': give one of the two another "
            "'frame_prefix'",
        ),
        (
            "odometry",
            "odometry: {odom: b/odom}",
            "the node of line 3 also moves frame 'base_link': give one of the two another 'base'",
        ),
        (
            "odometry: {base: a/base}",
            "odometry: {base: b/base}\n  - laser: {base: a/bse}",
            "no robot has the base 'a/bse'; did you mean 'a/base'?",
        ),
    ],
)
def test_robots_that_would_move_each_other_are_refused(scenario, first, second, told):
    path = scenario("{file: crane.urdf}")
    path.write_text(two(first, second))

    with pytest.raises(ScenarioError, match=re.escape(told)):
        load(path)


def test_a_laser_of_the_only_robot_may_name_another_base(scenario):
    path = scenario("{file: crane.urdf}")
    path.write_text(
        two(
            "odometry: {base: footprint, speed: 0, turn_rate: 0}",
            "static: {parent: base_link, child: laser_link}\n  - laser",
            "[{at: 1 s, frame: laser_point, parent: laser_link}]",
        )
    )

    assert checked(path) == 0
