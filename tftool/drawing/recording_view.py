"""Content of a recording or a robot description, as text lines and as JSON."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime, timedelta
from textwrap import wrap
from typing import Any

from rich.cells import cell_len
from rich.text import Text

from tftool.base.plain_text import count, short_size, visible
from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, Duration, Stamp, as_seconds
from tftool.drawing.table_columns import TableColumn, fit, middle_cut
from tftool.recordings.contract import Publisher, RecordedTopic
from tftool.recordings.description_frames import DescribedFrames
from tftool.recordings.recording import Recording
from tftool.recordings.recording_summary import EdgeFacts, TreeFacts, edge_facts, oddities, trees
from tftool.robots.description import RobotJoint
from tftool.robots.robot_model import Robot

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def as_text(recording: Recording, width: int | None = None, name: str | None = None) -> str:
    """Return the content of a recording as text lines.

    Args:
        recording: The recording.
        width: Maximum length of a line in cells, None for no limit. Sentences are wrapped, and
            columns that do not fit are omitted.
        name: Name to print instead of the opened path.
    """
    source = recording.source
    edges, forest = edge_facts(recording.transforms), trees(recording.transforms)
    topics = recording.topics
    messages = sum(topic.count for topic in topics)
    span = source.end - source.start
    facts = [
        f"{visible(name or recording.name)}: {recording.source.kind}, {short_size(source.size)}",
        f"{count(messages, 'message')} on {count(len(topics), 'topic')}, "
        f"{count(len(recording.transforms), 'transform')} of {count(len(edges), 'edge')}",
    ]
    if messages:
        facts.append(
            f"Received from {_moment(source.start)} to {_moment(source.end)}: {_seconds(span)}"
        )
    if edges:
        facts.append(
            f"Stamps   from {_moment(recording.start)} to {_moment(recording.end)}: "
            f"{_seconds(recording.end - recording.start)}"
        )
    lines = [line for fact in facts for line in wrapped(fact, width)]
    if topics:
        lines += ["", "Topics"]
        lines += table(
            ("name", "type", "messages", "rate", "publishers"),
            _topics(recording, topics),
            width,
            optional=("publishers", "type"),
            right=("messages", "rate"),
        )
    if edges:
        lines += ["", *wrapped(f"Frames: {_forest(forest)}", width)]
        lines += table(
            ("edge", "kind", "transforms", "rate", "delay", "least … most", "from"),
            list(map(_row, edges)),
            width,
            optional=("kind", "transforms", "from", "least … most", "delay"),
            right=("transforms", "rate", "delay", "least … most"),
        )
    if recording.robot is not None:
        lines += ["", *wrapped(f"Robot: {_robot(recording, recording.robot)}", width)]
    odd = oddities(recording, edges, forest)
    for heading, sentences in (("Damage", recording.damage), ("Odd", odd)):
        if sentences:
            lines += ["", heading]
            for sentence in sentences:
                lines += wrapped(visible(sentence), width, "  ")
    return "\n".join(lines) + "\n"


def wrapped(sentence: str, width: int | None, indent: str = "") -> list[str]:
    """Indent a sentence, and wrap it between words if the width is limited."""
    if width is None or len(indent) + cell_len(sentence) <= width:
        return [indent + sentence]
    return wrap(
        sentence,
        max(width, 20),
        initial_indent=indent,
        subsequent_indent=f"{indent}  ",
        break_on_hyphens=False,
    )


def _topics(recording: Recording, topics: Sequence[RecordedTopic]) -> list[tuple[str, ...]]:
    span = recording.source.end - recording.source.start
    publishers = _publishers(recording)
    return [
        (
            visible(topic.name),
            visible(topic.type),
            f"{topic.count:,}",
            f"{(topic.count - 1) * NANOSECONDS / span:.1f} Hz"
            if topic.count > 1 and span and not topic.static
            else "-",
            _few(sorted({one.node for one in publishers[topic.name]})),
        )
        for topic in topics
    ]


def _publishers(recording: Recording) -> dict[str, list[Publisher]]:
    """Return the publishers of each topic of a recording."""
    found: dict[str, list[Publisher]] = defaultdict(list)
    for one in recording.publishers:
        found[one.topic].append(one)
    return found


def _robot(recording: Recording, robot: Robot) -> str:
    moving = sum(joint.moves for joint in robot.joints.values())
    found = recording.described or DescribedFrames()
    text = (
        f"description of '{visible(robot.name)}': {count(len(robot.links), 'link')}, "
        f"{count(len(robot.joints), 'joint')}, {moving} of the joints move"
    )
    if found.still or found.moving:
        text += (
            f"; {count(len(found.still) + len(found.moving), 'frame')} only in the description, "
            f"{len(found.moving)} of these moved by joint states"
        )
    if found.gaps:
        text += f"; {count(len(found.gaps), 'link')} without a frame: {_few(list(found.gaps))}"
    return text


def as_object(recording: Recording, name: str | None = None) -> dict[str, Any]:
    """Return the content of a recording as a mapping, for --json; times in nanoseconds."""
    source, publishers = recording.source, _publishers(recording)
    edges, forest = edge_facts(recording.transforms), trees(recording.transforms)
    return {
        "name": name or recording.name,
        "kind": source.kind,
        "bytes": source.size,
        "log_start_ns": source.start,
        "log_end_ns": source.end,
        "start_ns": recording.start,
        "end_ns": recording.end,
        "robot": None
        if recording.robot is None or recording.described is None
        else {
            "name": recording.robot.name,
            "links": len(recording.robot.links),
            "added_still": list(recording.described.still),
            "added_moving": list(recording.described.moving),
            "gaps": list(recording.described.gaps),
        },
        "topics": [_topic_object(topic, publishers[topic.name]) for topic in recording.topics],
        "edges": [_edge_object(edge) for edge in edges],
        "trees": [{"root": tree.root, "frames": tree.frames} for tree in forest],
        "damage": list(recording.damage),
        "odd": oddities(recording, edges, forest),
    }


def _topic_object(topic: RecordedTopic, publishers: Sequence[Publisher]) -> dict[str, Any]:
    return {
        "name": topic.name,
        "type": topic.type,
        "encoding": topic.encoding,
        "count": topic.count,
        "transforms": topic.transforms,
        "static": topic.static,
        "publishers": [
            {"node": one.node, "durability": one.durability, "reliability": one.reliability}
            for one in publishers
        ],
    }


def _edge_object(edge: EdgeFacts) -> dict[str, Any]:
    offset = edge.offset
    return {
        "parent": edge.parent,
        "child": edge.child,
        "static": edge.static,
        "count": edge.count,
        "rate": edge.rate,
        "first_ns": edge.first,
        "last_ns": edge.last,
        "offset_ns": None
        if offset is None
        else {"least": offset.least, "median": offset.median, "most": offset.most},
        "publishers": list(edge.publishers),
    }


def _row(edge: EdgeFacts) -> tuple[str, ...]:
    delay = span = "-"
    if edge.offset is not None and edge.offset.least >= SIMULATED_BELOW:
        # "50 years later" would say little; "on another clock" explains the difference.
        delay = "other clock"
    elif edge.offset is not None:
        delay = _offset(edge.offset.median)
        span = f"{_offset(edge.offset.least)} … {_offset(edge.offset.most)}"
    return (
        f"{visible(edge.child)} in {visible(edge.parent)}",
        "static" if edge.static else "dynamic",
        f"{edge.count:,}",
        "-" if edge.rate is None else f"{edge.rate:.1f} Hz",
        delay,
        span,
        _few(edge.publishers),
    )


def _forest(forest: Sequence[TreeFacts]) -> str:
    total = sum(tree.frames for tree in forest)
    words = [f"{tree.frames} with the root {visible(tree.root)}" for tree in forest[:4]]
    more = f" and {len(forest) - 4} trees more" if len(forest) > 4 else ""
    if len(forest) == 1:
        return f"{total} in 1 tree with the root {visible(forest[0].root)}"
    return f"{total} in {len(forest)} trees: {', '.join(words)}{more}"


_WIDEST = 120
_NARROW = (32, 16)
"""Widths to which a column that may be left out shrinks, one after the other."""


def table(
    heads: tuple[str, ...],
    rows: list[tuple[str, ...]],
    width: int | None = None,
    *,
    optional: tuple[str, ...] = (),
    right: tuple[str, ...] = (),
) -> list[str]:
    """Format a table as lines of text, with columns as wide as their widest cells.

    Args:
        heads: Headings of the columns.
        rows: Cells of each row.
        width: Maximum length of a line in cells; None for no limit.
        optional: Headings of columns to narrow or omit if the table is too wide, in this order.
        right: Headings of columns with numbers, which are aligned to the right.
    """
    widths = [min(_WIDEST, max(map(cell_len, column))) for column in zip(heads, *rows, strict=True)]
    lines = [
        "  "
        + "  ".join(
            " " * (width - cell_len(cell)) + cell
            if head in right
            else cell + " " * (width - cell_len(cell))
            for head, cell, width in zip(heads, row, widths, strict=True)
        ).rstrip()
        for row in (heads, *rows)
    ]
    if width is None or max(map(cell_len, lines)) <= width:
        return lines
    columns = [
        TableColumn(
            head,
            [(row[at], "") for row in rows],
            align_right=head in right,
            # A number must not be cut in its middle: it would look like another number.
            caps=_NARROW if head in optional and head not in right else (),
            drop_order=optional.index(head) + 1 if head in optional else 0,
        )
        for at, head in enumerate(heads)
        if at
    ]
    longest = max(map(cell_len, [heads[0], *(row[0] for row in rows)]))
    fitted = fit(columns, width - 2, reserved=longest, longest=longest)
    names = [Text(middle_cut(row[0], fitted.first_width)) for row in rows]
    shown = [fitted.heading(heads[0]), *(fitted.row(at, name) for at, name in enumerate(names))]
    return [f"  {line.plain}" for line in shown]


def _few(names: Sequence[str]) -> str:
    shown = ", ".join(visible(name) for name in names[:3] if name) or "-"
    return shown if len(names) <= 3 else f"{shown} and {len(names) - 3} more"


def _offset(duration: Duration) -> str:
    if abs(duration) < NANOSECONDS:
        return f"{duration / 1e6:.1f} ms"
    return f"{as_seconds(duration):.3f} s"


def _seconds(duration: Duration) -> str:
    return f"{as_seconds(duration):.3f} s"


def _moment(stamp: Stamp) -> str:
    if stamp < SIMULATED_BELOW:
        return f"{as_seconds(stamp):.3f} s"
    try:
        return (_EPOCH + timedelta(microseconds=stamp // 1000)).strftime("%Y-%m-%d %H:%M:%S.%f UTC")
    except OverflowError:
        return f"{as_seconds(stamp):.3f} s"


def as_lines(rows: Sequence[Mapping[str, Any]], width: int | None = None) -> str:
    """Return one line per recording; problems of a recording are in further lines.

    Args:
        rows: Facts of each recording, or the reason why a recording could not be read.
        width: Maximum length of a line in cells; None for no limit.
    """
    heads = ("recording", "kind", "length", "messages", "transforms", "frames", "trees")
    lines: list[tuple[str, ...]] = []
    for row in rows:
        facts: tuple[str, ...] = ("-",) * 6
        if row["unreadable"] is None:
            facts = (
                str(row["kind"]),
                f"{row['seconds']:.1f} s",
                *(f"{row[one]:,}" for one in heads[3:]),
            )
        lines.append((visible(str(row["source"])), *facts))
    told = table(
        heads,
        lines,
        width,
        optional=("kind", "trees", "messages", "frames", "transforms"),
        right=heads[2:],
    )
    wrong = {
        "Unreadable": [row for row in rows if row["unreadable"] is not None],
        "Damage": [row for row in rows if row["unreadable"] is None and row["damage"]],
    }
    for heading, found in wrong.items():
        if found:
            told += ["", heading]
        for row in found:
            name, why = str(row["source"]), row["unreadable"] or "; ".join(row["damage"])
            # The error text usually names the file already.
            told += wrapped(visible(why if name in why else f"{name}: {why}"), width, "  ")
    return "\n".join(told) + "\n"


def robot_as_text(name: str, robot: Robot, width: int | None = None) -> str:
    """Return the content of a robot description as text lines.

    Args:
        name: Name of the description, as given.
        robot: The described robot.
        width: Maximum length of a line in cells, None for no limit; columns that do not fit are
            omitted.
    """
    links, joints = robot.links, robot.joints
    moving = sum(joint.moves for joint in joints.values())
    lines = [
        f"{visible(name)}: description of robot '{visible(robot.name)}'",
        f"{count(len(links), 'link')}, {count(len(joints), 'joint')}, {moving} of them "
        f"{'moves' if moving == 1 else 'move'}",
        f"Root: {visible(robot.root)}",
        _mass(robot),
    ]
    if joints:
        rest = robot.positions()
        lines += ["", "Joints"]
        lines += table(
            ("name", "type", "frames", "limits", "at rest", "mimics"),
            [
                (
                    visible(joint.name),
                    joint.type,
                    f"{visible(joint.child)} in {visible(joint.parent)}",
                    _limits(joint),
                    f"{rest[joint.name]:.4g}" if joint.moves else "-",
                    _mimic(joint),
                )
                for joint in joints.values()
            ],
            width,
            optional=("mimics", "frames", "type"),
        )
    if robot.notes:
        lines += ["", "Odd"]
        for note in robot.notes:
            lines += wrapped(visible(note), width, "  ")
    return "\n".join(lines) + "\n"


def robot_as_object(name: str, robot: Robot) -> dict[str, Any]:
    """Return a robot description as a mapping, for --json; radians, metres, kilograms."""
    rest = robot.positions()
    return {
        "name": name,
        "kind": "robot description",
        "robot": robot.name,
        "root": robot.root,
        "links": [{"name": link.name, "mass": link.mass} for link in robot.links.values()],
        "joints": [
            {
                "name": joint.name,
                "type": joint.type,
                "parent": joint.parent,
                "child": joint.child,
                "lower": joint.limit.lower if joint.limit else None,
                "upper": joint.limit.upper if joint.limit else None,
                "at_rest": rest.get(joint.name),
                "mimics": None
                if joint.mimic is None
                else {
                    "joint": joint.mimic.joint,
                    "multiplier": joint.mimic.multiplier,
                    "offset": joint.mimic.offset,
                },
            }
            for joint in robot.joints.values()
        ],
        "notes": list(robot.notes),
    }


def _mass(robot: Robot) -> str:
    masses = [link.mass for link in robot.links.values() if link.mass is not None]
    if not masses:
        return "Mass: not given"
    return f"Mass: {sum(masses):.4g} kg in {count(len(masses), 'link')}"


def _limits(joint: RobotJoint) -> str:
    if joint.limits is None:
        return "-"
    lower, upper = joint.limits
    return f"{lower:.4g} {joint.unit} … {upper:.4g} {joint.unit}"


def _mimic(joint: RobotJoint) -> str:
    if joint.mimic is None:
        return "-"
    shift = f" {joint.mimic.offset:+.4g}" if joint.mimic.offset else ""
    return f"{joint.mimic.multiplier:.4g} · {visible(joint.mimic.joint)}{shift}"
