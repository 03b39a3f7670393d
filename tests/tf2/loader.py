"""The tf2 vectors, case by case, and their tolerance."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import yaml

FILE = Path(__file__).parent.parent / "reference" / "tf2_vectors.yaml"
FORMAT = "tf2-vectors/1"


def load(text: str) -> dict[str, Any]:
    """Read the vectors; the C parser, if it is installed, is ten times as fast."""
    vectors = yaml.load(text, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    if vectors["format"] != FORMAT:
        raise ValueError(f"vectors of format {vectors['format']} are not known")
    return vectors


VECTORS = load(FILE.read_text(encoding="utf-8"))
CASES: list[dict[str, Any]] = VECTORS["cases"]
CACHE: int = VECTORS["default_cache_ns"]
DEFAULT: float = VECTORS["tolerance"]["default"]
VELOCITY: float = VECTORS["tolerance"]["velocity"]


class Unknown(Exception):
    """Error for contents of the vectors that no test reads."""


def fields(step: Mapping[str, Any], *known: str) -> None:
    """Raise an error for fields of a step that its runner does not read."""
    more = set(step) - {"op", "note", "note_versions", "msg_jazzy_and_older", *known}
    if more:
        raise Unknown(f"fields nobody reads: {sorted(more)} in {step}")


def close(found: Iterable[float], wanted: Iterable[float], tolerance: float = DEFAULT) -> bool:
    """Return whether both lists have equal lengths, and values within the tolerance."""
    return all(
        abs(one - other) <= tolerance * max(1.0, abs(other))
        for one, other in zip(found, wanted, strict=True)
    )


def negated(numbers: Iterable[float]) -> list[float]:
    return [-number for number in numbers]
