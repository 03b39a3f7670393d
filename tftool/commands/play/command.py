"""Implementation of `tftool play`: play a recording as a live session."""

from collections.abc import Coroutine, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, Stamp, as_seconds
from tftool.commands.play import PlayOptions
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.hosting import join_or_host
from tftool.commands.shared.notices import is_news, notice, tell_record
from tftool.commands.shared.on_screen import screen_lacks, screen_setting
from tftool.doctor.evidence import Evidence, evidence_of_recording
from tftool.doctor.judge import judge
from tftool.drawing.playback_line import PlaybackMark, PlayedTopic
from tftool.frames.source_options import At
from tftool.opener import named
from tftool.recordings.contract import Stamps
from tftool.recordings.recording import Recording
from tftool.recordings.timeline import Timeline
from tftool.world.clock import Clock, FollowedClock
from tftool.world.clock import run as run_loop
from tftool.world.endpoints import PUBLISHER
from tftool.world.link.feed import TopicFeed
from tftool.world.link.session import Link
from tftool.world.link.session_world import shared
from tftool.world.nodes.player import Player
from tftool.world.supervisor import beside, live
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.world.log import LogRecord


MOST_JUDGED = 1_000_000
"""Most transforms of a recording that the doctor examines before playback, for about a second."""

MOST_MARKS = 200
"""Most findings marked on the line; the worst findings are chosen."""


def _refuse_to_mix(link: Link) -> None:
    """Raise UsageError if /tf has publishers: their transforms would mix with the recording's."""
    nodes = sorted({one.node for one in link.graph.entities(PUBLISHER, name="tf")})
    if nodes:
        some = ", ".join(f"'{visible(node)}'" for node in nodes[:3])
        raise UsageError(
            f"/tf has publishers here ({some}): their transforms would mix with the playback's, "
            "and a robot would act on both. Choose another --domain, or add --force."
        )


def _span(
    recording: Recording, timeline: Timeline, begin: At | None, until: At | None
) -> tuple[Stamp, Stamp]:
    """Return the first and the last time to play.

    Raises:
        UsageError: If a time is outside of the recording, or --from is after --to.
    """
    # The last message is received after its stamp, so it is later than the last stamp.
    low, high = min(timeline.start, recording.start), max(timeline.end, recording.end)
    first = timeline.start if begin is None else begin.stamp(recording.start)
    last = timeline.end if until is None else until.stamp(recording.start)
    for asked, stamp in ((begin, first), (until, last)):
        if asked is not None and not low <= stamp <= high:
            lasts = f"{as_seconds(high - recording.start):g} s"
            meant = asked.meant(recording.start, high)
            raise UsageError(
                f"The time {asked} is outside of the recording, which lasts {lasts}.{meant}"
            )
    if first > last:
        raise UsageError(f"--from {begin} is after --to {until}.")
    return first, last


async def _play(
    options: PlayOptions,
    recording: Recording,
    timeline: Timeline,
    span: tuple[Stamp, Stamp],
    marks_and_topics: tuple[Sequence[PlaybackMark], Sequence[PlayedTopic]] | None,
    pace: Clock,
    link: Link | None,
) -> None:
    """Play a recording and share it as a session.

    Args:
        options: Options of the command.
        recording: The recording.
        timeline: Transforms of the recording, with their times.
        span: First and last time to play.
        marks_and_topics: Findings and topics to show on a full screen; None for no screen.
        pace: Clock of real time.
        link: Connection to the session; None to share nothing.
    """
    is_restamped = options.restamp is not None
    world = World(pace if is_restamped else FollowedClock(max(span[0], 1)))
    with shared(link, world):
        player = Player(
            world,
            "player",
            timeline=timeline,
            pace=pace,
            span=span,
            rate=options.rate,
            is_paused=options.paused,
            is_looping=options.loop,
            waits_at_end=marks_and_topics is not None,
            is_restamped=is_restamped,
            feed=_feed(recording, timeline, link) if options.everything else None,
        )
        life = beside(live(world), _end_after(world, pace, options.run_for))
        if marks_and_topics is not None:
            await _on_screen(options, player, timeline.moments - span[0], marks_and_topics, life)
            return
        stop_telling = world.log.listen(_tell, "console")
        try:
            await life
        finally:
            stop_telling()


def _tell(record: "LogRecord") -> None:
    """Print a warning about the session or a message of the player; ignore other log messages."""
    if is_news(record):
        notice(visible(record.text))
    elif record.node == "player":
        tell_record(record)


async def _on_screen(
    options: PlayOptions,
    player: Player,
    moments: Stamps,
    marks_and_topics: tuple[Sequence[PlaybackMark], Sequence[PlayedTopic]],
    life: Coroutine[Any, Any, None],
) -> None:
    """Play on a full screen until q is pressed or the coroutine `life` ends."""
    from tftool.screens.terminal.player_app import PlayerScreen

    setting = screen_setting(options, f"tftool play {visible(Path(options.file).name)}")
    app = PlayerScreen(player, moments, *marks_and_topics, setting)

    def tell(record: "LogRecord") -> None:
        if is_news(record):
            app.tell(record.text)

    player.world.log.listen(tell, "screen")
    await app.run_with_world(life)


async def _end_after(world: World, pace: Clock, duration: Duration | None) -> None:
    """Stop the world after a duration; return at once if `duration` is None."""
    if duration is not None:
        await pace.sleep(duration)
        world.stop()


def _feed(recording: Recording, timeline: Timeline, link: Link | None) -> TopicFeed | None:
    if link is None:
        notice("--all has no effect here: no other process can join this world.")
        return None
    feed = TopicFeed(link, recording.source, timeline.clock, "player")
    for sentence in feed.left_out:
        notice(visible(sentence))
    return feed


def _findings_and_topics(
    recording: Recording, timeline: Timeline, start: Stamp
) -> tuple[list[PlaybackMark], list[PlayedTopic]]:
    """Return timeline marks for the doctor's findings, and the topics to show.

    The worst findings come first. A very long recording is not judged and gets no marks.
    """
    if len(recording.transforms) > MOST_JUDGED:
        return [], _topics(recording, timeline, None, start)
    evidence = evidence_of_recording(recording)
    marks = [
        PlaybackMark(
            (one.since or start) - start,
            (one.until or one.since or start) - start,
            one.message,
            one.severity,
            is_timed=one.since is not None,
        )
        for one in sorted(judge(evidence).findings, key=lambda one: one.severity.rank)
        # A finding that a report omits is still worth a look at its place.
        if one.is_shown or one.since is not None
    ]
    return marks[:MOST_MARKS], _topics(recording, timeline, evidence, start)


def _topics(
    recording: Recording, timeline: Timeline, evidence: Evidence | None, start: Stamp
) -> list[PlayedTopic]:
    """Return the topics to show: topics with transforms, then others; each group by message count.

    The message times are known only for topics with transforms or with headers.
    """
    transforms = recording.transforms
    by_sender = np.array([one.topic for one in transforms.publishers] or [""], dtype=np.object_)
    topic_of = by_sender[transforms.senders]
    found = []
    for topic in sorted(recording.topics, key=lambda one: (not one.transforms, -one.count)):
        logs = None
        if topic.transforms:
            logs = transforms.log_times[topic_of == topic.name]
        elif evidence is not None and topic.name in evidence.headers:
            logs = evidence.headers[topic.name].log_times
        moments = None if logs is None else np.sort(timeline.clock.of(logs)) - start
        found.append(PlayedTopic(topic.name, topic.count, moments))
    return found


def run(connection: Connection, options: PlayOptions) -> ExitStatus:
    """Run `tftool play`: play a recording until its end or a key."""
    connection.refuse_read_only("play")
    found = named(options.file)
    if not found.kind.is_recording:
        word = visible(options.file)
        raise UsageError(f"'{word}' is a {found.kind.value}: name a recording instead.")
    # `shares`: the options of sharing apply to the session that plays the recording.
    recording = open_from(connection, options.file, shares=True).recording
    assert isinstance(recording, Recording)
    timeline = Timeline(recording.source, recording.transforms)
    span = _span(recording, timeline, options.begin, options.until)
    shown = None if screen_lacks() else _findings_and_topics(recording, timeline, span[0])
    # Last, because other processes wait until it is decided who hosts.
    link = join_or_host(connection, options.file).link
    if link is not None and connection.reach.is_robots and not options.force:
        _refuse_to_mix(link)
    pace = connection.providers.wall_clock()
    run_loop(pace, _play(options, recording, timeline, span, shown, pace, link))
    return ExitStatus.DONE
