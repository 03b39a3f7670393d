"""Browser tests of the page as one file, opened from disk without a server."""

import itertools
import json
import math
from types import SimpleNamespace

import pytest

pytest.importorskip("selenium.webdriver", reason="selenium is not installed")

from selenium.webdriver.common.by import By

import tftool
from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page
from tests.screens.browser.mesh_files import write_package
from tests.screens.browser.test_robots import ROBOT
from tests.screens.browser.test_standalone import EPOCH, WILD, drawn_world
from tftool.app.main import main
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.screens.browser import protocol
from tftool.screens.browser.robots import ShownRobot
from tftool.screens.browser.standalone import StandaloneData, standalone_page

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)


def opened(driver, path, state=""):
    """Open a file as a person does by a double click."""
    # A view in the address would replace the view in the file.
    return Page(driver, SimpleNamespace(url=path.as_uri()), state, patient=False)


def file_of(tmp_path, buffer, *, end=0.0, **words):
    path = tmp_path / "run one.html"
    data = StandaloneData("recording 'run.mcap'", buffer, EPOCH, EPOCH + seconds(end), **words)
    path.write_bytes(standalone_page(data).content)
    return path


def asked_elsewhere(page):
    """Return what the page has fetched from outside of the file."""
    script = "performance.getEntriesByType('resource').map((entry) => entry.name)"
    return [name for name in page.said(script) if not name.startswith(("data:", "blob:"))]


def test_trails_of_a_long_recording_are_as_fine_as_it(chromium, tmp_path):
    buffer = Buffer(seconds(1000))
    for step in range(6000):  # ten minutes at 10 Hz, on a circle of 6 s
        angle = math.tau * step / 60
        pose = Transform((math.cos(angle), math.sin(angle), 0.0))
        stamp = EPOCH + seconds(0.1 * step)
        buffer.set_transform(TransformStamped(stamp, "map", "runner", pose), "mover")
    path = file_of(tmp_path, buffer, end=599.9, begin=EPOCH + seconds(300))
    page = opened(chromium, path, "fixed=map&trails=1&length=10")

    def fine(moment):
        """Return the points of the trail once it is drawn finely; the first trail is coarse."""
        points = page.said("tftool.trailOf('runner')") or []
        steps = [math.dist(one, other) for one, other in itertools.pairwise(points)]
        angle = math.tau * moment / 6
        ends = points and math.dist(points[-1], (math.cos(angle), math.sin(angle), 0.0)) < 1e-3
        # The trail has 30 positions per second, and ends at the frame's present position.
        is_fine = ends and len(steps) >= 299 and max(steps) < 1.1 * math.tau / 6 / 30
        return points if is_fine else None

    for moment in (300, 555.5):
        page.scrub(moment)
        points = page.until(lambda moment=moment: fine(moment))
        assert all(math.hypot(x, y) > 0.99 for x, y, _ in points)
        assert points[-1] == pytest.approx(page.drawn()["runner"]["pose"][:3])
    assert page.complaints() == []


def test_a_recording_is_scrubbed_played_and_measured_without_a_server(chromium, tmp_path):
    buffer = drawn_world(4)
    path = file_of(tmp_path, buffer, end=3.1, begin=EPOCH + seconds(0.5))
    page = opened(chromium, path, "fixed=map&target=map&source=laser")
    page.until(lambda: page.said("tftool.pair()?.found"))

    assert page.said("tftool.moment()") == 0.5
    assert page.text("#status") == "recorded"
    assert page.said("document.title") == "recording 'run.mcap' · tftool view"
    page.scrub(1.25)
    page.until(lambda: page.said("tftool.moment()") == 1.25)
    at = EPOCH + seconds(1.25)
    wanted = json.loads(protocol.encode_pair(buffer, EPOCH, "map", "laser", at))
    assert page.said("tftool.pair()")["translation"] == pytest.approx(wanted["translation"])
    x = buffer.lookup_transform("map", "base", at).transform.translation.x
    page.until(lambda: page.x_of("base") == pytest.approx(x))  # drawn in the next picture
    # Playing stops at the end of the data: a file has no live data.
    page.scrub(2.9)
    page.find("#play").click()
    page.until(lambda: page.said("tftool.moment()") == page.said("tftool.reach().newest"))
    page.until(lambda: page.find("#play").get_attribute("aria-label") == "Play")
    assert not page.find("#live").is_displayed()
    assert asked_elsewhere(page) == []
    assert page.complaints() == []


def test_a_file_plays_by_itself_where_its_address_says_so(chromium, tmp_path):
    path = file_of(tmp_path, drawn_world(4), end=3.1, begin=EPOCH)
    page = opened(chromium, path, "play=1&speed=4")
    page.until(lambda: page.said("tftool.moment()") > 0)
    # Playing starts again at the beginning.
    page.until(lambda: page.said("tftool.moment()") > 2)
    page.until(lambda: page.said("tftool.moment()") < 2)
    page.find("#play").click()
    page.until(lambda: page.find("#play").get_attribute("aria-label") == "Play")


def test_wild_names_are_shown_as_they_are_and_do_nothing(chromium, tmp_path):
    buffer = Buffer()
    for name in WILD:
        buffer.set_transform(TransformStamped(EPOCH, "world", name, Transform()), name)
    page = opened(chromium, file_of(tmp_path, buffer, view="chosen=</script><script>alert(3)"))
    page.until(lambda: len(page.drawn()) == len(WILD) + 1)

    assert set(page.drawn()) == {"world", *WILD}
    assert set(page.texts("#tree .name")) == {"world", *WILD}
    assert page.said("document.querySelectorAll('script').length") == 3
    assert page.complaints() == []


def test_a_description_brings_its_meshes_along(chromium, tmp_path):
    package = write_package(tmp_path)
    (package / "urdf").mkdir(exist_ok=True)
    description = package / "urdf" / "arm.urdf"
    description.write_text(ROBOT)
    path = tmp_path / "arm.html"

    assert main(["view", str(description), "-o", str(path)]) == 0
    page = opened(chromium, path, "view=orbit")
    page.until(lambda: page.said("tftool.robot().waiting") == 0 and page.drawn())
    assert page.said("tftool.robot()")["links"] == {"base": [4, 0, 0], "hand": [6, 0, 0]}
    assert not [one for one in page.texts("#missing li") if "cannot be drawn" in one]
    assert asked_elsewhere(page) == []
    assert page.complaints() == []


SLIDING = """<robot name="slider"><link name="base"/><link name="arm"/><link name="tip"/>
  <link name="finger"/>
  <joint name="turn" type="revolute"><origin xyz="1 0 2" rpy="0.3 -0.2 0.1"/><axis xyz="0 1 1"/>
    <parent link="base"/><child link="arm"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><origin rpy="0 0.5 0"/><axis xyz="1 0 0"/>
    <parent link="arm"/><child link="tip"/>
    <limit lower="0" upper="0.4" effort="1" velocity="1"/></joint>
  <joint name="grip" type="revolute"><axis xyz="1 0 0"/><parent link="tip"/><child link="finger"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/>
    <mimic joint="turn" multiplier="-2" offset="0.1"/></joint>
</robot>"""


def test_a_file_of_a_robot_moves_its_joints_by_itself(chromium, tmp_path):
    description, path = tmp_path / "slider.urdf", tmp_path / "slider.html"
    description.write_text(SLIDING)
    assert main(["view", str(description), "--joint", "turn=0.5", "-o", str(path)]) == 0
    page = opened(chromium, path, "fixed=base&target=base&source=finger")
    page.until(lambda: page.texts("#sliders span") == ["turn", "slide"])
    robot = tftool.load_urdf(description)

    def check(positions):
        wanted = robot.buffer(positions).lookup_transform("base", "finger", 0).transform
        page.until(
            lambda: (
                page.said("tftool.pair()?.translation")
                == pytest.approx([*wanted.translation], abs=1e-12)
            )
        )
        assert page.said("tftool.pair().rotation") == pytest.approx([*wanted.rotation], abs=1e-12)
        page.until(lambda: page.x_of("finger") == pytest.approx(wanted.translation.x, abs=1e-9))

    def slide(joint, position):
        page.driver.execute_script(
            """
            const row = document.querySelector(`input[aria-label="Joint ${arguments[0]}"]`);
            row.value = arguments[1];
            row.dispatchEvent(new Event("input"));
            """,
            joint,
            position,
        )

    check({"turn": 0.5})
    slide("turn", -0.75)
    check({"turn": -0.75})
    slide("slide", 7)  # not beyond its limit
    check({"turn": -0.75, "slide": 0.4})
    told = [page.row(one).find_element(By.CSS_SELECTOR, ".told").text for one in ("arm", "finger")]
    assert told == ["joint", "joint"]
    assert asked_elsewhere(page) == []
    assert page.complaints() == []


def positions_of(page):
    """Return the positions in the panel of joints, in degrees and metres."""
    script = "[...document.querySelectorAll('.slider [type=number]')].map((one) => +one.value)"
    return page.said(script)


def test_a_file_shared_while_sliders_move_the_joints_has_them_too(chromium, tmp_path):
    description = tmp_path / "slider.urdf"
    description.write_text(SLIDING)
    robot = tftool.load_urdf(description)
    mover = SimpleNamespace(positions=robot.positions({"slide": 0.3}))
    buffer = Buffer()
    for end in (0.0, 1.0):
        for one in robot.transforms({"slide": 0.3}):
            buffer.set_transform(one._replace(stamp=EPOCH + seconds(end)), "mover")
    path = file_of(tmp_path, buffer, end=1.0, robot=ShownRobot(robot, mover=mover))
    page = opened(chromium, path, "fixed=arm&target=arm&source=tip")
    page.until(lambda: positions_of(page) == [0, 0.3])

    page.driver.execute_script(
        """
        const row = document.querySelector('input[aria-label="Joint slide"]');
        row.value = 0.1;
        row.dispatchEvent(new Event("input"));
        """
    )

    wanted = robot.buffer({"slide": 0.1}).lookup_transform("arm", "tip", 0).transform
    page.until(
        lambda: (
            page.said("tftool.pair()?.translation")
            == pytest.approx([*wanted.translation], abs=1e-12)
        )
    )
    assert page.complaints() == []


COPIED = """
    globalThis.copied = "";
    Object.defineProperty(navigator, "clipboard", {
      value: { writeText: async (text) => { globalThis.copied = text; } },
    });
"""


def test_share_in_a_file_copies_its_name_and_the_view(chromium, tmp_path):
    page = opened(chromium, file_of(tmp_path, drawn_world(5), end=3.1), "at=1.5&fixed=map")
    page.until(lambda: page.drawn())
    chromium.execute_script(COPIED)
    page.find("#share").click()

    copied = page.until(lambda: page.said("copied"))
    assert copied.startswith("run%20one.html#")
    assert "at=1.5" in copied
    assert str(tmp_path) not in copied
    assert "for those who have the file" in page.text("#toast")


def test_share_of_a_live_page_saves_a_file_that_shows_the_same(chromium, stage, tmp_path):
    chromium.execute_cdp_cmd(
        "Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)}
    )
    stage.put(3.0, 1.0, at=1.0)
    page = Page(chromium, stage, "names=0")
    page.until(lambda: page.x_of("turtle") == 3.0)
    page.find("#share").click()
    path = tmp_path / "tftool-view.html"
    page.until(path.exists)
    assert "opens anywhere" in page.text("#toast")
    stage.end()

    saved = opened(chromium, path)
    saved.until(lambda: saved.x_of("turtle") == 3.0)
    assert saved.find("#names").get_attribute("aria-pressed") == "false"
    assert asked_elsewhere(saved) == []
    assert saved.complaints() == []


def test_a_notebooks_output_shows_the_frames_in_a_frame_of_its_own(chromium, tmp_path):
    path = tmp_path / "notebook.html"
    shown = tftool.view(drawn_world(6), height=500)
    path.write_text(f"<!doctype html><meta charset=utf-8><p>In [1]:</p>{shown._repr_html_()}")
    page = opened(chromium, path)
    chromium.switch_to.frame(page.find("iframe"))
    page.until(lambda: page.said("globalThis.tftool?.drawn().length"))

    assert page.text("#status") == "recorded"
    page.scrub(2.0)
    page.until(lambda: page.said("tftool.moment()") == 2.0)
    page.find("#share").click()
    assert page.until(lambda: page.text("#toast")) == "This view has no address of its own"
    chromium.switch_to.default_content()
    assert page.complaints() == []
