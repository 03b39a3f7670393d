"""Command `tftool calibrate`: a sensor's mounting pose and clock offset, from recorded motion."""

from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import OUTPUT, Force, Json, argument, flag, option, output_file

MOUNT = "Mount"
"""Heading in the help above the options about the mount."""


class CalibrateOptions(Command, shares=False, poses=True):
    """Find a sensor's mounting pose and clock offset from motion.

    The input is two recorded motions of one rigid body, in separate frames and on separate clocks.
    Examples are odometry and a camera's SLAM, or an arm and a tag on the arm. The result is the
    pose of one moving frame in the other (the mount), the pose of one fixed frame in the other, and
    the clock offset, each with a 95 % interval. If the motions do not determine the mount, a
    sentence says which motion to record next. The exit status is 0 if the mount is solved
    completely or partly, and 1 otherwise.

    tftool calibrate run.mcap --moving odom:base_link --moving world:camera
    tftool calibrate arm.bag --moving base:tool0 --moving camera:tag
    tftool calibrate vicon.csv camera.csv --report report.html
    tftool calibrate run.mcap est.tum --moving odom:base --urdf a.urdf -o b.urdf
    """

    places: list[str] = argument(
        "One recording or pose file with both motions, or one file for each motion.",
        default=...,
        metavar="FROM [FROM]",
    )
    moving: list[str] | None = option(
        "Frames of a motion in tf, or a topic of Odometry or PoseStamped. Give the option once "
        "for each of the two motions; a pose file needs no --moving.",
        metavar="FIXED:MOVING|TOPIC",
    )
    planar: bool = flag(
        "Estimate only x, y and yaw; take height, roll and pitch from the published mount."
    )
    time_only: bool = flag("Measure only the clock offset, without the mount.")
    scale: bool = flag("Also estimate a factor for the translations of the first motion.")
    check: bool = flag(
        "Compare the published mount with the result; the exit status is 1 if the published mount "
        "is outside of the interval."
    )
    urdf: Path | None = option(
        "Robot description that contains the mount.", "--urdf", metavar="FILE", panel=MOUNT
    )
    mounted: str | None = option(
        "Name of the second moving frame in tf or in the description, if the motion has another "
        "name for this frame.",
        metavar="NAME",
        panel=MOUNT,
    )
    joint: str | None = option(
        "Joint whose origin is changed; if not given, the first fixed joint between the two "
        "frames.",
        metavar="NAME",
        panel=MOUNT,
    )
    seed: int = option("Seed of the random numbers for intervals.", default=0, metavar="N", min=0)
    no_cache: bool = flag("Read the recordings again, without the cache, and write no cache.")
    output: Path | None = output_file(
        "Write the mount: .urdf, .launch.py, .launch.yaml, .launch.xml or .sh."
    )
    report: Path | None = option(
        "Write an .html page with curves of the motions and the errors.",
        metavar="FILE",
        panel=OUTPUT,
    )
    force: Force = False
    for_programs: Json = False
