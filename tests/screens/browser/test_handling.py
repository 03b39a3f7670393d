"""Browser tests of old data, keys, lists and small screens."""

import pytest

pytest.importorskip("selenium.webdriver", reason="selenium is not installed")

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page, Resized
from tests.screens.browser.stage import Stage

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)


def press(page, *keys):
    ActionChains(page.driver).send_keys(*keys).perform()


def pressed(page, control):
    return page.find(f"#{control}").get_attribute("aria-pressed")


def filtered(page):
    """Return how the browser draws the scene: unchanged, or through a filter."""
    return page.said("getComputedStyle(document.getElementById('main')).filter")


# Old data


def test_a_session_that_is_gone_greys_the_scene_and_names_the_last_moment(chromium):
    with Stage() as stage:
        stage.put(1.0)
        page = Page(chromium, stage)
        page.until(lambda: page.text("#status") == "live" and page.x_of("turtle") == 1.0)
        assert pressed(page, "live") == "true"
        assert filtered(page) == "none"
        assert not page.find("#banner").is_displayed()
    page.until(lambda: page.find("#banner").is_displayed())

    assert page.text("#banner").startswith("The session is gone. Last seen: its ")
    page.until(lambda: pressed(page, "live") == "false")
    assert "grayscale" in filtered(page)

    with Stage(port=stage.port) as again:
        again.put(2.0)
        page.until(lambda: page.text("#status") == "live" and page.x_of("turtle") == 2.0)
        assert not page.find("#banner").is_displayed()
        assert filtered(page) == "none"


def test_data_that_stopped_turns_amber_then_red_and_the_scene_grey(chromium, stage):
    for second in (0.8, 1.0):
        stage.put(second, at=second)
    stage.mount(("world", "camera"))
    page = Page(chromium, stage)
    told = "[...document.querySelectorAll('.told')].map(e => e.dataset.late ?? '')"
    seen = "globalThis.seen ??= new Set(); seen.add(document.querySelector('.told').dataset.late)"
    page.until(lambda: "turtle" in page.drawn())
    page.said(f"setInterval(() => {{ {seen}; }}, 5)")

    page.until(lambda: page.text("#status") == "no new data")
    page.until(lambda: "dead" in page.said(told))
    # The camera is static, and has no age.
    assert sorted(page.said(told)) == ["", "", "dead"]
    assert page.text("#banner").startswith("No new data for ")
    assert "The newest transform is of 1.00 s." in page.text("#banner")
    assert pressed(page, "live") == "false"
    assert "grayscale" in filtered(page)

    def seen_while_it_comes():
        now = stage.do(lambda world: (world.clock.now() - world.clock.epoch) / 1e9)
        stage.put(3.0, at=now)
        return page.text("#status") == "live" and filtered(page) == "none"

    page.until(seen_while_it_comes)


# Keys


def test_keys_mean_the_same_after_any_click(chromium, stage):
    for second in (1.0, 2.0):
        stage.put(second, at=second)
    page = Page(chromium, stage)
    page.until(lambda: "turtle" in page.drawn())

    for clicked in ("#grid", "#speed", "#scrub", "#tree .row", "#tree input", "#more summary"):
        page.find(clicked).click()
        press(page, Keys.ESCAPE)
        before = pressed(page, "names")
        press(page, "n")
        page.until(lambda before=before: pressed(page, "names") != before)

    # In a text field, letters are text.
    before = pressed(page, "names")
    page.find("#only").send_keys("n")
    assert page.find("#only").get_attribute("value") == "n"
    assert pressed(page, "names") == before


def test_a_button_reached_by_the_tab_key_is_pressed_by_space(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage)
    page.until(lambda: "turtle" in page.drawn())

    page.said("document.getElementById('grid').focus()")
    press(page, " ")

    page.until(lambda: pressed(page, "grid") == "false")
    assert page.find("#play").get_attribute("aria-label") == "Pause"


def test_a_question_mark_tells_the_keys(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage)
    page.until(lambda: "turtle" in page.drawn())

    press(page, "?")
    page.until(lambda: page.find("#help").is_displayed())
    assert {"T", "O", "F", "Space", "?", "/"} <= set(page.texts("#help dt"))
    assert "Esc" in page.text("#help .note")
    press(page, Keys.ESCAPE)
    page.until(lambda: not page.find("#help").is_displayed())


def test_a_frame_is_found_by_typing_a_part_of_its_name(chromium, stage):
    stage.mount(*(("world", f"link_{index}") for index in range(300)))
    stage.put(1.0, child="laser_point")
    page = Page(chromium, stage)
    page.until(lambda: "laser_point" in page.drawn())

    page.find("#source").click()
    page.until(lambda: "202 more: type to find them" in page.texts("#offers li"))
    press(page, "point")
    page.until(lambda: page.texts("#offers li") == ["laser_point"])
    press(page, Keys.ENTER)
    page.find("#target").click()
    press(page, "link_2")
    assert page.texts("#offers li")[:2] == ["link_2", "link_20"]
    press(page, Keys.ARROW_DOWN, Keys.ENTER)
    page.until(lambda: page.text("#sentence") == "laser_point in link_20")

    page.find("#target").click()
    press(page, "nothing of that name")
    page.until(lambda: page.texts("#offers li") == ["no frame has that name"])
    press(page, Keys.ENTER, Keys.ESCAPE)
    assert page.find("#target").get_attribute("value") == "link_20"


def test_a_double_click_flies_to_a_frame(chromium, stage):
    stage.put(30.0, 20.0)
    stage.put(-30.0, child="other")
    for view in ("top", "orbit"):
        page = Page(chromium, stage, f"view={view}")
        page.until(lambda page=page: {"turtle", "other"} <= page.drawn().keys())

        # Both clicks are one event, because on a busy machine two clicks may be too far apart.
        page.said(
            "[...document.querySelectorAll('#tree .name')].find(e => e.textContent === 'turtle')"
            ".dispatchEvent(new MouseEvent('dblclick', { bubbles: true }))"
        )

        left, right = (page.find(f"#{side}").rect for side in ("left", "right"))
        middle = (left["x"] + left["width"] + right["x"]) / 2
        page.until(
            lambda page=page, middle=middle: abs(page.drawn()["turtle"]["pixel"][0] - middle) < 5
        )


def test_a_frame_under_the_pointer_is_lit_in_both_places(chromium, stage):
    stage.put(1.0)
    stage.put(-2.0, child="other")
    page = Page(chromium, stage)
    page.until(lambda: {"turtle", "other"} <= page.drawn().keys())
    lit = "[...document.querySelectorAll('.row.lit .name')].map(e => e.textContent)"

    ActionChains(chromium).move_to_element(page.row("turtle")).perform()
    page.until(lambda: page.said("tftool.hovered()") == "turtle" and page.said(lit) == ["turtle"])

    x, y = page.drawn()["other"]["pixel"]
    over = page.find("#over").rect
    ActionChains(chromium).move_to_element_with_offset(
        page.find("#over"), round(x - over["width"] / 2), round(y - over["height"] / 2)
    ).perform()
    page.until(lambda: page.said("tftool.hovered()") == "other" and page.said(lit) == ["other"])


def test_another_fixed_frame_is_fitted_again(chromium, stage):
    stage.put(200.0)
    page = Page(chromium, stage)
    page.until(lambda: "turtle" in page.drawn())
    drag = ActionChains(chromium).move_to_element(page.find("#over")).click_and_hold()
    drag.move_by_offset(200, 150).release().perform()
    page.row("turtle").click()
    page.until(lambda: page.text("#chosen") == "turtle")

    page.find("#as-fixed").click()
    page.until(lambda: page.x_of("world") == -200.0)

    left, right = (page.find(f"#{side}").rect for side in ("left", "right"))
    begin, end = left["x"] + left["width"], right["x"]
    page.until(lambda: all(begin < frame["pixel"][0] < end for frame in page.drawn().values()))


# The list of frames


def test_the_list_is_one_tab_stop_and_arrow_keys_lead_through_it(chromium, stage):
    stage.mount(("map", "odom"), ("odom", "base"), ("base", "arm"), ("base", "head"))
    page = Page(chromium, stage)
    page.until(lambda: page.texts("#tree .name") == ["map", "odom", "base", "arm", "head"])
    stops = "[...document.querySelectorAll('#tree, #tree *')].filter(e => e.tabIndex >= 0).length"
    assert page.said(stops) == 1
    focused = "document.activeElement.querySelector('.name')?.textContent"
    item = "document.activeElement.getAttribute('aria-{}')"

    page.said("document.querySelector('#tree [tabindex=\"0\"]').focus()")
    press(page, Keys.ARROW_DOWN, Keys.ARROW_DOWN)
    assert page.said(focused) == "base"
    assert page.said(item.format("expanded")) == "true"
    assert page.said(item.format("level")) == "3"
    press(page, Keys.ARROW_LEFT)
    assert page.said(item.format("expanded")) == "false"
    press(page, Keys.ARROW_DOWN)
    assert page.said(focused) == "base"  # folded rows are not focused
    press(page, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.END)
    assert page.said(focused) == "head"
    press(page, Keys.ENTER)
    page.until(lambda: page.text("#chosen") == "head")
    page.until(lambda: page.said(item.format("selected")) == "true")
    press(page, " ")
    page.until(lambda: "head" not in page.drawn())
    press(page, Keys.ARROW_LEFT)
    assert page.said(focused) == "base"
    assert page.said(stops) == 1


def test_a_filter_hides_rows_and_keeps_those_above_a_match(chromium, stage):
    stage.mount(("map", "odom"), ("odom", "base"), ("base", "arm"), ("map", "door"))
    page = Page(chromium, stage)
    page.until(lambda: "arm" in page.drawn())

    page.find("#only").send_keys("^arm$")
    page.until(lambda: list(page.drawn()) == ["arm"])

    seen = (
        "[...document.querySelectorAll('#tree .name')].filter(e => e.offsetParent)"
        ".map(e => e.textContent)"
    )
    page.until(lambda: page.said(seen) == ["map", "odom", "base", "arm"])


def test_the_list_is_as_wide_as_it_is_drawn_and_the_address_keeps_it(chromium, stage):
    stage.mount(("map", "odom"), ("odom", "base"))
    page = Page(chromium, stage)
    page.until(lambda: "base" in page.drawn())
    width = page.find("#left").rect["width"]

    drag = ActionChains(chromium).click_and_hold(page.find("#grip"))
    drag.move_by_offset(120, 0).release().perform()
    page.until(lambda: page.find("#left").rect["width"] == pytest.approx(width + 120, abs=8))
    page.find("#grip").send_keys(Keys.ARROW_LEFT)
    page.until(lambda: page.find("#left").rect["width"] == pytest.approx(width + 100, abs=8))
    page.until(lambda: "side=3" in chromium.current_url)

    names = "[...document.querySelectorAll('#tree .fold')].map(e => e.getBoundingClientRect().x)"
    x = page.said(names)
    assert [round(one - x[0]) for one in x] == [0, 10, 20]


# Letters

CONTRASTS = """
    const sheet = document.createElement("canvas");
    const pen = sheet.getContext("2d", { willReadFrequently: true });
    const rgba = (color) => {
      pen.clearRect(0, 0, 1, 1);
      pen.fillStyle = color;
      pen.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = pen.getImageData(0, 0, 1, 1).data;
      return [r, g, b, a / 255];
    };
    const over = (top, below) =>
      top.slice(0, 3).map((value, at) => value * top[3] + below[at] * (1 - top[3]));
    const back = (element) => {
      const layers = [];
      for (let at = element; at; at = at.parentElement)
        layers.push(rgba(getComputedStyle(at).backgroundColor));
      return layers.reverse().reduce((below, layer) => over(layer, below), [255, 255, 255]);
    };
    const light = (color) => {
      const [r, g, b] = color.map((value) =>
        value <= 0.04045 * 255 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4);
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const poor = [];
    let count = 0;
    const told = (element, pseudo) => {
      const below = back(element);
      const text = over(rgba(getComputedStyle(element, pseudo).color), below);
      const [low, high] = [light(text), light(below)].sort((one, other) => one - other);
      const ratio = (high + 0.05) / (low + 0.05);
      count++;
      const { tagName, id, className } = element;
      if (ratio < 4.5) poor.push(`${tagName}#${id}.${className} ${ratio.toFixed(2)}`);
    };
    for (const element of document.body.querySelectorAll("*")) {
      if (!element.checkVisibility({ visibilityProperty: true }) || element.disabled) continue;
      const texts = [...element.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE);
      if (texts.some((node) => node.data.trim())) told(element);
      if (element.matches("input[type=search], input[type=number], .picker")) told(element);
      if (element.placeholder && !element.value) told(element, "::placeholder");
    }
    return { count, poor: [...new Set(poor)] };
"""


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_all_text_stands_out_from_what_is_below_it(chromium, stage, theme):
    # The world has a frame of every kind: moving, static, stale, filtered, lost, hidden, chosen.
    for second in (0.9, 1.0):
        stage.put(second, at=second)
    stage.mount(("turtle", "camera"), ("world", "door"), ("apart", "lonely"))
    page = Page(
        chromium,
        stage,
        f"theme={theme}&chosen=turtle&target=world&source=turtle&hidden=door&fixed=world",
    )
    page.until(lambda: page.text("#sentence") == "turtle in world")
    page.find("#more summary").click()
    page.until(lambda: page.find("#banner").is_displayed())
    page.until(lambda: page.find('.told[data-late="dead"]').is_displayed())

    told = chromium.execute_script(CONTRASTS)
    assert told["count"] > 60
    assert told["poor"] == []

    page.find("#more summary").click()
    page.pick("source", "lonely")
    page.find("#only").send_keys("(")
    page.until(lambda: page.find("#wrong").is_displayed() and page.find("#why").is_displayed())
    page.find("#target").click()
    page.until(lambda: page.texts("#offers li"))
    assert chromium.execute_script(CONTRASTS)["poor"] == []
    press(page, Keys.ESCAPE, "?")
    page.until(lambda: page.find("#help").is_displayed())
    assert chromium.execute_script(CONTRASTS)["poor"] == []


OVERPRINTS = """
    const boxes = [];
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walk.nextNode(); node; node = walk.nextNode()) {
      const element = node.parentElement;
      if (!node.data.trim() || !element.checkVisibility({ visibilityProperty: true })) continue;
      if (element.closest("select")) continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      const { left, right, top, bottom } = range.getBoundingClientRect();
      if (right - left < 1) continue;
      // What is scrolled away is not seen.
      const edge = element.closest("#tree, #right")?.getBoundingClientRect();
      if (edge && (bottom > edge.bottom || top < edge.top)) continue;
      // What is cut with an ellipsis ends where its box does.
      const end = Math.min(right, element.getBoundingClientRect().right);
      const seen = document.elementFromPoint((left + end) / 2, (top + bottom) / 2);
      // What lets clicks through, as the banner does, is never found at its own place.
      const clicks = getComputedStyle(element).pointerEvents !== "none";
      const covered = clicks && seen && !seen.contains(element) && !element.contains(seen);
      boxes.push({ text: node.data.trim(), left, right: end, top, bottom, covered });
    }
    const bad = boxes
      .filter(({ covered, left, right }) => covered || left < -0.5 || right > innerWidth + 0.5)
      .map(({ text }) => text);
    for (const one of boxes) for (const other of boxes) {
      if (one === other) continue;
      const wide = Math.min(one.right, other.right) - Math.max(one.left, other.left);
      const high = Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top);
      if (wide > 1 && high > 3) bad.push(`${one.text} over ${other.text}`);
    }
    return bad;
"""


def test_on_a_phone_panels_are_drawers_and_nothing_overprints(chromium, stage):
    for second in (1.0, 2.0):
        stage.put(second, at=second)
    stage.mount(("turtle", "camera"))
    page = Page(chromium, stage, "chosen=camera&target=world&source=camera")
    page.until(lambda: page.text("#sentence") == "camera in world")
    with Resized(chromium, 400, 800):
        page.until(lambda: page.said("innerWidth") == 400)
        drawers = ("left", "right")
        page.until(lambda: not any(page.find(f"#{name}").is_displayed() for name in drawers))
        # The next picture moves the names so that they do not overlap.
        page.until(lambda: chromium.execute_script(OVERPRINTS) == [])
        # The picture gets most of the screen.
        bar, time = page.find("#bar").rect, page.find("#time").rect
        assert time["y"] - (bar["y"] + bar["height"]) > 500

        for name in ("left", "right", "menu"):
            button = page.find(f"[data-drawer={name}].drawer")
            button.click()
            page.until(lambda button=button: button.get_attribute("aria-expanded") == "true")
            if name != "menu":
                panel = page.find(f"#{name}")
                assert panel.is_displayed()
                time = page.find("#time").rect
                assert panel.rect["y"] + panel.rect["height"] <= time["y"]
            page.until(lambda: chromium.execute_script(OVERPRINTS) == [])
            assert page.said("document.documentElement.scrollWidth") <= 400
            button.click()
            page.until(lambda button=button: button.get_attribute("aria-expanded") == "false")
