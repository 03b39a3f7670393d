"""Listeners, pending requests for transforms, and detection of backward jumps of a clock.

Buffers, topics, logs and worlds treat listeners alike. An exception of a listener is reported with
the name of its owner; the other listeners and the publishing code continue. A pending request for a
transform is tried again only when a frame between its two frames changes.
"""

from collections.abc import Callable
from typing import Generic, TypeAlias, TypeVarTuple

from tftool.base.errors import failure_text
from tftool.base.stamps import NANOSECONDS, Duration, Stamp

Values = TypeVarTuple("Values")

Report = Callable[[str, Exception], object]
"""Function called with the name of a listener's owner, and the exception the listener raised."""


class Listeners(Generic[*Values]):
    """Registered callbacks, in the order of registration.

    A callback that was registered twice is called twice. Each registration is removed separately.

    Attributes:
        registered: Pairs of callback and owner. Code that must be fast tests this list directly,
            because `if registered` costs less than a call of `len`.
    """

    __slots__ = ("_report", "registered")

    def __init__(self, report: Report | None = None) -> None:
        """Create an empty list of listeners.

        Args:
            report: Function called with each exception of a listener, after all listeners were
                called; None sends the exception to Python's log.
        """
        self._report: Report = report or _report_to_logging
        # Replaced, never changed in place: changing a list during iteration would skip entries.
        self.registered: tuple[tuple[Callable[[*Values], object], str], ...] = ()

    def add(self, callback: Callable[[*Values], object], owner: str = "") -> Callable[[], None]:
        """Register a callback for all future calls of `call`.

        Args:
            callback: Function to call.
            owner: Name under which an exception of the callback is reported.

        Returns:
            A function that removes this registration only.
        """
        registration = (callback, owner)
        self.registered = (*self.registered, registration)

        def stop() -> None:
            self.registered = tuple(one for one in self.registered if one is not registration)

        return stop

    def call(self, *values: *Values) -> None:
        """Call every listener with these values, even a listener that is removed meanwhile."""
        failures: tuple[tuple[str, Exception], ...] = ()
        for callback, owner in self.registered:
            try:
                callback(*values)
            except Exception as error:
                failures = (*failures, (owner, error))
        for failed, failure in failures:
            self._report(failed, failure)

    def __len__(self) -> int:
        return len(self.registered)


def _report_to_logging(owner: str, error: Exception) -> None:
    # Imported here because it takes 10 ms at start-up, and most programs never log.
    import logging

    logging.getLogger("tftool").error("%s", listener_text(owner, error))


def listener_text(owner: str, error: Exception) -> str:
    """Return the log line for a listener that raised an exception."""
    return f"a listener{f' of {owner!r}' if owner else ''} failed: {failure_text(error)}"


LEAST_FALL: Duration = NANOSECONDS
"""Smallest backward jump of a clock that clears a buffer, as in tf2's Python code.

tf2's C++ buffer is cleared after a jump of one nanosecond.
"""

FELL_BACK = "Detected jump back in time. Clearing tf buffer."


def must_clear(
    change: Duration, *, source_changed: bool = False, least_fall: Duration = LEAST_FALL
) -> bool:
    """Whether a jump of the clock makes all moving samples in a buffer obsolete.

    Args:
        change: Size of the jump, nanoseconds; negative for a jump backward. A jump forward makes
            nothing obsolete.
        source_changed: Whether the source of time changed, which always makes samples obsolete.
        least_fall: Smallest jump backward that makes samples obsolete, nanoseconds.
    """
    return source_changed or change <= -least_fall


class Watch:
    """Detector that clears a buffer if a clock jumps backward.

    A buffer has no clock, and a recording or a simulation may restart. Code that fills a buffer
    from one of these first passes each new time to this class.
    """

    def __init__(
        self,
        clear: Callable[[], object],
        log: Callable[[str, str], object] | None = None,
        *,
        least_fall: Duration = LEAST_FALL,
    ) -> None:
        self._clear = clear
        self._log = log
        self._least_fall = least_fall
        self._last: Stamp | None = None

    def read(self, now: Stamp) -> bool:
        """Clear the buffer and return True if the clock jumped back since the last call."""
        last, self._last = self._last, now
        if last is None or not must_clear(now - last, least_fall=self._least_fall):
            return False
        if self._log is not None:
            self._log("WARN", FELL_BACK)
        self._clear()
        return True


NEVER = 2**64 - 1
"""Handle of a request that can no longer succeed."""

NOW = 0
"""Handle of a request whose transform is available at once."""

PENDING = 0
AVAILABLE = 1
EXPIRED = 2

Callback: TypeAlias = Callable[[int, bool], object]
"""Function called with the handle, and True if the transform is available, False if it never will
be.
"""

Lookup: TypeAlias = tuple[str, str, Stamp]
"""Target frame, source frame and time."""

Examine: TypeAlias = Callable[[Lookup, bool], tuple[int, tuple[str, ...]]]
"""Function that returns the state of a lookup (PENDING, AVAILABLE or EXPIRED), and the frames of
which one must change before the lookup can succeed.

With the flag (the first attempt), a lookup that succeeds has never expired. Without the flag,
expiry is checked first, as in tf2.
"""


class Request:
    """A pending request: a lookup, and the function to call once its transform is available."""

    __slots__ = ("callback", "handle", "lookup", "watched")

    def __init__(self, handle: int, callback: Callback, lookup: Lookup) -> None:
        self.handle = handle
        self.callback = callback
        self.lookup = lookup
        self.watched: tuple[str, ...] = ()


class Requests:
    """Pending requests for transforms, indexed by the frames that each request waits for.

    After a change of a frame, only the requests that wait for this frame are tried again.

    Attributes:
        pending: Pending requests by handle.
    """

    __slots__ = ("_examine", "_last", "_watchers", "pending")

    def __init__(self, examine: Examine) -> None:
        self._examine = examine
        self._last = 0
        self.pending: dict[int, Request] = {}
        # Handles by frame; the inner dictionary keeps the order of the requests.
        self._watchers: dict[str, dict[int, None]] = {}

    def add(self, callback: Callback, lookup: Lookup) -> int:
        """Try the lookup at once; store the request if the lookup may succeed later.

        Returns:
            NOW if the lookup succeeds, NEVER if it cannot succeed any more, else a handle.
        """
        request = Request(self._last + 1, callback, lookup)
        status = self._ask(request, True)
        if status == AVAILABLE:
            return NOW
        if status == EXPIRED:
            return NEVER
        self._last += 1
        self.pending[request.handle] = request
        return request.handle

    def cancel(self, handle: int) -> None:
        """Remove a pending request; ignore an unknown handle."""
        request = self.pending.pop(handle, None)
        if request is not None:
            self._unwatch(request)

    def changed(self, *frames: str) -> list[Exception]:
        """Try again every request that waits for one of these frames, oldest first.

        Returns:
            The exceptions that callbacks raised. An exception does not prevent the other callbacks.
        """
        due: set[int] = set()
        for frame in frames:
            due.update(self._watchers.get(frame, ()))
        failures: list[Exception] = []
        for handle in sorted(due):
            # An earlier callback may have cancelled this request.
            request = self.pending.get(handle)
            if request is None:
                continue
            self._unwatch(request)
            status = self._ask(request, False)
            if status != PENDING:
                del self.pending[handle]
                try:
                    request.callback(handle, status == AVAILABLE)
                except Exception as failure:
                    failures.append(failure)
        return failures

    def _ask(self, request: Request, first: bool) -> int:
        """Return the state of a request's lookup; for PENDING, register the frames to wait for."""
        status, blocked = self._examine(request.lookup, first)
        if status == PENDING:
            self._watch(request, blocked)
        return status

    def _watch(self, request: Request, frames: tuple[str, ...]) -> None:
        request.watched = frames
        for frame in frames:
            self._watchers.setdefault(frame, {})[request.handle] = None

    def _unwatch(self, request: Request) -> None:
        for frame in request.watched:
            watchers = self._watchers.get(frame)
            if watchers is not None:
                watchers.pop(request.handle, None)
                if not watchers:
                    del self._watchers[frame]
        request.watched = ()
