"""Every tree of frames in a terminal's width: one line a frame, whatever the width.

What does not fit goes one by one: first the columns that say least, of the broadcasters' names
their middle, then wide guides, then the middle of the frames' names.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from rich.cells import cell_len
from rich.text import Text

from tftool.frames.sample import FrameInfo, Snapshot
from tftool.stamps import Stamp, as_seconds, display
from tftool.views.branches import ASCII, UNICODE, Branch, Guides, branches
from tftool.views.escaping import distinct, visible
from tftool.views.fixed_width import middle_cut
from tftool.views.forest import Forest, grow
from tftool.views.short_numbers import short_duration, short_rate
from tftool.views.theme import FRAME_TIMEOUT

GAP = 2
"""Cells between two columns."""

LEAST_NAME = 16
"""Cells that names get, and what is before them, before a column is given up for them."""

SHARE = 0.6
"""Of the width, what names and guides may take before guides shrink and names are cut."""

BROADCASTERS = (24, 16, 11)
"""How many cells names of broadcasters get; fewer rather than none."""

STOPPED = "edge-stopped"


class TreeOrder(StrEnum):
    """What decides which frame stands above which."""

    tree = "tree"
    name = "name"
    rate = "rate"
    age = "age"
    broadcaster = "broadcaster"


@dataclass(frozen=True, slots=True)
class CompactTree:
    """Lines of a terminal.

    Attributes:
        heading: Above the frames: when, how many trees, and what the columns are.
        rows: One a frame.
        is_cut: Whether a name is not there in full.
    """

    heading: tuple[Text, ...]
    rows: tuple[Text, ...]
    is_cut: bool


@dataclass(frozen=True, slots=True)
class _Column:
    heading: str
    cell: Callable[[FrameInfo], str]
    stands_right: bool = True


def _rate(info: FrameInfo) -> str:
    if info.is_static:
        return "static"
    return "-" if info.samples < 2 else short_rate(info.rate)


def _measured(cell: Callable[[FrameInfo], str]) -> Callable[[FrameInfo], str]:
    return lambda info: "" if info.is_static else cell(info)


_BROADCASTER = _Column("broadcaster", lambda info: visible(info.authority or "-"), False)
_RATE = _Column("rate", _rate)
_KEPT = _Column("kept", _measured(lambda info: short_duration(info.buffer_length)))
_OLDEST = _Column("oldest", _measured(lambda info: display(info.oldest)))
_NEWEST = _Column("newest", _measured(lambda info: display(info.newest)))
_AGE = _Column("age", _measured(lambda info: short_duration(info.age)))

COLUMNS = (_BROADCASTER, _RATE, _KEPT, _OLDEST, _NEWEST, _AGE)
"""Of frames that are sent, from left to right."""

_GIVEN_UP = (_OLDEST, _NEWEST, _KEPT, _BROADCASTER, _RATE, _AGE)
"""The same in the order in which they go as the width shrinks."""


def compact(
    snapshot: Snapshot,
    width: int,
    *,
    ascii_only: bool = False,
    moving: Collection[str] | None = None,
    marks: Mapping[str, Sequence[str]] | None = None,
    order: TreeOrder = TreeOrder.tree,
    wanted: str = "",
) -> CompactTree:
    """Draw every tree, one line a frame.

    Args:
        snapshot: What to draw.
        width: Columns there are.
        ascii_only: Whether to keep to ASCII for the guides.
        moving: Of a robot description, the frames whose joint moves; None for other frames.
        marks: What is wrong with frames: ids of the doctor's checks.
        order: What decides the order; any but the tree's own leaves out guides.
        wanted: Only frames whose name has these letters, and in the tree what they hang from.
    """
    forest = grow(snapshot)
    rows = _ordered(forest, order, wanted)
    if moving is not None:
        rows = [_of_robot(branch, moving) for branch in rows]
    columns: tuple[_Column, ...] = COLUMNS
    given_up: tuple[_Column, ...] = _GIVEN_UP
    if moving is not None:
        kind = _Column("link", lambda info: "moving" if info.frame in moving else "fixed", False)
        joint = _Column("joint", _BROADCASTER.cell, False)
        columns, given_up = (kind, joint), (joint, kind)
    told = _told(snapshot, moving)
    drawing = _Drawing(rows, distinct(forest.info), width, ascii_only, order, told)
    wrong = {branch.info.frame: _wrong(branch, marks or {}) for branch in rows}
    if any(wrong.values()):
        wrong_column = _Column("wrong", lambda info: wrong[info.frame], False)
        columns = (*columns, wrong_column)
    drawing.choose(columns, given_up)
    lines = tuple(drawing.line(branch, marked=bool(wrong[branch.info.frame])) for branch in rows)
    heading = [drawing.heading()]
    if len(forest.roots) > 1:
        listed = ", ".join(visible(root) for root in forest.roots)
        text = middle_cut(f"{len(forest.roots)} separate trees: {listed}", width, more=drawing.more)
        heading.insert(0, Text(text, style="yellow"))
    return CompactTree(tuple(heading), lines, drawing.is_cut)


def _of_robot(branch: Branch, moving: Collection[str]) -> Branch:
    """The same frame; in a description nothing is sent, and a joint that moves counts."""
    info = branch.info
    return replace(branch, info=info._replace(is_static=info.frame not in moving))


def moment(stamp: Stamp) -> str:
    """A stamp where the drawing has little room: to the millisecond."""
    return f"{as_seconds(stamp):.3f}"


def _told(snapshot: Snapshot, moving: Collection[str] | None) -> str:
    """What the drawing is of, in few words."""
    if moving is not None:
        return f"{len(moving)} of {len(snapshot.frames) - 1} joints move"
    if snapshot.at:
        return f"at {moment(snapshot.at)}, seen at {moment(snapshot.now)}"
    return f"at {moment(snapshot.now)}"


def _ordered(forest: Forest, order: TreeOrder, wanted: str) -> list[Branch]:
    rows = list(branches(forest))
    if wanted:
        found = {one.info.frame for one in rows if wanted.lower() in one.info.frame.lower()}
        if order is TreeOrder.tree:
            # What they hang from is drawn too, or the guides would lead nowhere.
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
    """What frames are sorted by: what is fast, or old, comes first, and statics last."""
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
        return f"a loop: hangs from {visible(branch.info.parent or '-')}"
    ids = marks.get(branch.info.frame, ())
    if not ids:
        return ""
    return ids[0] if len(ids) == 1 else f"{ids[0]} +{len(ids) - 1}"


class _Drawing:
    """Which columns there is room for, and the lines that they make."""

    def __init__(
        self,
        rows: list[Branch],
        names: Mapping[str, str],
        width: int,
        ascii_only: bool,
        order: TreeOrder,
        told: str,
    ) -> None:
        self.told = told
        self.rows = rows
        self.names = names
        self.width = width
        self.is_flat = order is not TreeOrder.tree
        self.more = "~" if ascii_only else "…"
        self.kinds = ASCII if ascii_only else UNICODE
        self.guides = self.kinds[0]
        self.columns: tuple[_Column, ...] = ()
        self.cells: dict[str, list[str]] = {}
        self.widths: list[int] = []
        self.room = width
        self.is_cut = False

    def choose(self, columns: tuple[_Column, ...], given_up: tuple[_Column, ...]) -> None:
        """Choose guides and columns so that every line fits."""
        most = max(LEAST_NAME, int(self.width * SHARE))
        self.guides = next(
            (one for one in self.kinds if self._longest(one) <= most), self.kinds[-1]
        )
        longest = max(self._longest(self.guides), cell_len(self.told), LEAST_NAME)
        wanted = min(longest, most)
        going = list(given_up)
        cells = {
            column.heading: [
                "" if one.info.parent is None and column.heading != "wrong"
                else column.cell(one.info)
                for one in self.rows
            ]
            for column in columns
        }  # fmt: skip
        # A column in which nothing stands is none.
        columns = tuple(one for one in columns if any(cells[one.heading]))
        limits = dict.fromkeys(cells, self.width)
        limits["wrong"] = max(10, self.width // 4)
        while True:
            widths = [
                min(limits[one.heading], max(map(cell_len, [one.heading, *cells[one.heading]])))
                for one in columns
            ]
            room = self.width - sum(widths) - GAP * len(widths)
            if room >= wanted or not going:
                break
            column = going[0]
            tighter = [one for one in BROADCASTERS if one < limits[column.heading]]
            if column in columns and not column.stands_right and tighter:
                limits[column.heading] = tighter[0]
                continue
            del going[0]
            columns = tuple(one for one in columns if one is not column)
        self.columns, self.widths, self.cells = columns, widths, cells
        self.room = min(max(1, room), longest)
        self._at = {one.info.frame: place for place, one in enumerate(self.rows)}

    def heading(self) -> Text:
        """What the drawing is of, and what its columns are."""
        line = self._fill(middle_cut(self.told, self.room, more=self.more), self.room)
        for column, width in zip(self.columns, self.widths, strict=True):
            line += " " * GAP + self._cell(column, column.heading, width)
        return Text(line.rstrip(), style="dim")

    def line(self, branch: Branch, *, marked: bool) -> Text:
        """One frame."""
        info = branch.info
        lead = self._lead(branch)
        name = self.names[info.frame]
        shown = middle_cut(name, max(1, self.room - cell_len(lead)), more=self.more)
        self.is_cut = self.is_cut or shown != name
        line = Text(no_wrap=True, overflow="crop")
        line.append(lead, style="dim")
        line.append(shown, style=_style(info, marked))
        line.append(" " * (self.room - cell_len(lead) - cell_len(shown)))
        for column, width in zip(self.columns, self.widths, strict=True):
            cell = self.cells[column.heading][self._at[info.frame]]
            line.append(" " * GAP)
            line.append(self._cell(column, cell, width), style=_cell_style(column, info, marked))
        line.rstrip()
        return line

    def _lead(self, branch: Branch) -> str:
        if self.is_flat or not branch.turns:
            return ""
        depth = len(branch.turns)
        if self.guides.width(depth) <= max(4, int(self.width * SHARE)):
            return self.guides.lead(branch.turns)
        # So deep that guides alone would fill the line: a number says where it hangs.
        return f"{depth}{self.more}{self.guides.lead(branch.turns[-1:])}"

    def _longest(self, guides: Guides) -> int:
        """How many cells the longest name takes with what is before it."""
        return max(
            (
                cell_len(self.names[one.info.frame])
                + (
                    0
                    if self.is_flat
                    else min(guides.width(len(one.turns)), int(self.width * SHARE))
                )
                for one in self.rows
            ),
            default=LEAST_NAME,
        )

    def _cell(self, column: _Column, text: str, width: int) -> str:
        shown = middle_cut(text, width, more=self.more)
        if column.stands_right:
            return " " * (width - cell_len(shown)) + shown
        return self._fill(shown, width)

    @staticmethod
    def _fill(text: str, width: int) -> str:
        return text + " " * (width - cell_len(text))


def _style(info: FrameInfo, marked: bool) -> str:
    if marked:
        return "yellow"
    if info.parent is None:
        return "bold"
    return "cyan" if info.is_static else ""


def _cell_style(column: _Column, info: FrameInfo, marked: bool) -> str:
    if column.heading == "wrong":
        return "yellow"
    if column is _AGE and marked:
        return "red" if as_seconds(info.age) > FRAME_TIMEOUT else "yellow"
    return "dim" if column in (_BROADCASTER, _OLDEST, _NEWEST) or info.is_static else ""
