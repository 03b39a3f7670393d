"""Order of the frames in a drawing of trees, with the tree lines and the facts of each frame.

The frames in a buffer form trees, but data from other sources may contain loops. So drawings also
end if a frame is its own ancestor.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from tftool.base.stamps import NANOSECONDS, Stamp, display
from tftool.buffer.sample import FrameInfo, Snapshot


@dataclass(frozen=True, slots=True)
class Forest:
    """Frames to draw, as trees.

    Attributes:
        roots: Frames without a parent, and one frame of every loop.
        loops: The roots that have a parent, because they are in a loop. The line to this parent is
            not drawn.
        children: Children to draw of every drawn frame, in order of registration.
        hidden: Number of omitted frames below a drawn frame, by the name of the drawn frame.
        info: Every frame of the snapshot by its name.
    """

    roots: tuple[str, ...]
    loops: tuple[str, ...]
    children: dict[str, tuple[str, ...]]
    hidden: dict[str, int]
    info: dict[str, FrameInfo]

    @property
    def left_out(self) -> int:
        """Number of frames that are not drawn."""
        return len(self.info) - len(self.children)


def grow(snapshot: Snapshot, *, most: int | None = None) -> Forest:
    """Arrange a snapshot's frames in trees; keep the `most` frames nearest to the roots."""
    info = {frame.frame: frame for frame in snapshot.frames}
    children: dict[str, list[str]] = {name: [] for name in info}
    roots = []
    for name, frame in info.items():
        if frame.parent is None or frame.parent not in info:
            roots.append(name)
        else:
            children[frame.parent].append(name)

    order = _walk(roots, children)
    loops = []
    reached = set(order)
    for name in info:
        if name not in reached:
            # This frame is in a loop or below one: go up until a frame of the loop repeats.
            top, passed = name, set[str]()
            while top not in passed:
                passed.add(top)
                parent = info[top].parent
                assert parent is not None
                top = parent
            loops.append(top)
            # The edge that closes the loop is cut here, so that the rest is a tree.
            above = info[top].parent
            assert above is not None
            children[above].remove(top)
            reached.update(_walk([top], children))
    if loops:
        order = _walk([*roots, *loops], children)

    kept = set(order if most is None else order[:most])
    sizes = dict.fromkeys(info, 1)
    for name in reversed(order):
        sizes[name] += sum(sizes[child] for child in children[name])
    drawn = {
        name: tuple(child for child in children[name] if child in kept)
        for name in order
        if name in kept
    }
    hidden = {
        name: missing
        for name in drawn
        if (missing := sum(sizes[child] for child in children[name] if child not in kept))
    }
    return Forest(
        roots=tuple(name for name in [*roots, *loops] if name in kept),
        loops=tuple(name for name in loops if name in kept),
        children=drawn,
        hidden=hidden,
        info=info,
    )


def _walk(roots: list[str], children: dict[str, list[str]]) -> list[str]:
    """Return the roots, then all frames below the roots, level by level; each frame once."""
    order = list(roots)
    for name in order:  # grows while it is walked
        order.extend(children[name])
    return order


DEEPEST = 64
"""Number of levels that are indented; a deeper frame has its level as a number."""


@dataclass(frozen=True, slots=True)
class Guides:
    """Texts that draw the lines of a tree before names, such as "├── ", all of one width.

    Attributes:
        child: Text before a frame with later siblings.
        last: Text before the last child of a frame.
        past: Text below an ancestor with later siblings.
        blank: Text below an ancestor that is a last child.
        gap: Text between the lines and the name.
    """

    child: str
    last: str
    past: str
    blank: str
    gap: str = ""

    def lead(self, branch: "Branch", most: int | None = None, more: str = "…") -> str:
        """Return the text before a frame's name: tree lines or, for a deep frame, its depth.

        Args:
            branch: Frame with its position in the tree.
            most: Maximum width of the tree lines in cells; None for the width of `DEEPEST` levels.
            more: Sign after the depth, in place of the omitted lines.
        """
        if not branch.depth:
            return ""
        own = (self.last if branch.are_last[-1] else self.child) + self.gap
        if branch.depth > DEEPEST or (most is not None and self.width(branch.depth) > most):
            return f"{branch.depth}{more}{own}"
        return "".join(self.blank if last else self.past for last in branch.are_last[:-1]) + own

    def width(self, depth: int) -> int:
        """Return the width in cells of the tree lines before the name of a frame at a depth."""
        return len(self.child) * depth + len(self.gap) if depth else 0


UNICODE = (
    Guides("├── ", "└── ", "│   ", "    "),
    Guides("├─ ", "└─ ", "│  ", "   "),
    Guides("├ ", "└ ", "│ ", "  "),
    Guides("├", "└", "│", " ", " "),
)
"""Guides in box-drawing characters, from wide to narrow."""

ASCII = (
    Guides("|-- ", "`-- ", "|   ", "    "),
    Guides("|- ", "`- ", "|  ", "   "),
    Guides("| ", "` ", "| ", "  "),
    Guides("|", "`", "|", " ", " "),
)


@dataclass(frozen=True, slots=True)
class Branch:
    """Frame with its position in the tree.

    Attributes:
        info: The frame.
        depth: Number of levels below the root.
        are_last: Whether each frame on the path from the root's child to this frame is the last
            child of its parent; for a deep frame, only the last `DEEPEST` values.
        closes_loop: Whether the line to this frame's parent closes a loop, and so is not drawn.
    """

    info: FrameInfo
    depth: int
    are_last: tuple[bool, ...]
    closes_loop: bool


def branches(forest: Forest) -> Iterator[Branch]:
    """Yield every frame of a forest with its position, parents before children."""
    waiting: list[tuple[str, int, tuple[bool, ...]]]
    waiting = [(root, 0, ()) for root in reversed(forest.roots)]
    loops = frozenset(forest.loops)
    while waiting:
        frame, depth, are_last = waiting.pop()
        yield Branch(forest.info[frame], depth, are_last, frame in loops)
        for place, child in enumerate(reversed(forest.children[frame])):
            waiting.append((child, depth + 1, (*are_last, place == 0)[-DEEPEST:]))


@dataclass(frozen=True, slots=True)
class Facts:
    """Broadcaster, rate, and stamps of a frame as text; numbers have no trailing zeros."""

    broadcaster: str
    rate: str
    buffer_length: str
    newest: str
    oldest: str

    def lines(self, *, units: bool) -> tuple[str, str, str, str, str]:
        """Return five lines with the labels of rqt_tf_tree; `units` adds "Hz" and "s"."""
        hertz, second = (" Hz", " s") if units else ("", "")
        return (
            f"Broadcaster: {self.broadcaster}",
            f"Average rate: {self.rate}{hertz}",
            f"Buffer length: {self.buffer_length}{second}",
            f"Most recent transform: {self.newest}{second}",
            f"Oldest transform: {self.oldest}{second}",
        )


def facts(frame: FrameInfo) -> Facts:
    """Format broadcaster, rate and stamps of a frame's transform, as rqt_tf_tree does."""
    return Facts(
        broadcaster=frame.authority or "no recorded authority",
        rate=str(float(f"{frame.rate:.3f}")),
        buffer_length=str(float(f"{frame.buffer_length / NANOSECONDS:.3f}")),
        newest=str(float(display(frame.newest))),
        oldest=str(float(display(frame.oldest))),
    )


def recorded_at(now: Stamp) -> str:
    """Return the line of a drawing that shows the time of the snapshot."""
    whole, rest = divmod(now, NANOSECONDS)
    return f"Recorded at time: {whole + rest / 1e9}"
