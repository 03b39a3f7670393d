"""Packages found in a workspace's sources, as they lie there: nothing is built or installed."""

import ast
import configparser
import re
import sys
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from tftool.errors import InputError, UsageError
from tftool.interfaces.classes import INTERFACES

SHARE = Path(__file__).resolve().parents[1] / "share"
"""Launch files of the packages we stand in for."""

_SKIPPED = {"build", "install", "log", "node_modules", "__pycache__", "venv", "site-packages"}
_DEPTH = 5
_TAKEN = {*sys.stdlib_module_names, "tftool", "numpy", "yaml", "rich", "typer", "pytest"}
"""Python's own modules and ours: interfaces of a package with such a name would hide them."""

_MARKS = ("package.xml", "setup.py", "setup.cfg", "pyproject.toml")


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


class Workspace:
    """The packages below a folder, and above them those of the workspace it belongs to.

    Attributes:
        start: The folder.
        packages: The packages by name.
        skipped: A sentence for each folder that was left out, and why.
    """

    def __init__(self, start: Path) -> None:
        """Look round from `start`; a package that cannot be read is skipped."""
        self.start = start.resolve()
        self.packages: dict[str, Package] = {}
        self.skipped: list[str] = []
        for root in self._roots():
            for folder in _folders(root, _DEPTH):
                try:
                    package = _package(folder)
                except (InputError, OSError) as error:
                    self._skip(folder, error)
                    continue
                if package is not None:
                    self.packages.setdefault(package.name, package)
        for package in self.packages.values():
            try:
                _add_interfaces(package)
            except (InputError, OSError) as error:
                self._skip(package.path, error)

    def _skip(self, folder: Path, error: Exception) -> None:
        sentence = f"'{folder}' is skipped: {error}"
        if sentence not in self.skipped:
            self.skipped.append(sentence)

    def _roots(self) -> list[Path]:
        roots = [self.start]
        for parent in [self.start, *self.start.parents][:4]:
            # A package's folder belongs to the src it lies in; a src to nothing above it.
            if parent.name == "src":
                roots.append(parent)
                break
            if (parent / "src").is_dir():
                roots.append(parent / "src")
                break
            if len(roots) == 1 and any((parent / mark).is_file() for mark in _MARKS):
                roots.append(parent)
        return roots

    def module_folders(self) -> list[str]:
        """The folders that the packages' own Python modules lie in, as when they are installed.

        A package named like one of Python's own modules, or of ours, is left out: it would hide it.
        """
        return [
            str(package.path)
            for name, package in self.packages.items()
            if name not in _TAKEN and (package.path / name / "__init__.py").is_file()
        ]

    def folder_without_mark(self, name: str) -> Path | None:
        """A folder of that name with Python in it that would be a package, had it a package.xml."""
        for root in self._roots():
            for folder in _folders(root, _DEPTH):
                if folder.name == name and any(folder.glob("*.py")):
                    return folder
        return None

    def package(self, name: str) -> Package:
        """The package of a name.

        Raises:
            UsageError: If there is none; the nearest is told.
        """
        found = self.packages.get(name)
        if found is None:
            raise UsageError(missing_package(name, self))
        return found

    def share(self, name: str) -> Path:
        """A package's share directory: its sources, or our stand-in's launch files.

        Raises:
            UsageError: If there is no such package.
        """
        if name not in self.packages and (SHARE / name).is_dir():
            return SHARE / name
        return self.package(name).path


def missing_package(name: str, workspace: Workspace, ours: tuple[str, ...] = ()) -> str:
    """A sentence: there is no such package, and which there are."""
    known = [*workspace.packages, *ours]
    near = get_close_matches(name, known, n=1)
    hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(sorted(known))}"
    where = f"below {workspace.start} or in the src it belongs to"
    skipped = "".join(f"\n{one}" for one in workspace.skipped)
    without = workspace.folder_without_mark(name)
    if without is not None:
        hint = f"'{without}' has no package.xml, setup.py, setup.cfg or pyproject.toml: add one"
    elif not known:
        hint = "there is none at all"
    return f"there is no package '{name}' {where}; {hint}{skipped}"


def _folders(root: Path, depth: int) -> Iterator[Path]:
    yield root
    if depth == 0:
        return
    try:
        below = sorted(one for one in root.iterdir() if one.is_dir())
    except OSError:
        return
    for folder in below:
        if folder.name in _SKIPPED or folder.name.startswith("."):
            continue
        if not folder.is_symlink():
            yield from _folders(folder, depth - 1)
        elif any((folder / mark).is_file() for mark in _MARKS):
            # A package linked into a workspace; where other links lead is not looked at.
            yield folder


def _package(folder: Path) -> Package | None:
    if not any((folder / mark).is_file() for mark in _MARKS) or (folder / "COLCON_IGNORE").exists():
        return None
    scripts: dict[str, str] = {}
    name = ""
    if (folder / "package.xml").is_file():
        match = re.search(r"<name>\s*([\w-]+)\s*</name>", _text(folder / "package.xml"))
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


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read '{path}': {error}") from None


def _from_setup_py(path: Path) -> tuple[str, dict[str, str]]:
    """Name and console scripts of a setup.py, read and not run."""
    try:
        tree = ast.parse(_text(path), str(path))
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
        parser.read_string(_text(path))
    except configparser.Error as error:
        raise InputError(f"{path}: {error}") from None
    return (
        parser.get("metadata", "name", fallback=""),
        _scripts(parser.get("options.entry_points", "console_scripts", fallback="")),
    )


def _from_pyproject(path: Path) -> tuple[str, dict[str, str]]:
    """Name and [project.scripts]; nothing of a file that is no TOML, which names no package."""
    try:
        project = tomllib.loads(_text(path)).get("project", {})
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


def _add_interfaces(package: Package) -> None:
    if package.name in _TAKEN:
        if any((package.path / kind).is_dir() for kind in ("msg", "srv", "action")):
            raise InputError(f"a package of interfaces cannot be named '{package.name}' as well")
        return
    texts = {
        (kind, file.stem): _text(file)
        for kind in ("msg", "srv", "action")
        for file in sorted((package.path / kind).glob(f"*.{kind}"))
    }
    if texts:
        INTERFACES.add(package.name, texts)
