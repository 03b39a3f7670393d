"""Tests with peers of other libraries: C on Debian's Cyclone DDS, C++ on Debian's Fast DDS."""

import asyncio

import pytest

from tests.world.link.conftest import until
from tests.world.link.dds.test_session import joined, transform
from tftool.app.main import main
from tftool.base.stamps import seconds
from tftool.world.clock import WallClock
from tftool.world.endpoints import PUBLISHER
from tftool.world.link.graph import Role

KINDS = pytest.mark.parametrize("kind", ["cyclone", "fast"])


@KINDS
def test_a_foreign_publisher_is_heard_whole_and_its_statics_late(peer, domain, kind):
    foreign = peer(kind, "pub", 300)

    async def scene():
        # The peer publishes its static transform before a reader exists, and waits for a reader of
        # `tf`.
        await until(lambda: ["ready"] in foreign.lines)
        async with joined(domain, read_only=True) as (world, _):
            await until(lambda: {"laser", "base"} <= set(world.buffer.frames()))
            await until(lambda: stamps_of(world, "base")[-1:] == [stamp(299)])
            return world.buffer.samples("base"), world.buffer.samples("laser")

    moving, still = asyncio.run(scene())
    # The buffer stores the last ten seconds, and 300 samples at 100 Hz need only three.
    assert moving.stamps.tolist() == [stamp(number) for number in range(300)]
    assert moving.poses[:, 0].tolist() == [number * 0.5 for number in range(300)]
    assert set(moving.parents) == {"odom"}
    assert still.is_static
    assert set(still.parents) == {"base"}


def stamps_of(world, frame):
    """Return the stamps of a frame; a frame that is only a parent has none."""
    return world.buffer.samples(frame).stamps.tolist() if frame in world.buffer.frames() else []


def stamp(number):
    return seconds(1000) + number * 10_000_000


@KINDS
def test_a_foreign_subscriber_gets_everything_and_statics_late(peer, domain, kind):
    async def scene():
        async with joined(domain) as (world, _):
            world.broadcast([transform("base", "camera", x=0.25)], "mounting", static=True)
            world.broadcast([transform("base", "laser", x=0.5)], "mounting", static=True)
            foreign = peer(kind, "sub")
            await until(lambda: world.tf.far_subscribers)
            # A writer finds a reader a moment after the graph does; earlier messages are lost.
            while not any(line[0] == "tf" for line in foreign.lines):
                world.broadcast([transform("odom", "primer")], "wheels")
                await WallClock().sleep(seconds(0.005))
            for number in range(300):
                world.broadcast([transform("odom", "base", stamp(number), number * 0.5)], "wheels")
                if number % 50 == 49:
                    # The subscription stores its last 100 messages, and many programs run here.
                    await until(lambda sent=number + 1: len(heard(foreign)) == sent)
            await until(lambda: heard(foreign) == expected)
            await until(
                lambda: {"camera", "laser"} <= {line[2] for line in foreign.lines if line[2:]}
            )
            return foreign.lines

    expected = [
        ["odom", "base", str(1000 + number // 100), str(number % 100 * 10_000_000)]
        for number in range(300)
    ]
    lines = asyncio.run(scene())
    numbers = [float(line[5]) for line in lines if line[2:3] == ["base"]]
    assert numbers == [number * 0.5 for number in range(300)]
    assert {tuple(line[1:]) for line in lines if line[0] == "tf_static"} == {
        ("base", "camera", "0", "1", "0.25"),
        ("base", "laser", "0", "1", "0.5"),
    }


def heard(foreign):
    return [line[1:5] for line in foreign.lines if line[2:3] == ["base"]]


def test_tree_and_session_show_a_robot_and_name_its_publishers(peer, domain, capsys):
    foreign = peer("fast", "pub", 100_000)
    asyncio.run(until(lambda: ["ready"] in foreign.lines))

    assert main(["tree", "--dds"]) == 0
    shown = capsys.readouterr().out
    assert "laser" in shown
    assert "fast_peer" in shown

    assert main(["session", "--dds"]) == 0
    listed = capsys.readouterr().out
    assert "tf2_msgs/msg/TFMessage  from fast_peer" in listed


def test_a_publisher_that_asks_too_little_is_told_and_not_heard(peer, domain, capsys):
    foreign = peer("cyclone", "pub_best_effort", 100_000)

    async def scene():
        async with joined(domain, read_only=True) as (world, link):
            said = world.log.records
            await until(lambda: any("best effort" in one.text for one in said))
            await until(lambda: "laser" in world.buffer.frames())
            return said, world.buffer.frames(), link.graph.entities(PUBLISHER, name="tf")

    said, frames, publishers = asyncio.run(scene())
    assert ["ready"] in foreign.lines
    assert not publishers[0].quality.is_reliable
    assert "odom" not in frames
    assert any("tf2 asks for reliable" in one.text for one in said)


def test_a_peer_that_is_killed_is_missed_when_its_lease_is_over(peer, domain):
    foreign = peer("cyclone", "pub", 100_000)

    async def scene():
        async with joined(domain, Role.GUEST, read_only=True) as (world, link):
            await until(lambda: {"laser", "odom"} <= set(world.buffer.frames()))
            foreign.kill()
            await until(lambda: link.graph.is_empty)
            told = [one.text for one in world.log.records]
            return link.departures, world.buffer.frames(), told

    departures, frames, told = asyncio.run(scene())
    assert any("no longer publishes /tf" in one for one in told)
    assert departures == 1
    assert {"odom", "base", "laser"} <= set(frames)


def test_garbage_and_ten_megabytes_of_it_are_dropped_beside_what_is_right(peer, domain):
    async def scene():
        async with joined(domain, read_only=True) as (world, link):
            good, hostile = peer("cyclone", "pub", 300), peer("fast", "hostile", 60)
            await until(lambda: ["sent"] in hostile.lines)
            await until(lambda: ["sent"] in good.lines)
            await until(lambda: world.buffer.frames() and len(link.graph.sessions) == 2)
            await until(lambda: stamps_of(world, "base")[-1:] == [stamp(299)])
            return world.buffer.samples("base").stamps.tolist(), set(world.buffer.frames())

    stamps, frames = asyncio.run(scene())
    assert stamps == [stamp(number) for number in range(300)]
    assert frames == {"odom", "base", "laser"}


def test_a_message_of_ten_megabytes_arrives_whole(domain):
    count = 100_000

    async def scene():
        async with joined(domain) as (robot, _), joined(domain, read_only=True) as (world, _):
            await until(lambda: robot.tf.far_subscribers)
            path = [transform("odom", "base", seconds(100) + at, float(at)) for at in range(count)]
            robot.broadcast(path, "wheels")
            await until(lambda: "base" in world.buffer.frames())
            await until(lambda: len(world.buffer.samples("base").stamps) == count)
            return world.buffer.samples("base")

    samples = asyncio.run(scene())
    assert samples.poses[:, 0].tolist() == list(range(count))
