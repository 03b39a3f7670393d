"""The trees as one file of HTML: the picture and a table, nothing fetched, no script."""

from html import escape

from tftool.base.escaping import distinct, visible
from tftool.base.stamps import display
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing.frame_tree import HEADINGS, NO_MARKS, NOTHING, Marks, facts

_STYLE = """\
:root { color-scheme: light dark; }
body { margin: 1.5rem; font: 15px/1.45 system-ui, sans-serif; background: #fbfbfd; color: #171c24; }
h1 { font-size: 1.2rem; margin: 0; }
.picture { overflow: auto; margin: 1rem 0; }
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


def render(snapshot: Snapshot, svg: str, marks: Marks = NO_MARKS) -> str:
    """Write the page.

    Args:
        snapshot: The frames.
        svg: The picture of their trees.
        marks: What is wrong with frames: ids of the doctor's checks.

    Returns:
        HTML; nothing in a name acts in it.
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
    rows = "\n".join(_row(info, names, marks) for info in snapshot.frames)
    table = f"<table>\n<thead><tr>{cells}</tr></thead>\n<tbody>\n{rows}\n</tbody>\n</table>"
    body = [
        "<h1>Frames</h1>",
        f"<p>{told}</p>",
        *(
            [f'<div class="picture">\n{svg}</div>', f'<div class="table">\n{table}\n</div>']
            if snapshot.frames
            else [f"<p>{NOTHING}</p>"]
        ),
    ]
    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            "<head>",
            '<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            '<meta http-equiv="Content-Security-Policy" '
            "content=\"default-src 'none'; style-src 'unsafe-inline'\">",
            "<title>Frames</title>",
            f"<style>{_STYLE}</style>",
            "</head>",
            "<body>",
            *body,
            "</body>",
            "</html>",
            "",
        ]
    )


def _row(info: FrameInfo, names: dict[str, str], marks: Marks) -> str:
    parent = "" if info.parent is None else names.get(info.parent, visible(info.parent))
    told = facts(info) if info.parent is not None else ("",) * len(HEADINGS[1:])
    ids = ", ".join(marks.get(info.frame, ()))
    cells = [names[info.frame], parent, *told, *([ids] if marks else [])]
    written = "".join(
        f"<td{_class(place, len(cells), bool(marks))}>{escape(cell)}</td>"
        for place, cell in enumerate(cells)
    )
    return f'<tr class="wrong">{written}</tr>' if ids else f"<tr>{written}</tr>"


def _class(place: int, count: int, has_marks: bool) -> str:
    """How a column is set: names may break, numbers stand right."""
    if place < 2:
        return ' class="frame"'
    return ' class="number"' if 4 <= place < count - has_marks else ""
