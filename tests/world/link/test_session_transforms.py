"""Tests of transforms between two worlds, each with a zenoh session."""

import math
import re

import pytest

from tests.world.link.conftest import new_world, until
from tests.world.link.two import Two, play, sample, texts
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import encode_transforms
from tftool.messages.turtle_messages import Empty, Twist, twist
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.link.topic_bridges import TF
from tftool.world.node import Node
from tftool.world.world import TransformMessage


def test_transforms_arrive_with_their_sender_in_buffer_and_topic():
    async def send():
        async with Two() as two:
            heard = []
            two.there.tf.subscribe(heard.append)
            now = two.here.clock.now()
            await until(lambda: two.host.graph.entities("subscription", name="tf"))

            two.here.broadcast([sample(now), sample(now, "turtle2")], "broadcaster1")
            await until(lambda: heard)

            expected = TransformMessage((sample(now), sample(now, "turtle2")), "broadcaster1")
            assert heard == [expected]
            found = two.there.buffer.lookup_transform("world", "turtle1", now)
            assert found.transform == Transform((1.0, 2.0, 0.0))
            info = two.there.buffer.snapshot(now).frame("turtle1")
            assert info.authority == "broadcaster1"

    play(send())


def test_received_messages_are_not_sent_out_again():
    async def send():
        async with Two() as two:
            echoes = []
            two.here.tf.subscribe(echoes.append)
            commands = []
            two.here.topic("turtle1/cmd_vel", Twist).subscribe(commands.append)
            two.there.topic("turtle1/cmd_vel", Twist).subscribe(lambda twist: None)
            await until(lambda: two.guest.graph.entities("subscription", name="turtle1/cmd_vel"))
            await until(lambda: two.host.graph.entities("subscription", name="turtle1/cmd_vel"))

            for step in range(1, 6):
                two.there.broadcast([sample(step)], "guest")
                two.there.topic("turtle1/cmd_vel", Twist).publish(twist(float(step)))
            await until(lambda: len(echoes) >= 5 and len(commands) >= 5)
            # A returned transform would have arrived before the response to this call.
            two.here.serve("clear", lambda request: None, Empty)
            await until(lambda: two.there.has_service("clear"))
            await two.there.call("clear", Empty.Request())

            assert len(echoes) == 5
            assert [twist.linear.x for twist in commands] == [1.0, 2.0, 3.0, 4.0, 5.0]
            assert two.guest.received == 0

    play(send())


def test_a_late_guest_gets_the_newest_static_of_every_frame_with_its_sender():
    async def send():
        with Link(Options("static")) as first:
            here = new_world()
            first.attach(here, role=Role.HOST)
            here.broadcast([sample(0, "a"), sample(0, "b")], "one", static=True)
            here.broadcast([sample(0, "c")], "one", static=True)
            here.broadcast([sample(0, "a", x=5.0)], "one", static=True)
            here.broadcast([sample(0, "d")], "two", static=True)

            with Link(Options("echo")) as late:
                there = new_world()
                late.attach(there, role=Role.GUEST)
                await until(lambda: set("abcd") <= set(there.buffer.frames()))

                found = there.buffer.lookup_transform("world", "a")
                assert found.transform.translation.x == 5.0
                authorities = {
                    name: there.buffer.snapshot(1).frame(name).authority for name in "abcd"
                }
                assert authorities == {"a": "one", "b": "one", "c": "one", "d": "two"}

    play(send())


def test_a_node_that_leaves_is_no_publisher_of_tf_any_more_but_its_statics_stay():
    async def leave():
        async with Two() as two:

            def publishers(topic):
                return {one.node for one in two.guest.graph.entities("publisher", name=topic)}

            node = Node(two.here, "turtle2_broadcaster")
            for name in (node.name, "no_node"):
                two.here.broadcast([sample(1, name)], name)
            two.here.broadcast([sample(0, "carrot")], node.name, static=True)
            await until(lambda: publishers("tf") == {node.name, "no_node"})

            two.here.remove(node)
            await until(lambda: publishers("tf") == {"no_node"})
            assert two.guest.departures == 0
            with Link(Options("tree")) as late:
                there = new_world()
                late.attach(there, role=Role.GUEST)
                await until(lambda: "carrot" in there.buffer.frames())

                assert there.buffer.snapshot(1).frame("carrot").authority == node.name

            # The next node may have the same name.
            Node(two.here, node.name)
            two.here.broadcast([sample(2, node.name)], node.name)
            await until(lambda: publishers("tf") == {node.name, "no_node"})

    play(leave())


def test_bytes_that_are_no_message_are_counted_and_said_once():
    async def send():
        async with Two() as two:
            await until(lambda: two.host.graph.entities("subscription", name="tf"))
            outlet = two.host.middleware.publisher("stranger", "tf", "tf2_msgs/msg/TFMessage", TF)
            for _ in range(5):
                outlet.put(b"\x00\x01\x00\x00\xff\xff\xff\xff", 1)
            two.here.broadcast([sample(3)], "fine")
            await until(lambda: two.guest.received == 1)

            assert two.guest.refused == 5
            told = [text for text in texts(two.there) if "refused" in text]
            assert len(told) == 1
            assert told[0].startswith(
                "On 'tf': tf2_msgs/TFMessage refused: the message announces 4294967295"
            )

    play(send())


def path(stamp, child="turtle1", parent="world", count=3000):
    return [
        TransformStamped(stamp + step, parent, child, Transform((float(step), 0.0, 0.0)))
        for step in range(count)
    ]


def test_a_long_path_in_one_message_is_taken_in_as_if_one_by_one():
    async def send():
        async with Two() as two:
            await until(lambda: two.host.graph.entities("subscription", name="tf"))
            told = []
            two.there.buffer.listen(lambda one, static, who: told.append((one, static, who)))
            now = two.here.clock.now()
            sent = [*path(now), *path(now, "turtle2")]
            # No buffer accepts the first of these samples; the second is from an hour ago.
            sent[10] = TransformStamped(
                now + 10, "world", "turtle1", Transform((math.nan, 0.0, 0.0))
            )
            sent.append(TransformStamped(now - seconds(3600), "world", "turtle1", Transform()))
            outlet = two.host.middleware.publisher("stranger", "tf", "tf2_msgs/msg/TFMessage", TF)
            await until(lambda: outlet.is_wanted)
            outlet.put(encode_transforms(sent), 1)
            await until(lambda: two.guest.received)

            alone = Buffer(log=lambda level, text: None)
            expected = [one for one in sent if alone.set_transform(one)]
            assert [one for one, _, _ in told] == expected
            assert {(static, who) for _, static, who in told} == {(False, "stranger")}
            for child in ("turtle1", "turtle2"):
                ours = two.there.buffer.lookup_transform("world", child, now + 10)
                assert ours == alone.lookup_transform("world", child, now + 10)
            said = [one.text for one in two.there.log.records if one.node == "buffer"]
            assert len(said) == 2
            assert said[0].startswith("TF_NAN_INPUT")
            assert said[1].startswith("TF_OLD_DATA")
            # No node subscribed to the topic, so its messages were not decoded there.
            assert two.there.tf.count == 0

    play(send())


@pytest.mark.parametrize(
    "sent",
    [
        [*path(seconds(1e9)), *path(seconds(1e9 + 1), parent="map")],
        [one for number in range(60) for one in path(seconds(1e9), f"frame{number}", count=50)],
    ],
    ids=["two parents", "many links"],
)
def test_a_message_of_two_parents_or_many_links_arrives_unchanged(sent):
    async def send():
        async with Two() as two:
            await until(lambda: two.host.graph.entities("subscription", name="tf"))
            outlet = two.host.middleware.publisher("stranger", "tf", "tf2_msgs/msg/TFMessage", TF)
            await until(lambda: outlet.is_wanted)
            outlet.put(encode_transforms(sent), 1)
            await until(lambda: two.there.tf.count)

            assert two.there.tf.latest.transforms == tuple(sent)

    play(send())


def test_a_large_message_that_is_none_is_refused_like_any_other():
    async def send():
        async with Two() as two:
            await until(lambda: two.host.graph.entities("subscription", name="tf"))
            outlet = two.host.middleware.publisher("stranger", "tf", "tf2_msgs/msg/TFMessage", TF)
            payload = encode_transforms(path(1))
            outlet.put(payload[:-10], 1)
            await until(lambda: two.guest.refused)

            assert two.there.buffer.frames() == []

    play(send())


def test_a_clock_that_is_years_off_is_said_once_for_each_sender():
    async def send():
        async with Two() as two:
            await until(lambda: two.host.graph.entities("subscription", name="tf"))
            for step in range(3):
                two.here.broadcast([sample(seconds(1000 + step))], "simulated")
            await until(lambda: two.guest.received == 3)

            (told,) = [text for text in texts(two.there) if "clock" in text]
            assert told.startswith("'simulated' stamps its transforms ")
            assert "years before this machine's clock" in told
            assert two.there.buffer.frame_exists("turtle1")

    play(send())


def test_a_clock_that_is_ahead_is_said_once_for_all():
    async def send():
        async with Two() as two:
            await until(lambda: two.host.graph.entities("subscription", name="tf"))
            now = two.here.clock.now()
            two.here.broadcast([sample(now + seconds(1), "late")], "tolerant")
            for step in range(3):
                two.here.broadcast([sample(now + seconds(60 + step))], "fast")
                two.here.broadcast([sample(now + seconds(60 + step), "turtle2")], "faster")
            await until(lambda: two.guest.received == 7)

            (told,) = [text for text in texts(two.there) if "clock" in text]
            assert re.match(r"'fast' stamps its transforms (59|60)\.\d s after this machine", told)
            assert "(demo --rate)" in told

    play(send())
