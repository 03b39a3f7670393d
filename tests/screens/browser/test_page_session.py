"""Browser tests of the page, its address and its session."""

import threading

import pytest

pytest.importorskip("selenium.webdriver", reason="selenium is not installed")

from selenium.webdriver.common.by import By

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page
from tests.screens.browser.stage import Stage

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)


def test_another_sites_page_gets_no_frames(chromium, stage):
    stage.put(1.0)
    chromium.get("data:text/html,<title>another site</title>")

    told = chromium.execute_async_script(
        """
        const [url, done] = arguments;
        const socket = new WebSocket(url);
        socket.onopen = () => done("opened");
        socket.onerror = () => done("refused");
        """,
        stage.address("/frames").replace("http://", "ws://"),
    )

    assert told == "refused"


def test_a_second_window_joins_with_a_view_of_its_own(chromium, stage):
    stage.put(1.0)
    first = Page(chromium, stage)
    first.until(lambda: first.x_of("turtle") == 1.0)
    first_window = chromium.current_window_handle

    chromium.switch_to.new_window("window")
    second = Page(chromium, stage, "view=orbit")
    second.until(lambda: second.x_of("turtle") == 1.0)
    assert second.find("#orbit").get_attribute("aria-pressed") == "true"
    stage.put(2.0, at=2.0)
    second.until(lambda: second.x_of("turtle") == 2.0)
    chromium.close()
    chromium.switch_to.window(first_window)

    first.until(lambda: first.x_of("turtle") == 2.0)
    assert first.find("#orbit").get_attribute("aria-pressed") == "false"


def test_a_server_that_says_nothing_any_more_is_not_called_live(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage)
    page.until(lambda: page.text("#status") == "live")
    goes_on = threading.Event()
    stopped = threading.Thread(target=stage.do, args=[lambda world: goes_on.wait()])
    stopped.start()
    try:
        page.until(lambda: page.text("#status") == "no answer")
        assert "does not answer. Last seen: its " in page.text("#banner")
    finally:
        goes_on.set()
        stopped.join()

    page.until(lambda: page.text("#status") == "live")
    page.until(lambda: not page.find("#banner").is_displayed())


def test_the_end_of_the_session_is_shown_and_the_page_finds_the_next_one(chromium):
    with Stage() as ended:
        ended.put(1.0)
        page = Page(chromium, ended)
        page.until(lambda: page.text("#status") == "live")
        page.until(lambda: page.x_of("turtle") == 1.0)
    page.until(lambda: page.text("#status").startswith("session ended"))
    assert page.x_of("turtle") == 1.0  # the last picture stays

    with Stage(port=ended.port) as found:
        found.put(5.0, child="newcomer")
        page.until(lambda: page.text("#status") == "live")
        page.until(lambda: page.texts("#tree .name") == ["world", "newcomer"])
        page.until(lambda: page.x_of("newcomer") == 5.0)


def test_before_any_frame_the_page_says_what_it_waits_for(chromium, stage):
    page = Page(chromium, stage)

    page.until(lambda: page.text("#empty").startswith("No tf data.  Actual error: "))
    stage.put(1.0)
    page.until(lambda: "turtle" in page.drawn() and not page.find("#empty").is_displayed())


def test_the_address_carries_the_view(chromium, stage):
    for second in (1.0, 2.0):
        stage.put(second, at=second)
    page = Page(chromium, stage)
    page.until(lambda: page.x_of("turtle") == 2.0)
    page.row("turtle").find_element(By.CLASS_NAME, "name").click()
    page.find("#orbit").click()
    page.find("#grid").click()
    page.pick("source", "turtle")
    page.pick("target", "world")
    page.scrub(1.5)
    page.until(lambda: "at=1.5" in chromium.current_url and "target=world" in chromium.current_url)

    again = Page(chromium, stage, chromium.current_url.partition("#")[2])
    again.until(lambda: again.x_of("turtle") == 1.5)
    again.until(lambda: again.text("#chosen") == "turtle")
    again.until(lambda: again.text("#sentence") == "turtle in world")
    assert again.find("#orbit").get_attribute("aria-pressed") == "true"
    assert again.find("#grid").get_attribute("aria-pressed") == "false"


def test_a_link_put_into_an_open_page_shows_its_view_and_makes_no_loop(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage)
    page.until(lambda: "turtle" in page.drawn())
    page.said("location.hash = 'view=orbit&chosen=turtle&speed=0.25&hidden=world&timeout=700'")

    page.until(lambda: page.said("globalThis.tftool && tftool.drawn().length") == 1)
    page.until(lambda: page.text("#chosen") == "turtle")
    assert page.find("#orbit").get_attribute("aria-pressed") == "true"
    assert page.find("#speed").get_attribute("value") == "0.25"
    assert page.find("#timeout").get_attribute("value") == "700"


def test_a_root_stands_in_for_a_fixed_frame_until_that_one_comes(chromium, stage):
    stage.put(1.0)
    page = Page(chromium, stage, "fixed=map&chosen=turtle")

    page.until(lambda: page.text("#banner").startswith("Frame [map] does not exist."))
    assert page.text("#banner").endswith("the fixed frame is [world].")
    assert page.find("#banner").is_displayed()
    page.until(lambda: page.x_of("turtle") == 1.0)
    assert page.find("#fixed").get_attribute("value") == "world"
    stage.mount(("map", "world"), x=5.0)
    page.until(lambda: page.x_of("turtle") == 6.0)
    page.until(lambda: not page.find("#banner").is_displayed())
    assert page.find("#fixed").get_attribute("value") == "map"
