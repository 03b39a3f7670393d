"""Registered callbacks (listeners), called one after the other.

The buffer, topics, the log and the world share these rules: each registration is separate, and the
exception of a listener is reported under the name of the listener's owner. The other listeners and
the publishing code continue.
"""

from collections.abc import Callable
from typing import Generic, TypeVarTuple

from tftool.base.errors import failure_text

Values = TypeVarTuple("Values")

Report = Callable[[str, Exception], object]
"""Function called with the name of a listener's owner, and the exception the listener raised."""


class Listeners(Generic[*Values]):
    """Registered callbacks, in the order of registration.

    A callback can be registered more than once: it is called once per registration, and each
    registration is removed separately.

    Attributes:
        registered: Each callback with its owner. Fast code tests this list itself, because `if
            registered` costs less than a call of `len`.
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
        """Register a callback.

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
        """Call every listener with these values, even if it is removed during the call."""
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
