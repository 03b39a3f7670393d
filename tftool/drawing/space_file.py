"""3-D picture of frames as a file: SVG, or PNG by matplotlib.

Solids are an image; lines and names are drawn over the image.
"""

import io
import struct
import zlib
from base64 import b64encode
from html import escape
from importlib import import_module

import numpy as np
import numpy.typing as npt

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible
from tftool.drawing import theme
from tftool.drawing.labels import Label, PlacedLabel, Placer
from tftool.drawing.space import OrbitCamera, SpacePicture
from tftool.drawing.space_canvas import ASIDES, MOST_NAMED, DrawnSpace, corners_of, drawn

COLUMNS, ROWS = 640, 220
"""Width and height of the picture in cells of 2 × 4 points."""

_WIDE, _HIGH = 8, 16
"""Width and height of a letter in points."""


def drawn_file(
    picture: SpacePicture, form: str, palette: theme.Palette = theme.DARK, *, title: str = ""
) -> bytes:
    """Return a 3-D picture as the bytes of a file, "svg" or "png".

    Raises:
        UsageError: If the extra `plot`, which writes PNG, is not installed.
    """
    view = OrbitCamera().view(picture, corners_of(picture), COLUMNS, ROWS)
    sheet = drawn(picture, view, COLUMNS, ROWS, palette)
    labels = [
        Label(one.name, visible(name), round(x / _WIDE), round(y / _HIGH), 1)
        for one, name, _, x, y in sheet.names[:MOST_NAMED]
    ]
    columns, rows = 2 * COLUMNS // _WIDE, 4 * ROWS // _HIGH
    solid = (sheet.depth.owners >= 0).reshape(rows, _HIGH, columns, _WIDE).any((1, 3))
    placed = Placer(columns, rows, ASIDES).placed(labels, np.where(solid, 4.0, 0.0))
    if form == "svg":
        return _svg(sheet, placed, palette, title).encode()
    return _png(sheet, placed, palette)


def _pixels(sheet: DrawnSpace) -> npt.NDArray[np.uint8]:
    """Return the solids as an image of RGBA values from 0 to 255, transparent elsewhere."""
    seen = sheet.depth.owners >= 0
    return np.dstack([np.clip(sheet.image, 0, 255), np.where(seen, 255, 0)]).astype(np.uint8)


def png_bytes(pixels: npt.NDArray[np.uint8]) -> bytes:
    """Return an image of RGBA values, shape (height, width, 4), as the bytes of a PNG file.

    Source:
        W3C, "Portable Network Graphics (PNG) Specification", 2003.
    """
    height, width, _ = pixels.shape

    def chunk(kind: bytes, content: bytes) -> bytes:
        check = zlib.crc32(kind + content)
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", check)

    # Every row begins with the number of its filter: 0 for none.
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], 1)
    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    body = zlib.compress(rows.tobytes(), 6)
    signature = bytes([137, 80, 78, 71, 13, 10, 26, 10])
    return signature + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def _ink(name: str, palette: theme.Palette) -> str:
    return theme.hexadecimal(theme.readable(theme.of_name(name), palette))


def _svg(sheet: DrawnSpace, placed: list[PlacedLabel], palette: theme.Palette, title: str) -> str:
    width, height = 2 * COLUMNS, 4 * ROWS
    image = b64encode(png_bytes(_pixels(sheet))).decode()
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}">',
        f"<title>{escape(visible(title), quote=False)}</title>",
        f'<rect width="100%" height="100%" fill="{theme.hexadecimal(palette.panel)}"/>',
    ]
    solids = f'<image width="{width}" height="{height}" href="data:image/png;base64,{image}"/>'
    below: list[str] = []
    above: list[str] = []
    for layer in sheet.layers:
        path = "".join(
            f"M{0.5 * width + start[0]:.1f} {0.5 * height - start[1]:.1f}"
            f"L{0.5 * width + end[0]:.1f} {0.5 * height - end[1]:.1f}"
            for start, end in layer.ends[np.isfinite(layer.ends).all((1, 2))].tolist()
        )
        line = f'<path d="{path}" stroke="{theme.hexadecimal(layer.color)}" '
        line += f'stroke-width="{1 if layer.is_hidden else 2}" fill="none"/>'
        (below if layer.is_hidden else above).append(line)
    parts += [*below, solids, *above]
    parts += [
        f'<text x="{one.column * _WIDE}" y="{one.row * _HIGH + 12}" '
        f'fill="{_ink(one.label.name, palette)}" '
        f'font-family="monospace" font-size="13">{escape(one.label.text, quote=False)}</text>'
        for one in placed
    ]
    return "\n".join([*parts, "</svg>\n"])


def _png(sheet: DrawnSpace, placed: list[PlacedLabel], palette: theme.Palette) -> bytes:
    try:
        figure_module = import_module("matplotlib.figure")
        collections = import_module("matplotlib.collections")
    except ImportError as missing:
        raise UsageError(
            "A PNG file needs matplotlib: pip install 'tftool-tf2[plot]', or write .svg."
        ) from missing
    width, height = 2 * COLUMNS, 4 * ROWS
    ground = theme.hexadecimal(palette.panel)
    figure = figure_module.Figure(figsize=(width / 100, height / 100), dpi=100, facecolor=ground)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_xlim(0, width)
    axes.set_ylim(height, 0)
    axes.imshow(_pixels(sheet), extent=(0, width, height, 0), aspect="auto", zorder=2)
    for layer in sheet.layers:
        ends = layer.ends[np.isfinite(layer.ends).all((1, 2))][:, :, :2] * [1, -1]
        axes.add_collection(
            collections.LineCollection(
                ends + np.array([0.5 * width, 0.5 * height]),
                colors=theme.hexadecimal(layer.color),
                linewidths=0.8 if layer.is_hidden else 1.5,
                zorder=1 if layer.is_hidden else 3,
            )
        )
    for one in placed:
        text = one.label.text.replace("$", r"\$")
        axes.text(
            one.column * _WIDE,
            one.row * _HIGH + 12,
            text,
            color=_ink(one.label.name, palette),
            family="monospace",
            fontsize=9.5,
            zorder=4,
        )
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=100, facecolor=ground)
    return file.getvalue()
