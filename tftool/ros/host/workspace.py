"""Packages of a ROS workspace, found in its source folders without building or installing them."""

import os
import shutil
import sys
import tempfile
import weakref
from collections.abc import Iterator, Mapping
from functools import cached_property
from itertools import chain
from pathlib import Path, PurePosixPath

from tftool.base.errors import InputError, UsageError
from tftool.base.plain_text import near_names
from tftool.messages.classes import INTERFACES
from tftool.ros.host.package_files import MARKS, Package, read_package, read_text


class ShareFolder:
    """Temporary folder that imitates a package's installed share directory by symbolic links.

    The folder contains links to the package's source files, and links at the paths under which
    setup.py or CMakeLists.txt installs files.

    Attributes:
        path: Path of the folder, which is deleted with this object.
    """

    def __init__(self, source: Path, installed: Mapping[str, Path]) -> None:
        """Create the folder and the links in it.

        Args:
            source: Source folder of the package; its files are linked under the same paths.
            installed: Further links: from a path relative to the new folder to the linked file.
        """
        self.path = Path(tempfile.mkdtemp(prefix="tftool-share-")).resolve()
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)
        parents = {str(one) for place in installed for one in PurePosixPath(place).parents}
        for parent in sorted(parents):
            self._link(source, parent, parents)
        for place, file in installed.items():
            target = self.path / place
            if not target.exists():
                _link(file, target)

    def _link(self, source: Path, subfolder: str, parents: set[str]) -> None:
        """Link the entries of one source folder, except hidden entries and __pycache__.

        Args:
            source: Source folder of the package.
            subfolder: Path, relative to `source`, of the folder whose entries are linked.
            parents: Paths, relative to `source`, of folders to leave out. These are real
                folders, not links, because files are installed into them.
        """
        (self.path / subfolder).mkdir(parents=True, exist_ok=True)
        there = source / subfolder
        for one in there.iterdir() if there.is_dir() else ():
            place = str(PurePosixPath(subfolder, one.name))
            if not (one.name.startswith(".") or one.name == "__pycache__" or place in parents):
                _link(one, self.path / place)


def _link(file: Path, target: Path) -> None:
    try:
        os.symlink(file.resolve(), target, target_is_directory=file.is_dir())
    except OSError:
        # Windows needs a privilege to create a symbolic link.
        if file.is_file():
            shutil.copy2(file, target)


SHARE = Path(__file__).resolve().parents[1] / "share"
"""Folder with tftool's own launch files of ROS packages."""

_SKIPPED = {"build", "install", "log", "node_modules", "__pycache__", "venv", "site-packages"}
_DEPTH = 5
_KINDS = ("msg", "srv", "action")
TAKEN = {*sys.stdlib_module_names, "tftool", "numpy", "yaml", "rich", "typer", "pytest"}
"""Names of Python's and tftool's modules, which a package of the same name would hide."""

WITH_MODULES: set[str] = set()
"""Packages with both interfaces and Python modules."""


class Workspace:
    """Packages in the source folders below the folder `start` and in the workspace around it."""

    def __init__(self, start: Path, near: Path | None = None) -> None:
        """Find the packages around and below the folder `start`; skip unreadable packages.

        Args:
            start: The folder.
            near: File or folder. If several packages have the same name, the package nearest to
                `near` is used.
        """
        self.start = start.resolve()
        around = (near or start).resolve().parents
        self._shares: dict[str, ShareFolder] = {}
        self._marked = [
            Path(folder)
            for root in self._roots()
            for folder, is_marked in _folders(root, _DEPTH)
            if is_marked
        ]
        # A repository may have several workspaces, with packages of the same names.
        self._marked.sort(key=lambda folder: sum(map(folder.is_relative_to, around)), reverse=True)
        # Interfaces must be found before a program imports one, as they take precedence over
        # tftool's.
        if any((folder / kind).is_dir() for folder in self._marked for kind in _KINDS):
            _ = self._found

    @property
    def packages(self) -> dict[str, Package]:
        """Packages by name; their files are read at the first use."""
        return self._found[0]

    @property
    def skipped(self) -> list[str]:
        """Sentences about the package folders that could not be read, each with the reason."""
        return list(dict.fromkeys(self._found[1]))

    @cached_property
    def _found(self) -> tuple[dict[str, Package], list[str]]:
        packages: dict[str, Package] = {}
        skipped = []
        for folder in self._marked:
            try:
                package = read_package(folder)
            except (InputError, OSError) as error:
                skipped.append(f"'{folder}' is skipped: {error}")
                continue
            if package is not None:
                packages.setdefault(package.name, package)
        for package in packages.values():
            try:
                _add_interfaces(package)
            except (InputError, OSError) as error:
                skipped.append(f"'{package.path}' is skipped: {error}")
        return packages, skipped

    def _roots(self) -> list[Path]:
        roots = [self.start]
        for parent in [self.start, *self.start.parents][:4]:
            # A package's folder belongs to the src folder that contains it; a src folder belongs to
            # no folder above it.
            if parent.name == "src":
                roots.append(parent)
                break
            is_package = any((parent / mark).is_file() for mark in MARKS)
            # The src of a package in C++ contains its sources, and no packages.
            if (parent / "src").is_dir() and not is_package:
                roots.append(parent / "src")
                break
            if len(roots) == 1 and is_package:
                roots.append(parent)
        return roots

    def module_folders(self) -> list[str]:
        """Return the folders from which the packages' Python modules can be imported.

        A package named like a standard module or a module that tftool uses is left out, because the
        package would hide that module.
        """
        modules = (
            package.path / name
            for package in self.packages.values()
            for name in (package.name, f"src/{package.name}", *package.modules)
        )
        folders = (
            str(module.parent)
            for module in modules
            if module.name not in TAKEN and (module / "__init__.py").is_file()
        )
        return list(dict.fromkeys(folders))

    def folder_without_manifest(self, name: str) -> Path | None:
        """Return a folder named `name` that has Python files but no package.xml or setup.py.

        Return None if there is no such folder.
        """
        for root in self._roots():
            for folder in (Path(one) for one, _ in _folders(root, _DEPTH)):
                if folder.name == name and any(
                    chain(folder.glob("*.py"), folder.glob(f"{name}/*.py"))
                ):
                    return folder
        return None

    def file_named(self, path: Path) -> Path | None:
        """Find a file of a package by a path whose first folders the user has left out.

        Args:
            path: Path relative to the package, to its launch folder, to its Python package or to
                the folder that contains the package.

        Returns:
            Path of the file, such as `src/pkg/pkg/node.py` for `pkg/pkg/node.py` or `node.py`;
            relative to `start` if the file is below `start`. None if no package has such a file.
        """
        if path.is_absolute() or ".." in path.parts:
            return None
        for name, package in self.packages.items():
            for folder in (package.path.parent, package.path, package.path / name):
                for file in (folder / path, folder / "launch" / path):
                    if file.is_file():
                        below = file.is_relative_to(self.start)
                        return file.relative_to(self.start) if below else file
        return None

    def package(self, name: str) -> Package:
        """Return the package named `name`.

        Raises:
            UsageError: If there is no such package; the text suggests a remedy.
        """
        found = self.packages.get(name)
        if found is None:
            raise UsageError(missing_package(name, self))
        return found

    def share(self, name: str) -> Path:
        """Return a folder with the files of a package's share directory; nothing is installed.

        For a package of ROS, the folder is part of tftool. For a user's package, the folder is the
        package's source folder. If the package installs files under other paths, a temporary folder
        with links is returned instead.

        Raises:
            UsageError: If there is no such package.
        """
        if name not in self.packages and (SHARE / name).is_dir():
            return SHARE / name
        package = self.package(name)
        if not package.installed:
            return package.path
        if name not in self._shares:
            self._shares[name] = ShareFolder(package.path, package.installed)
        return self._shares[name].path


_current: list[Workspace] = []


def use_workspace(workspace: Workspace) -> None:
    """Set the workspace that `current` returns."""
    _current[:] = [workspace]


def current() -> Workspace:
    """Return the workspace set by `use_workspace`; by default the one around the current folder."""
    if not _current:
        _current.append(Workspace(Path.cwd()))
    return _current[0]


def missing_package(name: str, workspace: Workspace, provided: tuple[str, ...] = ()) -> str:
    """Return the error text for a package that is not in the workspace.

    The text suggests a package with a similar name, suggests adding a package.xml, or lists all
    packages.

    `provided` contains the names of the packages that tftool provides.
    """
    known = [*workspace.packages, *provided]
    near = near_names(name, known, alike=0.8)
    hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(sorted(known))}"
    where = f"below {workspace.start} or in the src folder around it"
    skipped = "".join(f"\n{one}" for one in workspace.skipped)
    without = workspace.folder_without_manifest(name)
    inside = [one for one, package in workspace.packages.items() if package.path.name == name]
    if inside:
        hint = f"the package in folder '{name}' is called '{inside[0]}': use this name"
    elif without is not None:
        hint = f"'{without}' has no package.xml, setup.py, setup.cfg or pyproject.toml: add one"
    elif not known:
        hint = "there are no packages"
    return f"there is no package '{name}' {where}; {hint}{skipped}"


def _folders(root: Path, depth: int) -> Iterator[tuple[str, bool]]:
    """Yield (path, whether the folder is a package) for `root` and the folders below it.

    Each folder is listed only once, because a home folder may contain thousands of folders.

    Search at most `depth` levels below `root`.
    """
    top = str(root)
    for folder, inner, files in os.walk(top, followlinks=True):
        yield folder, not MARKS.isdisjoint(files) and "COLCON_IGNORE" not in {*inner, *files}
        level = folder.count(os.sep) - top.count(os.sep)
        # A symbolic link to a package is followed; folders below it are not searched.
        if level == depth or (level and os.path.islink(folder)):
            inner.clear()
        inner[:] = [one for one in inner if one not in _SKIPPED and not one.startswith(".")]
        # Of two packages with one name the first is used; src contains the sources of built
        # packages.
        inner.sort(key=lambda one: (one != "src", one))


def _add_interfaces(package: Package) -> None:
    if package.name in TAKEN:
        if any((package.path / kind).is_dir() for kind in _KINDS):
            raise InputError(
                f"the package of interfaces '{package.name}' has the name of a module of Python: "
                "rename the package"
            )
        return
    texts = {
        (kind, file.stem): read_text(file)
        for kind in _KINDS
        for file in sorted((package.path / kind).rglob(f"*.{kind}"))
    }
    if texts:
        INTERFACES.add(package.name, texts)
        if (package.path / package.name / "__init__.py").is_file():
            WITH_MODULES.add(package.name)


FILES = (".py", ".xml", ".yaml", ".yml")


def is_file(word: str) -> bool:
    """Return whether a command-line argument is the path of a file rather than a package's name."""
    return Path(word).suffix in FILES or "/" in word or Path(word).is_file()


def file_of(workspace: Workspace, word: str) -> Path:
    """Return the path in a command-line argument.

    Raises:
        InputError: If there is no such file, but a package has a file of that name. The text
            proposes the path of the package's file.
    """
    path = Path(word)
    if not path.exists() and (near := workspace.file_named(path)) is not None:
        raise InputError(f"cannot read '{word}': No such file or directory; did you mean '{near}'?")
    return path
