"""message_filters: one topic, or several whose messages belong together by their stamps."""

from collections.abc import Callable, Sequence
from typing import Any

from tftool.ros.client.time import Duration, Time
from tftool.ros.values import stamp_of


class SimpleFilter:
    """Hands messages on to those who registered."""

    def __init__(self) -> None:
        self._callbacks: list[tuple[Callable[..., Any], tuple[Any, ...]]] = []

    def registerCallback(self, callback: Callable[..., Any], *args: Any) -> int:  # noqa: N802
        """Have `callback` called with every message."""
        self._callbacks.append((callback, args))
        return len(self._callbacks) - 1

    def signalMessage(self, *messages: Any) -> None:  # noqa: N802
        """Hand messages on."""
        for callback, args in list(self._callbacks):
            callback(*messages, *args)


class Subscriber(SimpleFilter):
    """A subscription as a filter."""

    def __init__(self, node: Any, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        kwargs.setdefault("qos_profile", 10)
        self.topic = args[1] if len(args) > 1 else kwargs.get("topic")
        self.sub = node.create_subscription(*args, callback=self.signalMessage, **kwargs)

    def getTopic(self) -> Any:  # noqa: N802
        """The topic's name."""
        return self.topic


class Cache(SimpleFilter):
    """Keeps the last messages."""

    def __init__(
        self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False
    ) -> None:
        super().__init__()
        self._size = cache_size
        self._headerless = allow_headerless
        self._kept: list[tuple[int, Any]] = []
        f.registerCallback(self._add)

    def _add(self, message: Any) -> None:
        if not hasattr(message, "header") and not self._headerless:
            raise TypeError("a message without a header needs allow_headerless=True")
        stamp = stamp_of(message.header.stamp) if hasattr(message, "header") else len(self._kept)
        self._kept = [*self._kept, (stamp, message)][-self._size :]
        self.signalMessage(message)

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:  # noqa: N802
        """The messages between two moments."""
        low, high = from_stamp.nanoseconds, to_stamp.nanoseconds
        return [message for stamp, message in self._kept if low <= stamp <= high]

    def getLast(self) -> Any:  # noqa: N802
        """The newest message, None without one."""
        return self._kept[-1][1] if self._kept else None


class TimeSynchronizer(SimpleFilter):
    """Hands on sets of messages with equal stamps, one of each filter."""

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        self._size = queue_size
        self._queues: list[dict[int, Any]] = [{} for _ in fs]
        for index, one in enumerate(fs):
            one.registerCallback(lambda message, at=index: self._add(message, at))

    def _add(self, message: Any, index: int) -> None:
        self._keep(stamp_of(message.header.stamp), message, index)
        for stamp in sorted(set.intersection(*(set(queue) for queue in self._queues))):
            self.signalMessage(*(queue.pop(stamp) for queue in self._queues))

    def _keep(self, stamp: int, message: Any, index: int) -> None:
        queue = self._queues[index]
        queue[stamp] = message
        while len(queue) > self._size:
            del queue[min(queue)]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Hands on sets of messages whose stamps differ by no more than `slop` seconds."""

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
    ) -> None:
        super().__init__(fs, queue_size)
        self._slop = Duration(seconds=slop).nanoseconds

    def _add(self, message: Any, index: int) -> None:
        stamp = stamp_of(message.header.stamp)
        self._keep(stamp, message, index)
        chosen = []
        for queue in self._queues:
            near = min(queue, key=lambda other: abs(other - stamp), default=None)
            if near is None or abs(near - stamp) > self._slop:
                return
            chosen.append(near)
        self.signalMessage(
            *(queue.pop(one) for queue, one in zip(self._queues, chosen, strict=True))
        )
