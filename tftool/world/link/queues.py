"""Queues between our event loop and a transport's threads, of limited size."""

import asyncio
import contextlib
import queue
import threading
from collections import deque
from collections.abc import Callable
from typing import Any, Final

from tftool.base.errors import LinkError

MOST_WAITING: Final = 50_000
"""Messages that may wait for the event loop; further ones are lost, and counted."""

MOST_BYTES: Final = 256 * 1024 * 1024
"""Bytes of payload that may wait."""

_SLICE: Final = 200


class Inbox:
    """Calls from any thread, made one after the other on the event loop.

    Attributes:
        lost: Messages that were dropped because too many waited.
    """

    def __init__(self) -> None:
        self.lost = 0
        self._loop: asyncio.AbstractEventLoop | None = None
        self._lock = threading.Lock()
        self._waiting: deque[tuple[Callable[..., object], Any, int]] = deque()
        self._bytes = 0
        self._scheduled = False
        self._closed = False

    def start(self, loop: asyncio.AbstractEventLoop) -> None:
        """Make the calls on `loop` from now on; earlier ones are queued."""
        with self._lock:
            self._loop = loop
            self._scheduled = bool(self._waiting)
        # Messages that came before the loop did.
        if self._scheduled:
            loop.call_soon(self._drain)

    def call_now(self) -> None:
        """Make the queued calls now, before there is a loop."""
        while self._loop is None:
            with self._lock:
                if not self._waiting:
                    return
                callback, argument, size = self._waiting.popleft()
                self._bytes -= size
            callback(argument)

    def close(self) -> None:
        """Make no further call."""
        with self._lock:
            self._closed = True
            self._waiting.clear()

    def put(self, callback: Callable[..., object], argument: Any, size: int | None = None) -> None:
        """Queue `callback(argument)` for the loop (from any thread).

        Args:
            callback: Function to call.
            argument: With what.
            size: Bytes a message carries; None for events, which are never dropped.
        """
        with self._lock:
            if self._closed:
                return
            # Events (arrivals, departures) pass even a full inbox: the graph must not miss one.
            full = len(self._waiting) >= MOST_WAITING or self._bytes + (size or 0) > MOST_BYTES
            if size is not None and full:
                self.lost += 1
                return
            self._waiting.append((callback, argument, size or 0))
            self._bytes += size or 0
            # One wake-up serves all that wait: a flood costs the loop no flood of wake-ups.
            if self._scheduled or self._loop is None:
                return
            self._scheduled = True
            loop = self._loop
        # A loop that has just been closed wants to hear no more.
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(self._drain)

    def _drain(self) -> None:
        """Make all queued calls, some at a time, so that a flood does not block the world.

        A callback that raises is reported to the loop; those behind it are called all the same.
        """
        # The lock is held for one message at a time: transport threads never wait for a callback.
        for _ in range(_SLICE):
            with self._lock:
                if not self._waiting:
                    self._scheduled = False
                    return
                callback, argument, size = self._waiting.popleft()
                self._bytes -= size
            try:
                callback(argument)
            except Exception as error:
                self._report(callback, error)
        if self._loop is not None:
            # More may wait: behind whatever else the loop has to do now.
            self._loop.call_soon(self._drain)

    def _report(self, callback: Callable[..., object], error: Exception) -> None:
        if self._loop is not None:
            told = f"{callback!r} failed with what came in over the link"
            self._loop.call_exception_handler({"message": told, "exception": error})


MOST_AHEAD: Final = 32
"""How far the loop may run ahead before it lets the sender catch up."""

MOST_UNSENT: Final = 20_000
"""Messages that may wait while a reader takes nothing; then the loop waits a while as well."""

MOST_UNSENT_BYTES: Final = 256 * 1024 * 1024
"""Bytes of payload that may wait in the same way: a few images weigh more than many poses."""

LONGEST_WAIT: Final = 2.0
"""Seconds the loop waits for room in all; later messages are dropped while there is none."""

_PAUSE = 0.0002
_STUCK = 50  # pauses without progress, after which the sender counts as stuck
_FAREWELL = 2.0


class Outbox:
    """Calls that send, made in order in one thread.

    Attributes:
        dropped: Number of were dropped because too much waited for a sender that is stuck.
    """

    def __init__(self) -> None:
        self._queue: queue.SimpleQueue[tuple[Callable[[], object], int] | None] = (
            queue.SimpleQueue()
        )
        # Each of these is written by one thread only, so that neither needs a lock.
        self._put = self._put_bytes = 0
        self.dropped = 0
        self._sent = self._sent_bytes = 0
        self._stuck = False
        self._is_hopeless = False
        self._closed = False
        self._thread: threading.Thread | None = None

    def put(self, send: Callable[[], object], size: int = 0) -> None:
        """Queue a call after all earlier ones; exceptions in it are ignored.

        If too much waits, and nothing was sent for `LONGEST_WAIT`, the call is dropped: a call that
        never returns must not block the loop for ever.

        Args:
            send: Sends it.
            size: Bytes it holds until it is sent.

        Raises:
            LinkError: If this is closed.
        """
        if self._closed:
            raise LinkError("a message could not be sent: the link is closed")
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="outbox", daemon=True)
            self._thread.start()
        # The sender gave no sign of life for two seconds: waiting once more would stop the world.
        if self._is_full and self._is_hopeless:
            self.dropped += 1
            return
        # Counted before it is queued: the sender may be done with it in the next instant.
        self._put += 1
        self._put_bytes += size
        self._queue.put((send, size))
        if self._is_full or (self._put - self._sent > MOST_AHEAD and not self._stuck):
            self._let_catch_up()

    def close(self) -> None:
        """Send everything queued, within limits, and nothing more."""
        if not self._closed:
            self._closed = True
            self._queue.put(None)
            if self._thread is not None:
                self._thread.join(_FAREWELL)

    @property
    def _is_full(self) -> bool:
        """Whether the queue exceeds its limit."""
        waiting, held = self._put - self._sent, self._put_bytes - self._sent_bytes
        return waiting > MOST_UNSENT or held > MOST_UNSENT_BYTES

    def _let_catch_up(self) -> None:
        """Wait while the sender makes progress.

        Without it, a busy loop would block the interpreter's other threads.
        """
        pause = threading.Event()
        sent, idle = self._sent, 0
        while self._put - self._sent > MOST_AHEAD // 2 or self._is_full:
            pause.wait(_PAUSE)
            idle = idle + 1 if self._sent == sent else 0
            sent = self._sent
            if idle >= _STUCK and not self._is_full:
                self._stuck = True
                return
            if idle * _PAUSE >= LONGEST_WAIT:
                self._is_hopeless = True
                return

    def _run(self) -> None:
        while True:
            waiting = self._queue.get()
            if waiting is None:
                return
            send, size = waiting
            # Who it was for may be gone by now, or the session closed.
            with contextlib.suppress(Exception):
                send()
            # Named no more, so that what counts as sent is free as well.
            del waiting, send
            self._sent_bytes += size
            self._sent += 1
            self._stuck = self._is_hopeless = False
