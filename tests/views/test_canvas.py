import io
import math
from itertools import pairwise

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.console import Console

from tftool.messages import Color
from tftool.views import canvas, sprites, theme
from tftool.views.canvas import (
    EDGE,
    Canvas,
    DrawnTurtle,
    FieldPicture,
    FieldView,
    Mark,
    fit,
    framed,
)

PEN = theme.PEN
CENTRE = EDGE / 2


def words(lines):
    return ["".join(segment.text for segment in line) for line in lines]


def draw(picture, rows=16, **how):
    return Canvas(2 * rows, rows, **how).lines(picture)


def stroke(x0, y0, x1, y1, color=PEN, width=3):
    return (x0, y0, x1, y1, color, width)


def dotted(lines):
    """The (column, row) of every cell with a piece of trail in it."""
    return {
        (column, row)
        for row, text in enumerate(words(lines))
        for column, sign in enumerate(text)
        if "\u2801" <= sign <= "\u28ff"
    }


def style_at(lines, column, row):
    for segment in lines[row]:
        if column < segment.cell_length:
            return segment.style
        column -= segment.cell_length
    raise AssertionError("beyond the line")


@pytest.mark.parametrize(
    ("width", "height"), [(80, 20), (40, 60), (41, 60), (3, 9), (1, 1), (0, 0)]
)
def test_the_field_is_square_on_cells_twice_as_high_as_wide(width, height):
    columns, rows = fit(width, height)

    assert columns == 2 * rows
    assert columns <= width
    assert rows <= height
    assert columns + 2 > width or rows + 1 > height


@example(7, 2, [("\U000101fd0", 5.0, 0.0, 0.0), ("\u0301", 0.0, 0.0, 0.0)], [], False)
@given(
    st.integers(0, 40),
    st.integers(0, 20),
    st.lists(
        st.tuples(st.text(max_size=12), *[st.floats(-3.0, 15.0)] * 2, st.floats()), max_size=4
    ),
    st.lists(st.tuples(*[st.floats()] * 4), max_size=4),
    st.booleans(),
)
def test_whatever_there_is_every_line_is_exactly_as_wide_as_asked(
    columns, rows, turtles, trail, ascii_only
):
    picture = FieldPicture(
        turtles=tuple(
            DrawnTurtle(name, x, y, theta if math.isfinite(theta) else 0.0)
            for name, x, y, theta in turtles
        ),
        strokes=tuple(stroke(*ends) for ends in trail),
        walls=frozenset({"left", "top"}),
    )

    lines = Canvas(columns, rows, ascii_only=ascii_only).lines(picture)

    assert [sum(cell_len(segment.text) for segment in line) for line in lines] == [columns] * rows
    if ascii_only:
        assert all(text.isascii() for text in words(lines))


def test_an_empty_field_is_turtlesims_blue():
    lines = draw(FieldPicture())

    assert set("".join(words(lines))) == {" "}
    assert style_at(lines, 5, 5).bgcolor.name == "#4556ff"


@pytest.mark.parametrize(
    ("theta", "arrow"),
    [(0, "→"), (45, "↗"), (90, "↑"), (135, "↖"), (180, "←"), (-135, "↙"), (-90, "↓"), (-45, "↘")],
)
def test_a_small_turtle_is_an_arrow_that_points_where_it_heads(theta, arrow):
    text = words(
        draw(FieldPicture(turtles=(DrawnTurtle("turtle1", CENTRE, CENTRE, math.radians(theta)),)))
    )

    assert text[8][16] == arrow


@pytest.mark.parametrize(("theta", "letter"), [*zip(range(0, 360, 45), ">7^F<LvJ", strict=True)])
def test_without_unicode_the_arrow_is_a_letter(theta, letter):
    turtle = DrawnTurtle("turtle1", CENTRE, CENTRE, math.radians(theta))

    text = words(draw(FieldPicture(turtles=(turtle,)), ascii_only=True))

    assert text[8][16] == letter


@pytest.mark.parametrize("theta", [0.0, 0.7, 1.6, 2.4, 3.1, -2.2, -1.5, -0.8])
def test_a_big_turtle_is_drawn_with_its_head_where_it_heads(theta):
    rows = 60
    lines = Canvas(2 * rows, rows).lines(
        FieldPicture(turtles=(DrawnTurtle("t1", CENTRE, CENTRE, theta),))
    )
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
    picture = FieldPicture(
        turtles=(DrawnTurtle("a", 1.0, 10.0, 0.0), DrawnTurtle("b", 10.0, 1.0, 0.0))
    )

    text = words(draw(picture, ascii_only=True))

    assert text[1].index(">") == 2
    assert text[14].rindex(">") == 28


def test_the_edges_of_the_field_are_inside():
    corners = [(0.0, 0.0), (EDGE, 0.0), (0.0, EDGE), (EDGE, EDGE)]
    picture = FieldPicture(
        turtles=tuple(DrawnTurtle(f"t{n}", x, y, 0.0) for n, (x, y) in enumerate(corners))
    )

    text = words(draw(picture, rows=10, ascii_only=True))

    assert (text[0][0], text[0][-1], text[-1][0], text[-1][-1]) == (">", ">", ">", ">")


def test_a_turtle_that_is_nowhere_is_left_out():
    nowhere = (DrawnTurtle("a", math.nan, 1.0, 0.0), DrawnTurtle("b", 1e30, 1.0, 0.0))

    assert words(draw(FieldPicture(turtles=nowhere))) == words(draw(FieldPicture()))


def test_a_trail_is_continuous_however_the_pen_moved():
    corners = [(1.0, 1.0), (10.0, 9.0), (10.0, 2.0), (2.0, 8.0)]
    strokes = tuple(stroke(*a, *b) for a, b in pairwise(corners))

    cells = dotted(draw(FieldPicture(strokes=strokes)))

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

    lines = draw(FieldPicture(strokes=(red, green)))

    rows = {row: style_at(lines, column, row).color.name for column, row in dotted(lines)}
    assert rows == {14: "#ff0000", 3: "#00ff00"}


def test_a_wide_pen_draws_a_wide_trail():
    thin = dotted(draw(FieldPicture(strokes=(stroke(1, 5, 10, 5, width=3),)), rows=50))
    wide = dotted(draw(FieldPicture(strokes=(stroke(1, 5, 10, 5, width=40),)), rows=50))

    assert len({row for _, row in wide}) >= 4
    assert len({row for _, row in thin}) <= 2


def test_what_lies_outside_of_the_field_is_cut_off():
    through = stroke(-1e12, CENTRE, 1e12, CENTRE)
    beside = stroke(-5.0, 20.0, -1.0, 30.0)

    cells = dotted(draw(FieldPicture(strokes=(through, beside, stroke(0.0, -2.0, 11.0, -2.0)))))

    assert cells == {(column, 8) for column in range(32)}


def test_a_trail_that_grew_looks_as_if_drawn_at_once():
    strokes = tuple(stroke(n / 10, 2 + n / 20, (n + 1) / 10, 2 + (n + 1) / 20) for n in range(100))
    grown = Canvas(32, 16)

    for length in (0, 10, 11, 60, 100):
        grown.lines(FieldPicture(strokes=strokes[:length]))

    assert grown.lines(FieldPicture(strokes=strokes)) == draw(FieldPicture(strokes=strokes))


def test_a_trail_whose_beginning_was_forgotten_stays_drawn():
    strokes = tuple(stroke(n, 5.0, n + 1, 5.0) for n in range(10))
    kept = Canvas(32, 16)
    kept.lines(FieldPicture(strokes=strokes[:6]))

    lines = kept.lines(FieldPicture(strokes=strokes[4:], forgotten=4))

    assert dotted(lines) == dotted(draw(FieldPicture(strokes=strokes)))


def test_a_wiped_trail_is_gone_and_an_earlier_one_comes_back():
    first, second = stroke(1, 1, 9, 1), stroke(1, 9, 9, 9)
    board = Canvas(32, 16)
    board.lines(FieldPicture(strokes=(first,)))

    after = dotted(board.lines(FieldPicture(strokes=(second,), wipes=1)))
    back = dotted(board.lines(FieldPicture(strokes=(first,), wipes=0)))

    assert after == dotted(draw(FieldPicture(strokes=(second,))))
    assert back == dotted(draw(FieldPicture(strokes=(first,))))


def test_going_back_in_time_shortens_the_trail():
    strokes = (stroke(1, 1, 9, 1), stroke(9, 1, 9, 9))
    board = Canvas(32, 16)
    board.lines(FieldPicture(strokes=strokes))

    assert dotted(board.lines(FieldPicture(strokes=strokes[:1]))) == dotted(
        draw(FieldPicture(strokes=strokes[:1]))
    )


def test_another_background_is_painted_everywhere():
    board = Canvas(8, 4)
    board.lines(FieldPicture())

    lines = board.lines(FieldPicture(background=Color(1, 2, 3)))

    assert {segment.style.bgcolor.name for line in lines for segment in line} == {"#010203"}


def test_names_stand_beside_turtles_and_do_not_hide_each_other():
    pair = (DrawnTurtle("turtle1", 5.0, 5.0, 0.0), DrawnTurtle("turtle2", 5.3, 5.0, 0.0))

    text = "\n".join(words(draw(FieldPicture(turtles=pair))))

    assert text.count("turtle1") == text.count("turtle2") == 1


def test_a_name_at_the_right_edge_stands_to_the_left():
    text = words(
        draw(FieldPicture(turtles=(DrawnTurtle("turtle1", 10.8, 5.0, 0.0),)), ascii_only=True)
    )

    assert text[8].rstrip().endswith(">")
    assert "turtle1" in text[8]


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
    lines = draw(FieldPicture(turtles=(DrawnTurtle(name, CENTRE, CENTRE, 0.0),)))

    text = "".join(words(lines))
    assert all(sign.isprintable() for sign in text)
    assert [sum(segment.cell_length for segment in line) for line in lines] == [32] * 16


def test_a_long_name_is_cut_with_an_ellipsis():
    text = "".join(
        words(draw(FieldPicture(turtles=(DrawnTurtle("long" * 99, CENTRE, CENTRE, 0.0),))))
    )

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
    lines = Canvas(8, 4).lines(FieldPicture(walls=frozenset({side})))

    lit = {
        (column, row)
        for row in range(4)
        for column in range(8)
        if (color := style_at(lines, column, row).color) and color.name == "#ff5c57"
    }
    assert lit == cells


def test_another_frame_is_a_bare_arrow_with_its_name():
    text = "\n".join(words(draw(FieldPicture(marks=(Mark("carrot1", 3.0, 3.0, math.pi / 2),)))))

    assert " ↑ carrot1" in text


def test_a_frame_nobody_hears_of_fades_and_is_gone():
    def ink(age):
        lines = draw(FieldPicture(marks=(Mark("carrot1", 3.0, 3.0, 0.0, age),)))
        row = words(lines)[11]
        return style_at(lines, row.index("→"), 11).color.name if "→" in row else None

    assert ink(0.0) == theme.hexadecimal(theme.of_name("carrot1"))
    assert ink(10.0) == "#b2b2b2"
    assert ink(15.1) is None


def test_the_view_may_be_another_square_of_the_world():
    picture = FieldPicture(marks=(Mark("m", -3.5, 11.5),), left=-5.0, bottom=3.0, size=10.0)

    text = words(draw(picture, rows=10, ascii_only=True))

    assert text[1][3] == ">"


def test_a_frame_goes_round_a_field_without_colour():
    lines = framed(Canvas(4, 2).lines(FieldPicture()))

    assert words(lines) == ["┌────┐", "│    │", "│    │", "└────┘"]
    assert words(framed([], ascii_only=True)) == ["++", "++"]


def test_the_field_is_a_renderable_of_whatever_size_there_is():
    console = Console(
        width=30, height=40, file=io.StringIO(), color_system=None, legacy_windows=False
    )

    console.print(FieldView(FieldPicture(turtles=(DrawnTurtle("turtle1", CENTRE, CENTRE, 0.0),))))

    lines = console.file.getvalue().splitlines()
    assert len(lines) == 15
    assert "▐→▌ turtle1" in lines[7]


@pytest.mark.parametrize("rows", [1, 2, 3, 5])
def test_a_tiny_field_still_shows_its_turtle(rows):
    turtle = DrawnTurtle("turtle1", CENTRE, CENTRE, math.pi / 2)

    assert "↑" in "".join(words(draw(FieldPicture(turtles=(turtle,)), rows=rows)))


def test_with_arrows_asked_for_a_big_turtle_is_one():
    turtle = DrawnTurtle("turtle1", CENTRE, CENTRE, math.pi)

    assert "▐←▌" in "".join(words(draw(FieldPicture(turtles=(turtle,)), rows=60, arrows=True)))


def test_the_edge_is_the_simulators_own():
    from tftool.motion.unicycle import FIELD

    assert canvas.EDGE == FIELD
