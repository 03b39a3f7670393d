"""`tftool new`: a workspace package to begin with, or a scenario."""

import keyword
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.commands.new import EXAMPLES
from tftool.messages.classes import INTERFACES
from tftool.scenario.builtin import shipped

TEMPLATE = "learning_tf"
"""The finished package that each new one is cut from: its name stands where a package's does."""


OF_ROS = {"rclpy", "tf2_py", "tf2_ros", "launch", "launch_ros", "turtlesim", "turtle_tf2_py"}
"""Packages that the files of the new one import, or run; those of messages are known beside."""


def _check_name(name: str) -> None:
    """Refuse what ROS 2 or Python would not take as the name of a package."""
    if not re.fullmatch(r"[a-z](_?[a-z0-9])*", name):
        hint = " With --scenario it is a scenario." if name.endswith((".yaml", ".yml")) else ""
        raise UsageError(
            f"'{name}' is no name for a package: small letters, digits and single "
            f"underscores, a letter first, as in 'my_frames'.{hint}"
        )
    if keyword.iskeyword(name) or name in sys.stdlib_module_names:
        raise UsageError(f"'{name}' is a word of Python's own; choose another name.")

    if name in OF_ROS or name in INTERFACES.packages():
        raise UsageError(f"'{name}' is a package of ROS 2's own; choose another name.")


def _refuse_existing(path: Path) -> None:
    if path.exists() or path.is_symlink():
        raise UsageError(f"'{path}' is there already; nothing was written. Choose another name.")


def _files(package: str, example: str) -> dict[str, str]:
    """The text of every file of the new package, by its path within it."""
    source = shipped("examples", TEMPLATE) / TEMPLATE
    nodes = EXAMPLES[example]
    wanted = [
        "package.xml",
        "setup.cfg",
        "setup.py",
        f"resource/{TEMPLATE}",
        f"{TEMPLATE}/__init__.py",
        *(f"{TEMPLATE}/{node}.py" for node in nodes),
        f"launch/{example}.launch.py",
        f"test/test_{example}.py",
        f"scenarios/{example}.yaml",
    ]
    files = {}
    for one in wanted:
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
    """Make the whole package, or nothing."""
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


def _make_scenario(path: Path) -> None:
    path = path if path.suffix in (".yaml", ".yml") else path.with_name(f"{path.name}.yaml")
    _refuse_existing(path)
    try:
        shutil.copyfile(shipped("examples", TEMPLATE) / "scenario.yaml", path)
    except OSError as error:
        raise InputError(f"'{path}' cannot be made: {error.strerror}.") from None
    _tell(
        f"Made {path}.",
        (f"tftool check {path}", "judge it"),
        (f"tftool demo {path}", "see it"),
    )


def _say_what_next(path: Path, example: str, count: int) -> None:
    launch = path / "launch" / f"{example}.launch.py"
    _tell(
        f"Made {path}: {count} files.",
        (f"tftool launch {launch}", "run it; 'tftool demo --join' shows it"),
        (f"pytest --ros-free {path}", "test it, after 'pip install pytest'"),
        (f"tftool check {path / 'scenarios' / f'{example}.yaml'} --launch {launch}", "judge it"),
    )


def _tell(made: str, *lines: tuple[str, str]) -> None:
    """List the new files and the next commands, each with its purpose."""
    sys.stdout.write(f"{made}\n")
    for line, purpose in lines:
        sys.stdout.write(f"  {line}\n      {purpose}\n")


def run(
    name: str,
    example: str,
    scenario: bool,
) -> ExitStatus:
    """Run `tftool new`; the parameters are its options."""
    if scenario:
        _make_scenario(Path(name))
        return ExitStatus.DONE
    path = Path(name)
    _check_name(path.name)
    if example not in EXAMPLES:
        raise UsageError(f"there is no example '{example}'; there are {', '.join(EXAMPLES)}.")
    _refuse_existing(path)
    files = _files(path.name, example)
    _write(path, files)
    _say_what_next(path, example, len(files))
    return ExitStatus.DONE
