"""What can be written, and what the name of a file asks for."""

from enum import StrEnum
from pathlib import Path
from typing import Final

from tftool.base.errors import UsageError


class Format(StrEnum):
    """What can be written."""

    tum = "tum"
    kitti = "kitti"
    euroc = "euroc"
    csv = "csv"
    npz = "npz"
    parquet = "parquet"
    urdf = "urdf"
    launch_py = "launch-py"
    launch_xml = "launch-xml"
    launch_yaml = "launch-yaml"
    sh = "sh"
    mcap = "mcap"

    @property
    def is_trajectory(self) -> bool:
        """Whether it holds pairs of frames over time, not the links themselves."""
        return self in _TRAJECTORIES


_TRAJECTORIES: Final = frozenset(
    {Format.tum, Format.kitti, Format.euroc, Format.csv, Format.npz, Format.parquet}
)
TABLES: Final = frozenset({Format.csv, Format.npz, Format.parquet})
SUFFIXES: Final = {
    ".tum": Format.tum,
    ".kitti": Format.kitti,
    ".csv": Format.csv,
    ".npz": Format.npz,
    ".parquet": Format.parquet,
    ".urdf": Format.urdf,
    ".launch.py": Format.launch_py,
    ".launch.xml": Format.launch_xml,
    ".launch.yaml": Format.launch_yaml,
    ".launch.yml": Format.launch_yaml,
    ".sh": Format.sh,
    ".mcap": Format.mcap,
}
"""What the end of a name asks for. EuRoC's files end in .csv, and are asked for by format."""


def format_of(path: Path) -> Format:
    """What the name of a file asks for.

    Raises:
        UsageError: If it says nothing.
    """
    name = path.name.lower()
    for suffix, form in SUFFIXES.items():
        if name.endswith(suffix):
            return form
    raise UsageError(
        f"'{path}' does not say what to write: end it in {', '.join(SUFFIXES)}, or name the format."
    )
