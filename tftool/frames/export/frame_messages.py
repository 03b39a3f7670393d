"""Export of all transforms to an MCAP file, as tf2_msgs or for Foxglove and Rerun."""

import os
from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.messages.protobuf import frame_transforms, frame_transforms_definition
from tftool.recordings.channel import Channel
from tftool.recordings.contract import Progress
from tftool.recordings.recording_writer import write_recording

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
    """Write all transforms of a buffer: static transforms first, then moving links by stamps.

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
    """Yield the transforms of each message: all static transforms, then those of each stamp."""
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
