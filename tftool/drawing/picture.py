"""Layout of a snapshot's trees on a sheet: cards, edges and a legend, as plain shapes.

Each frame has a card with rqt_tf_tree's five facts about the edge to its parent. Trees are side by
side. Many leaves of one parent are drawn as a group, so that three hundred frames stay readable.
`svg` and `pdf` write the shapes to files.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass, field, replace
from typing import Literal

from tftool.base.plain_text import count, distinct, short_duration, visible
from tftool.base.stamps import Duration
from tftool.buffer.sample import Snapshot
from tftool.drawing.drawn_forest import Forest, facts, grow, recorded_at
from tftool.drawing.pdf import fit, width
from tftool.drawing.tree_layout import Item, tidy

MOST_DRAWN = 1000
"""Most frames in one picture; with more it would not be readable."""

FOLD = 8
"""Most leaves of one parent that are not drawn as a group."""

CARD_HEIGHT = 92.0
ROOT_HEIGHT = 36.0
STATIC_HEIGHT = 46.0
LEAST_WIDTH = 132.0
MOST_WIDTH = 268.0
PADDING = 12.0
GAP = 18.0
TREE_GAP = 56.0
GROUP_GAP = 12.0
DOWN_GAP = 46.0
ACROSS_GAP = 64.0
MARGIN = 28.0
NAME_SIZE = 13.0
FACT_SIZE = 9.5
WIDE_ENOUGH = 1800.0
"""Width in points above which trees grow to the right instead of downwards, if that fits better."""

Kind = Literal["root", "dynamic", "stale", "static", "group", "more"]


@dataclass(frozen=True, slots=True)
class Box:
    """Rectangle with rounded corners; `title` is the full name of its frame."""

    x: float
    y: float
    width: float
    height: float
    kind: Kind
    title: str = ""


@dataclass(frozen=True, slots=True)
class Text:
    """Line of text whose left end on the baseline is (x, y); `room` is its maximum width."""

    x: float
    y: float
    text: str
    size: float
    kind: Literal["name", "fact", "note"]
    room: float = math.inf


@dataclass(frozen=True, slots=True)
class Curve:
    """Curve from a frame at (x0, y0) to its child; the ends are vertical (`down`) or horizontal."""

    x0: float
    y0: float
    x1: float
    y1: float
    static: bool
    down: bool

    @property
    def bends(self) -> tuple[float, ...]:
        """Coordinates of the control points and the end of the curve as a cubic Bézier curve."""
        if self.down:
            half = (self.y0 + self.y1) / 2
            return self.x0, half, self.x1, half, self.x1, self.y1
        half = (self.x0 + self.x1) / 2
        return half, self.y0, half, self.y1, self.x1, self.y1


@dataclass(frozen=True, slots=True)
class Picture:
    """Shapes on a sheet, in points, x to the right and y down; `left_out` counts omitted frames."""

    width: float
    height: float
    links: tuple[Curve, ...]
    boxes: tuple[Box, ...]
    texts: tuple[Text, ...]
    left_out: int
    title: str


def lay_out(snapshot: Snapshot, *, stale: Collection[str] = ()) -> Picture:
    """Return the picture of a snapshot's trees, with at most `MOST_DRAWN` frames.

    Args:
        snapshot: Frames to draw.
        stale: Frames that are not published any more; the cards of these frames show the age.
    """
    forest = grow(snapshot, most=MOST_DRAWN)
    sheet = _Sheet(forest, _cards(forest, stale), down=True)
    if sheet.width > WIDE_ENOUGH:
        across = _Sheet(forest, _cards(forest, stale), down=False)
        if across.squareness() < sheet.squareness():
            sheet = across
    return sheet.finish(snapshot)


@dataclass(frozen=True, slots=True)
class _Card:
    kind: Kind
    name: str
    lines: tuple[str, ...]
    width: float
    height: float
    title: str


def _cards(forest: Forest, stale: Collection[str]) -> dict[str, _Card]:
    """Return the card (box with a frame's facts) of each drawn frame, by the frame's name.

    If the descendants of a frame are omitted, a further card shows their number. The key of this
    card is the frame's name, a newline and "rest".
    """
    cards = {}
    shown = distinct(forest.children)
    room = MOST_WIDTH - 2 * PADDING
    for name in forest.children:
        frame = forest.info[name]
        root = frame.parent is None
        # A static edge has no rate and no age: tf2 counts 10000 Hz and 0 s for it.
        told = () if root else facts(frame).lines(units=True)[: 1 if frame.is_static else None]
        if name in stale:
            told = tuple(_aged(line, frame.age) for line in told)
        lines = tuple(fit(visible(line), FACT_SIZE, room) for line in told)
        written = fit(shown[name], NAME_SIZE, room, bold=True)
        kind: Kind = "root" if root else "static" if frame.is_static else "dynamic"
        kind = "stale" if kind == "dynamic" and name in stale else kind
        cards[name] = _card(kind, written, lines, shown[name])
    for name, missing in forest.hidden.items():
        plural = "" if missing == 1 else "s"
        below = fit(f"frame{plural} below {shown[name]}", FACT_SIZE, room)
        lines = (below, "left out of this picture")
        cards[_rest(name)] = _card("more", f"+ {missing}", lines, "")
    return cards


def _aged(line: str, age: Duration) -> str:
    """Add the age to the fact about the newest sample; return other facts unchanged."""
    newest = line.startswith("Most recent transform")
    return f"{line}, {short_duration(age)} old" if newest else line


def _rest(name: str) -> str:
    # The newline keeps this key apart from the names of frames.
    return f"{name}\nrest"


def _card(kind: Kind, name: str, lines: tuple[str, ...], title: str) -> _Card:
    widest = max([width(name, NAME_SIZE, bold=True), *(width(line, FACT_SIZE) for line in lines)])
    if kind == "static":
        widest = max(widest, width(name, NAME_SIZE, bold=True) + width("static", FACT_SIZE) + 10)
    breadth = min(MOST_WIDTH, max(LEAST_WIDTH, widest + 2 * PADDING))
    height = {"root": ROOT_HEIGHT, "static": STATIC_HEIGHT}.get(kind, CARD_HEIGHT)
    return _Card(kind, name, lines, breadth, height, title)


@dataclass(frozen=True, slots=True)
class _Group:
    """Leaves of one parent, arranged in columns of width `cell` and rows of height `row`."""

    parent: str
    members: tuple[str, ...]
    columns: int
    cell: float
    row: float
    width: float
    height: float


@dataclass
class _Sheet:
    """Layout of the trees in one direction, downwards or to the right."""

    forest: Forest
    cards: dict[str, _Card]
    down: bool
    width: float = 0.0
    height: float = 0.0
    boxes: list[Box] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    links: list[Curve] = field(default_factory=list)

    def __post_init__(self) -> None:
        widest = max((card.width for card in self.cards.values()), default=LEAST_WIDTH)
        tallest = max(
            (card.height for card in self.cards.values() if card.kind != "root"),
            default=ROOT_HEIGHT,
        )
        self.pitch = tallest + DOWN_GAP if self.down else widest + ACROSS_GAP
        self.subjects: list[_Card | _Group] = []
        items = self._items()
        roots = tuple(range(len(self.forest.roots)))
        places = tidy(items, roots, gap=GAP, tree_gap=TREE_GAP)
        # A root's card is lower than the others, so the first level takes less room.
        spare = tallest - ROOT_HEIGHT if self.down and not self.forest.loops else 0.0
        corners = []
        for subject, place in zip(self.subjects, places, strict=True):
            if self.down:
                x, y = place.middle - subject.width / 2, place.level * self.pitch
                y -= spare if place.level else 0.0
            else:
                x, y = place.level * self.pitch, place.middle - subject.height / 2
            corners.append((x, y))
            self.width = max(self.width, x + subject.width)
            self.height = max(self.height, y + subject.height)
        self._items_placed = (items, corners)

    def squareness(self) -> float:
        """Return how much the sheet's aspect ratio differs from a screen's ratio of 1.6."""
        return abs(math.log(self.width / self.height / 1.6))

    def _items(self) -> list[Item]:
        """Return cards and groups as items of the tree layout, roots first."""
        self.subjects = [self.cards[name] for name in self.forest.roots]
        names: list[str | None] = list(self.forest.roots)
        hanging: list[tuple[int, ...]] = []
        at = 0
        while at < len(self.subjects):  # grows while it is walked
            name = names[at]
            first = len(self.subjects)
            if name is not None:
                for subject, own_name in self._below(name):
                    self.subjects.append(subject)
                    names.append(own_name)
            hanging.append(tuple(range(first, len(self.subjects))))
            at += 1
        return [
            Item(
                subject.width if self.down else subject.height,
                children,
                self._levels(subject),
            )
            for subject, children in zip(self.subjects, hanging, strict=True)
        ]

    def _levels(self, subject: _Card | _Group) -> int:
        if isinstance(subject, _Card):
            return 1
        if self.down:
            return math.ceil((subject.height + DOWN_GAP) / self.pitch)
        return math.ceil((subject.width + ACROSS_GAP) / self.pitch)

    def _below(self, name: str) -> list[tuple[_Card | _Group, str | None]]:
        """Return the cards and groups below a frame, each with a frame's name or None.

        The name is the name of the card's frame. A group of leaves, and the card that shows the
        number of omitted frames, have None.
        """
        children = [*self.forest.children[name]]
        if name in self.forest.hidden:
            children.append(_rest(name))
        leaves = tuple(
            child
            for child in children
            if not self.forest.children.get(child) and child not in self.forest.hidden
        )
        if len(leaves) <= FOLD:
            return [
                (self.cards[child], child if child in self.forest.children else None)
                for child in children
            ]
        gathered = set(leaves)
        below: list[tuple[_Card | _Group, str | None]] = []
        for child in children:
            if child not in gathered:
                below.append((self.cards[child], child))
            elif child == leaves[0]:
                below.append((self._group(name, leaves), None))
        return below

    def _group(self, parent: str, members: tuple[str, ...]) -> _Group:
        cell = max(self.cards[name].width for name in members)
        row = max(self.cards[name].height for name in members)
        columns = math.ceil(math.sqrt(1.6 * len(members) * row / cell))
        rows = math.ceil(len(members) / columns)
        return _Group(
            parent,
            members,
            columns,
            cell,
            row,
            width=columns * (cell + GROUP_GAP) + GROUP_GAP,
            height=rows * (row + GROUP_GAP) + GROUP_GAP,
        )

    def finish(self, snapshot: Snapshot) -> Picture:
        """Add all shapes and the legend to the sheet; return the picture."""
        notes = self._notes(snapshot)
        top = MARGIN + 40.0 + 14.0 * len(notes) + 18.0
        items, corners = self._items_placed
        corners = [(x + MARGIN, y + top) for x, y in corners]
        for index, (subject, (x, y)) in enumerate(zip(self.subjects, corners, strict=True)):
            for child in items[index].children:
                self._link(subject, (x, y), self.subjects[child], corners[child])
            if isinstance(subject, _Card):
                self._draw_card(subject, x, y)
            else:
                self._draw_group(subject, x, y)

        legend_width = self._legend(snapshot, notes)
        return Picture(
            width=max(self.width, legend_width) + 2 * MARGIN,
            height=top + self.height + MARGIN,
            links=tuple(self.links),
            boxes=tuple(self.boxes),
            texts=tuple(self.texts),
            left_out=self.forest.left_out,
            title=recorded_at(snapshot.now),
        )

    def _link(
        self,
        parent: _Card | _Group,
        parent_at: tuple[float, float],
        child: _Card | _Group,
        child_at: tuple[float, float],
    ) -> None:
        if isinstance(child, _Card):
            static = child.kind == "static"
        else:
            static = all(self.cards[name].kind == "static" for name in child.members)
        x0, y0 = parent_at
        x1, y1 = child_at
        if self.down:
            x0, y0, x1 = x0 + parent.width / 2, y0 + parent.height, x1 + child.width / 2
        else:
            x0, y0, y1 = x0 + parent.width, y0 + parent.height / 2, y1 + child.height / 2
        self.links.append(Curve(x0, y0, x1, y1, static, self.down))

    def _draw_card(self, card: _Card, x: float, y: float) -> None:
        self.boxes.append(Box(x, y, card.width, card.height, card.kind, card.title))
        if card.kind == "root":
            indent = (card.width - width(card.name, NAME_SIZE, bold=True)) / 2
            room = card.width - 2 * indent
            self.texts.append(Text(x + indent, y + 22.5, card.name, NAME_SIZE, "name", room))
            return
        room = card.width - 2 * PADDING
        mark = width("static", FACT_SIZE)
        beside = room - mark - 10 if card.kind == "static" else room
        self.texts.append(Text(x + PADDING, y + 20.0, card.name, NAME_SIZE, "name", beside))
        if card.kind == "static":
            end = x + card.width - PADDING - mark
            self.texts.append(Text(end, y + 20.0, "static", FACT_SIZE, "note", mark))
        for number, line in enumerate(card.lines):
            baseline = y + 35.0 + 12.0 * number
            self.texts.append(Text(x + PADDING, baseline, line, FACT_SIZE, "fact", room))

    def _draw_group(self, group: _Group, x: float, y: float) -> None:
        self.boxes.append(Box(x, y, group.width, group.height, "group"))
        for number, name in enumerate(group.members):
            row, column = divmod(number, group.columns)
            left = x + GROUP_GAP + column * (group.cell + GROUP_GAP)
            top = y + GROUP_GAP + row * (group.row + GROUP_GAP)
            card = self.cards[name]
            same_size = replace(card, width=group.cell, height=group.row)
            self._draw_card(same_size, left, top)

    def _notes(self, snapshot: Snapshot) -> list[str]:
        frames = len(snapshot.frames)
        if not frames:
            return ["No tf data received"]
        trees = len(self.forest.roots)
        notes = [f"{count(frames, 'frame')} in {count(trees, 'tree')}"]
        if self.forest.left_out:
            notes.append(
                f"{count(frames - self.forest.left_out, 'frame')} shown, "
                f"{self.forest.left_out:,} left out: those farthest from their root"
            )
        for name in self.forest.loops:
            parent = self.forest.info[name].parent or ""
            notes.append(
                f"A loop: the parent of {fit(visible(name), FACT_SIZE, 200)} is "
                f"{fit(visible(parent), FACT_SIZE, 200)}, one of its own descendants; "
                "the line between them is not drawn"
            )
        return notes

    def _legend(self, snapshot: Snapshot, notes: list[str]) -> float:
        """Add the legend's text to the sheet; return the legend's width."""
        head = recorded_at(snapshot.now)
        self.texts.append(Text(MARGIN, MARGIN + 12.0, head, NAME_SIZE, "name"))
        if snapshot.at:
            shown = f"shown: {recorded_at(snapshot.at).rpartition(' ')[2]}"
            start = MARGIN + width(head, NAME_SIZE, bold=True) + 12.0
            self.texts.append(Text(start, MARGIN + 12.0, shown, FACT_SIZE, "note"))
        line = MARGIN + 27.0
        x = MARGIN
        for static, word in ((False, "dynamic"), (True, "static")):
            self.links.append(Curve(x, line, x + 34.0, line, static, down=False))
            self.texts.append(Text(x + 41.0, line + 3.2, word, FACT_SIZE, "fact"))
            x += 100.0
        for number, note in enumerate(notes):
            self.texts.append(Text(MARGIN, MARGIN + 46.0 + 14.0 * number, note, FACT_SIZE, "fact"))
        return max([240.0, *(width(note, FACT_SIZE) for note in notes)])
