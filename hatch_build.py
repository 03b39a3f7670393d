"""Build hook that compiles the native modules if there are a C compiler and Python's headers.

Otherwise the package is plain Python, with equal results. It is also plain Python with another
interpreter than CPython, without a GIL, or with `TFTOOL_PURE=1`. `tftool --version` prints which
one runs. One build works with every CPython from 3.11 on. In an editable installation, the modules
are put beside their sources.
"""

import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

SOURCES = ("tftool/buffer/_kernel.c", "tftool/messages/_scan.c")

# The compiler must not fuse or reorder operations, because results must equal those of Python.
EXACT = ("-O3", "-std=c11", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math")

WINDOWS = sys.platform == "win32"
SUFFIX = ".pyd" if WINDOWS else ".abi3.so"

# On Windows, setuptools finds the compiler of Visual Studio.
SETUP = """
import sys
from setuptools import Extension, setup

source, name, folder = sys.argv[1:]
module = Extension(name, [source], py_limited_api=True, extra_compile_args=["/O2", "/fp:precise"])
sys.argv[1:] = ["build_ext", "--build-lib", folder, "--build-temp", folder]
setup(name=name, packages=[], py_modules=[], ext_modules=[module])
"""


class KernelBuild(BuildHookInterface):  # type: ignore[misc]
    """Build hook for the native modules."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        """Return the requirements of the build besides hatchling."""
        return ["setuptools>=65"] if WINDOWS else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the modules and put them into the wheel, or print why they are not built."""
        if self.target_name != "wheel":
            return
        if reason := unfit():
            self.app.display_info(f"plain Python: {reason}")
            return
        root = Path(self.root)
        self.folder = Path(tempfile.mkdtemp(prefix="tftool-kernel-"))
        done = []
        for source in map(Path, SOURCES):
            target = self.folder / f"{source.stem}{SUFFIX}"
            if reason := build(root / source, target):
                self.app.display_warning(f"plain Python, {source} does not build: {reason}")
                return
            done.append((target, source.with_name(target.name)))
        for built, place in done:
            if version == "editable":
                # Replace the file, do not overwrite it: a running program may have loaded it.
                copy = root / f"{place}.new"
                shutil.copy(built, copy)
                copy.replace(root / place)
            else:
                build_data["force_include"][str(built)] = place.as_posix()
        build_data["pure_python"] = False
        build_data["tag"] = f"cp311-abi3-{platform()}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove the temporary folder."""
        if hasattr(self, "folder"):
            shutil.rmtree(self.folder)


def unfit() -> str:
    """Return why the modules cannot be built for this Python; empty if they can."""
    if os.environ.get("TFTOOL_PURE", "") not in ("", "0"):
        return "TFTOOL_PURE is set"
    if sys.implementation.name != "cpython":
        return f"the native modules are for CPython, and this is {sys.implementation.name}"
    if sysconfig.get_config_var("Py_GIL_DISABLED"):
        return "the native modules need a GIL, and this Python runs without"
    if not Path(sysconfig.get_path("include"), "Python.h").exists():
        return "there is no Python.h (Debian's is in python3-dev)"
    return ""


def build(source: Path, target: Path) -> str:
    """Compile a source file; return the error, empty if there was none."""
    try:
        done = subprocess.run(
            command(source, target), capture_output=True, text=True, check=False, cwd=target.parent
        )
    except OSError as missing:
        return f"no compiler: {missing}"
    if done.returncode:
        return f"{done.stdout}{done.stderr}".strip()
    if not target.exists():
        target.with_name(
            next(path.name for path in target.parent.glob(f"{source.stem}*.pyd"))
        ).replace(target)
    return ""


def command(source: Path, target: Path) -> list[str]:
    """Return the command that compiles a file, with `CC`, `CFLAGS`, `LDFLAGS` and `ARCHFLAGS`."""
    if WINDOWS:
        return [sys.executable, "-c", SETUP, str(source), source.stem, str(target.parent)]
    told = {name: shlex.split(os.environ.get(name, "")) for name in ("CC", "CFLAGS", "LDFLAGS")}
    compiler = told["CC"] or shlex.split(sysconfig.get_config_var("CC") or "cc")[:1]
    if shutil.which(compiler[0]) is None:
        # Python may have been built on another machine, with a compiler that this machine lacks.
        compiler = ["cc"]
    # Call Python's functions without the procedure linkage table: an insert takes 5 % less time.
    kind = ["-shared", "-fno-plt"]
    if sys.platform == "darwin":
        kind = ["-bundle", "-undefined", "dynamic_lookup"]
        kind += shlex.split(os.environ.get("ARCHFLAGS", ""))
    include = f"-I{sysconfig.get_path('include')}"
    options = [*EXACT, "-fPIC", "-fvisibility=hidden", include, *told["CFLAGS"], *kind]
    return [*compiler, *options, str(source), "-o", str(target), *told["LDFLAGS"], "-lm"]


def platform() -> str:
    """Return the platform tag of the wheel for this Python."""
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")
