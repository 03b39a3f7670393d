"""What turtles drew, handed from the simulator's process to one that shows it.

turtlesim's topics tell no pen, and no stroke from before one listened. A simulator of ours
therefore answers a hidden service, `<node>/_drawing`: lists of services leave it out, as in ROS 2
they do whatever begins with an underscore.
"""

from itertools import islice
from typing import Any, Final

from tftool.base.color import Color
from tftool.messages.classes import INTERFACES
from tftool.world.node import Node
from tftool.world.nodes.trail import Segment, Trail

SERVICE: Final = "_drawing"

MOST_STROKES: Final = 2000
"""Strokes in one answer; the next answer continues there."""

INTERFACES.add(
    "tftool_interfaces",
    {
        ("srv", "Drawing"): "int64 began\nuint64 wipes\nuint64 drawn\n---\n"
        "int64 began\nuint64 wipes\nuint64 first\nuint64 drawn\nfloat32[] ends\nuint8[] pens\n"
    },
)

KIND: Final[Any] = INTERFACES.find("tftool_interfaces", "srv", "Drawing")
"""Asked: which sheet the asker has (when its simulator began, and how often it was wiped), and
how many strokes of it. Told: which sheet there is, the strokes that follow from the `first` on
(four numbers for the ends of each, then red, green, blue and width), and how many there are."""


class DrawingService:
    """Answers with the strokes of a trail, those first that the asker lacks."""

    def __init__(self, node: Node, trail: Trail) -> None:
        """Serve until the node ends."""
        self._trail = trail
        self._began = node.clock.now()
        node.serve(f"{node.name}/{SERVICE}", self._answer, KIND)

    def _answer(self, request: Any) -> Any:
        trail = self._trail
        is_same = (request.began, request.wipes) == (self._began, trail.wipes)
        forgotten = trail.drawn - len(trail.segments)
        first = max(forgotten, request.drawn if is_same and request.drawn <= trail.drawn else 0)
        told = KIND.Response(began=self._began, wipes=trail.wipes, first=first, drawn=trail.drawn)
        start = first - forgotten
        for stroke in islice(trail.segments, start, start + MOST_STROKES):
            told.ends.extend(stroke[:4])
            told.pens.extend(
                (stroke.color.r, stroke.color.g, stroke.color.b, min(stroke.width, 255))
            )
        return told


class FarDrawing:
    """A trail elsewhere, as far as it was told.

    Attributes:
        is_whole: Whether everything was told that was there at the last answer.
    """

    def __init__(self, trail: Trail) -> None:
        """Take what is told into `trail`."""
        self.is_whole = False
        self._trail = trail
        self._began = -1
        self._wipes = self._drawn = 0

    def request(self) -> Any:
        """What asks for the strokes that are not here yet."""
        return KIND.Request(began=self._began, wipes=self._wipes, drawn=self._drawn)

    def take(self, told: Any) -> bool:
        """Draw what an answer brought; whether it changed anything."""
        is_new = (told.began, told.wipes) != (self._began, self._wipes) or told.first < self._drawn
        if is_new:
            self._trail.wipe()
            self._began, self._wipes = told.began, told.wipes
        strokes = min(len(told.ends) // 4, len(told.pens) // 4)
        for one in range(0, 4 * strokes, 4):
            r, g, b, width = told.pens[one : one + 4]
            x0, y0, x1, y1 = told.ends[one : one + 4]
            self._trail.draw(Segment(x0, y0, x1, y1, Color(r, g, b), width))
        self._drawn = told.first + strokes
        self.is_whole = self._drawn >= told.drawn or not strokes
        return is_new or strokes > 0
