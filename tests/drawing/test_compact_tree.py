"""Tests of the tree in the width of a terminal."""

from itertools import pairwise

import pytest
from rich.cells import cell_len
from rich.text import Text

from tests.drawing.test_frame_tree import WORLD, fixed, moving, root, snapshot
from tftool.base.stamps import seconds
from tftool.drawing.frame_tree import TreeOrder, compact
from tftool.drawing.table_columns import TableColumn, fit


def lines(picture, width=80, **options):
    found = compact(picture, width, **options)
    return [line.plain for line in (*found.heading, *found.rows)]


def chain(length, lead="f"):
    return snapshot(
        root(f"{lead}0"), *(moving(f"{lead}{n + 1}", f"{lead}{n}") for n in range(length))
    )


def test_every_frame_has_one_line_with_short_numbers():
    assert lines(WORLD) == [
        "at 1012.500       broadcaster     rate  stored    oldest    newest     age",
        "world",
        "├── turtle1       b1           62.6 Hz  10.0 s  1002.484  1012.484  0.02 s",
        "│   └── carrot1   publisher     static",
        "└── turtle2       b2                 -  0.00 s  1012.484  1012.484  0.02 s",
    ]


def test_columns_go_one_by_one_as_the_width_shrinks():
    kept = [set(lines(WORLD, width)[0].split()[2:]) for width in range(100, 29, -1)]

    assert kept[0] == {"broadcaster", "rate", "stored", "oldest", "newest", "age"}
    assert kept[-1] == {"age"}
    assert all(
        after <= before and len(before) - len(after) <= 1 for before, after in pairwise(kept)
    )


@pytest.mark.parametrize("width", [20, 40, 60, 80, 132])
@pytest.mark.parametrize(
    "picture",
    [
        WORLD,
        chain(40),
        chain(300),
        chain(12, "a_rather_long_name_of_a_link_in_a_namespace/"),
        snapshot(moving("n" * 500, "world", authority="b" * 500), root("world")),
        snapshot(moving("車輪" * 40, "世界", authority="放送" * 9), root("世界")),
        snapshot(moving("a", "b"), moving("b", "a")),
        snapshot(*(root(f"tree{n}") for n in range(50))),
    ],
)
@pytest.mark.parametrize("ascii_only", [False, True])
def test_no_line_is_wider_than_the_terminal_and_none_is_missing(picture, width, ascii_only):
    found = compact(picture, width, ascii_only=ascii_only)

    assert len(found.rows) == len(picture.frames)
    assert max(cell_len(line.plain) for line in (*found.heading, *found.rows)) <= width


def test_forty_levels_are_readable_in_eighty_columns():
    drawn = lines(chain(40, "link_"))

    assert len(drawn) == 42
    assert all(f"link_{n}" in line for n, line in enumerate(drawn[1:]))
    # Each child begins one cell further to the right than its parent.
    starts = [line.index("link_") for line in drawn[1:]]
    assert all(after - before == 1 for before, after in pairwise(starts[1:]))
    assert drawn[-1].split()[-2:] == ["0.02", "s"]


def test_deeper_still_a_number_says_how_deep():
    assert lines(chain(300))[-1].startswith("300…└ f300 ")
    assert lines(chain(300), ascii_only=True)[-1].startswith("300~` f300 ")


def test_a_column_is_measured_once_and_not_for_every_row():
    looks = 0

    class Counted(tuple):
        def __iter__(self):
            nonlocal looks
            looks += 1
            return super().__iter__()

    cells = Counted(("cell", "") for _ in range(50))
    columns = fit([TableColumn("head", cells)], 80, reserved=10, longest=10)
    before = looks
    for place in range(50):
        columns.row(place, Text("name"))

    assert looks == before


def test_so_many_rows_are_drawn_and_no_more():
    assert len(compact(chain(300), 80, most=100).rows) == 100


def test_a_long_name_keeps_its_beginning_and_its_end():
    found = compact(chain(3, "front_left_wheel_encoder_of_robot/link_"), 40)

    assert found.is_cut
    names = [line.plain.split()[-3] for line in found.rows[1:]]
    assert all(name.startswith("front_") and "…" in name for name in names)
    assert [name[-1] for name in names] == ["1", "2", "3"]
    assert not compact(WORLD, 80).is_cut


def test_guides_are_dim_whatever_the_colour_of_the_frame():
    found = compact(WORLD, 80, marks={"turtle1": ("edge-stopped",)})

    for line in found.rows[1:]:
        assert any(span.start == 0 and span.style == "dim" for span in line.spans)
        assert line.style == ""


def test_marks_end_their_rows_and_ages_of_stopped_frames_are_yellow_then_red():
    old, older = moving("old", "world", newest=seconds(1009)), moving("older", "world", newest=0)
    picture = snapshot(root("world"), old, older, moving("cup", "world"))
    marks = {
        "old": ("edge-stopped",), "older": ("edge-stopped",), "cup": ("two-parents", "x"),
    }  # fmt: skip

    found = compact(picture, 80, marks=marks)

    assert [line.plain.split()[-1] for line in found.rows[1:3]] == ["edge-stopped"] * 2
    assert found.rows[3].plain.endswith("two-parents +1")
    ages = [
        span.style
        for line in found.rows[1:3]
        for span in line.spans
        if line.plain[span.start : span.end].strip() in ("3.5 s", "16.9 min")
    ]
    assert ages == ["yellow", "red"]


def test_a_loop_is_told():
    assert any(
        "a loop: parent is b" in line
        for line in lines(snapshot(moving("a", "b"), moving("b", "a")))
    )


def test_several_trees_are_told():
    assert lines(snapshot(root("map"), root("odom")))[0] == "2 separate trees: map, odom"


def test_sorted_frames_have_no_guides():
    picture = snapshot(
        root("world"),
        moving("slow", "world", rate=1.0, newest=seconds(1012)),
        moving("fast", "slow", rate=90.0),
        fixed("still", "fast"),
    )

    def order(by):
        return [line.plain.split()[0] for line in compact(picture, 80, order=by).rows]

    assert order(TreeOrder.name) == ["fast", "slow", "still", "world"]
    assert order(TreeOrder.rate)[:2] == ["fast", "slow"]
    assert order(TreeOrder.age)[:2] == ["slow", "fast"]


def test_of_filtered_frames_those_they_hang_from_stay():
    drawn = lines(WORLD, wanted="CARROT")

    assert [line.split()[-3 if "Hz" in line else 0] for line in drawn[1:2]] == ["world"]
    assert len(drawn) == 4
    assert "turtle2" not in "".join(drawn)
    flat = compact(WORLD, 80, wanted="carrot", order=TreeOrder.name)
    assert [line.plain.split()[0] for line in flat.rows] == ["carrot1"]


def test_of_a_description_the_joints_are_told():
    picture = snapshot(root("base"), fixed("arm", "base", authority="shoulder"))

    assert lines(picture, moving={"arm"}) == [
        "1 of 1 joints move  link    joint",
        "base",
        "└── arm             moving  shoulder",
    ]


def test_the_age_of_a_frame_that_stopped_is_yellow_and_red_after_fifteen_seconds():
    def color(silent, rate=0.0):
        one = moving("arm", "world", rate=rate, newest=seconds(1012.5) - seconds(silent))
        (row,) = [
            row for row in compact(snapshot(root("world"), one), 80).rows if "arm" in row.plain
        ]
        at = row.plain.rindex(" s") - 1
        return next((str(span.style) for span in row.spans if span.start <= at < span.end), "")

    assert color(0.1, rate=50.0) == ""
    assert color(3.0) == "yellow"
    assert color(6.0, rate=0.1) == "yellow"
    assert color(20.0) == "red"
