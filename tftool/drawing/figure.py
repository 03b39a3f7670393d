"""Figures made with matplotlib: curves over time, and a path seen from above.

matplotlib is optional (the extra `plot`), and imported only when a figure is drawn.
"""

from collections.abc import Sequence
from functools import partial
from importlib import import_module
from textwrap import wrap
from typing import TYPE_CHECKING, Any, BinaryIO, Final

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import Stamp
from tftool.buffer.batch.transform_array import TransformArray
from tftool.frames.export.export import Framed, buffer_of
from tftool.frames.pair_samples import Trajectory, sample, trajectory_of
from tftool.frames.pair_series import (
    QUANTITIES,
    PlotPanel,
    RefusedSpan,
    chosen,
    panels,
    path_curves,
    reasons,
    shades,
    thinned,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FORMATS: Final = ("svg", "pdf", "png")

MOST_POINTS: Final = 20_000
"""Most points drawn of one curve: more than a printed page can show."""

_CHARACTERS: Final = 125
"""Longest line of text below a figure, in characters."""

_LIGHT: Final = {
    "figure.facecolor": "white",
    "axes.facecolor": "white",
    "text.color": "#1a1a1a",
    "axes.labelcolor": "#1a1a1a",
    "axes.edgecolor": "#808080",
    "xtick.color": "#404040",
    "ytick.color": "#404040",
    "grid.color": "#d8d8d8",
}
_DARK: Final = {
    "figure.facecolor": "#14171c",
    "axes.facecolor": "#14171c",
    "text.color": "#e6e6e6",
    "axes.labelcolor": "#e6e6e6",
    "axes.edgecolor": "#6a6f78",
    "xtick.color": "#b8bcc4",
    "ytick.color": "#b8bcc4",
    "grid.color": "#30353d",
    "legend.facecolor": "#1c2027",
}
_COMMON: Final[dict[str, object]] = {
    "svg.fonttype": "none",
    # Fixed ids, so that the same plot gives the same file.
    "svg.hashsalt": "tftool",
    "font.family": "sans-serif",
    "axes.grid": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.unicode_minus": False,
    "legend.framealpha": 0.8,
    "font.size": 9.0,
}
_INKS: Final = {
    False: ("#c0392b", "#1e8449", "#2452c9", "#b9770e", "#7d3c98", "#117a8b"),
    True: ("#ff8787", "#87e087", "#87afff", "#ffd75f", "#e0a0ff", "#5fe0e0"),
}


def plot(
    frames: "Framed | TransformArray | Trajectory | Sequence[TransformArray | Trajectory]",
    target: str | None = None,
    source: str | None = None,
    *,
    ax: "Axes | None" = None,
    what: str | Sequence[str] = (),
    xy: bool = False,
    start: Stamp | None = None,
    dark: bool = False,
) -> "Figure | Axes":
    """Draw the pose of `source` in `target`, or some series of poses, as a matplotlib figure.

        tftool.plot(recording, "map", "base_link").savefig("path.svg")
        path = recording.buffer.lookup_transforms("map", "base_link", stamps, missing="nan")
        tftool.plot(path, ax=axes, what="yaw")

    Args:
        frames: Opened frames, a recording, a buffer or a robot; or one or several series of poses.
            Lookups are at the stamps of the most frequent transform between `source` and `target`.
        target: Frame in which the poses are expressed; None with series of poses.
        source: Frame whose poses are drawn; None with series of poses.
        ax: Axes for one panel; None for a new figure with all panels.
        what: Panels to draw: "position", "rotation", "distance", "speed", "turn rate", or a single
            curve such as "x" or "yaw". If empty, a new figure has all panels, and `ax` shows the
            position.
        xy: Whether to draw the path from above instead of curves over time.
        start: Stamp that is 0 on the time axis, nanoseconds; None for the first pose.
        dark: Whether a new figure has a dark background.

    Returns:
        The new figure, or `ax`.

    Raises:
        TransformException: If `target` or `source` is unknown, or the frames are never connected.
        TypeError: If `target` and `source` are given with series of poses, or missing without them.
        UsageError: If there is nothing to draw, or the extra `plot` is not installed.
    """
    found = _trajectories(frames, target, source)
    if not any(one.path.valid.any() for one in found):
        raise UsageError("No pose can be drawn, because every lookup failed.")
    words = [what] if isinstance(what, str) else list(what)
    begin = min(int(one.path.stamps[0]) for one in found if len(one.path))
    begin = begin if start is None else start
    if ax is None:
        pyplot = _needed("matplotlib.pyplot")
        made = partial(
            pyplot.figure, FigureClass=_needed("tftool.drawing.notebook_figure").NotebookFigure
        )
        return _figure(found, begin, chosen(words), xy, dark, made)
    if xy:
        _draw_path(ax, found, dark)
        return ax
    drawn = panels(found, begin, chosen(words or ["position"]))
    if len(drawn) > 1:
        raise UsageError(f"`ax` shows one panel, not {len(drawn)}: choose a panel with what=….")
    _draw_panel(ax, drawn[0], shades(found, begin), dark)
    ax.set_xlabel("time, s")
    return ax


def _trajectories(
    frames: "Framed | TransformArray | Trajectory | Sequence[TransformArray | Trajectory]",
    target: str | None,
    source: str | None,
) -> list[Trajectory]:
    """Return the poses of `source` in `target`, or the given series, as trajectories."""
    if isinstance(frames, TransformArray | Trajectory | Sequence):
        if target is not None or source is not None:
            raise TypeError(
                "poses already have a pair of frames: call plot(path) or plot(path, ax=axes). "
                "For frames, name a pair: plot(recording, 'map', 'base_link')"
            )
        given = [frames] if isinstance(frames, TransformArray | Trajectory) else frames
        return [one if isinstance(one, Trajectory) else trajectory_of(one) for one in given]
    buffer = buffer_of(frames)
    if target is None or source is None:
        raise TypeError("no pair of frames is given: call plot(recording, 'map', 'base_link')")
    return [sample(buffer, target, source)]


def write(
    trajectories: Sequence[Trajectory],
    file: BinaryIO,
    form: str,
    *,
    start: Stamp,
    quantities: Sequence[str] = QUANTITIES,
    xy: bool = False,
    dark: bool = False,
) -> None:
    """Write a figure of trajectories to a file, in the format `form`, one of `FORMATS`.

    Raises:
        UsageError: If the extra `plot` is not installed.
    """
    made = _needed("matplotlib.figure").Figure
    _save(_figure(trajectories, start, quantities, xy, dark, made), file, form)


def write_panels(drawn: Sequence[PlotPanel], title: str, file: BinaryIO, form: str) -> None:
    """Write a figure of panels below a title to a file, in the format `form`, one of `FORMATS`.

    Raises:
        UsageError: If the extra `plot` is not installed.
    """
    made = _needed("matplotlib.figure").Figure
    _save(_figure_of_panels(drawn, title, (), False, made), file, form)


def _save(figure: "Figure", file: BinaryIO, form: str) -> None:
    # Without a date, so that the same plot gives the same file.
    metadata = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}[form]
    with _needed("matplotlib").rc_context(_COMMON):
        figure.savefig(file, format=form, dpi=150, metadata=metadata)


def _needed(module: str) -> Any:
    try:
        return import_module(module)
    except ImportError as missing:
        raise UsageError("A picture needs matplotlib: pip install 'tftool-tf2[plot]'") from missing


def _figure(
    trajectories: Sequence[Trajectory],
    start: Stamp,
    quantities: Sequence[str],
    xy: bool,
    dark: bool,
    make: Any,
) -> "Figure":
    title = ", ".join(f"{one.source} in {one.target}" for one in trajectories[:4])
    title += " …" if len(trajectories) > 4 else ""
    if not xy:
        drawn = panels(trajectories, start, quantities)
        return _figure_of_panels(
            drawn, title, shades(trajectories, start), dark, make, len(trajectories) == 1
        )
    figure = _empty_figure(6.0, dark, make)
    with _needed("matplotlib").rc_context(_settings(dark)):
        figure.suptitle(_plain(title), fontsize=11)
        _draw_path(figure.subplots(), trajectories, dark)
    return figure


def _settings(dark: bool) -> dict[str, object]:
    return {**_COMMON, **(_DARK if dark else _LIGHT)}


def _empty_figure(height: float, dark: bool, make: Any) -> "Figure":
    # pyplot's first figure also sets up its backend. If that happened inside our temporary
    # settings, it would end with them, and a notebook would show no later figure.
    ground = (_DARK if dark else _LIGHT)["figure.facecolor"]
    figure: Figure = make(figsize=(8.0, height), layout="constrained", facecolor=ground)
    return figure


def _figure_of_panels(
    drawn: Sequence[PlotPanel],
    title: str,
    shaded: Sequence[RefusedSpan],
    dark: bool,
    make: Any,
    named: bool = True,
) -> "Figure":
    """Return a figure, created by `make`, with panels below each other.

    If `named`, each panel has a legend.
    """
    figure = _empty_figure(1.0 + 1.7 * len(drawn), dark, make)
    with _needed("matplotlib").rc_context(_settings(dark)):
        figure.suptitle(_plain(title), fontsize=11)
        axes = figure.subplots(len(drawn), 1, sharex=True, squeeze=False)[:, 0]
        for one, panel in zip(axes, drawn, strict=True):
            _draw_panel(one, panel, shaded, dark, named=named or one is axes[0])
        axes[-1].set_xlabel("time, s")
        if shaded:
            figure.supxlabel(_plain_lines(reasons(shaded)), x=0.01, ha="left", fontsize=7)
        figure.align_ylabels(axes)
    return figure


def _draw_panel(
    ax: "Axes", panel: PlotPanel, shaded: Sequence[RefusedSpan], dark: bool, *, named: bool = True
) -> None:
    inks = _INKS[dark]
    handles = []
    for place, one in enumerate(panel.curves):
        times, values = thinned(one.times, one.values, MOST_POINTS)
        (line,) = ax.plot(times, values, color=inks[place % len(inks)], linewidth=1.1)
        handles.append((line, one.label))
    for span in shaded:
        ax.axvspan(span.first, span.last, color="#d08a00", alpha=0.22, linewidth=1)
    ax.set_ylabel(f"{panel.title}, {panel.unit}")
    ax.margins(x=0.01)
    if named and (len(handles) > 1 or panel.curves[0].label != panel.title):
        _legend(ax, handles)


def _draw_path(ax: "Axes", found: Sequence[Trajectory], dark: bool) -> None:
    inks = _INKS[dark]
    handles = []
    for place, (label, x, y) in enumerate(path_curves(found)):
        step = -(-len(x) // MOST_POINTS)
        ink = inks[place % len(inks)]
        (line,) = ax.plot(x[::step], y[::step], color=ink, linewidth=1.2)
        held = (x == x).nonzero()[0]
        ax.plot(x[held[0]], y[held[0]], marker="o", color=ink, markersize=5)
        ax.plot(x[held[-1]], y[held[-1]], marker="s", color=ink, markersize=5)
        handles.append((line, f"{label}: from ● to ■"))
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("x, m")
    ax.set_ylabel("y, m")
    _legend(ax, handles)


def _legend(ax: "Axes", handles: Sequence[tuple[Any, str]]) -> None:
    ax.legend(
        [line for line, _ in handles],
        [_plain(label) for _, label in handles],
        loc="upper left",
        bbox_to_anchor=(1.0, 1.0),
        fontsize=8,
    )


def _plain(text: str) -> str:
    """Escape the characters that matplotlib reads as mathematics ($) or a hidden label (_)."""
    shown = visible(text).replace("$", r"\$")
    return f" {shown}" if shown.startswith("_") else shown


def _plain_lines(sentences: Sequence[str]) -> str:
    return "\n".join(line for one in sentences for line in wrap(_plain(one), _CHARACTERS))
