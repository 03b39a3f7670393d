"""Report on a session, or on the messages of a recording."""

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import seconds
from tftool.commands.monitor import MonitorOptions
from tftool.commands.monitor.recording_monitor import report_recording
from tftool.commands.monitor.traffic_monitor import ReportStyle, TrafficReport, watch_session
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.open_from import open_from
from tftool.commands.shared.redraw import can_redraw
from tftool.opener import named


def run(connection: Connection, options: MonitorOptions) -> ExitStatus:
    """Run `tftool monitor`."""
    if options.as_tf2 and options.for_programs:
        raise UsageError("--tf2 and --json are two output formats: choose one.")
    frames, place = _sorted_out(options.words or [])
    try:
        is_recording = place is not None and named(place).kind.is_recording
    except InputError as error:
        if frames is None:
            sentence = f"{error} For the chain between two frames, name both."
            raise InputError(sentence) from error
        raise
    if options.for_programs:
        style = ReportStyle.JSON
    elif options.as_tf2:
        style = ReportStyle.TF2
    else:
        style = ReportStyle.TABLE if can_redraw() else ReportStyle.LINES
    report = TrafficReport(frames, style)
    if is_recording:
        recording = open_from(connection, place)
        report_recording(
            recording,
            report,
            period=options.every,
            lasting=options.run_for,
            cache_time=options.cache_time,
        )
        return ExitStatus.DONE
    session = open_session(connection, place, cache_time=options.cache_time)
    period = options.every or seconds(1 if style is ReportStyle.TABLE else 10)
    session.run(watch_session(session.world, report, period=period, lasting=options.run_for))
    return ExitStatus.DONE


def _sorted_out(words: list[str]) -> tuple[tuple[str, str] | None, str | None]:
    """Interpret the words: two are frames, one is a world, three are all."""
    if len(words) > 3:
        raise UsageError(
            f"{len(words)} words are too many: no frames or two of them, then a scenario."
        )
    if len(words) < 2:
        place = words[0] if words else None
        return None, place
    target, source, *rest = words
    return (target, source), rest[0] if rest else None
