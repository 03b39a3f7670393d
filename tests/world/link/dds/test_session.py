"""Tests of two worlds of tftool that share a session over DDS."""

import asyncio
import contextlib

import pytest

from tests.world.link.conftest import new_world, until
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, Endpoint, Quality
from tftool.world.link.dds.reach import DdsReach
from tftool.world.link.graph import NODE, Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.node import Node

TWIST = INTERFACES.message("geometry_msgs/msg/Twist")


class Silent(Node):
    async def run(self):
        await asyncio.Event().wait()


@contextlib.asynccontextmanager
async def joined(domain, role=Role.SOURCE, **options):
    world = new_world()
    with Link(Options("test", domain, DdsReach(), **options)) as link:
        link.attach(world, role=role)
        yield world, link


def nodes_of(link, topic):
    return {one.node for one in link.graph.entities(PUBLISHER, name=topic)}


def transform(parent, child, stamp=1, x=1.0):
    return TransformStamped(stamp, parent, child, Transform((x, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0)))


def test_a_late_joiner_gets_all_statics_and_who_sent_them(domain):
    async def scene():
        async with joined(domain) as (robot, _):
            robot.broadcast([transform("base", "laser", x=0.5)], "mounting", static=True)
            robot.broadcast([transform("base", "camera", x=0.25)], "mounting", static=True)
            async with joined(domain, read_only=True) as (late, link):
                await until(lambda: {"laser", "camera"} <= set(late.buffer.frames()))
                found = late.buffer.lookup_transform("base", "laser")
                await until(lambda: nodes_of(link, "tf_static") == {"mounting"})
        return found

    found = asyncio.run(scene())
    assert found.transform.translation == (0.5, 2.0, 3.0)


def test_transforms_travel_with_their_stamps_and_their_publisher(domain):
    async def scene():
        async with joined(domain) as (robot, _), joined(domain, read_only=True) as (other, link):
            await until(lambda: robot.tf.far_subscribers)
            stamps = [seconds(100) + number for number in range(300)]
            for stamp in stamps:
                robot.broadcast([transform("odom", "base", stamp, x=float(stamp % 7))], "wheels")
            await until(lambda: "base" in other.buffer.frames())
            await until(lambda: len(other.buffer.samples("base").stamps) == 300)
            samples = other.buffer.samples("base")
            await until(lambda: "wheels" in {one.node for one in link.graph.entities(PUBLISHER)})
            return stamps, samples

    stamps, samples = asyncio.run(scene())
    assert samples.stamps.tolist() == stamps
    assert samples.poses[:, 0].tolist() == [stamp % 7 for stamp in stamps]


def test_a_topic_of_any_known_type_travels_both_ways(domain):
    async def scene():
        heard = {"one": [], "two": []}
        async with joined(domain) as (one, _), joined(domain) as (two, _):
            for name, world in (("one", one), ("two", two)):
                topic = world.topic("cmd_vel", TWIST)
                topic.subscribe(lambda value, name=name: heard[name].append(value), name)
            await until(lambda: one.topic("cmd_vel", TWIST).far_subscribers)
            await until(lambda: two.topic("cmd_vel", TWIST).far_subscribers)
            message = TWIST()
            message.linear.x = 1.5
            one.topic("cmd_vel", TWIST).publish(message)
            await until(lambda: heard["two"])
            message = TWIST()
            message.angular.z = -0.5
            two.topic("cmd_vel", TWIST).publish(message)
            await until(lambda: len(heard["one"]) == 2)
        return heard

    heard = asyncio.run(scene())
    assert [one.linear.x for one in heard["two"]] == [1.5, 0.0]
    assert [one.angular.z for one in heard["one"]] == [0.0, -0.5]


def test_nodes_are_named_and_what_only_looks_shows_none(domain):
    async def scene():
        async with joined(domain) as (robot, _), joined(domain, read_only=True) as (_, link):
            Silent(robot, "arm/driver")
            quality = Quality(depth=3, is_reliable=False)
            robot.endpoints.add(
                Endpoint(PUBLISHER, "arm/driver", "speed", TWIST.interface__, quality)
            )
            robot.topic("speed", TWIST)
            await until(
                lambda: [
                    one
                    for one in link.graph.entities(PUBLISHER, name="speed")
                    if one.node == "arm/driver"
                ]
            )
            await until(lambda: link.graph.entities(NODE))
            found = link.graph.entities(PUBLISHER, name="speed")[0]
            async with joined(domain) as (_, third):
                await until(lambda: third.graph.processes())
                seen = {one.node for one in third.graph.entities(SUBSCRIPTION)}
            return found, {one.node for one in link.graph.entities(NODE)}, seen

    found, nodes, _ = asyncio.run(scene())
    assert not found.quality.is_reliable
    assert found.type_hash.startswith("RIHS01_")
    assert "arm/driver" in nodes


def test_a_process_that_leaves_is_gone_from_the_graph(domain):
    async def scene():
        async with joined(domain, read_only=True) as (_, link):
            async with joined(domain, Role.HOST) as (robot, _):
                robot.broadcast([transform("odom", "base")], "wheels")
                await until(lambda: link.graph.entities(PUBLISHER, name="tf"))
                host = link.graph.processes()[0]
            await until(lambda: link.graph.is_empty)
            return host, link.departures

    host, departures = asyncio.run(scene())
    assert (host.role, host.command) == (Role.HOST, "test")
    assert departures == 1


@pytest.mark.parametrize("published", ["other_domain", "other_type"])
def test_messages_of_another_domain_or_type_are_not_received(domain, published):
    async def scene():
        async with joined(domain, read_only=True) as (world, link):
            heard = []
            topic = world.topic("cmd_vel", TWIST)
            topic.subscribe(heard.append, "test")
            elsewhere = domain + 100 if published == "other_domain" else domain
            kind = (
                TWIST if published == "other_domain" else INTERFACES.message("std_msgs/msg/Empty")
            )
            async with joined(elsewhere) as (other, _), joined(elsewhere) as (near, _):
                far = []
                near.topic("cmd_vel", kind).subscribe(far.append, "test")
                await until(lambda: other.topic("cmd_vel", kind).far_subscribers)
                other.topic("cmd_vel", kind).publish(kind())
                await until(lambda: far)
            return heard, link.received

    assert asyncio.run(scene()) == ([], 0)
