"""`tftool doctor`: what is wrong with the frames, why, and what to do about it."""

import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, seconds
from tftool.commands.doctor.options import FailOn
from tftool.commands.fleet import fleet, fleet_tasks
from tftool.commands.fleet.fleet import expanded
from tftool.commands.fleet.workers import workers_of
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.evidence_sources import material_of, rules_of
from tftool.commands.shared.notices import complain
from tftool.commands.shared.printer import line_width, write, write_file
from tftool.doctor.check import Check
from tftool.doctor.evidence import Scope, described_by
from tftool.doctor.findings import Severity
from tftool.doctor.judge import CHECKS, Diagnosis, judge, refuse_unknown, unknown
from tftool.doctor.model import Settings
from tftool.drawing import finding_view as view
from tftool.frames.moment import At
from tftool.recordings.remote_files import fetched


def _refuse_reports(given: dict[str, bool]) -> None:
    """Refuse reports for which there is no room beside rows in a file.

    Raises:
        UsageError: If one is asked for.
    """
    asked = " and ".join(name for name, is_given in given.items() if is_given)
    if asked:
        raise UsageError(f"-o writes rows, and {asked} another report: leave one out.")


def _print(rows: Sequence[tuple[str, Diagnosis | str]], *, verbose: bool, statistics: bool) -> None:
    """Each diagnosis for a person; of several sources, what differs at the end."""
    diagnoses = [found for _, found in rows if not isinstance(found, str)]
    for number, one in enumerate(diagnoses):
        if number:
            sys.stdout.write("\n")
        write(view.render(one, verbose=verbose))
        if statistics:
            write(view.statistics(one.model))
    if len(rows) > 1:
        sys.stdout.write("\n")
        write(view.compared(rows))


def _diagnosed(
    connection: Connection,
    places: Sequence[str | None],
    lasting: Duration | None,
    settings: Settings,
    select: Sequence[str],
    ignore: Sequence[str],
    scope: Scope,
) -> "list[tuple[str, Diagnosis | str]]":
    """Each source with what was found in it; of several, one that is unreadable stops none."""
    chosen, left_out = _words(select), _words(ignore)
    words = [place for place in places if place is not None]
    sources: list[str | None] = [*expanded(words)] if words else [None]
    rows: list[tuple[str, Diagnosis | str]] = []
    for word in sources:
        try:
            with fetched(word or "") as path:
                rules = rules_of(path or None)
                material = material_of(connection, path or None, lasting, scope)
        except InputError as error:
            if len(sources) == 1:
                raise
            complain("tftool doctor", str(error))
            rows.append((word or "", str(error)))
            continue
        if path != (word or ""):
            material = replace(material, name=word or "")
        diagnosis = judge(
            material,
            rules.settings(settings),
            select=chosen,
            ignore=(*left_out, *rules.ignore),
        )
        rows.append((word or material.name, diagnosis))
    return rows


def _swept_status(counts: dict[str, int], fails: Severity | None) -> ExitStatus:
    """Of many recordings, the worst."""
    if fleet_tasks.UNREADABLE in counts:
        return ExitStatus.UNREADABLE
    bad = [name for name in ("error", "warning", "note") if name in counts]
    found = fails is not None and any(_rank(name) <= fails.rank for name in bad)
    return ExitStatus.FAILED if found else ExitStatus.DONE


def _rank(name: str) -> int:

    return Severity(name).rank


def _status(rows: Sequence[tuple[str, Diagnosis | str]], fails: Severity | None) -> ExitStatus:
    """The worst of all sources."""
    if any(isinstance(found, str) for _, found in rows):
        return ExitStatus.UNREADABLE
    worst = [found.worst for _, found in rows if not isinstance(found, str)]
    if fails is not None and any(one is not None and one.rank <= fails.rank for one in worst):
        return ExitStatus.FAILED
    return ExitStatus.DONE


def _check(name: str) -> Check:

    if name not in CHECKS:
        raise UsageError(unknown(name, list(CHECKS), "check"))
    return CHECKS[name]


def _words(options: Sequence[str]) -> list[str]:
    return [word.strip() for option in options for word in option.split(",") if word.strip()]


def _settings(
    cache_time: Duration | None,
    fixed_frame: str,
    limits: Sequence[str],
    tf_topics: Sequence[str],
) -> Settings:

    given: dict[str, dict[str, float]] = {}
    for text in limits:
        name, _, value = text.partition("=")
        check, _, limit = name.partition(".")
        try:
            number = float(value)
        except ValueError:
            number = -1.0
        if not limit or not 0.0 <= number < float("inf"):
            raise UsageError(
                f"--limit {text}: write ID.NAME=VALUE with a number from 0 on, as in gap.seconds=2"
            )
        given.setdefault(check, {})[limit] = number
    return Settings(cache_time or seconds(10), fixed_frame, tuple(tf_topics), given)


def run(
    connection: Connection,
    places: list[str] | None,
    select: list[str] | None,
    ignore: list[str] | None,
    fail_on: FailOn,
    limits: list[str] | None,
    cache_time: int | None,
    fixed_frame: str,
    tf_topic: list[str] | None,
    begin: At | None,
    end: At | None,
    lasting: int | None,
    statistics: bool,
    verbose: bool,
    for_programs: bool,
    markdown: bool,
    junit: Path | None,
    output: Path | None,
    processes: int,
    resume: bool,
    scheduler: str,
    explain: str,
    listed: bool,
) -> ExitStatus:
    """Run `tftool doctor`; the parameters are its options."""
    # Heavy imports wait until this command is the chosen one.

    if listed:
        if markdown:
            sys.stdout.write(view.as_page())
        else:
            write(view.listing())
        return ExitStatus.DONE
    if explain:
        sys.stdout.write(view.explained(_check(explain), line_width()))
        return ExitStatus.DONE
    if for_programs and markdown:
        raise UsageError("--json and --markdown are two ways to print it: leave one out.")
    settings = _settings(cache_time, fixed_frame, limits or (), tf_topic or ())
    urdf = connection.robot.urdf
    scope = Scope(None if urdf is None else described_by(urdf), settings.tf_topics, begin, end)
    fails = None if fail_on is FailOn.never else Severity(fail_on.value)
    if output is not None:
        _refuse_reports(
            {
                "--junit": junit is not None,
                "--json": for_programs,
                "--markdown": markdown,
                "--verbose": verbose,
                "--statistics": statistics,
            }
        )
        chosen, left_out = tuple(_words(select or ())), tuple(_words(ignore or ()))
        refuse_unknown(settings, chosen, left_out)
        task = fleet_tasks.Examination(settings, chosen, left_out, scope)
        workers = workers_of(processes, scheduler)
        counts = fleet.swept_into(places or (), output, workers, task, resume=resume)
        return _swept_status(counts, fails)
    if resume or processes > 1 or scheduler:
        raise UsageError("--jobs, --resume and --scheduler make rows: add -o FILE.")
    rows = _diagnosed(
        connection, places or [None], lasting, settings, select or (), ignore or (), scope
    )
    diagnoses = [found for _, found in rows if not isinstance(found, str)]
    if for_programs:
        objects = [view.as_object(one) for one in diagnoses]
        content = objects[0] if len(rows) == 1 and objects else objects
        sys.stdout.write(json.dumps(content, indent=2, allow_nan=False, default=str) + "\n")
    elif markdown:
        sys.stdout.write("\n".join(view.as_markdown(one) for one in diagnoses))
    else:
        _print(rows, verbose=verbose, statistics=statistics)
    if junit is not None:
        write_file(junit, view.as_junit(rows, fails))
    return _status(rows, fails)
