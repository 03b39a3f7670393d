"""Queue from the transport's threads to our event loop, of limited size."""

import asyncio
import contextlib
import threading
from collections import deque
from collections.abc import Callable
from typing import Any, Final

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
