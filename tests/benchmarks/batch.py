"""Batches of lookups compared with tf2's C++, with other libraries and with single lookups.

Single-threaded work is measured in processor time, so that other programs on the machine do not
count. The results are compared before anything is timed.
"""

import statistics
import time
import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec

import numpy as np

from tests.benchmarks import noetic
from tests.benchmarks.batch_peers import PEERS
from tftool.base.stamps import seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

ROUNDS = 5
MANY = 1_000_000
FEW = 100_000
"""Number of lookups or samples in comparisons with slow programs."""


@dataclass(frozen=True)
class Chain:
    """Chain of frames f0 ← f1 ← …; each edge has 100 samples per second and moves in all axes."""

    stamps: np.ndarray
    samples: np.ndarray
    buffer: Buffer

    @property
    def source(self) -> str:
        return f"f{len(self.stamps)}"

    def times(self, count: int, *, in_order: bool) -> np.ndarray:
        """Return stamps spread over all data of the chain."""
        random = np.random.default_rng(7)
        times = random.integers(self.stamps[:, 0].max(), self.stamps[:, -1].min(), count)
        return np.sort(times) if in_order else times

    def ask(self, times: np.ndarray, threads: int = 1) -> TransformArray:
        """Run the measured batch of lookups."""
        return self.buffer.lookup_transforms("f0", self.source, times, threads=threads)


def chain(depth: int, samples: int = 1000) -> Chain:
    """Create a chain."""
    random = np.random.default_rng(depth)
    jitter = random.integers(0, 2_000_000, (depth, samples))
    stamps = seconds(1) + np.arange(samples) * 10_000_000 + jitter
    turns = random.normal(size=(depth, 1, 4)) + np.cumsum(
        random.normal(size=(depth, samples, 4)) * 0.01, axis=1
    )
    turns /= np.linalg.norm(turns, axis=-1, keepdims=True)
    places = np.cumsum(random.normal(size=(depth, samples, 3)) * 0.01, axis=1)
    buffer = Buffer(seconds(1e6))
    for link in range(depth):
        buffer.set_transforms(
            f"f{link}", f"f{link + 1}", stamps[link], places[link], turns[link], "benchmark"
        )
    return Chain(stamps, np.concatenate((places, turns), axis=-1), buffer)


def interleaved(
    works: dict[str, Callable[[], object]],
    clock: Callable[[], float] = time.process_time,
    *,
    rounds: int = ROUNDS,
    of: Callable[[list[float]], float] = statistics.median,
) -> dict[str, float]:
    """Return the median seconds of each function, measured in rounds in which all of them run."""
    for work in works.values():
        work()
    taken: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(rounds):
        for name, work in works.items():
            began = clock()
            work()
            taken[name].append(clock() - began)
    return {name: of(each) for name, each in taken.items()}


def against_noetic() -> list[str]:
    """Compare one million lookups at depth 5 with single lookups in tf2's C++."""
    head = "  noetic C++, single lookups, depth 5"
    if isinstance(noetic.program(), str):
        return [f"{head}: left out, {noetic.program()}"]
    lines = []
    world = chain(5)
    for order, wanted in (("sorted", 9.0), ("random", 9.0)):
        times = world.times(MANY, in_order=order == "sorted")
        _, answers = noetic.lookups(world.stamps, world.samples, times[:FEW])
        found = world.ask(times[:FEW])
        np.testing.assert_allclose(found.translations, answers[:, :3], rtol=0, atol=1e-12)
        # For some rotations ROS 1 returns a quaternion of the other sign than ROS 2.
        dots = np.einsum("ij,ij->i", found.rotations, answers[:, 3:])
        np.testing.assert_allclose(np.abs(dots), 1.0, rtol=0, atol=1e-12)
        ours, theirs = [], []
        world.ask(times)
        for _ in range(ROUNDS):
            theirs += noetic.lookups(world.stamps, world.samples, times)[0]
            began = time.process_time()
            world.ask(times)
            ours.append((time.process_time() - began) / MANY * 1e9)
        lines.append(
            row(
                f"{head}, {order}",
                statistics.median(ours),
                statistics.median(theirs),
                wanted,
            )
        )
    return lines


def against_peers() -> list[str]:
    """Compare lookups at the same stamps in every installed library."""
    lines = []
    for peer in PEERS:
        if find_spec(peer.module) is None:
            lines.append(f"  {peer.name}: left out, it is not installed")
            continue
        world = chain(peer.depth)
        for order in peer.orders:
            times = world.times(peer.count, in_order=order == "sorted")
            work = peer.ready(world.stamps, world.samples, times)
            peer.compare(work(), world.ask(times))
            taken = interleaved({"ours": partial(world.ask, times), "theirs": work})
            scale = 1e9 / peer.count
            lines.append(
                row(
                    f"  {peer.name}, depth {peer.depth}, {peer.count:,} times, {order}",
                    taken["ours"] * scale,
                    taken["theirs"] * scale,
                    peer.wanted,
                )
            )
    return lines


def threads() -> list[str]:
    """Compare two threads with one thread in wall time, by the fastest round of each.

    Other programs on the two cores slow two threads down more than one thread.
    """
    world = chain(5)
    lines = []
    for order in ("sorted", "random"):
        times = world.times(MANY, in_order=order == "sorted")
        taken = interleaved(
            {"one": partial(world.ask, times), "two": partial(world.ask, times, 2)},
            time.perf_counter,
            rounds=15,
            of=min,
        )
        one, two = taken["one"] / MANY * 1e9, taken["two"] / MANY * 1e9
        lines.append(row(f"  one thread of ours against two, depth 5, {order}", two, one, 1.8))
    return lines


def growth() -> list[str]:
    """Measure the time per lookup by depth, by number of samples, and by size of the batch."""
    lines = []
    for depth, samples, count in (
        (2, 1000, FEW),
        (5, 1000, 1000),
        (5, 1000, FEW),
        (5, 1000, MANY),
        (20, 1000, FEW),
        (5, 100_000, FEW),
        (5, 100_000, MANY),
    ):
        world = chain(depth, samples)
        works = {
            order: partial(world.ask, world.times(count, in_order=order == "sorted"))
            for order in ("sorted", "random")
        }
        taken = interleaved(works)
        told = ", ".join(f"{order} {taken[order] / count * 1e9:.0f} ns" for order in works)
        lines.append(f"  depth {depth}, {samples:,} samples a link, {count:,} times: {told}")
    return lines


def reads_alone() -> list[str]:
    """Compare random lookups with copying only the samples that these lookups need.

    A lookup needs two adjacent samples of 64 bytes in each of five edges. All samples need 32
    megabytes, more than the caches of a processor. numpy copies the samples row by row.
    """
    world = chain(5, FEW)
    times = world.times(MANY, in_order=False)
    rows = [np.zeros((FEW // 2, 16)) for _ in range(5)]
    places = [np.searchsorted(stamps, times) // 2 for stamps in world.stamps]
    copy = np.empty((MANY, 16))

    def reads() -> None:
        for link, place in zip(rows, places, strict=True):
            np.take(link, place, axis=0, out=copy, mode="clip")

    taken = interleaved({"reads": reads, "ours": partial(world.ask, times)})
    reads_ns, ours_ns = (taken[name] / MANY * 1e9 for name in ("reads", "ours"))
    return [
        f"  depth 5, 100,000 samples a link at random: copying the samples {reads_ns:.0f} ns, "
        f"ours {ours_ns:.0f} ns, {ours_ns / reads_ns:.1f} times as long"
    ]


def insertion() -> list[str]:
    """Measure the insertion of 100,000 samples in one call, and one by one."""
    world = chain(1, FEW)
    stamps, places, turns = world.stamps[0], world.samples[0, :, :3], world.samples[0, :, 3:]
    order = np.random.default_rng(3).permutation(FEW)

    def together(rows: np.ndarray) -> None:
        fresh = Buffer(seconds(1e6))
        fresh.set_transforms("f0", "f1", stamps[rows], places[rows], turns[rows])

    poses = [
        TransformStamped(stamp, "f0", "f1", Transform(place, turn))
        for stamp, place, turn in zip(stamps.tolist(), places.tolist(), turns.tolist(), strict=True)
    ]

    def one_by_one() -> None:
        fresh = Buffer(seconds(1e6))
        for pose in poses:
            fresh.set_transform(pose)

    works = {
        "set together, in order": partial(together, np.arange(FEW)),
        "set together, shuffled": partial(together, order),
        "set one by one, in order": one_by_one,
    }
    taken = interleaved(works)
    return [f"  {FEW:,} samples {what}: {taken[what] / FEW * 1e9:.0f} ns each" for what in works]


def memory() -> list[str]:
    """Measure the peak memory of a batch, as numpy reports it, beyond the necessary memory.

    A batch needs its results, and a copy of the samples, which may change during the batch.
    """
    lines = []
    for samples in (1000, FEW):
        world = chain(5, samples)
        times = world.times(3 * MANY, in_order=False)
        world.ask(times[:10])
        tracemalloc.start()
        found = world.ask(times, 2)
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        answers = sum(
            part.nbytes for part in (found.stamps, found.translations, found.rotations, found.valid)
        )
        more = (most - answers - world.stamps.nbytes - world.samples.nbytes) / 2**20
        lines.append(
            f"  {len(times):,} times at random in {samples:,} samples a link, two threads: "
            f"{more:.0f} MiB beyond samples and answers (wanted: 64 at most)"
        )
    return lines


def snapshot() -> list[str]:
    """Compare a snapshot of all frames with one lookup per frame."""
    world = chain(300, 3)
    frames = [f"f{number}" for number in range(1, 301)]
    # A chain is the slowest tree: every frame is below all earlier frames.
    taken = interleaved(
        {
            "sweep": lambda: world.buffer.snapshot(0, seconds(1.015)),
            "each": lambda: [
                world.buffer.lookup_transform("f0", frame, seconds(1.015)) for frame in frames
            ],
        }
    )
    bushy = Buffer()
    for number in range(1, 1001):
        bushy.set_transforms(
            f"f{(number - 1) // 4}",
            f"f{number}",
            [seconds(1), seconds(2)],
            [[1, 0, 0]] * 2,
            [[0, 0, 0.6, 0.8]] * 2,
        )
    names = [f"f{number}" for number in range(1, 1001)]
    more = interleaved(
        {
            "sweep": lambda: bushy.snapshot(0, seconds(1.5)),
            "each": lambda: [bushy.lookup_transform("f0", name, seconds(1.5)) for name in names],
        }
    )
    return [
        f"  all frames of a chain of 300 in one sweep: {taken['sweep'] * 1e3:.1f} ms, "
        f"a lookup each {taken['each'] / taken['sweep']:.1f} times as long",
        f"  all of a tree of 1,000, four to a parent: {more['sweep'] * 1e3:.1f} ms, "
        f"a lookup each {more['each'] / more['sweep']:.1f} times as long",
    ]


def row(what: str, ours: float, theirs: float, wanted: float) -> str:
    """Return one row of the table."""
    return (
        f"{what:<62}{theirs:8.0f} → {ours:5.0f} ns   {theirs / ours:5.1f} times faster "
        f"(wanted: {wanted:g})"
    )


def report() -> str:
    """Run all measurements, and return the table."""
    parts = (
        against_noetic,
        against_peers,
        threads,
        growth,
        reads_alone,
        insertion,
        memory,
        snapshot,
    )
    head = f"batch, nanoseconds a time (median of {ROUNDS} interleaved rounds): theirs → ours"
    return "\n".join([head, *(line for part in parts for line in part())])


if __name__ == "__main__":
    print(report())  # noqa: T201
