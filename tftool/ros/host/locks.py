"""Locks, conditions, semaphores and events between the threads of users' programs.

They wait in the world's time: on the simulated clock the event loop goes on while a thread waits
for another, and a timeout means simulated seconds.
"""

import asyncio
import threading
from collections import deque
from collections.abc import Callable
from typing import Any, TypeVar

from tftool.base.stamps import seconds
from tftool.ros.host import fibers

T = TypeVar("T")


def running_program() -> Any:
    """Return the program of the running fiber; None on every other thread."""
    fiber = fibers.current()
    return None if fiber is None else fiber.owner


class StateMonitor:
    """State that threads change and wait for.

    The inner mutex is held only briefly, never while a thread waits.
    """

    def __init__(self) -> None:
        self._mutex = threading.Lock()
        self._wakers: list[Callable[[], object]] = []

    def change(self, update: Callable[[], T]) -> T:
        """Change the state, and wake every waiting thread to check it.

        Returns:
            The result of `update`, whose exceptions pass through.
        """
        with self._mutex:
            try:
                return update()
            finally:
                for wake in self._wakers:
                    wake()

    def wait(self, take: Callable[[], bool], timeout: float | None = None) -> bool:
        """Block until `take`, which checks and may change the state, returns True.

        Args:
            take: Called with the state held.
            timeout: Seconds to wait at most: the world's in a program's thread, real ones in
                any other. None for no limit, 0 to look once.

        Returns:
            Whether it did so in time.

        Raises:
            KeyboardInterrupt: If the program was asked to end while it waited.
        """
        with self._mutex:
            if take():
                return True
        owner = running_program()
        if timeout is not None and timeout <= 0.0:
            if owner is not None:
                owner.looked_in_vain()
            return False
        if owner is None:
            return self._block(take, timeout)
        return bool(owner.ask(lambda: self._wait(owner, take, timeout)))

    async def _wait(self, owner: Any, take: Callable[[], bool], timeout: float | None) -> bool:
        loop, clock = asyncio.get_running_loop(), owner.clock
        timer = None
        if timeout is not None:
            timer = clock.timer(clock.now() + seconds(timeout), owner.turn, owner.rank)
        try:
            while True:
                changed: asyncio.Future[None] = loop.create_future()

                def wake(changed: "asyncio.Future[None]" = changed) -> None:
                    loop.call_soon_threadsafe(fibers.finish, changed)

                with self._mutex:
                    if take():
                        return True
                    if timer is not None and timer.done():
                        return False
                    self._wakers.append(wake)
                try:
                    waits_for = {changed} if timer is None else {changed, timer}
                    await asyncio.wait(waits_for, return_when=asyncio.FIRST_COMPLETED)
                finally:
                    with self._mutex:
                        self._wakers.remove(wake)
        finally:
            if timer is not None:
                timer.cancel()

    def _block(self, take: Callable[[], bool], timeout: float | None) -> bool:
        """Wait in real time, on a thread that belongs to no program."""
        changed = threading.Event()
        while True:
            with self._mutex:
                if take():
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
                    return take()


def _limit(blocking: bool, timeout: float | None) -> float | None:
    """Return the timeout given to `acquire` in the form of `StateMonitor.wait`.

    Raises:
        ValueError: As in Python's own locks.
    """
    if timeout is None or timeout == -1:
        return None if blocking else 0.0
    if not blocking:
        raise ValueError("can't specify a timeout for a non-blocking call")
    if timeout < 0:
        raise ValueError("timeout value must be a non-negative number")
    return float(timeout)


class UserLock:
    """`threading.Lock` in the world's time."""

    def __init__(self) -> None:
        self._state = StateMonitor()
        self._held = False

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Take the lock; return whether that succeeded in time."""
        return self._state.wait(self._take, _limit(blocking, timeout))

    def _take(self) -> bool:
        free, self._held = not self._held, True
        return free

    def release(self) -> None:
        """Release the lock.

        Raises:
            RuntimeError: If it is not held.
        """

        def free() -> None:
            if not self._held:
                raise RuntimeError("release unlocked lock")
            self._held = False

        self._state.change(free)

    def locked(self) -> bool:
        """Whether it is held."""
        return self._held

    def is_owned(self) -> bool:
        """Whether a condition may assume that the caller holds it."""
        return self._held

    def release_whole(self) -> int:
        """Release it for a condition's wait; return how often to take it again."""
        self.release()
        return 1

    def acquire_whole(self, count: int) -> None:
        """Take it again after a condition's wait."""
        self.acquire()

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *args: object) -> None:
        self.release()


class UserRLock:
    """`threading.RLock` in the world's time."""

    def __init__(self) -> None:
        self._state = StateMonitor()
        self._owner = 0
        self._count = 0

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Take the lock, again if this thread holds it; return whether that succeeded in time."""
        return self._take(1, _limit(blocking, timeout))

    def _take(self, count: int, limit: float | None) -> bool:
        # `take` may run on the loop's thread for this one.
        thread = threading.get_ident()

        def take() -> bool:
            if self._count and self._owner != thread:
                return False
            self._owner, self._count = thread, self._count + count
            return True

        return self._state.wait(take, limit)

    def release(self) -> None:
        """Release it once.

        Raises:
            RuntimeError: If this thread does not hold it.
        """
        self._give(1)

    def _give(self, count: int) -> None:
        if not self.is_owned():
            raise RuntimeError("cannot release un-acquired lock")

        def free() -> None:
            self._count -= count

        self._state.change(free)

    def is_owned(self) -> bool:
        """Whether this thread holds it."""
        return bool(self._count) and self._owner == threading.get_ident()

    def release_whole(self) -> int:
        """Release it for a condition's wait; return how often to take it again."""
        count = self._count
        self._give(count)
        return count

    def acquire_whole(self, count: int) -> None:
        """Take it again after a condition's wait."""
        self._take(count, None)

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *args: object) -> None:
        self.release()


class UserCondition:
    """`threading.Condition` in the world's time."""

    def __init__(self, lock: Any = None) -> None:
        self._lock = UserRLock() if lock is None else lock
        self.acquire, self.release = self._lock.acquire, self._lock.release
        self._state = StateMonitor()
        self._waiting: deque[object] = deque()

    def __enter__(self) -> Any:
        return self._lock.__enter__()

    def __exit__(self, *args: object) -> None:
        self._lock.__exit__(*args)

    def wait(self, timeout: float | None = None) -> bool:
        """Release the lock, block until notified, and take the lock again.

        Returns:
            Whether it was notified in time.

        Raises:
            RuntimeError: If the lock is not held.
        """
        self._check("wait on")
        token = object()
        self._waiting.append(token)
        count = self._lock.release_whole()
        try:
            return self._state.wait(lambda: token not in self._waiting, timeout)
        finally:
            if token in self._waiting:
                self._waiting.remove(token)
            self._lock.acquire_whole(count)

    def wait_for(self, predicate: Callable[[], T], timeout: float | None = None) -> T:
        """Block until a predicate is true; return its last value."""
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

    def notify(self, n: int = 1) -> None:
        """Wake up to `n` waiting threads.

        Raises:
            RuntimeError: If the lock is not held.
        """
        self._check("notify on")

        def pick() -> None:
            for _ in range(min(n, len(self._waiting))):
                self._waiting.popleft()

        self._state.change(pick)

    def notify_all(self) -> None:
        """Wake all waiting threads."""
        self.notify(len(self._waiting))

    def _check(self, verb: str) -> None:
        if not self._lock.is_owned():
            raise RuntimeError(f"cannot {verb} un-acquired lock")


class UserSemaphore:
    """`threading.Semaphore` in the world's time."""

    def __init__(self, value: int = 1) -> None:
        if value < 0:
            raise ValueError("semaphore initial value must be >= 0")
        self._state = StateMonitor()
        self._value = value

    def acquire(self, blocking: bool = True, timeout: float | None = None) -> bool:
        """Take one; return whether that succeeded in time."""
        return self._state.wait(self._take, _limit(blocking, timeout))

    def _take(self) -> bool:
        if self._value == 0:
            return False
        self._value -= 1
        return True

    def release(self, n: int = 1) -> None:
        """Release `n`."""
        if n < 1:
            raise ValueError("n must be one or more")

        def give() -> None:
            self._check(n)
            self._value += n

        self._state.change(give)

    def _check(self, n: int) -> None:
        """Refuse to exceed the initial value."""

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *args: object) -> None:
        self.release()


class UserBoundedSemaphore(UserSemaphore):
    """`threading.BoundedSemaphore` in the world's time."""

    def __init__(self, value: int = 1) -> None:
        super().__init__(value)
        self._most = value

    def _check(self, n: int) -> None:
        if self._value + n > self._most:
            raise ValueError("Semaphore released too many times")


class UserEvent:
    """`threading.Event` in the world's time."""

    def __init__(self) -> None:
        self._state = StateMonitor()
        self._set = False

    def is_set(self) -> bool:
        """Whether it is set."""
        return self._set

    def set(self) -> None:
        """Set it, and wake all waiting threads."""
        self._put(True)

    def clear(self) -> None:
        """Unset it."""
        self._put(False)

    def _put(self, value: bool) -> None:
        def put() -> None:
            self._set = value

        self._state.change(put)

    def wait(self, timeout: float | None = None) -> bool:
        """Block until it is set; return whether it is."""
        owner = running_program()
        if owner is not None and owner.interrupted:
            return self._set
        return self._state.wait(self.is_set, timeout)


class UserBarrier(threading.Barrier):
    """`threading.Barrier` in the world's time."""

    def __init__(
        self, parties: int, action: Callable[[], None] | None = None, timeout: float | None = None
    ) -> None:
        super().__init__(parties, action, timeout)
        # The class of the standard library does everything by this condition.
        self._cond: Any = UserCondition(UserLock())
