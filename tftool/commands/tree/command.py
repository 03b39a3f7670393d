"""Implementation of `tftool tree`: write the tree of frames once, as text, data or a picture."""

import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from rich.console import Console
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count, visible
from tftool.buffer.sample import Snapshot
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.notices import notice, rivalries
from tftool.commands.shared.options import refuse
from tftool.commands.shared.printer import write_file
from tftool.commands.tree import TreeFormat, TreeOptions
from tftool.doctor.frame_marks import marks as doctor_marks
from tftool.drawing import frame_tree
from tftool.drawing.frame_tree import NOTHING, Marks, advice, compact
from tftool.recordings.target import refuse_existing

LINES_AT_ONCE = 400

MOST_ON_SCREEN = 5_000
"""Most frames drawn on a terminal, because nobody scrolls through tens of thousands."""

Moving = frozenset[str] | None
"""Frames whose joint moves, if the frames are of a robot description; else None."""


def drawn(snapshot: Snapshot, moving: Moving, marks: Marks, options: TreeOptions) -> Iterator[str]:
    """Yield the text of the tree in parts, so that the first lines of a large tree appear soon.

    On a terminal, lines are shortened to the width of the terminal unless --wide is given.
    """
    console = Console()
    if not console.is_terminal:
        for text, _ in frame_tree.pieces(
            snapshot, ascii_only=options.ascii_only, moving=moving, marks=marks
        ):
            yield text
        yield "\n"
        return
    ascii_only = options.ascii_only or console.options.ascii_only
    if options.wide or options.output is not None:
        picture = frame_tree.render(snapshot, ascii_only=ascii_only, moving=moving, marks=marks)
        lines: Sequence[Text] = list(picture.split("\n"))
    else:
        lines = fitting(snapshot, moving, marks, console, options)
    # A few hundred lines at a time: the first appear at once, and rich is not slower.
    for first in range(0, len(lines), LINES_AT_ONCE):
        with console.capture() as capture:
            console.print(Text("\n").join(lines[first : first + LINES_AT_ONCE]), soft_wrap=True)
        yield capture.get()


def fitting(
    snapshot: Snapshot, moving: Moving, marks: Marks, console: Console, options: TreeOptions
) -> Sequence[Text]:
    """Return the lines of a tree, with columns and names shortened to a terminal's width."""
    if not snapshot.frames:
        return [Text(NOTHING)]
    found = compact(
        snapshot,
        console.width,
        ascii_only=options.ascii_only or console.options.ascii_only,
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
        lines.append(Text("Some names are shortened: --wide prints the full names.", style="dim"))
    return lines


SUFFIXES = {
    ".txt": TreeFormat.tree,
    ".json": TreeFormat.json,
    ".yaml": TreeFormat.yaml,
    ".yml": TreeFormat.yaml,
    ".dot": TreeFormat.dot,
    ".gv": TreeFormat.dot,
    ".mmd": TreeFormat.mermaid,
    ".mermaid": TreeFormat.mermaid,
    ".svg": TreeFormat.svg,
    ".html": TreeFormat.html,
    ".htm": TreeFormat.html,
    ".pdf": TreeFormat.pdf,
    ".png": TreeFormat.png,
}
"""Output format for each suffix of a file."""


WITHOUT_MARKS = (TreeFormat.dot, TreeFormat.mermaid, TreeFormat.yaml)
"""Output formats that cannot show the doctor's marks."""


def run(connection: Connection, options: TreeOptions) -> ExitStatus:
    """Run `tftool tree`: write or show the tree of frames."""
    form = options.form
    if options.as_json:
        if form not in (None, TreeFormat.json):
            raise UsageError(
                f"--json and --format {form.value} are two output formats: leave one out."
            )
        form = TreeFormat.json
    form = form or _form_of(options.output)
    is_drawn_at_once = (
        form is not TreeFormat.tree or options.output is not None or options.at is not None
    )
    refuse(
        (
            options.watch and is_drawn_at_once,
            "--watch draws on the terminal: leave out --format, --json, -o and --at.",
        ),
        (options.force and options.output is None, "--force is only allowed with -o: add -o FILE."),
        (
            options.run_for is not None and not options.watch,
            "--for is only allowed with --watch: without --watch the tree is written once.",
        ),
    )
    if options.output is not None and options.output.is_file():
        refuse_existing(options.output, force=options.force)
    if options.watch:
        from tftool.commands.tree.tree_watch import show_changes

        show_changes(connection, options)
        return ExitStatus.DONE
    frames = open_from(
        connection, options.place, until=options.at, margin=0.0, cache_time=options.cache_time
    )
    buffer, now = frames.buffer, frames.span[1]
    if options.at is not None:
        now = frames.moment(options.at)
        if frames.kind == "recording":
            from tftool.frames.cut import up_to

            buffer = up_to(buffer, now)
    snapshot = buffer.snapshot(now)
    # A description that is not published has no messages for the doctor to judge.
    is_silent = form in WITHOUT_MARKS or frames.moving is not None
    marks = {} if is_silent else doctor_marks(buffer, snapshot, frames.static_edges)
    _write(snapshot, frames.moving, form, marks, options)
    for sentence in rivalries(buffer, buffer.frames()):
        notice(sentence)
    return ExitStatus.DONE


def _form_of(output: Path | None) -> TreeFormat:
    if output is None or str(output) == "-":
        return TreeFormat.tree
    suffix = output.suffix.lower()
    if output.is_dir():
        raise UsageError(f"'{output}' is a folder: name a file in it.")
    if suffix not in SUFFIXES:
        raise UsageError(
            f"'{output}' has no known suffix: end it in {', '.join(sorted(SUFFIXES))}, "
            "or give --format."
        )
    return SUFFIXES[suffix]


def _write(
    snapshot: Snapshot, moving: Moving, form: TreeFormat, marks: Marks, options: TreeOptions
) -> None:
    output, content = options.output, _content(snapshot, moving, form, marks, options)
    if output is None or str(output) == "-":
        if isinstance(content, bytes):
            if sys.stdout.isatty():
                raise UsageError(
                    "A picture cannot be printed to a terminal: name a file with -o FILE."
                )
            sys.stdout.buffer.write(content)
        else:
            sys.stdout.writelines(content)
        return

    write_file(output, content if isinstance(content, bytes) else "".join(content))
    notice(visible(f"Wrote {count(len(snapshot.frames), 'frame')} to {output}."))


def _content(
    snapshot: Snapshot, moving: Moving, form: TreeFormat, marks: Marks, options: TreeOptions
) -> bytes | Iterable[str]:
    """Return the tree in the format `form`: bytes of a picture, or parts of a text."""
    if form is TreeFormat.json:
        told = frame_tree.as_object(snapshot, moving, marks)
        return [json.dumps(told, indent=2, allow_nan=False), "\n"]
    if form is TreeFormat.yaml:
        return [frame_tree.as_yaml(snapshot)]
    if form is TreeFormat.tree:
        return drawn(snapshot, moving, marks, options)
    from tftool.drawing.tree_picture import draw

    drawing = draw(snapshot, form.value, marks)
    if drawing.note:
        notice(drawing.note)
    return drawing.content if isinstance(drawing.content, bytes) else [drawing.content]
