"""rclpy's parameter services: others get, set, list and describe a node's parameters."""

from collections.abc import Callable, Iterator
from typing import Any

from tftool.interfaces.classes import INTERFACES
from tftool.ros.client.exceptions import ParameterNotDeclaredException
from tftool.ros.client.node_parameters import NodeParameters, set_result
from tftool.ros.client.parameters import Parameter

# A stranger's request may name a type that is none, or a value that is not of its type.
_REFUSALS = (ParameterNotDeclaredException, ValueError, TypeError)


class ParameterService:
    """What a node answers to questions about its parameters."""

    def __init__(self, node: NodeParameters) -> None:
        self._node = node

    def services(self) -> Iterator[tuple[str, Any, Callable[[Any, Any], Any]]]:
        """Each service's name below the node, its type, and what answers it."""
        for name, kind, answer in (
            ("get_parameters", "GetParameters", self._on_get),
            ("get_parameter_types", "GetParameterTypes", self._on_types),
            ("set_parameters", "SetParameters", self._on_set),
            ("set_parameters_atomically", "SetParametersAtomically", self._on_set_together),
            ("list_parameters", "ListParameters", self._on_list),
            ("describe_parameters", "DescribeParameters", self._on_describe),
        ):
            yield name, INTERFACES.find("rcl_interfaces", "srv", kind), answer

    def _on_get(self, request: Any, response: Any) -> Any:
        response.values = [
            self._node.get_parameter_or(name).get_parameter_value() for name in request.names
        ]
        return response

    def _on_types(self, request: Any, response: Any) -> Any:
        response.types = [int(self._node.get_parameter_or(name).type_) for name in request.names]
        return response

    def _on_set(self, request: Any, response: Any) -> Any:
        response.results = [self._set_one(one) for one in request.parameters]
        return response

    def _set_one(self, message: Any) -> Any:
        try:
            return self._node.set_parameters([Parameter.from_parameter_msg(message)])[0]
        except _REFUSALS as error:
            return set_result(False, str(error))

    def _on_set_together(self, request: Any, response: Any) -> Any:
        try:
            response.result = self._node.set_parameters_atomically(
                [Parameter.from_parameter_msg(one) for one in request.parameters]
            )
        except _REFUSALS as error:
            response.result = set_result(False, str(error))
        return response

    def _on_list(self, request: Any, response: Any) -> Any:
        response.result = self._node.list_parameters(request.prefixes, request.depth)
        return response

    def _on_describe(self, request: Any, response: Any) -> Any:
        response.descriptors = [
            self._node.describe_parameter(name)
            for name in request.names
            if self._node.has_parameter(name)
        ]
        return response
