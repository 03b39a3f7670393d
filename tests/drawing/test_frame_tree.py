import json
from dataclasses import replace
from io import StringIO

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from tftool.base.stamps import seconds
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing import frame_tree
from tftool.geometry.rigid import Transform

NOW = seconds(1012.5)


def root(frame):
    return FrameInfo(
        frame=frame,
        parent=None,
        is_static=False,
        authority=None,
        samples=0,
        rate=0.0,
        oldest=0,
        newest=0,
        buffer_length=0,
        age=0,
        transform=Transform(),
        root=frame,
        root_from_frame=Transform(),
    )


def moving(frame, parent, *, samples=626, rate=62.6, newest=seconds(1012.484), authority="b1"):
    length = seconds(10) if samples > 1 else 0
    return FrameInfo(
        frame=frame,
        parent=parent,
        is_static=False,
        authority=authority,
        samples=samples,
        rate=rate,
        oldest=newest - length,
        newest=newest,
        buffer_length=length,
        age=NOW - newest,
        transform=Transform((1.0, 2.0, 0.0)),
        root="world",
        root_from_frame=Transform((1.0, 2.0, 0.0)),
    )


def fixed(frame, parent, *, authority="publisher"):
    return FrameInfo(
        frame=frame,
        parent=parent,
        is_static=True,
        authority=authority,
        samples=1,
        rate=10000.0,
        oldest=0,
        newest=0,
        buffer_length=0,
        age=0,
        transform=Transform((0.0, 0.0, float("inf"))),
        root="world",
        root_from_frame=None,
    )


def snapshot(*frames, at=0):
    return Snapshot(NOW, at, frames)


def shown(picture, width=200, **options):
    console = Console(file=StringIO(), width=width, color_system=None, _environ={})
    console.print(frame_tree.render(picture, **options), soft_wrap=True)
    return console.file.getvalue().split("\n")


WORLD = snapshot(
    moving("turtle1", "world"),
    root("world"),
    fixed("carrot1", "turtle1"),
    moving("turtle2", "world", samples=1, rate=10000.0, authority="b2"),
)


def test_a_tree_has_one_line_a_frame_with_all_facts():
    assert shown(WORLD) == [
        "Recorded at time: 1012.500000",
        "",
        "                 link     broadcaster       rate  buffer length"
        "       oldest       newest      age",
        "world",
        "├── turtle1      dynamic  b1           62.600 Hz       10.000 s"
        "  1002.484000  1012.484000  0.016 s",
        "│   └── carrot1  static   publisher            -              -"
        "            -            -        -",
        "└── turtle2      dynamic  b2                   -        0.000 s"
        "  1012.484000  1012.484000  0.016 s",
        "",
    ]


def test_nothing_known_says_so():
    assert shown(snapshot()) == ["Recorded at time: 1012.500000", "No tf data received", ""]


def test_a_loop_is_one_tree_with_all_frames_below_it():
    # The branches come before the frames of the loop.
    frames = [moving("left", "a"), moving("right", "b"), moving("a", "b"), moving("b", "a")]

    lines = shown(snapshot(*frames))

    assert not any("separate trees" in line for line in lines)
    assert [line for line in lines if "a loop" in line] == [lines[3]]
    names = sorted(line.split("dynamic")[0].strip("│├└─ ") for line in lines[4:-1])
    assert names == ["b", "left", "right"]
    two = shown(snapshot(*frames, root("map")))
    assert two[1] == "2 separate trees: map, a"


def test_several_trees_are_told_and_a_moment_of_the_past_too():
    lines = shown(snapshot(root("map"), root("world"), at=seconds(1005)))

    assert lines == [
        "Recorded at time: 1012.500000",
        "Shown at time: 1005.000000",
        "2 separate trees: map, world",
        "",
        "map",
        "world",
        "",
    ]


def test_a_loop_is_drawn_once_and_said():
    lines = shown(snapshot(moving("a", "b"), moving("b", "a")))

    assert any("a (a loop: its parent is b)" in line for line in lines)
    assert sum("b1" in line for line in lines) == 2


def test_a_name_cannot_act_on_the_terminal():
    lines = shown(snapshot(moving("\x1b[2Jx\n[bold]y", "world"), root("world")))

    assert not any("\x1b" in line for line in lines)
    assert any("␛[2Jx␊[bold]y" in line for line in lines)


def test_the_deepest_chain_is_drawn():
    chain = [moving(f"f{n + 1}", f"f{n}") for n in range(1000)]

    assert len(shown(snapshot(root("f0"), *chain), 9000)) == 1000 + 5


def test_programs_get_every_fact_and_null_where_there_is_none():
    data = frame_tree.as_object(WORLD)
    assert data["shown_at_ns"] is None
    assert frame_tree.as_object(replace(WORLD, at=5))["shown_at_ns"] == 5

    assert json.loads(json.dumps(data, allow_nan=False)) == data
    turtle, world, carrot, lone = data["frames"]
    assert data["recorded_at_ns"] == NOW
    assert data["roots"] == ["world"]
    assert turtle["rate"] == 62.6
    assert turtle["age_ns"] == 16_000_000
    assert turtle["transform"] == {"translation": [1.0, 2.0, 0.0], "rotation": [0, 0, 0, 1]}
    assert world["rate"] is None
    assert carrot["static"]
    assert carrot["newest_ns"] is None
    assert carrot["transform"]["translation"] == [0.0, 0.0, None]
    assert carrot["root_from_frame"] is None
    assert lone["rate"] is None


@pytest.mark.parametrize("name", ["on", "1", "null", "a: b", "[bold]", "é", "x\x1b"])
def test_yaml_has_tf2s_facts_and_gives_every_name_back(name):
    picture = snapshot(moving(name, "world"), root("world"), fixed("c", name, authority=None))

    links = yaml.safe_load(frame_tree.as_yaml(picture))

    assert links[name] == {
        "parent": "world",
        "broadcaster": "b1",
        "rate": 62.6,
        "most_recent_transform": 1012.484,
        "oldest_transform": 1002.484,
        "transform_delay": 0.016,
        "buffer_length": 10.0,
        "static": False,
    }
    assert links["c"]["parent"] == name
    assert links["c"]["static"] is True
    assert links["c"]["rate"] == 10000.0
    assert links["c"]["broadcaster"] == "no recorded authority"


NAMES = st.one_of(
    st.text("abyYnoONeEſK_/01 9.-:#~=<", min_size=1, max_size=6),
    st.sampled_from(["yes", "No", "NULL", "true", "nan", "a" * 100, "a" * 101, "a" * 130, "a b"]),
)


@given(NAMES, NAMES, st.floats(0, 1e20))
def test_yaml_is_as_pyyaml_writes_it(frame, sender, rate):
    info = moving(frame, sender, authority=sender)._replace(rate=rate)

    written = frame_tree.as_yaml(snapshot(info))

    assert written == yaml.safe_dump(
        yaml.safe_load(written), sort_keys=False, allow_unicode=True, width=4096
    )
    link = yaml.safe_load(written)[frame]
    assert (link["parent"], link["broadcaster"]) == (sender, sender)
    assert link["rate"] == round(rate, 3)


def test_yaml_of_nothing_is_an_empty_mapping():
    assert yaml.safe_load(frame_tree.as_yaml(snapshot(root("world")))) == {}


def test_one_long_name_does_not_fill_up_the_lines_of_the_others():
    frames = (root("world"), *(moving(f"frame{n}", "world") for n in range(50)))
    long = moving("x" * 4096, "world", authority="y" * 4096)

    drawn = frame_tree.render(Snapshot(NOW, 0, (*frames, long))).plain

    assert "x" * 4096 in drawn
    assert all(len(line) < 300 for line in drawn.splitlines() if "frame" in line)


def test_a_deep_chain_is_indented_so_far_and_then_numbered():
    deep = snapshot(root("f0"), *(fixed(f"f{n}", f"f{n - 1}") for n in range(1, 3001)))

    lines = frame_tree.render(deep).plain.split("\n")

    by_name = {line.split("── ")[-1].split()[0]: line for line in lines if "── " in line}
    assert by_name["f64"].startswith(" " * 4 * 63 + "└── f64 ")
    assert by_name["f65"].startswith("65…└── f65 ")
    assert by_name["f3000"].startswith("3000…└── f3000 ")
    # The length of a line is limited, whatever the depth: 3000 lines of 12 kB would be 36 MB.
    assert max(map(len, lines)) < 500


def test_the_first_lines_of_a_tree_come_before_the_last_ones_are_made():
    pieces = frame_tree.pieces(snapshot(root("map"), fixed("odom", "map")))

    assert next(pieces)[0].startswith("Recorded at time")
