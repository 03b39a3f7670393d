"""Run the doctor over one source or several, and report what it finds."""

import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from tftool.base.errors import InputError, UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, seconds
from tftool.commands.doctor import DoctorOptions, FailOn
from tftool.commands.fleet import fleet, fleet_tasks
from tftool.commands.fleet.fleet import expanded
from tftool.commands.fleet.workers import workers_of
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.evidence_sources import evidence_from, rules_of
from tftool.commands.shared.notices import complain
from tftool.commands.shared.options import refuse
from tftool.commands.shared.pairs import pairs_and_place
from tftool.commands.shared.printer import line_width, write, write_file
from tftool.doctor.evidence import Evidence, Scope, described_by
from tftool.doctor.findings import Severity, fingerprint
from tftool.doctor.judge import CHECKS, Diagnosis, judge, refuse_unknown, unknown
from tftool.doctor.localisation_steps import steps_of
from tftool.doctor.measured_mounts import MeasuredMount, measured_mounts
from tftool.doctor.model import Model, Settings
from tftool.drawing import finding_view as view
from tftool.drawing import step_view
from tftool.drawing.sarif import as_sarif
from tftool.recordings.remote_files import fetched

if TYPE_CHECKING:
    from rich.text import Text


@dataclass(frozen=True, slots=True)
class Baseline:
    """Fingerprints of an earlier report, by the name of each source.

    Attributes:
        known: Known findings of each source.
    """

    known: Mapping[str, frozenset[str]]

    @classmethod
    def read(cls, path: Path) -> "Baseline":
        """Read the output of `tftool doctor --json` for one source or several.

        Raises:
            InputError: If the file cannot be read, or is no such report.
        """
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            reason = error.strerror or error
            raise InputError(f"'{visible(str(path))}' cannot be read: {reason}.") from error
        except (ValueError, RecursionError) as error:
            raise _no_report(path, "is no JSON") from error
        reports = content if isinstance(content, list) else [content]
        try:
            return cls(
                {
                    str(report["source"]): frozenset(_identity(row) for row in report["findings"])
                    for report in reports
                }
            )
        except (KeyError, TypeError, AttributeError) as error:
            raise _no_report(path, "is no report of the doctor") from error

    def marked(self, source: str, diagnosis: Diagnosis) -> Diagnosis:
        """Mark the findings in the baseline, by this source or, if it is missing there, by any
        source.
        """
        known = self.known.get(source)
        if known is None:
            known = frozenset[str]().union(*self.known.values())
        findings = (replace(f, known=f.fingerprint in known) for f in diagnosis.findings)
        return replace(diagnosis, findings=tuple(findings))


def _identity(row: Mapping[str, Any]) -> str:
    """Return a finding's fingerprint; for older reports it is computed from the finding's names."""
    given = row.get("fingerprint")
    if isinstance(given, str):
        return given
    return fingerprint(row["id"], row["frames"], row["edges"], row["topics"])


def _no_report(path: Path, what: str) -> InputError:
    return InputError(
        f"'{visible(str(path))}' {what}: make one with 'tftool doctor FROM --json > OLD.json'."
    )


Judged: TypeAlias = list[tuple[str, Diagnosis | str]]
"""Each source with its diagnosis, or why it cannot be read."""


@dataclass(frozen=True, slots=True)
class DoctorReport:
    """Output format of the report.

    Attributes:
        for_programs: The report as JSON.
        markdown: For an issue on the web.
        verbose: With all evidence.
        statistics: With rate, latency and gaps.
        junit: A file for a build server.
        sarif: A file for a code host.
    """

    for_programs: bool
    markdown: bool
    verbose: bool
    statistics: bool
    junit: Path | None
    sarif: Path | None
    steps: bool


@dataclass(frozen=True, slots=True)
class CheckSelection:
    """Checks to run, and their thresholds.

    Attributes:
        select: These checks or areas alone; all where empty.
        ignore: Checks or areas left out.
        limits: Other thresholds: "gap.seconds=2".
        cache_time: How far back the listener remembers.
        fixed_frame: Frame in which sensors are placed.
    """

    select: tuple[str, ...]
    ignore: tuple[str, ...]
    limits: Sequence[str]
    cache_time: Duration | None
    fixed_frame: str

    def settings(self, tf_topics: tuple[str, ...]) -> Settings:
        """Return the thresholds.

        Raises:
            UsageError: If one is not a threshold.
        """
        given: dict[str, dict[str, float]] = {}
        for text in self.limits:
            name, _, value = text.partition("=")
            check, _, limit = name.partition(".")
            try:
                number = float(value)
            except ValueError:
                number = -1.0
            if not limit or not 0.0 <= number < float("inf"):
                raise UsageError(
                    f"--limit {text}: write ID.NAME=VALUE with a number from 0 on, as in "
                    "gap.seconds=2"
                )
            given.setdefault(check, {})[limit] = number
        return Settings(self.cache_time or seconds(10), self.fixed_frame, tf_topics, given)


@dataclass(frozen=True, slots=True)
class RowOptions:
    """Options for writing findings of many recordings as rows of a file.

    Attributes:
        output: The file; None to report instead.
        processes: How many at once.
        scheduler: A cluster that does it.
        resume: Whether to skip recordings that the file already holds.
    """

    output: Path | None
    processes: int
    scheduler: str
    resume: bool


def run(connection: Connection, options: DoctorOptions) -> ExitStatus:
    """Run `tftool doctor`."""
    if options.listed or options.explain:
        return _show_checks("" if options.listed else options.explain, markdown=options.markdown)
    chosen, left_out = tuple(_words(options.select or ())), tuple(_words(options.ignore or ()))
    selection = CheckSelection(
        chosen, left_out, options.limits or [], options.cache_time, options.fixed_frame
    )
    report = DoctorReport(
        options.for_programs,
        options.markdown,
        options.verbose,
        options.statistics,
        options.junit,
        options.sarif,
        options.steps,
    )
    rows = RowOptions(options.output, options.processes, options.scheduler, options.resume)
    _refuse_contradictions(report, rows)
    settings = selection.settings(tuple(options.tf_topic or ()))
    urdf = connection.robot.urdf
    scope = Scope(
        None if urdf is None else described_by(urdf), settings.tf_topics, options.begin, options.end
    )
    fails = None if options.fail_on is FailOn.never else Severity(options.fail_on.value)
    if options.pair and not options.steps:
        raise UsageError(f"--pair {options.pair} is about steps: add --steps.")
    if options.steps:
        (ends,), _ = pairs_and_place([], [options.pair]) if options.pair else ([("", "")], None)
        return _show_steps(
            connection, options.places or [], ends, (options.lasting, scope), options.for_programs
        )
    if options.baseline is not None and options.output is not None:
        raise UsageError("--baseline applies to reports, and -o writes rows: leave one out.")
    accepted = None if options.baseline is None else Baseline.read(options.baseline)
    if options.mounts and options.output is not None:
        raise UsageError("--mounts goes with a report: leave -o out.")
    if options.output is not None:
        return _sweep(options.places or [], options.output, rows, selection, settings, scope, fails)
    judged = _diagnosed(
        connection,
        options.places or [],
        options.lasting,
        settings,
        selection,
        scope,
        mounts=options.mounts,
    )
    if accepted is not None:
        judged = [(name, found if isinstance(found, str) else accepted.marked(name, found))
                  for name, found in judged]  # fmt: skip
    _print(judged, report)
    if options.junit is not None:
        write_file(options.junit, view.as_junit(judged, fails))
    if options.sarif is not None:
        write_file(options.sarif, as_sarif(judged))
    return _status(judged, fails)


def _show_checks(name: str, *, markdown: bool) -> ExitStatus:
    """Print one check in full, or the list of all checks.

    Raises:
        UsageError: If there is no such check.
    """
    if not name:
        if markdown:
            sys.stdout.write(view.as_page())
        else:
            write(view.listing())
    elif name in CHECKS:
        sys.stdout.write(view.explained(CHECKS[name], line_width()))
    else:
        raise UsageError(unknown(name, list(CHECKS), "check"))
    return ExitStatus.DONE


def _show_steps(
    connection: Connection,
    places: list[str],
    ends: tuple[str, str],
    listening: tuple[Duration | None, Scope],
    for_programs: bool,
) -> ExitStatus:
    """Print the steps of every source.

    Raises:
        InputError: If one cannot be read.
        LookupException: If a frame is unknown, or nothing joins the two.
    """
    lasting, scope = listening
    objects = []
    for word in [*expanded(places)] if places else [None]:
        with fetched(word or "") as path:
            model = Model(evidence_from(connection, path or None, lasting, scope))
        steps = steps_of(model, *ends)
        if for_programs:
            objects.append(step_view.as_object(model, steps))
        else:
            write(step_view.render(model, steps))
    if for_programs:
        content = objects[0] if len(objects) == 1 else objects
        sys.stdout.write(json.dumps(content, indent=2, allow_nan=False) + "\n")
    return ExitStatus.DONE


def _refuse_contradictions(report: DoctorReport, rows: RowOptions) -> None:
    """Refuse contradicting options.

    Raises:
        UsageError: If two were given.
    """
    asked = {
        "--junit": report.junit is not None,
        "--sarif": report.sarif is not None,
        "--json": report.for_programs,
        "--markdown": report.markdown,
        "--verbose": report.verbose,
        "--statistics": report.statistics,
        "--steps": report.steps,
    }
    others = " and ".join(name for name, is_given in asked.items() if is_given)
    makes_rows = rows.output is not None
    refuse(
        (
            report.for_programs and report.markdown,
            "--json and --markdown are two ways to print it: leave one out.",
        ),
        (makes_rows and others, f"-o writes rows, and {others} another report: leave one out."),
        (
            report.steps and (report.markdown or report.junit or report.statistics),
            "--steps prints a table in place of the findings: leave out --markdown, --junit and "
            "--statistics.",
        ),
        (
            not makes_rows and (rows.resume or rows.processes > 1 or rows.scheduler),
            "--jobs, --resume and --scheduler make rows: add -o FILE.",
        ),
    )


def _words(options: Sequence[str]) -> list[str]:
    """Split an option's comma-separated values over all its uses."""
    return [word.strip() for one in options for word in one.split(",") if word.strip()]


def _sweep(
    places: list[str],
    output: Path,
    rows: RowOptions,
    selection: CheckSelection,
    settings: Settings,
    scope: Scope,
    fails: Severity | None,
) -> ExitStatus:
    """Write rows for each recording; return the worst exit status."""
    refuse_unknown(settings, selection.select, selection.ignore)
    task = fleet_tasks.Examination(settings, selection.select, selection.ignore, scope)
    workers = workers_of(rows.processes, rows.scheduler)
    counts = fleet.swept_into(places, output, workers, task, resume=rows.resume)
    if fleet_tasks.UNREADABLE in counts:
        return ExitStatus.UNREADABLE
    bad = [name for name in ("error", "warning", "note") if name in counts]
    found = fails is not None and any(Severity(name).rank <= fails.rank for name in bad)
    return ExitStatus.FAILED if found else ExitStatus.DONE


def _diagnosed(
    connection: Connection,
    places: list[str],
    lasting: Duration | None,
    settings: Settings,
    selection: CheckSelection,
    scope: Scope,
    *,
    mounts: bool,
) -> Judged:
    """Yield the diagnosis of each source; an unreadable one does not stop the others."""
    sources: list[str | None] = [*expanded(places)] if places else [None]
    judged: Judged = []
    before: list[MeasuredMount] = []
    refuse_unknown(settings, selection.select, selection.ignore)

    def look(evidence: Evidence) -> "list[Text]":
        found = judge(evidence, settings, select=selection.select, ignore=selection.ignore)
        return view.so_far(found)

    for word in sources:
        try:
            with fetched(word or "") as path:
                rules = rules_of(path or None)
                evidence = evidence_from(connection, path or None, lasting, scope, look)
        except InputError as error:
            if len(sources) == 1:
                raise
            complain("tftool doctor", str(error))
            judged.append((word or "", str(error)))
            continue
        if path != (word or ""):
            evidence = replace(evidence, name=word or "")
        if mounts:
            measured = measured_mounts(Model(evidence, settings), before)
            before += measured
            evidence = replace(evidence, mounts=measured)
        diagnosis = judge(
            evidence,
            rules.settings(settings),
            select=selection.select,
            ignore=(*selection.ignore, *rules.ignore),
        )
        judged.append((word or evidence.name, diagnosis))
    return judged


def _print(judged: Judged, report: DoctorReport) -> None:
    """Print every diagnosis; for several sources in text form, also a comparison at the end."""
    diagnoses = [found for _, found in judged if not isinstance(found, str)]
    if report.for_programs:
        objects = [view.as_object(one) for one in diagnoses]
        content = objects[0] if len(judged) == 1 and objects else objects
        sys.stdout.write(json.dumps(content, indent=2, allow_nan=False, default=str) + "\n")
        return
    if report.markdown:
        sys.stdout.write("\n".join(view.as_markdown(one) for one in diagnoses))
        return
    for number, one in enumerate(diagnoses):
        if number:
            sys.stdout.write("\n")
        write(view.render(one, verbose=report.verbose))
        if report.statistics:
            write(view.statistics(one.model))
    if len(judged) > 1:
        sys.stdout.write("\n")
        write(view.compared(judged))


def _status(judged: Judged, fails: Severity | None) -> ExitStatus:
    """Return the worst exit status of all sources."""
    if any(isinstance(found, str) for _, found in judged):
        return ExitStatus.UNREADABLE
    worst = [found.worst for _, found in judged if not isinstance(found, str)]
    if fails is not None and any(one is not None and one.rank <= fails.rank for one in worst):
        return ExitStatus.FAILED
    return ExitStatus.DONE
