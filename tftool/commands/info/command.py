"""Implementation of `tftool info`: contents of recordings and robot descriptions."""

import sys
from pathlib import Path

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count, visible
from tftool.commands.info import InfoOptions
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.notices import complain, notice
from tftool.commands.shared.printer import line_width, write_json
from tftool.doctor.evidence import Described, Scope, evidence_of_recording
from tftool.drawing import recording_view
from tftool.frames.recording_frames import odometry_notes
from tftool.frames.source_options import DescriptionOptions
from tftool.opener import named
from tftool.recordings.find import Kind, fetched
from tftool.recordings.recording import Recording
from tftool.robots.robot_model import load_urdf
from tftool.robots.static_publishers import read_statics


def run(connection: Connection, options: InfoOptions) -> ExitStatus:
    """Run `tftool info`: print the contents of one file, or a summary of several files."""
    if options.output is None and (options.resume or options.scheduler):
        raise UsageError("--resume and --scheduler are only allowed with -o FILE: add -o FILE.")
    if (
        options.output is None
        and len(options.places) == 1
        and not _is_launch_file(options.places[0])
    ):
        with fetched(options.places[0]) as path:
            return _show(connection, path, options.places[0], for_programs=options.for_programs)
    if options.output is None and all(_is_text(place) for place in options.places):
        return _list_texts(connection, options.places, for_programs=options.for_programs)
    from tftool.commands.fleet import fleet, workers

    executor, task = workers.workers_of(options.processes, options.scheduler), fleet.Inventory()
    if options.output is not None:
        counts = fleet.swept_into(
            options.places, options.output, executor, task, resume=options.resume
        )
    else:
        counts, rows = fleet.sweep(fleet.expanded(options.places), None, executor, task)
        if options.for_programs:
            write_json(rows)
        else:
            sys.stdout.write(recording_view.as_lines(rows, line_width()))
    return ExitStatus.UNREADABLE if fleet.UNREADABLE in counts else ExitStatus.DONE


def _is_launch_file(place: str) -> bool:
    return Path(place).is_file() and named(place).kind is Kind.STATICS


def _is_text(path: str) -> bool:
    """Return whether a path names a robot description, launch file or script, not a recording."""
    try:
        return Path(path).is_file() and named(path).kind in (Kind.DESCRIPTION, Kind.STATICS)
    except InputError:
        return False


def _list_texts(connection: Connection, paths: list[str], *, for_programs: bool) -> ExitStatus:
    """Print a line for each robot description or launch file, and every mistake in the files."""
    rows: list[dict[str, object]] = []
    for name in paths:
        kind, path = named(name).kind, Path(name)
        noun = "joint" if kind is Kind.DESCRIPTION else "static transform"
        number = 0
        mistakes: list[str] = []
        try:
            if kind is Kind.DESCRIPTION:
                robot = load_urdf(path, connection.robot.arguments)
                number, mistakes = len(robot.joints), [*robot.description.mistakes]
            else:
                statics, wrong, _ = read_statics(path, name)
                number, mistakes = len(statics), [text for _, text in wrong]
        except InputError as error:
            mistakes = [str(error)]
        rows.append(
            {"source": name, "kind": kind.value, "transforms": number, "mistakes": mistakes}
        )
        if not for_programs:
            sys.stdout.write(f"{visible(name)}: {kind.value}, {count(number, noun)}\n")
        for mistake in mistakes:
            complain("tftool info", mistake)
    if for_programs:
        write_json(rows)
    return ExitStatus.UNREADABLE if any(row["mistakes"] for row in rows) else ExitStatus.DONE


def _show(connection: Connection, path: str, name: str, *, for_programs: bool) -> ExitStatus:
    """Print everything about one recording or robot description."""
    found = named(path)
    if found.kind is Kind.DESCRIPTION:
        return _show_robot(connection, found.paths[0], name, for_programs=for_programs)
    word = visible(name)
    if found.kind is Kind.SCENARIO:
        raise UsageError(
            f"'{word}' is a scenario, not a recording or robot description: 'tftool check {word}' "
            f"plays the scenario, 'tftool tree {word}' shows the frames."
        )
    if not found.kind.is_recording:
        raise UsageError(
            f"'{word}' is a {found.kind.value}, not a recording: 'tftool tree {word}' shows its "
            "frames."
        )
    recording = open_from(connection, path, tells=False).recording
    assert recording is not None
    given = connection.robot.urdf is not None and recording.robot is not None
    notes = recording.robot.notes if given and recording.robot is not None else ()
    for sentence in (*notes, *odometry_notes(recording)):
        notice(visible(sentence))
    if for_programs:
        write_json(recording_view.as_object(recording, name))
    else:
        _print(recording, name, has_urdf=connection.robot.urdf is not None)
    return ExitStatus.DONE


def _print(recording: Recording, name: str, *, has_urdf: bool) -> None:
    """Print a recording's contents and the doctor's findings."""
    from tftool.doctor.judge import judge
    from tftool.drawing.finding_view import brief

    described = Described(recording.robot) if has_urdf else None
    diagnosis = judge(evidence_of_recording(recording, Scope(described)))
    width = line_width()
    sys.stdout.write(recording_view.as_text(recording, width, name))
    told = "\n".join(recording_view.wrapped(brief(diagnosis), width))
    sys.stdout.write(f"\n{told}\n")


def _show_robot(connection: Connection, path: Path, name: str, *, for_programs: bool) -> ExitStatus:
    DescriptionOptions(connection.robot.joints, urdf=connection.robot.urdf).refuse(
        "'info' shows joints at rest"
    )
    robot = load_urdf(path, connection.robot.arguments)
    if for_programs:
        write_json(recording_view.robot_as_object(name, robot))
    else:
        sys.stdout.write(recording_view.robot_as_text(name, robot, line_width()))
    return ExitStatus.UNREADABLE if robot.description.mistakes else ExitStatus.DONE
