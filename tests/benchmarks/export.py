"""Time to write one million poses, in the same run as np.savetxt for CSV."""

import statistics
import tempfile
import time
from pathlib import Path

import numpy as np

from tftool.buffer.batch.transform_array import TransformArray
from tftool.frames.export.export import write_trajectories
from tftool.frames.export.export_formats import Format, Style
from tftool.frames.pair_samples import Trajectory

POSES = 1_000_000
ROUNDS = 3


def poses(count=POSES):
    """Return a trajectory of noisy doubles with stamps of today."""
    draw = np.random.default_rng(1)
    turns = draw.normal(size=(count, 4))
    turns /= np.linalg.norm(turns, axis=1)[:, np.newaxis]
    stamps = 1_700_000_000_000_000_000 + np.arange(count) * 10_000_000
    places = 100.0 * draw.normal(size=(count, 3))
    valid = np.ones(count, dtype=bool)
    path = TransformArray("map", "base_link", stamps, places, turns, valid)
    return Trajectory(path, (), "at given stamps")


def seconds_of(way):
    """Return the seconds that one call takes."""
    began = time.perf_counter()
    way()
    return time.perf_counter() - began


def report() -> str:
    """Measure, and print a few lines."""
    found = poses()
    path = found.path
    table = np.column_stack([path.stamps, path.translations, path.rotations])
    with tempfile.TemporaryDirectory() as folder:

        def ours(form):
            target = Path(folder) / f"ours.{form}"
            write_trajectories([found], target, form, Style(), force=True)

        ways = {
            "savetxt": lambda: np.savetxt(
                Path(folder) / "theirs.csv", table, fmt="%.9f", delimiter=","
            ),
            **{
                form: lambda form=form: ours(form)
                for form in (Format.csv, Format.tum, Format.kitti, Format.npz, Format.parquet)
            },
        }
        spent = {name: [] for name in ways}
        for _ in range(ROUNDS):
            for name, way in ways.items():
                spent[name].append(seconds_of(way))
    took = {name: statistics.median(times) for name, times in spent.items()}
    lines = [f"export, {POSES} poses (median of {ROUNDS} rounds, taking turns; with fsync)"]
    lines.append(f"  np.savetxt to CSV: {took['savetxt']:.2f} s")
    for form, wanted in (
        (Format.csv, f"{took[Format.csv] / took['savetxt']:.2f} times savetxt (wanted: 0.5)"),
        (Format.tum, f"{took[Format.tum] / took['savetxt']:.2f} times savetxt"),
        (Format.kitti, "12 numbers a pose"),
        (Format.npz, f"{POSES / took[Format.npz] / 1e6:.1f} M poses/s (wanted: 2)"),
        (Format.parquet, f"{POSES / took[Format.parquet] / 1e6:.1f} M poses/s"),
    ):
        lines.append(f"  {form}: {took[form]:.2f} s, {wanted}")
    return "\n".join(lines)
