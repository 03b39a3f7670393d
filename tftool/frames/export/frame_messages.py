"""Export of all transforms to an MCAP file, as tf2_msgs/TFMessage or foxglove.FrameTransforms."""

import os
import struct
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from typing import Final

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.recordings.channel import Channel
from tftool.recordings.contract import Progress
from tftool.recordings.recording_writer import write_recording

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
    """Return the protobuf schema of foxglove.FrameTransforms as bytes of a FileDescriptorSet."""
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


_BYTES_PER_SAMPLE = 64
_TOLD_EVERY = 512


def write_frames(
    buffer: Buffer,
    path: "str | os.PathLike[str]",
    *,
    foxglove: bool = False,
    force: bool = False,
    progress: Progress | None = None,
) -> int:
    """Write all transforms of a buffer: first static transforms, then moving transforms by stamp.

    Args:
        buffer: Source of the transforms.
        path: File to write; its name must end in ".mcap".
        foxglove: Whether to write foxglove.FrameTransforms in protobuf, not tf2_msgs/TFMessage.
        force: Whether an existing file may be replaced.
        progress: Function called with the progress.

    Returns:
        The number of transforms written.

    Raises:
        UsageError: If the file exists and `force` is not given.
        InputError: If the file cannot be written.
    """
    statics, moving, total = _held(buffer)
    done = 0
    with write_recording(path, profile="" if foxglove else "ros2", force=force) as recording:
        for number, (stamp, samples) in enumerate(_messages(statics, moving)):
            still = number == 0 and bool(statics)
            if foxglove:
                channel = Channel(
                    "/tf_static" if still else "/tf",
                    "foxglove.FrameTransforms",
                    "protobuf",
                    "protobuf",
                    frame_transforms_definition(),
                )
                recording.raw(channel, stamp, frame_transforms(samples))
            elif still:
                recording.static_transforms(samples, stamp)
            else:
                recording.transforms(samples, stamp)
            done += len(samples)
            if progress is not None and number % _TOLD_EVERY == 0:
                progress(done * _BYTES_PER_SAMPLE, total * _BYTES_PER_SAMPLE)
    return done


Moving = list[tuple[str, "np.ndarray", "np.ndarray", "np.ndarray"]]


def _held(buffer: Buffer) -> "tuple[list[TransformStamped], Moving, int]":
    statics: list[TransformStamped] = []
    moving: Moving = []
    total = 0
    for frame in buffer.frames():
        held = buffer.samples(frame)
        total += len(held)
        if held.is_static:
            pose = _pose(held.poses[0].tolist())
            statics.append(TransformStamped(0, str(held.parents[0]), frame, pose))
        elif len(held):
            moving.append((frame, held.stamps, held.parents, held.poses))
    return statics, moving, total


def _messages(
    statics: list[TransformStamped], moving: "Moving"
) -> Iterator[tuple[Stamp, list[TransformStamped]]]:
    """Yield (time, transforms) of each message: static transforms, then moving ones by stamp."""
    stamps = np.concatenate([one[1] for one in moving]) if moving else np.array([], np.int64)
    order = np.argsort(stamps, kind="stable")
    start = int(stamps[order[0]]) if len(order) else NANOSECONDS
    if statics:
        yield start, [one._replace(stamp=start) for one in statics]
    whose = np.repeat(np.arange(len(moving)), [len(one[1]) for one in moving])
    begins = np.cumsum([0, *(len(one[1]) for one in moving)])
    gathered: list[TransformStamped] = []
    for place in order.tolist():
        stamp = int(stamps[place])
        if gathered and gathered[0].stamp != stamp:
            yield gathered[0].stamp, gathered
            gathered = []
        frame, _, parents, poses = moving[whose[place]]
        row = place - int(begins[whose[place]])
        gathered.append(
            TransformStamped(stamp, str(parents[row]), frame, _pose(poses[row].tolist()))
        )
    if gathered:
        yield gathered[0].stamp, gathered


def _pose(row: list[float]) -> Transform:
    return Transform(Vector3(*row[:3]), Quaternion(*row[3:]))
