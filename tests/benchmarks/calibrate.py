"""Calibration of simulated motions with a known mount: accuracy, intervals, refusals, speed.

If uv can install them, OpenCV (before 5) with its five methods and trajectopy solve the same
poses, each in a separate process.
"""

import shutil
import statistics
import subprocess
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

import tftool
from tests.frames.motions import errors, path, world
from tftool.frames.calibration.body_motion import BodyMotion
from tftool.geometry import rigid_arrays
from tftool.geometry.conversions import quaternion_from_matrix

WORLDS = 40
EACH = 10
POSES = 200
"""Number of poses given to the other solvers; OpenCV's methods compare all pairs of poses."""
CASES = {
    "3-D, 3 mm 0.3°": {},
    "3-D, 1 mm 0.1°": {"noise": (0.001, 0.1)},
    "3-D, 20 mm 1°": {"noise": (0.02, 1.0)},
    "10 % outliers": {"outliers": 0.1},
    "20 % outliers": {"outliers": 0.2},
    "10 % flipped tags": {"flips": 0.1},
    "drift 1 %": {"drift": 0.01},
    "drift 1 %, 10 mm 0.5°": {"drift": 0.01, "noise": (0.01, 0.5)},
    "no offset": {"offset": 0.0},
    "offset of years": {"offset": -1e8},
    "inverted": {"upside": True},
    "clock drift 50 ppm, 120 s": {"ppm": 50.0, "seconds": 120.0},
    "10 min, clock drift 20 ppm": {"ppm": 20.0, "seconds": 600.0, "rates": (50.0, 10.0)},
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
    "at rest": {"kind": "rest"},
    "4 s": {"seconds": 4.0},
    "two bodies": {},
    "two bodies about one axis": {"kind": "axis"},
}
"""Arguments of `world` for each generated case, by the case's name."""

REFUSED = ("no rotation", "at rest", "4 s", "two bodies")
"""Beginnings of the names of the cases that a solver must refuse."""

OPENCV = """
import sys, cv2, numpy as np
poses = np.load(sys.argv[1])
for a, b in zip(poses["a"], poses["b"]):
    back = np.linalg.inv(b)
    for name in "Tsai Park Horaud Andreff Daniilidis".split():
        turn, shift = cv2.calibrateHandEye(
            a[:, :3, :3], a[:, :3, 3], back[:, :3, :3], back[:, :3, 3],
            method=getattr(cv2, "CALIB_HAND_EYE_" + name.upper()))
        print("OpenCV", name, *shift.ravel(), *turn.ravel(), sep=",")
"""
TRAJECTOPY = """
import sys, numpy as np, trajectopy as t
poses = np.load(sys.argv[1])
wanted = t.AlignmentSettings(estimation_settings=t.AlignmentEstimationSettings(
    leverarm_x=True, leverarm_y=True, leverarm_z=True))
for a, b, stamps in zip(poses["a"], poses["b"], poses["stamps"]):
    both = [t.Trajectory(t.Positions(one[:, :3, 3]),
                         t.Rotations.from_matrix(one[:, :3, :3]), stamps) for one in (a, b)]
    found = t.estimate_alignment(*both, wanted).position_parameters
    print("trajectopy", "lever arm", found.lever_x.value, found.lever_y.value,
          found.lever_z.value, sep=",")
"""
PEERS = {"opencv-python-headless<5": OPENCV, "trajectopy": TRAJECTOPY}
"""Programs of other solvers, by the requirement that uv installs for each.

A line of output has the case's name, the method, the translation and the rotation matrix.
"""


def solved(made):
    """Return the calibration and the processor time it took, seconds."""
    began = time.process_time()
    found = tftool.calibrate(made.a, made.b)
    return found, time.process_time() - began


def case(name, options):
    """Return a line about one case, and the number of its intervals that contain the true value."""
    verdicts, held, factors, moved, turned = {}, [], [], [], []
    for seed in range(EACH):
        made = world(1000 + seed, **{"seconds": 60.0, **options})
        if name.startswith("two bodies"):
            made = replace(made, b=world(5000 + seed, seconds=60.0, **options).b)
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
    """Return errors on 3-D motions of 60 s by the noise of one pose, and the processor time."""
    noise = 0.003, 0.3
    rows, same, poses = [], [], ([], [], [])
    for seed in range(WORLDS):
        made = world(seed, seconds=60.0, noise=noise, offset=0.2)
        found, took = solved(made)
        shift, turn = errors(found.mount, made.mount)
        rows.append(
            (np.linalg.norm(shift), np.linalg.norm(turn), abs(found.clock_offset - 0.2), took)
        )
        thinned = synchronised(made, poses)
        shift, turn = errors(tftool.calibrate(*thinned).mount, made.mount)
        same.append((np.linalg.norm(shift), np.linalg.norm(turn)))
    moved, turned, late, took = (statistics.median(column) for column in zip(*rows, strict=True))
    lines = [
        f"  3-D, 60 s, {WORLDS} worlds: {moved / noise[0]:.3f} × the noise of one pose (0.2), "
        f"{turned / noise[1]:.3f} × (0.15), offset {late * 1e3:.3f} ms (0.5); "
        f"{took:.2f} s of processor time with intervals (5)"
    ]
    lines += against(poses, np.median(same, axis=0))
    lines.append(f"  tftool of all poses, clock offset unknown: {moved * 1e3:.2f} mm {turned:.3f}°")
    return lines


def synchronised(made, poses):
    """Return poses of both bodies at the same moments, resampled with the true clock offset."""
    a, b = BodyMotion.of(made.a), BodyMotion.of(made.b)
    times = b.times + (b.start - a.start) / 1e9 + made.offset
    places, turns, valid = a.at(times)
    chosen = np.flatnonzero(valid)
    chosen = chosen[np.linspace(0, len(chosen) - 1, POSES).astype(int)]
    both = (places[chosen], turns[chosen]), (b.positions[chosen], b.rotations[chosen])
    poses[0].append(rigid_arrays.matrices(*both[0]))
    poses[1].append(rigid_arrays.matrices(*both[1]))
    poses[2].append(times[chosen])
    stamps = (times[chosen] * 1e9).astype(np.int64)
    return [
        path(stamps, one.frame_id, one.child_frame_id, *pair)
        for one, pair in zip((made.a, made.b), both, strict=True)
    ]


def printed(package, script, file):
    """Run another solver; return its output, or the reason why it did not run."""
    uv = shutil.which("uv")
    if uv is None:
        return "", "uv is not installed"
    words = [uv, "run", "-q", "--no-project", "--python", "3.11", "--with", package]
    done = subprocess.run([*words, "python", "-c", script, file], capture_output=True, text=True)
    return done.stdout, "".join(done.stderr.strip().splitlines()[-1:]) if done.returncode else ""


def against(poses, ours):
    """Return the median errors of other solvers on the same poses, thinned and synchronised."""
    lines, wrong = [], {}
    truths = [world(seed, seconds=60.0, offset=0.2).mount for seed in range(WORLDS)]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "poses.npz"
        np.savez(file, a=np.array(poses[0]), b=np.array(poses[1]), stamps=np.array(poses[2]))
        for package, script in PEERS.items():
            text, why = printed(package, script, file)
            if why:
                lines.append(f"  {package} did not run: {why}")
                continue
            for line in text.splitlines():
                name, method, *numbers = line.split(",")
                rows = wrong.setdefault(f"{name} {method}", [])
                values = list(map(float, numbers))
                turn = np.reshape(values[3:] or np.eye(3), (3, 3)).tolist()
                found = tftool.Transform(values[:3], quaternion_from_matrix(turn))
                shift, angle = errors(found, truths[len(rows)])
                rows.append(
                    (np.linalg.norm(shift), np.linalg.norm(angle) if values[3:] else np.inf)
                )
    for name, rows in {f"tftool, the same {POSES} poses": [ours], **wrong}.items():
        moved, turned = np.median(rows, axis=0)
        angle = f"{turned:.3f}°" if np.isfinite(turned) else "no rotation"
        lines.append(f"  {name:30} {moved * 1e3:.2f} mm {angle}")
    if wrong:
        best = np.min([np.median(rows, axis=0) for rows in wrong.values()], axis=0)
        lines.append(f"  tftool is {'not ' if (ours <= best).all() else ''}above the best of them")
    return lines


def report():
    """Run all measurements."""
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
