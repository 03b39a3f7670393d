"""Loading of users' Python files, and functions that run these files as programs."""

import dis
import inspect
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.base.named_files import open_regular
from tftool.base.plain_text import did_you_mean
from tftool.ros.host import importing, program
from tftool.ros.host.error_text import syntax_sentence
from tftool.ros.host.shims import BUILTINS_FOR_USERS


def file_body(path: Path) -> Callable[[], None]:
    """Return a function that runs a Python file as `python3 FILE` would.

    Many files of ROS tutorials only define `main`, for a console script, and call neither `main`
    nor `rclpy.init` themselves. For such a file, the returned function calls `main`.

    Raises:
        InputError: If the file cannot be read or is not valid Python; the text shows the line.
    """
    return partial(_run_file, path, compile_file(path))


def _run_file(path: Path, code: CodeType) -> None:
    module = load_module(path, "__main__", code)
    owner = program.current()
    if owner.context is not None or owner.has_started_programs:
        return
    main = module.__dict__.get("main")
    if not inspect.isfunction(main) or main.__module__ != "__main__" or _reads(code, "main"):
        owner.warn(
            f"'{path.name}' has ended without calling rclpy.init(), so it ran no node: call "
            "rclpy.init() and spin a node"
        )
    else:
        _end_with(main())


def load_module(path: Path, name: str = "", code: CodeType | None = None) -> ModuleType:
    """Execute a user's file as a module of the running program, and return the module.

    Without `code`, the file is compiled here. Without a name, the module gets the file's name
    without suffix.

    Raises:
        InputError: If the file cannot be read or is not valid Python; the text shows the line.
    """
    code = compile_file(path) if code is None else code
    folder = path.resolve().parent
    module = ModuleType(name or path.stem)
    folders = [folder]
    if (folder / "__init__.py").is_file():
        # A node's file in a package can import the package by name, and neighbouring files with
        # a leading dot, as if the package were installed.
        folders.insert(0, folder.parent)
        module.__package__ = folder.name
        if (folder / f"{folder.name}.py").is_file():
            # An import of this name must find the package, not the file of the same name in it.
            folders.reverse()
    for root in folders:
        importing.search_first(root)
    importing.unload_hidden(folder)
    module.__file__ = str(path)
    module.__dict__["__builtins__"] = BUILTINS_FOR_USERS
    exec(code, module.__dict__)
    return module


def _reads(code: CodeType, name: str) -> bool:
    """Return whether a file's top-level statements read the global variable `name`."""
    return any(
        step.opname == "LOAD_NAME" and step.argval == name for step in dis.get_instructions(code)
    )


def compile_file(path: Path) -> CodeType:
    """Read and compile a user's Python file.

    Raises:
        InputError: If the file cannot be read or is not valid Python.
    """
    try:
        with open_regular(path) as file:
            source = file.read()
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    try:
        # `from __future__` imports of tftool must not affect users' code.
        code: CodeType = compile(source, str(path), "exec", dont_inherit=True)
        return code
    except SyntaxError as error:
        if error.filename is None:
            raise InputError(f"'{path}' is not valid Python: {error.msg}") from None
        raise InputError(syntax_sentence(error)) from None
    except ValueError as error:
        raise InputError(f"'{path}' is not a Python text file: {error}") from None


def entry_point_body(module: str, function: str, *, root: Path) -> Callable[[], None]:
    """Return a function that runs the console script `module:function` of a package.

    The name of the function may contain dots. The module is imported from the folder `root`.
    """

    def body() -> None:
        try:
            target: Any = importing.import_fresh(module, root)
        except ModuleNotFoundError as error:
            if error.name is None or not f"{module}.".startswith(f"{error.name}."):
                raise
            there = [f"{one.parent.name}.{one.stem}" for one in root.glob("*/*.py")]
            raise UsageError(
                f"the console script names module {module}, but there is no such file in "
                f"{root}{did_you_mean(module, there)}"
            ) from error
        for part in function.split("."):
            if not hasattr(target, part):
                raise UsageError(
                    f"the console script names {module}:{function}, but there is no '{part}' in "
                    f"{getattr(target, '__file__', module)}{did_you_mean(part, dir(target))}"
                )
            target = getattr(target, part)
        _end_with(target())

    return body


def _end_with(status: object) -> None:
    """Raise SystemExit with the value that a console script's function returned; ignore None."""
    if status is not None:
        raise SystemExit(status)
