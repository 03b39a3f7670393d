"""launch's actions that contain actions: groups, other launch files, functions, timers."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action, LaunchDescription, LaunchDescriptionSource
from tftool.ros.launch.processes import seconds_of
from tftool.ros.launch.settings import (
    Pop,
    Push,
    ResetLaunchConfigurations,
    SetLaunchConfiguration,
)
from tftool.ros.launch.substitutions import perform


class OpaqueFunction(Action):
    """Calls a function of the launch file."""

    def __init__(
        self,
        *,
        function: Callable[..., Any],
        args: Iterable[Any] = (),
        kwargs: Mapping[str, Any] | None = None,
        **rest: Any,
    ) -> None:
        super().__init__(**rest)
        self._call: Callable[..., Any] = lambda context: function(context, *args, **(kwargs or {}))

    def execute(self, context: LaunchContext) -> Any:
        """Call the function; return its result as the next actions."""
        return self._call(context)


class GroupAction(Action):
    """Actions in their own scope."""

    def __init__(
        self,
        actions: Iterable[Any],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[str, Any] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.actions = list(actions)
        self.scoped = scoped
        self.forwarding = forwarding
        self.launch_configurations = dict(launch_configurations or {})

    def execute(self, context: LaunchContext) -> Any:
        """Return all actions."""
        # Asked for outside, where they are passed from.
        inside: list[Any] = [
            SetLaunchConfiguration(perform(context, name), perform(context, value))
            for name, value in self.launch_configurations.items()
        ]
        if not self.scoped:
            return [*inside, *self.actions]
        begin = [Push()] if self.forwarding else [Push(), ResetLaunchConfigurations()]
        return [*begin, *inside, *self.actions, Pop()]

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the actions inside."""
        return self.actions


class IncludeLaunchDescription(Action):
    """Includes another launch file."""

    def __init__(
        self, launch_description_source: Any, *, launch_arguments: Any = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        if isinstance(launch_description_source, LaunchDescription):
            launch_description_source = LaunchDescriptionSource(launch_description_source)
        elif not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = LaunchDescriptionSource(None, launch_description_source)
        self.source: LaunchDescriptionSource = launch_description_source
        if isinstance(launch_arguments, Mapping):
            raise UsageError(
                "launch_arguments are pairs, not a dictionary: write launch_arguments={…}.items()"
            )
        self.launch_arguments = list(launch_arguments or ())

    def execute(self, context: LaunchContext) -> Any:
        """Return its actions, after its arguments."""
        description, path = self.source.load(context)
        arguments = [SetLaunchConfiguration(name, value) for name, value in self.launch_arguments]
        if path is None:
            return [*arguments, *description.entities]
        return [*arguments, _EnterFile(path), *description.entities, _LeaveFile()]


class _EnterFile(Action):
    """Enters an included launch file."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.path = path

    def execute(self, context: LaunchContext) -> Any:
        """Change the current file."""
        context.enter_file(self.path)


class _LeaveFile(Action):
    """Returns to the including launch file."""

    def execute(self, context: LaunchContext) -> Any:
        """Change back the current file."""
        context.files = context.files[:-1]


class TimerAction(Action):
    """Actions after a delay."""

    takes_time: ClassVar[bool] = True

    def __init__(
        self, *, period: Any, actions: Iterable[Any], cancel_on_shutdown: Any = True, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.period, self.actions = period, list(actions)

    def execute(self, context: LaunchContext) -> Any:
        """Schedule the actions.

        Raises:
            UsageError: If the period is no number of seconds.
        """
        period = seconds_of(context, self.period, "a TimerAction's period")
        context.launch.later(self, period, self.actions)

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the actions inside."""
        return self.actions
