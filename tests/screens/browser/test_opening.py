"""Browser tests of the page's first picture, of a pair, a turtle and the ground."""

import pytest

pytest.importorskip("selenium.webdriver", reason="selenium is not installed")

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page
from tests.screens.browser.stage import Stage
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)

CLOSE = """
    const [wanted, far] = arguments;
    const sheet = tftool.picture();
    const { data } = sheet.getContext("2d").getImageData(0, 0, sheet.width, sheet.height);
    const pen = document.createElement("canvas").getContext("2d");
    pen.fillStyle = wanted;
    pen.fillRect(0, 0, 1, 1);
    const color = pen.getImageData(0, 0, 1, 1).data;
    let seen = 0;
    for (let at = 0; at < data.length; at += 4) {
      if ([0, 1, 2].every((side) => Math.abs(data[at + side] - color[side]) < far)) seen++;
    }
    return seen;
"""


def painted(page, colour, far=12):
    """Return how many pixels of the picture have nearly a colour."""
    return page.driver.execute_script(CLOSE, colour, far)


def swatch(page, name):
    return (
        page.row(name)
        .find_element("css selector", ".swatch")
        .value_of_css_property("background-color")
    )


def test_the_turtles_open_with_their_pair_their_trails_and_figures(chromium):
    with Stage(scenario="turtles", lived=12.0) as stage:
        page = Page(chromium, stage, "theme=dark&names=0")
        page.until(lambda: page.text("#sentence") == "turtle1 in turtle2")

        assert page.find("#top").get_attribute("aria-pressed") == "true"
        page.until(lambda: len(page.said("tftool.trails()")) == 2)
        # A turtle is a metre long, in the colour of its frame. Soon turtle2 covers turtle1.
        turtles = ("turtle1", "turtle2")
        page.until(lambda: any(painted(page, swatch(page, name)) > 150 for name in turtles))
        address = page.said("location.hash")
        assert "target=" not in address
        assert "trails=" not in address
        # The whole turtle is in the part of the picture that the panels do not cover.
        left, right = (page.find(f"#{side}").rect for side in ("left", "right"))
        for frame in page.drawn().values():
            assert left["x"] + left["width"] < frame["pixel"][0] < right["x"]


def test_a_world_with_height_opens_from_the_side_with_the_longest_chain(chromium):
    with Stage(scenario="robot", lived=12.0) as stage:
        page = Page(chromium, stage)
        page.until(lambda: page.text("#sentence") == "laser_point in map")
        page.until(lambda: page.find("#orbit").get_attribute("aria-pressed") == "true")
        page.until(lambda: len(page.said("tftool.trails()")) > 0)


def test_all_of_a_tall_world_lies_in_what_panels_leave_free(chromium, stage):
    mast = TransformStamped(0, "base", "mast", Transform((1.0, 0.0, 3.0)))
    stage.do(lambda world: world.broadcast([mast], "test", static=True))
    page = Page(chromium, stage)
    page.until(lambda: page.text("#sentence") == "mast in base")

    def is_free():
        left, right, bar = (page.find(f"#{name}").rect for name in ("left", "right", "bar"))
        bottom = page.said("innerHeight")
        return all(
            left["x"] + left["width"] < x < right["x"] and bar["y"] + bar["height"] < y < bottom
            for x, y in (frame["pixel"] for frame in page.drawn().values())
        )

    page.until(lambda: len(page.drawn()) == 2 and is_free())


def test_view_settings_chosen_by_a_person_stay_when_frames_are_added(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage)
    page.until(lambda: page.text("#sentence") == "turtle in world")
    page.find("#top").click()
    page.find("#trails").click()
    page.find("#swap").click()
    page.until(lambda: page.text("#sentence") == "world in turtle")

    stage.mount(("turtle", "camera"), ("camera", "lens"))
    page.until(lambda: "lens" in page.drawn())
    page.until(lambda: page.text("#sentence") == "world in turtle")
    assert page.find("#trails").get_attribute("aria-pressed") == "false"
    # The address changes a moment later.
    page.until(lambda: {"view=top", "trails=0"} <= set(page.said("location.hash").split("&")))


def test_the_chain_is_thick_with_its_length_and_others_are_dimmed(chromium, stage):
    stage.put(3.0, 4.0)
    stage.put(-3.0, 1.0, child="other")
    look = "theme=dark&names=0&arrows=0&grid=0&scale=3"
    page = Page(chromium, stage, f"{look}&pair=none")
    page.until(lambda: {"turtle", "other"} <= page.drawn().keys())
    axis = "rgb(240, 69, 75)"
    accent = "rgb(255, 184, 77)"
    page.until(lambda: painted(page, axis, 40) > 0)
    before = painted(page, axis, 40)
    assert painted(page, accent) == 0

    page = Page(chromium, stage, f"{look}&target=world&source=turtle")
    page.until(lambda: page.text("#sentence") == "turtle in world")
    page.until(lambda: painted(page, accent) > 500)
    assert page.said("tftool.distance()") == "5.000 m"
    dims = {name: frame["dim"] for name, frame in page.drawn().items()}
    assert dims["turtle"] == dims["world"] == 1
    assert dims["other"] < 0.6
    assert painted(page, axis, 40) < before


def test_an_axis_is_seen_where_the_chain_lies_along_it(chromium, stage):
    stage.put(3.0)
    look = "theme=dark&names=0&arrows=0&grid=0&trails=0&view=top"
    page = Page(chromium, stage, f"{look}&pair=none")
    page.until(lambda: {"turtle", "world"} <= page.drawn().keys())
    red = "rgb(240, 69, 75)"
    alone = page.until(lambda: painted(page, red, 60))

    page = Page(chromium, stage, f"{look}&target=world&source=turtle")
    page.until(lambda: page.said("tftool.distance()") == "3.000 m")
    page.until(lambda: painted(page, "rgb(255, 184, 77)") > 100)
    assert painted(page, red, 60) > 0.9 * alone


def test_trails_have_the_colours_of_the_list(chromium, stage):
    for second in (1.0, 2.0, 3.0):
        stage.put(second, at=second)
        stage.put(0.0, second, at=second, child="other")
    page = Page(
        chromium, stage, "at=3&theme=dark&names=0&axes=0&arrows=0&grid=0&pair=none&trails=1"
    )
    page.until(lambda: len(page.said("tftool.trails()")) == 2)
    page.until(lambda: min(page.said("tftool.trails()")) > 50)

    names = ("turtle", "other")
    page.until(lambda: all(painted(page, swatch(page, name), 40) > 20 for name in names))
    assert swatch(page, names[0]) != swatch(page, names[1])


def test_the_grid_is_as_fine_as_one_looks_near(chromium, stage):
    stage.put(400.0, 300.0)
    page = Page(chromium, stage, "theme=dark&trails=0")
    page.until(lambda: page.said("tftool.ground().cell") == 50)
    assert page.said("tftool.ground().reach") > 400

    stage.put(0.4, 0.3, at=2.0)
    page.until(lambda: page.x_of("turtle") == 0.4)
    page.find("#fit").click()
    page.until(lambda: page.said("tftool.ground().cell") < 0.5)
