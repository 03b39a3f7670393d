"""Time to read recordings into the buffer, compared with `rosbags`, `mcap` and `transform_tree`.

Each program runs in a separate process, so that its memory is measured alone, and the programs run
in turn. Each process reads the file several times, and the fastest reading counts: the first
reading includes imports, and allocation of memory can double the time of others. The report has
two ratios. The ratio of processor time hardly depends on other work of the machine. The ratio of
wall time includes unpacking in threads, and is meaningful only on an idle machine.
"""

import importlib.util
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

import numpy as np

from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.layouts import CDR, ROS1
from tftool.messages.transform_rows import walk
from tftool.messages.transforms import encode_transforms

SECOND = 10**9
TRANSFORMS = 1_000_000
TURNS = 5
READINGS = 3
BIG = 2_000_000_000
_STAMP = struct.Struct("<II")


def _messages(layout: str, per_message: int, transforms: int) -> Iterator[tuple[int, bytes]]:
    """Yield log time and bytes of each message: noisy odometry and four moving joints."""
    draw = np.random.default_rng(7)
    count = transforms // per_message
    kinds = min(count, 5000)
    places = np.tile(np.arange(15.0).reshape(5, 3) / 7.0, (kinds, 1, 1))
    places[:, 0] = draw.normal(size=(kinds, 3))
    angles = draw.uniform(-1.0, 1.0, size=(kinds, 5))
    turns = np.stack([0 * angles, 0 * angles, np.sin(angles / 2), np.cos(angles / 2)], axis=-1)
    pairs = [("odom", "base_link")] + [("base_link", f"joint_{k}_link") for k in range(1, 5)]
    made = []
    for row in range(kinds):
        sent = range(5) if per_message == 5 else [row % 5]
        payload = _payload(layout, [(*pairs[k], places[row, k], turns[row, k]) for k in sent])
        found = walk(CDR if layout == "cdr" else ROS1, payload).places
        made.append((bytearray(payload), [place.stamp for place in found]))
    for tick in range(count):
        stamp = 1_750_000_000 * SECOND + tick * 5_000_000
        payload, stamps = made[tick % kinds]
        for place in stamps:
            _STAMP.pack_into(payload, place, stamp // SECOND, stamp % SECOND)
        yield stamp + 2_000_000, bytes(payload)


def _payload(layout: str, frames: list) -> bytes:
    if layout == "cdr":
        return encode_transforms(
            [
                TransformStamped(0, p, c, Transform(tuple(t.tolist()), tuple(q.tolist())))
                for p, c, t, q in frames
            ]
        )
    parts = [struct.pack("<I", len(frames))]
    for parent, child, place, turn in frames:
        parts.append(bytes(12))
        parts += [struct.pack("<I", len(name)) + name.encode() for name in (parent, child)]
        parts.append(struct.pack("<7d", *place, *turn))
    return b"".join(parts)


def _write(kind: str, path: Path, per_message: int) -> None:
    from tests.recordings import writers

    messages = _messages("ros1" if kind.startswith("ros1") else "cdr", per_message, TRANSFORMS)
    if kind.startswith("mcap"):
        compression = getattr(writers.CompressionType, kind.split()[1].upper())
        with path.open("wb") as stream:
            writer = writers.McapWriter(stream, 1 << 20, compression, enable_crcs=False)
            writer.start("ros2")
            text = writers.ROS2.generate_msgdef(writers.TF, ros_version=2)[0]
            schema = writer.register_schema(writers.TF, "ros2msg", text.encode())
            channel = writer.register_channel("/tf", "cdr", schema)
            for log_time, payload in messages:
                writer.add_message(channel, log_time, payload, log_time)
            writer.finish()
    elif kind == "db3":
        with writers.Rosbag2Writer(path, version=9) as bag:
            connection = bag.add_connection("/tf", writers.TF, typestore=writers.ROS2)
            for log_time, payload in messages:
                bag.write(connection, log_time, payload)
    else:
        bag1 = writers.Rosbag1Writer(path)
        if kind != "ros1 none":
            bag1.set_compression(bag1.CompressionFormat[kind.split()[1].upper()])
        with bag1:
            connection = bag1.add_connection("/tf", writers.TF, typestore=writers.ROS1)
            for log_time, payload in messages:
                bag1.write(connection, log_time, payload)


def _write_big(path: Path, method: str) -> None:
    """Write 2 GB of messages: an image of 500 kB before each message of transforms."""
    from tests.recordings import writers

    image = np.random.default_rng(3).integers(0, 255, 500_000, dtype=np.uint8).tobytes()
    compression = getattr(writers.CompressionType, method.upper())
    with path.open("wb") as stream:
        writer = writers.McapWriter(stream, 1 << 20, compression, enable_crcs=False)
        writer.start("ros2")
        text = writers.ROS2.generate_msgdef(writers.TF, ros_version=2)[0]
        schema = writer.register_schema(writers.TF, "ros2msg", text.encode())
        channel = writer.register_channel("/tf", "cdr", schema)
        pictures = writer.register_channel("/image", "raw", 0)
        for log_time, payload in _messages("cdr", 5, 5 * BIG // 500_000):
            writer.add_message(pictures, log_time, image, log_time)
            writer.add_message(channel, log_time, payload, log_time)
        writer.finish()


# The compared programs


def _ours(path: Path, most: int) -> int:
    from tftool.recordings.recording import open_recording

    with open_recording(path) as recording:
        assert recording.buffer.frames()
        return len(recording.transforms)


def _rosbags(path: Path, most: int) -> int:
    """Decode a limited number of transforms with rosbags, which is slow."""
    from rosbags.highlevel import AnyReader

    from tests.recordings import writers

    count = 0
    with AnyReader([path], default_typestore=writers.ROS2) as reader:
        wanted = [one for one in reader.connections if one.topic == "/tf"]
        for connection, _, raw in reader.messages(wanted):
            count += len(reader.deserialize(raw, connection.msgtype).transforms)
            if count >= most:
                break
    return count


def _mcap(path: Path, most: int) -> int:
    from mcap.reader import make_reader

    with path.open("rb") as stream:
        return 5 * sum(1 for _ in make_reader(stream).iter_messages(topics=["/tf"]))


def _transform_tree(path: Path, most: int) -> int:
    import tf_tree

    tf_tree.ingest_bag(str(path))
    return TRANSFORMS


@cache
def _packed(path: Path) -> list[tuple[bytes, int]]:
    """Return the compressed chunks of a recording, and the length of each when unpacked."""
    if path.suffix == ".mcap":
        from mcap.records import Chunk
        from mcap.stream_reader import StreamReader

        with path.open("rb") as stream:
            records = StreamReader(stream, emit_chunks=True).records
            return [(one.data, one.uncompressed_size) for one in records if isinstance(one, Chunk)]
    from rosbags.rosbag1 import Reader

    with Reader(path) as reader, path.open("rb") as stream:
        return [
            (os.pread(stream.fileno(), one.datasize, one.datapos), 0)
            for one in reader.chunks.values()
        ]


def _unpacker(path: Path, largest: int) -> Callable[[bytes, int], "bytes | memoryview"]:
    """Return a function that unpacks a chunk of a recording, zstd into memory that is reused."""
    import bz2

    import lz4.frame
    import zstandard

    if "zstd" not in path.name:
        unpack = {"lz4": lz4.frame.decompress, "bz2": bz2.decompress, "none": bytes}
        found = unpack[path.stem.split("_")[1]]
        return lambda packed, size: found(packed)
    room = memoryview(bytearray(largest))
    unpacker = zstandard.ZstdDecompressor()

    def zstd(packed: bytes, size: int) -> memoryview:
        with unpacker.stream_reader(packed) as reader:
            assert reader.readinto(room[:size]) == size
        return room[:size]

    return zstd


def _in_threads(path: Path, work: Callable[[list[tuple[bytes, int]]], None]) -> int:
    """Divide the chunks of a recording among as many threads as there are processors."""
    # The reason is in tftool.recordings.decompression, at `keep_freed_memory`.
    np.empty(31 << 20, dtype=np.uint8)
    pieces, workers = _packed(path), len(os.sched_getaffinity(0))
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(work, [pieces[k::workers] for k in range(workers)]))
    return TRANSFORMS


def _unpacking(path: Path, most: int) -> int:
    """Unpack the chunks in threads into memory that is reused, and do nothing else."""

    def work(pieces: list[tuple[bytes, int]]) -> None:
        unpack = _unpacker(path, max(size for _, size in pieces))
        for packed, size in pieces:
            assert unpack(packed, size)

    return _in_threads(path, work)


def _floor(path: Path, most: int) -> int:
    """Do in threads the work that no reader can avoid.

    Read the file, unpack the chunks, read the unpacked bytes once, and write 64 bytes for each
    transform to new memory in large pages.
    """
    from tftool.base.native import PAGE, large_pages

    total = sum(len(packed) for packed, _ in _packed(path))

    def work(pieces: list[tuple[bytes, int]]) -> None:
        unpack = _unpacker(path, max(size for _, size in pieces))
        share = sum(len(packed) for packed, _ in pieces) / total
        size = int(64 * TRANSFORMS * share)
        columns = np.frombuffer(large_pages(size + PAGE, size) or bytearray(size), dtype=np.uint8)
        with path.open("rb", buffering=0) as stream:
            for number, (packed, length) in enumerate(pieces):
                found = stream.read(len(packed))
                assert len(found) == len(packed)
                data = found if path.stem.split("_")[1] == "none" else unpack(packed, length)
                assert np.frombuffer(data, dtype=np.uint64, count=len(data) // 8).max()
                begin, end = (size * k // len(pieces) for k in (number, number + 1))
                columns[begin:end] = 1

    return _in_threads(path, work)


SIDES: dict[str, Callable[[Path, int], int]] = {
    "ours": _ours,
    "rosbags": _rosbags,
    "mcap": _mcap,
    "transform_tree": _transform_tree,
    "unpacking": _unpacking,
    "floor": _floor,
}

LIMITS = {
    "unpacking": "unpacking alone",
    "floor": "floor: read the file, unpack, read the bytes, write 64 bytes a transform",
}


def _side(name: str, path: str, most: str) -> None:
    """Run one program: return processor and wall seconds a transform, megabytes, and transforms."""
    # Imports of the first call are not part of reading, and numpy's own memory does not count.
    import lz4.frame  # noqa: F401
    import rosbags.highlevel  # noqa: F401
    import zstandard  # noqa: F401

    import tftool.recordings.recording  # noqa: F401

    before, used, least = _peak(), 0.0, [9e9, 9e9]
    for turn in range(READINGS):
        begin = time.process_time(), time.perf_counter()
        count = SIDES[name](Path(path), int(most))
        spent = time.process_time() - begin[0], time.perf_counter() - begin[1]
        least = [min(one, two / count) for one, two in zip(least, spent, strict=True)]
        if turn == 0:
            used = _peak() - before
    print(*least, used, count)  # noqa: T201


def _peak() -> float:
    """Return the peak memory of this process in megabytes."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) / 1e3 for line in lines if line.startswith("VmHWM"))


def _measured(name: str, path: Path, most: int = TRANSFORMS) -> tuple[float, float, float, float]:
    words = [sys.executable, "-m", "tests.benchmarks.recordings", name, str(path), str(most)]
    # Threads of a library for matrices, which reading does not use, would count as work.
    env = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(words, capture_output=True, text=True, check=True, env=env)
    spent, clock, memory, count = map(float, done.stdout.split())
    return spent, clock, memory, count


def report() -> str:
    """Print millions of transforms per processor second, and the ratio to each other library."""
    lines = ["recordings: 1 000 000 transforms into the buffer, by the processor (by the clock)"]
    with tempfile.TemporaryDirectory() as folder:
        for kind, per_message, peers in (
            ("mcap zstd", 5, ("rosbags", "transform_tree")),
            ("mcap zstd", 1, ("rosbags",)),
            ("mcap lz4", 5, ()),
            ("mcap none", 5, ()),
            ("db3", 5, ("rosbags",)),
            ("ros1 none", 5, ("rosbags",)),
            ("ros1 lz4", 5, ("rosbags",)),
            ("ros1 bz2", 5, ("rosbags",)),
        ):
            suffix = {"mcap": ".mcap", "db3": "", "ros1": ".bag"}[kind.split()[0]]
            path = Path(folder) / f"{kind.replace(' ', '_')}_{per_message}{suffix}"
            _write(kind, path, per_message)
            there = [one for one in peers if one != "transform_tree" or _installed("tf_tree")]
            sides = ["ours", *there]
            if kind.split()[-1] in ("zstd", "lz4", "bz2"):
                sides.append("unpacking")
            if kind.split()[-1] in ("zstd", "lz4", "none"):
                sides.append("floor")
            spent: dict[str, list[tuple[float, float]]] = {one: [] for one in sides}
            memory = []
            for _ in range(TURNS):
                for one, times in spent.items():
                    most = 50_000 if one == "rosbags" else TRANSFORMS
                    took, clock, used, _ = _measured(one, path, most)
                    times.append((took, clock))
                    if one == "ours":
                        memory.append(used)
            least = {one: _least(times) for one, times in spent.items()}
            peer_times = {one: least[one] for one in there}
            told = f"{_told(least['ours'], peer_times)}, {statistics.median(memory):.0f} MB"
            lines.append(f"  {kind}, {per_message} a message: {told}")
            for one, text in LIMITS.items():
                if one in least:
                    processor, clock = (
                        f"{100 * few / much:.0f} %"
                        for few, much in zip(least[one], least["ours"], strict=True)
                    )
                    told = _told(least[one], peer_times if one == "unpacking" else {})
                    lines.append(f"    {text}: {told}, {processor} ({clock}) of our time")
            if path.is_file():
                path.unlink()
        lines += _big(Path(folder))
    return "\n".join(lines)


def _told(spent: tuple[float, float], peers: dict[str, tuple[float, float]]) -> str:
    """Return transforms per second, and the ratio to each other library."""
    ratios = "".join(
        f", {theirs[0] / spent[0]:.1f} times {one} ({theirs[1] / spent[1]:.1f})"
        for one, theirs in peers.items()
    )
    return f"{1e-6 / spent[0]:.1f} M/s ({1e-6 / spent[1]:.1f}){ratios}"


def _least(times: list[tuple[float, float]]) -> tuple[float, float]:
    return min(spent for spent, _ in times), min(clock for _, clock in times)


def _big(folder: Path) -> list[str]:
    lines = []
    path = folder / "big.mcap"
    _write_big(path, "none")
    _measured("ours", path)  # to fill the caches
    for one in ("ours", "rosbags", "mcap"):
        took, _, _, count = _measured(one, path)
        lines.append(f"  2 GB uncompressed, 0.1 % tf, {one}: {took * count:.2f} s")
    from tftool.recordings.container_reader import Recorded
    from tftool.recordings.mcap.read import Mcap

    container = Mcap(path)
    Recorded("big", container).transforms()
    lines.append(f"  ours reads {container.read / 1e6:.1f} MB of the file")
    container.close()
    path.unlink()
    _write_big(path, "zstd")
    first, second = (_asked(path, folder / "cache") for _ in range(2))
    lines.append(
        f"  2 GB zstd, a question: {first:.2f} s, the next one {second:.3f} s, "
        f"{first / second:.0f} times as quick"
    )
    return lines


def _asked(path: Path, kept: Path) -> float:
    """Return the processor seconds of a lookup in a recording whose columns are cached."""
    from tftool.recordings.column_cache import ColumnCache
    from tftool.recordings.recording import open_recording

    begin = time.process_time()
    with open_recording(path, cache=ColumnCache(kept)) as recording:
        recording.buffer.lookup_transform("odom", "joint_1_link")
    return time.process_time() - begin


def _installed(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


if __name__ == "__main__":
    _side(*sys.argv[1:])
