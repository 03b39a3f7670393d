"""Marks (ids of checks) of frames with findings, from three of the doctor's checks."""

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW
from tftool.buffer.buffer import Buffer
from tftool.doctor.clock_checks import clock_mixture
from tftool.doctor.evidence import evidence_of_buffer
from tftool.doctor.model import Model
from tftool.doctor.publisher_checks import two_parents
from tftool.doctor.stop_checks import edge_stopped


def marked(buffer: Buffer) -> dict[str, tuple[str, ...]]:
    """Return the marks of a buffer that may contain faults; see `frame_marks.marks`.

    A frame gets the mark `edge-stopped` if its newest sample is old: more than ten periods and more
    than one second before the newest sample of all frames. Samples of localisers, and samples on
    another clock, are not compared.
    """
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
