"""Tests of services and actions between two worlds, each with a zenoh session."""

import asyncio
import gc
from types import FunctionType

import pytest

from tests.world.link.conftest import new_world, until
from tests.world.link.two import Two, play
from tftool.base.errors import LinkError, TftoolError
from tftool.messages.classes import INTERFACES, build
from tftool.messages.turtle_messages import Empty, Kill, RotateAbsolute, Spawn
from tftool.world.action_parts import ActionParts
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link


def test_a_service_of_the_host_is_one_of_the_guests_world():
    async def ask():
        async with Two() as two:
            asked = []

            async def spawn(request):
                asked.append(request)
                return build(Spawn.Response, request.name)

            stop = two.here.serve("spawn", spawn, Spawn)
            await until(lambda: two.there.has_service("spawn"))

            answer = await two.there.call("spawn", build(Spawn.Request, 4.0, 2.0, 0.0, "turtle2"))

            assert answer == build(Spawn.Response, "turtle2")
            assert asked == [build(Spawn.Request, 4.0, 2.0, 0.0, "turtle2")]
            stop()
            await until(lambda: not two.there.has_service("spawn"))

    play(ask())


def test_changes_made_by_a_watcher_while_the_link_looks_are_carried_too():
    async def answer():
        async with Two() as two:

            def changed():
                # The connection itself has just added the service of another process.
                if two.there.has_service("clear") and not two.there.has_service("spawn"):
                    two.there.serve(
                        "spawn", lambda request: build(Spawn.Response, "turtle2"), Spawn
                    )

            two.there.watch(changed)
            two.here.serve("clear", lambda request: None, Empty)
            await until(lambda: two.here.has_service("spawn"))

            assert await two.here.call("spawn", build(Spawn.Request, 4.0, 2.0)) == build(
                Spawn.Response, "turtle2"
            )

    play(answer())


def test_a_refusal_of_a_service_comes_back_as_a_sentence():
    async def ask():
        async with Two() as two:

            def refuse(request):
                raise TftoolError("no room for another turtle")

            two.here.serve("spawn", refuse, Spawn)
            await until(lambda: two.there.has_service("spawn"))

            with pytest.raises(LinkError, match="'spawn': it was refused: no room for another"):
                await two.there.call("spawn", build(Spawn.Request, 4.0, 2.0))

    play(ask())


def test_a_question_whose_server_leaves_ends():
    async def ask():
        two = Two()
        waits = asyncio.Event()

        async def never(request):
            waits.set()
            await asyncio.get_running_loop().create_future()

        two.here.serve("kill", never, Kill)
        two.here.serve("clear", never, Empty)
        await until(lambda: two.there.has_service("clear"))
        question = asyncio.ensure_future(two.there.call("clear", Empty.Request()))
        await waits.wait()
        two.host.close()

        with pytest.raises(LinkError, match="'clear'"):
            await question
        two.guest.close()

    play(ask())


class Rotation:
    """Rotate action that the test moves itself."""

    def __init__(self, world):
        self.goals = []
        world.serve_action("turtle1/rotate_absolute", self.goals.append, RotateAbsolute)


def test_a_goal_travels_with_its_feedback_and_its_end():
    async def turn():
        async with Two() as two:
            rotation = Rotation(two.here)
            await until(lambda: "turtle1/rotate_absolute" in two.there.actions())
            feedback = []

            goal = two.there.send_goal(
                "turtle1/rotate_absolute", build(RotateAbsolute.Goal, 1.5), feedback.append
            )
            await until(lambda: rotation.goals)
            (served,) = rotation.goals
            assert served.request == build(RotateAbsolute.Goal, 1.5)
            assert served.goal_id == goal.goal_id
            served.publish_feedback(build(RotateAbsolute.Feedback, 0.5))
            await until(lambda: feedback)
            served.finish("succeeded", build(RotateAbsolute.Result, -1.5))
            result = await goal.result()

            assert feedback == [build(RotateAbsolute.Feedback, 0.5)]
            assert (result.status, result.value) == (
                "succeeded",
                build(RotateAbsolute.Result, -1.5),
            )

    play(turn())


def test_the_services_of_an_action_can_be_called_from_another_process():
    parts = RotateAbsolute.Impl
    names = {f"turtle1/rotate_absolute/_action/{part}" for part in ("send_goal", "cancel_goal")}

    async def turn():
        async with Two() as two:
            rotation = Rotation(two.here)
            await until(lambda: names <= two.there.services().keys())
            goal_id = INTERFACES.message("unique_identifier_msgs/UUID")(uuid=[7] * 16)
            sent = parts.SendGoalService.Request(
                goal_id=goal_id, goal=build(RotateAbsolute.Goal, 1.5)
            )
            answer = await two.there.call("turtle1/rotate_absolute/_action/send_goal", sent)
            every = parts.CancelGoalService.Request()
            ended = await two.there.call("turtle1/rotate_absolute/_action/cancel_goal", every)

            assert answer.accepted
            assert rotation.goals[0].request == build(RotateAbsolute.Goal, 1.5)
            assert [one.goal_id for one in ended.goals_canceling] == [goal_id]
            two.host.close()
            await until(lambda: not names & two.there.services().keys())

    play(turn())


def test_action_feedback_published_in_the_process_too_goes_over_the_link_once():
    fibonacci = INTERFACES.find("example_interfaces", "action", "Fibonacci")
    name = "count/_action/feedback"

    async def count():
        async with Two() as two:
            goals, heard, here = [], [], two.here
            here.serve_action("count", goals.append, fibonacci)
            inside = here.topic(name, fibonacci.Impl.FeedbackMessage)
            inside.subscribe(lambda message: None)
            ActionParts(
                here,
                "count",
                fibonacci.interface__,
                on_feedback=inside.publish,
                on_status=lambda message: None,
                warn=lambda text: None,
            )
            two.there.topic(name, fibonacci.Impl.FeedbackMessage).subscribe(heard.append)
            graph = two.host.graph
            await until(lambda: graph.entities(SUBSCRIPTION, name=name))
            here.send_goal("count", fibonacci.Goal())
            for number in range(3):
                goals[0].publish_feedback(fibonacci.Feedback(sequence=[number]))
            await until(lambda: heard and list(heard[-1].feedback.sequence) == [2])

            assert [list(one.feedback.sequence) for one in heard] == [[0], [1], [2]]
            assert len(two.guest.graph.entities(PUBLISHER, name=name)) == 1

    play(count())


def test_a_goal_is_called_off_over_the_link():
    async def turn():
        async with Two() as two:
            rotation = Rotation(two.here)
            await until(lambda: "turtle1/rotate_absolute" in two.there.actions())
            goal = two.there.send_goal("turtle1/rotate_absolute", build(RotateAbsolute.Goal, 1.5))
            await until(lambda: rotation.goals)
            served = rotation.goals[0]

            goal.cancel()
            await until(lambda: served.cancel_requested)
            served.finish("canceled", build(RotateAbsolute.Result, 0.25))

            assert (await goal.result()).status == "canceled"

    play(turn())


def test_a_goal_whose_host_leaves_ends_as_aborted():
    async def turn():
        two = Two()
        rotation = Rotation(two.here)
        await until(lambda: "turtle1/rotate_absolute" in two.there.actions())
        goal = two.there.send_goal("turtle1/rotate_absolute", build(RotateAbsolute.Goal, 1.5))
        await until(lambda: rotation.goals)

        two.host.close()

        assert (await goal.result()).status == "aborted"
        assert "turtle1/rotate_absolute" not in two.there.actions()
        two.guest.close()

    play(turn())


def test_a_question_that_is_cancelled_is_taken_back():
    async def ask():
        with Link(Options("server")) as server, Link(Options("client")) as client:
            arrived = []
            server.attach(new_world(), role=Role.HOST)
            client.attach(new_world(), role=Role.GUEST)
            stop = server.middleware.server("node", "slow", "std_srvs/srv/Empty", arrived.append)
            wire = client.middleware.client("node", "slow", "std_srvs/srv/Empty")
            await until(lambda: client.graph.entities("server", name="slow"))
            held = asyncio.ensure_future(wire.ask(b"\0\1\0\0\0", 1, timeout=3600.0))
            await until(lambda: arrived)
            assert waiting() == 1
            held.cancel()
            del held
            # zenoh releases the function that it would call with the response.
            await until(lambda: waiting() == 0)
            arrived[0].answer(b"\0\1\0\0\0", 1)
            stop()

    def waiting():
        """Return the pending requests for which zenoh would still deliver a response."""
        gc.collect()
        # Only functions are searched: other objects of the process may refuse access to a name.
        names = [one.__qualname__ for one in gc.get_objects() if type(one) is FunctionType]
        return names.count("Wire.ask.<locals>.replied")

    play(ask())
