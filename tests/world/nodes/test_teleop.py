import pytest

from tests.world.nodes.harness import At, log_texts, new_world, play
from tftool.base.errors import UsageError
from tftool.messages.classes import build
from tftool.messages.turtle_messages import RotateAbsolute, Twist, twist
from tftool.world.clock import SimClock, run
from tftool.world.nodes.turtle_drivers import KEYS, KeyPress, Teleop
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World


def heard(world):
    commands = []
    world.topic("turtle1/cmd_vel", Twist).subscribe(commands.append)
    return commands


def test_the_scales_are_read_anew_at_every_press():
    world = new_world()
    commands = heard(world)
    teleop = Teleop(world, scale_linear=1, scale_angular=3)
    At(
        world,
        (0.1, lambda: teleop.press("up")),
        (0.1, lambda: teleop.press("right")),
        (0.2, lambda: teleop.set_parameter("scale_linear", 5)),
        (0.3, lambda: teleop.press("down")),
    )
    play(world, 0.5)

    assert commands == [twist(1.0, 0.0), twist(0.0, -3.0), twist(-5.0, 0.0)]


def test_no_command_carries_a_minus_zero():
    world = new_world()
    commands = heard(world)
    teleop = Teleop(world)
    At(world, *((0.1, lambda key=key: teleop.press(key)) for key in KEYS if len(key) > 1))
    play(world, 0.5)

    assert "-0.0" not in str(commands)


def test_unknown_keys_are_ignored_and_letters_count_in_either_case():
    world = new_world()
    commands = heard(world)
    goals = []
    world.serve_action("turtle1/rotate_absolute", goals.append)
    teleop = Teleop(world)
    keys = ["x", "", "UP", "F13", "B", "\x1b", "é"]
    hands = At(world, *((0.1, lambda key=key: teleop.press(key)) for key in keys))
    play(world, 0.5)

    assert hands.answers == [None, None, "cmd_vel", None, "rotate", None, None]
    assert commands == [twist(2.0, 0.0)]
    assert [goal.request for goal in goals] == [build(RotateAbsolute.Goal, -0.7854)]


def test_f_cancels_the_last_accepted_rotation_and_nothing_else():
    world = new_world()
    sim = Turtlesim(world)
    teleop = Teleop(world)
    At(
        world,
        (0.0, lambda: teleop.press("f")),
        (0.1, lambda: teleop.press("r")),
        (0.5, lambda: teleop.press("F")),
        (1.0, lambda: teleop.press("f")),
    )
    play(world, 2.0)

    assert "Rotation goal canceled" in log_texts(world)
    assert 0.3 < sim.turtles["turtle1"].place.theta < 0.5


def test_an_arrow_during_a_rotation_aborts_it():
    world = new_world()
    Turtlesim(world)
    teleop = Teleop(world)
    At(world, (0.1, lambda: teleop.press("r")), (0.5, lambda: teleop.press("up")))
    play(world, 2.0)

    assert "Velocity command received during rotation goal. Aborting goal" in log_texts(world)


def test_keys_also_come_by_topic_and_q_ends_the_node():
    world = World(SimClock())
    commands = heard(world)
    Teleop(world)
    keys = world.topic("keys", KeyPress)
    At(
        world,
        (0.1, lambda: keys.publish(KeyPress("left"))),
        (0.2, lambda: keys.publish(KeyPress("q"))),
        (0.3, lambda: keys.publish(KeyPress("left"))),
    )
    # Without a given end, the world ends with its last node.
    run(world.clock, live(world))

    assert commands == [twist(0.0, 2.0)]


def test_a_rotation_nobody_takes_is_told_and_teleop_goes_on():
    world = new_world()
    commands = heard(world)
    teleop = Teleop(world)
    At(world, (0.1, lambda: teleop.press("g")), (0.2, lambda: teleop.press("up")))
    play(world, 0.5)

    assert log_texts(world) == [
        "turtle1 cannot be turned: no node serves the action 'turtle1/rotate_absolute'"
    ]
    assert len(commands) == 1


@pytest.mark.parametrize("name", ["", "two words", "sim1/", "\x1b"])
def test_a_turtle_that_cannot_be_is_refused(name):
    with pytest.raises(UsageError, match="cannot be a turtle's name"):
        Teleop(new_world(), turtle=name)
