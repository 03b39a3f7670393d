"""Decoders of transforms in JSON and in other types than TFMessage, for one message at a time.

Sources: foxglove.dev's schemas of FrameTransform and FrameTransforms; common_interfaces.
"""

import json
import struct
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Final, NamedTuple

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import LAST_STAMP, NANOSECONDS, Stamp
from tftool.messages.classes import Interfaces
from tftool.messages.codec import Codec
from tftool.messages.layouts import CDR, ROS1


class Shaped(NamedTuple):
    """One transform: its stamp, frame names, position x y z and quaternion x y z w."""

    stamp: Stamp
    parent: str
    child: str
    numbers: tuple[float, float, float, float, float, float, float]


Decoder = Callable[[bytes], Iterable[Shaped]]

_FOXGLOVE: Final = {"FrameTransform": False, "FrameTransforms": True}

FOREIGN: Final = frozenset(
    [
        (f"foxglove{package}{name}", encoding)
        for package in (".", "/", "_msgs.", "_msgs/")
        for name in _FOXGLOVE
        for encoding in ("protobuf", "json")
    ]
    + [("geometry_msgs/TransformStamped", encoding) for encoding in ("cdr", "ros1", "json")]
    + [(kind, "json") for kind in ("tf2_msgs/TFMessage", "tf/tfMessage")]
)
"""Short type and encoding of messages that contain transforms, but are not TFMessages as bytes."""

_DOUBLE = struct.Struct("<d")


def decoder_of(kind: str, encoding: str, definition: str, topic: str) -> "Decoder | None":
    """Return a function that decodes the transforms in a message of a type; None for unknown types.

    Args:
        kind: Type of the messages, in short form.
        encoding: Encoding of the messages.
        definition: The type's definition, as recorded.
        topic: Name of the topic, used as the child frame of a PoseStamped.

    Raises:
        InputError: If the type's definition is wrong or missing.
    """
    package, _, name = kind.replace("/", ".").rpartition(".")
    if package in ("foxglove", "foxglove_msgs") and name in _FOXGLOVE:
        several = _FOXGLOVE[name]
        if encoding == "protobuf":
            return lambda payload: _protobuf(payload, several)
        if encoding == "json":
            return lambda payload: _json(payload, several, _of_json)
    if encoding == "json" and (kind, encoding) in FOREIGN:
        return lambda payload: _json(payload, name != "TransformStamped", _of_ros_json)
    layout = {"cdr": CDR, "ros1": ROS1}.get(encoding)
    read = _READERS.get(kind)
    if layout is None or read is None:
        return None
    decode = Codec(Interfaces().recorded(kind, definition), layout).decode
    return lambda payload: [read(decode(payload), topic)]


def _stamp(message: Any) -> Stamp:
    stamp = message.header.stamp
    return int(stamp.sec) * NANOSECONDS + int(stamp.nanosec)


def _numbers(place: Any, turn: Any) -> tuple[float, float, float, float, float, float, float]:
    return place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w


def _transform_stamped(message: Any, topic: str) -> Shaped:
    pose = message.transform
    return Shaped(
        _stamp(message),
        message.header.frame_id,
        message.child_frame_id,
        _numbers(pose.translation, pose.rotation),
    )


def _odometry(message: Any, topic: str) -> Shaped:
    pose = message.pose.pose
    return Shaped(
        _stamp(message),
        message.header.frame_id,
        message.child_frame_id,
        _numbers(pose.position, pose.orientation),
    )


def _pose_stamped(message: Any, topic: str) -> Shaped:
    pose = getattr(message.pose, "pose", message.pose)
    return Shaped(
        _stamp(message),
        message.header.frame_id,
        topic.strip("/"),
        _numbers(pose.position, pose.orientation),
    )


_READERS: Final[dict[str, Callable[[Any, str], Shaped]]] = {
    "geometry_msgs/TransformStamped": _transform_stamped,
    "nav_msgs/Odometry": _odometry,
    "geometry_msgs/PoseStamped": _pose_stamped,
    "geometry_msgs/PoseWithCovarianceStamped": _pose_stamped,
}


# Foxglove's types


def _json(
    payload: bytes, several: bool, read: "Callable[[dict[str, Any]], Shaped]"
) -> list[Shaped]:
    try:
        document = json.loads(payload)
        return [read(one) for one in (document["transforms"] if several else [document])]
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError) as error:
        raise MalformedMessage(
            "foxglove.FrameTransform", f"the data is not valid JSON: {error}"
        ) from error
    except RecursionError as error:
        raise MalformedMessage(
            "foxglove.FrameTransform", "the JSON is nested too deeply"
        ) from error


def _of_json(one: dict[str, Any]) -> Shaped:
    return _shaped(one["timestamp"], one["parent_frame_id"], one["child_frame_id"], one)


def _of_ros_json(one: dict[str, Any]) -> Shaped:
    header = one["header"]
    return _shaped(header["stamp"], header["frame_id"], one["child_frame_id"], one["transform"])


def _shaped(time: dict[str, Any], parent: Any, child: Any, pose: dict[str, Any]) -> Shaped:
    place, turn = pose["translation"], pose["rotation"]
    # ROS 1 has the names secs and nsecs, ROS 2 sec and nanosec, Foxglove sec and nsec.
    whole = time["sec" if "sec" in time else "secs"]
    rest = time[next((name for name in ("nanosec", "nsec") if name in time), "nsecs")]
    stamp = int(whole) * NANOSECONDS + int(rest)
    numbers = [float(place[axis]) for axis in "xyz"] + [float(turn[axis]) for axis in "xyzw"]
    x, y, z, qx, qy, qz, qw = numbers
    return Shaped(_checked(stamp), str(parent), str(child), (x, y, z, qx, qy, qz, qw))


def _protobuf(payload: bytes, several: bool) -> list[Shaped]:
    try:
        if not several:
            return [_of_protobuf(payload)]
        return [_of_protobuf(value) for number, value in _fields(payload) if number == 1]
    except (IndexError, struct.error, TypeError, ValueError) as error:
        raise MalformedMessage(
            "foxglove.FrameTransform", f"the data is not valid protobuf: {error}"
        ) from error


def _of_protobuf(payload: bytes) -> Shaped:
    seconds = nanoseconds = 0
    names = ["", ""]
    # Protobuf omits zeros; without any rotation field, the rotation is the identity.
    place, turn = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]
    turned = False
    for number, value in _fields(payload):
        if number == 1:
            for part, count in _fields(value):
                if part == 1:
                    seconds = int(count)
                elif part == 2:
                    nanoseconds = int(count)
        elif number in (2, 3):
            if not isinstance(value, bytes):
                raise ValueError("a frame name is not UTF-8 text")
            names[number - 2] = value.decode("utf-8", "backslashreplace")
        elif number in (4, 5):
            target = place if number == 4 else turn
            turned = turned or number == 5
            for part, double in _fields(value):
                if 1 <= part <= len(target):
                    (target[part - 1],) = _DOUBLE.unpack(double)
    if not turned:
        turn = [0.0, 0.0, 0.0, 1.0]
    x, y, z = place
    qx, qy, qz, qw = turn
    stamp = _checked(seconds * NANOSECONDS + nanoseconds)
    return Shaped(stamp, names[0], names[1], (x, y, z, qx, qy, qz, qw))


def _checked(stamp: int) -> Stamp:
    if not -LAST_STAMP <= stamp <= LAST_STAMP:
        raise ValueError(f"the stamp {stamp} ns does not fit 64 bits")
    return stamp


def _fields(payload: bytes) -> Iterator[tuple[int, Any]]:
    """Yield the number and value of each protobuf field; a value is an integer or bytes."""
    position, size = 0, len(payload)
    while position < size:
        key, position = _varint(payload, position)
        kind = key & 7
        if kind == 0:
            value, position = _varint(payload, position)
            yield key >> 3, value
            continue
        if kind == 2:
            length, position = _varint(payload, position)
        elif kind in (1, 5):
            length = 8 if kind == 1 else 4
        else:
            raise ValueError(f"a field has the wire type {kind}, which is not supported")
        if position + length > size:
            raise ValueError(f"a field announces {length} bytes, more than the message has")
        yield key >> 3, payload[position : position + length]
        position += length


def _varint(payload: bytes, position: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        byte = payload[position]
        position += 1
        value |= (byte & 0x7F) << shift
        if byte < 0x80:
            return value, position
        shift += 7
        if shift > 63:
            raise ValueError("a number has more than 64 bits")
