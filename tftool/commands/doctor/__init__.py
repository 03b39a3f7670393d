"""Command `tftool doctor`: what is wrong with the frames, why, and how to fix it."""

from enum import StrEnum
from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    CacheTime,
    Jobs,
    Json,
    Junit,
    Resume,
    Rows,
    RunFor,
    Scheduler,
    argument,
    flag,
    moment,
    option,
)
from tftool.frames.source_options import At


class FailOn(StrEnum):
    """Lowest severity of a finding at which the exit status is 1."""

    error = "error"
    warning = "warning"
    note = "note"
    never = "never"


class DoctorOptions(Command, looks_only=True, urdf=True):
    """Say what is wrong with the frames, and how to fix it: cause, evidence, consequence, fix.

    A recording is read completely, a scenario is played on simulated time, and a running session is
    listened to for 5 s, or for the time of --for. The exit status is 1 if a finding is a warning or
    an error (see --fail-on), 3 if a source cannot be read, else 0.

    tftool doctor run.mcap
    tftool doctor bags/*.mcap --junit report.xml
    tftool doctor 'runs/**/*.mcap' -j 8 -o findings.parquet --resume
    tftool doctor run.mcap --steps --pair map:base_link
    tftool doctor run.mcap --baseline accepted.json
    tftool doctor --explain split-tree
    """

    places: list[str] | None = argument(
        "Frames to check: recordings (file, folder, glob) and scenarios; if not given, the "
        "running session, else the scenario turtles.",
        metavar="[FROM]...",
    )
    select: list[str] | None = option(
        "Run only these checks, or areas (groups of checks).", metavar="ID,..."
    )
    ignore: list[str] | None = option("Do not run these checks or areas.", metavar="ID,...")
    fail_on: FailOn = option(
        "Lowest severity of a finding at which the exit status is 1.", default=FailOn.warning
    )
    baseline: Path | None = option(
        "Fail only for new findings, which are not in this earlier report (made with --json).",
        metavar="OLD.json",
    )
    limits: list[str] | None = option(
        "Set a threshold of a check, as in gap.seconds=2; --explain ID prints the names.",
        "--limit",
        metavar="ID.NAME=VALUE",
    )
    cache_time: CacheTime = None
    fixed_frame: str = option(
        "Frame into which sensor messages must be transformable; if not given, odom, else map.",
        default="",
        metavar="FRAME",
    )
    tf_topic: list[str] | None = option(
        "Check only the transforms of this topic, such as /robot1/tf.", metavar="TOPIC"
    )
    begin: At | None = option(
        "Ignore the messages of a recording before this time.",
        "--from",
        metavar="MOMENT",
        parser=moment,
    )
    end: At | None = option(
        "Ignore the messages of a recording after this time.",
        "--to",
        metavar="MOMENT",
        parser=moment,
    )
    lasting: RunFor = None
    mounts: bool = flag(
        "Also compare the published poses of sensors on the robot with the recorded motion, which "
        "takes some seconds."
    )
    statistics: bool = flag("Also print the rate, latency and gaps of every frame.")
    steps: bool = flag(
        "Print a table of the jumps of a localiser or of odometry: when, how far, and the drift."
    )
    pair: str = option(
        "With --steps: check the transforms between these two frames; if not given, map to odom.",
        default="",
        metavar="TARGET:SOURCE",
    )
    verbose: bool = flag("Print all evidence, and the checks that were skipped.", "--verbose", "-v")
    for_programs: Json = False
    markdown: bool = flag("Print the report as Markdown, for an issue on the web.")
    junit: Junit = None
    sarif: Path | None = option(
        "Write the findings as SARIF, which code hosts display.", "--sarif", metavar="FILE"
    )
    output: Rows = None
    processes: Jobs = 1
    resume: Resume = False
    scheduler: Scheduler = ""
    explain: str = option(
        "Print the description of one check, and stop.", "--explain", default="", metavar="ID"
    )
    listed: bool = flag("List all checks, and stop.", "--list")
