"""The marks of frames that something is wrong with.

Of a buffer in which nothing can be wrong this is told without numpy and the checks, whose import
takes as long as all else that shows a tree.
"""

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import Snapshot
from tftool.doctor.catalogue import CHECKS


def marks(buffer: Buffer, snapshot: Snapshot) -> dict[str, tuple[str, ...]]:
    """The frames of a buffer that something is wrong with, and the ids of the checks.

    A frame is marked `two-parents`, `clock-mixture` or `edge-stopped`.

    Args:
        buffer: Which.
        snapshot: All its frames, as they are now.
    """
    if _is_calm(buffer, snapshot):
        return {}
    from tftool.doctor.buffer_evidence import marked

    return marked(buffer)


def _is_calm(buffer: Buffer, snapshot: Snapshot) -> bool:
    """Whether no check can hit: one parent each, one clock for all, and no link is late."""
    moving = [info for info in snapshot.frames if info.samples and not info.is_static]
    if not moving:
        return True
    newest = [info.newest for info in moving]
    first = min(info.oldest for info in moving)
    late = max(newest) - min(newest) > CHECKS["edge-stopped"].limits["seconds"] * NANOSECONDS
    one_clock = (first < SIMULATED_BELOW) == (max(newest) < SIMULATED_BELOW)
    return one_clock and not late and all(len(buffer.parents(info.frame)) == 1 for info in moving)
