"""Check whether ROS 2 would find a package's nodes and launch files after a build.

The check only reads the package's files; nothing is built.
"""

import ast
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from tftool.base.errors import InputError
from tftool.base.plain_text import did_you_mean
from tftool.messages.classes import INTERFACES
from tftool.ros.host import import_table
from tftool.ros.host.package_files import Package, read_text

_LAUNCHES = ("launch", "launch_ros", "ros2launch", "launch_xml", "launch_yaml")
_INSTEAD = {
    "launch": _LAUNCHES,
    "launch_ros": ("launch_ros", "ros2launch"),
    "tf2_ros": ("tf2_ros", "tf2_ros_py"),
}
"""Packages that a dependency on a module may name; by default the package named as the module."""

_DEPENDENCY = re.compile(r"<(depend|exec_depend|run_depend)\b[^>]*>\s*([\w-]+)\s*<")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


@dataclass(frozen=True, slots=True)
class InstalledPart:
    """Part of a package that ROS 2 finds only if a build file declares the part.

    Attributes:
        subject: The part and the declaration, such as "chase/node.py: an entry point in setup.py".
        file: File of the part.
        fault: Reason why ROS 2 would not find the part, with the remedy; "" without a fault.
    """

    subject: str
    file: Path
    fault: str


def installed_parts(package: Package, siblings: Iterable[str] = ()) -> Iterator[InstalledPart]:
    """Yield a package's nodes, launch files and dependencies with the faults in their declarations.

    Raises:
        InputError: If one of the package's files cannot be read.
    """
    others = set(siblings) - {package.name}
    if (package.path / "setup.py").is_file():
        yield from _marks(package)
        yield from _entry_points(package, others)
        yield from _nodes_without_entry_point(package)
    yield from _launch_files(package)
    yield from _dependencies(package, others)


def faults_about(package: Package, file: Path, siblings: Iterable[str] = ()) -> list[str]:
    """Return the reasons why ROS 2 would not find a node or launch file, or its dependencies.

    For a launch file, the faults of the nodes named in the file are included.
    """
    try:
        parts = list(installed_parts(package, siblings))
    except InputError:
        return []  # Reading the file reports the error.
    faults = [part for part in parts if part.fault]
    text = ""
    if any(part.file != file for part in faults) and file.parent.name == "launch":
        text = file.read_text(encoding="utf-8", errors="replace")
    return [one.fault for one in faults if one.file == file or one.file.stem in text]


def entry_point_fault(package: Package, name: str) -> str:
    """Return the reason why a console script cannot start; "" if the script can start."""
    module, _, function = package.scripts[name].partition(":")
    path = package.path.joinpath(*module.split("."))
    if not path.with_suffix(".py").is_file() and not (path / "__init__.py").is_file():
        hint = did_you_mean(module, [_module(package, file) for file in _sources(package)])
        return f"entry point '{name}' names module '{module}', which does not exist{hint}"
    file = path.with_suffix(".py")
    names = _globals(file) if file.is_file() else set()
    first = function.partition(".")[0]
    if names and first not in names:
        hint = did_you_mean(first, names)
        return f"entry point '{name}' names function '{first}', which {file.name} lacks{hint}"
    return ""


def _marks(package: Package) -> Iterator[InstalledPart]:
    mark = package.path / "resource" / package.name
    missing = not mark.is_file() or (
        package.data_files is not None and f"resource/{package.name}" not in package.data_files
    )
    fault = (
        "ament's index does not contain the package: add an empty file "
        f"'resource/{package.name}', and let setup.py install it into "
        "share/ament_index/resource_index/packages"
    )
    yield InstalledPart(
        "the package itself: data_files in setup.py", mark, fault if missing else ""
    )
    config = package.path / "setup.cfg"
    text = read_text(config) if config.is_file() else ""
    fault = (
        f"ros2 run searches executables in lib/{package.name}: write '[install]' and, below it, "
        f"'install_scripts=$base/lib/{package.name}' into setup.cfg"
    )
    found = f"lib/{package.name}" in text
    yield InstalledPart(
        "its executables: install_scripts in setup.cfg", config, "" if found else fault
    )


def _entry_points(package: Package, others: set[str]) -> Iterator[InstalledPart]:
    for name, target in package.scripts.items():
        if target.partition(".")[0] in others:
            continue
        file = package.path.joinpath(*target.partition(":")[0].split(".")).with_suffix(".py")
        yield InstalledPart(
            f"entry point {name} = {target}", file, entry_point_fault(package, name)
        )


def _nodes_without_entry_point(package: Package) -> Iterator[InstalledPart]:
    begun = {target.partition(":")[0] for target in package.scripts.values()}
    for file in _sources(package):
        module = _module(package, file)
        if module in begun or not {"main"} <= _globals(file) or "rclpy" not in _imports(file):
            continue
        yield InstalledPart(
            f"{file.relative_to(package.path)}: an entry point in setup.py",
            file,
            f"no entry point starts {file.name}: add '{file.stem} = {module}:main' to "
            "console_scripts in setup.py",
        )


def _launch_files(package: Package) -> Iterator[InstalledPart]:
    for file in sorted((package.path / "launch").glob("*launch.*")):
        if file.suffix not in (".py", ".xml", ".yaml", ".yml"):
            continue
        inside = f"launch/{file.name}"
        fault = ""
        if package.data_files is not None and inside not in package.data_files:
            fault = (
                f"setup.py does not install {inside}: add ('share/{package.name}/launch', "
                f"['{inside}']) to data_files"
            )
        elif not (package.path / "setup.py").is_file() and not _is_installed_by_cmake(package):
            fault = (
                f"CMakeLists.txt does not install {inside}: add install(DIRECTORY launch "
                "DESTINATION share/${PROJECT_NAME})"
            )
        yield InstalledPart(f"{inside}: installed", file, fault)


def _is_installed_by_cmake(package: Package) -> bool:
    path = package.path / "CMakeLists.txt"
    if not path.is_file():
        return True  # ROS 2 uses the file itself, without a build.
    calls = re.findall(r"\binstall\s*\((.*?)\)", read_text(path), re.DOTALL | re.IGNORECASE)
    return any("launch" in call for call in calls)


def _dependencies(package: Package, others: set[str]) -> Iterator[InstalledPart]:
    if not (package.path / "package.xml").is_file():
        return
    text = _COMMENT.sub("", read_text(package.path / "package.xml"))
    declared = {name for _, name in _DEPENDENCY.findall(text)}
    ours = {name.partition(".")[0] for name in import_table.table()}
    known = (ours | set(INTERFACES.packages()) | others) - {package.name}
    launches = sorted((package.path / "launch").glob("*.py"))
    for file in (*_sources(package), *launches):
        for module in sorted(_imports(file) & known):
            found = declared.intersection(_INSTEAD.get(module, (module,)))
            shown = file.relative_to(package.path)
            fault = (
                f"package.xml names no dependency on {module}, which {shown} imports: add "
                f"<exec_depend>{module}</exec_depend>"
            )
            yield InstalledPart(f"dependency {module} in package.xml", file, "" if found else fault)


def _sources(package: Package) -> list[Path]:
    return sorted((package.path / package.name).rglob("*.py"))


def _module(package: Package, file: Path) -> str:
    return ".".join(file.relative_to(package.path).with_suffix("").parts)


def _tree(file: Path) -> ast.Module:
    """Parse a Python file; return an empty module if the file is unreadable or not valid Python.

    Running such a file reports the error.
    """
    try:
        return ast.parse(read_text(file), str(file))
    except (InputError, SyntaxError, ValueError, RecursionError, MemoryError):
        return ast.Module([], [])


def _globals(file: Path) -> set[str]:
    """Return the names of the functions, classes and imports in a Python file."""
    found: set[str] = set()
    for statement in ast.walk(_tree(file)):
        match statement:
            case (
                ast.FunctionDef(name=name)
                | ast.AsyncFunctionDef(name=name)
                | ast.ClassDef(name=name)
            ):
                found.add(name)
            case ast.Import(names=names) | ast.ImportFrom(names=names):
                found.update(one.asname or one.name for one in names)
            case ast.Name(id=name, ctx=ast.Store()):
                found.add(name)
    return set() if "*" in found else found


def _imports(file: Path) -> set[str]:
    found: set[str] = set()
    for statement in ast.walk(_tree(file)):
        match statement:
            case ast.Import(names=names):
                found.update(one.name.partition(".")[0] for one in names)
            case ast.ImportFrom(module=str(module), level=0):
                found.add(module.partition(".")[0])
    return found
