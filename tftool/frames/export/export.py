"""Export of frames to files: poses of pairs over time, or links (poses of frames in parents)."""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, ParamSpec, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import UsageError, without_frames
from tftool.base.stamps import LATEST, Duration, Stamp
from tftool.buffer.buffer import Buffer
from tftool.frames.export import frame_messages, static_files
from tftool.frames.export.export_formats import DECIMALS, Format, Style, format_of
from tftool.frames.export.static_files import LINK_WRITERS
from tftool.frames.export.trajectory_files import TRAJECTORY_WRITERS
from tftool.frames.pair_samples import Moments, Stamps, Trajectory, sample
from tftool.recordings.contract import Progress
from tftool.recordings.target import whole_file

if TYPE_CHECKING:
    from tftool.frames.frames import Frames
    from tftool.recordings.recording import Recording
    from tftool.robots.robot_model import Robot

Framed: TypeAlias = "Buffer | Frames | Recording | Robot"
"""Source of frames for an export; in a robot description every joint is at rest."""


@dataclass(frozen=True, slots=True, eq=False)
class Exported:
    """Result of an export: the written files.

    Attributes:
        paths: Paths of the files.
        format: Format of the files.
        count: Number of poses, links or transforms in the files.
        trajectories: Poses of each pair, and the times at which lookups failed; empty for links.
    """

    paths: tuple[Path, ...]
    format: Format
    count: int
    trajectories: tuple[Trajectory, ...] = field(default=(), repr=False)

    @property
    def refused(self) -> int:
        """Number of times that were left out because the lookup failed."""
        return sum(one.refused for one in self.trajectories)


def buffer_of(frames: Framed) -> Buffer:
    """Return the buffer of a recording, a robot or opened frames, or the given buffer itself."""
    if isinstance(frames, Buffer):
        return frames
    if not hasattr(frames, "buffer"):
        raise without_frames(frames)
    held = frames.buffer
    return held if isinstance(held, Buffer) else held()


P = ParamSpec("P")


def _named_path(function: "Callable[P, Exported]") -> "Callable[P, Exported]":
    """Decorate `export` to raise a TypeError for arguments in the order of an earlier version."""

    @wraps(function)
    def checked(*given: P.args, **named: P.kwargs) -> Exported:
        if "path" not in named or len(given) > 3 or {"target_frame", "source_frame"} & named.keys():
            raise TypeError(
                "export takes frames, target and source, and the path as a keyword argument: "
                "export(recording, 'map', 'base_link', path='run.tum')"
            )
        return function(*given, **named)

    return checked


@_named_path
def export(
    frames: Framed,
    target: str | None = None,
    source: str | None = None,
    *,
    path: "str | os.PathLike[str]",
    pairs: Sequence[tuple[str, str]] = (),
    format: str | None = None,
    start: Stamp | None = None,
    end: Stamp | None = None,
    period: Duration | None = None,
    stamps: npt.ArrayLike | None = None,
    decimals: int = DECIMALS,
    rpy: bool = False,
    foxglove: bool = False,
    with_moving: bool = False,
    root: str | None = None,
    time: Stamp = LATEST,
    force: bool = False,
    progress: Progress | None = None,
) -> Exported:
    """Write the poses of one frame in another over time, or the links between frames.

        tftool.export(recording, "map", "base_link", path="run.tum")
        tftool.export(recording, path="robot.urdf")

    The file appears only when it is complete. Times at which a lookup fails are left out, and are
    counted in the result.

    Args:
        frames: Opened frames, a recording, a buffer, or a robot description.
        target: Frame in which poses are expressed; None to write links.
        source: Frame whose poses are written.
        path: File to write. Its suffix selects the format: .tum .kitti .csv .npz .parquet for
            pairs, .urdf .launch.py .launch.xml .launch.yaml .sh .mcap for links.
        pairs: Several pairs (target, source), for CSV, npz and Parquet.
        format: Name of a `Format`, such as "euroc", which replaces the format of the suffix.
        start: Time before which nothing is written, nanoseconds.
        end: Time after which nothing is written, nanoseconds.
        period: Nanoseconds between lookups; None for the stamps of the frame with the highest rate.
        stamps: Times of the lookups instead of `start`, `end` and `period`, nanoseconds, shape
            (n,).
        decimals: Number of decimals; see `Style`.
        rpy: Whether to add roll, pitch and yaw to CSV and Parquet.
        foxglove: Whether to write MCAP as foxglove.FrameTransforms.
        with_moving: Whether to write moving links to a URDF, as floating joints.
        root: Frame below which links are written; None for all links.
        time: Time of the poses of moving links, nanoseconds.
        force: Whether the file may replace an existing file.
        progress: Function called with the progress in bytes.

    Raises:
        InputError: If the file cannot be written.
        TransformException: If a frame is unknown, or a pair has no pose at any time.
        TypeError: If `frames` is not a source of frames, or if `path` is not a keyword argument.
        UsageError: If the options contradict each other, or an extra is missing.
    """
    place = Path(path)
    form = _named(format) if format is not None else format_of(place)
    asked = list(pairs)
    if (target is None) != (source is None):
        raise UsageError("Only one frame of a pair is given: name the target and the source.")
    if target is not None and source is not None:
        asked.insert(0, (target, source))
    refuse_input(frames, place)
    moments = Moments(start, end, period, None if stamps is None else _stamps(stamps))
    style = Style(decimals, rpy, foxglove, with_moving, root, time)
    return _written(frames, place, form, asked, moments, style, force, progress)


def _written(
    frames: Framed,
    place: Path,
    form: Format,
    pairs: Sequence[tuple[str, str]],
    moments: Moments,
    style: Style,
    force: bool,
    progress: Progress | None,
) -> Exported:
    """Write pairs of frames over time, or links, depending on the format."""
    buffer = buffer_of(frames)
    if not form.is_trajectory:
        if pairs:
            raise UsageError(
                f"{form} files contain all frames, not a pair: leave out the target and the source."
            )
        return write_links(buffer, place, form, style, force=force, progress=progress)
    if not pairs:
        raise UsageError(
            f"{form} files contain pairs of frames over time: name a target and a source."
        )
    found = [sample(buffer, target, source, moments) for target, source in pairs]
    return write_trajectories(found, place, form, style, force=force, progress=progress)


def write_trajectories(
    found: Sequence[Trajectory],
    path: Path,
    form: Format,
    style: Style,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> Exported:
    """Write trajectories, whose poses were looked up before, to a file.

    Raises:
        InputError: If the file cannot be written.
        TransformException: If a pair has no pose at any time.
        UsageError: If the format supports one pair only, or an extra is missing.
    """
    if len(found) > 1 and form.holds == "pair":
        raise UsageError(
            f"{form} files contain one pair, not {len(found)}: write .csv, .npz or .parquet."
        )
    if style.rpy and form not in (Format.csv, Format.parquet):
        raise UsageError(f"Roll, pitch and yaw are columns of CSV and Parquet, not of {form}.")
    paths = TRAJECTORY_WRITERS[form](found, path, style, force, progress)
    count = sum(len(one.path) - one.refused for one in found)
    return Exported(tuple(paths), form, count, tuple(found))


def write_links(
    buffer: Buffer,
    path: Path,
    form: Format,
    style: Style,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> Exported:
    """Write the links (poses of frames in their parents) to a file.

    MCAP contains all frames. A URDF contains static frames, and moving frames on request. The other
    formats contain static frames only.

    Raises:
        InputError: If the file cannot be written.
        UsageError: If there is nothing to write, or the format cannot contain these links.
    """
    if not buffer.frames():
        raise UsageError("The source has no frames to write.")
    if form is Format.mcap:
        count = frame_messages.write_frames(
            buffer, path, foxglove=style.foxglove, force=force, progress=progress
        )
        return Exported((path,), form, count)
    if style.foxglove:
        raise UsageError(
            f"foxglove.FrameTransforms can only be written to an MCAP file, not into {form}."
        )
    if style.with_moving and form is not Format.urdf:
        raise UsageError(
            f"The format {form} contains static transforms only: leave out --with-moving, "
            "or write an MCAP file."
        )
    links = static_files.fixed_links(
        buffer, with_moving=style.with_moving, time=style.time, root=style.root
    )
    if not links:
        moving = " --with-moving adds moving frames." if form is Format.urdf else ""
        tops = static_files.roots(static_files.fixed_links(buffer))
        if tops:
            shown = ", ".join(f"'{one}'" for one in tops[:6]) + (" …" if len(tops) > 6 else "")
            raise UsageError(
                f"Static transforms connect no frame below '{style.root}' with it, and {form} "
                f"contains static frames only: they are below {shown}.{moving}"
            )
        raise UsageError(f"No frame is static, and {form} contains static frames only.{moving}")
    name = path.name.partition(".")[0] or "robot"
    text = LINK_WRITERS[form](links, name)
    with whole_file(path, force=force) as file:
        file.write(text.encode("utf-8"))
        if form is Format.sh:
            os.chmod(file.fileno(), 0o755)
    return Exported((path,), form, len(links))


def _named(name: str) -> Format:
    for form in Format:
        if form == name:
            return form
    raise UsageError(f"'{name}' is not a format: use one of {', '.join(Format)}.")


def refuse_input(frames: object, path: Path) -> None:
    """Check that an output path is not the file or folder from which the frames were read.

    Raises:
        UsageError: If the path is the input.
    """
    if getattr(frames, "kind", "") in ("scenario", "session"):
        return
    name = getattr(frames, "name", None)
    if not isinstance(name, str) or not os.path.exists(name) or not os.path.lexists(path):
        return
    inside = os.path.isdir(name) and path.parent.exists() and os.path.samefile(name, path.parent)
    ignored = getattr(getattr(frames, "found", None), "passed_over", ())
    if inside and path.exists() and any(one.exists() and path.samefile(one) for one in ignored):
        return  # a file of the folder that was not read, such as the output of an earlier export
    if inside or (path.exists() and os.path.samefile(name, path)):
        raise UsageError(f"'{path}' is the input: choose another name.")


def _stamps(stamps: npt.ArrayLike) -> Stamps:
    found = np.asarray(stamps)
    if found.ndim != 1 or not np.issubdtype(found.dtype, np.integer):
        raise TypeError("stamps must be int64 nanoseconds of shape (n,)")
    return found.astype(np.int64)
