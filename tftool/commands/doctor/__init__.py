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
    """Least severity of a finding with which the exit status is 1."""

    error = "error"
    warning = "warning"
    note = "note"
    never = "never"


class DoctorOptions(Command, looks_only=True, urdf=True):
    """Say what is wrong with the frames, and what mends it: cause, evidence, consequence, fix.

    A recording is read completely, a scenario is played on simulated time, a running session is
    heard for 5 s, or --for. The exit status is 0 without findings from a warning on (--fail-on),
    else 1, and 3 if a source cannot be read.

    tftool doctor run.mcap
    tftool doctor bags/*.mcap --junit report.xml
    tftool doctor 'runs/**/*.mcap' -j 8 -o findings.parquet --resume
    tftool doctor run.mcap --steps --pair map:base_link
    tftool doctor run.mcap --baseline accepted.json
    tftool doctor --explain split-tree
    """

    places: list[str] | None = argument(
        "Whose frames: recordings (file, folder, glob) and scenarios; if not said, the "
        "session that runs, else the turtles.",
        metavar="[FROM]...",
    )
    select: list[str] | None = option("Run only these checks or areas.", metavar="ID,...")
    ignore: list[str] | None = option("Leave these checks or areas out.", metavar="ID,...")
    fail_on: FailOn = option("From what on the exit status is 1.", default=FailOn.warning)
    baseline: Path | None = option(
        "Fail by what this report of --json lacks alone.", metavar="OLD.json"
    )
    limits: list[str] | None = option(
        "Another threshold: gap.seconds=2.", "--limit", metavar="ID.NAME=VALUE"
    )
    cache_time: CacheTime = None
    fixed_frame: str = option(
        "Where sensors are to be placed; odom, else map.", default="", metavar="FRAME"
    )
    tf_topic: list[str] | None = option(
        "Look at these transforms alone: /robot1/tf.", metavar="TOPIC"
    )
    begin: At | None = option(
        "Look at a recording from there on.", "--from", metavar="MOMENT", parser=moment
    )
    end: At | None = option("Look at it up to there.", "--to", metavar="MOMENT", parser=moment)
    lasting: RunFor = None
    mounts: bool = flag("Hold mounts against recorded motion, too: seconds more.")
    statistics: bool = flag("Print rate, latency and gaps of everything, too.")
    steps: bool = flag("Print where a localiser or odometry steps: when, how far, the drift.")
    pair: str = option(
        "Steps of the edges between two frames; else of map to odom.",
        default="",
        metavar="TARGET:SOURCE",
    )
    verbose: bool = flag("Print all evidence, and skipped checks.", "--verbose", "-v")
    for_programs: Json = False
    markdown: bool = flag("Print it for an issue on the web.")
    junit: Junit = None
    sarif: Path | None = option("Write SARIF for a code host.", "--sarif", metavar="FILE")
    output: Rows = None
    processes: Jobs = 1
    resume: Resume = False
    scheduler: Scheduler = ""
    explain: str = option(
        "Tell all about one check, and stop.", "--explain", default="", metavar="ID"
    )
    listed: bool = flag("List all checks, and stop.", "--list")
