"""Statistics of a recording: rate and delay of each edge, trees of frames, unusual facts."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tftool.base.stamps import SIMULATED_BELOW, Duration, Stamp
from tftool.recordings.contract import Edge, Transforms, median, usual_rate
from tftool.recordings.recording import Recording


@dataclass(frozen=True, slots=True)
class Offset:
    """Smallest, median and largest delay from stamp to reception, nanoseconds."""

    least: Duration
    median: Duration
    most: Duration


@dataclass(frozen=True, slots=True)
class EdgeFacts:
    """Statistics of one edge (pair of parent and child).

    Attributes:
        parent: Name of the parent.
        child: Name of the child.
        static: Whether the edge is static.
        count: Number of transforms.
        rate: Mean rate in hertz without gaps; None if static, or for one transform.
        first: First stamp, nanoseconds.
        last: Last stamp, nanoseconds.
        offset: Statistics of the delay from stamp to log time; None if static.
        simulated: Whether stamps are simulation times, which count from the start of a simulation.
        publishers: Names of the publishers: nodes if recorded, else topics.
    """

    parent: str
    child: str
    static: bool
    count: int
    rate: float | None
    first: Stamp
    last: Stamp
    offset: Offset | None
    simulated: bool
    publishers: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TreeFacts:
    """Root and number of frames of one tree, in which each frame has its last recorded parent."""

    root: str
    frames: int


def edge_facts(transforms: Transforms) -> list[EdgeFacts]:
    """Return the statistics of every edge, in order of appearance."""
    return [_facts(transforms, edge) for edge in transforms.edges if len(edge)]


def _facts(transforms: Transforms, edge: Edge) -> EdgeFacts:
    stamps = edge.stamps
    senders = transforms.senders_of(edge)
    # Usually an edge has one publisher; searching for others takes several times as long.
    numbers = [senders[0]] if senders.min() == senders.max() else np.unique(senders).tolist()
    publishers = tuple(sorted({transforms.publishers[one].authority for one in numbers}))
    first, last = int(stamps.min()), int(stamps.max())
    rate = offset = None
    if not edge.static:
        rate = usual_rate(stamps)
        late = transforms.log_times_of(edge) - stamps
        offset = Offset(int(late.min()), int(median(late)), int(late.max()))
    return EdgeFacts(
        edge.parent,
        edge.child,
        edge.static,
        len(edge),
        rate,
        first,
        last,
        offset,
        not edge.static and first < SIMULATED_BELOW and 0 < int(median(stamps)) < SIMULATED_BELOW,
        publishers,
    )


def trees(transforms: Transforms) -> list[TreeFacts]:
    """Return root and size of every tree, the largest tree first."""
    parents: dict[str, tuple[int, str]] = {}
    names: dict[str, None] = {}
    for edge in transforms.edges:
        if not len(edge):
            continue
        last = int(edge.messages[-1])
        names.setdefault(edge.parent)
        names.setdefault(edge.child)
        if parents.get(edge.child, (-1, ""))[0] < last:
            parents[edge.child] = last, edge.parent
    roots: dict[str, str] = {}
    for name in names:
        passed: dict[str, None] = {}
        here = name
        # Go up to a root, to a known frame, or around a loop.
        while here not in roots and here in parents and here not in passed:
            passed[here] = None
            here = parents[here][1]
        root = roots.get(here, here)
        for one in (*passed, here):
            roots[one] = root
    counts: dict[str, int] = {}
    for root in roots.values():
        counts[root] = counts.get(root, 0) + 1
    return [TreeFacts(root, n) for root, n in sorted(counts.items(), key=lambda one: -one[1])]


def oddities(
    recording: Recording, edges: Sequence[EdgeFacts], forest: Sequence[TreeFacts]
) -> list[str]:
    """Return sentences about unusual facts of a recording's transforms, except damage.

    Args:
        recording: The recording.
        edges: Statistics of the edges.
        forest: Root and size of every tree.
    """
    found = [*recording.source.oddities]
    found += [
        f"{text}." if count == 1 else f"{text} ({count} times)."
        for text, count in recording.oddities.items()
    ]
    facts = [one for one in edges if not one.static]
    simulated = [one for one in facts if one.simulated]
    if simulated and len(simulated) < len(facts):
        odd = min(simulated, [one for one in facts if not one.simulated], key=len)
        names = ", ".join(f"{one.child} in {one.parent}" for one in odd[:4])
        found.append(
            f"Two clocks: the stamps of {names}{' …' if len(odd) > 4 else ''} count from "
            f"{'the start of a simulation' if odd[0].simulated else '1970'}, but the stamps of "
            "other edges do not. Set the parameter use_sim_time to the same value in all nodes."
        )
    elif simulated and recording.source.start >= SIMULATED_BELOW:
        found.append("Stamps count from the start of a simulation; log times from 1970.")
    if len(forest) > 1:
        roots = ", ".join(tree.root for tree in forest[:4])
        found.append(
            f"{len(forest)} separate trees, with the roots {roots}"
            f"{' …' if len(forest) > 4 else ''}."
        )
    slashed = sum(edge.slashed for edge in recording.edges)
    if slashed:
        found.append(
            f"{slashed} transforms have frame names with a leading slash, which is removed."
        )
    return found
