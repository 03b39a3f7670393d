"""Implementation of `tftool check`: play scenarios and judge their expectations."""

import glob
import os
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible, visible_lines
from tftool.base.report import Report
from tftool.base.stamps import Stamp, as_seconds, seconds
from tftool.commands.check import CheckOptions
from tftool.commands.shared.notices import complain, notice
from tftool.commands.shared.printer import write, write_file, write_json
from tftool.drawing import report_view as judgements
from tftool.opener import scenario_named
from tftool.recordings.find import METADATA
from tftool.scenario import builtin
from tftool.scenario.play import run_scenario
from tftool.scenario.scenario import Scenario, Verdict
from tftool.world.clock import Clock, WallClock
from tftool.world.frame_listener import logged_in
from tftool.world.log import LogRecord
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.frames.transform_log import TransformLog

PATIENCE = seconds(5)
"""Nanoseconds of real time between two notices about a scenario's progress."""

SUFFIXES = (".yaml", ".yml")
"""Suffixes of scenario files in a folder."""


def _expanded(name: str) -> list[str]:
    """Return the scenario files that a glob or folder contains; return any other word unchanged.

    tftool expands globs itself because not every shell does.
    """
    files: list[str] = []
    if builtin.path_of(name) is None:
        if os.path.isdir(name):
            listed = sorted(os.listdir(name))
            if METADATA not in listed:
                files = [os.path.join(name, one) for one in listed if one.endswith(SUFFIXES)]
        elif not os.path.lexists(name):
            files = sorted(glob.glob(name))
    return files or [name]


def _judge(
    name: str, judge: Callable[..., Verdict], folder: "_RecordingFolder | None", *, own_nodes: bool
) -> "tuple[Report, bool]":
    """Judge one scenario; return a report, and whether the scenario file could be read.

    The report has warnings and, for a failure, the doctor's findings. `own_nodes` says whether
    nodes of the scenario run; only then, a frame with two parents or in a loop is a warning.
    """
    try:
        scenario = scenario_named(name)
    except InputError as error:
        why = str(error)
        if Path(name).is_dir():  # the error text would also mention recordings
            why = f"No scenario ({', '.join(SUFFIXES)}) is in the folder '{name}'."
        complain("tftool", why)
        return Report(Path(name).stem or name, name, (), failure=why), False
    warnings = tuple(str(mistake) for mistake in scenario.warnings) if own_nodes else ()
    for warning in warnings:
        notice(visible_lines(warning))
    log = _RunLog(scenario)
    if folder is None:
        verdict = judge(scenario, watch=log.watching)
    else:
        verdict = _recorded(scenario, judge, folder.path_for(scenario.name), log)
    for warning in verdict.warnings:
        notice(visible_lines(warning))
    found = () if verdict.ok else log.findings(verdict)
    return replace(verdict.report(), warnings=warnings + verdict.warnings, why=found), True


class _RunLog:
    """Recorder of the transforms of one scenario run.

    If an expectation fails, the doctor examines the recorded transforms.
    """

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        self._log: TransformLog | None = None
        self._rejected: dict[str, str] = {}
        self._span: tuple[Stamp, Callable[[], Stamp]] | None = None

    @contextmanager
    def watching(self, world: World) -> Iterator[None]:
        """Record a world's transforms until the block ends."""
        self._log, stop = logged_in(world)
        stops = [stop, world.log.listen(self._note_rejection, "check")]
        if sys.stderr.isatty():
            stops.append(world.tf.subscribe(self._progress(world.clock)))
        self._span = (world.clock.now(), world.clock.now)
        try:
            yield
        finally:
            for one in stops:
                one()

    def _progress(self, simulated: Clock) -> Callable[[object], None]:
        """Return a callback that prints, every 5 s, how much of a long run is played."""
        real = WallClock()
        told, start = real.now(), simulated.now()

        def tell(_: object) -> None:
            nonlocal told
            if real.now() - told >= PATIENCE:
                told = real.now()
                done, whole = simulated.now() - start, self._scenario.duration
                name = visible(self._scenario.name)
                notice(f"{name}: {as_seconds(done):.0f} of {as_seconds(whole):g} s played")

        return tell

    def _note_rejection(self, record: LogRecord) -> None:
        """Keep the first message of each reason for which the buffer rejects transforms."""
        reason, colon, _ = record.text.partition(":")
        if record.node == "buffer" and colon and reason.startswith("TF_"):
            self._rejected.setdefault(reason, record.text)

    def findings(self, verdict: Verdict) -> tuple[str, ...]:
        """Return a sentence for each error or warning of the doctor, with a suggested fix."""
        # Imported here: this takes as long as most scenarios take to play.
        from tftool.doctor.judge import faults_in_log

        if self._log is None or self._span is None:
            return ()
        if not len(self._log):
            return self._without_transforms(verdict)
        begin, now = self._span
        scenario, rules = self._scenario, self._scenario.doctor
        faults = faults_in_log(
            self._log,
            scenario.name,
            (begin, now()),
            scenario.cache_time,
            limits=rules.limits,
            ignore=rules.ignore,
        )
        return tuple(
            f"{fault.id}: {fault.message}" + (f"; {fault.fixes[0].line}" if fault.fixes else "")
            for fault in faults
        )

    def _without_transforms(self, verdict: Verdict) -> tuple[str, ...]:
        """Return why an expectation about frames failed if the buffer has no transform."""
        failed = {one.line for one in verdict.outcomes if one.reached and not one.ok}
        asked = (one for one in self._scenario.expect if one.line in failed)
        if not any(one.question.is_of_frames for one in asked):
            return ()
        if not self._rejected:
            return ("no-transforms: no node sent a transform",)
        # One transform can be rejected for several reasons; the last one names the missing field.
        last = [*self._rejected.values()][-1]
        return (f"no-transforms: every transform was rejected: {last}",)


class _RecordingFolder:
    """Folder for the recordings of failed scenarios; each recording has a unique file name."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._names: set[str] = set()

    def path_for(self, name: str) -> Path:
        """Return a new path for a scenario's recording; append a number if the name was used."""
        plain = free = re.sub(r"[^0-9A-Za-z_-]", "_", name)
        number = 1
        while free in self._names:
            number += 1
            free = f"{plain}_{number}"
        self._names.add(free)
        return self._folder / f"{free}.mcap"


def _recorded(
    scenario: Scenario, judge: Callable[..., Verdict], path: Path, log: _RunLog
) -> Verdict:
    """Judge a scenario, and record the run; the recording stays only if an expectation failed."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(
            f"The folder '{visible(str(path.parent))}' cannot be written to: {reason}."
        ) from error
    # Imported here, because the recorder imports the writers of all containers.
    from tftool.world.nodes.recorder import recorded

    # A temporary name until the judgement: an earlier recording stays if nothing fails.
    played = path.with_name(f".{path.name}")

    @contextmanager
    def watching(world: World) -> Iterator[None]:
        with log.watching(world), recorded(world, path=played, force=True):
            yield

    verdict = judge(scenario, watch=watching)
    if verdict.ok:
        played.unlink(missing_ok=True)
    else:
        played.replace(path)
        notice(f"Recorded: {visible(str(path))}")
    return verdict


def _strictly(report: Report) -> Report:
    """Return a report in which warnings count as failures, for the option --strict."""
    if not report.warnings or not report.ok:
        return report
    return replace(report, failure="\n".join(("warnings fail (--strict):", *report.warnings)))


def run(options: CheckOptions) -> ExitStatus:
    """Run `tftool check`: judge scenarios and packages, and print the outcomes."""
    if not options.scenarios and not options.packages:
        raise UsageError(
            "no scenario is given: write a name or a file, or a package as --as-ros PACKAGE"
        )
    kept = None if options.recordings is None else _RecordingFolder(options.recordings)
    judging: AbstractContextManager[Callable[..., Verdict]]
    runs_programs = options.programs or options.launched is not None
    if runs_programs or options.packages:
        # Imported here: users' programs need all of `ros`, a scenario's own nodes none of it.
        from tftool.commands.check.programs import judge_packages, judge_with
    if runs_programs:
        judging = judge_with(
            options.programs or (), options.launched, force=options.force, verbose=options.verbose
        )
    else:
        judging = nullcontext(run_scenario)
    with judging as judge:
        judged = [
            _judge(word, judge, kept, own_nodes=options.launched is None)
            for words in options.scenarios or ()
            for word in _expanded(words)
        ]
    if options.packages:
        judged += [(report, True) for report in judge_packages(options.packages)]
    if options.strict:
        judged = [(_strictly(report), readable) for report, readable in judged]
    reports = [report for report, _ in judged]
    if options.for_programs:
        write_json(judgements.as_rows(reports))
    else:
        if Console().is_terminal and sys.stderr.isatty():
            # The terminal already shows the error in full, printed to stderr.
            reports = [
                report if readable else replace(report, failure="cannot be read")
                for report, readable in judged
            ]
        write(
            judgements.render_all(reports) if options.verbose else judgements.render(reports),
            is_wide=not options.verbose,
        )
        sys.stdout.write(
            f"{judgements.summary(reports, 'scenario' if options.scenarios else 'package')}\n"
        )
    if options.junit is not None:
        write_file(options.junit, judgements.as_junit(reports))
    if not all(readable for _, readable in judged):
        return ExitStatus.UNREADABLE
    return ExitStatus.DONE if all(report.ok for report in reports) else ExitStatus.FAILED
