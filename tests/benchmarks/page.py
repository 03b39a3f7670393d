"""The page of `tftool view` with hundreds of frames, in a browser without a graphics card."""

import asyncio
import contextlib
import math
import shutil
import threading
import time
from collections.abc import Awaitable, Callable, Iterator
from typing import Any

from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.world.clock import Phase
from tftool.world.world import World

FRAMES = 300
WANTED = 30.0
WARM = 3.0
LASTING = 10.0

pause = threading.Event().wait


async def crowd(world: World) -> None:
    """Move a tree of many frames, each at 30 Hz, without end."""
    links = [("map" if n < 10 else f"frame{(n - 10) // 3}", f"frame{n}") for n in range(FRAMES)]
    clock = world.clock
    due = clock.now()
    while True:
        await clock.sleep_until(due, Phase.WATCH)
        due += seconds(1 / WANTED)
        now = clock.now()
        moved = 0.3 * math.sin(2.0 * (now - clock.epoch) / 1e9)
        world.broadcast(
            [
                TransformStamped(
                    now,
                    parent,
                    child,
                    Transform(
                        (0.5 + n % 3, n % 5 - 2.0 + moved, 0.2 * (n % 2)),
                        (0.0, 0.0, math.sin(0.1 * n), math.cos(0.1 * n)),
                    ),
                )
                for n, (parent, child) in enumerate(links)
            ],
            "crowd",
        )


@contextlib.contextmanager
def shown(
    act: Callable[[World], Awaitable[None]], state: str, ready: str, robot: Any = None
) -> Iterator[tuple[Any, Any, float]]:
    """Yield a page in a headless browser: the stage, the driver, seconds to the first picture.

    Args:
        act: Coroutine that changes the world.
        state: Part of the page's address after the #.
        ready: Expression that is true in the page once everything is drawn.
        robot: Robot to show in the page.
    """
    from tests.screens.browser.driving import start_chromium
    from tests.screens.browser.stage import Stage

    with Stage() as stage:
        stage.do(lambda world: asyncio.ensure_future(act(world)))
        if robot is not None:
            stage.show(robot)
        driver = start_chromium()
        try:
            began = time.perf_counter()
            driver.get(f"{stage.url}#{state}")
            while not driver.execute_script(f"return {ready}"):
                pause(0.1)
            first = time.perf_counter() - began
            pause(WARM)
            yield stage, driver, first
        finally:
            driver.quit()


def has_browser() -> bool:
    """Whether Chromium and its driver are installed."""
    return bool(shutil.which("chromium") and shutil.which("chromedriver"))


def pictures_a_second(
    act: Callable[[World], Awaitable[None]], state: str, ready: str, robot: Any = None
) -> float | None:
    """Return the pictures per second that a headless browser draws; None without a browser."""
    if not has_browser():
        return None
    with shown(act, state, ready, robot) as (stage, _, _):
        before, began = stage.pictures(), time.perf_counter()
        pause(LASTING)
        return (stage.pictures() - before) / (time.perf_counter() - began)


def told(what: str, pictures: float | None) -> str:
    """Return a line of a report."""
    if pictures is None:
        return f"{what}: no chromium here"
    return f"{what} in headless Chromium: {pictures:.1f} pictures/s (wanted: {WANTED:.0f})"


def report() -> str:
    """Measure, and print a few lines."""
    ready = f"globalThis.tftool?.drawn().length > {FRAMES}"
    named = pictures_a_second(crowd, "", ready)
    bare = pictures_a_second(crowd, "names=0", ready)
    return "\n".join(
        [
            told(f"{FRAMES} frames at {WANTED:.0f} Hz, with names and a pair", named),
            told(f"{FRAMES} frames at {WANTED:.0f} Hz, without names", bare),
        ]
    )


if __name__ == "__main__":
    print(report())  # noqa: T201
