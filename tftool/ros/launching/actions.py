"""launch's actions: what a description is made of.

`execute` gives further actions, or None; whatever takes time is handed to the
launch (`context.launch`).
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from tftool.errors import UsageError
from tftool.ros import names
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
from tftool.ros.launching.substitutions import Substitution, describe, perform


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


class ParameterValue:
    """A parameter's value of a given type."""

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self.value, self.value_type = value, value_type

    def evaluate(self, context: LaunchContext) -> Any:
        """The value.

        Raises:
            UsageError: If it is not of that type.
        """
        if not _is_text(self.value):
            return _plain(context, self.value)
        text = perform(context, self.value)
        if self.value_type is str:
            return text
        value = names.yaml_value(text)
        if self.value_type is float and isinstance(value, int):
            value = float(value)
        if isinstance(self.value_type, type) and not isinstance(value, self.value_type):
            raise UsageError(
                f"a parameter's value is to be {self.value_type.__name__}, not '{text}'"
            )
        return value


class ParameterFile:
    """A parameter file."""

    def __init__(self, param_file: Any, *, allow_substs: Any = False) -> None:
        self.param_file = param_file


def _is_text(value: Any) -> bool:
    if isinstance(value, str | Substitution):
        return True
    return (
        isinstance(value, list | tuple)
        and bool(value)
        and any(isinstance(one, Substitution) for one in value)
        and all(isinstance(one, str | Substitution) for one in value)
    )


def _plain(context: LaunchContext, value: Any) -> Any:
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if isinstance(value, str):
        return value
    if _is_text(value):
        # What a substitution gives is read as YAML, as ROS 2 reads it.
        return names.yaml_value(perform(context, value))
    if isinstance(value, list | tuple):
        return [_plain(context, one) for one in value]
    return value


class Node(Action):
    """A node: a package's executable."""

    def __init__(
        self,
        *,
        executable: Any,
        package: Any = None,
        name: Any = None,
        namespace: Any = None,
        exec_name: Any = None,
        parameters: Iterable[Any] | None = None,
        remappings: Iterable[Any] | None = None,
        arguments: Iterable[Any] | None = None,
        ros_arguments: Iterable[Any] | None = None,
        output: Any = "log",
        emulate_tty: bool = False,
        respawn: Any = False,
        respawn_delay: float | None = None,
        on_exit: Any = None,
        prefix: Any = None,
        additional_env: Any = None,
        env: Any = None,
        cwd: Any = None,
        shell: bool = False,
        sigterm_timeout: Any = None,
        sigkill_timeout: Any = None,
        node_name: Any = None,
        node_namespace: Any = None,
        node_executable: Any = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.package, self.executable = package, executable
        self.name = name if node_name is None else node_name
        self.namespace = namespace if node_namespace is None else node_namespace
        self.exec_name = exec_name
        self.parameters = [parameters] if isinstance(parameters, dict) else list(parameters or ())
        self.remappings = list(remappings or ())
        self.arguments = _listed(arguments)
        self.ros_arguments = _listed(ros_arguments)
        self.output = output
        self.on_exit = on_exit

    def execute(self, context: LaunchContext) -> Any:
        """Start it."""
        options, _ = names.parse(
            ["--ros-args", *(perform(context, one) for one in self.ros_arguments)]
        )
        if self.name is not None:
            options.name = perform(context, self.name)
            names.check_node_name(options.name)
        own = "" if self.namespace is None else perform(context, self.namespace)
        options.namespace = own if own.startswith("/") else names.join(context.namespace, own)
        for old, new in [*self._remappings(context), *context.remaps]:
            names.add_remap(options, f"{old}:={new}")
        given = [("", name, value) for name, value in context.parameters.items()]
        options.parameters = [*given, *self._parameters(context), *options.parameters]
        arguments = [perform(context, one) for one in self.arguments]
        if "--ros-args" in arguments:
            more, arguments = names.parse(arguments)
            options.parameters += more.parameters
            options.remaps += more.remaps
            options.name = more.name or options.name
        if self.on_exit is not None:
            context.launch.handlers.append(
                OnProcessExit(target_action=self, on_exit=self.on_exit, handle_once=True)
            )
        if self.package is None:
            raise UsageError("a Node needs a package here; run a command by ExecuteProcess")
        context.launch.start_node(
            self,
            perform(context, self.package),
            perform(context, self.executable),
            arguments,
            options,
            None if self.exec_name is None else perform(context, self.exec_name),
        )

    def _remappings(self, context: LaunchContext) -> list[tuple[str, str]]:
        return [(perform(context, old), perform(context, new)) for old, new in self.remappings]

    def _parameters(self, context: LaunchContext) -> list[tuple[str, str, Any]]:
        found: list[tuple[str, str, Any]] = []
        for one in self.parameters:
            if isinstance(one, Mapping):
                named = {perform(context, key): value for key, value in one.items()}
                for name, value in names.flatten(named):
                    found.append(("", name, _plain(context, value)))
            elif isinstance(one, ParameterFile):
                found += names.read_parameters(Path(perform(context, one.param_file)))
            else:
                found += names.read_parameters(Path(perform(context, one)))
        return found


def _listed(given: Any) -> list[Any]:
    """A list of words; a single text is split as a shell would."""
    if given is None:
        return []
    if isinstance(given, str):
        import shlex

        return list(shlex.split(given))
    return [given] if isinstance(given, Substitution) else list(given)


class PushRosNamespace(Action):
    """Puts nodes of the scope into a namespace."""

    def __init__(self, namespace: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.namespace = namespace

    def execute(self, context: LaunchContext) -> Any:
        """Go into it."""
        own = perform(context, self.namespace)
        absolute = own.startswith("/")
        context.namespace = own.strip("/") if absolute else names.join(context.namespace, own)


class SetRemap(Action):
    """Renames a topic for all nodes of the scope."""

    def __init__(self, src: Any, dst: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.src, self.dst = src, dst

    def execute(self, context: LaunchContext) -> Any:
        """Rename it."""
        context.remaps.append((perform(context, self.src), perform(context, self.dst)))


class SetParameter(Action):
    """Sets a parameter for all nodes of the scope."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set it."""
        context.parameters[perform(context, self.name)] = _plain(context, self.value)
