"""launch_ros's actions: nodes, their namespaces and remappings."""

import shlex
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from tftool.errors import UsageError
from tftool.ros.host import names
from tftool.ros.launch.action import Action
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.parameters import read_all
from tftool.ros.launch.processes import Executable, Startable
from tftool.ros.launch.substitutions import Substitution, perform


class Node(Startable):
    """A node: a package's executable, or a file."""

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
        additional_env: Any = None,
        env: Any = None,
        cwd: Any = None,
        shell: Any = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.package, self.executable = package, executable
        self.name, self.namespace, self.exec_name = name, namespace, exec_name
        self.parameters = [parameters] if isinstance(parameters, dict) else list(parameters or ())
        self.remappings = list(remappings or ())
        self.arguments = _listed(arguments)
        self.ros_arguments = _listed(ros_arguments)
        self.additional_env, self.env, self.cwd, self.shell = additional_env, env, cwd, shell

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
        names.check_namespace(options.namespace)
        for old, new in [*self._remappings(context), *context.remaps]:
            names.add_remap(options, f"{old}:={new}")
        own_parameters = read_all(context, self.parameters)
        options.parameters = [*context.parameters, *own_parameters, *options.parameters]
        arguments = [perform(context, one) for one in self.arguments]
        if "--ros-args" in arguments:
            more, arguments = names.parse(arguments)
            options.parameters += more.parameters
            options.remaps += more.remaps
            options.name = more.name or options.name
        package = None if self.package is None else perform(context, self.package)
        executable = perform(context, self.executable)
        if package is None:
            executable = _file(executable)
        self.handle_exit(context)
        self.say_unused(context, "additional_env", "env", "cwd", "shell")
        label = perform(context, self.exec_name) or Path(executable).name
        started = Executable(package, executable, arguments, options, label)
        context.launch.start_node(self, started, self.respawn_after(context))

    def _remappings(self, context: LaunchContext) -> list[tuple[str, str]]:
        return [(perform(context, old), perform(context, new)) for old, new in self.remappings]


def _file(executable: str) -> str:
    """The file a node without a package is, looked for as a shell does.

    Raises:
        UsageError: If there is none, or it is no Python.
    """
    found = shutil.which(executable) or executable
    try:
        with Path(found).open("rb") as file:
            first = file.readline(200)
    except OSError:
        raise UsageError(
            f"there is no file '{executable}' to run; a package's executable needs package='…'"
        ) from None
    if first.startswith(b"\x7fELF") or (first.startswith(b"#!") and b"python" not in first):
        raise UsageError(f"a node is a Python file here, not '{found}': run it by ExecuteProcess")
    return found


def _listed(given: Any) -> list[Any]:
    """A list of words; a single text is split as a shell would."""
    if given is None:
        return []
    if isinstance(given, str):
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
        names.check_namespace(own)
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
