"""Filters of ROS's message_filters, which cache messages or synchronise topics by stamp."""

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any

from tftool.ros.rclpy.logging import get_logger
from tftool.ros.rclpy.time import Duration, ROSClock, Time


class SimpleFilter:
    """Base class of filters, which call registered callbacks with messages."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:  # noqa: N802
        """Call `cb(message, *args)` with every message; return the callback's number."""
        connection = len(self.callbacks)
        self.callbacks[connection] = (cb, args)
        return connection

    def signalMessage(self, *msg: Any) -> None:  # noqa: N802
        """Call the registered callbacks with `msg`: one message, or one for each input filter."""
        for callback, args in list(self.callbacks.values()):
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """Filter whose messages come from a subscription: `Subscriber(node, type, topic, …)`.

    Further arguments are passed to `Node.create_subscription`.
    """

    def __init__(self, node: Any, msg_type: Any, topic: str, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        if not args:
            kwargs.setdefault("qos_profile", 10)
        self.node = node
        self.topic = topic
        self.sub = node.create_subscription(msg_type, topic, self.callback, *args, **kwargs)

    def callback(self, msg: Any) -> None:
        """Call the registered callbacks with a received message."""
        self.signalMessage(msg)

    def getTopic(self) -> str:  # noqa: N802
        """Return the name of the subscribed topic."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        # The attributes of the subscription are available here too.
        if key == "sub":
            raise AttributeError(key)
        return getattr(self.sub, key)


def _stamp(msg: Any, allow_headerless: bool, logger_name: str) -> Time | None:
    """Return the stamp of a message.

    For a message without a header, return the present time, or log a warning and return None.
    """
    if hasattr(msg, "header") and hasattr(msg.header, "stamp"):
        stamp = msg.header.stamp
        return stamp if isinstance(stamp, Time) else Time.from_msg(stamp)
    if allow_headerless:
        return ROSClock().now()
    get_logger(logger_name).warning(
        f"{type(msg).__name__} has no header with a stamp, so the message is ignored: "
        "set allow_headerless=True to use the time of arrival as its stamp"
    )
    return None


class Cache(SimpleFilter):
    """Filter that stores the last `cache_size` messages of another filter with their stamps."""

    def __init__(
        self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False
    ) -> None:
        super().__init__()
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Time] = []
        self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:  # noqa: N802
        """Set the filter whose messages are stored from now on."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Store a message and call the registered callbacks; drop a message without a stamp."""
        stamp = _stamp(msg, self.allow_headerless, "message_filters_cache")
        if stamp is None:
            return
        self.cache_msgs = [*self.cache_msgs, msg][-self.cache_size :]
        self.cache_times = [*self.cache_times, stamp][-self.cache_size :]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:  # noqa: N802
        """Return the stored messages with stamps from `from_stamp` to `to_stamp`, both included."""
        return self._where(lambda stamp: from_stamp <= stamp <= to_stamp)

    def getElemAfterTime(self, stamp: Time) -> Any:  # noqa: N802
        """Return the oldest stored message with a stamp at or after `stamp`, or None."""
        return next(iter(self._where(lambda kept: kept >= stamp)), None)

    def getElemBeforeTime(self, stamp: Time) -> Any:  # noqa: N802
        """Return the newest stored message with a stamp at or before `stamp`, or None."""
        return next(reversed(self._where(lambda kept: kept <= stamp)), None)

    def _where(self, fits: Callable[[Time], bool]) -> list[Any]:
        kept = zip(self.cache_times, self.cache_msgs, strict=True)
        return [msg for stamp, msg in kept if fits(stamp)]

    def getLastestTime(self) -> Time | None:  # noqa: N802
        """Return the stamp of the newest stored message; None if the cache is empty.

        ROS 2 misspells the method's name in the same way.
        """
        return self.cache_times[-1] if self.cache_times else None

    def getOldestTime(self) -> Time | None:  # noqa: N802
        """Return the stamp of the oldest stored message; None if the cache is empty."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:  # noqa: N802
        """Return the newest stored message; None if the cache is empty."""
        return self.cache_msgs[-1] if self.cache_msgs else None


class TimeSynchronizer(SimpleFilter):
    """Filter that combines messages with equal stamps, one from each of several input filters."""

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        self.queue_size = queue_size
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[SimpleFilter]) -> None:  # noqa: N802
        """Set the input filters whose messages are combined."""
        self.queues: list[dict[int, Any]] = [{} for _ in fs]
        self.input_connections = [
            one.registerCallback(self.add, queue, index)
            for index, (one, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int) -> None:
        """Store a message; call the registered callbacks for each complete set of equal stamps.

        `my_queue` has the stored messages of the input filter with the index `my_queue_index`, by
        stamp.
        """
        self._keep(Time.from_msg(msg.header.stamp).nanoseconds, msg, my_queue)
        for stamp in sorted(set.intersection(*(set(queue) for queue in self.queues))):
            self._hand_on([stamp] * len(self.queues))

    def _keep(self, stamp: int, msg: Any, queue: dict[int, Any]) -> None:
        queue[stamp] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]

    def _hand_on(self, stamps: Sequence[int]) -> None:
        chosen = zip(self.queues, stamps, strict=True)
        self.signalMessage(*[queue.pop(stamp) for queue, stamp in chosen])


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Filter that combines one message per input filter, with stamps less than `slop` s apart."""

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
    ) -> None:
        super().__init__(fs, queue_size)
        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int) -> None:
        """Store a message; call the registered callbacks if it completes a set of near stamps.

        For the arguments see `TimeSynchronizer.add`.
        """
        time = _stamp(msg, self.allow_headerless, "message_filters_approx")
        if time is None:
            return
        stamp, slop = time.nanoseconds, self.slop.nanoseconds
        self._keep(stamp, msg, my_queue)
        if stamp not in my_queue:
            return  # the queue is full of newer messages
        near = [
            [stamp]
            if queue is my_queue
            else sorted(
                (other for other in queue if abs(other - stamp) <= slop),
                key=lambda other: abs(other - stamp),
            )
            for queue in self.queues
        ]
        for stamps in product(*near):
            if max(stamps) - min(stamps) < slop:
                self._hand_on(stamps)
                return
