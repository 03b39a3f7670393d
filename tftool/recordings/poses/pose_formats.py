"""Table of the formats of pose files, each with a recogniser, a reader and its convention.

A new format needs a function that recognises the first bytes, a reader, and one entry in the table.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Final

from tftool.base.errors import InputError, UsageError
from tftool.recordings.find import HEAD
from tftool.recordings.poses import pose_readers as cameras
from tftool.recordings.poses import pose_readers as trajectories
from tftool.recordings.poses.pose_links import PoseFile, PoseLink
from tftool.recordings.poses.pose_options import PoseOptions, options_of, path_behind_prefix

_FIRST_NANOSECONDS: Final = 1 << 41
_JSON: Final = re.compile(r'"(frames|transform_matrix|camera_angle_x|fl_x|camera_model)"\s*:')


class Head:
    """First bytes of a file, split into lines, words and numbers to recognise the format."""

    def __init__(self, data: bytes) -> None:
        """Decode the first bytes of a file; omit a last line that may be incomplete."""
        self.data = data
        self.text = data.decode("utf-8-sig", "replace")
        lines = self.text.splitlines()
        self.lines = lines[:-1] if len(data) >= HEAD and len(lines) > 1 else lines

    @cached_property
    def row(self) -> str:
        """First line that is neither empty nor a comment; "" if there is none."""
        return next((one for one in map(str.strip, self.lines) if one and one[0] != "#"), "")

    @cached_property
    def numbers(self) -> list[float]:
        """Numbers in the line `row`; empty if a word in this line is not a number."""
        try:
            return [float(one) for one in self.row.replace(",", " ").split()]
        except ValueError:
            return []

    @property
    def has_commas(self) -> bool:
        """Whether the numbers in `row` are separated by commas."""
        return "," in self.row

    @property
    def has_nanoseconds(self) -> bool:
        """Whether the first word of `row` is an integer too large for seconds."""
        word = self.row.partition(",")[0].strip()
        return word.isdigit() and len(word) < 20 and int(word) >= _FIRST_NANOSECONDS

    def has_line(self, pattern: str) -> bool:
        """Whether some line begins with text that matches a pattern."""
        return re.search(rf"^(?:{pattern})", self.text, re.MULTILINE) is not None


@dataclass(frozen=True, slots=True)
class PoseFormat:
    """One format of pose files, with its recogniser, its reader and its convention.

    Attributes:
        name: Name for --pose-format.
        fits: Function that checks whether a file's first bytes look like this format.
        read: Function that reads a file.
        parent: Default name of the parent.
        child: Default name of the child.
        convention: Sentence about the meaning of the numbers.
        inverse: Whether the numbers map points from the parent to the child.
        axes: Axes of cameras in this format, "opencv" or "opengl"; "" without cameras.
    """

    name: str
    fits: Callable[[Head], bool]
    read: Callable[[PoseFile], list[PoseLink]]
    parent: str
    child: str
    convention: str
    inverse: bool = False
    axes: str = ""


def _is_tum(head: Head) -> bool:
    return len(head.numbers) == 8 and not head.has_commas


def _is_tum_with_commas(head: Head) -> bool:
    if head.has_line(r"#.*\[ns\]") or _has_euroc_header(head):
        return False
    return len(head.numbers) == 8 and head.has_commas and not head.has_nanoseconds


def _has_euroc_header(head: Head) -> bool:
    return re.match(r"#\s*timestamp\b.*q_RS_w", head.text) is not None


def _is_euroc(head: Head) -> bool:
    return _has_euroc_header(head) or (
        len(head.numbers) >= 8 and head.has_commas and head.has_nanoseconds
    )


def _is_csv(head: Head) -> bool:
    if set(trajectories.TABLE_COLUMNS) <= set(head.row.split(",")):
        return True
    is_named = head.text.startswith("#")
    return len(head.numbers) == 8 and head.has_commas and head.has_nanoseconds and not is_named


def _is_colmap(head: Head) -> bool:
    words = head.row.split(maxsplit=9)
    if not words:
        return head.has_line(r"#\s+IMAGE_ID, QW, QX")
    try:
        [float(one) for one in words[1:8]]
        return len(words) == 10 and words[0].isdigit() and words[8].isdigit() and not head.numbers
    except ValueError:
        return False


FORMATS: Final = (
    PoseFormat(
        "tum",
        _is_tum,
        trajectories.read_tum,
        "world",
        "body",
        "stamps in seconds, quaternions with w last",
    ),
    PoseFormat(
        "tum-csv",
        _is_tum_with_commas,
        trajectories.read_tum,
        "world",
        "body",
        "stamps in seconds, quaternions with w last",
    ),
    PoseFormat(
        "csv",
        _is_csv,
        trajectories.read_csv,
        "world",
        "body",
        "stamps in nanoseconds, quaternions with w last",
    ),
    PoseFormat(
        "npz",
        lambda head: head.data.startswith(b"PK\x03\x04") and b".npy" in head.data[30:80],
        trajectories.read_npz,
        "world",
        "body",
        "stamps in nanoseconds, quaternions with w last",
    ),
    PoseFormat(
        "parquet",
        lambda head: head.data.startswith(b"PAR1"),
        trajectories.read_parquet,
        "world",
        "body",
        "stamps in nanoseconds, quaternions with w last",
    ),
    PoseFormat(
        "kitti",
        lambda head: len(head.numbers) == 12 and not head.has_commas,
        trajectories.read_kitti,
        "world",
        "body",
        "matrices that map the body's points into the world",
    ),
    PoseFormat(
        "euroc",
        _is_euroc,
        trajectories.read_euroc,
        "world",
        "body",
        "stamps in nanoseconds, quaternions with w first",
    ),
    PoseFormat(
        "euroc-sensor",
        lambda head: head.has_line("T_BS:"),
        cameras.read_euroc_sensor,
        "body",
        "sensor",
        "T_BS maps the sensor's points into the body",
    ),
    PoseFormat(
        "colmap",
        _is_colmap,
        cameras.read_colmap,
        "world",
        "camera",
        "world to camera, quaternions with w first, OpenCV axes",
        inverse=True,
        axes="opencv",
    ),
    PoseFormat(
        "nerfstudio",
        lambda head: head.text.lstrip().startswith("{") and bool(_JSON.search(head.text)),
        cameras.read_nerfstudio,
        "world",
        "camera",
        "camera to world, OpenGL axes",
        axes="opengl",
    ),
    PoseFormat(
        "kalibr",
        lambda head: head.has_line("cam[0-9]+:"),
        cameras.read_kalibr,
        "imu",
        "cam0",
        "T_cam_imu and T_cn_cnm1 map into the camera, OpenCV axes",
        inverse=True,
        axes="opencv",
    ),
    PoseFormat(
        "kitti-calib",
        lambda head: head.has_line(r"(?:P[0-9]|Tr[a-z_]*|R0_rect|R): *[-+.0-9]"),
        cameras.read_kitti_calibration,
        "cam0",
        "velodyne",
        "matrices that map the child's points into the parent, OpenCV axes",
        axes="opencv",
    ),
)
"""All supported formats of pose files."""


def format_named(name: str) -> PoseFormat:
    """Return the format of pose files with the given name.

    Raises:
        UsageError: If there is no such format.
    """
    for one in FORMATS:
        if one.name == name:
            return one
    names = ", ".join(one.name for one in FORMATS)
    raise UsageError(f"--pose-format must be one of {names}, not '{name}'.")


def recognised(data: bytes, name: str) -> PoseFormat | None:
    """Return the format of a file with these first bytes; None if the file is not a pose file.

    Raises:
        InputError: If the text fits several formats.
    """
    head = Head(data)
    found = [one for one in FORMATS if one.fits(head)]
    if len(found) > 1:
        names = " and ".join(f"{one.name} ({one.convention})" for one in found)
        raise InputError(f"'{name}' fits {names}: choose with --pose-format NAME.")
    return found[0] if found else None


def convention_of(word: str, path: Path) -> str:
    """Return a sentence that describes the convention of a file's poses."""
    form, options = format_of_file(word, path)
    said = form.convention
    if options.inverted:
        said += ", inverted"
    if options.axes is not None:
        said += f", --axes {options.axes}"
    frames = ":".join(options.pair()) if options.frames else f"{form.parent}:{form.child}"
    return (
        f"Reading '{path.name}' as {form.name} ({said}); "
        f"the frames are {frames} unless the file names frames."
    )


def format_of_file(word: str, path: Path) -> tuple[PoseFormat, PoseOptions]:
    """Return the format of a pose file, and the options given for the file.

    Raises:
        InputError: If the file is not a pose file.
        UsageError: If --pose-format does not name a format.
    """
    options = options_of(word)
    prefix, _ = path_behind_prefix(word)
    if prefix:
        options = replace(options, prefix=prefix)
    if options.pose_format is not None:
        return format_named(options.pose_format), options
    with path.open("rb") as file:
        form = recognised(file.read(HEAD), str(path))
    if form is None:
        raise InputError(f"'{path}' has changed and is not a pose file any more.")
    return form, options
