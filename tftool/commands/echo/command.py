"""`tftool echo`: one transform, again and again, as tf2_echo prints it."""

import contextlib
from pathlib import Path

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.echo_loop import Echo, LivePrinter, Printer
from tftool.commands.shared.hosting import (
    A_MOMENT,
    NO_SESSION,
    open_session,
    refuse_to_forget,
    refuse_to_share,
)
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.options import within
from tftool.commands.shared.pairs import refuse_file_as_frame
from tftool.commands.shared.recorded import moments
from tftool.commands.shared.redraw import Redrawing, can_redraw
from tftool.commands.shared.waiter import FramePair
from tftool.drawing.echo_view import in_words
from tftool.frames.moment import At, checked_moment
from tftool.opener import named
from tftool.recordings.find import Found, Kind
from tftool.world.link.session_world import Session


def _print_recorded(
    connection: Connection,
    found: Found,
    frames: tuple[str, str],
    printer: Printer,
    rate: float | None,
    stamps_of: str | None,
    most: int | None,
) -> None:
    """Print the whole span of a recording, moment by moment."""
    stored = connection.open_stored(found)
    name_frames(stored.buffer.frames(), frames)
    for answer in moments(stored, *frames, rate=rate, topic=stamps_of, most=most):
        printer.found(answer.stamp, answer)


def _print_live(
    session: Session,
    pair: FramePair,
    printer: Printer,
    heading: str,
    *,
    period: Duration,
    count: int | None,
    patience: Duration | None,
    tells: bool,
) -> None:
    """Ask a session again and again, and print each answer, or draw it in place of the last."""
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


def run(
    connection: Connection,
    target: str,
    source: str,
    place: str | None,
    rate: float | None,
    once: bool,
    count: int | None,
    at: At | None,
    stamps_of: str | None,
    offset: int | None,
    fixed_frame: str | None,
    distance: bool,
    precision: int,
    timeout: int | None,
    for_programs: bool,
    cache_time: int | None,
) -> ExitStatus:
    """Run `tftool echo`; the parameters are its options."""
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
