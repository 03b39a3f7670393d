"""The picture of frames in a panel: the fixed frame's tree, and small ones of the trees apart."""

from rich.segment import Segment

from tftool.base.fixed_width import padded
from tftool.drawing.canvas import Canvas
from tftool.drawing.cells import Line
from tftool.drawing.plane import PlanePicture, fitted_view
from tftool.screens.terminal.camera import Camera
from tftool.screens.terminal.text_style import Look

WITH_INSETS = 16
"""Rows of a panel from which trees apart are drawn, and not only named."""

INSET_WIDTH = 24
"""Columns an inset takes at least."""


class PlaneView:
    """Draws pictures of frames into a panel of any size.

    Attributes:
        camera: Which part is shown.
    """

    def __init__(self) -> None:
        self.camera = Camera()
        self._canvases: dict[object, Canvas] = {}
        self._key: object = None
        self._gutter = 0

    def lines(
        self, picture: PlanePicture, width: int, height: int, look: Look, *, colors: bool
    ) -> list[Line]:
        """Draw a picture: `height` lines of `width` cells."""
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
        """The column and row of the main picture under a cell of the panel."""
        return x - self._gutter + 0.5, y + 0.5

    def frame_at(self, picture: PlanePicture, x: int, y: int) -> str | None:
        """The frame nearest to a cell of the panel, within three cells of it."""
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
        """The first trees apart, side by side, each under its own heading."""
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
        """What is not to be seen, in words."""
        words = []
        shown = max(1, width // INSET_WIDTH) if height >= WITH_INSETS else 0
        hidden = picture.apart[shown:]
        if hidden:
            names = ", ".join(one.fixed for one in hidden[:5])
            more = f" and {len(hidden) - 5} more" if len(hidden) > 5 else ""
            words.append(f"not joined to {picture.fixed}: {names}{more}")
        if picture.nowhere:
            names = ", ".join(picture.nowhere[:5])
            more = f" and {len(picture.nowhere) - 5} more" if len(picture.nowhere) > 5 else ""
            words.append(f"no pose in {picture.fixed} at this moment: {names}{more}")
        warning = look.ink(look.palette.warning)
        return [[Segment(padded(" " + one, width, more=look.more), warning)] for one in words]
