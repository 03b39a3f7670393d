"""The native kernel, where it was built: one C file that does what the plain modules say."""

from typing import TYPE_CHECKING, Final, TypeVar

from tftool.base.native import built

if TYPE_CHECKING:
    from tftool.buffer.forest import Sender
    from tftool.buffer.path import Path
    from tftool.buffer.requests import Request

_Class = TypeVar("_Class", bound=type)

IS_NATIVE: Final[bool] = built("tftool.buffer._kernel", 6) is not None
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
    from tftool.buffer._kernel import Door


def usual_by_kernel(plain: _Class) -> _Class:
    """Have the kernel's methods do what is usual, and the plain ones of that name all else.

    The kernel's are inherited from `Door`; it finds a plain one under `_plain_` and its name.
    """
    for name in vars(Door).keys() & vars(plain).keys() if IS_NATIVE else ():
        if not name.startswith("__"):
            setattr(plain, f"_plain_{name}", vars(plain)[name])
            delattr(plain, name)
    return plain
