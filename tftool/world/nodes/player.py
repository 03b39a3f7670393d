"""A node that plays a recording's transforms at its own or another rate."""

from typing import TYPE_CHECKING, Any, ClassVar, Final

from tftool.base.stamps import NANOSECONDS, Duration, Stamp, seconds
from tftool.buffer.clock_jumps import FELL_BACK, LEAST_FALL
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import INTERFACES
from tftool.world.clock import Clock, FollowedClock, Phase
from tftool.world.endpoints import Quality
from tftool.world.node import Node
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.recordings.timeline import Due, Timeline
    from tftool.world.link.feed import TopicFeed

CLOCK_QUALITY: Final = Quality(depth=10)

TICK: Final = seconds(0.025)
"""How often `/clock` is published, in real time; rosbag2's own figure."""

AT_ONCE: Final = 500
"""Messages that are sent before anything else gets a turn."""

RECENT: Final = seconds(1)
"""Time before a moment that is sent together with its frames, at most `AT_ONCE`."""

SLOWEST, FASTEST = 0.01, 100.0
"""Rates that a player takes."""


class Player(Node):
    """Broadcasts a recording's transforms when due, and publishes `/clock`.

    Its moments are on the clock of the recording's stamps.

    Attributes:
        rate: Seconds of the recording for each real second.
        is_paused: Whether the player is paused.
        laps: Number of restarts.
    """

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(
        self,
        world: World,
        name: str,
        *,
        timeline: "Timeline",
        pace: Clock,
        span: tuple[Stamp, Stamp] | None = None,
        rate: float = 1.0,
        is_paused: bool = False,
        is_looping: bool = False,
        is_restamped: bool = False,
        is_silent: bool = False,
        names_topics: bool = False,
        feed: "TopicFeed | None" = None,
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to play in; its clock is set if it is a `FollowedClock`.
            name: The node's name.
            timeline: Timeline to send.
            pace: Clock of real time, or a test's substitute.
            span: From where to where to play; all of it if None.
            rate: Seconds of the recording for each second of `pace`.
            is_paused: Whether to begin standing still.
            is_looping: Whether to start over at the end.
            is_restamped: Whether to move stamps to the moment at which they are sent, and publish
                no `/clock`.
            is_silent: Whether to publish no `/clock` though stamps are the recording's.
            names_topics: Whether to name the topic as sender where no node is recorded,
                as in the description of a recording; else this node is named.
            feed: Sends other topics along.
        """
        super().__init__(world, name)
        self._timeline = timeline
        self._pace = pace
        self.start, self.end = span or (timeline.start, timeline.end)
        self.rate = rate
        self.is_paused = is_paused
        self.laps = 0
        self._is_looping = is_looping
        self._is_restamped = is_restamped
        self._is_silent = is_silent or is_restamped
        self._names_topics = names_topics
        self._feed = feed
        self._anchor = self.start  # where it was
        self._since = pace.now()  # when it was there
        self._place = timeline.place(self.start)
        self._listeners = world.tf.subscribers
        if not self._is_silent:
            self.publisher("clock", INTERFACES.message("rosgraph_msgs/Clock"), CLOCK_QUALITY)

    # Where it is

    @property
    def position(self) -> Stamp:
        """The playback's time, on the clock of the stamps."""
        if self.is_paused:
            return self._anchor
        passed = self._pace.now() - self._since
        return min(self._anchor + round(passed * self.rate), self.end)

    @property
    def is_over(self) -> bool:
        """Whether everything has been played."""
        return not self._is_looping and not self.is_paused and self.position >= self.end

    def pause(self) -> None:
        """Pause."""
        self._anchor, self.is_paused = self.position, True

    def resume(self) -> None:
        """Resume; from the start again after the end."""
        if self.is_paused:
            if self._anchor >= self.end:
                self.seek(self.start)
            self._since, self.is_paused = self._pace.now(), False

    def set_rate(self, rate: float) -> None:
        """Change the rate, between `SLOWEST` and `FASTEST`."""
        self._anchor, self._since = self.position, self._pace.now()
        self.rate = min(max(rate, SLOWEST), FASTEST)

    def step(self) -> None:
        """Send the next message, and pause."""
        self.pause()
        if self._place < len(self._timeline):
            moment = int(self._timeline.moments[self._place])
            if moment <= self.end:
                self._anchor = max(self._anchor, moment)
                self._tell()
                self._send(self._place)
                self._place += 1
                self._feed_until(moment)

    def seek(self, moment: Stamp) -> None:
        """Jump to a time: send the frames known at that time, and the second before."""
        before = self.position
        self._anchor = min(max(moment, self.start), self.end)
        self._since = self._pace.now()
        self._place = self._timeline.place(self._anchor, after=True)
        if self._feed is not None:
            self._feed.seek(self._anchor)
        if self._anchor - before <= -LEAST_FALL and not self._is_restamped:
            self.warn(FELL_BACK)
            self.buffer.clear()
        self._tell()
        self._send_known(self._anchor)

    # Playing

    async def run(self) -> None:
        """Play to the end; repeatedly, on request."""
        self._since = self._pace.now()
        self._tell()
        self._send_known(self.start - 1)
        if self._feed is not None:
            self._feed.seek(self.start)
        while True:
            self._welcome()
            is_behind = self._send_due()
            if self.is_over:
                return
            if self._is_looping and not self.is_paused and self.position >= self.end:
                self._start_over()
            await self._pace.sleep_until(self._next_turn(is_behind), self.phase, self.rank)

    def _welcome(self) -> None:
        """Send the present frames to processes that join during a pause."""
        listeners = self.world.tf.subscribers
        if self.is_paused and listeners > self._listeners:
            self._send_known(self._anchor)
        self._listeners = listeners

    def _start_over(self) -> None:
        self.laps += 1
        self.seek(self.start)
        # The very first messages are sent once more, as in the first round.
        self._place = self._timeline.place(self.start)

    def _send_due(self) -> bool:
        """Send everything due; return whether some is left for the next call."""
        position = self.position
        last = min(self._timeline.place(position, after=True), self._place + AT_ONCE)
        while self._place < last:
            # Before the transforms of that moment, so that it lies in the past of its listeners.
            self._tell(int(self._timeline.moments[self._place]))
            self._send(self._place)
            self._place += 1
        if last < self._timeline.place(position, after=True):
            return True
        self._feed_until(position)
        self._tell(position)
        return False

    def _next_turn(self, is_behind: bool) -> Stamp:
        now = self._pace.now()
        if is_behind:
            return now
        turn = self._since + 2**62 if self._is_silent and not self.is_paused else now + TICK
        if self.is_paused:
            return turn
        dues = [self.end]
        if self._place < len(self._timeline):
            dues.append(int(self._timeline.moments[self._place]))
        if self._feed is not None and (due := self._feed.next_due()) is not None:
            dues.append(due)
        wait = -(-(min(dues) - self._anchor) // self.rate)
        return max(now, min(turn, self._since + int(wait)))

    def _feed_until(self, moment: Stamp) -> None:
        if self._feed is not None:
            self._feed.send_until(moment)

    def _send(self, place: int) -> None:
        for due in self._timeline.message(place):
            self._broadcast(due)

    def _send_known(self, moment: Stamp) -> None:
        """Send what a lookup at a time needs.

        The last transform of each link would not suffice: their stamps differ, and a lookup of two
        links needs a moment between two samples of the one that is ahead.
        """
        last = self._timeline.place(moment, after=True)
        first = last
        if not self._is_restamped:
            first = max(self._timeline.place(moment - RECENT), last - AT_ONCE)
        before = int(self._timeline.moments[first]) - 1 if first < last else moment
        for due in self._timeline.known_at(before):
            self._broadcast(due)
        for place in range(first, last):
            self._send(place)

    def _broadcast(self, due: "Due") -> None:
        transforms = due.transforms
        if self._is_restamped:
            later = self._shift(due.moment)
            transforms = tuple(_restamped(one, later, due.static) for one in transforms)
        sender = due.node or (due.topic if self._names_topics else self.name)
        self.world.broadcast(transforms, sender, static=due.static)

    def _shift(self, moment: Stamp) -> Duration:
        """Return by how much a time is played later than it was recorded."""
        wait = 0 if self.is_paused else round((moment - self._anchor) / self.rate)
        since = self._pace.now() if self.is_paused else self._since
        return since + wait - moment

    def _tell(self, moment: Stamp | None = None) -> None:
        """Publish the time: to this world, and on `/clock`."""
        if self._is_silent:
            return
        now = max(self._anchor if moment is None else moment, 1)
        clock = self.world.clock
        if isinstance(clock, FollowedClock) and clock.now() != now:
            clock.tell(now)
        message: Any = INTERFACES.message("rosgraph_msgs/Clock")()
        message.clock.sec, message.clock.nanosec = divmod(now, NANOSECONDS)
        self.publish("clock", message)


def _restamped(sample: TransformStamped, later: Duration, static: bool) -> TransformStamped:
    # Static transforms may have the stamp 0, which says nothing of when.
    if static and not sample.stamp:
        return sample
    return sample._replace(stamp=max(sample.stamp + later, 1))
