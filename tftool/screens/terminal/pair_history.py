"""The plots beside the picture: the pair over the last seconds, looked up at every look."""

import numpy as np
from rich.text import Text

from tftool.base.errors import TransformException
from tftool.base.stamps import seconds
from tftool.drawing.line_plot import PAIR_LABELS, PlotSpan, pair_plot
from tftool.screens.terminal.scene import Scene, SceneMoment
from tftool.screens.terminal.text_style import Look, wrapped

SPAN = seconds(10.0)
"""How much of time is shown."""


class PairPlot:
    """Draws a pair's distance and yaw, and where in it the moment shown lies."""

    def __init__(self) -> None:
        self._key: object = None
        self._lines: list[Text] = []

    def lines(
        self, moment: SceneMoment, scene: Scene, width: int, height: int, look: Look
    ) -> list[Text]:
        """Look the pair up over the last seconds, or round an earlier moment.

        Args:
            moment: What is shown.
            scene: Where the pair is looked up.
            width: Cells across.
            height: Lines.
            look: How to paint.
        """
        now = moment.stamp + moment.behind
        span = PlotSpan(now - SPAN, now, scene.start)
        if moment.behind:
            first = now - SPAN if moment.behind <= SPAN else moment.stamp - SPAN // 2
            span = PlotSpan(first, first + SPAN, scene.start, moment.stamp)
        pair = moment.pair
        columns = max(1, width - PAIR_LABELS - 1)
        period = max(1, SPAN // (2 * columns))
        # On a grid of its own, so that a curve moves and does not tremble.
        stamps = np.arange(span.first // period + 1, span.last // period + 1) * period
        newest = scene.newest(pair.target, pair.source)
        if newest is not None and span.first < newest <= span.last:
            stamps = np.append(stamps[stamps < newest], newest)
        key = (pair.target, pair.source, span, newest, width, height, look)
        if key == self._key:
            return self._lines
        self._key = key
        try:
            path = scene.world.buffer.lookup_transforms(
                pair.target, pair.source, stamps[stamps > 0], missing="nan", threads=1
            )
        except TransformException:
            self._lines = wrapped("No poses to plot.", width, look.ink(look.palette.dim))
            return self._lines
        self._lines = pair_plot(path, span, width, height, look.palette, ascii_only=look.ascii_only)
        return self._lines
