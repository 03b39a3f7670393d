"""The tree of frames as text: whole, or fitted to a terminal."""

from rich.console import Console
from rich.text import Text

from tftool.buffer.sample import Snapshot
from tftool.drawing import frame_tree
from tftool.drawing.frame_tree import NOTHING, Marks, advice, compact

Moving = frozenset[str] | None
"""The links of a description whose joint moves; None for other frames."""


def drawn(snapshot: Snapshot, moving: Moving, marks: Marks, *, wide: bool) -> str:
    """The tree in the width of this terminal; in full where there is none, or if asked for."""
    console = Console()
    if console.is_terminal and not wide:
        picture = fitting(snapshot, moving, marks, console)
    else:
        picture = frame_tree.render(
            snapshot,
            ascii_only=console.is_terminal and console.options.ascii_only,
            moving=moving,
            marks=marks,
        )
    if not console.is_terminal:
        return picture.plain + "\n"
    with console.capture() as capture:
        console.print(picture, soft_wrap=True)
    return capture.get()


def fitting(snapshot: Snapshot, moving: Moving, marks: Marks, console: Console) -> Text:
    """Return the tree in the width of a terminal, its columns and names cut to fit."""
    if not snapshot.frames:
        return Text(NOTHING)
    found = compact(
        snapshot, console.width, ascii_only=console.options.ascii_only, moving=moving, marks=marks
    )
    lines = [*found.heading, *found.rows]
    if marks:
        lines.append(Text(advice(marks), style="yellow"))
    if found.is_cut:
        lines.append(Text("Some names are cut to fit: --wide shows them whole.", style="dim"))
    return Text("\n").join(lines)
