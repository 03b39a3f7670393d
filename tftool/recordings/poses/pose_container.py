"""Pose file that is read like a recording: every pose becomes a message on /tf or /tf_static."""

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Final

import numpy as np

from tftool.base.errors import InputError, UsageError
from tftool.base.plain_text import count
from tftool.base.stamps import NANOSECONDS
from tftool.buffer.sample import TransformStamped
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import encode_transforms
from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch
from tftool.recordings.containers import RECORDED
from tftool.recordings.contract import Floats, Progress, Stamps
from tftool.recordings.find import Found
from tftool.recordings.message_conversion import TRANSFORMS, ros2_channel
from tftool.recordings.poses.pose_formats import PoseFormat, format_of_file
from tftool.recordings.poses.pose_links import PoseFile, PoseLink
from tftool.recordings.poses.pose_options import PoseOptions

_TURNED: Final = (1.0, 0.0, 0.0, 0.0)
"""Quaternion x y z w of the half turn about x between the axes of OpenCV and OpenGL."""

_NOT_UNIT: Final = 1e-6
_NOT_ROTATION: Final = 1e-2


class PoseContainer:
    """Container with the poses of one file, as messages on /tf and /tf_static; see `Container`."""

    def __init__(self, path: Path, form: PoseFormat, options: PoseOptions) -> None:
        """Read a pose file.

        Raises:
            InputError: If the file cannot be read.
            UsageError: If --pose-rate is given for a file with its own stamps, or without motion.
        """
        file = PoseFile(path, options, (form.parent, form.child))
        links = form.read(file)
        if options.pose_rate is not None and not file.is_timed:
            what = "is static" if all(link.static for link in links) else "has its own stamps"
            raise UsageError(
                f"'{path}' {what}: leave out --pose-rate, or write it after the file without "
                "stamps."
            )
        self.damage: list[str] = []
        self.oddities: list[str] = []
        self.size = path.stat().st_size
        self.kind = f"poses ({form.name})"
        self.channels: list[Channel] = []
        parts: list[tuple[int, Stamps, np.ndarray]] = []
        solved = [(link, *_solved(link, form, options, file)) for link in links]
        moments = [stamps for link, stamps, _ in solved if not link.static and len(stamps)]
        start = min((int(one.min()) for one in moments), default=0)
        for link, stamps, poses in solved:
            number = self._channel(static=link.static)
            when = np.full_like(stamps, start) if link.static else stamps
            parts.append((number, when, _messages(link, options.prefix, when, poses)))
        for what, number in file.oddities.items():
            # Only rows that are left out are missing from the poses.
            sentences = self.damage if what.endswith("left out") else self.oddities
            sentences.append(f"{path.name}: {count(number, 'row')} {what}.")
        if not any(len(when) for _, when, _ in parts):
            raise InputError(f"'{path}' has no poses. {' '.join(self.damage)}".rstrip())
        self._batch = _joined(parts)
        self.start, self.end = int(self._batch.log_times[0]), int(self._batch.log_times[-1])
        self.streams = self.channels

    def _channel(self, *, static: bool) -> int:
        channel = ros2_channel("/tf_static" if static else "/tf", TRANSFORMS, static=static)
        if channel not in self.channels:
            self.channels.append(channel)
        return self.channels.index(channel)

    @property
    def counts(self) -> list[int]:
        """Return the number of messages of each stream."""
        found: list[int] = np.bincount(self._batch.senders, minlength=len(self.streams)).tolist()
        return found

    def expected(self, wanted: Collection[int]) -> int:
        """Return the number of messages in some streams."""
        return sum(self.counts[number] for number in wanted)

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield the messages of some streams in batches; see `Container`."""
        chosen = np.flatnonzero(np.isin(self._batch.senders, list(wanted)))
        if len(chosen):
            yield self._batch.chosen(chosen)
        if progress is not None:
            progress(self.size, self.size)

    def close(self) -> None:
        """Do nothing: the file was closed after reading."""

    def write_mcap(self, path: Path) -> None:
        """Write the messages as an MCAP file, for editing."""
        writer = RECORDED.create(path, profile="ros2", library="tftool")
        numbers = [writer.channel(one) for one in self.channels]
        messages = self._batch
        for place in range(len(messages)):
            number = numbers[int(messages.senders[place])]
            writer.write(number, int(messages.log_times[place]), messages.payload(place))
        writer.finish()


def open_poses(found: Found) -> PoseContainer:
    """Read a pose file, with the options that the user gave for this file.

    Raises:
        InputError: If the file cannot be read.
    """
    return PoseContainer(found.paths[0], *format_of_file(found.name, found.paths[0]))


def _solved(
    link: PoseLink, form: PoseFormat, options: PoseOptions, file: PoseFile
) -> tuple[Stamps, Floats]:
    """Return a link's sorted stamps, shape (n,), and poses in ROS's axes, shape (n, 7)."""
    stamps = np.array(link.stamps, dtype=np.int64)
    numbers = np.array(link.numbers, dtype=np.float64).reshape(-1, link.width)
    keep = np.asarray(np.isfinite(numbers).all(axis=1))
    _note(file, "with NaN left out", int((~keep).sum()))
    stamps, numbers = stamps[keep], numbers[keep]
    if link.width == 12:
        matrices = numbers.reshape(-1, 3, 4)
        turns = _quaternions(matrices[:, :, :3], file)
        shifts = matrices[:, :, 3]
    else:
        shifts, turns = numbers[:, :3], numbers[:, 3:]
    square = np.einsum("ij,ij->i", turns, turns)
    zero = square < 1e-12
    _note(file, "with a zero quaternion left out", int(zero.sum()))
    stamps, shifts, turns, square = stamps[~zero], shifts[~zero], turns[~zero], square[~zero]
    turns = np.where((np.abs(square - 1.0) > _NOT_UNIT)[:, None], batch.unit(turns), turns)
    if form.inverse != options.inverted:
        unit = batch.unit(turns)
        turns = batch.conjugate(unit)
        shifts = -batch.rotate(turns, shifts)
    if (options.axes or form.axes) == "opengl":
        turns = batch.multiply(batch.unit(turns), np.broadcast_to(_TURNED, turns.shape))
    if len(stamps) > 1:
        _note(file, "out of order, sorted", int((np.diff(stamps) < 0).sum()))
        order = np.argsort(stamps, kind="stable")
        stamps, shifts, turns = stamps[order], shifts[order], turns[order]
        _note(file, "with the stamp of another row", int((np.diff(stamps) == 0).sum()))
    return stamps, np.hstack([shifts, turns])


def _note(file: PoseFile, what: str, count: int) -> None:
    if count:
        file.oddities[what] += count


def _quaternions(matrices: Floats, file: PoseFile) -> Floats:
    """Return the quaternions x y z w of rotation matrices, shape (n, 3, 3).

    Raises:
        InputError: If a matrix is not a rotation.

    Source:
        Shepperd, "Quaternion from Rotation Matrix", 1978.
    """
    square = np.einsum("nij,nkj->nik", matrices, matrices)
    error = np.abs(square - np.eye(3)).max(axis=(1, 2), initial=0.0)
    bad = (error > _NOT_ROTATION) | (np.linalg.det(matrices) < 0.0)
    if bad.any():
        raise InputError(
            f"'{file.path}': the matrix of pose {int(np.argmax(bad)) + 1} is not a rotation."
        )
    m = matrices
    trace = np.trace(m, axis1=1, axis2=2)
    choices = np.stack([m[:, 0, 0], m[:, 1, 1], m[:, 2, 2], trace], axis=1)
    found = np.empty((len(m), 4))
    for choice in range(4):
        rows = choices.argmax(axis=1) == choice
        one = m[rows]
        if choice == 3:
            found[rows, 0] = one[:, 2, 1] - one[:, 1, 2]
            found[rows, 1] = one[:, 0, 2] - one[:, 2, 0]
            found[rows, 2] = one[:, 1, 0] - one[:, 0, 1]
            found[rows, 3] = 1.0 + trace[rows]
            continue
        i, j, k = choice, (choice + 1) % 3, (choice + 2) % 3
        found[rows, i] = 1.0 - trace[rows] + 2.0 * one[:, i, i]
        found[rows, j] = one[:, j, i] + one[:, i, j]
        found[rows, k] = one[:, k, i] + one[:, i, k]
        found[rows, 3] = one[:, k, j] - one[:, j, k]
    return batch.unit(found)


def _messages(link: PoseLink, prefix: str, stamps: Stamps, poses: Floats) -> np.ndarray:
    """Return the bytes of one TFMessage per pose, shape (n, bytes)."""
    before = f"{prefix}/" if prefix else ""
    sample = TransformStamped(1, before + link.parent, before + link.child, Transform())
    template = np.frombuffer(encode_transforms((sample,)), dtype=np.uint8)
    rows = np.tile(template, (len(stamps), 1))
    # The stamp is after 4 bytes of CDR's header and 4 bytes of the number of transforms.
    rows[:, 8:12] = (stamps // NANOSECONDS).astype("<i4")[:, None].view(np.uint8)
    rows[:, 12:16] = (stamps % NANOSECONDS).astype("<u4")[:, None].view(np.uint8)
    rows[:, -56:] = np.ascontiguousarray(poses, dtype="<f8").view(np.uint8)
    return rows


def _joined(parts: "list[tuple[int, Stamps, np.ndarray]]") -> Batch:
    """Merge the messages of all links into one batch, in order of time."""
    lengths = np.concatenate([np.full(len(when), rows.shape[1]) for _, when, rows in parts])
    senders = np.concatenate([np.full(len(when), number) for number, when, _ in parts])
    log_times = np.concatenate([when for _, when, _ in parts])
    starts = np.cumsum(lengths) - lengths
    order = np.argsort(log_times, kind="stable")
    return Batch(
        np.concatenate([rows.ravel() for _, _, rows in parts]),
        starts[order].astype(np.int64),
        lengths[order].astype(np.int64),
        log_times[order],
        senders[order].astype(np.int32),
    )
