"""Serialiser of foxglove.FrameTransforms in protobuf, and the schema of these messages.

Source: foxglove.dev's schemas of FrameTransforms, FrameTransform, Vector3 and Quaternion, and
protobuf's own wire format and descriptor.proto.
"""

import struct
from collections.abc import Iterable, Sequence
from functools import cache
from typing import Final

from tftool.base.stamps import NANOSECONDS
from tftool.buffer.sample import TransformStamped

_VARINT, _LENGTH = 0, 2
_POSE: Final = struct.Struct("<BdBdBd")
_TURN: Final = struct.Struct("<BdBdBdBd")

# Numbers for types and labels of fields in descriptor.proto.
_DOUBLE, _INT64, _INT32, _STRING, _MESSAGE = 1, 3, 5, 9, 11
_ONE, _MANY = 1, 3


def frame_transforms(samples: Iterable[TransformStamped]) -> bytes:
    """Return the bytes of a foxglove.FrameTransforms message with these samples."""
    return b"".join(_field(1, _frame_transform(one)) for one in samples)


def _frame_transform(sample: TransformStamped) -> bytes:
    whole, rest = divmod(sample.stamp, NANOSECONDS)
    place, turn = sample.transform
    return b"".join(
        (
            _field(1, _number(1, whole) + _number(2, rest)),
            _field(2, sample.frame_id.encode("utf-8", "replace")),
            _field(3, sample.child_frame_id.encode("utf-8", "replace")),
            _field(4, _POSE.pack(0x09, place[0], 0x11, place[1], 0x19, place[2])),
            _field(5, _TURN.pack(0x09, turn[0], 0x11, turn[1], 0x19, turn[2], 0x21, turn[3])),
        )
    )


@cache
def frame_transforms_definition() -> bytes:
    """Return the bytes of the FileDescriptorSet of foxglove.FrameTransforms, parts first."""
    time = ".google.protobuf."
    own = ".foxglove."
    doubles = [(name, _DOUBLE, "", _ONE) for name in "xyzw"]
    files = (
        _file(
            "google/protobuf/timestamp.proto",
            "google.protobuf",
            (),
            "Timestamp",
            [("seconds", _INT64, "", _ONE), ("nanos", _INT32, "", _ONE)],
        ),
        _file("foxglove/Vector3.proto", "foxglove", (), "Vector3", doubles[:3]),
        _file("foxglove/Quaternion.proto", "foxglove", (), "Quaternion", doubles),
        _file(
            "foxglove/FrameTransform.proto",
            "foxglove",
            (
                "foxglove/Quaternion.proto",
                "foxglove/Vector3.proto",
                "google/protobuf/timestamp.proto",
            ),
            "FrameTransform",
            [
                ("timestamp", _MESSAGE, f"{time}Timestamp", _ONE),
                ("parent_frame_id", _STRING, "", _ONE),
                ("child_frame_id", _STRING, "", _ONE),
                ("translation", _MESSAGE, f"{own}Vector3", _ONE),
                ("rotation", _MESSAGE, f"{own}Quaternion", _ONE),
            ],
        ),
        _file(
            "foxglove/FrameTransforms.proto",
            "foxglove",
            ("foxglove/FrameTransform.proto",),
            "FrameTransforms",
            [("transforms", _MESSAGE, f"{own}FrameTransform", _MANY)],
        ),
    )
    return b"".join(_field(1, one) for one in files)


def _file(
    name: str,
    package: str,
    needs: Sequence[str],
    message: str,
    fields: Sequence[tuple[str, int, str, int]],
) -> bytes:
    """Return the bytes of a FileDescriptorProto with one message type."""
    body = _field(1, message.encode())
    for number, (field, kind, type_name, label) in enumerate(fields, 1):
        described = _field(1, field.encode()) + _number(3, number) + _number(4, label)
        described += _number(5, kind)
        if type_name:
            described += _field(6, type_name.encode())
        body += _field(2, described)
    head = _field(1, name.encode()) + _field(2, package.encode())
    head += b"".join(_field(3, one.encode()) for one in needs)
    return head + _field(4, body) + _field(12, b"proto3")


def _field(number: int, content: bytes) -> bytes:
    return _varint(number << 3 | _LENGTH) + _varint(len(content)) + content


def _number(number: int, value: int) -> bytes:
    return _varint(number << 3 | _VARINT) + _varint(value & 0xFFFF_FFFF_FFFF_FFFF)


def _varint(value: int) -> bytes:
    found = bytearray()
    while value > 0x7F:
        found.append(value & 0x7F | 0x80)
        value >>= 7
    found.append(value)
    return bytes(found)
