"""3-D pictures of a scene's moments."""

from tftool.base.color import Color
from tftool.drawing import theme
from tftool.drawing.solids import Solids
from tftool.drawing.space import Line3, SpacePicture
from tftool.screens.terminal.scene import SceneMoment
from tftool.screens.terminal.space_panel import frames_in_space, is_tall

MOST_STROKES = 3000
"""Of a drawing, and of all trails, the newest strokes are drawn."""

SHADES = 32
"""Steps in which the colours of a trail fade."""


def space_picture(moment: SceneMoment, solids: Solids | None = None) -> SpacePicture:
    """Return a moment's frames in 3-D, with a robot's shapes, trails and the turtles' field."""
    plane = moment.picture
    frames = frames_in_space(moment.snapshot, plane.fixed, moment.ages)
    lines: list[Line3] = []
    if plane.field is not None:
        corners = [(x, y, 0.0) for x, y in plane.field.corners()]
        around = zip(corners, [*corners[1:], corners[0]], strict=True)
        lines += [Line3(start, end, plane.field.color) for start, end in around]
        for x0, y0, x1, y1, color, _ in list(plane.pen.strokes)[-MOST_STROKES:]:
            start, end = plane.field.place(x0, y0), plane.field.place(x1, y1)
            lines.append(Line3((*start, 0.0), (*end, 0.0), theme.readable(color, theme.DARK)))
    trails = plane.trails
    first = max(0, len(trails.heights) - MOST_STROKES)
    parts = zip(trails.strokes[first:], trails.heights[first:], strict=True)
    for (x0, y0, x1, y1, color, _), (z0, z1) in parts:
        # Few colours: each is drawn by itself.
        shade = Color(*(one // SHADES * SHADES for one in color))
        lines.append(Line3((x0, y0, z0), (x1, y1, z1), shade))
    return SpacePicture(plane.fixed, frames, solids, lines, moment.pair.source, plane.pair)


def opens_in_space(moment: SceneMoment) -> bool:
    """Whether a top view would show static frames on top of each other."""
    moves = any(not info.is_static and info.parent for info in moment.snapshot.frames)
    if moves or moment.picture.field is not None:
        return False
    return is_tall(frames_in_space(moment.snapshot, moment.picture.fixed))
