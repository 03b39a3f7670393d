"""Figure that a notebook shows once, whether it is a cell's value or drawn in the cell.

This module needs matplotlib, an extra, and is imported when something is drawn.
"""

from matplotlib import get_backend, pyplot
from matplotlib.figure import Figure


class NotebookFigure(Figure):
    """Figure of pyplot that a notebook does not show twice."""

    def _ipython_display_(self) -> None:
        """Remove the figure from those shown at the end of the cell, and show it as usual."""
        if "inline" in get_backend():
            pyplot.close(self)
        # This exception makes IPython show the figure as if this method did not exist.
        raise NotImplementedError
