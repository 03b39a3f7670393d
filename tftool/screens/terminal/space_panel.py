"""Panel that shows frames in 3-D, and functions that make 3-D pictures of a scene.

Keys and the mouse orbit the panel's camera.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from rich.text import Text
from textual import events
from textual.binding import Binding
from textual.content import Content

from tftool.buffer.sample import Snapshot
from tftool.drawing.cells import packed
from tftool.drawing.plane import ColoredLines
from tftool.drawing.solids import Solids
from tftool.drawing.space import OrbitCamera, SpaceFrame, SpacePicture, is_tall
from tftool.drawing.space_canvas import SpaceCanvas, Tones, corners_of
from tftool.screens.terminal.frames_picture import in_snapshot
from tftool.screens.terminal.scene import SceneMoment
from tftool.screens.terminal.text_style import Look
from tftool.screens.terminal.world_app import Panel

FARTHEST = 1e9
"""Metres from the fixed frame beyond which nothing is drawn."""

MOST_STROKES = 3000
"""Largest number of strokes drawn of a drawing, and of all trails; older strokes are left out."""

FEW = 0xE0E0E0
"""Mask of the bits of a trail's colour that are used, so that there are few colours."""

_MOVES: Mapping[str, Callable[[OrbitCamera], None]] = {
    "shift+left": lambda camera: camera.turn(-1, 0),
    "shift+right": lambda camera: camera.turn(1, 0),
    "shift+up": lambda camera: camera.turn(0, 1),
    "shift+down": lambda camera: camera.turn(0, -1),
    "less_than_sign": lambda camera: camera.zoom(-1),
    "greater_than_sign": lambda camera: camera.zoom(1),
    "w": OrbitCamera.next_view,
    "a": OrbitCamera.fit,
}
"""Keys of this panel, which have no other meaning on a screen with it."""

SPACE_KEYS = """\
 p            show or hide the 3-D picture
 Shift+Arrow  turn the picture (or drag with the mouse)
 < >          zoom out, zoom in (also the wheel)
 w            another view: orbit, top, front, side
 y            keep the chosen frame in the middle, or the scene
 a            show everything again
 i            name all frames of a robot, or root, tips and the chosen one
"""

SPACE_BINDINGS = [
    Binding(key, f"space('{key}')", show=False, priority=True)
    for key in (*_MOVES, "y", "i")
    if not key.startswith("shift")
]
"""Key bindings of a screen whose `action_space` passes keys to `SpacePanel.press`."""

ORBIT_BINDINGS = [
    Binding(key, f"space('{key}')", show=False, priority=True)
    for key in _MOVES
    if key.startswith("shift")
]
"""Key bindings of the arrows, for a screen that does not use arrows otherwise."""


class SpacePanel(Panel):
    """Panel that can show frames in 3-D.

    Attributes:
        camera: Camera that orbits the frames.
        in_space: Whether the panel shows frames in 3-D, in place of text.
    """

    def __init__(self, name: str, title: str = "", *, can_focus: bool = True) -> None:
        super().__init__(name, title, can_focus=can_focus)
        self.camera = OrbitCamera()
        self.in_space = False
        self._names_all = False
        self._picture = SpacePicture()
        self._look = Look()
        self._canvas: SpaceCanvas | None = None
        self._key: object = None
        self._dragged: tuple[int, int] | None = None

    def draw(self, picture: SpacePicture, look: Look) -> None:
        """Show a 3-D picture in the panel."""
        self._picture, self._look = picture, look
        self._paint()

    def on_resize(self) -> None:
        """Draw the picture again in the new size of the panel."""
        if self.in_space:
            self._paint()

    def _paint(self) -> None:
        width, height = self.size
        if not width or not height:
            return
        look, tones = self._look, self._tones()
        key = width, height, look, tones
        if key != self._key or self._canvas is None:
            self._key = key
            self._canvas = SpaceCanvas(
                width, height, palette=look.palette, tones=tones, ascii_only=look.ascii_only
            )
        picture = replace(self._picture, names_all=self._names_all)
        if not picture.frames:
            self.show([Text("There are no frames yet.", look.ink(look.palette.dim))])
            return
        view = self.camera.view(picture, corners_of(picture), width, height)
        follows = f", follows {self.camera.follows}" if self.camera.follows else ""
        self.border_subtitle = Content(f"view: {self.camera.name}{follows}")
        self.show(self._canvas.lines(picture, view))

    def _tones(self) -> Tones:
        console = self.app.console
        if console.no_color or console.color_system is None or not self._has_colors():
            return "none"
        return "few" if console.color_system == "standard" else "full"

    def _has_colors(self) -> bool:
        setting = getattr(self.app, "setting", None)
        return setting is None or bool(setting.colors)

    def frame_at(self, x: int, y: int) -> str | None:
        """Return the frame nearest to a cell of the panel; None if no frame is within 3 cells."""
        return None if self._canvas is None else self._canvas.frame_at(x, y)

    # Keys and the mouse

    def press(self, key: str, chosen: str = "") -> bool:
        """Handle a key; return False if the key has no meaning in this panel.

        Args:
            key: Name of the key.
            chosen: Frame that the key "y" keeps in the middle.
        """
        if not self.in_space:
            return False
        if key == "y":
            self.camera.follows = "" if self.camera.follows == chosen else chosen
        elif key == "i":
            self._names_all = not self._names_all
        elif key in _MOVES:
            _MOVES[key](self.camera)
        else:
            return False
        self._paint()
        return True

    def on_mouse_down(self, event: events.MouseDown) -> None:
        """Start to drag the picture."""
        if self.in_space:
            self._dragged = event.screen_x, event.screen_y

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Orbit while the left mouse button is pressed, pan while another button is pressed."""
        if self._dragged is None or not self.in_space:
            return
        event.stop()
        if not event.button:
            self._dragged = None
            return
        x, y = event.screen_x - self._dragged[0], event.screen_y - self._dragged[1]
        self._dragged = event.screen_x, event.screen_y
        if event.button == 1:
            self.camera.turn(-0.4 * x, 0.8 * y)
        else:
            self.camera.pan(x, y)
        self._paint()

    def on_mouse_up(self) -> None:
        """Stop dragging the picture."""
        self._dragged = None

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Zoom in by a step."""
        self._wheel(event, 1)

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Zoom out by a step."""
        self._wheel(event, -1)

    def _wheel(self, event: events.MouseEvent, steps: int) -> None:
        if self.in_space:
            event.stop()
            self.camera.zoom(steps)
            self._paint()


def frames_in_space(
    snapshot: Snapshot,
    fixed: str,
    ages: Mapping[str, float] | None = None,
) -> tuple[SpaceFrame, ...]:
    """Return the frames in the tree of `fixed`, with their poses in `fixed`.

    Args:
        snapshot: Snapshot of the frames.
        fixed: Fixed frame of the picture.
        ages: Seconds since each frame's newest transform.
    """
    lookup = in_snapshot(snapshot)
    root = snapshot.frame(fixed).root if fixed in snapshot else None
    found = []
    for info in snapshot.frames:
        pose = lookup(fixed, info.frame) if info.root == root and root is not None else None
        if pose is not None and math.dist(pose.translation, (0, 0, 0)) < FARTHEST:
            age = 0.0 if ages is None else ages.get(info.frame, 0.0)
            found.append(SpaceFrame(info.frame, pose, info.parent, age))
    return tuple(found)


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
