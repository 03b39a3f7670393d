"""`tftool info`: what a recording or a robot description holds."""

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.options import Jobs, Json, Resume, Rows, Scheduler
from tftool.frames.source_options import RobotOptions

if TYPE_CHECKING:
    from tftool.recordings.find import Found
    from tftool.recordings.recording import Recording


def info(
    connection: Connection,
    places: Annotated[
        list[str],
        typer.Argument(
            metavar="FROM...", help="A recording (file, folder, glob) or a robot description."
        ),
    ],
    for_programs: Json = False,
    output: Rows = None,
    processes: Jobs = 1,
    resume: Resume = False,
    scheduler: Scheduler = "",
) -> ExitStatus:
    """Show what a recording or robot description holds (ros2 bag info).

    Topics with their types, counts and publishers; frames and trees; every edge with its
    rate, who publishes it (by node in ROS 1 bags, by topic else), and its delay: how much
    later than its stamp it was received; what is damaged, what is odd, and what the doctor
    finds. On a terminal columns that have no room are left out.
    Of a robot description: joints with limits and mimics, the root, masses where given.
    Of several recordings, a line each; with -o, a row each in a file. Where the terminal is
    narrow, columns are left out: 'tftool info run.mcap | cat' has them all.

    tftool info run.mcap
    tftool info robot.urdf
    tftool info 'runs/**/*.mcap' -j 8 -o runs.csv
    """
    from tftool.commands.fleet import fleet, fleet_tasks
    from tftool.commands.fleet.workers import workers_of
    from tftool.recordings.remote_files import fetched

    if output is not None:
        workers = workers_of(processes, scheduler)
        counts = fleet.swept_into(places, output, workers, fleet_tasks.Inventory(), resume=resume)
        return ExitStatus.UNREADABLE if fleet_tasks.UNREADABLE in counts else ExitStatus.DONE
    if resume or scheduler:
        raise UsageError("--resume and --scheduler make rows: add -o FILE.")
    if len(places) > 1:
        return _compared(places, processes, for_programs=for_programs)
    (place,) = places
    with fetched(place) as path:
        return _one(connection, path, place, for_programs=for_programs)


def _compared(places: list[str], processes: int, *, for_programs: bool) -> ExitStatus:
    """Several recordings, a line each."""
    from tftool.commands.fleet import fleet, fleet_tasks
    from tftool.commands.fleet.workers import workers_of
    from tftool.commands.shared.printer import line_width
    from tftool.drawing import recording_view as view

    workers = workers_of(processes, "")
    counts, rows = fleet.sweep(fleet.expanded(places), None, workers, fleet_tasks.Inventory())
    if for_programs:
        sys.stdout.write(json.dumps(rows, indent=2) + "\n")
    else:
        sys.stdout.write(view.as_lines(rows, line_width()))
    return ExitStatus.UNREADABLE if fleet_tasks.UNREADABLE in counts else ExitStatus.DONE


def _one(connection: Connection, place: str, name: str, *, for_programs: bool) -> ExitStatus:
    """All there is to say of one recording or description, which people know by a name."""
    from dataclasses import replace

    from tftool.base.escaping import visible
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.printer import line_width
    from tftool.commands.shared.recorded import read, told_of_odometry
    from tftool.drawing import recording_view as view
    from tftool.opener import named
    from tftool.recordings.find import Kind

    found = named(place)
    if found.kind is Kind.DESCRIPTION:
        _describe(connection, replace(found, name=name), for_programs=for_programs)
        return ExitStatus.DONE
    if not found.kind.is_recording:
        word = visible(name)
        if found.kind is Kind.SCENARIO:
            sentence = (
                f"'{word}' is no recording and no robot description. As a scenario, 'tftool check "
                f"{word}' plays it, and 'tftool tree {word}' shows its frames."
            )
            raise InputError(sentence) if Path(place).is_file() else UsageError(sentence)
        raise UsageError(
            f"'{word}' is a {found.kind.value} and no recording: 'tftool tree {word}' shows its "
            "frames."
        )
    recording: Recording = read(found, connection.robot, connection.recording)
    with recording:
        for sentence in told_of_odometry(recording):
            notice(visible(sentence))
        if for_programs:
            sys.stdout.write(json.dumps(view.as_object(recording, name), indent=2) + "\n")
        else:
            from tftool.doctor.evidence import Described, Scope, evidence_of_recording
            from tftool.doctor.judge import judge
            from tftool.drawing.finding_view import brief

            given = None if connection.robot.urdf is None else Described(recording.robot)
            diagnosis = judge(evidence_of_recording(recording, Scope(given)))
            width = line_width()
            sys.stdout.write(view.as_text(recording, width, name))
            told = "\n".join(view.wrapped(brief(diagnosis), width))
            sys.stdout.write(f"\n{told}\n")
    return ExitStatus.DONE


def _describe(connection: Connection, found: "Found", *, for_programs: bool) -> None:
    from tftool.commands.shared.printer import line_width
    from tftool.drawing import robot_view as view
    from tftool.robots.robot_model import load_urdf

    RobotOptions(connection.robot.joints, urdf=connection.robot.urdf).refuse(
        "'info' shows joints as they rest"
    )
    robot = load_urdf(found.paths[0], connection.robot.arguments)
    if for_programs:
        sys.stdout.write(json.dumps(view.as_object(found.name, robot), indent=2) + "\n")
    else:
        sys.stdout.write(view.as_text(found.name, robot, line_width()))
