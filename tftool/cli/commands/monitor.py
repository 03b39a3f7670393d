"""`tftool monitor`: what arrives, how often, how late."""

import sys
from typing import Annotated

import typer

from tftool.cli.app import ExitStatus
from tftool.cli.connection import Connection
from tftool.cli.options import OUTPUT, WHEN, CacheTime, Json, RunFor, duration, positive
from tftool.errors import InputError, UsageError
from tftool.stamps import Duration, seconds


def monitor(
    connection: Connection,
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[A B] [FROM]",
            help="Two frames, for the chain between them; then a world to host: "
            "a scenario's name or file.",
            show_default=False,
        ),
    ] = None,
    run_for: RunFor = None,
    every: Annotated[
        Duration | None,
        typer.Option(
            metavar="SECONDS",
            parser=duration(positive),
            rich_help_panel=WHEN,
            help="Time between two reports: 1 on a terminal, 10 elsewhere.",
        ),
    ] = None,
    as_tf2: Annotated[
        bool,
        typer.Option(
            "--tf2",
            rich_help_panel=OUTPUT,
            help="Print tf2_monitor's own numbers, its flaws included.",
        ),
    ] = False,
    for_programs: Json = False,
    cache_time: CacheTime = None,
) -> ExitStatus:
    """Show how often and how late transforms arrive (tf2_monitor).

    And from whom. Without frames, all of them; with two, the chain between them and how old its
    latest transform is.

    tftool monitor
    tftool monitor turtle2 turtle1
    tftool monitor robot --for 10 --json
    """
    from tftool.cli.hosting import open_session
    from tftool.cli.monitoring import Monitor, Style

    if as_tf2 and for_programs:
        raise UsageError("--tf2 and --json are two ways of writing: choose one.")
    frames, place = _sorted_out(words or [])
    try:
        session = open_session(
            connection, place, cache_time=cache_time, needs_messages=True, plays=True
        )
    except InputError as error:
        if frames is None:
            sentence = f"{error} For the chain between two frames, name both."
            raise InputError(sentence) from error
        raise
    if for_programs:
        style = Style.JSON
    elif as_tf2:
        style = Style.TF2
    else:
        style = Style.TABLE if sys.stdout.isatty() else Style.LINES
    if session.is_played and session.duration is not None:
        # What was recorded is over at once: one report says all of it.
        run_for = min(run_for or session.duration, session.duration) or 1
        every = every or run_for
    if every is None:
        every = seconds(1) if style is Style.TABLE else seconds(10)
    watching = Monitor(session.world, frames, style, period=every)
    session.run(watching.run(run_for))
    return ExitStatus.DONE


def _sorted_out(words: list[str]) -> tuple[tuple[str, str] | None, str | None]:
    """Tell frames from a world: two words are frames, one is a world, three are all."""
    if len(words) > 3:
        raise UsageError(
            f"{len(words)} words are too many: no frames or two of them, then a scenario."
        )
    if len(words) < 2:
        place = words[0] if words else None
        return None, place
    target, source, *rest = words
    return (target, source), rest[0] if rest else None
