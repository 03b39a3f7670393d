"""The turtlesim vectors by section; a section that no test reads is an error."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

FILE = Path(__file__).parents[2] / "reference" / "turtlesim_vectors.yaml"
FORMAT = "tftool-turtlesim-vectors/1"

TESTED_IN = {
    "constants": "test_vectors_constants",
    "normalize_angle": "test_vectors_constants",
    "teleop_keys": "test_vectors_programs",
    "teleop_banner": "test_vectors_programs",
    "mimic": "test_vectors_programs",
    "static_turtle_cli": "test_vectors_programs",
    "draw_square": "test_vectors_programs",
    "carrot": "test_vectors_programs",
    "open_loop": "test_vectors_simulator",
    "teleop_sequence": "test_vectors_simulator",
    "teleport": "test_vectors_simulator",
    "rotate_absolute": "test_vectors_simulator",
    "spawn_sequence": "test_vectors_simulator",
    "pen_sequence": "test_vectors_simulator",
    "follower": "test_vectors_follower",
    "launch_timeline": "test_vectors_follower",
    "time_travel": "test_vectors_follower",
    "leader_lost": "test_vectors_follower",
    "coincidence": "test_vectors_transforms",
    "control_law": "test_vectors_transforms",
    "full_lookup": "test_vectors_transforms",
    "pid": "test_vectors_transforms",
    "static_A_B": "test_vectors_transforms",
    "robot_chain": "test_vectors_transforms",
    "euler_to_quaternion": "test_vectors_transforms",
    "tree_statistics": "test_vectors_transforms",
    "stale_fade": "../../screens/browser/test_page",
}
"""Module of this folder that runs all cases of a section, by the section's name."""

_HEAD = {"format", "tolerances"}


def load(text: str) -> dict[str, Any]:
    """Read the vectors; raise an error for contents that no test reads."""
    vectors = yaml.safe_load(text)
    if vectors["format"] != FORMAT:
        raise ValueError(f"vectors of format {vectors['format']} are not known")
    unknown = set(vectors) - set(TESTED_IN) - _HEAD
    missing = set(TESTED_IN) | _HEAD
    missing -= set(vectors)
    if unknown or missing:
        raise ValueError(f"sections nobody tests: {unknown}; sections that are gone: {missing}")
    return vectors


VECTORS = load(FILE.read_text(encoding="utf-8"))
STRICT = VECTORS["tolerances"]["strict"]


def rows(case: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the rows of a case as mappings from column names to values."""
    return [dict(zip(case["columns"], row, strict=True)) for row in case["rows"]]


def ids(cases: Sequence[Mapping[str, Any]]) -> list[str]:
    return [str(case.get("id", number)) for number, case in enumerate(cases)]


def close(found: float, expected: float, what: str) -> bool:
    """Return whether a number is within the strict tolerance; angles are compared modulo a turn."""
    difference = found - expected
    if what in ("theta", "angular"):
        difference = math.remainder(difference, math.tau)
    return abs(difference) <= STRICT[what]


def mismatch(found: Mapping[str, float], row: Mapping[str, Any]) -> str:
    """Return the differences from a row's pose and velocity as text; empty if there are none."""
    kinds = {
        "x": "xy",
        "y": "xy",
        "theta": "theta",
        "linear_velocity": "linear",
        "angular_velocity": "angular",
    }
    return "; ".join(
        f"{name}: {found[name]} for {row[name]}"
        for name, kind in kinds.items()
        if name in row and not close(found[name], row[name], kind)
    )
