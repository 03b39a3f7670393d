"""asyncio for users' programs: event loops in the world's time."""

import asyncio
import selectors
from collections.abc import Callable, Coroutine
from typing import Any

from tftool.base.stamps import NANOSECONDS, Duration, seconds
from tftool.ros.host.locks import running_program

SLICE: Duration = seconds(0.01)
"""How long a loop waits at once: by then it sees what came by socket or from another thread."""


class _WorldSelector(selectors.DefaultSelector):
    """Selector that waits for input the way `time.sleep` waits in a user's program."""

    def select(self, timeout: float | None = None) -> Any:
        ready = super().select(0)
        owner = running_program()
        if ready or owner is None or (timeout is not None and timeout <= 0):
            return ready
        owner.sleep(SLICE if timeout is None else min(SLICE, seconds(timeout)))
        if owner.interrupted:
            raise KeyboardInterrupt
        return super().select(0)


class UserEventLoop(asyncio.SelectorEventLoop):
    """Event loop of a user's program; its seconds are the world's."""

    def __init__(self) -> None:
        """Make a loop for the running program; it closes with the program."""
        super().__init__(_WorldSelector())
        self._owner = running_program()
        self._owner.event_loops.append(self)

    def time(self) -> float:
        """Return seconds since the world began."""
        return float(self._owner.now() - self._owner.clock.epoch) / NANOSECONDS


def get_event_loop() -> asyncio.AbstractEventLoop:
    """Return the thread's loop; create one if there is none, as in a process's main thread."""
    try:
        return asyncio.get_event_loop()
    except RuntimeError:
        if running_program() is None:
            raise
    loop = UserEventLoop()
    asyncio.set_event_loop(loop)
    return loop


def new_event_loop() -> asyncio.AbstractEventLoop:
    """Return a loop in the world's time for a user's program, Python's own elsewhere."""
    return asyncio.new_event_loop() if running_program() is None else UserEventLoop()


def run(main: Coroutine[Any, Any, Any], *, debug: bool | None = None) -> Any:
    """Run a coroutine to its end in a new loop, as `asyncio.run` does."""
    factory: Callable[[], asyncio.AbstractEventLoop] | None = None
    if running_program() is not None:
        factory = UserEventLoop
    with asyncio.Runner(debug=debug, loop_factory=factory) as runner:
        return runner.run(main)
