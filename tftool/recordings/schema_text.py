"""Definitions of message types as recordings store them, including nested types."""

import hashlib
import re
from functools import cache
from typing import Final

from tftool.base.errors import InputError
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.hashes import type_hash
from tftool.messages.schema import PRIMITIVES, FieldDefinition, full_name

_LINE: Final = "=" * 80
_MOMENTS: Final = {
    "builtin_interfaces/msg/Time": "time",
    "builtin_interfaces/msg/Duration": "duration",
}
_HEADER: Final = "std_msgs/msg/Header"


def ros2_definition(name: str, interfaces: Interfaces = INTERFACES) -> str:
    """Return a type's definition as ROS 2 records it ("ros2msg"), followed by nested types.

    Raises:
        InputError: If the type is not known.
    """
    full = full_name(name)
    texts = [_ros2_text(interfaces, full)]
    texts += [
        f"{_LINE}\nMSG: {short(part)}\n{_ros2_text(interfaces, part)}"
        for part in _parts(interfaces, full)
    ]
    return "\n".join(text.strip("\n") for text in texts) + "\n"


def same_layout(name: str, one: Interfaces, other: Interfaces) -> bool:
    """Whether messages of a type have the same bytes in two sets of definitions.

    Raises:
        InputError: If a definition lacks the type.
    """

    def shape(interfaces: Interfaces, full: str) -> list[object]:
        return [
            (
                field.type if field.type in PRIMITIVES else shape(interfaces, field.type),
                field.size,
            )
            for field in interfaces.structure(full).fields
        ]

    full = full_name(name)
    return shape(one, full) == shape(other, full)


def ros1_definition(name: str, interfaces: Interfaces = INTERFACES) -> str:
    """Return a type's definition as ROS 1 records it, followed by nested types.

    Raises:
        InputError: If the type is unknown, or has no equivalent in ROS 1.
    """
    full = full_name(name)
    texts = [_ros1_text(interfaces, full)]
    texts += [
        f"{_LINE}\nMSG: {short(part)}\n{_ros1_text(interfaces, part)}"
        for part in _parts(interfaces, full)
        if part not in _MOMENTS
    ]
    return "\n".join(texts) + "\n"


def ros1_md5(name: str, interfaces: Interfaces = INTERFACES) -> str:
    """Return ROS 1's MD5 sum of a type's definition.

    Source: wiki.ros.org/ROS/Technical%20Overview, and `roslib.gentools.compute_md5_text`.
    """
    full = full_name(name)
    structure = interfaces.structure(full)
    lines = [f"{kind} {own}={value}" for own, kind, value in structure.constants]
    if full == _HEADER and all(field.name != "seq" for field in structure.fields):
        lines.append("uint32 seq")
    for field in structure.fields:
        kind = _MOMENTS.get(field.type)
        if kind is None and field.type in PRIMITIVES:
            kind = _ros1_name(full, field)
        if kind is not None:
            lines.append(f"{kind}{_brackets(field)} {field.name}")
        else:
            lines.append(f"{ros1_md5(field.type, interfaces)} {field.name}")
    return hashlib.md5("\n".join(lines).encode(), usedforsecurity=False).hexdigest()


@cache
def known_hash(name: str) -> str:
    """Return ROS 2's hash of a type included in tftool; "" for other types."""
    try:
        return type_hash(INTERFACES, full_name(name))
    except InputError:
        return ""


def short(full: str) -> str:
    """Return a type's name in ROS 1's form: "std_msgs/String"."""
    return full.replace("/msg/", "/")


def _ros2_text(interfaces: Interfaces, full: str) -> str:
    package, kind, own = full.split("/")
    if interfaces is INTERFACES:
        return interfaces.text(package, kind, own)
    # A definition recorded by ROS 1 writes Header and time in ROS 1's form.
    structure = interfaces.structure(full)
    lines = [f"{kind} {own}={value}" for own, kind, value in structure.constants]
    for field in structure.fields:
        text = f"<={field.text_bound}" if field.text_bound else ""
        bound = f"[<={field.bound}]" if field.bound is not None else _brackets(field)
        default = f" {field.default}" if field.default else ""
        lines.append(f"{short(field.type)}{text}{bound} {field.name}{default}")
    return "\n".join(lines)


def _parts(interfaces: Interfaces, full: str) -> list[str]:
    """Return the names of a type's nested types, each once, in order of appearance."""
    found: dict[str, None] = {}
    waiting = [full]
    while waiting:
        for field in interfaces.structure(waiting.pop(0)).fields:
            if field.type not in PRIMITIVES and field.type not in found and field.type != full:
                found[field.type] = None
                waiting.append(field.type)
    return list(found)


def _ros1_text(interfaces: Interfaces, full: str) -> str:
    structure = interfaces.structure(full)
    lines = [f"{kind} {own}={value}" for own, kind, value in structure.constants]
    if full == _HEADER and all(field.name != "seq" for field in structure.fields):
        lines.append("uint32 seq")
    for field in structure.fields:
        kind = _MOMENTS.get(field.type)
        if kind is None:
            kind = _ros1_name(full, field) if field.type in PRIMITIVES else short(field.type)
        lines.append(f"{kind}{_brackets(field)} {field.name}")
    return "\n".join(lines)


def _ros1_name(owner: str, field: FieldDefinition) -> str:
    if field.type == "wstring":
        raise InputError(f"{owner}: '{field.name}' is a wstring, which ROS 1 does not have")
    return re.sub(r"^float$", "float32", re.sub(r"^double$", "float64", field.type))


def _brackets(field: FieldDefinition) -> str:
    if field.size is None and field.bound is None:
        return ""
    return f"[{field.size}]" if field.size is not None and field.size >= 0 else "[]"
