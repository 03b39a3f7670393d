"""Writing of recordings: edits compared with `cp` and `info`, and the memory of a recorder.

    python -m tests.benchmarks.writing [MEGABYTES]

The compared programs run in turn, because only ratios are comparable between machines. After an
edit, the result is read again and compared.
"""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import encode_transforms
from tftool.recordings.channel import Channel
from tftool.recordings.edit.changes import Edits
from tftool.recordings.edit.rewrite import edit
from tftool.recordings.mcap.write import McapWriter
from tftool.recordings.message_conversion import TRANSFORMS, ros2_channel
from tftool.recordings.rolling_writer import RollingRecording

START = seconds(1_750_000_000)
TURNS = 3
IMAGE = 500_000
MANY = 1_200_000
EACH = 5


def _large(path: Path, megabytes: int) -> None:
    """Write an uncompressed file of noisy images with a few transforms, as rosbag2 does."""
    writer = McapWriter(path, compression="none", with_crc=False)
    tf = writer.channel(ros2_channel("/tf", TRANSFORMS))
    static = writer.channel(ros2_channel("/tf_static", TRANSFORMS, static=True))
    images = writer.channel(Channel("/image", "sensor_msgs/msg/Image", "cdr", "ros2msg"))
    noise = np.random.default_rng(1).integers(0, 256, IMAGE, dtype=np.uint8).tobytes()
    mount = TransformStamped(0, "base", "laser", Transform((1.0, 0.0, 0.0)))
    writer.write(static, START, encode_transforms([mount]))
    for number in range(megabytes * 1_000_000 // IMAGE):
        now = START + number * 10_000_000
        writer.write(images, now, noise)
        moved = TransformStamped(now, "odom", "base", Transform((float(number), 0.0, 0.0)))
        writer.write(tf, now, encode_transforms([moved]))
    writer.finish()


def _timed(work) -> tuple[float, float]:
    """Return the seconds, and the seconds of processor time, of a function."""
    began, used = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - began, time.process_time() - used


def _edits(folder: Path, megabytes: int) -> None:
    source = folder / "large.mcap"
    _large(source, megabytes)
    pose = {("base", "laser"): (2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)}
    sides = {
        "cp": lambda out: shutil.copyfile(source, out),
        "cp, on the disk": lambda out: (shutil.copyfile(source, out), _sync(out)),
        "edit": lambda out: edit([str(source)], out, Edits()),
        "edit --set": lambda out: edit([str(source)], out, Edits(poses=pose)),
        "edit --drop": lambda out: edit([str(source)], out, Edits(drop=(("odom", "base"),))),
    }
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in sides}
    for _ in range(TURNS):
        for name, work in sides.items():
            out = folder / "out.mcap"
            times[name].append(_timed(lambda work=work, out=out: work(out)))
            out.unlink()
    base = [min(side) for side in zip(*times["cp, on the disk"], strict=True)]
    sys.stdout.write(f"{source.stat().st_size / 1e6:.0f} MB\n")
    for name, found in times.items():
        best = [min(side) for side in zip(*found, strict=True)]
        sys.stdout.write(
            f"  {name:16} {best[0]:6.2f} s, {best[0] / base[0]:5.2f} x cp to the disk; "
            f"of the processor {best[1]:5.2f} s, {best[1] / base[1]:5.2f} x\n"
        )


def _edits_of_transforms(folder: Path) -> None:
    """Compare edits that change transforms with `info` of the same recording, in processor time."""
    source = folder / "transforms.mcap"
    writer = McapWriter(source)
    tf = writer.channel(ros2_channel("/tf", TRANSFORMS))
    links = [("odom", "base"), *(("base", f"joint_{number}") for number in range(1, EACH))]
    for number in range(MANY // EACH):
        now = START + number * 5_000_000
        pose = Transform((number / 7.0, 0.0, 0.0))
        writer.write(
            tf, now, encode_transforms([TransformStamped(now, *one, pose) for one in links])
        )
    writer.finish()
    end = (MANY // EACH) // 2 * 0.005
    sides = {
        "info": ["info", source, "--no-cache"],
        "rename": ["edit", source, "--rename", "odom=world", "-o", folder / "out.mcap"],
        "cut": ["edit", source, "--to", str(end), "-o", folder / "out.mcap"],
        "to .bag": ["edit", source, "-o", folder / "out.bag"],
    }
    times: dict[str, list[float]] = {name: [] for name in sides}
    for _ in range(TURNS):
        for name, words in sides.items():
            force = ["--force"] if name != "info" else []
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(
                [sys.executable, "-m", "tftool", *map(str, words), *force],
                check=True,
                stdout=subprocess.DEVNULL,
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            spent = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
            times[name].append(spent)
    base = min(times["info"])
    sys.stdout.write(f"{MANY:,} transforms, processor time\n")
    for name, found in times.items():
        sys.stdout.write(f"  {name:16} {min(found):6.2f} s, {min(found) / base:5.2f} x info\n")


def _sync(path: Path) -> None:
    number = os.open(path, os.O_RDONLY)
    os.fsync(number)
    os.close(number)


def _records(folder: Path) -> None:
    for each in (1, 10):
        rolling = RollingRecording(folder / "run.mcap", force=True)
        channel = ros2_channel("/tf", TRANSFORMS)
        count = 300_000 // each
        payloads = [
            encode_transforms(
                [
                    TransformStamped(
                        START + n, "odom", f"frame_{k}", Transform((float(n), 0.0, 0.0))
                    )
                    for k in range(each)
                ]
            )
            for n in range(1000)
        ]

        def run(rolling=rolling, channel=channel, count=count, payloads=payloads, each=each):
            for number in range(count):
                # The log time advances by a second per 100,000 transforms.
                now = START + number * each * 10_000
                rolling.take(channel, now, payloads[number % 1000], each)
            rolling.close()

        began = time.process_time()
        run()
        took = time.process_time() - began
        rate = count * each / took / 1e6
        sys.stdout.write(f"record, {each:2} a message: {rate:5.2f} M/s of processor time\n")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        _edits(Path(place), int(sys.argv[1]) if len(sys.argv) > 1 else 500)
        _edits_of_transforms(Path(place))
        _records(Path(place))
