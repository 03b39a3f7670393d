"""Functions of rosidl_runtime_py: find interface classes by name, and convert messages to text."""

import math
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.base.plain_text import did_you_mean
from tftool.messages.classes import INTERFACES, Message
from tftool.messages.schema import FLOATS
from tftool.ros.host.error_text import missing_package


def interface(name: str, kind: str) -> Any:
    """Return the class of the interface named `name`.

    The name is like "std_srvs/srv/Trigger" or "std_srvs/Trigger"; the kind is "msg", "srv" or
    "action".

    Raises:
        UsageError: If the interface is unknown; the text has the nearest name.
    """
    package, _, own = name.strip("/").partition("/")
    own = own.removeprefix(f"{kind}/")
    if not own or own not in INTERFACES.names(package, kind):
        known = [f"{one}/{kind}/{n}" for one in INTERFACES.packages()
                 for n in INTERFACES.names(one, kind)]  # fmt: skip
        hint = did_you_mean(f"{package}/{kind}/{own}", known)
        if own and package not in INTERFACES.packages():
            hint = f"; {missing_package(package)}"
        raise UsageError(f"there is no interface '{name}' of kind {kind}{hint}")
    try:
        return INTERFACES.find(package, kind, own)
    except InputError as error:
        raise UsageError(str(error)) from None


def definition(name: str) -> str:
    """Return the text of an interface's .msg, .srv or .action file.

    Raises:
        UsageError: If the interface is unknown.
    """
    package, _, own = name.partition("/")
    kind, _, short = own.rpartition("/")
    for one in [kind] if kind else ["msg", "srv", "action"]:
        if short in INTERFACES.names(package, one):
            return INTERFACES.text(package, one, short)
    interface(name, kind or "msg")
    raise UsageError(f"there is no interface '{name}': 'ros2 interface list' shows all")


KINDS = {"msg": "Messages", "srv": "Services", "action": "Actions"}
"""Kinds of interfaces, with their headings in `ros2 interface list`."""


def interfaces(package: str | None = None, kinds: Sequence[str] = tuple(KINDS)) -> list[str]:
    """Return the full names of the interfaces of the given kinds.

    If `package` is None, return the interfaces of all packages.

    Raises:
        UsageError: If there is no such package; the text names a similar one.
    """
    if package is not None and package not in INTERFACES.packages():
        hint = did_you_mean(package, INTERFACES.packages())
        raise UsageError(f"there is no package of interfaces '{package}'{hint}")
    return [
        f"{one}/{kind}/{name}"
        for one in ([package] if package else sorted(INTERFACES.packages()))
        for kind in kinds
        for name in sorted(INTERFACES.names(one, kind))
    ]


def prototype(name: str) -> Any:
    """Return a new message with default values in all fields, for the interface `name`.

    For a service, the message is a request; for an action, a goal.

    Raises:
        UsageError: If there is no such interface; the text names a similar one.
    """
    parts = name.strip("/").split("/")
    kind = parts[1] if len(parts) == 3 else "msg"
    found = interface(name, kind if kind in KINDS else "msg")
    part = {"srv": "Request", "action": "Goal"}.get(kind)
    return (getattr(found, part) if part else found)()


def fill(message: Any, values: Any, where: str = "") -> None:
    """Set a message's fields from values parsed from YAML.

    Args:
        message: Message to change.
        values: Mapping from field names to values; None and "" change nothing.
        where: Path of the message in the outermost message, for error texts.

    Raises:
        UsageError: If a field is unknown, or a value has the wrong type; the text names the field.
    """
    known = [field.name for field in message.fields__]
    if values is None or values == "":
        return
    if not isinstance(values, Mapping):
        what = f"'{where}'" if where else type(message).__name__
        names = ", ".join(known)
        raise UsageError(f"{what} needs fields, not {values!r}: write '{{name: value}}' ({names})")
    fields = {field.name: field for field in message.fields__}
    for name, value in values.items():
        path = f"{where}.{name}" if where else str(name)
        field = fields.get(name)
        if field is None:
            hint = did_you_mean(str(name), known)
            names = ", ".join(known) or "none"
            raise UsageError(
                f"{type(message).__name__} has no field '{path}' (it has {names}){hint}"
            )
        current = getattr(message, name)
        if isinstance(current, Message):
            fill(current, value, path)
            continue
        try:
            setattr(message, name, _fitting(field, value, path))
        except (AssertionError, TypeError, ValueError, OverflowError) as error:
            raise UsageError(f"field '{path}' cannot be {value!r}: {error}") from None


def _fitting(field: Any, value: Any, path: str) -> Any:
    if field.size is not None and not isinstance(field.kind, str):
        if not isinstance(value, list):
            raise TypeError("a list is needed")
        made = []
        for number, one in enumerate(value):
            element = field.kind()
            fill(element, one, f"{path}[{number}]")
            made.append(element)
        return made
    if field.kind in FLOATS:
        if isinstance(value, list):
            return [float(one) for one in value]
        return float(value) if type(value) is int else value
    return value


def plain(
    value: Any, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> Any:
    """Convert a message to mappings, lists and single values, for output as YAML.

    Args:
        value: Message, or value of a message's field.
        truncate_length: Number of elements of a list, or letters of a text, to show; None for
            all.
        no_arr: Whether a list is replaced by its type and length.
        no_str: Whether a text is replaced by its length.
    """

    def inner(one: Any) -> Any:
        return plain(one, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str)

    if isinstance(value, Message):
        types = value.get_fields_and_field_types() if no_arr else {}
        return {
            field.name: _summary(getattr(value, field.name), types[field.name])
            if field.size is not None and no_arr
            else inner(getattr(value, field.name))
            for field in value.fields__
        }
    if isinstance(value, bytes | bytearray):
        value = list(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, str):
        if no_str:
            return f"<string length: <{len(value)}>>"
        is_long = truncate_length is not None and len(value) > truncate_length
        return f"{value[:truncate_length]}..." if is_long else value
    if isinstance(value, list | tuple):
        shown = [inner(one) for one in value[:truncate_length]]
        return shown if len(shown) == len(value) else [*shown, "..."]
    return value


def _summary(value: Any, kind: str) -> str:
    """Return ROS 2's text for a list, without its values: "<sequence type: double, length: 3>"."""
    if not kind.startswith("sequence<"):
        return f"<array type: {kind}>"
    element = kind.removeprefix("sequence<").removesuffix(">")
    name, _, bound = element.partition(", ")
    return f"<sequence type: {name}{bound and f'<{bound}>'}, length: {len(value)}>"


def as_yaml(shown: Any, *, flow_style: bool = False) -> str:
    """Return `shown`, a result of `plain`, as YAML text that ends with a line end."""
    import yaml  # Imported late, to keep command lines fast.

    if not isinstance(shown, dict | list):
        return f"{shown}\n"
    text: str = yaml.safe_dump(
        shown, sort_keys=False, allow_unicode=True, default_flow_style=flow_style, width=math.inf
    )
    return text


def as_csv(shown: Any) -> str:
    """Return all single values in `shown`, a result of `plain`, separated by commas."""
    return ",".join(str(value) for value in _single_values(shown))


def _single_values(value: Any) -> list[Any]:
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list):
        return [one for part in value for one in _single_values(part)]
    return [value]


def message_to_ordereddict(msg: Any, **options: Any) -> "OrderedDict[str, Any]":
    """Convert a message to an ordered mapping; nested messages become mappings too.

    `options` are options of `plain`.
    """
    return OrderedDict(plain(msg, **options))


def message_to_yaml(msg: Any, *, flow_style: bool = False, **options: Any) -> str:
    """Return a message as YAML text, with its fields in the order of the definition.

    With `flow_style`, write everything on one line; `options` are options of `plain`.
    """
    return as_yaml(plain(msg, **options), flow_style=flow_style)


def message_to_csv(msg: Any, **options: Any) -> str:
    """Return the values in a message, separated by commas; `options` are passed to `plain`."""
    return as_csv(plain(msg, **options))


def get_message_slot_types(msg: Any) -> "OrderedDict[str, str]":
    """Return a mapping from the name of each field of a message to the field's type."""
    return OrderedDict(msg.get_fields_and_field_types())


def set_message_fields(msg: Any, values: Mapping[str, Any], **_: Any) -> None:
    """Set fields of a message from a mapping, as `ros2 topic pub` does.

    Raises:
        AttributeError: If the message has no such field.
        UsageError: If a value has the wrong type; the text names the field.
    """
    for name, value in values.items():
        current = getattr(msg, name)
        if isinstance(current, Message) and isinstance(value, Mapping):
            set_message_fields(current, value)
        else:
            fill(msg, {name: value})


def get_message(identifier: str) -> Any:
    """Return the message class with the full name "package/msg/Name"."""
    return interface(identifier, "msg")


def get_service(identifier: str) -> Any:
    """Return the service class with the full name "package/srv/Name"."""
    return interface(identifier, "srv")


def get_action(identifier: str) -> Any:
    """Return the action class with the full name "package/action/Name"."""
    return interface(identifier, "action")


def get_interface(identifier: str) -> Any:
    """Return the class of a message, service or action with a name such as "package/msg/Name".

    Raises:
        UsageError: If there is no such interface; the text names a similar one.
    """
    parts = identifier.split("/")
    return interface(identifier, parts[1] if len(parts) == 3 else "msg")
