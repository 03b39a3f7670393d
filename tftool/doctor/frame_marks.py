"""Marks (ids of checks) that trees and screens show beside frames with findings.

The slow import of numpy and of the checks is made only for buffers that may contain faults.
"""

from collections.abc import Iterable

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import Snapshot


def marks(
    buffer: Buffer, snapshot: Snapshot, statics: Iterable[tuple[str, str]] = ()
) -> dict[str, tuple[str, ...]]:
    """Return the ids of the checks that find a fault, by frame name.

    Only the checks `two-parents`, `clock-mixture` and `edge-stopped` run.

    Args:
        buffer: The buffer.
        snapshot: Snapshot of the buffer's frames.
        statics: Parent and child of each static transform that was sent. The buffer itself has only
            the last parent of a child.
    """
    parents: dict[str, set[str]] = {}
    for parent, child in statics:
        parents.setdefault(child.lstrip("/"), set()).add(parent.lstrip("/"))
    found: dict[str, tuple[str, ...]] = {
        child: ("two-parents",) for child, names in parents.items() if len(names) > 1
    }
    if _is_calm(buffer, snapshot):
        return found
    from tftool.doctor.marked_frames import marked

    for child, ids in marked(buffer).items():
        found[child] = tuple(dict.fromkeys((*found.get(child, ()), *ids)))
    return found


def _is_calm(buffer: Buffer, snapshot: Snapshot) -> bool:
    """Whether a buffer has one parent per frame, one clock and no late edge, and so no fault."""
    moving = [info for info in snapshot.frames if info.samples and not info.is_static]
    if not moving:
        return True
    # A robot description, whose frames do not move, is shown without this import.
    from tftool.doctor.findings import STOPPED_AFTER

    newest = [info.newest for info in moving]
    first = min(info.oldest for info in moving)
    late = max(newest) - min(newest) > STOPPED_AFTER * NANOSECONDS
    one_clock = (first < SIMULATED_BELOW) == (max(newest) < SIMULATED_BELOW)
    return one_clock and not late and all(len(buffer.parents(info.frame)) == 1 for info in moving)
