"""launch's actions: what a description is made of.

`execute` gives further actions, or None; whatever takes time is handed to the
launch (`context.launch`).
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from tftool.errors import UsageError
from tftool.ros.launching.context import LaunchContext
from tftool.ros.launching.description import LaunchDescription, LaunchDescriptionSource
from tftool.ros.launching.events import (
    Event,
    EventHandler,
    ExecutionComplete,
    OnProcessExit,
)
from tftool.ros.launching.events import (
    Shutdown as ShutdownEvent,
)
from tftool.ros.launching.substitutions import describe, perform


class Action:
    """One thing to do."""

    def __init__(self, *, condition: Any = None, **kwargs: Any) -> None:
        self.condition = condition
        if kwargs:
            raise TypeError(
                f"{type(self).__name__} takes no argument {', '.join(map(repr, kwargs))} here"
            )

    def visit(self, context: LaunchContext) -> Any:
        """Do it, if its condition holds; what is to be done next."""
        if self.condition is not None and not self.condition.evaluate(context):
            return None
        following = self.execute(context)
        context.launch.emit(ExecutionComplete(action=self))
        return following

    def execute(self, context: LaunchContext) -> Any:
        """Do it."""
        return None

    def describe_sub_entities(self) -> Sequence[Any]:
        """Actions inside, for looking for arguments."""
        return ()


class DeclareLaunchArgument(Action):
    """An argument that the launch file takes."""

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
        self.description = description or "no description given"
        self.choices = None if choices is None else list(choices)

    def execute(self, context: LaunchContext) -> Any:
        """Take the default unless a value was passed.

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
        """The default as --show-args shows it."""
        return None if self.default_value is None else describe(self.default_value)


class SetLaunchConfiguration(Action):
    """Gives an argument a value."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set it."""
        context.launch_configurations[perform(context, self.name)] = perform(context, self.value)


class UnsetLaunchConfiguration(Action):
    """Takes an argument's value away."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Unset it."""
        context.launch_configurations.pop(perform(context, self.name), None)


class SetEnvironmentVariable(Action):
    """Gives an environment variable a value, for processes to come."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set it."""
        context.environment[perform(context, self.name)] = perform(context, self.value)


class UnsetEnvironmentVariable(Action):
    """Takes an environment variable away."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Unset it."""
        context.environment.pop(perform(context, self.name), None)


class LogInfo(Action):
    """Says something."""

    def __init__(self, *, msg: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.msg = msg

    def execute(self, context: LaunchContext) -> Any:
        """Say it."""
        context.launch.info(perform(context, self.msg))


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
        """Call it; what it returns is done next."""
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
        """Do them all."""
        inside: list[Any] = [
            SetLaunchConfiguration(name, value)
            for name, value in self.launch_configurations.items()
        ]
        if not self.scoped:
            return [*inside, *self.actions]
        return [_Push(), *inside, *self.actions, _Pop()]

    def describe_sub_entities(self) -> Sequence[Any]:
        """The actions inside."""
        return self.actions


class _Push(Action):
    def execute(self, context: LaunchContext) -> Any:
        """Begin a scope."""
        context.push()


class _Pop(Action):
    def execute(self, context: LaunchContext) -> Any:
        """End it."""
        context.pop()


PushLaunchConfigurations = _Push
PopLaunchConfigurations = _Pop


class IncludeLaunchDescription(Action):
    """Another launch file."""

    def __init__(
        self, launch_description_source: Any, *, launch_arguments: Any = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        if isinstance(launch_description_source, LaunchDescription):
            launch_description_source = LaunchDescriptionSource(launch_description_source)
        elif not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = LaunchDescriptionSource(None, launch_description_source)
        self.source: LaunchDescriptionSource = launch_description_source
        given = launch_arguments or ()
        self.launch_arguments = list(given.items() if isinstance(given, Mapping) else given)

    def execute(self, context: LaunchContext) -> Any:
        """Its actions, after its arguments."""
        description, path = self.source.load(context)
        arguments = [SetLaunchConfiguration(name, value) for name, value in self.launch_arguments]
        before = dict(context.locals)
        enter, leave = _Locals(path, before), _Locals(None, before)
        return [*arguments, enter, *description.entities, leave]


class _Locals(Action):
    """Which file one is in."""

    def __init__(self, path: Path | None, before: Mapping[str, str]) -> None:
        super().__init__()
        self.path, self.before = path, before

    def execute(self, context: LaunchContext) -> Any:
        """Note it."""
        context.locals = dict(self.before)
        if self.path is not None:
            context.locals["current_launch_file_path"] = str(self.path)
            context.locals["current_launch_file_directory"] = str(self.path.parent)


class RegisterEventHandler(Action):
    """Does something when something happens."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> Any:
        """Begin to listen."""
        context.launch.handlers.append(self.event_handler)


class UnregisterEventHandler(Action):
    """Does it no more."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> Any:
        """Listen no more."""
        if self.event_handler in context.launch.handlers:
            context.launch.handlers.remove(self.event_handler)


class EmitEvent(Action):
    """Makes something happen."""

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event = event

    def execute(self, context: LaunchContext) -> Any:
        """Emit it."""
        context.launch.emit(self.event)


class Shutdown(EmitEvent):
    """Ends the launch."""

    def __init__(self, *, reason: str = "reason not given", **kwargs: Any) -> None:
        super().__init__(event=ShutdownEvent(reason=reason), **kwargs)


class TimerAction(Action):
    """Actions after a while."""

    def __init__(
        self, *, period: Any, actions: Iterable[Any], cancel_on_shutdown: Any = True, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.period, self.actions = period, list(actions)

    def execute(self, context: LaunchContext) -> Any:
        """Have them done later.

        Raises:
            UsageError: If the period is no number of seconds.
        """
        text = perform(context, self.period)
        try:
            period = float(text)
        except ValueError:
            raise UsageError(f"a TimerAction's period is seconds, not '{text}'") from None
        context.launch.later(period, self.actions)

    def describe_sub_entities(self) -> Sequence[Any]:
        """The actions inside."""
        return self.actions


class ExecuteProcess(Action):
    """A command of the system."""

    def __init__(
        self,
        *,
        cmd: Iterable[Any],
        name: Any = None,
        cwd: Any = None,
        env: Mapping[Any, Any] | None = None,
        additional_env: Mapping[Any, Any] | None = None,
        shell: bool = False,
        output: Any = "log",
        on_exit: Any = None,
        prefix: Any = None,
        respawn: Any = False,
        respawn_delay: float | None = None,
        emulate_tty: bool = False,
        sigterm_timeout: Any = None,
        sigkill_timeout: Any = None,
        log_cmd: bool = False,
        output_format: str = "",
        cached_output: bool = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.cmd = list(cmd)
        self.process_name = name
        self.cwd, self.env, self.additional_env = cwd, env, additional_env
        self.shell = shell
        self.on_exit = on_exit
        self.output = output

    def execute(self, context: LaunchContext) -> Any:
        """Start it."""
        words = [perform(context, word) for word in self.cmd]
        environment = dict(context.environment)
        if self.env is not None:
            environment = _texts(context, self.env)
        environment.update(_texts(context, self.additional_env or {}))
        cwd = None if self.cwd is None else perform(context, self.cwd)
        if self.process_name is None:
            name = Path(words[0].split()[0]).name if words[0].strip() else "process"
        else:
            name = perform(context, self.process_name)
        if self.on_exit is not None:
            context.launch.handlers.append(
                OnProcessExit(target_action=self, on_exit=self.on_exit, handle_once=True)
            )
        context.launch.start_process(self, name, words, environment, cwd, self.shell)


def _texts(context: LaunchContext, given: Mapping[Any, Any]) -> dict[str, str]:
    return {perform(context, key): perform(context, value) for key, value in given.items()}


ExecuteLocal = ExecuteProcess
