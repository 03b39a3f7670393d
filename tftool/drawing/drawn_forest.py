"""Which frames a drawing shows, and what hangs from what, loops and all.

A buffer holds a forest, but what comes in over a link may be anything: a frame whose
parent hangs from itself must not send a drawing round in circles.
"""

from dataclasses import dataclass

from tftool.buffer.sample import FrameInfo, Snapshot


@dataclass(frozen=True, slots=True)
class Forest:
    """The frames to draw, level by level from the roots.

    Attributes:
        roots: Names without a parent, and one frame of every loop.
        loops: Of the roots, those that do have a parent: the links that close a loop.
        children: The drawn children of every drawn frame, in order of registration.
        hidden: How many frames below a drawn frame are left out, where any are.
        info: Every frame of the snapshot by its name.
    """

    roots: tuple[str, ...]
    loops: tuple[str, ...]
    children: dict[str, tuple[str, ...]]
    hidden: dict[str, int]
    info: dict[str, FrameInfo]

    @property
    def left_out(self) -> int:
        """How many frames are not drawn."""
        return len(self.info) - len(self.children)


def grow(snapshot: Snapshot, *, most: int | None = None) -> Forest:
    """Sort a snapshot into trees and keep the `most` frames nearest to their roots."""
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
            loops.append(name)
            # The link that closes the loop is cut here, so that the rest is a tree.
            parent = info[name].parent
            assert parent is not None
            children[parent].remove(name)
            found = _walk([name], children)
            reached.update(found)
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
    """Every frame below the roots, level by level; each once, whatever hangs from what."""
    order = list(roots)
    for name in order:  # grows while it is walked
        order.extend(children[name])
    return order
