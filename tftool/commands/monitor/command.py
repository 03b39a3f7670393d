"""Watch a session, or a recording that is played again at once."""

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import CACHE_TIME, Duration, Stamp, seconds
from tftool.commands.monitor.traffic_monitor import Monitor, ReportStyle
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import tell_news
from tftool.commands.shared.open_from import open_from
from tftool.commands.shared.redraw import can_redraw
from tftool.frames.frames import Frames
from tftool.opener import named
from tftool.recordings.timeline import Timeline
from tftool.world.clock import SimClock
from tftool.world.link.session_world import Session
from tftool.world.nodes.player import Player
from tftool.world.supervisor import live
from tftool.world.world import World


def run(
    connection: Connection,
    words: list[str] | None,
    *,
    run_for: Duration | None,
    every: Duration | None,
    as_tf2: bool,
    for_programs: bool,
    cache_time: Duration | None,
) -> ExitStatus:
    """Run `tftool monitor`; the parameters are its options."""
    if as_tf2 and for_programs:
        raise UsageError("--tf2 and --json are two ways of writing: choose one.")
    frames, place = _sorted_out(words or [])
    try:
        is_recording = place is not None and named(place).kind.is_recording
    except InputError as error:
        if frames is None:
            sentence = f"{error} For the chain between two frames, name both."
            raise InputError(sentence) from error
        raise
    if for_programs:
        style = ReportStyle.JSON
    elif as_tf2:
        style = ReportStyle.TF2
    else:
        style = ReportStyle.TABLE if can_redraw() else ReportStyle.LINES
    if is_recording:
        session = _played(open_from(connection, place), cache_time)
        # What was recorded is over at once: one report says all of it.
        duration = session.duration or 0
        run_for = min(run_for or duration, duration) or 1
        every = every or run_for
    else:
        session = open_session(connection, place, cache_time=cache_time)
    if every is None:
        every = seconds(1) if style is ReportStyle.TABLE else seconds(10)
    # What has not come yet of a recording comes at once: no wait is worth a line.
    watching = Monitor(session.world, frames, style, period=every, tells=not is_recording)
    session.run(watching.run(run_for))
    return ExitStatus.DONE


def _played(frames: Frames, cache_time: Duration | None) -> Session:
    """Return a world in which a recording's messages arrive, as fast as they can be simulated."""
    recording = frames.recording
    assert recording is not None
    timeline = Timeline(recording.source, recording.transforms)
    clock = SimClock(max(timeline.start, 1))
    world = World(clock, cache_time=cache_time or CACHE_TIME)
    Player(world, "player", timeline=timeline, pace=clock, is_silent=True, names_topics=True)

    async def alive(until: Stamp | None) -> None:
        await live(world, until=until)

    return Session(
        world, True, frames.title, alive, 0, timeline.end - timeline.start, None, tell_news
    )


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
