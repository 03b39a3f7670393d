"""Browser tests of the time ruler and the plot: gaps, findings, and clicks."""

import pytest

pytest.importorskip("selenium", reason="selenium is not installed")

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.support.ui import Select

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page
from tests.screens.browser.test_file import file_of, opened
from tests.screens.browser.test_standalone import EPOCH
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)


def holed_world():
    """Create a world of a robot at 50 Hz for 10 s, without data from 4 s to 6 s."""
    buffer = Buffer(seconds(60))
    for tick in range(500):
        time = tick / 50
        if not 4.0 < time < 6.0:
            stamp = EPOCH + seconds(time)
            pose = Transform((time, -2.0, 0.0))
            buffer.set_transform(TransformStamped(stamp, "world", "robot", pose), "wheels")
            buffer.set_transform(TransformStamped(stamp, "robot", "arm", Transform()), "arm")
    return buffer


def clicked(page, canvas, pixel):
    """Click into a canvas, `pixel` pixels from its left side."""
    element = page.find(canvas)
    x = round(pixel - element.size["width"] / 2)
    ActionChains(page.driver).move_to_element_with_offset(element, x, 0).click().perform()


def went(page, canvas, moment, *, near, beside=0):
    """Click at a moment; click again if the page's layout was still changing."""

    def there():
        clicked(page, canvas, page.said(f"tftool.course().pixel({moment})") + beside)
        return page.said("tftool.moment()") == pytest.approx(moment, abs=near + 1e-9)

    page.until(there)


def test_the_ruler_marks_gaps_and_findings_and_goes_where_one_clicks(chromium, tmp_path):
    page = opened(chromium, file_of(tmp_path, holed_world(), end=9.98), "target=world&source=arm")
    page.until(lambda: page.said("tftool.course().series") and page.said("tftool.course().gaps"))

    course = page.said("tftool.course()")
    (gap,) = course["gaps"]
    assert (gap["from"], gap["to"]) == (4.0, 6.0)
    assert set(gap["frames"]) == {"robot", "arm"}
    found = next(one for one in course["findings"] if one["id"] == "gap")
    assert found["since"] == 4.0
    # The page goes to the exact time of the finding, although a pixel is wide.
    went(page, "#ruler", found["since"], beside=2, near=0.0)
    assert "gap" in page.find("#ruler").get_attribute("title")
    went(page, "#plot", 8.0, near=0.05)
    # The pointer is at 8 s, where the robot is 8 m along x.
    assert "x 8.0" in page.said("tftool.course().legend")

    # The wheel zooms around the pointer. The slider shows the same span, and dragging pans.
    plot = page.find("#plot")
    origin = ScrollOrigin.from_element(plot)
    ActionChains(chromium).scroll_from_origin(origin, 0, -500).perform()
    page.until(lambda: page.said("tftool.course().span.newest") < 9)
    span = page.said("tftool.course().span")
    assert span["oldest"] > 1
    assert page.find("#scrub").get_attribute("min") == str(span["oldest"])
    page.until(
        lambda: page.said("tftool.course().series.times[0]") == pytest.approx(span["oldest"])
    )
    moment = page.said("tftool.moment()")
    ActionChains(chromium).drag_and_drop_by_offset(plot, 60, 0).perform()
    page.until(lambda: page.said("tftool.course().span.oldest") < span["oldest"])
    assert page.said("tftool.moment()") == moment
    ActionChains(chromium).double_click(plot).perform()
    page.until(lambda: page.said("tftool.course().span.oldest") == 0)
    assert page.complaints() == []


def test_the_plot_follows_its_choice_and_the_address_keeps_it(chromium, tmp_path):
    path = file_of(tmp_path, holed_world(), end=9.98)
    page = opened(chromium, path, "target=world&source=arm&plot=distance")
    page.until(lambda: page.find("#plot").is_displayed())
    page.until(lambda: page.said("tftool.course().limits")[1] > 10)

    least, most = page.said("tftool.course().limits")
    assert least < 2.0 < (9.98**2 + 4) ** 0.5 < most
    Select(page.find("#quantity")).select_by_value("rpy")
    page.until(lambda: page.said("tftool.course().limits")[1] < 1)
    page.until(lambda: "plot=rpy" in chromium.current_url)
    Select(page.find("#quantity")).select_by_value("none")
    page.until(lambda: not page.find("#plot").is_displayed())


def test_a_live_page_plots_what_goes_on(chromium, stage):
    stage.put(1.0, at=1.0)
    page = Page(chromium, stage, "target=world&source=turtle")
    page.until(lambda: page.x_of("turtle") == 1.0)
    for tick in range(2, 8):
        stage.put(float(tick), at=tick / 2)
    told = "(tftool.course().series?.x ?? []).filter((x) => x !== null)"
    page.until(lambda: (page.said(told) or [0])[-1] == 7.0)
    assert page.said(told)[0] == 1.0
