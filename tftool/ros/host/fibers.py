"""Fibers: threads in which users' code runs and blocks, taking turns with the event loop.

Code on a fiber may block as ROS nodes do (`rclpy.spin`, `time.sleep`, `client.call`). The thread
never touches tftool's world itself: it sends a request, the event loop executes the request,
and the thread sleeps until the result arrives. For the loop, a fiber is like a coroutine.

On the simulated clock the loop waits while a fiber runs. Only one fiber therefore runs at any time,
and two runs of the same programs are exactly equal. On the wall clock the loop does not wait, so
that busy code blocks only its own fiber.
"""

import asyncio
import contextlib
import ctypes
import inspect
import linecache
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from types import FrameType, SimpleNamespace, TracebackType
from typing import Any, TypeVar

from tftool.base.errors import TftoolError, is_users_file
from tftool.world.clock import Clock

T = TypeVar("T")

PATIENCE = 2.0
"""Real seconds that a fiber may be busy before a warning names its line of code."""

GIVE_UP = 10.0
"""Real seconds for which simulated time waits for a busy fiber before the fiber is stopped."""

GIVE_UP_IMPORT = 60.0
"""`GIVE_UP` for code that imports a module, as large libraries load slowly on a busy machine."""

GRACE = 0.25
"""Real seconds that a busy fiber may continue after a signal before the fiber is interrupted."""

GRACE_AT_END = 1.0
"""`GRACE` when a run ends without a signal; less than the time the world waits for a fiber."""

AFTERLIFE = 50
"""Number of waits that an interrupted fiber may start before its thread is abandoned."""

LAST_REQUESTS = 1000
"""Number of requests without a wait, such as to publish, that an interrupted fiber may make.

Further requests raise an exception, as waits of the fiber do.
"""


_local = threading.local()


class EndedError(TftoolError):
    """Error for a request to a world whose run has ended."""


class StuckError(TftoolError):
    """Error for user code that did not pause or end in time and was therefore stopped."""


@dataclass(frozen=True, slots=True)
class CodeLine:
    """Line of code in a user's file.

    Attributes:
        file: Path of the file.
        line: Line number, from 1.
        function: Function that contains the line.
        text: Source of the line, without surrounding blanks.
    """

    file: str
    line: int
    function: str
    text: str

    def __str__(self) -> str:
        where = f"{self.file}:{self.line}, in {self.function}"
        return f"{where}: {self.text}" if self.text else where


def user_line(frame: FrameType | None) -> CodeLine | None:
    """Return the innermost line of a call stack that is in a user's file.

    Return None if no line of the stack is in a user's file.
    """
    while frame is not None:
        file = frame.f_code.co_filename
        if is_users_file(file):
            return _place(file, frame.f_lineno, frame.f_code.co_name)
        frame = frame.f_back
    return None


def user_line_of_error(trace: TracebackType | None) -> CodeLine | None:
    """Return the innermost line of a traceback that is in a user's file.

    Return None if no line of the traceback is in a user's file.
    """
    found = None
    while trace is not None:
        code = trace.tb_frame.f_code
        if is_users_file(code.co_filename):
            found = _place(code.co_filename, trace.tb_lineno, code.co_name)
        trace = trace.tb_next
    return found


def _place(file: str, line: int, function: str) -> CodeLine:
    return CodeLine(file, line, function, linecache.getline(file, line).strip())


class Fiber:
    """Thread that runs a user's code and takes turns with the event loop.

    Attributes:
        name: Name of the program whose code the fiber runs.
        interrupted: Whether the fiber was asked to end. Each wait of the code then raises
            KeyboardInterrupt.
        is_told: Whether a wait of the interrupted code has already raised KeyboardInterrupt.
        error: Exception that ended the code; None if there was none. A StuckError means that tftool
            stopped code that was still running at the end of the run.
        ended: Whether the code has ended.
        imports: Number of imports of the user's code that are under way, one inside the other.
        owner: Program that the fiber belongs to.
        end: Function that returns the exception which waits of an interrupted fiber raise.
        on_interrupt: Function called once in the fiber's thread, just before the first
            interrupted wait raises its exception.
    """

    def __init__(
        self,
        name: str,
        body: Callable[[], object],
        *,
        strict: bool,
        on_busy: Callable[[CodeLine | None], object] = lambda place: None,
        patience: float | None = None,
        give_up: float | None = None,
        clock: Clock | None = None,
    ) -> None:
        """Create a fiber that runs `body`; the method `drive` starts the thread.

        Args:
            name: Name of the program, for log messages.
            body: Function to run.
            strict: Whether the event loop waits while the thread runs.
            on_busy: Function called once, on the event loop's thread, when the code has not paused
                for `patience` seconds. Its argument is the line of code that runs at that time.
            patience: Limit for `on_busy` in real seconds; None for `PATIENCE`.
            give_up: Real seconds until busy code is stopped in strict mode; None for `GIVE_UP`.
            clock: Clock of the world, which reports signals such as Ctrl-C at once. In strict mode
                the event loop itself would notice a signal only after the code has paused.
        """
        self.name = name
        self.interrupted = self.is_told = False
        self.error: BaseException | None = None
        self.ended = False
        self.imports = 0
        self.owner: Any = None
        self._strict = strict
        self._on_busy = on_busy
        self._patience = PATIENCE if patience is None else patience
        self._give_up = GIVE_UP if give_up is None else give_up
        self._clock = clock or SimpleNamespace(interrupted=False)
        # Two locks decide which side runs: `_go` wakes the thread, and `_rest` tells the loop that
        # the thread sleeps again.
        # One thread releases the lock and another acquires it, which is the fastest way to signal.
        self._go, self._rest = threading.Lock(), threading.Lock()
        self._go.acquire()
        self._rest.acquire()
        self._request: Callable[[], Any] | None = None
        # One side writes these attributes while the other side sleeps, so they need no lock.
        self._broken_off = ""
        self._answer: tuple[Any, BaseException | None] = (None, None)
        self._arrived: tuple[asyncio.AbstractEventLoop, asyncio.Future[None]] | None = None
        self.end: Callable[[], BaseException] = KeyboardInterrupt
        self.on_interrupt: Callable[[], object] | None = None
        self._thread: threading.Thread | None = threading.Thread(
            # A daemon: code that never returns must not keep the process alive.
            target=self._main,
            args=(body,),
            name=name,
            daemon=True,
        )

    @classmethod
    def adopt(cls, name: str) -> "Fiber":
        """Return a fiber for the calling thread, driven by an event loop in another thread.

        The calling thread continues to run; a later call of `release` ends the fiber.
        """
        fiber = cls(name, lambda: None, strict=True)
        # The caller's own thread runs the code, so there is no thread to start or to interrupt.
        fiber._thread = None
        fiber.end = lambda: EndedError("the world has ended")
        _local.fiber = fiber
        return fiber

    def release(self) -> None:
        """End an adopted fiber; its thread continues as an ordinary thread."""
        _local.fiber = None
        self._post(None)

    # The fiber's side.

    def ask(self, request: Callable[[], Any]) -> Any:
        """Call `request` in the event loop's thread, wait for the result and return the result.

        The event loop awaits an awaitable result. Call this method in the fiber's own thread only.

        Raises:
            KeyboardInterrupt: If the fiber is interrupted during the wait.
            Exception: Any exception that `request` raises.
        """
        __tracebackhide__ = True
        self._answer = (None, None)
        self._post(request)
        self._go.acquire()
        value, error = self._answer
        if isinstance(error, KeyboardInterrupt) and self.on_interrupt is not None:
            handle, self.on_interrupt = self.on_interrupt, None
            handle()
        if error is not None:
            raise error
        return value

    def _main(self, body: Callable[[], object]) -> None:
        # The loop starts the thread before it lets the thread run.
        self._go.acquire()
        _local.fiber = self
        try:
            body()
        # This includes SystemExit and KeyboardInterrupt, because the loop decides how the program
        # ended.
        except BaseException as error:
            self.error = error
        finally:
            _local.fiber = None
            self._post(None)

    def _post(self, request: Callable[[], Any] | None) -> None:
        self._request = request
        if request is None:
            self.ended = True
        # From here on the event loop may run at any moment, so the code below does not use the
        # request.
        self._rest.release()
        arrived = self._arrived
        if arrived is not None:
            loop, future = arrived
            try:
                loop.call_soon_threadsafe(finish, future)
            except RuntimeError:  # the loop is closed: it abandoned this fiber
                return

    # The loop's side.

    async def drive(self) -> None:
        """Start the thread, and execute the code's requests in the event loop until the code ends.

        If this coroutine is cancelled, the code's present or next wait raises KeyboardInterrupt, as
        after Ctrl-C in a ROS node. Requests are still executed until the code has ended.

        Raises:
            StuckError: In strict mode, if the code neither paused nor ended and was stopped.
        """
        if self._thread is not None:
            self._thread.start()
        answer: tuple[Any, BaseException | None] = (None, None)
        first = True
        refused = late = 0
        # An interrupted fiber goes on, because its `finally` blocks may publish and call services.
        while refused < AFTERLIFE:
            await self._turn(answer, wake=not first or self._thread is not None)
            first = False
            request = self._request
            # A request of None means that the code has ended, or that an adopted thread was
            # released.
            if self.ended or request is None:
                if self._broken_off:
                    self.error = StuckError(self._broken_off)
                return
            late += self.interrupted
            if late > LAST_REQUESTS:
                # A loop that publishes and never waits would go on for ever.
                refused += 1
                answer = (None, self.end())
                continue
            try:
                value = request()
                # The loop waits, while the thread sleeps in `ask`.
                if inspect.isawaitable(value):
                    if self.interrupted:
                        discard(value)
                        refused += 1
                        raise asyncio.CancelledError
                    value = await value
                answer = (value, None)
            except asyncio.CancelledError:
                self.interrupted = self.is_told = True
                answer = (None, self.end())
            except Exception as error:
                answer = (None, error)
        self._leave_alone()

    def _leave_alone(self) -> None:
        """Abandon a fiber whose code ignored KeyboardInterrupt; its daemon thread keeps running."""
        self.ended = True
        self.error = StuckError(
            f"'{self.name}' did not stop at the end of the run: "
            f"{self.place() or 'no line of yours is running'}"
        )

    async def _turn(self, answer: tuple[Any, BaseException | None], *, wake: bool) -> None:
        """Let the thread run until its next request or the end of its code.

        Args:
            answer: Result and exception of the thread's last request.
            wake: Whether to wake the thread with `answer`; false at the first turn of an adopted
                thread, which already runs.
        """
        if not self._strict:
            # Before the thread wakes up, because it reports its next request here.
            loop = asyncio.get_running_loop()
            arrived = loop.create_future()
            self._arrived = (loop, arrived)
        if wake:
            self._answer = answer
            self._go.release()
        if self._strict:
            self._wait_for_rest()
            return
        # On the wall clock a busy thread delays nothing else, so it only causes a warning.
        alarm = loop.call_later(self._patience, self._say_busy)
        try:
            await arrived
        except asyncio.CancelledError:
            await self._interrupt(loop)
        finally:
            alarm.cancel()
            self._arrived = None
        # The future has already reported that the thread sleeps; acquire the lock again for the
        # next turn.
        self._rest.acquire(blocking=False)

    def _wait_for_rest(self) -> None:
        if self._thread is None:
            self._rest.acquire()
            return
        if self._pauses_within(self._patience):
            return
        if not self._clock.interrupted:
            self._say_busy()
            if self._pauses_within(max(0.0, self._give_up - self._patience)):
                return
            if self.imports and self._pauses_within(GIVE_UP_IMPORT - self._give_up):
                return
        if self._clock.interrupted:
            self._end_now()
            return
        place = self.place()
        # The exception is raised at the thread's next bytecode; code inside a C call continues.
        self._raise_in_thread(SystemExit)
        self._rest.acquire(timeout=1.0)
        self.ended = True
        raise StuckError(
            f"'{self.name}' has computed for {self._give_up:g} s without waiting, so simulated "
            "time could not advance. Let the code wait with a timer or time.sleep; if the code "
            "waits for a file, a socket or a process, run it without --simulated. "
            + (f"The code was at: {place}" if place else "None of your lines was running.")
        )

    def _pauses_within(self, limit: float) -> bool:
        """Wait at most `limit` real seconds for a pause of the thread; return whether it paused.

        A signal such as Ctrl-C ends the wait early.
        """
        while limit > 0.0 and not self._clock.interrupted:
            # Wait in short parts, so that a signal meanwhile is noticed.
            part = min(limit, GRACE)
            if self._rest.acquire(timeout=part):
                return True
            limit -= part
        return self._rest.acquire(blocking=False)

    def _end_now(self) -> None:
        """Raise KeyboardInterrupt in code that was busy when a signal arrived.

        Code that still does not stop is abandoned.
        """
        if not self.interrupted:
            self.interrupted = self.is_told = True
            self._raise_in_thread(KeyboardInterrupt)
        if not self._rest.acquire(timeout=GRACE * 4):
            self._leave_alone()

    async def _interrupt(self, loop: asyncio.AbstractEventLoop) -> None:
        """Interrupt a thread that is running now.

        The code's next request to the event loop raises KeyboardInterrupt. If no request comes in
        time, the exception is raised in the running code.
        """
        self.interrupted = True
        # After Ctrl-C a person waits, so busy code is interrupted. At the end of `--for`, busy code
        # is an error.
        signalled = self._clock.interrupted
        for forced in (False, True):
            if forced:
                if not signalled:
                    self._broken_off = (
                        f"'{self.name}' did not end with the run and was stopped: "
                        f"{self.place() or 'no line of yours is running'}"
                    )
                self.is_told = True
                self._raise_in_thread(KeyboardInterrupt)
            arrived = loop.create_future()
            self._arrived = (loop, arrived)
            # The thread paused between the last turn and now, so its next request raises.
            if self._rest.acquire(blocking=False):
                self._rest.release()
                return
            grace = GRACE if signalled else GRACE_AT_END
            with contextlib.suppress(asyncio.CancelledError):  # cancelled once more: end sooner
                await asyncio.wait([arrived], timeout=GRACE * 4 if forced else grace)
            if arrived.done():
                return
        self._leave_alone()

    def _say_busy(self) -> None:
        self._on_busy(self.place())

    def place(self) -> CodeLine | None:
        """Return the line of the user's code that this fiber is executing; None for other code."""
        if self._thread is None or self._thread.ident is None:
            return None
        return user_line(sys._current_frames().get(self._thread.ident))

    def _raise_in_thread(self, kind: type[BaseException]) -> None:
        if self._thread is not None and self._thread.ident is not None:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(self._thread.ident), ctypes.py_object(kind)
            )


def current() -> Fiber | None:
    """Return the fiber of the calling thread; None if the thread has no fiber."""
    return getattr(_local, "fiber", None)


def forget_current() -> None:
    """Make the calling thread an ordinary thread, because its fiber runs in another process."""
    _local.fiber = None


def finish(future: "asyncio.Future[None]", _: object = None) -> None:
    """Set a future's result to None, unless the future is done.

    The second argument is ignored, so that this function can be a done callback of another future.
    """
    if not future.done():
        future.set_result(None)


def discard(awaitable: Any) -> None:
    """Close a coroutine, or cancel a future, that nobody will await."""
    close = getattr(awaitable, "close", None) or getattr(awaitable, "cancel", None)
    if close is not None:
        close()
