"""Report on a session, or on the messages of a recording."""

from itertools import pairwise

import numpy as np
from rich.console import Console

from tftool.base.errors import InputError, TransformException, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import CACHE_TIME, NANOSECONDS, Duration, Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.requests import NOW
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import Series, Traffic
from tftool.commands.monitor import MonitorOptions
from tftool.commands.monitor.traffic_monitor import (
    ASK_EVERY,
    ReportStyle,
    TrafficReport,
    watch_session,
)
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import name_frames
from tftool.commands.shared.pairs import FramePair
from tftool.commands.shared.terminal import can_redraw
from tftool.frames.frames import Frames
from tftool.opener import named
from tftool.recordings.contract import Stamps
from tftool.recordings.timeline import Due, Timeline

LEAST_AT_ONCE = 64
"""Messages that are received at once; of fewer, one by one is as quick."""


def report_recording(
    frames: Frames,
    report: TrafficReport,
    *,
    period: Duration | None,
    lasting: Duration | None,
    cache_time: Duration | None,
) -> None:
    """Report on a recording.

    Args:
        frames: The recording.
        report: The report to fill and to write.
        period: Nanoseconds between two reports; one report about all of it if None.
        lasting: Duration of the reported part, from the moment the frames are connected.
        cache_time: Cache time of the lookups, as in a session.

    Raises:
        TransformException: If the frames are not connected in as much time.
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
            # Of two that are due at one moment, the one with the longer period goes first.
            last = now - 1 if period > ASK_EVERY else now
            moments = np.arange(measured + ASK_EVERY, last + 1, ASK_EVERY)
            measured += len(moments) * ASK_EVERY
            arrivals.measure(report, moments)
        arrivals.receive_until(now, report.traffic)
        reported = now
        if report.style is not ReportStyle.TABLE:
            report.write(now)
        elif now == end:
            # The ones before it would be drawn over at once.
            console.print(report.table(console, now, began))


class Arrivals:
    """Messages of a recording in the order in which a session would receive them."""

    def __init__(self, timeline: Timeline, buffer: Buffer) -> None:
        """Start before the first message; static transforms are known from the start.

        Args:
            timeline: The messages.
            buffer: Takes their transforms.
        """
        self.buffer = buffer
        self._timeline = timeline
        self._place = 0
        self._statics: dict[str, dict[str, TransformStamped]] = {}
        self._known = timeline.known_at(timeline.start - 1)
        self._plain = timeline.is_plain()

    def receive_until(self, moment: Stamp, traffic: Traffic | None) -> None:
        """Receive the messages up to a time, and count them in `traffic`."""
        start = self._timeline.start
        while self._known:
            self._receive(self._known.pop(0), start, traffic)
        last = self._timeline.place(moment, after=True)
        while self._place < last:
            # Up to the next message in which the order among frames counts.
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
        """Receive messages until a pair can be looked up; return that time.

        Raises:
            TransformException: If the frames are not connected at the end.
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
        """Record the age of the newest answer of a report's chain at each of these moments.

        Lookups need the messages received up to each moment, and receiving a few hundred at a
        time takes twice as long as receiving all. The arrival times alone give the same ages
        wherever every link has one publisher whose stamps increase.

        Args:
            report: The report to fill.
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
            # The buffer prunes by the stamp that was the newest one before an insertion.
            kept = stamps[np.maximum(last - 1, 0)] - self.buffer.cache_time
            oldest.append(stamps[np.searchsorted(stamps, kept)])
        if not newest:
            return
        common = np.min(newest, axis=0)
        answered = (common >= np.max(oldest, axis=0)) & (common != 0)
        for delay in ((moments - common)[answered] / NANOSECONDS).tolist():
            report.chain.delay.add(delay)

    def _receive_many(self, first: int, last: int, traffic: Traffic) -> None:
        """Receive plain messages in bulk: first by frame, then by publisher."""
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
        # By the first message of each, in which order a listener comes to know them.
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
        # The topic names the sender where no node is recorded.
        sender = due.node or due.topic
        put = self.buffer.set_transform_static if due.static else self.buffer.set_transform
        taken = [sample for sample in due.transforms if put(sample, sender)]
        if due.static:
            # A message of a sender holds all of its statics, as tf2's broadcasters write it.
            held = self._statics.setdefault(sender, {})
            held.update((sample.child_frame_id, sample) for sample in taken)
            taken = [*held.values()] if taken else []
        if taken and traffic is not None:
            traffic.receive(max(now, 1), taken, sender, is_static=due.static)


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
