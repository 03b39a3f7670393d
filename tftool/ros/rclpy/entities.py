"""Timers, work queues and guard conditions of a node, and callback groups.

An entity of a node has work for an executor, such as a callback to call. The entity stores the
work until an executor takes it.
"""

import asyncio
import inspect
from collections import deque
from collections.abc import Callable, Coroutine, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from typing import Any, Final, Self

from tftool.base.errors import TftoolError
from tftool.base.stamps import Stamp
from tftool.ros.host.program import TICK
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node_state import NodeState
from tftool.ros.rclpy.time import Clock, ClockType, Time
from tftool.world.endpoints import CLIENT, Endpoint

Work = Callable[[], Any]
"""Function that an executor calls in the spinning thread; may return a coroutine."""


MOST_WAITING: Final = 1000
"""Largest number of queued requests or goals; further requests and goals are refused."""


@contextmanager
def required(require: Callable[[], object]) -> Iterator[None]:
    """Call `require`, which raises an error for a destroyed entity; then run the `with` block."""
    require()
    yield


class NodeEntity:
    """Base class of a node's objects, such as timers, that may have work for an executor."""

    passes_busy_group = False
    is_a_callback = False
    """Whether the entity is a callback of the user that only an executor calls."""
    only_ends_spin_once = False
    """Whether the entity only makes `spin_once` return, as the same object in ROS 2 does."""

    def __init__(self, state: NodeState, group: Any) -> None:
        self.node_state = state
        self.callback_group = group

    def ready(self) -> bool:
        """Return whether the entity has work for an executor."""
        return False

    def take(self) -> Work:
        """Remove the entity's next work and return it as a function, which the executor calls."""
        raise NotImplementedError

    def withdraw(self) -> None:
        """Close the entity; call this in the event loop's thread."""

    def destroy(self) -> None:
        """Close the entity, and remove it from the node."""
        self.node_state.forget(self)

    @property
    def handle(self) -> AbstractContextManager[None]:
        """Context manager that raises InvalidHandle if the entity was destroyed."""
        return required(lambda: self.node_state.require_of(self))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *args: object) -> None:
        self.destroy()


class WorkQueue(NodeEntity):
    """Entity that stores its work in a queue; an executor does the work in order."""

    def __init__(self, state: NodeState, group: Any) -> None:
        super().__init__(state, group)
        self._arrived: deque[Work] = deque()

    def put(self, work: Work) -> None:
        """Append work to the queue and wake the executor; call this in the event loop's thread."""
        self._arrived.append(work)
        self.node_state.wake()

    @property
    def is_full(self) -> bool:
        """Whether the queue is at its limit; the entity then refuses further requests and goals."""
        return len(self._arrived) >= MOST_WAITING

    def ready(self) -> bool:
        """Return whether the queue contains work."""
        return bool(self._arrived)

    def take(self) -> Work:
        """Remove the oldest work from the queue and return it."""
        return self._arrived.popleft()


class Requester(WorkQueue):
    """Entity that sends requests to a server; the executor's work is to process each response."""

    # A response only completes a future and calls no callback. So it is processed even if a
    # callback of the same group waits for it.
    passes_busy_group = True

    def __init__(self, state: NodeState, group: Any) -> None:
        super().__init__(state, group)
        self._asking: set[asyncio.Task[None]] = set()
        self._leave: Callable[[], None] | None = None

    def announce(self, service: str, kind: str) -> None:
        """Add the entity to the graph as a client of a service.

        Call this in the event loop's thread.
        """
        client = Endpoint(CLIENT, self.node_state.authority, service, kind)
        self._leave = self.node_state.world.clients.add(client)

    def is_served(self) -> bool:
        """Return whether a server is available; call this in the event loop's thread."""
        raise NotImplementedError

    def server_is_ready(self) -> bool:
        """Return whether a server is available now; this method can be called in any thread."""
        ready = bool(self.node_state.program.ask(self.is_served))
        if not ready:
            self.node_state.program.count_failed_query(must_keep_pace=False)
        return ready

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Block until a server is available; return False at the timeout."""
        return self.node_state.wait_until(self.is_served, timeout_sec)

    def promise(self, request: Callable[[], Coroutine[Any, Any, Any]]) -> Future:
        """Start the coroutine of a request in the event loop; return a future of the response.

        The node's executor completes the future; if the coroutine returns None, the future never
        completes. Closing this entity cancels the coroutine.
        """
        future = Future(executor=self.node_state.executor)

        async def work() -> None:
            try:
                response = await request()
            except TftoolError as error:
                complete: Callable[[], object] = partial(future.set_exception, error)
            else:
                complete = partial(future.set_result, response)
                if response is None:
                    return

            def settle() -> None:
                if not future.cancelled():
                    future.set_executor(self.node_state.executor)
                    complete()

            self.put(settle)

        def start() -> None:
            task = asyncio.get_running_loop().create_task(work())
            self._asking.add(task)
            task.add_done_callback(self._asking.discard)

        self.node_state.program.ask(start)
        return future

    def withdraw(self) -> None:
        """Close the entity and cancel all its requests."""
        if self._leave is not None:
            self._leave()
        for task in list(self._asking):
            task.cancel()


class GuardCondition(WorkQueue):
    """Entity that calls its callback when a program calls `trigger`."""

    def __init__(self, state: NodeState, callback: Callable[[], Any], group: Any) -> None:
        super().__init__(state, group)
        self.callback = callback

    def trigger(self) -> None:
        """Schedule the callback, unless the callback is already scheduled."""

        def set_off() -> None:
            if not self.ready():
                self.put(self.callback)

        self.node_state.program.ask(set_off)


class CallbackGroup:
    """Group of callbacks with a rule about which of them may run at the same time."""

    busy = 0
    """Number of callbacks of the group that are running."""

    def add_entity(self, entity: Any) -> None:
        """Do nothing, because each entity stores its callback group."""

    def has_entity(self, entity: Any) -> bool:
        """Return whether an entity belongs to the group."""
        return getattr(entity, "callback_group", None) is self

    def can_execute(self, entity: Any) -> bool:
        """Return whether the group's rule permits a callback to start now."""
        raise NotImplementedError

    def beginning_execution(self, entity: Any) -> bool:
        """Count a callback as running; if the group's rule forbids this now, return False."""
        if not self.can_execute(entity):
            return False
        self.busy += 1
        return True

    def ending_execution(self, entity: Any) -> None:
        """Decrement the number of running callbacks of this group."""
        self.busy -= 1


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """Group of callbacks that run one at a time."""

    def can_execute(self, entity: Any) -> bool:
        """Return whether no other callback of the group is running."""
        return self.busy == 0


class ReentrantCallbackGroup(CallbackGroup):
    """Group of callbacks that may all run at the same time."""

    def can_execute(self, entity: Any) -> bool:
        """Return True, because callbacks of this group may start at any time."""
        return True


class TimerInfo:
    """Planned time and actual time of a timer's call."""

    def __init__(
        self,
        *,
        expected_call_time: int = 0,
        actual_call_time: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        """Store the two times, given in nanoseconds on a clock of type `clock_type`."""
        self.expected_call_time = Time(nanoseconds=expected_call_time, clock_type=clock_type)
        self.actual_call_time = Time(nanoseconds=actual_call_time, clock_type=clock_type)


class Timer(NodeEntity):
    """Timer that calls its callback once per period; the first call is after one period."""

    is_a_callback = True

    def __init__(
        self,
        state: NodeState,
        callback: Callable[..., Any] | None,
        period_ns: int,
        group: Any,
        clock: Clock,
        autostart: bool = True,
    ) -> None:
        super().__init__(state, group)
        self.callback: Callable[..., Any] | None = callback
        self.clock = clock
        self._period = period_ns
        clock.timers.append(self)
        self._last = clock.reading()
        self.due = self._last + period_ns
        self._canceled = not autostart
        self._takes_info = callback is not None and not accepts(callback)

    @property
    def timer_period_ns(self) -> int:
        """Period of the timer in nanoseconds."""
        return self._period

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        def change() -> None:
            self._period = int(value)

        self.node_state.program.ask(change)

    def ready(self) -> bool:
        """Return whether the timer's next call is due."""
        return not self._canceled and self.due <= self.clock.reading()

    is_ready = ready

    def take(self) -> Work:
        """Schedule the timer's next call, and return a function that calls the callback now.

        The next call is at the next multiple of the period, so calls that were missed are left out.
        """
        now, due = self.clock.reading(), self.due
        self._last = now
        # A timer with period 0 must not stop simulated time.
        fastest = TICK if self.node_state.program.strict else 0
        if not self._period:
            self.due = now + fastest
        else:
            self.due += self._period
            if self.due < now:
                self.due += -(-(now - self.due) // self._period) * self._period

        if self.callback is None:
            return lambda: None
        if not self._takes_info:
            return self.callback
        kind = self.clock.clock_type
        info = TimerInfo(expected_call_time=due, actual_call_time=now, clock_type=kind)
        return partial(self.callback, info)

    def cancel(self) -> None:
        """Stop calling the callback until `reset` is called."""
        self._canceled = True

    def is_canceled(self) -> bool:
        """Return whether the timer was cancelled."""
        return self._canceled

    def reset(self) -> None:
        """Restart the timer; the next call is one period from now."""

        def restart() -> None:
            self._canceled = False
            self.due = self.clock.reading() + self._period
            self.node_state.wake()

        self.node_state.program.ask(restart)

    def time_since_last_call(self) -> int:
        """Return the nanoseconds since the last call, or the creation if there was no call."""
        return self.clock.reading() - self._last

    def time_until_next_call(self) -> int | None:
        """Return the nanoseconds until the timer's next call; None for a cancelled timer."""
        return None if self._canceled else self.due - self.clock.reading()

    def clock_jumped(self, before: Stamp, is_other_source: bool) -> None:
        """Adapt the time of the next call after a `TimeSource` has set the clock.

        After a change of the clock's source, the next call is as far away as before, unless a time
        is 0: a source that has not set a time yet shows time 0. If the same source has set an
        earlier time, a new period begins. Call this in the event loop's thread.

        Args:
            before: Time of the clock before it was set, nanoseconds.
            is_other_source: Whether the source of the clock's time has changed.
        """
        now = self.clock.reading()
        if is_other_source and before and now:
            self._last += now - before
            self.due += now - before
        elif not is_other_source and now < self._last:
            self._last, self.due = now, now + self._period
        self.node_state.wake()

    def withdraw(self) -> None:
        """Stop counting time on the clock."""
        self.clock.timers.remove(self)


class RateTimer(Timer):
    """Timer of a `Rate`; as in ROS 2, each call of this timer makes `spin_once` return."""

    only_ends_spin_once = True
    on_end: Callable[[], object] = staticmethod(lambda: None)
    """Function called when the timer is destroyed."""
    on_jump: Callable[[], object] = staticmethod(lambda: None)
    """Function called when a `TimeSource` has set the clock."""

    def clock_jumped(self, before: Stamp, is_other_source: bool) -> None:
        """Adapt the time of the next call, and call the function `on_jump`."""
        super().clock_jumped(before, is_other_source)
        self.on_jump()

    def withdraw(self) -> None:
        """Close the timer, and call the function `on_end`."""
        super().withdraw()
        self.on_end()


async def outcome(value: Any) -> Any:
    """Return the result of a callback; await the value if the callback returned a coroutine."""
    return await value if inspect.isawaitable(value) else value


def accepts(callback: Callable[..., Any], *args: object) -> bool:
    """Return whether the signature of a callback accepts these arguments."""
    try:
        inspect.signature(callback).bind(*args)
    except TypeError:
        return False
    except ValueError:  # It has no signature.
        return True
    return True
