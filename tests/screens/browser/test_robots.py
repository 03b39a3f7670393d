"""Tests of the server's messages about a robot."""

import json

import pytest

from tests.screens.browser.mesh_files import write_package
from tests.screens.browser.test_server import Page, fetch, open_page, put, serve, where
from tests.world.nodes.harness import new_world
from tftool.base.errors import InputError
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description
from tftool.screens.browser.page_messages import parse
from tftool.screens.browser.robots import ShownRobot
from tftool.world.nodes.joints import JointStatePublisher

ROBOT = """<robot name="arm">
  <material name="blue"><color rgba="0 0 1 0.5"/></material>
  <link name="base">
    <visual><geometry><box size="1 2 3"/></geometry><material name="blue"/></visual>
    <visual><geometry><cylinder radius="0.1" length="2"/></geometry></visual>
    <visual><geometry><sphere radius="0.3"/></geometry>
      <material name="photo"><texture filename="package://arm_description/textures/red.png"/>
      </material></visual>
    <visual><geometry><capsule radius="0.1" length="0.5"/></geometry></visual>
    <collision><origin xyz="1 2 3"/><geometry><box size="1 1 1"/></geometry></collision>
  </link>
  <link name="hand">
    <visual><geometry><mesh filename="package://arm_description/meshes/a.stl" scale="2 2 2"/>
      </geometry></visual>
    <visual><geometry><mesh filename="../meshes/a.obj"/></geometry></visual>
    <visual><geometry><mesh filename="package://arm_description/meshes/a.dae"/></geometry></visual>
    <visual><geometry><mesh filename="package://arm_description/meshes/a.gltf"/></geometry></visual>
    <visual><geometry><mesh filename="package://nobody/meshes/x.stl"/></geometry></visual>
    <visual><geometry><mesh filename="file:///etc/passwd"/></geometry></visual>
  </link>
  <joint name="turn" type="revolute"><axis xyz="0 0 1"/><parent link="base"/><child link="hand"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture
def package(tmp_path):
    return write_package(tmp_path)


@pytest.fixture
def shown(package):
    return ShownRobot(Robot(parse_description(ROBOT)), MeshFolders(package / "urdf" / "arm.urdf"))


def test_every_shape_is_told_with_its_place_and_colour(shown):
    told = json.loads(shown.as_text())

    base, hand = told["links"]
    assert [one["kind"] for one in base["visuals"]] == ["box", "cylinder", "sphere", "capsule"]
    assert base["visuals"][0]["color"] == [0, 0, 1, 0.5]
    assert base["visuals"][2]["texture"] == "/mesh/0/textures/red.png"
    assert base["collisions"][0]["origin"] == [1, 2, 3, 0, 0, 0, 1]
    assert [one.get("address") for one in hand["visuals"]] == [
        "/mesh/0/meshes/a.stl",
        "/mesh/0/meshes/a.obj",
        "/mesh/0/meshes/a.dae",
        "/mesh/0/meshes/a.gltf",
        None,
        None,
    ]
    assert hand["visuals"][0]["scale"] == [2, 2, 2]
    assert [one["kind"] for one in hand["visuals"][4:]] == ["missing", "missing"]
    assert [line.split(":")[0] for line in told["missing"]] == [
        "package 'nobody' of 'package",
        "'file",
    ]
    assert told["sliders"] == []


def test_sliders_are_told_where_we_move_the_joints(shown):
    shown.mover = JointStatePublisher(new_world(), robot=shown.robot, positions={"turn": 0.25})

    assert json.loads(shown.as_text())["sliders"] == [
        {"name": "turn", "unit": "rad", "range": [-1, 2], "position": 0.25}
    ]


def test_pages_get_the_robot_its_meshes_and_nothing_else(shown, package):
    (package / "meshes" / "out.stl").symlink_to("/etc/hostname")

    async def test(world, page):
        page.show_robot(shown)
        async with open_page(page) as connection:
            client = Page(connection)
            put(world, 1.0, parent="base", child="hand")
            await client.until(lambda client: "robot" in client.told)
        good = await fetch(page.port, where(page, "/mesh/0/meshes/a.stl"))
        bad = [
            await fetch(page.port, where(page, path))
            for path in (
                "/mesh/0/../../etc/passwd",
                "/mesh/0/%2e%2e/%2e%2e/etc/passwd",
                "/mesh/0//etc/passwd",
                "/mesh/0/meshes/out.stl",
                "/mesh/0/package.xml",
                "/mesh/9/meshes/a.stl",
            )
        ]
        return client.told["robot"], good, bad

    told, (status, headers, body), bad = serve(test)
    assert told["name"] == "arm"
    assert status == 200
    assert headers["Content-Type"] == "model/stl"
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert body == (package / "meshes" / "a.stl").read_bytes()
    assert [status for status, _, _ in bad] == [404] * 6
    assert not any(b"root:" in body for _, _, body in bad)


def test_without_a_robot_there_are_no_meshes():
    async def test(world, page):
        return await fetch(page.port, where(page, "/mesh/0/meshes/a.stl"))

    status, _, _ = serve(test)
    assert status == 404


def test_a_page_moves_joints_within_their_limits(shown):
    async def test(world, page):
        shown.mover = JointStatePublisher(world, robot=shown.robot)
        page.show_robot(shown)
        places = []
        async with open_page(page) as connection:
            client = Page(connection)
            for joint, position in (("turn", 0.5), ("nothing", 1.0), ("turn", 9.0)):
                await client.say(type="move", joint=joint, position=position)
                # The answer about a pair shows that earlier messages were processed.
                pair = f"a{len(places)}"
                await client.say(type="pair", target=pair, source="b")
                while client.told.get("pair", {}).get("target") != pair:
                    await client.hear()
                places.append(shown.mover.positions["turn"])
        return places

    assert serve(test) == [0.5, 0.5, 2.0]


def test_frames_that_come_say_what_stands_before_the_links(shown):
    async def test(world, page):
        page.show_robot(shown)
        async with open_page(page) as connection:
            client = Page(connection)
            put(world, 1.0, parent="left/base", child="left/hand")
            await client.until(
                lambda client: (
                    client.told.get("robot", {"links": [{"frame": ""}]})["links"][0]["frame"]
                    == "left/base"
                )
            )
            return client.told["robot"]["joints"][0]["frame"]

    assert serve(test) == "left/hand"


@pytest.mark.parametrize(
    "said",
    [
        {"type": "move"},
        {"type": "move", "joint": 3, "position": 1.0},
        {"type": "move", "joint": "a", "position": "b"},
        {"type": "move", "joint": "a", "position": 1e300},
    ],
)
def test_a_move_that_is_none_is_refused(said):
    with pytest.raises(InputError):
        parse(json.dumps(said))
