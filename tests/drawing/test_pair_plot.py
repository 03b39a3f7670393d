import math
import re

import numpy as np
import pytest
from rich.cells import cell_len

from tftool.base.stamps import seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.drawing.line_plot import PlotSpan, pair_plot
from tftool.geometry.rigid import Transform

START = seconds(1000)


@pytest.fixture(scope="module")
def path() -> TransformArray:
    """Return ten seconds of a motion from one metre to ten, with a turn and a half to the left."""
    buffer = Buffer(cache_time=seconds(60))
    for tenth in range(101):
        yaw = 3.0 * math.pi * tenth / 100
        turn = (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
        pose = Transform((0.0, 0.1 * tenth, 0.0), turn)
        buffer.set_transform(TransformStamped(START + seconds(0.1) * tenth, "a", "b", pose))
    stamps = START + np.arange(0, 101, dtype=np.int64) * seconds(0.1)
    return buffer.lookup_transforms("a", "b", stamps)


def plotted(path, width=48, height=13, cursor=None, **how):
    span = PlotSpan(START, START + seconds(10), START, cursor)
    return [line.plain for line in pair_plot(path, span, width, height, **how)]


def test_distance_and_yaw_stand_one_under_the_other_with_their_last_values(path):
    lines = plotted(path)

    assert len(lines) == 13
    assert lines[0] == "distance 10.000 m"
    assert lines[6].startswith("yaw ")
    assert abs(float(lines[6].removeprefix("yaw ").removesuffix("°"))) == pytest.approx(180.0)
    assert lines[1].startswith("     10│")
    assert lines[5].startswith("      0│")
    assert lines[-1].split() == ["0.0", "10.0", "s"]


def test_a_distance_that_grows_goes_up_from_left_to_right(path):
    lines = plotted(path)[1:6]

    firsts = [
        min(column for column, sign in enumerate(line) if "\u2801" <= sign <= "\u28ff")
        for line in lines
    ]
    assert firsts == sorted(firsts, reverse=True)


def test_the_moment_shown_is_marked_and_its_values_are_told(path):
    lines = plotted(path, cursor=START + seconds(5))

    assert lines[0] == "distance 5.000 m"
    assert {line.index("┃") for line in lines if "┃" in line} == {8 + 20}
    assert sum("┃" in line for line in lines) == 10


def test_with_two_lines_a_curve_has_its_name_at_its_left(path):
    lines = plotted(path, height=2)

    assert lines[0].startswith("   dist│")
    assert lines[1].startswith("    yaw│")


@pytest.mark.parametrize("height", [3, 4, 5, 6])
def test_a_low_plot_is_the_distance_alone_and_has_the_yaw_as_a_number(path, height):
    lines = plotted(path, height=height)

    time = "" if height in (4, 6) else " +0–10 s"
    assert re.fullmatch(rf"distance 10\.000 m  yaw -?180\.0°{time}", lines[0])
    curve = lines[1:] if time else lines[1:-1]
    assert [line[:8].strip() for line in curve][:: len(curve) - 1] == ["10│", "0│"]
    assert len(lines) == height


def test_seven_lines_have_both_curves_with_their_scales_and_the_time(path):
    lines = plotted(path, height=7)

    assert [line[:8].strip() for line in lines[1:3]] == ["10│", "0│"]
    assert [line[:8].strip() for line in lines[4:6]] == ["180│", "-180│"]
    assert lines[6].split() == ["0.0", "10.0", "s"]


def test_the_values_of_a_pair_without_news_have_a_note(path):
    lines = plotted(path, note="9 s old")

    assert lines[0] == "distance 10.000 m  9 s old"
    assert lines[6].endswith("°  9 s old")


@pytest.mark.parametrize(("width", "height"), [(0, 0), (5, 5), (16, 1), (16, 3), (30, 9), (99, 40)])
def test_it_fits_into_any_room(path, width, height):
    lines = plotted(path, width, height, ascii_only=True)

    assert len(lines) <= height
    assert all(cell_len(line) <= width for line in lines)
    assert "".join(lines).isascii()


def test_where_there_is_no_pose_there_is_no_curve():
    stamps = START + np.arange(0, 101, dtype=np.int64) * seconds(0.1)
    buffer = Buffer()
    buffer.set_transform(TransformStamped(START + seconds(50), "a", "b", Transform()))

    lines = plotted(buffer.lookup_transforms("a", "b", stamps, missing="nan"))

    assert not any("\u2801" <= sign <= "\u28ff" for line in lines for sign in line)
    assert lines[0] == "distance "
