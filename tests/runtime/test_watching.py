"""Those who are told when something comes or goes: a link to other processes is one."""

from tftool.messages import Twist2D
from tftool.runtime.clock import SimClock, run
from tftool.runtime.node import Node
from tftool.runtime.topics import GoalHandle
from tftool.runtime.world import World


def test_a_watcher_is_told_of_topics_services_actions_and_nodes():
    world = World(SimClock())
    seen = []
    stop = world.watch(lambda: seen.append((sorted(world.topics()), sorted(world.services()))))

    world.topic("turtle1/cmd_vel", Twist2D)
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
    world.topic("late", Twist2D)
    assert len(seen) == 7


def test_a_watcher_hears_of_a_topic_before_its_first_value():
    world = World(SimClock())
    heard = []

    def listen():
        world.topics()["new"].subscribe(heard.append)
        stop()

    stop = world.watch(listen)
    world.topic("new", Twist2D).publish(Twist2D(1.0))

    assert heard == [Twist2D(1.0)]


def test_a_topic_tells_of_demand_when_a_listener_comes_and_when_it_goes():
    topic = World(SimClock()).topic("new", Twist2D)
    counts = []
    topic.on_demand = lambda: counts.append(topic.subscribers)

    stop = topic.subscribe(lambda value: None)
    stop()
    stop()

    assert counts == [1, 0]


def test_a_server_that_does_not_look_is_told_of_a_cancel_once():
    async def ask():
        goal = GoalHandle("turn")
        told = []
        goal.on_cancel = lambda: told.append(goal.cancel_requested)
        goal.cancel()
        goal.cancel()
        return told

    assert run(SimClock(), ask()) == [True]
