"""launch's actions: settings, groups, other launch files, functions, timers, log, events."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action, LaunchDescription, LaunchDescriptionSource
from tftool.ros.launch.events import Event, EventHandler, OnExecutionComplete
from tftool.ros.launch.events import Shutdown as ShutdownEvent
from tftool.ros.launch.processes import seconds_of
from tftool.ros.launch.substitutions import describe, is_true, perform


class DeclareLaunchArgument(Action):
    """Declares an argument of the launch file."""

    def __init__(
        self,
        name: str,
        *,
        default_value: Any = None,
        description: str | None = None,
        choices: Sequence[str] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.name = name
        self.default_value = default_value
        self.choices = None if choices is None else list(choices)
        self.description = description or "no description given"
        if self.choices is not None:
            end = "" if self.description.endswith(".") else "."
            self.description += f"{end} Valid choices are: {self.choices}"

    def execute(self, context: LaunchContext) -> Any:
        """Set the default unless a value was given.

        Raises:
            UsageError: If there is neither, or the value is none of the choices.
        """
        configurations = context.launch_configurations
        if self.name not in configurations:
            if self.default_value is None:
                raise UsageError(
                    f"launch argument '{self.name}' ({self.description}) has no default: pass "
                    f"{self.name}:=…"
                )
            configurations[self.name] = perform(context, self.default_value)
        value = configurations[self.name]
        if self.choices is not None and value not in self.choices:
            raise UsageError(
                f"launch argument '{self.name}' is one of {', '.join(self.choices)}, not '{value}'"
            )
        return None

    def shown_default(self) -> str | None:
        """Return the default as --show-args displays it."""
        return None if self.default_value is None else describe(self.default_value)


class SetLaunchConfiguration(Action):
    """Sets an argument."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set the argument."""
        context.launch_configurations[perform(context, self.name)] = perform(context, self.value)


class UnsetLaunchConfiguration(Action):
    """Removes an argument."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Remove the argument."""
        context.launch_configurations.pop(perform(context, self.name), None)


class ResetLaunchConfigurations(Action):
    """Removes all arguments, or replaces them."""

    def __init__(
        self, launch_configurations: Mapping[Any, Any] | None = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.kept = dict(launch_configurations or {})

    def execute(self, context: LaunchContext) -> Any:
        """Reset the arguments."""
        given = {perform(context, key): perform(context, one) for key, one in self.kept.items()}
        context.launch_configurations = given


class SetEnvironmentVariable(Action):
    """Sets an environment variable for later processes."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set the variable."""
        context.environment[perform(context, self.name)] = perform(context, self.value)


class SetLogFolder(Action):
    """Sets the log folder: used by other programs, since nodes here write no logs."""

    def __init__(self, new_log_dir: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.new_log_dir = new_log_dir

    def execute(self, context: LaunchContext) -> Any:
        """Set the folder, inside the present one unless it is absolute."""
        before = context.environment.get("ROS_LOG_DIR", "")
        folder = os.path.join(before, perform(context, self.new_log_dir))
        context.environment["ROS_LOG_DIR"] = folder


class AppendEnvironmentVariable(Action):
    """Appends to an environment variable, or prepends."""

    def __init__(
        self,
        name: Any,
        value: Any,
        prepend: Any = False,
        separator: Any = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value
        self.prepend, self.separator = prepend, separator

    def execute(self, context: LaunchContext) -> Any:
        """Extend the variable."""
        name, value = perform(context, self.name), perform(context, self.value)
        before = context.environment.get(name)
        parts = [value] if before is None else [before, value]
        if is_true(perform(context, self.prepend)):
            parts.reverse()
        context.environment[name] = perform(context, self.separator).join(parts)


class UnsetEnvironmentVariable(Action):
    """Removes an environment variable."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Remove the variable."""
        context.environment.pop(perform(context, self.name), None)


class PushEnvironment(Action):
    """Saves the environment variables for a PopEnvironment."""

    def execute(self, context: LaunchContext) -> Any:
        """Save the variables."""
        context.environments.append(dict(context.environment))


class PopEnvironment(Action):
    """Restores the environment variables of the last PushEnvironment."""

    def execute(self, context: LaunchContext) -> Any:
        """Restore the variables.

        Raises:
            UsageError: If there was none.
        """
        if not context.environments:
            raise UsageError("there is no PushEnvironment before this PopEnvironment")
        context.environment = context.environments.pop()


class ResetEnvironment(Action):
    """Restores the environment variables of the launch's beginning."""

    def execute(self, context: LaunchContext) -> Any:
        """Restore the variables."""
        context.environment = dict(os.environ)


class Push(Action):
    """Opens a scope."""

    def execute(self, context: LaunchContext) -> Any:
        """Open a scope."""
        context.push()


class Pop(Action):
    """Closes a scope."""

    def execute(self, context: LaunchContext) -> Any:
        """Close the scope."""
        context.pop()


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
    """Actions in a scope of their own."""

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
        """Set the arguments, then return the actions of the included description."""
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
            UsageError: If the period is not a number of seconds.
        """
        period = seconds_of(context, self.period, "a TimerAction's period")
        context.launch.later(self, period, self.actions)

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the actions inside."""
        return self.actions


class LogInfo(Action):
    """Logs a message."""

    def __init__(self, *, msg: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.msg = msg

    def execute(self, context: LaunchContext) -> Any:
        """Log the message."""
        context.launch.info(perform(context, self.msg))


class RegisterEventHandler(Action):
    """Registers an event handler."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[Any]]]:
        """Return what the handler does, as far as it is known before."""
        return [(type(self.event_handler).__name__, getattr(self.event_handler, "entities", []))]

    def execute(self, context: LaunchContext) -> Any:
        """Register the handler."""
        context.launch.handlers.append(self.event_handler)
        handler = self.event_handler
        if isinstance(handler, OnExecutionComplete) and getattr(handler.target, "is_begun", False):
            context.launch.warn(
                "this OnExecutionComplete is never called, as in ROS 2: its "
                f"{_kind(handler.target)} was executed before. Register it above its "
                "target_action"
            )


def _kind(value: Any) -> str:
    return type(value).__name__


class UnregisterEventHandler(Action):
    """Removes an event handler."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> Any:
        """Remove the handler."""
        if self.event_handler in context.launch.handlers:
            context.launch.handlers.remove(self.event_handler)


class EmitEvent(Action):
    """Emits an event."""

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event = event

    def execute(self, context: LaunchContext) -> Any:
        """Emit the event.

        Raises:
            UsageError: If the value is no event.
        """
        if not isinstance(self.event, Event):
            action = " of launch.actions" if isinstance(self.event, Action) else ""
            raise UsageError(f"EmitEvent needs an event, not a {_kind(self.event)}{action}")
        context.launch.emit(self.event)


class Shutdown(Action):
    """Ends the launch."""

    def __init__(self, *, reason: Any = "reason not given", **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.reason = reason

    def execute(self, context: LaunchContext) -> Any:
        """End the launch."""
        context.launch.emit(ShutdownEvent(reason=perform(context, self.reason)))
