"""How soon a command answers, against a Python that does nothing."""

import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
ROUNDS = 21

BARE = [sys.executable, "-c", "pass"]
TFTOOL = [sys.executable, "-m", "tftool"]
EXAMPLE = ["0", "0", "3", "0", "0", "3.14", "A", "B"]

# What is run, and the milliseconds it may take beyond the bare start.
COMMANDS = {
    "tftool --help": ([*TFTOOL, "--help"], 60.0),
    "tftool echo --help": ([*TFTOOL, "echo", "--help"], 60.0),
    "tftool static --once": (
        [*TFTOOL, "static", "--once", *EXAMPLE],
        250.0,
    ),
    "tftool echo --once": ([*TFTOOL, "echo", "turtle2", "turtle1", "--once"], 250.0),
    "tftool tree": ([*TFTOOL, "tree"], 250.0),
}


def measure(command: list[str]) -> float:
    """Milliseconds from start to end of one run."""
    started = time.perf_counter()
    subprocess.run(command, cwd=ROOT, capture_output=True, check=True)
    return (time.perf_counter() - started) * 1e3


def report() -> str:
    """Measure, and say it in a few lines."""
    commands = {"python -c pass": (BARE, 0.0), **COMMANDS}
    for command, _ in commands.values():
        measure(command)  # once, so that bytecode is cached where it may be
    taken: dict[str, list[float]] = {name: [] for name in commands}
    # In turn, so that a slow moment of the machine hits them all alike.
    for _ in range(ROUNDS):
        for name, (command, _) in commands.items():
            taken[name].append(measure(command))
    bare = statistics.median(taken["python -c pass"])
    lines = [f"start-up, milliseconds (median of {ROUNDS})", f"  {'python -c pass':<24}{bare:7.1f}"]
    for name, (_, allowed) in COMMANDS.items():
        median = statistics.median(taken[name])
        lines.append(
            f"  {name:<24}{median:7.1f}   {median / bare:4.1f} times the bare start, "
            f"+{median - bare:.0f} ms (wanted: +{allowed:.0f} at most)"
        )
    allowed = 2.5 * bare + 120.0
    lines.append(
        f"  --help was wanted under 2.5 times the bare start plus 120 ms: {allowed:.0f} ms"
    )
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
