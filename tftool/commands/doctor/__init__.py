"""`tftool doctor`: what is wrong with the frames, why, and what to do about it."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

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
    moment,
    option,
)
from tftool.frames.moment import At


class FailOn(StrEnum):
    """Severity from which the exit status is 1."""

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

    places: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[FROM]...",
            help="Whose frames: recordings (file, folder, glob) and scenarios; if not said, the "
            "session that runs, else the turtles.",
            show_default=False,
        ),
    ] = None
    select: Annotated[
        list[str] | None, option("Run only these checks or areas.", metavar="ID,...")
    ] = None
    ignore: Annotated[
        list[str] | None, option("Leave these checks or areas out.", metavar="ID,...")
    ] = None
    fail_on: Annotated[FailOn, option("From what on the exit status is 1.")] = FailOn.warning
    baseline: Annotated[
        Path | None,
        option("Fail by what this report of --json lacks alone.", metavar="OLD.json"),
    ] = None
    limits: Annotated[
        list[str] | None,
        option("Another threshold: gap.seconds=2.", "--limit", metavar="ID.NAME=VALUE"),
    ] = None
    cache_time: CacheTime = None
    fixed_frame: Annotated[
        str, option("Where sensors are to be placed; odom, else map.", metavar="FRAME")
    ] = ""
    tf_topic: Annotated[
        list[str] | None, option("Look at these transforms alone: /robot1/tf.", metavar="TOPIC")
    ] = None
    begin: Annotated[
        At | None,
        typer.Option(
            "--from", metavar="MOMENT", parser=moment, help="Look at a recording from there on."
        ),
    ] = None
    end: Annotated[
        At | None,
        typer.Option("--to", metavar="MOMENT", parser=moment, help="Look at it up to there."),
    ] = None
    lasting: RunFor = None
    mounts: Annotated[
        bool, option("Hold mounts against recorded motion, too: seconds more.", "--mounts")
    ] = False
    statistics: Annotated[
        bool, option("Print rate, latency and gaps of everything, too.", "--statistics")
    ] = False
    steps: Annotated[
        bool,
        option("Print where a localiser or odometry steps: when, how far, the drift.", "--steps"),
    ] = False
    pair: Annotated[
        str,
        option(
            "Steps of the edges between two frames; else of map to odom.", metavar="TARGET:SOURCE"
        ),
    ] = ""
    verbose: Annotated[
        bool, option("Print all evidence, and skipped checks.", "--verbose", "-v")
    ] = False
    for_programs: Json = False
    markdown: Annotated[bool, option("Print it for an issue on the web.", "--markdown")] = False
    junit: Junit = None
    sarif: Annotated[
        Path | None, option("Write SARIF for a code host.", "--sarif", metavar="FILE")
    ] = None
    output: Rows = None
    processes: Jobs = 1
    resume: Resume = False
    scheduler: Scheduler = ""
    explain: Annotated[
        str, option("Tell all about one check, and stop.", "--explain", metavar="ID")
    ] = ""
    listed: Annotated[bool, option("List all checks, and stop.", "--list")] = False
