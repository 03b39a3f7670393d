import pytest

from tftool.base.errors import TftoolError
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.motion.twist import Twist2D
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES
from tftool.messages.turtle_values import (
    Clear,
    Pose2D,
    RotateAbsolute,
    Rotated,
    Rotating,
    Spawn,
    Spawned,
)
from tftool.world.clock import SimClock, run
from tftool.world.endpoints import Quality
from tftool.world.node import Node
from tftool.world.topics import GoalResult, Topic
from tftool.world.world import TransformMessage, World


def test_every_subscriber_has_been_told_when_publish_returns():
    topic = Topic("pose", Pose2D)
    told = []
    topic.subscribe(lambda pose: told.append(("first", pose.x)))
    topic.subscribe(lambda pose: told.append(("second", pose.x)))

    topic.publish(Pose2D(1.0, 2.0, 0.0))

    assert told == [("first", 1.0), ("second", 1.0)]
    assert topic.latest == Pose2D(1.0, 2.0, 0.0)
    assert topic.count == 1


def test_who_unsubscribes_while_being_told_skips_nobody():
    topic = Topic("pose", Pose2D)
    told = []
    stops = []

    def leaves(_):
        told.append("leaver")
        stops[0]()

    stops.append(topic.subscribe(leaves))
    topic.subscribe(lambda _: told.append("stayer"))

    topic.publish(Pose2D(0, 0, 0))
    topic.publish(Pose2D(0, 0, 0))

    assert told == ["leaver", "stayer", "stayer"]
    assert topic.subscribers == 1


def test_a_value_of_another_kind_is_refused():
    with pytest.raises(TypeError, match="carries Pose2D, not Twist2D"):
        Topic("pose", Pose2D).publish(Twist2D())


def test_one_name_carries_one_kind():
    world = World(SimClock())
    assert world.topic("/turtle1/pose", Pose2D) is world.topic("turtle1/pose", Pose2D)

    with pytest.raises(TftoolError, match="carries turtlesim/msg/Pose, not geometry_msgs/msg/T"):
        world.topic("turtle1/pose", Twist2D)


def test_a_forgotten_topic_starts_anew():
    world = World(SimClock())
    world.topic("turtle1/pose", Pose2D).publish(Pose2D(1, 1, 1))

    world.remove_topic("/turtle1/pose")

    assert "turtle1/pose" not in world.topics()
    assert world.topic("turtle1/pose", Pose2D).latest is None


def test_a_publisher_goes_on_with_the_topic_that_took_the_place_of_its_own():
    world = World(SimClock())
    publisher = world.publisher("sim", "turtle1/pose", Pose2D)
    publisher.publish(Pose2D(1, 1, 1))
    before = world.topic("turtle1/pose", Pose2D)
    world.remove_topic("turtle1/pose")
    told = []
    world.topic("turtle1/pose", Pose2D).subscribe(told.append)

    assert publisher.subscribers == 1
    publisher.publish(Pose2D(2, 2, 2))

    assert told == [Pose2D(2, 2, 2)]
    assert before.latest == Pose2D(1, 1, 1)
    world.remove_topic("turtle1/pose")
    publisher.publish(Pose2D(3, 3, 3))
    assert world.topic("turtle1/pose", Pose2D).latest == Pose2D(3, 3, 3)


def test_what_was_broadcast_can_be_read_whether_or_not_anything_listened():
    world = World(SimClock())
    sample = TransformStamped(1, "world", "turtle1", Transform())
    told = []

    world.broadcast([sample], "me")
    assert world.tf.latest == TransformMessage((sample,), "me")

    world.tf.subscribe(told.append)
    later = sample._replace(stamp=2)
    world.broadcast([later], "me")
    assert told == [world.tf.latest] == [TransformMessage((later,), "me")]


def test_a_stream_hands_over_values_in_order_and_loses_the_oldest_when_slow():
    clock = SimClock()
    topic = Topic("pose", Pose2D)

    async def main():
        stream = topic.stream(depth=2)
        first = clock.timer(clock.now() + seconds(1))
        first.add_done_callback(lambda _: topic.publish(Pose2D(0, 0, 0)))
        seen = [(await anext(stream)).x]
        for x in (1, 2, 3):
            topic.publish(Pose2D(x, 0, 0))
        seen += [(await anext(stream)).x, (await anext(stream)).x]
        await stream.aclose()
        return seen

    assert run(clock, main()) == [0, 2, 3]
    assert topic.subscribers == 0


def test_a_service_answers_now_or_when_awaited():
    world = World(SimClock())

    async def later(request):
        await world.clock.sleep(seconds(3))
        return request * 2

    world.serve("now", lambda request: request + 1)
    stop = world.serve("/later", later)

    async def main():
        return await world.call("/now", 1), await world.call("later", 21)

    assert run(world.clock, main()) == (2, 42)
    assert world.clock.elapsed() == seconds(3)
    assert set(world.services()) == {"now", "later"}
    stop()
    assert not world.has_service("later")


def test_a_service_nobody_serves_is_named():
    world = World(SimClock())
    with pytest.raises(TftoolError, match="no node serves 'spawn'"):
        run(world.clock, world.call("spawn", None))


def test_two_may_not_serve_one_name():
    world = World(SimClock())
    world.serve("spawn", lambda _: None)
    with pytest.raises(TftoolError, match="'spawn' is served already"):
        world.serve("/spawn", lambda _: None)


def test_a_goal_gives_feedback_and_its_first_end_counts():
    world = World(SimClock())
    told = []

    def accept(goal):
        goal.publish_feedback(0.5)
        goal.finish("succeeded", goal.request + 1)
        goal.finish("aborted", None)

    world.serve_action("rotate", accept)

    async def main():
        goal = await world.send_goal("/rotate", 1, told.append)
        goal.cancel()
        return goal, await goal.result()

    goal, result = run(world.clock, main())
    assert (result.status, result.value) == ("succeeded", 2)
    assert told == [0.5]
    assert goal.feedback == 0.5
    assert not goal.cancel_requested, "a goal that has ended cannot be cancelled"


def test_a_goal_in_progress_can_be_asked_to_stop():
    world = World(SimClock())
    goals = []
    world.serve_action("rotate", goals.append)

    async def main():
        goal = await world.send_goal("rotate", 1)
        goal.cancel()
        return goals[0].cancel_requested, goal.done

    assert run(world.clock, main()) == (True, False)


def test_an_action_nobody_serves_is_named():
    world = World(SimClock())
    with pytest.raises(TftoolError, match="no node serves the action 'rotate'"):
        run(world.clock, world.send_goal("rotate", 1))


TWIST = INTERFACES.message("geometry_msgs/Twist")


def twist(x, z=0.0):
    message = TWIST()
    message.linear.x, message.linear.z = x, z
    return message


def test_a_topic_of_messages_is_one_of_values_to_those_who_name_a_value():
    world = World(SimClock())
    values, messages = [], []
    world.topic("cmd_vel", Twist2D).subscribe(values.append)
    stop = world.topic("cmd_vel", TWIST).subscribe(messages.append)

    world.topic("cmd_vel", Twist2D).publish(Twist2D(1.0))
    world.topic("cmd_vel", TWIST).publish(twist(2.0, 3.0))
    stop()
    world.topic("cmd_vel", Twist2D).publish(Twist2D(4.0))

    assert values == [Twist2D(1.0), Twist2D(2.0), Twist2D(4.0)]
    assert messages == [twist(1.0), twist(2.0, 3.0)]
    assert world.topic("cmd_vel", Twist2D).latest == Twist2D(4.0)
    assert world.topic("cmd_vel", TWIST).latest == twist(4.0)
    assert world.topic("cmd_vel", TWIST).count == 3


def test_a_reader_of_messages_that_comes_later_makes_them_from_then_on():
    world = World(SimClock())
    node = Node(world, "driver")
    node.publish("cmd_vel", Twist2D(1.0))
    messages = []
    world.subscribe("reader", "cmd_vel", TWIST, messages.append)

    node.publish("cmd_vel", Twist2D(2.0))

    assert messages == [twist(2.0)]


def test_a_latched_publisher_of_values_keeps_messages_for_those_who_come_late():
    world = World(SimClock())
    publisher = world.publisher("map", "goal", Twist2D, Quality(1, is_latched=True))
    publisher.publish(Twist2D(1.0))
    publisher.publish(Twist2D(2.0))
    late, values = [], []

    world.subscribe("late", "goal", TWIST, late.append, Quality(is_latched=True))
    world.subscribe("ours", "goal", Twist2D, values.append, Quality(is_latched=True))

    assert late == [twist(2.0)]
    assert values == [Twist2D(2.0)]


def test_a_value_that_is_not_the_topics_is_refused_at_its_door():
    with pytest.raises(TypeError, match="carries Twist2D, not Pose2D"):
        World(SimClock()).topic("cmd_vel", Twist2D).publish(Pose2D(0.0, 0.0, 0.0))


def test_a_service_takes_values_and_messages_and_answers_each_in_kind():
    spawn = INTERFACES.find("turtlesim", "srv", "Spawn")

    async def ask():
        world = World(SimClock())
        world.serve("ours", lambda request: Spawned(request.name.upper()), Spawn)
        world.serve("theirs", lambda request: spawn.Response(name=request.name + "!"), spawn)
        value, message = Spawn(1.0, 2.0, 0.0, "bob"), spawn.Request(name="bob")

        assert await world.call("ours", value) == Spawned("BOB")
        assert await world.call("theirs", value) == Spawned("bob!")
        assert await world.call("ours", message) == spawn.Response(name="BOB")
        assert await world.call("theirs", message) == spawn.Response(name="bob!")
        with pytest.raises(TftoolError, match="'ours' is of type turtlesim/srv/Spawn, which takes"):
            await world.call("ours", Clear())

    run(SimClock(), ask())


def test_a_goal_in_values_and_its_server_in_messages_understand_each_other():
    rotate = INTERFACES.find("turtlesim", "action", "RotateAbsolute")

    async def act():
        world = World(SimClock())
        taken, fed = [], []
        world.serve_action("turn", taken.append, rotate)
        goal = await world.send_goal("turn", RotateAbsolute(1.5), fed.append)
        assert taken[0].request == rotate.Goal(theta=1.5)
        taken[0].publish_feedback(rotate.Feedback(remaining=0.5))
        assert fed == [Rotating(0.5)]
        assert goal.feedback == Rotating(0.5)
        assert goal.ended is None
        taken[0].finish("succeeded", rotate.Result(delta=1.5))
        assert goal.done
        assert goal.ended == GoalResult("succeeded", Rotated(1.5))

        world.serve_action("spin", taken.append, RotateAbsolute)
        handle = await world.send_goal("spin", rotate.Goal(theta=2.0))
        assert taken[1].request == RotateAbsolute(2.0)
        handle.cancel()
        assert taken[1].cancel_requested
        assert await taken[1].cancellation()
        taken[1].finish("canceled", Rotated(0.25))
        assert await handle.result() == GoalResult("canceled", rotate.Result(delta=0.25))

    run(SimClock(), act())
