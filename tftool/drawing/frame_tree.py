"""Every tree of frames: as text for people, as data for programs."""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import zip_longest
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias

from rich.cells import cell_len
from rich.text import Text

from tftool.base.escaping import distinct, visible
from tftool.base.short_numbers import finite
from tftool.base.stamps import as_seconds, display
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing.branches import ASCII, UNICODE, Branch, Guides, branches
from tftool.drawing.drawn_forest import grow
from tftool.geometry.rigid import Transform

NOTHING = "No tf data received"

# What a fact is when there is none: a static link has no rate and no age.
NONE = "-"

ROBOT_HEADINGS = ("", "link", "joint")
"""Of a robot description, in which nothing is sent."""

HEADINGS = ("", "link", "broadcaster", "rate", "buffer length", "oldest", "newest", "age")


WIDEST = 80
"""Columns that the cells of others are filled up to; one that is longer sticks out of its line."""


Marks: TypeAlias = Mapping[str, Sequence[str]]
"""Ids of the doctor's checks by frame."""

NO_MARKS: Marks = MappingProxyType({})


def render(
    snapshot: Snapshot,
    *,
    ascii_only: bool = False,
    moving: Collection[str] | None = None,
    marks: Marks = NO_MARKS,
) -> Text:
    """Draw every tree with all that is known of each link, as wide as it gets.

    `compact_tree.compact` draws it in a terminal's width.

    Args:
        snapshot: What to draw.
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
    if len(forest.roots) > 1:
        listed = ", ".join(names[root] for root in forest.roots)
        text.append(f"\n{len(forest.roots)} separate trees: {listed}", style="yellow")
    text.append("\n")

    for frame, ids in marks.items():
        if frame in names:
            names[frame] += f" ({', '.join(ids)})"
    guides = (ASCII if ascii_only else UNICODE)[0]
    rows = [_row(branch, names, guides, moving) for branch in branches(forest)]
    text.append_tokens(_table(rows, HEADINGS if moving is None else ROBOT_HEADINGS))
    if marks:
        text.append(f"\n\nWhat is in brackets is wrong: {advice(marks)}", style="yellow")
    return text


def advice(marks: Marks) -> str:
    """Where to read on about what is wrong with frames."""
    first = next(iter(marks.values()))[0]
    return f"'tftool doctor --explain {first}' tells more."


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
        "shown_at_ns": snapshot.at or None,
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
    links = [info for info in snapshot.frames if info.parent is not None]
    return "".join(map(_yaml_entry, links)) or "{}\n"


_PLAIN = re.compile(
    r"(?!(?:yes|no|on|off|true|false|null)\Z)[a-z_/][a-z0-9_/]{,100}", re.IGNORECASE
)
"""Names that mean the same in YAML without quotes; of others PyYAML knows."""


def _yaml_entry(info: FrameInfo) -> str:
    entry = {
        "parent": info.parent,
        "broadcaster": info.authority or "no recorded authority",
        "rate": round(info.rate, 3),
        "most_recent_transform": round(as_seconds(info.newest), 6),
        "oldest_transform": round(as_seconds(info.oldest), 6),
        "transform_delay": round(as_seconds(info.age), 3),
        "buffer_length": round(as_seconds(info.buffer_length), 3),
        "static": info.is_static,
    }
    told = {key: _plain(value) for key, value in entry.items()}
    if _plain(info.frame) and all(told.values()):
        # PyYAML takes 200 µs for it: seconds, where there are many.
        return f"{info.frame}:\n" + "".join(f"  {key}: {text}\n" for key, text in told.items())
    import yaml

    return str(yaml.safe_dump({info.frame: entry}, sort_keys=False, allow_unicode=True, width=4096))


def _plain(value: object) -> str:
    """A value as YAML has it; empty where that is not known here."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        text = repr(value)
        return text if text.replace(".", "").lstrip("-").isdecimal() else ""
    return value if isinstance(value, str) and _PLAIN.fullmatch(value) else ""


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


class _Row(NamedTuple):
    """One line: guides, the guides with the frame's name and the facts of its link, its colour."""

    lead: str
    cells: tuple[str, ...]
    style: str


def _row(
    branch: Branch, names: dict[str, str], guides: Guides, moving: Collection[str] | None
) -> _Row:
    info = branch.info
    name = names[info.frame]
    if branch.closes_loop:
        name += f" (a loop: it hangs from {visible(info.parent or NONE)})"
    told = () if info.parent is None else facts(info)
    if told and moving is not None:
        info = info._replace(is_static=info.frame not in moving)
        told = ("fixed" if info.is_static else "moving", visible(info.authority or NONE))
    lead = guides.lead(branch.turns)
    return _Row(lead, (lead + name, *told), _style(info))


def _table(rows: list[_Row], headings: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """One line a frame, under headings where there are links to describe, and its styles."""
    if any(len(row.cells) > 1 for row in rows):
        rows = [_Row("", headings, "dim"), *rows]
    sizes = [[cell_len(cell) for cell in row.cells] for row in rows]
    widths = [min(WIDEST, max(column)) for column in zip_longest(*sizes, fillvalue=0)]
    for row, taken in zip(rows, sizes, strict=True):
        padded = []
        for column, (cell, size) in enumerate(zip(row.cells, taken, strict=True)):
            room = " " * (widths[column] - size)
            # Numbers stand right, so that their points are under each other.
            padded.append(room + cell if column >= 3 else cell + room)
        whole = "  ".join(padded).rstrip()
        yield "\n", ""
        yield row.lead, "dim"
        yield whole[len(row.lead) :], row.style


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
        "translation": [finite(number) for number in pose.translation],
        "rotation": [finite(number) for number in pose.rotation],
    }
