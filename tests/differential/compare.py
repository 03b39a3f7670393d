"""Both sides live through the same worlds; what they answer is compared."""

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
"""Debian's module belongs to Debian's Python, whichever one runs the tests."""


@dataclass
class Comparison:
    """What came of it.

    Attributes:
        questions: How many were asked.
        refused: How many of them both sides refused, by class.
        worst: The largest difference between two answers that both gave.
        disagreements: Questions to which the two said something else.
    """

    questions: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    worst: float = 0.0
    disagreements: list[str] = field(default_factory=list)


def missing() -> str:
    """Why there is nobody to compare with; empty if there is."""
    if shutil.which(PYTHON) is None:
        return f"there is no {PYTHON}"
    found = subprocess.run(
        [PYTHON, "-c", "import tf2_py, genpy, geometry_msgs.msg"], capture_output=True, check=False
    )
    return "" if found.returncode == 0 else "Debian's python3-tf2 is not installed"


def their_answers(worlds: list[World]) -> list[list[Any]]:
    """What Debian's tf2 answers, world by world."""
    told = subprocess.run(
        [PYTHON, str(THEIRS)],
        input="".join(json.dumps([one.cache, one.steps]) + "\n" for one in worlds),
        capture_output=True,
        text=True,
        check=True,
    )
    return [json.loads(line) for line in told.stdout.splitlines()]


def compare(seeds: range, tolerance: float) -> Comparison:
    """Ask both sides everything in the worlds of those seeds."""
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
