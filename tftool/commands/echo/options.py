"""`tftool echo`: one transform, again and again, as tf2_echo prints it."""

import contextlib
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.options import (
    OUTPUT,
    WHEN,
    AtOption,
    CacheTime,
    Json,
    Source,
    StampsOf,
    Target,
    decimals,
    finite,
    not_negative,
    option,
    seconds_option,
    within,
)
from tftool.frames.moment import At

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Connection
    from tftool.commands.shared.echo_loop import Printer
    from tftool.commands.shared.waiter import FramePair
    from tftool.recordings.find import Found
    from tftool.world.link.session_world import Session


def echo(
    connection: "Connection",
    target: Target,
    source: Source,
    place: Annotated[
        str | None,
        typer.Argument(
            metavar="[FROM]",
            help="Whose frames: a scenario (name or file), a recording (file, folder, glob) or a "
            "robot description; if not said, the session that runs, else the turtles. A number "
            "is a rate.",
            show_default=False,
        ),
    ] = None,
    rate: Annotated[
        float | None,
        typer.Option(
            "--rate",
            "-r",
            metavar="HZ",
            rich_help_panel=WHEN,
            callback=within(0.001, 1000),
            help="How often; once a second if not said.",
        ),
    ] = None,
    once: Annotated[bool, option("Print one transform and stop.", "--once", panel=WHEN)] = False,
    count: Annotated[
        int | None,
        typer.Option(
            min=1, metavar="N", rich_help_panel=WHEN, help="Print so many transforms and stop."
        ),
    ] = None,
    at: AtOption = None,
    stamps_of: StampsOf = None,
    offset: Annotated[
        Duration | None,
        seconds_option("Ask about a moment so far from now; -5 is five seconds ago.", check=finite),
    ] = None,
    fixed_frame: Annotated[
        str | None,
        option(
            "With --offset: take only SOURCE from that moment and TARGET from now, "
            "by way of this frame, which stands still.",
            metavar="FRAME",
            panel=WHEN,
        ),
    ] = None,
    distance: Annotated[
        bool, option("Add how far apart the two frames are, in metres.", "--distance", panel=OUTPUT)
    ] = False,
    precision: Annotated[int, decimals("Decimals.")] = 3,
    timeout: Annotated[
        Duration | None,
        seconds_option("Give up waiting after so long (exit status 4).", check=not_negative),
    ] = None,
    for_programs: Json = False,
    cache_time: CacheTime = None,
) -> ExitStatus:
    """Print where SOURCE is in TARGET (ros2 run tf2_ros tf2_echo).

    Waits until the transform is there and says why it waits. Then, once a second:
    translation, quaternion (x y z w), roll pitch yaw in radians and degrees, matrix; on a
    terminal in place of the last, with x red, y green and z blue, and with its age.
    Of a recording the whole span is printed, or one moment with --at or --once.

    tftool echo turtle2 turtle1            turtle1 as turtle2 sees it
    tftool echo map laser_link robot --at 12.5
    tftool echo turtle2 turtle1 --offset -5 --fixed-frame world
    """
    from tftool.commands.shared.echo_loop import Printer
    from tftool.commands.shared.hosting import (
        A_MOMENT,
        NO_SESSION,
        open_session,
        refuse_to_forget,
        refuse_to_share,
    )
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.pairs import refuse_file_as_frame
    from tftool.commands.shared.waiter import FramePair
    from tftool.drawing.echo_view import in_words
    from tftool.frames.moment import checked_moment
    from tftool.opener import named
    from tftool.recordings.find import Kind

    place, rate = _place_or_rate(place, rate)
    _refuse_contradictions(once, count, at, offset, fixed_frame)
    refuse_file_as_frame(target, source, place)
    _check_names(target, source, *([] if fixed_frame is None else [fixed_frame]))

    # What is recorded is all there: it is read, not waited for.
    found = None if place is None else named(place)
    recorded = found is not None and found.kind is not Kind.SCENARIO
    if stamps_of is not None and (not recorded or at is not None or offset is not None):
        raise UsageError("--at-stamps-of goes with a recording, and without --at and --offset.")
    heading = in_words(target, source)
    printer = Printer(precision, distance, for_programs)
    of_one_moment = stamps_of is None and (once or at is not None or offset is not None)
    if found is not None and found.kind.is_recording and not of_one_moment:
        refuse_to_share(connection, place)
        refuse_to_forget(found, cache_time)
        notice(f"{heading}:")
        _print_recorded(connection, found, (target, source), printer, rate, stamps_of, count)
        return ExitStatus.DONE
    # Where nothing changes, once is enough.
    still = found is not None and found.kind in (Kind.DESCRIPTION, Kind.STATICS)
    once = once or (still and count is None)
    session = open_session(
        connection,
        place,
        simulated=at is not None or recorded,
        cache_time=cache_time,
        because=NO_SESSION if at is None else A_MOMENT,
    )
    stamp = 0
    if at is not None:
        stamp = checked_moment(at, session.name, session.world.clock.epoch, session.duration)
        heading += f", at {at}" if at.is_stamp else f", {at} after {session.name} began"
    if timeout is None and (stamp or recorded):
        # What has not come a second after the moment asked about will not come.
        timeout = max(stamp, session.world.clock.now()) - session.world.clock.now() + seconds(1)
    _print_live(
        session,
        FramePair(target, source, stamp, offset or 0, fixed_frame),
        printer,
        heading,
        period=seconds(1.0 / (rate or 1.0)),
        count=1 if once or stamp or recorded else count,
        patience=timeout,
        tells=not (stamp or recorded),
    )
    return ExitStatus.DONE


def _print_recorded(
    connection: "Connection",
    found: "Found",
    frames: tuple[str, str],
    printer: "Printer",
    rate: float | None,
    stamps_of: str | None,
    most: int | None,
) -> None:
    """Print the whole span of a recording, moment by moment."""
    from tftool.commands.shared.notices import name_frames
    from tftool.commands.shared.recorded import moments

    stored = connection.open_stored(found)
    name_frames(stored.buffer.frames(), frames)
    for answer in moments(stored, *frames, rate=rate, topic=stamps_of, most=most):
        printer.found(answer.stamp, answer)


def _print_live(
    session: "Session",
    pair: "FramePair",
    printer: "Printer",
    heading: str,
    *,
    period: Duration,
    count: int | None,
    patience: Duration | None,
    tells: bool,
) -> None:
    """Ask a session again and again, and print each answer, or draw it in place of the last."""
    from tftool.commands.shared.echo_loop import Echo, LivePrinter
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.redraw import Redrawing, can_redraw

    redraws = count is None and not printer.for_programs and can_redraw()
    if not redraws:
        notice(f"{heading}:")
    if pair.target == pair.source:
        notice("A frame seen from itself is always the identity.")
    with contextlib.ExitStack() as stack:
        shown: Printer | LivePrinter = printer
        if redraws:
            redrawing = stack.enter_context(Redrawing(session.world.clock))
            shown = LivePrinter(redrawing, pair, printer.precision, printer.with_distance)
        echoing = Echo(
            session.world,
            pair,
            shown,
            period=period,
            count=count,
            patience=patience,
            tells=tells,
            departures=session.departures,
        )
        session.run(echoing.run())


def _refuse_contradictions(
    once: bool,
    count: int | None,
    at: At | None,
    offset: Duration | None,
    fixed_frame: str | None,
) -> None:
    if once and count not in (None, 1):
        raise UsageError(f"--once and --count {count} contradict each other.")
    if at is not None and count not in (None, 1):
        raise UsageError(f"--at asks about one moment, and has one answer, not {count}.")
    if fixed_frame is not None and offset is None:
        raise UsageError("--fixed-frame needs --offset: it carries SOURCE over that time.")
    if at is not None and offset is not None:
        raise UsageError("--at and --offset both choose the moment: leave one out.")


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


def _check_names(*frames: str) -> None:
    for frame in frames:
        if not frame:
            raise UsageError("A frame's name cannot be empty.")
        if frame.startswith("/"):
            raise UsageError(
                f"Frame \"{frame}\": in tf2 frame_ids cannot start with a '/'. "
                f"Ask for {frame.lstrip('/') or 'its name without it'}."
            )
