"""Command `ros2`, which runs as a program of tftool's world, like a node.

`tftool ros2 …` and launch files that execute `ros2` both run this program, in tftool's process.
"""

import argparse
import re
from collections.abc import Callable, Sequence
from typing import Any

from tftool.base.errors import UsageError
from tftool.messages.classes import INTERFACES
from tftool.ros.host import executables, parameter_files, rosidl_runtime
from tftool.ros.host.package_files import read_text
from tftool.ros.host.workspace import Workspace
from tftool.ros.rclpy import core
from tftool.ros.ros2 import ros2_words
from tftool.ros.ros2.topic_verbs import Print, show_lines
from tftool.ros.ros2.verbs import verb_of

NAME = "_ros2cli"
"""Name of the command's own node; as in ROS, the underscore hides it from lists."""


def body(words: Sequence[str], workspace: Workspace, show: Print) -> Callable[[], None]:
    """Return a function that runs the command line `ros2 WORDS` as a program.

    Args:
        words: Words after `ros2`.
        workspace: Workspace in which packages are searched.
        show: Function called with each line to print.

    Raises:
        UsageError: If there is no such command, or the command line names an unknown type.
    """
    asked = ros2_words.parse(words)
    if asked.noun in ros2_words.SESSIONLESS:
        # The function of `ros2 pkg list` is `_pkg_list`.
        text = globals()[f"_{asked.noun}_{asked.verb}"](asked, workspace)
        return lambda: show_lines(text, show)
    if "values" in asked:
        asked.message = _message(asked)

    def work() -> None:
        core.init()
        node = core.create_node(NAME, start_parameter_services=False, use_global_arguments=False)
        try:
            status = verb_of(asked)(node, asked, show)
        finally:
            node.destroy_node()
        if status:
            raise SystemExit(status)

    return work


def _message(asked: argparse.Namespace) -> Any:
    """Create the message that a command line describes by a type and a YAML text.

    Raises:
        UsageError: If the type is unknown, or the YAML text does not fit the type.
    """
    kind = {"topic": "msg", "service": "srv", "action": "action"}[asked.noun]
    asked.kind = rosidl_runtime.interface(asked.type, kind)
    part = {"msg": asked.kind}.get(kind) or getattr(
        asked.kind, "Request" if kind == "srv" else "Goal"
    )
    made = part()
    rosidl_runtime.fill(made, parameter_files.yaml_value(asked.values))
    return made


def _pkg_executables(asked: argparse.Namespace, workspace: Workspace) -> str:
    found = executables.names(workspace)
    if asked.package is not None and asked.package not in {package for package, _ in found}:
        workspace.package(asked.package)
    return "\n".join(
        str(path) if asked.full_path and path else f"{package} {name}"
        for (package, name), path in sorted(found.items())
        if asked.package in (None, package)
    )


def _pkg_prefix(asked: argparse.Namespace, workspace: Workspace) -> str:
    known = workspace.packages.get(asked.package)
    return str(workspace.share(asked.package) if known is None or asked.share else known.path)


def _pkg_xml(asked: argparse.Namespace, workspace: Workspace) -> str:
    """Return the text of a package's package.xml, or the content of one XML tag in the file.

    Raises:
        UsageError: If the package has no package.xml, or the file has no such tag.
    """
    file = workspace.package(asked.package).path / "package.xml"
    if not file.is_file():
        raise UsageError(f"package '{asked.package}' has no package.xml")
    text = read_text(file)
    if asked.tag is None:
        return text
    tag = re.escape(asked.tag)
    found = re.findall(rf"<{tag}(?:\s[^>]*)?>\s*(.*?)\s*</{tag}>", text, re.DOTALL)
    if not found:
        raise UsageError(f"package.xml of '{asked.package}' has no tag '{asked.tag}'")
    return "\n".join(found)


def _interface_list(asked: argparse.Namespace, workspace: Workspace) -> str:
    wanted = [kind for kind in rosidl_runtime.KINDS if getattr(asked, f"only_{kind}s")]
    lines = []
    for kind in wanted or rosidl_runtime.KINDS:
        found = rosidl_runtime.interfaces(kinds=[kind])
        lines += [f"{rosidl_runtime.KINDS[kind]}:", *(f"    {one}" for one in found)]
    return "\n".join(lines)


def _interface_proto(asked: argparse.Namespace, workspace: Workspace) -> str:
    shown = rosidl_runtime.plain(rosidl_runtime.prototype(asked.type))
    text = rosidl_runtime.as_yaml(shown) if shown else ""
    return text if asked.no_quotes else f'"{text}"'


def _interface_show(asked: argparse.Namespace, workspace: Workspace) -> str:
    return rosidl_runtime.definition(asked.type)


def _interface_package(asked: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(rosidl_runtime.interfaces(asked.package))


def _interface_packages(asked: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(sorted(INTERFACES.packages()))


def _pkg_list(asked: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(sorted({*workspace.packages, *INTERFACES.packages()}))
