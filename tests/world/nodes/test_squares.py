from tests.world.nodes.harness import At, log_texts, new_world, play
from tftool.messages.turtle_messages import Empty, Pose, Twist, twist
from tftool.world.nodes.turtle_drivers import DrawSquare, Mimic, Teleop
from tftool.world.nodes.turtlesim import Turtlesim


def test_the_simulator_is_reset_once_before_the_first_side():
    world = new_world()
    sim = Turtlesim(world)
    DrawSquare(world)
    play(world, 3.0)

    said = log_texts(world)
    assert said.count("Resetting turtlesim.") == 1
    assert said[2] == "New goal [7.544445 5.544445, 0.000000]"
    assert "Reached goal" in said
    assert 7.4 < sim.turtles["turtle1"].place.x < 7.5


def test_nothing_is_driven_before_there_is_a_simulator():
    world = new_world()
    commands = []
    world.topic("turtle1/cmd_vel", Twist).subscribe(commands.append)
    square = DrawSquare(world)
    At(world, (0.5, lambda: Turtlesim(world)))
    play(world, 0.4)
    assert square.goal is None
    assert commands == []

    asked = []
    world = new_world()
    DrawSquare(world)
    world.serve("reset", asked.append)
    play(world, 0.4)
    assert asked == [Empty.Request()]


def test_a_copy_drives_forward_when_its_leader_reverses():
    world = new_world()
    sim = Turtlesim(world)
    teleop = Teleop(world)
    Mimic(world, leader="turtle1", copy="copy")
    poses = []
    world.topic("copy/pose", Pose).subscribe(poses.append)
    commands = []
    world.topic("copy/cmd_vel", Twist).subscribe(commands.append)
    At(world, (0.1, lambda: teleop.press("down")))
    play(world, 0.5)

    assert sim.turtles["turtle1"].forward == -2.0
    assert commands[-1] == twist(2.0, 0.0)
