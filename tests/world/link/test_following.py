"""Tests of clocks that follow `/clock` of another process while it is published."""

import contextlib

import pytest

from tests.world.link.conftest import until
from tests.world.link.memory import MemoryReach
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES
from tftool.world.clock import FollowedClock, WallClock, run
from tftool.world.endpoints import Quality
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.link.session_world import shared
from tftool.world.link.topic_bridges import is_clock_shown
from tftool.world.world import World

pytestmark = pytest.mark.usefixtures("by_memory")

CLOCK = INTERFACES.message("rosgraph_msgs/Clock")


def reading(moment):
    message = CLOCK()
    message.clock.sec, message.clock.nanosec = divmod(moment, 10**9)
    return message


@contextlib.contextmanager
def joined(role="guest", clock=FollowedClock):
    """Yield the connection, the world of a host, and the world of a guest with a clock."""
    host, guest = World(WallClock()), World(clock())
    links = [Link(Options(name, reach=MemoryReach())) for name in ("play", "echo")]
    links[0].attach(host, role=Role.HOST)
    try:
        with shared(links[1], guest, role):
            yield links[1], host, guest
    finally:
        links[0].close()


@pytest.mark.parametrize("role", ["guest", "source"])
def test_a_world_that_has_joined_takes_now_from_the_clock_that_is_published(role):
    async def follow():
        with joined(role) as (link, host, guest):
            assert not is_clock_shown(link.graph)
            assert not guest.clock.is_told

            publisher = host.publisher("player", "clock", CLOCK, Quality())
            topic = host.topic("clock", CLOCK)
            await until(lambda: topic.far_subscribers)
            assert is_clock_shown(link.graph)

            publisher.publish(reading(seconds(20)))
            await until(lambda: guest.clock.is_told)
            assert guest.clock.now() == seconds(20)

            moved = TransformStamped(seconds(20), "a", "b", Transform())
            guest.buffer.set_transform(moved, "node")
            publisher.publish(reading(seconds(12)))
            await until(lambda: guest.clock.now() == seconds(12))
            assert [one.text for one in guest.log.records if one.level == "WARN"] == [
                "Detected jump back in time. Clearing tf buffer."
            ]
            assert not guest.buffer.can_transform("a", "b", 0)

            publisher.close()
            await until(lambda: not guest.clock.is_told)
            assert seconds(12) <= guest.clock.now() < seconds(12 + 600)

    run(WallClock(), follow())


def test_transforms_before_the_first_clock_message_are_not_called_years_old():
    async def follow():
        with joined() as (link, host, guest):
            clock = host.publisher("player", "clock", CLOCK, Quality())
            topic = host.topic("clock", CLOCK)
            await until(lambda: topic.far_subscribers and is_clock_shown(link.graph))

            host.broadcast([TransformStamped(seconds(20), "a", "b", Transform())], "player")
            await until(lambda: guest.buffer.frame_exists("b"))

            assert not guest.clock.is_told
            assert [one.text for one in guest.log.records if "clock" in one.text] == []
            clock.close()

    run(WallClock(), follow())


def test_a_world_with_a_clock_of_its_own_forgets_transforms_where_clock_falls_back():
    async def follow():
        with joined(clock=WallClock) as (link, host, guest):
            publisher = host.publisher("player", "clock", CLOCK, Quality())
            topic = host.topic("clock", CLOCK)
            await until(lambda: topic.far_subscribers and is_clock_shown(link.graph))

            # The buffer keeps ten seconds, so it would reject the second transform.
            for moment, frame in ((seconds(90), "first"), (seconds(20), "second")):
                host.buffer.clear()
                publisher.publish(reading(moment))
                told, last = guest.topic("clock", CLOCK), reading(moment)
                await until(lambda told=told, last=last: told.latest == last)
                sent = TransformStamped(moment, "a", "b", Transform())
                named = TransformStamped(moment, "a", frame, Transform())
                host.broadcast([sent, named], "player")
                await until(lambda frame=frame: guest.buffer.frame_exists(frame))

            assert guest.buffer.lookup_transform("a", "b").stamp == seconds(20)
            assert guest.clock.now() > seconds(10**9)
            assert [one.text for one in guest.log.records if one.level == "WARN"] == []

    run(WallClock(), follow())


def test_a_late_transform_of_the_last_round_of_a_playback_is_no_fast_clock():
    async def follow():
        with joined() as (link, host, guest):
            publisher = host.publisher("player", "clock", CLOCK, Quality())
            topic = host.topic("clock", CLOCK)
            await until(lambda: topic.far_subscribers and is_clock_shown(link.graph))
            publisher.publish(reading(seconds(20)))
            await until(lambda: guest.clock.is_told)

            host.broadcast([TransformStamped(seconds(90), "a", "b", Transform())], "node")
            await until(lambda: guest.buffer.frame_exists("b"))
            assert [one.text for one in guest.log.records if "clock" in one.text] == []

    run(WallClock(), follow())
