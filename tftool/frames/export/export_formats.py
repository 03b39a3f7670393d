"""Export formats by file name, and the options of an export.

To add a format: its line in `Format`, and its function in the table of writers in
`trajectory_files` (pairs over time) or `static_files` (links).
"""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Final, Literal

from tftool.base.errors import UsageError
from tftool.base.stamps import LATEST, Stamp

DECIMALS: Final = 9
"""Of numbers in texts, unless said otherwise: nanometres."""


@dataclass(frozen=True, slots=True)
class Style:
    """Options of an export; each format uses those that apply.

    Attributes:
        decimals: Decimals of numbers in texts; 17 writes the shortest text that reads back equal.
        rpy: Whether CSV and Parquet get roll, pitch and yaw, too.
        foxglove: Whether MCAP gets foxglove.FrameTransforms in the place of tf2_msgs.
        with_moving: Whether URDF gets links that move, too, as floating joints.
        root: The frame a URDF or the like begins with; None for all there is.
        time: Time of the lookup of moving links, nanoseconds; 0 for the latest.
    """

    decimals: int = DECIMALS
    rpy: bool = False
    foxglove: bool = False
    with_moving: bool = False
    root: str | None = None
    time: Stamp = LATEST


class Format(StrEnum):
    """Format of an export.

    Attributes:
        holds: One pair of frames over time, several pairs, or the links themselves.
        suffixes: Ends of names that ask for it.
    """

    holds: Literal["pair", "pairs", "links"]
    suffixes: tuple[str, ...]

    def __new__(
        cls, name: str, holds: Literal["pair", "pairs", "links"], *suffixes: str
    ) -> "Format":
        """Make a member from its table row."""
        member = str.__new__(cls, name)
        member._value_ = name
        member.holds, member.suffixes = holds, suffixes
        return member

    tum = "tum", "pair", ".tum"
    kitti = "kitti", "pair", ".kitti"
    # Its files end in .csv, and are asked for by name.
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
        """Whether the format stores pairs over time, and not links."""
        return self.holds != "links"


SUFFIXES: Final = {suffix: form for form in Format for suffix in form.suffixes}
"""What the end of a name asks for."""


def suffixes_of(*, trajectories: bool) -> str:
    """List the file name endings for pairs over time, or for links, in a sentence."""
    forms = [form for form in Format if form.suffixes and form.is_trajectory == trajectories]
    return " ".join(form.suffixes[0] for form in forms)


def format_of(path: Path) -> Format:
    """Return the format for a file name.

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
