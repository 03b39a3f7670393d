"""Context of rclpy: the state of a program between `rclpy.init` and `rclpy.shutdown`."""

from collections.abc import Callable, Sequence
from typing import Any

from tftool.ros.host import names, program


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


def context_of(owner: Any) -> Context:
    """Return a program's default context; create the context at the first call."""
    if owner.context is None:
        owner.context = Context()
    context: Context = owner.context
    return context
