"""Simulated and real clocks with one interface.

No other module uses `time` or `asyncio.sleep`. Both clocks wake waiters in the order of stamp, then
phase within the instant, then rank within the phase, then request. asyncio's own timers of one
instant would be called in an unpredictable order.

On the simulated clock the event loop runs in virtual time too. When every task sleeps, time jumps
to the earliest waiter's time. So asyncio's own timeouts are in simulated time, and ten simulated
minutes can take one real second.
"""

import asyncio
import contextlib
import heapq
import math
import selectors
import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Coroutine, Iterator
from enum import IntEnum
from typing import Any, TypeVar

from tftool.base.errors import TftoolError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, seconds, whole
from tftool.buffer.callbacks import Listeners
from tftool.world.stopper import PATIENCE, STANDSTILL, Stopper, abandon, leftovers

T = TypeVar("T")


class Phase(IntEnum):
    """Order in which waiters are woken within one instant."""

    SIMULATE = 0
    BROADCAST = 1
    CONSUME = 2
    WATCH = 3
    END = 4


class Clock(ABC):
    """Source of time on which tasks can wait.

    Attributes:
        epoch: Time at which the clock was made, nanoseconds. Never 0, which means "latest".
        rate: Seconds of the clock per real second; infinite if simulated.
        interrupted: Whether a signal has asked the run on this clock to end. The flag is set when
            the signal arrives, even while a node blocks the event loop.
        when_killed: Functions called before the stopper ends the process, such as one that restores
            the terminal.
        stopper: Stopper that can end the run; None while nothing runs.
    """

    epoch: Stamp
    rate: float
    interrupted: bool
    when_killed: Listeners[()]
    stopper: Stopper | None

    def __init__(self, epoch: Stamp, rate: float) -> None:
        self.epoch = epoch
        self.rate = rate
        self.interrupted = False
        self.when_killed = Listeners()
        self.stopper = None
        self._waiters: list[tuple[Stamp, int, int, int, asyncio.Future[None]]] = []
        # Number of waiters so far: of equal waiters, the first one is woken first.
        self._asked = 0

    @abstractmethod
    def now(self) -> Stamp:
        """Return the current time of the clock in nanoseconds."""

    @abstractmethod
    def new_loop(self) -> asyncio.AbstractEventLoop:
        """Create an event loop that runs in this clock's time."""

    def interrupt(self) -> None:
        """Record that a signal was received, which asks the run to end."""
        self.interrupted = True

    @abstractmethod
    def limit(self, until: Stamp | None) -> None:
        """Set the time after which a node that blocks the event loop is ended.

        Args:
            until: End of the run, nanoseconds; None for no limit.
        """

    @abstractmethod
    def real_timer(self, patience: float) -> "asyncio.Future[None]":
        """Return a future that is done after `patience` real seconds, unless cancelled before."""

    async def wait_for_end(
        self, tasks: "Collection[asyncio.Task[Any]]"
    ) -> "set[asyncio.Task[Any]]":
        """Wait at most `PATIENCE` real seconds (after a signal: without limit) for cancelled tasks.

        Returns:
            The tasks that have not ended.
        """
        waiting = set(tasks)
        timer = self.real_timer(PATIENCE)
        try:
            while waiting and (self.interrupted or not timer.done()):
                also = set() if timer.done() else {timer}
                first = asyncio.FIRST_COMPLETED
                _, pending = await asyncio.wait(waiting | also, return_when=first)
                waiting &= pending
        finally:
            timer.cancel()
        return waiting

    def elapsed(self) -> Duration:
        """Return the nanoseconds since the clock's epoch."""
        return self.now() - self.epoch

    def timer(
        self, stamp: Stamp, phase: Phase = Phase.CONSUME, rank: int = 0
    ) -> "asyncio.Future[None]":
        """Return a future that is done at `stamp`, or at the current time if `stamp` has passed.

        Waiters of one instant are woken in the order of phase, rank and request. To stop the timer,
        cancel the future.

        Raises:
            TypeError: If `stamp` is not a whole number: a fraction of a nanosecond, such as 0.5, is
                likely meant in seconds, and NaN is not a time.
        """
        stamp = whole(stamp)
        future: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._asked += 1
        heapq.heappush(self._waiters, (stamp, phase, rank, self._asked, future))
        return future

    async def sleep_until(self, stamp: Stamp, phase: Phase = Phase.CONSUME, rank: int = 0) -> None:
        """Wait until `stamp`; if `stamp` has passed, wait only until earlier waiters are woken."""
        await self.timer(stamp, phase, rank)

    async def sleep(self, duration: Duration, phase: Phase = Phase.CONSUME, rank: int = 0) -> None:
        """Wait for a duration in nanoseconds of this clock."""
        await self.timer(self.now() + duration, phase, rank)

    def _next_due(self) -> Stamp | None:
        """Return the time of the next waiter; None without waiters. Drop cancelled waiters."""
        while self._waiters:
            if not self._waiters[0][4].done():
                return self._waiters[0][0]
            heapq.heappop(self._waiters)
        return None


class SimClock(Clock):
    """Simulated clock: no time passes while a task runs, and time jumps when all tasks wait.

    Runs of the same program give equal results. One waiter is woken at a time, and all effects of
    this waiter are complete before the next waiter of the same instant is woken.

    Attributes:
        alarms: Number of timers of real time that are set.
        paced: Number of real processes that run beside the world. If the number is not 0, simulated
            time passes no faster than real time, so that these processes keep up.
        held: Number of real processes that must end before simulated time passes.
    """

    def __init__(self, epoch: Stamp = seconds(1000)) -> None:
        """Create a clock that starts at `epoch`, in nanoseconds.

        Raises:
            ValueError: If `epoch` is not after 0; 0 means "latest" in every lookup.
        """
        if epoch <= 0:
            raise ValueError("a simulated clock must start after 0, because stamp 0 means 'latest'")
        super().__init__(epoch, math.inf)
        self.alarms = 0
        self.paced = 0
        self.held = 0
        self._now = epoch

    def now(self) -> Stamp:
        """Return the simulated time in nanoseconds."""
        return self._now

    def timer(
        self, stamp: Stamp, phase: Phase = Phase.CONSUME, rank: int = 0
    ) -> "asyncio.Future[None]":
        """Return a future that is done at `stamp`, or at the current time if `stamp` has passed."""
        return super().timer(max(whole(stamp), self._now), phase, rank)

    def new_loop(self) -> asyncio.AbstractEventLoop:
        """Create an event loop that runs in this clock's time."""
        return VirtualLoop(self)

    def limit(self, until: Stamp | None) -> None:
        """Raise `Overdue` in nodes that block the loop for 20 real s, unless `until` is None."""
        if self.stopper is not None:
            self.stopper.limit(None, None if until is None else STANDSTILL)

    def real_timer(self, patience: float) -> "asyncio.Future[None]":
        """Return a future that is done after `patience` seconds of real, not simulated, time."""
        loop = asyncio.get_running_loop()
        future: asyncio.Future[None] = loop.create_future()

        # A thread wakes the loop, since the loop's own timers count simulated seconds.
        def ring() -> None:
            with contextlib.suppress(RuntimeError):  # the loop has been closed
                loop.call_soon_threadsafe(_set, future)

        alarm = threading.Timer(patience, ring)
        alarm.daemon = True
        # An event from outside will arrive, so simulated time must not end before.
        self.alarms += 1

        def forget(_: "asyncio.Future[None]") -> None:
            self.alarms -= 1
            alarm.cancel()

        future.add_done_callback(forget)
        alarm.start()
        return future

    def wait_really(
        self, loop_timer: float | None, select: Callable[[float | None], list[Any]]
    ) -> list[Any]:
        """Wait in real time until the next timer is due, or a file or thread wakes the event loop.

        Args:
            loop_timer: Seconds until asyncio's own next timer; None if asyncio has no timer.
            select: Function that waits for events of files and threads, at most for the given
                seconds.

        Returns:
            The events. Simulated time has advanced by the real time of the wait.
        """
        due = self._next_due()
        left = None if due is None else (due - self._now) / NANOSECONDS
        if loop_timer is not None:
            left = loop_timer if left is None else min(left, loop_timer)
        began = time.monotonic_ns()
        events = select(left)
        if events:
            passed = time.monotonic_ns() - began
            self._now += passed if left is None else min(passed, int(left * NANOSECONDS))
        return events

    def advance(self, loop_timer: float | None) -> bool:
        """Jump to the next due timer and wake its waiter; return False without a timer.

        The clock's own event loop calls this when every task waits.

        Args:
            loop_timer: Seconds until asyncio's own next timer; None if asyncio has no timer.
        """
        due = self._next_due()
        # Rounded up: if woken a nanosecond early, asyncio would ask again, forever.
        timer = None if loop_timer is None else self._now + math.ceil(loop_timer * NANOSECONDS)
        if due is None and timer is None:
            return False
        # At a tie our waiters are first: data that arrives in time beats its timeout.
        if timer is not None and (due is None or timer < due):
            self._now = timer
            return True
        stamp, _, _, _, future = heapq.heappop(self._waiters)
        self._now = stamp
        future.set_result(None)
        return True


@contextlib.contextmanager
def paced(clock: Clock) -> Iterator[None]:
    """Limit simulated time to the speed of real time inside this block."""
    if isinstance(clock, SimClock):
        clock.paced += 1
    try:
        yield
    finally:
        if isinstance(clock, SimClock):
            clock.paced -= 1


@contextlib.contextmanager
def held(clock: Clock) -> Iterator[None]:
    """Stop simulated time inside this block, in which a real process runs."""
    if isinstance(clock, SimClock):
        clock.held += 1
    try:
        yield
    finally:
        if isinstance(clock, SimClock):
            clock.held -= 1


class WallClock(Clock):
    """Clock of real time since the Unix epoch, optionally faster or slower than real time.

    The system's clock is read once; then a monotonic clock counts. So later corrections of the
    system's clock have no effect.
    """

    def __init__(
        self, rate: float = 1.0, *, epoch: Stamp | None = None, head_start: Duration = 0
    ) -> None:
        """Create a clock that starts now and runs at `rate` times real time.

        Args:
            rate: Seconds of the clock per real second.
            epoch: First time of the clock, nanoseconds, such as a recording's start; None for the
                present time minus `head_start`.
            head_start: Nanoseconds to simulate first as fast as possible, so that the world is
                already moving when a user first sees it.

        Raises:
            ValueError: If `rate` is not between a billionth and a billion, the head start is
                negative, or the epoch is not after 0.
        """
        # Beyond these rates, real durations would not be finite numbers of seconds.
        if not 1e-9 <= rate <= 1e9:
            raise ValueError(f"a rate must be a positive number from 1e-9 to 1e9, not {rate!r}")
        if head_start < 0:
            raise ValueError(f"a head start cannot be negative: {head_start} ns")
        if epoch is not None and epoch <= 0:
            raise ValueError("a clock must start after 0, because stamp 0 means 'latest'")
        super().__init__(time.time_ns() - head_start if epoch is None else epoch, rate)
        self._started = time.monotonic_ns() - round(head_start / rate)
        self._alarm: asyncio.TimerHandle | None = None
        # Until this time, time stands still while any task runs; then it is real.
        self._caught_up = self.epoch + head_start
        self._behind = head_start
        self._simulated: Stamp | None = self.epoch if head_start else None

    def now(self) -> Stamp:
        """Return the time in nanoseconds: Unix time, unless `rate` or `epoch` was given."""
        return self._real() if self._simulated is None else self._simulated

    def _real(self) -> Stamp:
        passed = time.monotonic_ns() - self._started
        return self.epoch + (passed if self.rate == 1.0 else round(passed * self.rate))

    def new_loop(self) -> asyncio.AbstractEventLoop:
        """Create an ordinary asyncio event loop."""
        return asyncio.new_event_loop()

    def timer(
        self, stamp: Stamp, phase: Phase = Phase.CONSUME, rank: int = 0
    ) -> "asyncio.Future[None]":
        """Return a future that is done at `stamp`, or at the current time if `stamp` has passed."""
        future = super().timer(stamp, phase, rank)
        if self._waiters[0][4] is future:
            self._set_alarm()
        return future

    def limit(self, until: Stamp | None) -> None:
        """Set the time after which a node that blocks the event loop is ended."""
        if self.stopper is not None:
            wait = None if until is None else (until - self.now()) / (NANOSECONDS * self.rate)
            # A thread cannot wait longer than some hundred years.
            self.stopper.limit(None if wait is None or wait > 1e9 else max(wait, 0.0))

    def real_timer(self, patience: float) -> "asyncio.Future[None]":
        """Return a future that is done after `patience` real seconds, at any rate."""
        loop = asyncio.get_running_loop()
        future: asyncio.Future[None] = loop.create_future()
        alarm = loop.call_later(patience, _set, future)
        future.add_done_callback(lambda _: alarm.cancel())
        return future

    def _set_alarm(self) -> None:
        if self._alarm is not None:
            self._alarm.cancel()
            self._alarm = None
        due = self._next_due()
        if self._simulated is not None:
            self._alarm = asyncio.get_running_loop().call_later(0, self._wake)
        elif due is not None:
            # A wait longer than the largest stamp is split in two.
            delay = max(0, min(due - self.now(), 2**63)) / (NANOSECONDS * self.rate)
            self._alarm = asyncio.get_running_loop().call_later(delay, self._wake)

    def _wake(self) -> None:
        if self._alarm is not None:
            self._alarm.cancel()
            self._alarm = None
        if self._simulated is not None and _others_wait_their_turn():
            asyncio.get_running_loop().call_soon(self._wake)
            return
        due = self._next_due()
        if self._simulated is not None:
            self._simulated = self._moment_before_now(due, self._simulated)
        if due is None or due > self.now():
            self._set_alarm()
            return
        heapq.heappop(self._waiters)[4].set_result(None)
        # The woken task takes its step before the next waiter of the instant is woken.
        asyncio.get_running_loop().call_soon(self._wake)

    def _moment_before_now(self, due: Stamp | None, moment: Stamp) -> Stamp | None:
        """Return the next simulated time of the head start; None if the head start is over."""
        real = self._real()
        behind = real - self._caught_up
        if due is not None and self._caught_up < due <= real and behind <= self._behind // 2:
            # Simulating the last part of the past took real time; what became due meanwhile is
            # simulated as well, which takes less time.
            self._caught_up, self._behind = real, behind
        if due is not None and due <= self._caught_up:
            return max(due, moment)
        if due is not None and due <= real:
            # This world is no faster than real time: a clock behind the system's clock is better
            # than many timers that are late at once.
            self._started += round(behind / self.rate)
        return None


class FollowedClock(WallClock):
    """Clock that shows real time until `tell` sets a time; then only `tell` moves the time.

    A world that shares a session (a group of processes that exchange frames) uses this clock. While
    another process publishes `/clock`, for example to play a recording, this clock shows the
    published time. A waiter keeps its remaining duration when time falls back, or when the source
    of time changes.

    Attributes:
        fell_back: Functions called with the nanoseconds by which time has fallen back.
    """

    def __init__(self, fixed_time: Stamp | None = None, *, epoch: Stamp | None = None) -> None:
        """Create a clock that shows real time, or a fixed time until another time is set.

        Args:
            fixed_time: Fixed time in nanoseconds; None for real time. At time 0, which is not a
                valid time, all waiters wait for the first time that is set.
            epoch: Time at which the clock began; None for `fixed_time` if given, else the present.
        """
        super().__init__(epoch=(fixed_time or None) if epoch is None else epoch)
        self.fell_back: Listeners[Duration] = Listeners()
        self._told = fixed_time
        self._first: asyncio.Future[None] | None = None

    @property
    def is_told(self) -> bool:
        """Whether the clock shows a time that was set, not real time."""
        return self._told is not None

    def now(self) -> Stamp:
        """Return the last time set by `tell`; before `tell` and after `run_on`, real time."""
        return super().now() if self._told is None else self._told

    def tell(self, moment: Stamp) -> None:
        """Set the time; call this in the event loop that runs on this clock.

        Args:
            moment: Time in nanoseconds; 0 and less, which are not valid times, count as 1.
        """
        before, last_told = self.now(), self._told
        self._told = max(moment, 1)
        change = self._told - before
        if not last_told:
            self.epoch = self._told
            # From here on, waiting in real time is no sign that a node blocks the loop.
            self.limit(None)
        if last_told is None or change < 0:
            self._shift(change)
        self._set_alarm()
        if self._first is not None:
            _set(self._first)
        if change < 0 and last_told is not None:
            self.fell_back.call(-change)

    async def wait_until_told(self, patience: Duration) -> None:
        """Wait until `tell` has set a time, at most `patience` nanoseconds of real time."""
        first = self._first = asyncio.get_running_loop().create_future()
        if self.is_told:
            first.set_result(None)
        timer = self.real_timer(patience / NANOSECONDS)
        try:
            await asyncio.wait({first, timer}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            timer.cancel()

    def run_on(self) -> None:
        """Continue in real time from the time that the clock was last set to."""
        if self._told is not None:
            self._started = time.monotonic_ns() - (self._told - self.epoch)
            self._told = None
            self._set_alarm()

    def limit(self, until: Stamp | None) -> None:
        """Set the time after which a blocking node is ended; no limit while `is_told`."""
        super().limit(None if self.is_told else until)

    def _shift(self, change: Duration) -> None:
        """Move every wake-up time by `change` nanoseconds, so that remaining waits stay equal."""
        self._waiters = [
            (stamp + change, phase, rank, asked, future)
            for stamp, phase, rank, asked, future in self._waiters
        ]
        heapq.heapify(self._waiters)

    def _set_alarm(self) -> None:
        if self._told is None:
            super()._set_alarm()
            return
        if self._alarm is not None:
            self._alarm.cancel()
            self._alarm = None
        due = self._next_due()
        if due is not None and 0 < self._told >= due:
            self._alarm = asyncio.get_running_loop().call_later(0, self._wake)


def pace_of(clock: Clock) -> Clock:
    """Return the clock for waits that should take real time, such as "print every second".

    If another process sets the time of `clock`, and so can pause or speed up time, a new clock of
    real time is returned; else `clock` itself.
    """
    if not isinstance(clock, FollowedClock):
        return clock
    pace = WallClock()
    pace.stopper = clock.stopper
    return pace


def _set(future: "asyncio.Future[None]") -> None:
    if not future.done():
        future.set_result(None)


def _others_wait_their_turn() -> bool:
    """Return whether the running event loop has ready callbacks; asyncio has no public test."""
    return bool(getattr(asyncio.get_running_loop(), "_ready", ()))


def run(clock: Clock, main: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine to its end on an event loop of `clock`.

    The first SIGINT or SIGTERM cancels the coroutine, so that every `finally` runs. Code that does
    not end in two seconds is named on stderr. A second signal ends the process at once, with status
    130.

    Returns:
        Result of the coroutine.

    Raises:
        KeyboardInterrupt: If a signal ended the run; its `__cause__` is an error that occurred
            while the run was being ended, or None.
        Exception: Any exception of the coroutine, or of a task that the coroutine started.
    """
    loop = clock.new_loop()
    clock.interrupted = False
    try:
        asyncio.set_event_loop(loop)
        task = loop.create_task(main)
        # After the task exists, so that a signal always finds something to cancel.
        now = time.monotonic  # noqa: TID251
        stopper = Stopper(loop, task, now, clock.interrupt, clock.when_killed)
        clock.stopper = stopper
        try:
            return _outcome(clock, loop, task)
        finally:
            clock.stopper = None
            stopper.close()
            loop.run_until_complete(loop.shutdown_asyncgens())
    finally:
        asyncio.set_event_loop(None)
        loop.close()


def _outcome(clock: Clock, loop: asyncio.AbstractEventLoop, task: "asyncio.Task[T]") -> T:
    """Run a task, and tasks that it left running, to their end; return the task's result."""
    failure: BaseException | None = None
    try:
        loop.run_until_complete(task)
    except BaseException as error:
        failure = error
    # Tasks that are left after the main one are cancelled, so that their `finally` runs.
    left_failure = _cancel_leftovers(clock, loop)
    # If a left task failed, a cancellation of the main task is only the consequence.
    if failure is None or isinstance(failure, asyncio.CancelledError):
        failure = left_failure or failure
    if clock.interrupted and (failure is None or isinstance(failure, Exception)):
        raise KeyboardInterrupt from failure
    # The exception is a consequence of the signal.
    if clock.interrupted:
        raise KeyboardInterrupt from None
    if failure is not None:
        raise failure
    return task.result()


def _cancel_leftovers(clock: Clock, loop: asyncio.AbstractEventLoop) -> BaseException | None:
    """Cancel the tasks that still run on a loop; return the first exception of these tasks."""

    async def cancel(tasks: "set[asyncio.Task[Any]]") -> BaseException | None:
        for task in tasks:
            task.cancel()
        # Tasks that do not end in time must not block the end of the program.
        for task in await clock.wait_for_end(tasks):
            abandon(task)
        for task in tasks:
            if task.done() and not task.cancelled() and (error := task.exception()) is not None:
                return error
        return None

    left = leftovers(loop)
    if not left:
        return None
    ending = loop.create_task(cancel(left))
    try:
        return loop.run_until_complete(ending)
    finally:
        # The loop itself may fail: nothing may be pending when it is closed.
        if not ending.done():
            abandon(ending)
            ending.get_coro().close()


class VirtualLoop(asyncio.SelectorEventLoop):
    """Event loop that runs in the time of a simulated clock."""

    def __init__(self, clock: "SimClock") -> None:
        # Before the base class, whose constructor calls `time`.
        self.clock = clock
        super().__init__(_VirtualSelector(self))

    def time(self) -> float:
        """Return the clock's time in seconds, for asyncio's own timers."""
        return self.clock.now() / NANOSECONDS

    def is_forsaken(self) -> bool:
        """Return whether nothing can wake this loop any more: no file, thread or real timer."""
        selector: Any = getattr(self, "_selector", None)
        # One file is always registered: the loop's own wake-up pipe.
        files = 0 if selector is None else len(selector.get_map())
        helpers = getattr(self, "_default_executor", None), self.clock.alarms, self.clock.paced
        return files <= 1 and not any(helpers)


class _VirtualSelector(selectors.DefaultSelector):
    """Selector of a virtual loop, which advances the clock instead of waiting."""

    POLL_EVERY = 64

    def __init__(self, loop: VirtualLoop) -> None:
        super().__init__()
        self._loop = loop
        self._calls = 0

    def select(self, timeout: float | None = None) -> Any:
        """Return events of files and threads; if no task can run, advance time without waiting."""
        # A real poll is a system call, which is too slow for each of a million time jumps.
        self._calls += 1
        # The loop always watches one file, its own wake-up pipe.
        if self._calls % self.POLL_EVERY == 0 or len(self.get_map()) > 1:
            events = super().select(0)
            if events:
                return events
        if timeout is not None and timeout <= 0:
            return []
        clock = self._loop.clock
        if clock.held:
            return super().select(None)
        if clock.paced and (events := clock.wait_really(timeout, super().select)):
            return events
        # Every task sleeps, so time jumps to the next timer, which is then due.
        if clock.advance(timeout):
            return []
        if self._loop.is_forsaken():
            raise TftoolError(
                "every task waits, but no timer is due, so this run would never end: pass "
                "'until', or start a timer."
            )
        # A thread or a file may still wake the loop, so wait for that in real time.
        return super().select(None)
