"""Browser tests of the picture's resolution while frames move."""

import asyncio
import math

import pytest

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.world.clock import Phase

pytestmark = pytest.mark.skipif(
    CHROMIUM is None or CHROMEDRIVER is None, reason="no chromium with a driver here"
)

# This delays every picture, as on a slow machine.
SLOW = """
const spin = () => {
  const end = performance.now() + 60;
  while (performance.now() < end);
  globalThis.spinning = requestAnimationFrame(spin);
};
spin();
"""


async def swing(world):
    """Move one frame many times a second, until cancelled."""
    clock = world.clock
    while True:
        now = clock.now()
        pose = Transform((math.sin(now / 1e9), 0.0, 0.0))
        world.broadcast([TransformStamped(now, "world", "swing", pose)], "test")
        await clock.sleep(seconds(0.02), Phase.WATCH)


def sizes(page):
    """Return the picture's size relative to the window, and its canvas in pixels."""
    return page.said(
        "[tftool.scale(), document.getElementById('main').width,"
        " document.getElementById('over').clientWidth]"
    )


def test_slow_pictures_grow_coarser_and_what_rests_is_drawn_in_full(chromium, stage):
    swinging = stage.do(lambda world: asyncio.ensure_future(swing(world)))
    page = Page(chromium, stage, "names=1")
    page.until(lambda: page.x_of("swing") is not None)
    page.driver.execute_script(SLOW)

    page.until(lambda: sizes(page)[0] == 0.5)
    page.until(lambda: (lambda _, drawn, window: drawn == window // 2)(*sizes(page)))

    stage.do(lambda world: swinging.cancel())
    page.until(lambda: (lambda scale, drawn, window: (scale, drawn) == (1, window))(*sizes(page)))
    # A saved picture always has full resolution.
    assert page.said("tftool.picture().width") == sizes(page)[2]
    assert page.complaints() == []


def test_where_nothing_moves_the_grid_stays_in_the_picture(chromium, stage):
    stage.put(1.0)
    page = Page(
        chromium, stage, "names=0&arrows=0&axes=0&pair=none&theme=dark&camera=0,0,10,0,0,0,1"
    )
    page.until(lambda: "turtle" in page.drawn())

    def red():
        return page.driver.execute_script(
            """
            const sheet = tftool.picture();
            const { data } = sheet.getContext("2d").getImageData(0, 0, sheet.width, sheet.height);
            let seen = 0;
            for (let at = 0; at < data.length; at += 4) {
              if (data[at] > 150 && data[at + 1] < 120 && data[at + 2] < 120) seen++;
            }
            return seen;
            """
        )

    # The red pixels are the x axis on the ground, drawn live and in the stored picture.
    aside = "document.getElementById('floor').hidden"
    page.until(lambda: page.said(aside) is False)
    assert red() > 1000
    page.find("#grid").click()
    page.until(lambda: page.said(aside) is True)
    assert red() < 200  # only the axes in the corner
