"""Errors of the DDS library, counted; the library itself prints each to stderr."""

import ctypes
import os
import re
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final

from tftool.base.escaping import shorten
from tftool.world.log import Repeats

_MOST: Final = 160
"""Characters of a complaint that are passed on: the bytes of the packet follow them."""

_STAMP: Final = re.compile(r"^[\d.]+ (\[\w*\])?\s*")
_NUMBER: Final = re.compile(r"[0-9a-f.]*\d[0-9a-f.]*")


class LibraryLog:
    """The library's error output, read through a pipe and passed to listeners.

    The library has no function that redirects them: a domain writes to C's `stderr` at the time of
    its creation. During that time the variable names our pipe. The library's end of the pipe never
    blocks, and text that does not fit is dropped: the library holds locks while it writes, so
    neither a full pipe nor Python's own lock, as in a callback from C, may stop it.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._listeners: list[Callable[[str], object]] = []
        self._repeats = Repeats()
        self._stream: int | None = None

    def listen(self, callback: Callable[[str], object]) -> Callable[[], None]:
        """Call `callback` in another thread with sentences to print.

        Returns:
            A function that ends this.
        """
        with self._lock:
            self._listeners.append(callback)

        def stop() -> None:
            with self._lock:
                self._listeners.remove(callback)

        return stop

    @contextmanager
    def taking(self) -> Iterator[None]:
        """Capture the errors of a domain created in this block, where C allows it."""
        try:
            c = ctypes.CDLL(None)
            stderr = ctypes.c_void_p.in_dll(
                c, "__stderrp" if sys.platform == "darwin" else "stderr"
            )
        except (OSError, TypeError, ValueError):
            # Windows, and libraries of C in which it is no variable: they stay on stderr.
            yield
            return
        before = stderr.value
        stderr.value = self._open(c)
        try:
            yield
        finally:
            # The rest of the process keeps its own stderr: only the domain has taken the stream.
            stderr.value = before

    def _open(self, c: ctypes.CDLL) -> int:
        """Return the C stream to read; it stays open, as domains continue to write to it."""
        if self._stream is None:
            # Never closed: the library may write at any time, also while the process ends.
            read, write = os.pipe()
            os.set_blocking(write, False)
            c.fdopen.restype = ctypes.c_void_p
            stream: int = c.fdopen(write, b"w")
            # Without a buffer of C's, in which a complaint would wait for more of them.
            c.setbuf(ctypes.c_void_p(stream), None)
            self._stream = stream
            threading.Thread(target=self._read, args=(read,), name="dds-log", daemon=True).start()
        return self._stream

    def _read(self, read: int) -> None:
        with os.fdopen(read, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                text = _STAMP.sub("", line.strip())
                # Addresses and counts differ each time: without them, a complaint is one of a kind.
                kind = _NUMBER.sub("#", text)[:40]
                said = self._repeats.said(kind, f"The DDS library: {shorten(text, _MOST)}")
                if not said:
                    continue
                with self._lock:
                    # Called without the lock: a listener may end itself.
                    listeners = tuple(self._listeners)
                for listener in listeners:
                    listener(said)


LIBRARY_LOG: Final = LibraryLog()
"""One for the process, as its `stderr` is."""
