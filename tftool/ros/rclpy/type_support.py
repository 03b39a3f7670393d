"""rclpy.type_support: checks of message, service and action types."""

from typing import Any

from tftool.ros.rclpy.exceptions import NoTypeSupportImportedException


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Check that it is an interface.

    Raises:
        AttributeError: If it is nothing like one.
        NoTypeSupportImportedException: If it is one that nothing is known of.
    """
    if _is_message(msg_or_srv_type) or _has(msg_or_srv_type, "Request", "Goal"):
        return
    _ = type(msg_or_srv_type)._TYPE_SUPPORT
    raise NoTypeSupportImportedException


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Check that it is a message type.

    Raises:
        RuntimeError: If it is another's.
    """
    if not _is_message(msg_type):
        raise RuntimeError(f"The message type provided is not valid ({msg_type})")


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Check that it is a service type.

    Raises:
        RuntimeError: If it is another's.
    """
    if not _has(srv_type, "Request"):
        raise RuntimeError(f"The service type provided is not valid ({srv_type})")


def _is_message(kind: Any) -> bool:
    return isinstance(kind, type) and hasattr(kind, "get_fields_and_field_types")


def _has(kind: Any, *parts: str) -> bool:
    return isinstance(kind, type) and any(_is_message(getattr(kind, part, None)) for part in parts)
