"""State of a running launch, which actions and substitutions read and change."""

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
"""Largest allowed depth of nested includes of launch files."""


class LaunchContext:
    """State of a running launch: arguments, environment variables, scopes and the current file.

    Attributes:
        launch_configurations: Values of the launch arguments, by name. `scope.py` also stores
            its settings for the scope's nodes here.
        environment: Environment variables for processes, at first a copy of tftool's variables.
        environments: Environments saved by PushEnvironment, the newest last.
        files: Launch files, each included by the one before; the current file is last.
        node_names: Number of nodes that were started, by full name.
        load: Function that reads an included launch file; None outside of a launch.
        launch: Launch that executes the actions; None outside of a launch.
        argv: Arguments of the launch's command line.
        noninteractive: Setting of ROS 2 without effect: tftool never asks the user a question.
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
        self._states: list[tuple[Any, ...]] = []

    @property
    def workspace(self) -> Workspace:
        """Workspace in which the launch searches packages; by default the current workspace."""
        if self._workspace is None:
            self._workspace = current()
        return self._workspace

    @property
    def locals(self) -> SimpleNamespace:
        """Local values of the launch as attributes, such as `event` in an event handler."""
        return SimpleNamespace(**self.get_locals_as_dict())

    def extend_locals(self, extensions: Mapping[str, Any]) -> None:
        """Add or replace local values, given by name in `extensions`."""
        self._locals.update(extensions)

    def push_locals(self) -> None:
        """Save the local values, so that `pop_locals` can restore them."""
        self._outer_locals.append(dict(self._locals))

    def pop_locals(self) -> None:
        """Restore the local values that `push_locals` saved last."""
        self._locals = self._outer_locals.pop()

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return the local values by name."""
        return dict(self._locals)

    def register_event_handler(self, event_handler: Any, append: bool = False) -> None:
        """Register an event handler with the running launch.

        Raises:
            UsageError: If no launch is running.
        """
        self._launched().handlers.append(event_handler)

    def unregister_event_handler(self, event_handler: Any) -> None:
        """Remove an event handler from the running launch.

        Raises:
            UsageError: If no launch is running.
            ValueError: If the handler was not registered.
        """
        self._launched().handlers.remove(event_handler)

    def _launched(self) -> Any:
        if self.launch is None:
            raise UsageError(
                "this LaunchContext belongs to no running launch, so it has no events: use the "
                "context that the launch passes to your function"
            )
        return self.launch

    def number(self, name: str) -> int:
        """Return the number of a name: 1 for the first name used in this launch, then 2, 3, …"""
        return self._numbers.setdefault(name, len(self._numbers) + 1)

    def perform_substitution(self, substitution: Any) -> str:
        """Return the text of a substitution; Python functions in launch files call this method."""
        return str(substitution.perform(self))

    def enter_file(self, path: Path) -> None:
        """Make a launch file the current file.

        Raises:
            UsageError: If the includes of launch files are nested too deep.
        """
        if len(self.files) >= DEEPEST:
            raise UsageError(
                f"'{path}' is nested in {DEEPEST} included launch files: check whether the file "
                "includes itself"
            )
        self.files = (*self.files, path.absolute())

    def copy_state(self) -> tuple[Any, ...]:
        """Return a copy of the arguments, environment variables, current file and local values."""
        return (
            dict(self.launch_configurations),
            dict(self.environment),
            self.files,
            dict(self._locals),
        )

    def push(self) -> None:
        """Open a scope: save arguments, environment variables, current file and local values."""
        self._states.append(self.copy_state())

    def pop(self) -> None:
        """Close the innermost scope, and restore the values that `push` saved for this scope."""
        self._restore(self._states.pop())

    @contextmanager
    def use_state(self, state: tuple[Any, ...]) -> Iterator[None]:
        """Set the state that `copy_state` returned, until the end of the `with` block."""
        now = self.copy_state()
        self._restore(state)
        try:
            yield
        finally:
            self._restore(now)

    def _restore(self, state: tuple[Any, ...]) -> None:
        (self.launch_configurations, self.environment, self.files, self._locals) = state
