"""Comparison of two programs that execute the same worlds."""

import json
import math
import shutil
import subprocess
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.differential import ours
from tests.differential.worlds import World, world

THEIRS = Path(__file__).with_name("debian.py")
PYTHON = "/usr/bin/python3"
"""Debian's Python, which alone can import Debian's tf2, whichever Python runs the tests."""


@dataclass
class Comparison:
    """Result of a comparison.

    Attributes:
        questions: Number of questions.
        refused: Number of questions that both programs refused, by class of the error.
        worst: Largest difference between two results.
        disagreements: Questions to which only one program gave a result, or with other errors.
    """

    questions: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    worst: float = 0.0
    disagreements: list[str] = field(default_factory=list)


def missing() -> str:
    """Return the reason why nothing can be compared; empty if Debian's tf2 is installed."""
    if shutil.which(PYTHON) is None:
        return f"there is no {PYTHON}"
    found = subprocess.run(
        [PYTHON, "-c", "import tf2_py, genpy, geometry_msgs.msg"], capture_output=True, check=False
    )
    return "" if found.returncode == 0 else "Debian's python3-tf2 is not installed"


def their_answers(worlds: list[World]) -> list[list[Any]]:
    """Return the answers of Debian's tf2, by world."""
    told = subprocess.run(
        [PYTHON, str(THEIRS)],
        input="".join(json.dumps([one.cache, one.steps]) + "\n" for one in worlds),
        capture_output=True,
        text=True,
        check=True,
    )
    return [json.loads(line) for line in told.stdout.splitlines()]


def compare(seeds: range, tolerance: float) -> Comparison:
    """Compare the answers to all questions in the worlds of some seeds."""
    worlds = [world(seed) for seed in seeds]
    result = Comparison()
    for seed, lived, theirs in zip(seeds, worlds, their_answers(worlds), strict=True):
        mine = ours.live(lived)
        questions = [step for step in lived.steps if step[0] != "set"]
        for number, (question, wanted, found) in enumerate(
            zip(questions, theirs, mine, strict=True)
        ):
            result.questions += 1
            if wanted[0] == found[0] == "refused":
                result.refused[wanted[1]] += 1
            apart = ours.difference(wanted, found)
            if not apart <= tolerance:
                result.disagreements.append(
                    f"world {seed}, question {number}, {question}: {wanted} against our {found}"
                )
            if math.isfinite(apart):
                result.worst = max(result.worst, apart)
    return result
