"""One compared program of the scalar benchmark: `scalar_side.py ours|debian`.

It takes the same commands as `noetic.cpp`, and prints the same answers. It runs on the system's
Python, which has Debian's tf2, and imports only the code that is measured.
"""

import gc
import itertools
import os
import sys
import time

SECOND = 10**9
PERIOD = 10**7
SHOWN = 20


class Ours:
    """tftool's buffer."""

    def __init__(self):
        from tftool.buffer.buffer import Buffer
        from tftool.buffer.sample import TransformStamped
        from tftool.geometry.rigid import Transform

        self.buffer, self.stamped, self.pose = Buffer, TransformStamped, Transform

    def make(self, cache):
        made = self.buffer(cache)
        self.put = made.set_transform
        self.calls = {
            "lookup": made.lookup_transform,
            "full": made.lookup_transform_full,
            "can": made.can_transform,
        }

    def transform(self, numbers):
        return self.pose(numbers[:3], numbers[3:])

    def sample(self, parent, child, stamp, transform):
        return self.stamped(stamp, parent, child, transform)

    # A sample that is sent once needs no copy, because it is an immutable value.
    fresh = sample

    def moment(self, stamp):
        return stamp

    def numbers(self, found):
        return [*found.transform.translation, *found.transform.rotation]

    def yes(self, found):
        return [int(found)]


class Debian:
    """Debian's tf2_py."""

    def __init__(self):
        import genpy
        import tf2_py
        from geometry_msgs.msg import Transform, TransformStamped

        self.genpy, self.tf2_py = genpy, tf2_py
        self.message, self.pose = TransformStamped, Transform
        self.reused = TransformStamped()

    def make(self, cache):
        made = self.tf2_py.BufferCore(self.genpy.Duration(cache // SECOND, cache % SECOND))
        self.put = made.set_transform
        self.calls = {
            "lookup": made.lookup_transform_core,
            "full": made.lookup_transform_full_core,
            "can": made.can_transform_core,
        }

    def transform(self, numbers):
        made = self.pose()
        to, by = made.translation, made.rotation
        to.x, to.y, to.z, by.x, by.y, by.z, by.w = numbers
        return made

    def sample(self, parent, child, stamp, transform):
        return self._fill(self.message(), parent, child, stamp, transform)

    def fresh(self, parent, child, stamp, transform):
        return self._fill(self.reused, parent, child, stamp, transform)

    def _fill(self, made, parent, child, stamp, transform):
        made.header.frame_id, made.child_frame_id = parent, child
        made.header.stamp.secs, made.header.stamp.nsecs = divmod(stamp, SECOND)
        made.transform = transform
        return made

    def moment(self, stamp):
        return self.genpy.Time(stamp // SECOND, stamp % SECOND)

    def numbers(self, found):
        to, by = found.transform.translation, found.transform.rotation
        return [to.x, to.y, to.z, by.x, by.y, by.z, by.w]

    def yes(self, found):
        return [int(found[0])]


class Commands:
    """Commands that a compared program executes."""

    def __init__(self, side):
        self.side = side

    def poses(self, *words):
        numbers = [float(word) for word in words]
        self.table = [numbers[first : first + 7] for first in range(0, len(numbers), 7)]
        return [0]

    def make(self, samples, *names):
        links = list(zip(names[::2], names[1::2]))  # noqa: B905
        transforms = [self.side.transform(numbers) for numbers in self.table]
        self.side.make(10**15)
        before = memory()
        put, fresh, count = self.side.put, self.side.fresh, len(transforms)
        for k in range(int(samples)):
            for n, (parent, child) in enumerate(links):
                stamp = SECOND + k * PERIOD + (k * 7919 + n * 104729) % 500 * 1000
                put(fresh(parent, child, stamp, transforms[(k + 131 * n) % count]), "benchmark")
        return [(memory() - before) / (int(samples) * len(links))]

    def ask(self, kind, *words):
        moment, call = self.side.moment, self.side.calls[kind]
        if kind == "full":
            asked = [
                (target, moment(int(when)), source, moment(int(then)), fixed)
                for target, when, source, then, fixed in zip(*[iter(words)] * 5)  # noqa: B905
            ]
            started = time.process_time()
            for target, when, source, then, fixed in asked:
                call(target, when, source, then, fixed)
        else:
            asked = [
                (target, source, moment(int(when)))
                for target, when, source in zip(*[iter(words)] * 3)  # noqa: B905
            ]
            started = time.process_time()
            for target, source, when in asked:
                call(target, source, when)
        taken = time.process_time() - started
        told = self.side.yes if kind == "can" else self.side.numbers
        shown = (told(call(*question)) for question in asked[:SHOWN])
        return [taken / len(asked) * 1e9, *itertools.chain.from_iterable(shown)]

    def insert(self, asked, *words):
        samples = [
            # Each sample has new number objects, like a sample decoded from a message.
            self.side.sample(
                "world", "turtle1", int(stamp), self.side.transform(self.table[int(pose)])
            )
            for stamp, pose in zip(words[::2], words[1::2])  # noqa: B905
        ]
        self.side.make(10 * SECOND)
        put = self.side.put
        started = time.process_time()
        for sample in samples:
            put(sample, "benchmark")
        taken = time.process_time() - started
        found = self.side.calls["lookup"]("world", "turtle1", self.side.moment(int(asked)))
        return [taken / len(samples) * 1e9, *self.side.numbers(found)]


def memory():
    """Return the bytes of this process that are in memory."""
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")


def main():
    commands = Commands({"ours": Ours, "debian": Debian}[sys.argv[1]]())
    for line in sys.stdin:
        command, *words = line.split()
        answer = getattr(commands, command)(*words)
        sys.stdout.write(" ".join(map(repr, answer)) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
