"""Facts about a package, read from package.xml, setup.py, CMakeLists.txt and other files.

No setup.py is executed.
"""

import ast
import configparser
import glob
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from tftool.base.errors import InputError
from tftool.base.named_files import read_named_text

MARKS = frozenset(("package.xml", "setup.py", "setup.cfg", "pyproject.toml"))
"""Names of files that make a folder a package; one such file is enough."""


@dataclass(frozen=True, slots=True)
class Package:
    """Facts about the source folder of one package.

    Attributes:
        name: Name of the package.
        path: Source folder, also used as the package's share directory.
        scripts: Console scripts: from name to "module:function".
        installed: Files with a different path in the share directory than in the source folder:
            from the installed path to the source file.
        modules: Folders of Python packages that CMakeLists.txt installs
            (`ament_python_install_package`), relative to the source folder.
        programs: Python files that CMakeLists.txt installs (`install(PROGRAMS …)`), by name.
        data_files: Files that setup.py installs; None if only running setup.py would give the
            list.
        compiled: Names of the executables that CMakeLists.txt compiles, such as "talker" and
            "${target}_node".
    """

    name: str
    path: Path
    scripts: Mapping[str, str] = field(default_factory=dict)
    installed: Mapping[str, Path] = field(default_factory=dict)
    modules: Sequence[str] = ()
    programs: Mapping[str, Path] = field(default_factory=dict)
    data_files: frozenset[str] | None = None
    compiled: frozenset[str] = frozenset()

    def script_file(self, name: str) -> Path | None:
        """Return the Python file of an executable in a package without setup.py.

        The name of an executable is the file's name with or without ".py".

        Returns:
            Path of the file; None if there is no such file.
        """
        if name in self.programs:
            return self.programs[name]
        for folder in ("scripts", "nodes", self.name, "."):
            for file in (name, f"{name}.py"):
                path = self.path / folder / file
                if path.is_file() and (path.suffix == ".py" or _is_python(path)):
                    return path
        return None

    def is_compiled(self, name: str) -> bool:
        """Return whether CMakeLists.txt compiles an executable of this name."""
        # A variable, as in a loop over targets, stands for any text.
        patterns = (re.split(r"\$\{\w+\}", one) for one in self.compiled)
        return any(
            re.fullmatch(".+".join(map(re.escape, parts)), name) for parts in patterns if any(parts)
        )

    def path_of_script(self, name: str) -> Path:
        """Return the path that a console script would get if installed into the source folder."""
        return self.path / "lib" / self.name / name

    def executable_at(self, path: Path) -> str | None:
        """Return the name of the executable whose file is `path`; None if there is none."""
        if path.name in self.scripts and path == self.path_of_script(path.name):
            return path.name
        is_node = path == self.script_file(path.name) and b"rclpy" in path.read_bytes()
        return path.name if is_node else None


def _is_python(path: Path) -> bool:
    with path.open("rb") as file:
        return file.readline().startswith(b"#!") and b"python" in path.read_bytes()[:80]


def read_package(folder: Path) -> Package | None:
    """Read the package in a source folder; return None if the folder is not a package.

    Raises:
        InputError: If one of the package's files cannot be read.
    """
    if not any((folder / mark).is_file() for mark in MARKS) or (folder / "COLCON_IGNORE").exists():
        return None
    scripts: dict[str, str] = {}
    name = ""
    if (folder / "package.xml").is_file():
        match = re.search(r"<name>\s*([\w-]+)\s*</name>", read_text(folder / "package.xml"))
        name = match[1] if match else ""
    installed: Any = None
    if (folder / "setup.py").is_file():
        name_there, scripts, installed = _from_setup_py(folder / "setup.py")
        name = name or name_there
    for file, read in (("setup.cfg", _from_setup_cfg), ("pyproject.toml", _from_pyproject)):
        if (folder / file).is_file():
            told, found = read(folder / file)
            name = name or told
            scripts.update(found)
    name = name or folder.name
    moved = dict(_moved(folder, f"share/{name}", installed))
    cmake = folder / "CMakeLists.txt"
    text = read_text(cmake).replace("${PROJECT_NAME}", name) if cmake.is_file() else ""
    modules = _modules_of_cmake(text)
    programs = {}
    for kind, place, source in _installed_by_cmake(text, folder, f"share/{name}"):
        if not source.is_file() or ".." in place.parts:
            continue
        if kind != "PROGRAMS":
            moved[str(place)] = source
        elif source.suffix == ".py" or _is_python(source):
            programs[place.name] = source
    compiled = frozenset(_COMPILED.findall(re.sub(r"#.*", "", text)))
    listed = _listed_files(installed)
    return Package(name, folder, scripts, moved, modules, programs, listed, compiled)


_COMPILED = re.compile(r"(?:add_executable\s*\(|\bEXECUTABLE\b)\s*\"?([\w.${}-]+)")


def _listed_files(data_files: Any) -> frozenset[str] | None:
    """Return the files in the `data_files` of a setup.py; None if the value is not fully known."""
    if not isinstance(data_files, list):
        return None
    listed: set[str] = set()
    for entry in data_files:
        if not (isinstance(entry, list) and len(entry) == 2 and isinstance(entry[1], list)):
            return None
        if not all(isinstance(one, str) for one in entry[1]):
            return None
        listed.update(str(PurePosixPath(one)) for one in entry[1])
    return frozenset(listed)


def _installed_by_cmake(
    text: str, folder: Path, share_path: str
) -> Iterator[tuple[str, PurePosixPath, Path]]:
    """Yield (kind, installed path, source file) of the files that a CMakeLists.txt installs.

    The kind PROGRAMS means a program in `lib`: its installed path is relative to the prefix. The
    kind FILES means any other file: its installed path is relative to the share directory. Files
    that are installed under their source path are left out.
    """
    pattern = r"^[ \t]*install\(\s*(PROGRAMS|FILES|DIRECTORY)\s+([^)]*)\)"
    for kind, call in re.findall(pattern, re.sub(r"#.*", "", text), re.M):
        sources, _, said = call.replace('"', "").partition("DESTINATION")
        target, *more = said.split() or [""]
        renamed = more[more.index("RENAME") + 1] if "RENAME" in more[:-1] else None
        for source in sources.replace("${CMAKE_CURRENT_SOURCE_DIR}/", "").split():
            top = folder / source
            inside = kind == "DIRECTORY" and source.endswith("/")
            place = PurePosixPath(target) if inside else PurePosixPath(target, renamed or top.name)
            if kind == "PROGRAMS" and place.is_relative_to("lib"):
                yield kind, place, top
            if not place.is_relative_to(share_path):
                continue
            place = place.relative_to(share_path)
            if folder / place == top:
                continue
            for file in sorted(top.rglob("*")) if kind == "DIRECTORY" else [top]:
                yield "FILES", place / file.relative_to(top).as_posix(), file


def _modules_of_cmake(text: str) -> list[str]:
    """Return the folders of Python packages that the text of a CMakeLists.txt installs."""
    calls = re.findall(r"ament_python_install_package\(\s*([^)]*)\)", text)
    words = [call.replace('"', "").split() for call in calls]
    return [
        one[one.index("PACKAGE_DIR") + 1] if "PACKAGE_DIR" in one[:-1] else one[0]
        for one in words
        if one
    ]


def _moved(folder: Path, share_path: str, data_files: Any) -> Iterator[tuple[str, Path]]:
    """Yield (installed path, source file) for each file that setup.py installs under a new path.

    The installed path is relative to the share directory, the source file is below `folder`.
    """
    for entry in data_files if isinstance(data_files, list) else ():
        if not (isinstance(entry, list) and len(entry) == 2 and isinstance(entry[1], list)):
            continue
        target, files = entry
        if not isinstance(target, str):
            continue
        below = target.strip("/")
        if f"{below}/".startswith(f"{share_path}/"):
            below = below[len(share_path) :].strip("/")
        elif not below.startswith("lib/"):  # the prefix is the source folder here
            continue
        for file in files:
            if isinstance(file, str) and (folder / file).is_file():
                place = str(PurePosixPath(below, PurePosixPath(file).name))
                if ".." not in PurePosixPath(place).parts and place != str(PurePosixPath(file)):
                    yield place, folder / file


def read_text(path: Path) -> str:
    """Return a file's text, decoded as UTF-8.

    Raises:
        InputError: If the file cannot be read, or is not UTF-8.
    """
    try:
        return read_named_text(path)
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read '{path}': {error}") from None


def _from_setup_py(path: Path) -> tuple[str, dict[str, str], Any]:
    """Return the name, console scripts and data files in a setup.py, without executing the file."""
    try:
        tree = ast.parse(read_text(path), str(path))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        # The build of the package reports the error; here the package only has no scripts.
        return "", {}, None
    literals = _Literals(path.parent)
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and _called(call.func) == "setup":
            try:
                literals.assign(tree.body)
                given = {one.arg: literals.value(one.value) for one in call.keywords if one.arg}
            except RecursionError:
                return "", {}, None
            points = given.get("entry_points")
            listed = points.get("console_scripts", []) if isinstance(points, dict) else points
            name = given.get("name")
            files = given.get("data_files", [])
            return (name if isinstance(name, str) else "", _scripts(listed), files)
    return "", {}, None


def _called(function: ast.expr) -> str:
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ""


class _Literals:
    """Evaluator of simple expressions in a setup.py; the file is never executed.

    The evaluator covers literals, variables, joined texts, and calls of `glob` and `os.path.join`.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._names: dict[str, Any] = {}

    def assign(self, body: Iterable[ast.stmt]) -> None:
        for statement in body:
            if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
                self._names[statement.targets[0].id] = self.value(statement.value)

    def value(self, node: ast.expr) -> Any:
        """Return the value of an expression; None if only running the code would give the value."""
        match node:
            case ast.Constant():
                return node.value
            case ast.Name():
                return self._names.get(node.id)
            case ast.List() | ast.Tuple():
                return [self.value(one) for one in node.elts]
            case ast.Dict():
                return {
                    self.value(key): self.value(value)
                    for key, value in zip(node.keys, node.values, strict=True)
                    if key is not None
                }
            case ast.BinOp(op=ast.Add()):
                left, right = self.value(node.left), self.value(node.right)
                alike = isinstance(left, str | list) and isinstance(left, type(right))
                return left + right if alike else None
            case ast.JoinedStr():
                inner = (
                    one.value if isinstance(one, ast.FormattedValue) else one for one in node.values
                )
                return _joined("", [self.value(one) for one in inner])
            case ast.Call() if _called(node.func) == "join":
                return _joined("/", [self.value(one) for one in node.args])
            case ast.Call() if _called(node.func) in ("glob", "iglob") and node.args:
                deep = any(one.arg == "recursive" for one in node.keywords)
                return self._files(self.value(node.args[0]), deep=deep)
        return None

    def _files(self, pattern: Any, *, deep: bool) -> list[str]:
        """Return the files in the package's folder that match a glob pattern.

        The pattern may contain `**` only if `deep` is true.
        """
        if not isinstance(pattern, str) or Path(pattern).is_absolute() or ".." in pattern:
            return []
        return sorted(glob.glob(pattern, root_dir=self._folder, recursive=deep))


def _joined(between: str, parts: Sequence[Any]) -> str | None:
    return between.join(parts) if all(isinstance(part, str) for part in parts) else None


def _scripts(listed: Any) -> dict[str, str]:
    lines = listed.splitlines() if isinstance(listed, str) else listed or []
    found = {}
    for line in lines:
        if isinstance(line, str) and "=" in line:
            name, _, target = line.partition("=")
            found[name.strip()] = "".join(target.split("[")[0].split())
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
    """Return the name and console scripts in a pyproject.toml; empty values for invalid TOML."""
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
