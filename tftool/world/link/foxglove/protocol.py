"""Messages of the Foxglove WebSocket protocol, as far as a subscribing client needs them.

A server sends JSON about its channels, and binary messages of subscribed channels. All of this data
is untrusted, so every field is checked, and every store has a limit.

Source: the protocol's description in foxglove/ws-protocol, and foxglove-sdk.
"""

import json
import re
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final, NamedTuple

from tftool.base.errors import InputError, MalformedMessage
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.codec import Codec
from tftool.messages.schema import full_name
from tftool.messages.transforms import encode_transforms
from tftool.recordings.channel import Channel
from tftool.recordings.foreign_transforms import FOREIGN, Decoder, decoder_of
from tftool.recordings.message_conversion import as_ros2, same_layout, short

SUBPROTOCOLS: Final = ("foxglove.sdk.v1", "foxglove.websocket.v1")
"""Names of the protocol's versions for the connection, the newer one first."""

LARGEST: Final = 64 * 1024 * 1024
"""Largest message in bytes; a larger one ends the connection."""

LARGEST_TEXT: Final = 32 * 1024 * 1024
"""Longest JSON message in characters."""

MOST_CHANNELS: Final = 5_000
"""Largest number of channels of a server that are stored; further channels are ignored."""

MOST_NODES: Final = 10_000
"""Largest numbers, each, of stored publishers, subscribers and services of a server."""

MOST_DEFINITIONS: Final = 32 * 1024 * 1024
"""Largest number of characters of definitions that are stored."""

MOST_WARNINGS: Final = 10
"""Largest number of sentences from a server that the user sees per connection."""

_LONGEST_NAME: Final = 300
_DATA: Final = struct.Struct("<BIQ")
_TIME: Final = struct.Struct("<BQ")
_CLOCK: Final = struct.Struct("<4siI")


class ProtocolError(Exception):
    """Error for a message that violates the protocol; the text continues "the server sent"."""


@dataclass(frozen=True, slots=True)
class FoxgloveChannel:
    """Channel of a server: a topic with one encoding and one type.

    Attributes:
        number: Number of the channel on this connection.
        topic: Name of the topic, as the server writes it.
        encoding: Encoding of the messages: "cdr", "ros1", "protobuf", "json".
        type: Name of the type, as the server writes it.
        schema_encoding: Language of the definition: "ros2msg", "ros1msg", "protobuf".
        definition: Definition of the type; "" for a missing definition, or one that is too long.
    """

    number: int
    topic: str
    encoding: str
    type: str
    schema_encoding: str
    definition: str


@dataclass(slots=True)
class ServerState:
    """Everything a server has announced on one connection.

    Attributes:
        name: Name of the server; "" until received.
        capabilities: Optional features that the server announced, such as "time".
        channels: Channels by number.
        publishers: Names of the nodes that publish, by topic.
        subscribers: Names of the nodes that subscribe, by topic.
        providers: Names of the nodes that serve, by service.
        services: Name and type of each service, by its number.
        warnings: Sentences from the server that must still be shown to the user.
        ignored: Number of channels that were not stored because of the limit.
    """

    name: str = ""
    capabilities: frozenset[str] = frozenset()
    channels: dict[int, FoxgloveChannel] = field(default_factory=dict)
    publishers: dict[str, tuple[str, ...]] = field(default_factory=dict)
    subscribers: dict[str, tuple[str, ...]] = field(default_factory=dict)
    providers: dict[str, tuple[str, ...]] = field(default_factory=dict)
    services: dict[int, tuple[str, str]] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    ignored: int = 0
    _definitions: int = 0
    _warned: int = 0

    def take(self, text: str) -> str:
        """Process one JSON message; return its field "op", or "" if tftool ignores the operation.

        Raises:
            ProtocolError: If the message violates the protocol.
        """
        if len(text) > LARGEST_TEXT:
            raise ProtocolError(f"a text of {len(text)} characters")
        try:
            message = json.loads(text)
        except (ValueError, RecursionError):
            raise ProtocolError("a text that is not JSON") from None
        if not isinstance(message, dict):
            raise ProtocolError("a text that is not a JSON object")
        operation = message.get("op")
        change = _CHANGES.get(operation) if isinstance(operation, str) else None
        if change is None:
            return ""
        try:
            change(self, message)
        except (KeyError, TypeError, ValueError, AttributeError, OverflowError):
            raise ProtocolError(f"a message '{operation}' whose fields are wrong") from None
        return str(operation)

    def _take_info(self, message: dict[str, Any]) -> None:
        self.name = _text(message.get("name") or "server")
        self.capabilities = frozenset(_text(one) for one in message.get("capabilities") or ())

    def _take_status(self, message: dict[str, Any]) -> None:
        if int(message["level"]) >= 1 and self._warned < MOST_WARNINGS:
            self._warned += 1
            self.warnings.append(_text(message["message"]))

    def _take_channels(self, message: dict[str, Any]) -> None:
        for one in message["channels"]:
            number = _number(one["id"])
            self._drop(number)
            if len(self.channels) >= MOST_CHANNELS:
                self.ignored += 1
                continue
            definition = one.get("schema") or ""
            if not isinstance(definition, str):
                raise TypeError("a schema that is not text")
            if self._definitions + len(definition) > MOST_DEFINITIONS:
                definition = ""
            self._definitions += len(definition)
            self.channels[number] = FoxgloveChannel(
                number,
                _text(one["topic"]),
                _text(one["encoding"]),
                _text(one.get("schemaName") or ""),
                _text(one.get("schemaEncoding") or ""),
                definition,
            )

    def _drop_channels(self, message: dict[str, Any]) -> None:
        for number in message["channelIds"]:
            self._drop(_number(number))

    def _drop(self, number: int) -> None:
        gone = self.channels.pop(number, None)
        if gone is not None:
            self._definitions -= len(gone.definition)

    def _take_services(self, message: dict[str, Any]) -> None:
        for one in message["services"]:
            if len(self.services) < MOST_NODES:
                self.services[_number(one["id"])] = _text(one["name"]), _text(one["type"])

    def _drop_services(self, message: dict[str, Any]) -> None:
        for number in message["serviceIds"]:
            self.services.pop(_number(number), None)

    def _take_graph(self, message: dict[str, Any]) -> None:
        tables = (
            (self.publishers, "publishedTopics", "publisherIds"),
            (self.subscribers, "subscribedTopics", "subscriberIds"),
            (self.providers, "advertisedServices", "providerIds"),
        )
        for table, key, ids in tables:
            for one in message.get(key) or ():
                name, nodes = _text(one["name"]), one[ids]
                table.pop(name, None)
                left = MOST_NODES - sum(map(len, table.values())) - len(table)
                if nodes and left > 0:
                    table[name] = tuple(_text(node).strip("/") for node in nodes[:left])
        for name in message.get("removedTopics") or ():
            self.publishers.pop(_text(name), None)
            self.subscribers.pop(_text(name), None)
        for name in message.get("removedServices") or ():
            self.providers.pop(_text(name), None)


_CHANGES: Final = {
    "serverInfo": ServerState._take_info,
    "status": ServerState._take_status,
    "advertise": ServerState._take_channels,
    "unadvertise": ServerState._drop_channels,
    "advertiseServices": ServerState._take_services,
    "unadvertiseServices": ServerState._drop_services,
    "connectionGraphUpdate": ServerState._take_graph,
}
"""Method that processes each operation of a server; other operations are ignored."""


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError("no text")
    return value[:_LONGEST_NAME]


def _number(value: Any) -> int:
    if not (isinstance(value, int) and 0 <= value < 1 << 32):
        raise ValueError("not a number of 32 bits")
    return value


def message_data(frame: bytes) -> tuple[int, bytes] | None:
    """Return (subscription number, payload) of a message with data; None for other binary messages.

    Raises:
        ProtocolError: If the message ends too early.
    """
    if not frame or frame[0] != 1:
        return None
    if len(frame) < _DATA.size:
        raise ProtocolError(f"message data of {len(frame)} bytes")
    return _DATA.unpack_from(frame)[1], frame[_DATA.size :]


def server_time(frame: bytes) -> Stamp | None:
    """Return the server's time from a binary message; None for messages of other kinds.

    Raises:
        ProtocolError: If the message has a wrong length, or the time is too large for ROS.
    """
    if not frame or frame[0] != 2:
        return None
    if len(frame) != _TIME.size:
        raise ProtocolError(f"a time message has {len(frame)} bytes instead of {_TIME.size}")
    stamp: Stamp = _TIME.unpack(frame)[1]
    if stamp >= NANOSECONDS << 31:
        raise ProtocolError(f"a time message has a time of {stamp} ns, which is too large for ROS")
    return stamp


def clock_message(stamp: Stamp) -> bytes:
    """Return a rosgraph_msgs/msg/Clock message in CDR."""
    return _CLOCK.pack(b"\x00\x01\x00\x00", *divmod(stamp, NANOSECONDS))


def request(operation: str, **fields: Any) -> str:
    """Return a client's message to the server, as JSON."""
    return json.dumps({"op": operation, **fields})


TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"

LARGEST_FOREIGN: Final = 2 * 1024 * 1024
"""Largest message in bytes of Foxglove's own types, whose transforms may take two bytes each."""

_PARTS: Final = re.compile(r"^MSG: *(\S+)", re.MULTILINE)
_ROS1_TRANSFORMS: Final = "tf/msg/tfMessage"


class RosTopic(NamedTuple):
    """ROS 2 topic that corresponds to a channel.

    Attributes:
        name: Name of the topic, without a leading slash.
        type: Type, such as "sensor_msgs/msg/LaserScan"; the channel's own type name if unknown in
            ROS.
    """

    name: str
    type: str


def ros_topic(channel: FoxgloveChannel) -> RosTopic:
    """Return the ROS topic and type of a channel.

    Foxglove's own transform type can be on any topic. A channel of this type counts as a publisher
    of `tf_static` if the topic's name ends in `tf_static`, else of `tf`.
    """
    name = channel.topic.strip("/")
    if _is_foreign(channel):
        is_static = name.rpartition("/")[2] == "tf_static"
        return RosTopic("tf_static" if is_static else "tf", TRANSFORMS)
    if channel.encoding not in ("cdr", "ros1"):
        return RosTopic(name, channel.type)
    try:
        full = full_name(channel.type)
    except InputError:
        return RosTopic(name, channel.type)
    return RosTopic(name, TRANSFORMS if full == _ROS1_TRANSFORMS else full)


def _is_foreign(channel: FoxgloveChannel) -> bool:
    return channel.encoding in ("protobuf", "json") and (channel.type, channel.encoding) in FOREIGN


def define(channel: FoxgloveChannel) -> bool:
    """Register the type of a channel from the channel's definition; return whether this was done.

    A type that is already known, or not defined in ROS 2's language, is not registered.

    Raises:
        InputError: If the definition is invalid.
    """
    full = ros_topic(channel).type
    if channel.encoding != "cdr" or channel.schema_encoding != "ros2msg" or not channel.definition:
        return False
    if INTERFACES.has(full):
        return False
    # Types that are already registered cannot be defined differently.
    for name in _PARTS.findall(channel.definition):
        if INTERFACES.has(full_name(name)):
            INTERFACES.structure(full_name(name))
    return INTERFACES.define(full, channel.definition)


def conversion(channel: FoxgloveChannel) -> Callable[[bytes], bytes]:
    """Return the function that converts a channel's messages to CDR.

    Raises:
        InputError: If the messages cannot be converted; the text says why.
        MalformedMessage: If the type cannot be read.
    """
    if _is_foreign(channel):
        decode = decoder_of(channel.type, channel.encoding, "", channel.topic)
        assert decode is not None
        return _foreign(decode)
    if channel.encoding not in ("cdr", "ros1"):
        raise InputError(f"the encoding of the messages, '{channel.encoding}', is unknown")
    theirs = _definitions(channel)
    if channel.encoding == "cdr":
        full = ros_topic(channel).type
        if theirs is not None and not same_layout(full, INTERFACES, theirs):
            raise InputError(f"the server has another definition of {short(full)} than tftool")
        return bytes
    definition = channel.definition.encode("utf-8", "backslashreplace")
    stream = Channel(channel.topic, channel.type, "ros1", "ros1msg", definition)
    return as_ros2(stream).payload


def _definitions(channel: FoxgloveChannel) -> Interfaces | None:
    """Return the definitions that the server sends for a channel's type; None without a definition.

    Raises:
        InputError: If a definition is invalid, contains itself or has too many fields.
    """
    if channel.schema_encoding not in ("ros1msg", "ros2msg") or not channel.definition.strip():
        return None
    theirs = Interfaces()
    full = full_name(channel.type)
    theirs.define(full, channel.definition)
    # A codec limits the number of fields: comparing hostile definitions could take forever.
    Codec(theirs.message(full))
    return theirs


def _foreign(decode: Decoder) -> Callable[[bytes], bytes]:
    def converted(payload: bytes) -> bytes:
        if len(payload) > LARGEST_FOREIGN:
            raise MalformedMessage(
                "foxglove.FrameTransforms",
                f"{len(payload)} bytes exceed the limit of {LARGEST_FOREIGN} bytes",
            )
        return encode_transforms(
            [
                TransformStamped(
                    one.stamp,
                    one.parent,
                    one.child,
                    Transform(Vector3(*one.numbers[:3]), Quaternion(*one.numbers[3:])),
                )
                for one in decode(payload)
            ]
        )

    return converted
