"""Tables of a recording's facts, in as many cells as a terminal has."""

import pytest
from rich.cells import cell_len

from tftool.views.info import table

HEADS = ("edge", "kind", "rate", "from")
ROWS = [
    ("laser_link in base_link", "static", "-", "/static_transform_publisher_1396293887803024259"),
    ("base_link in odom", "dynamic", "50.0 Hz", "/wheels"),
]


def told(width):
    return table(HEADS, ROWS, width, goes=("kind", "from"))


def test_numbers_stand_under_each_other_at_their_right_ends():
    rows = [("a", "7", "static"), ("b", "1,234", "dynamic")]

    told = table(("edge", "count", "kind"), rows, right=("count",))

    assert told == ["  edge  count  kind", "  a         7  static", "  b     1,234  dynamic"]


def test_with_room_every_column_stands_there_whole():
    assert told(None) == told(200)
    assert told(None)[1].split()[-1] == ROWS[0][3]


@pytest.mark.parametrize(
    ("width", "heads"),
    [
        (90, ["edge", "kind", "rate", "from"]),
        (70, ["edge", "rate", "from"]),
        (52, ["edge", "rate", "from"]),
        (40, ["edge", "rate"]),
        (20, ["edge", "rate"]),
    ],
)
def test_columns_shrink_and_go_in_their_order_where_there_is_no_room(width, heads):
    lines = told(width)

    assert lines[0].split() == heads
    assert max(map(cell_len, lines)) <= width
    assert len(lines) == 3


def test_of_what_is_cut_the_beginning_and_the_end_stay():
    (shown,) = [line.split()[-1] for line in told(60) if "/static" in line]

    assert shown.startswith("/static")
    assert shown.endswith("3024259")
    assert "…" in shown
