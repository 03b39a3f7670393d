import asyncio

import pytest

from tftool.base.errors import (
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
)
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.world.clock import SimClock, run
from tftool.world.world import World


@pytest.fixture
def world():
    return World(SimClock())


def put(world, at, child="turtle1", x=0.0, parent="world"):
    stamp = world.clock.epoch + seconds(at)
    world.buffer.set_transform(
        TransformStamped(stamp, parent, child, Transform((x, 0.0, 0.0))), "test"
    )


def later(world, at, action):
    timer = world.clock.timer(world.clock.epoch + seconds(at))
    timer.add_done_callback(lambda _: action())


def test_a_known_transform_is_returned_at_once(world):
    put(world, 0, x=3.0)

    async def main():
        return await world.wait_for_transform("world", "turtle1")

    assert run(world.clock, main()).transform.translation.x == 3.0
    assert world.clock.elapsed() == 0


def test_a_waiter_is_woken_by_the_set_that_makes_its_transform_possible(world):
    asked = world.clock.epoch + seconds(2)

    async def main():
        later(world, 1, lambda: put(world, 1, x=1.0))
        later(world, 3, lambda: put(world, 3, x=3.0))
        return await world.wait_for_transform("world", "turtle1", asked, seconds(10))

    found = run(world.clock, main())
    assert found.stamp == asked
    assert found.transform.translation.x == pytest.approx(2.0)
    assert world.clock.elapsed() == seconds(3)


def test_a_waiter_gives_up_at_its_deadline_and_says_what_was_missing(world):
    async def main():
        await world.wait_for_transform("world", "turtle1", 0, seconds(1.5))

    with pytest.raises(TimeoutException, match="Timed out waiting for transform") as late:
        run(world.clock, main())

    assert isinstance(late.value.__cause__, LookupException)
    assert world.clock.elapsed() == seconds(1.5)


def test_data_that_comes_in_the_instant_of_the_deadline_is_in_time(world):
    async def main():
        later(world, 1, lambda: put(world, 1))
        return await world.wait_for_transform("world", "turtle1", 0, seconds(1))

    assert run(world.clock, main()).child_frame_id == "turtle1"


def test_a_name_that_can_never_be_asked_for_is_refused_at_once(world):
    with pytest.raises(InvalidArgumentException):
        run(world.clock, world.wait_for_transform("/world", "turtle1", 0, seconds(1)))
    assert world.clock.elapsed() == 0


def test_a_moment_that_is_forgotten_already_is_not_waited_for(world):
    put(world, 0)
    put(world, 30)
    put(world, 31)
    with pytest.raises(ExtrapolationException):
        run(
            world.clock,
            world.wait_for_transform("world", "turtle1", world.clock.epoch + seconds(1)),
        )


def test_a_cancelled_waiter_leaves_nothing_behind(world):
    async def main():
        waiter = asyncio.get_running_loop().create_task(
            world.wait_for_transform("world", "turtle1", 0, seconds(60))
        )
        await world.clock.sleep(seconds(1))
        waiter.cancel()
        await asyncio.gather(waiter, return_exceptions=True)
        put(world, 1)
        return waiter.cancelled()

    assert run(world.clock, main())
    assert world.clock.elapsed() == seconds(1)


def test_many_waiters_are_answered_in_the_order_they_asked(world):
    answered = []

    async def wait(name):
        await world.wait_for_transform("world", "turtle1")
        answered.append(name)

    async def main():
        later(world, 1, lambda: put(world, 1))
        await asyncio.gather(*(wait(name) for name in range(20)))

    run(world.clock, main())
    assert answered == list(range(20))


def test_a_question_across_time_waits_for_both_of_its_halves(world):
    epoch = world.clock.epoch

    async def main():
        put(world, 0, x=5.0)
        later(world, 1, lambda: put(world, 1, x=6.0))
        later(world, 2, lambda: put(world, 2, child="turtle2", x=1.0))
        return await world.wait_for_transform_full(
            "turtle2", epoch + seconds(2), "turtle1", epoch + seconds(1), "world", seconds(5)
        )

    found = run(world.clock, main())
    assert found.transform.translation.x == pytest.approx(5.0)
    assert world.clock.elapsed() == seconds(2)


@pytest.mark.parametrize(
    ("name", "refused"),
    [("ghost", LookupException), ("", InvalidArgumentException), ("/a", InvalidArgumentException)],
)
def test_a_question_across_time_of_one_name_that_nobody_knows_comes_to_an_end(world, name, refused):
    epoch = world.clock.epoch
    with pytest.raises(refused):
        run(
            world.clock,
            world.wait_for_transform_full(name, epoch, name, epoch + 1, name, seconds(1)),
        )


def test_a_forgotten_half_is_not_waited_for_again(world):
    epoch = world.clock.epoch

    async def main():
        put(world, 0)
        later(world, 1, lambda: [put(world, at) for at in (40, 80)])
        later(world, 2, lambda: put(world, 2, child="turtle2"))
        await world.wait_for_transform_full(
            "turtle2", epoch + seconds(2), "turtle1", epoch, "world", seconds(5)
        )

    with pytest.raises(ExtrapolationException):
        run(world.clock, main())
    assert world.clock.elapsed() == seconds(2)


@pytest.mark.parametrize("timeout", [1.0, float("nan"), float("inf"), "1"])
def test_a_timeout_that_is_not_whole_nanoseconds_is_refused(world, timeout):
    with pytest.raises(TypeError, match=r"write seconds\(2.5\) for 2.5 seconds"):
        run(world.clock, world.wait_for_transform("world", "turtle1", 0, timeout))
    with pytest.raises(TypeError, match=r"write seconds\(2.5\) for 2.5 seconds"):
        run(
            world.clock,
            world.wait_for_transform_full("world", 1, "turtle1", 2, "world", timeout),
        )
