"""Tests of messages and services of any type between two worlds, as users' nodes exchange them."""

import asyncio
from collections import deque

import pytest

from tests.world.link.conftest import new_world, until
from tests.world.link.two import Two, play, texts
from tftool.base.errors import LinkError, TftoolError
from tftool.messages.classes import INTERFACES, build
from tftool.messages.turtle_messages import Empty, RotateAbsolute
from tftool.world import node
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Endpoint, Quality
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.node import Node
from tftool.world.topics import GoalResult

STRING = INTERFACES.message("std_msgs/String")
ODOMETRY = INTERFACES.message("nav_msgs/Odometry")
SET_BOOL = INTERFACES.find("std_srvs", "srv", "SetBool")
TRIGGER = INTERFACES.find("std_srvs", "srv", "Trigger")
FIBONACCI = INTERFACES.find("example_interfaces", "action", "Fibonacci")


def publisher(world, topic="chatter", kind=STRING, node="talker", **quality):
    endpoint = Endpoint(PUBLISHER, node, topic, kind.interface__, Quality(**quality))
    world.topic(topic, kind)
    world.endpoints.add(endpoint)
    return lambda message: world.topic(topic, kind).publish(message, endpoint)


def subscription(world, heard, topic="chatter", kind=STRING, node="listener", **quality):
    latched = quality.get("is_latched", False)
    there = world.topic(topic, kind)

    def deliver(value, sender):
        heard.append((value, sender))

    def arrived(value):
        if not (latched and there.sender and there.sender.is_remote):
            deliver(value, there.sender)

    remove = world.endpoints.add(
        Endpoint(SUBSCRIPTION, node, topic, kind.interface__, Quality(**quality),
                 deliver=deliver if latched else None)
    )  # fmt: skip
    stop = there.subscribe(arrived)
    return lambda: (stop(), remove())


def test_a_message_of_any_type_arrives_with_who_sent_it():
    async def send():
        async with Two() as two:
            heard = []
            publish = publisher(two.here, "odom", ODOMETRY, "base", depth=3, is_reliable=False)
            subscription(two.there, heard, "odom", ODOMETRY, is_reliable=False)
            await until(lambda: two.host.graph.entities("subscription", name="odom"))
            message = ODOMETRY(child_frame_id="base_link")
            message.header.frame_id = "odom"
            message.pose.covariance[7] = 0.5

            publish(message)
            await until(lambda: heard)

            ((found, sender),) = heard
            assert found == message
            assert (sender.node, sender.quality) == ("base", Quality(3, is_reliable=False))
            await until(lambda: two.guest.graph.entities("publisher", name="odom"))
            (entity,) = two.guest.graph.entities("publisher", name="odom")
            assert (entity.node, entity.ros_type) == ("base", "nav_msgs/msg/Odometry")
            assert two.guest.refused == two.host.refused == 0

    play(send())


def test_every_publisher_and_subscription_is_shown_under_its_node_and_goes_with_it():
    async def send():
        async with Two() as two:
            publisher(two.here, node="one")
            publisher(two.here, node="two", is_latched=True, depth=2)
            stop = subscription(two.here, [], node="three")
            await until(
                lambda: (
                    len(two.guest.graph.entities("publisher", "subscription", name="chatter")) == 3
                )
            )
            shown = {
                (one.node, one.kind, one.quality)
                for one in two.guest.graph.entities("publisher", "subscription", name="chatter")
            }
            assert shown == {
                ("one", "publisher", Quality(depth=10)),
                ("two", "publisher", Quality(depth=2, is_latched=True)),
                ("three", "subscription", Quality(depth=10)),
            }

            stop()
            await until(lambda: not two.guest.graph.entities("subscription", name="chatter"))

    play(send())


def test_the_world_knows_the_nodes_of_others_while_they_are_there():
    async def look():
        async with Two() as two:
            world = two.here
            node = Node(world, "robot1/talker")
            changes = []
            two.there.watch(lambda: changes.append(two.there.far_nodes))
            await until(lambda: two.there.far_nodes == ("robot1/talker",))
            assert ("robot1/talker",) in changes

            world.remove(node)
            await until(lambda: two.there.far_nodes == ("tftool_demo",))

    play(look())


def test_nothing_is_turned_into_bytes_while_nobody_else_listens(monkeypatch):
    async def send():
        async with Two() as two:
            publish = publisher(two.here)
            heard = []
            subscription(two.here, heard)
            await until(lambda: two.guest.graph.entities("publisher", name="chatter"))

            # A lone surrogate cannot be encoded: the message is refused, and counted.
            publish(STRING(data="\ud800"))
            assert len(heard) == 1
            assert two.host.refused == 0

            subscription(two.there, [])
            await until(lambda: two.host.graph.entities("subscription", name="chatter"))
            publish(STRING(data="\ud800"))
            assert two.host.refused == 1

    play(send())


def test_a_latched_subscription_gets_what_was_sent_before_and_others_hear_all_once():
    async def send():
        async with Two() as two:
            publish = publisher(two.here, is_latched=True, depth=2)
            early, late, plain = [], [], []
            subscription(two.there, plain)
            await until(lambda: two.host.graph.entities("subscription", name="chatter"))
            for word in ("one", "two", "three"):
                publish(STRING(data=word))
            await until(lambda: len(plain) == 3)
            subscription(two.there, early, node="early", is_latched=True)
            await until(lambda: len(early) == 2)
            subscription(two.there, late, node="late", is_latched=True)
            await until(lambda: len(late) == 2)
            await until(lambda: len(two.host.graph.entities("subscription", name="chatter")) == 3)
            publish(STRING(data="four"))
            await until(lambda: len(plain) == 4 and len(early) == 3 and len(late) == 3)

            assert [one.data for one, _ in early] == ["two", "three", "four"]
            assert [one.data for one, _ in late] == ["two", "three", "four"]
            assert [one.data for one, _ in plain] == ["one", "two", "three", "four"]

    play(send())


def test_a_publisher_that_keeps_all_keeps_it_for_other_processes_too():
    async def send():
        async with Two() as two:
            publish = publisher(two.here, is_latched=True, depth=1, keeps_all=True)
            early, late = [], []
            subscription(two.there, early)
            await until(lambda: two.host.graph.entities("subscription", name="chatter"))
            for word in ("one", "two", "three"):
                publish(STRING(data=word))
            await until(lambda: len(early) == 3)
            subscription(two.there, late, node="late", is_latched=True)
            await until(lambda: late and late[-1][0].data == "three")

            assert [one.data for one, _ in late] == ["one", "two", "three"]

    play(send())


def test_latched_messages_kept_before_the_link_reach_late_subscribers():
    async def send():
        here, there = new_world(), new_world()
        endpoint = Endpoint(
            PUBLISHER, "mapper", "map", STRING.interface__, Quality(1, is_latched=True),
            kept=deque([STRING(data="the attic")]),
        )  # fmt: skip
        here.topic("map", STRING)
        here.endpoints.add(endpoint)
        with Link(Options("run")) as first:
            first.attach(here, role=Role.HOST)
            with Link(Options("run")) as second:
                second.attach(there, role=Role.GUEST)
                heard = []
                subscription(there, heard, "map", is_latched=True)
                await until(lambda: heard)

                assert [one.data for one, _ in heard] == ["the attic"]

    play(send())


def test_two_in_different_processes_that_do_not_fit_are_told_so():
    async def send():
        async with Two() as two:
            publisher(two.here, is_reliable=False)
            subscription(two.there, [])

            def told(world, node):
                return [r.text for r in world.log.records if r.node == node and "QoS" in r.text]

            await until(lambda: told(two.here, "talker") and told(two.there, "listener"))
            assert told(two.here, "talker") == [
                "New subscription discovered on topic '/chatter' (node 'listener'), requesting "
                "incompatible QoS. No messages will be sent to it. Last incompatible policy: "
                "RELIABILITY"
            ]
            assert "Last incompatible policy: RELIABILITY" in told(two.there, "listener")[0]

    play(send())


def test_a_topic_of_two_types_is_two_topics():
    async def send():
        async with Two() as two:
            heard = []
            publish = publisher(two.here)
            subscription(two.there, heard, kind=ODOMETRY)
            await until(lambda: two.host.graph.entities("subscription", name="chatter"))

            publish(STRING(data="hello"))
            two.here.serve("done", lambda request: TRIGGER.Response(), TRIGGER)
            await until(lambda: two.there.has_service("done"))
            await two.there.call("done", TRIGGER.Request())

            assert heard == []
            assert two.guest.refused == 0

    play(send())


def test_a_service_of_any_type_is_answered_and_shown_under_its_node():
    async def ask():
        async with Two() as two:
            asked = []

            async def enable(request):
                asked.append(request)
                return SET_BOOL.Response(success=True, message="on")

            two.here.serve("enable", enable, SET_BOOL, node="motors")
            await until(lambda: two.there.has_service("enable"))

            answer = await two.there.call("enable", SET_BOOL.Request(data=True))

            assert answer == SET_BOOL.Response(success=True, message="on")
            assert asked == [SET_BOOL.Request(data=True)]
            (entity,) = two.guest.graph.entities("server", name="enable")
            assert (entity.node, entity.ros_type) == ("motors", "std_srvs/srv/SetBool")
            await until(lambda: two.host.graph.entities("client", name="enable"))

    play(ask())


def test_a_client_is_known_to_other_processes_even_before_its_service_exists():
    async def announce():
        async with Two() as two:
            client = Endpoint(CLIENT, "arm/asker", "enable", "std_srvs/srv/SetBool")
            leave = two.there.clients.add(client)
            await until(lambda: two.here.clients.of("enable", CLIENT))

            (found,) = two.here.clients.of("enable", CLIENT)
            assert (found.node, found.interface) == ("arm/asker", "std_srvs/srv/SetBool")
            leave()
            await until(lambda: not two.here.clients.of("enable", CLIENT))

    play(announce())


def test_a_client_that_is_announced_is_counted_once_after_its_request():
    async def ask():
        async with Two() as two:
            two.here.serve("enable", lambda request: SET_BOOL.Response(), SET_BOOL)
            two.there.clients.add(Endpoint(CLIENT, "asker", "enable", "std_srvs/srv/SetBool"))
            await until(lambda: two.there.has_service("enable"))
            await two.there.call("enable", SET_BOOL.Request())
            await until(lambda: two.here.clients.of("enable", CLIENT))

            assert [one.node for one in two.here.clients.of("enable", CLIENT)] == ["asker"]

    play(ask())


def test_a_question_of_another_type_is_not_sent():
    async def ask():
        async with Two() as two:
            two.here.serve("enable", lambda request: SET_BOOL.Response(), SET_BOOL)
            await until(lambda: two.there.has_service("enable"))

            for request in (TRIGGER.Request(), Empty.Request()):
                with pytest.raises(TftoolError, match="'enable' is of type std_srvs/srv/SetBool"):
                    await two.there.call("enable", request)

    play(ask())


def test_a_users_node_waits_for_an_answer_longer_than_nodes_of_ours(monkeypatch):
    monkeypatch.setattr(node, "PATIENCE", 0.1)

    async def ask():
        async with Two() as two:
            ready = asyncio.Event()

            async def slow(request):
                await ready.wait()
                return TRIGGER.Response(message="done")

            two.here.serve("work", slow, TRIGGER)
            two.here.serve("clear", slow, Empty)
            await until(lambda: two.there.has_service("work") and two.there.has_service("clear"))
            working = asyncio.ensure_future(two.there.call("work", TRIGGER.Request()))

            with pytest.raises(LinkError, match=r"'clear': no server answered within 0\.1 s"):
                await node.Node(two.there, "ours").call("clear", Empty.Request())
            ready.set()

            assert (await working).message == "done"

    play(ask())


def test_a_service_of_a_name_of_the_simulators_is_what_it_says_it_is():
    async def ask():
        async with Two() as two:
            answer = TRIGGER.Response(success=True, message="as new")
            two.here.serve("reset", lambda request: answer, TRIGGER)
            await until(lambda: two.there.has_service("reset"))

            assert await two.there.call("reset", TRIGGER.Request()) == answer

    play(ask())


def test_a_local_service_is_preferred_to_one_of_another_process():
    async def ask():
        async with Two() as two:
            two.here.serve("go", lambda request: TRIGGER.Response(message="far"), TRIGGER)
            await until(lambda: two.there.has_service("go"))
            stop = two.there.serve("go", lambda request: TRIGGER.Response(message="near"), TRIGGER)
            assert (await two.there.call("go", TRIGGER.Request())).message == "near"

            stop()
            await until(lambda: two.there.has_service("go"))
            assert (await two.there.call("go", TRIGGER.Request())).message == "far"

    play(ask())


def test_a_service_without_a_type_is_not_offered_to_other_processes():
    async def ask():
        async with Two() as two:
            two.here.serve("secret", lambda request: None)
            two.here.serve("go", lambda request: TRIGGER.Response(), TRIGGER)
            await until(lambda: two.there.has_service("go"))

            assert not two.there.has_service("secret")

    play(ask())


def test_a_goal_of_any_type_is_taken_or_refused_fed_back_and_ended():
    async def act():
        async with Two() as two:
            goals = []

            def accept(goal):
                goal.decided = asyncio.get_running_loop().create_future()
                goal.decided.set_result(goal.request.order > 0)
                goals.append(goal)

            two.here.serve_action("fibonacci", accept, FIBONACCI, node="counter")
            await until(lambda: "fibonacci" in two.there.actions())
            fed = []

            refused = two.there.send_goal("fibonacci", FIBONACCI.Goal(order=0), fed.append)
            assert await refused.decided is False
            taken = two.there.send_goal("fibonacci", FIBONACCI.Goal(order=3), fed.append)
            assert await taken.decided is True
            await until(
                lambda: two.guest.graph.entities("publisher", name="fibonacci/_action/feedback")
            )
            goals[1].publish_feedback(FIBONACCI.Feedback(sequence=[0, 1]))
            await until(lambda: fed)
            goals[1].finish("succeeded", FIBONACCI.Result(sequence=[0, 1, 1]))

            assert await taken.result() == GoalResult(
                "succeeded", FIBONACCI.Result(sequence=[0, 1, 1])
            )
            assert fed == [FIBONACCI.Feedback(sequence=[0, 1])]

    play(act())


def test_a_client_that_cancels_a_goal_hears_the_decision_of_the_server():
    async def act():
        async with Two() as two:
            goals, decisions = [], [False, True]

            def accept(goal):
                goal.on_cancel = lambda: goal.decide_cancel(decisions.pop(0))
                goals.append(goal)

            two.here.serve_action("fibonacci", accept, FIBONACCI, node="counter")
            await until(lambda: "fibonacci" in two.there.actions())
            goal = two.there.send_goal("fibonacci", FIBONACCI.Goal(order=3))
            await until(lambda: goals)

            goal.cancel()
            assert not await goal.cancellation()
            assert not goals[0].cancel_requested
            goal.cancel()
            assert await goal.cancellation()
            assert goals[0].cancel_requested
            goals[0].finish("canceled", FIBONACCI.Result())
            assert (await goal.result()).status == "canceled"

    play(act())


@pytest.mark.parametrize(
    "goal", [build(RotateAbsolute.Goal, 1.0), {"order": 3}, SET_BOOL.Request()]
)
def test_a_goal_of_another_type_is_refused_before_it_is_sent(goal):
    async def act():
        async with Two() as two:
            two.here.serve_action("fibonacci", lambda goal: None, FIBONACCI, node="counter")
            await until(lambda: "fibonacci" in two.there.actions())

            with pytest.raises(TftoolError, match="is of type example_interfaces/action/Fibonacci"):
                two.there.send_goal("fibonacci", goal)

    play(act())


def test_a_twist_that_says_more_than_a_turtle_reads_arrives_whole():
    async def send():
        async with Two() as two:
            kind = INTERFACES.message("geometry_msgs/Twist")
            sent = kind()
            sent.linear.x, sent.linear.z, sent.angular.x = 1.0, 3.0, -1.0
            whole = []
            two.there.topic("cmd_vel", kind).subscribe(whole.append)
            await until(lambda: two.host.graph.entities("subscription", name="cmd_vel"))

            two.here.topic("cmd_vel", kind).publish(sent)
            await until(lambda: whole)

            assert whole == [sent]

    play(send())


def test_a_message_that_no_other_release_could_read_stays_here_and_that_is_said():
    async def send():
        async with Two() as two:
            INTERFACES.add("pkg", {("msg", "Wide"): "wstring data"})
            two.here.topic("wide", INTERFACES.message("pkg/Wide"))

            assert any(
                "'wide' is not shared with other processes" in text for text in texts(two.here)
            )

    try:
        play(send())
    finally:
        INTERFACES.add("pkg", {})
