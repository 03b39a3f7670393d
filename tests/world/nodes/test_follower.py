import math

import pytest

from tests.world.nodes.harness import At, log_texts, new_world, play
from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.motion import Gains
from tftool.geometry.rigid import Transform
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Kill, Spawn, Twist, twist
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION
from tftool.world.nodes.broadcasters import Broadcaster, StaticBroadcaster
from tftool.world.nodes.follower import Follower
from tftool.world.nodes.turtlesim import Turtlesim


def turtle_world(**options):
    world = new_world()
    sim = Turtlesim(world)
    Broadcaster(world, "broadcaster1", turtle="turtle1")
    Broadcaster(world, "broadcaster2", turtle="turtle2")
    Follower(world, "listener", **options)
    return world, sim


def distance(sim):
    one, two = (sim.turtles[name].place for name in ("turtle1", "turtle2"))
    return math.dist(one[:2], two[:2])


def heard(world, turtle="turtle2"):
    commands = []
    world.topic(f"{turtle}/cmd_vel", Twist).subscribe(commands.append)
    return commands


def test_the_demo_from_the_first_line_to_the_embrace():
    world, sim = turtle_world()
    play(world, 25.0)

    assert log_texts(world, "listener") == ["Successfully spawned turtle2"]
    assert distance(sim) < 1e-4


def test_without_a_simulator_the_follower_says_so_every_period():
    world = new_world()
    Follower(world, "listener")
    play(world, 3.0)

    assert log_texts(world) == ["Service is not ready"] * 3


def test_an_answer_that_takes_long_is_waited_for():
    world = new_world()

    async def slow(request):
        await world.clock.sleep(seconds(2.5))
        return build(Spawn.Response, request.name)

    world.serve("spawn", slow)
    Follower(world, "listener")
    play(world, 6.0)

    assert log_texts(world)[:4] == [
        "Spawn is not finished",
        "Spawn is not finished",
        "Successfully spawned turtle2",
        'Could not transform turtle2 to turtle1: "turtle2" passed to lookupTransform '
        "argument target_frame does not exist. ",
    ]


def test_a_refused_spawn_is_asked_for_again():
    world = new_world()
    answers = []

    def refuse_once(request):
        answers.append(request)
        if len(answers) == 1:
            raise UsageError("not now")
        return build(Spawn.Response, request.name)

    world.serve("spawn", refuse_once)
    Follower(world, "listener")
    play(world, 4.0)

    assert answers == [build(Spawn.Request, 4.0, 2.0, 0.0, "turtle2")] * 2
    assert log_texts(world)[:2] == [
        "Could not spawn 'turtle2', asking again: not now",
        "Successfully spawned turtle2",
    ]


def test_a_follower_that_is_there_already_will_do():
    world = new_world()
    sim = Turtlesim(world, turtles=[build(Spawn.Request, 9.0, 9.0, 0.0, "turtle2")])
    for number in (1, 2):
        Broadcaster(world, f"broadcaster{number}", turtle=f"turtle{number}")
    Follower(world, "listener")
    play(world, 20.0)

    assert log_texts(world, "listener") == ["turtle2 exists already, and is used"]
    assert distance(sim) < 0.01


def test_an_unknown_leader_is_told_once_a_period_and_commands_nothing():
    world, _ = turtle_world(leader="carrot1")
    commands = heard(world)
    play(world, 5.5)

    refusals = log_texts(world, "listener")[1:]
    assert len(refusals) == 3
    assert set(refusals) == {
        'Could not transform turtle2 to carrot1: "carrot1" passed to lookupTransform '
        "argument source_frame does not exist. "
    }
    assert commands == []


def test_a_full_controller_with_tutorial_gains_is_the_tutorials_law():
    plain, sim = turtle_world()
    full, other = turtle_world(
        distance_gains=Gains(0.5, 0.0, 0.0, 1.0), bearing_gains=Gains(1.0, 0.0, 0.0, 1.0)
    )
    play(plain, 10.0)
    play(full, 10.0)

    assert sim.turtles["turtle2"].place == other.turtles["turtle2"].place


def test_the_dead_band_stops_short_and_the_speed_limit_holds():
    world, sim = turtle_world(dead_band=1.0, speed_limit=0.4)
    commands = heard(world)
    play(world, 30.0)

    assert max(command.linear.x for command in commands) == 0.4
    assert commands[-1] == twist()
    assert 0.5 < distance(sim) < 1.0


def test_stale_data_stops_the_follower_with_one_clear_sentence_until_it_is_fresh():
    world, _ = turtle_world(stale_after=seconds(1))
    commands = heard(world)
    At(
        world,
        (4.1, lambda: world.call("kill", build(Kill.Request, "turtle1"))),
        (9.5, lambda: world.call("spawn", build(Spawn.Request, 2.0, 2.0, 0.0, "turtle1"))),
    )
    play(world, 12.0)

    said = log_texts(world, "listener")
    assert said[1:] == [
        "The newest transform of turtle1 in turtle2 is 1.904 s old, the limit is 1 s: "
        "stopping until there is a newer transform",
        "There are new transforms of turtle1: following again",
    ]
    # The commands are sent at 3, 4 and 5 s, the stop at 6 s, then commands at 10, 11 and 12 s.
    assert len(commands) == 7
    assert commands[3] == twist()
    assert commands[4] != twist()


def test_without_a_limit_old_data_is_followed_as_in_the_tutorial():
    world, _ = turtle_world()
    commands = heard(world)
    At(world, (4.1, lambda: world.call("kill", build(Kill.Request, "turtle1"))))
    play(world, 9.0)

    assert len(commands) == 7
    assert all(command == commands[2] for command in commands[2:])


def test_frames_that_never_change_never_are_stale():
    world = new_world()
    links = [
        TransformStamped(0, "world", name, Transform((float(x), 0.0, 0.0)))
        for x, name in enumerate(("robot", "goal"))
    ]
    StaticBroadcaster(world, "statics", transforms=links)
    Follower(
        world, "listener", leader="goal", follower="robot", spawn=None, stale_after=seconds(0.5)
    )
    commands = heard(world, "robot")
    play(world, 3.0)

    assert commands == [twist(0.5, 0.0)] * 3


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"follower": "[bold]"}, r"'\[bold\]' cannot be a turtle's name"),
        ({"leader": "a", "follower": "a"}, "'a' cannot follow itself"),
        ({"period": 0}, "a period must be longer than 0 s"),
        ({"delay": -1}, "a delay must be 0 s or more"),
        ({"stale_after": 0}, "a limit for stale data must be longer than 0 s"),
        ({"dead_band": math.nan}, "the dead band must be zero metres or more"),
    ],
)
def test_a_follower_that_cannot_be_is_refused_and_does_not_join(wrong, told):
    world = new_world()

    with pytest.raises(UsageError, match=told):
        Follower(world, "listener", **wrong)
    assert world.nodes == []


def test_two_runs_of_the_demo_are_equal_to_the_last_bit():
    def lived():
        world, sim = turtle_world(distance_gains=Gains(0.5, 0.05, 0.1))
        commands = heard(world)
        play(world, 15.0)
        return commands, list(world.log.records), list(sim.trail.segments)

    assert lived() == lived()


def test_endpoints_name_their_nodes_and_types_until_the_nodes_end():
    world = new_world()
    Turtlesim(world, "sim")
    Broadcaster(world, "broadcaster1", turtle="turtle1")
    Broadcaster(world, "broadcaster2", turtle="turtle2")
    Follower(world, "listener")
    ends = {}

    def look():
        for topic in ("turtle2/cmd_vel", "turtle1/pose", "tf"):
            ends[topic] = [
                sorted((end.node, end.interface) for end in world.endpoints.of(topic, role))
                for role in (PUBLISHER, SUBSCRIPTION)
            ]

    At(world, (5.0, look))
    play(world, 6.0)

    twist, pose, tf = "geometry_msgs/msg/Twist", "turtlesim/msg/Pose", "tf2_msgs/msg/TFMessage"
    assert ends == {
        "turtle2/cmd_vel": [[("listener", twist)], [("sim", twist)]],
        "turtle1/pose": [[("sim", pose)], [("broadcaster1", pose)]],
        "tf": [[("broadcaster1", tf), ("broadcaster2", tf)], []],
    }
    # An ended node has no publishers and subscriptions.
    assert world.endpoints.topics() == []
