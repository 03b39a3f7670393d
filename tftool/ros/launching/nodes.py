"""launch_ros's actions: nodes, their parameters, namespaces and remappings."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from tftool.errors import UsageError
from tftool.ros import names
from tftool.ros.launching.actions import Action
from tftool.ros.launching.context import LaunchContext
from tftool.ros.launching.events import OnProcessExit
from tftool.ros.launching.substitutions import Substitution, perform


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
