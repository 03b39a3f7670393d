"""Tests of the simulator's parameter services as ROS 2's tools call them."""

import asyncio

import pytest

from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES
from tftool.world.clock import SimClock, run
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World


@pytest.fixture
def ask():
    world = World(SimClock())
    simulator = Turtlesim(world, "sim")

    def asked(service, kind, **fields):
        request = INTERFACES.find("rcl_interfaces", "srv", kind).Request(**fields)

        async def question():
            living = asyncio.ensure_future(live(world))
            await world.clock.sleep(seconds(0.05))
            answer = await world.call(f"sim/{service}", request)
            living.cancel()
            await asyncio.gather(living, return_exceptions=True)
            return answer

        return run(world.clock, question())

    asked.simulator = simulator
    return asked


def parameter(name, **value):
    made = INTERFACES.message("rcl_interfaces/ParameterValue")(**value)
    return INTERFACES.message("rcl_interfaces/Parameter")(name=name, value=made)


def test_the_simulator_lists_its_parameters_and_tells_their_types_and_values(ask):
    listed = ask("list_parameters", "ListParameters").result.names
    assert listed == ["background_r", "background_g", "background_b", "holonomic"]
    names = ["background_b", "holonomic", "speed"]
    assert list(ask("get_parameter_types", "GetParameterTypes", names=names).types) == [2, 1, 0]
    values = ask("get_parameters", "GetParameters", names=names).values
    assert [value.type for value in values] == [2, 1, 0]
    assert (values[0].integer_value, values[1].bool_value) == (255, False)
    described = ask("describe_parameters", "DescribeParameters", names=names).descriptors
    assert [(one.name, one.type) for one in described] == [("background_b", 2), ("holonomic", 1)]


def test_only_what_lies_below_a_prefix_is_listed(ask):
    def listed(*prefixes):
        return ask("list_parameters", "ListParameters", prefixes=list(prefixes)).result.names

    assert listed("holonomic") == ["holonomic"]
    assert listed("background") == []


def test_each_change_is_accepted_or_refused_by_itself(ask):
    results = ask(
        "set_parameters",
        "SetParameters",
        parameters=[
            parameter("background_r", type=2, integer_value=7),
            parameter("background_g", type=2, integer_value=256),
            parameter("background_b", type=4, string_value="blue"),
            parameter("backgroud_b", type=2, integer_value=1),
            parameter("holonomic", type=77),
            parameter("holonomic", type=1, bool_value=True),
        ],
    ).results

    assert [one.successful for one in results] == [True, False, False, False, False, True]
    assert [one.reason for one in results[1:5]] == [
        "background_g must be a whole number from 0 to 255, not 256",
        "parameter 'background_b' of node 'sim' takes int, not str ('blue')",
        "node 'sim' has no parameter 'backgroud_b'; did you mean 'background_b'?",
        "77 is not a known type of a parameter",
    ]
    assert (ask.simulator.background.r, ask.simulator.background.g) == (7, 86)
    assert ask.simulator.get_parameter("holonomic") is True


def test_of_changes_that_belong_together_all_are_made_or_none(ask):
    def changed(green):
        return ask(
            "set_parameters_atomically",
            "SetParametersAtomically",
            parameters=[
                parameter("background_r", type=2, integer_value=1),
                parameter("background_g", type=2, integer_value=green),
            ],
        ).result

    assert not changed(999).successful
    assert ask.simulator.background.r == 69
    assert changed(2).successful
    assert (ask.simulator.background.r, ask.simulator.background.g) == (1, 2)
