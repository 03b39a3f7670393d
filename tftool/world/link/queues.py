"""Queues of limited size between the event loop and a middleware's threads."""

import asyncio
import contextlib
import queue
import threading
from collections import deque
from collections.abc import Callable
from typing import Any, Final

from tftool.base.errors import LinkError

MOST_WAITING: Final = 50_000
"""Largest number of messages in the queue; further ones are dropped, and counted."""

MOST_BYTES: Final = 256 * 1024 * 1024
"""Largest number of bytes of messages in the queue."""

_SLICE: Final = 200


class Inbox:
    """Queue to which any thread adds calls; the event loop makes the calls in order.

    Attributes:
        lost: Number of messages that were dropped because the queue was full.
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
        """Make all calls in the event loop `loop` from now on, beginning with the queued calls."""
        with self._lock:
            self._loop = loop
            self._scheduled = bool(self._waiting)
        # Messages that arrived before the loop started.
        if self._scheduled:
            loop.call_soon(self._drain)

    def call_now(self) -> None:
        """Make the queued calls now, in this thread; used while no event loop exists."""
        while self._loop is None:
            with self._lock:
                if not self._waiting:
                    return
                callback, argument, size = self._waiting.popleft()
                self._bytes -= size
            callback(argument)

    def close(self) -> None:
        """Drop the queued calls; no further call is made."""
        with self._lock:
            self._closed = True
            self._waiting.clear()

    def put(self, callback: Callable[..., object], argument: Any, size: int | None = None) -> None:
        """Queue `callback(argument)` for the event loop, from any thread.

        Args:
            callback: Function to call.
            argument: Argument of the call.
            size: Bytes of a message; None for events, which are never dropped.
        """
        with self._lock:
            if self._closed:
                return
            # Events (arrivals, departures) enter even a full inbox: the graph needs them all.
            full = len(self._waiting) >= MOST_WAITING or self._bytes + (size or 0) > MOST_BYTES
            if size is not None and full:
                self.lost += 1
                return
            self._waiting.append((callback, argument, size or 0))
            self._bytes += size or 0
            # One wake-up of the loop serves all waiting calls.
            if self._scheduled or self._loop is None:
                return
            self._scheduled = True
            loop = self._loop
        # The loop may just have been closed.
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(self._drain)

    def _drain(self) -> None:
        """Make the queued calls, a limited number at a time, so that the event loop is not blocked.

        An exception of a callback is reported to the event loop, and does not prevent later calls.
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
            # More calls may wait: the loop first runs other callbacks.
            self._loop.call_soon(self._drain)

    def _report(self, callback: Callable[..., object], error: Exception) -> None:
        if self._loop is not None:
            told = f"{callback!r} failed with data from another process"
            self._loop.call_exception_handler({"message": told, "exception": error})


MOST_AHEAD: Final = 32
"""Number of queued messages above which the event loop waits for the sender."""

MOST_UNSENT: Final = 20_000
"""Largest number of queued messages while a reader takes none; then the event loop waits."""

MOST_UNSENT_BYTES: Final = 256 * 1024 * 1024
"""Largest number of queued bytes while a reader takes no message, because images are large."""

LONGEST_WAIT: Final = 2.0
"""Longest wait in seconds of the event loop for room; then messages are dropped."""

_PAUSE = 0.0002
_STUCK = 50  # pauses without progress, after which the sender counts as stuck
_FAREWELL = 2.0


class Outbox:
    """Queue of calls that send messages; one thread makes the calls in order.

    Attributes:
        dropped: Number of calls that were dropped because the queue was full and no message could
            be sent.
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
        """Queue a call after all earlier calls; exceptions of the call are ignored.

        If the queue is full and nothing was sent for `LONGEST_WAIT` seconds, the call is dropped,
        because a send that never returns must not block the event loop for ever.

        Args:
            send: Function that sends a message.
            size: Bytes of the message.

        Raises:
            LinkError: If the outbox is closed.
        """
        if self._closed:
            raise LinkError("a message could not be sent: the connection to the session is closed")
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="outbox", daemon=True)
            self._thread.start()
        # The sender made no progress for two seconds: waiting again would stop the world.
        if self._is_full and self._is_hopeless:
            self.dropped += 1
            return
        # Counted before it is queued, because the sender may process it at once.
        self._put += 1
        self._put_bytes += size
        self._queue.put((send, size))
        if self._is_full or (self._put - self._sent > MOST_AHEAD and not self._stuck):
            self._let_catch_up()

    def close(self) -> None:
        """Send everything queued, within a time limit, and accept no further calls."""
        if not self._closed:
            self._closed = True
            self._queue.put(None)
            if self._thread is not None:
                self._thread.join(_FAREWELL)

    @property
    def _is_full(self) -> bool:
        """Whether the queue exceeds its limit of messages or bytes."""
        waiting, held = self._put - self._sent, self._put_bytes - self._sent_bytes
        return waiting > MOST_UNSENT or held > MOST_UNSENT_BYTES

    def _let_catch_up(self) -> None:
        """Wait while the sender makes progress.

        Without this wait, a busy loop would block the interpreter's other threads.
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
            # The receiver may have left, or the session may be closed.
            with contextlib.suppress(Exception):
                send()
            # Delete the references, so that the memory of sent messages is free.
            del waiting, send
            self._sent_bytes += size
            self._sent += 1
            self._stuck = self._is_hopeless = False
