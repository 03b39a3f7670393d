"""Figure that a notebook shows once, as a cell's value or while drawing.

Imported when something is drawn: it needs matplotlib, an extra.
"""

from matplotlib import get_backend, pyplot
from matplotlib.figure import Figure


class NotebookFigure(Figure):
    """A pyplot figure; outside notebooks it is like any other."""

    def _ipython_display_(self) -> None:
        """Show the figure, and remove it from those shown at the end of the cell."""
        if "inline" in get_backend():
            pyplot.close(self)
        # IPython's word for: show it as if this method were not there.
        raise NotImplementedError
