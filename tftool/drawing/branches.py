"""A forest as rows from top to bottom, and the guides that are drawn before their names."""

from collections.abc import Iterator
from dataclasses import dataclass

from tftool.buffer.sample import FrameInfo
from tftool.drawing.drawn_forest import Forest


@dataclass(frozen=True, slots=True)
class Guides:
    """The four pieces a tree is drawn with, all equally wide, and what stands before a name."""

    child: str
    last: str
    past: str
    blank: str
    gap: str = ""

    def lead(self, turns: tuple[bool, ...]) -> str:
        """What is drawn before a name.

        Args:
            turns: From the root's child down to the frame: whether each is the last of its
                siblings; empty for a root.
        """
        if not turns:
            return ""
        above = "".join(self.blank if last else self.past for last in turns[:-1])
        return above + (self.last if turns[-1] else self.child) + self.gap

    def width(self, depth: int) -> int:
        """How many cells stand before the name of a frame so far below its root."""
        return len(self.child) * depth + len(self.gap) if depth else 0


UNICODE = (
    Guides("├── ", "└── ", "│   ", "    "),
    Guides("├─ ", "└─ ", "│  ", "   "),
    Guides("├ ", "└ ", "│ ", "  "),
    Guides("├", "└", "│", " ", " "),
)
"""From wide to narrow."""

ASCII = (
    Guides("|-- ", "`-- ", "|   ", "    "),
    Guides("|- ", "`- ", "|  ", "   "),
    Guides("| ", "` ", "| ", "  "),
    Guides("|", "`", "|", " ", " "),
)


@dataclass(frozen=True, slots=True)
class Branch:
    """One frame where it stands in its tree.

    Attributes:
        info: The frame.
        turns: What `Guides.lead` draws its guides by.
        closes_loop: Whether its own link closes a loop, which is cut there.
    """

    info: FrameInfo
    turns: tuple[bool, ...]
    closes_loop: bool


def branches(forest: Forest) -> Iterator[Branch]:
    """Every frame, parents before children; a deep tree needs no deep stack."""
    waiting: list[tuple[str, tuple[bool, ...]]] = [(root, ()) for root in reversed(forest.roots)]
    while waiting:
        frame, turns = waiting.pop()
        yield Branch(forest.info[frame], turns, frame in forest.loops)
        for place, child in enumerate(reversed(forest.children[frame])):
            waiting.append((child, (*turns, place == 0)))
