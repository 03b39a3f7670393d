"""Trees of frames: as full text, fitted to a terminal's width, or as data for --json.

In a narrow terminal, parts are dropped one by one: first the least useful columns, then the middle
of the broadcasters' names, wide tree lines, and the middle of the frames' names.
"""

import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import zip_longest
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias

from rich.cells import cell_len
from rich.text import Text

from tftool.base.plain_text import distinct, finite, short_duration, short_rate, visible
from tftool.base.stamps import (
    FRAME_TIMEOUT,
    SIMULATED_BELOW,
    as_seconds,
    display,
    time_of_day,
)
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing import theme
from tftool.drawing.drawn_forest import ASCII, UNICODE, Branch, Forest, Guides, branches, grow
from tftool.drawing.sparklines import NO_HISTORY, TrafficHistory
from tftool.drawing.table_columns import GAP, Cell, TableColumn, fit, middle_cut
from tftool.geometry.rigid import Transform

NOTHING = "No tf data received"

# Text for a missing fact: a static edge has no rate and no age.
NONE = "-"

ROBOT_HEADINGS = ("", "link", "joint")
"""Headings of the tree of a robot description, which has no publishers or rates."""

HEADINGS = ("", "link", "broadcaster", "rate", "buffer length", "oldest", "newest", "age")


WIDEST = 80
"""Largest width to which a column's cells are padded; a longer cell moves the rest of its line."""


Marks: TypeAlias = Mapping[str, Sequence[str]]
"""Ids of the doctor's findings about each frame."""

NO_MARKS: Marks = MappingProxyType({})


def render(
    snapshot: Snapshot,
    *,
    ascii_only: bool = False,
    moving: Collection[str] | None = None,
    marks: Marks = NO_MARKS,
) -> Text:
    """Return every tree as text with all facts of each frame, in lines of any width.

    The arguments are those of `pieces`. To fit the trees to a terminal's width, use `compact`.

    Returns:
        Lines in which control characters are replaced.
    """
    drawn = pieces(snapshot, ascii_only=ascii_only, moving=moving, marks=marks)
    return Text(no_wrap=True, overflow="ellipsis").append_tokens(drawn)


def pieces(
    snapshot: Snapshot,
    *,
    ascii_only: bool = False,
    moving: Collection[str] | None = None,
    marks: Marks = NO_MARKS,
) -> Iterator[tuple[str, str]]:
    """Yield the text of every tree bit by bit, so that a large tree starts to appear at once.

    Args:
        snapshot: Frames to draw.
        ascii_only: Whether to draw the branches in ASCII.
        moving: Frames of a robot description that a joint moves; None for other sources.
        marks: Ids of the doctor's findings about each frame.

    Yields:
        Successive texts, each with its style.
    """
    if moving is None:
        yield f"Recorded at time: {display(snapshot.now)}", ""
    else:
        fixed = max(len(snapshot.frames) - len(moving) - 1, 0)
        yield f"{len(moving)} of {len(moving) + fixed} joints move", ""
    if snapshot.at:
        yield f"\nShown at time: {display(snapshot.at)}", ""
    if not snapshot.frames:
        yield f"\n{NOTHING}", ""
        return
    forest = grow(snapshot)
    names = distinct(forest.info)
    if len(forest.roots) > 1:
        listed = ", ".join(names[root] for root in forest.roots)
        yield f"\n{len(forest.roots)} separate trees: {listed}", "yellow"
    yield "\n", ""

    for frame, ids in marks.items():
        if frame in names:
            names[frame] += f" ({', '.join(ids)})"
    guides = (ASCII if ascii_only else UNICODE)[0]
    rows = [_row(branch, names, guides, moving) for branch in branches(forest)]
    yield from _table(rows, HEADINGS if moving is None else ROBOT_HEADINGS)
    if marks:
        yield f"\n\nThe ids in brackets name problems: {advice(marks)}", "yellow"


def advice(marks: Marks) -> str:
    """Return a sentence with the command that explains the first of the doctor's findings."""
    first = next(iter(marks.values()))[0]
    return f"'tftool doctor --explain {first}' tells more."


def as_object(
    snapshot: Snapshot, moving: Collection[str] | None = None, marks: Marks = NO_MARKS
) -> dict[str, Any]:
    """Return the trees as a mapping, for --json: times in nanoseconds, null for unknown values."""
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
    """Return the text of tf2's `all_frames_as_yaml`, with `static` added to each frame.

    Names that YAML would misread are quoted.
    """
    links = [info for info in snapshot.frames if info.parent is not None]
    return "".join(map(_yaml_entry, links)) or "{}\n"


_PLAIN = re.compile(
    r"(?!(?:yes|no|on|off|true|false|null)\Z)[a-z_/][a-z0-9_/]{,100}", re.IGNORECASE
)
"""Names that need no quotes in YAML; PyYAML decides about other names."""


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
        # PyYAML takes 200 µs per name, which would be seconds for many names.
        return f"{info.frame}:\n" + "".join(f"  {key}: {text}\n" for key, text in told.items())
    # Few trees are written as YAML, and fewer need PyYAML, whose import delays every tree.
    import yaml

    return str(yaml.safe_dump({info.frame: entry}, sort_keys=False, allow_unicode=True, width=4096))


def _plain(value: object) -> str:
    """Return the YAML text of a value that needs no quotes; "" for other values."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        text = repr(value)
        return text if text.replace(".", "").lstrip("-").isdecimal() else ""
    return value if isinstance(value, str) and _PLAIN.fullmatch(value) else ""


def facts(info: FrameInfo) -> tuple[str, ...]:
    """Return the facts about a frame's edge to its parent, one fact for each of `HEADINGS`."""
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
    """Line of a tree: tree lines before the name, cells (name and facts of the frame), style."""

    lead: str
    cells: tuple[str, ...]
    style: str


def _row(
    branch: Branch, names: dict[str, str], guides: Guides, moving: Collection[str] | None
) -> _Row:
    info = branch.info
    name = names[info.frame]
    if branch.closes_loop:
        name += f" (a loop: its parent is {visible(info.parent or NONE)})"
    told = () if info.parent is None else facts(info)
    if told and moving is not None:
        info = info._replace(is_static=info.frame not in moving)
        told = ("fixed" if info.is_static else "moving", visible(info.authority or NONE))
    lead = guides.lead(branch, more="~" if guides in ASCII else "…")
    return _Row(lead, (lead + name, *told), _style(info))


def _table(rows: list[_Row], headings: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Yield one line per frame with its style, in aligned columns below headings."""
    if any(len(row.cells) > 1 for row in rows):
        rows = [_Row("", headings, "dim"), *rows]
    sizes = [[cell_len(cell) for cell in row.cells] for row in rows]
    widths = [min(WIDEST, max(column)) for column in zip_longest(*sizes, fillvalue=0)]
    for row, taken in zip(rows, sizes, strict=True):
        padded = []
        for column, (cell, size) in enumerate(zip(row.cells, taken, strict=True)):
            room = " " * (widths[column] - size)
            # Numbers are aligned to the right, so that their decimal points are in one column.
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


LEAST_NAME = 16
"""Cells of guides and names for which a column of facts is dropped."""

SHARE = 0.6
"""Fraction of the width for guides and names; wider guides shrink, and longer names are cut."""

BROADCASTERS = (24, 16, 11)
"""Widths in cells of the column of broadcasters, tried from wide to narrow."""


class TreeOrder(StrEnum):
    """Order of the frames in a compact tree: as a tree, or sorted by one column."""

    tree = "tree"
    name = "name"
    rate = "rate"
    age = "age"
    broadcaster = "broadcaster"


@dataclass(frozen=True, slots=True)
class CompactTree:
    """Text of the trees, fitted to a terminal's width.

    Attributes:
        heading: Lines above the frames: the time, the number of trees, and the column headings.
        rows: One line per frame.
        is_cut: Whether a name had to be shortened.
    """

    heading: tuple[Text, ...]
    rows: tuple[Text, ...]
    is_cut: bool


Told = Callable[[FrameInfo], str]


def _measured(told: Told) -> Told:
    return lambda info: "" if info.is_static else told(info)


def _broadcaster(info: FrameInfo) -> str:
    return visible(info.authority or "-")


def _rate(info: FrameInfo) -> str:
    if info.is_static:
        return "static"
    return "-" if info.samples < 2 else short_rate(info.rate)


_STORED = _measured(lambda info: short_duration(info.buffer_length))
_OLDEST = _measured(lambda info: time_of_day(info.oldest))
_NEWEST = _measured(lambda info: time_of_day(info.newest))
_AGE = _measured(lambda info: short_duration(info.age))


def compact(
    snapshot: Snapshot,
    width: int,
    *,
    ascii_only: bool = False,
    moving: Collection[str] | None = None,
    marks: Mapping[str, Sequence[str]] | None = None,
    order: TreeOrder = TreeOrder.tree,
    wanted: str = "",
    most: int | None = None,
    history: TrafficHistory = NO_HISTORY,
) -> CompactTree:
    """Return every tree as text with one line per frame, fitted to a width.

    Args:
        snapshot: Frames to draw.
        width: Width in cells.
        ascii_only: Whether to draw the tree lines in ASCII.
        moving: Frames of a robot description that a joint moves; None for other sources.
        marks: Ids of the doctor's findings about each frame.
        order: Order of the rows; tree lines are drawn only in the tree's own order.
        wanted: Text that the names of shown frames contain; in tree order, the ancestors of these
            frames are shown too.
        most: Maximum number of rows; None for all rows.
        history: Earlier rates and delays of each frame, drawn as small curves.
    """
    forest = grow(snapshot)
    rows = _ordered(forest, order, wanted)[:most]
    if moving is not None:
        rows = [_of_robot(branch, moving) for branch in rows]
    told = _caption(snapshot, moving)
    more = "~" if ascii_only else "…"
    drawing = _Drawing(rows, distinct(forest.info), width, ascii_only, order)
    longest = max(drawing.longest(drawing.guides), cell_len(told), LEAST_NAME)
    wished = min(longest, drawing.most)
    facts = _link_columns(rows, width, moving, marks or {})
    used = sum(one.width + GAP for one in facts if any(text for text, _ in one.cells))
    names = [one.info.frame for one in rows]
    columns = fit(
        [*facts, *history.columns(names, width - wished - used, ascii_only=ascii_only)],
        width,
        reserved=wished,
        longest=longest,
        more=more,
    )
    heading = [columns.heading(told)]
    if len(forest.roots) > 1:
        listed = ", ".join(visible(root) for root in forest.roots)
        text = middle_cut(f"{len(forest.roots)} separate trees: {listed}", width, more=more)
        heading.insert(0, Text(text, style="yellow"))
    lines = tuple(
        columns.row(
            place,
            drawing.first(
                branch, columns.first_width, marked=bool(_wrong(branch, marks or {})), more=more
            ),
        )
        for place, branch in enumerate(rows)
    )
    return CompactTree(tuple(heading), lines, drawing.is_cut)


def _of_robot(branch: Branch, moving: Collection[str]) -> Branch:
    """Return a row of a robot description, marked as static unless its frame is in `moving`."""
    info = branch.info
    return replace(branch, info=info._replace(is_static=info.frame not in moving))


def _caption(snapshot: Snapshot, moving: Collection[str] | None) -> str:
    """Return the text above a tree: time of the snapshot, or number of a robot's moving joints."""
    if moving is not None:
        return f"{len(moving)} of {max(len(snapshot.frames) - 1, 0)} joints move"
    zone = " UTC" if snapshot.now >= SIMULATED_BELOW else ""
    seen = f"at {time_of_day(snapshot.now)}{zone}"
    return f"at {time_of_day(snapshot.at)}, seen {seen}" if snapshot.at else seen


def _ordered(forest: Forest, order: TreeOrder, wanted: str) -> list[Branch]:
    rows = list(branches(forest))
    if wanted:
        found = {one.info.frame for one in rows if wanted.lower() in one.info.frame.lower()}
        if order is TreeOrder.tree:
            # Their ancestors are drawn too, or the guides would lead nowhere.
            for one in reversed(rows):
                if one.info.frame in found and one.info.parent is not None:
                    found.add(one.info.parent)
            return list(branches(_pruned(forest, found)))
        rows = [one for one in rows if one.info.frame in found]
    if order is not TreeOrder.tree:
        rows.sort(key=lambda one: _key(one.info, order))
    return rows


def _pruned(forest: Forest, kept: Collection[str]) -> Forest:
    children = {
        name: tuple(child for child in below if child in kept)
        for name, below in forest.children.items()
        if name in kept
    }
    roots = tuple(root for root in forest.roots if root in kept)
    return Forest(roots, forest.loops, children, {}, forest.info)


def _key(info: FrameInfo, order: TreeOrder) -> tuple[object, ...]:
    """Return the key by which frames are sorted: high rates or ages first, static frames last."""
    still = info.is_static or info.parent is None
    if order is TreeOrder.rate:
        return (still, -info.rate if info.samples > 1 else 0.0, info.frame)
    if order is TreeOrder.age:
        return (still, -info.age, info.frame)
    if order is TreeOrder.broadcaster:
        return (info.parent is None, info.authority or "", info.frame)
    return (info.frame,)


def _wrong(branch: Branch, marks: Mapping[str, Sequence[str]]) -> str:
    if branch.closes_loop:
        return f"a loop: parent is {visible(branch.info.parent or '-')}"
    ids = marks.get(branch.info.frame, ())
    if not ids:
        return ""
    return ids[0] if len(ids) == 1 else f"{ids[0]} +{len(ids) - 1}"


def _link_columns(
    rows: list[Branch],
    width: int,
    moving: Collection[str] | None,
    marks: Mapping[str, Sequence[str]],
) -> list[TableColumn]:
    """Return the columns with the facts of each frame's edge to its parent."""

    def cells(told: Told, style: str = "") -> list[Cell]:
        return [
            ("", "")
            if one.info.parent is None
            else (told(one.info), "dim" if one.info.is_static else style)
            for one in rows
        ]

    wrong = [(_wrong(one, marks), "yellow") for one in rows]
    last = TableColumn("wrong", wrong, caps=(max(12, width // 4),))
    if moving is not None:
        kinds = cells(lambda info: "fixed" if info.is_static else "moving")
        return [
            TableColumn("link", kinds, drop_order=2),
            TableColumn("joint", cells(_broadcaster), caps=BROADCASTERS, drop_order=1),
            last,
        ]
    ages = [
        (text, _age_style(one.info) if why or _is_late(one.info) else style)
        for one, (text, style), (why, _) in zip(rows, cells(_AGE), wrong, strict=True)
    ]
    rates = [
        (text, _age_style(one.info) if _has_stopped(one.info) else style)
        for one, (text, style) in zip(rows, cells(_rate), strict=True)
    ]
    return [
        TableColumn("broadcaster", cells(_broadcaster, "dim"), caps=BROADCASTERS, drop_order=4),
        TableColumn("rate", rates, align_right=True, drop_order=5),
        TableColumn("stored", cells(_STORED), align_right=True, drop_order=3),
        TableColumn("oldest", cells(_OLDEST, "dim"), align_right=True, drop_order=1),
        TableColumn("newest", cells(_NEWEST, "dim"), align_right=True, drop_order=2),
        TableColumn("age", ages, align_right=True, drop_order=6),
        last,
    ]


class _Drawing:
    """First column of a compact tree: the tree lines and the names of the frames."""

    def __init__(
        self,
        rows: list[Branch],
        names: Mapping[str, str],
        width: int,
        ascii_only: bool,
        order: TreeOrder,
    ) -> None:
        self.rows = rows
        self.names = names
        self.is_flat = order is not TreeOrder.tree
        self.most = max(LEAST_NAME, int(width * SHARE))
        kinds = ASCII if ascii_only else UNICODE
        self.guides = next((one for one in kinds if self.longest(one) <= self.most), kinds[-1])
        self.is_cut = False

    def first(self, branch: Branch, width: int, *, marked: bool, more: str) -> Text:
        """Return the tree lines and the name of one frame, cut to `width` cells."""
        lead = "" if self.is_flat else self.guides.lead(branch, self.most, more)
        name = self.names[branch.info.frame]
        shown = middle_cut(name, max(1, width - cell_len(lead)), more=more)
        self.is_cut = self.is_cut or shown != name
        style = "yellow" if marked else _style(branch.info)
        return Text().append(lead, style="dim").append(shown, style=style)

    def longest(self, guides: Guides) -> int:
        """Return the width in cells of the longest name with its tree lines."""
        return max(
            (
                cell_len(self.names[one.info.frame])
                + (0 if self.is_flat else min(guides.width(one.depth), self.most))
                for one in self.rows
            ),
            default=LEAST_NAME,
        )


def _has_stopped(info: FrameInfo) -> bool:
    return not (info.rate or info.samples < 2 or info.is_static or info.parent is None)


def _is_late(info: FrameInfo) -> bool:
    """Whether a moving frame is no longer published, or the age of its newest sample is high."""
    is_moving = info.parent is not None and not info.is_static
    return is_moving and (_has_stopped(info) or theme.is_stale(as_seconds(info.age)))


def _age_style(info: FrameInfo) -> str:
    return "red" if as_seconds(info.age) > FRAME_TIMEOUT else "yellow"
