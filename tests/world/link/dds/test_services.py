"""Tests of services over DDS, between tftool's worlds and with a peer on Cyclone DDS."""

import asyncio

import pytest

from tests.world.link.conftest import until
from tests.world.link.dds.test_session import Silent, joined
from tftool.base.errors import LinkError
from tftool.messages.classes import INTERFACES
from tftool.world.endpoints import CLIENT, Endpoint, Quality
from tftool.world.link.graph import SERVER, GraphEntity

SWITCH = INTERFACES.find("std_srvs", "srv", "SetBool")


async def switched(request):
    return SWITCH.Response(success=request.data, message="switched")


def test_a_service_of_one_process_answers_another(domain):
    async def scene():
        async with joined(domain) as (robot, _), joined(domain) as (other, _):
            Silent(robot, "breaker")
            robot.serve("switch", switched, SWITCH, node="breaker")
            await until(lambda: "switch" in other.services())
            node = other.services()["switch"].node
            answers = [await other.call("switch", SWITCH.Request(data=to)) for to in (True, False)]
            return node, [(one.success, one.message) for one in answers]

    node, answers = asyncio.run(scene())
    assert answers == [(True, "switched"), (False, "switched")]
    assert node == "breaker"


def test_a_client_is_listed_once_with_its_node_before_and_after_its_request(domain):
    def named(world):
        return [(one.node, one.interface) for one in world.clients.of("switch", CLIENT)]

    async def scene():
        async with joined(domain) as (robot, _), joined(domain) as (other, _):
            Silent(other, "asker")
            Silent(other, "second")
            leave = other.clients.add(Endpoint(CLIENT, "asker", "switch", "std_srvs/srv/SetBool"))
            await until(lambda: named(robot) == [("asker", "std_srvs/srv/SetBool")])
            robot.serve("switch", switched, SWITCH)
            await until(lambda: "switch" in other.services())
            await other.call("switch", SWITCH.Request(data=True))
            after = named(robot)
            leave()
            await until(lambda: not named(robot))
            return after

    assert asyncio.run(scene()) == [("asker", "std_srvs/srv/SetBool")]


def test_a_service_on_cyclone_answers_us(peer, domain):
    peer("service", "serve")

    async def scene():
        async with joined(domain) as (world, _):
            await until(lambda: "switch" in world.services())
            return await world.call("switch", SWITCH.Request(data=True))

    answer = asyncio.run(scene())
    assert (answer.success, answer.message) == (True, "switched")


def test_a_client_on_cyclone_is_answered_by_us(peer, domain):
    asking = peer("service", "ask")

    async def scene():
        async with joined(domain) as (world, _):
            world.serve("switch", switched, SWITCH)
            await until(lambda: len(asking.lines) == 2)

    asyncio.run(scene())
    assert asking.lines == [["ready"], ["77", "5", "1", "switched"]]


def test_a_service_over_fast_dds_is_refused_by_name(domain):
    async def scene():
        async with joined(domain) as (_, link):
            gid = b"\x01\x0f" + bytes(14)
            quality = Quality()
            link.graph.add(
                "far",
                GraphEntity(SERVER, domain, "far", "n", "switch", SWITCH.interface__, quality, gid),
            )
            client = link.middleware.client("n", "switch", SWITCH.interface__)
            with pytest.raises(LinkError, match=r"Fast DDS.*rmw_cyclonedds_cpp or rmw_zenoh_cpp"):
                await client.ask(b"\0\1\0\0\1", 0, 5.0)
            return client

    assert asyncio.run(scene()) is not None
