"""ROS 2's six services about a node's parameters: for our own nodes, and for rclpy's."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Protocol

from tftool.base.errors import UsageError
from tftool.messages.classes import INTERFACES
from tftool.messages.parameter_values import SCALARS, list_result, value_message, value_of
from tftool.world.node import Node


class ParameterHolder(Protocol):
    """What the services read and change: messages of rcl_interfaces in and out."""

    def values(self, names: Sequence[str]) -> list[Any]:
        """A ParameterValue for each name, without a type where there is none of that name."""

    def descriptors(self, names: Sequence[str]) -> list[Any]:
        """A ParameterDescriptor for each name that is known."""

    def listed(self, prefixes: Sequence[str], depth: int) -> Any:
        """A ListParametersResult."""

    def change(self, parameters: Sequence[Any]) -> Any:
        """Set each of some Parameters, or none of them; a SetParametersResult."""


Answer = Callable[[Any, Any], Any]
"""Fills in and returns the response to a request: both are given."""


def parameter_services(holder: ParameterHolder) -> Iterator[tuple[str, Any, Answer]]:
    """Each service's name below its node, its type, and what answers it."""

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
    """Serves the parameters of a node of ours."""

    def __init__(self, node: Node) -> None:
        """Serve from now on, until the node ends."""
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
        """A ParameterValue for each name."""
        known = self._node.parameters.values()
        return [value_message(known.get(name), self._number(name)) for name in names]

    def descriptors(self, names: Sequence[str]) -> list[Any]:
        """A ParameterDescriptor for each name that is known."""
        kind = INTERFACES.message("rcl_interfaces/ParameterDescriptor")
        known = self._node.parameters.values()
        return [kind(name=name, type=self._number(name)) for name in names if name in known]

    def listed(self, prefixes: Sequence[str], depth: int) -> Any:
        """The names below some prefixes."""
        return list_result(self._node.parameters.values(), prefixes, depth)

    def change(self, parameters: Sequence[Any]) -> Any:
        """Make all changes or none; how that went."""
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
