"""Tests of a clock whose time another process sets."""

import asyncio

from tftool.base.stamps import seconds
from tftool.world.clock import FollowedClock, SimClock, WallClock, pace_of, run
from tftool.world.node import Node
from tftool.world.supervisor import live
from tftool.world.world import World


async def settled():
    """Run everything that is pending on the event loop."""
    for _ in range(10):
        await WallClock().sleep(0)


def test_it_stands_still_between_two_tellings_and_wakes_what_is_due():
    clock, woken = FollowedClock(seconds(10)), []

    async def wait(number):
        await clock.sleep_until(seconds(number))
        woken.append((number, clock.now()))

    async def main():
        waiting = [asyncio.ensure_future(wait(number)) for number in (12, 11, 20)]
        await settled()
        clock.tell(seconds(15))
        await settled()
        for task in waiting:
            task.cancel()

    run(clock, main())

    assert woken == [(11, seconds(15)), (12, seconds(15))]


def test_a_sleeper_keeps_its_remaining_time_when_the_clock_falls_back():
    clock, woken, fell = FollowedClock(seconds(100)), [], []
    clock.fell_back.add(fell.append)

    async def wait():
        await clock.sleep(seconds(10))
        woken.append(clock.now())

    async def main():
        waiting = asyncio.ensure_future(wait())
        await settled()
        clock.tell(seconds(104))
        clock.tell(seconds(50))
        clock.tell(seconds(55))
        await settled()
        assert woken == []
        clock.tell(seconds(56))
        await waiting

    run(clock, main())

    assert woken == [seconds(56)]
    assert fell == [seconds(54)]


def test_the_first_telling_is_no_fall_and_begins_its_epoch():
    clock, fell = FollowedClock(), []
    clock.fell_back.add(fell.append)

    clock.tell(seconds(5))

    assert (clock.now(), clock.elapsed(), fell) == (seconds(5), 0, [])


def test_told_no_more_it_goes_on_from_where_it_stands():
    clock = FollowedClock(seconds(5))
    clock.run_on()

    first = clock.now()

    assert seconds(5) <= first <= clock.now() < seconds(5 + 60)


def test_moments_before_all_time_count_as_the_first():
    clock = FollowedClock(seconds(5))
    clock.tell(-3)
    assert clock.now() == 1


class Ticking(Node):
    def __init__(self, world):
        super().__init__(world, "ticking")
        self.ticks = []

    async def run(self):
        async for now in self.every(seconds(1)):
            self.ticks.append(now)


def test_a_nodes_timer_begins_anew_where_time_falls_back():
    clock = FollowedClock(seconds(100))
    node = Ticking(World(clock))

    async def main():
        living = asyncio.ensure_future(live(node.world))
        await settled()
        for moment in (101, 102, 50, 51, 52, 53):
            clock.tell(seconds(moment))
            await settled()
        node.world.stop()
        await living

    run(clock, main())

    assert node.ticks == [seconds(one) for one in (101, 102, 51, 52, 53)]


def test_at_time_0_all_wait_for_the_first_time():
    clock = FollowedClock(0)
    node = Ticking(World(WallClock()))
    node.clock = clock

    async def main():
        early = asyncio.ensure_future(clock.sleep_until(0))
        living = asyncio.ensure_future(live(node.world))
        await settled()
        assert (clock.now(), early.done(), node.ticks) == (0, False, [])
        for moment in (100, 101):
            clock.tell(seconds(moment))
            await settled()
        assert early.done()
        node.world.stop()
        await living

    run(WallClock(), main())

    assert node.ticks == [seconds(100), seconds(101)]
    assert [one.text for one in node.world.log.records] == []


def test_people_wait_by_real_time_where_the_worlds_is_told():
    simulated = SimClock()

    assert pace_of(simulated) is simulated
    assert type(pace_of(FollowedClock(seconds(5)))) is WallClock
