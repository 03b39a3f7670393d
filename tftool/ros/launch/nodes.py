"""Action of launch_ros that starts a node."""

import shlex
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import UsageError
from tftool.ros.host import names
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.parameters import normalize_parameters, read_all
from tftool.ros.launch.processes import Executable, Startable, is_python
from tftool.ros.launch.scope import (
    add_node_name,
    get_node_name_count,
    namespace_in,
    normalize_remap_rules,
    parameters_in,
    remaps_in,
)
from tftool.ros.launch.substitutions import Substitution, perform


class Node(Startable):
    """Action that starts a node: an executable of a package, or a file.

    Attributes:
        node_name: Full name of the node; valid once the node is started.
        expanded_node_namespace: Namespace of the node; valid once the node is started. "" if
            neither the action nor its scope has a namespace.
        expanded_remapping_rules: Remapping rules of the scope and the node; None until the node is
            started.
    """

    UNSPECIFIED_NODE_NAME: Final = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE: Final = ""

    def __init__(
        self,
        *,
        executable: Any,
        package: Any = None,
        name: Any = None,
        namespace: Any = None,
        exec_name: Any = None,
        parameters: Any = None,
        remappings: Any = None,
        arguments: Iterable[Any] | None = None,
        ros_arguments: Iterable[Any] | None = None,
        additional_env: Any = None,
        env: Any = None,
        cwd: Any = None,
        shell: Any = False,
        **kwargs: Any,
    ) -> None:
        """Store which program to start, with its name, namespace, parameters and remapping rules.

        Raises:
            TypeError: If `parameters` is not a list of mappings and files, or `remappings` not a
                list of pairs.
        """
        super().__init__(**kwargs)
        self.package, self.executable = package, executable
        self.name, self.namespace, self.exec_name = name, namespace, exec_name
        self.parameters = [] if parameters is None else normalize_parameters(parameters)
        self.remappings = list(normalize_remap_rules(remappings or ()))
        self.arguments = _argument_list(arguments)
        self.ros_arguments = _argument_list(ros_arguments)
        self.additional_env, self.env, self.cwd, self.shell = additional_env, env, cwd, shell
        self.node_name = ""
        self.expanded_node_namespace = self.UNSPECIFIED_NODE_NAMESPACE
        self.expanded_remapping_rules: list[tuple[str, str]] | None = None

    @property
    def node_package(self) -> Any:
        """Package of the node, as passed to `__init__`."""
        return self.package

    @property
    def node_executable(self) -> Any:
        """Executable of the node, as passed to `__init__`."""
        return self.executable

    def is_node_name_fully_specified(self) -> bool:
        """Return whether the launch file sets both the name and the namespace of the node."""
        return bool(self.expanded_node_namespace) and (
            self.UNSPECIFIED_NODE_NAME not in self.node_name
        )

    def _perform_substitutions(self, context: LaunchContext) -> None:
        """Evaluate name, namespace and remapping rules; subclasses in users' code call this."""
        name = self.UNSPECIFIED_NODE_NAME
        if self.name is not None:
            name = perform(context, self.name)
            names.check_node_name(name)
        namespace = namespace_in(context, self.namespace)
        self.expanded_node_namespace = namespace or self.UNSPECIFIED_NODE_NAMESPACE
        self.node_name = f"/{names.join(self.expanded_node_namespace, name)}"
        self.expanded_remapping_rules = remaps_in(context, self.remappings)

    def execute(self, context: LaunchContext) -> Any:
        """Evaluate the node's settings and start the node."""
        self._perform_substitutions(context)
        options, _ = names.parse(
            ["--ros-args", *(perform(context, one) for one in self.ros_arguments)]
        )
        if self.name is not None:
            options.name = perform(context, self.name)
        options.namespace = self.expanded_node_namespace.strip("/")
        for old, new in self.expanded_remapping_rules or ():
            names.add_remap(options, f"{old}:={new}")
        own_parameters = read_all(context, self.parameters)
        options.parameters = [*parameters_in(context), *own_parameters, *options.parameters]
        arguments = [perform(context, one) for one in self.arguments]
        if "--ros-args" in arguments:
            more, arguments = names.parse(arguments)
            options.parameters += more.parameters
            options.remaps += more.remaps
            options.name = more.name or options.name
        package = None if self.package is None else perform(context, self.package)
        executable = perform(context, self.executable)
        if package is None and is_python(executable) and arguments:
            executable, *arguments = arguments
        if package is None:
            executable = python_file(executable)
        self.handle_exit(context)
        self.warn_of_unused(context, "additional_env", "env", "cwd", "shell")
        label = perform(context, self.exec_name) or Path(executable).name
        started = Executable(package, executable, arguments, options, label)
        context.launch.start_node(self, started, self.respawn_after(context))
        self._count_name(context)

    def _count_name(self, context: LaunchContext) -> None:
        if not self.is_node_name_fully_specified():
            return
        add_node_name(context, self.node_name)
        count = get_node_name_count(context, self.node_name)
        if count > 1:
            context.launch.warn(
                f"{self.node_name} is started {count} times by this launch; give each node "
                "a name or a namespace of its own"
            )


def python_file(executable: str) -> str:
    """Return the path of the Python program of a node without a package.

    As in a shell, a name without a folder is searched on the PATH.

    Raises:
        UsageError: If there is no such file, or the file is not a Python program.
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
        raise UsageError(f"'{found}' is not a Python file: run it by ExecuteProcess, not as a Node")
    return found


def _argument_list(arguments: Any) -> list[Any]:
    """Return arguments as a list; a single text is split into words as a shell does."""
    if arguments is None:
        return []
    if isinstance(arguments, str):
        return list(shlex.split(arguments))
    return [arguments] if isinstance(arguments, Substitution) else list(arguments)
