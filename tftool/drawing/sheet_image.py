"""PNG file of a tree picture, drawn by matplotlib (the extra `plot`)."""

import io
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any, Final

from tftool.base.errors import UsageError
from tftool.drawing.picture import Box, Picture

_MOST_POINTS: Final = 12_000
"""Largest width and height in pixels; many programs do not open larger images."""

_FILLS: Final = {
    "root": ("#dbe9ff", "#4b7fd6"),
    "dynamic": ("#ffffff", "#8fa3bd"),
    "stale": ("#fff1e0", "#d9731a"),
    "static": ("#fdf7e7", "#b99a45"),
    "group": ("none", "#c6ced9"),
    "more": ("none", "#8a93a0"),
}
_INKS: Final = {"name": "#171c24", "fact": "#5a6472", "note": "#8a6a17"}


def render(picture: Picture) -> bytes:
    """Return a picture as the bytes of a PNG file; a very large picture has a lower resolution.

    Raises:
        UsageError: If the extra `plot` is not installed.
    """
    try:
        figure_module = import_module("matplotlib.figure")
        patches = import_module("matplotlib.patches")
        paths = import_module("matplotlib.path")
    except ImportError as missing:
        raise UsageError(
            "A PNG file needs matplotlib: pip install 'tftool-tf2[plot]', or write .svg."
        ) from missing
    scale = min(2.0, _MOST_POINTS / max(picture.width, picture.height))
    size = picture.width / 72.0, picture.height / 72.0
    figure = figure_module.Figure(figsize=size, dpi=72, facecolor="#fbfbfd")
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_xlim(0, picture.width)
    axes.set_ylim(picture.height, 0)
    path = paths.Path
    for link in picture.links:
        bends = link.bends
        points = [(link.x0, link.y0), *zip(bends[::2], bends[1::2], strict=True)]
        codes = [path.MOVETO, path.CURVE4, path.CURVE4, path.CURVE4]
        ink, dashes = ("#b99a45", (0, (3, 2))) if link.static else ("#6d86a8", "-")
        axes.add_patch(
            patches.PathPatch(
                path(points, codes), fill=False, edgecolor=ink, linewidth=1.4, linestyle=dashes
            )
        )
    for box in picture.boxes:
        fill, edge = _FILLS[box.kind]
        axes.add_patch(
            patches.FancyBboxPatch(
                (box.x, box.y),
                box.width,
                box.height,
                boxstyle=f"round,pad=0,rounding_size={_radius(box)}",
                facecolor=fill,
                edgecolor=edge,
                linewidth=1.1,
                linestyle=(0, (3, 2)) if box.kind in ("static", "more") else "-",
            )
        )
    for text in picture.texts:
        drawn = axes.text(
            text.x,
            text.y,
            text.text.replace("$", r"\$"),
            color=_INKS[text.kind],
            # Slightly smaller than in SVG, because this font is wider than Helvetica.
            fontsize=0.86 * text.size,
            fontweight="bold" if text.kind == "name" else "normal",
            fontstyle="italic" if text.kind == "note" else "normal",
        )
        # Only a text of many characters can be too wide; to measure a text takes time.
        if text.size * len(text.text) > text.room:
            drawn.set_fontsize(0.86 * text.size * min(1.0, text.room / _width(drawn)))
    file = io.BytesIO()
    with _without_warnings():
        figure.savefig(file, format="png", dpi=72.0 * scale, facecolor="#fbfbfd")
    return file.getvalue()


def missing_letters(picture: Picture) -> str:
    """Return the letters of a picture's texts that the PNG's font lacks, each once."""
    fonts = import_module("matplotlib.font_manager")
    known = fonts.get_font(fonts.findfont(fonts.FontProperties())).get_charmap()
    return "".join(
        dict.fromkeys(c for text in picture.texts for c in text.text if ord(c) not in known)
    )


def _width(drawn: Any) -> float:
    with _without_warnings():
        return max(1.0, float(drawn.get_window_extent().width))


@contextmanager
def _without_warnings() -> Iterator[None]:
    """Suppress matplotlib's warning about each letter that its font lacks."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        yield


def _radius(box: Box) -> float:
    return min(box.height / 2.0, box.width / 2.0) if box.kind == "root" else 9.0
