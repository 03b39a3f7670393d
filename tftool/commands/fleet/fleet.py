"""Processing of many recordings in one process, several processes, or a cluster.

Each variant is an executor of `concurrent.futures`. Results are rows of a table. A recording that
cannot be read also gets a row. After the crash of a process, each recording that may have caused
the crash is tried again in a new process.
"""

import glob
import math
import os
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from tftool.base.errors import InputError, TftoolError, UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import as_seconds
from tftool.commands.fleet.rows import ColumnKind, Row, RowFile
from tftool.commands.fleet.workers import Workers, processes
from tftool.commands.shared.evidence_sources import refuse_part
from tftool.commands.shared.notices import notice
from tftool.doctor.evidence import Evidence, evidence_of_frames, evidence_of_recording
from tftool.doctor.judge import judge
from tftool.doctor.model import Model
from tftool.opener import named, open_frames, scenario_named
from tftool.recordings.containers import SUFFIXES
from tftool.recordings.find import METADATA, Kind, fetched, is_url, kind_of_file, listed
from tftool.recordings.recording import open_recording
from tftool.scenario.doctor_expectations import rules_beside

if TYPE_CHECKING:
    from tftool.doctor.evidence import Scope
    from tftool.doctor.model import Settings


_TEXT, _TEXTS, _INTEGER, _NUMBER = (
    ColumnKind.TEXT,
    ColumnKind.TEXTS,
    ColumnKind.INTEGER,
    ColumnKind.NUMBER,
)

FINDINGS: Mapping[str, ColumnKind] = {
    "source": _TEXT,
    "id": _TEXT,
    "severity": _TEXT,
    "area": _TEXT,
    "message": _TEXT,
    "confidence": _TEXT,
    "because_of": _TEXT,
    "edges": ColumnKind.EDGES,
    "frames": _TEXTS,
    "topics": _TEXTS,
    "publishers": _TEXTS,
    "since": _INTEGER,
    "until": _INTEGER,
    "count": _INTEGER,
    "consequence": _TEXT,
    "fix": _TEXT,
    "command": _TEXT,
}
"""Columns of a finding's row."""


FACTS: Mapping[str, ColumnKind] = {
    "source": _TEXT,
    "kind": _TEXT,
    "bytes": _INTEGER,
    "start": _INTEGER,
    "end": _INTEGER,
    "seconds": _NUMBER,
    "messages": _INTEGER,
    "topics": _TEXTS,
    "transforms": _INTEGER,
    "edges": ColumnKind.EDGES,
    "frames": _INTEGER,
    "trees": _INTEGER,
    "damage": _TEXTS,
    "unreadable": _TEXT,
}
"""Columns of a recording's row."""

NONE_FOUND = "none"
"""Id of the single row of a recording without findings."""

UNREADABLE = "unreadable"
"""Id of the single row of a recording that cannot be read."""


class FleetTask:
    """Task to run on each of many recordings; a task can be pickled for other processes.

    Attributes:
        columns: Names and types of the columns of a row.
        outcome_columns: Names of those columns that `outcome` reads.
    """

    __slots__ = ()

    columns: ClassVar[Mapping[str, ColumnKind]]
    outcome_columns: ClassVar[Sequence[str]]

    def rows(self, source: str, address: str) -> list[Row]:
        """Return the rows of one recording; an unreadable recording gives one row, not an error.

        Args:
            source: Name of the recording in the rows.
            address: Path or URL of the recording.
        """
        try:
            with fetched(address) as path:
                return self.read(source, path)
        except UsageError:
            raise
        except (TftoolError, OSError, MemoryError) as error:
            return [self.unreadable(source, str(error) or type(error).__name__)]

    def read(self, source: str, path: str) -> list[Row]:
        """Examine one recording in this process; return the rows of the result table."""
        raise NotImplementedError

    def unreadable(self, source: str, why: str) -> Row:
        """Return the row of an unreadable recording; `why` is the error message."""
        raise NotImplementedError

    def outcome(self, rows: Sequence[Row]) -> str:
        """Return the outcome of one recording, such as "error", computed from its rows."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Examination(FleetTask):
    """Task of `tftool doctor`: examine one recording, with one row for each finding.

    Attributes:
        settings: Settings with which the doctor judges.
        select: Checks to run; all if empty.
        ignore: Checks not to run.
        scope: Part of a recording to examine.
    """

    columns = FINDINGS
    outcome_columns = ("id", "severity", "because_of")

    settings: "Settings"
    select: tuple[str, ...]
    ignore: tuple[str, ...]
    scope: "Scope"

    def read(self, source: str, path: str) -> list[Row]:
        """Return a row for each finding of one recording or scenario."""
        if named(path).kind is Kind.SCENARIO:
            refuse_part(self.scope)
            rules = scenario_named(path).doctor
            material = evidence_of_frames(open_frames(path, until=math.inf), self.scope)
        else:
            rules, _ = rules_beside(path)
            with open_recording(path) as recording:
                material = evidence_of_recording(recording, self.scope)
        diagnosis = judge(
            material,
            rules.settings(self.settings),
            select=self.select,
            ignore=(*self.ignore, *rules.ignore),
        )
        rows: list[Row] = []
        for one in diagnosis.findings:
            first = one.fixes[0] if one.fixes else None
            rows.append(
                {
                    "source": source,
                    "id": one.id,
                    "severity": one.severity.value,
                    "area": one.area.value,
                    "message": one.message,
                    "confidence": one.confidence.value,
                    "because_of": one.because_of,
                    "edges": [list(edge) for edge in one.edges],
                    "frames": list(one.frames),
                    "topics": list(one.topics),
                    "publishers": list(one.publishers),
                    "since": one.since,
                    "until": one.until,
                    "count": one.count,
                    "consequence": one.consequence,
                    "fix": first.text if first else "",
                    "command": first.command if first else "",
                }
            )
        return rows or [
            {"source": source, "id": NONE_FOUND, "message": "nothing found", "count": 0}
        ]

    def unreadable(self, source: str, why: str) -> Row:
        """Return the row of an unreadable recording."""
        return {
            "source": source,
            "id": UNREADABLE,
            "severity": "error",
            "message": why,
            "count": 1,
        }

    def outcome(self, rows: Sequence[Row]) -> str:
        """Return the worst severity of a recording's findings, such as "warning".

        Findings that are consequences of other findings do not count.
        """
        if rows[0]["id"] in (UNREADABLE, NONE_FOUND):
            return str(rows[0]["id"])
        severities = {row["severity"] for row in rows if row.get("because_of") is None}
        return next((one for one in ("error", "warning", "note") if one in severities), NONE_FOUND)


@dataclass(frozen=True, slots=True)
class Inventory(FleetTask):
    """Task of `tftool info`: describe the contents of one recording in one row."""

    columns = FACTS
    outcome_columns = ("damage", "unreadable")

    def read(self, source: str, path: str) -> list[Row]:
        """Return the row of one recording."""
        with open_recording(path) as recording:
            held, transforms = recording.source, recording.transforms
            model = Model(Evidence(source, held.kind, transforms, start=held.start, end=held.end))
            row = {
                "source": source,
                "kind": held.kind,
                "bytes": held.size,
                "start": held.start,
                "end": held.end,
                "seconds": as_seconds(held.end - held.start),
                "messages": sum(topic.count for topic in held.topics),
                "topics": [topic.name for topic in held.topics],
                "transforms": len(transforms),
                "edges": [[edge.parent, edge.child] for edge in transforms.edges],
                "frames": len(model.frames),
                "trees": len(model.trees),
                "damage": list(recording.damage),
                "unreadable": None,
            }
        return [row]

    def unreadable(self, source: str, why: str) -> Row:
        """Return the row of an unreadable recording."""
        return {"source": source, "unreadable": why}

    def outcome(self, rows: Sequence[Row]) -> str:
        """Return the outcome of one recording: "whole", "damaged" or "unreadable"."""
        if rows[0].get("unreadable") is not None:
            return UNREADABLE
        return "damaged" if rows[0]["damage"] else "whole"


# The work


def sweep(
    sources: Sequence[str], output: RowFile | None, workers: Workers, task: FleetTask
) -> tuple[dict[str, int], list[Row]]:
    """Run a task on many recordings; write the rows of a recording when the recording is finished.

    Args:
        sources: Paths or URLs; a recording that already has rows in `output` is skipped.
        output: File for the rows; None to return the rows.
        workers: Executor to use.
        task: Task to run on each recording.

    Returns:
        Number of recordings by outcome; list of all rows, empty if `output` is given.
    """
    left = [
        source for source in dict.fromkeys(sources) if output is None or not output.holds(source)
    ]
    counts: dict[str, int] = {}
    kept: dict[str, list[Row]] = {}
    columns = (
        TextColumn("Examining"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
        TextColumn("{task.fields[found]}"),
    )  # fmt: skip
    console = Console(stderr=True)
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        bar = progress.add_task("", total=len(left), found="")
        for source, rows in _results(left, workers, task):
            if output is None:
                kept[source] = rows
            else:
                output.write(rows)
            outcome = task.outcome(rows)
            counts[outcome] = counts.get(outcome, 0) + 1
            progress.update(bar, advance=1, found=summary(counts))
    return counts, [row for source in left for row in kept.get(source, ())]


def _results(
    sources: Sequence[str], workers: Workers, task: FleetTask
) -> Iterator[tuple[str, list[Row]]]:
    waiting = list(sources)
    while waiting:
        finished: set[str] = set()
        with workers.open() as pool:
            try:
                for source, rows in _worked(pool, waiting, workers, task):
                    finished.add(source)
                    yield source, rows
                return
            except BrokenExecutor:
                # One of the pending recordings ended its process: each is tried in a new process.
                waiting = [source for source in waiting if source not in finished]
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        for source in waiting[: workers.count]:
            yield source, _alone(source, task)
        waiting = waiting[workers.count :]


def _worked(
    pool: Executor, sources: Sequence[str], workers: Workers, task: FleetTask
) -> Iterator[tuple[str, list[Row]]]:
    """Yield each recording and its rows when the recording is finished.

    Raises:
        BrokenExecutor: If a worker process was killed; raised after the results of the other
            workers are yielded.
    """
    queue = iter(sources)
    pending: dict[Future[list[Row]], str] = {}
    broken: BrokenExecutor | None = None
    while broken is None:
        for source in islice(queue, workers.window - len(pending)):
            pending[pool.submit(task.rows, source, workers.place(source))] = source
        if not pending:
            return
        done, _ = wait(pending, return_when=FIRST_COMPLETED)
        for future in done:
            source = pending.pop(future)
            try:
                rows = future.result()
            except BrokenExecutor as error:
                broken = error
                continue
            except UsageError:
                raise
            except Exception as error:
                rows = [task.unreadable(source, _failure(error))]
            yield source, rows
    raise broken


def _failure(error: Exception) -> str:
    """Return the reason why a cluster's worker failed on one recording.

    Raises:
        UsageError: If tftool is not installed on the cluster's workers.
        InputError: If the connection to the cluster is lost while recordings are processed.
    """
    if isinstance(error, ModuleNotFoundError) and (error.name or "").startswith("tftool"):
        raise UsageError(
            "The workers of the cluster do not have this version of tftool: install it on the "
            "workers."
        ) from error
    if type(error).__name__ == "KilledWorker":
        return "the workers that read this recording were killed (too little memory?)"
    if isinstance(error, CancelledError) or type(error).__module__.startswith("distributed"):
        raise InputError(
            "The connection to the cluster was lost: the same command with --resume processes "
            "the remaining recordings."
        ) from error
    return f"{type(error).__name__}: {error}"


def _alone(source: str, task: FleetTask) -> list[Row]:
    """Process a recording in a new process, so that a crash affects no other recording."""
    with processes(1) as pool:
        try:
            return pool.submit(task.rows, source, source).result()
        except BrokenExecutor:
            return [task.unreadable(source, "its process was killed (too little memory?)")]


# Which recordings, and what came of them


def expanded(names: Sequence[str]) -> list[str]:
    """Expand files, folders, globs and URLs into a list of recordings without duplicates.

    A file that matches a glob is included if the file has the suffix of a recording, even if the
    file cannot be read.

    Raises:
        InputError: If a glob or web folder has no matches, or cannot be listed.
    """
    found: list[str] = []
    for word in names:
        if is_url(word):
            found += listed(word)
            continue
        if glob.has_magic(word) and not os.path.lexists(word):
            matches = sorted(glob.glob(word, recursive=True))
            found += [
                match
                for match in matches
                if match.lower().endswith(SUFFIXES)
                or (Path(match) / METADATA).exists()
                or (os.path.isfile(match) and _is_recording(match))
            ]
            if not matches:
                raise InputError(f"No file matches '{visible(word)}'.")
            continue
        try:
            what = named(word)
        except InputError:
            found.append(word)
            continue
        several = what.kind is Kind.SEVERAL
        if several:
            for text in what.notices():
                notice(visible(text))
        found += [str(path) for path in what.paths] if several else [word]
    return list(dict.fromkeys(found))


def _is_recording(path: str) -> bool:
    try:
        return kind_of_file(Path(path)).is_recording
    except InputError:
        return False


def summary(counts: dict[str, int]) -> str:
    """Return the numbers of recordings by outcome as text: "3 with errors, 12 fine"."""
    words = {
        "error": "with errors",
        "warning": "with warnings",
        "note": "with notes only",
        NONE_FOUND: "fine",
        "whole": "whole",
        "damaged": "damaged",
        UNREADABLE: "unreadable",
    }
    return ", ".join(f"{counts[key]:,} {word}" for key, word in words.items() if key in counts)


def announce(counts: dict[str, int], earlier: dict[str, int], output: Path) -> None:
    """Print the number of recordings by outcome, in this run (`counts`) and before (`earlier`)."""
    total = sum(counts.values())
    passed = sum(earlier.values())
    over = f" ({passed:,} were in the file already: {summary(earlier)})" if passed else ""
    what = summary(counts) or "nothing left to do"
    name = "recording" if total == 1 else "recordings"
    sys.stdout.write(f"{total:,} {name}: {what}. Rows are in {visible(str(output))}{over}.\n")


def swept_into(
    names: Sequence[str], path: Path, workers: Workers, task: FleetTask, *, resume: bool
) -> dict[str, int]:
    """Process many recordings, write a file of rows, and print the summary.

    Returns:
        Number of recordings in the whole file, by outcome.
    """
    sources = expanded(names)
    if not sources:
        raise UsageError("Name the recordings: files, folders, globs, URLs.")
    output = RowFile(path, task.columns, task.outcome_columns, resume=resume)
    try:
        counts, _ = sweep(sources, output, workers, task)
    finally:
        output.close()
    earlier: dict[str, int] = Counter(
        task.outcome(output.earlier(source))
        for source in dict.fromkeys(sources)
        if output.holds(source)
    )
    announce(counts, earlier, path)
    return {key: counts.get(key, 0) + earlier.get(key, 0) for key in {**counts, **earlier}}
