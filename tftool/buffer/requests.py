"""Pending requests for a transform, tried again only when a frame they depend on changes."""

from collections.abc import Callable
from typing import TypeAlias

from tftool.base.stamps import Stamp

NEVER = 2**64 - 1
"""Handle of a request that can no longer succeed."""

NOW = 0
"""Handle of a request whose transform is available at once."""

PENDING = 0
AVAILABLE = 1
EXPIRED = 2

Callback: TypeAlias = Callable[[int, bool], object]
"""Function called with the handle, and whether the transform is available or never will be."""

Lookup: TypeAlias = tuple[str, str, Stamp]
"""Target frame, source frame and time."""

Examine: TypeAlias = Callable[[Lookup, bool], tuple[int, tuple[str, ...]]]
"""Function that returns PENDING, AVAILABLE or EXPIRED, and the frames that must change before
the lookup can succeed.

With the flag (the first attempt), a lookup that succeeds has never expired. Without the flag,
expiry is checked first, as in tf2.
"""


class Request:
    """A request to call a function once a transform is available."""

    __slots__ = ("callback", "handle", "lookup", "watched")

    def __init__(self, handle: int, callback: Callback, lookup: Lookup) -> None:
        self.handle = handle
        self.callback = callback
        self.lookup = lookup
        self.watched: tuple[str, ...] = ()


class Requests:
    """Pending requests for transforms, indexed by the frames they wait for.

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
            The exceptions that callbacks raised; the other callbacks were called nevertheless.
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
        """Try a request's lookup; if it may succeed later, watch the frames that prevent it."""
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
