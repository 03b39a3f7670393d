"""Path between two nodes of a tree through their common ancestor, for frames and for joints."""

from collections.abc import Callable
from typing import Protocol, TypeVar


class Above(Protocol):
    """Interface of an edge of a tree; an edge connects a node with its parent."""

    @property
    def parent(self) -> str:
        """Return the name of the parent node."""


EdgeT = TypeVar("EdgeT", bound=Above)


def climbed(frame: str, parent: Callable[[str], EdgeT | None]) -> list[EdgeT]:
    """Return the edges from a frame up to its root, lowest first.

    Args:
        frame: The frame to start from. In a loop, each edge is returned once.
        parent: Function that returns the edge from a frame to its parent, or None for a root.
    """
    edges: list[EdgeT] = []
    seen = {frame}
    while (edge := parent(frame)) is not None:
        edges.append(edge)
        frame = edge.parent
        if frame in seen:
            break
        seen.add(frame)
    return edges


def up_to_join(
    frame: str, other: str, above: Callable[[str], list[EdgeT]]
) -> tuple[list[EdgeT], list[EdgeT]] | None:
    """Return the edges from `frame` and from `other` to the common ancestor; None if there is none.

    Args:
        frame: The first frame.
        other: The second frame.
        above: Function that returns the edges from a frame up to its root, lowest first.
    """
    up, down = above(frame), above(other)
    ups = [frame, *(edge.parent for edge in up)]
    downs = [other, *(edge.parent for edge in down)]
    for place, name in enumerate(ups):
        if name in downs:
            return up[:place], down[: downs.index(name)]
    return None
