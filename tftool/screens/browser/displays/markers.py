"""Display of `visualization_msgs/MarkerArray`: markers are added, replaced and deleted.

A message of `visualization_msgs/Marker` is drawn as an array of one marker.
"""

import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS
from tftool.geometry import rigid_arrays
from tftool.geometry.rigid import Quaternion, Vector3
from tftool.screens.browser.displays.shapes import (
    Arrival,
    DrawnMessage,
    Shape,
    frame_of,
    stamp_of,
)

TYPES: Final = ("visualization_msgs/msg/MarkerArray", "visualization_msgs/msg/Marker")

DELETE, DELETE_ALL = 2, 3

MOST_SHAPES: Final = 2000
"""Largest number of shapes of one topic; a page would draw more too slowly."""

HEAD: Final = 0.23
"""Length of an arrow's head as a share of the arrow, as in rviz."""

Floats = npt.NDArray[np.float64]
Part = tuple[str, Floats, Quaternion, Vector3]
"""Kind of a shape, its positions in the marker's frame, and rotation and size of each."""

_UPRIGHT_TO_FORWARD: Final = Quaternion(0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))
_UNIT: Final = Vector3(1.0, 1.0, 1.0)


def draw(message: Any, arrival: Arrival) -> DrawnMessage:
    """Return all markers of the topic after this message, as shapes to draw.

    A marker with `frame_locked` moves with the marker's frame.
    """
    shapes = list(arrival.before.shapes) if arrival.before is not None else []
    faults = []
    moment = arrival.stamp
    for marker in message.markers if hasattr(message, "markers") else [message]:
        key = f"{marker.ns}/{marker.id}"
        stamp = stamp_of(marker.header)
        if marker.action == DELETE_ALL:
            # rviz deletes one namespace if the message names one.
            shapes = [
                one for one in shapes if marker.ns and not one.key.startswith(f"{marker.ns}/")
            ]
            continue
        shapes = [one for one in shapes if one.key != key]
        if marker.action == DELETE:
            continue
        moment = max(stamp, moment) if stamp else moment
        parts = _PARTS.get(marker.type)
        if parts is None:
            faults.append(f"markers of type {marker.type} are not drawn")
            continue
        lifetime = marker.lifetime.sec * NANOSECONDS + marker.lifetime.nanosec
        for kind, places, turn, size in parts(marker):
            colors = _colors(marker, len(places))
            whole = np.isfinite(places).all(axis=1)
            if not whole.any():
                continue
            shapes.append(
                Shape(
                    kind,
                    frame_of(marker.header),
                    None if marker.frame_locked else stamp,
                    places[whole].astype(np.float32),
                    colors[whole],
                    turn,
                    size,
                    marker.text if kind == "words" else "",
                    key,
                    (stamp or arrival.stamp) + lifetime if lifetime > 0 else None,
                ).thinned(arrival.most)
            )
    alive = [one for one in shapes if one.until is None or one.until > moment]
    if len(alive) > MOST_SHAPES:
        faults.append(f"more than {MOST_SHAPES:,} markers: the newest are drawn")
    return DrawnMessage(moment, tuple(alive[-MOST_SHAPES:]), tuple(dict.fromkeys(faults)))


def _single(kind: str) -> Callable[[Any], Iterator[Part]]:
    def parts(marker: Any) -> Iterator[Part]:
        place, turn = _pose(marker)
        yield kind, place[np.newaxis], turn, _size(marker)

    return parts


def _at_points(kind: str) -> Callable[[Any], Iterator[Part]]:
    def parts(marker: Any) -> Iterator[Part]:
        size = _size(marker) if kind in ("box", "sphere") else _UNIT
        yield kind, _points(marker), _pose(marker)[1], size

    return parts


def _arrow(marker: Any) -> Iterator[Part]:
    size = _size(marker)
    points = _points(marker)
    if len(points) >= 2:
        yield from _arrow_between(points[0], points[1], size)
        return
    place, turn = _pose(marker)
    upright = turn @ _UPRIGHT_TO_FORWARD
    ahead = rigid_arrays.rotate(np.array(turn), np.array((size.x, 0.0, 0.0)))
    shaft = Vector3(size.z / 2.0, size.y / 2.0, size.x * (1.0 - HEAD))
    yield "cylinder", (place + ahead * (1.0 - HEAD) / 2.0)[np.newaxis], upright, shaft
    head = Vector3(size.z, size.y, size.x * HEAD)
    yield "cone", (place + ahead * (1.0 - HEAD / 2.0))[np.newaxis], upright, head


def _arrow_strip(marker: Any) -> Iterator[Part]:
    points = _points(marker)
    for first, second in pairwise(points):
        yield from _arrow_between(first, second, _size(marker))


def _arrow_between(start: Floats, end: Floats, size: Vector3) -> Iterator[Part]:
    """Yield the shaft and the head of an arrow as parts to draw.

    In `size`, x and y are the diameters of shaft and head, and z is the length of the head.
    """
    along = end - start
    length = float(np.linalg.norm(along))
    if not 0.0 < length < math.inf:
        return
    x, y, z = (along / length).tolist()
    half = math.sqrt(2.0 * (1.0 + z))
    is_down = half < 1e-6
    turn = (
        Quaternion(1.0, 0.0, 0.0, 0.0)
        if is_down
        else Quaternion(-y / half, x / half, 0.0, half / 2)
    )
    head = min(length, size.z if size.z > 0.0 else HEAD * length)
    shaft = length - head
    middle = start + along * (shaft / 2.0 / length)
    yield "cylinder", middle[np.newaxis], turn, Vector3(size.x, size.x, shaft)
    tip = end - along * (head / 2.0 / length)
    yield "cone", tip[np.newaxis], turn, Vector3(size.y, size.y, head)


_PARTS: Final[dict[int, Callable[[Any], Iterator[Part]]]] = {
    0: _arrow,
    1: _single("box"),
    2: _single("sphere"),
    3: _single("cylinder"),
    4: _at_points("line"),
    5: _at_points("segments"),
    6: _at_points("box"),
    7: _at_points("sphere"),
    8: _at_points("points"),
    9: _single("words"),
    11: _at_points("triangles"),
    12: _arrow_strip,
}
"""Functions that draw each type of marker, by number: arrow, cube, sphere, cylinder, line strip,
line list, cube list, sphere list, points, text, triangle list, arrow strip. Meshes are not drawn,
because their files may be anywhere."""


def _pose(marker: Any) -> tuple[Floats, Quaternion]:
    """Return a marker's position and unit quaternion; the quaternion 0, 0, 0, 0 is the identity."""
    place, turn = marker.pose.position, marker.pose.orientation
    norm = math.hypot(turn.x, turn.y, turn.z, turn.w)
    unit = Quaternion(0.0, 0.0, 0.0, 1.0)
    if 0.0 < norm < math.inf:
        unit = Quaternion(turn.x / norm, turn.y / norm, turn.z / norm, turn.w / norm)
    return np.array((place.x, place.y, place.z), dtype=np.float64), unit


def _points(marker: Any) -> Floats:
    place, turn = _pose(marker)
    points = [(point.x, point.y, point.z) for point in marker.points]
    own = np.array(points, dtype=np.float64).reshape(-1, 3)
    return rigid_arrays.rotate(np.array(turn), own) + place


def _size(marker: Any) -> Vector3:
    scale = marker.scale
    return Vector3(scale.x, scale.y, scale.z)


def _colors(marker: Any, count: int) -> npt.NDArray[np.uint8]:
    """Return the colour of each of a marker's `count` positions: red, green, blue, opacity.

    The values are 0 to 255, shape (count, 4).
    """
    given = marker.colors if len(marker.colors) == count else [marker.color] * count
    parts = np.array([(one.r, one.g, one.b, one.a) for one in given], dtype=np.float64)
    shares = np.nan_to_num(parts.reshape(-1, 4))
    return np.rint(np.clip(shares, 0.0, 1.0) * 255.0).astype(np.uint8)
