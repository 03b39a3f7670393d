"""Browser tests of `tftool view`: turtles left alone and driven, recordings, descriptions."""

import contextlib
import math
import os
import re
import subprocess
import sys
from itertools import pairwise

import pytest

pytest.importorskip("selenium.webdriver", reason="selenium is not installed")

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from tests.benchmarks.robots import ball
from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page, Resized
from tests.screens.browser.stage import Stage

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)

ALONE = """\
about: A turtle that nobody drives.
duration: 20 s
nodes:
  - turtlesim
  - broadcaster: {turtle: turtle1}
"""

ROBOT = """\
<robot name="cube">
  <link name="base"><visual><geometry><box size="2 2 2"/></geometry>
    <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material></visual></link>
  <link name="inner"/>
  <joint name="mount" type="fixed"><parent link="base"/><child link="inner"/></joint>
</robot>
"""


LONG = "left_front_steering_knuckle_of_the_second_axle_joint"

JOINTS = f"""\
<robot name="arm">
  <link name="base"><visual><geometry><cylinder radius="1" length="0.2"/></geometry>
    <material name="red"><color rgba="1 0 0 1"/></material></visual></link>
  <link name="arm"/><link name="slide"/>
  <joint name="{LONG}" type="revolute"><parent link="base"/><child link="arm"/>
    <axis xyz="0 0 1"/><limit lower="-0.5" upper="1" effort="1" velocity="1"/></joint>
  <joint name="lift" type="prismatic"><parent link="arm"/><child link="slide"/>
    <axis xyz="0 0 1"/><limit lower="0.1" upper="0.4" effort="1" velocity="1"/></joint>
</robot>
"""

# The distance from the world's origin to the farthest red pixel, in several directions
REACH = """
    const sheet = tftool.picture(), directions = 360;
    const { width, height } = sheet, ratio = width / document.getElementById("over").clientWidth;
    const [x, y] = tftool.pixelOf(0, 0, 0).map((place) => place * ratio);
    const { data } = sheet.getContext("2d").getImageData(0, 0, width, height);
    const isRed = (column, row) => {
      const at = 4 * (Math.round(row) * width + Math.round(column));
      return data[at] > 60 && data[at] > 2 * Math.max(data[at + 1], data[at + 2]);
    };
    return [...Array(directions).keys()].map((turn) => {
      const angle = (2 * Math.PI * turn) / directions;
      let far = 80 * ratio; // names stand in the middle
      while (isRed(x + far * Math.cos(angle), y + far * Math.sin(angle))) far += 0.25;
      return far;
    });
"""


class Address:
    """Page that another process serves."""

    def __init__(self, url):
        self.url = url


def bottom(element):
    """Return where an element ends, in pixels from the top of the window."""
    return element.rect["y"] + element.rect["height"]


@contextlib.contextmanager
def view(tmp_path, *words):
    """Run `tftool view` in a separate session; return the page's address."""
    sessions = tmp_path / "sessions"
    sessions.mkdir(mode=0o700, exist_ok=True)
    process = subprocess.Popen(
        [sys.executable, "-m", "tftool", "view", *map(str, words), "--port", "0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "TFTOOL_SESSION_DIR": str(sessions)},
    )
    try:
        yield Address(re.search(r"http://\S+", process.stdout.readline())[0])
    finally:
        process.terminate()
        process.communicate()


def test_a_turtle_left_alone_draws_and_arrow_keys_drive_it(chromium, tmp_path):
    file = tmp_path / "alone.yaml"
    file.write_text(ALONE)
    with view(tmp_path, file) as address:
        page = Page(chromium, address)
        page.until(lambda: "turtle1" in page.drawn())
        began = page.x_of("turtle1")
        page.until(lambda: abs(page.x_of("turtle1") - began) > 0.3)

        body = page.find("body")
        body.send_keys(Keys.ARROW_UP)
        # A key ends the drawing: the turtle stops within a second.
        poses = [page.drawn()["turtle1"]["pose"]]

        def rests():
            page.driver.execute_async_script("setTimeout(arguments[0], 400)")
            poses.append(page.drawn()["turtle1"]["pose"])
            return poses[-1] == poses[-2]

        page.until(rests)
        # The up key moves the turtle along its heading.
        body.send_keys(Keys.ARROW_LEFT)
        page.until(lambda: page.drawn()["turtle1"]["pose"][3:] != poses[-1][3:])
        assert page.complaints() == []


def test_axes_are_seen_through_solids_which_are_on_the_ground_and_are_measured(chromium, tmp_path):
    file = tmp_path / "cube.urdf"
    file.write_text(ROBOT)
    seen = """
        const sheet = tftool.picture();
        const pen = sheet.getContext("2d");
        const { data } = pen.getImageData(sheet.width / 2 - 80, sheet.height / 2 - 80, 160, 160);
        let found = 0;
        for (let at = 0; at < data.length; at += 4) {
          if (data[at] > 100 && data[at] > 2 * Math.max(data[at + 1], data[at + 2])) found++;
        }
        return found;
    """
    with view(tmp_path, file) as address:
        looks = "names=0&arrows=0&grid=0&scale=2&theme=dark&view=orbit&camera=-6,-6,5,0,0,0,1"
        page = Page(chromium, address, looks)
        # The red pixels are the x axis of 0.4 m, in the middle of a cube of 2 m.
        page.until(lambda: page.driver.execute_script(seen) > 10)
        page.find("#through").click()
        page.until(lambda: page.driver.execute_script(seen) == 0)

        # The ground is at the cube's lower side. The measured points are on the cube's edge, one
        # directly above the other.
        assert page.said("tftool.ground().level") == -1
        page.find("#measure").click()
        for place in ((-1, -1, 0.5), (-1, -1, -0.5)):
            x, y = page.said(f"tftool.pixelOf({','.join(map(str, place))})")
            middle = page.find("#over").rect
            at = round(x - middle["width"] / 2), round(y - middle["height"] / 2)
            ActionChains(chromium).move_to_element_with_offset(
                page.find("#over"), *at
            ).click().perform()
        told = page.until(lambda: "in base: " in page.text("#measured") and page.text("#measured"))
        assert float(re.search(r"in base: ([\d.]+) m", told)[1]) == pytest.approx(1, abs=0.05)


def test_a_recording_is_called_recorded_and_opens_at_its_start_with_its_whole_path(
    chromium, tmp_path
):
    run = tmp_path / "run.tum"
    run.write_text("".join(f"{100 + step} {step} 0 0 0 0 0 1\n" for step in range(11)))
    with view(tmp_path, run) as address:
        page = Page(chromium, address)
        page.until(lambda: page.text("#status") == "recorded")
        page.until(lambda: page.said("tftool.moment()") == 0)
        assert page.find("#play").get_attribute("aria-label") == "Play"
        assert not page.find("#live").is_displayed()
        assert page.said("tftool.reach()")["newest"] == 10
        page.until(lambda: [path[-1:] for path in page.said("tftool.ahead()")] == [[[10, 0, 0]]])
        page.scrub(4)
        page.until(lambda: [path[0][0] > 3.9 for path in page.said("tftool.ahead()")] == [True])
        page.until(lambda: page.text("#moment") == "4.000 of 10.000 s")
        page.find("#more summary").click()
        page.find("#whole").click()
        page.until(lambda: page.said("tftool.ahead()") == [[]])


def test_a_trail_shows_no_other_moments_after_settings_jumps_and_drags(chromium, tmp_path):
    run = tmp_path / "run.tum"
    # A metre per second along x, so that a position shows its time
    run.write_text("".join(f"{100 + step} {step} 0 0 0 0 0 1\n" for step in range(301)))
    places = "Math.min(...tftool.trailOf(arguments[0]).map(([x]) => x)) - tftool.moment()"
    with view(tmp_path, run) as address:
        page = Page(chromium, address, "whole=0&trails=1&view=top")
        # The moment is 0 before the first frame is drawn, too.
        page.until(lambda: any(one["arrow"] for one in page.drawn().values()))
        page.until(lambda: page.said("tftool.moment()") == 0)
        (moving,) = (name for name, one in page.drawn().items() if one["arrow"])
        over = page.find("#over")

        def oldest():
            return page.driver.execute_script(f"return {places}", moving)

        def drag():
            ActionChains(chromium).drag_and_drop_by_offset(over, 40, 30).perform()

        def lengthen(seconds):
            typed = page.find("#length")
            typed.send_keys(Keys.CONTROL, "a", Keys.NULL, str(seconds), Keys.ENTER)

        page.find("#more summary").click()
        for moment, length in ((200, 10), (70, 50), (250, 5), (60, 20)):
            page.scrub(moment)
            page.until(lambda moment=moment: page.said("tftool.moment()") == moment)
            lengthen(length)
            drag()
            # While the recording loads, the trail may be too short, but never too long.
            while oldest() > 0.5 - length:
                assert oldest() >= -length
            assert oldest() >= -length


@pytest.mark.parametrize("width", [390, 700, 1000, 1600])
def test_settings_open_inside_the_window(chromium, stage, width):
    stage.put(1.0)
    with Resized(chromium, width, 844):
        page = Page(chromium, stage)
        page.until(lambda: "turtle" in page.drawn())
        if width < 640:
            page.find('.drawer[data-drawer="menu"]').click()
        page.find("#more summary").click()
        settings = page.find("#more > .panel").rect
        assert settings["x"] >= 0
        assert settings["x"] + settings["width"] <= width


def test_a_description_has_no_timeline_and_the_same_colours_served_and_as_a_file(
    chromium, tmp_path
):
    file, written = tmp_path / "cube.urdf", tmp_path / "cube.html"
    file.write_text(ROBOT)
    subprocess.run(
        [sys.executable, "-m", "tftool", "view", str(file), "-o", str(written)], check=True
    )
    colours = []
    with view(tmp_path, file) as served:
        for address in (served, Address(written.as_uri())):
            page = Page(chromium, address)
            page.until(lambda page=page: {"base", "inner"} == page.drawn().keys())
            page.until(lambda page=page: not page.find("#time").is_displayed())
            said = "live" if address is served else "description"
            page.until(lambda page=page, said=said: page.text("#status") == said)
            colours.append(
                page.said("[...document.querySelectorAll('.swatch')].map((e) => e.style.cssText)")
            )
    assert len(colours[0]) == 2
    assert colours[0] == colours[1]


def test_of_a_deep_name_both_ends_are_seen(chromium):
    names = ["world", *(f"a{place}_link" for place in range(9)), "camera_depth_optical_frame"]
    with Stage() as stage:
        stage.mount(*pairwise(names))
        page = Page(chromium, stage)
        page.until(lambda: len(page.texts("#tree .name")) == len(names))
        row = page.row(names[-1])
        name, told = (row.find_element(By.CSS_SELECTOR, f".{part}") for part in ("name", "told"))
        head, tail = name.find_elements(By.CSS_SELECTOR, "span")

        assert name.get_attribute("title") == names[-1]
        assert tail.text == "ptical_frame"
        assert tail.rect["width"] >= page.said("12 * 5")
        assert head.rect["width"] > 10
        # The texts at the end of all rows are aligned.
        ends = {
            round(one.rect["x"] + one.rect["width"])
            for one in page.driver.find_elements(By.CSS_SELECTOR, "#tree .told")
        }
        assert len(ends) == 1
        # "static" is not in the colour of a warning; the browser writes both colours in one
        # notation.
        colours = page.driver.execute_script(
            """
            const warning = document.body.appendChild(document.createElement("i"));
            warning.style.color = "var(--still)";
            return [warning, arguments[0]].map((element) => getComputedStyle(element).color);
            """,
            told,
        )
        assert len(set(colours)) == 2


@pytest.mark.parametrize("width", [390, 1280])
def test_the_timeline_is_as_wide_as_its_panel_and_its_buttons_share_a_row(chromium, width):
    with Stage(scenario="turtles", lived=5.0) as stage, Resized(chromium, width, 800):
        page = Page(chromium, stage)
        page.until(lambda: page.text("#status") == "live")
        panel, line = page.find("#time").rect, page.find("#line").rect
        assert line["width"] > panel["width"] - 40
        play, live = page.find("#play").rect, page.find("#live").rect
        assert abs(play["y"] + play["height"] - live["y"] - live["height"]) < 4


def test_a_low_window_shows_the_picture_alone_until_panels_are_asked_for(chromium, stage):
    stage.put(1.0)
    with Resized(chromium, 1000, 400):
        page = Page(chromium, stage)
        page.until(lambda: "turtle" in page.drawn())
        panels = [page.find(f"#{name}") for name in ("left", "right", "time", "brand")]
        assert not any(panel.is_displayed() for panel in panels)
        page.find("#panels").click()
        page.until(lambda: all(panel.is_displayed() for panel in panels))

        # The list does not reach below the timeline either.
        page.until(lambda: bottom(page.find("#left")) <= page.find("#time").rect["y"])

        page.find("#left .collapse").click()
        assert not page.find("#tree").is_displayed()
        page.find("#left .collapse").click()
        assert page.find("#tree").is_displayed()


def test_the_joint_panel_has_full_names_limits_and_buttons_for_all_joints(chromium, tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(JOINTS)
    with view(tmp_path, file) as address:
        page = Page(chromium, address)
        page.until(lambda: page.texts(".slider > span") == [LONG, "lift"])
        assert page.said(
            "[...document.querySelectorAll('.slider > span')].every("
            "(name) => name.scrollWidth <= name.clientWidth + 1 || "
            "getComputedStyle(name).overflow === 'visible')"
        )
        limits = [re.findall(r"-?[\d.]+", text) for text in page.texts(".slider small")]
        told = [float(one[0]) for one in limits if one]
        assert told == pytest.approx([-28.6, 57.3, 0.1, 0.4], abs=0.05)

        def typed():
            boxes = page.driver.find_elements(By.CSS_SELECTOR, ".slider [type=number]")
            return [float(one.get_attribute("value")) for one in boxes]

        buttons = {
            one.text: one for one in page.driver.find_elements(By.CSS_SELECTOR, "#sliders button")
        }
        buttons["Centre"].click()
        assert typed() == pytest.approx([14.32, 0.25], abs=0.01)
        # Zero is outside of the lift's limits.
        buttons["Zero"].click()
        assert typed() == pytest.approx([0, 0.1])
        found = set()
        for _ in range(10):
            buttons["Random"].click()
            turn, lift = typed()
            assert -28.65 <= turn <= 57.30
            assert 0.1 <= lift <= 0.4
            found.add((turn, lift))
        assert len(found) > 1


def test_a_cylinder_is_drawn_round_and_has_a_shadow_on_the_ground(chromium, tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(JOINTS)
    with view(tmp_path, file) as address:
        looks = "names=0&arrows=0&axes=0&trails=0&theme=light&view=top"
        page = Page(chromium, address, f"{looks}&grid=0")
        page.until(lambda: min(page.driver.execute_script(REACH)) > 90)
        reach = page.driver.execute_script(REACH)
        widths = [one + other for one, other in zip(reach[:180], reach[180:], strict=True)]
        # The width of a polygon of 32 sides varies by a half per cent, with 16 sides by two per
        # cent; pixels are whole numbers.
        assert min(widths) > max(widths) * math.cos(math.pi / 32) - 2.5

        beside = """
            const [x, y] = tftool.pixelOf(1.15, 0.07, -0.1), sheet = tftool.picture();
            const ratio = sheet.width / document.getElementById("over").clientWidth;
            return [...sheet.getContext("2d").getImageData(x * ratio, y * ratio, 1, 1).data];
        """
        bare = page.driver.execute_script(beside)
        page.find("#grid").click()
        page.until(lambda: sum(page.driver.execute_script(beside)) < sum(bare) - 30)


def test_a_mesh_of_many_facets_is_shaded_smoothly(chromium, tmp_path):
    (tmp_path / "ball.stl").write_bytes(ball(1.0, rings=12))
    file = tmp_path / "ball.urdf"
    box = '<box size="2 2 2"/>'
    assert box in ROBOT
    file.write_text(ROBOT.replace(box, '<mesh filename="ball.stl"/>'))
    shades = """
        const sheet = tftool.picture();
        const ratio = sheet.width / document.getElementById("over").clientWidth;
        const [column, up] = tftool.pixelOf(0.5, 0, 0.8), [, down] = tftool.pixelOf(0.5, 0, -0.8);
        const high = Math.round((down - up) * ratio);
        const pen = sheet.getContext("2d");
        const { data } = pen.getImageData(column * ratio, up * ratio, 1, high);
        return new Set([...Array(high).keys()].map((at) => data[4 * at])).size;
    """
    with view(tmp_path, file, "--meshes", tmp_path) as address:
        page = Page(chromium, address, "names=0&axes=0&grid=0&theme=light&view=side")
        # A column with 12 flat sides would have 12 shades.
        page.until(lambda: page.driver.execute_script(shades) > 20)


def test_a_mesh_is_measured_the_same_in_another_fixed_frame(chromium, tmp_path):
    (tmp_path / "ball.stl").write_bytes(ball(1.0, rings=64))
    file = tmp_path / "ball.urdf"
    mount = '<joint name="mount" type="fixed">'
    box = '<box size="2 2 2"/>'
    assert ROBOT.count(box) == ROBOT.count(mount) == 1
    moved = f'{mount}<origin xyz="3 0 0" rpy="0 0 1.5707963"/>'
    file.write_text(ROBOT.replace(box, '<mesh filename="ball.stl"/>').replace(mount, moved))
    with view(tmp_path, file, "--meshes", tmp_path) as address:
        page = Page(chromium, address, "names=0&view=top&fixed=base&axes=0")
        page.until(lambda: page.said("tftool.robot().waiting") == 0 and "inner" in page.drawn())
        page.find("#measure").click()

        def measured(*places):
            for place in places:
                x, y = page.said(f"tftool.pixelOf({place[0]}, {place[1]}, 0)")
                half = page.find("#over").rect
                at = round(x - half["width"] / 2), round(y - half["height"] / 2)
                ActionChains(chromium).move_to_element_with_offset(
                    page.find("#over"), *at
                ).click().perform()
            told = page.until(lambda: " m (" in page.text("#measured") and page.text("#measured"))
            assert " in base " in told
            return float(re.search(r"([\d.]+) m \(", told)[1])

        # Two points of the ball, above (0.6, 0.6) and (-0.6, 0.6), at equal heights
        assert measured((0.6, 0.6), (-0.6, 0.6)) == pytest.approx(1.2, abs=0.05)
        page.pick("fixed", "inner")
        page.until(lambda: max(map(abs, page.drawn()["inner"]["pose"][:3])) < 1e-9)
        # The whole ball is in the picture again, and the grid is at its lowest point.
        page.until(lambda: page.said("tftool.ground().level") == pytest.approx(-1, abs=0.01))
        page.until(lambda: page.said("tftool.pixelOf(0, 4, 0)")[1] > bottom(page.find("#bar")))
        # The two points are the same, but x is the former y: turned back by a quarter, and 3 m to
        # the side.
        page.find("#measure").click()
        page.find("#measure").click()
        turned = [(y, 3 - x) for x, y in ((0.6, 0.6), (-0.6, 0.6))]
        assert measured(*turned) == pytest.approx(1.2, abs=0.05)


def test_the_pairs_numbers_stay_in_a_narrow_window_and_the_banner_below_the_bar(chromium):
    with Stage(scenario="turtles", lived=5.0) as stage, Resized(chromium, 1000, 700):
        page = Page(chromium, stage)
        page.until(lambda: page.find("#numbers").is_displayed())
        page.row("turtle1").click()
        page.until(lambda: page.text("#chosen") == "turtle1")
        numbers = page.find("#numbers").rect
        assert numbers["x"] >= 0
        assert numbers["x"] + numbers["width"] <= 1000
        assert numbers["y"] + numbers["height"] <= 700

        stage.end()
        page.until(lambda: page.find("#banner").is_displayed())
        bar = page.find("#bar").rect
        assert page.find("#banner").rect["y"] >= bar["y"] + bar["height"]
