"""Which part of the plane is on the screen: fitted to all there is, or as the user moved it."""

from tftool.drawing.plane import Box, PlanePicture, Viewport, fitted_view

STEP = 1.25
"""How much nearer one step of the zoom comes."""

MOST, LEAST = 1e9, 1e-4
"""Metres to a row beyond which the zoom does not go."""

ROOMY = 0.4
"""What is shown shrinks only when less than this share of it is needed."""


class Camera:
    """Keeps a view of the plane from look to look.

    Fitted, it grows at once with what there is, and shrinks only when most of it is empty:
    a picture that breathes cannot be read.
    """

    def __init__(self) -> None:
        self._box: Box | None = None
        self._fixed = ""
        self._own: tuple[float, float, float] | None = None
        self._size = (0, 0)
        self._shown = Viewport(0.0, 0.0, 1.0)

    def view(self, picture: PlanePicture, columns: int, rows: int) -> Viewport:
        """The view of a picture in columns × rows of cells."""
        if picture.fixed != self._fixed:
            # What a person zoomed into is elsewhere in another frame.
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
        """Come nearer by some steps, or go back by fewer than none.

        Args:
            steps: How many.
            at: The column and row that stays where it is; the middle if None.
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
        """Move the view by a number of cells, right and down."""
        left, bottom, per_row = self._shown
        x = left + 0.25 * self._size[0] * per_row - 0.5 * columns * per_row
        y = bottom + 0.5 * self._size[1] * per_row + rows * per_row
        self._look_at(x, y, per_row)

    def fit(self) -> None:
        """Show all there is again."""
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
        # With some room to come, or it would grow at every look.
        room = 0.1 * max(right - left, top - bottom)
        return (
            left - room * (left < kept[0]),
            bottom - room * (bottom < kept[1]),
            right + room * (right > kept[2]),
            top + room * (top > kept[3]),
        )
