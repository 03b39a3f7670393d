"""The tree of frames as text: complete, or fitted to a terminal."""

from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.text import Text

from tftool.base.short_numbers import count
from tftool.buffer.sample import Snapshot
from tftool.drawing import frame_tree
from tftool.drawing.frame_tree import NOTHING, Marks, advice, compact

LINES_AT_ONCE = 400

MOST_ON_SCREEN = 5_000
"""Frames drawn on a terminal: of a tree of tens of thousands, nobody scrolls through the rest."""

Moving = frozenset[str] | None
"""The links of a description whose joint moves; None for other frames."""


def drawn(snapshot: Snapshot, moving: Moving, marks: Marks, *, wide: bool) -> Iterator[str]:
    """Yield the tree at the terminal's width; complete without a terminal or on request."""
    console = Console()
    if not console.is_terminal:
        for text, _ in frame_tree.pieces(snapshot, moving=moving, marks=marks):
            yield text
        yield "\n"
        return
    if wide:
        picture = frame_tree.render(
            snapshot, ascii_only=console.options.ascii_only, moving=moving, marks=marks
        )
        lines: Sequence[Text] = list(picture.split("\n"))
    else:
        lines = fitting(snapshot, moving, marks, console)
    # A few hundred at a time: the first show at once, and rich takes no longer for them.
    for first in range(0, len(lines), LINES_AT_ONCE):
        with console.capture() as capture:
            console.print(Text("\n").join(lines[first : first + LINES_AT_ONCE]), soft_wrap=True)
        yield capture.get()


def fitting(snapshot: Snapshot, moving: Moving, marks: Marks, console: Console) -> Sequence[Text]:
    """Return the tree at a terminal's width; columns and names are cut to fit."""
    if not snapshot.frames:
        return [Text(NOTHING)]
    found = compact(
        snapshot,
        console.width,
        ascii_only=console.options.ascii_only,
        moving=moving,
        marks=marks,
        most=MOST_ON_SCREEN,
    )
    lines = [*found.heading, *found.rows]
    left_out = len(snapshot.frames) - len(found.rows)
    if left_out:
        more = f"{count(left_out, 'frame')} more: '-o tree.txt' writes all of them."
        lines.append(Text(more, style="yellow"))
    if marks:
        lines.append(Text(advice(marks), style="yellow"))
    if found.is_cut:
        lines.append(Text("Some names are cut to fit: --wide shows them whole.", style="dim"))
    return lines
