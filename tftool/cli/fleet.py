"""Many recordings, judged by several processes at once: a row a finding."""

import csv
import json
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from tftool.errors import InputError, TftoolError, UsageError
from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.diagnostics.model import Settings
    from tftool.diagnostics.scope import Scope

COLUMNS = (
    "source", "id", "severity", "area", "message", "confidence", "because_of", "edges", "frames",
    "topics", "publishers", "since", "until", "count", "consequence", "fix", "command",
)  # fmt: skip
"""What a row tells; lists are JSON in a table."""

NONE_FOUND = "none"
"""The id of the one row of a source in which nothing was found."""

UNREADABLE = "unreadable"
"""The id of the one row of a source that cannot be read."""

Row = dict[str, object]


@dataclass(frozen=True, slots=True)
class Job:
    """What is done with each recording.

    Attributes:
        settings: What the listener is like.
        select: Checks to run.
        ignore: Checks to leave out.
        scope: What of a recording is looked at.
    """

    settings: "Settings"
    select: tuple[str, ...]
    ignore: tuple[str, ...]
    scope: "Scope"


def examined(path: str, job: Job) -> list[Row]:
    """One recording's findings as rows; what cannot be read is a row too, and raises nothing."""
    from tftool.diagnostics.judge import judge
    from tftool.sources.recording import open_recording

    try:
        with open_recording(path) as recording:
            material = job.scope.material(recording)
        diagnosis = judge(material, job.settings, select=job.select, ignore=job.ignore)
    except UsageError:
        raise
    except (TftoolError, OSError, MemoryError) as error:
        return [unreadable(path, str(error))]
    rows: list[Row] = []
    for one in diagnosis.findings:
        first = one.fixes[0] if one.fixes else None
        rows.append(
            {
                "source": path,
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
    return rows or [{"source": path, "id": NONE_FOUND, "message": "nothing found", "count": 0}]


def unreadable(path: str, why: str) -> Row:
    """The row of a source that cannot be read."""
    return {"source": path, "id": UNREADABLE, "severity": "error", "message": why, "count": 1}


class Output:
    """A file of rows, written as they come: one JSON object a line, or a table."""

    def __init__(self, path: Path, *, resume: bool) -> None:
        """Open it.

        Args:
            path: Its suffix says what is written: .jsonl or .csv.
            resume: Whether to keep what it holds, and go on.

        Raises:
            UsageError: If the suffix is another.
            InputError: If it cannot be opened, or what it holds is none of ours.
        """
        self.is_table = path.suffix.lower() == ".csv"
        if not self.is_table and path.suffix.lower() != ".jsonl":
            raise UsageError(f"'{path}' does not say what to write: end it in .jsonl or .csv.")
        self.done: frozenset[str] = frozenset()
        try:
            if resume and path.exists() and path.stat().st_size:
                self.done = frozenset(self._sources(path))
            self._file: TextIO = path.open("a" if self.done else "w", encoding="utf-8", newline="")
        except (OSError, ValueError, KeyError, TypeError) as error:
            reason = getattr(error, "strerror", None) or "it holds something else than rows"
            raise InputError(f"'{path}' cannot be gone on with: {reason}.") from error
        if self.is_table and not self.done:
            csv.writer(self._file).writerow(COLUMNS)

    def _sources(self, path: Path) -> Iterator[str]:
        whole = path.read_bytes()
        # A process that was killed may have left half a line.
        kept = whole[: whole.rfind(b"\n") + 1]
        if len(kept) < len(whole):
            path.write_bytes(kept)
        lines = kept.decode("utf-8").splitlines()
        if self.is_table:
            yield from (row["source"] for row in csv.DictReader(lines))
        else:
            yield from (json.loads(line)["source"] for line in lines if line)

    def write(self, rows: Sequence[Row]) -> None:
        """All rows of one source, at once."""
        if self.is_table:
            table = csv.writer(self._file)
            for row in rows:
                table.writerow([_cell(row.get(column)) for column in COLUMNS])
        else:
            text = "".join(f"{json.dumps(row, allow_nan=False)}\n" for row in rows)
            self._file.write(text)
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def _cell(value: object) -> object:
    if isinstance(value, list):
        return json.dumps(value) if value else ""
    if isinstance(value, str):
        # A name that a spreadsheet would take for a formula is none; lines stay lines.
        text = visible(value)
        return f"'{text}" if text[:1] in ("=", "+", "-", "@") else text
    return "" if value is None else value


def sweep(
    paths: Sequence[str],
    output: Output,
    processes: int,
    job: Job,
) -> dict[str, int]:
    """Judge many recordings, and write what is found as it comes.

    Args:
        paths: The recordings; those that the output holds already are passed over.
        output: Where rows go.
        processes: How many work at once.
        job: What is done with each.

    Returns:
        How many recordings there are of each worst severity; "unreadable" and "none" too.
    """
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

    left = [path for path in dict.fromkeys(paths) if path not in output.done]
    counts: dict[str, int] = {}
    columns = (
        TextColumn("Examining"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
        TextColumn("{task.fields[found]}"),
    )  # fmt: skip
    console = Console(stderr=True)
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        task = progress.add_task("", total=len(left), found="")
        for rows in _results(left, processes, job):
            output.write(rows)
            worst = _worst(rows)
            counts[worst] = counts.get(worst, 0) + 1
            progress.update(task, advance=1, found=told(counts))
    return counts


def _results(
    paths: Sequence[str],
    processes: int,
    job: Job,
) -> Iterator[list[Row]]:
    if processes == 1:
        for path in paths:
            yield examined(path, job)
        return
    waiting = list(paths)
    while waiting:
        # Spawned, not forked: a fork would carry over threads and locks.
        with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
            futures = _submitted(pool, waiting, job)
            finished: set[str] = set()
            try:
                for future in as_completed(futures):
                    rows = future.result()
                    finished.add(futures[future])
                    yield rows
                return
            except BrokenProcessPool:
                # One of those that were worked on ended its process: they are tried alone.
                waiting = [path for path in waiting if path not in finished]
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        yield from _alone(waiting[:processes], job)
        waiting = waiting[processes:]


def _submitted(
    pool: Executor,
    paths: Sequence[str],
    job: Job,
) -> dict[Future[list[Row]], str]:
    return {pool.submit(examined, path, job): path for path in paths}


def _alone(paths: Sequence[str], job: Job) -> Iterator[list[Row]]:
    """Each in a process of its own, so that one that ends it harms no other."""
    for path in paths:
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            try:
                yield pool.submit(examined, path, job).result()
            except BrokenProcessPool:
                yield [unreadable(path, "the process that read it was ended (memory?)")]


def _worst(rows: Sequence[Row]) -> str:
    if rows[0]["id"] in (UNREADABLE, NONE_FOUND):
        return str(rows[0]["id"])
    severities = {row["severity"] for row in rows if row.get("because_of") is None}
    return next((one for one in ("error", "warning", "note") if one in severities), NONE_FOUND)


def told(counts: dict[str, int]) -> str:
    """The counts in words."""
    words = {
        "error": "with errors",
        "warning": "with warnings",
        "note": "with notes only",
        NONE_FOUND: "fine",
        UNREADABLE: "unreadable",
    }
    return ", ".join(f"{counts[key]} {word}" for key, word in words.items() if key in counts)


def announce(counts: dict[str, int], passed_over: int, output: Path) -> None:
    """Say on stdout what came of a sweep."""
    total = sum(counts.values())
    over = f" ({passed_over} were in it already)" if passed_over else ""
    what = told(counts) or "nothing left to do"
    sys.stdout.write(f"{total} recordings: {what}. Rows are in {visible(str(output))}{over}.\n")
