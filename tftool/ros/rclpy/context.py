"""Context of rclpy: the state of a program between `rclpy.init` and `rclpy.shutdown`.

Also functions of the modules rclpy.signals and rclpy.utilities.
"""

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, List, Optional  # noqa: UP035

from tftool.ros.host import names, program

# Some programs import what rclpy's own module imports from typing.
__all__ = ["TYPE_CHECKING", "List", "Optional"]


class Context:
    """State of a program between `rclpy.init` and `rclpy.shutdown`."""

    def __init__(self) -> None:
        self._program = program.current()
        self._valid = False
        self._domain: int | None = None
        self._listeners: list[Callable[[], object]] = []
        self._on_shutdown: list[Callable[[], object]] = []
        self.options = self._program.options

    def init(
        self,
        args: Sequence[str] | None = None,
        *,
        initialize_logging: bool = True,
        domain_id: int | None = None,
    ) -> None:
        """Initialise the context.

        Args:
            args: A command line; only the part after `--ros-args` is used.
            initialize_logging: Ignored, because tftool's logging needs no initialisation.
            domain_id: Number that `get_domain_id` returns. Messages to other processes use the
                domain of tftool's option `--domain` instead.

        Raises:
            RuntimeError: If the context was initialised before, or the domain is negative.
            UsageError: If the part after `--ros-args` is malformed.
            UnicodeEncodeError: If an argument is not a string.
        """
        if self._valid:
            raise RuntimeError("Context.init() must only be called once")
        for word in args or ():
            word.encode()  # as in ROS 2, arguments must be valid text
        if args is not None and "--ros-args" in args and list(args) != self._program.argv:
            self.options, _ = names.parse(list(args))
        if domain_id is not None and domain_id < 0:
            raise RuntimeError(f"Domain id ({domain_id}) must not be lower than zero.")
        self._domain = domain_id
        self._valid = True

    def ok(self) -> bool:
        """Return whether the context is initialised and not shut down."""
        return self._valid and not self._program.interrupted

    def shutdown(self) -> None:
        """Shut the context down, which ends all functions that spin.

        Raises:
            RuntimeError: If the context was not initialised.
        """
        if not self._valid:
            if self._program.interrupted:
                return
            raise RuntimeError("Context must be initialized before it can be shutdown")
        self.try_shutdown()

    def try_shutdown(self) -> None:
        """Shut the context down; do nothing if it is shut down already."""
        if not self._valid:
            return
        self._valid = False
        callbacks, self._on_shutdown = self._on_shutdown, []
        for callback in callbacks:
            callback()
        for listener in list(self._listeners):
            listener()

    def on_shutdown(self, callback: Callable[[], object]) -> None:
        """Register a function to call when the context shuts down."""
        self._on_shutdown.append(callback)

    def on_change(self, callback: Callable[[], object]) -> Callable[[], None]:
        """Register `callback`, called at shutdown; return a function that removes the callback."""
        self._listeners.append(callback)
        return lambda: self._listeners.remove(callback)

    def get_domain_id(self) -> int:
        """Return the domain given to `init`, by default 0.

        Messages to other processes use the domain of tftool's option `--domain`, which a program
        cannot read.
        """
        return self._domain or 0

    def destroy(self) -> None:
        """Shut the context down; do nothing if it is shut down already."""
        self.try_shutdown()

    def __enter__(self) -> "Context":
        if not self._valid:
            self.init()
        return self

    def __exit__(self, *args: object) -> None:
        self.try_shutdown()


def get_default_context() -> Context:
    """Return the default context of the calling program; create the context at the first call."""
    owner = program.current()
    if owner.context is None:
        owner.context = Context()
    context: Context = owner.context
    return context


@dataclass(eq=False)
class InitContextManager:
    """Context manager that `rclpy.init` returns; the end of the `with` block shuts rclpy down."""

    context: Context

    def __enter__(self) -> "InitContextManager":
        return self

    def __exit__(self, *args: object) -> None:
        self.context.try_shutdown()


def init(
    *,
    args: Sequence[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: Any = None,
) -> InitContextManager:
    """Initialise rclpy in the calling program; return a context manager that shuts rclpy down.

    Raises:
        RuntimeError: If rclpy is initialised already.
    """
    owner = program.current()
    chosen = context or get_default_context()
    if context is None and not chosen.ok() and not owner.interrupted:
        # As in ROS 2, after a shutdown the default context may be started again.
        owner.executor = None
    chosen.init(args, domain_id=domain_id)
    return InitContextManager(chosen)


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut rclpy down in the calling program, which ends all functions that spin."""
    (context or get_default_context()).shutdown()


def try_shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut rclpy down in the calling program; do nothing if rclpy is shut down already."""
    (context or get_default_context()).try_shutdown()


def ok(*, context: Context | None = None) -> bool:
    """Return whether rclpy is initialised and not shut down."""
    return (context or get_default_context()).ok()


class SignalHandlerOptions(IntEnum):
    """Signals that rclpy handles, as an option of `init`."""

    NO = 0
    ALL = 1
    SIGINT = 2
    SIGTERM = 3


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Return ALL while the default context is initialised, otherwise NO."""
    return SignalHandlerOptions.ALL if ok() else SignalHandlerOptions.NO


def remove_ros_args(args: Sequence[str] | None = None) -> list[str]:
    """Return a command line, by default `sys.argv`, without the parts after `--ros-args`."""
    return names.parse(list(sys.argv if args is None else args))[1]


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Convert a timeout from seconds to nanoseconds; return -1 for None or a negative timeout."""
    if timeout_sec is None or timeout_sec < 0:
        return -1
    return int(float(timeout_sec) * 1e9)


def get_rmw_implementation_identifier() -> str:
    """Return "tftool" instead of the name of a ROS 2 middleware, because none is used."""
    return "tftool"
