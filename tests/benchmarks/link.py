"""How fast transforms cross from one process to another, over a real session.

The far end is a process of its own: `python -m tests.benchmarks.link READERS-WORD ...`
is how this file starts it.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.link.graph import Role
from tftool.link.membership import Options
from tftool.link.session import Link
from tftool.runtime.clock import WallClock, run
from tftool.runtime.world import World
from tftool.stamps import seconds

STEADY = 5.0
"""Seconds of the steady stream."""

FLAT_OUT = 10_000
"""Messages sent without a pause."""


# Made beforehand: what is measured is how poses travel, not how they are computed.
POSE = Transform((1.0, 2.0, 0.0))
FRAMES = [f"frame{number}" for number in range(1000)]


def sample_of(stamp, number):
    return TransformStamped(stamp, "world", FRAMES[number], POSE)


async def _read(messages):
    """Take so many messages; say how late each was and how long all took."""
    clock = WallClock()
    world = World(clock)
    delays = []
    arrived = []

    def heard(message):
        arrived.append(time.time_ns())
        delays.append(arrived[-1] - message.transforms[0].stamp)

    with Link(Options("reader")) as link:
        world.tf.subscribe(heard)
        link.attach(world, role=Role.GUEST)
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        silent = 0
        while len(arrived) < messages and silent < 100:
            before = len(arrived)
            await clock.sleep(seconds(0.05))
            silent = silent + 1 if len(arrived) == before else 0
        lost = link.wire.lost
    used = os.times()
    json.dump(
        {
            "received": len(arrived),
            "median_ms": statistics.median(delays) / 1e6 if delays else None,
            "p99_ms": sorted(delays)[int(len(delays) * 0.99)] / 1e6 if delays else None,
            "seconds": (arrived[-1] - arrived[0]) / 1e9 if arrived else None,
            "overrun": lost,
            "cpu": used.user + used.system,
        },
        sys.stdout,
    )


async def _send(link, world, size, count, period):
    while len(link.graph.entities("MS", name="tf")) < _send.readers:
        await world.clock.sleep(seconds(0.01))
    due = world.clock.now()
    for _ in range(count):
        stamp = time.time_ns()
        world.broadcast([sample_of(stamp, number) for number in range(size)], "bench")
        if period:
            due += period
            await world.clock.sleep_until(due)
    await world.clock.sleep(seconds(0.2))


def measure(*, size, count, period, readers=1):
    """Send `count` messages of `size` transforms; give what each reader found."""
    with tempfile.TemporaryDirectory(prefix="tf") as folder:
        os.environ["TFTOOL_SESSION_DIR"] = folder
        world = World(WallClock())
        with Link(Options("sender")) as link:

            async def work():
                link.attach(world, role=Role.HOST)
                far = [
                    subprocess.Popen(
                        [sys.executable, "-m", "tests.benchmarks.link", str(count)],
                        stdout=subprocess.PIPE,
                        text=True,
                    )
                    for _ in range(readers)
                ]
                _send.readers = readers
                await _send(link, world, size, count, period)
                while any(process.poll() is None for process in far):
                    await world.clock.sleep(seconds(0.05))
                return [json.loads(process.stdout.read().partition("\n")[2]) for process in far]

            return run(world.clock, work())


def report() -> str:
    """Measure, and say it in a few lines."""
    lines = ["link, one process to another (unix sockets)"]
    (steady,) = measure(size=3, count=int(100 * STEADY), period=seconds(0.01))
    lines.append(
        f"  100 Hz x 3: median {steady['median_ms']:.3f} ms, p99 {steady['p99_ms']:.3f} ms, "
        f"{steady['received']} of {int(100 * STEADY)} arrived (wanted: under 1 ms, all)"
    )
    (flood,) = measure(size=20, count=FLAT_OUT, period=0)
    pace = flood["received"] * 20 / flood["seconds"]
    lines.append(
        f"  flat out x 20: {flood['received']} of {FLAT_OUT} arrived, {pace:,.0f} transforms/s "
        "(wanted: all, 100,000)"
    )
    eight = measure(size=20, count=int(100 * STEADY), period=seconds(0.01), readers=8)
    arrived = sorted(one["received"] for one in eight)
    lines.append(
        f"  100 Hz x 20 to 8 readers: {arrived[0]} to {arrived[-1]} of {int(100 * STEADY)} arrived"
    )
    return "\n".join(lines)


if __name__ == "__main__":
    clock = WallClock()
    run(clock, _read(int(sys.argv[1])))
