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

from tftool.ros import fibers, program
from tftool.ros.complaints import sentence_of
from tftool.ros.fibers import Fiber
from tftool.stamps import NANOSECONDS, seconds

_REAL_SLEEP = time.sleep  # noqa: TID251
_PAUSE = 0.001
"""Seconds between two looks at what another thread does."""


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


def _owner() -> "program.Program | None":
    """Whose code is running; None for code outside of every program: a test file, imported."""
    fiber = fibers.current()
    return None if fiber is None else fiber.owner


def _sleep(secs: float) -> None:
    owner = _owner()
    if owner is None:
        _REAL_SLEEP(secs)
        return
    if secs < 0:
        raise ValueError("sleep length must be non-negative")
    owner.sleep(seconds(secs))


def _now_ns() -> int:
    owner = _owner()
    return time.time_ns() if owner is None else owner.now()


def _elapsed_ns() -> int:
    owner = _owner()
    return time.monotonic_ns() if owner is None else owner.now() - owner.clock.epoch


class UserThread(threading.Thread):
    """A thread of a user's program: a fiber more."""

    _fiber: Fiber | None = None

    def start(self) -> None:
        """Run it beside the code that started it."""
        owner = _owner()
        if owner is None:
            super().start()
            return
        self._owner = owner
        self._fiber = fiber = owner.new_fiber(self.name, self._run_told)
        owner.ask(lambda: [owner.start_fiber(fiber)])

    def _run_told(self) -> None:
        """Run it; what it raises ends it alone, and is said, as Python does for its threads."""
        try:
            self.run()
        except Exception as error:
            sentence = f"thread '{self.name}' failed: {sentence_of(error)}"
            self._owner.ask(lambda: self._owner.error(sentence))

    def join(self, timeout: float | None = None) -> None:
        """Wait for its end."""
        if self._fiber is None:
            super().join(timeout)
            return
        limit = None if timeout is None else self._owner.now() + seconds(max(0.0, timeout))
        while not self._fiber.ended and not self._owner.interrupted:
            if limit is not None and self._owner.now() >= limit:
                return
            _sleep(_PAUSE)

    def is_alive(self) -> bool:
        """Whether it runs."""
        return super().is_alive() if self._fiber is None else not self._fiber.ended


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
        limit = None if timeout is None else _now_ns() + seconds(max(0.0, timeout))
        while not self._set and (limit is None or _now_ns() < limit):
            owner = _owner()
            if owner is not None and owner.interrupted:
                break
            _sleep(_PAUSE)
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
