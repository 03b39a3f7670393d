"""Browser tests of views without perspective, measuring, and a camera that follows a frame."""

import pytest

pytest.importorskip("selenium", reason="selenium is not installed")

from selenium.webdriver.common.action_chains import ActionChains

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM
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


@pytest.fixture
def driven(tmp_path):
    """Record a robot that drives along x for 4 s at 1 m/s, and a post at (0, 3, 4)."""
    buffer = Buffer(seconds(60))
    post = TransformStamped(0, "world", "post", Transform((0.0, 3.0, 4.0)))
    buffer.set_transform_static(post, "map")
    for tick in range(41):
        stamp = EPOCH + seconds(tick / 10)
        pose = Transform((tick / 10, 0.0, 0.0))
        buffer.set_transform(TransformStamped(stamp, "world", "robot", pose), "wheels")
    return file_of(tmp_path, buffer, end=4.0)


def pixels(page, *place):
    return page.said("tftool.pixelOf({}, {}, {})".format(*place))


def clicked(page, place):
    """Click at the pixel of a 3-D position."""
    x, y = pixels(page, *place)
    over = page.find("#over")
    left, top = round(x - over.size["width"] / 2), round(y - over.size["height"] / 2)
    ActionChains(page.driver).move_to_element_with_offset(over, left, top).click().perform()


@pytest.mark.parametrize(
    ("view", "right", "upward"),
    [
        ("top", (1, 0, 0), (0, 1, 0)),
        ("side", (1, 0, 0), (0, 0, 1)),
        ("front", (0, 1, 0), (0, 0, 1)),
    ],
)
def test_a_view_along_an_axis_has_no_perspective(chromium, driven, view, right, upward):
    page = opened(chromium, driven, "fixed=world&at=1")
    page.until(lambda: len(page.drawn()) == 3)
    page.find(f"#{view}").click()
    page.until(lambda: page.find(f"#{view}").get_attribute("aria-pressed") == "true")
    through = [1 - one - other for one, other in zip(right, upward, strict=True)]

    def spread():
        origin, across, up, deep = (
            pixels(page, *place) for place in ((0, 0, 0), right, upward, through)
        )
        metre = across[0] - origin[0]
        return metre > 5 and (metre, origin, across, up, deep)

    metre, origin, across, up, deep = page.until(spread)
    assert across == pytest.approx([origin[0] + metre, origin[1]], abs=0.01)
    assert up == pytest.approx([origin[0], origin[1] - metre], abs=0.01)
    # A point behind the origin is drawn at the same pixel and in the same size.
    assert deep == pytest.approx(origin, abs=0.01)
    assert page.complaints() == []


def test_two_frames_are_measured_as_they_move(chromium, driven):
    page = opened(chromium, driven, "fixed=world&at=0&view=side")
    page.until(lambda: len(page.drawn()) == 3)
    page.scrub(3.0)
    page.until(lambda: page.x_of("robot") == 3.0)
    page.find("#measure").click()
    page.until(lambda: "first point" in page.text("#measured"))
    clicked(page, (3, 0, 0))
    page.until(lambda: "second point" in page.text("#measured"))
    chromium.execute_script(
        "globalThis.words = [];"
        "const pen = CanvasRenderingContext2D.prototype, write = pen.fillText;"
        "pen.fillText = function (text, ...at) { words.push(text); write.call(this, text, ...at); }"
    )
    clicked(page, (0, 3, 4))

    page.until(lambda: "5.831 m" in page.said("words"))
    told = "robot to post: 5.831 m (x -3.000, y 3.000, z 4.000 in world)"
    page.until(lambda: page.text("#measured") == told)
    page.scrub(0.0)
    told = "robot to post: 5.000 m (x 0.000, y 3.000, z 4.000 in world)"
    page.until(lambda: page.text("#measured") == told)
    assert "5.000 m" in page.said("words")
    page.find("#measure").click()
    page.until(lambda: not page.find("#measured").is_displayed())


def test_the_line_of_a_pair_has_the_panels_distance_and_none_where_it_is_zero(chromium, driven):
    page = opened(chromium, driven, "fixed=world&at=0.5&target=world&source=robot&speed=4")
    page.until(lambda: page.said("tftool.distance()") == "0.500 m")
    chromium.execute_script(
        """
        globalThis.seen = [];
        const look = () => {
          requestAnimationFrame(look);
          const rows = [...document.querySelectorAll("#numbers dt")];
          const row = rows.find(({ textContent }) => textContent === "Distance, m");
          seen.push([tftool.distance(), row.nextSibling.textContent]);
        };
        requestAnimationFrame(look);
        """
    )
    page.find("#play").click()
    page.until(lambda: page.said("new Set(seen.map(([line]) => line)).size") > 4)
    assert {f"{float(panel):.3f} m" for _, panel in page.said("seen")} > {"0.500 m"}
    assert all(line == f"{float(panel):.3f} m" for line, panel in page.said("seen"))

    page.scrub(0.0)
    page.until(lambda: page.said("seen.at(-1)[1]") == "0.000000")
    assert page.said("tftool.distance()") == ""


def test_the_camera_goes_along_with_the_frame_it_follows(chromium, driven):
    page = opened(chromium, driven, "fixed=world&at=0.5&followed=robot")
    page.until(lambda: page.x_of("robot") == 0.5)
    before = pixels(page, 0.5, 0, 0)
    page.scrub(3.5)
    page.until(lambda: page.x_of("robot") == 3.5)

    page.until(lambda: pixels(page, 3.5, 0, 0) == pytest.approx(before, abs=0.01))
    assert pixels(page, 0.5, 0, 0)[0] < before[0] - 10
    assert page.complaints() == []
