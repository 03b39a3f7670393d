"""Conversion of parameter values between rcl_interfaces and Python."""

import array
from collections.abc import Iterable, Sequence
from typing import Any, Final

from tftool.messages.classes import INTERFACES

FIELDS: Final = (
    None,
    "bool_value",
    "integer_value",
    "double_value",
    "string_value",
    "byte_array_value",
    "bool_array_value",
    "integer_array_value",
    "double_array_value",
    "string_array_value",
)
"""The field of a ParameterValue that holds the value, by the number of its type."""

SCALARS: Final[dict[type[Any], int]] = {bool: 1, int: 2, float: 3, str: 4}
"""The numbers of the types of single values."""


def value_of(message: Any) -> Any:
    """Return the Python value of an rcl_interfaces ParameterValue; None if not set.

    Raises:
        ValueError: If ROS 2 has no such type of value.
    """
    if message.type >= len(FIELDS):
        raise ValueError(f"{message.type} is no known type of a parameter")
    field = FIELDS[message.type]
    value = None if field is None else getattr(message, field)
    return value.tolist() if isinstance(value, array.array) else value


def value_message(value: Any, number: int) -> Any:
    """Return the rcl_interfaces ParameterValue of a value; for None, a value that is not set."""
    message: Any = INTERFACES.message("rcl_interfaces/ParameterValue")(type=number)
    field = FIELDS[number]
    if field is not None and value is not None:
        setattr(message, field, value)
    return message


def list_result(names: Iterable[str], prefixes: Sequence[str], depth: int) -> Any:
    """Return the ListParametersResult of the names below some prefixes.

    Args:
        names: All parameters.
        prefixes: Names, or prefixes that end before a dot; an empty list selects all parameters.
        depth: Number of levels below a prefix to list; 0 for all levels.
    """
    starts = [f"{one}." for one in prefixes] or [""]

    def is_listed(name: str) -> bool:
        return name in prefixes or any(
            name.startswith(start) and (not depth or name[len(start) :].count(".") < depth)
            for start in starts
        )

    found = [name for name in names if is_listed(name)]
    kind = INTERFACES.message("rcl_interfaces/ListParametersResult")
    return kind(names=found, prefixes=sorted({one.rpartition(".")[0] for one in found} - {""}))
