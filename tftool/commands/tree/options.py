"""`tftool tree`: which frame hangs from which, as text, data or a picture."""

import sys
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.options import (
    OUTPUT,
    AtOption,
    CacheTime,
    From,
    Json,
    RunFor,
    option,
    output_file,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.console import Console
    from rich.text import Text

    from tftool.buffer.sample import Snapshot
    from tftool.commands.shared.connection import Connection
    from tftool.drawing.frame_tree import Marks
    from tftool.world.link.session_world import Session
    from tftool.world.log import LogRecord
    from tftool.world.world import World

    Moving = frozenset[str] | None


class TreeFormat(StrEnum):
    """What a tree can be written as."""

    tree = "tree"
    json = "json"
    yaml = "yaml"
    dot = "dot"
    mermaid = "mermaid"
    svg = "svg"
    html = "html"
    pdf = "pdf"


TEXTS = {
    ".txt": TreeFormat.tree,
    ".json": TreeFormat.json,
    ".yaml": TreeFormat.yaml,
    ".yml": TreeFormat.yaml,
}
"""What a file's suffix asks for, where it is no drawing."""


def tree(
    connection: "Connection",
    place: From = None,
    form: Annotated[
        TreeFormat | None,
        option("What to write; if not said, what -o ends in.", "--format", "-f", panel=OUTPUT),
    ] = None,
    output: Annotated[Path | None, output_file("Where to write it; - is stdout.")] = None,
    as_json: Json = False,
    wide: Annotated[
        bool,
        option(
            "All columns and whole names on a terminal too, however long the lines.",
            "--wide",
            panel=OUTPUT,
        ),
    ] = False,
    at: AtOption = None,
    watch: Annotated[
        bool, option("Show it as it changes; keys scroll, sort and filter.", "--watch", "-w")
    ] = False,
    run_for: RunFor = None,
    cache_time: CacheTime = None,
) -> ExitStatus:
    """Show which frame hangs from which (rqt_tf_tree, view_frames).

    Every tree there is, and for every link: whether it is static, who broadcasts it, how
    often, how long a past the buffer holds of it, and how old its newest data is. Beside
    a frame with two parents by turns, that is sent no more, or has another clock than the
    others, stands the id of the doctor's check.
    A scenario is shown 5 s after its start, a recording at its end, if --at does not say.

    tftool tree                   the tree of what runs here
    tftool tree robot -o robot.svg --at 12.5
    tftool tree --watch
    """
    from tftool.commands.shared.hosting import open_session
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.observe import observe
    from tftool.commands.shared.rival_publishers import rivalries

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
        _watch(
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


def _form_of(output: Path | None) -> TreeFormat:
    if output is None or str(output) == "-":
        return TreeFormat.tree
    from tftool.drawing.tree_picture import SUFFIXES

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
    snapshot: "Snapshot",
    moving: "Moving",
    form: TreeFormat,
    output: Path | None,
    marks: "Marks",
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
    from tftool.base.counts import count
    from tftool.base.escaping import visible
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.printer import write_file

    write_file(output, content)
    notice(visible(f"Wrote {count(len(snapshot.frames), 'frame')} to {output}."))


def _content(
    snapshot: "Snapshot", moving: "Moving", form: TreeFormat, marks: "Marks", *, wide: bool
) -> str | bytes:
    from tftool.commands.shared.notices import notice
    from tftool.drawing import frame_tree

    if form is TreeFormat.json:
        import json

        told = frame_tree.as_object(snapshot, moving, marks)
        return json.dumps(told, indent=2, allow_nan=False) + "\n"
    if form is TreeFormat.yaml:
        return frame_tree.as_yaml(snapshot)
    if form is TreeFormat.tree:
        return _drawn(snapshot, moving, marks, wide=wide)
    from tftool.drawing.tree_picture import draw

    drawing = draw(snapshot, form.value, marks)
    if drawing.note:
        notice(drawing.note)
    return drawing.content


def _drawn(snapshot: "Snapshot", moving: "Moving", marks: "Marks", *, wide: bool) -> str:
    """The tree in the width of this terminal; in full where there is none, or if asked for."""
    from rich.console import Console

    from tftool.drawing import frame_tree

    console = Console()
    if console.is_terminal and not wide:
        picture = _fitting(snapshot, moving, marks, console)
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


def _fitting(snapshot: "Snapshot", moving: "Moving", marks: "Marks", console: "Console") -> "Text":
    from rich.text import Text

    from tftool.drawing.compact_tree import compact
    from tftool.drawing.frame_tree import NOTHING, advice

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


def _watch(open_session: "Callable[[], Session]", duration: Duration | None) -> None:
    """Show the tree as it changes: with keys where there are some, else redrawn in place."""
    from rich.console import Console

    from tftool.commands.shared.on_screen import screen_lacks

    console = Console()
    if not console.is_terminal:
        raise UsageError("--watch needs a terminal; without it the tree is written once.")
    session = open_session()
    if screen_lacks():
        session.run(_redrawn(session.world, duration, console))
    else:
        _watch_with_keys(session, duration)


def _watch_with_keys(session: "Session", duration: Duration | None) -> None:
    import os

    from tftool.commands.shared.notices import is_news
    from tftool.doctor.frame_marks import marks
    from tftool.screens.terminal.run_screen import show
    from tftool.screens.terminal.screen_options import Setting, setting_from
    from tftool.screens.terminal.tree_app import TreeWatch
    from tftool.world.clock import run

    world = session.world
    setting = setting_from(os.environ, sys.stdout.encoding or "ascii", Setting())
    app = TreeWatch(world, lambda snapshot: marks(world.buffer, snapshot), setting)

    def tell(record: "LogRecord") -> None:
        if is_news(record):
            app.tell(record.text)

    world.log.listen(tell, "screen")
    run(world.clock, show(app, session.along(session.lasting(duration))))


async def _redrawn(world: "World", duration: Duration | None, console: "Console") -> None:
    """Draw the tree on the world's own ticks; rich's thread would draw half a change."""
    from rich.console import Group
    from rich.live import Live
    from rich.text import Text

    from tftool.base.escaping import visible
    from tftool.commands.shared.notices import is_news
    from tftool.doctor.frame_marks import marks
    from tftool.world.clock import Phase, pace_of
    from tftool.world.stopping import leave_screen

    # On this screen nothing else can be read.
    news = Text(style="yellow")

    def tell(record: "LogRecord") -> None:
        if is_news(record):
            news.plain = f"\n{visible(record.text)}"

    world.log.listen(tell, "console")
    world.clock.when_killed.add(leave_screen, "screen")
    with Live(console=console, auto_refresh=False, screen=True) as live:
        pace = pace_of(world.clock)
        due = pace.now()
        end = None if duration is None else due + duration
        pace.limit(end)
        while end is None or due <= end:
            snapshot = world.buffer.snapshot(world.clock.now())
            picture = _fitting(snapshot, None, marks(world.buffer, snapshot), console)
            live.update(Group(picture, news), refresh=True)
            due = max(due + seconds(0.5), pace.now())
            await pace.sleep_until(due, Phase.WATCH)
