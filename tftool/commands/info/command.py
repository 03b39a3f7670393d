"""`tftool info`: what a recording or a robot description holds."""

import json
import sys
from dataclasses import replace
from pathlib import Path

from tftool.base.errors import InputError, UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.commands.fleet import fleet, fleet_tasks
from tftool.commands.fleet.workers import workers_of
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.notices import notice
from tftool.commands.shared.printer import line_width
from tftool.commands.shared.recorded import read, told_of_odometry
from tftool.doctor.evidence import Described, Scope, evidence_of_recording
from tftool.doctor.judge import judge
from tftool.drawing import recording_view, robot_view
from tftool.drawing.finding_view import brief
from tftool.frames.source_options import RobotOptions
from tftool.opener import named
from tftool.recordings.find import Found, Kind
from tftool.recordings.recording import Recording
from tftool.recordings.remote_files import fetched
from tftool.robots.robot_model import load_urdf


def _compared(places: list[str], processes: int, *, for_programs: bool) -> ExitStatus:
    """Several recordings, a line each."""
    workers = workers_of(processes, "")
    counts, rows = fleet.sweep(fleet.expanded(places), None, workers, fleet_tasks.Inventory())
    if for_programs:
        sys.stdout.write(json.dumps(rows, indent=2) + "\n")
    else:
        sys.stdout.write(recording_view.as_lines(rows, line_width()))
    return ExitStatus.UNREADABLE if fleet_tasks.UNREADABLE in counts else ExitStatus.DONE


def _one(connection: Connection, place: str, name: str, *, for_programs: bool) -> ExitStatus:
    """All there is to say of one recording or description, which people know by a name."""
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
            sys.stdout.write(json.dumps(recording_view.as_object(recording, name), indent=2) + "\n")
        else:
            given = None if connection.robot.urdf is None else Described(recording.robot)
            diagnosis = judge(evidence_of_recording(recording, Scope(given)))
            width = line_width()
            sys.stdout.write(recording_view.as_text(recording, width, name))
            told = "\n".join(recording_view.wrapped(brief(diagnosis), width))
            sys.stdout.write(f"\n{told}\n")
    return ExitStatus.DONE


def _describe(connection: Connection, found: Found, *, for_programs: bool) -> None:

    RobotOptions(connection.robot.joints, urdf=connection.robot.urdf).refuse(
        "'info' shows joints as they rest"
    )
    robot = load_urdf(found.paths[0], connection.robot.arguments)
    if for_programs:
        sys.stdout.write(json.dumps(robot_view.as_object(found.name, robot), indent=2) + "\n")
    else:
        sys.stdout.write(robot_view.as_text(found.name, robot, line_width()))


def run(
    connection: Connection,
    places: list[str],
    for_programs: bool,
    output: Path | None,
    processes: int,
    resume: bool,
    scheduler: str,
) -> ExitStatus:
    """Run `tftool info`; the parameters are its options."""
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
