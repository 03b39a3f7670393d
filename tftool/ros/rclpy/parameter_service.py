"""Services for reading, setting, listing and describing a node's parameters."""

from collections.abc import Sequence
from typing import Any

from tftool.ros.rclpy.exceptions import (
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from tftool.ros.rclpy.node_parameters import NodeParameters, set_result
from tftool.ros.rclpy.parameters import Parameter

# A request may name a type that is none, or a value that is not of its type.
_REFUSALS = (ParameterNotDeclaredException, ValueError, TypeError)


class ServedParameters:
    """A node's parameters in the form of `node_parameters`."""

    def __init__(self, node: NodeParameters) -> None:
        self._node = node

    def values(self, names: Sequence[str]) -> list[Any]:
        """Return a ParameterValue for each name; none at all if one has no value, as in ROS 2."""
        try:
            return [one.get_parameter_value() for one in self._node.get_parameters(list(names))]
        except (ParameterNotDeclaredException, ParameterUninitializedException):
            return []

    def descriptors(self, names: Sequence[str]) -> list[Any]:
        """Return a ParameterDescriptor for each known name."""
        node = self._node
        return [node.describe_parameter(name) for name in names if node.has_parameter(name)]

    def listed(self, prefixes: Sequence[str], depth: int) -> Any:
        """Return the names below some prefixes."""
        return self._node.list_parameters(prefixes, depth)

    def change(self, parameters: Sequence[Any]) -> Any:
        """Make all changes or none; return the result."""
        try:
            return self._node.set_parameters_atomically(
                [Parameter.from_parameter_msg(one) for one in parameters]
            )
        except _REFUSALS as error:
            return set_result(False, str(error))
