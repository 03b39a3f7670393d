"""rosidl_runtime_py: messages as mappings, YAML and CSV, and interfaces by name."""

from collections import OrderedDict
from collections.abc import Mapping
from typing import Any

from tftool.ros.host import ros2_words


def message_to_ordereddict(msg: Any, **_: Any) -> "OrderedDict[str, Any]":
    """Return the fields of a message, messages inside it as mappings too."""
    return OrderedDict(ros2_words.plain(msg))


def message_to_yaml(msg: Any, **_: Any) -> str:
    """Return a message as YAML, its fields in the order of the definition."""
    import yaml

    text: str = yaml.safe_dump(ros2_words.plain(msg), sort_keys=False)
    return text


def message_to_csv(msg: Any, **_: Any) -> str:
    """Return the values of a message, separated by commas."""
    return ",".join(str(value) for value in _single_values(ros2_words.plain(msg)))


def _single_values(value: Any) -> list[Any]:
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list):
        return [one for part in value for one in _single_values(part)]
    return [value]


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
