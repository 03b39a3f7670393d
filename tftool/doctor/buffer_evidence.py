"""What a buffer holds, as a diagnosis looks at it, and the marks of frames that come of it."""

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW
from tftool.buffer.buffer import Buffer
from tftool.doctor import clock_checks as clocks
from tftool.doctor import publisher_checks as publishers
from tftool.doctor.catalogue import CHECKS
from tftool.doctor.evidence import Material
from tftool.doctor.model import Model
from tftool.recordings.contract import Edge, Publisher, Stamps, Transforms

Records = npt.NDArray[np.int64]
Places = npt.NDArray[np.int32]


def of_buffer(buffer: Buffer, name: str = "buffer") -> Material:
    """What a buffer holds, in columns; everything in it counts as arrived at its stamp."""
    parts: dict[tuple[str, str, bool], list[tuple[Records, Places]]] = {}
    logs: list[Stamps] = []
    senders: list[npt.NDArray[np.int32]] = []
    known: dict[Publisher, int] = {}
    count = 0
    for child in buffer.frames():
        held = buffer.samples(child)
        topic = "/tf_static" if held.is_static else "/tf"
        records = np.empty((len(held.stamps), 8), dtype=np.int64)
        records[:, 0] = held.stamps
        records.view(np.float64)[:, 1:] = held.poses
        places = np.arange(count, count + len(records), dtype=np.int32)
        count += len(records)
        logs.append(records[:, 0])
        for one in _runs(held.parents):
            key = (str(held.parents[one[0]]), child, held.is_static)
            parts.setdefault(key, []).append((records[one], places[one]))
        sender = np.zeros(len(records), dtype=np.int32)
        for one in _runs(held.authorities):
            publisher = Publisher(topic, str(held.authorities[one[0]]))
            sender[one] = known.setdefault(publisher, len(known))
        senders.append(sender)
    log_times = np.concatenate(logs) if logs else np.zeros(0, dtype=np.int64)
    moving = log_times[log_times != 0]
    edges = tuple(
        Edge(*key, 0, np.concatenate([r for r, _ in of]), np.concatenate([p for _, p in of]))
        for key, of in parts.items()
    )
    sent_by = np.concatenate(senders) if senders else np.zeros(0, dtype=np.int32)
    transforms = Transforms(edges, log_times, sent_by, tuple(known))
    return Material(
        name=name,
        kind="buffer",
        transforms=transforms,
        publishers=tuple(known),
        start=int(moving.min()) if len(moving) else 0,
        end=int(moving.max()) if len(moving) else 0,
        timed=False,
        recorded=False,
    )


def _runs(names: npt.NDArray[np.object_]) -> list[Places]:
    """The places of each name among many; quick where there is one."""
    if not len(names) or bool((names == names[0]).all()):
        return [np.arange(len(names), dtype=np.int32)] if len(names) else []
    found: dict[str, list[int]] = {}
    for place, name in enumerate(names.tolist()):
        found.setdefault(name, []).append(place)
    return [np.array(places, dtype=np.int32) for places in found.values()]


def marked(buffer: Buffer) -> dict[str, tuple[str, ...]]:
    """What `marks` in `marking` gives, of a buffer in which something may be wrong.

    A frame is marked `edge-stopped` where its newest sample is further behind the newest of
    all, on the same clock, than ten of its periods and a second.
    """
    model = Model(of_buffer(buffer))
    found: dict[str, list[str]] = {}
    for hits in (publishers.two_parents, clocks.clock_mixture):
        name = hits.__name__.replace("_", "-")
        for hit in hits(model, CHECKS[name].limits):
            for _, child in hit.edges:
                found.setdefault(child, []).append(name)
    limits = CHECKS["edge-stopped"].limits
    newest: dict[bool, int] = {}
    # A localiser dates its transforms ahead: what it is ahead of is not old.
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
