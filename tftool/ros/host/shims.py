"""Replacements of seven standard modules and of `print` for users' programs.

A user's file that imports one of these modules gets a version that works with tftool's clock:

- `time`: `sleep` and the clocks use tftool's time.
- `threading`: threads take turns, and the timeouts of locks count seconds of tftool's clock.
- `queue`: the standard queues, based on these locks.
- `asyncio`: timers of event loops use tftool's time.
- `concurrent.futures`: pools of such threads, and futures based on these locks.
- `multiprocessing`: a process that uses rclpy runs as a program of the world.
- `signal`: a handler belongs to one program instead of the process.

All other files, such as those of libraries, get Python's standard modules.
"""

import asyncio
import builtins
import concurrent
import concurrent.futures
import importlib.util
import io
import queue
import selectors
import signal
import sys
import threading
import time
from collections.abc import Callable, Coroutine
from functools import cache, partial
from types import ModuleType
from typing import Any
from weakref import WeakKeyDictionary

from tftool.base.stamps import NANOSECONDS, Duration, seconds
from tftool.ros.host import locks
from tftool.ros.host.fibers import current
from tftool.ros.host.locks import running_program
from tftool.ros.host.workers import (
    UserThread,
    UserThreadPool,
    UserTimer,
    as_completed,
    elapsed_ns,
    process_class,
    wait_for_futures,
)

_REAL_SLEEP = time.sleep  # noqa: TID251
_REAL_PRINT = print


class _Shim(ModuleType):
    """Copy of a standard module in which some functions and classes are replaced."""

    def __init__(self, real: ModuleType, replaced: dict[str, Any]) -> None:
        super().__init__(real.__name__, real.__doc__)
        self.__dict__["_real"] = real
        self.__dict__.update(replaced)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._real, name)

    def __dir__(self) -> list[str]:
        return dir(self._real)


def _sleep(secs: float) -> None:
    owner = running_program()
    if owner is None:
        _REAL_SLEEP(secs)
        return
    if secs < 0:
        raise ValueError("sleep length must be non-negative")
    owner.sleep(seconds(secs))


def _now_ns() -> int:
    owner = running_program()
    return time.time_ns() if owner is None else owner.now()


def _print(*values: object, **options: Any) -> None:
    """Print as Python does, and pass the text to the program's `on_print` function, if set."""
    _REAL_PRINT(*values, **options)
    owner = running_program()
    if owner is None or owner.on_print is None:
        return
    if (file := options.get("file") or sys.stdout) in (sys.stdout, sys.stderr):
        _REAL_PRINT(*values, **{**options, "file": (text := io.StringIO()), "flush": False})
        owner.on_print(text.getvalue(), file is sys.stdout)


_HANDLERS: WeakKeyDictionary[Any, dict[int, Any]] = WeakKeyDictionary()
"""Signal handlers of each program, by signal."""


def _handler_of(number: int) -> Any:
    owner = running_program()
    given = {} if owner is None else _HANDLERS.get(owner, {})
    return given.get(number, signal.getsignal(number))


def _set_handler(number: int, handler: Any) -> Any:
    """Set the calling program's handler for the signal `number`; return the previous handler.

    The program's handler of SIGINT is called when tftool asks the program to end.
    """
    owner, fiber = running_program(), current()
    if owner is None or fiber is None or fiber is not owner.fiber:
        return signal.signal(number, handler)
    before = _handler_of(number)
    _HANDLERS.setdefault(owner, {})[number] = handler
    if number == signal.SIGINT:
        told = partial(handler, number, None) if callable(handler) else None
        fiber.on_interrupt = None if handler is signal.default_int_handler else told
    return before


@cache
def _queues() -> ModuleType:
    """Return a copy of the module `queue` whose timeouts count seconds of tftool's clock."""
    spec = importlib.util.find_spec("queue")
    if spec is None or spec.loader is None:
        return queue
    module = importlib.util.module_from_spec(spec)
    module.__dict__["__builtins__"] = BUILTINS_FOR_USERS
    spec.loader.exec_module(module)
    # The version in C waits in real time; both versions raise the same exceptions.
    module.__dict__["SimpleQueue"] = module._PySimpleQueue
    return module


IMPORTING = locks.UserRLock()
"""Lock for imports of users' modules, which may sleep during the import.

Python's own import locks would block the event loop, and with the loop simulated time.
"""


def _is_imported(name: str, fromlist: Any) -> bool:
    module = sys.modules.get(name)
    if module is None or getattr(module.__spec__, "_initializing", False):
        return False
    return all(one in vars(module) for one in fromlist or ())


SLICE: Duration = seconds(0.01)
"""Longest wait of an event loop, in nanoseconds, before the loop checks sockets and threads."""


class _WorldSelector(selectors.DefaultSelector):
    """Selector for asyncio's event loops; its timeouts count seconds of tftool's clock."""

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
    """Event loop of asyncio for a user's program; the loop's time is the time of tftool's clock."""

    def __init__(self) -> None:
        """Create an event loop for the calling program; the loop is closed at the program's end."""
        super().__init__(_WorldSelector())
        self._owner = running_program()
        self._owner.event_loops.append(self)

    def time(self) -> float:
        """Return the seconds that have passed on tftool's clock since the run started."""
        return float(self._owner.now() - self._owner.clock.epoch) / NANOSECONDS


_replaced: list[asyncio.AbstractEventLoop] = []
"""Event loops that Python created for a thread, stored because a discarded loop logs a warning."""


def _get_event_loop() -> asyncio.AbstractEventLoop:
    """Return the calling thread's event loop; in a user's program, create a loop if there is none.

    Python itself creates loops in the main thread only, but a program runs in another thread.
    """
    owner = running_program()
    try:
        found = asyncio.get_event_loop()
    except RuntimeError:
        if owner is None:
            raise
    else:
        if owner is None or found.is_running() or found in owner.event_loops:
            return found
        # In a test's thread, this is a loop in real time, or the loop of another test.
        if not found.is_closed():
            _replaced.append(found)
    loop = UserEventLoop()
    asyncio.set_event_loop(loop)
    return loop


def _new_event_loop() -> asyncio.AbstractEventLoop:
    """Return a new event loop: on tftool's clock in a user's program, otherwise Python's own."""
    return asyncio.new_event_loop() if running_program() is None else UserEventLoop()


def _run_coroutine(main: Coroutine[Any, Any, Any], *, debug: bool | None = None) -> Any:
    """Run a coroutine to its end in a new event loop, as `asyncio.run` does."""
    factory: Callable[[], asyncio.AbstractEventLoop] | None = None
    if running_program() is not None:
        factory = UserEventLoop
    with asyncio.Runner(debug=debug, loop_factory=factory) as runner:
        return runner.run(main)


_FUTURES = _Shim(
    concurrent.futures,
    {
        "ThreadPoolExecutor": UserThreadPool,
        "wait": wait_for_futures,
        "as_completed": as_completed,
    },
)
_SHIMS: dict[str, ModuleType] = {
    "concurrent": _Shim(concurrent, {"futures": _FUTURES}),
    "concurrent.futures": _FUTURES,
    "time": _Shim(
        time,
        {
            "sleep": _sleep,
            "time": lambda: _now_ns() / NANOSECONDS,
            "time_ns": _now_ns,
            "monotonic": lambda: elapsed_ns() / NANOSECONDS,
            "monotonic_ns": elapsed_ns,
            "perf_counter": lambda: elapsed_ns() / NANOSECONDS,
            "perf_counter_ns": elapsed_ns,
        },
    ),
    "threading": _Shim(
        threading,
        {
            "Thread": UserThread,
            "Timer": UserTimer,
            "Event": locks.UserEvent,
            "Lock": locks.UserLock,
            "RLock": locks.UserRLock,
            "Condition": locks.UserCondition,
            "Semaphore": locks.UserSemaphore,
            "BoundedSemaphore": locks.UserBoundedSemaphore,
            "Barrier": locks.UserBarrier,
        },
    ),
    "signal": _Shim(signal, {"signal": _set_handler, "getsignal": _handler_of}),
    "asyncio": _Shim(
        asyncio,
        {
            "get_event_loop": _get_event_loop,
            "new_event_loop": _new_event_loop,
            "run": _run_coroutine,
        },
    ),
}


def _import(
    name: str, globals: Any = None, locals: Any = None, fromlist: Any = (), level: int = 0
) -> Any:
    if level == 0 and name in _SHIMS:
        # `import concurrent.futures` gives the outer module.
        return _SHIMS[name if fromlist else name.partition(".")[0]]
    if level == 0 and name == "queue":
        return _queues()
    if level == 0 and name == "multiprocessing":
        import multiprocessing

        return _Shim(multiprocessing, {"Process": process_class()})
    owner, fiber = running_program(), current()
    if (
        fiber is None
        or owner is None
        or not owner.strict
        or (level == 0 and _is_imported(name, fromlist))
    ):
        return builtins.__import__(name, globals, locals, fromlist, level)
    with IMPORTING:
        fiber.imports += 1
        try:
            return builtins.__import__(name, globals, locals, fromlist, level)
        finally:
            fiber.imports -= 1


BUILTINS_FOR_USERS = {**vars(builtins), "__import__": _import, "print": _print}
"""Python's builtins with a different `print` and `import`.

A user's module with these builtins imports tftool's versions of time, threading, queue, asyncio,
concurrent.futures and signal.
"""
