import math

import pytest

from tftool.messages import Color
from tftool.views import theme
from tftool.views.theme import Rgba, faded, stale_fade


@pytest.mark.parametrize(
    ("age", "expected"),
    [
        (0.0, (1.0, 0.0, 0.0, 1.0)),
        (5.0, (1.0, 0.0, 0.0, 1.0)),
        (7.5, (0.85, 0.35, 0.35, 1.0)),
        (10.0, (0.7, 0.7, 0.7, 1.0)),
        (12.5, (0.7, 0.7, 0.7, 0.5)),
        (15.0, (0.7, 0.7, 0.7, 0.0)),
    ],
)
def test_a_stale_colour_turns_grey_and_then_transparent(age, expected):
    assert stale_fade(theme.AXIS_X, age) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("age", [15.1, 1e9, math.inf, math.nan])
def test_what_is_dead_or_of_no_known_age_is_hidden(age):
    assert stale_fade(theme.NAME, age) is None
    assert faded(theme.WHITE, age, theme.INK) is None


def test_another_timeout_scales_all_three_stages():
    assert stale_fade(theme.NAME, 1.5, 3.0) == stale_fade(theme.NAME, 7.5, 15.0)
    assert stale_fade(Rgba(1.0, 1.0, 1.0, 0.5), 2.5, 3.0) == pytest.approx((0.7, 0.7, 0.7, 0.25))


def test_on_a_screen_what_is_transparent_shows_the_ground():
    ground = Color(10, 20, 30)

    assert faded(theme.WHITE, 0.0, ground) == theme.WHITE
    assert faded(theme.WHITE, 10.0, ground) == Color(178, 178, 178)
    assert faded(theme.WHITE, 15.0, ground) == ground


def test_a_name_has_one_colour_and_neighbours_differ():
    assert theme.of_name("carrot1") == theme.of_name("carrot1")
    assert len({theme.of_name(f"turtle{n}") for n in range(1, 9)}) == 8


@pytest.mark.parametrize("name", ["", "7", "\ud800", "turtle²", "x" * 500, "a" + "9" * 400])
def test_any_name_has_a_colour(name):
    assert theme.of_name(name) in theme._PALETTE


def test_a_colour_is_written_in_hexadecimal():
    assert theme.hexadecimal(theme.BACKGROUND) == "#4556ff"


@pytest.mark.parametrize(
    ("environment", "light"),
    [({}, False), ({"COLORFGBG": "0;15"}, True), ({"COLORFGBG": "15;default;0"}, False)],
)
def test_a_terminal_may_say_that_its_ground_is_light(environment, light):
    assert theme.prefers_light(environment) is light
