import pytest

from tftool.errors import TftoolError
from tftool.messages import Pose2D, Twist2D
from tftool.runtime.clock import SimClock, run
from tftool.runtime.topics import Topic
from tftool.runtime.world import World
from tftool.stamps import seconds


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
