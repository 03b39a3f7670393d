"""What users' files get instead of two standard modules.

In a user's own files `import time` gives a module whose `sleep` and clocks are the
world's, and `import threading` one whose threads take turns too. Everybody else's
`time` and `threading` stay as they are.
"""

import builtins
import threading
import time
from functools import cache
from types import ModuleType
from typing import Any

from tftool.ros import program
from tftool.ros.fibers import Fiber
from tftool.stamps import NANOSECONDS, seconds


class _Shim(ModuleType):
    """A standard module with some names replaced."""

    def __init__(self, real: ModuleType, replaced: dict[str, Any]) -> None:
        super().__init__(real.__name__, real.__doc__)
        self.__dict__["_real"] = real
        self.__dict__.update(replaced)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._real, name)

    def __dir__(self) -> list[str]:
        return dir(self._real)


def _sleep(secs: float) -> None:
    if secs < 0:
        raise ValueError("sleep length must be non-negative")
    program.current().sleep(seconds(secs))


def _now_ns() -> int:
    return program.current().now()


def _elapsed_ns() -> int:
    owner = program.current()
    return owner.now() - owner.clock.epoch


class UserThread(threading.Thread):
    """A thread of a user's program: a fiber more."""

    def start(self) -> None:
        """Run it beside the code that started it."""
        owner = program.current()
        self._fiber = Fiber(self.name, self.run, strict=owner.strict)
        self._drive = owner.ask(lambda: [owner.start_fiber(self._fiber)])[0]
        self._owner = owner

    def join(self, timeout: float | None = None) -> None:
        """Wait for its end."""
        if not hasattr(self, "_fiber"):
            raise RuntimeError("cannot join thread before it is started")
        limit = None if timeout is None else self._owner.now() + seconds(max(0.0, timeout))
        while not self._fiber.ended and not self._owner.interrupted:
            if limit is not None and self._owner.now() >= limit:
                return
            self._owner.sleep(seconds(0.001))

    def is_alive(self) -> bool:
        """Whether it runs."""
        return hasattr(self, "_fiber") and not self._fiber.ended


class UserEvent:
    """`threading.Event` between the threads of one program."""

    def __init__(self) -> None:
        self._set = False

    def is_set(self) -> bool:
        """Whether it is set."""
        return self._set

    def set(self) -> None:
        """Set it; whoever waits goes on."""
        self._set = True

    def clear(self) -> None:
        """Unset it."""
        self._set = False

    def wait(self, timeout: float | None = None) -> bool:
        """Block until it is set; whether it is."""
        owner = program.current()
        limit = None if timeout is None else owner.now() + seconds(max(0.0, timeout))
        while not self._set and not owner.interrupted:
            if limit is not None and owner.now() >= limit:
                break
            owner.sleep(seconds(0.001))
        return self._set


@cache
def _shims() -> dict[str, ModuleType]:
    return {
        "time": _Shim(
            time,
            {
                "sleep": _sleep,
                "time": lambda: _now_ns() / NANOSECONDS,
                "time_ns": _now_ns,
                "monotonic": lambda: _elapsed_ns() / NANOSECONDS,
                "monotonic_ns": _elapsed_ns,
                "perf_counter": lambda: _elapsed_ns() / NANOSECONDS,
                "perf_counter_ns": _elapsed_ns,
            },
        ),
        "threading": _Shim(threading, {"Thread": UserThread, "Event": UserEvent}),
    }


@cache
def builtins_for_users() -> dict[str, Any]:
    """Builtins whose `import` gives users' files our `time` and `threading`."""
    shims = _shims()

    def import_(
        name: str, globals: Any = None, locals: Any = None, fromlist: Any = (), level: int = 0
    ) -> Any:
        if level == 0 and name in shims:
            return shims[name]
        return builtins.__import__(name, globals, locals, fromlist, level)

    return {**vars(builtins), "__import__": import_}
