"""Baseline of the doctor: findings of an earlier report, which no longer count as failures."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from tftool.base.errors import InputError
from tftool.base.escaping import visible
from tftool.doctor.findings import fingerprint
from tftool.doctor.judge import Diagnosis


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
