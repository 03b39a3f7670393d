import asyncio
import os
import signal
import time

import pytest

from tftool.base.errors import TftoolError
from tftool.base.stamps import seconds
from tftool.world.clock import Phase, SimClock, WallClock, run


def test_ten_simulated_minutes_pass_to_the_nanosecond():
    clock = SimClock()

    async def main():
        for _ in range(600):
            await clock.sleep(seconds(1))
        return clock.now()

    assert run(clock, main()) == clock.epoch + seconds(600)
    assert clock.elapsed() == seconds(600)


def test_a_simulated_clock_must_not_start_at_the_moment_that_means_latest():
    with pytest.raises(ValueError, match="must start after 0"):
        SimClock(0)


@pytest.mark.parametrize("rate", [0, -1, float("nan"), float("inf"), 1e308, 1e-320])
def test_a_wall_clock_wants_a_rate_that_moves(rate):
    with pytest.raises(ValueError, match="positive"):
        WallClock(rate)


@pytest.mark.parametrize("make_clock", [SimClock, WallClock])
def test_within_an_instant_phase_goes_before_rank_and_rank_before_order_of_asking(make_clock):
    clock = make_clock()
    woken = []

    async def wait(name, phase, rank):
        await clock.sleep_until(clock.epoch + 1000, phase, rank)
        woken.append(name)

    async def main():
        await asyncio.gather(
            wait("screen", Phase.WATCH, 0),
            wait("second follower", Phase.CONSUME, 2),
            wait("first follower", Phase.CONSUME, 1),
            wait("same rank, asked later", Phase.CONSUME, 1),
            wait("simulator", Phase.SIMULATE, 9),
        )

    run(clock, main())

    assert woken == [
        "simulator",
        "first follower",
        "same rank, asked later",
        "second follower",
        "screen",
    ]


def test_the_work_a_waiter_starts_ends_before_the_next_waiter_of_the_instant():
    clock = SimClock()
    seen = []

    async def later_steps():
        for step in range(5):
            seen.append(step)
            await _yield_once()

    async def _yield_once():
        future = asyncio.get_running_loop().create_future()
        asyncio.get_running_loop().call_soon(future.set_result, None)
        await future

    async def first():
        await clock.sleep(10, Phase.SIMULATE)
        await asyncio.get_running_loop().create_task(later_steps())

    async def second():
        await clock.sleep(10, Phase.WATCH)
        seen.append("watcher")

    async def main():
        await asyncio.gather(second(), first())

    run(clock, main())
    assert seen == [0, 1, 2, 3, 4, "watcher"]


def test_asyncio_timeouts_mean_simulated_time():
    clock = SimClock()

    async def main():
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(asyncio.get_running_loop().create_future(), 3600)
        return clock.elapsed()

    assert run(clock, main()) == seconds(3600)


def test_data_that_comes_in_the_instant_of_its_timeout_is_in_time():
    clock = SimClock()

    async def main():
        return await asyncio.wait_for(clock.sleep(seconds(2)), 2)

    run(clock, main())
    assert clock.elapsed() == seconds(2)


def test_a_run_in_which_nothing_is_due_says_so_instead_of_hanging():
    clock = SimClock()

    async def main():
        await asyncio.get_running_loop().create_future()

    with pytest.raises(TftoolError, match="no timer is due"):
        run(clock, main())


def test_a_thread_is_waited_for_although_time_stands_still():
    clock = SimClock()

    async def main():
        return await asyncio.to_thread(sum, [1, 2, 3])

    assert run(clock, main()) == 6
    assert clock.elapsed() == 0


def test_a_waiter_given_up_is_not_waited_for():
    clock = SimClock()

    async def main():
        clock.timer(clock.now() + seconds(100)).cancel()
        await clock.sleep(seconds(1))

    run(clock, main())
    assert clock.elapsed() == seconds(1)


def test_a_moment_that_has_passed_comes_at_once():
    clock = SimClock()

    async def main():
        await clock.sleep(seconds(5))
        await clock.sleep_until(clock.epoch)
        return clock.elapsed()

    assert run(clock, main()) == seconds(5)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("make_clock", [SimClock, WallClock])
def test_a_signal_lets_every_finally_run_and_then_interrupts(number, make_clock):
    clock = make_clock()
    cleaned = []
    before = signal.getsignal(number)

    async def main():
        try:
            os.kill(os.getpid(), number)
            while True:
                await clock.sleep(1000)
        finally:
            cleaned.append(True)

    with pytest.raises(KeyboardInterrupt):
        run(clock, main())
    assert cleaned == [True]
    assert signal.getsignal(number) is before


def test_tasks_left_behind_are_cancelled():
    clock = SimClock()
    ended = []

    async def forever():
        try:
            await clock.sleep(seconds(1e6))
        finally:
            ended.append(True)

    async def main():
        task = asyncio.get_running_loop().create_task(forever())
        await clock.sleep(1)
        return task

    assert run(clock, main()).cancelled()
    assert ended == [True]


def test_a_fast_wall_clock_counts_its_own_seconds():
    clock = WallClock(rate=1000)

    async def main():
        start = clock.now()
        await clock.sleep(seconds(2))
        return clock.now() - start

    assert run(clock, main()) >= seconds(2)


def test_a_head_start_is_lived_through_at_once_and_in_order_then_time_is_real():
    clock = WallClock(head_start=seconds(3600))
    woken = []

    async def tick(name, period):
        for _ in range(3):
            await clock.sleep(period)
            woken.append((name, clock.elapsed()))

    async def main():
        await asyncio.gather(tick("slow", seconds(1000)), tick("fast", seconds(600)))
        await clock.sleep_until(clock.epoch + seconds(3600))
        return clock.elapsed()

    arrived = run(clock, main())

    assert woken == [
        ("fast", seconds(600)),
        ("slow", seconds(1000)),
        ("fast", seconds(1200)),
        ("fast", seconds(1800)),
        ("slow", seconds(2000)),
        ("slow", seconds(3000)),
    ]
    assert seconds(3600) <= arrived < seconds(3660)


@pytest.mark.parametrize(("cost", "behind"), [(0.003, 0.0), (0.02, 6.0)])
def test_after_a_head_start_it_is_as_late_as_elsewhere_if_the_world_can_keep_up(
    monkeypatch, cost, behind
):
    spent = 0
    monotonic = time.monotonic_ns
    monkeypatch.setattr("tftool.world.clock.time.monotonic_ns", lambda: monotonic() + spent)
    clock = WallClock(head_start=seconds(3))
    began = monotonic()

    async def tick():
        nonlocal spent
        while True:
            await clock.sleep(seconds(0.01))
            spent += seconds(cost)

    async def main():
        ticking = asyncio.ensure_future(tick())
        await clock.sleep_until(clock.epoch + seconds(3))
        await clock.sleep(seconds(2))
        elapsed = clock.elapsed()
        real = seconds(3) + monotonic() + spent - began
        ticking.cancel()
        return (real - elapsed) / seconds(1)

    assert run(clock, main()) == pytest.approx(behind, abs=0.25)


def test_a_head_start_ends_when_nothing_is_due_in_it():
    clock = WallClock(rate=2.0, head_start=seconds(10))

    async def main():
        await clock.sleep(seconds(10) + 1000)
        return clock.elapsed()

    assert seconds(10) + 1000 <= run(clock, main()) < seconds(70)


def test_in_a_head_start_too_everything_comes_to_rest_before_time_moves_on():
    clock = WallClock(head_start=seconds(100))
    seen = []

    async def step():
        future = asyncio.get_running_loop().create_future()
        asyncio.get_running_loop().call_soon(future.set_result, None)
        await future

    async def starts_slowly():
        for _ in range(5):
            await step()
        await clock.sleep(seconds(1))
        seen.append(("slow starter", clock.elapsed()))

    async def main():
        later = clock.timer(clock.epoch + seconds(50))
        await asyncio.gather(starts_slowly(), later)
        seen.append(("main", clock.elapsed()))

    run(clock, main())

    assert seen == [("slow starter", seconds(1)), ("main", seconds(50))]


def test_a_head_start_cannot_be_negative():
    with pytest.raises(ValueError, match="head start"):
        WallClock(head_start=-1)


@pytest.mark.parametrize("make_clock", [SimClock, WallClock])
@pytest.mark.parametrize("moment", [0.5, float("nan"), float("inf"), None])
def test_a_moment_that_is_not_whole_nanoseconds_is_refused(make_clock, moment):
    clock = make_clock()
    with pytest.raises(TypeError):
        run(clock, clock.sleep(moment))
    with pytest.raises(TypeError, match=r"write seconds\(2.5\) for 2.5 seconds"):
        run(clock, clock.sleep_until(moment))
    assert isinstance(clock.now(), int)


@pytest.mark.parametrize("make_clock", [SimClock, WallClock])
def test_a_moment_beyond_all_floats_can_be_waited_for_and_given_up(make_clock):
    clock = make_clock()

    async def main():
        forever = asyncio.get_running_loop().create_task(clock.sleep(10**400))
        await clock.sleep(1)
        forever.cancel()
        await asyncio.gather(forever, return_exceptions=True)
        return forever.cancelled()

    assert run(clock, main())
