"""The native kernel, where it was built: one C file that does what the plain modules say.

It is built with the package where there is a C compiler. Without it everything runs in plain
Python and means the same; `TFTOOL_PURE=1` has it so even where the kernel is there.
"""

import os
from importlib import import_module
from typing import TYPE_CHECKING, Final, TypeVar

if TYPE_CHECKING:
    from types import ModuleType

    from tftool.frames.path import Path
    from tftool.frames.requests import Request
    from tftool.frames.tree import Sender

_Class = TypeVar("_Class", bound=type)

SWITCH = "TFTOOL_PURE"
"""The environment variable that has everything run in plain Python, if it is not empty or 0."""


def built(name: str, interface: int) -> "ModuleType | None":
    """A native module, where it was built and is wanted.

    Args:
        name: Its full name.
        interface: What is expected of it; one that was built for others is left alone.
    """
    if os.environ.get(SWITCH, "") not in ("", "0"):
        return None
    try:
        found = import_module(name)
    except ImportError:
        return None
    return found if interface == found.INTERFACE else None


IS_NATIVE: Final[bool] = built("tftool.frames._kernel", 6) is not None
"""Whether the kernel is used."""

BUILD: Final = "native" if IS_NATIVE else "pure Python"
"""What `tftool --version` says."""


if TYPE_CHECKING or not IS_NATIVE:

    class Door:
        """What a buffer's methods read first; natively the same, where C code can read it.

        Attributes:
            _paths: The solver's.
            _senders: The tree's.
            _listening: Those that each accepted sample is told to.
            _pending: Requests that wait, by handle.
        """

        __slots__ = ("_listening", "_paths", "_pending", "_senders")

        _paths: "dict[str, dict[str, Path]]"
        _senders: "dict[str, Sender]"
        _listening: "tuple[object, ...]"
        _pending: "dict[int, Request]"

else:
    from tftool.frames._kernel import Door


def usual_by_kernel(plain: _Class) -> _Class:
    """Have the kernel's methods do what is usual, and the plain ones of that name all else.

    The kernel's are inherited from `Door`; it finds a plain one under `_plain_` and its name.
    """
    for name in vars(Door).keys() & vars(plain).keys() if IS_NATIVE else ():
        if not name.startswith("__"):
            setattr(plain, f"_plain_{name}", vars(plain)[name])
            delattr(plain, name)
    return plain
