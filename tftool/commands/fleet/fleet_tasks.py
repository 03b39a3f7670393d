"""Tasks run on each of many recordings, with table rows as results."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from tftool.base.errors import TftoolError, UsageError
from tftool.base.stamps import as_seconds
from tftool.commands.fleet.rows import ColumnKind, Row
from tftool.doctor.evidence import Evidence, evidence_of_recording
from tftool.doctor.judge import judge
from tftool.doctor.model import Model
from tftool.recordings.recording import open_recording
from tftool.recordings.remote_files import fetched
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


class FleetTask:
    """A task for one recording; it is pickled for other processes.

    Attributes:
        columns: The columns of a row.
        judged: Names of the columns that `outcome` reads.
    """

    __slots__ = ()

    columns: ClassVar[Mapping[str, ColumnKind]]
    judged: ClassVar[Sequence[str]]

    def rows(self, source: str, place: str) -> list[Row]:
        """Return the rows of one recording; an unreadable one gives a row too, and raises nothing.

        Args:
            source: Name.
            place: Path or URL.
        """
        try:
            with fetched(place) as path:
                return self.read(source, path)
        except UsageError:
            raise
        except (TftoolError, OSError, MemoryError) as error:
            return [self.unreadable(source, str(error) or type(error).__name__)]

    def read(self, source: str, path: str) -> list[Row]:
        """Return the rows of a recording on this machine."""
        raise NotImplementedError

    def unreadable(self, source: str, why: str) -> Row:
        """Return the row of an unreadable recording."""
        raise NotImplementedError

    def outcome(self, rows: Sequence[Row]) -> str:
        """Return the outcome for one recording, a word that `told` counts."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Examination(FleetTask):
    """Task of `doctor`: a row for each finding.

    Attributes:
        settings: Settings of the listener.
        select: Checks to run.
        ignore: Checks to leave out.
        scope: Part of a recording to examine.
    """

    columns = FINDINGS
    judged = ("id", "severity", "because_of")

    settings: "Settings"
    select: tuple[str, ...]
    ignore: tuple[str, ...]
    scope: "Scope"

    def read(self, source: str, path: str) -> list[Row]:
        """Return a row for each finding of one recording."""
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
        """Return the worst severity among findings that are not consequences of others."""
        if rows[0]["id"] in (UNREADABLE, NONE_FOUND):
            return str(rows[0]["id"])
        severities = {row["severity"] for row in rows if row.get("because_of") is None}
        return next((one for one in ("error", "warning", "note") if one in severities), NONE_FOUND)


@dataclass(frozen=True, slots=True)
class Inventory(FleetTask):
    """Task of `info`: one row per recording."""

    columns = FACTS
    judged = ("damage", "unreadable")

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
        """Return whether the recording is readable and complete."""
        if rows[0].get("unreadable") is not None:
            return UNREADABLE
        return "damaged" if rows[0]["damage"] else "whole"
