"""Rate and delay of transforms between two processes, over a real session, DDS and Foxglove.

The other end is a separate process, which this file starts as
`python -m tests.benchmarks.link READERS-WORD ...`.
"""

import contextlib
import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import foxglove

from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import decode_columns, decode_transforms, encode_transforms
from tftool.world.clock import WallClock, run
from tftool.world.link.dds.reach import DdsReach
from tftool.world.link.foxglove.reach import FoxgloveReach
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.world import World

STEADY = 5.0
"""Length of the stream at a steady rate, seconds."""

FLAT_OUT = 10_000
"""Number of messages that are sent without a pause."""


# The poses are made in advance, because the benchmark measures their transport only.
POSE = Transform((1.0, 2.0, 0.0))
FRAMES = [f"frame{number}" for number in range(1000)]


def sample_of(stamp, number):
    return TransformStamped(stamp, "world", FRAMES[number], POSE)


DDS_DOMAIN = 87
"""DDS domain of the measurements, which use the loopback interface only."""


def options(name, middleware):
    if middleware.startswith("ws://"):
        return Options(name, 0, FoxgloveReach(middleware), read_only=True)
    return Options(name, DDS_DOMAIN, DdsReach()) if middleware == "dds" else Options(name)


async def _read(messages, middleware):
    """Receive some messages; print the delay of each message, and the time for all."""
    clock = WallClock()
    world = World(clock)
    delays = []
    arrived = []

    def heard(message):
        arrived.append(time.time_ns())
        delays.append(arrived[-1] - message.transforms[0].stamp)

    with Link(options("reader", middleware)) as link:
        world.tf.subscribe(heard)
        link.attach(world, role=Role.GUEST)
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        silent = 0
        while len(arrived) < messages and silent < 100:
            before = len(arrived)
            await clock.sleep(seconds(0.05))
            silent = silent + 1 if len(arrived) == before else 0
        lost = link.middleware.lost
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
    while len(link.graph.entities("subscription", name="tf")) < _send.readers:
        await world.clock.sleep(seconds(0.01))
    due = world.clock.now()
    for _ in range(count):
        stamp = time.time_ns()
        world.broadcast([sample_of(stamp, number) for number in range(size)], "bench")
        if period:
            due += period
            await world.clock.sleep_until(due)
    await world.clock.sleep(seconds(0.2))


def measure(*, size, count, period, readers=1, middleware="zenoh"):
    """Send `count` messages of `size` transforms; return the results of each reader."""
    with tempfile.TemporaryDirectory(prefix="tf") as folder:
        os.environ["TFTOOL_SESSION_DIR"] = folder
        world = World(WallClock())
        with Link(options("sender", middleware)) as link:

            async def work():
                link.attach(world, role=Role.HOST)
                far = [
                    subprocess.Popen(
                        [sys.executable, "-m", "tests.benchmarks.link", str(count), middleware],
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


def measure_foxglove(*, size, count, period):
    """Send the same messages from foxglove-sdk's server; return the results of its reader."""
    subscribed = threading.Event()

    class Listener(foxglove.websocket.ServerListener):
        def on_subscribe(self, client, channel):
            subscribed.set()

    server = foxglove.start_server(host="127.0.0.1", port=0, server_listener=Listener())
    schema = foxglove.Schema(name="tf2_msgs/msg/TFMessage", encoding="ros2msg", data=b"")
    tf = foxglove.Channel("/tf", message_encoding="cdr", schema=schema)
    clock = WallClock()

    async def work():
        due = clock.now()
        for _ in range(count):
            stamp = time.time_ns()
            tf.log(encode_transforms([sample_of(stamp, number) for number in range(size)]))
            due += period
            await clock.sleep_until(due)

    reader = [sys.executable, "-m", "tests.benchmarks.link", str(count)]
    far = subprocess.Popen(
        [*reader, f"ws://127.0.0.1:{server.port}"], stdout=subprocess.PIPE, text=True
    )
    subscribed.wait()
    run(clock, work())
    found = json.loads(far.communicate()[0].partition("\n")[2])
    server.stop()
    return found


def paths(size=20_000):
    """Return samples per second of a message with one long path, inserted at once or singly."""
    payload = encode_transforms([sample_of(10**18 + step, 0) for step in range(size)])

    def at_once():
        columns = decode_columns(payload)
        Buffer().set_transforms(
            "world", "frame0", columns.stamps, columns.translations, columns.rotations
        )

    def one_by_one():
        buffer = Buffer()
        for sample in decode_transforms(payload):
            buffer.set_transform(sample)

    found = {}
    for way in (at_once, one_by_one) * 5:
        began = time.perf_counter()
        way()
        found.setdefault(way, []).append(size / (time.perf_counter() - began))
    return max(found[at_once]), max(found[one_by_one])


ALONE = """
import sys
from tftool.app.main import main
from tftool.commands.shared.connection import Providers
class Alone(Providers):
    def link(self, options):
        return None
providers = Alone() if sys.argv[1] == "alone" else None
sys.exit(main(["static", "--frame-id", "A", "--child-frame-id", "B", "--once"], providers))
"""


def opening():
    """Return the seconds of a command in a session with another waiting process, and without."""
    found = {"linked": [], "alone": []}
    with holding_out():
        for way in (*found,) * 8:
            began = time.perf_counter()
            subprocess.run([sys.executable, "-c", ALONE, way], check=True, capture_output=True)
            found[way].append(time.perf_counter() - began)
    return min(found["linked"]), min(found["alone"])


@contextlib.contextmanager
def holding_out():
    """Host a session in which nothing happens: `tftool static` after its transform is published."""
    with tempfile.TemporaryDirectory(prefix="tf") as folder:
        os.environ["TFTOOL_SESSION_DIR"] = folder
        words = ["static", "--frame-id", "A", "--child-frame-id", "B"]
        with subprocess.Popen(
            [sys.executable, "-u", "-m", "tftool", *words], stdout=subprocess.PIPE, text=True
        ) as static:
            static.stdout.readline()
            yield static.pid
            static.terminate()


def idle(duration=5.0):
    """Return the share of a core that an idle session uses; None except on Linux."""

    def used():
        fields = stat.read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    with holding_out() as pid:
        stat = Path(f"/proc/{pid}/stat")
        if not stat.exists():
            return None
        pause = threading.Event()
        pause.wait(1.0)
        before = used()
        pause.wait(duration)
        return (used() - before) / duration


def report() -> str:
    """Measure, and print a few lines."""
    lines = ["link, one process to another (unix sockets)"]
    linked, alone = opening()
    lines.append(
        f"  a command with a link: {linked * 1e3:.0f} ms, without: {alone * 1e3:.0f} ms "
        "(wanted: under 150 ms more)"
    )
    share = idle()
    if share is not None:
        lines.append(f"  a session in which nothing happens: {share:.1%} of a core (wanted: 2 %)")
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
    (robot,) = measure(size=100, count=int(100 * STEADY), period=seconds(0.01), middleware="dds")
    (same,) = measure(size=100, count=int(100 * STEADY), period=seconds(0.01))
    lines.append(
        f"  over DDS, 100 Hz x 100: median {robot['median_ms']:.3f} ms, "
        f"{robot['received']} of {int(100 * STEADY)} arrived (wanted: 2 ms, all); "
        f"{robot['median_ms'] / same['median_ms']:.1f} times zenoh's"
    )
    (rush,) = measure(size=100, count=2500, period=seconds(0.0012), middleware="dds")
    pace = rush["received"] * 100 / rush["seconds"]
    lines.append(
        f"  over DDS, 833 Hz x 100: {rush['received']} of 2500 arrived, {pace:,.0f} transforms/s "
        "(wanted: all, 50,000)"
    )
    robot = measure_foxglove(size=100, count=int(100 * STEADY), period=seconds(0.01))
    lines.append(
        f"  over Foxglove, 100 Hz x 100: median {robot['median_ms']:.3f} ms, "
        f"{robot['received']} of {int(100 * STEADY)} arrived; "
        f"{robot['median_ms'] / same['median_ms']:.1f} times zenoh's"
    )
    at_once, one_by_one = paths()
    lines.append(
        f"  a path of 20,000 in one message: {at_once:,.0f} samples/s into the buffer at once, "
        f"{one_by_one:,.0f} one by one"
    )
    return "\n".join(lines)


if __name__ == "__main__":
    clock = WallClock()
    run(clock, _read(int(sys.argv[1]), sys.argv[2]))
