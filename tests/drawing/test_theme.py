import pytest

from tftool.base.color import BACKGROUND
from tftool.drawing import theme


def test_a_name_has_one_colour_and_neighbours_differ():
    assert theme.of_name("carrot1") == theme.of_name("carrot1")
    assert len({theme.of_name(f"turtle{n}") for n in range(1, 9)}) == 8


@pytest.mark.parametrize(
    "names",
    ["world turtle1 turtle2 carrot1", "map odom base_link laser_link laser_point", "A B"],
)
def test_usual_names_beside_each_other_have_different_colours(names):
    colors = [theme.of_name(name) for name in names.split()]
    assert len(set(colors)) == len(colors)


@pytest.mark.parametrize("name", ["", "7", "\ud800", "turtle²", "x" * 500, "a" + "9" * 400])
def test_any_name_has_a_colour(name):
    assert theme.of_name(name) in theme._PALETTE


def test_a_colour_is_written_in_hexadecimal():
    assert theme.hexadecimal(BACKGROUND) == "#4556ff"


@pytest.mark.parametrize(
    ("environment", "light"),
    [({}, False), ({"COLORFGBG": "0;15"}, True), ({"COLORFGBG": "15;default;0"}, False)],
)
def test_a_terminal_may_say_that_its_ground_is_light(environment, light):
    assert theme.prefers_light(environment) is light
