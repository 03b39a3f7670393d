"""3-D pictures of a scene's moments."""

from tftool.drawing import theme
from tftool.drawing.space import Line3, SpacePicture
from tftool.screens.terminal.scene import SceneMoment
from tftool.screens.terminal.space_panel import frames_in_space, is_tall

MOST_STROKES = 3000
"""Of a turtle's drawing the newest strokes are drawn."""


def space_picture(moment: SceneMoment) -> SpacePicture:
    """Return a moment's frames in 3-D, with the turtles' field and trails."""
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
    return SpacePicture(plane.fixed, frames, None, lines, moment.pair.source, plane.pair)


def opens_in_space(moment: SceneMoment) -> bool:
    """Whether a top view would show static frames on top of each other."""
    moves = any(not info.is_static and info.parent for info in moment.snapshot.frames)
    if moves or moment.picture.field is not None:
        return False
    return is_tall(frames_in_space(moment.snapshot, moment.picture.fixed))
