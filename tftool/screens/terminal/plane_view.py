"""Picture of frames in a panel: the visible part of the xy plane, and insets of other trees."""

from rich.segment import Segment

from tftool.drawing.canvas import Canvas
from tftool.drawing.cells import Line
from tftool.drawing.plane import Box, PlanePicture, Viewport, fitted_view
from tftool.drawing.table_columns import padded
from tftool.screens.terminal.text_style import Look

STEP = 1.25
"""Magnification of one step of the zoom."""

MOST, LEAST = 1e9, 1e-4
"""Limits of the zoom, in metres per row."""

ROOMY = 0.4
"""Share of the view that a picture must fill so that the view does not shrink."""


class Camera:
    """Camera above the xy plane; the scale stays steady from picture to picture.

    Until the user zooms or pans, the view grows at once with the picture. The view shrinks only
    when most of the view is empty.
    """

    def __init__(self) -> None:
        self._box: Box | None = None
        self._fixed = ""
        self._own: tuple[float, float, float] | None = None
        self._size = (0, 0)
        self._shown = Viewport(0.0, 0.0, 1.0)

    def view(self, picture: PlanePicture, columns: int, rows: int) -> Viewport:
        """Return the visible part of the plane for a picture of `columns` by `rows` cells."""
        if picture.fixed != self._fixed:
            # A section that the user zoomed into has no meaning in another fixed frame.
            self._fixed, self._box, self._own = picture.fixed, None, None
        if self._own is None:
            self._box = self._fitted(picture.bounds())
            self._shown = fitted_view(self._box, columns, rows)
        else:
            x, y, per_row = self._own
            self._shown = Viewport(x - 0.25 * columns * per_row, y - 0.5 * rows * per_row, per_row)
        self._size = columns, rows
        return self._shown

    def zoom(self, steps: int, at: tuple[float, float] | None = None) -> None:
        """Zoom in by a number of steps; zoom out if the number is negative.

        Args:
            steps: Number of steps.
            at: Column and row of the point that does not move; None for the middle.
        """
        columns, rows = self._size
        left, bottom, per_row = self._shown
        column, row = at or (0.5 * columns, 0.5 * rows)
        x, y = left + 0.5 * column * per_row, bottom + (rows - row) * per_row
        nearer = min(MOST, max(LEAST, per_row * STEP**-steps))
        share = nearer / per_row
        middle_x = left + 0.25 * columns * per_row
        middle_y = bottom + 0.5 * rows * per_row
        self._look_at(x + (middle_x - x) * share, y + (middle_y - y) * share, nearer)

    def pan(self, columns: float, rows: float) -> None:
        """Move the view by `columns` cells to the right and `rows` cells down."""
        left, bottom, per_row = self._shown
        x = left + 0.25 * self._size[0] * per_row - 0.5 * columns * per_row
        y = bottom + 0.5 * self._size[1] * per_row + rows * per_row
        self._look_at(x, y, per_row)

    def fit(self) -> None:
        """Undo zooming and panning: show the whole picture."""
        self._own = self._box = None

    def _look_at(self, x: float, y: float, per_row: float) -> None:
        columns, rows = self._size
        self._own = x, y, per_row
        self._shown = Viewport(x - 0.25 * columns * per_row, y - 0.5 * rows * per_row, per_row)

    def _fitted(self, box: Box) -> Box:
        kept = self._box
        if kept is None:
            return box
        left, bottom = min(kept[0], box[0]), min(kept[1], box[1])
        right, top = max(kept[2], box[2]), max(kept[3], box[3])
        used = max(box[2] - box[0], box[3] - box[1])
        if used < ROOMY * max(right - left, top - bottom):
            return box
        if (left, bottom, right, top) == kept:
            return kept
        # With a margin, or the view would grow at every update.
        room = 0.1 * max(right - left, top - bottom)
        return (
            left - room * (left < kept[0]),
            bottom - room * (bottom < kept[1]),
            right + room * (right > kept[2]),
            top + room * (top > kept[3]),
        )


WITH_INSETS = 16
"""Smallest number of rows of a panel in which other trees are drawn, not only named."""

INSET_WIDTH = 24
"""Smallest width of an inset in columns."""


class PlaneView:
    """Renderer of pictures of frames in a panel of any size.

    Attributes:
        camera: Camera that determines the visible part of the plane.
    """

    def __init__(self) -> None:
        self.camera = Camera()
        self._canvases: dict[object, Canvas] = {}
        self._key: object = None
        self._gutter = 0

    def lines(
        self, picture: PlanePicture, width: int, height: int, look: Look, *, colors: bool
    ) -> list[Line]:
        """Draw a picture; return `height` lines of `width` cells."""
        key = (width, height, look, colors)
        if key != self._key:
            self._key = key
            self._canvases.clear()
        notes = self._notes(picture, width, height, look)
        insets = 0
        if picture.apart and height >= WITH_INSETS:
            insets = max(5, height // 4)
        rows = height - insets - len(notes)
        main = self._canvas("", width, rows, look, colors)
        self._gutter = main.gutter
        view = self.camera.view(picture, main.columns, main.rows)
        lines = main.lines(picture, view)
        if insets:
            lines += self._insets(picture, width, insets, look, colors)
        return [*lines, *notes]

    def cell(self, x: int, y: int) -> tuple[float, float]:
        """Return the column and row in the picture for a cell of the panel."""
        return x - self._gutter + 0.5, y + 0.5

    def frame_at(self, picture: PlanePicture, x: int, y: int) -> str | None:
        """Return the frame nearest to a cell of the panel; None if no frame is within 3 cells."""
        main = self._canvases.get(("", 0))
        column, row = self.cell(x, y)
        best = None
        for one in picture.frames if main is not None else ():
            place = main.place(one.x, one.y) if main is not None else (0.0, 0.0)
            away = max(0.5 * abs(place[0] - column), abs(place[1] - row))
            if one.is_frame and away <= 1.5 and (best is None or away < best[0]):
                best = away, one.name
        return None if best is None else best[1]

    def _canvas(
        self, name: str, width: int, rows: int, look: Look, colors: bool, place: int = 0
    ) -> Canvas:
        drawn = self._canvases.get((name, place))
        if drawn is None or drawn.asked != (width, rows):
            drawn = self._canvases[name, place] = Canvas(
                width,
                rows,
                ascii_only=look.ascii_only,
                mono=not colors,
                palette=look.palette,
                scaled=not place,
            )
        return drawn

    def _insets(
        self, picture: PlanePicture, width: int, height: int, look: Look, colors: bool
    ) -> list[Line]:
        """Draw as many other trees as fit, side by side, each below a heading."""
        count = min(len(picture.apart), max(1, width // INSET_WIDTH))
        wide = width // count
        warning = look.ink(look.palette.warning)
        dash = "-" if look.ascii_only else "─"
        rows: list[Line] = [[] for _ in range(height)]
        for place, one in enumerate(picture.apart[:count]):
            columns = wide if place < count - 1 else width - wide * (count - 1)
            count_words = "1 frame" if len(one.frames) == 1 else f"{len(one.frames)} frames"
            words = f"{dash}{dash} apart: {one.fixed}, {count_words} "
            heading = padded(words, columns, more=look.more).rstrip()
            heading += " " + dash * (columns - len(heading) - 2) + " "
            rows[0].append(Segment(padded(heading, columns, more=look.more), warning))
            drawn = self._canvas(one.fixed, columns, height - 1, look, colors, place + 1)
            view = fitted_view(one.bounds(), drawn.columns, drawn.rows)
            for row, line in enumerate(drawn.lines(one, view), 1):
                rows[row] += line
        return rows

    def _notes(self, picture: PlanePicture, width: int, height: int, look: Look) -> list[Line]:
        """Return lines that name the frames and trees that are not visible."""
        words = []
        shown = max(1, width // INSET_WIDTH) if height >= WITH_INSETS else 0
        hidden = picture.apart[shown:]
        if hidden:
            names = ", ".join(one.fixed for one in hidden[:5])
            more = f" and {len(hidden) - 5} more" if len(hidden) > 5 else ""
            words.append(f"not connected to {picture.fixed}: {names}{more}")
        if picture.nowhere:
            names = ", ".join(picture.nowhere[:5])
            more = f" and {len(picture.nowhere) - 5} more" if len(picture.nowhere) > 5 else ""
            words.append(f"no pose in {picture.fixed} at this moment: {names}{more}")
        warning = look.ink(look.palette.warning)
        return [[Segment(padded(" " + one, width, more=look.more), warning)] for one in words]
