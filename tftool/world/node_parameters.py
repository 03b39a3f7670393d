"""Parameters of a node, and the six ROS 2 services that read and set parameters."""

import array
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from tftool.base.errors import UsageError
from tftool.base.plain_text import did_you_mean
from tftool.messages.classes import INTERFACES

if TYPE_CHECKING:
    from tftool.world.node import Node


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
"""Names of the fields of a ParameterValue that contain the value, by the number of its type."""

SCALARS: Final[dict[type[Any], int]] = {bool: 1, int: 2, float: 3, str: 4}
"""Numbers in ParameterValue of the types of single values."""


def value_of(message: Any) -> Any:
    """Return the Python value of an rcl_interfaces ParameterValue; None if not set.

    Raises:
        ValueError: If ROS 2 defines no parameter type with the number `message.type`.
    """
    if message.type >= len(FIELDS):
        raise ValueError(f"{message.type} is not a known type of a parameter")
    field = FIELDS[message.type]
    value = None if field is None else getattr(message, field)
    return value.tolist() if isinstance(value, array.array) else value


def value_message(value: Any, number: int) -> Any:
    """Return the rcl_interfaces ParameterValue of a value whose ROS 2 type has this `number`."""
    message: Any = INTERFACES.message("rcl_interfaces/ParameterValue")(type=number)
    field = FIELDS[number]
    if field is not None and value is not None:
        setattr(message, field, value)
    return message


def list_result(names: Iterable[str], prefixes: Sequence[str], depth: int) -> Any:
    """Return the ListParametersResult with the names of parameters below some prefixes.

    Args:
        names: Names of all parameters.
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


Value = bool | int | float | str


class Parameters:
    """Declared parameters of a node: names with typed values, and callbacks for changes."""

    def __init__(self, owner: str) -> None:
        self._owner = owner
        self._values: dict[str, Value] = {}
        self._listeners: list[Callable[[str, Value], object]] = []

    def declare(self, name: str, default: Value) -> Value:
        """Declare a parameter of this type; return `default`, or the value if declared before."""
        return self._values.setdefault(name, default)

    def __getitem__(self, name: str) -> Value:
        """Return the value of a declared parameter."""
        self._check(name)
        return self._values[name]

    def set(self, name: str, value: Value) -> None:
        """Change a declared parameter.

        Raises:
            UsageError: If the parameter was not declared, or the value has another type.
                An int is accepted for a float.
        """
        self._check(name)
        kind = type(self._values[name])
        if kind is float and type(value) is int:
            value = float(value)
        if type(value) is not kind:
            raise UsageError(
                f"parameter '{name}' of node '{self._owner}' takes {kind.__name__}, "
                f"not {type(value).__name__} ({value!r})"
            )
        self._values[name] = value
        for listener in self._listeners:
            listener(name, value)

    def on_change(self, callback: Callable[[str, Value], object]) -> None:
        """Call `callback` with a parameter's name and value after every change."""
        self._listeners.append(callback)

    def values(self) -> Mapping[str, Value]:
        """Return the values of all parameters by name, read-only."""
        return MappingProxyType(self._values)

    def _check(self, name: str) -> None:
        if name in self._values:
            return
        hint = did_you_mean(name, self._values)
        raise UsageError(f"node '{self._owner}' has no parameter '{name}'{hint}")


Answer = Callable[[Any, Any], Any]
"""Handler of a service: fills in the given response to a request, and returns it."""


def parameter_services(
    *,
    values: Callable[[Sequence[str]], list[Any]],
    descriptors: Callable[[Sequence[str]], list[Any]],
    listed: Callable[[Sequence[str], int], Any],
    change: Callable[[Sequence[Any]], Any],
) -> Iterator[tuple[str, Any, Answer]]:
    """Yield ROS 2's six parameter services as (name below the node's name, type, handler).

    Args:
        values: Function that returns a ParameterValue for each name.
        descriptors: Function that returns a ParameterDescriptor for each known name.
        listed: Function that returns the ListParametersResult for prefixes and a depth (number of
            levels).
        change: Function that sets either all of the given Parameters or none; returns a
            SetParametersResult.
    """
    return answered(
        "rcl_interfaces",
        ("get_parameters", "values", lambda asked: values(asked.names)),
        ("get_parameter_types", "types", lambda asked: [one.type for one in values(asked.names)]),
        ("set_parameters", "results", lambda asked: [change([one]) for one in asked.parameters]),
        ("set_parameters_atomically", "result", lambda asked: change(asked.parameters)),
        ("list_parameters", "result", lambda asked: listed(asked.prefixes, asked.depth)),
        ("describe_parameters", "descriptors", lambda asked: descriptors(asked.names)),
    )


def answered(
    package: str, *rows: tuple[str, str, Callable[[Any], Any]]
) -> Iterator[tuple[str, Any, Answer]]:
    """Yield (name, type, handler) of services whose response has one field.

    Args:
        package: Package of the services' types.
        rows: For each service: name, field of the response, and a function that returns the field's
            value for a request. The type of a service "get_state" is GetState, unless another type
            follows the name, as in "name:Type".
    """

    def handler(field: str, find: Callable[[Any], Any]) -> Answer:
        def answer(request: Any, response: Any) -> Any:
            setattr(response, field, find(request))
            return response

        return answer

    for row, field, find in rows:
        name, _, kind = row.partition(":")
        kind = kind or name.title().replace("_", "")
        yield name, INTERFACES.find(package, "srv", kind), handler(field, find)


def serve_parameters(node: "Node") -> None:
    """Serve ROS 2's parameter services of a node until the node ends."""
    known = node.parameters.values()

    def number(name: str) -> int:
        return SCALARS.get(type(known.get(name)), 0)

    def descriptors(names: Sequence[str]) -> list[Any]:
        kind = INTERFACES.message("rcl_interfaces/ParameterDescriptor")
        return [kind(name=name, type=number(name)) for name in names if name in known]

    def change(parameters: Sequence[Any]) -> Any:
        kind = INTERFACES.message("rcl_interfaces/SetParametersResult")
        before = dict(known)
        try:
            for one in parameters:
                node.set_parameter(one.name, value_of(one.value))
        except (UsageError, ValueError) as refusal:
            for name, value in before.items():
                if known[name] != value:
                    node.set_parameter(name, value)
            return kind(successful=False, reason=str(refusal))
        return kind(successful=True)

    def serve(name: str, kind: Any, answer: Answer) -> None:
        node.serve(f"{node.name}/{name}", lambda request: answer(request, kind.Response()), kind)

    for below, kind, answer in parameter_services(
        values=lambda names: [value_message(known.get(name), number(name)) for name in names],
        descriptors=descriptors,
        listed=lambda prefixes, depth: list_result(known, prefixes, depth),
        change=change,
    ):
        serve(below, kind, answer)
