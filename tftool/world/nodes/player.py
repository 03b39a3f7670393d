"""Node that plays a recording's transforms at any rate."""

from typing import TYPE_CHECKING, Any, ClassVar, Final

from tftool.base.stamps import NANOSECONDS, Duration, Stamp, seconds
from tftool.buffer.callbacks import FELL_BACK, LEAST_FALL
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
"""Real nanoseconds between two messages on `/clock`, as in rosbag2."""

AT_ONCE: Final = 500
"""Largest number of messages sent at once, before other tasks get a turn."""

RECENT: Final = seconds(1)
"""Nanoseconds before a sought time whose transforms are sent too, at most `AT_ONCE` of them."""

SLOWEST, FASTEST = 0.01, 100.0
"""Smallest and largest rate of a player."""


class Player(Node):
    """Node that publishes a recording's transforms at the recorded intervals, and `/clock`.

    All times in this class are times of the recording, like the stamps of its transforms.

    Attributes:
        rate: Seconds of the recording per real second.
        is_paused: Whether the player is paused.
        laps: Number of restarts.
        frames: Names of all frames of the recording.
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
        waits_at_end: bool = False,
        is_restamped: bool = False,
        is_silent: bool = False,
        names_topics: bool = False,
        feed: "TopicFeed | None" = None,
    ) -> None:
        """Add the node to a world.

        Args:
            world: World that gets the transforms. If its clock is a `FollowedClock`, the player
                sets the clock.
            name: Name of the node.
            timeline: Transforms of the recording, with their times.
            pace: Clock of real time, or a test's substitute.
            span: First and last time to play; None for the whole recording.
            rate: Seconds of the recording per second of `pace`.
            is_paused: Whether to begin paused.
            is_looping: Whether to start again at the end.
            waits_at_end: Whether to pause at the end, instead of ending.
            is_restamped: Whether to replace stamps by the time of sending, and publish no `/clock`.
            is_silent: Whether to publish no `/clock` although the recording's stamps are kept.
            names_topics: Whether the authority of a transform without a recorded node is the topic;
                else the authority is this node.
            feed: Player of the recording's topics other than tf.
        """
        super().__init__(world, name)
        self._timeline, self.frames = timeline, timeline.frames
        self._pace = pace
        self.start, self.end = span or (timeline.start, timeline.end)
        self.rate = rate
        self.is_paused = is_paused
        self.laps = 0
        self._is_looping = is_looping
        self._waits_at_end = waits_at_end
        self._is_restamped = is_restamped
        self._is_silent = is_silent or is_restamped
        self._names_topics = names_topics
        self._feed = feed
        self._anchor = self.start  # position at `_since`
        self._since = pace.now()  # real time at which the position was `_anchor`
        self._place = timeline.place(self.start)
        self._listeners = world.tf.subscribers
        if not self._is_silent:
            self.publisher("clock", INTERFACES.message("rosgraph_msgs/Clock"), CLOCK_QUALITY)

    # State of the playback

    @property
    def position(self) -> Stamp:
        """Current time of the playback, as a time of the recording in nanoseconds."""
        if self.is_paused:
            return self._anchor
        passed = self._pace.now() - self._since
        return min(self._anchor + round(passed * self.rate), self.end)

    @property
    def is_over(self) -> bool:
        """Whether the whole recording has been played."""
        return not self._is_looping and not self.is_paused and self.position >= self.end

    def pause(self) -> None:
        """Pause the playback at its current time."""
        self._anchor, self.is_paused = self.position, True

    def resume(self) -> None:
        """Resume the playback; at the end of the recording, start again."""
        if self.is_paused:
            if self._anchor >= self.end:
                self.seek(self.start)
            self._since, self.is_paused = self._pace.now(), False

    def set_rate(self, rate: float) -> None:
        """Change the rate, limited to `SLOWEST` and `FASTEST`."""
        self._anchor, self._since = self.position, self._pace.now()
        self.rate = min(max(rate, SLOWEST), FASTEST)

    def step(self) -> None:
        """Pause the playback, and send the next transform of the recording."""
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
        """Jump to a time of the recording; send the transforms that lookups at this time need."""
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
        """Play the recording to its end, or repeatedly if `is_looping`."""
        self._since = self._pace.now()
        self._tell()
        self._send_known(self.start - 1)
        if self._feed is not None:
            self._feed.seek(self.start)
        while True:
            self._welcome()
            is_behind = self._send_due()
            if self.is_over:
                if not self._waits_at_end:
                    return
                self.pause()
            if self._is_looping and not self.is_paused and self.position >= self.end:
                self._start_over()
            await self._pace.sleep_until(self._next_turn(is_behind), self.phase, self.rank)

    def _welcome(self) -> None:
        """If the player is paused and there are new subscribers, send the current frames again."""
        listeners = self.world.tf.subscribers
        if self.is_paused and listeners > self._listeners:
            self._send_known(self._anchor)
        self._listeners = listeners

    def _start_over(self) -> None:
        self.laps += 1
        self.seek(self.start)
        # Start again with the first messages, as in the first round.
        self._place = self._timeline.place(self.start)

    def _send_due(self) -> bool:
        """Send the messages whose time has come, up to a limit; return whether more are waiting."""
        position = self.position
        last = min(self._timeline.place(position, after=True), self._place + AT_ONCE)
        while self._place < last:
            # Before the transforms of that time, so that listeners' clocks are not behind them.
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
        """Send the transforms that lookups at the time `moment` need.

        The last transform of each frame would not be enough: the last stamps of two frames differ,
        and a lookup between the frames needs samples before and after a common time.
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
        """Return the nanoseconds from a time of the recording to the time of its playback."""
        wait = 0 if self.is_paused else round((moment - self._anchor) / self.rate)
        since = self._pace.now() if self.is_paused else self._since
        return since + wait - moment

    def _tell(self, moment: Stamp | None = None) -> None:
        """Set the world's clock to the playback's time, and publish this time on `/clock`."""
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
    # Static transforms may have the stamp 0, which is not a time.
    if static and not sample.stamp:
        return sample
    return sample._replace(stamp=max(sample.stamp + later, 1))
