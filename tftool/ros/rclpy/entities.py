"""Entities of a node that executors wait for.

Each entity keeps arrivals until an executor takes them.
"""

import asyncio
from collections import deque
from collections.abc import Callable, Coroutine
from typing import Any, Final, Self

from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.seat import NodeSeat

Work = Callable[[], Any]
"""The rest of the work on the fiber once an entity was taken from; may return a coroutine."""


MOST_WAITING: Final = 1000
"""Requests or goals that may wait for a node that takes none; more are refused."""


class RequiredHandle:
    """Handle for an entity's `with` block, checked to exist."""

    def __init__(self, require: Callable[[], object]) -> None:
        self._require = require

    def __enter__(self) -> Self:
        self._require()
        return self

    def __exit__(self, *args: object) -> None:
        """Do nothing: there is nothing to release."""


class NodeEntity:
    """Entity of a node that can become ready."""

    passes_busy_group = False
    is_a_callback = False
    """Whether it is a callback of the user's own that only an executor calls."""
    only_ends_spin_once = False
    """Whether it has nothing to do but end a `spin_once`, as what it stands for would in ROS."""

    def __init__(self, seat: NodeSeat, group: Any) -> None:
        self.seat = seat
        self.callback_group = group

    def ready(self) -> bool:
        """Whether there is work."""
        return False

    def take(self) -> Work:
        """Return the next piece of work."""
        raise NotImplementedError

    def withdraw(self) -> None:
        """Close it (in the loop's thread)."""

    def destroy(self) -> None:
        """Close it, and remove it from the node."""
        self.seat.forget(self)

    @property
    def handle(self) -> RequiredHandle:
        """Handle that raises InvalidHandle once destroyed."""
        return RequiredHandle(lambda: self.seat.require_of(self))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *args: object) -> None:
        self.destroy()


class WorkQueue(NodeEntity):
    """Entity whose work arrives in pieces, executed in order."""

    def __init__(self, seat: NodeSeat, group: Any) -> None:
        super().__init__(seat, group)
        self._arrived: deque[Work] = deque()

    def put(self, work: Work) -> None:
        """Queue a piece of work (in the loop's thread)."""
        self._arrived.append(work)
        self.seat.wake()

    @property
    def is_full(self) -> bool:
        """Whether the queue is so long that others' requests and goals are refused."""
        return len(self._arrived) >= MOST_WAITING

    def ready(self) -> bool:
        """Whether a piece of work waits."""
        return bool(self._arrived)

    def take(self) -> Work:
        """Return the oldest piece."""
        return self._arrived.popleft()


class Requester(WorkQueue):
    """Entity that sends requests to others, whose responses are its work."""

    # An answer completes a future and calls no callback by itself, so a callback that
    # waits for it gets it.
    passes_busy_group = True

    def __init__(self, seat: NodeSeat, group: Any) -> None:
        super().__init__(seat, group)
        self._asking: set[asyncio.Task[None]] = set()

    def ask(self, question: Coroutine[Any, Any, None]) -> None:
        """Send a request in the loop's thread; it is cancelled with this entity."""

        def start() -> None:
            task = asyncio.get_running_loop().create_task(question)
            self._asking.add(task)
            task.add_done_callback(self._asking.discard)

        self.seat.program.ask(start)

    def settle(self, future: Future, complete: Callable[[], object]) -> None:
        """Complete a future in the executor that serves this; it runs the callbacks."""

        def work() -> None:
            if not future.cancelled():
                future.set_executor(self.seat.executor)
                complete()

        self.put(work)

    def withdraw(self) -> None:
        """Cancel all requests."""
        super().withdraw()
        for task in list(self._asking):
            task.cancel()


class GuardCondition(NodeEntity):
    """Calls back when triggered."""

    def __init__(self, seat: NodeSeat, callback: Callable[[], Any], group: Any) -> None:
        super().__init__(seat, group)
        self.callback = callback
        self._triggered = False

    def trigger(self) -> None:
        """Schedule the callback."""

        def set_off() -> None:
            self._triggered = True
            self.seat.wake()

        self.seat.program.ask(set_off)

    def ready(self) -> bool:
        """Whether it was triggered."""
        return self._triggered

    def take(self) -> Work:
        """Return the callback."""
        self._triggered = False
        return self.callback


class CallbackGroup:
    """Callbacks with a common rule."""

    def __init__(self) -> None:
        self.busy = 0

    def add_entity(self, entity: Any) -> None:
        """Do nothing: entities know their group."""

    def has_entity(self, entity: Any) -> bool:
        """Return whether an entity belongs to it."""
        return getattr(entity, "callback_group", None) is self

    def can_execute(self, entity: Any) -> bool:
        """Return whether a callback of this group may start."""
        raise NotImplementedError

    def beginning_execution(self, entity: Any) -> bool:
        """Record the start of a callback; return False if another one prevents it."""
        if not self.can_execute(entity):
            return False
        self.busy += 1
        return True

    def ending_execution(self, entity: Any) -> None:
        """Record the end of a callback."""
        self.busy -= 1


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """Group of callbacks of which one runs at a time."""

    def can_execute(self, entity: Any) -> bool:
        """Return whether no other callback of the group is running."""
        return self.busy == 0


class ReentrantCallbackGroup(CallbackGroup):
    """Group of callbacks that may all run concurrently."""

    def can_execute(self, entity: Any) -> bool:
        """Return True."""
        return True
