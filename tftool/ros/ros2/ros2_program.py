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
from tftool.ros.rclpy.context import init
from tftool.ros.rclpy.node import Node
from tftool.ros.ros2 import ros2_words
from tftool.ros.ros2.topic_verbs import Print, show_lines
from tftool.ros.ros2.verbs import verb_of

NAME = "_ros2cli"
"""Name of the command's own node; as in ROS, the underscore hides it from lists."""


def body(words: Sequence[str], workspace: Workspace, show: Print) -> Callable[[], None]:
    """Return a function that runs the command line `ros2 WORDS` as a program.

    `show` is called with each line to print.

    Raises:
        UsageError: If there is no such command, or the command line names an unknown type.
    """
    args = ros2_words.parse(words)
    if args.noun in ros2_words.SESSIONLESS:
        # The function of `ros2 pkg list` is `_pkg_list`.
        text = globals()[f"_{args.noun}_{args.verb}"](args, workspace)
        return lambda: show_lines(text, show)
    if "values" in args:
        args.message = _message(args)

    def work() -> None:
        init()
        node = Node(NAME, start_parameter_services=False, use_global_arguments=False)
        try:
            status = verb_of(args)(node, args, show)
        finally:
            node.destroy_node()
        if status:
            raise SystemExit(status)

    return work


def _message(args: argparse.Namespace) -> Any:
    """Create the message that a command line describes by a type and a YAML text.

    Raises:
        UsageError: If the type is unknown, or the YAML text does not fit the type.
    """
    kind = {"topic": "msg", "service": "srv", "action": "action"}[args.noun]
    args.kind = rosidl_runtime.interface(args.type, kind)
    part = {"msg": args.kind}.get(kind) or getattr(
        args.kind, "Request" if kind == "srv" else "Goal"
    )
    made = part()
    rosidl_runtime.fill(made, parameter_files.yaml_value(args.values))
    return made


def _pkg_executables(args: argparse.Namespace, workspace: Workspace) -> str:
    found = executables.names(workspace)
    if args.package is not None and args.package not in {package for package, _ in found}:
        workspace.package(args.package)
    return "\n".join(
        str(path) if args.full_path and path else f"{package} {name}"
        for (package, name), path in sorted(found.items())
        if args.package in (None, package)
    )


def _pkg_prefix(args: argparse.Namespace, workspace: Workspace) -> str:
    known = workspace.packages.get(args.package)
    return str(workspace.share(args.package) if known is None or args.share else known.path)


def _pkg_xml(args: argparse.Namespace, workspace: Workspace) -> str:
    """Return the text of a package's package.xml, or the content of one XML tag in the file.

    Raises:
        UsageError: If the package has no package.xml, or the file has no such tag.
    """
    file = workspace.package(args.package).path / "package.xml"
    if not file.is_file():
        raise UsageError(f"package '{args.package}' has no package.xml")
    text = read_text(file)
    if args.tag is None:
        return text
    tag = re.escape(args.tag)
    found = re.findall(rf"<{tag}(?:\s[^>]*)?>\s*(.*?)\s*</{tag}>", text, re.DOTALL)
    if not found:
        raise UsageError(f"package.xml of '{args.package}' has no tag '{args.tag}'")
    return "\n".join(found)


def _interface_list(args: argparse.Namespace, workspace: Workspace) -> str:
    wanted = [kind for kind in rosidl_runtime.KINDS if getattr(args, f"only_{kind}s")]
    lines = []
    for kind in wanted or rosidl_runtime.KINDS:
        found = rosidl_runtime.interfaces(kinds=[kind])
        lines += [f"{rosidl_runtime.KINDS[kind]}:", *(f"    {one}" for one in found)]
    return "\n".join(lines)


def _interface_proto(args: argparse.Namespace, workspace: Workspace) -> str:
    shown = rosidl_runtime.plain(rosidl_runtime.prototype(args.type))
    text = rosidl_runtime.as_yaml(shown) if shown else ""
    return text if args.no_quotes else f'"{text}"'


def _interface_show(args: argparse.Namespace, workspace: Workspace) -> str:
    return rosidl_runtime.definition(args.type)


def _interface_package(args: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(rosidl_runtime.interfaces(args.package))


def _interface_packages(args: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(sorted(INTERFACES.packages()))


def _pkg_list(args: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(sorted({*workspace.packages, *INTERFACES.packages()}))
