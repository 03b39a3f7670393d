"""Import hooks that provide `rclpy` and ROS 2's other Python modules.

Only `tftool run`, `tftool launch` and the pytest fixture install these hooks, never `import
tftool`.
"""

import dis
import importlib
import importlib.machinery
import importlib.util
import os
import sys
import threading
from collections import UserList
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.abc import Loader, MetaPathFinder
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any

from tftool.base.errors import UsageError
from tftool.messages.classes import INTERFACES
from tftool.ros.host import fibers, import_table
from tftool.ros.host.error_text import missing_module, missing_name
from tftool.ros.host.shims import BUILTINS_FOR_USERS, IMPORTING
from tftool.ros.host.workspace import TAKEN, WITH_MODULES

DISTRIBUTION = "jazzy"
"""ROS 2 distribution that tftool imitates: the value of `ROS_DISTRO` for programs."""

_OURS = Path(__file__).resolve().parents[2]
"""Folder of the package tftool, which may be below a user's folder."""


def real_ros() -> str:
    """Return the path of rclpy in a sourced ROS 2; "" if no ROS 2 is sourced.

    The variable `ROS_DISTRO` alone proves nothing, because tftool sets it too for users' programs
    and their child processes.
    """
    if not (os.environ.get("ROS_DISTRO") or os.environ.get("AMENT_PREFIX_PATH")):
        return ""
    try:
        spec = importlib.machinery.PathFinder.find_spec("rclpy")
    except (ImportError, ValueError):
        return ""
    return "" if spec is None or not spec.origin else spec.origin


_LOADING = threading.RLock()
"""Lock for loading a name, because two threads would create two classes for one interface."""


class _StandInModule(ModuleType):
    """Module that has a ROS 2 module's name and loads each object from tftool at first use."""

    def __dir__(self) -> list[str]:
        return sorted({*vars(self), *_entries(self.__name__), *self._modules()} - {"*"})

    def _modules(self) -> list[str]:
        """Return the submodules that ROS 2 itself imports together with this package.

        A program may use these submodules without importing them. The list is empty for a package
        whose submodules a program must import.
        """
        if self.__name__ not in import_table.WHOLE_PACKAGES:
            return []
        parts = (name.rpartition(".") for name in import_table.table())
        return [name for package, _, name in parts if package == self.__name__]

    def __getattr__(self, name: str) -> Any:
        entries = _entries(self.__name__)
        if name in entries:
            with _LOADING:
                return vars(self).setdefault(name, load(entries[name]))
        if name.startswith("__") and name != "__all__":
            raise AttributeError(name)
        for other in import_table.imported_by(self.__name__):
            if name in (entries := _entries(other)):
                return load(entries[name])
        known = [one for one in dir(self) if not one.startswith("_")]
        if name == "__all__":
            return known
        below = f"{self.__name__}.{name}"
        if name in self._modules():
            # Nodes use rclpy.time.Time() after `import rclpy` alone.
            return importlib.import_module(below)
        sentence = missing_name(self.__name__, name, known)
        if _is_import_from(sys._getframe(1)):
            try:
                # `from package import module` asks for an attribute first.
                return importlib.import_module(below)
            except ImportError:
                raise ImportError(sentence, name=self.__name__) from None
        raise AttributeError(sentence)


_PARTS: Mapping[str, Sequence[str]] = MappingProxyType(
    {"srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}
)
"""Parts of an interface that have classes of their own, such as `Trigger_Request`, by kind."""


def _entries(module: str) -> Mapping[str, import_table.ImportedName]:
    """Return the names in a ROS 2 module, such as `std_msgs.msg`, with their objects in tftool."""
    package, _, below = module.partition(".")
    if package not in INTERFACES.packages():
        return import_table.table()[module]
    kind, _, own = below.partition(".")
    names = _names_in(package, below)
    if own:
        names += [f"{one}_{part}" for one in names for part in _PARTS.get(kind, ())]
    return {one: import_table.ImportedName(f"{package}/{kind}", one) for one in names}


def _is_import_from(frame: Any) -> bool:
    while frame is not None and frame.f_code.co_filename.startswith("<frozen importlib"):
        frame = frame.f_back
    code = frame.f_code.co_code
    operation: int = code[frame.f_lasti]
    return operation == dis.opmap["IMPORT_FROM"] or dis.opname[operation] == "CALL_FUNCTION"


class _StandInLoader(Loader):
    """Import loader that creates modules with the names of ROS 2 modules."""

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType:
        return _StandInModule(spec.name, f"{spec.name}, as far as it runs without ROS.")

    def exec_module(self, module: ModuleType) -> None:
        entries = _entries(module.__name__)
        if (whole := entries.get("*")) is not None:
            ours = importlib.import_module(f".{whole.module}", "tftool.ros")
            vars(module).update(_defined(ours))
        elif module.__name__ in import_table.REGISTERING:
            load(next(iter(entries.values())))


def load(imported: import_table.ImportedName) -> Any:
    """Import and return the object of tftool that `imported` names."""
    package, _, kind = imported.module.partition("/")
    if kind:
        name, _, part = imported.name.partition("_")
        found = INTERFACES.find(package, kind, name)
        return getattr(found, part) if part else found
    return getattr(importlib.import_module(f".{package}", "tftool.ros"), imported.name)


def _defined(module: ModuleType) -> dict[str, Any]:
    """Return {name: value} of the public names that one of tftool's modules defines.

    Names that the module only imports are left out.
    """
    # A copy, because another thread may import a submodule, which adds a name to `module`.
    return {
        name: value
        for name, value in vars(module).copy().items()
        if not (name.startswith("_") or isinstance(value, ModuleType))
        and getattr(value, "__module__", module.__name__) == module.__name__
    }


def _names_in(package: str, module: str) -> list[str]:
    """Return the names of the interfaces in a module of a package of interfaces.

    `module` is a path in the package, such as "msg" or "msg._string".
    """
    kind, _, own = module.partition(".")
    names = INTERFACES.names(package, kind) if kind else []
    return [one for one in names if own == f"_{import_table.snake_case(one)}"] if own else names


class _Finder(MetaPathFinder):
    """Import hook that finds tftool's versions of ROS 2 modules, and modules in users' folders."""

    def __init__(self) -> None:
        self.roots: list[Path] = []
        self.behind: list[Callable[[], Iterable[str]]] = []
        """Functions that return folders to search last; called at the first import of a module."""
        self.tested: Path | None = None
        """Folder of the tests and the tested code, whose modules get tftool's builtins."""
        self.on_import: dict[str, Callable[[], object]] = {}
        """Functions to call when a program first imports a package, by its name."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        package, _, rest = fullname.partition(".")
        if not rest and (imported := self.on_import.pop(package, None)) is not None:
            imported()
        known = import_table.table()
        if package in INTERFACES.packages():
            if not (rest and _names_in(package, rest)):
                # The package's own module is the parent of its Python modules and its interfaces.
                own = self._own(fullname, path, target) if package in WITH_MODULES else None
                if own is not None or rest:
                    return own
        elif fullname not in known:
            if package in known:
                raise ModuleNotFoundError(missing_module(fullname), name=fullname)
            return self._own(fullname, path, target)
        # Every module is a package, so that tftool reports a wrong name below a module itself.
        return importlib.machinery.ModuleSpec(fullname, _StandInLoader(), is_package=True)

    def _own(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None
    ) -> importlib.machinery.ModuleSpec | None:
        """Return the import spec of a module in a user's folders; None if no such module exists."""
        if self.tested is not None:
            return self._tested(fullname, path, target)
        if fullname.partition(".")[0] not in TAKEN:
            while self.behind:
                more = map(Path, self.behind.pop(0)())
                self.roots += [root for root in more if root not in self.roots]
        if not self.roots:
            return None
        search = list(path) if path is not None else [str(root) for root in self.roots]
        find = importlib.machinery.PathFinder.find_spec
        spec = find(fullname, search, target)
        if spec is None:
            return None
        if spec.origin is None and path is None and find(fullname) is not None:
            return None  # A folder without __init__.py is a package only if there is no other.
        folders = spec.submodule_search_locations
        if folders is not None:
            # Copy to a list: Python's own object fails once the parent package is unloaded.
            folders = spec.submodule_search_locations = list(folders)
        file = spec.origin or next(iter(folders or ()), "")
        if not _is_users(Path(file), self.roots):
            return None
        if isinstance(spec.loader, importlib.machinery.SourceFileLoader):
            spec.loader = _UserLoader(fullname, str(spec.origin))
        return spec

    def _tested(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None
    ) -> importlib.machinery.ModuleSpec | None:
        """Return the import spec of a module while tests run; None if no such module exists.

        Modules below the tests' folder get replaced builtins: in these modules `import time`, for
        example, imports tftool's version of `time`.
        """
        for finder in sys.meta_path[sys.meta_path.index(self) + 1 :]:
            spec = finder.find_spec(fullname, path, target)
            if spec is None:
                continue
            origin = Path(spec.origin or "")
            inside = self.tested is not None and origin.is_relative_to(self.tested)
            # Even if tftool's checkout is below the folder of the tests, tftool is not the code
            # under test.
            ours = "site-packages" in origin.parts or fullname.partition(".")[0] == "tftool"
            if inside and spec.loader is not None and not ours:
                spec.loader = _TestedLoader(spec.loader)
            return spec
        return _dotted_test(fullname, path or ())


def _dotted_test(fullname: str, path: Sequence[str]) -> importlib.machinery.ModuleSpec | None:
    """Return the import spec of a test file with dots in its name; None if there is no such file.

    With `--import-mode=importlib`, pytest imports the file `x.test.py` as the module `x_test`.
    """
    name = fullname.rpartition(".")[2]
    files = (file for folder in path for file in Path(folder).glob("*.*.py"))
    for file in files if "_" in name else ():
        if file.stem.replace(".", "_") == name:
            loader = _UserLoader(fullname, str(file))
            return importlib.util.spec_from_file_location(fullname, file, loader=loader)
    return None


class _UserLoader(importlib.machinery.SourceFileLoader):
    """Import loader for users' modules, which get the builtins of `BUILTINS_FOR_USERS`."""

    def exec_module(self, module: ModuleType) -> None:
        module.__dict__["__builtins__"] = BUILTINS_FOR_USERS
        super().exec_module(module)

    def set_data(self, path: str, data: Any, *, _mode: int = 0o666) -> None:
        """Do nothing, so that no __pycache__ is written to a user's folders."""


class _TestedLoader(Loader):
    """Import loader for tests: wraps another loader, and replaces the module's builtins."""

    def __init__(self, loader: Loader) -> None:
        self._loader = loader

    def __getattr__(self, name: str) -> Any:
        return getattr(self._loader, name)

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType | None:
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        module.__dict__["__builtins__"] = BUILTINS_FOR_USERS
        self._loader.exec_module(module)


class _Arguments(UserList[str]):
    """Replacement of `sys.argv`: a list in which each program sees its own arguments."""

    def __init__(self, otherwise: list[str]) -> None:
        super().__init__()
        self._otherwise = otherwise

    @property
    def data(self) -> list[str]:
        """Arguments of the program that the calling thread belongs to.

        A thread that belongs to no program sees the arguments of tftool itself.
        """
        fiber = fibers.current()
        owner = fiber.owner if fiber is not None else None
        return self._otherwise if owner is None else owner.argv

    @data.setter
    def data(self, value: list[str]) -> None:
        """Ignore the new value, because each program has its own list of arguments."""

    # A slice must be a plain list, because pytest shows all arguments for a list of this class.

    def __getitem__(self, index: Any) -> Any:
        return self.data[index]

    def __add__(self, other: Any) -> Any:
        return self.data + list(other)

    def __radd__(self, other: Any) -> Any:
        return list(other) + self.data

    def __mul__(self, times: int) -> Any:
        return self.data * times

    __rmul__ = __mul__

    def copy(self) -> Any:
        """Return a copy of the calling program's arguments."""
        return self.data.copy()

    __copy__ = copy


_finder: _Finder | None = None


@contextmanager
def ros_free(*, force: bool = False, simulated: bool = False) -> Iterator["_Finder"]:
    """Make ROS 2's modules importable, and give every program its own `sys.argv`.

    Both last until the end of the `with` block.

    With `force`, replace the modules of a sourced ROS 2. If `simulated`, the programs run on
    simulated time, which child processes cannot join.

    Raises:
        UsageError: If a real ROS 2 is sourced and `force` is false.
    """
    found = real_ros()
    if found and not force:
        raise UsageError(
            f"a real ROS 2 is sourced ({found}): run the file with ROS 2, or add --ros-free "
            "to run the file without ROS"
        )
    argv = sys.argv
    if not isinstance(argv, _Arguments):
        sys.argv = _Arguments(argv)  # type: ignore[assignment]
    try:
        with environment(simulated=simulated), ros_modules() as finder:
            yield finder
    finally:
        sys.argv = argv


@contextmanager
def environment(*, simulated: bool = False) -> Iterator[None]:
    """Set the environment variables of a sourced ROS 2 until the end of the `with` block.

    `ROS_DISTRO`, which launch files read, keeps an existing value. `PATH` begins with the folder of
    tftool's `ros2` command, so that child processes find this command. If `simulated`, the command
    refuses to join a session.
    """
    commands = f"{Path(__file__).parent / 'bin'}{os.pathsep}{os.environ.get('PATH', '')}"
    wanted = {
        "ROS_DISTRO": os.environ.get("ROS_DISTRO", DISTRIBUTION),
        "PATH": commands,
        "TFTOOL_PYTHON": sys.executable,
        "TFTOOL_SIMULATED": "1" if simulated else "",
    }
    before = {name: os.environ.get(name) for name in wanted}
    os.environ.update(wanted)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


@contextmanager
def ros_modules() -> Iterator["_Finder"]:
    """Make ROS 2's modules importable until the end of the `with` block; ignore a sourced ROS 2."""
    global _finder
    if _finder is not None:
        yield _finder
        return
    _finder = _Finder()
    before = {name: sys.modules.pop(name) for name in list(sys.modules) if _is_theirs(name)}
    sys.meta_path.insert(0, _finder)
    loaded = set(sys.modules)
    try:
        yield _finder
    finally:
        sys.meta_path.remove(_finder)
        for name in set(sys.modules) - loaded:
            if _is_theirs(name) or _is_users(_file_of(sys.modules[name]), _finder.roots):
                del sys.modules[name]
        sys.modules.update(before)
        _finder = None


def _is_theirs(name: str) -> bool:
    package = name.partition(".")[0]
    return package in import_table.table() or package in INTERFACES.packages()


def _file_of(module: ModuleType) -> Path:
    """Return the file of a module; for a package without a file, return its first folder."""
    folders = getattr(module, "__path__", None)
    return Path(getattr(module, "__file__", None) or next(iter(folders or ()), ""))


def _is_users(file: Path, roots: Iterable[Path]) -> bool:
    """Return whether a module's file is below one of `roots` and outside virtual environments."""
    for root in () if file.is_relative_to(_OURS) else roots:
        if file.is_relative_to(root) and "site-packages" not in file.relative_to(root).parts:
            return True
    return False


def search_first(root: Path) -> None:
    """Make `root` the first folder in which imports look for users' modules."""
    if _finder is not None:
        if root in _finder.roots:
            _finder.roots.remove(root)
        _finder.roots.insert(0, root)


def unload_hidden(folder: Path) -> None:
    """Remove from `sys.modules` each user's module that has the name of a file in `folder`.

    Two programs may have modules of the same name. Without the removal, an import in the second
    program would return the first program's module.
    """
    names = {one.stem for one in folder.iterdir()}
    roots = [] if _finder is None else _finder.roots
    for name, module in _modules():
        # Most modules have another name; their files need not be looked at.
        if name.partition(".")[0] not in names:
            continue
        file = _file_of(module)
        if not file.is_relative_to(folder) and _is_users(file, roots):
            sys.modules.pop(name, None)  # Another program may have removed it meanwhile.


def _modules() -> Iterable[tuple[str, ModuleType]]:
    """Return the imported modules by name, while programs in other threads import further ones."""
    # `list(sys.modules.items())` fails then: it creates tuples, which may start the garbage
    # collector, whose finalizers let other threads run. A copy of the dictionary creates none.
    return sys.modules.copy().items()


def search_last(roots: Callable[[], Iterable[str]]) -> None:
    """Add folders in which imports look for users' modules, after the programs' own folders.

    `roots` is called at the first import of a user's module.
    """
    if _finder is not None:
        _finder.behind.append(roots)


def import_fresh(module: str, root: Path) -> ModuleType:
    """Import a user's module from the folder `root`; execute it even if it was imported before.

    Two programs that run the same module therefore share no global variables.

    Raises:
        ImportError: If the module, or a module that it imports, does not exist.
    """
    with IMPORTING:
        search_first(root)
        for name, imported in _modules():
            if _is_users(_file_of(imported), [root]):
                sys.modules.pop(name, None)
        importlib.invalidate_caches()
        return importlib.import_module(module)
