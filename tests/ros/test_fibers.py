import asyncio
import threading

import pytest

from tests.patience import PATIENCE
from tftool.base.errors import TftoolError
from tftool.base.stamps import seconds
from tftool.ros.host import fibers
from tftool.ros.host.fibers import Fiber, StuckError
from tftool.world.clock import SimClock, WallClock, run


def drive(clock, *bodies, strict=True, **settings):
    """Run functions side by side; return the fibers once all have ended."""
    made = [
        Fiber(f"fiber {index}", body, strict=strict, **settings)
        for index, body in enumerate(bodies)
    ]

    async def main():
        await asyncio.gather(*(fiber.drive() for fiber in made))

    run(clock, main())
    return made


def sleep(clock, duration):
    return fibers.current().ask(lambda: clock.sleep(seconds(duration)))


@pytest.mark.parametrize("clock", [SimClock(), WallClock(rate=1000)], ids=["sim", "wall"])
def test_a_fiber_is_given_what_it_asks_for(clock):
    strict = isinstance(clock, SimClock)
    given = []

    def body():
        ask = fibers.current().ask
        given.append(ask(lambda: 42))
        before = clock.now()
        ask(lambda: clock.sleep(seconds(3)))
        given.append(clock.now() - before)

    drive(clock, body, strict=strict)

    assert given[0] == 42
    assert given[1] == seconds(3) if strict else given[1] >= seconds(3)


def test_an_exception_in_a_request_is_raised_in_the_fiber_that_asked():
    def body():
        with pytest.raises(ZeroDivisionError):
            fibers.current().ask(lambda: 1 / 0)

    (fiber,) = drive(SimClock(), body)

    assert fiber.error is None


def test_an_exception_in_a_body_is_kept_as_the_error_of_its_fiber():
    (fiber,) = drive(SimClock(), lambda: 1 / 0)

    assert isinstance(fiber.error, ZeroDivisionError)


def test_requests_run_on_the_loops_thread_and_bodies_on_their_own():
    threads = []

    def body():
        threads.append(threading.get_ident())
        threads.append(fibers.current().ask(threading.get_ident))

    drive(SimClock(), body)

    assert threads[0] != threads[1] == threading.get_ident()


def test_two_simulated_runs_of_three_threads_are_the_same_run():
    def once():
        clock = SimClock()
        trace = []

        def body(name, period):
            def run_on():
                for _ in range(50):
                    trace.append((clock.now(), name))
                    sleep(clock, period)

            return run_on

        drive(clock, body("a", 0.01), body("b", 0.02), body("c", 0.01))
        return trace

    assert once() == once()


def test_cancelling_interrupts_the_wait_of_a_fiber_and_lets_it_finish():
    clock = SimClock()
    trace = []

    def body():
        try:
            sleep(clock, 100)
        except KeyboardInterrupt:
            trace.append("caught")
            fibers.current().ask(lambda: trace.append("asked on the way out"))

    async def main():
        fiber = Fiber("it", body, strict=True)
        task = asyncio.get_running_loop().create_task(fiber.drive())
        await clock.sleep(seconds(1))
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
        return fiber

    fiber = run(clock, main())

    assert trace == ["caught", "asked on the way out"]
    assert fiber.interrupted
    assert fiber.ended


def test_a_fiber_that_will_not_end_is_left_alone():
    clock = SimClock()
    caught = []

    def body():
        while True:
            with pytest.raises(KeyboardInterrupt):
                sleep(clock, 1)
            caught.append(clock.now())

    async def main():
        task = asyncio.get_running_loop().create_task(Fiber("it", body, strict=True).drive())
        await clock.sleep(seconds(0.5))
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    run(clock, main())

    assert len(caught) == fibers.AFTERLIFE


def test_a_busy_fiber_is_named_by_the_line_it_is_at_and_given_up_on_simulated_time():
    told = []

    def body():
        while True:
            pass

    with pytest.raises(StuckError, match=r"'fiber 0' has computed for .*test_fibers\.py:\d+"):
        drive(SimClock(), body, on_busy=told.append, patience=1.0, give_up=2.0)

    assert told[0].function == "body"
    assert told[0].text in ("while True:", "pass")


def test_a_busy_fiber_on_the_wall_clock_holds_up_nobody_and_can_be_interrupted():
    clock = WallClock()
    told, trace = [], []
    begun, ended = threading.Event(), threading.Event()

    def busy():
        try:
            begun.set()
            while True:
                pass
        except KeyboardInterrupt:
            trace.append("interrupted")
            ended.set()

    async def main():
        fiber = Fiber("busy", busy, strict=False, on_busy=told.append, patience=0.01)
        task = asyncio.get_running_loop().create_task(fiber.drive())
        while not (told and begun.is_set()):
            await clock.sleep(seconds(0.01))
        trace.append("others go on")
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    run(clock, main())

    assert ended.wait(PATIENCE)
    assert trace == ["others go on", "interrupted"]


def test_the_calling_thread_can_be_a_fiber_of_a_loop_elsewhere():
    clock = SimClock()
    fiber = Fiber.adopt("test")
    loop_thread = threading.Thread(target=lambda: run(clock, fiber.drive()))
    loop_thread.start()

    fiber.ask(lambda: clock.sleep(seconds(5)))
    fiber.release()
    loop_thread.join()

    assert clock.elapsed() == seconds(5)
    assert fibers.current() is None


def test_an_adopted_thread_is_told_in_its_own_words_that_the_world_has_ended():
    clock = SimClock()
    fiber = Fiber.adopt("test")

    async def main():
        task = asyncio.get_running_loop().create_task(fiber.drive())
        await clock.sleep(seconds(1))
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    loop_thread = threading.Thread(target=lambda: run(clock, main()))
    loop_thread.start()
    with pytest.raises(TftoolError, match="the world has ended"):
        fiber.ask(lambda: clock.sleep(seconds(100)))
    fiber.release()
    loop_thread.join()
