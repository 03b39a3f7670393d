"""`tftool calibrate`: the mount of a sensor and its clock offset, from recorded motion."""

from pathlib import Path
from typing import Annotated

import typer

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import OUTPUT, Force, Json, option, output_file

MOUNT = "Mount"
"""Heading of the help."""


class CalibrateOptions(Command, shares=False, poses=True):
    """Find a sensor's mount and clock offset from motion.

    Two motions of one rigid body are recorded, in separate frames and on separate clocks: odometry
    and a camera's SLAM, an arm and a tag on it. Their comparison gives the mount of one moving
    frame on the other, the pose of one fixed frame in the other, and the clock offset, each with a
    95 % interval; or a refusal, with the motion to record next. The exit status is 0 if the mount
    is solved or partly solved, and 1 if it is refused.

    tftool calibrate run.mcap --moving odom:base_link --moving world:camera
    tftool calibrate arm.bag --moving base:tool0 --moving camera:tag
    tftool calibrate vicon.csv camera.csv --report report.html
    tftool calibrate run.mcap est.tum --moving odom:base --urdf a.urdf -o b.urdf
    """

    places: Annotated[
        list[str],
        typer.Argument(
            metavar="FROM [FROM]",
            help="A recording or pose file with both motions, or one for each.",
        ),
    ]
    moving: Annotated[
        list[str] | None,
        option(
            "A motion: frames of tf, or a topic of Odometry or PoseStamped. Twice; not for a pose "
            "file.",
            metavar="FIXED:MOVING|TOPIC",
        ),
    ] = None
    planar: Annotated[
        bool, option("Ask for x, y and yaw alone; keep the rest of the mount.", "--planar")
    ] = False
    time_only: Annotated[bool, option("Measure the clock offset alone.", "--time-only")] = False
    scale: Annotated[
        bool, option("Estimate a scale of the first motion's translations.", "--scale")
    ] = False
    check: Annotated[
        bool,
        option("Compare the published mount; 1 where it is outside the interval.", "--check"),
    ] = False
    urdf: Annotated[
        Path | None,
        option("Description that has the mount.", "--urdf", metavar="FILE", panel=MOUNT),
    ] = None
    mounted: Annotated[
        str | None,
        option(
            "Name of the second moving frame in tf or the description.",
            metavar="NAME",
            panel=MOUNT,
        ),
    ] = None
    joint: Annotated[
        str | None,
        option(
            "Joint whose origin is changed; the first fixed one on the way if not said.",
            metavar="NAME",
            panel=MOUNT,
        ),
    ] = None
    seed: Annotated[
        int, typer.Option(metavar="N", min=0, help="Seed of the numbers drawn for intervals.")
    ] = 0
    no_cache: Annotated[
        bool, option("Read recordings anew, and keep no columns.", "--no-cache")
    ] = False
    output: Annotated[
        Path | None,
        output_file("Write the mount: .urdf, .launch.py, .launch.yaml, .launch.xml or .sh."),
    ] = None
    report: Annotated[
        Path | None,
        option("Write a page with curves: .html.", metavar="FILE", panel=OUTPUT),
    ] = None
    force: Force = False
    for_programs: Json = False
