"""Tests with a server of another library, foxglove-sdk's: all its data arrives."""

import asyncio
import struct

import pytest

from tests.world.link.conftest import until
from tests.world.link.foxglove.conftest import foxglove, joined, transform
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES, build
from tftool.messages.codec import Codec, codec
from tftool.messages.layouts import ROS1
from tftool.messages.transforms import encode_transforms
from tftool.world.clock import FollowedClock, WallClock
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION
from tftool.world.link.graph import NODE, SERVER

STRING = INTERFACES.message("std_msgs/String")
CLOCK = INTERFACES.message("rosgraph_msgs/Clock")


def at(second, nanosecond=0):
    return foxglove.messages.Timestamp(second, nanosecond)


def hung(parent, child, second, x):
    return foxglove.messages.FrameTransform(
        timestamp=at(second, 5),
        parent_frame_id=parent,
        child_frame_id=child,
        translation=foxglove.messages.Vector3(x=x, y=0.0, z=-1.0),
        rotation=foxglove.messages.Quaternion(x=0.0, y=0.0, z=1.0, w=0.0),
    )


async def subscribed(robot, *topics):
    await until(lambda: set(topics) <= set(robot.subscribed))


def test_transforms_in_cdr_arrive_with_their_stamps_and_names(robots):
    async def scene():
        robot = robots()
        tf = robot.topic("/tf")
        with joined(robot.address) as (world, link):
            await subscribed(robot, "/tf")
            for number in range(50):
                sample = transform("odom", "base", seconds(100) + number, number * 0.5)
                tf.log(encode_transforms([sample]))
            await until(lambda: link.received == 50)
            return world.buffer.samples("base")

    samples = asyncio.run(scene())
    assert samples.stamps.tolist() == [seconds(100) + number for number in range(50)]
    assert samples.poses[:, 0].tolist() == [number * 0.5 for number in range(50)]


def test_a_late_joiner_gets_every_static_transform(robots):
    async def scene():
        robot = robots()
        statics = robot.topic("/tf_static")
        for name in ("laser", "camera", "imu"):
            robot.keep(statics, encode_transforms([transform("base", name, 0, 0.25)]))
        for _ in range(2):
            with joined(robot.address) as (world, _link):
                await until(lambda w=world: {"laser", "camera", "imu"} <= set(w.buffer.frames()))
                found = world.buffer.lookup_transform("base", "imu")
                assert found.transform.translation == (0.25, 2.0, 3.0)

    asyncio.run(scene())


def test_protobuf_of_foxglove_is_heard_from_any_topic(robots):
    async def scene():
        robot = robots()
        many = robot.offer(
            foxglove.channels.FrameTransformsChannel("/world/frames", context=robot.context)
        )
        one = robot.offer(foxglove.channels.FrameTransformChannel("/tf", context=robot.context))
        still = robot.offer(
            foxglove.channels.FrameTransformsChannel("/arm/tf_static", context=robot.context)
        )
        with joined(robot.address) as (world, link):
            await subscribed(robot, "/world/frames", "/tf", "/arm/tf_static")
            many.log(
                foxglove.messages.FrameTransforms(
                    transforms=[hung("map", "odom", 7, 0.5), hung("odom", "base", 7, 1.5)]
                )
            )
            one.log(hung("base", "wheel", 8, 2.5))
            still.log(foxglove.messages.FrameTransforms(transforms=[hung("base", "laser", 0, 3.5)]))
            await until(lambda: link.received == 3)
            return world.buffer

    buffer = asyncio.run(scene())
    found = buffer.lookup_transform("map", "odom", seconds(7) + 5)
    assert found.transform.translation == (0.5, 0.0, -1.0)
    assert found.transform.rotation == (0.0, 0.0, 1.0, 0.0)
    assert buffer.lookup_transform("base", "wheel", seconds(8) + 5).stamp == seconds(8) + 5
    assert buffer.samples("laser").is_static
    assert not buffer.samples("odom").is_static


def test_messages_of_ros_1_become_those_of_ros_2(robots):
    kind = INTERFACES.message("tf2_msgs/TFMessage")
    message = codec(kind).decode(encode_transforms([transform("odom", "base", seconds(3), 0.5)]))
    # A header in ROS 1 has a counter of four bytes before the stamp.
    payload = Codec(kind, ROS1).encode(message)
    text = Codec(STRING, ROS1).encode(build(STRING, data="<robot/>"))

    async def scene():
        robot = robots()
        options = {"encoding": "ros1", "schema_encoding": "ros1msg"}
        tf = robot.topic("/tf", "tf2_msgs/TFMessage", **options)
        described = robot.topic("/robot_description", "std_msgs/String", **options)
        robot.keep(described, text)
        heard = []
        with joined(robot.address) as (world, _):
            world.subscribe("test", "robot_description", STRING, heard.append)
            await subscribed(robot, "/tf", "/robot_description")
            tf.log(payload)
            await until(lambda: heard and "base" in world.buffer.frames())
            return world.buffer.samples("base"), heard[0].data

    samples, described = asyncio.run(scene())
    assert samples.stamps.tolist() == [seconds(3)]
    assert samples.poses[0, :3].tolist() == [0.5, 2.0, 3.0]
    assert described == "<robot/>"


def test_publishers_subscribers_and_services_are_named_by_the_connection_graph(robots):
    graph = foxglove.websocket.ConnectionGraph()
    graph.set_published_topic("/tf", ["/ekf"])
    graph.set_subscribed_topic("/tf", ["/planner"])
    graph.set_advertised_service("/reset", ["/ekf"])

    async def scene():
        robot = robots(capabilities=[foxglove.websocket.Capability.ConnectionGraph])
        tf = robot.topic("/tf")
        robot.topic("/scan", "sensor_msgs/msg/LaserScan")
        robot.server.publish_connection_graph(graph)
        with joined(robot.address) as (world, link):
            await subscribed(robot, "/tf")
            await until(lambda: link.graph.entities(NODE))
            tf.log(encode_transforms([transform("odom", "base")]))
            await until(lambda: "base" in world.buffer.frames())
            (frame,) = (one for one in world.buffer.snapshot(1).frames if one.frame == "base")
            shown = {
                (one.kind, one.name, one.node)
                for one in link.graph.entities(PUBLISHER, SUBSCRIPTION, NODE, SERVER)
            }
            return frame.authority, shown

    authority, shown = asyncio.run(scene())
    assert authority == "ekf"
    assert shown == {
        (PUBLISHER, "tf", "ekf"),
        (PUBLISHER, "scan", "bridge"),
        (SUBSCRIPTION, "tf", "planner"),
        (NODE, "", "ekf"),
        (NODE, "", "planner"),
    }


@pytest.mark.parametrize("by_topic", [True, False])
def test_the_clock_is_followed_from_its_topic_or_the_servers_time(robots, by_topic):
    async def scene():
        robot = robots(capabilities=[foxglove.websocket.Capability.Time])
        topic = robot.topic("/clock", "rosgraph_msgs/msg/Clock") if by_topic else None
        clock = FollowedClock()
        with joined(robot.address, clock):
            while not clock.is_told:
                if topic is None:
                    robot.server.broadcast_time(seconds(5000) + 7)
                else:
                    topic.log(b"\0\1\0\0" + struct.pack("<iI", 5000, 7))
                await WallClock().sleep(seconds(0.01))
            return clock.now()

    now = asyncio.run(scene())
    assert seconds(5000) <= now < seconds(5060)


def test_types_that_only_the_server_knows_are_learnt_but_ours_are_not_changed(robots):
    before = INTERFACES.structure("geometry_msgs/msg/Point32")
    mark = "=" * 80

    async def scene():
        robot = robots()
        robot.topic("/cell", "battery_pkg/msg/Cell", definition="float32 volts\n")
        robot.topic(
            "/evil",
            "evil_pkg/msg/Cell",
            definition=f"geometry_msgs/Point32 p\n{mark}\nMSG: geometry_msgs/Point32\nint8 x\n",
        )
        with joined(robot.address) as (_, link):
            await until(lambda: len(link.graph.entities(PUBLISHER)) == 2)

    asyncio.run(scene())
    assert INTERFACES.has("battery_pkg/msg/Cell")
    assert not INTERFACES.has("evil_pkg/msg/Cell")
    assert INTERFACES.structure("geometry_msgs/msg/Point32") == before


def test_a_hundred_transforms_at_a_time_arrive_all(robots):
    """Check 500 messages of 100 transforms, sent without pauses."""

    async def scene():
        robot = robots()
        tf = robot.topic("/tf")
        with joined(robot.address) as (world, link):
            await subscribed(robot, "/tf")
            for number in range(500):
                stamp = seconds(10) + number
                tf.log(encode_transforms([transform("world", f"f{n}", stamp) for n in range(100)]))
                # The server stores the last 1024 messages for a client, and drops the others.
                await WallClock().sleep(0)
            await until(lambda: link.received == 500)
            return [len(world.buffer.samples(f"f{n}").stamps) for n in range(100)]

    assert asyncio.run(scene()) == [500] * 100
