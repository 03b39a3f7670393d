"""Random worlds: samples set, good and bad, and questions asked in between.

A world is a list of steps, each a plain list that JSON can carry:

    ["set", parent, child, stamp, [x, y, z, qx, qy, qz, qw], static]
    ["lookup", target, source, time]
    ["lookup_full", target, target_time, source, source_time, fixed]
    ["can", target, source, time]
    ["can_full", target, target_time, source, source_time, fixed]
    ["latest", target, source]
    ["exists", frame]
    ["frames"]
"""

import math
from random import Random
from typing import Any, NamedTuple

SECOND = 10**9

# Rotations at which signs and branches change: half turns, quarter turns, thirds
_SPECIAL = [
    (0.0, 0.0, 0.0, 1.0),
    (1.0, 0.0, 0.0, 0.0),
    (0.0, 0.0, 1.0, 0.0),
    (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)),
    (0.5, 0.5, 0.5, 0.5),
]


class World(NamedTuple):
    """Length of the cache in nanoseconds, and the steps."""

    cache: int
    steps: list[list[Any]]


def world(seed: int, questions: int = 100) -> World:
    """Return the world of a seed; the result is always the same."""
    random = Random(seed)
    frames = [f"f{n}" for n in range(random.randint(3, 12))]
    cache = random.choice([10 * SECOND, 10 * SECOND, 2 * SECOND, 100 * SECOND])
    # Random frequency of each kind of difficult data in this world
    restless = random.choice([0.0, 0.0, 0.02, 0.2])
    loops = random.random() < 0.3
    late = random.choice([0.0, 0.1, 0.5])
    start = random.choice([0, 1, 1_000_000, 1_600_000_000]) * SECOND
    # Debian's binding passes times as floats in seconds. Beyond some weeks, only multiples of 1/512
    # s arrive exactly.
    grid = 1 if start < 10**16 else SECOND // 512
    trees = random.randint(1, 3)

    parents: dict[str, str] = {}
    for number, frame in enumerate(frames[trees:], trees):
        parents[frame] = frames[random.randrange(number)]
    statics = {frame for frame in parents if random.random() < 0.25}

    steps: list[list[Any]] = []
    stamps = [start]
    now = start
    asked = 0
    while asked < questions:
        now += random.choice([0, SECOND // 4, SECOND // 4, random.randrange(SECOND)])
        for child in parents:
            if random.random() < 0.5:
                continue
            if random.random() < restless:
                above = frames if loops else frames[: frames.index(child)]
                parents[child] = random.choice([one for one in above if one != child])
            stamp = now
            if random.random() < late:
                stamp = max(0, now - random.randrange(12 * SECOND))
            elif random.random() < 0.1:
                stamp = random.choice(stamps)
            stamp -= stamp % grid
            stamps.append(stamp)
            steps.append(["set", parents[child], child, stamp, _pose(random), child in statics])
        if random.random() < 0.2:
            steps.append(_bad_set(random, frames, now - now % grid))
        for _ in range(random.randint(1, 6)):
            steps.append(_question(random, frames, stamps[-60:], now, grid))
            asked += 1
    return World(cache, steps)


def _pose(random: Random) -> list[float]:
    place = [random.uniform(-100.0, 100.0) for _ in range(3)]
    if random.random() < 0.2:
        return [*place, *random.choice(_SPECIAL)]
    while True:
        turn = [random.gauss(0.0, 1.0) for _ in range(4)]
        length = math.sqrt(sum(part * part for part in turn))
        if length > 0.1:
            return [*place, *(part / length for part in turn)]


def _bad_set(random: Random, frames: list[str], now: int) -> list[Any]:
    """Return a sample that both programs must refuse, or with a slash that both remove."""
    child, parent = random.sample(frames, 2)
    pose = _pose(random)
    kind = random.randrange(6)
    if kind == 0:
        return ["set", child, child, now, pose, False]
    if kind == 1:
        return ["set", "", child, now, pose, False]
    if kind == 2:
        return ["set", parent, random.choice(["", "/"]), now, pose, False]
    if kind == 3:
        pose[random.randrange(7)] = math.nan
        return ["set", parent, child, now, pose, False]
    if kind == 4:
        return ["set", parent, child, now, [*pose[:3], 0.0, 0.0, 0.0, 0.0], False]
    return ["set", "/" + frames[0], "/leaf", now, pose, False]


def _question(
    random: Random, frames: list[str], stamps: list[int], now: int, grid: int
) -> list[Any]:
    def frame() -> str:
        if random.random() < 0.03:
            return random.choice(["ghost", "", "/f0", "leaf"])
        return random.choice(frames)

    def time() -> int:
        kind = random.random()
        if kind < 0.25:
            return 0
        if kind < 0.5:
            return random.choice(stamps)
        if kind < 0.6:
            return max(0, random.choice(stamps) + random.choice([-grid, grid]))
        moment = max(0, now + SECOND - random.randrange(5 * SECOND))
        return moment - moment % grid

    kind = random.random()
    if kind < 0.45:
        return ["lookup", frame(), frame(), time()]
    if kind < 0.6:
        return ["lookup_full", frame(), time(), frame(), time(), frame()]
    if kind < 0.75:
        return ["can", frame(), frame(), time()]
    if kind < 0.83:
        return ["can_full", frame(), time(), frame(), time(), frame()]
    if kind < 0.95:
        return ["latest", frame(), frame()]
    if kind < 0.98:
        return ["exists", frame()]
    return ["frames"]
