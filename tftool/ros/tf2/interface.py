"""tf2_ros: what every buffer can do with lookups, and how types are transformed and converted."""

import copy
from collections.abc import Callable
from typing import Any, TypeVar

from tftool.base.errors import TransformException
from tftool.ros.rclpy.time import Duration

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


NOW = Duration()
"""No waiting."""


class BufferInterface:
    """Transforms stamped data; subclasses look the transforms up."""

    def __init__(self) -> None:
        self.registration = Registration()

    def _refuse(self, *asked: Any, **named: Any) -> Any:
        """Look nothing up.

        Raises:
            NotImplementedException: If the class does not implement it.
        """
        raise NotImplementedException

    lookup_transform = lookup_transform_full = can_transform = can_transform_full = _refuse

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = NOW, new_type: Any = None
    ) -> Any:
        """Transform stamped data to another frame.

        Raises:
            TypeException: If it is not registered how to transform such data.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _converted(do_transform(object_stamped, found), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
        new_type: Any = None,
    ) -> Any:
        """Transform stamped data to another frame at another time."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(do_transform(object_stamped, found), new_type)


def _converted(result: Any, new_type: Any) -> Any:
    return result if new_type is None else convert(result, new_type)
