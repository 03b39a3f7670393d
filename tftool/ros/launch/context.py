"""State of a running launch."""

import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from tftool.base.errors import UsageError
from tftool.ros.host.workspace import Workspace, current

DEEPEST = 50
"""How many launch files may include each other in a row."""


class LaunchContext:
    """Arguments, environment, the current scope, and the launch itself.

    Attributes:
        launch_configurations: Arguments and their values; and settings for the nodes of the
            scope, as `scope` keeps it.
        environment: Environment variables, a copy.
        environments: Environments saved by PushEnvironment.
        files: The launch file one is in, last, after those that include it.
        node_names: Number of nodes of each full name were started.
        load: Reads a launch file, for those that include one; None outside of a launch.
        launch: Launch that executes the description.
        argv: Arguments of the launch's command line.
        noninteractive: Whether questions are left out, as in ROS 2: here none is ever asked.
    """

    def __init__(
        self,
        workspace: Workspace | None = None,
        load: Callable[[Path], Any] | None = None,
        launch: Any = None,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
    ) -> None:
        self.launch_configurations: dict[str, str] = {}
        self.environment: dict[str, str] = dict(os.environ)
        self.environments: list[dict[str, str]] = []
        self.files: tuple[Path, ...] = ()
        self.node_names: Counter[str] = Counter()
        self.argv = list(argv or ())
        self.noninteractive = noninteractive
        self._workspace = workspace
        self.load = load
        self.launch = launch
        self._numbers: dict[str, int] = {}
        self._locals: dict[str, Any] = {}
        self._outer_locals: list[dict[str, Any]] = []
        self._kept: list[tuple[Any, ...]] = []

    @property
    def workspace(self) -> Workspace:
        """Return the folder where packages are searched: the command's unless another was given."""
        if self._workspace is None:
            self._workspace = current()
        return self._workspace

    @property
    def locals(self) -> SimpleNamespace:
        """Local values: the event being handled, and added ones."""
        return SimpleNamespace(**self.get_locals_as_dict())

    def extend_locals(self, extensions: Mapping[str, Any]) -> None:
        """Add local values."""
        self._locals.update(extensions)

    def push_locals(self) -> None:
        """Begin to handle an event: what is added from here on, `pop_locals` forgets."""
        self._outer_locals.append(dict(self._locals))

    def pop_locals(self) -> None:
        """Forget the local values added since `push_locals`."""
        self._locals = self._outer_locals.pop()

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return the local values by name."""
        return dict(self._locals)

    def register_event_handler(self, event_handler: Any, append: bool = False) -> None:
        """Register an event handler.

        Raises:
            UsageError: If nothing is launched.
        """
        self._launched().handlers.append(event_handler)

    def unregister_event_handler(self, event_handler: Any) -> None:
        """Remove an event handler.

        Raises:
            UsageError: If nothing is launched.
            ValueError: If the handler was not registered.
        """
        self._launched().handlers.remove(event_handler)

    def would_handle_event(self, event: Any) -> bool:
        """Whether a handler matches an event."""
        return bool(self._launched().is_awaited(event))

    def emit_event_sync(self, event: Any) -> None:
        """Pass an event to the handlers.

        Raises:
            UsageError: If nothing is launched.
        """
        self._launched().emit(event)

    async def emit_event(self, event: Any) -> None:
        """Pass an event to the handlers."""
        self.emit_event_sync(event)

    def _launched(self) -> Any:
        if self.launch is None:
            raise UsageError("this context belongs to no running launch, and has no events")
        return self.launch

    def number_of(self, name: str) -> int:
        """Return a number for a name, the same every time."""
        return self._numbers.setdefault(name, len(self._numbers) + 1)

    def perform_substitution(self, substitution: Any) -> str:
        """Return the text of a substitution, for functions of a launch file."""
        return str(substitution.perform(self))

    def enter_file(self, path: Path) -> None:
        """Set the current launch file.

        Raises:
            UsageError: If files include each other too deeply.
        """
        if len(self.files) >= DEEPEST:
            raise UsageError(f"'{path}' is included {DEEPEST} deep: does it include itself?")
        self.files = (*self.files, path.absolute())

    def kept(self) -> tuple[Any, ...]:
        """Return the current scope, for `back_to`."""
        return (
            dict(self.launch_configurations),
            dict(self.environment),
            self.files,
            dict(self._locals),
        )

    def push(self) -> None:
        """Open a scope."""
        self._kept.append(self.kept())

    def pop(self) -> None:
        """Close the scope, and restore everything."""
        self._restore(self._kept.pop())

    @contextmanager
    def back_to(self, kept: tuple[Any, ...]) -> Iterator[None]:
        """Use another scope inside this block."""
        now = self.kept()
        self._restore(kept)
        try:
            yield
        finally:
            self._restore(now)

    def _restore(self, kept: tuple[Any, ...]) -> None:
        (
            self.launch_configurations,
            self.environment,
            self.files,
            self._locals,
        ) = kept
