"""Table of export formats with their suffixes, and the options of an export.

A new format needs a line in `Format`, and a function in the table of writers in `trajectory_files`
(pairs over time) or `static_files` (links).
"""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Final, Literal

from tftool.base.errors import UsageError
from tftool.base.stamps import LATEST, Stamp

DECIMALS: Final = 9
"""Default number of decimals in texts: nanometres."""


@dataclass(frozen=True, slots=True)
class Style:
    """Options of an export; options that do not apply to a format are ignored.

    Attributes:
        decimals: Number of decimals in text files; 17 for the shortest exact text.
        rpy: Whether roll, pitch and yaw are added to CSV and Parquet.
        foxglove: Whether MCAP contains foxglove.FrameTransforms instead of tf2_msgs/TFMessage.
        with_moving: Whether moving links are written to a URDF, as floating joints.
        root: Frame below which links are written; None for all links.
        time: Time of the lookup of moving links, nanoseconds; 0 for the latest.
    """

    decimals: int = DECIMALS
    rpy: bool = False
    foxglove: bool = False
    with_moving: bool = False
    root: str | None = None
    time: Stamp = LATEST


class Format(StrEnum):
    """File format of an export; the value is the name of the format.

    Attributes:
        holds: Contents: "pair" or "pairs" of frames over time, or "links".
        suffixes: Endings of file names that select the format.
    """

    holds: Literal["pair", "pairs", "links"]
    suffixes: tuple[str, ...]

    def __new__(
        cls, name: str, holds: Literal["pair", "pairs", "links"], *suffixes: str
    ) -> "Format":
        """Create a member from its name, contents and suffixes."""
        member = str.__new__(cls, name)
        member._value_ = name
        member.holds, member.suffixes = holds, suffixes
        return member

    tum = "tum", "pair", ".tum"
    kitti = "kitti", "pair", ".kitti"
    # Selected by name only, because its files also end in .csv.
    euroc = "euroc", "pair"
    csv = "csv", "pairs", ".csv"
    npz = "npz", "pairs", ".npz"
    parquet = "parquet", "pairs", ".parquet"
    urdf = "urdf", "links", ".urdf"
    launch_py = "launch-py", "links", ".launch.py"
    launch_xml = "launch-xml", "links", ".launch.xml"
    launch_yaml = "launch-yaml", "links", ".launch.yaml", ".launch.yml"
    sh = "sh", "links", ".sh"
    mcap = "mcap", "links", ".mcap"

    @property
    def is_trajectory(self) -> bool:
        """Whether files of this format contain pairs over time, and not links."""
        return self.holds != "links"


SUFFIXES: Final = {suffix: form for form in Format for suffix in form.suffixes}
"""Format by the ending of a file name."""


def suffixes_of(*, trajectories: bool) -> str:
    """Return the first suffix of each trajectory format, or of each format for links, as a text."""
    forms = [form for form in Format if form.suffixes and form.is_trajectory == trajectories]
    return " ".join(form.suffixes[0] for form in forms)


def format_of(path: Path) -> Format:
    """Return the format that a file name's ending selects.

    Raises:
        UsageError: If the suffix is unknown.
    """
    name = path.name.lower()
    for suffix, form in SUFFIXES.items():
        if name.endswith(suffix):
            return form
    raise UsageError(
        f"'{path}' has no known suffix: end it in {', '.join(SUFFIXES)}, or name the format."
    )
