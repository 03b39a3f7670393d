"""Browser tests of the page: what a person sees and clicks."""

import math
import os
from itertools import count
from pathlib import Path

import pytest
import yaml

pytest.importorskip("selenium.webdriver", reason="selenium is not installed")

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page, Resized
from tests.screens.browser.rover import drive, rover
from tests.screens.browser.stage import Stage
from tftool.base.stamps import display, seconds

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)

VECTORS = Path(__file__).parents[2] / "reference" / "turtlesim_vectors.yaml"

PICTURES = Path(__file__).parents[2] / "pictures"

# The name of the graphics card as the page reads it (0x9246), on a machine without one
CARD = """
    const told = WebGL2RenderingContext.prototype.getParameter;
    WebGL2RenderingContext.prototype.getParameter = function (what) {
      return what === 0x9246 ? "a graphics card" : told.call(this, what);
    };
"""


@pytest.fixture
def card(chromium):
    """Let the page draw as with a graphics card: slower here, and finer."""
    script = chromium.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": CARD})
    yield
    chromium.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", script)


def test_frames_appear_and_move(chromium, stage):
    stage.put(1.0, 2.0)
    page = Page(chromium, stage)
    page.until(lambda: page.x_of("turtle") == 1.0)

    before = page.drawn()
    stage.put(4.0, 2.0, at=2.0)
    page.until(lambda: page.x_of("turtle") == 4.0)
    after = page.drawn()

    assert page.texts("#tree .name") == ["world", "turtle"]
    assert before["turtle"]["arrow"]
    assert not before["world"]["arrow"]
    # From above, a frame at four metres is further to the right than one at one metre.
    assert (
        after["turtle"]["pixel"][0] - after["world"]["pixel"][0]
        > before["turtle"]["pixel"][0] - before["world"]["pixel"][0]
    )
    assert page.complaints() == []


def test_axes_are_painted_in_their_colours(chromium, stage):
    stage.put(1.0, 1.0)
    page = Page(chromium, stage, "names=0&arrows=0&theme=dark&scale=2&pair=none")
    page.until(lambda: "turtle" in page.drawn())

    painted = chromium.execute_script(
        """
        const sheet = tftool.picture();
        const [x, y] = tftool.drawn().find(({ name }) => name === "turtle").pixel;
        const ratio = sheet.width / innerWidth;
        const far = 60;
        const area = sheet.getContext("2d").getImageData((x - far) * ratio, (y - far) * ratio,
                                                         2 * far * ratio, 2 * far * ratio);
        const seen = { red: 0, green: 0 };
        for (let at = 0; at < area.data.length; at += 4) {
          const [r, g, b] = area.data.slice(at, at + 3);
          if (r > 140 && g < 110 && b < 110) seen.red++;
          if (g > 120 && r < 110 && b < 130) seen.green++;
        }
        return seen;
        """
    )

    assert painted["red"] > 50
    assert painted["green"] > 50


def test_a_switch_hides_one_frame_and_the_master_switch_all(chromium, stage):
    stage.put(1.0)
    stage.put(2.0, child="other")
    page = Page(chromium, stage)
    page.until(lambda: {"turtle", "other"} <= page.drawn().keys())
    page.until(lambda: page.find("#all").is_selected())

    page.row("turtle").find_element(By.TAG_NAME, "input").click()
    page.until(lambda: "turtle" not in page.drawn())
    assert "other" in page.drawn()
    page.until(lambda: not page.find("#all").is_selected())

    page.find("#all").click()
    page.until(lambda: {"turtle", "other"} <= page.drawn().keys())
    page.find("#all").click()
    page.until(lambda: not page.drawn())


def test_a_filter_shows_matching_names_only_and_says_what_is_wrong_with_it(chromium, stage):
    stage.put(1.0)
    stage.put(2.0, child="other")
    page = Page(chromium, stage)
    page.until(lambda: {"turtle", "other"} <= page.drawn().keys())

    page.find("#only").send_keys("^tur")
    page.until(lambda: list(page.drawn()) == ["turtle"])
    page.find("#only").clear()
    page.find("#not").send_keys("^o|w")
    page.until(lambda: list(page.drawn()) == ["turtle"])
    page.find("#not").send_keys("(")
    page.until(lambda: "regular expression" in page.text("#wrong"))


def test_scrubbing_shows_the_asked_moment_and_live_returns(chromium, stage):
    for second in (1.0, 2.0, 3.0):
        stage.put(10 * second, at=second)
    page = Page(chromium, stage)
    page.until(lambda: page.x_of("turtle") == 30.0)

    page.scrub(1.25)
    page.until(lambda: page.x_of("turtle") == pytest.approx(12.5))
    page.until(lambda: page.text("#status") == "past")
    assert chromium.execute_script("return tftool.moment()") == 1.25
    assert page.text("#moment").startswith("1.250 s")

    page.find("#forth").click()
    page.until(lambda: page.x_of("turtle") == pytest.approx(13.5))
    page.find("#live").click()
    page.until(lambda: page.x_of("turtle") == 30.0)
    page.until(lambda: page.said("tftool.moment()") is None)


def test_the_sliders_bounds_are_there_before_anything_is_drawn(chromium, stage):
    # Without this, a move of the handle between two messages would be clamped to old bounds.
    frozen = {"source": "window.requestAnimationFrame = () => 0"}
    script = chromium.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", frozen)
    try:
        for second in (1.0, 3.0):
            stage.put(second, at=second)
        page = Page(chromium, stage)
        page.until(lambda: page.said("globalThis.tftool && tftool.reach().newest") == 3.0)

        line = page.find("#scrub")
        assert [line.get_attribute(name) for name in ("min", "max")] == ["1", "3"]
        page.scrub(2.0)
        page.until(lambda: "at=2&" in f"{chromium.current_url}&")
    finally:
        chromium.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", script)


def test_playing_runs_through_the_past_into_the_present(chromium, stage):
    # Playing takes eighty seconds at this speed, so there is time for a look in between.
    for second in (1.0, 9.0):
        stage.put(second, at=second)
    page = Page(chromium, stage, "speed=0.1")
    page.until(lambda: page.x_of("turtle") == 9.0)

    page.scrub(1.0)
    page.until(lambda: page.x_of("turtle") == 1.0)
    page.find("#play").click()
    page.until(lambda: 1.0 < page.x_of("turtle") < 9.0)
    Select(page.find("#speed")).select_by_value("4")
    page.until(lambda: page.said("tftool.moment()") is None and page.x_of("turtle") == 9.0)


def numbers(page):
    """Return the numbers of the pair panel, by their names."""
    told = {}
    terms = page.texts("#numbers dt")
    for place, term in enumerate(terms, start=1):
        if term == "At time":
            continue
        told[term] = [float(text) for text in page.texts(f"#numbers dd:nth-of-type({place}) span")]
    return told


@pytest.mark.parametrize("moment", [None, 1.5])
def test_a_pairs_numbers_are_those_of_lookup_transform(chromium, stage, moment):
    turned = (0.034270798550482, 0.106020511061796, 0.143572175027392, 0.983347443256356)
    for second in (1.0, 2.0):
        stage.put(math.pi * second, math.e, at=second, rotation=turned)
        stage.put(-second / 3, 7 / 9, at=second, child="other", rotation=(0, 0, 0.6, 0.8))
    page = Page(chromium, stage)
    page.until(lambda: "other" in page.drawn())

    page.pick("source", "turtle")
    page.pick("target", "other")
    page.until(lambda: page.text("#sentence") == "turtle in other")
    if moment is not None:
        page.scrub(moment)
    at = 0 if moment is None else stage.do(lambda world: world.clock.epoch) + seconds(moment)
    found = stage.do(lambda world: world.buffer.lookup_transform("other", "turtle", at))
    page.until(lambda: f"{display(found.stamp)} s" in page.texts("#numbers dd"))

    told = numbers(page)
    assert told["Translation"] == pytest.approx(found.transform.translation, abs=1e-6)
    assert told["Quaternion"] == pytest.approx(found.transform.rotation, abs=1e-6)
    assert told["Distance, m"][0] == pytest.approx(
        math.hypot(*found.transform.translation), abs=1e-6
    )
    assert page.text("#sentence") == "turtle in other"
    assert page.text("#chain") == "Chain, source to target: turtle · world · other"


def test_a_pair_without_a_transform_says_why(chromium, stage):
    stage.put(1.0)
    stage.put(1.0, parent="elsewhere", child="lost")
    page = Page(chromium, stage, "target=turtle&source=lost")

    page.until(lambda: "not part of the same tree" in page.text("#why"))


def test_a_frame_of_another_tree_is_listed_and_said_to_have_no_transform(chromium, stage):
    stage.put(1.0)
    stage.put(1.0, child="second")
    stage.put(1.0, parent="elsewhere", child="lost")
    page = Page(chromium, stage, "chosen=lost")

    page.until(lambda: page.text("#trouble") == "No transform from [lost] to [world]")
    assert "lost" not in page.drawn()
    page.pick("fixed", "elsewhere")
    page.until(lambda: set(page.drawn()) == {"lost", "elsewhere"})


def test_a_loop_is_listed_and_said_and_everything_else_goes_on(chromium, stage):
    stage.put(1.0, parent="hen", child="egg")
    stage.put(1.0, parent="egg", child="hen")
    stage.put(1.0)
    page = Page(chromium, stage, "chosen=egg&target=egg&source=turtle")

    page.until(lambda: "its chain is a loop" in page.text("#trouble"))
    page.until(lambda: page.text("#why"))
    assert set(page.texts("#tree .name")) == {"hen", "egg", "world", "turtle"}
    assert set(page.drawn()) == {"world", "turtle"}


def test_the_chosen_frame_is_told_absolute_and_relative(chromium, stage):
    stage.put(1.0, 2.0, rotation=(0, 0, math.sqrt(0.5), math.sqrt(0.5)))
    stage.mount(("turtle", "camera"), x=0.5)
    page = Page(chromium, stage)
    page.until(lambda: "camera" in page.drawn())

    page.row("camera").find_element(By.CLASS_NAME, "name").click()
    page.until(lambda: page.text("#chosen") == "camera")

    assert page.texts("#absolute dd span") == [
        *("1.0000", "2.5000", "0.0000"),
        *("0.0000", "0.0000", "0.7071", "0.7071"),
        *("0.00", "0.00", "90.00"),
    ]
    assert page.texts("#relative dd span")[:3] == ["0.5000", "0.0000", "0.0000"]
    assert page.texts("#link-facts dd") == ["Transform OK", "turtle", "mount", "static"]


SIZES = [(1920, 1080), (1280, 800), (1200, 800), (900, 600), (640, 520)]


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_numbers_stand_in_one_line_each_and_panels_keep_clear_of_the_bars(
    chromium, stage, width, height
):
    # The address chooses the frame, so its panel exists before there are numbers for it.
    stage.put(-123.456789, -2.0, rotation=(-0.5, -0.5, -0.5, 0.5))
    stage.mount(("turtle", "camera"), x=-0.5)
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        page = Page(chromium, stage, "chosen=camera&target=world&source=camera")
        page.until(lambda: page.text("#sentence") == "camera in world")
        page.until(lambda: len(page.texts("#absolute dd span")) == 10)

        rows = chromium.execute_script(
            "return [...document.querySelectorAll('dl.numbers dd')].map(row => ({"
            "  text: row.textContent, spans: [...row.children].map(span => span.textContent),"
            "  lines: new Set([...row.children].map(span => span.offsetTop)).size}))"
        )
        assert all(row["lines"] == 1 for row in rows)
        assert all("".join(row["spans"]) == row["text"] for row in rows)
        assert "\N{EN DASH}" not in "".join(row["text"] for row in rows)
        wide = "return [...document.querySelectorAll('dl.numbers, #bar, #time')]"
        too_wide = f"{wide}.filter(box => box.scrollWidth > box.clientWidth).map(box => box.id)"
        assert chromium.execute_script(too_wide) == []
        box = "return document.getElementById(arguments[0]).getBoundingClientRect().toJSON()"
        bar, left, right, time = (
            chromium.execute_script(box, name) for name in ("bar", "left", "right", "time")
        )
        for panel in (left, right):
            if panel["width"]:
                assert bar["bottom"] <= panel["top"] < panel["bottom"] <= time["top"]
        # The bar is one line if the window has a usual width.
        assert width < 1200 or bar["height"] < 60
        # The texts about the plot's lines and height are side by side in one line.
        assert chromium.execute_script(box, "line")["width"] > 500
    finally:
        chromium.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_only_the_rows_of_frames_that_changed_are_written(chromium, stage):
    stage.mount(("world", "mast"), ("mast", "lamp"))
    stage.put(1.0)
    page = Page(chromium, stage)
    page.until(lambda: page.x_of("turtle") == 1.0)
    chromium.execute_script(
        "globalThis.written = new Set();"
        "new MutationObserver((all) => all.forEach(({target}) => written.add("
        "(target.closest ? target : target.parentElement).closest('li')"
        "?.querySelector('.name').textContent ?? 'the list')))"
        ".observe(document.getElementById('tree'),"
        " {subtree: true, childList: true, attributes: true, characterData: true})"
    )
    for moment in range(2, 12):
        stage.put(float(moment), at=float(moment))
        page.until(lambda m=moment: page.x_of("turtle") == float(m))
        if moment == 3:
            # At this point, every row was written once.
            chromium.execute_script("written.clear()")
    assert page.said("[...written]") == ["turtle"]


HOSTILE = "<img src=x onerror=\"document.title='owned'\">"


def test_markup_in_a_name_is_text(chromium, stage):
    names = [HOSTILE, "</script><script>document.title='owned'</script>", "a\x1b[31m", "שלום", "🐢"]
    for name in names:
        stage.put(1.0, child=name)
    page = Page(chromium, stage)
    page.until(lambda: HOSTILE in page.drawn())

    page.row(HOSTILE).find_element(By.CLASS_NAME, "name").click()
    page.pick("source", HOSTILE)
    page.pick("target", "world")
    page.until(lambda: page.text("#sentence") == f"{HOSTILE} in world")

    assert set(names) <= set(page.texts("#tree .name"))
    assert page.text("#chosen") == HOSTILE
    assert chromium.find_elements(By.CSS_SELECTOR, "#tree img, #right img, #tree script") == []
    assert chromium.title == "tftool view"


def test_a_name_of_five_hundred_letters_keeps_inside_its_panel(chromium, stage):
    long = "long_" * 100
    stage.put(1.0, child=long)
    page = Page(chromium, stage)
    page.until(lambda: long in page.drawn())

    page.row(long).find_element(By.CLASS_NAME, "name").click()
    page.until(lambda: page.text("#chosen") == long)

    width = chromium.execute_script("return document.documentElement.scrollWidth")
    assert width <= chromium.execute_script("return window.innerWidth")


def test_a_frame_infinitely_far_away_leaves_the_others_where_they_are(chromium, stage):
    # The buffer refuses NaN, but accepts infinity as tf2 does. Seen from that frame, all numbers
    # are NaN.
    stage.put(math.inf, child="beyond")
    stage.put(2.0, child="here")
    page = Page(chromium, stage)
    page.until(lambda: "here" in page.drawn())

    page.pick("fixed", "beyond")
    page.pick("fixed", "world")

    page.until(lambda: page.x_of("here") == pytest.approx(2.0))


def test_a_stale_frame_fades_away_and_comes_back_and_statics_never_fade(chromium, stage):
    stage.put(1.0)
    stage.mount(("world", "camera"))
    page = Page(chromium, stage, "timeout=1")

    page.until(lambda: "camera" in page.drawn() and "turtle" not in page.drawn())
    assert (page.drawn()["camera"]["grey"], page.drawn()["camera"]["alpha"]) == (0, 1)
    # Data with old stamps is fresh while it keeps arriving.
    stamps = count(150)

    def seen_while_it_comes():
        stage.put(2.0, at=next(stamps) / 100)
        return page.x_of("turtle") == 2.0

    page.until(seen_while_it_comes)


def test_fading_has_rvizs_three_stages(chromium, stage):
    page = Page(chromium, stage)
    vectors = yaml.safe_load(VECTORS.read_text(encoding="utf-8"))["stale_fade"]

    for age, axis, *_ in vectors["rows"]:
        told = page.driver.execute_script(
            "return tftool.fade(...arguments)", age, vectors["frame_timeout"]
        )
        if axis is None:
            assert told["alpha"] == 0
        else:
            red, green, blue, alpha = axis
            grey = told["grey"]
            assert 1 - 0.3 * grey == pytest.approx(red, abs=1e-6)
            assert 0.7 * grey == pytest.approx(green, abs=1e-6) == pytest.approx(blue, abs=1e-6)
            assert told["alpha"] == pytest.approx(alpha, abs=1e-3)


def test_the_update_interval_slows_the_picture_but_not_the_person(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage, "interval=60&chosen=turtle")
    page.until(lambda: page.x_of("turtle") == 1.0)

    # The first layout is drawn at once, and data with it.
    shown, newest = 1.0, 1.0

    def keeps_what_it_shows():
        nonlocal shown, newest
        shown, newest = page.x_of("turtle"), newest + 1.0
        stage.put(newest, at=newest)
        page.until(lambda: chromium.execute_script("return tftool.reach().newest") == newest)
        chromium.execute_async_script(
            "requestAnimationFrame(() => requestAnimationFrame(arguments[0]))"
        )
        return page.x_of("turtle") == shown != newest

    page.until(keeps_what_it_shows)
    page.find("#grid").click()
    page.until(lambda: page.x_of("turtle") == newest)


def test_a_frame_leaves_a_trail_when_asked_to(chromium, stage):
    for second in (1.0, 2.0, 3.0):
        stage.put(second, at=second)
        stage.put(0.0, second, at=second, child="other")
    page = Page(chromium, stage, "chosen=turtle&trails=0&at=3")
    page.until(lambda: page.said("tftool.remembered()") > 100)
    assert page.said("tftool.trails()") == []

    page.find("#with-trail").click()
    page.until(lambda: len(page.said("tftool.trails()")) == 1)
    # The trail has 30 positions per second, and the present one.
    page.until(lambda: page.said("tftool.trails()")[0] == 62)
    page.find("#trails").click()
    page.until(lambda: len(page.said("tftool.trails()")) == 2)


PAINTED = """
    const sheet = tftool.picture();
    const { data } = sheet.getContext("2d").getImageData(0, 0, sheet.width, sheet.height);
    let seen = 0;
    for (let at = 0; at < data.length; at += 4) {
      const [red, green, blue] = data.subarray(at, at + 3);
      // The accent of the dark theme.
      if (red > 240 && Math.abs(green - 184) < 15 && Math.abs(blue - 77) < 15) seen++;
    }
    return seen;
"""


def test_the_chain_of_the_pair_is_drawn(chromium, stage):
    stage.put(1.0, 2.0)
    stage.put(-3.0, 1.0, child="other")
    page = Page(chromium, stage, "names=0&axes=0&arrows=0&grid=0&theme=dark&target=other")
    page.until(lambda: {"turtle", "other"} <= page.drawn().keys())
    assert chromium.execute_script(PAINTED) == 0

    page.pick("source", "turtle")
    page.until(lambda: page.text("#sentence") == "turtle in other")
    page.until(lambda: chromium.execute_script(PAINTED) > 100)


def test_the_screenshot_button_saves_a_picture(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage)
    page.until(lambda: "turtle" in page.drawn())
    # The file that the browser would save
    page.driver.execute_script(
        """
        URL.createObjectURL = blob => { window.picture = blob; return "#"; };
        HTMLAnchorElement.prototype.click = function () { window.saved = this.download; };
        """
    )
    page.find("#shot").click()
    page.until(lambda: page.said("globalThis.saved"))

    told = chromium.execute_async_script(
        """
        const done = arguments[0];
        picture.arrayBuffer().then(buffer =>
          done([saved, [...new Uint8Array(buffer.slice(0, 4))], buffer.byteLength]));
        """
    )
    assert told[:2] == ["tftool-view.png", [0x89, 0x50, 0x4E, 0x47]]
    assert told[2] > 1000


@pytest.mark.parametrize("drawn_by", ["processor", "card"])
def test_a_crowd_of_frames_is_painted_in_its_colours(chromium, stage, drawn_by, request):
    # Without a graphics card, many frames are drawn in another way than few.
    if drawn_by == "card":
        request.getfixturevalue("card")
    links = [("world", f"f{index}") for index in range(100)]
    stage.mount(*links, x=2.0)
    page = Page(chromium, stage, "names=0&grid=0&theme=dark&scale=3&pair=none")
    page.until(lambda: len(page.drawn()) == 101)
    assert page.said("tftool.plain()") == (drawn_by == "processor")

    colours = page.driver.execute_script(
        """
        const sheet = tftool.picture();
        const { data } = sheet.getContext("2d").getImageData(0, 0, sheet.width, sheet.height);
        const seen = [0, 0];
        for (let at = 0; at < data.length; at += 4) {
          const [r, g, b] = data.subarray(at, at + 3);
          if (r > 120 && g < 100 && b < 100) seen[0]++;
          if (g > 100 && r < 100 && b < 120) seen[1]++;
        }
        return seen;
        """
    )
    assert min(colours) > 20


def test_thousands_of_frames_are_answered_and_what_is_left_out_is_said(chromium, stage):
    stage.mount(*((f"f{(index - 1) // 3}", f"f{index}") for index in range(1, 5000)), x=0.5)
    page = Page(chromium, stage)

    page.until(lambda: "2000 of 5000 frames shown" in page.text("#left-out"))
    page.until(lambda: len(page.drawn()) == 2000)


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_the_pages_pictures_are_made_from_the_page_as_it_is(chromium, card, theme):
    picture = PICTURES / ("view.png" if theme == "dark" else "view-light.png")
    if picture.exists() and not os.environ.get("TFTOOL_PICTURES"):
        pytest.skip("the picture is there; TFTOOL_PICTURES=1 makes it anew")
    with Stage() as stage, Resized(chromium, 1280, 984):
        shown = rover()
        stage.show(shown)
        stage.do(lambda world: drive(world, shown))
        page = Page(chromium, stage, f"theme={theme}&chosen=gripper&fixed=map&arrows=0")
        page.until(lambda: page.text("#sentence") == "gripper in map")
        page.until(lambda: page.text("#chosen") == "gripper")
        page.until(lambda: chromium.execute_script("return tftool.remembered()") >= 240)
        # Moving frames may be drawn coarsely.
        stage.do(lambda world: world.driving.cancel())
        page.until(lambda: page.said("tftool.scale()") == 1)
        assert chromium.save_screenshot(str(picture))

    assert picture.read_bytes().startswith(b"\x89PNG")
    assert picture.stat().st_size < 400_000
