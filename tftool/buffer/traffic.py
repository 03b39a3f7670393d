"""Rates and delays of arriving transforms: exact values, and values as `tf2_monitor` computes them.

Properties that begin with `tf2_` use the formulas of `tf2_monitor`, for comparison with the output
of `tf2_monitor`. All other properties are exact. `tf2_monitor` has known errors: rates are too high
by one message, the net delay starts at zero and rises for minutes, and a static transform counts as
very late.
"""

from collections import deque
from collections.abc import Iterable
from itertools import takewhile
from typing import TYPE_CHECKING

from tftool.base.stamps import Stamp, as_seconds
from tftool.buffer.sample import TransformStamped

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Stamps = npt.NDArray[np.int64]
    Floats = npt.NDArray[np.float64]

KEEP = 1000
"""Number of the newest messages from which rates and delays are computed."""


class Series:
    """Arrival times and delays of the recent messages of one frame or one publisher.

    Attributes:
        total: Number of messages received, including messages that are no longer kept.
    """

    def __init__(self) -> None:
        self.total = 0
        self._arrivals: deque[Stamp] = deque(maxlen=KEEP)
        self._delays: deque[float] = deque(maxlen=KEEP)
        self._tf2_delays: deque[float] = deque(maxlen=KEEP)
        self._tf2_maximum = 0.0

    def add(self, now: Stamp, tf2_delay: float, *, dated: bool = True) -> None:
        """Record the arrival of a message.

        Args:
            now: Arrival time, nanoseconds.
            tf2_delay: `now` minus the message's stamp, seconds.
            dated: Whether the stamp is a time of measurement; false for a static transform.
        """
        self.total += 1
        self._arrivals.append(now)
        self._tf2_delays.append(tf2_delay)
        self._tf2_maximum = max(self._tf2_maximum, tf2_delay)
        if dated:
            self._delays.append(tf2_delay)

    def add_many(self, arrivals: "Stamps", delays: "Floats") -> None:
        """Record the arrivals of many messages whose stamps are times of measurement.

        Args:
            arrivals: Arrival times, nanoseconds, ascending, shape (n,).
            delays: Arrival time minus stamp of each message, seconds, shape (n,), n > 0.
        """
        self.total += len(arrivals)
        newest = delays[-KEEP:].tolist()
        self._arrivals.extend(arrivals[-KEEP:].tolist())
        self._tf2_delays.extend(newest)
        self._delays.extend(newest)
        self._tf2_maximum = max(self._tf2_maximum, float(delays.max()))

    @property
    def rate(self) -> float | None:
        """Message rate, hertz; None until two messages have arrived at different times."""
        span = self._span()
        return (len(self._arrivals) - 1) / span if span > 0.0 else None

    @property
    def last(self) -> Stamp | None:
        """Return the arrival time of the newest message; None before the first message."""
        return self._arrivals[-1] if self._arrivals else None

    @property
    def average_delay(self) -> float | None:
        """Mean delay from stamp to arrival, seconds; None if all messages are static."""
        return sum(self._delays) / len(self._delays) if self._delays else None

    @property
    def latest_delay(self) -> float | None:
        """Delay of the newest moving transform, seconds; None if all messages are static."""
        return self._delays[-1] if self._delays else None

    def worst_delay_since(self, stamp: Stamp) -> float | None:
        """Return the greatest delay of the messages that arrived after a time, seconds.

        If no message arrived after that time, return `latest_delay`, which can be None.
        """
        newest = takewhile(
            lambda one: one[0] > stamp,
            zip(reversed(self._arrivals), reversed(self._tf2_delays), strict=True),
        )
        return max((delay for _, delay in newest), default=self.latest_delay)

    @property
    def maximum_delay(self) -> float | None:
        """Greatest delay from stamp to arrival, seconds; None if all messages are static."""
        return max(self._delays) if self._delays else None

    @property
    def tf2_rate(self) -> float:
        """Message rate in hertz by tf2_monitor's formula, which gives 1e8 for a single message."""
        return len(self._arrivals) / max(1e-8, self._span())

    @property
    def tf2_average_delay(self) -> float:
        """Mean delay of all messages in seconds, static transforms included, as in tf2_monitor."""
        return sum(self._tf2_delays) / len(self._tf2_delays) if self._tf2_delays else 0.0

    @property
    def tf2_maximum_delay(self) -> float:
        """Greatest delay of a message in seconds, at least 0, as in tf2_monitor."""
        return self._tf2_maximum

    def _span(self) -> float:
        if not self._arrivals:
            return 0.0
        return as_seconds(self._arrivals[-1] - self._arrivals[0])


class FrameTraffic:
    """Recent messages about one frame: sender, arrival times and delays.

    Attributes:
        frame: Name of the frame.
        parent: Parent frame in the newest message.
        sender: Sender of the newest message.
        is_static: Whether the newest message came on the static topic.
        series: Recent messages about the frame.
    """

    def __init__(self, frame: str) -> None:
        self.frame = frame
        self.parent = ""
        self.sender = ""
        self.is_static = False
        self.series = Series()


class Traffic:
    """Rates and delays of all received transforms, by frame and by publisher.

    Attributes:
        links: Recent messages about each frame, in the order of arrival.
        senders: Recent messages of each publisher, by authority, in the order of arrival.
    """

    def __init__(self) -> None:
        self.links: dict[str, FrameTraffic] = {}
        self.senders: dict[str, Series] = {}

    def link(self, frame: str) -> FrameTraffic:
        """Return the recent messages about a frame; create an empty record for a new frame."""
        return self.links.setdefault(frame, FrameTraffic(frame))

    def receive(
        self,
        now: Stamp,
        transforms: Iterable[TransformStamped],
        authority: str,
        *,
        is_static: bool = False,
    ) -> None:
        """Record the arrival of one message of a publisher, which may contain many transforms."""
        delays = []
        for sample in transforms:
            delay = as_seconds(now - sample.stamp)
            delays.append(delay)
            link = self.link(sample.child_frame_id)
            link.parent = sample.frame_id
            link.sender = authority
            link.is_static = is_static
            link.series.add(now, delay, dated=not is_static)
        if delays:
            sender = self.senders.setdefault(authority, Series())
            sender.add(now, sum(delays) / len(delays), dated=not is_static)


class NetDelay:
    """Ages of the results of a repeated lookup: the largest age, and the mean age."""

    def __init__(self) -> None:
        self.count = 0
        self.maximum = 0.0
        self.tf2_average = 0.0
        self._sum = 0.0

    def add(self, delay: float) -> None:
        """Record the age of the transform that a lookup returned, seconds."""
        self.count += 1
        self._sum += delay
        self.maximum = max(self.maximum, delay)
        self.tf2_average = 0.01 * delay + 0.99 * self.tf2_average

    @property
    def average(self) -> float | None:
        """Mean age of all results, seconds; None before the first result."""
        return self._sum / self.count if self.count else None
