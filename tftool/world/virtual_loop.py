"""The event loop of simulated time: where it would wait, its clock jumps."""

import asyncio
import selectors
from typing import TYPE_CHECKING, Any

from tftool.base.errors import TftoolError
from tftool.base.stamps import NANOSECONDS

if TYPE_CHECKING:
    from tftool.world.clock import SimClock


class VirtualLoop(asyncio.SelectorEventLoop):
    """An event loop whose time is a simulated clock's."""

    def __init__(self, clock: "SimClock") -> None:
        self.clock = clock
        super().__init__(_VirtualSelector(self))

    def time(self) -> float:
        """The clock's moment in seconds, for asyncio's own timers."""
        return self.clock.now() / NANOSECONDS

    def is_forsaken(self) -> bool:
        """Whether nothing from outside can wake this loop any more."""
        selector: Any = getattr(self, "_selector", None)
        # The one file that is always there is the loop's own wake-up pipe.
        files = 0 if selector is None else len(selector.get_map())
        has_help = getattr(self, "_default_executor", None) is not None or self.clock.alarms > 0
        return files <= 1 and not has_help


class _VirtualSelector(selectors.DefaultSelector):
    """Where a virtual loop would wait for files, it lets its clock jump instead."""

    POLL_EVERY = 64

    def __init__(self, loop: VirtualLoop) -> None:
        super().__init__()
        self._loop = loop
        self._calls = 0

    def select(self, timeout: float | None = None) -> Any:
        """Poll now and then for signals and threads; jump when the loop has nothing to run."""
        self._calls += 1
        if self._calls % self.POLL_EVERY == 0 or self.has_files():
            events = super().select(0)
            if events:
                return events
        if timeout is not None and timeout <= 0:
            return []
        if self._loop.clock.advance(timeout):
            return []
        if self._loop.is_forsaken():
            raise TftoolError(
                "nothing is due and every task waits: this run would never end. "
                "Give it an end (until), or something that wakes it."
            )
        return super().select(None)

    def has_files(self) -> bool:
        """Whether anything besides the loop's own pipe is watched."""
        return len(self.get_map()) > 1
