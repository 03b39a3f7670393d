"""Command `tftool new`: create a package of nodes, or a scenario."""

import ast
import keyword
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Final

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, argument, flag, option, refuse
from tftool.commands.shared.printer import write_json
from tftool.messages.classes import INTERFACES
from tftool.scenario.builtin import shipped

EXAMPLES = {
    "static": ("static_frame",),
    "broadcaster": ("turtle_broadcaster",),
    "follower": ("turtle_broadcaster", "turtle_follower"),
    "carrot": ("turtle_broadcaster", "turtle_follower", "fixed_carrot"),
    "orbit": ("turtle_broadcaster", "turtle_follower", "moving_carrot"),
    "time_travel": ("turtle_broadcaster", "time_traveller"),
}
"""Steps of the tutorial, with the nodes of each finished step."""


class NewOptions(Command, shares=False):
    """Create a package with example nodes (ros2 pkg create).

    The package contains a finished step of the tutorial: ROS 2 nodes, a launch file, a test and a
    scenario that tests the nodes. The same files run with tftool and under ROS 2. Without ROS 2,
    'pytest --ros-free' runs the test.

    tftool new my_frames
    tftool new my_frames --example carrot --exercise
    tftool new pkg_tf --node-name turtle_tf_broadcaster
    tftool new my_world.yaml --scenario
    """

    name: str = argument(
        "Name of the package to make, or a path that ends in the name.",
        default=...,
        metavar="PACKAGE",
    )
    example: str = option(
        f"Which step of the tutorial: {', '.join(EXAMPLES)}.",
        "--example",
        default="follower",
        metavar="STEP",
    )
    exercise: bool = flag("Replace the important lines of the nodes by TODO, as an exercise.")
    node_name: str = option(
        "Make a package with one empty node of this name, without a step of the tutorial.",
        default="",
        metavar="NAME",
    )
    scenario: bool = flag("Make only a scenario file of that name, without a package.")
    as_json: Json = False


LINES: Final = {
    "static_frame": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame in which the shelf is measured",
        "t.child_frame_id": "TODO: t.child_frame_id, the frame that is new",
        "t.transform.translation.z": "TODO: the height of the shelf, in metres",
    },
    "turtle_broadcaster": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame in which the pose is given",
        "t.child_frame_id": "TODO: t.child_frame_id, the frame that moves",
        "t.transform.rotation.z": "TODO: t.transform.rotation.z, from pose.theta",
        "t.transform.rotation.w": "TODO: t.transform.rotation.w, from pose.theta",
    },
    "turtle_follower": {
        "found": 'raise TransformException("TODO: look up the transform; call it `found`")',
        "command.linear.x": "TODO: command.linear.x, half of the distance to the goal",
        "command.angular.z": "TODO: command.angular.z, the direction of the goal",
    },
    "fixed_carrot": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame that carries the carrot",
        "t.child_frame_id": "TODO: t.child_frame_id, the frame that is new",
        "t.transform.translation.y": "TODO: two metres to the left",
    },
    "moving_carrot": {
        "t.header.frame_id": "TODO: t.header.frame_id, the frame that carries the carrot",
        "t.transform.translation.x": "TODO: t.transform.translation.x, on a circle of two metres",
        "t.transform.translation.y": "TODO: t.transform.translation.y, likewise",
    },
    "time_traveller": {
        "found": 'raise TransformException("TODO: look up turtle1 in the past; call it `found`")',
    },
}
"""Replacement of each key assignment, by node: a comment, or a line if Python needs one."""


def with_blanks(node: str, text: str) -> str:
    """Turn a node's source into an exercise: write a TODO in place of each important assignment.

    Args:
        node: Name of the node, which selects the assignments.
        text: Source code of the node.
    """
    wanted = LINES[node]
    lines = text.splitlines(keepends=True)
    found = [one for one in ast.walk(ast.parse(text)) if isinstance(one, ast.Assign)]
    # From the end, so that the line numbers of earlier assignments stay valid.
    for one in sorted(found, key=lambda one: one.lineno, reverse=True):
        blank = wanted.get(ast.unparse(one.targets[0]))
        if blank is not None:
            mark = "# " if blank.startswith("TODO") else ""
            line = f"{' ' * one.col_offset}{mark}{blank}\n"
            lines[one.lineno - 1 : one.end_lineno] = [line]
    return "".join(lines)


TEMPLATE = "learning_tf"
"""Name of the example package whose files are copied, with this name replaced."""


OF_ROS = {"rclpy", "tf2_py", "tf2_ros", "launch", "launch_ros", "turtlesim", "turtle_tf2_py"}
"""Packages that a new package uses and whose names it may not have, like message packages."""


EMPTY_NODE = """\
def main():
    print("Hi from {package}.")


if __name__ == "__main__":
    main()
"""


def _check_name(name: str) -> None:
    """Raise UsageError for a package name that ROS 2 or Python would not accept."""
    if not re.fullmatch(r"[a-z](_?[a-z0-9])*", name):
        hint = (
            " With --scenario, the name is that of a scenario file."
            if name.endswith((".yaml", ".yml"))
            else ""
        )
        raise UsageError(
            f"'{name}' is not a valid package name: use small letters, digits and single "
            f"underscores, a letter first, as in 'my_frames'.{hint}"
        )
    if keyword.iskeyword(name) or name in sys.stdlib_module_names:
        raise UsageError(f"'{name}' is a keyword or module of Python; choose another name.")

    if name in OF_ROS or name in INTERFACES.packages():
        raise UsageError(f"'{name}' is a package of ROS 2; choose another name.")


def _check_node(name: str) -> None:
    """Raise UsageError for a node name that Python could not import."""
    if not name.isidentifier() or not name.isascii() or keyword.iskeyword(name):
        raise UsageError(
            f"'{name}' is not a valid node name: use letters, digits and underscores, a letter "
            "first, as in 'turtle_tf_broadcaster'."
        )


def _refuse_existing(path: Path) -> None:
    if path.exists() or path.is_symlink():
        raise UsageError(f"'{path}' exists already; nothing was written. Choose another name.")


def _files(package: str, example: str, *, exercise: bool) -> dict[str, str]:
    """Return the files of a tutorial step's package, as a mapping from path to text."""
    nodes = EXAMPLES[example]
    sources = {f"{TEMPLATE}/{node}.py": node for node in nodes}
    step = (f"launch/{example}.launch.py", f"test/test_{example}.py", f"scenarios/{example}.yaml")
    files = _texts(package, nodes, (*sources, *step))
    for source, node in sources.items() if exercise else ():
        name = source.replace(TEMPLATE, package)
        files[name] = with_blanks(node, files[name])
    return files


def _files_of_node(package: str, node: str) -> dict[str, str]:
    """Return the files of a package with one empty node, as from `ros2 pkg create`."""
    files = _texts(package, (), ())
    entry = f'            "{node} = {package}.{node}:main",\n'
    mark = '"console_scripts": [\n'
    files["setup.py"] = files["setup.py"].replace(mark, mark + entry)
    files[f"{package}/{node}.py"] = EMPTY_NODE.format(package=package)
    return files


def _texts(package: str, nodes: Sequence[str], more: Sequence[str]) -> dict[str, str]:
    """Return the files of a package, as a mapping from path to text.

    Args:
        package: Name of the package.
        nodes: Names of the nodes that setup.py installs.
        more: Paths of files to add to the files that every package has.
    """
    source = shipped("examples", TEMPLATE) / TEMPLATE
    every = ("package.xml", "setup.cfg", "setup.py", f"resource/{TEMPLATE}")
    files = {}
    for one in (*every, f"{TEMPLATE}/__init__.py", *more):
        text = (source / one).read_text(encoding="utf-8")
        if one == "setup.py":
            text = "".join(
                line
                for line in text.splitlines(keepends=True)
                if " = learning_tf." not in line or line.split()[0].strip('"') in nodes
            )
        files[one.replace(TEMPLATE, package)] = text.replace(TEMPLATE, package)
    return files


def _write(path: Path, files: dict[str, str]) -> None:
    """Write all files of a package, or no file if one of the files cannot be written."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".new-", dir=path.parent) as place:
            made = Path(place, path.name)
            for name, text in files.items():
                file = made / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            os.rename(made, path)
    except OSError as error:
        raise InputError(f"'{path}' cannot be created: {error.strerror}.") from None


def _make_scenario(path: Path, *, as_json: bool) -> None:
    path = path if path.suffix in (".yaml", ".yml") else path.with_name(f"{path.name}.yaml")
    _refuse_existing(path)
    try:
        shutil.copyfile(shipped("examples", TEMPLATE) / "scenario.yaml", path)
    except OSError as error:
        raise InputError(f"'{path}' cannot be created: {error.strerror}.") from None
    _tell(
        path,
        "",
        (),
        (f"tftool check {path}", "play the scenario"),
        (f"tftool demo {path}", "see it"),
        as_json=as_json,
    )


def _say_what_next(
    path: Path, example: str, files: Collection[str], *, exercise: bool, as_json: bool
) -> None:
    launch = path / "launch" / f"{example}.launch.py"
    _tell(
        path,
        " Write the lines marked TODO." if exercise else "",
        files,
        (f"tftool launch {launch}", "run the nodes; 'tftool demo --join' shows them"),
        (f"pytest --ros-free {path}", "test the nodes, after 'pip install pytest'"),
        (
            f"tftool check {path / 'scenarios' / f'{example}.yaml'} --launch {launch}",
            "play the scenario",
        ),
        as_json=as_json,
    )


def _tell(
    path: Path, todo: str, files: Collection[str], *lines: tuple[str, str], as_json: bool
) -> None:
    """Print the new files, and suggested commands.

    Args:
        path: New package or scenario.
        todo: Sentence on what the user must write; empty if nothing is left to write.
        files: Paths of the new files in the package.
        lines: Suggested commands, each with its purpose.
        as_json: Whether to print JSON.
    """
    if as_json:
        following = [{"command": line, "purpose": purpose} for line, purpose in lines]
        told = {"schema": "tftool.new/1", "made": str(path), "files": sorted(files)}
        write_json({**told, "next": following})
        return
    counted = f": {count(len(files), 'file')}" if files else ""
    sys.stdout.write(f"Made {path}{counted}.{todo}\n")
    for line, purpose in lines:
        sys.stdout.write(f"  {line}\n      {purpose}\n")


def run(options: NewOptions) -> ExitStatus:
    """Run `tftool new`: create a package or a scenario."""
    refuse(
        (
            options.scenario and (options.exercise or options.node_name),
            "--scenario makes a file, not a package: leave out the options of a package.",
        ),
        (
            options.exercise and options.node_name,
            "--exercise and --node-name exclude each other: leave one out.",
        ),
    )
    if options.scenario:
        _make_scenario(Path(options.name), as_json=options.as_json)
        return ExitStatus.DONE
    path = Path(options.name)
    _check_name(path.name)
    if options.example not in EXAMPLES:
        raise UsageError(
            f"there is no example '{options.example}'; there are {', '.join(EXAMPLES)}."
        )
    _refuse_existing(path)
    if options.node_name:
        _check_node(options.node_name)
        files = _files_of_node(path.name, options.node_name)
        _write(path, files)
        run_it = f"tftool run {path / path.name / options.node_name}.py", "run the node"
        _tell(path, "", files, run_it, as_json=options.as_json)
        return ExitStatus.DONE
    files = _files(path.name, options.example, exercise=options.exercise)
    _write(path, files)
    _say_what_next(path, options.example, files, exercise=options.exercise, as_json=options.as_json)
    return ExitStatus.DONE
