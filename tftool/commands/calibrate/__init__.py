"""Command `tftool calibrate`: a sensor's mount and clock offset, from recorded motion."""

from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import OUTPUT, Force, Json, argument, flag, option, output_file

MOUNT = "Mount"
"""Heading in the help above the options about the mount."""


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

    places: list[str] = argument(
        "A recording or pose file with both motions, or one for each.",
        default=...,
        metavar="FROM [FROM]",
    )
    moving: list[str] | None = option(
        "A motion: frames of tf, or a topic of Odometry or PoseStamped. Twice; not for a pose "
        "file.",
        metavar="FIXED:MOVING|TOPIC",
    )
    planar: bool = flag("Ask for x, y and yaw alone; keep the rest of the mount.")
    time_only: bool = flag("Measure the clock offset alone.")
    scale: bool = flag("Estimate a scale of the first motion's translations.")
    check: bool = flag("Compare the published mount; 1 where it is outside the interval.")
    urdf: Path | None = option(
        "Description that has the mount.", "--urdf", metavar="FILE", panel=MOUNT
    )
    mounted: str | None = option(
        "Name of the second moving frame in tf or the description.", metavar="NAME", panel=MOUNT
    )
    joint: str | None = option(
        "Joint whose origin is changed; the first fixed one on the way if not said.",
        metavar="NAME",
        panel=MOUNT,
    )
    seed: int = option("Seed of the numbers drawn for intervals.", default=0, metavar="N", min=0)
    no_cache: bool = flag("Read recordings anew, and keep no columns.")
    output: Path | None = output_file(
        "Write the mount: .urdf, .launch.py, .launch.yaml, .launch.xml or .sh."
    )
    report: Path | None = option("Write a page with curves: .html.", metavar="FILE", panel=OUTPUT)
    force: Force = False
    for_programs: Json = False
