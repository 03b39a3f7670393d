"""Tests of the scenario node `robot`: an arm from its description."""

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
