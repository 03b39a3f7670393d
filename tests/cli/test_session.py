import pytest

from tftool.cli.session import HEAD_START, open_empty_session, open_session
from tftool.errors import InputError, NodeFailed, UsageError
from tftool.runtime.clock import SimClock
from tftool.runtime.node import Node
from tftool.stamps import seconds


class Failing(Node):
    async def run(self):
        await self.clock.sleep(seconds(2))
        raise ValueError("out of order")


class Brief(Node):
    async def run(self):
        await self.clock.sleep(seconds(1))


def test_a_node_that_fails_ends_the_work_with_its_name():
    session = open_empty_session(SimClock())
    Failing(session.world, "failing")

    with pytest.raises(NodeFailed, match="node 'failing' failed: ValueError: out of order"):
        session.run(session.lasting(None))
    assert session.world.clock.elapsed() == seconds(2)


def test_a_world_whose_nodes_are_done_does_not_end_the_work():
    session = open_empty_session(SimClock())
    Brief(session.world, "brief")

    session.run(session.lasting(seconds(5)))

    assert session.world.clock.elapsed() == seconds(5)


def test_the_world_ends_with_the_work_which_hands_back_its_result():
    session = open_session("turtles", clock=SimClock())

    async def work():
        await session.world.clock.sleep(seconds(2.5))
        return session.world.buffer.frames()

    assert session.run(work()) == ["turtle1", "world", "turtle2"]
    assert session.world.clock.elapsed() == seconds(2.5)


def test_a_hosted_world_outlives_its_scenario_for_whoever_looks():
    session = open_session("static", clock=SimClock())

    session.run(session.lasting(session.duration + seconds(100)))

    assert session.world.clock.elapsed() > session.duration


def test_work_begins_after_the_head_start(simulated, capsys):
    session = open_session()
    began = []

    async def work():
        began.append(session.world.clock.elapsed())

    session.run(work())

    assert began == [HEAD_START]
    assert capsys.readouterr().err == "No session is running here: hosting scenario 'turtles'.\n"


def test_a_source_that_was_named_is_hosted_without_a_word(simulated, capsys):
    assert open_session("robot").is_hosted
    assert capsys.readouterr().err == ""


def test_a_world_can_be_lived_through_to_a_moment():
    session = open_session("turtles", clock=SimClock())

    session.live_until(session.moment(seconds(1)))

    assert session.world.clock.elapsed() == seconds(1)


def test_a_moment_after_the_end_is_refused():
    session = open_session("turtles", clock=SimClock())

    with pytest.raises(UsageError, match="scenario 'turtles' lasts 60 s: 61 s is after its end"):
        session.moment(seconds(61))
    assert open_empty_session(SimClock()).moment(seconds(1e6)) > 0


def test_nodes_can_be_left_out_and_the_memory_set():
    session = open_session(
        "turtles",
        clock=SimClock(),
        cache_time=seconds(3),
        without=lambda node: node.kind == "follower",
    )

    assert session.world.buffer.cache_time == seconds(3)
    assert "follower" not in {node.name for node in session.world.nodes}


@pytest.mark.parametrize(("by_hand", "moved"), [(False, True), (True, False)])
def test_the_script_drives_unless_somebody_else_does(by_hand, moved):
    session = open_session("turtles", clock=SimClock(), by_hand=by_hand)

    session.live_until(session.moment(seconds(30)))

    found = session.world.buffer.lookup_transform("world", "turtle1")
    assert (found.transform.translation.x != pytest.approx(5.544445)) is moved


def test_an_unknown_source_is_told():
    with pytest.raises(InputError, match="did you mean 'orbit'"):
        open_session("orbti")
