"""Single lookups with ROS 1's compiled tf2, from C++.

This needs Debian's libtf2-dev and a C++ compiler; without them the benchmark prints the reason.
"""

import atexit
import functools
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from tests.benchmarks.sides import Side

SOURCE = Path(__file__).with_name("noetic.cpp")


@functools.cache
def program() -> Path | str:
    """Return the compiled program, or the reason why there is none."""
    compiler = shutil.which("g++") or shutil.which("clang++")
    if compiler is None:
        return "no C++ compiler"
    if not Path("/usr/include/tf2/buffer_core.h").exists():
        return "libtf2-dev is not installed"
    folder = tempfile.mkdtemp(prefix="tftool-noetic-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    built = Path(folder) / "noetic"
    done = subprocess.run(
        [compiler, "-std=c++17", "-O3", "-o", built, SOURCE, "-ltf2", "-lrostime"],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        return f"does not compile here: {done.stderr.splitlines()[0]}"
    return built


def lookups(
    stamps: np.ndarray, samples: np.ndarray, times: np.ndarray, rounds: int = 1
) -> tuple[list[float], np.ndarray]:
    """Return nanoseconds of processor time per lookup in each round, and the results, shape (n, 7).

    Args:
        stamps: Stamps of each edge of the chain f0 ← f1 ← …, shape (depth, k).
        samples: Poses of these samples, shape (depth, k, 7).
        times: Times of the lookups of f(depth) in f0, shape (n,).
        rounds: Number of rounds.
    """
    built = program()
    assert isinstance(built, Path), built
    with tempfile.TemporaryDirectory() as folder:
        for name, values in (("stamps", stamps), ("samples", samples), ("times", times)):
            values.tofile(Path(folder, name))
        side = Side([built])
        side.ask("chain", folder, len(stamps))
        taken = [side.ask("times", folder)[0] for _ in range(rounds)]
        side.end()
        answers = np.fromfile(Path(folder, "answers")).reshape(-1, 7)
    return taken, answers
