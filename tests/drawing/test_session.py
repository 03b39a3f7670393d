"""Tests of the list of a session's processes in aligned columns."""

import pytest
from rich.cells import cell_len

from tftool.drawing import session_view as session

FOUND = {
    "domain": 0,
    "processes": [
        {
            "command": "demo",
            "pid": 12,
            "role": "host",
            "since": 0.0,
            "nodes": ["turtlesim", "broadcaster1", "a\x1b[2J"],
        },
        {"command": "teleop", "pid": 4567, "role": "guest", "since": 60.0, "nodes": []},
    ],
    "nodes": ["turtlesim", "broadcaster1", "a\x1b[2J", "stranger"],
    "topics": {
        "tf": {
            "type": "tf2_msgs/msg/TFMessage",
            "publishers": ["broadcaster1", "broadcaster1"],
            "subscribers": ["echo"],
            "rate": 125.0,
        },
        "turtle1/cmd_vel": {
            "type": "geometry_msgs/msg/Twist",
            "publishers": [],
            "subscribers": ["turtlesim"],
            "rate": 0.0,
        },
    },
    "services": {
        "spawn": {"type": "turtlesim/srv/Spawn", "node": "turtlesim"},
        "turtle1/set_pen": {"type": "turtlesim/srv/SetPen", "node": "turtlesim"},
        "turtlesim/get_parameters": {"type": "rcl_interfaces/srv/GetParameters", "node": "t"},
    },
}


def lines(**options):
    return [line.plain for line in session.lines(FOUND, **options)]


def test_everything_of_a_kind_stands_in_columns():
    told = lines()

    assert told[0] == "Processes (2)"
    assert told[1].startswith("  tftool demo    process 12    hosts the world  since ")
    assert told[1].endswith("  a␛[2J, broadcaster1, turtlesim")
    assert told[2].startswith("  tftool teleop  process 4567  joined           since ")
    assert told[2].endswith("  no nodes")
    assert told[3:] == [
        "Other nodes (1)",
        "  stranger",
        "Topics (2)",
        "  tf               125.0 Hz  tf2_msgs/msg/TFMessage   from broadcaster1, to echo",
        "  turtle1/cmd_vel    0.0 Hz  geometry_msgs/msg/Twist  from none, to turtlesim",
        "Services (3, 2 shown)",
        "  spawn            turtlesim/srv/Spawn",
        "  turtle1/set_pen  turtlesim/srv/SetPen",
        "  and 1 of parameters and actions (--verbose lists them)",
    ]


@pytest.mark.parametrize("width", [40, 60, 80, 132])
def test_on_a_terminal_lists_go_on_below_and_no_word_is_broken(width):
    told = lines(width=width, verbose=True)

    assert max(map(cell_len, told)) <= width
    place = next(n for n, line in enumerate(told) if line.startswith("  tf "))
    assert told[place + 1] == "    from broadcaster1, to echo"
    words = " ".join(told).replace(",", " ").split()
    assert {"turtlesim", "broadcaster1", "turtle1/cmd_vel", "tf", "joined"} <= set(words)


def test_nobody_there_is_nothing_listed():
    empty = {"processes": [], "nodes": [], "topics": {}, "services": {}}

    assert [line.plain for line in session.lines(empty)] == [
        "Processes (0)", "Topics (0)", "Services (0)",
    ]  # fmt: skip


def test_a_small_terminal_has_all_topics_in_a_line_each():
    topic = {"type": "a/msg/B", "publishers": ["sender"], "subscribers": ["x" * 90], "rate": 5.0}
    found = FOUND | {"topics": {f"topic_{n}": topic for n in range(9)} | {"a/_action/b": topic}}
    told = [line.plain for line in session.lines(found, width=80, height=24)]

    assert len(told) < 24
    assert max(map(cell_len, told)) <= 80
    assert sum("5.0 Hz  sender → x" in line for line in told) == 9
    assert "Topics (10, 9 shown), from → to" in told
    assert "  spawn, turtle1/set_pen" in told
    # A blank line is above each list but the first.
    assert [place for place, line in enumerate(told) if not line] == [
        told.index("Other nodes (1)") - 1,
        told.index("Topics (10, 9 shown), from → to") - 1,
        told.index("Services (3, 2 shown)") - 1,
    ]
    assert told[-1] == "  and 1 topics, 1 services of parameters and actions (--verbose)"
    assert len(session.lines(found, width=80, height=60)) > 24


def test_the_arrow_between_long_lists_of_nodes_is_never_cut():
    long = [f"a_node_with_a_long_name_{n}" for n in range(3)]
    topic = {"type": "a/msg/B", "publishers": long, "subscribers": long, "rate": 5.0}
    found = FOUND | {"topics": {f"topic_{n}": topic for n in range(12)}}

    told = [line.plain for line in session.lines(found, width=80, height=24)]

    assert sum(line.count(" +2 → ") and line.endswith(" +2") for line in told) == 12
    assert max(map(cell_len, told)) <= 80


def test_a_topic_names_a_receiver_that_is_not_its_sender():
    topic = {"publishers": ["drawing", "teleop"], "subscribers": ["drawing", "turtlesim" * 4]}
    found = FOUND | {"topics": {f"t{n}": topic | {"type": "a/B", "rate": 5.0} for n in range(14)}}
    told = [line.plain for line in session.lines(found, width=80, height=24)]

    assert sum("→ turtlesim" in line for line in told) == 14
