"""Locks, conditions, semaphores and events for the threads of users' programs.

Timeouts count seconds of tftool's clock. On the simulated clock, the event loop continues while one
thread waits for another.
"""

import asyncio
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from tftool.base.stamps import Duration, seconds
from tftool.ros.host import fibers

T = TypeVar("T")


def running_program() -> Any:
    """Return the program that the calling thread belongs to; None for other threads."""
    fiber = fibers.current()
    return None if fiber is None else fiber.owner


class StateMonitor:
    """State shared by several threads, which can wait until another thread changes the state.

    The inner mutex is held only briefly, never while a thread waits.
    """

    def __init__(self) -> None:
        self._mutex = threading.Lock()
        self._wakers: list[Callable[[], object]] = []

    @contextmanager
    def changing(self) -> Iterator[None]:
        """Hold the mutex in the `with` block, which changes the state; then wake all waiters."""
        with self._mutex:
            yield
            for wake in self._wakers:
                wake()

    def wait(self, attempt: Callable[[], bool], timeout: float | None = None) -> bool:
        """Call `attempt` at once and after every change of the state, until `attempt` returns True.

        Args:
            attempt: Function that checks the state and may change it, called under the mutex.
            timeout: Longest wait in seconds: of tftool's clock in a program's thread, of real time
                in any other thread. None for no limit, 0 to check once.

        Returns:
            Whether `attempt` returned True in time.

        Raises:
            KeyboardInterrupt: If the program is interrupted during the wait.
        """
        with self._mutex:
            if attempt():
                return True
        owner = running_program()
        if timeout is not None and timeout <= 0.0:
            if owner is not None:
                owner.count_failed_query()
            return False
        if owner is None:
            return self._block(attempt, timeout)
        length = None if timeout is None else seconds(timeout)
        return bool(owner.ask(lambda: self._wait(owner, attempt, length)))

    def sleep(self, owner: Any, length: Duration, is_over: Callable[[], bool]) -> None:
        """Block the calling thread until `is_over` returns True, at most for the time `length`.

        `is_over` is called after every change of the state; `length` is in nanoseconds of tftool's
        clock.
        """
        if not owner.interrupted:
            owner.ask(lambda: self._wait(owner, is_over, max(0, length)))

    def wake(self) -> None:
        """Wake every waiting thread to check the state again."""
        with self.changing():
            pass

    async def _wait(self, owner: Any, take: Callable[[], bool], length: Duration | None) -> bool:
        loop = asyncio.get_running_loop()
        end = None if length is None else owner.clock.now() + length
        is_late = False
        while True:
            changed: asyncio.Future[None] = loop.create_future()

            def wake(changed: "asyncio.Future[None]" = changed) -> None:
                loop.call_soon_threadsafe(fibers.finish, changed)

            with self._mutex:
                if take():
                    return True
                if is_late:
                    return False
                self._wakers.append(wake)
            try:
                is_late = not await owner.first_of(changed, until=end)
            finally:
                with self._mutex:
                    self._wakers.remove(wake)

    def _block(self, attempt: Callable[[], bool], timeout: float | None) -> bool:
        """Wait until `attempt` returns True; return False after `timeout` real seconds.

        Only threads that belong to no user's program wait in real time.
        """
        changed = threading.Event()
        while True:
            with self._mutex:
                if attempt():
                    return True
                changed.clear()
                self._wakers.append(changed.set)
            try:
                in_time = changed.wait(timeout)
            finally:
                with self._mutex:
                    self._wakers.remove(changed.set)
            if not in_time:
                with self._mutex:
                    return attempt()


def _limit(blocking: bool, timeout: float | None) -> float | None:
    """Convert the arguments of `Lock.acquire` to a timeout for `StateMonitor.wait`.

    Raises:
        ValueError: For the arguments that Python's own locks refuse.
    """
    if timeout is None or timeout == -1:
        return None if blocking else 0.0
    if not blocking:
        raise ValueError("can't specify a timeout for a non-blocking call")
    if timeout < 0:
        raise ValueError("timeout value must be a non-negative number")
    return float(timeout)


class UserLock:
    """Replacement of `threading.Lock` whose timeouts count seconds of tftool's clock."""

    def __init__(self) -> None:
        self._state = StateMonitor()
        self._held = False

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Acquire the lock; return False if the timeout passes first."""
        return self._state.wait(self._take, _limit(blocking, timeout))

    def _take(self) -> bool:
        free, self._held = not self._held, True
        return free

    def release(self) -> None:
        """Release the lock.

        Raises:
            RuntimeError: If the lock is not held.
        """
        with self._state.changing():
            if not self._held:
                raise RuntimeError("release unlocked lock")
            self._held = False

    def locked(self) -> bool:
        """Return whether a thread holds the lock."""
        return self._held

    _is_owned = locked  # A condition calls this; its default counts as polling.

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *args: object) -> None:
        self.release()


# The other classes are the standard library's, based on these locks and conditions.


class UserRLock(threading._RLock):  # type: ignore[misc]
    """Replacement of `threading.RLock` whose timeouts count seconds of tftool's clock."""

    def __init__(self) -> None:
        super().__init__()
        self._block: Any = UserLock()


class UserCondition(threading.Condition):
    """Replacement of `threading.Condition` whose timeouts count seconds of tftool's clock."""

    _waiters: Any

    def __init__(self, lock: Any = None) -> None:
        super().__init__(UserRLock() if lock is None else lock)

    def wait(self, timeout: float | None = None) -> bool:
        """Release the lock, block until notified, and acquire the lock again.

        Returns:
            Whether a notification came before the timeout.

        Raises:
            RuntimeError: If the lock is not held.
        """
        parts: Any = self
        if not parts._is_owned():
            raise RuntimeError("cannot wait on un-acquired lock")
        waiter, is_notified = UserLock(), False
        waiter.acquire()
        self._waiters.append(waiter)
        held = parts._release_save()
        try:
            is_notified = waiter.acquire(timeout=-1 if timeout is None else max(0.0, timeout))
            return is_notified
        finally:
            parts._acquire_restore(held)
            if not is_notified and waiter in self._waiters:
                self._waiters.remove(waiter)

    def wait_for(self, predicate: Callable[[], T], timeout: float | None = None) -> T:
        """Block until `predicate()` is true or the timeout passes; return the last result."""
        owner = running_program()
        start = 0 if owner is None else owner.now()
        left, result = timeout, predicate()
        while not result and (left is None or left > 0.0):
            in_time = self.wait(left)
            result = predicate()
            if timeout is not None:
                passed = 0.0 if owner is None else (owner.now() - start) / 1e9
                left = timeout - passed if in_time else 0.0
        return result


class UserSemaphore(threading.Semaphore):
    """Replacement of `threading.Semaphore` whose timeouts count seconds of tftool's clock."""

    _value: int

    def __init__(self, value: int = 1) -> None:
        super().__init__(value)
        self._cond: Any = UserCondition(UserLock())

    def acquire(self, blocking: bool = True, timeout: float | None = None) -> bool:
        """Wait until the counter is above 0, then decrement it; return False at the timeout."""
        limit = _limit(blocking, timeout)
        with self._cond:
            if limit == 0.0 and not self._value:
                self._cond.wait(0.0)  # which counts as polling
            is_free = bool(self._cond.wait_for(lambda: self._value, limit))
            self._value -= is_free
        return is_free

    __enter__ = acquire


class UserBoundedSemaphore(UserSemaphore, threading.BoundedSemaphore):
    """Replacement of `threading.BoundedSemaphore` with timeouts in seconds of tftool's clock."""


class UserEvent(threading.Event):
    """Replacement of `threading.Event` whose timeouts count seconds of tftool's clock."""

    def __init__(self) -> None:
        super().__init__()
        self._cond: Any = UserCondition(UserLock())

    def wait(self, timeout: float | None = None) -> bool:
        """Block until the event is set; return False if the timeout passes first."""
        owner = running_program()
        if owner is None or not owner.is_told:
            return super().wait(timeout)
        owner.wait_after_end(self.is_set, None if timeout is None else seconds(timeout))
        return self.is_set()


class UserBarrier(threading.Barrier):
    """Replacement of `threading.Barrier` whose timeouts count seconds of tftool's clock."""

    def __init__(
        self, parties: int, action: Callable[[], None] | None = None, timeout: float | None = None
    ) -> None:
        super().__init__(parties, action, timeout)
        self._cond: Any = UserCondition(UserLock())
