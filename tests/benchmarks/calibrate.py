"""Calibration on made motions of known truth: accuracy, intervals, refusals, processor time.

Where uv installs it, OpenCV (before 5) solves the same poses with its five methods, in a process
of its own.
"""

import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import tftool
from tests.frames.motions import errors, world
from tftool.frames.calibration.motion import BodyMotion
from tftool.geometry import rigid_arrays
from tftool.geometry.conversions import quaternion_from_matrix

WORLDS = 40
EACH = 10
POSES = 200
"""Poses of each world for OpenCV, whose methods compare all pairs of them."""
CASES = {
    "3-D, 3 mm 0.3°": {},
    "3-D, 1 mm 0.1°": {"noise": (0.001, 0.1)},
    "3-D, 20 mm 1°": {"noise": (0.02, 1.0)},
    "10 % outliers": {"outliers": 0.1},
    "20 % outliers": {"outliers": 0.2},
    "10 % flipped tags": {"flips": 0.1},
    "drift 1 %": {"drift": 0.01},
    "drift 1 %, 10 mm 0.5°": {"drift": 0.01, "noise": (0.01, 0.5)},
    "offset of years": {"offset": -1e8},
    "inverted": {"upside": True},
    "clock drift 50 ppm, 120 s": {"ppm": 50.0, "seconds": 120.0},
    "10 s": {"seconds": 10.0},
    "slow turns": {"pace": 0.3},
    "slow turns, 10 mm 0.5°": {"pace": 0.3, "noise": (0.01, 0.5)},
    "one axis": {"kind": "axis"},
    "one axis, 20 mm 1°": {"kind": "axis", "noise": (0.02, 1.0)},
    "planar": {"kind": "planar"},
    "planar, drift 1 %": {"kind": "planar", "drift": 0.01},
    "one axis, 10 % outliers": {"kind": "axis", "outliers": 0.1},
    "3-D, 5 Hz": {"rates": (100.0, 5.0)},
    "no rotation": {"kind": "still"},
    "no rotation, 20 mm 1°": {"kind": "still", "noise": (0.02, 1.0)},
}
"""Made worlds by name: options of `world`."""

REFUSED = ("no rotation",)
"""Beginnings of the names of the cases that must be refused."""

METHODS = ("Tsai", "Park", "Horaud", "Andreff", "Daniilidis")
OPENCV = """
import sys, cv2, numpy as np
poses = np.load(sys.argv[1])
names = "TSAI PARK HORAUD ANDREFF DANIILIDIS".split()
for a, b in zip(poses["a"], poses["b"]):
    back = np.linalg.inv(b)
    for name in names:
        turn, shift = cv2.calibrateHandEye(
            a[:, :3, :3], a[:, :3, 3], back[:, :3, :3], back[:, :3, 3],
            method=getattr(cv2, "CALIB_HAND_EYE_" + name))
        print(*turn.ravel(), *shift.ravel())
"""


def solved(made):
    """Return the calibration and the processor time it took, seconds."""
    began = time.process_time()
    found = tftool.calibrate(made.a, made.b)
    return found, time.process_time() - began


def case(name, options):
    """Return a line about one case, and how many of its intervals hold."""
    verdicts, held, factors, moved, turned = {}, [], [], [], []
    for seed in range(EACH):
        made = world(1000 + seed, **{"seconds": 60.0, **options})
        found, _ = solved(made)
        verdicts[found.verdict] = verdicts.get(found.verdict, 0) + 1
        if not found:
            continue
        wrong = np.abs(np.concatenate(errors(found.mount, made.mount)))
        widths = [*found.interval95.translation, *found.interval95.rotation_deg]
        seen = [place for place, width in enumerate(widths) if width is not None]
        held += [wrong[place] <= widths[place] for place in seen]
        factors += [widths[place] / max(wrong[place], 1e-9) for place in seen]
        moved.append(max(wrong[place] for place in seen if place < 3))
        turned.append(max(wrong[place] for place in seen if place > 2))
    told = ", ".join(f"{count} {verdict}" for verdict, count in verdicts.items())
    if not held:
        return f"  {name:28} {told}", held, factors, verdicts
    return (
        f"  {name:28} {told}; intervals hold {np.mean(held):.0%}; worst axis "
        f"{statistics.median(moved) * 1e3:.2f} mm {statistics.median(turned):.3f}°",
        held,
        factors,
        verdicts,
    )


def accuracy():
    """Return errors on 3-D motions of 60 s against the noise of one pose, and processor time."""
    noise = 0.003, 0.3
    rows, ours, poses = [], [], ([], [])
    for seed in range(WORLDS):
        made = world(seed, seconds=60.0, noise=noise, offset=0.2)
        found, took = solved(made)
        shift, turn = errors(found.mount, made.mount)
        rows.append(
            (np.linalg.norm(shift), np.linalg.norm(turn), abs(found.clock_offset - 0.2), took)
        )
        ours.append(rows[-1][:2])
        synchronised(made, poses)
    moved, turned, late, took = (statistics.median(column) for column in zip(*rows, strict=True))
    lines = [
        f"  3-D, 60 s, {WORLDS} worlds: {moved / noise[0]:.3f} × the noise of one pose (0.2), "
        f"{turned / noise[1]:.3f} × (0.15), offset {late * 1e3:.3f} ms (0.5); "
        f"{took:.2f} s of processor time with intervals (5)"
    ]
    return lines + opencv(poses, (moved, turned))


def synchronised(made, poses):
    """Add some poses of both bodies at the same moments, by the true clock offset."""
    a, b = BodyMotion.of(made.a), BodyMotion.of(made.b)
    times = b.times + (b.start - a.start) / 1e9 + made.offset
    places, turns, valid = a.at(times)
    chosen = np.flatnonzero(valid)
    chosen = chosen[np.linspace(0, len(chosen) - 1, POSES).astype(int)]
    for target, shift, turn in (
        (poses[0], places[chosen], turns[chosen]),
        (poses[1], b.positions[chosen], b.rotations[chosen]),
    ):
        target.append(rigid_arrays.matrices(shift, turn))


def opencv(poses, ours):
    """Return the medians of OpenCV's solvers on the same poses, thinned and synchronised."""
    uv = shutil.which("uv")
    if uv is None:
        return ["  OpenCV: uv is not installed"]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "poses.npz"
        np.savez(path, a=np.array(poses[0]), b=np.array(poses[1]))
        words = [uv, "run", "-q", "--no-project", "--python", "3.11"]
        words += ["--with", "opencv-python-headless<5", "python", "-c", OPENCV, str(path)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        return [f"  OpenCV did not run: {done.stderr.strip().splitlines()[-1:]}"]
    rows = [list(map(float, line.split())) for line in done.stdout.splitlines()]
    lines, best = [], [np.inf, np.inf]
    for number, name in enumerate(METHODS):
        moved, turned = [], []
        for seed, row in enumerate(rows[number :: len(METHODS)]):
            truth = world(seed, seconds=60.0, offset=0.2).mount
            turn = np.array(row[:9]).reshape(3, 3)
            rotation = quaternion_from_matrix(turn.tolist())
            shift, angle = errors(tftool.Transform(row[9:], rotation), truth)
            moved.append(np.linalg.norm(shift))
            turned.append(np.linalg.norm(angle))
        medians = statistics.median(moved), statistics.median(turned)
        best = [min(pair) for pair in zip(best, medians, strict=True)]
        lines.append(
            f"  OpenCV {name:11} of {POSES} poses: {medians[0] * 1e3:.2f} mm {medians[1]:.3f}°"
        )
    verdict = "not above" if ours[0] <= best[0] and ours[1] <= best[1] else "ABOVE"
    return [
        *lines,
        f"  tftool             {ours[0] * 1e3:.2f} mm {ours[1]:.3f}° with the clock offset "
        f"unknown: {verdict} the best of them",
    ]


def report():
    """Measure all of it."""
    lines = ["calibrate", *accuracy()]
    held, factors, confident = [], [], 0
    for name, options in CASES.items():
        line, own, widths, verdicts = case(name, options)
        lines.append(line)
        held += own
        factors += widths
        if name.startswith(REFUSED):
            confident += sum(count for verdict, count in verdicts.items() if verdict != "refused")
    lines.append(
        f"  {len(CASES) * EACH} worlds: 95 % intervals, pooled over axes, hold in "
        f"{np.mean(held):.1%} (90 %), in the median {np.median(factors):.1f} × the error "
        f"({np.median(factors) / 2.9:.1f} × a right one); {confident} refusals answered (0)"
    )
    return "\n".join(lines)
