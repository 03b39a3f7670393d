"""The report of `monitor` on a recording, as if its messages arrived in a session."""

from rich.console import Console

from tftool.base.errors import TransformException
from tftool.base.stamps import CACHE_TIME, Duration, Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.requests import NOW
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import Traffic
from tftool.commands.monitor.traffic_monitor import ASK_EVERY, ReportStyle, TrafficReport
from tftool.commands.shared.notices import name_frames
from tftool.commands.shared.pairs import FramePair
from tftool.frames.frames import Frames
from tftool.recordings.timeline import Due, Timeline


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
        lasting: How much of it to report on, from where the frames are connected.
        cache_time: How far back lookups reach, as in a session.

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
        due, measuring = min(reported + period, end), measured + ASK_EVERY
        # Of two that are due at one moment, the one with the longer period goes first.
        is_report = report.chain is None or (due, -period) < (measuring, -ASK_EVERY)
        now = due if is_report else measuring
        arrivals.receive_until(now, report.traffic)
        if not is_report:
            measured = now
            report.measure(arrivals.buffer, now)
            continue
        reported = now
        if report.style is not ReportStyle.TABLE:
            report.write(now)
        elif now == end:
            # The ones before it would be drawn over at once.
            console.print(report.table(console, now, began))


class Arrivals:
    """The messages of a recording in order, as a session would receive them."""

    def __init__(self, timeline: Timeline, buffer: Buffer) -> None:
        """Begin before the first message; statics are known from the beginning on.

        Args:
            timeline: The messages.
            buffer: Takes their transforms.
        """
        self.buffer = buffer
        self._timeline = timeline
        self._place = 0
        self._statics: dict[str, dict[str, TransformStamped]] = {}
        self._known = timeline.known_at(timeline.start - 1)

    def receive_until(self, moment: Stamp, traffic: Traffic | None) -> None:
        """Receive the messages up to a moment, and count them in `traffic`."""
        start = self._timeline.start
        while self._known:
            self._receive(self._known.pop(0), start, traffic)
        last = self._timeline.place(moment, after=True)
        for place in range(self._place, last):
            for due in self._timeline.message(place):
                self._receive(due, due.moment, traffic)
        self._place = max(self._place, last)

    def connect(self, pair: tuple[str, str], end: Stamp) -> Stamp:
        """Receive messages until a pair can be looked up; return the moment.

        Raises:
            TransformException: If that is not so at the end.
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
