"""The picture in the README: TFTOOL_PICTURES=1 draws it anew."""

import asyncio
import os
import re
from pathlib import Path

import pytest

from tftool.screens.setting import Setting
from tftool.screens.terminal import TurtleApp

PICTURE = Path(__file__).parents[1] / "pictures" / "demo.svg"
SIZE = (116, 34)
FONTS = "ui-monospace, SFMono-Regular, Menlo, Consolas, 'DejaVu Sans Mono', monospace"

# A person's keys, at their seconds: a round through the field, with turtle2 behind.
KEYS = tuple((4.0 + 0.5 * n, "left" if n % 3 == 2 else "up") for n in range(26))


def drawn(scene):
    """The app's screen as SVG that fetches nothing."""
    app = TurtleApp(scene, lambda key: None, Setting(title="tftool demo turtles"))
    pictures = []

    async def main():
        async with app.run_test(size=SIZE) as pilot:
            await pilot.pause()
            app.redraw()
            await pilot.pause()
            pictures.append(app.export_screenshot(title="tftool demo"))

    asyncio.run(main())
    svg = re.sub(r"@font-face \{.*?\}", "", pictures[0], flags=re.DOTALL)
    return re.sub(r"font-family: Fira Code, monospace", f"font-family: {FONTS}", svg)


@pytest.fixture(scope="module")
def scene(turtles):
    return turtles(16.6, KEYS)


def test_the_picture_in_the_readme_is_this_screen(scene):
    svg = drawn(scene)

    if os.environ.get("TFTOOL_PICTURES") or not PICTURE.exists():
        PICTURE.write_text(svg, encoding="utf-8")

    assert PICTURE.read_text(encoding="utf-8").startswith("<svg")
    text = re.sub(r"<[^>]+>", "", svg).replace("&#160;", " ")
    for there in (
        "Frames",
        "world",
        "Tree",
        "Echo",
        "Log",
        "turtle1",
        "turtle2",
        "62.6",
        "live",
        "drive",
    ):
        assert there in text
    assert "⣀" in text or "⠤" in text
    assert len(svg.encode()) < 300_000
    assert "http" not in svg.replace("http://www.w3.org/2000/svg", "").replace(
        "https://www.textualize.io", ""
    )


def test_the_picture_is_the_same_every_time(scene, turtles):
    assert drawn(scene) == drawn(turtles(16.6, KEYS))
