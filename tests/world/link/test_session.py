"""Tests of two worlds with two zenoh sessions and real sockets."""

import asyncio

from tests.world.link.conftest import new_world, until
from tests.world.link.two import Two, play, sample, texts
from tftool.base.color import Color
from tftool.messages.classes import build
from tftool.messages.turtle_messages import (
    ColorMessage,
    Empty,
    Pose,
    SetPen,
    Spawn,
    TeleportAbsolute,
    Twist,
    twist,
)
from tftool.world.link.graph import GraphEntity, Role, hosts
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.link.topic_bridges import TF, TRANSFORMS
from tftool.world.link.zenoh.keys import token_key
from tftool.world.node import Node
from tftool.world.nodes.remote_turtles import FarTurtles
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live


def test_the_first_is_alone_and_the_second_sees_a_host():
    async def meet():
        with Link(Options("demo")) as host:
            assert host.graph.is_empty
            host.attach(new_world(), role=Role.HOST)
            with Link(Options("echo")) as guest:
                (process,) = guest.graph.processes()
                assert hosts([process]) == [process]
                assert str(process).startswith("'tftool demo' (process ")

    play(meet())


def test_a_session_with_more_tokens_than_a_queue_of_zenoh_holds_can_be_joined():
    async def join():
        with Link(Options("demo")) as first:
            here = new_world()
            first.attach(here, role=Role.HOST)
            for number in range(150):
                here.topic(f"turtle{number}/pose", Pose).subscribe(lambda pose: None)
                here.topic(f"turtle{number}/pose", Pose).publish(build(Pose, 1.0, 2.0, 0.0))
            # An older process knows all others, so a newcomer gets all announcements at once.
            with Link(Options("echo")) as second:
                second.attach(new_world(), role=Role.GUEST)
                await until(lambda: len(second.graph.entities("publisher", "subscription")) >= 300)
                with Link(Options("tree")) as third:
                    there = new_world()
                    third.attach(there, role=Role.GUEST)
                    await until(lambda: "turtle149/pose" in there.topics())

    play(join())


def test_a_topic_is_known_to_all_and_travels_to_who_listens():
    async def send():
        async with Two() as two:
            pose = build(Pose, 1.5, 2.5, 0.5, 1.0, -1.0)
            two.here.topic("turtle1/pose", Pose).publish(pose)
            await until(lambda: "turtle1/pose" in two.there.topics())
            heard = []
            stop = two.there.topic("turtle1/pose", Pose).subscribe(heard.append)
            await until(lambda: two.host.graph.entities("subscription", name="turtle1/pose"))

            two.here.topic("turtle1/pose", Pose).publish(pose)
            await until(lambda: heard)
            assert heard == [pose]

            stop()
            await until(lambda: not two.host.graph.entities("subscription", name="turtle1/pose"))

    play(send())


def test_a_topic_that_others_had_goes_with_them_unless_somebody_here_asked_for_it():
    async def leave():
        two = Two()
        names = {f"turtle{number}/pose" for number in range(1, 4)}
        for name in names:
            two.here.topic(name, Pose).publish(build(Pose, 1.0, 2.0, 0.0))
        await until(lambda: names <= two.there.topics().keys())
        stop = two.there.topics()["turtle1/pose"].subscribe(lambda pose: None)
        held = two.there.topic("turtle2/pose", Pose)
        two.host.close()
        await until(lambda: "turtle3/pose" not in two.there.topics())

        assert two.there.topics()["turtle2/pose"] is held
        assert "turtle1/pose" in two.there.topics()
        stop()
        two.there.topic("something", Pose)
        await until(lambda: "turtle1/pose" not in two.there.topics())
        two.guest.close()

    play(leave())


def test_colours_are_asked_for_only_while_somebody_far_away_wants_them():
    async def send():
        async with Two() as two:
            colors = two.here.topic("turtle1/color_sensor", ColorMessage)
            assert colors.subscribers == 0
            stop = two.there.topic("turtle1/color_sensor", ColorMessage).subscribe(
                lambda color: None
            )
            await until(lambda: colors.subscribers == 1)
            stop()
            await until(lambda: colors.subscribers == 0)

    play(send())


def test_a_guest_drives_and_looks_at_the_hosts_turtle():
    async def drive():
        async with Two() as two:
            Turtlesim(two.here, "sim")
            living = asyncio.ensure_future(live(two.here))
            poses = []
            await until(lambda: "turtle1/pose" in two.there.topics())
            two.there.topic("turtle1/pose", Pose).subscribe(poses.append)
            await until(lambda: poses)

            two.there.topic("turtle1/cmd_vel", Twist).publish(twist(2.0))
            await until(lambda: poses[-1].linear_velocity == 2.0)
            answer = await two.there.call("spawn", build(Spawn.Request, 4.0, 2.0, 0.0, "turtle2"))

            assert answer == build(Spawn.Response, "turtle2")
            await until(lambda: two.there.has_service("turtle2/set_pen"))
            await until(lambda: [node.node for node in two.guest.graph.entities("node")] == ["sim"])
            living.cancel()
            await asyncio.gather(living, return_exceptions=True)

    play(drive())


def test_a_guest_sees_the_hosts_background_and_the_strokes_of_its_pens():
    async def look():
        async with Two() as two:
            simulator = Turtlesim(two.here, background=Color(150, 0, 10))
            living = asyncio.ensure_future(live(two.here))
            await until(lambda: two.here.has_service("turtle1/set_pen"))
            await two.here.call("turtle1/set_pen", build(SetPen.Request, 255, 0, 0, 9, 0))
            await two.here.call(
                "turtle1/teleport_absolute", build(TeleportAbsolute.Request, 1.0, 1.0, 0.0)
            )
            await until(lambda: simulator.trail.segments)

            far = FarTurtles(two.there)
            looking = asyncio.ensure_future(live(two.there))
            await until(lambda: far.trail.segments)
            await until(lambda: far.background == Color(150, 0, 10))
            (stroke,) = far.trail.segments
            assert stroke[2:] == (1.0, 1.0, Color(255, 0, 0), 9)
            # Lists hide these services, like ROS 2's own hidden services.
            assert {one.node for one in two.guest.graph.entities("node")} == {"turtlesim"}
            living.cancel()
            looking.cancel()
            await asyncio.gather(living, looking, return_exceptions=True)

    play(look())


def test_a_guests_nodes_are_in_the_hosts_graph_while_they_live():
    async def look():
        async with Two() as two:
            node = Node(two.there, "teleop_turtle")
            await until(
                lambda: [one.node for one in two.host.graph.entities("node")] == [node.name]
            )
            two.there.remove(node)
            await until(
                lambda: [one.node for one in two.host.graph.entities("node")] == ["tftool_echo"]
            )

    play(look())


def test_a_read_only_guest_receives_but_shows_and_sends_nothing():
    async def look():
        async with Two(guest=Options("monitor", read_only=True)) as two:
            heard = []
            two.here.tf.subscribe(heard.append)
            two.here.serve("clear", lambda request: None, Empty)
            two.there.broadcast([sample(1)], "sneaky")
            two.there.topic("turtle1/cmd_vel", Twist).publish(twist(1.0))
            steps = iter(range(2, 10_000))

            # The message is sent until it is heard, because a subscription without announcement is
            # invisible.
            def sent_and_heard():
                two.here.broadcast([sample(next(steps))], "broadcaster1")
                return two.guest.received

            await until(sent_and_heard)

            assert {message.authority for message in heard} == {"broadcaster1"}
            assert two.host.graph.is_empty
            assert not two.there.has_service("clear")

    play(look())


def test_a_host_that_leaves_is_told_once():
    async def leave():
        two = Two()
        await until(lambda: two.guest.graph.processes())
        two.host.close()
        await until(lambda: not two.guest.graph.processes())

        (told,) = texts(two.there)
        assert told.startswith("'tftool demo' (process ")
        assert told.endswith("which hosted, has left; its last transforms stay.")
        two.guest.close()

    play(leave())


def test_a_process_departs_once_however_many_of_its_nodes_sent_transforms():
    async def leave():
        two = Two()
        for name in ("one", "two"):
            two.here.broadcast([sample(1, name)], name)
        await until(lambda: len(two.guest.graph.entities("publisher", name="tf")) == 2)
        two.host.close()
        await until(lambda: two.guest.graph.is_empty)

        assert two.guest.departures == 1
        two.guest.close()

    play(leave())


def test_a_process_that_is_no_tftool_departs_with_the_last_that_sent_transforms():
    async def leave():
        async with Two() as two:
            sender = GraphEntity("publisher", 0, "ab", "ros", "tf", TRANSFORMS, TF)
            tokens = [token_key(sender, 1, number) for number in (1, 2)]
            hide = [two.host.middleware.wire.token(token) for token in tokens]
            await until(lambda: len(two.guest.graph.entities("publisher", name="tf")) == 2)
            hide[0]()
            await until(lambda: len(two.guest.graph.entities("publisher", name="tf")) == 1)
            assert two.guest.departures == 0
            hide[1]()
            await until(lambda: two.guest.departures == 1)

    play(leave())


def test_a_guest_that_comes_and_goes_is_told():
    async def leave():
        two = Two()
        await until(lambda: two.host.graph.processes())
        two.guest.close()
        await until(lambda: len(texts(two.here)) == 2)

        joined, left = texts(two.here)
        assert joined.endswith("has joined.")
        assert left.endswith("has left.")
        two.host.close()

    play(leave())


def test_the_second_host_of_the_same_turtle_is_told():
    async def host():
        async with Two() as two:
            two.here.serve("spawn", lambda request: build(Spawn.Response, "turtle1"), Spawn)
            await until(lambda: two.there.has_service("spawn"))
            with Link(Options("demo")) as second:
                world = new_world()
                world.serve("spawn", lambda request: build(Spawn.Response, "turtle1"), Spawn)
                second.attach(world, role=Role.HOST)

                (told,) = texts(world)
                assert "serves 'spawn' too" in told
                assert "--domain" in told
            assert [text for text in texts(two.here) if "serves" in text] == []

    play(host())
