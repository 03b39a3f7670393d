"""Implementation of `tftool doctor`: examine one source or several, and report the findings."""

import json
import sys
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import seconds
from tftool.commands.doctor import DoctorOptions, FailOn
from tftool.commands.fleet import fleet
from tftool.commands.fleet.fleet import UNREADABLE, Examination, expanded
from tftool.commands.fleet.workers import workers_of
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.evidence_sources import evidence_from, rules_of
from tftool.commands.shared.notices import complain, notice
from tftool.commands.shared.options import refuse
from tftool.commands.shared.pairs import pairs_and_place
from tftool.commands.shared.printer import line_width, write, write_file, write_json
from tftool.doctor.evidence import Evidence, Scope, described_by
from tftool.doctor.findings import Severity, fingerprint
from tftool.doctor.judge import CHECKS, Diagnosis, checks_named, judge, refuse_unknown, unknown
from tftool.doctor.localisation_steps import steps_of
from tftool.doctor.measured_mounts import MeasuredMount, measured_mounts
from tftool.doctor.model import Model, Settings
from tftool.doctor.wording import several
from tftool.drawing import finding_view as view
from tftool.drawing import step_view
from tftool.drawing.sarif import as_sarif
from tftool.recordings.find import fetched

if TYPE_CHECKING:
    from rich.text import Text


Judged: TypeAlias = list[tuple[str, Diagnosis | str]]
"""Each source with its diagnosis, or with the reason why it cannot be read."""

Baseline: TypeAlias = Mapping[str, frozenset[str]]
"""Fingerprints of an earlier report's findings, by the name of each source."""


def _read_baseline(path: Path) -> Baseline:
    """Read a baseline: the output of an earlier `tftool doctor --json`.

    Raises:
        InputError: If the file cannot be read, or is not the output of the doctor.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"'{visible(str(path))}' cannot be read: {reason}.") from error
    except (ValueError, RecursionError) as error:
        raise _no_report(path, "is not valid JSON") from error
    reports = content if isinstance(content, list) else [content]
    try:
        return {
            str(report["source"]): frozenset(_identity(row) for row in report["findings"])
            for report in reports
        }
    except (KeyError, TypeError, AttributeError) as error:
        raise _no_report(path, "is not a report of the doctor") from error


def _marked(baseline: Baseline, source: str, diagnosis: Diagnosis | str) -> Diagnosis | str:
    """Mark the findings of a source that are in the baseline, an earlier report.

    If the baseline has no report on this source, a finding is marked if it equals a finding of any
    source in the baseline.
    """
    if isinstance(diagnosis, str):
        return diagnosis
    known = baseline.get(source)
    if known is None:
        known = frozenset[str]().union(*baseline.values())
    findings = (replace(f, known=f.fingerprint in known) for f in diagnosis.findings)
    return replace(diagnosis, findings=tuple(findings))


def _identity(row: Mapping[str, Any]) -> str:
    """Return the fingerprint of a finding, computed if the report has no fingerprint."""
    given = row.get("fingerprint")
    if isinstance(given, str):
        return given
    return fingerprint(row["id"], row["frames"], row["edges"], row["topics"])


def _no_report(path: Path, what: str) -> InputError:
    return InputError(
        f"'{visible(str(path))}' {what}: make a report with 'tftool doctor FROM --json > OLD.json'."
    )


def run(connection: Connection, options: DoctorOptions) -> ExitStatus:
    """Run `tftool doctor`: print or write the findings, and return the exit status."""
    _refuse_ignored(connection, options)
    _refuse_contradictions(options)
    if options.listed or options.explain:
        return _show_checks("" if options.listed else options.explain, markdown=options.markdown)
    task = _examination(connection, options)
    fails = None if options.fail_on is FailOn.never else Severity(options.fail_on.value)
    if options.steps:
        return _show_steps(connection, options, task.scope)
    baseline = None if options.baseline is None else _read_baseline(options.baseline)
    refuse_unknown(task.settings, task.select, task.ignore)
    if options.output is not None:
        return _sweep(options, options.output, task, fails)
    judged = _diagnosed(connection, options, task)
    if baseline is not None:
        judged = [(name, _marked(baseline, name, found)) for name, found in judged]
    _print(judged, options)
    if options.junit is not None:
        write_file(options.junit, view.as_junit(judged, fails))
    if options.sarif is not None:
        write_file(options.sarif, as_sarif(judged))
    return _status(judged, fails)


def _examination(connection: Connection, options: DoctorOptions) -> Examination:
    """Return the settings of the examination: checks, thresholds, part of the source.

    Raises:
        UsageError: If a value of --limit is not ID.NAME=NUMBER.
    """
    limits: dict[str, dict[str, float]] = {}
    for text in options.limits or ():
        name, _, value = text.partition("=")
        check, _, limit = name.partition(".")
        try:
            number = float(value)
        except ValueError:
            number = -1.0
        if not limit or not 0.0 <= number < float("inf"):
            raise UsageError(
                f"--limit '{text}': --limit takes ID.NAME=VALUE with a VALUE of 0 or more, such as "
                "gap.seconds=2"
            )
        limits.setdefault(check, {})[limit] = number
    topics = tuple(options.tf_topic or ())
    urdf = connection.robot.urdf
    described = None if urdf is None else described_by(urdf)
    return Examination(
        Settings(options.cache_time or seconds(10), options.fixed_frame, topics, limits),
        _words(options.select),
        _words(options.ignore),
        Scope(described, topics, options.begin, options.end),
    )


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


def _show_steps(connection: Connection, options: DoctorOptions, scope: Scope) -> ExitStatus:
    """Print the sudden jumps of frames in every source (`--steps`).

    Raises:
        InputError: If a source cannot be read.
        LookupException: If a frame of `--pair` is unknown, or the two frames are not connected.
    """
    (ends,), _ = pairs_and_place([], [options.pair]) if options.pair else ([("", "")], None)
    objects = []
    for word in _sources(options):
        with nullcontext() if word is None else fetched(word) as path:
            model = Model(evidence_from(connection, path, options.lasting, scope))
        steps = steps_of(model, *ends)
        if options.for_programs:
            objects.append(step_view.as_object(model, steps))
        else:
            write(step_view.render(model, steps))
    if options.for_programs:
        write_json(objects[0] if len(objects) == 1 else objects)
    return ExitStatus.DONE


def _sources(options: DoctorOptions) -> list[str | None]:
    return [*expanded(options.places)] if options.places else [None]


def _refuse_ignored(connection: Connection, options: DoctorOptions) -> None:
    """Raise UsageError if arguments are given beside --list or --explain, which ignores them."""
    context = connection.context
    if context is None or not (options.listed or options.explain):
        return
    meant = "listed" if options.listed else "explain"
    told = "--list" if options.listed else "--explain"
    used = {meant, "markdown"} if options.listed else {meant}
    given = []
    for option in context.command.params:
        source = context.get_parameter_source(option.name or "")
        if option.name not in used and source is not None and source.name == "COMMANDLINE":
            is_option = option.param_type_name == "option"
            given.append(option.opts[0] if is_option else " ".join(options.places or ()))
    if given:
        raise UsageError(
            f"{told} only prints text about checks: leave out {visible(', '.join(given))}."
        )


def _refuse_contradictions(options: DoctorOptions) -> None:
    """Raise UsageError if two options contradict each other."""
    asked = {
        "--junit": options.junit,
        "--sarif": options.sarif,
        "--json": options.for_programs,
        "--markdown": options.markdown,
        "--verbose": options.verbose,
        "--statistics": options.statistics,
        "--steps": options.steps,
    }
    others = " and ".join(name for name, given in asked.items() if given)
    makes_rows = options.output is not None
    selected = checks_named(_words(options.select)) or list(CHECKS)
    refuse(
        (
            options.for_programs and options.markdown,
            "--json and --markdown are two output formats: leave one out.",
        ),
        (
            set(selected) <= set(checks_named(_words(options.ignore))),
            "--ignore leaves out every check that would run: change --ignore or --select.",
        ),
        (makes_rows and others, f"-o writes rows instead of a report: leave out {others}."),
        (
            options.steps and (options.markdown or options.junit or options.statistics),
            "--steps prints a table instead of the findings: leave out --markdown, --junit and "
            "--statistics.",
        ),
        (
            not makes_rows and (options.resume or options.processes > 1 or options.scheduler),
            "--jobs, --resume and --scheduler are only allowed with -o FILE: add -o FILE.",
        ),
        (
            options.pair and not options.steps,
            f"--pair {options.pair} is only allowed with --steps: add --steps.",
        ),
        (
            options.baseline is not None and makes_rows,
            "--baseline marks findings of a report, but -o writes rows instead of a report: "
            "leave one out.",
        ),
        (options.mounts and makes_rows, "--mounts cannot be combined with -o: leave one out."),
    )


def _words(values: Sequence[str] | None) -> tuple[str, ...]:
    """Split the comma-separated values of an option, which may be given several times."""
    return tuple(word.strip() for one in values or () for word in one.split(",") if word.strip())


def _sweep(
    options: DoctorOptions, output: Path, task: Examination, fails: Severity | None
) -> ExitStatus:
    """Examine many recordings, write the findings to a file, and return the worst exit status."""
    workers = workers_of(options.processes, options.scheduler)
    counts = fleet.swept_into(options.places or [], output, workers, task, resume=options.resume)
    if UNREADABLE in counts:
        return ExitStatus.UNREADABLE
    bad = [name for name in ("error", "warning", "note") if name in counts]
    found = fails is not None and any(Severity(name).rank <= fails.rank for name in bad)
    return ExitStatus.FAILED if found else ExitStatus.DONE


def _diagnosed(connection: Connection, options: DoctorOptions, task: Examination) -> Judged:
    """Return the diagnosis of each source; an unreadable source does not stop the others."""
    sources = _sources(options)
    judged: Judged = []
    before: list[MeasuredMount] = []

    def look(evidence: Evidence) -> "list[Text]":
        return view.so_far(judge(evidence, task.settings, select=task.select, ignore=task.ignore))

    for word in sources:
        try:
            with nullcontext() if word is None else fetched(word) as path:
                rules = rules_of(path)
                evidence = evidence_from(connection, path, options.lasting, task.scope, look)
        except InputError as error:
            if len(sources) == 1:
                raise
            complain("tftool doctor", str(error))
            judged.append((word or "", str(error)))
            continue
        if word is not None and path != word:
            evidence = replace(evidence, name=word)
        if options.mounts:
            measured = measured_mounts(Model(evidence, task.settings), before)
            before += measured
            notice(f"{visible(evidence.name)}: {_compared(measured)}")
            evidence = replace(evidence, mounts=measured)
        ignore = (*task.ignore, *rules.ignore)
        diagnosis = judge(
            evidence, rules.settings(task.settings), select=task.select, ignore=ignore
        )
        judged.append((word or evidence.name, diagnosis))
    return judged


def _compared(measured: Sequence[MeasuredMount]) -> str:
    """Return which mounts were compared with the recorded motion, as text for a notice."""
    if not measured:
        return (
            "no mount was compared, because no recorded motions of a robot and of a sensor on it "
            "determine one."
        )
    names = several([f"{one.child} in {one.parent}" for one in measured])
    are = "mount was" if len(measured) == 1 else "mounts were"
    return f"{len(measured)} {are} compared with the motion: {visible(names)}."


def _print(results: Judged, options: DoctorOptions) -> None:
    """Print the diagnosis of each source; for several sources, also a comparison as text."""
    diagnoses = [found for _, found in results if not isinstance(found, str)]
    if options.for_programs:
        objects = [view.as_object(one) for one in diagnoses]
        write_json(objects[0] if len(diagnoses) == 1 and objects else objects)
        return
    if options.markdown:
        sys.stdout.write("\n".join(view.as_markdown(one) for one in diagnoses))
        return
    for number, one in enumerate(diagnoses):
        if number:
            sys.stdout.write("\n")
        write(view.render(one, verbose=options.verbose))
        if options.statistics:
            write(view.statistics(one.model))
    if len(diagnoses) > 1:
        sys.stdout.write("\n")
        write(view.compared(results))


def _status(results: Judged, fails: Severity | None) -> ExitStatus:
    """Return the worst exit status of all sources."""
    if any(isinstance(found, str) for _, found in results):
        return ExitStatus.UNREADABLE
    worst = [found.worst for _, found in results if not isinstance(found, str)]
    if fails is not None and any(one is not None and one.rank <= fails.rank for one in worst):
        return ExitStatus.FAILED
    return ExitStatus.DONE
