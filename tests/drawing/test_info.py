"""Tests of the tables of a recording's facts, in the width of a terminal."""

import pytest
from rich.cells import cell_len

from tftool.drawing.recording_view import as_lines, table

HEADS = ("edge", "kind", "rate", "from")
ROWS = [
    ("laser_link in base_link", "static", "-", "/static_transform_publisher_1396293887803024259"),
    ("base_link in odom", "dynamic", "50.0 Hz", "/wheels"),
]


def told(width):
    return table(HEADS, ROWS, width, optional=("kind", "from"))


def test_numbers_stand_under_each_other_at_their_right_ends():
    rows = [("a", "7", "static"), ("b", "1,234", "dynamic")]

    told = table(("edge", "count", "kind"), rows, right=("count",))

    assert told == ["  edge  count  kind", "  a         7  static", "  b     1,234  dynamic"]


def test_wide_letters_take_two_cells():
    rows = [("日本語 in map", "static", "-"), ("base", "dynamic", "10.0 Hz")]

    lines = table(("edge", "kind", "rate"), rows)

    starts = [
        line.index(word) for line, word in zip(lines, ("kind", "static", "dynamic"), strict=True)
    ]
    columns = [cell_len(line[:at]) for line, at in zip(lines, starts, strict=True)]
    assert columns == [17, 17, 17]


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


@pytest.mark.parametrize("width", [30, 36, 44, 60])
def test_a_number_stands_whole_or_not_at_all(width):
    span = "-1234.567 ms … 1234.567 ms"

    lines = table(
        ("edge", "delay", "least … most"),
        [("base_link in odom", "0.001 ms", span)],
        width,
        optional=("least … most", "delay"),
        right=("delay", "least … most"),
    )

    for cell in ("0.001 ms", span):
        assert cell in lines[1] or len(lines[1].split("  ")) < 4
    assert "…" not in "".join(lines).replace(span, "").replace("least … most", "")


def held(source, **facts):
    row = {"kind": "MCAP", "seconds": 1.5, "messages": 1200, "transforms": 7, "frames": 3}
    return {"source": source, "unreadable": None, "damage": [], "trees": 1, **row, **facts}


def test_damaged_and_unreadable_recordings_are_explained_in_full_below_the_table():
    rows = [
        held("run.mcap"),
        held("cut.mcap", damage=["The file ends in the middle of a chunk.", "It has no index."]),
        held("note.bag", unreadable="'note.bag' is an empty file (0 bytes)."),
    ]

    wide, narrow = as_lines(rows).splitlines(), as_lines(rows, 40).splitlines()

    assert wide[0].split()[-2:] == ["frames", "trees"]
    assert wide[1].split()[-4:] == ["1,200", "7", "3", "1"]
    for lines in (wide, narrow):
        told = " ".join(" ".join(lines).split())
        assert "Unreadable 'note.bag' is an empty file (0 bytes)." in told
        assert "cut.mcap: The file ends in the middle of a chunk.; It has no index." in told
    assert max(map(cell_len, narrow)) <= 40
