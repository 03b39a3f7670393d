"""A picture of the tree as SVG: one self-contained file, light or dark as its viewer is."""

import math
from xml.sax.saxutils import escape

from tftool.drawing.font import width
from tftool.drawing.picture import Box, Curve, Picture, Text

_STYLE = """\
svg { background: #fbfbfd; font-family: Helvetica, Arial, sans-serif; }
text { fill: #5a6472; white-space: pre; unicode-bidi: isolate; }
.name { fill: #171c24; font-weight: bold; }
.note { fill: #8a6a17; font-style: italic; }
rect { stroke-width: 1.2; }
.root { fill: #dbe9ff; stroke: #4b7fd6; }
.dynamic { fill: #ffffff; stroke: #8fa3bd; }
.stale { fill: #fff1e0; stroke: #d9731a; stroke-width: 2; }
.static { fill: #fdf7e7; stroke: #b99a45; stroke-dasharray: 5 3; }
.group { fill: none; stroke: #c6ced9; }
.more { fill: none; stroke: #8a93a0; stroke-dasharray: 1.5 3; }
path { fill: none; stroke: #6d86a8; stroke-width: 1.6; }
path.still { stroke: #b99a45; stroke-dasharray: 5 4; }
@media (prefers-color-scheme: dark) {
svg { background: #14171c; }
text { fill: #a3aebd; }
.name { fill: #f0f3f7; }
.note { fill: #d9b65c; }
.root { fill: #1d3050; stroke: #6c9cf0; }
.dynamic { fill: #1c2129; stroke: #55657c; }
.stale { fill: #33230f; stroke: #f0953c; }
.static { fill: #29241a; stroke: #a3873d; }
.group { stroke: #333c49; }
path { stroke: #7f96b6; }
path.still { stroke: #b4964a; }
}"""


def render(picture: Picture) -> str:
    """Write a picture as SVG; names are text in it and nothing else."""
    wide, high = _number(picture.width), _number(picture.height)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" '
        f'viewBox="0 0 {wide} {high}">',
        f"<title>{escape(picture.title)}</title>",
        f"<style>{_STYLE}</style>",
        *map(_link, picture.links),
        *map(_box, picture.boxes),
        *map(_text, picture.texts),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _link(link: Curve) -> str:
    style = ' class="still"' if link.static else ""
    bends = " ".join(map(_number, link.bends))
    return f'<path{style} d="M{_number(link.x0)} {_number(link.y0)}C{bends}"/>'


def _box(box: Box) -> str:
    radius = _number(box.height / 2 if box.kind == "root" else 9.0)
    opening = (
        f'<rect class="{box.kind}" x="{_number(box.x)}" y="{_number(box.y)}" '
        f'width="{_number(box.width)}" height="{_number(box.height)}" rx="{radius}"'
    )
    # The whole name, for names that were cut to fit; shown when the pointer rests on the box.
    return f"{opening}><title>{escape(box.title)}</title></rect>" if box.title else f"{opening}/>"


def _text(text: Text) -> str:
    length = width(text.text, text.size, bold=text.kind == "name")
    # A viewer's font may be wider than Helvetica. All that stands in a card is kept to its width:
    # lines of which some are drawn together and others are not look like several sizes.
    fitted = f' textLength="{_number(length)}" lengthAdjust="spacingAndGlyphs"'
    return (
        f'<text class="{text.kind}" x="{_number(text.x)}" y="{_number(text.y)}" '
        f'font-size="{_number(text.size)}"{fitted if math.isfinite(text.room) else ""}>'
        f"{escape(text.text)}</text>"
    )


def _number(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")
