import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.style import Style

from tftool.base.color import Color
from tftool.drawing import sprites, theme
from tftool.drawing.canvas import Canvas
from tftool.drawing.cells import NONE, CellSheet, Dots, merged, packed, runs
from tftool.drawing.line_plot import draw_curve
from tftool.drawing.plane import (
    ColoredLines,
    Drawn,
    PlaneFrame,
    PlanePicture,
    TurtleField,
    Viewport,
    fitted_view,
    grid_step,
)
from tftool.geometry.motion import CENTRE, FIELD

PEN = Color(179, 184, 255)


def words(lines):
    return ["".join(segment.text for segment in line) for line in lines]


def view(rows, size=FIELD, left=0.0, bottom=0.0):
    return Viewport(left, bottom, size / rows)


def draw(picture, rows=16, size=FIELD, **how):
    return Canvas(2 * rows, rows, scaled=False, **how).lines(picture, view(rows, size))


def turtle(name, x, y, theta=0.0, **how):
    """Return a turtle without a frame: only its sprite and its name are drawn."""
    ahead = ((math.cos(theta), math.sin(theta)),)
    return PlaneFrame(name, x, y, ahead, is_turtle=True, is_frame=False, **how)


def sheet(*turtles, strokes=(), **how):
    """Return the turtles' field with a drawing on it."""
    pen = Drawn(strokes, how.pop("forgotten", 0), how.pop("edition", 0))
    field = TurtleField(**how)
    return PlanePicture("world", turtles, field=field, pen=pen)


def stroke(x0, y0, x1, y1, color=PEN, width=3):
    return (x0, y0, x1, y1, color, width)


def dotted(lines, color=PEN):
    """Return the (column, row) of every cell that contains a part of a trail of that colour."""
    named = theme.hexadecimal(color)
    found = set()
    for row, line in enumerate(lines):
        column = 0
        for segment in line:
            ink = segment.style.color if segment.style else None
            for sign in segment.text:
                if "\u2801" <= sign <= "\u28ff" and ink is not None and ink.name == named:
                    found.add((column, row))
                column += cell_len(sign)
    return found


def style_at(lines, column, row):
    for segment in lines[row]:
        if column < segment.cell_length:
            return segment.style
        column -= segment.cell_length
    raise AssertionError("beyond the line")


@example(7, 2, [("\U000101fd0", 5.0, 0.0, 0.0), ("\u0301", 0.0, 0.0, 0.0)], [], False, True)
@given(
    st.integers(0, 50),
    st.integers(0, 20),
    st.lists(
        st.tuples(st.text(max_size=12), *[st.floats(-3.0, 15.0)] * 2, st.floats()), max_size=4
    ),
    st.lists(st.tuples(*[st.floats()] * 4), max_size=4),
    st.booleans(),
    st.booleans(),
)
def test_every_line_of_any_picture_has_exactly_the_requested_width(
    columns, rows, frames, trail, ascii_only, are_turtles
):
    frames = tuple(
        PlaneFrame(
            name,
            x,
            y,
            ((math.cos(theta), math.sin(theta)), (-math.sin(theta), math.cos(theta)))
            if math.isfinite(theta)
            else ((1.0, 0.0), (0.0, 1.0)),
            parent=(1.0, 2.0),
            is_turtle=are_turtles,
        )
        for name, x, y, theta in frames
    )
    drawn = Drawn(tuple(stroke(*ends) for ends in trail))
    field = TurtleField(walls=frozenset({"left", "top"}))
    ends = np.array([(x0, y0, 0.0, x1, y1, 0.0) for x0, y0, x1, y1 in trail], float)
    # Frames farther away have no trail.
    ends = np.clip(np.nan_to_num(ends), -1e9, 1e9).reshape(-1, 2, 3)
    trails = ColoredLines(ends, np.zeros(len(trail), int))
    picture = PlanePicture("f", frames, field=field, pen=drawn, trails=trails)

    drawing = Canvas(columns, rows, ascii_only=ascii_only)
    lines = drawing.lines(picture, fitted_view(picture.bounds(), drawing.columns, drawing.rows))

    wide = columns if rows else 0
    assert [sum(cell_len(segment.text) for segment in line) for line in lines] == [wide] * rows
    if ascii_only:
        assert all(text.isascii() for text in words(lines))


def test_an_empty_field_is_turtlesims_blue():
    lines = draw(sheet())

    assert {segment.style.bgcolor.name for line in lines for segment in line} == {"#4556ff"}


@pytest.mark.parametrize(
    ("theta", "arrow"),
    [(0, "→"), (45, "↗"), (90, "↑"), (135, "↖"), (180, "←"), (-135, "↙"), (-90, "↓"), (-45, "↘")],
)
def test_a_small_turtle_is_an_arrow_that_points_where_it_heads(theta, arrow):
    text = words(draw(sheet(turtle("turtle1", CENTRE, CENTRE, math.radians(theta)))))

    assert text[8][16] == arrow


@pytest.mark.parametrize(("theta", "letter"), [*zip(range(0, 360, 45), ">7^F<LvJ", strict=True)])
def test_without_unicode_the_arrow_is_a_letter(theta, letter):
    text = words(
        draw(sheet(turtle("turtle1", CENTRE, CENTRE, math.radians(theta))), ascii_only=True)
    )

    assert text[8][16] == letter


@pytest.mark.parametrize("theta", [0.0, 0.7, 1.6, 2.4, 3.1, -2.2, -1.5, -0.8])
def test_a_big_turtle_is_drawn_with_its_head_where_it_heads(theta):
    rows = 60
    lines = draw(sheet(turtle("t1", CENTRE, CENTRE, theta)), rows)
    head = theme.hexadecimal(theme.of_name("t1"))

    cells = [
        (column + 0.5 - rows, rows / 2 - row - 0.5)
        for row in range(rows)
        for column in range(2 * rows)
        if (style := style_at(lines, column, row)).color
        and style.color.name == head
        and words([lines[row]])[0][column] in sprites._QUADRANTS.strip()
    ]
    x = sum(column / 2 for column, _ in cells) / len(cells)
    y = sum(row for _, row in cells) / len(cells)

    assert math.cos(math.atan2(y, x) - theta) > math.cos(0.25)


def test_up_is_up_and_right_is_right():
    picture = sheet(turtle("a", 1.0, 10.0), turtle("b", 10.0, 1.0))

    text = words(draw(picture, ascii_only=True))

    assert text[1].index(">") == 2
    assert text[14].rindex(">") == 28


def test_the_edges_of_the_field_are_inside():
    corners = [(0.0, 0.0), (FIELD, 0.0), (0.0, FIELD), (FIELD, FIELD)]
    picture = sheet(*(turtle(f"t{n}", x, y) for n, (x, y) in enumerate(corners)))

    text = words(draw(picture, rows=10, ascii_only=True))

    assert (text[0][0], text[0][-1], text[-1][0], text[-1][-1]) == (">", ">", ">", ">")


def test_a_turtle_that_is_nowhere_is_left_out():
    nowhere = turtle("a", math.nan, 1.0), turtle("b", 1e30, 1.0)

    assert words(draw(sheet(*nowhere))) == words(draw(sheet()))


def test_a_trail_is_continuous_however_the_pen_moved():
    corners = [(1.0, 1.0), (10.0, 9.0), (10.0, 2.0), (2.0, 8.0)]
    strokes = tuple(stroke(*a, *b) for a, b in pairwise(corners))

    cells = dotted(draw(sheet(strokes=strokes)))

    start = min(cells)
    reached, waiting = {start}, [start]
    while waiting:
        column, row = waiting.pop()
        for near in cells - reached:
            if abs(near[0] - column) <= 1 and abs(near[1] - row) <= 1:
                reached.add(near)
                waiting.append(near)
    assert reached == cells
    assert len(cells) > 30


def test_a_trail_has_the_colour_of_its_pen():
    red = stroke(1.0, 1.0, 10.0, 1.0, Color(255, 0, 0))
    green = stroke(1.0, 9.0, 10.0, 9.0, Color(0, 255, 0))

    lines = draw(sheet(strokes=(red, green)))

    assert {row for _, row in dotted(lines, Color(255, 0, 0))} == {14}
    assert {row for _, row in dotted(lines, Color(0, 255, 0))} == {3}


def test_a_wide_pen_draws_a_wide_trail():
    thin = dotted(draw(sheet(strokes=(stroke(1, 5, 10, 5, width=3),)), rows=50))
    wide = dotted(draw(sheet(strokes=(stroke(1, 5, 10, 5, width=40),)), rows=50))

    assert len({row for _, row in wide}) >= 4
    assert len({row for _, row in thin}) <= 2


def test_strokes_are_cut_off_at_the_edges_of_the_field():
    through = stroke(-1e12, CENTRE, 1e12, CENTRE)
    beside = stroke(-5.0, 20.0, -1.0, 30.0)

    cells = dotted(draw(sheet(strokes=(through, beside, stroke(0.0, -2.0, 11.0, -2.0)))))

    assert cells == {(column, 8) for column in range(32)}


def test_a_trail_that_grew_looks_as_if_drawn_at_once():
    strokes = tuple(stroke(n / 10, 2 + n / 20, (n + 1) / 10, 2 + (n + 1) / 20) for n in range(100))
    grown = Canvas(32, 16, scaled=False)

    for length in (0, 10, 11, 60, 100):
        grown.lines(sheet(strokes=strokes[:length]), view(16))

    assert grown.lines(sheet(strokes=strokes), view(16)) == draw(sheet(strokes=strokes))


def test_a_trail_whose_beginning_was_forgotten_stays_drawn():
    strokes = tuple(stroke(n, 5.0, n + 1, 5.0) for n in range(10))
    kept = Canvas(32, 16, scaled=False)
    kept.lines(sheet(strokes=strokes[:6]), view(16))

    lines = kept.lines(sheet(strokes=strokes[4:], forgotten=4), view(16))

    assert dotted(lines) == dotted(draw(sheet(strokes=strokes)))


def test_a_wiped_trail_is_gone_and_an_earlier_one_comes_back():
    first, second = stroke(1, 1, 9, 1), stroke(1, 9, 9, 9)
    board = Canvas(32, 16, scaled=False)
    board.lines(sheet(strokes=(first,)), view(16))

    after = dotted(board.lines(sheet(strokes=(second,), edition=1), view(16)))
    back = dotted(board.lines(sheet(strokes=(first,), edition=0), view(16)))

    assert after == dotted(draw(sheet(strokes=(second,))))
    assert back == dotted(draw(sheet(strokes=(first,))))


def test_going_back_in_time_shortens_the_trail():
    strokes = (stroke(1, 1, 9, 1), stroke(9, 1, 9, 9))
    board = Canvas(32, 16, scaled=False)
    board.lines(sheet(strokes=strokes), view(16))

    assert dotted(board.lines(sheet(strokes=strokes[:1]), view(16))) == dotted(
        draw(sheet(strokes=strokes[:1]))
    )


def test_another_background_is_painted_everywhere():
    board = Canvas(8, 4, scaled=False)
    board.lines(sheet(), view(4))

    lines = board.lines(sheet(color=Color(1, 2, 3)), view(4))

    assert {segment.style.bgcolor.name for line in lines for segment in line} == {"#010203"}


def test_the_field_lies_in_the_picture_as_its_frame_does():
    """Check a field ten metres to the right and turned by a quarter: its colour is only there."""
    lines = Canvas(80, 20, scaled=False).lines(
        sheet(x=10.0 + FIELD, theta=math.pi / 2, strokes=(stroke(1.0, 2.0, 9.0, 2.0),)),
        Viewport(0.0, 0.0, FIELD / 20 * 2),
    )

    blue = {
        (column, row)
        for row in range(20)
        for column in range(80)
        if (ground := style_at(lines, column, row).bgcolor) and ground.name == "#4556ff"
    }
    # A column is 0.554 m: 18 of 80 columns are 10 m, and the field has 20 more.
    assert blue == {(column, row) for row in range(10, 20) for column in range(18, 38)}
    # The drawing is parallel to the field's x axis at two metres. On the screen it is a vertical
    # line, two metres from the right.
    assert {column for column, _ in dotted(lines)} == {math.floor((8.0 + FIELD) / FIELD * 20)}


def test_names_stand_beside_turtles_and_do_not_hide_each_other():
    pair = turtle("turtle1", 5.0, 5.0), turtle("turtle2", 5.3, 5.0)

    text = "\n".join(words(draw(sheet(*pair))))

    assert text.count("turtle1") == text.count("turtle2") == 1


@pytest.mark.parametrize(("right", "up"), [(2.0, -1.0), (2.0, 1.0), (-2.0, 1.0), (-1.0, 1.5)])
def test_a_name_is_nearer_to_its_own_turtle_than_to_another(right, up):
    rows = 34
    places = {"turtle1": (4.0, 5.0), "turtle2": (4.0 + right, 5.0 + up)}
    drawn = words(draw(sheet(*(turtle(name, *at) for name, at in places.items())), rows=rows))

    def apart(row, column, end, name):
        x, y = (place * rows / FIELD for place in places[name])
        return math.hypot(x - min(max(2.0 * x, column), end) / 2.0, rows - y - row - 0.5)

    for name, other in (("turtle1", "turtle2"), ("turtle2", "turtle1")):
        text = f"{name} (no frame)"
        (row,) = [row for row, line in enumerate(drawn) if text in line]
        column = drawn[row].index(text)
        span = row, column, column + len(text)
        assert apart(*span, name) < apart(*span, other)


def test_a_crowd_of_names_is_nudged_apart_and_none_is_dropped():
    crowd = [frame(f"frame{n:02}", 5.0 + 0.01 * n, 5.0) for n in range(20)]

    text = "\n".join(words(Canvas(80, 30).lines(PlanePicture("m", tuple(crowd)), view(29))))

    assert [text.count(one.name) for one in crowd] == [1] * 20


@pytest.mark.parametrize("how", [{}, {"mono": True}, {"ascii_only": True}])
def test_of_two_turtles_at_one_place_the_first_is_whole_and_the_other_beside_it(how):
    pair = turtle("turtle1", CENTRE, CENTRE, 0.0), turtle("turtle2", CENTRE, CENTRE, math.pi / 2)

    lines = draw(sheet(*pair), **how)
    text = words(lines)[8]

    east, north = (">", "^") if "ascii_only" in how else ("→", "↑")
    assert text[16] == east
    beside = text.index(north)
    assert abs(beside - 16) <= 2
    assert style_at(lines, beside, 8).color.name == theme.hexadecimal(theme.of_name("turtle2"))


def test_of_two_bodies_at_one_place_the_first_is_on_top():
    def shells(*turtles):
        lines = draw(sheet(*turtles), 60)
        return [style_at(lines, column, 30) for column in range(56, 64)]

    first, second = turtle("turtle1", CENTRE, CENTRE), turtle("turtle2", CENTRE, CENTRE, 1.5)

    assert shells(first, second) == shells(first)


def test_a_name_at_the_right_edge_stands_to_the_left():
    text = words(draw(sheet(turtle("turtle1", 10.8, 5.0)), ascii_only=True))

    line = next(one for one in text if "turtle1" in one)
    assert line.index("turtle1") + 7 < 30


@pytest.mark.parametrize(
    "name",
    [
        "[bold]x[/]",
        "\x1b[31mred\x1b[0m",
        "a\nb\tc",
        "x" * 500,
        "שלום",
        "🐢🐢",
        "👩‍🚀",
        "\u202eevil",
    ],
)
def test_no_name_acts_or_breaks_a_line(name):
    lines = draw(sheet(turtle(name, CENTRE, CENTRE), frame(name, 1.0, 1.0)))

    text = "".join(words(lines))
    assert all(sign.isprintable() for sign in text)
    assert [sum(segment.cell_length for segment in line) for line in lines] == [32] * 16


def test_a_long_name_is_cut_with_an_ellipsis():
    text = "".join(words(draw(PlanePicture("m", (frame("long" * 99, CENTRE, CENTRE),)))))

    assert "longlongl…" in text


@pytest.mark.parametrize(
    ("side", "cells"),
    [
        ("left", {(0, row) for row in range(4)}),
        ("right", {(7, row) for row in range(4)}),
        ("top", {(column, 0) for column in range(8)}),
        ("bottom", {(column, 3) for column in range(8)}),
    ],
)
def test_a_wall_that_was_hit_lights_up(side, cells):
    lines = draw(sheet(walls=frozenset({side})), 4)

    assert dotted(lines, theme.WALL) == cells


def frame(name, x, y, theta=0.0, **how):
    cosine, sine = math.cos(theta), math.sin(theta)
    return PlaneFrame(name, x, y, ((cosine, sine), (-sine, cosine)), **how)


def test_a_frame_is_a_named_point_with_red_axis_ahead_and_green_one_to_its_left():
    colors = theme.paper(theme.DARK)

    lines = draw(PlanePicture("m", (frame("carrot1", CENTRE, CENTRE, math.pi / 2),)))

    assert words(lines)[8][16] == "●"
    assert "carrot1" in "".join(words(lines))
    # The turtle is turned to the left by a quarter, so its x axis points up and its y axis to the
    # left.
    red, green = dotted(lines, colors.x_axis), dotted(lines, colors.y_axis)
    assert red
    assert all(column == 16 and row < 8 for column, row in red)
    assert green
    assert all(column < 16 and row in (7, 8) for column, row in green)


def test_an_axis_that_points_at_the_eye_is_not_drawn_and_the_third_is_blue():
    colors = theme.paper(theme.DARK)
    down = PlaneFrame("lens", CENTRE, CENTRE, ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0)))

    lines = draw(PlanePicture("m", (down,)))

    assert not dotted(lines, colors.x_axis)
    assert dotted(lines, colors.y_axis)
    assert all(column > 16 for column, _ in dotted(lines, colors.z_axis))
    assert dotted(lines, colors.z_axis)


def test_a_line_leads_from_every_frame_to_its_parent():
    child = frame("b", 9.0, 2.0, parent=(2.0, 2.0))

    cells = dotted(
        draw(PlanePicture("m", (frame("a", 2.0, 2.0), child))), theme.paper(theme.DARK).link
    )

    assert {row for _, row in cells} == {13}
    assert min(column for column, _ in cells) < 12
    assert max(column for column, _ in cells) > 22


def test_a_trail_has_the_colour_of_its_frame_and_lies_where_it_was():
    color = theme.of_name("drone")
    ends = np.array([[[1.0, 5.2, 0.0], [10.0, 5.2, 0.0]]])
    ink = (color.r << 16) + (color.g << 8) + color.b
    picture = PlanePicture("m", trails=ColoredLines(ends, np.array([ink])))

    lines = draw(picture)

    assert dotted(lines, theme.blend(color, theme.DARK.panel, 0.3)) == {
        (column, 8) for column in range(2, 29)
    }


def test_a_frame_without_news_turns_amber_then_red_and_says_since_when():
    def shown(age):
        lines = draw(PlanePicture("m", (frame("carrot1", 3.0, 3.0, age=age),)), 30)
        row = next(row for row, text in enumerate(words(lines)) if "carrot1" in text)
        text = words(lines)[row]
        return style_at(lines, text.index("carrot1"), row).color.name, text

    assert shown(0.0)[0] == theme.hexadecimal(theme.of_name("carrot1"))
    assert "ago" not in shown(4.9)[1]
    assert shown(10.0)[0] == theme.hexadecimal(theme.DARK.warning)
    assert "carrot1 10 s ago" in shown(10.0)[1]
    assert shown(19.9)[0] == theme.hexadecimal(theme.DARK.error)
    assert "carrot1 19 s ago" in shown(19.9)[1]


def test_the_grid_says_its_metres():
    drawing = Canvas(45, 21, ascii_only=True)

    text = words(drawing.lines(PlanePicture("m"), Viewport(-2.0, -2.0, 0.5)))

    assert text[-1].split() == ["m", "-2", "0", "2", "4", "6", "8"]
    assert [line[:4].strip() for line in text[:-1] if line[:4].strip()] == [
        "8", "6", "4", "2", "0", "-2"
    ]  # fmt: skip
    # If 0 is a label on both sides, the two lines cross.
    assert text[16][:5].split() == ["0"] or text[15][:5].split() == ["0"]


@pytest.mark.parametrize(
    ("per_row", "step"), [(0.29, 1.0), (0.3, 2.0), (1.0, 5.0), (2.0, 10.0), (0.01, 0.05)]
)
def test_grid_lines_lie_a_few_rows_apart_at_round_numbers(per_row, step):
    assert grid_step(per_row) == pytest.approx(step)


def test_all_of_a_picture_is_seen_in_a_view_of_any_shape():
    picture = PlanePicture("m", (frame("a", -3.0, 1.0), frame("b", 40.0, 1.5)))

    for columns, rows in ((80, 24), (20, 60), (7, 2)):
        left, bottom, per_row = fitted_view(picture.bounds(), columns, rows)
        for one in picture.frames:
            assert left < one.x < left + 0.5 * per_row * columns
            assert bottom < one.y < bottom + per_row * rows


@pytest.mark.parametrize("rows", [1, 2, 3, 5])
def test_a_tiny_field_still_shows_its_turtle(rows):
    shown = draw(sheet(turtle("turtle1", CENTRE, CENTRE, math.pi / 2)), rows)

    assert "↑" in "".join(words(shown))


def test_without_colour_a_big_turtle_is_an_arrow():
    lines = draw(sheet(turtle("turtle1", CENTRE, CENTRE, math.pi)), 60, mono=True)

    assert "▐←▌" in "".join(words(lines))


def letters(lines, row):
    """Return the colour of every letter of a row, and whether the letter is on the field."""
    found = []
    for segment in lines[row]:
        style = segment.style
        on_field = style is not None and style.bgcolor is not None
        found += [(style.color.name, on_field) for sign in segment.text if sign.isalpha()]
    return found


def test_a_name_across_the_edge_of_the_field_is_read_on_both_grounds():
    def named(x):
        frame = PlaneFrame("a_long_name", x, CENTRE, ())
        drawn = draw(sheet(frame), rows=40, size=2 * FIELD, palette=theme.LIGHT)
        return max((letters(drawn, row) for row in range(40)), key=len)

    (on_field,), (beside,) = set(named(1.0)), set(named(1.3 * FIELD))
    assert on_field[1]
    assert not beside[1]
    assert on_field[0] != beside[0]
    assert set(named(FIELD - 2.5)) == {on_field, beside}


def curve(height, color):
    dots = Dots(12, 3)
    draw_curve(dots, np.array([0.0, 1.0]), np.array([height, height]), color)
    return dots


def test_curves_that_share_cells_keep_all_dots_and_take_turns_where_they_are_level():
    red, blue, green = Color(255, 0, 0), Color(0, 0, 255), Color(0, 255, 0)
    high, low = curve(0.5, red), curve(0.4, blue)
    rising = Dots(12, 3)
    draw_curve(rising, np.array([0.0, 0.5, 1.0]), np.array([1.0, 0.5, 0.5]), green)

    found = merged([high, low])
    assert (found.masks == high.masks | low.masks).all()
    dashes = [packed(red)] * 3 + [packed(blue)] * 3
    assert [row for row in found.colors.tolist() if max(row) >= 0] == [dashes * 2]
    both = merged([high, rising])
    assert (both.masks == high.masks | rising.masks).all()
    assert (both.colors[:, :6][rising.masks[:, :6] > 0] == packed(green)).all()
    assert set(both.colors[1, 7:].tolist()) == {packed(red), packed(green)}
    assert (merged([high]).masks == high.masks).all()


@pytest.mark.parametrize(
    ("start", "end", "sign"),
    [
        ((0, 0), (0, 31), "|"),
        ((0, 1), (15, 1), "-"),
        ((0, 0), (16, 32), "\\"),
        ((0, 32), (16, 0), "/"),
    ],
)
def test_a_line_in_ascii_is_a_row_of_strokes_in_its_direction(start, end, sign):
    dots = Dots(8, 8)
    dots.draw(np.array([[start, end]], float), 0)
    drawn = [sign for row in dots.rows(ascii_only=True) for sign, _ in row if sign != " "]

    assert drawn.count(sign) >= 7
    # Where the line only touches a cell, the cell has a single dot.
    assert set(drawn) <= {sign, "'", "."}


@given(
    st.lists(
        st.tuples(st.sampled_from(" ab"), st.sampled_from([0x112233, 0xFFFFFF]), st.booleans()),
        min_size=1,
        max_size=12,
    )
)
def test_joined_cells_keep_the_look_of_each_cell(cells):
    sheet = CellSheet(len(cells), 1)
    for column, (sign, ink, has_ground) in enumerate(cells):
        sheet.texts[0, column], sheet.inks[0, column] = sign, ink
        sheet.grounds[0, column] = 0x445566 if has_ground else NONE
    (line,) = sheet.lines()
    drawn = [(sign, one.style) for one in line for sign in one.text]
    assert [sign for sign, _ in drawn] == [sign for sign, _, _ in cells]
    for (sign, style), (_, ink, has_ground) in zip(drawn, cells, strict=True):
        assert style.bgcolor == (Style(bgcolor="#445566").bgcolor if has_ground else None)
        assert sign == " " or style.color == Style(color=f"#{ink:06x}").color


def test_blanks_between_cells_of_one_colour_begin_no_segment():
    sheet = CellSheet(7, 1)
    sheet.write(1, 0, "a", packed(PEN))
    sheet.write(5, 0, "b", packed(PEN))
    (line,) = sheet.lines()
    assert [one.text for one in line] == [" ", "a   b "]
    assert runs([(" ", ""), ("a", "red"), (" ", ""), ("b", "red"), ("c", "blue")]) == [
        (" a b", "red"),
        ("c", "blue"),
    ]
