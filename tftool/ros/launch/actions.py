"""Actions of ROS's launch: settings, groups, included files, functions, timers, logs and events."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action, LaunchDescription, LaunchDescriptionSource
from tftool.ros.launch.events import Event, EventHandler, OnExecutionComplete
from tftool.ros.launch.events import Shutdown as ShutdownEvent
from tftool.ros.launch.processes import seconds_of
from tftool.ros.launch.substitutions import describe, is_true, perform


class DeclareLaunchArgument(Action):
    """Action that declares an argument of the launch file."""

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
        """Set the argument to its default unless the command line gives a value.

        Raises:
            UsageError: If there is no value and no default, or the value is not an allowed choice.
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
                f"launch argument '{self.name}' must be one of {', '.join(self.choices)}, "
                f"not '{value}'"
            )
        return None

    def shown_default(self) -> str | None:
        """Return the text that --show-args displays as the default; None without a default."""
        return None if self.default_value is None else describe(self.default_value)


class SetLaunchConfiguration(Action):
    """Action that sets a launch argument."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set the launch argument to its value."""
        context.launch_configurations[perform(context, self.name)] = perform(context, self.value)


class UnsetLaunchConfiguration(Action):
    """Action that removes a launch argument."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Remove the launch argument, if it is set."""
        context.launch_configurations.pop(perform(context, self.name), None)


class ResetLaunchConfigurations(Action):
    """Action that removes all launch arguments, then sets those in `launch_configurations`."""

    def __init__(
        self, launch_configurations: Mapping[Any, Any] | None = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.kept = dict(launch_configurations or {})

    def execute(self, context: LaunchContext) -> Any:
        """Remove all launch arguments, then set the arguments passed to `__init__`."""
        given = {perform(context, key): perform(context, one) for key, one in self.kept.items()}
        context.launch_configurations = given


class SetEnvironmentVariable(Action):
    """Action that sets an environment variable for processes started later."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set the environment variable."""
        context.environment[perform(context, self.name)] = perform(context, self.value)


class SetLogFolder(Action):
    """Action that sets ROS_LOG_DIR, the folder in which processes write log files."""

    def __init__(self, new_log_dir: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.new_log_dir = new_log_dir

    def execute(self, context: LaunchContext) -> Any:
        """Set ROS_LOG_DIR to the folder; a relative path is below the present ROS_LOG_DIR."""
        before = context.environment.get("ROS_LOG_DIR", "")
        folder = os.path.join(before, perform(context, self.new_log_dir))
        context.environment["ROS_LOG_DIR"] = folder


class AppendEnvironmentVariable(Action):
    """Action that appends a value to an environment variable, or with `prepend` prepends it."""

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
        """Append the value to the environment variable, or with `prepend` prepend it."""
        name, value = perform(context, self.name), perform(context, self.value)
        before = context.environment.get(name)
        parts = [value] if before is None else [before, value]
        if is_true(perform(context, self.prepend)):
            parts.reverse()
        context.environment[name] = perform(context, self.separator).join(parts)


class UnsetEnvironmentVariable(Action):
    """Action that removes an environment variable."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Remove the environment variable, if it is set."""
        context.environment.pop(perform(context, self.name), None)


class PushEnvironment(Action):
    """Action that saves all environment variables, for a later PopEnvironment."""

    def execute(self, context: LaunchContext) -> Any:
        """Save all environment variables."""
        context.environments.append(dict(context.environment))


class PopEnvironment(Action):
    """Action that restores the environment variables saved by the last PushEnvironment."""

    def execute(self, context: LaunchContext) -> Any:
        """Restore the environment variables that were saved last.

        Raises:
            UsageError: If no PushEnvironment comes before this action.
        """
        if not context.environments:
            raise UsageError(
                "a PopEnvironment has no environment to restore: add a PushEnvironment before it"
            )
        context.environment = context.environments.pop()


class ResetEnvironment(Action):
    """Action that restores the environment variables that the launch started with."""

    def execute(self, context: LaunchContext) -> Any:
        """Restore the environment variables that the launch started with."""
        context.environment = dict(os.environ)


class Push(Action):
    """Action that opens a scope, which the next Pop closes.

    The Pop restores the launch arguments and environment variables from before the scope.
    """

    def execute(self, context: LaunchContext) -> Any:
        """Open a scope for launch arguments and environment variables."""
        context.push()


class Pop(Action):
    """Action that closes the innermost scope."""

    def execute(self, context: LaunchContext) -> Any:
        """Close the innermost scope; restore the arguments and variables from before the scope."""
        context.pop()


class OpaqueFunction(Action):
    """Action that calls a Python function of the launch file."""

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
        """Call the function with the launch context; return the actions that it returns."""
        return self._call(context)


class GroupAction(Action):
    """Group of actions with its own scope for launch arguments."""

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
        """Return the actions of the group, between a Push and a Pop if the group has a scope."""
        # The values are evaluated in the outer scope, from which they are passed.
        inside: list[Any] = [
            SetLaunchConfiguration(perform(context, name), perform(context, value))
            for name, value in self.launch_configurations.items()
        ]
        if not self.scoped:
            return [*inside, *self.actions]
        begin = [Push()] if self.forwarding else [Push(), ResetLaunchConfigurations()]
        return [*begin, *inside, *self.actions, Pop()]

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the actions of the group."""
        return self.actions


class IncludeLaunchDescription(Action):
    """Action that includes another launch file."""

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
                "launch_arguments must be pairs, not a dictionary: write "
                "launch_arguments={…}.items()"
            )
        self.launch_arguments = list(launch_arguments or ())

    def execute(self, context: LaunchContext) -> Any:
        """Return actions that set the included file's arguments, followed by the file's actions."""
        description, path = self.source.load(context)
        arguments = [SetLaunchConfiguration(name, value) for name, value in self.launch_arguments]
        if path is None:
            return [*arguments, *description.entities]

        def enter(context: LaunchContext) -> None:
            context.enter_file(path)

        def leave(context: LaunchContext) -> None:
            context.files = context.files[:-1]

        # ThisLaunchFileDir in the included file means the folder of that file.
        begin, end = OpaqueFunction(function=enter), OpaqueFunction(function=leave)
        return [*arguments, begin, *description.entities, end]


class TimerAction(Action):
    """Action that executes other actions after a delay."""

    takes_time: ClassVar[bool] = True

    def __init__(
        self, *, period: Any, actions: Iterable[Any], cancel_on_shutdown: Any = True, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.period, self.actions = period, list(actions)

    def execute(self, context: LaunchContext) -> Any:
        """Schedule the actions, to be executed after the delay.

        Raises:
            UsageError: If the period is not a number of seconds.
        """
        period = seconds_of(context, self.period, "a TimerAction's period")
        context.launch.execute_later(self, period, self.actions)

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the actions that are executed after the delay."""
        return self.actions


class LogInfo(Action):
    """Action that logs a message."""

    def __init__(self, *, msg: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.msg = msg

    def execute(self, context: LaunchContext) -> Any:
        """Log the message."""
        context.launch.info(perform(context, self.msg))


class RegisterEventHandler(Action):
    """Action that registers an event handler."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[Any]]]:
        """Return the handler's class name and actions; no actions if a function computes them."""
        return [(type(self.event_handler).__name__, getattr(self.event_handler, "entities", []))]

    def execute(self, context: LaunchContext) -> Any:
        """Register the event handler with the running launch."""
        context.launch.handlers.append(self.event_handler)
        handler = self.event_handler
        if isinstance(handler, OnExecutionComplete) and getattr(handler.target, "is_begun", False):
            context.launch.warn(
                "this OnExecutionComplete is never called, as in ROS 2: its target_action, of "
                f"type {_kind(handler.target)}, was executed earlier. Register the handler before "
                "that action"
            )


def _kind(value: Any) -> str:
    return type(value).__name__


class UnregisterEventHandler(Action):
    """Action that removes an event handler."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> Any:
        """Remove the event handler from the running launch, if it is registered."""
        if self.event_handler in context.launch.handlers:
            context.launch.handlers.remove(self.event_handler)


class EmitEvent(Action):
    """Action that passes an event to the event handlers."""

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event = event

    def execute(self, context: LaunchContext) -> Any:
        """Pass the event to the event handlers.

        Raises:
            UsageError: If the value is not an event.
        """
        if not isinstance(self.event, Event):
            action = " of launch.actions" if isinstance(self.event, Action) else ""
            raise UsageError(f"EmitEvent needs an event, not a {_kind(self.event)}{action}")
        context.launch.emit(self.event)


class Shutdown(Action):
    """Action that ends the launch."""

    def __init__(self, *, reason: Any = "reason not given", **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.reason = reason

    def execute(self, context: LaunchContext) -> Any:
        """Emit the event that ends the launch."""
        context.launch.emit(ShutdownEvent(reason=perform(context, self.reason)))
