import math

import pytest
import yaml

from tests.world.nodes.vectors import FILE, TESTED_IN, VECTORS, load
from tftool.base import color as colors
from tftool.base.stamps import seconds
from tftool.geometry import motion, rigid
from tftool.world.nodes import follower, trail, turtle
from tftool.world.nodes import turtle_drivers as teleop

CONSTANTS = VECTORS["constants"]


def test_every_number_of_the_constants_is_ours():
    ours = {
        "window_px": motion.WINDOW,
        "turtle_image_px": motion.PIXELS_PER_METRE,
        "px_per_meter": motion.PIXELS_PER_METRE,
        "field": pytest.approx(motion.FIELD, abs=1e-9),
        "field_exact_hex": motion.FIELD.hex(),
        "center": pytest.approx(motion.CENTRE, abs=1e-9),
        "tick_ns": motion.TICK,
        "dt": motion.STEP,
        "nominal_rate_hz": seconds(1) / motion.TICK,
        "cmd_timeout_ns": motion.COMMAND_TIMEOUT,
        "pi_used": motion.PI,
        "two_pi_used": motion.TWO_PI,
        "background_rgb": _rgb(colors.BACKGROUND),
        "pen_rgb": _rgb(turtle.PEN_COLOR),
        "pen_width_px": turtle.PEN_WIDTH,
        "blank_sensor_rgb": _rgb(trail.BLANK),
        "first_turtle": {
            "name": "turtle1",
            "x": pytest.approx(motion.CENTRE, abs=1e-9),
            "y": pytest.approx(motion.CENTRE, abs=1e-9),
            "theta": 0.0,
        },
        "follower_spawn": dict(
            zip(("x", "y", "theta"), follower.TUTORIAL_SPAWN, strict=True), name="turtle2"
        ),
        "gains": {
            "rotation": motion.TUTORIAL_BEARING.kp,
            "forward": motion.TUTORIAL_DISTANCE.kp,
        },
        "follower_period": 1.0,
        "rotate_speed": motion.ROTATION_SPEED,
        "rotate_tolerance": motion.ROTATION_TOLERANCE,
        "teleop_scale_linear": teleop.SCALE_LINEAR,
        "teleop_scale_angular": teleop.SCALE_ANGULAR,
    }

    assert ours == CONSTANTS


@pytest.mark.parametrize("case", VECTORS["normalize_angle"], ids=lambda case: str(case["a"]))
def test_angles_wrap_with_turtlesims_pi(case):
    assert motion.wrap(case["a"]) == pytest.approx(case["expect"], abs=1e-9)
    ours = rigid.wrap(case["a"])
    assert math.remainder(ours - case["expect"], math.tau) == pytest.approx(0.0, abs=1e-6)


def test_a_section_that_no_test_knows_is_refused():
    with pytest.raises(ValueError, match=r"sections nobody tests: \{'surprise'\}"):
        load(FILE.read_text(encoding="utf-8") + "\nsurprise: [1]\n")


def test_a_section_that_is_gone_is_noticed():
    vectors = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    del vectors["pid"]

    with pytest.raises(ValueError, match=r"sections that are gone: \{'pid'\}"):
        load(yaml.safe_dump(vectors))


def test_every_section_is_read_by_the_module_that_claims_it():
    for section, module in TESTED_IN.items():
        path = FILE.parents[1].joinpath("world/nodes", f"{module}.py")
        assert f'["{section}"]' in path.resolve().read_text(encoding="utf-8")


def _rgb(color):
    return [color.r, color.g, color.b]
