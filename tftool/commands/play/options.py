"""`tftool play`: a recording as a session that lives."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, Stamp, as_seconds
from tftool.commands.shared.options import (
    RunFor,
    moment_option,
    option,
    within,
)
from tftool.frames.moment import At

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Connection
    from tftool.commands.shared.playback import Display
    from tftool.recordings.recording import Recording
    from tftool.recordings.timeline import Timeline
    from tftool.world.clock import Clock
    from tftool.world.link.feed import TopicFeed
    from tftool.world.link.session import Link
    from tftool.world.nodes.player import Player
    from tftool.world.world import World


def play(
    connection: "Connection",
    file: Annotated[
        str, typer.Argument(metavar="RECORDING", help="What to play: a file, a folder, a glob.")
    ],
    rate: Annotated[
        float,
        typer.Option(
            "--rate",
            "-r",
            metavar="TIMES",
            callback=within(0.01, 100),
            help="How many times real time.",
        ),
    ] = 1.0,
    begin: Annotated[
        At | None, moment_option("Where to begin: seconds since the start, or a stamp.", "--from")
    ] = None,
    until: Annotated[At | None, moment_option("Where to end, likewise.", "--to")] = None,
    loop: Annotated[bool, option("Start over at the end.", "--loop")] = False,
    paused: Annotated[bool, option("Begin standing still.", "--paused")] = False,
    restamp: Annotated[
        Literal["now"] | None,
        option(
            "Give transforms stamps of the present, and publish no /clock.",
            "--restamp",
            metavar="now",
        ),
    ] = None,
    everything: Annotated[
        bool,
        option("Send every other topic too whose type is known, with its own stamps.", "--all"),
    ] = False,
    force: Annotated[
        bool, option("Over --dds: play beside publishers of /tf that are there.", "--force")
    ] = False,
    run_for: RunFor = None,
) -> ExitStatus:
    """Play a recording as a live session (ros2 bag play).

    Its transforms are broadcast as they were received, by the nodes that did if they are
    recorded, statics first, and /clock with them: other tftools take now from it, and nodes of
    ROS 2 do with use_sim_time. 'tftool view', 'tftool echo' and your own nodes see them live.

    On a terminal space pauses, the right arrow sends the next message, [ and ] seek by a second,
    { and } by ten, up and down change the rate, 0 goes to the start, q quits.

    tftool play run.mcap
    tftool play run.mcap --from 12.5 --to 20 --rate 0.5 --loop
    tftool play run.bag --restamp now --all
    """
    from tftool.base.escaping import visible
    from tftool.commands.shared.hosting import join_or_host
    from tftool.opener import named
    from tftool.recordings.recording import Recording
    from tftool.recordings.timeline import Timeline
    from tftool.world.clock import run

    connection.refuse_read_only("play")
    found = named(file)
    if not found.kind.is_recording:
        word = visible(file)
        raise UsageError(f"'{word}' is a {found.kind.value}: a recording is needed here.")
    recording = connection.open_stored(found)
    assert isinstance(recording, Recording)
    timeline = Timeline(recording.source, recording.transforms)
    playing = _Playing(
        recording,
        timeline,
        _span(recording, timeline, begin, until),
        rate,
        is_paused=paused,
        is_looping=loop,
        is_restamped=restamp is not None,
        sends_all=everything,
        duration=run_for,
    )
    # Last of all: while it has not been decided who hosts, other processes wait.
    link = join_or_host(connection, file).link
    if link is not None and connection.dds is not None and not force:
        _refuse_to_mix(link)
    pace = connection.providers.wall_clock()
    run(pace, playing.play(pace, link))
    return ExitStatus.DONE


def _refuse_to_mix(link: "Link") -> None:
    """Keep a recording's transforms out of the graph of a robot that sends its own.

    Raises:
        UsageError: If transforms are published there.
    """
    from tftool.base.escaping import visible
    from tftool.world.endpoints import PUBLISHER

    nodes = sorted({one.node for one in link.graph.entities(PUBLISHER, name="tf")})
    if nodes:
        some = ", ".join(f"'{visible(node)}'" for node in nodes[:3])
        raise UsageError(
            f"/tf has publishers here, {some}: what is played would mix with it, and a robot "
            "would act on both. Choose another --domain, or --force it."
        )


def _span(
    recording: "Recording", timeline: "Timeline", begin: At | None, until: At | None
) -> tuple[Stamp, Stamp]:
    """From where to where to play.

    Raises:
        UsageError: If there is nothing between.
    """
    # Received later than it was stamped, the last message lies behind the last stamp.
    low, high = min(timeline.start, recording.start), max(timeline.end, recording.end)
    first = timeline.start if begin is None else begin.stamp(recording.start)
    last = timeline.end if until is None else until.stamp(recording.start)
    for asked, stamp in ((begin, first), (until, last)):
        if asked is not None and not low <= stamp <= high:
            lasts = f"{as_seconds(high - recording.start):g} s"
            raise UsageError(f"The recording lasts {lasts}: {asked} lies outside it.")
    if first > last:
        raise UsageError(f"--from {begin} lies after --to {until}.")
    return first, last


@dataclass(frozen=True, slots=True)
class _Playing:
    """What is to be played, and how; the fields are those of `Player`."""

    recording: "Recording"
    timeline: "Timeline"
    span: tuple[Stamp, Stamp]
    rate: float
    is_paused: bool
    is_looping: bool
    is_restamped: bool
    sends_all: bool
    duration: Duration | None

    async def play(self, pace: "Clock", link: "Link | None") -> None:
        """Play, and share it."""
        from tftool.commands.shared.keypresses import keyboard
        from tftool.commands.shared.playback import Display, press
        from tftool.world.clock import FollowedClock
        from tftool.world.link.session_world import shared
        from tftool.world.supervisor import beside, live
        from tftool.world.world import World

        world = World(pace if self.is_restamped else FollowedClock(max(self.span[0], 1)))
        with shared(link, world):
            player = self._player(world, pace, link)
            display = Display(player, pace)
            stop_telling = world.log.listen(display.tell, "console")
            try:
                with keyboard(lambda key: press(player, key)) as display.has_keys:
                    helper = self._until_over(world, pace, display)
                    await beside(live(world), helper)
            finally:
                display.clear()
                stop_telling()

    def _player(self, world: "World", pace: "Clock", link: "Link | None") -> "Player":
        from tftool.world.nodes.player import Player

        return Player(
            world,
            "player",
            timeline=self.timeline,
            pace=pace,
            span=self.span,
            rate=self.rate,
            is_paused=self.is_paused,
            is_looping=self.is_looping,
            is_restamped=self.is_restamped,
            feed=self._feed(link) if self.sends_all else None,
        )

    def _feed(self, link: "Link | None") -> "TopicFeed | None":
        from tftool.base.escaping import visible
        from tftool.commands.shared.notices import notice
        from tftool.world.link.feed import TopicFeed

        if link is None:
            notice("--all sends nothing else: no other process can join this world.")
            return None
        feed = TopicFeed(link, self.recording.source, self.timeline.clock, "player")
        for sentence in feed.left_out:
            notice(visible(sentence))
        return feed

    async def _until_over(self, world: "World", pace: "Clock", display: "Display") -> None:
        """Show where it stands; end the world when the time is up."""
        import asyncio

        showing = asyncio.ensure_future(display.keep())
        try:
            if self.duration is None:
                await showing
            else:
                await pace.sleep(self.duration)
                world.stop()
        finally:
            showing.cancel()
