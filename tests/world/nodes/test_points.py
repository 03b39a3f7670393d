import pytest

from tests.world.nodes.harness import At, log_texts, new_world, play
from tftool.base.stamps import seconds
from tftool.messages.turtle_messages import PointStamped, point_stamped
from tftool.world.nodes.broadcasters import Broadcaster
from tftool.world.nodes.points import QUEUE_LENGTH, MessageBroadcaster, PointDrawer
from tftool.world.nodes.turtlesim import Turtlesim

TOPIC = "turtle3/turtle_point_stamped"


def point(stamp, frame="world"):
    return point_stamped(stamp, frame, 1.0, 2.0, 0.0)


def test_the_demo_places_every_point_of_turtle3_as_turtle1_sees_it():
    world = new_world()
    sim = Turtlesim(world)
    for number in (1, 3):
        Broadcaster(world, f"broadcaster{number}", turtle=f"turtle{number}")
    MessageBroadcaster(world)
    PointDrawer(world)
    play(world, 8.0)

    said = log_texts(world, "turtle_tf2_pose_drawer")
    assert log_texts(world, "turtle_tf2_message_broadcaster") == ["Successfully spawned turtle3"]
    # From the third second on, a point is logged per tick, in the instant of its publication.
    assert len(said) == world.topics()[TOPIC].count == 313
    assert said[0] == "Point of turtle3 in frame of turtle1: x:-1.544445 y:-3.544445 z:0.000000"
    x, y, _ = sim.turtles["turtle3"].place
    assert (x - 3.992) ** 2 + (y - 3.0) ** 2 == pytest.approx(1.0, abs=1e-3)


def test_a_point_waits_for_its_frame_and_no_longer_than_it_may():
    world = new_world()
    PointDrawer(world)
    points = world.topic(TOPIC, PointStamped)

    def begin():
        Turtlesim(world)
        Broadcaster(world, "broadcaster1", turtle="turtle1")

    At(
        world,
        (0.1, lambda: points.publish(point(seconds(1000.1)))),
        (0.8, begin),
        (0.9, lambda: points.publish(point(seconds(1001.5)))),
        (1.0, lambda: points.publish(point(seconds(1001.0), ""))),
    )
    play(world, 2.0)

    said = log_texts(world, "turtle_tf2_pose_drawer")
    # The first point is older than its frame's data; the second point's stamp was in the future.
    assert len(said) == 2
    assert said[0].startswith("Failure ")
    assert said[1] == "Point of turtle3 in frame of turtle1: x:-4.544445 y:-3.544445 z:0.000000"


def test_a_full_queue_drops_the_oldest():
    world = new_world()
    PointDrawer(world, patience=seconds(5))
    points = world.topic(TOPIC, PointStamped)

    def flood():
        for number in range(QUEUE_LENGTH + 20):
            points.publish(point(seconds(1002) + number))

    At(world, (0.1, flood))
    play(world, 6.0)

    assert len(log_texts(world)) == QUEUE_LENGTH


def test_a_demo_that_ends_while_it_starts_up_waits_for_nothing():
    world = new_world()
    MessageBroadcaster(world)
    play(world, 2.5)

    assert log_texts(world) == ["Service is not ready"] * 2


def test_the_drawer_names_the_turtle_and_the_frame_it_was_given():
    world = new_world()
    Turtlesim(world)
    Broadcaster(world, "broadcaster1", turtle="turtle1")
    PointDrawer(world, turtle="robot", target_frame="turtle1")
    points = world.topic("robot/turtle_point_stamped", PointStamped)
    At(world, (1.0, lambda: points.publish(point(0))))
    play(world, 2.0)

    [said] = log_texts(world, "turtle_tf2_pose_drawer")
    assert said.startswith("Point of robot in frame of turtle1: ")
