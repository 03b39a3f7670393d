"""rosidl_runtime_py: messages as mappings, YAML and CSV, and interfaces by name."""

from collections import OrderedDict
from typing import Any

from tftool.ros.host import ros2_words


def _short(
    truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> ros2_words.Shortening:
    return ros2_words.Shortening(truncate_length, no_arr, no_str)


def message_to_ordereddict(msg: Any, **options: Any) -> "OrderedDict[str, Any]":
    """Return the fields of a message, messages inside it as mappings too.

    Args:
        msg: The message.
        options: `truncate_length` of lists and texts; `no_arr` and `no_str` summarize them.
    """
    return OrderedDict(ros2_words.plain(msg, _short(**options)))


def message_to_yaml(msg: Any, *, flow_style: bool = False, **options: Any) -> str:
    """Return a message as YAML, its fields in the order of the definition.

    Args:
        msg: The message.
        flow_style: Whether on one line.
        options: As for `message_to_ordereddict`.
    """
    return ros2_words.as_yaml(ros2_words.plain(msg, _short(**options)), flow_style=flow_style)


def message_to_csv(msg: Any, **options: Any) -> str:
    """Return the values of a message, separated by commas; `options` as for the mapping."""
    return ros2_words.as_csv(ros2_words.plain(msg, _short(**options)))


def get_message_slot_types(msg: Any) -> "OrderedDict[str, str]":
    """Return the type of each field of a message, by name."""
    return OrderedDict(msg.get_fields_and_field_types())


def set_message_fields(msg: Any, values: Any, **_: Any) -> None:
    """Set fields of a message from a mapping, as `ros2 topic pub` does.

    Raises:
        UsageError: If there is no such field, or a value does not fit; the field is named.
    """
    ros2_words.fill(msg, values)


def get_message(identifier: str) -> Any:
    """Return the class of a message by "package/msg/Name".

    Raises:
        UsageError: If there is none; a near name is offered.
    """
    return ros2_words.interface(identifier, "msg")


def get_service(identifier: str) -> Any:
    """Return the class of a service by "package/srv/Name"; raises as `get_message` does."""
    return ros2_words.interface(identifier, "srv")


def get_action(identifier: str) -> Any:
    """Return the class of an action by "package/action/Name"; raises as `get_message` does."""
    return ros2_words.interface(identifier, "action")


def get_interface(identifier: str) -> Any:
    """Return the class of any interface by its full name; raises as `get_message` does."""
    parts = identifier.split("/")
    return ros2_words.interface(identifier, parts[1] if len(parts) == 3 else "msg")
