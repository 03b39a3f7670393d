"""What a package's own files say of it, read and not run: package.xml, setup.py and their kin."""

import ast
import configparser
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tftool.errors import InputError

MARKS = ("package.xml", "setup.py", "setup.cfg", "pyproject.toml")
"""One of these in a folder makes it a package."""


@dataclass(frozen=True, slots=True)
class Package:
    """One package's sources.

    Attributes:
        name: What it is called.
        path: Its folder; stands for its share directory too.
        scripts: Its console scripts: name to "module:function".
    """

    name: str
    path: Path
    scripts: Mapping[str, str] = field(default_factory=dict)

    def script_file(self, name: str) -> Path | None:
        """A node's file of that name, for packages that install scripts as they are."""
        for folder in ("scripts", "nodes", self.name, "."):
            for file in (name, f"{name}.py"):
                path = self.path / folder / file
                if path.is_file() and (path.suffix == ".py" or _is_python(path)):
                    return path
        return None


def _is_python(path: Path) -> bool:
    with path.open("rb") as file:
        return file.readline().startswith(b"#!") and b"python" in path.read_bytes()[:80]


def read_package(folder: Path) -> Package | None:
    """The package whose sources a folder holds; None if it holds none.

    Raises:
        InputError: If one of its files cannot be read.
    """
    if not any((folder / mark).is_file() for mark in MARKS) or (folder / "COLCON_IGNORE").exists():
        return None
    scripts: dict[str, str] = {}
    name = ""
    if (folder / "package.xml").is_file():
        match = re.search(r"<name>\s*([\w-]+)\s*</name>", read_text(folder / "package.xml"))
        name = match[1] if match else ""
    for file, read in (
        ("setup.py", _from_setup_py),
        ("setup.cfg", _from_setup_cfg),
        ("pyproject.toml", _from_pyproject),
    ):
        if (folder / file).is_file():
            told, found = read(folder / file)
            name = name or told
            scripts.update(found)
    return Package(name or folder.name, folder, scripts)


def read_text(path: Path) -> str:
    """A file's text.

    Raises:
        InputError: If it cannot be read, or is no UTF-8.
    """
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read '{path}': {error}") from None


def _from_setup_py(path: Path) -> tuple[str, dict[str, str]]:
    """Name and console scripts of a setup.py, read and not run."""
    try:
        tree = ast.parse(read_text(path), str(path))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        # It says so itself when it is built; here it only names no scripts.
        return "", {}
    names: dict[str, Any] = {}
    for statement in tree.body:
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            names[statement.targets[0].id] = _value(statement.value, names)
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and _called(call.func) == "setup":
            try:
                given = {one.arg: _value(one.value, names) for one in call.keywords if one.arg}
            except RecursionError:
                return "", {}
            points = given.get("entry_points")
            listed = points.get("console_scripts", []) if isinstance(points, dict) else points
            name = given.get("name")
            return (name if isinstance(name, str) else "", _scripts(listed))
    return "", {}


def _called(function: ast.expr) -> str:
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ""


def _value(node: ast.expr, names: Mapping[str, Any]) -> Any:
    """A literal, with names and joined texts; None for what only running it would tell."""
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name):
        return names.get(node.id)
    if isinstance(node, ast.List | ast.Tuple):
        return [_value(one, names) for one in node.elts]
    if isinstance(node, ast.Dict):
        return {
            _value(key, names): _value(value, names)
            for key, value in zip(node.keys, node.values, strict=True)
            if key is not None
        }
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = _value(node.left, names), _value(node.right, names)
        if isinstance(left, type(right)) and isinstance(left, str | list):
            return left + right
    if isinstance(node, ast.JoinedStr):
        parts = [
            _value(one.value if isinstance(one, ast.FormattedValue) else one, names)
            for one in node.values
        ]
        return "".join(parts) if all(isinstance(part, str) for part in parts) else None
    return None


def _scripts(listed: Any) -> dict[str, str]:
    lines = listed.splitlines() if isinstance(listed, str) else listed or []
    found = {}
    for line in lines:
        if isinstance(line, str) and "=" in line:
            name, _, target = line.partition("=")
            found[name.strip()] = target.split("[")[0].strip()
    return found


def _from_setup_cfg(path: Path) -> tuple[str, dict[str, str]]:
    parser = configparser.ConfigParser(interpolation=None)
    try:
        parser.read_string(read_text(path))
    except configparser.Error as error:
        raise InputError(f"{path}: {error}") from None
    return (
        parser.get("metadata", "name", fallback=""),
        _scripts(parser.get("options.entry_points", "console_scripts", fallback="")),
    )


def _from_pyproject(path: Path) -> tuple[str, dict[str, str]]:
    """Name and [project.scripts]; nothing of a file that is no TOML, which names no package."""
    try:
        project = tomllib.loads(read_text(path)).get("project", {})
    except (tomllib.TOMLDecodeError, RecursionError):
        return "", {}
    if not isinstance(project, dict):
        return "", {}
    name = project.get("name", "")
    tables = [project.get("scripts"), project.get("entry-points")]
    if isinstance(tables[1], dict):
        tables[1] = tables[1].get("console_scripts")
    scripts = {
        key: target
        for table in tables
        if isinstance(table, dict)
        for key, target in table.items()
        if isinstance(target, str)
    }
    return name if isinstance(name, str) else "", scripts
