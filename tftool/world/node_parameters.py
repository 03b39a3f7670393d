"""A node's parameters, and ROS 2's six services for them."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Protocol

from tftool.base.errors import UsageError
from tftool.base.near_names import did_you_mean
from tftool.messages.classes import INTERFACES
from tftool.messages.parameter_values import SCALARS, list_result, value_message, value_of

if TYPE_CHECKING:
    from tftool.world.node import Node

Value = bool | int | float | str


class Parameters:
    """Declared names with typed values, and callbacks for changes."""

    def __init__(self, owner: str) -> None:
        self._owner = owner
        self._values: dict[str, Value] = {}
        self._listeners: list[Callable[[str, Value], object]] = []

    def declare(self, name: str, default: Value) -> Value:
        """Declare a parameter with its default, which determines its type."""
        return self._values.setdefault(name, default)

    def __getitem__(self, name: str) -> Value:
        """Return the value of a declared parameter."""
        self._check(name)
        return self._values[name]

    def set(self, name: str, value: Value) -> None:
        """Change a declared parameter.

        Raises:
            UsageError: If it was never declared, or the value is of another type.
                An int is taken where a float is declared.
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
        """Call `callback` with name and value after every change."""
        self._listeners.append(callback)

    def values(self) -> Mapping[str, Value]:
        """Return every parameter, read-only."""
        return MappingProxyType(self._values)

    def _check(self, name: str) -> None:
        if name in self._values:
            return
        hint = did_you_mean(name, self._values)
        raise UsageError(f"node '{self._owner}' has no parameter '{name}'{hint}")


class ParameterHolder(Protocol):
    """Parameters as their services use them, in messages of rcl_interfaces."""

    def values(self, names: Sequence[str]) -> list[Any]:
        """Return a ParameterValue for each name, without a type for unknown names."""

    def descriptors(self, names: Sequence[str]) -> list[Any]:
        """Return a ParameterDescriptor for each known name."""

    def listed(self, prefixes: Sequence[str], depth: int) -> Any:
        """Return a ListParametersResult."""

    def change(self, parameters: Sequence[Any]) -> Any:
        """Set all of some Parameters, or none; return a SetParametersResult."""


Answer = Callable[[Any, Any], Any]
"""Fills in and returns the response to a request: both are given."""


def parameter_services(holder: ParameterHolder) -> Iterator[tuple[str, Any, Answer]]:
    """Yield each parameter service's name below its node, its type, and its handler."""

    def get(request: Any, response: Any) -> Any:
        response.values = holder.values(request.names)
        return response

    def types(request: Any, response: Any) -> Any:
        response.types = [value.type for value in holder.values(request.names)]
        return response

    def set_each(request: Any, response: Any) -> Any:
        response.results = [holder.change([one]) for one in request.parameters]
        return response

    def set_together(request: Any, response: Any) -> Any:
        response.result = holder.change(request.parameters)
        return response

    def list_(request: Any, response: Any) -> Any:
        response.result = holder.listed(request.prefixes, request.depth)
        return response

    def describe(request: Any, response: Any) -> Any:
        response.descriptors = holder.descriptors(request.names)
        return response

    for name, kind, answer in (
        ("get_parameters", "GetParameters", get),
        ("get_parameter_types", "GetParameterTypes", types),
        ("set_parameters", "SetParameters", set_each),
        ("set_parameters_atomically", "SetParametersAtomically", set_together),
        ("list_parameters", "ListParameters", list_),
        ("describe_parameters", "DescribeParameters", describe),
    ):
        yield name, INTERFACES.find("rcl_interfaces", "srv", kind), answer


class ParameterServices:
    """Server of a node's parameters."""

    def __init__(self, node: "Node") -> None:
        """Serve until the node ends."""
        self._node = node
        for name, kind, answer in parameter_services(self):
            self._serve(name, kind, answer)

    def _serve(self, name: str, kind: Any, answer: Answer) -> None:
        def handle(request: Any) -> Any:
            return answer(request, kind.Response())

        self._node.serve(f"{self._node.name}/{name}", handle, kind)

    def _number(self, name: str) -> int:
        return SCALARS.get(type(self._node.parameters.values().get(name)), 0)

    def values(self, names: Sequence[str]) -> list[Any]:
        """Return a ParameterValue for each name."""
        known = self._node.parameters.values()
        return [value_message(known.get(name), self._number(name)) for name in names]

    def descriptors(self, names: Sequence[str]) -> list[Any]:
        """Return a ParameterDescriptor for each known name."""
        kind = INTERFACES.message("rcl_interfaces/ParameterDescriptor")
        known = self._node.parameters.values()
        return [kind(name=name, type=self._number(name)) for name in names if name in known]

    def listed(self, prefixes: Sequence[str], depth: int) -> Any:
        """Return the names below some prefixes."""
        return list_result(self._node.parameters.values(), prefixes, depth)

    def change(self, parameters: Sequence[Any]) -> Any:
        """Make all changes or none; return the result."""
        kind = INTERFACES.message("rcl_interfaces/SetParametersResult")
        before = dict(self._node.parameters.values())
        try:
            for one in parameters:
                self._node.set_parameter(one.name, value_of(one.value))
        except (UsageError, ValueError) as refusal:
            for name, value in before.items():
                if self._node.parameters.values()[name] != value:
                    self._node.set_parameter(name, value)
            return kind(successful=False, reason=str(refusal))
        return kind(successful=True)
