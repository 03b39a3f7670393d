"""Every tree of frames: as text for people, as data for programs."""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, TypeAlias

from rich.cells import cell_len
from rich.text import Text

from tftool.frames.sample import FrameInfo, Snapshot
from tftool.geometry.rigid import Transform
from tftool.stamps import as_seconds, display
from tftool.views.escaping import distinct, shorten, visible
from tftool.views.forest import Forest, grow

NOTHING = "No tf data received"

# What a fact is when there is none: a static link has no rate and no age.
NONE = "-"

ROBOT_HEADINGS = ("", "link", "joint")
"""Of a robot description, in which nothing is sent."""

HEADINGS = ("", "link", "broadcaster", "rate", "buffer length", "oldest", "newest", "age")


WIDEST = 80
"""Columns that the cells of others are filled up to; one that is longer sticks out of its line."""


@dataclass(frozen=True, slots=True)
class _Guides:
    """The four pieces a tree is drawn with."""

    child: str = "├── "
    last: str = "└── "
    past: str = "│   "
    blank: str = "    "


Marks: TypeAlias = Mapping[str, Sequence[str]]
"""Ids of the doctor's checks by frame."""

NO_MARKS: Marks = MappingProxyType({})

UNICODE = _Guides()
ASCII = _Guides("|-- ", "`-- ", "|   ", "    ")


def render(
    snapshot: Snapshot,
    *,
    width: int | None = None,
    ascii_only: bool = False,
    moving: Collection[str] | None = None,
    marks: Marks = NO_MARKS,
) -> Text:
    """Draw every tree: one line a frame where that fits, else three.

    Args:
        snapshot: What to draw.
        width: Columns there are; None for as many as it takes.
        ascii_only: Whether to keep to ASCII for the branches.
        moving: Of a robot description, the frames whose joint moves; None for other frames.
        marks: What is wrong with frames: ids of the doctor's checks.

    Returns:
        Lines; nothing in a name acts on the terminal.
    """
    text = Text(no_wrap=True, overflow="ellipsis")
    if moving is None:
        text.append(f"Recorded at time: {display(snapshot.now)}")
    else:
        fixed = len(snapshot.frames) - len(moving) - 1
        text.append(f"{len(moving)} of {len(moving) + fixed} joints move")
    if snapshot.at:
        text.append(f"\nShown at time: {display(snapshot.at)}")
    if not snapshot.frames:
        return text.append(f"\n{NOTHING}")
    forest = grow(snapshot)
    names = distinct(forest.info)
    if width is not None:
        # A name may be of any length, and the facts behind it matter too.
        names = {frame: shorten(name, max(16, width // 3)) for frame, name in names.items()}
    if len(forest.roots) > 1:
        listed = ", ".join(names[root] for root in forest.roots)
        text.append(f"\n{len(forest.roots)} separate trees: {listed}", style="yellow")
    text.append("\n")

    for frame, ids in marks.items():
        if frame in names:
            names[frame] += f" ({', '.join(ids)})"
    branches = list(_branches(forest, names, ASCII if ascii_only else UNICODE))
    if moving is not None:
        branches = [_of_robot(branch, moving) for branch in branches]
    lines = _table(branches, HEADINGS if moving is None else ROBOT_HEADINGS)
    if width is not None and any(line.cell_len > width for line in lines):
        lines = list(_stacked(branches))
    for line in lines:
        text.append("\n").append_text(line)
    if marks:
        first = next(iter(marks.values()))[0]
        told = f"What is in brackets is wrong: 'tftool doctor --explain {first}' tells more."
        text.append(f"\n\n{told}", style="yellow")
    return text


def as_object(
    snapshot: Snapshot, moving: Collection[str] | None = None, marks: Marks = NO_MARKS
) -> dict[str, Any]:
    """The same for programs; stamps in nanoseconds, no fact as null."""
    if moving is not None:
        told = as_object(snapshot, marks=marks)
        for frame in told["frames"]:
            frame["moves"] = frame["frame"] in moving
        return told
    return {
        "recorded_at_ns": snapshot.now,
        "shown_at_ns": snapshot.at,
        "roots": list(snapshot.roots()),
        "frames": [
            _frame_object(info) | {"marks": list(marks.get(info.frame, ()))}
            for info in snapshot.frames
        ],
    }


def as_yaml(snapshot: Snapshot) -> str:
    """The same in the shape of tf2's `all_frames_as_yaml`, with every name quoted where YAML
    would take it for something else, and `static` beside tf2's own facts.
    """
    import yaml

    links = {
        info.frame: {
            "parent": info.parent,
            "broadcaster": info.authority or "no recorded authority",
            "rate": round(info.rate, 3),
            "most_recent_transform": round(as_seconds(info.newest), 6),
            "oldest_transform": round(as_seconds(info.oldest), 6),
            "transform_delay": round(as_seconds(info.age), 3),
            "buffer_length": round(as_seconds(info.buffer_length), 3),
            "static": info.is_static,
        }
        for info in snapshot.frames
        if info.parent is not None
    }
    return str(yaml.safe_dump(links, sort_keys=False, allow_unicode=True, width=4096))


def facts(info: FrameInfo) -> tuple[str, ...]:
    """What there is to say about one link, in the order of `HEADINGS` after the name."""
    if info.is_static:
        always = ("static", visible(info.authority or NONE))
        return (*always, *(NONE for _ in HEADINGS[3:]))
    return (
        "dynamic",
        visible(info.authority or NONE),
        NONE if info.samples < 2 else f"{info.rate:.3f} Hz",
        f"{as_seconds(info.buffer_length):.3f} s",
        display(info.oldest),
        display(info.newest),
        f"{as_seconds(info.age):.3f} s",
    )


@dataclass(frozen=True, slots=True)
class _Branch:
    """One frame where it stands in its tree.

    Attributes:
        label: The branch it hangs on, and its name.
        below: What is drawn before lines that belong to it.
        info: The frame.
        facts: About its link, in the order of `HEADINGS`; none for a root.
    """

    label: str
    below: str
    info: FrameInfo
    facts: tuple[str, ...]


def _branches(forest: Forest, names: dict[str, str], guides: _Guides) -> Iterator[_Branch]:
    """Every frame, parents before children; a deep tree needs no deep stack."""
    waiting = [(root, "", "") for root in reversed(forest.roots)]
    while waiting:
        frame, lead, below = waiting.pop()
        info = forest.info[frame]
        label = lead + names[frame]
        if frame in forest.loops:
            label += f" (a loop: it hangs from {visible(info.parent or NONE)})"
        yield _Branch(label, below, info, () if info.parent is None else facts(info))
        for place, child in enumerate(reversed(forest.children[frame])):
            branch, past = (guides.child, guides.past) if place else (guides.last, guides.blank)
            waiting.append((child, below + branch, below + past))


def _of_robot(branch: _Branch, moving: Collection[str]) -> _Branch:
    """The same frame with what there is to say about its joint."""
    if not branch.facts:
        return branch
    info = branch.info._replace(is_static=branch.info.frame not in moving)
    kind = "fixed" if info.is_static else "moving"
    return replace(branch, info=info, facts=(kind, visible(info.authority or NONE)))


def _table(branches: list[_Branch], headings: tuple[str, ...]) -> list[Text]:
    """One line a frame, under headings where there are links to describe."""
    rows = [(branch.label, *branch.facts) for branch in branches]
    if any(branch.facts for branch in branches):
        rows.insert(0, headings)
    widths = [
        min(WIDEST, max(cell_len(row[column]) for row in rows if column < len(row)))
        for column in range(max(map(len, rows)))
    ]
    styles = ["dim"] * (len(rows) - len(branches)) + [_style(branch.info) for branch in branches]
    return [_line(row, widths, style) for row, style in zip(rows, styles, strict=True)]


def _line(cells: tuple[str, ...], widths: list[int], style: str) -> Text:
    padded = []
    for column, (cell, width) in enumerate(zip(cells, widths, strict=False)):
        room = " " * (width - cell_len(cell))
        # Numbers stand right, so that their points are under each other.
        padded.append(room + cell if column >= 3 else cell + room)
    return Text("  ".join(padded).rstrip(), style=style)


def _stacked(branches: list[_Branch]) -> Iterator[Text]:
    """Up to three lines a frame, for narrow terminals."""
    for branch in branches:
        yield Text(branch.label, style=_style(branch.info))
        if not branch.facts:
            continue
        if len(branch.facts) == len(ROBOT_HEADINGS) - 1:
            yield Text(f"{branch.below}{', '.join(branch.facts)}", style="dim")
            continue
        kind, broadcaster, rate, length, oldest, newest, age = branch.facts
        if branch.info.is_static:
            yield Text(f"{branch.below}static, by {broadcaster}", style="dim")
            continue
        yield Text(f"{branch.below}{kind}, by {broadcaster}, {rate}, age {age}", style="dim")
        yield Text(f"{branch.below}{length} kept: {oldest} to {newest}", style="dim")


def _style(info: FrameInfo) -> str:
    if info.parent is None:
        return "bold"
    return "cyan" if info.is_static else ""


def _frame_object(info: FrameInfo) -> dict[str, Any]:
    measured = not info.is_static and info.parent is not None
    return {
        "frame": info.frame,
        "parent": info.parent,
        "root": info.root,
        "static": info.is_static,
        "broadcaster": info.authority,
        "samples": info.samples,
        "rate": info.rate if measured and info.samples > 1 else None,
        "oldest_ns": info.oldest if measured else None,
        "newest_ns": info.newest if measured else None,
        "buffer_length_ns": info.buffer_length if measured else None,
        "age_ns": info.age if measured else None,
        "transform": _pose_object(info.transform),
        "root_from_frame": _pose_object(info.root_from_frame),
    }


def _pose_object(pose: Transform | None) -> dict[str, list[float | None]] | None:
    if pose is None:
        return None
    return {
        "translation": [_finite(number) for number in pose.translation],
        "rotation": [_finite(number) for number in pose.rotation],
    }


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None
