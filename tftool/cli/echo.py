"""`tftool echo`: one transform, again and again, as tf2_echo prints it."""

from typing import Annotated

import typer

from tftool.cli.options import CacheTime, ForPrograms, finite, not_negative, within
from tftool.errors import UsageError
from tftool.stamps import seconds


def echo(
    target: Annotated[
        str, typer.Argument(metavar="TARGET", help="Frame to look from: the answer is given in it.")
    ],
    source: Annotated[str, typer.Argument(metavar="SOURCE", help="Frame to look at.")],
    place: Annotated[
        str | None,
        typer.Argument(
            metavar="[FROM]", help="World to host: a scenario's name or file. A number is a rate."
        ),
    ] = None,
    rate: Annotated[
        float | None,
        typer.Option(
            "--rate",
            "-r",
            metavar="HZ",
            callback=within(0.001, 1000),
            help="How often; once a second if not said.",
        ),
    ] = None,
    once: Annotated[bool, typer.Option("--once", help="Print one transform and stop.")] = False,
    count: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Print so many transforms and stop.")
    ] = None,
    at: Annotated[
        float | None,
        typer.Option(
            "--at",
            "-t",
            metavar="SECONDS",
            callback=not_negative,
            help="Ask about one moment, in seconds since the scenario began, and stop.",
        ),
    ] = None,
    offset: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            callback=finite,
            help="Ask about a moment so far from now; -5 is five seconds ago.",
        ),
    ] = None,
    fixed_frame: Annotated[
        str | None,
        typer.Option(
            metavar="FRAME",
            help="With --offset: take only SOURCE from that moment and TARGET from now, "
            "by way of this frame, which stands still.",
        ),
    ] = None,
    distance: Annotated[
        bool, typer.Option("--distance", help="Add how far apart the two frames are, in metres.")
    ] = False,
    precision: Annotated[
        int, typer.Option("--precision", "-p", min=0, max=17, metavar="N", help="Decimals.")
    ] = 3,
    timeout: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            callback=not_negative,
            help="Give up waiting after so long (exit status 4).",
        ),
    ] = None,
    for_programs: ForPrograms = False,
    cache_time: CacheTime = None,
) -> None:
    """Print where SOURCE is in TARGET (ros2 run tf2_ros tf2_echo).

    Waits until the transform is there and says why it waits. Then, once a second:
    translation, quaternion (x y z w), roll pitch yaw in radians and degrees, matrix.

    tftool echo turtle2 turtle1            turtle1 as turtle2 sees it
    tftool echo map laser_link robot --at 12.5
    tftool echo turtle2 turtle1 --offset -5 --fixed-frame world
    """
    from tftool.cli.echoing import Echo, Printer, Question
    from tftool.cli.notices import notice
    from tftool.cli.session import A_MOMENT, NO_SESSION, open_session
    from tftool.runtime.clock import SimClock
    from tftool.views.echo import in_words

    place, rate = _place_or_rate(place, rate)
    if once and count not in (None, 1):
        raise UsageError(f"--once and --count {count} contradict each other.")
    if at is not None and count not in (None, 1):
        raise UsageError(f"--at asks about one moment, and has one answer, not {count}.")
    if fixed_frame is not None and offset is None:
        raise UsageError("--fixed-frame needs --offset: it carries SOURCE over that time.")
    if at is not None and offset is not None:
        raise UsageError("--at and --offset both choose the moment: leave one out.")
    for frame in (target, source, *([] if fixed_frame is None else [fixed_frame])):
        _check_name(frame)

    clock = None if at is None else SimClock()
    session = open_session(
        place,
        clock=clock,
        cache_time=None if cache_time is None else seconds(cache_time),
        because=NO_SESSION if at is None else A_MOMENT,
    )
    heading = in_words(target, source)
    moment = patience = 0
    if clock is not None and at is not None:
        heading += f", {at:g} s after {session.name} began"
        moment = session.moment(seconds(at))
        # What has not come a second after the moment asked about will not come.
        patience = seconds(at) + seconds(1)
    notice(f"{heading}:")
    if target == source:
        notice("A frame seen from itself is always the identity.")
    echoing = Echo(
        session.world,
        Question(target, source, moment, seconds(offset or 0.0), fixed_frame),
        Printer(precision, distance, for_programs),
        period=seconds(1.0 / (rate or 1.0)),
        count=1 if once or moment else count,
        patience=(patience or None) if timeout is None else seconds(timeout),
        tells=not moment,
        departures=session.departures,
    )
    session.run(echoing.run())


def _place_or_rate(place: str | None, rate: float | None) -> tuple[str | None, float | None]:
    """Take tf2_echo's third word, its rate, where it can be nothing else."""
    if place is None:
        return place, rate
    try:
        number = float(place)
    except ValueError:
        return place, rate
    from pathlib import Path

    if Path(place).exists():
        return place, rate
    if rate is not None:
        raise UsageError(f"The rate is given twice: {place} and --rate {rate:g}.")
    return None, within(0.001, 1000)(number)


def _check_name(frame: str) -> None:
    if not frame:
        raise UsageError("A frame's name cannot be empty.")
    if frame.startswith("/"):
        raise UsageError(
            f"Frame \"{frame}\": in tf2 frame_ids cannot start with a '/'. "
            f"Ask for {frame.lstrip('/') or 'its name without it'}."
        )
