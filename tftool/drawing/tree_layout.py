"""Tidy layout of a forest, computed with numbers only.

A parent is above the middle between its first and last child. Siblings keep a gap. Subtrees are as
close as their outlines allow, after an idea of Reingold and Tilford. Packing from one side would
push small subtrees against one neighbour. So the forest is packed from both sides, and the mean
positions are used. The mean keeps the gaps, as both packings do, and is symmetric.

Time and memory are linear in the number of items. No function is recursive, so a chain of thousands
of items is no problem.
"""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Item:
    """Item of the layout, such as a card.

    Attributes:
        breadth: Extent across the direction of growth.
        children: Indices of the item's children, in order.
        levels: Number of levels that the item fills; 1 for an item with children.
    """

    breadth: float
    children: tuple[int, ...] = ()
    levels: int = 1


@dataclass(frozen=True, slots=True)
class Spot:
    """Position of an item: the middle of its breadth, and its level."""

    middle: float
    level: int


def tidy(items: Sequence[Item], roots: Sequence[int], *, gap: float, tree_gap: float) -> list[Spot]:
    """Compute the positions of a forest's items; the left edge of the forest is at 0.

    Args:
        items: All items; each is reached from the roots exactly once.
        roots: Indices of the trees' roots, from left to right.
        gap: Smallest distance between neighbours on one level.
        tree_gap: Smallest distance between two trees.

    Returns:
        One position per item, in the order of the items.
    """
    order = _parents_first(items, roots)
    forward = _pack(items, roots, order, gap, tree_gap, mirrored=False)
    backward = _pack(items, roots, order, gap, tree_gap, mirrored=True)
    middles = [(one + other) / 2 for one, other in zip(forward, backward, strict=True)]

    levels = [0] * len(items)
    for index in order:
        for child in items[index].children:
            levels[child] = levels[index] + 1
    edge = min(
        (middle - item.breadth / 2 for item, middle in zip(items, middles, strict=True)),
        default=0.0,
    )
    return [Spot(middle - edge, level) for middle, level in zip(middles, levels, strict=True)]


def _parents_first(items: Sequence[Item], roots: Sequence[int]) -> list[int]:
    order: list[int] = []
    waiting = list(reversed(roots))
    while waiting:
        index = waiting.pop()
        order.append(index)
        waiting.extend(reversed(items[index].children))
    return order


def _pack(
    items: Sequence[Item],
    roots: Sequence[int],
    order: Sequence[int],
    gap: float,
    tree_gap: float,
    *,
    mirrored: bool,
) -> list[float]:
    """Pack subtrees to the left, or to the right if `mirrored`; return the items' centres."""
    offsets = [0.0] * len(items)
    outlines: dict[int, _Outline] = {}
    for index in reversed(order):
        item = items[index]
        children = item.children[::-1] if mirrored else item.children
        outline = _row(children, outlines, offsets, gap)
        if children:
            middle = (offsets[children[0]] + offsets[children[-1]]) / 2
            for child in children:
                offsets[child] -= middle
            outline.shift(-middle)
        outline.crown(item.breadth / 2, item.levels)
        outlines[index] = outline

    edge = 0.0
    for root in roots[::-1] if mirrored else roots:
        # Trees do not overlap in width: one below another would look like its descendant.
        offsets[root] = edge - outlines[root].leftmost()
        edge = offsets[root] + outlines[root].rightmost() + tree_gap
    for index in order:
        for child in items[index].children:
            offsets[child] += offsets[index]
    return [-offset for offset in offsets] if mirrored else offsets


def _row(
    indices: Sequence[int], outlines: dict[int, "_Outline"], offsets: list[float], gap: float
) -> "_Outline":
    """Place subtrees side by side, store their offsets, and return their common outline."""
    together = _Outline()
    for index in indices:
        outline = outlines.pop(index)
        offsets[index] = together.room_for(outline, gap)
        together.add(outline, offsets[index])
    return together


class _Outline:
    """Outline of a subtree: positions of the left and the right edge on each level.

    The lists begin at the deepest level. So a new top level is appended, and the common levels of
    two outlines are at the ends of their lists. Each list has an offset, and moving a subtree only
    changes this offset.
    """

    __slots__ = ("left", "left_shift", "right", "right_shift")

    def __init__(self) -> None:
        self.left: list[float] = []
        self.right: list[float] = []
        self.left_shift = 0.0
        self.right_shift = 0.0

    def shift(self, distance: float) -> None:
        self.left_shift += distance
        self.right_shift += distance

    def leftmost(self) -> float:
        return min(self.left) + self.left_shift

    def rightmost(self) -> float:
        return max(self.right) + self.right_shift

    def crown(self, half: float, levels: int) -> None:
        """Add an item on top, with half its breadth (`half`) and the number of its levels."""
        self.left.extend([-half - self.left_shift] * levels)
        self.right.extend([half - self.right_shift] * levels)

    def room_for(self, other: "_Outline", gap: float) -> float:
        """Return the smallest offset to the right at which `other` keeps the gap on every level."""
        common = min(len(self.right), len(other.left))
        if not common:
            return 0.0
        ours = self.right[-common:]
        theirs = other.left[-common:]
        reach = max(our - their for our, their in zip(ours, theirs, strict=True))
        return reach + self.right_shift - other.left_shift + gap

    def add(self, other: "_Outline", position: float) -> None:
        """Add another outline at a position to the right of this outline."""
        other.shift(position)
        common = min(len(self.left), len(other.left))
        if len(other.left) > len(self.left):
            moved = self.left_shift - other.left_shift
            if common:
                other.left[-common:] = [edge + moved for edge in self.left]
            self.left, self.left_shift = other.left, other.left_shift
            self.right, self.right_shift = other.right, other.right_shift
        elif common:
            moved = other.right_shift - self.right_shift
            self.right[-common:] = [edge + moved for edge in other.right]
