"""Data of a 3-D picture of frames, and the camera that orbits the frames."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.drawing.plane import ColoredLines, grid_step
from tftool.drawing.solids import Solids
from tftool.geometry.rigid import Transform

Floats: TypeAlias = npt.NDArray[np.float64]

VIEWS: Final = {"orbit": (-60.0, 25.0), "top": (-90.0, 90.0), "front": (0.0, 0.0),
                "side": (-90.0, 0.0)}  # fmt: skip
"""Azimuth around the vertical axis and elevation above the ground, degrees, by name of the view."""

AZIMUTHS: Final = tuple(range(-60, 300, 15))
ELEVATIONS: Final = (25.0, 40.0, 55.0)
"""Candidate directions of the camera, degrees; the first azimuth and elevation are the usual."""

BETTER: Final = 0.9
"""Fraction of the usual scale from which another direction is chosen."""

FLAT: Final = 0.01
"""Height of a flat scene without solids, as a fraction of its width."""

TURN: Final = math.radians(7.5)
"""Angle in radians of one step around the scene."""

STEP: Final = 1.25
"""Magnification of one step of the zoom."""

NEAREST, MOST_DISTANT = 1e3, 1e-3
"""Limits of the zoom, as magnifications of the view of the whole scene."""

ROOMY: Final = 0.6
"""Fraction of the view that a scene must fill so that the view does not shrink."""


@dataclass(frozen=True, slots=True)
class SpaceFrame:
    """One frame of the picture.

    Attributes:
        name: Name of the frame.
        pose: Pose in the fixed frame.
        parent: Name of the parent; None for a root.
        age: Seconds since the frame's newest transform; 0 for static frames.
    """

    name: str
    pose: Transform
    parent: str | None = None
    age: float = 0.0


@dataclass(frozen=True, slots=True)
class SpacePicture:
    """Data of a 3-D picture of frames, at one time, in one fixed frame.

    Attributes:
        fixed: Name of the fixed frame.
        frames: Frames of the fixed frame's tree.
        solids: Shapes that move with the frames.
        lines: Trails and other lines.
        chosen: Name of the frame under the cursor: its name is bold and its solid coloured.
        pair: Names of two frames that a line connects.
        names_all: Whether to name all frames of a robot. Otherwise only the root, frames without
            children and the chosen frame are named.
    """

    fixed: str = ""
    frames: tuple[SpaceFrame, ...] = ()
    solids: Solids | None = None
    lines: ColoredLines = field(default_factory=ColoredLines)
    chosen: str = ""
    pair: tuple[str, str] = ("", "")
    names_all: bool = False


class Viewpoint(NamedTuple):
    """Direction, centre and scale of an orthographic view.

    Attributes:
        axes: Unit vectors to the right, up and towards the viewer, as rows.
        middle: Point in the middle of the picture, metres.
        scale: Metres per braille dot; a cell is two dots wide and four high.
    """

    axes: Floats
    middle: Floats
    scale: float

    def project(self, points: npt.NDArray[np.floating]) -> npt.NDArray[np.floating]:
        """Project points to dots right and up from the centre, and depth towards the viewer."""
        axes = (self.axes / self.scale).astype(points.dtype)
        return (points - self.middle.astype(points.dtype)) @ axes.T

    @property
    def grid(self) -> float:
        """Step of the ground grid, metres."""
        return grid_step(4.0 * self.scale)


class OrbitCamera:
    """Camera that orbits a scene, and shows the whole scene until the user zooms or pans.

    Until the user chooses a direction, the camera looks from above at a flat scene. It looks at
    other scenes from the direction in which the scene appears largest.

    Until the user zooms or pans, the view grows at once with the scene. The view shrinks only when
    most of the view is empty.

    Attributes:
        name: Name of the view; "orbit" after the camera was turned.
        follows: Name of the frame in the middle; empty for the middle of the scene.
    """

    def __init__(self, name: str = "") -> None:
        self.follows = ""
        self._factor = 1.0
        self._shift = (0.0, 0.0)
        self._box: Floats | None = None
        self._scale = 1.0
        self._seen: tuple[object, ...] = ("",)
        self.look_from(name or "orbit")
        self._is_chosen = bool(name)

    def look_from(self, name: str) -> None:
        """Look from the direction of one of `VIEWS`."""
        self.name, self._is_chosen = name, True
        self._azimuth, self._elevation = map(math.radians, VIEWS[name])

    def next_view(self) -> None:
        """Look from the direction of the next of `VIEWS`."""
        names = list(VIEWS)
        self.look_from(names[(names.index(self.name) + 1) % len(names)])

    def turn(self, right: float, up: float) -> None:
        """Move the camera around the scene by `right` steps to the right and `up` steps up."""
        self.name, self._is_chosen = "orbit", True
        self._azimuth += TURN * right
        quarter = 0.5 * math.pi
        self._elevation = min(quarter, max(-quarter, self._elevation + TURN * up))

    def zoom(self, steps: float) -> None:
        """Zoom in by a number of steps, or out if the number is negative."""
        self._factor = min(NEAREST, max(MOST_DISTANT, self._factor * STEP**steps))

    def pan(self, columns: float, rows: float) -> None:
        """Move the view by `columns` cells to the right and `rows` cells down."""
        right, up = self._shift
        self._shift = right + 2.0 * columns * self._scale, up - 4.0 * rows * self._scale

    def fit(self) -> None:
        """Show the whole scene again, after zooming and panning."""
        self._factor, self._shift, self._box, self.follows = 1.0, (0.0, 0.0), None, ""

    def view(self, picture: SpacePicture, corners: Floats, columns: int, rows: int) -> Viewpoint:
        """Return the view for a picture of columns × rows of cells.

        Args:
            picture: Data of the picture.
            corners: All points that should be visible, shape (n, 3).
            columns: Width of the picture in cells.
            rows: Height of the picture in cells.
        """
        has_solids = picture.solids is not None and len(picture.solids.triangles) > 0
        seen = picture.fixed, len(picture.frames), has_solids, columns, rows
        is_new = seen != self._seen
        if seen[0] != self._seen[0]:
            self._box = None
        self._seen = seen
        box = self._box = self._fitted(corners)
        low, high = box
        reach = np.array([[x, y, z] for x in box[:, 0] for y in box[:, 1] for z in box[:, 2]])
        middle = 0.5 * (low + high)
        # Axes and names need some room around the frames; a robot has few of them.
        axis = 4.0 * max(1.2, rows / 10.0)
        across = max(1.0, 2 * columns - (8.0 if has_solids else max(16.0, 2.4 * axis)))
        down = max(1.0, 4 * rows - max(8.0, axis))

        def scale() -> float:
            wide, tall = 2.0 * np.abs((reach - middle) @ self._axes()[:2].T).max(0)
            return max(float(wide) / across, float(tall) / down, 1e-9)

        if is_new and not self._is_chosen:
            is_flat = not has_solids and high[2] - low[2] < FLAT * (high - low).max()
            self._aim(scale, is_flat=is_flat and len(picture.frames) > 1)
        axes = self._axes()
        self._scale = scale() / self._factor
        for one in picture.frames:
            if one.name == self.follows:
                middle = np.array(one.pose.translation)
        right, up = self._shift
        return Viewpoint(axes, middle - right * axes[0] - up * axes[1], self._scale)

    def _aim(self, scale: Callable[[], float], *, is_flat: bool) -> None:
        """Look from above at a flat scene, at other scenes from the direction of the best scale.

        Args:
            scale: Function that returns the scale in metres per dot for the present direction.
            is_flat: Whether the scene is flat.
        """
        self.look_from("top" if is_flat else "orbit")
        self._is_chosen = False
        if is_flat:
            return
        best = BETTER * scale()
        chosen = self._azimuth, self._elevation
        for turned in AZIMUTHS:
            for raised in ELEVATIONS:
                self._azimuth, self._elevation = math.radians(turned), math.radians(raised)
                if (found := scale()) < best - 1e-9:
                    best, chosen = found, (self._azimuth, self._elevation)
        self._azimuth, self._elevation = chosen

    def _axes(self) -> Floats:
        azimuth, elevation = self._azimuth, self._elevation
        toward = np.array(
            [
                math.cos(elevation) * math.cos(azimuth),
                math.cos(elevation) * math.sin(azimuth),
                math.sin(elevation),
            ]
        )
        right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
        return np.stack([right, np.cross(toward, right), toward])

    def _fitted(self, corners: Floats) -> Floats:
        kept = self._box
        corners = corners[np.isfinite(corners).all(1)]
        if not len(corners):
            return np.array([[-1.0] * 3, [1.0] * 3]) if kept is None else kept
        box = np.stack([corners.min(0), corners.max(0)])
        size = float((box[1] - box[0]).max())
        if size <= 0.0:
            box = box + np.array([[-0.5], [0.5]])
        if kept is None or size < ROOMY * float((kept[1] - kept[0]).max()):
            return box
        low, high = np.minimum(kept[0], box[0]), np.maximum(kept[1], box[1])
        # With a margin, or the view would grow a little with every picture.
        room = 0.05 * float((high - low).max())
        return np.stack([low - room * (low < kept[0]), high + room * (high > kept[1])])


def axis_length(view: Viewpoint, rows: int, frames: int) -> float:
    """Return the length in metres of the axes of each frame; shorter for more than 20 frames."""
    crowded = math.sqrt(20.0 / max(20, frames))
    return view.scale * 4.0 * max(1.2, crowded * rows / 10.0)


def is_tall(frames: Sequence[SpaceFrame]) -> bool:
    """Whether frames differ more in height (z), which a view from above hides, than in x and y."""
    if len(frames) < 2:
        return False
    across, along, up = (
        max(axis) - min(axis)
        for axis in zip(*(one.pose.translation for one in frames), strict=True)
    )
    return bool(up > max(across, along))
