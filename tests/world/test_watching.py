"""Tests of callbacks for changes of a world, such as those of a connection to other processes."""

import pytest

from tftool.messages.turtle_messages import Twist, twist
from tftool.world.clock import SimClock, run
from tftool.world.node import Node
from tftool.world.topics import GoalHandle
from tftool.world.world import World


def test_a_watcher_is_told_of_topics_services_actions_and_nodes():
    world = World(SimClock())
    seen = []
    stop = world.watch(lambda: seen.append((sorted(world.topics()), sorted(world.services()))))

    world.topic("turtle1/cmd_vel", Twist)
    withdraw = world.serve("spawn", lambda request: request)
    withdraw()
    world.serve_action("rotate", lambda goal: None)
    node = Node(world, "watched")
    world.remove(node)
    world.remove_topic("turtle1/cmd_vel")
    world.remove_topic("turtle1/cmd_vel")

    assert len(seen) == 7
    assert seen[0] == (["tf", "tf_static", "turtle1/cmd_vel"], [])
    assert seen[1][1] == ["spawn"]
    assert seen[2][1] == []
    stop()
    world.topic("late", Twist)
    assert len(seen) == 7


def test_a_watcher_hears_of_a_topic_before_its_first_value():
    world = World(SimClock())
    heard = []

    def listen():
        world.topic("new", Twist).subscribe(heard.append)
        stop()

    stop = world.watch(listen)
    world.topic("new", Twist).publish(twist(1.0))

    assert heard == [twist(1.0)]


def test_a_topic_tells_of_demand_when_a_listener_comes_and_when_it_goes():
    world = World(SimClock())
    world.topic("new", Twist)
    topic = world.topics()["new"]
    counts = []
    topic.on_demand = lambda: counts.append(topic.subscribers)

    stop = topic.subscribe(lambda value: None)
    stop()
    stop()

    assert counts == [1, 0]


def test_a_server_that_decides_is_asked_anew_only_after_it_has_refused():
    async def ask():
        goal = GoalHandle("turn")
        asked = []
        goal.on_cancel = lambda: asked.append(goal.cancel_requested)
        found = []
        for accepted in (False, True):
            goal.cancel()
            goal.cancel()
            goal.decide_cancel(accepted)
            found.append((len(asked), await goal.cancellation(), goal.cancel_requested))
        goal.cancel()
        return found, asked

    found, asked = run(SimClock(), ask())

    assert found == [(1, False, False), (2, True, True)]
    assert asked == [False, False], "nothing is canceled before the server agrees"


@pytest.mark.parametrize(("status", "accepted"), [("canceled", True), ("succeeded", False)])
def test_the_end_of_a_goal_answers_an_open_cancellation(status, accepted):
    async def ask():
        goal = GoalHandle("turn")
        goal.on_cancel = lambda: None
        goal.cancel()
        goal.finish(status, None)
        return await goal.cancellation()

    assert run(SimClock(), ask()) is accepted
