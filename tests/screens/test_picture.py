"""Pictures of the README and the pages; TFTOOL_PICTURES=1 draws them again."""

import asyncio
import io
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console
from rich.terminal_theme import DEFAULT_TERMINAL_THEME, SVG_EXPORT_THEME
from rich.text import Text

from tests.screens.moving_picture import animated
from tftool.base.stamps import NANOSECONDS, seconds
from tftool.drawing import theme
from tftool.opener import scenario_named
from tftool.scenario.play import build, left_to_a_person
from tftool.screens.terminal.scene import Scene
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.turtle_app import TurtleApp
from tftool.world.clock import Phase, SimClock, run
from tftool.world.node import Node
from tftool.world.nodes.turtle_drivers import IdleDrawing
from tftool.world.nodes.turtlesim import simulator_of

PICTURES = Path(__file__).parents[1] / "pictures"
STILL, MOVING = PICTURES / "demo.svg", PICTURES / "demo-moving.svg"
LIGHT = PICTURES / "demo-light.svg"
DOCTOR = {"doctor.svg": SVG_EXPORT_THEME, "doctor-light.svg": DEFAULT_TERMINAL_THEME}
SIZE = (104, 32)
FONTS = "ui-monospace, SFMono-Regular, Menlo, Consolas, 'DejaVu Sans Mono', monospace"
BEGIN, COUNT, STEP = seconds(18.0), 16, seconds(0.4)


class Looker(Node):
    """Node that updates the scene as often as a screen does."""

    phase = Phase.WATCH

    def __init__(self, world, scene):
        super().__init__(world, "looker")
        self.scene = scene

    async def run(self):
        self.scene.start = self.clock.now()
        async for _ in self.every(seconds(0.05)):
            self.scene.look()


def taken():
    """Return a picture of the carrot's demo drawing by itself, and an animated one."""
    play = build(left_to_a_person(scenario_named("carrot")), SimClock())
    world = play.world
    IdleDrawing(world)
    scene = Scene(world, simulator_of(world))
    Looker(world, scene)
    setting = Setting(title="tftool demo carrot", pair=("turtle2", "carrot1"))
    screens, pictures = [], []

    async def shown(light=False):
        app = TurtleApp(scene, lambda key: None, replace(setting, light=light))
        async with app.run_test(size=SIZE) as pilot:
            await pilot.pause()
            app.redraw()
            await pilot.pause()
            screens.append(app.screen._compositor.render_strips(app.size))
            pictures.append(app.export_screenshot(title="tftool demo carrot"))
        if app.failure is not None:
            raise app.failure

    async def story():
        start = world.clock.now() + BEGIN
        living = asyncio.ensure_future(play.live(start + COUNT * STEP))
        # The screen has its own event loop, and the world waits for it.
        with ThreadPoolExecutor(1) as beside:
            for number in range(COUNT):
                await world.clock.sleep_until(start + number * STEP, Phase.WATCH)
                beside.submit(asyncio.run, shown()).result()
            beside.submit(asyncio.run, shown(light=True)).result()
        await living

    run(world.clock, story())
    light = screens.pop() and pictures.pop()
    ground = theme.hexadecimal(theme.DARK.ground)
    moving = animated(screens, STEP / NANOSECONDS, ground, "tftool demo carrot")
    return own_fonts(pictures[-1]), moving, own_fonts(light)


def own_fonts(svg):
    """Return the picture with fonts of the reader's machine, so that no font is fetched."""
    svg = re.sub(r"@font-face \{.*?\}", "", svg, flags=re.DOTALL)
    return svg.replace("font-family: Fira Code, monospace", f"font-family: {FONTS}")


def printed(*words, width):
    """Return the output of a command on a terminal of that width."""
    told = {"FORCE_COLOR": "1", "COLORTERM": "truecolor", "COLUMNS": str(width), "TERM": "xterm"}
    done = subprocess.run(
        [sys.executable, "-m", "tftool", *words],
        env={**os.environ, **told},
        capture_output=True,
        text=True,
        check=False,
    )
    return Text.from_ansi(done.stdout)


def drawn_anew(place, svg):
    """Write a missing picture, or one to draw again; return the existing one."""
    if os.environ.get("TFTOOL_PICTURES") or not place.exists():
        place.write_text(svg, encoding="utf-8")
    return place.read_text(encoding="utf-8")


def test_the_doctors_pictures_show_a_finding_and_its_cure():
    text = printed("doctor", "lost_leader", width=SIZE[0])
    for name, colours in DOCTOR.items():
        paper = Console(record=True, width=SIZE[0], file=io.StringIO(), force_terminal=True)
        paper.print(text)
        svg = own_fonts(paper.export_svg(title="tftool doctor lost_leader", theme=colours))
        there = re.sub(r"<[^>]+>", "", drawn_anew(PICTURES / name, svg)).replace("&#160;", " ")
        assert "edge-stopped" in there
        assert "turtle1" in there
        assert len(svg.encode()) < 100_000


@pytest.fixture(scope="module")
def pictures():
    return taken()


def test_the_pictures_in_the_readme_are_this_screen(pictures):
    for place, svg in zip((STILL, MOVING, LIGHT), pictures, strict=True):
        assert drawn_anew(place, svg).startswith("<svg")
        assert "http" not in svg.replace("http://www.w3.org/2000/svg", "").replace(
            "https://www.textualize.io", ""
        )
    still, moving, light = pictures
    assert theme.hexadecimal(theme.LIGHT.ground) in light
    assert len(still.encode()) < 300_000
    # Slow frames have trails too.
    assert len(moving.encode()) < 750_000


@pytest.mark.parametrize("which", [0, 1], ids=["still", "moving"])
def test_the_pictures_show_frames(pictures, which):
    text = re.sub(r"<[^>]+>", "", pictures[which]).replace("&#160;", " ")

    for there in ("Frames in", "Tree", "Echo", "Plot", "turtle1", "turtle2", "62."):
        assert there in text
    for there in ("carrot1", "distance", "yaw", "drive"):
        assert there in text
    assert "⣀" in text or "⠤" in text
    # Axes are red and green.
    assert "#ff6e6e" in pictures[which]
    assert "#5fff87" in pictures[which]


def test_the_moving_picture_moves_as_the_demo_does(pictures):
    moving = pictures[1]
    clocks = re.findall(r">\s*(\d+\.\d) s\s*<", re.sub(r"&#160;", " ", moving))

    assert moving.count("<animate ") > 100
    assert len(set(clocks)) >= COUNT
    assert "live" in moving
    assert "ago" not in re.sub(r"<[^>]+>", "", moving)
