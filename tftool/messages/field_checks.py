"""Checks of values assigned to fields: types and ranges, as in ROS 2's own classes."""

import array
import math
import struct
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from tftool.messages.schema import FLOATS, INTEGERS, STRINGS

_FLOAT32_MAX = 3.402823466e38
_FLOAT64_MAX = 1.7976931348623157e308

Check = Callable[[Any], Any]
"""Function that returns the value to store, or raises an AssertionError with the reason."""


def element_check(name: str, kind: str | type[Any], text: int | None) -> Check:
    """Return the function that checks the value of a field, or one element of an array field.

    Args:
        name: The field's name.
        kind: A primitive's name, or the class of a message.
        text: Maximum number of characters, if the field is a bounded string; else None.
    """
    if not isinstance(kind, str):
        return partial(_check_message, name, kind)
    if kind in INTEGERS:
        letter = INTEGERS[kind]
        bits = 8 * struct.calcsize(letter)
        low, high = (-(1 << bits - 1), 1 << bits - 1) if letter.islower() else (0, 1 << bits)
        return partial(_check_integer, name, low, high - 1)
    if kind in FLOATS:
        single = kind in ("float32", "float")
        return partial(_check_float, name, _FLOAT32_MAX if single else _FLOAT64_MAX)
    if kind in STRINGS:
        return partial(_check_string, name, text)
    return partial(_check_byte if kind == "byte" else _check_bool, name)


def array_check(
    name: str, kind: str | type[Any], size: int, bound: int | None, element: Check
) -> Check:
    """Return the function that checks a whole array or sequence.

    Args:
        name: The field's name.
        kind: The elements' type.
        size: Number of elements; -1 for a sequence.
        bound: Maximum length of a sequence; None without a bound.
        element: Function that checks one element.
    """
    code = typecode(kind)
    word = kind if isinstance(kind, str) else kind.__name__
    number = "float" if word in FLOATS else "int" if word in INTEGERS else word

    def check(value: Any) -> Any:
        if isinstance(value, str | Mapping) or not (
            isinstance(value, Sequence | set | array.array) or hasattr(value, "tolist")
        ):
            raise AssertionError(
                f"The '{name}' field must be a set or sequence and each value of type '{number}', "
                f"not '{type(value).__name__}'"
            )
        if isinstance(value, array.array) and value.typecode == code and size < 0:
            _check_length(name, len(value), size, bound)
            return value
        if isinstance(value, bytes | bytearray) and kind in ("uint8", "char"):
            values: list[Any] = list(value)
        else:
            values = value.tolist() if hasattr(value, "tolist") else list(value)
        _check_length(name, len(values), size, bound)
        for one in values:
            element(one)
        return packed(kind, size, values)

    return check


def typecode(kind: str | type[Any]) -> str | None:
    """Return the typecode of a numeric type in the module `array`; None for other types."""
    if not isinstance(kind, str):
        return None
    return INTEGERS[kind] if kind in INTEGERS else FLOATS.get(kind)


def packed(kind: str | type[Any], size: int, values: Sequence[Any]) -> Any:
    """Return the values as a field stores them: as `array.array`, numpy array or list."""
    code = typecode(kind)
    if code is None:
        return values
    if size < 0:
        return array.array(code, values)
    # ROS 2 stores fixed arrays of numbers as numpy arrays, and users' programs rely on it.
    import numpy as np

    return np.array(values, dtype=np.dtype(code))


def _check_length(name: str, length: int, size: int, bound: int | None) -> None:
    if size >= 0 and length != size:
        raise AssertionError(
            f"The '{name}' field must be a set or sequence with length {size}, not {length}"
        )
    if bound is not None and length > bound:
        raise AssertionError(
            f"The '{name}' field must be a set or sequence of at most {bound}, not {length}"
        )


def _check_bool(name: str, value: Any) -> Any:
    if not isinstance(value, bool):
        raise _mismatch(name, "bool", value)
    return value


def _check_integer(name: str, low: int, high: int, value: Any) -> Any:
    if not isinstance(value, int):
        raise _mismatch(name, "int", value)
    if not low <= value <= high:
        word = "an integer" if low else "an unsigned integer"
        raise AssertionError(f"The '{name}' field must be {word} in [{low}, {high}]")
    return value


def _check_float(name: str, highest: float, value: Any) -> Any:
    if not isinstance(value, float):
        raise _mismatch(name, "float", value)
    if not (-highest <= value <= highest) and math.isfinite(value):
        word = "a float" if highest == _FLOAT32_MAX else "a double"
        raise AssertionError(f"The '{name}' field must be {word} in [{-highest!r}, {highest!r}]")
    return value


def _check_string(name: str, bound: int | None, value: Any) -> Any:
    if not isinstance(value, str):
        raise _mismatch(name, "str", value)
    if bound is not None and len(value) > bound:
        raise AssertionError(f"The '{name}' field must be string value not longer than {bound}")
    return value


def _check_byte(name: str, value: Any) -> Any:
    if not (isinstance(value, bytes | bytearray | memoryview) and len(value) == 1):
        raise AssertionError(f"The '{name}' field must be of type 'bytes' with length 1")
    return bytes(value)


def _check_message(name: str, kind: type[Any], value: Any) -> Any:
    if not isinstance(value, kind):
        # rclpy's Time, Duration and Parameter have the same names as the message classes.
        makers = ("to_msg", "to_parameter_msg")
        made = next((one for one in makers if hasattr(value, one)), "")
        hint = f", which is rclpy's own: append .{made}()" if made else ""
        raise AssertionError(
            f"The '{name}' field must be a sub message of type '{kind.__name__}', "
            f"not '{type(value).__name__}'{hint}"
        )
    return value


def _mismatch(name: str, wanted: str, value: Any) -> AssertionError:
    text = f"The '{name}' field must be of type '{wanted}', not '{type(value).__name__}'"
    if wanted == "float" and type(value) is int:
        text += f": write {value}.0"
    return AssertionError(text)
