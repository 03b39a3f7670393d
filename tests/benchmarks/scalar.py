"""One question, one sample at a time, against Debian's tf2 in Python: interleaved, as ratios."""

import json
import os
import statistics
import subprocess
from pathlib import Path

from tests.differential.compare import PYTHON, missing

SIDE = Path(__file__).with_name("scalar_side.py")
ROOT = Path(__file__).parents[2]
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

    def __init__(self, side: str, root: Path) -> None:
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
    """Measure, and say it in a few lines.

    With TFTOOL_COMPILED naming a folder the compiled build was installed into
    (`TFTOOL_COMPILE=1 pip install --target FOLDER .`), that build is measured in the same turns.
    """
    if reason := missing():
        return f"scalar path: nothing to compare with, {reason}"
    roots = {"ours": ROOT}
    if folder := os.environ.get("TFTOOL_COMPILED"):
        roots["compiled"] = Path(folder)
    sides = {name: Process("ours", root) for name, root in roots.items()}
    sides["tf2_py"] = Process("debian", ROOT)
    lines = [
        f"scalar path, nanoseconds (median of {TURNS} turns each, {PYTHON})",
        f"  {'':<40}" + "".join(f"{name:>10}" for name in sides) + "   times as fast",
    ]
    for workload, wanted in WORKLOADS.items():
        *answers, theirs = [side.run(workload)[1] for side in sides.values()]
        if not all(agree(answer, theirs) for answer in answers):
            lines.append(f"  {workload:<40} answers differ: {answers} and {theirs}")
            continue
        turns = [[side.run(workload)[0] for side in sides.values()] for _ in range(TURNS)]
        taken = [statistics.median(side) for side in zip(*turns, strict=True)]
        ratios = [taken[-1] / mine for mine in taken[:-1]]
        goal = "" if wanted is None else f"   meant: {wanted}" + (" missed" * (ratios[0] < wanted))
        lines.append(
            f"  {workload:<40}"
            + "".join(f"{one:10.0f}" for one in taken)
            + "   "
            + " ".join(f"{ratio:6.2f}" for ratio in ratios)
            + goal
        )
    for side in sides.values():
        side.end()
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
