"""Many recordings, worked on by one process, by several, or by a cluster: rows of facts.

There is one path for all three: an executor of `concurrent.futures`. A recording that
cannot be read is a row as well, and one that ends the process it is read by is tried again
alone.
"""

import glob
import os
import signal
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from tftool.cli.rows import ColumnKind, Row, RowFile
from tftool.errors import InputError, TftoolError, UsageError
from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.diagnostics.model import Settings
    from tftool.diagnostics.scope import Scope

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
"""What a row of a finding tells."""

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
"""What a row of a recording tells."""

NONE_FOUND = "none"
"""The id of the one row of a recording in which nothing was found."""

UNREADABLE = "unreadable"
"""The id of the one row of a recording that cannot be read."""

RECORDED_SUFFIXES = (".mcap", ".bag", ".db3", ".zstd")
"""Files of a glob that are meant as recordings, whatever is in them."""

_ON_CLUSTER = 512
"""Recordings that wait at a cluster at once."""


class FleetTask(Protocol):
    """What is done with each recording; it is sent to other processes."""

    @property
    def columns(self) -> Mapping[str, ColumnKind]:
        """What a row tells."""

    def rows(self, source: str, place: str) -> list[Row]:
        """The rows of one recording; what cannot be read is a row too, and raises nothing.

        Args:
            source: What to call it.
            place: Where it is.
        """

    def unreadable(self, source: str, why: str) -> Row:
        """The row of a recording that cannot be read."""

    def outcome(self, rows: Sequence[Row]) -> str:
        """What came of a recording, in a word of `told`."""


@dataclass(frozen=True, slots=True)
class Examination:
    """The doctor's task.

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

    @property
    def columns(self) -> Mapping[str, ColumnKind]:
        """What a row tells."""
        return FINDINGS

    def rows(self, source: str, place: str) -> list[Row]:
        """One recording's findings."""
        return _told(self, source, place, partial(self._examined, source))

    def _examined(self, source: str, path: str) -> list[Row]:
        from tftool.diagnostics.judge import judge
        from tftool.scenario.doctoring import rules_beside
        from tftool.sources.recording import open_recording

        rules, _ = rules_beside(path)
        with open_recording(path) as recording:
            material = self.scope.material(recording)
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
        """The row of a recording that cannot be read."""
        return {
            "source": source,
            "id": UNREADABLE,
            "severity": "error",
            "message": why,
            "count": 1,
        }

    def outcome(self, rows: Sequence[Row]) -> str:
        """The worst severity among what is no consequence."""
        if rows[0]["id"] in (UNREADABLE, NONE_FOUND):
            return str(rows[0]["id"])
        severities = {row["severity"] for row in rows if row.get("because_of") is None}
        return next((one for one in ("error", "warning", "note") if one in severities), NONE_FOUND)


@dataclass(frozen=True, slots=True)
class Inventory:
    """The task of `info`: a row a recording."""

    @property
    def columns(self) -> Mapping[str, ColumnKind]:
        """What a row tells."""
        return FACTS

    def rows(self, source: str, place: str) -> list[Row]:
        """What one recording holds."""
        return _told(self, source, place, partial(self._listed, source))

    @staticmethod
    def _listed(source: str, path: str) -> list[Row]:
        from tftool.diagnostics.material import Material
        from tftool.diagnostics.model import Model
        from tftool.sources.recording import open_recording

        with open_recording(path) as recording:
            held, transforms = recording.source, recording.transforms
            model = Model(Material(source, held.kind, transforms, start=held.start, end=held.end))
            row = {
                "source": source,
                "kind": held.kind,
                "bytes": held.size,
                "start": held.start,
                "end": held.end,
                "seconds": (held.end - held.start) / 1e9,
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
        """The row of a recording that cannot be read."""
        return {"source": source, "unreadable": why}

    def outcome(self, rows: Sequence[Row]) -> str:
        """Whether it can be read, and whole."""
        if rows[0].get("unreadable") is not None:
            return UNREADABLE
        return "damaged" if rows[0]["damage"] else "whole"


def _told(task: FleetTask, source: str, place: str, work: Callable[[str], list[Row]]) -> list[Row]:
    """What a task found in a recording, wherever that is; what cannot be read is a row."""
    from tftool.sources.remote import fetched

    try:
        with fetched(place) as path:
            return work(path)
    except UsageError:
        raise
    except (TftoolError, OSError, MemoryError) as error:
        return [task.unreadable(source, str(error) or type(error).__name__)]


# Who works


class Workers(Protocol):
    """Where the work is done.

    Attributes:
        count: How many recordings are worked on at once.
        window: How many are handed over at once.
        place: Where a recording is, for the workers.
    """

    count: int
    window: int

    def open(self) -> AbstractContextManager[Executor]:
        """An executor; a second one, after the first one broke."""

    def place(self, source: str) -> str:
        """Where a recording is, for those who open it."""


class OneProcess:
    """This process does all of it."""

    count = window = 1

    def open(self) -> AbstractContextManager[Executor]:
        """An executor that works when it is asked to."""
        return _Here()

    def place(self, source: str) -> str:
        """As it was named."""
        return source


class _Here(Executor):
    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


class Processes:
    """Several processes of this machine.

    Args:
        count: How many.
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self.window = 4 * count

    def open(self) -> AbstractContextManager[Executor]:
        """A pool of them."""
        # Spawned, not forked: a fork would carry over threads and locks.
        return ProcessPoolExecutor(
            self.count, mp_context=get_context("spawn"), initializer=_end_with_ctrl_c
        )

    def place(self, source: str) -> str:
        """As it was named."""
        return source


def _end_with_ctrl_c() -> None:
    """Ctrl-C goes to all processes of a terminal; these end by it, and say nothing."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Cluster:
    """A cluster of Dask workers.

    Args:
        address: Of its scheduler.
    """

    count = 1
    window = _ON_CLUSTER

    def __init__(self, address: str) -> None:
        self.address = address

    def open(self) -> AbstractContextManager[Executor]:
        """An executor of the cluster."""
        from tftool.cli.cluster import connected

        return connected(self.address)

    def place(self, source: str) -> str:
        """From the root of the file system, which all of them share."""
        from tftool.sources.remote import is_url

        return source if is_url(source) else os.path.abspath(source)


def workers_of(processes: int, scheduler: str) -> Workers:
    """Who works, by the options of a command.

    Raises:
        UsageError: If both say it.
    """
    if not scheduler:
        return OneProcess() if processes == 1 else Processes(processes)
    if processes != 1:
        raise UsageError("--scheduler says who works: leave out --jobs.")
    return Cluster(scheduler)


# The work


def sweep(
    sources: Sequence[str], output: RowFile | None, workers: Workers, task: FleetTask
) -> tuple[dict[str, int], list[Row]]:
    """Work on many recordings, and write what is found as it comes.

    Args:
        sources: The recordings; those that the output holds already are passed over.
        output: Where rows go; None to get them back.
        workers: Who works.
        task: What is done with each.

    Returns:
        How many recordings there are of each outcome, and the rows if there is no output.
    """
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

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
            progress.update(bar, advance=1, found=told(counts))
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
                # One of those that were worked on ended its process: they are tried alone.
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
    """What comes of each, as it comes.

    Raises:
        BrokenExecutor: If a process was ended; what others had finished came before.
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
    """Why a worker of a cluster failed with one recording.

    Raises:
        UsageError: If it cannot do this work at all.
        InputError: If the cluster is gone: nothing is wrong with the recording.
    """
    if isinstance(error, ModuleNotFoundError) and (error.name or "").startswith("tftool"):
        raise UsageError("The workers of the cluster do not have this tftool installed.") from error
    if type(error).__name__ == "KilledWorker":
        return "the workers that read it were ended (memory?)"
    if isinstance(error, CancelledError) or type(error).__module__.startswith("distributed"):
        raise InputError(
            "The connection with the cluster was lost: --resume goes on with what is left."
        ) from error
    return f"{type(error).__name__}: {error}"


def _alone(source: str, task: FleetTask) -> list[Row]:
    """In a process of its own, so that one that ends it harms no other."""
    with Processes(1).open() as pool:
        try:
            return pool.submit(task.rows, source, source).result()
        except BrokenExecutor:
            return [task.unreadable(source, "the process that read it was ended (memory?)")]


# Which recordings, and what came of them


def expanded(words: Sequence[str]) -> list[str]:
    """The recordings that files, folders, globs and URLs name, each once.

    Of a glob, files with the ending of a recording are meant as recordings, even if they
    cannot be read.

    Raises:
        InputError: If a glob or a folder of the web names nothing, or cannot be listed.
    """
    from tftool.cli.hosting import named
    from tftool.sources.find import METADATA, Kind
    from tftool.sources.remote import is_url, listed

    found: list[str] = []
    for word in words:
        if is_url(word):
            found += listed(word)
            continue
        if glob.has_magic(word) and not os.path.lexists(word):
            matches = sorted(glob.glob(word, recursive=True))
            found += [
                match
                for match in matches
                if match.lower().endswith(RECORDED_SUFFIXES)
                or (Path(match) / METADATA).exists()
                or (os.path.isfile(match) and _is_recording(match))
            ]
            if not matches:
                raise InputError(f"No file is named by '{visible(word)}'.")
            continue
        try:
            what = named(word)
        except InputError:
            found.append(word)
            continue
        several = what.kind is Kind.SEVERAL
        found += [str(path) for path in what.paths] if several else [word]
    return list(dict.fromkeys(found))


def _is_recording(path: str) -> bool:
    from tftool.sources.find import kind_of_file

    try:
        return kind_of_file(Path(path)).is_recording
    except InputError:
        return False


def told(counts: dict[str, int]) -> str:
    """The counts in words."""
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


def announce(counts: dict[str, int], passed_over: int, output: Path) -> None:
    """Say on stdout what came of a sweep."""
    total = sum(counts.values())
    over = f" ({passed_over:,} were in it already)" if passed_over else ""
    what = told(counts) or "nothing left to do"
    name = "recording" if total == 1 else "recordings"
    sys.stdout.write(f"{total:,} {name}: {what}. Rows are in {visible(str(output))}{over}.\n")


def swept_into(
    words: Sequence[str], path: Path, workers: Workers, task: FleetTask, *, resume: bool
) -> dict[str, int]:
    """Work on many recordings, write a file of rows, and say what came of it.

    Returns:
        How many recordings there are of each outcome.
    """
    sources = expanded(words)
    if not sources:
        raise UsageError("Name the recordings: files, folders, globs, URLs.")
    output = RowFile(path, task.columns, resume=resume)
    try:
        counts, _ = sweep(sources, output, workers, task)
    finally:
        output.close()
    announce(counts, sum(output.holds(source) for source in sources), path)
    return counts
