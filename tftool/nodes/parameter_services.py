"""ROS 2's services about parameters, for a node of ours."""

from collections.abc import Callable
from typing import Any

from tftool.errors import UsageError
from tftool.interfaces.classes import INTERFACES
from tftool.interfaces.parameters import SCALARS, value_message, value_of
from tftool.runtime.node import Node


class ParameterServices:
    """Answers who lists, reads, describes and sets a node's parameters."""

    def __init__(self, node: Node) -> None:
        """Serve from now on, until the node ends."""
        self._node = node
        answers: dict[str, tuple[str, Callable[[Any, Any], None]]] = {
            "get_parameters": ("GetParameters", self._get),
            "get_parameter_types": ("GetParameterTypes", self._types),
            "set_parameters": ("SetParameters", self._set),
            "set_parameters_atomically": ("SetParametersAtomically", self._set_together),
            "list_parameters": ("ListParameters", self._list),
            "describe_parameters": ("DescribeParameters", self._describe),
        }
        for name, (kind, answer) in answers.items():
            self._serve(name, INTERFACES.find("rcl_interfaces", "srv", kind), answer)

    def _serve(self, name: str, kind: Any, answer: Callable[[Any, Any], None]) -> None:
        def handle(request: Any) -> Any:
            response = kind.Response()
            answer(request, response)
            return response

        self._node.serve(f"{self._node.name}/{name}", handle, kind)

    def _number(self, name: str) -> int:
        return SCALARS.get(type(self._node.parameters.values().get(name)), 0)

    def _get(self, request: Any, response: Any) -> None:
        values = self._node.parameters.values()
        response.values = [
            value_message(values.get(name), self._number(name)) for name in request.names
        ]

    def _types(self, request: Any, response: Any) -> None:
        response.types = [self._number(name) for name in request.names]

    def _list(self, request: Any, response: Any) -> None:
        prefixes = tuple(f"{prefix}." for prefix in request.prefixes)
        response.result.names = [
            name
            for name in self._node.parameters.values()
            if not prefixes or name in request.prefixes or name.startswith(prefixes)
        ]

    def _describe(self, request: Any, response: Any) -> None:
        kind = INTERFACES.message("rcl_interfaces/ParameterDescriptor")
        known = self._node.parameters.values()
        response.descriptors = [
            kind(name=name, type=self._number(name)) for name in request.names if name in known
        ]

    def _set(self, request: Any, response: Any) -> None:
        response.results = [self._apply([one]) for one in request.parameters]

    def _set_together(self, request: Any, response: Any) -> None:
        response.result = self._apply(request.parameters)

    def _apply(self, changes: list[Any]) -> Any:
        """Make all changes or none; how that went."""
        kind = INTERFACES.message("rcl_interfaces/SetParametersResult")
        before = dict(self._node.parameters.values())
        try:
            for one in changes:
                self._node.set_parameter(one.name, value_of(one.value))
        except (UsageError, ValueError) as refusal:
            for name, value in before.items():
                if self._node.parameters.values()[name] != value:
                    self._node.set_parameter(name, value)
            return kind(successful=False, reason=str(refusal))
        return kind(successful=True)
