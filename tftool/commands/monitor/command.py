"""Implementation of `tftool monitor`: reports about a session or a recording."""

import json
import os
import sys
from collections.abc import Callable, Coroutine
from contextlib import ExitStack
from enum import Enum, auto
from itertools import pairwise
from typing import Any

import numpy as np
from rich import box
from rich.console import Console, Group, RenderableType
from rich.panel import Panel
from rich.text import Text

from tftool.base.errors import InputError, TransformException, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import CACHE_TIME, NANOSECONDS, Duration, Stamp, as_seconds, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.callbacks import NOW
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import NetDelay, Series, Traffic
from tftool.commands.monitor import MonitorOptions
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.on_screen import ScreenOptions, screen_lacks, screen_setting
from tftool.commands.shared.pair_wait import PairWait
from tftool.commands.shared.pairs import FramePair
from tftool.commands.shared.terminal import Redrawing, can_redraw
from tftool.drawing import theme
from tftool.drawing import traffic_view as view
from tftool.drawing.echo_view import in_words
from tftool.frames.frames import Frames
from tftool.opener import named
from tftool.recordings.contract import Stamps
from tftool.recordings.timeline import Due, Timeline
from tftool.screens.terminal.panel_text import bar, title_bar
from tftool.screens.terminal.text_style import Look
from tftool.world.clock import Phase, pace_of
from tftool.world.supervisor import beside
from tftool.world.topics import Topic
from tftool.world.world import TransformMessage, World

ASK_EVERY = seconds(0.5)
"""Nanoseconds between two measurements of a chain's delay, as in tf2_monitor."""


class ReportStyle(Enum):
    """Output format of a report."""

    TABLE = auto()
    LINES = auto()
    TF2 = auto()
    JSON = auto()


class TrafficReport:
    """Report on the rates and delays of received transforms, as a table, as text or as JSON."""

    def __init__(
        self, frames: tuple[str, str] | None, style: ReportStyle, options: ScreenOptions
    ) -> None:
        """Create an empty report.

        Args:
            frames: Target and source of the pair to report on; None for all frames.
            style: Output format.
            options: Options of the screen.
        """
        self.options = options
        self.frames = frames
        self.style = style
        self.traffic = Traffic()
        self.chain: view.Chain | None = None

    def begin(self, buffer: Buffer, now: Stamp) -> None:
        """Look up the chain between the pair of frames, and count static transforms as received."""
        if self.frames is not None:
            chain = tuple(buffer.chain(*self.frames)) or self.frames[:1]
            self.chain = view.Chain(*self.frames, chain, NetDelay())
        for info in buffer.snapshot(now).frames:
            if info.is_static and info.parent is not None and info.transform is not None:
                sample = TransformStamped(now, info.parent, info.frame, info.transform)
                self.traffic.receive(now, [sample], info.authority or "", is_static=True)

    def measure(self, buffer: Buffer, now: Stamp) -> None:
        """Record the age of the newest transform between the two frames, unless it is static."""
        if self.chain is None:
            return
        try:
            found = buffer.lookup_transform(self.chain.target, self.chain.source)
        except TransformException:
            # tf2_monitor would end here; a missing link may return, or is visible in the rates.
            return
        if found.stamp:
            self.chain.delay.add(as_seconds(now - found.stamp))

    def announce(self, period: Duration, duration: Duration | None) -> None:
        """Print to stderr which frames the report covers, and how often a report is printed."""
        about = "all frames" if self.frames is None else in_words(*self.frames)
        if period == duration:
            notice(f"Gathering data on {about} for {round(as_seconds(duration), 3):g} s ...")
        else:
            notice(f"Gathering data on {about}, a report every {as_seconds(period):g} s ...")

    def table(
        self, console: Console, now: Stamp, began: Stamp, *, is_live: bool = False
    ) -> RenderableType:
        """Return the report as a framed table that fits the terminal."""
        ascii_only = self.options.ascii_only or console.options.ascii_only
        # A small terminal has no room for a border; the last line is left for the cursor.
        is_framed = console.width >= 60 and console.height >= 12
        shown = view.table(
            now,
            began,
            self.traffic,
            self.chain,
            width=console.width - 4 * is_framed,
            height=console.height - 1 - 3 * is_framed,
            ascii_only=ascii_only,
        )
        if not is_framed:
            return shown
        is_light = self.options.light or theme.prefers_light(os.environ)
        palette = theme.LIGHT if is_light else theme.DARK
        look = Look(palette, ascii_only)
        frame = Panel(
            shown,
            title=Text(" Frames ", theme.ink(palette.text)),
            title_align="left",
            border_style=theme.ink(palette.dim),
            box=box.ASCII if ascii_only else box.ROUNDED,
        )
        title, elapsed = "tftool monitor", as_seconds(now - began)
        head = bar(title, f"{elapsed:.1f} s", ("report", palette.dim), console.width, look)
        if is_live:
            head = title_bar(title, elapsed, console.width, look)
        return Group(head, frame)

    def write(self, now: Stamp) -> None:
        """Write the report to stdout, as lines or JSON."""
        if self.style is ReportStyle.JSON:
            text = json.dumps(view.as_object(now, self.traffic, self.chain), allow_nan=False) + "\n"
        else:
            text = view.lines(self.traffic, self.chain, as_tf2=self.style is ReportStyle.TF2)
        sys.stdout.write(text)
        sys.stdout.flush()


async def watch_session(
    world: World, report: TrafficReport, *, period: Duration, lasting: Duration | None
) -> None:
    """Receive transforms from a world, and write a report once a period and at the end.

    The duration is counted from the time at which the frames are connected.

    Args:
        world: World that receives the transforms.
        report: Report to fill and to write.
        period: Nanoseconds between two reports.
        lasting: Nanoseconds to listen; None for no end.

    Raises:
        TransformException: If the frames are not connected within `lasting`, or waiting cannot
            help.
    """
    clock, pace = world.clock, pace_of(world.clock)
    if report.frames is not None:
        advice = "--for SECONDS ends the wait."
        wait = PairWait(world, FramePair(*report.frames), patience=lasting, advice=advice)
        await wait.wait()
    began = clock.now()
    end = None if lasting is None else pace.now() + lasting
    # Without a limit, a node that blocks the event loop would prevent the end.
    pace.limit(end)

    def subscribe(topic: Topic[TransformMessage], is_static: bool) -> Callable[[], None]:
        def receive(message: TransformMessage) -> None:
            report.traffic.receive(
                clock.now(), message.transforms, message.authority, is_static=is_static
            )

        return topic.subscribe(receive, "monitor")

    async def measure() -> None:
        due = pace.now()
        while report.chain is not None:
            due = max(due + ASK_EVERY, pace.now())
            await pace.sleep_until(due, Phase.WATCH)
            report.measure(world.buffer, clock.now())

    async def repeat(write: Callable[[], None]) -> None:
        due = pace.now()
        while end is None or due < end:
            due = due + period if end is None else min(due + period, end)
            await pace.sleep_until(due, Phase.WATCH)
            write()

    with ExitStack() as stack:
        for topic, is_static in ((world.tf, False), (world.tf_static, True)):
            stack.callback(subscribe(topic, is_static))
        report.begin(world.buffer, began)
        if report.style is ReportStyle.TABLE and not screen_lacks():
            stack.callback(lambda: Console().print(report.table(Console(), clock.now(), began)))
            await _shown(world, report, beside(repeat(lambda: None), measure()))
            return
        report.announce(period, lasting)
        if report.style is ReportStyle.TABLE:
            redrawing = stack.enter_context(Redrawing(clock))
            console = redrawing.console
            writing = repeat(
                lambda: redrawing.show(report.table(console, clock.now(), began, is_live=True))
            )
        else:
            writing = repeat(lambda: report.write(clock.now()))
        await beside(writing, measure())


async def _shown(world: World, report: TrafficReport, life: Coroutine[Any, Any, None]) -> None:
    """Show the report on a full screen until q is pressed or the coroutine `life` ends."""
    from tftool.screens.terminal.traffic_app import TrafficWatch

    setting = screen_setting(report.options, "tftool monitor")
    app = TrafficWatch(world, report.traffic, report.chain, setting)
    await app.run_with_world(life)


LEAST_AT_ONCE = 64
"""Least number of messages to receive in bulk; fewer are as fast one by one."""


def report_recording(
    frames: Frames,
    report: TrafficReport,
    *,
    period: Duration | None,
    lasting: Duration | None,
    cache_time: Duration | None,
) -> None:
    """Write reports about a recording.

    Args:
        frames: Frames of the recording.
        report: Report to fill and to write.
        period: Nanoseconds between two reports; None for one report about everything.
        lasting: Nanoseconds to report on, counted from when the frames are connected.
        cache_time: Cache time of the buffer for lookups, nanoseconds; None for the default.

    Raises:
        TransformException: If the frames are not connected within `lasting`.
    """
    recording = frames.recording
    assert recording is not None
    timeline = Timeline(recording.source, recording.transforms)
    duration = timeline.end - timeline.start
    lasting = min(lasting or duration, duration) or 1
    period = period or lasting
    arrivals = Arrivals(timeline, Buffer(cache_time=cache_time or CACHE_TIME))
    began = max(timeline.start, 1)
    if report.frames is not None:
        began = arrivals.connect(report.frames, began + lasting)
    report.begin(arrivals.buffer, began)
    report.announce(period, lasting)
    console = Console()
    reported, measured, end = began, began, began + lasting
    while reported < end:
        now = min(reported + period, end)
        if report.chain is not None:
            # If a report and a measurement are due at the same time, the longer period is first.
            last = now - 1 if period > ASK_EVERY else now
            moments = np.arange(measured + ASK_EVERY, last + 1, ASK_EVERY)
            measured += len(moments) * ASK_EVERY
            arrivals.measure(report, moments)
        arrivals.receive_until(now, report.traffic)
        reported = now
        if report.style is not ReportStyle.TABLE:
            report.write(now)
        elif now == end:
            # Earlier tables would be replaced at once, so only the last one is printed.
            console.print(report.table(console, now, began))


class Arrivals:
    """Messages of a recording in the order in which a session would receive them."""

    def __init__(self, timeline: Timeline, buffer: Buffer) -> None:
        """Begin before the first message; static transforms count as received at the beginning.

        Args:
            timeline: Messages of the recording.
            buffer: Buffer into which the messages' transforms are inserted.
        """
        self.buffer = buffer
        self._timeline = timeline
        self._place = 0
        self._statics: dict[str, dict[str, TransformStamped]] = {}
        self._known = timeline.known_at(timeline.start - 1)
        self._plain = timeline.is_plain()

    def receive_until(self, moment: Stamp, traffic: Traffic | None) -> None:
        """Receive the messages up to the time `moment`, and count them in `traffic` unless None."""
        start = self._timeline.start
        while self._known:
            self._receive(self._known.pop(0), start, traffic)
        last = self._timeline.place(moment, after=True)
        while self._place < last:
            # Until the next message whose transforms must be received in order.
            ahead = self._plain[self._place : last]
            plain = len(ahead) if ahead.all() else int(ahead.argmin())
            if traffic is not None and plain >= LEAST_AT_ONCE:
                self._receive_many(self._place, self._place + plain, traffic)
                self._place += plain
                continue
            for due in self._timeline.message(self._place):
                self._receive(due, due.moment, traffic)
            self._place += 1

    def connect(self, pair: tuple[str, str], end: Stamp) -> Stamp:
        """Receive messages until the pair of frames can be looked up.

        Args:
            pair: Target and source frame.
            end: Time of the last message to receive.

        Returns:
            Time of the last received message.

        Raises:
            TransformException: If the frames are not connected at `end`.
        """
        answers: list[bool] = []
        waits = self.buffer.request(lambda _, there: answers.append(there), *pair) != NOW
        moment = max(self._timeline.start, 1)
        self.receive_until(moment, None)
        while waits and not answers and self._place < len(self._timeline):
            moment = max(int(self._timeline.moments[self._place]), 1)
            if moment > end:
                break
            self.receive_until(moment, None)
        try:
            FramePair(*pair).ask(self.buffer, moment)
        except TransformException:
            name_frames(self.buffer.frames(), pair, "so far")
            raise
        return moment

    def measure(self, report: TrafficReport, moments: Stamps) -> None:
        """Record the age of the newest transform of the report's pair at each time in `moments`.

        If every frame has one publisher whose stamps increase, the ages are computed from the
        arrival times of all messages. Otherwise, messages are received up to each time, which takes
        twice as long.

        Args:
            report: Report to fill.
            moments: Nanoseconds, shape (n,), increasing.
        """
        assert report.chain is not None
        frames = report.chain.frames
        links = [self._timeline.arrivals_of({*pair}) for pair in pairwise(frames)]
        if None in links:
            for moment in moments.tolist():
                self.receive_until(moment, report.traffic)
                report.measure(self.buffer, moment)
            return
        newest, oldest = [], []
        for link in links:
            if link is None or not len(link[0]):
                continue
            arrivals, stamps = link
            last = np.searchsorted(arrivals, moments, side="right") - 1
            newest.append(stamps[last])
            # The buffer prunes relative to the newest stamp before the insertion.
            kept = stamps[np.maximum(last - 1, 0)] - self.buffer.cache_time
            oldest.append(stamps[np.searchsorted(stamps, kept)])
        if not newest:
            return
        common = np.min(newest, axis=0)
        answered = (common >= np.max(oldest, axis=0)) & (common != 0)
        for delay in ((moments - common)[answered] / NANOSECONDS).tolist():
            report.chain.delay.add(delay)

    def _receive_many(self, first: int, last: int, traffic: Traffic) -> None:
        """Receive the messages with indices `first` to `last` - 1 at once, grouped by frame."""
        timeline = self._timeline
        rows = timeline.rows(first, last)
        if not len(rows.edges):
            return
        moments = np.maximum(timeline.moments[rows.places], 1)
        senders, names = timeline.senders(rows.places)
        delays = np.empty(len(moments))
        taken = np.zeros(len(moments), dtype=np.bool_)
        by_edge = np.argsort(rows.edges, kind="stable")
        bounds = np.flatnonzero(np.diff(rows.edges[by_edge])) + 1
        # In order of each frame's first message, as a listener discovers the frames.
        for mine in sorted(np.split(by_edge, bounds), key=lambda group: int(group[0])):
            edge, own = timeline.edge(int(rows.edges[mine[0]])), rows.rows[mine]
            sender = names[int(senders[mine[0]])]
            stamps = edge.stamps[own]
            pose = edge.translations[own], edge.rotations[own]
            accepted = self.buffer.set_transforms(
                edge.parent, edge.child, stamps, *pose, sender
            ).accepted
            delays[mine] = (moments[mine] - stamps) / NANOSECONDS
            taken[mine] = accepted
            mine = mine[accepted]
            if len(mine):
                link = traffic.link(edge.child)
                link.parent, link.sender, link.is_static = edge.parent, sender, False
                link.series.add_many(moments[mine], delays[mine])
        for number in dict.fromkeys(senders[taken].tolist()):
            mine = np.flatnonzero(taken & (senders == number))
            starts = np.flatnonzero(np.diff(rows.places[mine], prepend=-1))
            counts = np.diff(starts, append=len(mine))
            means = np.add.reduceat(delays[mine], starts) / counts
            series = traffic.senders.setdefault(names[number], Series())
            series.add_many(moments[mine[starts]], means)

    def _receive(self, due: Due, now: Stamp, traffic: Traffic | None) -> None:
        # If no node is recorded, the topic's name is used for the sender.
        sender = due.node or due.topic
        put = self.buffer.set_transform_static if due.static else self.buffer.set_transform
        taken = [sample for sample in due.transforms if put(sample, sender)]
        if due.static:
            # Each message has all static transforms of its sender, as tf2's broadcasters send it.
            held = self._statics.setdefault(sender, {})
            held.update((sample.child_frame_id, sample) for sample in taken)
            taken = [*held.values()] if taken else []
        if taken and traffic is not None:
            traffic.receive(max(now, 1), taken, sender, is_static=due.static)


def run(connection: Connection, options: MonitorOptions) -> ExitStatus:
    """Run `tftool monitor`: report on a session or a recording."""
    if options.as_tf2 and options.for_programs:
        raise UsageError("--tf2 and --json are two output formats: choose one.")
    frames, place = _pair_and_source(options.words or [])
    try:
        is_recording = place is not None and named(place).kind.is_recording
    except InputError as error:
        if frames is None:
            sentence = f"{error} To report on two frames, name both frames."
            raise InputError(sentence) from error
        raise
    if options.for_programs:
        style = ReportStyle.JSON
    elif options.as_tf2:
        style = ReportStyle.TF2
    else:
        style = ReportStyle.TABLE if can_redraw() else ReportStyle.LINES
    report = TrafficReport(frames, style, options)
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


def _pair_and_source(words: list[str]) -> tuple[tuple[str, str] | None, str | None]:
    """Split the words of the command line into a pair of frames and FROM, each None if missing.

    One word is FROM; two words are the target and the source frame; a third word is FROM.
    """
    if len(words) > 3:
        raise UsageError(f"{len(words)} words are too many: write [TARGET SOURCE] [FROM].")
    if len(words) < 2:
        place = words[0] if words else None
        return None, place
    target, source, *rest = words
    return (target, source), rest[0] if rest else None
