"""Browser tests of a robot in the page: meshes and sliders."""

import math

import pytest

pytest.importorskip("selenium.webdriver", reason="selenium is not installed")

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from tests.screens.browser.driving import CHROMEDRIVER, CHROMIUM, Page
from tests.screens.browser.mesh_files import write_package

pytestmark = pytest.mark.skipif(
    not (CHROMIUM and CHROMEDRIVER),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)


@pytest.fixture
def robot(tmp_path):
    """Write a robot of two links with meshes of every kind, some of them missing."""
    from tests.screens.browser.test_robots import ROBOT
    from tftool.robots.mesh_folders import MeshFolders
    from tftool.robots.robot_model import Robot
    from tftool.robots.urdf import parse_description
    from tftool.screens.browser.robots import ShownRobot

    package = write_package(tmp_path)
    broken = '<visual><geometry><mesh filename="../meshes/broken.stl"/></geometry></visual></link>'
    text = broken.join(ROBOT.rsplit("</link>", 1))
    return ShownRobot(Robot(parse_description(text)), MeshFolders(package / "urdf" / "arm.urdf"))


def links_of(page):
    """Return how many visuals, collisions and joint axes are drawn, by link."""
    return page.said("tftool.robot()")["links"]


def test_a_robot_is_drawn_with_all_its_meshes(chromium, stage, robot):
    stage.show(robot)
    stage.put(1.0, 0.0, parent="base", child="hand")
    page = Page(chromium, stage, "view=orbit")
    page.until(lambda: "hand" in links_of(page) and page.said("tftool.robot().waiting") == 0)

    assert links_of(page) == {"base": [4, 0, 0], "hand": [7, 0, 0]}
    missing = page.until(lambda: (lines := page.texts("#missing li")) and len(lines) == 3 and lines)
    assert "package 'nobody'" in missing[0]
    assert "use package:// or a relative path" in missing[1]
    assert missing[2].startswith("'meshes/broken.stl' cannot be drawn")
    assert page.complaints() == []


def test_switches_show_what_links_collide_with_and_where_joints_turn(chromium, stage, robot):
    stage.show(robot)
    stage.put(1.0, 0.0, parent="base", child="hand")
    page = Page(chromium, stage, "collisions=1&jointaxes=1")
    page.until(lambda: links_of(page).get("base") == [4, 1, 0])
    assert links_of(page)["hand"] == [7, 0, 1]

    page.find("#visuals").click()
    page.find("#collisions").click()
    page.until(lambda: links_of(page).get("base") == [0, 0, 0])

    page.row("hand").find_element(By.CSS_SELECTOR, ".solid").click()
    page.until(lambda: "hand" not in links_of(page))
    assert "bare=hand" in page.until(
        lambda: (address := page.said("location.hash")) and "bare" in address and address
    )


def test_a_mesh_for_collisions_is_fetched_when_collisions_are_shown(chromium, stage, tmp_path):
    from tests.screens.browser.mesh_files import stl
    from tests.screens.browser.test_robots import ROBOT
    from tftool.robots.mesh_folders import MeshFolders
    from tftool.robots.robot_model import Robot
    from tftool.robots.urdf import parse_description
    from tftool.screens.browser.robots import ShownRobot

    package = write_package(tmp_path)
    (package / "meshes" / "shell.stl").write_bytes(stl())
    shell = '<collision><geometry><mesh filename="../meshes/shell.stl"/></geometry></collision>'
    text = f"{shell}</link>".join(ROBOT.rsplit("</link>", 1))
    folders = MeshFolders(package / "urdf" / "arm.urdf")
    stage.show(ShownRobot(Robot(parse_description(text)), folders))
    stage.put(1.0, 0.0, parent="base", child="hand")
    page = Page(chromium, stage, "view=orbit")
    page.until(lambda: "hand" in links_of(page) and page.said("tftool.robot().waiting") == 0)

    fetched = "performance.getEntriesByType('resource').map(({ name }) => name).join(' ')"
    assert "shell.stl" not in page.said(fetched)
    page.find("#collisions").click()
    page.until(lambda: "shell.stl" in page.said(fetched) and links_of(page)["hand"][1] == 1)


def test_a_slider_moves_its_joint(chromium, stage, robot):
    from tftool.world.nodes.joints import JointStatePublisher

    robot.mover = stage.do(lambda world: JointStatePublisher(world, robot=robot.robot))
    stage.show(robot)
    page = Page(chromium, stage)
    page.until(lambda: page.texts(".slider span") == ["turn"])

    chromium.execute_script(
        "const slider = document.querySelector('.slider [type=range]'); slider.value = 0.75;"
        "slider.dispatchEvent(new Event('input'))"
    )
    page.until(lambda: stage.do(lambda world: robot.mover.positions["turn"]) == 0.75)

    # Angles are in degrees, can be typed, and stay within the limits.
    typed = page.find(".slider [type=number]")
    assert float(typed.get_attribute("value")) == pytest.approx(math.degrees(0.75), abs=0.01)
    typed.send_keys(Keys.CONTROL, "a", Keys.NULL, "30", Keys.ENTER)
    page.until(
        lambda: (
            stage.do(lambda world: robot.mover.positions["turn"])
            == pytest.approx(math.radians(30), abs=1e-3)
        )
    )
    zero = next(
        one
        for one in page.driver.find_elements(By.CSS_SELECTOR, "#sliders button")
        if one.text == "Zero"
    )
    zero.click()
    page.until(lambda: stage.do(lambda world: robot.mover.positions["turn"]) == 0)
