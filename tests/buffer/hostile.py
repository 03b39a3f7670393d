"""Hostile operations on a buffer for the sanitizers: python -m tests.buffer.hostile [COUNT].

The names' classes drop paths, change edges or collect garbage while names are compared. Meanwhile
other threads look up, and frames are added and dropped. Any exception of Python is fine here; the
sanitizers report invalid reads and writes of the kernel.
"""

import contextlib
import gc
import pickle
import random
import sys
import threading

import numpy as np

from tftool.base.stamps import seconds
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

FRAMES = [f"f{number}" for number in range(24)]


class World:
    """A buffer, and the random numbers that decide which operations are applied to it."""

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.buffer = Buffer(seconds(5), log=lambda level, sentence: None)
        self.now = seconds(10)

    def name(self) -> str:
        """Return a frame's name; one in four has a class that runs hostile code when compared."""
        name = self.draw.choice(FRAMES)
        return self.striking(name) if self.draw.random() < 0.25 else name

    def striking(self, name: str) -> str:
        buffer, draw = self.buffer, self.draw

        class Striking(str):
            def __eq__(self, other: object) -> bool:
                match draw.randrange(5):
                    case 0:
                        buffer.clear()
                    case 1:
                        gc.collect(0)
                    case 2:
                        raise RuntimeError("compared")
                return str.__eq__(self, other)

            __hash__ = str.__hash__

        return Striking(name)

    def insert(self) -> None:
        self.now += self.draw.randrange(-seconds(1), seconds(1))
        place = tuple(self.draw.uniform(-1.0, 1.0) for _ in range(3))
        sample = TransformStamped(self.now, self.name(), self.name(), Transform(place))
        self.buffer.set_transform(sample, self.name())

    def insert_many(self) -> None:
        count = self.draw.randrange(1, 40)
        stamps = self.now + np.arange(count) * 1_000_000
        turns = np.tile([0.0, 0.0, 0.0, 1.0], (count, 1))
        self.buffer.set_transforms(self.name(), self.name(), stamps, np.zeros((count, 3)), turns)

    def ask(self) -> None:
        time = 0 if self.draw.random() < 0.5 else self.now
        pair = self.name(), self.name()
        match self.draw.randrange(5):
            case 0:
                self.buffer.lookup_transform(*pair, time)
            case 1:
                self.buffer.can_transform(*pair, time)
            case 2:
                self.buffer.lookup_transform_full(pair[0], time, pair[1], time, self.name())
            case 3:
                self.buffer.lookup_transforms(*pair, np.full(9, time), missing="nan")
            case _:
                found = self.buffer.lookup_transform(*pair, time)
                assert pickle.loads(pickle.dumps(found)) == found

    def step(self) -> None:
        """Do one random operation; ignore an exception of Python."""
        with contextlib.suppress(Exception):
            drawn = self.draw.random()
            if drawn < 0.45:
                self.insert()
            elif drawn < 0.5:
                self.insert_many()
            elif drawn < 0.502:
                self.buffer.clear()
            elif drawn < 0.505:
                gc.collect()
            else:
                self.ask()


def run(count: int, threads: int = 2) -> None:
    """Run random operations in several threads, on their own buffers and on a shared buffer."""
    shared = World(0)

    def work(seed: int) -> None:
        own = World(seed)
        for number in range(count):
            (own if number % 4 else shared).step()

    running = [threading.Thread(target=work, args=(seed + 1,)) for seed in range(threads)]
    for thread in running:
        thread.start()
    for thread in running:
        thread.join()


def grow(frames: int) -> int:
    """Insert frames below one root, and look some up; return the number of frames."""
    buffer = Buffer(NO_LIMIT, max_frames=frames + 1)
    for number in range(frames):
        for stamp in (1, 2):
            sample = TransformStamped(stamp, "root", f"n{number}", Transform((1.0, 0.0, 0.0)))
            buffer.set_transform(sample)
    for number in range(0, frames, max(1, frames // 1000)):
        buffer.lookup_transform("root", f"n{number}")
    return len(buffer.frames())


if __name__ == "__main__":
    HOW_MANY = int(sys.argv[1]) if len(sys.argv) > 1 else 20_000
    run(HOW_MANY // 2)
    print(HOW_MANY, "hostile operations,", grow(max(1, HOW_MANY // 2)), "frames")  # noqa: T201
