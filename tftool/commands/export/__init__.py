"""`tftool export`: write frames to files of other tools."""

from pathlib import Path
from typing import Annotated

import typer

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
    decimals,
    option,
    output_file,
)
from tftool.frames.export.export_formats import Format, suffixes_of


class ExportOptions(Command, looks_only=True, recordings=True, descriptions=True, urdf=True):
    """Write a pair over time, or links, to files of other tools.

    The pose of SOURCE in TARGET is written at the stamps of the fastest link between the two;
    refused lookups are left out and counted. A scenario is played to its end. With FROM alone,
    static transforms are written in a form that can be published again, and to .mcap all
    transforms.

    tftool export map base_link run.mcap -o run.tum
    tftool export map base_link run.mcap -o run.csv --rate 10 --rpy
    tftool export run.mcap --pair map:base_link --pair map:laser -o run.npz
    tftool export run.mcap -o statics.launch.py
    tftool export robot -o frames.mcap --foxglove
    """

    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[TARGET SOURCE] [FROM]",
            help="A pair of frames and whose they are; one word alone is FROM, and its links are "
            "written.",
            show_default=False,
        ),
    ] = None
    output: Annotated[
        Path | None,
        output_file(
            f"Where to write it. Of pairs {suffixes_of(trajectories=True)}; of links "
            f"{suffixes_of(trajectories=False)}."
        ),
    ] = None
    form: Annotated[
        Format | None,
        option(
            f"What to write: {', '.join(Format)}; if not said, what -o ends in. EuRoC is written "
            "where it is said.",
            "--format",
            "-f",
            metavar="FORMAT",
            panel=OUTPUT,
        ),
    ] = None
    pairs: Pairs = None
    first: FromOption = None
    last: ToOption = None
    every: Every = None
    rate: Rate = None
    stamps_of: StampsOf = None
    at: AtOption = None
    lasting: RunFor = None
    rpy: Annotated[
        bool, option("Add roll, pitch and yaw to CSV and Parquet.", "--rpy", panel=OUTPUT)
    ] = False
    precision: Annotated[
        int, decimals("Decimals; 17 writes each number as short as it can be read back.")
    ] = 9
    root: Annotated[
        str | None, option("Of links, take those below this frame.", metavar="FRAME")
    ] = None
    with_moving: Annotated[
        bool,
        option(
            "Put links that move into a URDF, as floating joints (robot_state_publisher "
            "skips them); where they are at --at, else at last.",
            "--with-moving",
        ),
    ] = False
    foxglove: Annotated[
        bool,
        option(
            "Write .mcap as foxglove.FrameTransforms, not as tf2_msgs.", "--foxglove", panel=OUTPUT
        ),
    ] = False
    force: Force = False
    as_json: Json = False
