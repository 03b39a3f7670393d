"""Messages between the page and its server, as bytes and text.

Server to page:
  text   {"type": "frames", ...}  the frames' names and parents, whenever they change
  text   {"type": "pair", ...}    the transform of the chosen pair, or why there is none
  text   {"type": "robot", ...}   shapes, joints and sliders of the robot; see `robots.py`
  text   {"type": "range", ...}   how far the buffer reaches, while a past moment is shown
  text   {"type": "series", ...}  a pair's transform at many moments; see `encode_series`
  text   {"type": "trails", ...}  where frames were at many moments; see `encode_trails`
  text   {"type": "marks", ...}   gaps and the doctor's findings; see `marks.py`
  binary                          every frame's pose at one moment; see `encode_poses`
  binary                          the last message of a topic that is drawn; a block of `packing.py`

Page to server, text only:
  {"type": "show", "at": seconds | null}        which moment; null follows the present
  {"type": "pair", "target": …, "source": …}    which pair; null for none
  {"type": "got", "sequence": n}                the page has drawn that many poses
  {"type": "move", "joint": …, "position": …}   put a joint elsewhere, radians or metres
  {"type": "past"}                              send what the buffer remembers, for trails;
                                                it comes as poses of sequence number 0
  {"type": "series", "target": …, "source": …,  tell a pair's transform at `count` moments from
   "from": seconds, "to": seconds, "count": n}  the one to the other
  {"type": "trails", "fixed": …, "frames": […], tell where frames were in the fixed one at `count`
   "from": seconds, "to": seconds, "count": n}  moments
  {"type": "marks"}                             tell gaps and findings, when they are known

Moments travel as seconds since the clock's epoch, which a float holds to the nanosecond
for a hundred days; the epoch itself travels as text.
"""

import json
import math
import struct
import sys
from array import array
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from tftool.base.errors import InputError, TransformException
from tftool.base.stamps import LAST_STAMP, NANOSECONDS, Stamp, display
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing.drawn_forest import grow
from tftool.geometry.conversions import rpy_from_quaternion

MAGIC = b"TFP1"
HEADER = struct.Struct("<4sIIIdddd")
"""Magic, sequence, revision of the names, number of frames; now, moment shown (NaN for the
present), oldest and newest moment of the buffer, in seconds since the epoch."""

HISTORY = 120
"""Moments that tell what the buffer remembers; fewer where there are many frames."""

FIELDS = 11
"""Numbers per frame: x y z, qx qy qz qw (NaN without data), newest, oldest, rate, samples."""

MOST_FRAMES = 2000
"""More than this is neither drawn nor listed by a browser at a useful rate."""

MOST_MOMENTS = 2000
"""Moments of a pair that are told at once: a plot has no more columns."""

MOST_TRAILS = 60
"""Frames whose trails are told at once."""

MOST_BYTES = 16 * 1024
"""The longest message a page has a reason to send: two names of some thousand letters."""


ARROWS = ("up", "down", "left", "right")
"""Keys that drive a turtle."""


# Page to server


@dataclass(frozen=True, slots=True)
class Show:
    """Request to show a time: seconds since the epoch, or None for the present."""

    at: float | None


@dataclass(frozen=True, slots=True)
class PairRequest:
    """Request for a pair's transform from now on; None ends it."""

    frames: tuple[str, str] | None


@dataclass(frozen=True, slots=True)
class Got:
    """Acknowledgement that the page has drawn the poses of this sequence number."""

    sequence: int


@dataclass(frozen=True, slots=True)
class Move:
    """Request to move a joint: radians or metres."""

    joint: str
    position: float


@dataclass(frozen=True, slots=True)
class KeyPressed:
    """Key press that drives a turtle: "up", "down", "left" or "right"."""

    key: str


@dataclass(frozen=True, slots=True)
class Past:
    """Request for poses over the whole buffer, once."""


@dataclass(frozen=True, slots=True)
class SeriesRequest:
    """Request for a pair's transform at `count` times from `first` to `last`, in seconds."""

    target: str
    source: str
    first: float
    last: float
    count: int


@dataclass(frozen=True, slots=True)
class TrailsRequest:
    """Request for frames' positions at `count` times from `first` to `last`, in seconds."""

    fixed: str
    frames: tuple[str, ...]
    first: float
    last: float
    count: int


@dataclass(frozen=True, slots=True)
class MarksRequest:
    """Request for gaps and the doctor's findings."""


Said: TypeAlias = (
    Show
    | PairRequest
    | Got
    | Move
    | KeyPressed
    | Past
    | SeriesRequest
    | TrailsRequest
    | MarksRequest
)


def parse(message: str | bytes) -> Said:
    """Parse a message from a page.

    Raises:
        InputError: If it is none of the nine messages; names the mistake.
    """
    if isinstance(message, bytes):
        raise InputError("the page sends text, not bytes")
    try:
        said = json.loads(message)
    except (ValueError, RecursionError) as error:
        raise InputError("that is not JSON") from error
    kind = said.get("type") if isinstance(said, dict) else None
    if kind == "show":
        return Show(_moment(said.get("at")))
    if kind == "pair":
        target, source = said.get("target"), said.get("source")
        if target is None and source is None:
            return PairRequest(None)
        if isinstance(target, str) and isinstance(source, str):
            return PairRequest((target, source))
        raise InputError("a pair is two names of frames, or null twice")
    if kind == "got":
        sequence = said.get("sequence")
        if isinstance(sequence, int):
            return Got(sequence)
        raise InputError("a sequence is a whole number")
    if kind == "move":
        joint, position = said.get("joint"), said.get("position")
        if not isinstance(joint, str) or not isinstance(position, (int, float)):
            raise InputError("a move is the name of a joint and a number")
        if not abs(position) < 1e9:
            raise InputError("a joint's position is a finite number")
        return Move(joint, float(position))
    if kind == "key":
        if said.get("key") not in ARROWS:
            raise InputError(f"a key is one of {', '.join(ARROWS)}")
        return KeyPressed(said["key"])
    if kind == "past":
        return Past()
    if kind == "series":
        return _series(said)
    if kind == "trails":
        return _trails(said)
    if kind == "marks":
        return MarksRequest()
    raise InputError(
        'a message is an object whose "type" is show, pair, got, move, key, past, series, '
        "trails or marks"
    )


def _series(said: dict[str, Any]) -> SeriesRequest:
    target, source = said.get("target"), said.get("source")
    if not isinstance(target, str) or not isinstance(source, str):
        raise InputError("a series needs the names of two frames")
    return SeriesRequest(target, source, *_span(said))


def _trails(said: dict[str, Any]) -> TrailsRequest:
    fixed, frames = said.get("fixed"), said.get("frames")
    if not isinstance(fixed, str) or not isinstance(frames, list):
        raise InputError("trails need a fixed frame and a list of others")
    if len(frames) > MOST_TRAILS or not all(isinstance(frame, str) for frame in frames):
        raise InputError(f"trails can have at most {MOST_TRAILS} names of frames")
    return TrailsRequest(fixed, tuple(frames), *_span(said))


def _span(said: dict[str, Any]) -> tuple[float, float, int]:
    """Parse first and last time, and their number."""
    count = said.get("count")
    if not isinstance(count, int) or not 2 <= count <= MOST_MOMENTS:
        raise InputError(f"a series has from 2 to {MOST_MOMENTS} moments")
    first, last = _moment(said.get("from")), _moment(said.get("to"))
    if first is None or last is None or not first < last:
        raise InputError("a series goes from one moment to a later one")
    return first, last, count


def _moment(value: Any) -> float | None:
    if value is None:
        return None
    # Compared first: a whole number too large for a float cannot be converted.
    if isinstance(value, (int, float)) and abs(value) < 1e12:
        return float(value)
    raise InputError("a moment is a number of seconds since the epoch, or null")


# Server to page


def since(epoch: Stamp, stamp: Stamp) -> float:
    """Convert a stamp to seconds since the epoch."""
    return (stamp - epoch) / NANOSECONDS


def stamp_at(epoch: Stamp, moment: float) -> Stamp:
    """Convert seconds since the epoch to a stamp; never 0, which would mean the latest."""
    return min(max(1, epoch + round(moment * NANOSECONDS)), LAST_STAMP)


def reach(frames: Iterable[FrameInfo]) -> tuple[Stamp, Stamp] | None:
    """Return the oldest and newest stamp of any link; None if all are static."""
    oldest = newest = 0
    for frame in frames:
        if frame.parent is not None and not frame.is_static and frame.samples:
            oldest = frame.oldest if not newest else min(oldest, frame.oldest)
            newest = max(newest, frame.newest)
    return (oldest, newest) if newest else None


def chosen(snapshot: Snapshot) -> list[int]:
    """Choose frames to show if there are too many: those nearest to their roots."""
    if len(snapshot.frames) <= MOST_FRAMES:
        return list(range(len(snapshot.frames)))
    kept = grow(snapshot, most=MOST_FRAMES).children
    return [index for index, frame in enumerate(snapshot.frames) if frame.frame in kept]


def moments(frames: Sequence[FrameInfo]) -> list[Stamp]:
    """Return evenly spread times over all samples, oldest first."""
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
    """Serialise the parts of a snapshot that seldom change.

    Args:
        epoch: The clock's.
        revision: Counts how often the names have changed.
        frames: Shown frames.
        total: How many there are.
        rate: How fast the clock runs, for playing back.
        begin: The moment to open with, where everything was recorded before.
    """
    place = {frame.frame: index for index, frame in enumerate(frames)}
    return json.dumps(
        {
            "type": "frames",
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
        }
    )


def encode_poses(
    epoch: Stamp, sequence: int, revision: int, snapshot: Snapshot, frames: Sequence[FrameInfo]
) -> bytes:
    """Serialise every frame's pose in its parent, and the facts that change with every sample."""
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
    """Serialise the buffer's present time span."""
    oldest, newest = reach(snapshot.frames) or (snapshot.now, snapshot.now)
    return json.dumps(
        {
            "type": "range",
            "now": since(epoch, snapshot.now),
            "oldest": since(epoch, oldest),
            "newest": since(epoch, newest),
        }
    )


def encode_pair(buffer: Buffer, epoch: Stamp, target: str, source: str, at: Stamp) -> str:
    """Serialise the transform of `source` in `target`, with the exact numbers of `tftool echo`."""
    answer: dict[str, Any] = {"type": "pair", "target": target, "source": source}
    try:
        found = buffer.lookup_transform(target, source, at)
        chain = buffer.chain(target, source, at)
    except TransformException as error:
        return json.dumps({**answer, "found": False, "why": str(error)})
    x, y, z, w = found.transform.rotation
    answer |= {
        "found": True,
        "stamp": display(found.stamp),
        "moment": since(epoch, found.stamp) if found.stamp else None,
        "translation": _finite(found.transform.translation),
        "rotation": _finite((x, y, z, w)),
        "rpy": _finite(rpy_from_quaternion(found.transform.rotation)),
        "chain": list(chain),
    }
    return json.dumps(answer)


def encode_series(buffer: Buffer, epoch: Stamp, asked: SeriesRequest) -> str:
    """Serialise a pair's transform at evenly spread times, null where there is none."""
    stamps = _stamps(epoch, asked)
    answer: dict[str, Any] = {
        "type": "series",
        "target": asked.target,
        "source": asked.source,
        "times": [since(epoch, stamp) for stamp in stamps],
    }
    columns: list[list[float | None]] = [[None] * asked.count for _ in SERIES]
    try:
        path = buffer.lookup_transforms(
            asked.target, asked.source, np.array(stamps, dtype=np.int64), missing="nan"
        )
    except TransformException:
        pass
    else:
        for row in np.flatnonzero(path.valid).tolist():
            angles = rpy_from_quaternion(path.rotations[row].tolist())
            numbers = _finite((*path.translations[row].tolist(), *angles))
            for column, number in zip(columns, numbers, strict=True):
                column[row] = number
    return json.dumps(answer | dict(zip(SERIES, columns, strict=True)))


def encode_trails(buffer: Buffer, epoch: Stamp, asked: TrailsRequest) -> str:
    """Serialise frames' positions at evenly spread times, null where unknown."""
    stamps = np.array(_stamps(epoch, asked), dtype=np.int64)
    places: dict[str, list[list[float] | None]] = {}
    for frame in asked.frames:
        places[frame] = [None] * asked.count
        try:
            path = buffer.lookup_transforms(asked.fixed, frame, stamps, missing="nan")
        except TransformException:
            continue
        # A place that is very far away has no digits behind the point to round to.
        with np.errstate(over="ignore"):
            rounded = np.round(path.translations, _TRAIL_DIGITS)
        known = path.valid & np.isfinite(rounded).all(axis=1)
        rows = rounded.tolist()
        for at in np.flatnonzero(known).tolist():
            places[frame][at] = rows[at]
    told = {"type": "trails", "fixed": asked.fixed, "from": asked.first, "to": asked.last}
    return json.dumps(told | {"places": places})


_TRAIL_DIGITS = 5


def _stamps(epoch: Stamp, asked: SeriesRequest | TrailsRequest) -> list[Stamp]:
    """Return evenly spread times over the requested span."""
    first, last = stamp_at(epoch, asked.first), stamp_at(epoch, asked.last)
    steps = asked.count - 1
    return [first + (last - first) * step // steps for step in range(asked.count)]


SERIES = ("x", "y", "z", "roll", "pitch", "yaw")
"""The columns of a series: metres, radians."""


def _finite(values: Iterable[float]) -> list[float | None]:
    # JSON knows no NaN and no infinity; the page shows a dash for null.
    return [value if math.isfinite(value) else None for value in values]


def names_key(frames: Sequence[FrameInfo]) -> tuple[tuple[str, str | None, bool, str | None], ...]:
    """Return a key that changes whenever the names must be sent again."""
    return tuple((frame.frame, frame.parent, frame.is_static, frame.authority) for frame in frames)
