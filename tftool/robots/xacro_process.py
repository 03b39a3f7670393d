"""Expansion of xacro in a separate process, because a xacro file can run endless Python code.

The process gets the path and the arguments on its command line, and prints one JSON object.
"""

import atexit
import contextlib
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError, UsageError
from tftool.base.plain_text import did_you_mean
from tftool.robots.mesh_folders import packages_around

if sys.platform != "win32":
    import resource

TIME_LIMIT: Final = 20.0
"""Maximum duration of an expansion, seconds."""

MEMORY_LIMIT: Final = 1 << 30
"""Memory, bytes of address space, that an expansion may use in addition to Python and xacro."""

_NO_PACKAGE = re.compile(r"Package not found: (\S+)")
_NO_ARGUMENT = re.compile(r"Undefined substitution argument (\w+)")
_INSTALLED = re.compile(r"install\(\s*DIRECTORY\s+([^()]*?)\s+DESTINATION\s+[\"']?share/")
_MACRO = re.compile(r"<xacro:macro[^>]*\bname\s*=\s*[\"'](\w+)")


def expand(path: Path, arguments: Mapping[str, str]) -> tuple[str, tuple[str, ...]]:
    """Expand a description's xacro in another process.

    Args:
        path: Path of the file, to which paths of included files are relative.
        arguments: Values of xacro arguments.

    Returns:
        The text, and a sentence about each argument that the file does not use.

    Raises:
        InputError: If the file cannot be expanded within `TIME_LIMIT` and `MEMORY_LIMIT`.
        UsageError: If the extra `xacro` is not installed.
    """
    if importlib.util.find_spec("xacrodoc") is None:
        raise UsageError(
            f"'{path}' contains xacro, which needs an extra: pip install 'tftool-tf2[xacro]'"
        )
    refused = f"'{path}' cannot be expanded by xacro"
    command = [sys.executable, "-m", __name__, str(path), json.dumps(dict(arguments))]
    try:
        ended = subprocess.run(command, capture_output=True, timeout=TIME_LIMIT, check=False)
    except subprocess.TimeoutExpired as error:
        raise InputError(f"{refused} within {TIME_LIMIT:g} s") from error
    try:
        said = json.loads(ended.stdout)
    except ValueError:
        said = {"error": f"its process ended with status {ended.returncode}"}
    if "text" in said:
        unused = [name for name in arguments if name not in said["used"]]
        return str(said["text"]), tuple(
            f"'{path}' has no xacro argument '{name}'"
            f"{did_you_mean(name, said['used']) or ', and ignores its value.'}"
            for name in unused
        )
    if missing := _NO_PACKAGE.search(said["error"]):
        raise InputError(
            f"{refused}: there is no package '{missing[1]}': add its parent folder to the "
            "environment variable ROS_PACKAGE_PATH, or source "
            "its workspace"
        )
    if missing := _NO_ARGUMENT.search(said["error"]):
        raise InputError(
            f"'{path}' needs the xacro argument '{missing[1]}': add {missing[1]}:=VALUE"
        )
    raise InputError(f"{refused}: {said['error']}")


def _main(path: str, arguments: str) -> None:
    """Expand a file in the child process; print the result as JSON."""
    # Discard output of the file's expressions: stdout is for the result only.
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as answer:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        json.dump(_expanded(path, _XacroArguments(json.loads(arguments))), answer)


class _XacroArguments(dict[str, str]):
    """Values of xacro arguments, with the names that the file declares or uses."""

    def __init__(self, values: Mapping[str, str]) -> None:
        super().__init__(values)
        self.used: set[str] = set()

    def __contains__(self, name: object) -> bool:
        # xacro:arg looks whether a value was given.
        self.used.add(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self.used.add(name)
        return super().__getitem__(name)


def _expanded(path: str, arguments: _XacroArguments) -> dict[str, Any]:
    from xacrodoc import XacroDoc, packages, xacrodoc

    installed = packages.get_path
    found: dict[str, str] = {}

    def get_path(name: str) -> str:
        # xacro calls this again for every included file.
        if name not in found:
            around = next(packages_around(Path(path), name), None)
            found[name] = str(installed(name)) if around is None else str(_as_installed(around))
        return found[name]

    packages.get_path = get_path
    _bound_memory()
    try:
        # Included files are relative to this file, not to the working folder.
        xacrodoc.xacro.init_stacks(str(Path(path).resolve()))
        # Names of meshes stay unchanged: `mesh_folders` resolves them later, if needed.
        expanded = XacroDoc.from_file(path, subargs=arguments, resolve_packages=False)
        if not expanded.dom.getElementsByTagName("link"):
            macros = _MACRO.findall(Path(path).read_text(encoding="utf-8", errors="replace"))
            if macros:
                return {
                    "error": f"it only defines {'macros' if len(macros) > 1 else 'a macro'} "
                    f"({', '.join(macros[:5])}): name the file that uses them"
                }
        text = str(expanded.dom.toprettyxml(indent="  "))
        return {"text": text, "used": sorted(arguments.used)}
    except BaseException as error:  # expressions in the file can raise anything
        if _lacks_memory(error):
            return {"error": f"it needs more than {MEMORY_LIMIT >> 30} GB of memory"}
        return {"error": " ".join(str(error).split()) or type(error).__name__}


def _as_installed(package: Path) -> Path:
    """Return a folder with the layout that the package gets when CMake installs it.

    If CMakeLists.txt has `install(DIRECTORY description/urdf DESTINATION share/…)`, CMake copies
    urdf/ beside package.xml. A folder of symbolic links reproduces this. Else return `package`.
    """
    try:
        text = (package / "CMakeLists.txt").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return package
    words = (word for found in _INSTALLED.findall(text) for word in found.split())
    # A folder with a final slash is skipped: CMake installs its contents, maybe under another name.
    nested = [package / word for word in words if "/" in word.strip("/") and word[-1] != "/"]
    moved = {one.name: one for one in nested if one.is_dir() and package in one.parents}
    if not moved:
        return package
    share = Path(tempfile.mkdtemp(prefix="tftool-xacro-"))
    atexit.register(shutil.rmtree, share, ignore_errors=True)
    for name, source in {**{one.name: one for one in package.iterdir()}, **moved}.items():
        (share / name).symlink_to(source)
    return share


def _lacks_memory(error: BaseException | None) -> bool:
    """Whether an error is a MemoryError, or was caused by a MemoryError."""
    return error is not None and (
        isinstance(error, MemoryError)
        or _lacks_memory(error.__cause__ or error.__context__ or getattr(error, "exc", None))
    )


def _bound_memory() -> None:
    if sys.platform == "win32":
        return
    # Without /proc, the memory in use is unknown.
    with contextlib.suppress(OSError, ValueError):
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        used = pages * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY_LIMIT, used + MEMORY_LIMIT))


if __name__ == "__main__":
    _main(*sys.argv[1:])
