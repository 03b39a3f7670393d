"""The diagnosis in Python: of a recording, or of what a buffer holds."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from tftool.diagnostics import clocks, publishers
from tftool.diagnostics.catalogue import CHECKS
from tftool.diagnostics.explanation import Explanation, traced
from tftool.diagnostics.findings import Finding
from tftool.diagnostics.judge import judge
from tftool.diagnostics.material import Material, described_by
from tftool.diagnostics.model import Model, Settings
from tftool.diagnostics.scope import Readable, Scope
from tftool.diagnostics.tracing import Question
from tftool.frames.buffer import Buffer
from tftool.sources.contract import SIMULATED_BELOW, Edge, Publisher, Stamps, Transforms
from tftool.stamps import CACHE_TIME, LATEST, NANOSECONDS, Duration, Stamp

Records = npt.NDArray[np.int64]
Places = npt.NDArray[np.int32]


def diagnose(
    recording: Readable | Buffer,
    *,
    select: Sequence[str] = (),
    ignore: Sequence[str] = (),
    cache_time: Duration = CACHE_TIME,
    urdf: str | Path | None = None,
) -> list[Finding]:
    """Say what is wrong with the frames.

    A buffer keeps neither log times nor messages: what needs them is not looked for.

    Args:
        recording: A recording, or a buffer.
        select: Ids or areas of checks to run; all where empty.
        ignore: Ids or areas to leave out.
        cache_time: How far back the listener that is thought of remembers, nanoseconds.
        urdf: A file with the robot's description; None for the one recorded, if any.

    Returns:
        What was found, by area, errors first. Findings with `because_of` are consequences.

    Raises:
        InputError: If nothing of the recording can be read.
        UsageError: If there is no such check or area, or the description needs xacro, which is
            not installed.
    """
    settings = Settings(cache_time=cache_time)
    scope = Scope(None if urdf is None else described_by(urdf))
    return list(judge(_material(recording, scope), settings, select=select, ignore=ignore).findings)


def explain(
    recording: Readable | Buffer,
    target_frame: str,
    source_frame: str,
    time: Stamp = LATEST,
    *,
    asked_at: Stamp | None = None,
    cache_time: Duration = CACHE_TIME,
    timeout: Duration = 0,
) -> Explanation:
    """Say why a lookup answers or refuses, link by link.

    Args:
        recording: A recording, or a buffer.
        target_frame: The frame to express things in.
        source_frame: The frame they are given in.
        time: The moment, nanoseconds; 0 for the latest.
        asked_at: The log time at which it is asked; None for the arrival of the message of
            that stamp in the source frame, else the moment itself (of a buffer: now).
        cache_time: How far back the listener remembers, nanoseconds.
        timeout: How long it waits, nanoseconds.

    Raises:
        InputError: If nothing of the recording can be read.
    """
    settings = Settings(cache_time=cache_time)
    model = Model(_material(recording, Scope()), settings)
    if asked_at is None and not model.material.timed:
        asked_at = model.end
    return traced(model, Question(target_frame, source_frame, time, asked_at, settings, timeout))


def _material(recording: Readable | Buffer, scope: Scope) -> Material:
    if not isinstance(recording, Buffer):
        return scope.material(recording)
    material = of_buffer(recording)
    if scope.described is None:
        return material
    return replace(material, robot=scope.described.robot, mistakes=scope.described.mistakes)


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


MARKED = ("two-parents", "clock-mixture", "edge-stopped")
"""The checks whose ids stand beside the frames of a tree."""


def marks(buffer: Buffer) -> dict[str, tuple[str, ...]]:
    """The frames of a buffer that something is wrong with, and the ids of the checks.

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
