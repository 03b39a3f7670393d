"""Terminal drawing of `tftool plot`."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from rich.console import Console
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.stamps import Stamp
from tftool.drawing import line_plot as view
from tftool.frames.pair_samples import Trajectory
from tftool.frames.pair_series import chosen


@dataclass(frozen=True, slots=True)
class PlotStyle:
    """Quantities and appearance of a plot.

    Attributes:
        quantities: Quantities to draw over time.
        from_above: Draw the path from above instead.
        ascii_only: With plain characters.
        light: For a terminal with a light ground.
        dark: A picture on a dark ground.
    """

    quantities: Sequence[str]
    from_above: bool
    ascii_only: bool
    light: bool
    dark: bool

    @classmethod
    def of(
        cls, only: list[str], from_above: bool, ascii_only: bool, light: bool, dark: bool
    ) -> Self:
        """Parse --only.

        Raises:
            UsageError: If it names no quantity, or goes with --xy.
        """
        quantities = chosen([one for text in only for one in text.split(",") if one.strip()])
        if from_above and only:
            raise UsageError("--xy draws the path, and --only values over time: leave one out.")
        return cls(quantities, from_above, ascii_only, light, dark)

    def text(
        self,
        found: list[Trajectory],
        start: Stamp,
        console: Console,
        *,
        height: int | None = None,
        span: tuple[float, float] | None = None,
        hidden: frozenset[int] | None = None,
    ) -> Text:
        """Draw pairs at the width of a console.

        Args:
            found: The pairs.
            start: The moment that is 0 on the axis.
            console: The console to print on; 80 columns wide unless it is a terminal.
            height: Lines there are; as many as are good if None.
            span: Seconds since `start` that the axis covers; from data to data if None.
            hidden: Numbers of the curves that keys have hidden; None where there are no keys.
        """
        width = console.width if console.is_terminal else 80
        ascii_only = self.ascii_only or console.options.ascii_only
        look = view.PlotLook(
            width, height, ascii_only, self.light, hidden is not None, hidden or frozenset()
        )
        if self.from_above:
            return view.from_above(found, look)
        return view.over_time(found, start, self.quantities, look, span=span)
