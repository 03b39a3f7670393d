"""Shapes to draw, which every display returns; each shape is given in one frame."""

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.geometry.rigid import Quaternion, Vector3

Places = npt.NDArray[np.float32]
"""Positions in the frame of the shape, metres, shape (n, 3)."""

MOST_POINTS: Final = 200_000
"""Largest number of points of one shape; of a larger shape, every second or third is drawn."""


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """One shape of a message.

    Attributes:
        kind: Name of the function in `page/displays/` that draws the shape.
        frame: Frame in which the positions are given.
        stamp: Time at which the frame is looked up, nanoseconds, 0 for the latest; None if the
            shape moves with its frame.
        places: Positions, all finite.
        colors: Red, green, blue and opacity of each position, 0 to 255, shape (n, 4); None for
            the colour of the topic.
        turn: Rotation of the object that is drawn at each position.
        size: Size of the object that is drawn at each position, metres along the object's axes.
        text: Text to draw.
        key: Name within the topic; a later shape with the same name replaces this shape.
        until: Time at which the shape disappears, nanoseconds; None for never.
        placement: Root of the frame's tree at the stamp, and the frame's pose in the root
            (translation, then rotation), each None if unknown. None before the lookup.
    """

    kind: str
    frame: str
    stamp: Stamp | None
    places: Places
    colors: npt.NDArray[np.uint8] | None = None
    turn: Quaternion = Quaternion(0.0, 0.0, 0.0, 1.0)  # noqa: RUF009 - is frozen
    size: Vector3 = Vector3(1.0, 1.0, 1.0)  # noqa: RUF009 - is frozen
    text: str = ""
    key: str = ""
    until: Stamp | None = None
    placement: tuple[str | None, list[float] | None] | None = None

    def thinned(self, most: int) -> "Shape":
        """Return the shape with at most `most` positions: every second, third, … position.

        Lines and triangles take several positions each: for these, the first `most` positions are
        returned.
        """
        if len(self.places) <= most:
            return self
        if self.kind in ("segments", "triangles"):
            most -= most % 6
            colors = None if self.colors is None else self.colors[:most]
            return replace(self, places=self.places[:most], colors=colors)
        every = -(-len(self.places) // most)
        colors = None if self.colors is None else self.colors[::every]
        return replace(self, places=self.places[::every], colors=colors)


@dataclass(frozen=True, slots=True, eq=False)
class DrawnMessage:
    """Shapes to draw for one message.

    Attributes:
        stamp: Time of the message, nanoseconds.
        shapes: All shapes of the topic after this message.
        faults: Reasons why parts of the message are not drawn.
    """

    stamp: Stamp
    shapes: tuple[Shape, ...]
    faults: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Total number of positions in the `places` of all shapes."""
        return sum(len(shape.places) for shape in self.shapes)

    def thinned(self, most: int) -> "DrawnMessage":
        """Return the shapes with at most `most` positions in each shape."""
        return replace(self, shapes=tuple(shape.thinned(most) for shape in self.shapes))


@dataclass(frozen=True, slots=True)
class Arrival:
    """Facts about a message's arrival and topic, for the display that draws the message.

    Attributes:
        stamp: Time at which the message arrived, nanoseconds.
        most: Largest number of points to draw of a point cloud.
        before: Shapes that the topic has shown so far; None before the first message.
    """

    stamp: Stamp
    most: int = MOST_POINTS
    before: DrawnMessage | None = None


def drawn(kind: str, header: Any, places: npt.NDArray[Any], most: int) -> DrawnMessage:
    """Return a message with a single shape at those positions that are finite.

    Args:
        kind: Kind of the shape.
        header: Header of the message, with frame and stamp.
        places: Positions, shape (n, 3).
        most: Largest number of positions to keep.
    """
    places = np.asarray(places, dtype=np.float32).reshape(-1, 3)
    places = places[np.isfinite(places).all(axis=1)]
    stamp = stamp_of(header)
    return DrawnMessage(stamp, (Shape(kind, frame_of(header), stamp, places).thinned(most),))


def stamp_of(header: Any) -> Stamp:
    """Return the stamp of a message's header in nanoseconds."""
    stamp: Stamp = header.stamp.sec * NANOSECONDS + header.stamp.nanosec
    return stamp


def frame_of(header: Any) -> str:
    """Return the frame in a message's header, without the leading slash of ROS 1."""
    frame: str = header.frame_id
    return frame.removeprefix("/")
