import math
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.patience import PATIENCE
from tftool.base.errors import DescriptionError, InputError
from tftool.robots import xacro_process
from tftool.robots.description import (
    BoxShape,
    CapsuleShape,
    CylinderShape,
    MeshShape,
    SphereShape,
)
from tftool.robots.urdf import is_xacro, load_description, parse_description
from tftool.robots.urdf import parse_description as parse

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <material name="steel"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base"/>
  <link name="upper">
    <inertial>
      <mass value="2.5"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
    <visual name="tube">
      <origin xyz="0 0 0.5"/>
      <geometry><cylinder radius="0.1" length="1"/></geometry>
      <material name="steel"/>
    </visual>
    <visual><geometry><mesh filename="package://arm/upper.stl" scale="1 1 2"/></geometry></visual>
    <collision><geometry><box size="1 2 3"/></geometry></collision>
    <collision><geometry><sphere radius="0.5"/></geometry></collision>
    <collision><geometry><capsule radius="0.5" length="2"/></geometry></collision>
  </link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/>
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 0 2"/>
    <limit lower="-1" upper="2" effort="10" velocity="3"/>
  </joint>
  <joint name="flange" type="fixed">
    <parent link="upper"/>
    <child link="tool"/>
    <axis xyz="0 0 0"/>
  </joint>
  <gazebo><plugin name="unknown"/></gazebo>
</robot>
"""


def refused(text):
    with pytest.raises(DescriptionError) as error:
        parse(text, "arm.urdf")
    return error.value


def test_a_description_gives_links_and_joints():
    arm = parse(ARM)

    assert (arm.name, arm.root) == ("arm", "base")
    assert list(arm.links) == ["base", "upper", "tool"]
    shoulder = arm.joints["shoulder"]
    assert (shoulder.parent, shoulder.child, shoulder.type) == ("base", "upper", "revolute")
    assert shoulder.axis == (0.0, 0.0, 1.0)
    assert shoulder.origin.rotation == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))
    assert (shoulder.limit.lower, shoulder.limit.upper) == (-1.0, 2.0)
    assert (shoulder.limit.effort, shoulder.limit.velocity) == (10.0, 3.0)
    assert not arm.joints["flange"].moves


def test_the_visuals_collisions_and_mass_of_a_link_are_read():
    upper = parse(ARM).links["upper"]

    tube, mesh = upper.visuals
    assert tube.geometry == CylinderShape(0.1, 1.0)
    assert tube.origin.translation == (0.0, 0.0, 0.5)
    assert tube.material.color == (0.5, 0.5, 0.5, 1.0)
    assert mesh.geometry == MeshShape("package://arm/upper.stl", (1.0, 1.0, 2.0))
    assert [one.geometry for one in upper.collisions] == [
        BoxShape((1.0, 2.0, 3.0)),
        SphereShape(0.5),
        CapsuleShape(0.5, 2.0),
    ]
    assert upper.mass == 2.5


@pytest.mark.parametrize(
    ("before", "after", "marked", "told"),
    [
        ('<child link="upper"/>', '<child link="uper"/>', 'link="uper"', "did you mean 'upper'?"),
        ('<axis xyz="0 0 2"/>', '<axis xyz="0 0 0.0"/>', 'xyz="0 0 0.0"', "must not be zero"),
        ('type="revolute"', 'type="revolut"', 'type="revolut"', "did you mean 'revolute'?"),
        ('xyz="0 0 1"', 'xyz="0 0 1e999"', 'xyz="0 0 1e999"', "'1e999' is not a finite number"),
        ('xyz="0 0 1"', 'xyz="0 1"', 'xyz="0 1"', "xyz must be 3 numbers, not 2"),
        ('effort="10" ', "", "<limit", "<limit> has no effort"),
        ('name="tool"', "name='base'", "name='base'", "a link named 'base' already"),
        ('<parent link="upper"/>', '<parent link="tool"/>', None, "tool → tool"),
        ('<child link="tool"/>', "<child link='upper'/>", "link='upper'", "two parents"),
        ('name="arm"', "", "<robot", "the robot has no name"),
    ],
)
def test_a_mistake_is_reported_where_it_stands(before, after, marked, told):
    text = ARM.replace(before, after, 1)
    assert text != ARM

    mistakes = [one for one in refused(text).mistakes if told in one.text]

    assert len(mistakes) == 1
    (mistake,) = mistakes
    if marked:
        line = text.split("\n")[mistake.line - 1]
        assert line[mistake.column - 1 :].startswith(marked)
        assert mistake.marks.strip() == "^" * len(marked)


def test_every_mistake_is_reported_at_once_in_the_order_of_the_file():
    text = ARM.replace('<child link="tool"/>', '<child link="tol"/>').replace(
        'velocity="3"', 'velocity="?"'
    )

    lines = [one.line for one in refused(text).mistakes]

    assert lines == sorted(lines)
    assert len(lines) == 2


@pytest.mark.parametrize(
    ("before", "after", "place", "told"),
    [
        ('<mass value="2.5"/>', "", "6:5", "<inertial> has no <mass>"),
        ('ixy="0" ', "", "8:7", "<inertia> has no ixy"),
        ('<box size="1 2 3"/>', "<cone/>", "16:16", "not <cone>"),
        ('radius="0.1"', 'radius="thin"', "12:27", "'thin' is not a finite number"),
        ('xyz="0 0 0.5"', 'xyz="0 0"', "11:15", "xyz must be 3 numbers, not 2"),
        ('rgba="0.5 0.5 0.5 1"', 'rgba="grey"', "3:33", "'grey' is not a finite number"),
    ],
)
def test_a_mistake_that_moves_no_frame_is_noted_and_left_out(before, after, place, told):
    text = ARM.replace(before, after, 1)
    assert text != ARM

    arm = parse(text, "arm.urdf")

    assert list(arm.joints) == ["shoulder", "flange"]
    (note,) = arm.notes
    assert note.startswith(f"arm.urdf:{place}: ")
    assert told in note
    assert note.endswith("; left out")


def test_a_shape_keeps_what_is_sound_of_it():
    text = ARM.replace('<material name="steel"/>', '<material><color rgba="x"/></material>')

    tube, mesh = parse(text).links["upper"].visuals

    assert tube.geometry == CylinderShape(0.1, 1.0)
    assert tube.material is None
    assert mesh.material is None


def test_two_materials_of_one_name_are_refused():
    steel = '<material name="steel"><color rgba="0.5 0.5 0.5 1"/></material>'

    (mistake,) = refused(ARM.replace(steel, steel * 2)).mistakes

    assert "a material named 'steel' already" in mistake.text


@pytest.mark.parametrize("first", ["\n\n", "<?xml verison='1.0'?>\n", "\n<?xml version='1.0' ?>\n"])
def test_a_declaration_that_others_read_is_read(tmp_path, first):
    file = tmp_path / "arm.urdf"
    file.write_text(ARM.replace('<?xml version="1.0"?>\n', first))
    assert load_description(file).root == "base"

    file.write_text(file.read_text().replace('child link="tool"', 'child link="tol"'))
    with pytest.raises(DescriptionError) as error:
        load_description(file)

    lines = file.read_text().split("\n")
    (mistake,) = (one for one in error.value.mistakes if "'tol'" in one.text)
    assert lines[mistake.line - 1][mistake.column - 1 :].startswith('link="tol"')


def test_an_empty_name_is_taken():
    assert parse(ARM.replace('name="arm"', 'name=""')).name == ""
    assert list(parse('<robot name=""><link name=""/></robot>').links) == [""]


def test_several_roots_are_named_with_the_remedy():
    text = ARM.replace('<link name="tool"/>', '<link name="tool"/><link name="loose"/>')

    (mistake,) = refused(text).mistakes

    assert "'base', 'loose'" in mistake.text
    assert "connect these links by fixed joints" in mistake.text


@pytest.mark.parametrize(
    "text",
    [
        "",
        "<robot",
        "<sdf/>",
        "<robot name='a'/>",
        "<a>" * 100_000,
        "<robot name='a'><link name='x'/><link name='x'/></robot>",
        '<!DOCTYPE r [<!ENTITY a "aa"><!ENTITY b "&a;&a;">]><robot name="&b;"/>',
    ],
)
def test_an_invalid_description_is_refused_with_the_line_of_its_mistake(text):
    assert refused(text).mistakes[0].line >= 1


def test_a_document_type_is_refused():
    assert "<!DOCTYPE" in str(refused("<!DOCTYPE robot><robot name='a'><link name='b'/></robot>"))


def test_a_mimic_of_nothing_is_noted_and_read():
    text = ARM.replace('<axis xyz="0 0 2"/>', '<axis xyz="0 0 2"/><mimic joint="elbow"/>')

    arm = parse(text)

    assert arm.joints["shoulder"].mimic.joint == "elbow"
    assert "'elbow', but there is no such joint" in arm.notes[0]


def test_limits_that_leave_no_room_are_noted_and_read():
    arm = parse(ARM.replace('lower="-1', 'lower="9'))

    assert "'shoulder' has no valid position: its lower limit" in arm.notes[0]
    assert re.match(r"\S*:\d+:\d+: ", arm.notes[0])
    assert arm.mistakes == arm.notes
    assert parse(ARM).notes == ()


@pytest.mark.parametrize(("limit", "turns"), [("-90", "14"), ("180", "29"), ("360", "57")])
def test_limits_in_degrees_are_noted_and_read(limit, turns):
    arm = parse(ARM.replace('lower="-1', f'lower="{limit}'))

    told = [note for note in arm.notes if "radians" in note]
    assert len(told) == 1
    assert f"the limit {limit} of joint 'shoulder' is {turns} turns" in told[0]


@pytest.mark.parametrize("limit", ["-6.3", "-12.5", "-31.4", "-1e16"])
def test_limits_of_several_turns_are_no_mistake(limit):
    assert parse(ARM.replace('lower="-1', f'lower="{limit}')).mistakes == ()


def test_degrees_where_radians_are_wanted_are_noted_and_read():
    arm = parse(
        ARM.replace(
            "<joint",
            '<joint name="mount" type="fixed"><parent link="base"/>'
            '<child link="mounted"/><origin rpy="0 0 90"/></joint><link name="mounted"/><joint',
            1,
        )
    )

    assert "rpy 0 0 90 is more than a whole turn" in arm.notes[0]


def test_a_file_is_read_with_its_encoding(tmp_path):
    path = tmp_path / "arm.urdf"
    text = ARM.replace('"1.0"?', '"1.0" encoding="iso-8859-1"?').replace("tool", "groß")
    path.write_bytes(text.encode("iso-8859-1"))

    assert "groß" in load_description(path).links


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"\xff\xfe<robot", "is not text in"),
        (b"<?xml version='1.0' encoding='klingon'?><robot/>", "'klingon', which is unknown"),
        (b"<?xml version='1.0' encoding='hex'?><robot/>", "'hex', which is unknown"),
    ],
)
def test_a_file_that_is_no_text_is_refused(tmp_path, content, told):
    path = tmp_path / "arm.urdf"
    path.write_bytes(content)

    with pytest.raises(InputError, match=told):
        load_description(path)


def test_a_missing_file_is_a_sentence(tmp_path):
    with pytest.raises(InputError, match="No such file"):
        load_description(tmp_path / "arm.urdf")


def test_an_expanded_file_that_still_declares_xacro_needs_none():
    plain = ARM.replace('name="arm"', 'name="arm" xmlns:xacro="http://ros.org/wiki/xacro"')

    assert not is_xacro(f"<!-- made by xacro from $(find arm) -->{plain[22:]}")
    assert is_xacro(plain.replace('xyz="0 0 1"', 'xyz="0 0 ${height}"'))
    assert is_xacro(plain.replace("<gazebo>", "<xacro:arm/><gazebo>"))


def test_xacro_is_expanded_with_its_arguments(tmp_path):
    pytest.importorskip("xacrodoc", reason="the extra 'xacro' is not installed")
    path = tmp_path / "arm.urdf.xacro"
    path.write_text(
        ARM.replace(
            'name="arm">',
            'name="arm" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="h" default="1"/>',
        ).replace('xyz="0 0 1"', 'xyz="0 0 $(arg h)"')
    )

    tall = load_description(path, {"h": "7"})

    assert tall.joints["shoulder"].origin.translation == (0.0, 0.0, 7.0)
    assert load_description(path).joints["shoulder"].origin.translation == (0.0, 0.0, 1.0)


def test_xacro_that_fails_is_a_sentence(tmp_path):
    pytest.importorskip("xacrodoc", reason="the extra 'xacro' is not installed")
    path = tmp_path / "arm.urdf.xacro"
    path.write_text(ARM.replace('xyz="0 0 1"', 'xyz="0 0 ${nothing}"'))

    with pytest.raises(InputError, match="cannot be expanded by xacro"):
        load_description(path)


def test_xacro_finds_the_packages_of_its_workspace(tmp_path):
    pytest.importorskip("xacrodoc", reason="the extra 'xacro' is not installed")
    for package in ("arms/arm_bringup", "arms/arm_description", "tools/gripper"):
        folder = tmp_path / "ws" / "src" / package
        (folder / "urdf").mkdir(parents=True)
        name = folder.name
        (folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
        (folder / "urdf" / "part.xacro").write_text(
            '<robot xmlns:xacro="http://ros.org/wiki/xacro">'
            f'<xacro:macro name="{name}"><link name="{name}"/></xacro:macro></robot>'
        )
    # After installation, description/parts is parts/, beside package.xml.
    own = tmp_path / "ws" / "src" / "arms" / "arm_bringup"
    (own / "CMakeLists.txt").write_text(
        "install(\n  DIRECTORY description/parts\n  DESTINATION share/arm_bringup\n)\n"
    )
    (own / "description" / "parts").mkdir(parents=True)
    (own / "description" / "parts" / "tool.xacro").write_text(
        '<robot xmlns:xacro="http://ros.org/wiki/xacro"><link name="tool"/><joint name="t" '
        'type="fixed"><parent link="gripper"/><child link="tool"/></joint></robot>'
    )
    path = own / "urdf" / "arm.urdf.xacro"
    used = "arm_description"
    path.write_text(
        '<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">'
        f'<xacro:include filename="$(find {used})/urdf/part.xacro"/><xacro:{used}/>'
        '<xacro:include filename="$(find gripper)/urdf/part.xacro"/>'
        '<joint name="j" type="fixed"><parent link="arm_description"/><child link="gripper"/>'
        '</joint><xacro:gripper/><xacro:include filename="$(find arm_bringup)/parts/tool.xacro"/>'
        "</robot>"
    )

    assert set(load_description(path).links) == {"arm_description", "gripper", "tool"}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('<link name="$(arg dof)_base"/>', "needs the xacro argument 'dof': add dof:=VALUE"),
        (
            '<xacro:macro name="arm" params="p"><link name="${p}base"/></xacro:macro>',
            "it only defines a macro (arm): name the file that uses them",
        ),
    ],
)
def test_a_missing_argument_and_a_file_of_macros_are_named(tmp_path, text, said):
    pytest.importorskip("xacrodoc", reason="the extra 'xacro' is not installed")
    path = tmp_path / "arm.urdf.xacro"
    path.write_text(f'<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">{text}</robot>')

    with pytest.raises(InputError, match=re.escape(said)):
        load_description(path)


def test_xacro_in_a_file_of_another_name_is_not_run(tmp_path):
    path = tmp_path / "arm.urdf"
    trap = tmp_path / "ran"
    path.write_text(
        ARM.replace(
            "<gazebo>", f"<xacro:property name='x' value='${{open(\"{trap}\", \"w\")}}'/><gazebo>"
        )
    )

    with pytest.raises(InputError, match="contains xacro, which may run Python"):
        load_description(path)
    assert not trap.exists()


def test_a_description_with_elements_of_xacro_is_refused_where_it_is_published():
    text = ARM.replace("<gazebo>", "<xacro:arm/><gazebo>").replace(
        'name="arm"', 'name="arm" xmlns:xacro="http://ros.org/wiki/xacro"'
    )

    with pytest.raises(InputError, match="has elements of xacro"):
        parse_description(text, "run.bag:/robot_description")


@pytest.mark.parametrize(
    ("expression", "told"),
    [
        ("[0 for i in range(10**12)]", "within 1 s|GB of memory"),
        ("len('x' * 2**32)", "1 GB of memory"),
    ],
)
def test_xacro_without_bound_ends(tmp_path, monkeypatch, expression, told):
    pytest.importorskip("xacrodoc", reason="the extra 'xacro' is not installed")
    monkeypatch.setattr(xacro_process, "TIME_LIMIT", 5.0 if "2**32" in expression else 1.0)
    path = tmp_path / "arm.urdf.xacro"
    path.write_text(ARM.replace('xyz="0 0 1"', f'xyz="0 0 ${{{expression}}}"'))

    with pytest.raises(InputError, match=told):
        load_description(path)


def test_xacro_includes_are_found_beside_the_file_from_any_working_directory(tmp_path, monkeypatch):
    pytest.importorskip("xacrodoc", reason="the extra 'xacro' is not installed")
    named = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    include = '<xacro:include filename="{}"/>'
    (tmp_path / "parts").mkdir()
    (tmp_path / "arm.urdf.xacro").write_text(
        f'<robot name="arm" {named}>{include.format("parts/base.xacro")}'
        '<link name="${first}"/><link name="${second}"/>'
        "<xacro:property name='y' value=\"${xacro.load_yaml('parts/far.yaml')}\"/>"
        '<joint name="j" type="fixed"><parent link="${first}"/><child link="${second}"/>'
        "<origin xyz=\"${y['x']} 0 0\"/></joint></robot>"
    )
    (tmp_path / "parts" / "far.yaml").write_text("x: 2.5\n")
    (tmp_path / "parts" / "base.xacro").write_text(
        f"<robot {named}>{include.format('names.xacro')}"
        '<xacro:property name="first" value="base"/></robot>'
    )
    (tmp_path / "parts" / "names.xacro").write_text(
        f'<robot {named}><xacro:property name="second" value="hand"/></robot>'
    )
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)

    for path in (tmp_path / "arm.urdf.xacro", Path("..", "arm.urdf.xacro")):
        robot = load_description(path)
        assert sorted(robot.links) == ["base", "hand"]
        assert robot.joints["j"].origin.translation == (2.5, 0.0, 0.0)


def test_a_package_that_xacro_does_not_find_is_named_with_the_remedy(tmp_path):
    pytest.importorskip("xacrodoc", reason="the extra 'xacro' is not installed")
    path = tmp_path / "arm.urdf.xacro"
    include = '<xacro:include filename="$(find elsewhere)/wheel.xacro"/><link'
    robot = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'
    path.write_text(ARM.replace("<robot", robot, 1).replace("<link", include, 1))

    with pytest.raises(InputError, match=r"there is no package 'elsewhere': .*ROS_PACKAGE_PATH"):
        load_description(path)


@pytest.mark.skipif(not shutil.which("check_urdf"), reason="Debian's liburdfdom-tools is missing")
def test_urdfdom_takes_and_refuses_the_same(tmp_path):
    steel = '<material name="steel"><color rgba="0.5 0.5 0.5 1"/></material>'
    changes = [
        ("", ""),
        ('<mass value="2.5"/>', ""),
        ('ixy="0" ', ""),
        ('radius="0.1"', 'radius="thin"'),
        ('<box size="1 2 3"/>', "<cone/>"),
        ('xyz="0 0 0.5"', 'xyz="0 0"'),
        ('rgba="0.5 0.5 0.5 1"', 'rgba="grey"'),
        ('name="arm"', 'name=""'),
        ('name="arm"', ""),
        (steel, steel * 2),
        ('name="tool"', 'name="base"'),
        ('type="revolute"', 'type="revolut"'),
        ('xyz="0 0 1"', 'xyz="0 1"'),
        ('effort="10" ', ""),
        ('lower="-1" ', ""),
        ('<child link="upper"/>', '<child link="uper"/>'),
        ('<link name="tool"/>', '<link name="tool"/><link name="loose"/>'),
        ('<?xml version="1.0"?>', ""),
        ('<?xml version="1.0"?>', "<?xml verison='1.0'?>"),
        ('<?xml version="1.0"?>', "\n\n<?xml version='1.0'?>"),
        ("</robot>", "</robo>"),
    ]
    theirs, ours = [], []
    for number, (before, after) in enumerate(changes):
        file = tmp_path / f"{number}.urdf"
        file.write_text(ARM.replace(before, after, 1))
        told = subprocess.run(
            ["check_urdf", file], capture_output=True, check=False, timeout=PATIENCE
        )
        theirs.append((number, told.returncode == 0))
        try:
            load_description(file)
        except DescriptionError:
            ours.append((number, False))
        else:
            ours.append((number, True))

    assert ours == theirs
    assert {taken for _, taken in theirs} == {True, False}
