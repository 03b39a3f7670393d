"""Time until a command answers, compared with a Python that does nothing or only imports."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROUNDS = 21

BARE = [sys.executable, "-c", "pass"]
TFTOOL = [sys.executable, "-m", "tftool"]
EXAMPLE = ["0", "0", "3", "0", "0", "3.14", "A", "B"]
LIBRARIES = {
    "import typer": [sys.executable, "-c", "import typer"],
    "import typer, numpy": [sys.executable, "-c", "import typer, numpy"],
    "import typer, asyncio, yaml": [sys.executable, "-c", "import typer, asyncio, yaml"],
    "import typer, rich.table": [sys.executable, "-c", "import typer, rich.table"],
}
"""Imports that each command needs; their time is the lower limit for a command's start."""

# Command lines, and the milliseconds that each may take longer than an empty Python program.
COMMANDS = {
    "tftool --help": (["--help"], 45.0),
    "tftool echo --help": (["echo", "--help"], 45.0),
    "tftool echo A B turtles --at 5": (["echo", "turtle2", "turtle1", "turtles", "--at", "5"], 230),
    "tftool tree robot.urdf": (["tree", "robot.urdf"], 230.0),
    "tftool info run.mcap": (["info", "run.mcap"], 180.0),
    "tftool static --once": (["static", "--once", *EXAMPLE], 250.0),
    "tftool echo --once": (["echo", "turtle2", "turtle1", "--once"], 250.0),
    "tftool tree": (["tree"], 250.0),
}


def files(folder: Path) -> None:
    """Write the description and the recording that the commands read."""
    links = "".join(f'<link name="link{n}"/>' for n in range(10))
    joints = "".join(
        f'<joint name="joint{n}" type="revolute"><parent link="link{n}"/>'
        f'<child link="link{n + 1}"/>'
        '<origin xyz="0 0 0.2"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for n in range(9)
    )
    (folder / "robot.urdf").write_text(f'<robot name="arm">{links}{joints}</robot>')
    subprocess.run([*TFTOOL, "export", "turtles", "-o", "run.mcap"], cwd=folder, check=True)


def measure(command: list[str], folder: Path) -> float:
    """Return the milliseconds from start to end of one run."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    started = time.perf_counter()
    subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=True)
    return (time.perf_counter() - started) * 1e3


def report() -> str:
    """Measure, and print a few lines."""
    commands = {"python -c pass": BARE, **LIBRARIES}
    commands |= {name: [*TFTOOL, *words] for name, (words, _) in COMMANDS.items()}
    taken: dict[str, list[float]] = {name: [] for name in commands}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        files(folder)
        for command in commands.values():
            measure(command, folder)  # once, so that bytecode and columns are cached
        # The commands run in turn, so that a slow moment of the machine affects all of them.
        for _ in range(ROUNDS):
            for name, command in commands.items():
                taken[name].append(measure(command, folder))
    bare = statistics.median(taken["python -c pass"])
    lines = [f"start-up, milliseconds (median of {ROUNDS})"]
    for name, times in taken.items():
        median = statistics.median(times)
        lines.append(f"  {name:<32}{median:7.1f}   {median / bare:5.1f} times the bare start")
        if name in COMMANDS:
            more, allowed = median - bare, COMMANDS[name][1]
            lines[-1] += f", +{more:.0f} ms (wanted: +{allowed:.0f} at most)"
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
