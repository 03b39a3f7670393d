"""`tftool new`: a workspace package to begin with, or a scenario."""

import json
import keyword
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Collection, Sequence
from pathlib import Path

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.commands.new import EXAMPLES, NewOptions
from tftool.commands.new.blanks import with_blanks
from tftool.commands.shared.contradictions import refuse
from tftool.messages.classes import INTERFACES
from tftool.scenario.builtin import shipped

TEMPLATE = "learning_tf"
"""The finished package that each new one is cut from: its name stands where a package's does."""


OF_ROS = {"rclpy", "tf2_py", "tf2_ros", "launch", "launch_ros", "turtlesim", "turtle_tf2_py"}
"""Packages that the files of the new one import, or run; those of messages are known beside."""


EMPTY_NODE = """\
def main():
    print("Hi from {package}.")


if __name__ == "__main__":
    main()
"""


def _check_name(name: str) -> None:
    """Refuse a package name that ROS 2 or Python would not accept."""
    if not re.fullmatch(r"[a-z](_?[a-z0-9])*", name):
        hint = " With --scenario it is a scenario." if name.endswith((".yaml", ".yml")) else ""
        raise UsageError(
            f"'{name}' is no valid package name: use small letters, digits and single "
            f"underscores, a letter first, as in 'my_frames'.{hint}"
        )
    if keyword.iskeyword(name) or name in sys.stdlib_module_names:
        raise UsageError(f"'{name}' is a keyword or module of Python; choose another name.")

    if name in OF_ROS or name in INTERFACES.packages():
        raise UsageError(f"'{name}' is a package of ROS 2; choose another name.")


def _check_node(name: str) -> None:
    """Refuse a node name that Python could not import."""
    if not name.isidentifier() or not name.isascii() or keyword.iskeyword(name):
        raise UsageError(
            f"'{name}' is no valid node name: use letters, digits and underscores, a letter first, "
            "as in 'turtle_tf_broadcaster'."
        )


def _refuse_existing(path: Path) -> None:
    if path.exists() or path.is_symlink():
        raise UsageError(f"'{path}' is there already; nothing was written. Choose another name.")


def _files(package: str, example: str, *, exercise: bool) -> dict[str, str]:
    """Return every file of a tutorial step's package as text, by its path in the package."""
    nodes = EXAMPLES[example]
    sources = {f"{TEMPLATE}/{node}.py": node for node in nodes}
    step = (f"launch/{example}.launch.py", f"test/test_{example}.py", f"scenarios/{example}.yaml")
    files = _texts(package, nodes, (*sources, *step))
    for source, node in sources.items() if exercise else ():
        name = source.replace(TEMPLATE, package)
        files[name] = with_blanks(node, files[name])
    return files


def _files_of_node(package: str, node: str) -> dict[str, str]:
    """Return the files of a package with one empty node, as `ros2 pkg create` makes it."""
    files = _texts(package, (), ())
    entry = f'            "{node} = {package}.{node}:main",\n'
    mark = '"console_scripts": [\n'
    files["setup.py"] = files["setup.py"].replace(mark, mark + entry)
    files[f"{package}/{node}.py"] = EMPTY_NODE.format(package=package)
    return files


def _texts(package: str, nodes: Sequence[str], more: Sequence[str]) -> dict[str, str]:
    """Return the files common to every package, and `more`; setup.py installs `nodes`."""
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
    """Write the whole package, or nothing."""
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
        raise InputError(f"'{path}' cannot be made: {error.strerror}.") from None


def _make_scenario(path: Path, *, as_json: bool) -> None:
    path = path if path.suffix in (".yaml", ".yml") else path.with_name(f"{path.name}.yaml")
    _refuse_existing(path)
    try:
        shutil.copyfile(shipped("examples", TEMPLATE) / "scenario.yaml", path)
    except OSError as error:
        raise InputError(f"'{path}' cannot be made: {error.strerror}.") from None
    _tell(
        path,
        "",
        (),
        (f"tftool check {path}", "judge it"),
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
        (f"tftool launch {launch}", "run it; 'tftool demo --join' shows it"),
        (f"pytest --ros-free {path}", "test it, after 'pip install pytest'"),
        (f"tftool check {path / 'scenarios' / f'{example}.yaml'} --launch {launch}", "judge it"),
        as_json=as_json,
    )


def _tell(
    path: Path, todo: str, files: Collection[str], *lines: tuple[str, str], as_json: bool
) -> None:
    """Print the new files and the next commands with their purpose."""
    if as_json:
        following = [{"command": line, "purpose": purpose} for line, purpose in lines]
        told = {"schema": "tftool.new/1", "made": str(path), "files": sorted(files)}
        sys.stdout.write(json.dumps({**told, "next": following}, indent=2) + "\n")
        return
    counted = f": {count(len(files), 'file')}" if files else ""
    sys.stdout.write(f"Made {path}{counted}.{todo}\n")
    for line, purpose in lines:
        sys.stdout.write(f"  {line}\n      {purpose}\n")


def run(options: NewOptions) -> ExitStatus:
    """Run `tftool new`."""
    refuse(
        (
            options.scenario and (options.exercise or options.node_name),
            "--scenario makes no package: leave it out.",
        ),
        (
            options.exercise and options.node_name,
            "--exercise is about a step: leave out --node-name.",
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
