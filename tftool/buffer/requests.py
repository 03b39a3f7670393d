"""Pending requests, checked again only when a frame they depend on changes."""

from collections.abc import Callable
from typing import TypeAlias

from tftool.base.stamps import Stamp

NEVER = 2**64 - 1
"""The handle of a request that can no longer be met."""

NOW = 0
"""The handle of a request that is met already."""

PENDING = 0
AVAILABLE = 1
EXPIRED = 2

Callback: TypeAlias = Callable[[int, bool], object]
"""Is called with the handle, and whether the transform is available now or never will be."""

Lookup: TypeAlias = tuple[str, str, Stamp]
"""Target, source and time."""

Examine: TypeAlias = Callable[[Lookup, bool], tuple[int, tuple[str, ...]]]
"""Says PENDING, AVAILABLE or EXPIRED, and which frames must change before that can.

Asked the first time (the flag), a lookup that has an answer is never taken for expired;
later, as in tf2, expiry is looked at first.
"""


class Request:
    """One pending request."""

    __slots__ = ("callback", "handle", "lookup", "watched")

    def __init__(self, handle: int, callback: Callback, lookup: Lookup) -> None:
        self.handle = handle
        self.callback = callback
        self.lookup = lookup
        self.watched: tuple[str, ...] = ()


class Requests:
    """Pending requests, indexed by the frames they wait for.

    A change of a frame costs no time for requests that wait for other frames.

    Attributes:
        pending: Waiting requests by handle.
    """

    __slots__ = ("_examine", "_last", "_watchers", "pending")

    def __init__(self, examine: Examine) -> None:
        self._examine = examine
        self._last = 0
        self.pending: dict[int, Request] = {}
        # Handles by frame; a dictionary keeps them in the order they were made.
        self._watchers: dict[str, dict[int, None]] = {}

    def add(self, callback: Callback, lookup: Lookup) -> int:
        """Try the lookup at once; keep the request pending if the lookup may succeed later.

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
        """Cancel a request; ignore a handle that is not pending."""
        request = self.pending.pop(handle, None)
        if request is not None:
            self._unwatch(request)

    def changed(self, *frames: str) -> list[Exception]:
        """Check every request that waits for one of these frames again, oldest first.

        Returns:
            The exceptions that callbacks raised; all other callbacks were called nevertheless.
        """
        due: set[int] = set()
        for frame in frames:
            due.update(self._watchers.get(frame, ()))
        failures: list[Exception] = []
        for handle in sorted(due):
            # A callback may have cancelled it.
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
        """Try the lookup; if it fails, wait for the frames that prevent it."""
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
