"""Command `tftool diff`: differences between two sets of frames."""

from pathlib import Path
from typing import Literal

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    Force,
    Json,
    Pairs,
    RunFor,
    argument,
    flag,
    not_negative,
    option,
    output_file,
)

TRAJECTORIES = "Trajectories"
"""Heading in the help above the options of --ape and --rpe."""


class DiffOptions(Command, descriptions=True, urdf=True):
    """Say what differs between two sets of frames, link by link.

    A link is the transform from a frame to its parent. The report lists added and missing links,
    frames with another parent, and links that are static only in A or only in B. Differences are in
    millimetres and degrees. Moving links are compared at their common stamps: root mean square,
    maximum, and time of the maximum. The exit status is 1 if anything differs by more than the
    tolerance (1 mm, 0.1°, or --mm, --deg, --rate-percent), or if a moving link could not be
    compared.

    With --ape or --rpe, two trajectories are compared instead; A is the reference. A source with a
    single trajectory needs no option. Otherwise --pair TARGET:SOURCE names the frames; give --pair
    twice if A and B use different names.

    tftool diff monday.mcap robot.urdf
    tftool diff calibrated.launch.py session --mm 0.5
    tftool diff run1.mcap run2.mcap --align start --json
    tftool diff truth.tum estimate.tum --ape --rpe --fit se3
    tftool diff vicon.csv camera.csv --clock-offset
    """

    first: str = argument(
        "A recording, a robot description, a scenario, a launch file or script of static "
        "transforms, or the word 'session' for the running session.",
        default=...,
        metavar="A",
    )
    second: str = argument(
        "Frames to compare with A, of the same kinds as A.", default=..., metavar="B"
    )
    millimetres: float = option(
        "Accept differences in position up to this many millimetres.",
        "--mm",
        default=1.0,
        metavar="MM",
        callback=not_negative,
    )
    degrees: float = option(
        "Accept differences in rotation up to this many degrees.",
        "--deg",
        default=0.1,
        metavar="DEGREES",
        callback=not_negative,
    )
    rate_percent: float | None = option(
        "Accept rates that differ up to this many percent; if not given, rates are not compared.",
        metavar="PERCENT",
        callback=not_negative,
    )
    align: Literal["start"] | None = option(
        "Compare moving links by the time since the start of A and of B, not by their stamps.",
        metavar="start",
    )
    everything: bool = flag("Also list the links that do not differ.", "--all", panel=OUTPUT)
    ape: bool = flag("Measure the absolute pose error of trajectory B.", panel=TRAJECTORIES)
    rpe: bool = flag("Measure the relative pose error of trajectory B.", panel=TRAJECTORIES)
    pairs: Pairs = None
    clock_offset: bool = flag(
        "Measure the offset between the clocks of two motions of one body, t_A = t_B + offset.",
        panel=TRAJECTORIES,
    )
    fit: Literal["none", "first", "se3", "sim3"] = option(
        "Align B with A: by its first pose, rigidly (se3), or with a scale (sim3).",
        default="none",
        panel=TRAJECTORIES,
    )
    match: Literal["nearest", "interpolate"] = option(
        "Compare each pose of B with the nearest pose of A within 10 ms, or with A interpolated at "
        "the stamp of B.",
        default="nearest",
        panel=TRAJECTORIES,
    )
    per: str = option(
        "Length over which --rpe is taken: frames (1), metres (10m) or degrees (5deg).",
        default="1",
        metavar="LENGTH",
        panel=TRAJECTORIES,
    )
    lasting: RunFor = None
    for_programs: Json = False
    markdown: bool = flag(
        "Print the differences as Markdown, for an issue on the web.", panel=OUTPUT
    )
    output: Path | None = output_file("Draw the errors of --ape and --rpe: .svg, .pdf or .png.")
    force: Force = False
