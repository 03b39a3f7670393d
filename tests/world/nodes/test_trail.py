import math

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from tftool.base.color import Color
from tftool.geometry.motion import CENTRE, FIELD, PIXELS_PER_METRE
from tftool.world.nodes import trail as trail_module
from tftool.world.nodes.trail import BLANK, Segment, Trail

RED = Color(255, 0, 0)
BLUE = Color(0, 0, 255)
anywhere = st.floats(0.0, FIELD)
far = st.floats(-1e38, 1e38)


def metres(pixels):
    return pixels / PIXELS_PER_METRE


def painted(trail, columns, rows, color=RED):
    """Return the pixels of a window that have the colour, counted from the bottom left."""
    return {
        (column, row)
        for column in columns
        for row in rows
        if trail.color_at(metres(column), FIELD - metres(row)) == color
    }


def stroke(x0, y0, x1, y1, width=3, color=RED):
    """Return a line with its ends in pixels, counted downward from the top left."""
    return Segment(metres(x0), FIELD - metres(y0), metres(x1), FIELD - metres(y1), color, width)


def test_a_fresh_layer_is_blank_everywhere():
    assert Trail().color_at(CENTRE, CENTRE) == BLANK


def test_a_level_stroke_covers_a_rectangle_with_square_ends():
    trail = Trail()
    trail.draw(stroke(100, 100, 110, 100))

    expected = {(column, row) for column in range(99, 112) for row in (99, 100, 101)}
    assert painted(trail, range(90, 120), range(90, 110)) == expected


def test_a_thin_upright_stroke_is_one_pixel_wide():
    trail = Trail()
    trail.draw(stroke(100, 100, 100, 105, width=1))

    assert painted(trail, range(95, 105), range(95, 110)) == {(100, r) for r in range(100, 106)}


@given(anywhere, anywhere, anywhere, anywhere, st.sampled_from([1, 2, 3, 7]))
def test_a_stroke_is_seen_at_both_ends_however_thin(x0, y0, x1, y1, width):
    trail = Trail()
    trail.draw(Segment(x0, y0, x1, y1, RED, width))

    assert trail.color_at(x0, y0) == RED
    assert trail.color_at(x1, y1) == RED


@settings(max_examples=50)
@given(
    st.tuples(*[st.floats(20, 60)] * 4),
    st.integers(1, 9),
)
def test_exactly_the_pixels_on_the_stroke_are_painted(ends, width):
    x0, y0, x1, y1 = ends
    length = math.dist((x0, y0), (x1, y1))
    # Rounding decides the direction of a line of some billionths of a pixel.
    assume(length == 0.0 or length > 1e-6)
    along = ((x1 - x0) / length, (y1 - y0) / length) if length else (1.0, 0.0)
    trail = Trail()
    trail.draw(stroke(x0, y0, x1, y1, width))
    found = painted(trail, range(5, 76), range(5, 76))

    for column in range(5, 76):
        for row in range(5, 76):
            forward = (column - x0) * along[0] + (row - y0) * along[1]
            aside = -(column - x0) * along[1] + (row - y0) * along[0]
            inside = min(forward + width / 2, length + width / 2 - forward, width / 2 - abs(aside))
            nearest = min(
                max(abs(column - x0), abs(row - y0)), max(abs(column - x1), abs(row - y1))
            )
            if inside > 1e-6:
                assert (column, row) in found
            elif inside < -1e-6 and nearest > 0.5 + 1e-6:
                assert (column, row) not in found


@example(0.0, -4.9279690377879096e16, 0.0, 0.0, 231)
@given(far, far, far, far, st.integers(1, 255))
def test_strokes_that_leave_the_field_are_cut_off_quietly(x0, y0, x1, y1, width):
    trail = Trail()
    trail.draw(Segment(x0, y0, x1, y1, RED, width))

    assert trail.color_at(CENTRE, CENTRE) in (RED, BLANK)
    assert trail.color_at(x0, y0) in (RED, BLANK)


def test_the_later_stroke_lies_on_top():
    trail = Trail()
    trail.draw(stroke(100, 100, 120, 100))
    trail.draw(stroke(110, 90, 110, 110, color=BLUE))

    assert trail.color_at(metres(110), FIELD - metres(100)) == BLUE
    assert trail.color_at(metres(105), FIELD - metres(100)) == RED


def test_looking_between_strokes_changes_nothing():
    once, often = Trail(), Trail()
    for x in range(100, 140, 3):
        for trail in (once, often):
            trail.draw(stroke(x, 100, x + 3, 103))
        often.color_at(CENTRE, CENTRE)

    window = range(95, 150), range(95, 115)
    assert painted(once, *window) == painted(often, *window)


def test_wiping_leaves_a_blank_layer_and_is_counted():
    trail = Trail()
    trail.draw(stroke(100, 100, 120, 100))
    trail.wipe()

    assert trail.color_at(metres(110), FIELD - metres(100)) == BLANK
    assert (trail.drawn, trail.wipes, len(trail.segments)) == (0, 1, 0)


def test_old_segments_are_forgotten_but_their_colour_is_not(monkeypatch):
    monkeypatch.setattr(trail_module, "KEPT_SEGMENTS", 10)
    trail = Trail()
    for x in range(100, 200):
        trail.draw(stroke(x, 100, x + 1, 100))

    assert trail.drawn == 100
    assert trail.color_at(metres(100), FIELD - metres(100)) == RED


@pytest.mark.parametrize("point", [(-1.0, 1.0), (1.0, -1.0), (12.0, 1.0), (1.0, 12.0)])
def test_beyond_the_window_everything_is_blank(point):
    trail = Trail()
    trail.draw(stroke(0, 0, 499, 499, width=255))

    assert trail.color_at(*point) == BLANK


def test_an_end_between_two_pixels_is_painted_where_the_sensor_looks():
    trail = Trail()
    trail.draw(Segment(0.0, 0.0, 1.3, 3.375, RED, 1))

    assert trail.color_at(1.3, 3.375) == RED
