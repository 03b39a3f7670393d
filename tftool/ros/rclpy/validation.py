"""Functions of rclpy that validate or expand names of topics, services, nodes and parameters."""

from tftool.ros.host import names
from tftool.ros.host.names import Fault
from tftool.ros.rclpy.exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidParameterException,
    InvalidServiceNameException,
    InvalidTopicNameException,
)

HIDDEN_TOPIC_PREFIX = "_"


def topic_or_service_is_hidden(name: str) -> bool:
    """Return whether a part of a name begins with "_"; ROS 2 omits such names from lists."""
    return any(part.startswith(HIDDEN_TOPIC_PREFIX) for part in name.split("/"))


def validate_node_name(node_name: str) -> bool:
    """Return True if a node name is valid; otherwise raise an error.

    Raises:
        InvalidNodeNameException: If ROS 2 refuses the name.
    """
    if (fault := names.node_name_fault(node_name)) is not None:
        raise InvalidNodeNameException(node_name, *fault)
    return True


def validate_namespace(namespace: str) -> bool:
    """Return True if an absolute namespace is valid; otherwise raise an error.

    Raises:
        InvalidNamespaceException: If ROS 2 refuses the namespace.
    """
    if (fault := names.namespace_fault(namespace)) is not None:
        raise InvalidNamespaceException(namespace, *fault)
    return True


def validate_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Return True if a topic or service name is valid; otherwise raise an error.

    The name may be relative, or private ("~/x"), and may contain substitutions such as "{node}".

    Raises:
        InvalidTopicNameException: If the name is not a valid topic name.
        InvalidServiceNameException: If the name cannot be the name of a service.
    """
    return _passes(name, names.topic_name_fault(name), is_service)


def validate_full_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Return True if a full topic or service name is valid; otherwise raise an error.

    Raises:
        InvalidTopicNameException: If the name is not a valid topic name.
        InvalidServiceNameException: If the name cannot be the name of a service.
    """
    fault = names.namespace_fault(name) if name != "/" else Fault("it must not end with '/'", 0)
    return _passes(name, fault, is_service)


def _passes(name: str, fault: Fault | None, is_service: bool) -> bool:
    if fault is None:
        return True
    raise (InvalidServiceNameException if is_service else InvalidTopicNameException)(name, *fault)


def validate_parameter_name(name: str) -> bool:
    """Return True if a parameter name is valid; otherwise raise an error.

    Raises:
        InvalidParameterException: If ROS 2 refuses the name.
    """
    if not isinstance(name, str) or not name:
        raise InvalidParameterException(f"Invalid parameter name: {name!r}", str(name))
    return True


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """Return the full name of a topic in a node, with a leading slash.

    Raises:
        NameValidationException: If the topic, node name or namespace is not valid.
    """
    validate_topic_name(topic_name)
    validate_node_name(node_name)
    validate_namespace(node_namespace)
    return "/" + names.expand(topic_name, node_name, node_namespace)
