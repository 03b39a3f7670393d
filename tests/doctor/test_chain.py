"""Tests of the path between two links of a description, and of the reason for a failed lookup."""

import pytest

from tftool.base.errors import UsageError
from tftool.doctor.joint_chain import chained
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description

JOINT = '<parent link="{}"/><child link="{}"/><axis xyz="0 0 1"/>'
ARM = f"""<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="tool"/><link name="ball"/>
  <joint name="shoulder" type="continuous">{JOINT.format("base", "upper")}</joint>
  <joint name="elbow" type="revolute">{JOINT.format("upper", "lower")}
    <limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="shoulder" multiplier="2"/>
  </joint>
  <joint name="flange" type="fixed">{JOINT.format("lower", "tool")}</joint>
  <joint name="free" type="floating">{JOINT.format("tool", "ball")}</joint>
</robot>"""


def asked(target, source, **given):
    robot = Robot(parse_description(ARM))
    return chained(robot, given, target, source, "my arm.urdf")


def test_every_joint_on_the_way_is_told_with_its_position():
    found = asked("base", "tool", shoulder=0.25)

    assert found.available
    assert [(one.joint.name, one.position, one.leader) for one in found.links] == [
        ("flange", None, "flange"),
        ("elbow", 0.5, "shoulder"),
        ("shoulder", 0.25, "shoulder"),
    ]
    assert found.remedies == ()


def test_only_what_lies_between_the_two_links_is_told():
    assert [one.joint.name for one in asked("upper", "lower").links] == ["elbow"]
    assert [one.joint.name for one in asked("lower", "upper").links] == ["elbow"]
    assert asked("upper", "upper").links == ()


def test_a_joint_without_a_position_is_named_with_the_line_that_gives_it_one():
    found = asked("base", "tool")

    assert any("no position was given for shoulder" in why for why in found.why)
    (remedy,) = found.remedies
    assert remedy[1] == "tftool explain base tool 'my arm.urdf' --joint shoulder=0.5"


def test_a_mimic_that_is_driven_beyond_its_limits_is_told():
    found = asked("base", "tool", shoulder=0.75)
    assert any(
        "'elbow', which follows 'shoulder', is beyond its limits, -1 to 1 rad" in w
        for w in found.why
    )


def test_a_floating_joint_is_why_a_lookup_refuses():
    found = asked("base", "ball")

    assert not found.available
    assert (found.exception, found.cause) == ("LookupException", "split")
    assert [one.joint.name for one in found.links if not one.is_known] == ["free"]
    assert "floating" in found.why[0]
    assert "static_transform_publisher" in found.remedies[0][1]


@pytest.mark.parametrize(
    ("name", "why", "cure"),
    [
        ("tol", "'tol' is not a link of robot 'arm'", "did you mean tool?"),
        ("/tool", "'/tool' is not a link", "leave out ROS 1's leading slash: tool"),
        ("elbow", "'elbow' is a joint of robot 'arm'", "look up the link that it moves: lower"),
        ("wheel", "'wheel' is not a link", "its links are base, upper, lower, tool, ball"),
    ],
)
def test_a_name_that_is_no_link_is_told_with_what_was_meant(name, why, cure):
    found = asked("base", name)

    assert not found.available
    assert found.cause == "unknown-frame"
    assert found.why[0].startswith(why)
    assert found.remedies[0][0] == cure


def test_a_joint_that_is_none_is_refused():
    with pytest.raises(UsageError, match="no joint 'wrist'"):
        asked("base", "tool", wrist=1.0)
