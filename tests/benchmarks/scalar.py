"""Single lookups and inserts, compared with ROS 1's tf2 in Python and in C++.

Each compared program is a separate process that gets the same worlds and the same questions. The
answers are compared before anything is timed, and the programs run in turn.
"""

import math
import os
import statistics
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from random import Random

from tests.benchmarks import batch, growth, noetic
from tests.benchmarks.batch_peers import transform_tree_plan
from tests.benchmarks.sides import Side
from tests.differential.compare import PYTHON, missing
from tftool.base.native import SWITCH
from tftool.buffer.native_kernel import IS_NATIVE

SIDE = Path(__file__).with_name("scalar_side.py")
ROOT = Path(__file__).parents[2]
TURNS = 11
MOST = 2000
"""Maximum number of questions per turn; workloads with long chains have fewer."""
SHOWN = 20
"""Number of answers that are compared."""

SECOND = 10**9
PERIOD = 10**7

WANTED = {
    (1000, 5): (8.0, 1.5),
    (100_000, 5): (8.0, 2.0),
    (1000, 20): (None, 2.0),
    (1000, 100): (None, 2.5),
}
"""Wanted ratios (see `Workload`) of lookups at any time, by numbers of samples and links."""

POSES = 997
"""Number of different poses, which form a ring; neighbouring poses are near each other."""


@dataclass(frozen=True)
class World:
    """Edges with many samples each, at about 100 Hz with jitter.

    Attributes:
        links: Parent and child of each edge.
        samples: Number of samples of each edge.
        ends: Target and source of the questions; None for random frames.
    """

    links: tuple[tuple[str, str], ...]
    samples: int
    ends: tuple[str, str] | None = None

    @property
    def newest(self) -> int:
        """Return a time at which every edge has data."""
        return SECOND + (self.samples - 1) * PERIOD

    def command(self) -> list[str]:
        """Return the command that creates this world."""
        return ["make", str(self.samples), *(name for link in self.links for name in link)]

    def pair(self, random: Random) -> tuple[str, str]:
        """Return target and source of a question."""
        if self.ends is not None:
            return self.ends
        return random.choice(self.links)[1], random.choice(self.links)[1]


def chain(depth: int, samples: int = 1000) -> World:
    """Return the chain f0 ← f1 ← …; a chain of two edges has the two turtles in their world."""
    if depth == 2:
        links = (("world", "turtle1"), ("world", "turtle2"))
        return World(links, samples, ("turtle2", "turtle1"))
    links = tuple((f"f{n}", f"f{n + 1}") for n in range(depth))
    return World(links, samples, ("f0", f"f{depth}"))


def tree(frames: int, children: int) -> World:
    """Return a tree with a given number of frames, and of children per frame."""
    return World(tuple((f"f{(n - 1) // children}", f"f{n}") for n in range(1, frames)), 3)


@dataclass(frozen=True)
class Workload:
    """Workload to measure.

    Attributes:
        name: Name in the table.
        world: World of the questions; None for inserts, which begin with an empty buffer.
        command: Function from a round's random numbers to the command for each program.
        wanted: Wanted ratio of the native kernel to tf2_py, and to tf2 in C++.
    """

    name: str
    world: World | None
    command: Callable[[Random], list[str]]
    wanted: tuple[float | None, float | None] = (None, None)


def questions(
    name: str,
    world: World,
    back: int,
    wanted: tuple[float | None, float | None] = (None, None),
    kind: str = "lookup",
    again: bool = False,
) -> Workload:
    """Return a workload of questions about the last `back` periods; 0 for the latest time.

    With `again`, the questions of every round are about the same frames.
    """
    count = max(100, MOST // (1 + len(world.links) // 25)) if world.ends else MOST

    def command(random: Random) -> list[str]:
        words = ["ask", kind]
        pairs = Random(name) if again else random
        for _ in range(count):
            target, source = world.pair(pairs)
            moment = world.newest - 1 - random.randrange(back * PERIOD) if back else 0
            words += [target, str(moment), source]
            if kind == "full":
                # The pose is up to five seconds older, with the fixed frame f0.
                words += [str(max(moment - random.randrange(5 * SECOND), 2 * SECOND)), "f0"]
        return words

    return Workload(name, world, command, wanted)


def inserts(
    name: str,
    order: Callable[[Random], list[int]],
    asked: int,
    wanted: tuple[float | None, float | None] = (None, None),
) -> Workload:
    """Return a workload that inserts samples of one edge, with a cache of ten seconds."""

    def command(random: Random) -> list[str]:
        words = ["insert", str(SECOND + asked * PERIOD + PERIOD // 2)]
        for number in order(random):
            words += [str(SECOND + number * PERIOD), str(number % POSES)]
        return words

    return Workload(name, None, command, wanted)


def _late(random: Random) -> list[int]:
    """Return an order in which every second sample arrives up to four samples too late."""
    due = [number + (random.randrange(400) if number % 2 else 0) for number in range(MOST)]
    return sorted(range(MOST), key=due.__getitem__)


def workloads() -> Iterator[Workload]:
    """Return all workloads; workloads of the same world are adjacent.

    The longest chain comes first, because the memory is measured with it.
    """
    for samples in (100_000, 1000):
        for depth in (5, 2, 20, 100):
            world = chain(depth, samples)
            name = f"any time in {samples:,} samples, {depth} links"
            wanted = WANTED.get((samples, depth), (None, None))
            yield questions(name, world, samples - 2, wanted)
            if samples == 1000 and depth == 5:
                yield questions("latest, 5 links", world, 0)
                yield questions("just now, 5 links", world, 2)
                yield questions("time travel, 5 links", world, 300, kind="full")
                yield questions("whether it can, 5 links", world, 2, kind="can")
            if samples == 1000 and depth == 2:
                yield questions("latest, 2 links", world, 0, (9.0, 1.2))
                yield questions("just now, 2 links", world, 2)
            if samples == 1000 and depth == 20:
                yield questions("just now, 20 links", world, 2)
    for samples in (100, 10_000):
        yield questions(f"any time in {samples:,} samples, 5 links", chain(5, samples), samples - 2)
    for frames in (100, 1000, 10_000):
        world = tree(frames, frames)
        yield questions(f"{frames:,} frames, any two siblings", world, 1, again=True)
    world = tree(10_000, 4)
    yield questions("10,000 frames, any two of a tree", world, 1, again=True)
    yield questions("the same, each two for the first time", world, 1)
    yield inserts("a sample set, in order", lambda random: list(range(MOST)), 1500, (5.0, 1.2))
    yield inserts("a sample set, every second one late", _late, 1500)
    yield inserts("a sample set, in reverse order", lambda random: list(range(900, 0, -1)), 500)


def agree(one: list[float], other: list[float]) -> bool:
    """Whether two lists of answers are equal, up to each quaternion's sign."""
    if len(one) != len(other):
        return False
    width = 7 if len(one) % 7 == 0 else 1
    for first in range(0, len(one), width):
        mine, theirs = one[first : first + width], other[first : first + width]
        near = [abs(a - b) <= 1e-9 * max(1.0, abs(b)) for a, b in zip(mine, theirs, strict=True)]
        far = [abs(a + b) <= 1e-9 for a, b in zip(mine[3:], theirs[3:], strict=True)]
        if not (all(near) or (width == 7 and all(near[:3]) and all(far))):
            return False
    return True


def poses() -> list[str]:
    """Return the poses of the samples: a circle, with two turns about a tilted axis."""
    words = ["poses"]
    for number in range(POSES):
        angle = 2.0 * math.pi * number / POSES
        half = angle
        tilt = 0.1 * math.sin(angle)
        rest = math.sqrt(1.0 - tilt * tilt)
        place = (1.0 + math.cos(angle), 2.0 + math.sin(angle), 0.1 * math.sin(2.0 * angle))
        turn = (tilt, 0.0, math.sin(half) * rest, math.cos(half) * rest)
        words += map(repr, (*place, *turn))
    return words


def sides() -> tuple[dict[str, Side], list[str]]:
    """Return the available programs, and a line for each missing one."""
    lines = []
    switches = {"native": "0", "pure": "1"}
    if not IS_NATIVE:
        del switches["native"]
        lines.append("  native: left out, no kernel was built by `pip install -e .`")
    found = {
        name: Side([PYTHON, SIDE, "ours"], {**os.environ, "PYTHONPATH": str(ROOT), SWITCH: switch})
        for name, switch in switches.items()
    }
    if reason := missing():
        lines.append(f"  tf2_py: left out, {reason}")
    else:
        found["tf2_py"] = Side([PYTHON, SIDE, "debian"])
    program = noetic.program()
    if isinstance(program, str):
        lines.append(f"  tf2 C++: left out, {program}")
    else:
        found["tf2 C++"] = Side([program])
    return found, lines


def together(found: dict[str, Side], command: list[str]) -> list[list[float]]:
    """Return each program's answer to a command; all programs work at the same time."""
    for side in found.values():
        side.tell(*command)
    return [side.answer() for side in found.values()]


def measure(found: dict[str, Side], workload: Workload) -> list[float] | str:
    """Return each program's median nanoseconds per item, or the reason for no comparison."""
    random = Random(workload.name)
    first, *others = (answer[1:] for answer in together(found, workload.command(random)))
    if not all(agree(first, other) for other in others):
        return f"  {workload.name:<42} answers differ"
    turns = []
    for _ in range(TURNS):
        command = workload.command(random)
        turns.append([side.ask(*command)[0] for side in found.values()])
    return [statistics.median(taken) for taken in zip(*turns, strict=True)]


def row(workload: Workload, taken: dict[str, float]) -> str:
    """Return one row of the table."""
    line = f"  {workload.name:<42}" + "".join(f"{one:10.0f}" for one in taken.values())
    if "native" not in taken:
        return line
    for name, wanted in zip(("tf2_py", "tf2 C++"), workload.wanted, strict=True):
        if name in taken:
            ratio = taken[name] / taken["native"]
            line += f"  {ratio:6.2f}" + (
                "" if wanted is None else f" ({wanted:g}{' missed' if ratio < wanted else ''})"
            )
    return line


def against_transform_tree() -> str:
    """Compare with `transform_tree` (Rust): single lookups from Python, with a matrix as result."""
    depth, wanted = 3, 1.0
    name = f"transform_tree, any time in 1,000 samples, {depth} links"
    if find_spec("tf_tree") is None:
        return f"  {name}: left out, it is not installed"
    world = batch.chain(depth)
    plan = transform_tree_plan(world.stamps, world.samples)
    moments = world.times(MOST, in_order=False).tolist()
    lookup, target, source = world.buffer.lookup_transform, "f0", world.source

    def ours() -> None:
        for moment in moments:
            lookup(target, source, moment)

    def theirs() -> None:
        for moment in moments:
            plan.at(moment)

    for moment in moments[:SHOWN]:
        place = lookup(target, source, moment).transform.translation
        if math.dist(place, plan.at(moment)[:3, 3].tolist()) > 1e-9:
            return f"  {name}: answers differ"
    taken = batch.interleaved({"ours": ours, "theirs": theirs}, rounds=TURNS)
    mine, other = (seconds / MOST * 1e9 for seconds in taken.values())
    ratio = other / mine
    missed = " missed" if ratio < wanted else ""
    return f"  {name}: {mine:.0f} ns, theirs {other:.0f} ns, {ratio:.2f} ({wanted:g}{missed})"


def report() -> str:
    """Measure the native kernel and plain Python in the same rounds, and print a table."""
    found, absent = sides()
    lines = [
        f"scalar path, nanoseconds (median of {TURNS} turns each, {PYTHON}); "
        "how many times as fast as tf2_py and as tf2 in C++ native is (wanted)",
        f"  {'':<42}" + "".join(f"{name:>10}" for name in found),
        *absent,
    ]
    table: dict[str, dict[str, float]] = {}
    together(found, poses())
    at: World | None = None
    memory = ""
    for workload in workloads():
        if workload.world is not None and workload.world != at:
            at = workload.world
            sizes = [answer[0] for answer in together(found, at.command())]
            if not memory:
                memory = f"  {'bytes a sample':<42}" + "".join(f"{size:10.1f}" for size in sizes)
        taken = measure(found, workload)
        if isinstance(taken, str):
            lines.append(taken)
            continue
        table[workload.name] = dict(zip(found, taken, strict=True))
        lines.append(row(workload, table[workload.name]))
    for side in found.values():
        side.end()
    memory += "   wanted: 70 at most"
    return "\n".join([*lines, memory, *growth.lines(table), against_transform_tree()])


if __name__ == "__main__":
    print(report())  # noqa: T201
