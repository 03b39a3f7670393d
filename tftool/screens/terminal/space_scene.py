"""3-D pictures of a scene at one time."""

import numpy as np

from tftool.drawing.cells import packed
from tftool.drawing.plane import ColoredLines
from tftool.drawing.solids import Solids
from tftool.drawing.space import SpacePicture, is_tall
from tftool.screens.terminal.scene import SceneMoment
from tftool.screens.terminal.space_panel import frames_in_space

MOST_STROKES = 3000
"""Most strokes drawn of a drawing, and of all trails: the newest ones."""

FEW = 0xE0E0E0
"""Mask of the bits of a trail's colour that are used, so that there are few colours."""


def space_picture(moment: SceneMoment, solids: Solids | None = None) -> SpacePicture:
    """Return a 3-D picture of a scene: frames, trails, the robot's shapes, the turtles' field."""
    plane = moment.picture
    frames = frames_in_space(moment.snapshot, plane.fixed, moment.ages)
    ends, colors = [plane.trails.ends[-MOST_STROKES:]], [plane.trails.colors[-MOST_STROKES:]]
    if plane.field is not None:
        corners = plane.field.corners()
        edges = np.array([(*corners[n - 1], *corners[n]) for n in range(4)])
        strokes = list(plane.pen.strokes)[-MOST_STROKES:]
        drawn = np.array([stroke[:4] for stroke in strokes], float).reshape(-1, 4)
        flat = np.concatenate([edges, plane.field.placed(drawn)]).reshape(-1, 2, 2)
        ends.insert(0, np.pad(flat, ((0, 0), (0, 0), (0, 1))))
        inks = [plane.field.color] * 4 + [stroke[4] for stroke in strokes]
        colors.insert(0, np.array([packed(ink) for ink in inks]))
    # Few colours, because each one is drawn separately.
    lines = ColoredLines(np.concatenate(ends), np.concatenate(colors) & FEW)
    return SpacePicture(plane.fixed, frames, solids, lines, moment.pair.source, plane.pair)


def opens_in_space(moment: SceneMoment) -> bool:
    """Return whether a scene is better shown in 3-D than from above.

    A scene of static frames that differ mostly in height is better shown in 3-D.
    """
    moves = any(not info.is_static and info.parent for info in moment.snapshot.frames)
    if moves or moment.picture.field is not None:
        return False
    return is_tall(frames_in_space(moment.snapshot, moment.picture.fixed))
