"""SVG file of a tree picture, and an HTML page with the picture and a table.

Both files load nothing, and follow the viewer's light or dark scheme. A script in the page fits,
moves and searches the picture. Without scripts, the page still shows everything.
"""

import math
from base64 import b64encode
from hashlib import sha256
from html import escape

from tftool.base.plain_text import distinct, visible
from tftool.base.stamps import display
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing.frame_tree import HEADINGS, NO_MARKS, NOTHING, Marks, facts
from tftool.drawing.pdf import width
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
    """Return a picture as the text of an SVG file, with escaped names."""
    wide, high = _number(picture.width), _number(picture.height)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" '
        f'viewBox="0 0 {wide} {high}">',
        f"<title>{escape(picture.title, quote=False)}</title>",
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
    # The full name, shown when the pointer rests on a box whose name was shortened.
    return (
        f"{opening}><title>{escape(box.title, quote=False)}</title></rect>"
        if box.title
        else f"{opening}/>"
    )


def _text(text: Text) -> str:
    length = width(text.text, text.size, bold=text.kind == "name")
    # A viewer's font may be wider than Helvetica. So every text of a card is drawn at its width:
    # if only some lines were squeezed, they would look like several font sizes.
    fitted = f' textLength="{_number(length)}" lengthAdjust="spacingAndGlyphs"'
    return (
        f'<text class="{text.kind}" x="{_number(text.x)}" y="{_number(text.y)}" '
        f'font-size="{_number(text.size)}"{fitted if math.isfinite(text.room) else ""}>'
        f"{escape(text.text, quote=False)}</text>"
    )


def _number(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")


_PAGE_STYLE = """\
:root { color-scheme: light dark; }
body { margin: 1.5rem; font: 15px/1.45 system-ui, sans-serif; background: #fbfbfd; color: #171c24; }
h1 { font-size: 1.2rem; margin: 0; }
.picture { overflow: hidden; margin: .6rem 0 1rem; height: 75vh; border: 1px solid #d6dce5; }
.picture svg { width: 100%; height: 100%; cursor: grab; touch-action: none; }
rect.found { stroke: #d9731a; stroke-width: 5; }
.tools { display: flex; gap: .5rem; align-items: center; flex-wrap: wrap; margin-top: .6rem; }
.tools input { font: inherit; padding: .2rem .5rem; width: 16rem; }
.tools button { font: inherit; padding: .2rem .6rem; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .25rem .9rem .25rem 0; vertical-align: top; }
td { border-top: 1px solid #d6dce5; white-space: nowrap; }
td.frame { white-space: normal; overflow-wrap: anywhere; max-width: 40rem; }
td.number, th.number { text-align: right; }
tr.wrong td { color: #9a4a00; }
@media (prefers-color-scheme: dark) {
body { background: #14171c; color: #e4e9f0; }
td { border-color: #333c49; }
tr.wrong td { color: #f0a860; }
}"""


_SCRIPT = """\
const svg = document.querySelector(".picture svg"), words = document.querySelector("#words");
const wide = svg.viewBox.baseVal.width, high = svg.viewBox.baseVal.height;
const rows = [...document.querySelectorAll("tbody tr")];
const boxes = [...svg.querySelectorAll("rect")].filter((box) => box.querySelector("title"));
let view = [0, 0, wide, high], found = [], place = -1;
const show = () => svg.setAttribute("viewBox", view.join(" "));
const fit = () => { view = [0, 0, wide, high]; show(); };
function point(event) {
  const at = new DOMPoint(event.clientX, event.clientY);
  return at.matrixTransform(svg.getScreenCTM().inverse());
}
function zoom(factor, x = view[0] + view[2] / 2, y = view[1] + view[3] / 2) {
  const size = Math.min(4 * wide, Math.max(wide / 200, view[2] * factor)) / view[2];
  view = [x + (view[0] - x) * size, y + (view[1] - y) * size, view[2] * size, view[3] * size];
  show();
}
svg.addEventListener("wheel", (event) => {
  event.preventDefault();
  const at = point(event);
  zoom(event.deltaY < 0 ? 0.8 : 1.25, at.x, at.y);
}, { passive: false });
let held = null;
svg.addEventListener("pointerdown", (event) => {
  held = point(event);
  svg.setPointerCapture(event.pointerId);
});
svg.addEventListener("pointermove", (event) => {
  if (!held) return;
  const at = point(event);
  view[0] += held.x - at.x;
  view[1] += held.y - at.y;
  show();
});
svg.addEventListener("pointerup", () => { held = null; });
function search() {
  const wanted = words.value.trim().toLowerCase();
  const has = (text) => wanted !== "" && text.toLowerCase().includes(wanted);
  found = boxes.filter((box) => has(box.querySelector("title").textContent));
  for (const box of boxes) box.classList.toggle("found", found.includes(box));
  for (const row of rows) row.hidden = wanted !== "" && !has(row.cells[0].textContent);
  document.querySelector("#count").textContent =
    wanted === "" ? "" : found.length + (found.length === 1 ? " frame" : " frames");
  place = -1;
}
function next() {
  if (!found.length) return;
  place = (place + 1) % found.length;
  const box = found[place].getBBox(), ratio = svg.clientHeight / svg.clientWidth;
  const across = Math.max(6 * box.width, 900);
  view = [box.x + box.width / 2 - across / 2, box.y + box.height / 2 - across * ratio / 2,
    across, across * ratio];
  show();
}
words.addEventListener("input", search);
words.addEventListener("keydown", (event) => { if (event.key === "Enter") next(); });
const tools = { fit, nearer: () => zoom(0.8), farther: () => zoom(1.25) };
for (const [name, does] of Object.entries(tools)) {
  document.querySelector("#" + name).addEventListener("click", does);
}
addEventListener("keydown", (event) => {
  if (event.target === words) return;
  if (event.key === "+" || event.key === "=") zoom(0.8);
  else if (event.key === "-") zoom(1.25);
  else if (event.key === "0") fit();
  else if (event.key === "/") { event.preventDefault(); words.focus(); }
});
"""
_TOOLS = """\
<div class="tools"><input id="words" type="search" placeholder="find a frame: Enter goes to it"
 aria-label="Find a frame"><span id="count" role="status"></span>
<button id="nearer" type="button">+</button><button id="farther" type="button">&minus;</button>
<button id="fit" type="button">fit</button></div>"""


def page(snapshot: Snapshot, svg: str, marks: Marks = NO_MARKS) -> str:
    """Return the HTML page of a snapshot.

    Args:
        snapshot: Frames for the table.
        svg: Picture of the frames' trees.
        marks: Ids of the doctor's findings about each frame.

    Returns:
        Text of the page, in which names are escaped.
    """
    names = distinct(info.frame for info in snapshot.frames)
    told = f"Recorded at time: {display(snapshot.now)}"
    if snapshot.at:
        told += f", shown at time: {display(snapshot.at)}"
    headings = ["frame", "parent", *HEADINGS[1:], *(["wrong"] if marks else [])]
    cells = "".join(
        f"<th{_class(place, len(headings), bool(marks))}>{heading}</th>"
        for place, heading in enumerate(headings)
    )
    rows = "\n".join(_table_row(info, names, marks) for info in snapshot.frames)
    table = f"<table>\n<thead><tr>{cells}</tr></thead>\n<tbody>\n{rows}\n</tbody>\n</table>"
    body = [
        "<h1>Frames</h1>",
        f"<p>{told}</p>",
        *(
            [
                _TOOLS,
                f'<div class="picture">\n{svg}</div>',
                f'<div class="table">\n{table}\n</div>',
                f"<script>\n{_SCRIPT}</script>",
            ]
            if snapshot.frames
            else [f"<p>{NOTHING}</p>"]
        ),
    ]
    # This policy stops any other script, whatever characters a name contains.
    allowed = b64encode(sha256(f"\n{_SCRIPT}".encode()).digest()).decode()
    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            "<head>",
            '<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            '<meta http-equiv="Content-Security-Policy" '
            "content=\"default-src 'none'; style-src 'unsafe-inline'; "
            f"script-src 'sha256-{allowed}'\">",
            "<title>Frames</title>",
            f"<style>{_PAGE_STYLE}</style>",
            "</head>",
            "<body>",
            *body,
            "</body>",
            "</html>",
            "",
        ]
    )


def _table_row(info: FrameInfo, names: dict[str, str], marks: Marks) -> str:
    parent = "" if info.parent is None else names.get(info.parent, visible(info.parent))
    told = facts(info) if info.parent is not None else ("",) * len(HEADINGS[1:])
    ids = ", ".join(marks.get(info.frame, ()))
    cells = [names[info.frame], parent, *told, *([ids] if marks else [])]
    written = "".join(
        f"<td{_class(place, len(cells), bool(marks))}>{escape(cell)}</td>"
        for place, cell in enumerate(cells)
    )
    return f'<tr class="wrong">{written}</tr>' if ids else f"<tr>{written}</tr>"


def _class(column: int, count: int, has_marks: bool) -> str:
    """Return the class attribute of a table cell: "frame" for names, "number" for numbers, or none.

    Args:
        column: Index of the column.
        count: Number of columns.
        has_marks: Whether the last column shows the doctor's findings.
    """
    if column < 2:
        return ' class="frame"'
    return ' class="number"' if 4 <= column < count - has_marks else ""
