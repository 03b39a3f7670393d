"""One side of the scalar benchmark, in a process of its own: `scalar_side.py ours|debian`.

Reads the name of a workload a line from standard input; writes nanoseconds for one question,
and for comparison an answer. Both sides run on the system's Python, where Debian's tf2 lives.
"""

import json
import math
import sys
import time
from random import Random

SECOND = 10**9
PERIOD = 10**7
SAMPLES = 1000
ROUNDS = 2000


class Ours:
    """tftool."""

    def __init__(self):
        from tftool.frames.buffer import Buffer
        from tftool.frames.sample import TransformStamped
        from tftool.geometry.rigid import Transform

        self.buffer, self.stamped, self.pose = Buffer, TransformStamped, Transform

    def make(self, cache):
        made = self.buffer(cache)
        return made, made.set_transform, made.lookup_transform, made.can_transform

    def sample(self, parent, child, stamp, place, turn):
        return self.stamped(stamp, parent, child, self.pose(place, turn))

    def moment(self, stamp):
        return stamp

    def numbers(self, found):
        return [*found.transform.translation, *found.transform.rotation]


class Debian:
    """Debian's tf2_py."""

    def __init__(self):
        import genpy
        import tf2_py
        from geometry_msgs.msg import TransformStamped

        self.genpy, self.tf2_py, self.message = genpy, tf2_py, TransformStamped

    def make(self, cache):
        made = self.tf2_py.BufferCore(self.genpy.Duration(cache // SECOND, cache % SECOND))
        return made, made.set_transform, made.lookup_transform_core, made.can_transform_core

    def sample(self, parent, child, stamp, place, turn):
        made = self.message()
        made.header.stamp = self.moment(stamp)
        made.header.frame_id = parent
        made.child_frame_id = child
        to, by = made.transform.translation, made.transform.rotation
        to.x, to.y, to.z = place
        by.x, by.y, by.z, by.w = turn
        return made

    def moment(self, stamp):
        return self.genpy.Time(stamp // SECOND, stamp % SECOND)

    def numbers(self, found):
        to, by = found.transform.translation, found.transform.rotation
        return [to.x, to.y, to.z, by.x, by.y, by.z, by.w]


def turn(angle):
    tilt = 0.1 * math.sin(angle)
    rest = math.sqrt(1.0 - tilt * tilt)
    return (tilt, 0.0, math.sin(angle / 2) * rest, math.cos(angle / 2) * rest)


class Side:
    """The workloads, for either side."""

    def __init__(self, side):
        self.side = side
        self.worlds = {}

    def world(self, depth, samples):
        """A chain of that depth, or for 2 the two turtles."""
        if (depth, samples) not in self.worlds:
            made = self.side.make(10**15)
            pairs = [(f"f{n}", f"f{n + 1}") for n in range(depth)]
            if depth == 2:
                pairs = [("world", "turtle1"), ("world", "turtle2")]
            for k in range(samples):
                for n, (parent, child) in enumerate(pairs):
                    sample = self.side.sample(
                        parent,
                        child,
                        SECOND + k * PERIOD,
                        (1.0 + k * 1e-3, 2.0 + n, 0.0),
                        turn(k * 0.01 + n),
                    )
                    made[1](sample, "benchmark")
            self.worlds[depth, samples] = made
        ends = ("turtle2", "turtle1") if depth == 2 else ("f0", f"f{depth}")
        return self.worlds[depth, samples], ends

    def ask(self, depth, samples, when, call=2):
        made, (target, source) = self.world(depth, samples)
        random = Random(depth)
        newest = SECOND + (samples - 1) * PERIOD
        back = {"latest": 0, "recent": 2 * PERIOD, "any": (samples - 2) * PERIOD}[when]
        if when == "latest":
            moments = [0] * ROUNDS
        else:
            moments = [newest - 1 - random.randrange(back) for _ in range(ROUNDS)]
        moments = [self.side.moment(moment) for moment in moments]
        question = made[call]
        started = time.process_time()
        for moment in moments:
            question(target, source, moment)
        taken = time.process_time() - started
        return taken / ROUNDS * 1e9, self.side.numbers(made[2](target, source, moments[-1]))

    def insert(self, order):
        made = self.side.make(10 * SECOND)
        numbers = range(ROUNDS) if order == "in order" else range(900, 0, -1)
        samples = [
            self.side.sample(
                "world", "turtle1", SECOND + k * PERIOD, (1.0 + k, 2.0, 3.0), turn(k * 0.01)
            )
            for k in numbers
        ]
        put = made[1]
        started = time.process_time()
        for sample in samples:
            put(sample, "benchmark")
        taken = time.process_time() - started
        inside = 1500 if order == "in order" else 500
        asked = self.side.moment(SECOND + inside * PERIOD + PERIOD // 2)
        return taken / len(samples) * 1e9, self.side.numbers(made[2]("world", "turtle1", asked))

    def run(self, name):
        kind, *words = name.split(", ")
        if kind == "insert":
            return self.insert(words[0])
        depth = int(words[0].removeprefix("depth "))
        samples = int(words[2].split()[0]) if len(words) > 2 else SAMPLES
        return self.ask(depth, samples, words[1], 3 if kind == "can" else 2)


def main():
    side = Side({"ours": Ours, "debian": Debian}[sys.argv[1]]())
    for line in sys.stdin:
        sys.stdout.write(json.dumps(side.run(line.strip())) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
