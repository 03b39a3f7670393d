"""Definitions of recorded types, and conversion of messages between ROS 1 and ROS 2."""

import hashlib
import re
from collections.abc import Callable
from functools import cache
from typing import Final, NamedTuple

from tftool.base.errors import InputError, MalformedMessage
from tftool.messages.classes import INTERFACES, Interfaces, completed
from tftool.messages.codec import Codec, RecordedCodec
from tftool.messages.hashes import type_hash
from tftool.messages.layouts import CDR, ROS1
from tftool.messages.schema import PRIMITIVES, FieldDefinition, full_name
from tftool.recordings.channel import TRANSIENT_LOCAL, Channel, offers_of, offers_text

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


def same_layout(name: str, first: Interfaces, second: Interfaces) -> bool:
    """Whether two sets of definitions give the messages of a type the same byte layout.

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
    return shape(first, full) == shape(second, full)


def ros1_definition(name: str, interfaces: Interfaces = INTERFACES) -> str:
    """Return a type's definition as ROS 1 records it, followed by nested types.

    Raises:
        InputError: If the type is unknown, or has no equivalent in ROS 1.
    """
    full = full_name(name)

    def nested(field: FieldDefinition) -> str:
        return f"{short(field.type)}{_brackets(field)}"

    texts = [_ros1_text(interfaces, full, nested)]
    texts += [
        f"{_LINE}\nMSG: {short(part)}\n{_ros1_text(interfaces, part, nested)}"
        for part in _parts(interfaces, full)
        if part not in _MOMENTS
    ]
    return "\n".join(texts) + "\n"


def ros1_md5(name: str, interfaces: Interfaces = INTERFACES) -> str:
    """Return ROS 1's MD5 sum of a type's definition.

    Source: wiki.ros.org/ROS/Technical%20Overview, and `roslib.gentools.compute_md5_text`.
    """
    text = _ros1_text(interfaces, full_name(name), lambda field: ros1_md5(field.type, interfaces))
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


@cache
def known_hash(name: str) -> str:
    """Return the type hash (RIHS01) of a type that is included in tftool; "" for other types."""
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
    """Return the names of all nested types of a type, in order of first appearance."""
    found: dict[str, None] = {}
    waiting = [full]
    while waiting:
        for field in interfaces.structure(waiting.pop(0)).fields:
            if field.type not in PRIMITIVES and field.type not in found and field.type != full:
                found[field.type] = None
                waiting.append(field.type)
    return list(found)


def _ros1_text(interfaces: Interfaces, full: str, nested: Callable[[FieldDefinition], str]) -> str:
    """Return a type's definition in ROS 1's form; `nested` writes the type of a nested field."""
    structure = interfaces.structure(full)
    lines = [f"{kind} {own}={value}" for own, kind, value in structure.constants]
    if full == _HEADER and all(field.name != "seq" for field in structure.fields):
        lines.append("uint32 seq")
    for field in structure.fields:
        if field.type in _MOMENTS or field.type in PRIMITIVES:
            kind = _MOMENTS.get(field.type) or _ros1_name(full, field)
            lines.append(f"{kind}{_brackets(field)} {field.name}")
        else:
            lines.append(f"{nested(field)} {field.name}")
    return "\n".join(lines)


def _ros1_name(owner: str, field: FieldDefinition) -> str:
    if field.type == "wstring":
        raise InputError(f"{owner}: '{field.name}' is a wstring, which ROS 1 does not have")
    return re.sub(r"^float$", "float32", re.sub(r"^double$", "float64", field.type))


def _brackets(field: FieldDefinition) -> str:
    if field.size is None and field.bound is None:
        return ""
    return f"[{field.size}]" if field.size is not None and field.size >= 0 else "[]"


_SEQUENCE: Final = re.compile(
    r"^(MSG: (?:std_msgs|roslib)/Header[ \t]*\n(?:(?!MSG: ).*\n)*?)uint32 seq[ \t]*(?:#.*)?\n",
    re.MULTILINE,
)
_TO_ROS2: Final = {"tf/msg/tfMessage": "tf2_msgs/msg/TFMessage"}


class Conversion(NamedTuple):
    """Conversion of a channel and its messages between ROS 1 and ROS 2.

    Attributes:
        channel: The channel after the conversion.
        payload: Function that converts the bytes of a message.
    """

    channel: Channel
    payload: Callable[[bytes], bytes]


def as_ros2(channel: Channel) -> Conversion:
    """Return the conversion of a ROS 1 channel to ROS 2.

    Raises:
        InputError: If the type is unknown, or the messages are not encoded as in ROS 1 or ROS 2.
    """
    if channel.encoding == "cdr":
        return Conversion(channel, bytes)
    full, interfaces = _known(channel, "ros1")
    kind = interfaces.message(full)
    target = _TO_ROS2.get(full, full)
    own = INTERFACES
    if target == full and not (INTERFACES.has(full) and same_layout(full, INTERFACES, interfaces)):
        own = interfaces
    metadata = {
        "offered_qos_profiles": offers_text(channel.extra("latching") == "1"),
        "topic_type_hash": known_hash(target) if own is INTERFACES else "",
    }
    if channel.extra("callerid"):
        metadata["callerid"] = channel.extra("callerid")
    written = Channel(
        channel.topic,
        target,
        "cdr",
        "ros2msg",
        ros2_definition(target, own).encode(),
        tuple(metadata.items()),
    )
    read, write = Codec(kind, ROS1), Codec(kind, CDR)
    return Conversion(written, lambda payload: write.encode(read.decode(payload)))


def as_ros1(channel: Channel) -> Conversion:
    """Return the conversion of a ROS 2 channel to ROS 1.

    The function that converts a message raises InputError for a value that ROS 1 cannot store.

    Raises:
        InputError: If the type is unknown or has no equivalent in ROS 1, or the messages are not
            encoded as in ROS 1 or ROS 2.
    """
    if channel.encoding == "ros1":
        return Conversion(channel, bytes)
    full, interfaces = _known(channel, "cdr")
    kind = interfaces.message(full)
    write = Codec(kind, ROS1)
    metadata = {"md5sum": ros1_md5(full, interfaces)}
    if channel.extra("callerid"):
        metadata["callerid"] = channel.extra("callerid")
    if offers_of(channel.extra("offered_qos_profiles")).durability == TRANSIENT_LOCAL:
        metadata["latching"] = "1"
    written = Channel(
        channel.topic,
        short(full),
        "ros1",
        "ros1msg",
        ros1_definition(full, interfaces).encode(),
        tuple(metadata.items()),
    )
    is_ours = interfaces is INTERFACES
    read = RecordedCodec(interfaces, full, CDR) if is_ours else Codec(kind, CDR)

    def payload(data: bytes) -> bytes:
        message = completed(read.decode(data), kind) if is_ours else read.decode(data)
        try:
            return write.encode(message)
        except MalformedMessage as error:
            # Seconds are signed in ROS 2, and unsigned in ROS 1; all other fields are alike.
            raise InputError(
                f"A message of '{channel.topic}' has a value that a ROS 1 bag cannot store, such "
                "as a stamp below 0: write an .mcap or .db3 file, or change the stamps first "
                "('tftool edit --shift' or '--restamp log')."
            ) from error

    return Conversion(written, payload)


def _known(channel: Channel, encoding: str) -> tuple[str, Interfaces]:
    """Return the type of a channel, and definitions for decoding the channel's messages."""
    if channel.encoding != encoding:
        raise InputError(f"messages with the encoding '{channel.encoding}' cannot be converted")
    text = ""
    if channel.schema_encoding in ("ros1msg", "ros2msg"):
        text = channel.definition.decode("utf-8", "backslashreplace")
    full = full_name(channel.type)
    if not text.strip():
        INTERFACES.message(full)
        return full, INTERFACES
    if encoding == "ros1":
        # ROS 2's header has no sequence number, and the reader omits ROS 1's.
        text = _SEQUENCE.sub(r"\1", text)
    interfaces = Interfaces()
    interfaces.define(full, text)
    interfaces.message(full)
    return full, interfaces


TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"


def ros2_channel(topic: str, kind: str, *, static: bool = False) -> Channel:
    """Return a channel as ROS 2 would record it, for a type that is included in tftool.

    Args:
        topic: Name of the topic.
        kind: Type of the messages: "tf2_msgs/msg/TFMessage".
        static: Whether late subscribers also get the last message.

    Raises:
        InputError: If the type is not known.
    """
    metadata = (
        ("offered_qos_profiles", offers_text(static)),
        ("topic_type_hash", known_hash(kind)),
    )
    return Channel(topic, kind, "cdr", "ros2msg", ros2_definition(kind).encode(), metadata)
