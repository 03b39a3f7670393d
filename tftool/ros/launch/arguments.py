"""Functions of `ros2 launch`: find a launch file, parse its arguments, list declared arguments."""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from tftool.base.errors import TftoolError, UsageError
from tftool.base.plain_text import near_names
from tftool.ros.host.workspace import FILES, Workspace, file_of, is_file
from tftool.ros.launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import LaunchDescription, LaunchDescriptionEntity
from tftool.ros.launch.frontend import load_file
from tftool.ros.launch.substitutions import perform


def declared_arguments(
    description: LaunchDescription, context: LaunchContext
) -> list[DeclareLaunchArgument]:
    """Return the arguments that a launch description and its included files declare."""
    found: dict[str, DeclareLaunchArgument] = {}

    def look(entities: Iterable[Any]) -> None:
        for entity in entities:
            if isinstance(entity, DeclareLaunchArgument):
                found.setdefault(entity.name, entity)
                if entity.default_value is not None:
                    context.launch_configurations.setdefault(entity.name, "")
            elif isinstance(entity, IncludeLaunchDescription):
                before = set(found)
                files = context.files
                try:
                    passed = {perform(context, name) for name, _ in entity.launch_arguments}
                    inner, path = entity.source.load(context)
                    if path is not None and path.absolute() not in files:
                        context.enter_file(path)
                        look(inner.entities)
                except TftoolError:
                    continue  # the error is reported when the file is included
                finally:
                    context.files = files
                for name in set(found) - before & passed:
                    del found[name]
            elif isinstance(entity, LaunchDescriptionEntity):
                look(entity.describe_sub_entities())
                for _, inside in entity.describe_conditional_sub_entities():
                    look(inside)

    kept = dict(context.launch_configurations)
    look(description.entities)
    context.launch_configurations = kept
    return list(found.values())


def refuse_unknown(
    path: Path, arguments: Mapping[str, str], declared: Sequence[DeclareLaunchArgument]
) -> None:
    """Raise an error if a command line sets an argument that the launch file does not use.

    A name that occurs in the file's text counts as used, because a LaunchConfiguration or a
    function may read the argument.

    Raises:
        UsageError: If an argument is not used; the text names the most similar declared argument.
    """
    names = [one.name for one in declared]
    for name in arguments:
        if name not in names and not _mentions(path, name):
            near = near_names(name, names)
            if near:
                raise UsageError(
                    f"{path.name} declares no argument '{name}'; did you mean '{near[0]}:=…'?"
                )
            there = ", ".join(names) if names else "none"
            raise UsageError(f"{path.name} declares no argument '{name}' (it declares {there})")


def _mentions(path: Path, name: str) -> bool:
    text = path.read_text(encoding="utf-8", errors="replace")
    return re.search(rf"""["'\s]{re.escape(name)}["'\s)]""", text) is not None


def shown_arguments(arguments: Sequence[DeclareLaunchArgument]) -> str:
    """Return the text that `ros2 launch --show-args` prints for the declared arguments."""
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    if not arguments:
        lines += ["", "  No arguments."]
    for one in arguments:
        default = one.shown_default()
        lines += ["", f"    '{one.name}':", f"        {one.description}"]
        if default is not None:
            lines.append(f"        (default: {default})")
    return "\n".join(lines)


def find_launch_file(workspace: Workspace, words: Sequence[str]) -> tuple[Path, list[str]]:
    """Find the launch file that the command line of `ros2 launch` names.

    The words of the command line begin with `FILE` or `PACKAGE FILE`.

    Returns:
        Path of the launch file, and the remaining words.

    Raises:
        UsageError: If there is no such launch file; the text lists the package's launch files.
        InputError: If a path does not exist but a package has such a file.
    """
    first, *rest = words
    if is_file(first):
        return file_of(workspace, first), rest
    folder = workspace.share(first)
    if not rest or ":=" in rest[0]:
        raise UsageError(
            f"write the name of a launch file after package '{first}'. {_listed(folder)}"
        )
    for below in ("launch", "."):
        path = folder / below / rest[0]
        if path.is_file():
            # The path in the source folder, because error texts must name the file that the author
            # knows.
            return path.resolve(), rest[1:]
    raise UsageError(f"package '{first}' has no launch file '{rest[0]}'. {_listed(folder)}")


def _listed(folder: Path) -> str:
    found = sorted(one.name for one in (folder / "launch").glob("*") if one.suffix in FILES)
    return f"The package has {', '.join(found)}." if found else "Its folder 'launch' has none."


def parse_arguments(words: Sequence[str]) -> dict[str, str]:
    """Return the launch arguments on a command line as a mapping from name to value.

    Raises:
        UsageError: If a word does not have the form `name:=value`.
    """
    given = {}
    for word in words:
        name, found, value = word.partition(":=")
        if not found or not name:
            raise UsageError(f"'{word}' is not a launch argument: write name:=value")
        given[name] = value
    return given


def show_arguments(path: Path, workspace: Workspace) -> str:
    """Return the text that `ros2 launch --show-args` prints for a launch file.

    Raises:
        InputError: If the file cannot be read.
    """
    context = LaunchContext(workspace, load_file)
    context.enter_file(path)
    return shown_arguments(declared_arguments(load_file(path), context))
