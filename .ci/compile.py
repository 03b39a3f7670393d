"""The build hook behind `TFTOOL_COMPILE=1 pip install .`: the scalar path compiled by mypyc.

The same sources, translated to C and built, go into the wheel beside themselves; Python
prefers what is compiled. Without that variable the wheel is plain Python, and needs no
compiler. An editable install gets what is compiled next to the sources.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

SWITCH = "TFTOOL_COMPILE"

# What a lookup and an insert run through, below the buffer itself. The buffer and the tree stay
# plain: compiled code refuses a wrong type in its own words, before ours are reached, and the
# plain buffer reads a frame's fields.
MODULES = (
    "tftool/frames/history.py",
    "tftool/frames/path.py",
    "tftool/geometry/poses.py",
    "tftool/geometry/quaternions.py",
)

# Types are judged when the tests run, with everything installed; here they only steer.
MYPY = ("--ignore-missing-imports", "--follow-imports=silent", "--config-file=", *MODULES)

SETUP = """
import sys
from mypyc.build import mypycify
from setuptools import setup

folder, *words = sys.argv[1:]
extensions = mypycify(
    words, opt_level="3", debug_level="0", group_name="tftool._compiled", target_dir=folder
)
sys.argv[1:] = ["build_ext", "--build-lib", folder, "--build-temp", folder]
setup(name="tftool-compiled", packages=[], py_modules=[], ext_modules=extensions)
"""


class CompiledBuild(BuildHookInterface):  # type: ignore[misc]
    """Compile if asked to."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        """What is needed to build, beyond hatchling."""
        return ["mypy[mypyc]>=1.11", "setuptools>=65"] if wanted() else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the extensions and put them into the wheel."""
        if self.target_name != "wheel" or not wanted():
            return
        root = Path(self.root)
        # In a folder of its own: no C file comes near the sources.
        self.folder = Path(tempfile.mkdtemp(prefix="tftool-compile-"))
        for name in build(root, self.folder):
            if version == "editable":
                shutil.copy(self.folder / name, root / name)
            else:
                build_data["force_include"][str(self.folder / name)] = name
        build_data["pure_python"] = False
        build_data["infer_tag"] = True

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Leave nothing behind."""
        if hasattr(self, "folder"):
            shutil.rmtree(self.folder)


def wanted() -> bool:
    """Whether the one who builds asks for it."""
    return os.environ.get(SWITCH, "") not in ("", "0")


def build(root: Path, folder: Path) -> list[str]:
    """Compile into a folder; what came of it, by its place in the wheel."""
    with tempfile.TemporaryDirectory() as elsewhere:
        # Away from the project's own pyproject.toml, which setuptools would read.
        shutil.copytree(root / "tftool", Path(elsewhere, "tftool"), ignore=_only_sources)
        done = subprocess.run(
            [sys.executable, "-c", SETUP, str(folder), *MYPY],
            cwd=elsewhere,
            capture_output=True,
            text=True,
            check=False,
        )
    if done.returncode:
        raise RuntimeError(f"{SWITCH}=1, but it does not compile:\n{done.stdout}{done.stderr}")
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    return sorted(
        path.relative_to(folder).as_posix() for path in folder.glob(f"tftool/**/*{suffix}")
    )


def _only_sources(_folder: str, names: list[str]) -> set[str]:
    return {name for name in names if "." in name and not name.endswith((".py", ".typed"))}
