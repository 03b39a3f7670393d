"""Threads, thread pools and processes of users' programs, which take turns on the world's clock."""

import concurrent.futures
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from functools import cache, partial
from typing import Any

from tftool.base.stamps import NANOSECONDS, seconds
from tftool.ros.host import locks
from tftool.ros.host.error_text import error_sentence
from tftool.ros.host.fibers import Fiber
from tftool.ros.host.locks import running_program

Future = concurrent.futures.Future[Any]


def elapsed_ns() -> int:
    """Return the nanoseconds on tftool's clock since the run began; real time outside a program."""
    owner = running_program()
    return time.monotonic_ns() if owner is None else owner.now() - owner.clock.epoch


class UserThread(threading.Thread):
    """Replacement of `threading.Thread` that runs as a fiber of the calling user's program."""

    _fiber: Fiber | None = None

    def start(self) -> None:
        """Start the thread as a fiber of the calling program.

        If the caller belongs to no program, start an ordinary Python thread.
        """
        owner = running_program()
        if owner is None:
            super().start()
            return
        self._owner = owner
        self._fiber = fiber = owner.new_fiber(self.name, self._run_and_log)
        # The task is in a list, because `ask` would await a task itself.
        (self._task,) = owner.ask(lambda: [owner.start_fiber(fiber)])

    def _run_and_log(self) -> None:
        """Run the thread's function and log its exception; the program's other threads continue."""
        try:
            self.run()
        except Exception as error:
            sentence = f"thread '{self.name}' failed: {error_sentence(error)}"
            self._owner.ask(lambda: self._owner.error(sentence))

    def join(self, timeout: float | None = None) -> None:
        """Block until the thread has ended or the timeout has passed."""
        if self._fiber is None:
            super().join(timeout)
            return
        owner, fiber = self._owner, self._fiber
        length = None if timeout is None else seconds(max(0.0, timeout))
        if owner.is_told:
            owner.wait_after_end(lambda: fiber.ended, length)
            return
        end = None if length is None else owner.clock.now() + length
        owner.ask(lambda: owner.first_of(self._task, until=end))

    def is_alive(self) -> bool:
        """Return whether the thread was started and has not ended."""
        return super().is_alive() if self._fiber is None else not self._fiber.ended


class UserTimer(UserThread, threading.Timer):
    """Replacement of `threading.Timer` that waits in seconds of tftool's clock."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.finished: Any = locks.UserEvent()


class UserFuture(concurrent.futures.Future[Any]):
    """Future of a `UserThreadPool`; the future's timeouts count seconds of tftool's clock."""

    def __init__(self) -> None:
        super().__init__()
        self._condition = locks.UserCondition()


class UserThreadPool(concurrent.futures.ThreadPoolExecutor):
    """Replacement of `ThreadPoolExecutor` whose threads run as fibers of the user's program."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._jobs: deque[Any] = deque()
        self._changed = locks.UserCondition()
        self._workers: list[UserThread] = []
        self._idle = 0

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future:
        """Let a thread of the pool call `fn`; return a future for the result."""
        if running_program() is None:
            return super().submit(fn, *args, **kwargs)
        if self._shutdown:
            raise RuntimeError("cannot schedule new futures after shutdown")
        future = UserFuture()
        self._add((future, partial(fn, *args, **kwargs)))
        if len(self._jobs) > self._idle and len(self._workers) < self._max_workers:
            name = f"{self._thread_name_prefix}_{len(self._workers)}"
            self._workers.append(UserThread(target=self._work, name=name))
            self._workers[-1].start()
        return future

    def _add(self, job: tuple[Future, Callable[[], Any]] | None) -> None:
        with self._changed:
            self._jobs.append(job)
            self._changed.notify()

    def _work(self) -> None:
        if self._initializer is not None:
            self._initializer(*self._initargs)
        while True:
            with self._changed:
                self._idle += 1
                self._changed.wait_for(lambda: self._jobs)
                self._idle -= 1
                job = self._jobs.popleft()
            if job is None:
                return
            future, call = job
            if not future.set_running_or_notify_cancel():
                continue
            try:
                result = call()
            except BaseException as error:
                future.set_exception(error)
            else:
                future.set_result(result)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Refuse further calls; with `wait`, block until the pool's threads have ended."""
        super().shutdown(wait, cancel_futures=cancel_futures)
        if cancel_futures:
            with self._changed:
                jobs, self._jobs = self._jobs, deque()
            for future, _ in filter(None, jobs):
                future.cancel()
        for _ in self._workers:
            self._add(None)
        for worker in self._workers if wait else ():
            worker.join()


def wait_for_futures(
    fs: Iterable[Future],
    timeout: float | None = None,
    return_when: str = concurrent.futures.ALL_COMPLETED,
) -> Any:
    """Block until some or all futures are done, as `concurrent.futures.wait` does."""
    futures = set(fs)
    state = locks.StateMonitor()

    def is_over() -> bool:
        done = [one for one in futures if one.done()]
        if return_when == concurrent.futures.FIRST_COMPLETED and done:
            return True
        failed = (one for one in done if not one.cancelled() and one.exception() is not None)
        if return_when == concurrent.futures.FIRST_EXCEPTION and any(failed):
            return True
        return len(done) == len(futures)

    for one in futures:
        one.add_done_callback(lambda _: state.wake())
    state.wait(is_over, timeout)
    # This returns at once, with the standard library's own type.
    return concurrent.futures.wait(futures, 0.0)


def as_completed(fs: Iterable[Future], timeout: float | None = None) -> Iterator[Future]:
    """Yield each future when it is done, as `concurrent.futures.as_completed` does."""
    left, end = set(fs), None if timeout is None else elapsed_ns() + seconds(timeout)
    while left:
        rest = None if end is None else max(0, end - elapsed_ns()) / NANOSECONDS
        done, left = wait_for_futures(left, rest, concurrent.futures.FIRST_COMPLETED)
        if not done:
            raise TimeoutError(f"{len(left)} futures are not finished")
        yield from done


@cache
def process_class() -> Any:
    """Return the replacement of `multiprocessing.Process`, whose import is slow."""
    import multiprocessing

    class Process(multiprocessing.Process):
        """Replacement of `multiprocessing.Process`.

        A function that mentions rclpy runs as a program of the world. Any other function runs in a
        child process as usual.
        """

        _program: Any = None

        def start(self) -> None:
            """Start the function as a program of the caller's world, or in a child process.

            The function becomes a program if it mentions rclpy.
            """
            owner = running_program()
            kind: Any = type(self)
            given: Any = self
            function = kind.run if kind.run is not multiprocessing.Process.run else given._target
            code = getattr(getattr(function, "__func__", function), "__code__", None)
            if owner is None or code is None or "rclpy" not in code.co_names:
                super().start()
                return
            self._state = locks.StateMonitor()
            owner.has_started_programs = True
            self._program = owner.ask(
                lambda: type(owner)(
                    owner.world,
                    owner.world.free_name(self.name),
                    self.run,
                    argv=owner.argv,
                    options=owner.options,
                    on_exit=self._ended,
                )
            )

        def _ended(self, program: Any) -> None:
            if program.status and isinstance(program.failure, Exception):
                text = f"process '{program.name}' failed: {error_sentence(program.failure)}"
                program.say("ERROR", program.name, text)
            self._state.wake()

        def join(self, timeout: float | None = None) -> None:
            """Block until the process has ended or the timeout has passed."""
            if self._program is None:
                super().join(timeout)
            else:
                self._state.wait(lambda: self._program.status is not None, timeout)

        def is_alive(self) -> bool:
            """Return whether the process was started and has not ended."""
            return super().is_alive() if self._program is None else self.exitcode is None

        @property
        def exitcode(self) -> int | None:
            """Exit status of the process; None before its end."""
            if self._program is None:
                return super().exitcode
            return self._program.status  # type: ignore[no-any-return]

        def terminate(self) -> None:
            """End the process, as Ctrl-C ends a node."""
            if self._program is None:
                super().terminate()
            else:
                self._program.ask(lambda: self._program.world.remove(self._program))

        kill = terminate

    return Process
