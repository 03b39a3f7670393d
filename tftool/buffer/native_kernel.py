"""The native kernel, where it was built: one C file that implements the usual cases."""

from typing import TYPE_CHECKING, Any, Final, TypeVar, cast

from tftool.base.native import built

if TYPE_CHECKING:
    from tftool.buffer.forest import Sender
    from tftool.buffer.path import Path
    from tftool.buffer.requests import Request

_Method = TypeVar("_Method")

IS_NATIVE: Final[bool] = built("tftool.buffer._kernel", 6) is not None
"""Whether the kernel is used."""

BUILD: Final = "native" if IS_NATIVE else "pure Python"
"""What `tftool --version` says."""


if TYPE_CHECKING or not IS_NATIVE:

    class Door:
        """Fields that a buffer's methods read first, in native form where C code reads them.

        Attributes:
            _paths: The solver's.
            _senders: The tree's.
            _listening: Functions called with each accepted sample.
            _pending: Requests that wait, by handle.
        """

        __slots__ = ("_listening", "_paths", "_pending", "_senders")

        _paths: "dict[str, dict[str, Path]]"
        _senders: "dict[str, Sender]"
        _listening: "tuple[object, ...]"
        _pending: "dict[int, Request]"

else:
    from tftool.buffer._kernel import Door


class _NativeFirst:
    """Decorator's result that the class replaces by the kernel's method of the same name."""

    def __init__(self, plain: Any) -> None:
        self._plain = plain

    def __set_name__(self, owner: type, name: str) -> None:
        setattr(owner, f"_plain_{name}", self._plain)
        setattr(owner, name, vars(Door)[name])


def native_first(plain: _Method) -> _Method:
    """Decorate a method that the kernel implements for ordinary arguments.

    For all other cases (a new frame, a refusal, a long chain) the kernel calls the decorated
    method, as `_plain_` and its name. Without the kernel, the name is the method itself.
    """
    return cast(_Method, _NativeFirst(plain)) if IS_NATIVE else plain
