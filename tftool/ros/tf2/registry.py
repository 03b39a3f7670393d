"""tf2_ros's registry of functions that transform and convert types."""

import copy
from collections.abc import Callable
from typing import Any, TypeVar

from tftool.base.errors import TransformException

T = TypeVar("T")

_transform: dict[Any, Callable[[Any, Any], Any]] = {}
_to_msg: dict[Any, Callable[[Any], Any]] = {}
_from_msg: dict[Any, Callable[[Any], Any]] = {}
_convert: dict[tuple[Any, Any], Callable[[Any], Any]] = {}


class TypeException(TransformException):
    """Error for a type that is not registered."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(TransformException):
    """Error for something that a buffer does not support."""

    def __init__(self) -> None:
        super().__init__("CanTransform or LookupTransform not implemented")


class Registration:
    """Registers how to transform a type."""

    def print_me(self) -> None:
        """Do nothing."""

    def add(self, key: Any, callback: Callable[[Any, Any], Any]) -> None:
        """Register `callback(data, transform)` to transform data of a type."""
        _transform[key] = callback

    def get(self, key: Any) -> Callable[[Any, Any], Any]:
        """Return the function that transforms data of a type.

        Raises:
            TypeException: If none does.
        """
        return _of(_transform, key)


TransformRegistration = Registration


class ConvertRegistration:
    """Registers how to convert between types."""

    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register `callback` to make a type from a message."""
        _from_msg[key] = callback

    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register `callback` to make a message of a type."""
        _to_msg[key] = callback

    def add_convert(self, key: tuple[Any, Any], callback: Callable[[Any], Any]) -> None:
        """Register `callback` to convert one type to another."""
        _convert[key] = callback

    def get_from_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that makes a type from a message."""
        return _of(_from_msg, key)

    def get_to_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that makes a message of a type."""
        return _of(_to_msg, key)

    def get_convert(self, key: tuple[Any, Any]) -> Callable[[Any], Any]:
        """Return the function that converts one type to another."""
        return _of(_convert, key)


def _of(registry: dict[Any, T], key: Any) -> T:
    try:
        return registry[key]
    except KeyError:
        raise TypeException(f"Type {key} is not loaded or supported") from None


def convert(a: Any, b_type: Any) -> Any:
    """Convert `a` to another type: a copy, a direct conversion, or through a message."""
    if isinstance(a, b_type):
        return copy.deepcopy(a)
    direct = _convert.get((type(a), b_type))
    if direct is not None:
        return direct(a)
    return _of(_from_msg, b_type)(_of(_to_msg, type(a))(a))
