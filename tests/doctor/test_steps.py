"""Tests of the list of a localiser's steps, without its continuous motion."""

import math

import numpy as np
import pytest

from tests.doctor.judged import turned
from tests.doctor.robots import NO_TURN, Robot, drives, robot
from tftool.base.errors import LookupException
from tftool.doctor.localisation_steps import steps_of
from tftool.doctor.model import Model


def localised() -> Robot:
    """Return a robot that drives, with a localiser that corrects it more every two seconds."""

    def corrects(t: float) -> tuple[float, ...]:
        jumps = int(t / 2.0 + 1e-6)
        # Between its steps, the localiser drifts by 1 mm per second.
        return (0.02 * jumps + 0.001 * t, 0.0, 0.0, *turned(math.radians(jumps)))

    made = robot()
    made.moving("map", "odom", 10.0, corrects)
    return made


def test_every_correction_is_a_step_of_its_size_with_the_drift_before_it():
    steps = steps_of(Model(localised().evidence()))
    assert [step.edge for step in steps] == [("map", "odom")] * 3
    for step in steps:
        assert step.moved == pytest.approx(0.02, abs=1e-6)
        assert math.degrees(step.turned) == pytest.approx(1.0, abs=1e-6)
    # Between two steps are 19 samples of 0.1 mm.
    assert [step.drift_moved for step in steps[1:]] == pytest.approx([0.0019, 0.0019], abs=1e-6)


def test_noise_and_motion_are_no_steps_and_a_jump_among_them_is():
    noise = np.random.default_rng(1)

    def shakes(t: float) -> tuple[float, ...]:
        x, y = noise.normal(0.0, 0.004, 2)
        return (0.8 * t + x + (0.2 if t > 5.0 else 0.0), y, 0.0, *turned(0.5 * t))

    made = robot(odometry=False)
    made.moving("odom", "base_link", 20.0, shakes)
    (step,) = steps_of(Model(made.evidence()), "odom", "base_link")
    assert step.moved == pytest.approx(0.2, abs=0.03)
    assert steps_of(Model(robot().evidence()), "odom", "laser") == ()


def test_a_pair_names_the_edges_and_frames_that_there_are_not_are_refused():
    model = Model(localised().evidence())
    assert len(steps_of(model, "map", "base_link")) == 3
    assert steps_of(model, "odom", "base_link") == ()
    with pytest.raises(LookupException, match="No transform contains the frame 'cup'"):
        steps_of(model, "map", "cup")
    split = robot()
    split.moving("table", "plate", pose=drives)
    with pytest.raises(LookupException, match="No transforms connect"):
        steps_of(Model(split.evidence()), "odom", "plate")


def test_few_samples_have_no_steps():
    made = Robot()
    for tick in range(5):
        made.sent("map", "odom", tick * 0.1, (float(tick % 2), 0.0, 0.0, *NO_TURN))
    assert steps_of(Model(made.evidence())) == ()


@pytest.mark.parametrize("jump", [0.0, 0.3])
def test_stamps_that_are_less_regular_than_the_motion_make_no_steps(jump):
    """Check wheels that report 42 mm per message, whatever the stamp."""
    made, at = robot(odometry=False, scans=False), 0.0
    for number, gap in enumerate([0.15, 0.1, 0.2, 0.05, 0.3, 0.045, 0.15, 0.2, 0.05, 0.14] * 8):
        at += gap
        made.sent("odom", "base_link", at, (0.042 * number + jump * (number > 45), 0, 0, *NO_TURN))
    steps = steps_of(Model(made.evidence()), "odom", "base_link")
    assert [step.moved for step in steps] == pytest.approx([jump] if jump else [], abs=0.07)


def test_a_robot_that_starts_and_stops_at_once_makes_no_steps():
    made = robot(odometry=False, scans=False)
    made.moving(
        "odom",
        "base_link",
        10.0,
        lambda t: (0.5 * min(max(t - 3.03, 0.0), 2.0), 0.0, 0.0, *NO_TURN),
    )
    assert steps_of(Model(made.evidence()), "odom", "base_link") == ()
