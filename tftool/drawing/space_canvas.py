"""Drawing of 3-D pictures of frames in a terminal: shaded solids, and lines in braille dots.

The depth buffer has one point per braille dot; four points make one half block of a solid. Solids
hide the lines of the ground, but not the axes of frames.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
from numpy.lib.stride_tricks import sliding_window_view
from rich.cells import cell_len

from tftool.base.color import Color
from tftool.drawing import theme
from tftool.drawing.cells import NONE, CellSheet, Dots, Line, dots_of, packed
from tftool.drawing.labels import (
    ON_AXIS,
    SOLID,
    TAKEN,
    Label,
    PlacedLabel,
    Placer,
    label_text,
)
from tftool.drawing.plane import grid_step
from tftool.drawing.space import SpaceFrame, SpacePicture, Viewpoint, axis_length, is_tall
from tftool.drawing.table_columns import plain

Floats: TypeAlias = npt.NDArray[np.float32]
Indices: TypeAlias = npt.NDArray[np.int64]
Tones = Literal["full", "few", "none"]
"""Number of colours of a terminal: all, sixteen, or none."""

MOST_NAMED: Final = 40
"""Largest number of names that are written."""

LETTERED_FROM: Final = 15
"""Smallest number of rows of a picture whose axes have letters."""

MOST_LETTERED: Final = 4
"""Most frames whose axes have letters; more letters would hide the frames."""

MOST_GRID: Final = 10
"""Most steps of the ground's grid to a side; a finer grid would look like a carpet."""

CELLS_PER_NAME: Final = 150
"""Cells of a picture for each name; in a small picture, more names would hide the robot."""

ASIDES: Final = (0, 2, 4, 7, 10, 14, 18)
"""Distances in columns between a name and its frame, so that names do not cover the robot."""

MOST_POINTS: Final = 1_000_000
"""Points of triangles that are processed at once, to limit memory."""

_LIGHT: Final = np.array([-0.35, 0.6, 0.72], np.float32)
_RAMPS: Final = {True: " .:=+*#%@", False: "  ░░▒▒▓▓██"}


class DepthBuffer(NamedTuple):
    """Nearest surface at each point of a picture; the first row is at the top.

    Attributes:
        owners: Index of the triangle at each point, shape (height, width); -1 without a surface.
        depths: Depth of the surface at each point in widths of a point, shape (height, width). A
            larger depth is nearer to the viewer; minus infinity without a surface.
    """

    owners: Indices
    depths: Floats


class Layer(NamedTuple):
    """Lines of one colour.

    Attributes:
        color: Colour of the lines.
        ends: Both ends of each line in dots from the middle of the picture, shape (n, 2, 3).
        is_hidden: Whether solids in front of the lines hide them.
    """

    color: Color
    ends: npt.NDArray[np.floating]
    is_hidden: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class DrawnSpace:
    """Picture as pixels and lines, before conversion to a terminal's cells or a file.

    Attributes:
        image: Red, green and blue from 0 to 255 of the solids at every dot.
        depth: Nearest triangle at every dot, and its depth.
        layers: Lines in the order in which they are drawn.
        edges: Mask of the dots of outlines: where one part hides another and, in a plain picture
            (see `drawn`), around solids.
        names: Labels, the most important first: the frame, the text, the number of frames at this
            position, and the column and row in dots from the upper left corner.
        grid: Metres between two lines of the grid.
    """

    image: Floats
    depth: DepthBuffer
    layers: Sequence[Layer]
    edges: npt.NDArray[np.bool_]
    names: Sequence[tuple[SpaceFrame, str, int, float, float]]
    grid: float


def rasterise(corners: Floats, triangles: Indices, width: int, height: int) -> DepthBuffer:
    """Find the nearest triangle at every point of a picture.

    Args:
        corners: Corners to the right and up from the middle, and towards the viewer, in points,
            shape (n, 3).
        triangles: Indices of three corners each, shape (m, 3).
        width: Width of the picture in points.
        height: Height of the picture in points.
    """
    owners = np.full(width * height, -1, np.int64)
    depths = np.full(width * height, -np.inf, np.float32)
    x, y, z = corners.T[:, triangles.T] if len(triangles) else np.zeros((3, 3, 0), np.float32)
    x, y = x + np.float32(0.5 * width), np.float32(0.5 * height) - y
    with np.errstate(invalid="ignore", divide="ignore"):
        left = np.clip(np.ceil(x.min(0) - 0.5), 0, width)
        right = np.clip(np.floor(x.max(0) - 0.5), -1, width - 1)
        top = np.clip(np.ceil(y.min(0) - 0.5), 0, height)
        bottom = np.clip(np.floor(y.max(0) - 0.5), -1, height - 1)
        wide, tall = right - left + 1, bottom - top + 1
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        (seen,) = np.nonzero((wide > 0) & (tall > 0) & (np.abs(area) > 1e-9))
    if not len(seen):
        return DepthBuffer(owners.reshape(height, width), depths.reshape(height, width))
    x, y, z, area = x[:, seen], y[:, seen], z[:, seen], area[seen]
    wide, left, top = (one[seen].astype(np.int32) for one in (wide, left, top))
    counts = wide * tall[seen].astype(np.int32)
    # Two barycentric weights as planes over the picture, from the first point of each triangle.
    planes = np.empty((9, len(seen)), np.float32)
    planes[0], planes[1] = (y[1] - y[2]) / area, (x[2] - x[1]) / area
    planes[2], planes[3] = (y[2] - y[0]) / area, (x[0] - x[2]) / area
    from_x, from_y = left + np.float32(0.5) - x[2], top + np.float32(0.5) - y[2]
    planes[4] = planes[0] * from_x + planes[1] * from_y
    planes[5] = planes[2] * from_x + planes[3] * from_y
    planes[6], planes[7], planes[8] = z[0] - z[2], z[1] - z[2], z[2]
    cuts = np.flatnonzero(np.diff(np.cumsum(counts, dtype=np.int64) // MOST_POINTS)) + 1
    for some in np.split(np.arange(len(seen)), cuts):
        count = counts[some]
        one = np.repeat(some, count)
        place = np.arange(len(one), dtype=np.int32) - np.repeat(
            np.cumsum(count, dtype=np.int32) - count, count
        )
        down, across = np.divmod(place, wide[one])
        plane = planes[:, one]
        first = plane[0] * across + plane[1] * down + plane[4]
        second = plane[2] * across + plane[3] * down + plane[5]
        slack = np.float32(-1e-4)
        (inside,) = np.nonzero((first >= slack) & (second >= slack) & (first + second <= 1 - slack))
        first, second, plane = first[inside], second[inside], plane[6:, inside]
        depth = first * plane[0] + second * plane[1] + plane[2]
        one = one[inside]
        point = (top[one] + down[inside]).astype(np.int64) * width + left[one] + across[inside]
        nearer = depth > depths[point]
        point, depth, one = point[nearer], depth[nearer], one[nearer]
        # If a point gets several values, numpy stores the last one, which is the nearest.
        order = np.argsort(depth)
        point = point[order]
        depths[point], owners[point] = depth[order], seen[one[order]]
    return DepthBuffer(owners.reshape(height, width), depths.reshape(height, width))


def drawn(
    picture: SpacePicture,
    view: Viewpoint,
    columns: int,
    rows: int,
    palette: theme.Palette = theme.DARK,
    *,
    tinted: bool = True,
    plain: bool = False,
) -> DrawnSpace:
    """Draw a picture in columns × rows of cells.

    Args:
        picture: Data of the picture.
        view: Direction, centre and scale of the view.
        columns: Width in cells of two dots.
        rows: Height in cells of four dots.
        palette: Colours of the screen.
        tinted: Whether the solid under the cursor takes the colour of the cursor.
        plain: Whether to draw for a terminal of few colours. The ground is then a dot at each
            crossing of its grid. On a robot, only the frame under the cursor has axes and a line
            to the parent frame. A small picture of a robot with many frames is always plain.
    """
    width, height = 2 * columns, 4 * rows
    poses = {one.name: one.pose for one in picture.frames}
    solids = picture.solids
    image = np.zeros((height, width, 3), np.float32)
    edges = np.zeros((height, width), bool)
    if solids is None:
        depth = rasterise(np.zeros((0, 3), np.float32), np.zeros((0, 3), int), width, height)
    else:
        corners = view.project(solids.placed(poses))
        depth = rasterise(corners, solids.triangles, width, height)
        found = depth.owners >= 0
        owners = depth.owners[found]
        # On a dark screen, black parts would be invisible.
        colors = solids.colors[owners] ** 0.6
        parts = solids.parts()[owners]
        if tinted and picture.chosen in solids.frames:
            accent = np.array(palette.accent, np.float32) / 255.0
            mine = parts == solids.frames.index(picture.chosen)
            colors[mine] = 0.35 * colors[mine] + 0.65 * accent
        shades = _shades(corners, solids.triangles, owners)
        image[found] = 255.0 * colors * shades[:, None]
        whose = np.full(depth.owners.shape, -1)
        whose[found] = parts
        edges = _edges(whose, depth.depths)
        image[edges] *= 0.6
        if plain:
            edges |= _outline(found)
    places = view.project(np.array([one.pose.translation for one in picture.frames]).reshape(-1, 3))
    names = [
        (one, name, count, 0.5 * width + x, 0.5 * height - y)
        for one, name, count, (x, y, _) in _named(picture, places.tolist())
    ]
    ground, grid = _ground(picture, view, view.scale * max(width, height), sparse=plain)
    layers = [Layer(theme.paper(palette).grid, view.project(ground), is_hidden=True)]
    is_robot = solids is not None and len(solids.triangles) > 0
    is_crowded = len(picture.frames) * CELLS_PER_NAME > columns * rows
    lined = [
        one
        for one in picture.frames
        if not (is_robot and (plain or is_crowded)) or one.name == picture.chosen
    ]
    layers += _layers(picture, view, rows, palette, lined)
    return DrawnSpace(image, depth, layers, edges, names, grid)


def _shades(corners: Floats, triangles: Indices, owners: Indices) -> Floats:
    """Return the brightness of each point from the orientation of its triangle."""
    used, where = np.unique(owners, return_inverse=True)
    first, second, third = (corners[triangles[used, corner]] for corner in range(3))
    ahead, aside = second - first, third - first
    normals = np.stack(
        [
            ahead[:, 1] * aside[:, 2] - ahead[:, 2] * aside[:, 1],
            ahead[:, 2] * aside[:, 0] - ahead[:, 0] * aside[:, 2],
            ahead[:, 0] * aside[:, 1] - ahead[:, 1] * aside[:, 0],
        ],
        1,
    )
    lengths = np.sqrt((normals * normals).sum(1)) + np.float32(1e-12)
    # Meshes differ in which side of a triangle is outside: the visible side counts.
    facing = np.where(normals[:, 2] < 0.0, -1.0, 1.0) / lengths
    light = np.clip((normals @ _LIGHT) * facing, 0.0, 1.0)
    shade: Floats = (0.28 + 0.72 * light).astype(np.float32)
    return shade[where]


def _edges(parts: Indices, depths: Floats) -> npt.NDArray[np.bool_]:
    """Return a mask of the points at which one part of the robot hides another part.

    A point is masked if a neighbour on another part, or far from it in depth, is in front of it.

    Args:
        parts: Index of the part drawn at each point; -1 where no part is drawn.
        depths: Depth of each point.
    """
    edge = np.zeros(parts.shape, bool)
    with np.errstate(invalid="ignore"):
        for here, there in (
            (np.s_[:, :-1], np.s_[:, 1:]),
            (np.s_[:-1], np.s_[1:]),
        ):
            both = (parts[here] >= 0) & (parts[there] >= 0)
            gap = depths[here] - depths[there]
            apart = both & ((parts[here] != parts[there]) | (np.abs(gap) > 8.0))
            edge[here] |= apart & (gap <= 0)
            edge[there] |= apart & (gap > 0)
    return edge


def _outline(solid: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Return a mask of the outermost points of solids; `solid` is the mask of all points."""
    around = np.pad(solid, 1)
    inner: npt.NDArray[np.bool_] = solid & (
        around[:-2, 1:-1] & around[2:, 1:-1] & around[1:-1, :-2] & around[1:-1, 2:]
    )
    return solid & ~inner


def _ends(picture: SpacePicture) -> set[str]:
    """Return the names of the roots and of the frames without children."""
    parents = {one.parent for one in picture.frames}
    return {one.name for one in picture.frames if one.parent is None or one.name not in parents}


def _named(
    picture: SpacePicture, places: Sequence[Sequence[float]]
) -> list[tuple[SpaceFrame, str, int, Sequence[float]]]:
    """Return (frame, label, number of frames, position) for each position that has frames.

    The order is: the chosen frame, the pair's frames, frames without children, roots, other frames.
    """
    labels: dict[tuple[int, int], list[int]] = {}
    parents, ends = {one.parent for one in picture.frames}, _ends(picture)

    def weight(number: int) -> tuple[bool, bool, bool, bool]:
        one = picture.frames[number]
        is_tip = one.name not in parents
        return (
            one.name != picture.chosen,
            one.name not in picture.pair,
            not is_tip,
            one.parent is not None,
        )

    for number in sorted(range(len(places)), key=weight):
        x, y, _ = places[number]
        if abs(x) + abs(y) < 1e6:
            labels.setdefault((round(x / 3.0), round(y / 5.0)), []).append(number)
    # Where frames differ mostly in height, the height is the number to see.
    has_heights = picture.solids is None and is_tall(picture.frames)
    found = []
    for group in labels.values():
        group.sort(
            key=lambda number: (weight(number)[0], picture.frames[number].name not in ends, number)
        )
        names = [plain(picture.frames[number].name) for number in group]
        shown = 2 if len("".join(names[:2])) <= 18 else 1
        more = f" +{len(names) - shown}" if len(names) > shown else ""
        label = ", ".join(names[:shown]) + more
        height = picture.frames[group[0]].pose.translation.z
        label += f" z {height:.3g} m" if has_heights and abs(height) > 1e-3 else ""
        found.append((picture.frames[group[0]], label, len(group), places[group[0]]))
    return found


def _layers(
    picture: SpacePicture,
    view: Viewpoint,
    rows: int,
    palette: theme.Palette,
    with_axes: Sequence[SpaceFrame],
) -> list[Layer]:
    """Return the lines in drawing order: trails, lines to parents, the pair, axes.

    Only the frames in `with_axes` have axes and a line to their parent.
    """
    paper = theme.paper(palette)
    poses = {one.name: one.pose for one in picture.frames}
    layers = []
    lines = picture.lines
    for packed_color in np.unique(lines.colors).tolist():
        color = Color(packed_color >> 16, packed_color >> 8 & 255, packed_color & 255)
        ends = lines.ends[lines.colors == packed_color]
        layers.append(Layer(color, view.project(ends)))
    links = [
        (one.pose.translation, poses[one.parent].translation)
        for one in with_axes
        if one.parent in poses
    ]
    layers.append(Layer(paper.link, view.project(np.array(links, float).reshape(-1, 2, 3))))
    if picture.pair[0] in poses and picture.pair[1] in poses:
        pair = [[poses[name].translation for name in picture.pair]]
        layers.append(Layer(paper.accent, view.project(np.array(pair, float))))
    length = axis_length(view, rows, len(with_axes))
    for number, color in enumerate((paper.x_axis, paper.y_axis, paper.z_axis)):
        axis = tuple(length * (place == number) for place in range(3))
        ends = [(one.pose.translation, one.pose.apply(axis)) for one in with_axes]
        layers.append(Layer(color, view.project(np.array(ends, float).reshape(-1, 2, 3))))
    return layers


def _ground(
    picture: SpacePicture, view: Viewpoint, reach: float, *, sparse: bool
) -> tuple[npt.NDArray[np.float64], float]:
    """Return the lines of the ground grid and the grid's step.

    Args:
        picture: Data of the picture.
        view: Direction, centre and scale of the view.
        reach: The larger of the picture's width and height, metres.
        sparse: Whether to return only the crossings of the grid, as lines of length 0.

    Returns:
        Ends of the lines, metres, shape (n, 2, 3), and the step, metres.
    """
    step = view.grid
    places = np.array([one.pose.translation for one in picture.frames]).reshape(-1, 3)
    places = places if len(places) else np.zeros((1, 3))
    # Lines that are outside of the picture, after zooming in, do not count.
    while min(reach, float(np.ptp(places[:, :2], axis=0).max())) > (MOST_GRID - 4) * step:
        step = grid_step(0.3 * step)
    # Below high frames, a small ground would not look like the ground.
    around = 2 + np.floor(0.2 * np.ptp(places[:, 2]) / step)
    low = np.floor(places[:, :2].min(0) / step) - around
    high = np.ceil(places[:, :2].max(0) / step) + around
    # Frames may be kilometres apart: only the part near the middle is drawn.
    middle = view.middle[:2] / step
    low, high = np.maximum(low, np.floor(middle) - 60), np.minimum(high, np.ceil(middle) + 60)
    (left, near), (right, far) = low * step, high * step
    along = np.arange(low[0], high[0] + 0.5) * step
    across = np.arange(low[1], high[1] + 0.5) * step
    if sparse:
        crossings = [(x, y, 0.0) for x in along for y in across]
        return np.repeat(np.array(crossings).reshape(-1, 1, 3), 2, axis=1), step
    lines = [((x, near, 0.0), (x, far, 0.0)) for x in along]
    lines += [((left, y, 0.0), (right, y, 0.0)) for y in across]
    return np.array(lines).reshape(-1, 2, 3), step


class SpaceCanvas:
    """Drawer of 3-D pictures of frames as lines of a terminal.

    Args:
        columns: Width in cells.
        rows: Height in cells.
        palette: Colours of the screen.
        tones: Number of colours of the terminal.
        ascii_only: Whether to draw with ASCII characters only.
    """

    def __init__(
        self,
        columns: int,
        rows: int,
        *,
        palette: theme.Palette = theme.DARK,
        tones: Tones = "full",
        ascii_only: bool = False,
    ) -> None:
        self.columns, self.rows = columns, rows
        self._palette, self._tones, self._ascii = palette, tones, ascii_only
        self._has_halves = tones == "full" and not ascii_only
        self._placer = Placer(columns, rows, ASIDES)
        self._sheet: CellSheet | None = None
        self._places: list[tuple[float, float, str]] = []

    def lines(self, picture: SpacePicture, view: Viewpoint) -> list[Line]:
        """Draw a picture; return it as one line of text per row of the canvas."""
        columns, rows = self.columns, self.rows
        if not columns or not rows:
            return [[] for _ in range(rows)]
        tinted = self._tones == "full"
        plain = self._ascii or not tinted
        drawing = drawn(picture, view, columns, rows, self._palette, tinted=tinted, plain=plain)
        self._places = [(x / 2.0, y / 4.0, one.name) for one, _, _, x, y in drawing.names]
        sheet = self._shaded(drawing)
        # A cell with a line shows one colour of the solid: of its upper half, else the lower.
        halves = sheet.inks.copy() if self._has_halves else sheet.grounds
        # Lines of the ground never cover a cell of a solid.
        solid = _solid(drawing, columns, rows)
        ground = self._dotted(drawing, drawing.layers[:1])
        ground.masks[solid] = 0
        points = sheet.lay(ground, ascii_only=self._ascii)
        if self._ascii:
            sheet.texts[points] = "."
        dots = self._dotted(drawing, drawing.layers[1:])
        sheet.grounds = np.where(dots.masks > 0, halves, sheet.grounds)
        marked = sheet.lay(dots, ascii_only=self._ascii)
        self._name(drawing, picture, sheet, marked, solid)
        if self._tones == "none":
            sheet.inks[:], sheet.grounds[:] = NONE, NONE
        lines = sheet.lines(self._sheet)
        self._sheet = sheet
        return lines

    def frame_at(self, column: int, row: int) -> str | None:
        """Return the frame nearest to a cell of the last picture; None if no frame is near."""
        near = [
            (max(0.5 * abs(x - column - 0.5), abs(y - row - 0.5)), name)
            for x, y, name in self._places
        ]
        away, name = min(near, default=(9.0, ""))
        return name if away <= 1.5 else None

    def _shaded(self, drawing: DrawnSpace) -> CellSheet:
        """Return the cells of the solids, as half blocks or shaded characters."""
        columns, rows = self.columns, self.rows
        found = drawing.depth.owners >= 0
        sheet = CellSheet(columns, rows)
        if not self._has_halves:
            total = found.reshape(rows, 4, columns, 2).sum((1, 3))
            some = total > 0
            color = drawing.image.reshape(rows, 4, columns, 2, 3).sum((1, 3))
            bright = color.max(2) / 255.0 / 8.0
            ramp = np.array(list(_RAMPS[self._ascii]), "<U4")
            steps = len(ramp) - 1
            shades = np.clip(np.ceil(bright[some] * steps), 2, steps).astype(int)
            sheet.texts[some] = ramp[shades]
            mean = color[some] / total[some][:, None]
            # The character shows the brightness, its colour only the hue.
            hue = mean * (230.0 / np.maximum(mean.max(1, keepdims=True), 1.0))
            sheet.inks[some] = _few_shades(hue)
            if self._ascii:
                # Strokes only beside a broad part: a thin part of only strokes is unreadable.
                full = np.pad(total == 8, 2)
                broad = full[1:, 1:] & full[1:, :-1] & full[:-1, 1:] & full[:-1, :-1]
                beside = sliding_window_view(broad, (4, 4)).any((2, 3))
                down, across = np.nonzero(drawing.edges)
                strokes = Dots(columns, rows)
                strokes.mark(across, down, NONE)
                strokes.masks[(total == 8) | ~beside] = 0
                sheet.lay(strokes, sheet.inks, ascii_only=True)
            return sheet
        count = found.reshape(rows, 2, 2, columns, 2).sum((2, 4))
        color = drawing.image.reshape(rows, 2, 2, columns, 2, 3).sum((2, 4))
        ground = np.array(self._palette.panel, np.float32)
        halves = _few_shades((color + (4 - count)[..., None] * ground) / 4.0)
        halves[count < 2] = NONE
        upper, lower = halves[:, 0], halves[:, 1]
        sheet.texts[lower >= 0], sheet.texts[upper >= 0] = "▄", "▀"
        sheet.inks = np.where(upper >= 0, upper, lower)
        both = (upper >= 0) & (lower >= 0)
        sheet.grounds[both] = lower[both]
        return sheet

    def _dotted(self, drawing: DrawnSpace, layers: Sequence[Layer]) -> Dots:
        """Return lines as braille dots; a cell has the colour of its last line."""
        columns, rows = self.columns, self.rows
        dots = Dots(columns, rows)
        for layer in layers:
            ends = layer.ends * [1, -1, 1] + [columns, 2 * rows, 0]
            across, down, points, _ = dots_of(ends, 2 * columns, 4 * rows)
            if layer.is_hidden:
                seen = points[:, 2] >= drawing.depth.depths[down, across]
                across, down = across[seen], down[seen]
            mine = Dots(columns, rows)
            mine.mark(across, down, packed(layer.color))
            dots.cover(mine)
        return dots

    def _letter_axes(self, drawing: DrawnSpace, sheet: CellSheet) -> npt.NDArray[np.bool_]:
        """Write x, y and z at the ends of the axes of frames; return a mask of these cells.

        A picture with many frames gets no letters.
        """
        written = np.zeros((self.rows, self.columns), bool)
        # On a coloured robot, letters would hide the robot, and the colours name the axes.
        if self.rows < LETTERED_FROM or (self._has_halves and (drawing.depth.owners >= 0).any()):
            return written
        for letter, layer in zip("xyz", drawing.layers[-3:], strict=True):
            for start, end in layer.ends[:, :, :2] if len(layer.ends) <= MOST_LETTERED else ():
                x, y = end / (2.0, -4.0) + (0.5 * self.columns, 0.5 * self.rows)
                # An axis towards the viewer is too short for a letter.
                is_long = np.abs((end - start) / (2.0, 4.0)).max() >= 1.0
                if is_long and 0 <= x < self.columns and 0 <= y < self.rows:
                    sheet.write(int(x), int(y), letter, packed(layer.color))
                    written[int(y), int(x)] = True
        return written

    def _name(
        self,
        drawing: DrawnSpace,
        picture: SpacePicture,
        sheet: CellSheet,
        marked: npt.NDArray[np.bool_],
        solid: npt.NDArray[np.bool_],
    ) -> None:
        """Write the names of frames into a sheet; omit a name that would cover another name."""
        named: dict[str, tuple[SpaceFrame, int]] = {}
        labels: list[Label] = []
        # Many names beside a robot would hide the robot.
        wanted = _ends(picture) | {picture.chosen, *picture.pair}
        is_sparse = bool(solid.any()) and not picture.names_all
        most = max(3, min(MOST_NAMED, self.columns * self.rows // CELLS_PER_NAME))
        for one, name, count, x, y in drawing.names:
            column, row = int(x // 2), int(y // 4)
            if is_sparse and one.name not in wanted:
                continue
            if 0 <= column < self.columns and 0 <= row < self.rows and len(labels) < most:
                text = label_text(name, one.age, self.columns, 18, ascii_only=self._ascii)
                labels.append(Label(one.name, text, column, row, 1))
                named[one.name] = one, count
        # Names beside a robot are easier to read than names on it, and a gap keeps them apart.
        letters = self._letter_axes(drawing, sheet)
        solid = solid | letters
        near = solid.copy()
        near[:, 1:] |= solid[:, :-1]
        near[:, :-1] |= solid[:, 1:]
        costs = ON_AXIS * marked + SOLID * near
        total = sum(count for _, _, count, _, _ in drawing.names)
        hint = f"grid {drawing.grid:g} m"
        # Keep room for the longest hint that the picture may need.
        costs[-1, : len(hint) + 24] = TAKEN
        palette = self._palette
        found = self._placer.placed(labels, costs)
        inks = []
        for placed in found:
            one, _ = named[placed.label.name]
            color = theme.readable(theme.of_name(one.name), palette)
            inks.append(packed(theme.of_age(color, one.age, palette)))
        # The line has the colour of the name, and does not hide solids or axes.
        leaders = Dots(self.columns, self.rows)
        far = np.array([placed.is_far for placed in found], bool)
        ends = np.array([_leader(placed) for placed in found], float).reshape(-1, 2, 2)
        leaders.draw(ends[far], np.array(inks, np.int64)[far])
        axes = self._dotted(drawing, drawing.layers[-3:]).masks > 0
        leaders.masks[solid | axes] = 0
        sheet.lay(leaders, ascii_only=self._ascii)
        for placed, ink in zip(found, inks, strict=True):
            one, _ = named[placed.label.name]
            text, is_chosen = placed.label.text, one.name == picture.chosen
            sheet.write(placed.column, placed.row, text, ink, bold=is_chosen, clears=True)
        told = sum(named[placed.label.name][1] for placed in found)
        if told < total:
            words = f", {total - told} of {total} frames unnamed"
            fits = len(hint + words) <= self.columns
            hint += words if fits else words.replace(" frames", "")
        sheet.write(0, self.rows - 1, hint[: self.columns], packed(palette.dim), clears=True)


def _solid(drawing: DrawnSpace, columns: int, rows: int) -> npt.NDArray[np.bool_]:
    """Return a mask of the cells that show a part of a solid, shape (rows, columns)."""
    points = (drawing.depth.owners >= 0).reshape(rows, 4, columns, 2)
    cells: npt.NDArray[np.bool_] = np.logical_or.reduce(points, (1, 3))
    return cells


def _leader(placed: PlacedLabel) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return both ends, in dots, of the line from a label to its frame.

    The line begins at the letter nearest to the frame.
    """
    label = placed.label
    last = placed.column + cell_len(label.text) - 1
    column = min(max(label.column, placed.column), last)
    return (2 * column + 1, 4 * placed.row + 2), (2 * label.column + 1, 4 * label.row + 2)


def _few_shades(colors: npt.NDArray[np.floating]) -> Indices:
    """Pack each colour in one number, rounded to few shades so that styles can be cached."""
    red, green, blue = np.moveaxis(np.clip(colors, 0, 255).astype(np.int64) & 0xF8, -1, 0)
    shades: Indices = (red << 16) + (green << 8) + blue
    return shades


def corners_of(picture: SpacePicture) -> npt.NDArray[np.float64]:
    """Return the points that the view of a picture should include, shape (n, 3)."""
    parts: list[npt.NDArray[np.floating]] = [
        np.array([one.pose.translation for one in picture.frames], float).reshape(-1, 3)
    ]
    if picture.solids is not None:
        poses = {one.name: one.pose for one in picture.frames}
        placed = picture.solids.placed(poses)
        first = 0
        for end, _ in picture.solids.ends:
            if end > first and np.isfinite(placed[first]).all():
                parts += [placed[first:end].min(0)[None], placed[first:end].max(0)[None]]
            first = end
    return np.concatenate(parts)
