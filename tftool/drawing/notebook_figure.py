"""A figure that a notebook shows once, whether it is a cell's last value or drawn on the way.

Imported when something is drawn: it needs matplotlib, an extra.
"""

from matplotlib import get_backend, pyplot
from matplotlib.figure import Figure


class NotebookFigure(Figure):
    """One of pyplot's figures; elsewhere than in a notebook it is like any other."""

    def _ipython_display_(self) -> None:
        """Take itself off the figures that are shown when the cell ends, and be shown as usual."""
        if "inline" in get_backend():
            pyplot.close(self)
        # IPython's word for: show it as if this method were not there.
        raise NotImplementedError
