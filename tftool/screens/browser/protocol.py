"""Encoding of the server's messages to the page; `page_messages` defines their fields."""

import json
import math
import sys
from array import array
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from tftool.base.errors import TransformException
from tftool.base.stamps import LAST_STAMP, NANOSECONDS, Stamp, display
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing.drawn_forest import grow
from tftool.geometry.conversions import rpy_from_quaternion
from tftool.screens.browser.page_messages import HEADER, MAGIC, PageRequest, answer

HISTORY = 120
"""Number of past times sent to a new page; fewer if there are many frames."""

MOST_FRAMES = 2000
"""Largest number of frames shown; a browser could not draw or list more at a useful rate."""


def since(epoch: Stamp, stamp: Stamp) -> float:
    """Convert a stamp in nanoseconds to seconds since the epoch."""
    return (stamp - epoch) / NANOSECONDS


def stamp_at(epoch: Stamp, moment: float) -> Stamp:
    """Convert seconds since the epoch to a stamp; at least 1, because stamp 0 means the latest."""
    return min(max(1, epoch + round(moment * NANOSECONDS)), LAST_STAMP)


def reach(frames: Iterable[FrameInfo]) -> tuple[Stamp, Stamp] | None:
    """Return the oldest and newest stamp of all moving frames; None if all frames are static."""
    oldest = newest = 0
    for frame in frames:
        if frame.parent is not None and not frame.is_static and frame.samples:
            oldest = frame.oldest if not newest else min(oldest, frame.oldest)
            newest = max(newest, frame.newest)
    return (oldest, newest) if newest else None


def chosen(snapshot: Snapshot) -> list[int]:
    """Return the indices of the frames to show: at most `MOST_FRAMES`, those nearest to a root."""
    if len(snapshot.frames) <= MOST_FRAMES:
        return list(range(len(snapshot.frames)))
    kept = grow(snapshot, most=MOST_FRAMES).children
    return [index for index, frame in enumerate(snapshot.frames) if frame.frame in kept]


def moments(frames: Sequence[FrameInfo]) -> list[Stamp]:
    """Return evenly spread times between the oldest and the newest sample, oldest first."""
    span = reach(frames)
    if span is None or span[0] == span[1]:
        return []
    oldest, newest = span
    count = max(2, min(HISTORY, 40_000 // len(frames)))
    return [oldest + (newest - oldest) * step // (count - 1) for step in range(count)]


def encode_names(
    epoch: Stamp,
    revision: int,
    frames: Sequence[FrameInfo],
    total: int,
    rate: float,
    begin: Stamp | None = None,
) -> str:
    """Return the message with the frames' names and parents, which seldom change, as JSON.

    Args:
        epoch: Epoch of the clock, nanoseconds.
        revision: Number of changes of the names so far.
        frames: Frames to show.
        total: Number of all frames.
        rate: Seconds of the clock per real second, for playback.
        begin: Time that a page shows first, if the frames were recorded; None for the present.
    """
    place = {frame.frame: index for index, frame in enumerate(frames)}
    return json.dumps(
        answer(
            "frames",
            {
                "epoch": str(epoch),
                "revision": revision,
                "names": [frame.frame for frame in frames],
                "parents": [
                    -1 if frame.parent is None else place.get(frame.parent, -1) for frame in frames
                ],
                "statics": [int(frame.is_static) for frame in frames],
                "authorities": [frame.authority or "no recorded authority" for frame in frames],
                "total": total,
                "rate": rate if math.isfinite(rate) else 1.0,
                **({} if begin is None else {"begin": since(epoch, begin)}),
            },
        )
    )


def encode_poses(
    epoch: Stamp, sequence: int, revision: int, snapshot: Snapshot, frames: Sequence[FrameInfo]
) -> bytes:
    """Return the binary message with the pose of every frame in the frame's parent.

    The message also has each frame's time span, rate and number of samples.
    """
    span = reach(snapshot.frames)
    oldest, newest = span or (snapshot.now, snapshot.now)
    head = HEADER.pack(
        MAGIC,
        sequence & 0xFFFFFFFF,
        revision,
        len(frames),
        since(epoch, snapshot.now),
        since(epoch, snapshot.at) if snapshot.at else math.nan,
        since(epoch, oldest),
        since(epoch, newest),
    )
    numbers = array("d")
    for frame in frames:
        if frame.transform is None:
            numbers.extend(_NO_POSE)
        else:
            numbers.extend(frame.transform.translation)
            numbers.extend(frame.transform.rotation)
        if frame.is_static or not frame.samples:
            numbers.extend((math.nan, math.nan))
        else:
            numbers.extend((since(epoch, frame.newest), since(epoch, frame.oldest)))
        numbers.append(frame.rate)
        numbers.append(frame.samples)
    if sys.byteorder != "little":
        numbers.byteswap()
    return head + numbers.tobytes()


_NO_POSE = (math.nan,) * 7


def encode_range(epoch: Stamp, snapshot: Snapshot) -> str:
    """Return the message with the time span of the buffer's samples."""
    oldest, newest = reach(snapshot.frames) or (snapshot.now, snapshot.now)
    return json.dumps(
        answer(
            "range",
            {
                "now": since(epoch, snapshot.now),
                "oldest": since(epoch, oldest),
                "newest": since(epoch, newest),
            },
        )
    )


def encode_pair(buffer: Buffer, epoch: Stamp, target: str, source: str, at: Stamp) -> str:
    """Return the message with the pose of `source` in `target`, or with the lookup's error."""
    told: dict[str, Any] = {"target": target, "source": source}
    try:
        found = buffer.lookup_transform(target, source, at)
        chain = buffer.chain(target, source, at)
    except TransformException as error:
        return json.dumps(answer("pair", told | {"found": False, "why": str(error)}))
    x, y, z, w = found.transform.rotation
    told |= {
        "found": True,
        "stamp": display(found.stamp),
        "moment": since(epoch, found.stamp) if found.stamp else None,
        "translation": _finite(found.transform.translation),
        "rotation": _finite((x, y, z, w)),
        "rpy": _finite(rpy_from_quaternion(found.transform.rotation)),
        "chain": list(chain),
    }
    return json.dumps(answer("pair", told))


def encode_series(buffer: Buffer, epoch: Stamp, request: PageRequest) -> str:
    """Return the message with a pair's poses at the requested times; null for a failed lookup."""
    stamps = _stamps(epoch, request)
    told: dict[str, Any] = {
        "target": request["target"],
        "source": request["source"],
        "times": [since(epoch, stamp) for stamp in stamps],
    }
    columns: list[list[float | None]] = [[None] * request["count"] for _ in SERIES]
    try:
        path = buffer.lookup_transforms(
            request["target"], request["source"], np.array(stamps, dtype=np.int64), missing="nan"
        )
    except TransformException:
        pass
    else:
        for row in np.flatnonzero(path.valid).tolist():
            angles = rpy_from_quaternion(path.rotations[row].tolist())
            numbers = _finite((*path.translations[row].tolist(), *angles))
            for column, number in zip(columns, numbers, strict=True):
                column[row] = number
    return json.dumps(answer("series", told | dict(zip(SERIES, columns, strict=True))))


def encode_trails(buffer: Buffer, epoch: Stamp, request: PageRequest) -> str:
    """Return the message with frames' positions at the requested times; null for failed lookups."""
    stamps = np.array(_stamps(epoch, request), dtype=np.int64)
    places: dict[str, list[list[float] | None]] = {}
    for frame in request["frames"]:
        places[frame] = [None] * request["count"]
        try:
            path = buffer.lookup_transforms(request["fixed"], frame, stamps, missing="nan")
        except TransformException:
            continue
        # A very large number overflows when it is rounded, and has no decimals anyway.
        with np.errstate(over="ignore"):
            rounded = np.round(path.translations, _TRAIL_DIGITS)
        known = path.valid & np.isfinite(rounded).all(axis=1)
        rows = rounded.tolist()
        for at in np.flatnonzero(known).tolist():
            places[frame][at] = rows[at]
    told = {**{name: request[name] for name in ("fixed", "from", "to")}, "places": places}
    return json.dumps(answer("trails", told))


_TRAIL_DIGITS = 5


def _stamps(epoch: Stamp, request: PageRequest) -> list[Stamp]:
    """Return the evenly spread times that a request asks for, as `from`, `to` and `count`."""
    first, last = stamp_at(epoch, request["from"]), stamp_at(epoch, request["to"])
    steps = request["count"] - 1
    return [first + (last - first) * step // steps for step in range(request["count"])]


SERIES = ("x", "y", "z", "roll", "pitch", "yaw")
"""Columns of a series of poses, in metres and radians."""


def _finite(values: Iterable[float]) -> list[float | None]:
    # JSON has no NaN and no infinity; the page shows a dash for null.
    return [value if math.isfinite(value) else None for value in values]


def names_key(frames: Sequence[FrameInfo]) -> tuple[tuple[str, str | None, bool, str | None], ...]:
    """Return a key that changes whenever the message of `encode_names` changes."""
    return tuple((frame.frame, frame.parent, frame.is_static, frame.authority) for frame in frames)
