import pytest

from tftool.base.errors import TftoolError
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES, build
from tftool.messages.turtle_messages import Empty, Pose, RotateAbsolute, Spawn, Twist, twist
from tftool.world.clock import SimClock, run
from tftool.world.endpoints import Quality
from tftool.world.node import Node
from tftool.world.topics import GoalResult, Topic
from tftool.world.world import TransformMessage, World


def test_every_subscriber_has_been_told_when_publish_returns():
    topic = Topic("pose", Pose)
    told = []
    topic.subscribe(lambda pose: told.append(("first", pose.x)))
    topic.subscribe(lambda pose: told.append(("second", pose.x)))

    topic.publish(build(Pose, 1.0, 2.0, 0.0))

    assert told == [("first", 1.0), ("second", 1.0)]
    assert topic.latest == build(Pose, 1.0, 2.0, 0.0)
    assert topic.count == 1


def test_a_subscriber_that_leaves_during_publish_causes_no_other_to_be_skipped():
    topic = Topic("pose", Pose)
    told = []
    stops = []

    def leaves(_):
        told.append("leaver")
        stops[0]()

    stops.append(topic.subscribe(leaves))
    topic.subscribe(lambda _: told.append("stayer"))

    topic.publish(build(Pose, 0, 0, 0))
    topic.publish(build(Pose, 0, 0, 0))

    assert told == ["leaver", "stayer", "stayer"]
    assert topic.subscribers == 1


def test_a_value_of_another_kind_is_refused():
    with pytest.raises(TypeError, match="has messages of type Pose, not Twist"):
        Topic("pose", Pose).publish(twist())


def test_one_name_carries_one_kind():
    world = World(SimClock())
    assert world.topic("/turtle1/pose", Pose) is world.topic("turtle1/pose", Pose)

    with pytest.raises(
        TftoolError, match="has the type turtlesim/msg/Pose, not geometry_msgs/msg/T"
    ):
        world.topic("turtle1/pose", Twist)


def test_a_forgotten_topic_starts_anew():
    world = World(SimClock())
    world.topic("turtle1/pose", Pose).publish(build(Pose, 1, 1, 1))

    world.remove_topic("/turtle1/pose")

    assert "turtle1/pose" not in world.topics()
    assert world.topic("turtle1/pose", Pose).latest is None


def test_a_publisher_goes_on_with_the_topic_that_took_the_place_of_its_own():
    world = World(SimClock())
    publisher = world.publisher("sim", "turtle1/pose", Pose)
    publisher.publish(build(Pose, 1, 1, 1))
    before = world.topic("turtle1/pose", Pose)
    world.remove_topic("turtle1/pose")
    told = []
    world.topic("turtle1/pose", Pose).subscribe(told.append)

    assert publisher.subscribers == 1
    publisher.publish(build(Pose, 2, 2, 2))

    assert told == [build(Pose, 2, 2, 2)]
    assert before.latest == build(Pose, 1, 1, 1)
    world.remove_topic("turtle1/pose")
    publisher.publish(build(Pose, 3, 3, 3))
    assert world.topic("turtle1/pose", Pose).latest == build(Pose, 3, 3, 3)


def test_a_broadcast_is_the_latest_message_with_or_without_subscribers():
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
    topic = Topic("pose", Pose)

    async def main():
        stream = topic.stream(depth=2)
        first = clock.timer(clock.now() + seconds(1))
        first.add_done_callback(lambda _: topic.publish(build(Pose, 0, 0, 0)))
        seen = [(await anext(stream)).x]
        for x in (1, 2, 3):
            topic.publish(build(Pose, x, 0, 0))
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
    with pytest.raises(TftoolError, match="'spawn' already has a server"):
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
        goal = world.send_goal("/rotate", 1, told.append)
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
        goal = world.send_goal("rotate", 1)
        goal.cancel()
        return goals[0].cancel_requested, goal.done

    assert run(world.clock, main()) == (True, False)


def test_an_action_nobody_serves_is_named():
    world = World(SimClock())
    with pytest.raises(TftoolError, match="no node serves the action 'rotate'"):
        run(world.clock, world.send_goal("rotate", 1))


def test_two_who_name_a_topics_class_are_given_the_same_messages():
    world = World(SimClock())
    first, second = [], []
    world.topic("cmd_vel", Twist).subscribe(first.append)
    stop = world.topic("cmd_vel", INTERFACES.message("geometry_msgs/Twist")).subscribe(
        second.append
    )

    world.topic("cmd_vel", Twist).publish(twist(1.0))
    stop()
    world.topic("cmd_vel", Twist).publish(twist(4.0))

    assert first == [twist(1.0), twist(4.0)]
    assert second == [twist(1.0)]
    assert world.topic("cmd_vel", Twist).latest == twist(4.0)
    assert world.topic("cmd_vel", Twist).count == 2


def test_a_late_subscriber_gets_what_follows():
    world = World(SimClock())
    node = Node(world, "driver")
    node.publish("cmd_vel", twist(1.0))
    messages = []
    world.subscribe("reader", "cmd_vel", Twist, messages.append)

    node.publish("cmd_vel", twist(2.0))

    assert messages == [twist(2.0)]


def test_a_latched_publisher_keeps_messages_for_late_subscribers():
    world = World(SimClock())
    publisher = world.publisher("map", "goal", Twist, Quality(1, is_latched=True))
    publisher.publish(twist(1.0))
    publisher.publish(twist(2.0))
    late = []

    world.subscribe("late", "goal", Twist, late.append, Quality(is_latched=True))

    assert late == [twist(2.0)]


def test_a_value_that_is_not_the_topics_is_refused_at_its_door():
    with pytest.raises(TypeError, match="has messages of type Twist, not Pose"):
        World(SimClock()).topic("cmd_vel", Twist).publish(build(Pose, 0.0, 0.0, 0.0))


def test_a_service_answers_messages_of_its_type_alone():
    async def ask():
        world = World(SimClock())
        world.serve("ours", lambda request: Spawn.Response(name=request.name.upper()), Spawn)
        world.serve("silent", lambda request: None, Spawn)

        assert await world.call("ours", Spawn.Request(name="bob")) == Spawn.Response(name="BOB")
        assert await world.call("silent", Spawn.Request(name="bob")) == Spawn.Response()
        with pytest.raises(TftoolError, match="'ours' is of type turtlesim/srv/Spawn, which takes"):
            await world.call("ours", Empty.Request())

    run(SimClock(), ask())


def test_a_goals_client_and_server_share_its_feedback_and_its_end():
    rotate = RotateAbsolute

    async def act():
        world = World(SimClock())
        taken, fed = [], []
        world.serve_action("turn", taken.append, rotate)
        goal = world.send_goal("turn", rotate.Goal(theta=1.5), fed.append)
        assert taken[0].request == rotate.Goal(theta=1.5)
        taken[0].publish_feedback(rotate.Feedback(remaining=0.5))
        assert fed == [rotate.Feedback(remaining=0.5)]
        assert goal.feedback == rotate.Feedback(remaining=0.5)
        assert goal.ended is None
        taken[0].finish("succeeded", rotate.Result(delta=1.5))
        assert goal.done
        assert goal.ended == GoalResult("succeeded", rotate.Result(delta=1.5))

        handle = world.send_goal("turn", rotate.Goal(theta=2.0))
        handle.cancel()
        assert taken[1].cancel_requested
        assert await taken[1].cancellation()
        taken[1].finish("canceled", rotate.Result(delta=0.25))
        assert await handle.result() == GoalResult("canceled", rotate.Result(delta=0.25))

    run(SimClock(), act())
