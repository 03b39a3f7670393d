"""Command `tftool export`: write frames to files of other tools."""

from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    AtOption,
    Every,
    Force,
    FromOption,
    Json,
    Pairs,
    Rate,
    RunFor,
    StampsOf,
    ToOption,
    argument,
    decimals,
    flag,
    option,
    output_file,
)
from tftool.frames.export.export_formats import Format, suffixes_of


class ExportOptions(Command, looks_only=True, recordings=True, descriptions=True, urdf=True):
    """Write trajectories or transforms to files of other tools.

    The pose of SOURCE in TARGET is written at the stamps of the fastest link (a frame and its
    parent) between the two frames. Failed lookups are left out and counted. A scenario is played to
    its end. If only FROM is given, its static transforms are written in a form that can be
    published again; an .mcap file gets all transforms.

    tftool export map base_link run.mcap -o run.tum
    tftool export map base_link run.mcap -o run.csv --rate 10 --rpy
    tftool export run.mcap --pair map:base_link --pair map:laser -o run.npz
    tftool export run.mcap -o statics.launch.py
    tftool export robot -o frames.mcap --foxglove
    """

    words: list[str] | None = argument(
        "A pair of frames, and the source of the frames. If only FROM is given, its static "
        "transforms are written.",
        metavar="[TARGET SOURCE] [FROM]",
    )
    output: Path | None = output_file(
        f"File to write. For pairs of frames: {suffixes_of(trajectories=True)}; for links: "
        f"{suffixes_of(trajectories=False)}."
    )
    form: Format | None = option(
        f"Format to write: {', '.join(Format)}; if not given, the suffix of -o decides. EuRoC "
        "needs this option.",
        "--format",
        "-f",
        metavar="FORMAT",
        panel=OUTPUT,
    )
    pairs: Pairs = None
    first: FromOption = None
    last: ToOption = None
    every: Every = None
    rate: Rate = None
    stamps_of: StampsOf = None
    at: AtOption = None
    lasting: RunFor = None
    rpy: bool = flag("Add roll, pitch and yaw to CSV and Parquet.", panel=OUTPUT)
    precision: int = decimals(
        "Number of decimals; 17 writes each number with the fewest digits that restore it exactly.",
        default=9,
    )
    root: str | None = option(
        "Write only the frames below this frame; without --with-moving, only those that static "
        "transforms connect with this frame.",
        metavar="FRAME",
    )
    with_moving: bool = flag(
        "Also write frames that move into a URDF, as floating joints, which robot_state_publisher "
        "skips. Their poses are those at --at, or the latest poses."
    )
    foxglove: bool = flag("Write .mcap as foxglove.FrameTransforms, not as tf2_msgs.", panel=OUTPUT)
    force: Force = False
    as_json: Json = False
