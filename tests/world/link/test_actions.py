"""Tests of an action server with goals from other processes."""

import asyncio

import pytest

from tests.patience import PATIENCE
from tests.world.link.conftest import new_world, until
from tftool.messages.classes import INTERFACES, build
from tftool.messages.turtle_messages import RotateAbsolute
from tftool.world import action_parts
from tftool.world.clock import WallClock, run
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.service_bridges import ActionServer
from tftool.world.link.session import Link

ROTATE = "turtlesim/action/RotateAbsolute"
CANCEL = "action_msgs/srv/CancelGoal"
UNKNOWN = 2


def message(ros_type, **fields):
    return INTERFACES.part(ros_type)(**fields)


def goal_id(number):
    kind = INTERFACES.part("unique_identifier_msgs/msg/UUID")
    return kind(uuid=bytes([number]) * 16)


class Stranger:
    """Client that exchanges raw requests with an action server; the test ends goals itself."""

    def __init__(self, link, world, *, decides=False):
        self.goals = []
        self.decides = decides
        world.serve_action("turn", self.take)
        self.server = ActionServer(
            link, "sim", "turn", INTERFACES.find("turtlesim", "action", "RotateAbsolute")
        )

    def take(self, goal):
        self.goals.append(goal)
        if self.decides:
            goal.decided = asyncio.get_running_loop().create_future()

    async def send(self, number):
        goal = message(f"{ROTATE}_Goal", theta=1.5)
        asked = message(f"{ROTATE}_SendGoal_Request", goal_id=goal_id(number), goal=goal)
        return (await self.server.parts.send_goal(asked)).accepted

    async def cancel(self, number):
        info = message("action_msgs/msg/GoalInfo", goal_id=goal_id(number))
        asked = message(f"{CANCEL}_Request", goal_info=info)
        return (await self.server.parts.cancel_goal(asked)).return_code


def meet(coroutine, **kwargs):
    async def attached():
        with Link(Options("demo")) as link:
            world = new_world()
            link.attach(world, role=Role.HOST)
            stranger = Stranger(link, world, **kwargs)
            await coroutine(stranger, world)
            stranger.server.close()

    run(WallClock(), asyncio.wait_for(attached(), PATIENCE))


@pytest.fixture(autouse=True)
def three_are_kept(monkeypatch):
    monkeypatch.setattr(action_parts, "KEPT", 3)


def test_a_goal_under_way_is_never_forgotten_and_more_than_are_kept_are_refused():
    async def flood(stranger, world):
        assert [await stranger.send(number) for number in range(1, 6)] == [True] * 3 + [False] * 2
        assert len(stranger.goals) == 3
        (told,) = [record.text for record in world.log.records if "goals" in record.text]
        assert told == (
            "'turn': 3 goals run, which is the maximum: further goals are refused until one ends."
        )

        assert await stranger.cancel(1) == 0
        assert stranger.goals[0].cancel_requested

    meet(flood)


def test_of_the_goals_that_ended_the_oldest_makes_way_for_a_new_one():
    async def replace(stranger, world):
        for number in range(1, 4):
            await stranger.send(number)
        for goal in stranger.goals[1:]:
            goal.finish("succeeded", build(RotateAbsolute.Result, 0.0))

        assert await stranger.send(4)
        assert await stranger.cancel(1) == 0
        assert await stranger.cancel(2) == UNKNOWN
        assert await stranger.cancel(3) not in (0, UNKNOWN)

    meet(replace)


def test_a_goal_that_comes_again_while_it_is_decided_on_begins_once():
    async def repeat(stranger, world):
        first = asyncio.ensure_future(stranger.send(1))
        await until(lambda: stranger.goals)
        second = asyncio.ensure_future(stranger.send(1))
        await until(lambda: second.done() or len(stranger.goals) == 2)
        for goal in stranger.goals:
            goal.decided.set_result(True)

        assert (await first, await second) == (True, False)
        assert len(stranger.goals) == 1

    meet(repeat, decides=True)


def test_undecided_goals_count_toward_the_limit_and_refused_goals_do_not():
    async def decide(stranger, world):
        asked = [asyncio.ensure_future(stranger.send(number)) for number in range(1, 4)]
        await until(lambda: len(stranger.goals) == 3)
        assert not await stranger.send(4)
        for goal in stranger.goals:
            goal.decided.set_result(False)
        assert [await one for one in asked] == [False] * 3

        stranger.decides = False
        assert await stranger.send(4)

    meet(decide, decides=True)
