"""`tftool tree`: which frame hangs from which, as text, data or a picture."""

import json
import sys
from pathlib import Path
from typing import TypeAlias

from rich.console import Console
from rich.text import Text

from tftool.base.counts import count
from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.buffer.sample import Snapshot
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import notice
from tftool.commands.shared.observe import observe
from tftool.commands.shared.printer import write_file
from tftool.commands.shared.rival_publishers import rivalries
from tftool.commands.tree.options import TreeFormat
from tftool.drawing import frame_tree
from tftool.drawing.compact_tree import compact
from tftool.drawing.frame_tree import NOTHING, Marks, advice
from tftool.drawing.tree_picture import SUFFIXES, draw
from tftool.frames.moment import At

TEXTS = {
    ".txt": TreeFormat.tree,
    ".json": TreeFormat.json,
    ".yaml": TreeFormat.yaml,
    ".yml": TreeFormat.yaml,
}
"""What a file's suffix asks for, where it is no drawing."""

Moving: TypeAlias = frozenset[str] | None
"""Names of the frames that change; None where that is not known."""


def _form_of(output: Path | None) -> TreeFormat:
    if output is None or str(output) == "-":
        return TreeFormat.tree

    known = TEXTS | {suffix: TreeFormat(form) for suffix, form in SUFFIXES.items()}
    suffix = output.suffix.lower()
    if output.is_dir():
        raise UsageError(f"'{output}' is a folder: name a file in it.")
    if suffix not in known:
        raise UsageError(
            f"'{output}' does not say what to write: end it in {', '.join(sorted(known))}, "
            "or give --format."
        )
    return known[suffix]


def _write(
    snapshot: Snapshot,
    moving: Moving,
    form: TreeFormat,
    output: Path | None,
    marks: Marks,
    *,
    wide: bool,
) -> None:
    content = _content(snapshot, moving, form, marks, wide=wide or output is not None)
    if output is None or str(output) == "-":
        if isinstance(content, bytes):
            if sys.stdout.isatty():
                raise UsageError("A PDF is nothing for a terminal: say where it goes with -o FILE.")
            sys.stdout.buffer.write(content)
        else:
            sys.stdout.write(content)
        return

    write_file(output, content)
    notice(visible(f"Wrote {count(len(snapshot.frames), 'frame')} to {output}."))


def _content(
    snapshot: Snapshot, moving: Moving, form: TreeFormat, marks: Marks, *, wide: bool
) -> str | bytes:

    if form is TreeFormat.json:
        told = frame_tree.as_object(snapshot, moving, marks)
        return json.dumps(told, indent=2, allow_nan=False) + "\n"
    if form is TreeFormat.yaml:
        return frame_tree.as_yaml(snapshot)
    if form is TreeFormat.tree:
        return _drawn(snapshot, moving, marks, wide=wide)

    drawing = draw(snapshot, form.value, marks)
    if drawing.note:
        notice(drawing.note)
    return drawing.content


def _drawn(snapshot: Snapshot, moving: Moving, marks: Marks, *, wide: bool) -> str:
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
    """Return the tree in the width and height of a terminal."""
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


def run(
    connection: Connection,
    place: str | None,
    form: TreeFormat | None,
    output: Path | None,
    as_json: bool,
    wide: bool,
    at: At | None,
    watch: bool,
    run_for: int | None,
    cache_time: int | None,
) -> ExitStatus:
    """Run `tftool tree`; the parameters are its options."""
    if as_json:
        if form not in (None, TreeFormat.json):
            raise UsageError(f"--json and --format {form.value} exclude each other.")
        form = TreeFormat.json
    form = form or _form_of(output)
    if watch:
        if form is not TreeFormat.tree or output is not None or at is not None:
            raise UsageError(
                "--watch draws on the terminal: leave out --format, --json, -o and --at."
            )
        # textual takes longer to import than to draw a tree.
        from tftool.commands.tree.watch import watch_tree

        watch_tree(
            lambda: open_session(connection, place, cache_time=cache_time, needs_messages=True),
            run_for,
        )
        return ExitStatus.DONE
    if run_for is not None:
        raise UsageError("--for goes with --watch; without it the tree is written once.")
    seen = observe(connection, place, at, cache_time=cache_time)
    # dot, mermaid and YAML have no place for them.
    silent = (TreeFormat.dot, TreeFormat.mermaid, TreeFormat.yaml)
    snapshot = seen.snapshot()
    marks = {} if form in silent else seen.marks(snapshot)
    _write(snapshot, seen.moving, form, output, marks, wide=wide)
    for sentence in rivalries(seen.buffer, seen.buffer.frames()):
        notice(sentence)
    return ExitStatus.DONE
