"""`tftool tree`: which frame hangs from which, as text, data or a picture."""

import sys
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.cli.options import CacheTime, not_negative, positive
from tftool.errors import InputError, UsageError
from tftool.stamps import Duration, seconds

if TYPE_CHECKING:
    from collections.abc import Callable

    from tftool.cli.lifetime import Session
    from tftool.frames.sample import Snapshot
    from tftool.runtime.log import LogRecord


class Format(str, Enum):
    """What a tree can be written as."""

    tree = "tree"
    json = "json"
    yaml = "yaml"
    dot = "dot"
    mermaid = "mermaid"
    svg = "svg"
    pdf = "pdf"


TEXTS = {
    ".txt": Format.tree,
    ".json": Format.json,
    ".yaml": Format.yaml,
    ".yml": Format.yaml,
}
"""What a file's suffix asks for, where it is no drawing."""

LISTEN = 5.0
"""Seconds a scenario is played before its frames are shown, as view_frames listens."""

LISTEN_LIVE = 2.0
"""Seconds a session that runs is listened to: enough for a rate."""


def tree(
    place: Annotated[
        str | None,
        typer.Argument(metavar="[FROM]", help="World to show: a scenario, by name or file."),
    ] = None,
    form: Annotated[
        Format | None,
        typer.Option("--format", "-f", help="What to write; if not said, what -o ends in."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="Where to write it; - is stdout."),
    ] = None,
    at: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            callback=not_negative,
            help="Moment to show, in seconds since the scenario began; 5 if not said.",
        ),
    ] = None,
    watch: Annotated[bool, typer.Option("--watch", "-w", help="Draw it again and again.")] = False,
    run_for: Annotated[
        float | None,
        typer.Option(
            "--for", metavar="SECONDS", callback=positive, help="With --watch: stop after so long."
        ),
    ] = None,
    cache_time: CacheTime = None,
) -> None:
    """Show which frame hangs from which (rqt_tf_tree, view_frames).

    Every tree there is, and for every link: whether it is static, who broadcasts it, how
    often, how long a past the buffer holds of it, and how old its newest data is.

    tftool tree                   the tree of what runs here
    tftool tree robot -o robot.svg
    tftool tree --watch
    """
    from tftool.cli.session import A_MOMENT, NO_SESSION, join_session, open_session
    from tftool.runtime.clock import SimClock

    form = form or _form_of(output)
    cache = None if cache_time is None else seconds(cache_time)
    if watch:
        if form is not Format.tree or output is not None or at is not None:
            raise UsageError("--watch draws on the terminal: leave out --format, -o and --at.")
        _watch(
            lambda: open_session(place, cache_time=cache),
            None if run_for is None else seconds(run_for),
        )
        return
    if run_for is not None:
        raise UsageError("--for goes with --watch; without it the tree is written once.")
    joined = None if place is not None or at is not None else join_session(cache_time=cache)
    if joined is not None:
        joined.run(joined.lasting(seconds(LISTEN_LIVE)))
        _write(joined.world.buffer.snapshot(joined.world.clock.now()), form, output)
        return
    clock = SimClock()
    because = NO_SESSION if at is None else A_MOMENT
    session = open_session(place, clock=clock, cache_time=cache, because=because)
    session.live_until(session.moment(seconds(LISTEN if at is None else at)))
    _write(session.world.buffer.snapshot(clock.now()), form, output)


def _form_of(output: Path | None) -> Format:
    if output is None or str(output) == "-":
        return Format.tree
    from tftool.views.drawing import SUFFIXES

    known = TEXTS | {suffix: Format(form) for suffix, form in SUFFIXES.items()}
    suffix = output.suffix.lower()
    if output.is_dir():
        raise UsageError(f"'{output}' is a folder: name a file in it.")
    if suffix not in known:
        raise UsageError(
            f"'{output}' does not say what to write: end it in {', '.join(sorted(known))}, "
            "or give --format."
        )
    return known[suffix]


def _write(snapshot: "Snapshot", form: Format, output: Path | None) -> None:
    content = _content(snapshot, form, to_file=output is not None)
    if output is None or str(output) == "-":
        if isinstance(content, bytes):
            if sys.stdout.isatty():
                raise UsageError("A PDF is nothing for a terminal: say where it goes with -o FILE.")
            sys.stdout.buffer.write(content)
        else:
            sys.stdout.write(content)
        return
    try:
        if isinstance(content, bytes):
            output.write_bytes(content)
        else:
            output.write_text(content, encoding="utf-8")
    except OSError as error:
        raise InputError(f"'{output}' cannot be written: {error.strerror or error}.") from error


def _content(snapshot: "Snapshot", form: Format, *, to_file: bool) -> str | bytes:
    from tftool.cli.notices import notice
    from tftool.views import frame_tree

    if form is Format.json:
        import json

        return json.dumps(frame_tree.as_object(snapshot), indent=2, allow_nan=False) + "\n"
    if form is Format.yaml:
        return frame_tree.as_yaml(snapshot)
    if form is Format.tree:
        return _drawn(snapshot, to_file=to_file)
    from tftool.views.drawing import draw

    drawing = draw(snapshot, form.value)
    if drawing.note:
        notice(drawing.note)
    return drawing.content


def _drawn(snapshot: "Snapshot", *, to_file: bool) -> str:
    """The tree as this terminal shows it; in full where there is none."""
    from rich.console import Console

    from tftool.views import frame_tree

    console = Console()
    terminal = console.is_terminal and not to_file
    picture = frame_tree.render(
        snapshot,
        width=console.width if terminal else None,
        ascii_only=not to_file and console.options.ascii_only,
    )
    if not terminal:
        return picture.plain + "\n"
    with console.capture() as capture:
        console.print(picture)
    return capture.get()


def _watch(open_session: "Callable[[], Session]", duration: Duration | None) -> None:
    from rich.console import Console, Group
    from rich.live import Live
    from rich.text import Text

    from tftool.cli.notices import is_news
    from tftool.runtime.clock import Phase
    from tftool.views import frame_tree
    from tftool.views.escaping import visible

    console = Console()
    if not console.is_terminal:
        raise UsageError("--watch needs a terminal; without it the tree is written once.")
    session = open_session()
    world = session.world
    # On this screen nothing else can be read.
    news = Text(style="yellow")

    def tell(record: "LogRecord") -> None:
        if is_news(record):
            news.plain = f"\n{visible(record.text)}"

    world.log.listen(tell)

    async def draw() -> None:
        # Redrawn on the world's own ticks; rich's thread would draw half a change.
        with Live(console=console, auto_refresh=False, screen=True) as live:
            due = world.clock.now()
            end = None if duration is None else due + duration
            while end is None or due <= end:
                picture = frame_tree.render(
                    world.buffer.snapshot(world.clock.now()),
                    width=console.width,
                    ascii_only=console.options.ascii_only,
                )
                live.update(Group(picture, news), refresh=True)
                due = max(due + seconds(0.5), world.clock.now())
                await world.clock.sleep_until(due, Phase.WATCH)

    session.run(draw())
