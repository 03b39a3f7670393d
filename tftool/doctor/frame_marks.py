"""Marks (ids of checks) that trees and screens show beside frames with findings.

The slow import of numpy and of the checks is made only for buffers that may contain faults.
"""

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import Snapshot


def marks(buffer: Buffer, snapshot: Snapshot) -> dict[str, tuple[str, ...]]:
    """Return the ids of the checks that find a fault, by frame name.

    Only the checks `two-parents`, `clock-mixture` and `edge-stopped` run.

    Args:
        buffer: The buffer.
        snapshot: Snapshot of the buffer's frames.
    """
    if _is_calm(buffer, snapshot):
        return {}
    return marked(buffer)


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


def marked(buffer: Buffer) -> dict[str, tuple[str, ...]]:
    """Return the marks of a buffer that may contain faults; see `marks`.

    A frame gets the mark `edge-stopped` if its newest sample is more than ten periods and more than
    one second older than the newest of all samples on the same clock, except samples of localisers.
    """
    from tftool.doctor.clock_checks import clock_mixture
    from tftool.doctor.evidence import evidence_of_buffer
    from tftool.doctor.gap_checks import edge_stopped
    from tftool.doctor.model import Model
    from tftool.doctor.publisher_checks import two_parents

    model = Model(evidence_of_buffer(buffer))
    found: dict[str, list[str]] = {}
    for check in (two_parents, clock_mixture):
        for hit in check(model):
            for _, child in hit.edges:
                found.setdefault(child, []).append(check.id)
    limits = edge_stopped.limits
    newest: dict[bool, int] = {}
    # Localisers stamp transforms in the future, so they must not make other links look old.
    usual = [track for track in model.dynamic if not track.is_localisation]
    for track in usual:
        last = int(track.stamps.max())
        newest[last < SIMULATED_BELOW] = max(newest.get(last < SIMULATED_BELOW, 0), last)
    for track in model.parents.values():
        if track.static or len(track.stamps) < 2:
            continue
        last = int(track.stamps.max())
        least = max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)
        if newest.get(last < SIMULATED_BELOW, last) - last > least:
            found.setdefault(track.child, []).append("edge-stopped")
    return {child: tuple(dict.fromkeys(ids)) for child, ids in found.items()}
