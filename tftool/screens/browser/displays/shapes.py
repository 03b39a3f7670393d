"""Shapes to draw: the result of every display; each shape is given in one frame."""

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.geometry.rigid import Quaternion, Vector3

Places = npt.NDArray[np.float32]
"""Positions in the frame of the shape, metres, shape (n, 3)."""

MOST_POINTS: Final = 200_000
"""Most points drawn of one shape; of more, every second or third is drawn."""


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
        turn: Rotation of what is drawn at each position.
        size: Size of what is drawn at each position, metres along its own axes.
        text: Text to draw.
        key: Name within the topic; a later shape of the same name replaces this one.
        until: Time at which the shape disappears, nanoseconds; None for never.
        placement: Root of the tree that contains the frame at the stamp, and the frame's pose in
            that root (translation and rotation), each None if unknown. None before the lookup.
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
        """Return the shape with every second, third, … position, so that at most `most` remain.

        For lines and triangles, which take several positions each, the first `most` positions are
        returned instead.
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
    """Message as the shapes to draw.

    Attributes:
        stamp: Time of the message, nanoseconds.
        shapes: All shapes that its topic shows from then on.
        faults: Reasons why parts of the message are not drawn.
    """

    stamp: Stamp
    shapes: tuple[Shape, ...]
    faults: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of positions of all shapes."""
        return sum(len(shape.places) for shape in self.shapes)

    def thinned(self, most: int) -> "DrawnMessage":
        """Return the message with at most `most` positions in each shape."""
        return replace(self, shapes=tuple(shape.thinned(most) for shape in self.shapes))


@dataclass(frozen=True, slots=True)
class Arrival:
    """Facts besides the message that a display may use.

    Attributes:
        stamp: Time at which the message arrived, nanoseconds.
        most: Most positions of a cloud of points that are drawn.
        before: Shapes that the topic has shown so far; None before the first message.
    """

    stamp: Stamp
    most: int = MOST_POINTS
    before: DrawnMessage | None = None


def drawn(kind: str, header: Any, places: npt.NDArray[Any], most: int) -> DrawnMessage:
    """Return a message of one shape, with its finite positions thinned to at most `most`."""
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
