"""Interface to the native kernel, an optional C module that implements the most frequent cases."""

from typing import TYPE_CHECKING, Any, Final, TypeVar, cast

from tftool.base.native import built

if TYPE_CHECKING:
    from tftool.buffer.callbacks import Request
    from tftool.buffer.forest import Frame, Sender
    from tftool.buffer.solver import Path

_Method = TypeVar("_Method")

IS_NATIVE: Final[bool] = built("tftool.buffer._kernel", 7) is not None
"""Whether the native kernel is used."""

BUILD: Final = "native" if IS_NATIVE else "pure Python"
"""The kind of build, as printed by `tftool --version`."""


if TYPE_CHECKING or not IS_NATIVE:

    class Door:
        """Base class of `Buffer` without the C kernel: the fields that every lookup needs.

        If the C kernel is built, its class of this name takes the place of this class.

        Attributes:
            _paths: Paths of the solver.
            _senders: Child frames of moving links in the tree, by name.
            _listening: Functions called with each accepted sample.
            _pending: Waiting requests, by handle.
            _numbers: Each frame's number in the tree, by name.
            _frames: The frames of the tree by number.
        """

        __slots__ = ("_frames", "_listening", "_numbers", "_paths", "_pending", "_senders")

        _paths: "dict[str, dict[str, Path]]"
        _senders: "dict[str, Sender]"
        _listening: "tuple[object, ...]"
        _pending: "dict[int, Request]"
        _numbers: "dict[str, int]"
        _frames: "list[Frame]"

else:
    from tftool.buffer._kernel import Door


class _NativeFirst:
    """Marker of a method that the kernel's method replaces when the class is created."""

    def __init__(self, plain: Any) -> None:
        self._plain = plain

    def __set_name__(self, owner: type, name: str) -> None:
        setattr(owner, f"_plain_{name}", self._plain)
        setattr(owner, name, vars(Door)[name])


def native_first(plain: _Method) -> _Method:
    """Decorate a method that the kernel implements for ordinary arguments.

    For all other cases (a new frame, a refusal, a long chain) the kernel calls the decorated method
    by the name `_plain_<name of the method>`. Without the kernel, the decorated method is used
    directly.
    """
    return cast(_Method, _NativeFirst(plain)) if IS_NATIVE else plain
