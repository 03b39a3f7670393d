"""One question, one sample at a time, against Debian's tf2 in Python: interleaved, as ratios."""

import json
import os
import statistics
import subprocess
from pathlib import Path

from tests.differential.compare import PYTHON, missing

SIDE = Path(__file__).with_name("scalar_side.py")
TURNS = 15

# Workload, and how many times faster than Debian's ours is meant to be in the interpreter.
WORKLOADS = {
    "lookup, depth 2, latest": 1.5,
    "lookup, depth 2, recent": 1.5,
    "lookup, depth 2, any": None,
    "lookup, depth 5, latest": None,
    "lookup, depth 5, recent": None,
    "lookup, depth 5, any": None,
    "lookup, depth 5, any, 100000 samples": None,
    "lookup, depth 20, recent": None,
    "can, depth 5, recent": None,
    "insert, in order": 2.0,
    "insert, reversed": None,
}


class Process:
    """One side, kept alive; asked in turn with the other."""

    def __init__(self, side: str) -> None:
        root = Path(__file__).parents[2]
        self.process = subprocess.Popen(
            [PYTHON, str(SIDE), side],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONPATH": str(root)},
        )

    def run(self, workload: str) -> tuple[float, list[float]]:
        """Nanoseconds for one, and an answer."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(workload + "\n")
        self.process.stdin.flush()
        taken, answer = json.loads(self.process.stdout.readline())
        return taken, answer

    def end(self) -> None:
        self.process.communicate()


def agree(one: list[float], other: list[float]) -> bool:
    """Whether two answers are the same, up to the quaternion's sign."""
    near = [abs(a - b) <= 1e-9 * max(1.0, abs(b)) for a, b in zip(one, other, strict=True)]
    far = [abs(a + b) <= 1e-9 for a, b in zip(one[3:], other[3:], strict=True)]
    return all(near) or (all(near[:3]) and all(far))


def report() -> str:
    """Measure, and say it in a few lines."""
    if reason := missing():
        return f"scalar path: nothing to compare with, {reason}"
    lines = [
        f"scalar path, nanoseconds (median of {TURNS} turns each, {PYTHON})",
        f"  {'':<40}{'ours':>8}{'tf2_py':>8}{'ratio':>7}",
    ]
    ours, debian = Process("ours"), Process("debian")
    for workload, wanted in WORKLOADS.items():
        first, second = ours.run(workload)[1], debian.run(workload)[1]
        if not agree(first, second):
            lines.append(f"  {workload:<40} answers differ: {first} and {second}")
            continue
        taken = [(ours.run(workload)[0], debian.run(workload)[0]) for _ in range(TURNS)]
        mine, theirs = (statistics.median(side) for side in zip(*taken, strict=True))
        ratio = theirs / mine
        goal = "" if wanted is None else f"   meant: {wanted}" + (" missed" * (ratio < wanted))
        lines.append(f"  {workload:<40}{mine:8.0f}{theirs:8.0f}{ratio:7.2f}{goal}")
    ours.end()
    debian.end()
    return "\n".join(lines)
