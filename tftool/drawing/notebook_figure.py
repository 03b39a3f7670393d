"""Figure that a notebook shows once, even if a cell draws the figure and also returns it.

This module needs matplotlib (the extra `plot`), and is imported only when a figure is drawn.
"""

from matplotlib import get_backend, pyplot
from matplotlib.figure import Figure


class NotebookFigure(Figure):
    """Figure of pyplot that a notebook shows only once."""

    def _ipython_display_(self) -> None:
        """Show the figure as usual, and do not show it again at the end of the cell."""
        if "inline" in get_backend():
            pyplot.close(self)
        # This exception makes IPython show the figure as if this method did not exist.
        raise NotImplementedError
