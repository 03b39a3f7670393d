"""Pictures of the frame tree as dot, Mermaid, SVG, HTML, PDF or PNG, without Graphviz.

The dot text equals that of view_frames, so that programs for frames.gv can read it. The other
formats have tftool's own layout.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from tftool.base.plain_text import distinct, shorten, visible
from tftool.buffer.sample import Snapshot
from tftool.drawing import pdf as pdf_writer
from tftool.drawing import sheet_image
from tftool.drawing import svg as svg_writer
from tftool.drawing.drawn_forest import Forest, facts, grow, recorded_at
from tftool.drawing.frame_tree import NO_MARKS, Marks
from tftool.drawing.picture import MOST_DRAWN, lay_out


@dataclass(frozen=True, slots=True)
class Drawing:
    """Content of a picture's file.

    Attributes:
        content: Text, or bytes for PDF and PNG.
        left_out: Number of frames that are not in the picture.
        note: Sentence about omitted or shortened content; empty if the picture is complete.
    """

    content: str | bytes
    left_out: int = 0
    note: str = ""


def draw(snapshot: Snapshot, form: str, marks: Marks = NO_MARKS) -> Drawing:
    """Draw a snapshot's trees in one of `FORMATS`.

    Args:
        snapshot: Frames to draw.
        form: Name of the format.
        marks: Ids of the doctor's findings about each frame.

    Raises:
        KeyError: If `form` is not the name of a format.
    """
    return FORMATS[form](snapshot, marks)


def dot(snapshot: Snapshot, marks: Marks = NO_MARKS) -> Drawing:
    """Return the text of a dot file; without static transforms, view_frames writes the same bytes.

    Lines to static frames are dashed. All frames are in the picture. The legend is attached to
    every root. view_frames attaches the legend to one root only, and fails if the frames form a
    loop.
    """
    named = distinct(frame.frame for frame in snapshot.frames)
    known = frozenset(named)
    lines = []
    for frame in snapshot.frames:
        if frame.parent is None or frame.parent not in known:
            continue
        label = "\\n".join(map(_dot_label, facts(frame).lines(units=False)))
        dashed = ", style=dashed" if frame.is_static else ""
        ends = f"{_dot_id(named[frame.parent])} -> {_dot_id(named[frame.frame])}"
        lines.append(f'{ends}[label=" {label}\\n"{dashed}];\n')
    if not lines:
        return Drawing('digraph G { "No tf data received" }')

    # Graphviz decodes HTML entities in a label that it takes from the node's name.
    entities = [
        f'{_dot_id(name)}[label="{_dot_label(name)}"];\n' for name in named.values() if "&" in name
    ]
    parents = {frame.parent for frame in snapshot.frames}
    roots = [
        _dot_id(named[frame.frame])
        for frame in snapshot.frames
        if frame.parent is None and frame.frame in parents
    ]
    tie = "" if not roots else f"->{roots[0]};" if len(roots) == 1 else f"->{{{' '.join(roots)}}};"
    return Drawing(
        "digraph G {\n"
        + "".join(lines)
        + "".join(entities)
        + "edge [style=invis];\n"
        + ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";\n'
        + f'"{recorded_at(snapshot.now)}"[ shape=plaintext ] ;\n'
        + "}"
        + tie
        + "\n}"
    )


def _dot_id(name: str) -> str:
    quoted = name.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{quoted}"'


def _dot_label(text: str) -> str:
    text = visible(text)
    return text.replace("&", "&amp;").replace("\\", "\\\\").replace('"', '\\"')


_MERMAID_LINKS = 450
"""Mermaid refuses flowcharts of more than 500 edges, and of more than 50 000 characters."""
_MERMAID_TEXT = 49_000
_MERMAID_NAME = 60


def mermaid(snapshot: Snapshot, marks: Marks = NO_MARKS) -> Drawing:
    """Return a Mermaid flowchart of the trees, which GitHub and many wikis draw.

    Mermaid refuses large charts. In a large chart, edges show only their rate. If the chart is
    still too large, the frames farthest from their root are left out, and a note says so.
    """
    forest = grow(snapshot, most=_MERMAID_LINKS)
    text = _flowchart(snapshot, forest, full=True)
    note = _left_out(forest)
    if len(text) > _MERMAID_TEXT:
        note = f"links show only their rate, because Mermaid limits the text. {note}".strip()
        text = _flowchart(snapshot, forest, full=False, note=note)
    most = len(forest.children)
    while len(text) > _MERMAID_TEXT:
        most = most * 3 // 4
        forest = grow(snapshot, most=most)
        note = f"links show only their rate, because Mermaid limits the text. {_left_out(forest)}"
        text = _flowchart(snapshot, forest, full=False, note=note)
    return Drawing(text, forest.left_out, note)


def _flowchart(snapshot: Snapshot, forest: Forest, *, full: bool, note: str = "") -> str:
    named = distinct(forest.children)
    numbers = {name: f"f{number}" for number, name in enumerate(forest.children)}
    head = [recorded_at(snapshot.now), *filter(None, [note or _left_out(forest)])]
    if not forest.children:
        head.append("No tf data received")
    lines = ["flowchart TD"]
    lines.append(f'  legend["{"<br>".join(map(_mermaid_text, head))}"]:::legend')
    for name, number in numbers.items():
        label = _mermaid_text(shorten(named[name], _MERMAID_NAME))
        opening, closing = ('(["', '"])') if forest.info[name].parent is None else ('["', '"]')
        lines.append(f"  {number}{opening}{label}{closing}")
    for parent, children in forest.children.items():
        for child in children:
            frame = forest.info[child]
            told = facts(frame)
            words = told.lines(units=True) if full else (f"{told.rate} Hz",)
            label = "<br>".join(_mermaid_text(shorten(visible(word), 90)) for word in words)
            link = "-.->" if frame.is_static else "-->"
            lines.append(f'  {numbers[parent]} {link}|"{label}"| {numbers[child]}')
    lines.extend(f"  legend ~~~ {numbers[root]}" for root in forest.roots)
    lines.append("  classDef legend fill:none,stroke:none")
    return "\n".join(lines) + "\n"


def _mermaid_text(text: str) -> str:
    """Escape every character that has a meaning in Mermaid, Markdown or HTML."""
    # "fa:fa-car" would become an icon even when escaped: Mermaid decodes escapes first.
    text = text.replace(":fa-", ":\u200bfa-")
    return _ACTIVE.sub(lambda found: f"#{ord(found[0])};", text)


_ACTIVE = re.compile(r"[^\w\s,:/.\-\u0080-\U0010ffff]|(?<![^\W_])[_.-]|[_.-](?![^\W_])")
"""Characters to escape; common characters of names only where they could have a meaning."""


def svg(snapshot: Snapshot, marks: Marks = NO_MARKS) -> Drawing:
    """Draw the trees as SVG in tftool's own layout; at most `MOST_DRAWN` frames."""
    picture = lay_out(snapshot, stale=_stale(marks))
    return Drawing(svg_writer.render(picture), picture.left_out, _picture_note(picture.left_out))


def page(snapshot: Snapshot, marks: Marks = NO_MARKS) -> Drawing:
    """Draw the trees as one HTML file: the SVG picture, and below it a table of all frames."""
    picture = lay_out(snapshot, stale=_stale(marks))
    content = svg_writer.page(snapshot, svg_writer.render(picture), marks)
    return Drawing(content, picture.left_out, _picture_note(picture.left_out))


def pdf(snapshot: Snapshot, marks: Marks = NO_MARKS) -> Drawing:
    """Draw the trees as a PDF page; at most `MOST_DRAWN` frames.

    Letters that Helvetica lacks are written as their codes.
    """
    picture = lay_out(snapshot, stale=_stale(marks))
    notes = [_picture_note(picture.left_out), _letters_note(pdf_writer.missing_letters(picture))]
    note = "; ".join(filter(None, notes))
    return Drawing(pdf_writer.render(picture), picture.left_out, note)


def png(snapshot: Snapshot, marks: Marks = NO_MARKS) -> Drawing:
    """Draw the trees as a PNG image; at most `MOST_DRAWN` frames.

    Raises:
        UsageError: If the extra `plot` is not installed.
    """
    picture = lay_out(snapshot, stale=_stale(marks))
    content = sheet_image.render(picture)
    notes = [_picture_note(picture.left_out)]
    if missing := sheet_image.missing_letters(picture):
        notes.append(f"the PNG's font has no letter for {_listed(missing)}: {_SHOWN_BY}")
    return Drawing(content, picture.left_out, "; ".join(filter(None, notes)))


def _stale(marks: Marks) -> frozenset[str]:
    return frozenset(frame for frame, ids in marks.items() if "edge-stopped" in ids)


_LETTERS_NAMED = 12
_SHOWN_BY = "svg and html show these letters"


def _letters_note(missing: str) -> str:
    if not missing:
        return ""
    return (
        f"the PDF's font has no letter for {_listed(missing)}: each is written as its number, "
        f"<U+{ord(missing[0]):04X}>; {_SHOWN_BY}"
    )


def _listed(letters: str) -> str:
    named = " ".join(letters[:_LETTERS_NAMED])
    return named + (
        f" and {len(letters) - _LETTERS_NAMED} more" if letters[_LETTERS_NAMED:] else ""
    )


def _left_out(forest: Forest) -> str:
    if not forest.left_out:
        return ""
    return (
        f"{len(forest.children)} of {len(forest.info)} frames shown, {forest.left_out} left out: "
        "those farthest from their root."
    )


def _picture_note(left_out: int) -> str:
    if not left_out:
        return ""
    return (
        f"the picture shows {MOST_DRAWN} frames and leaves out {left_out}, "
        "those farthest from their root; dot and json contain all frames"
    )


FORMATS: Mapping[str, Callable[[Snapshot, Marks], Drawing]] = {
    "dot": dot,
    "mermaid": mermaid,
    "svg": svg,
    "html": page,
    "pdf": pdf,
    "png": png,
}
"""Function that draws each format, by the format's name."""
