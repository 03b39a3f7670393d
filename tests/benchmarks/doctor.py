"""The doctor on a long recording compared with reading it, and two processes compared with one.

The compared programs run in turn, and their medians are compared.
"""

import statistics
import struct
import tempfile
import time
from pathlib import Path

import numpy as np

from tests.benchmarks.recordings import SECOND
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import encode_transforms

TRANSFORMS = 1_000_000
HEADERS = 100_000
SMALL = 400
TURNS = 5
_STAMP = struct.Struct("<II")


def write_long(path: Path, transforms: int = TRANSFORMS, headers: int = HEADERS) -> Path:
    """Write a recording of a robot with moving joints, five transforms a message, and a sensor."""
    from tests.recordings import writers

    pairs = [("odom", "base_link")] + [("base_link", f"joint_{k}_link") for k in range(1, 5)]
    count = transforms // 5
    scan = writers.payload(writers.Sent(0, "/scan", scan=(0, "laser")))
    mount = [TransformStamped(0, "base_link", "laser", Transform((0.1, 0.0, 0.2)))]
    start = 1_750_000_000 * SECOND
    with path.open("wb") as stream:
        writer = writers.McapWriter(stream, 1 << 20, writers.CompressionType.LZ4, enable_crcs=False)
        writer.start("ros2")
        text = writers.ROS2.generate_msgdef(writers.TF, ros_version=2)[0]
        schema = writer.register_schema(writers.TF, "ros2msg", text.encode())
        moving = writer.register_channel("/tf", "cdr", schema)
        static = writer.register_channel("/tf_static", "cdr", schema)
        text = writers.ROS2.generate_msgdef(writers.SCAN, ros_version=2)[0]
        schema = writer.register_schema(writers.SCAN, "ros2msg", text.encode())
        scans = writer.register_channel("/scan", "cdr", schema)
        writer.add_message(static, start, encode_transforms(mount), start)
        for tick in range(count):
            stamp = start + tick * 5_000_000
            angle = 0.001 * tick
            turn = (0.0, 0.0, float(np.sin(angle / 2)), float(np.cos(angle / 2)))
            place = (0.0025 * tick, 0.0, 0.0)
            payload = encode_transforms(
                [TransformStamped(stamp, p, c, Transform(place, turn)) for p, c in pairs]
            )
            writer.add_message(moving, stamp + 2_000_000, payload, stamp)
            if tick % max(1, count // headers) == 0:
                body = bytearray(scan)
                _STAMP.pack_into(body, 4, stamp // SECOND, stamp % SECOND)
                writer.add_message(scans, stamp + 3_000_000, bytes(body), stamp)
        writer.finish()
    return path


def _seconds(work) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def compare_reading() -> str:
    """Compare the check of one million transforms and 100,000 headers with reading them."""
    from tftool.doctor.evidence import evidence_of_recording
    from tftool.doctor.judge import judge
    from tftool.recordings.recording import open_recording

    with tempfile.TemporaryDirectory() as folder:
        path = write_long(Path(folder) / "long.mcap")

        def read() -> None:
            with open_recording(path) as recording:
                assert len(recording.transforms) > 0.9 * TRANSFORMS
                assert len(recording.source.headers()["/scan"]) >= HEADERS

        def examine() -> None:
            with open_recording(path) as recording:
                found = judge(evidence_of_recording(recording))
            assert found.ran > 40

        times = [(_seconds(read), _seconds(examine)) for _ in range(TURNS)]
    reading, judged = (statistics.median(column) for column in zip(*times, strict=True))
    return (
        f"doctor, {TRANSFORMS:,} transforms and {HEADERS:,} headers: {judged:.2f} s, "
        f"{judged / reading:.2f} times reading ({reading:.2f} s); least 3"
    )


def compare_processes() -> str:
    """Compare two processes with one on many small recordings."""
    from tftool.commands.fleet import fleet
    from tftool.commands.fleet.fleet import Examination
    from tftool.commands.fleet.workers import workers_of
    from tftool.doctor.evidence import Scope
    from tftool.doctor.model import Settings

    with tempfile.TemporaryDirectory() as folder:
        whole = write_long(Path(folder) / "0.mcap", 40_000, 1_000)
        sources = []
        for number in range(SMALL):
            path = Path(folder) / f"run{number}.mcap"
            path.hardlink_to(whole)
            sources.append(str(path))
        task = Examination(Settings(), (), (), Scope())

        def work(count: int) -> None:
            fleet.sweep(sources, None, workers_of(count, ""), task)

        times = [(_seconds(lambda: work(1)), _seconds(lambda: work(2))) for _ in range(3)]
    one, two = (statistics.median(column) for column in zip(*times, strict=True))
    return f"{SMALL} recordings: one process {one:.1f} s, two {two:.1f} s: {one / two:.2f} times"


def report() -> str:
    """Run all measurements."""
    return f"{compare_reading()}\n{compare_processes()}"
