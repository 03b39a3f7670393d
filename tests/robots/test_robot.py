import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import tftool
from tftool.base.errors import UsageError
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description

TEXT = """<robot name="crane">
  <link name="base"/><link name="boom"/><link name="hook"/><link name="claw"/><link name="eye"/>
  <joint name="turn" type="continuous">
    <origin xyz="0 0 2"/><axis xyz="0 0 1"/><parent link="base"/><child link="boom"/>
  </joint>
  <joint name="reach" type="prismatic">
    <origin rpy="0 0 1.5707963267948966"/><axis xyz="1 0 0"/>
    <parent link="boom"/><child link="hook"/>
    <limit lower="1" upper="5" effort="1" velocity="1"/>
  </joint>
  <joint name="grip" type="revolute">
    <axis xyz="0 1 0"/><parent link="hook"/><child link="claw"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/>
    <mimic joint="reach" multiplier="-2" offset="0.5"/>
  </joint>
  <joint name="look" type="revolute">
    <axis xyz="0 1 0"/><parent link="claw"/><child link="eye"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/>
    <mimic joint="grip" multiplier="3" offset="1"/>
  </joint>
</robot>"""


@pytest.fixture
def crane():
    return Robot(parse_description(TEXT))


def test_it_says_what_it_is(crane):
    links, joints = TEXT.count("<link "), TEXT.count("<joint ")
    assert repr(crane) == f"<Robot 'crane': {links} links, {joints} joints>"


def poses(robot, positions):
    return {one.child_frame_id: one.transform for one in robot.transforms(positions)}


def test_joints_rest_at_zero_or_in_the_middle_of_their_limits(crane):
    assert crane.positions() == {
        "turn": 0.0,
        "reach": 3.0,
        "grip": -2 * 3.0 + 0.5,
        "look": 3 * (-2 * 3.0 + 0.5) + 1.0,
    }


def test_a_joint_turns_about_its_axis_and_slides_along_it(crane):
    found = poses(crane, {"turn": math.pi / 2, "reach": 4.0})

    assert found["boom"].apply((1, 0, 0)) == pytest.approx((0, 1, 2))
    assert found["hook"].translation == pytest.approx((0, 4, 0))


def test_mimics_follow_their_leader_unless_they_have_a_position(crane):
    assert crane.positions({"reach": 1.0})["look"] == 3 * (-2 * 1.0 + 0.5) + 1.0
    assert crane.positions({"reach": 1.0, "grip": 0.25})["grip"] == 0.25
    assert crane.positions({"reach": 1.0, "grip": 0.25})["look"] == 3 * 0.25 + 1.0


def test_joints_that_mimic_each_other_stand_for_themselves():
    text = TEXT.replace('joint="reach"', 'joint="look"')

    circle = Robot(parse_description(text))

    assert circle.positions({"reach": 1.0})["grip"] == 0.0
    assert any("mimics itself" in note for note in circle.notes)


@pytest.mark.parametrize(
    ("positions", "told"),
    [
        ({"tern": 1.0}, "no joint 'tern'; did you mean 'turn'?"),
        ({"turn": math.nan}, "give a finite number"),
    ],
)
def test_a_wrong_position_is_a_sentence(crane, positions, told):
    with pytest.raises(UsageError, match=told.replace("?", r"\?")):
        crane.transforms(positions)


def test_a_fixed_joint_takes_no_position():
    fixed = Robot(parse_description(TEXT.replace('type="continuous"', 'type="fixed"')))

    with pytest.raises(UsageError, match="is fixed, so it has no position"):
        fixed.positions({"turn": 1.0})


def test_a_floating_joint_gives_no_frame():
    loose = Robot(parse_description(TEXT.replace('type="continuous"', 'type="floating"')))

    assert "boom" not in poses(loose, {})
    (note,) = loose.notes
    assert "floating joints are left out" in note
    assert note.endswith("no pose in their parents: boom")


@given(st.lists(st.tuples(st.floats(-10, 10), st.floats(-10, 10)), min_size=1, max_size=5))
def test_the_batch_is_each_state_by_itself(states):
    crane = Robot(parse_description(TEXT))

    columns = crane.batch(["turn", "reach"], states)

    assert [one.joint.name for one in columns] == ["turn", "reach", "grip", "look"]
    for row, (turn, reach) in enumerate(states):
        single = poses(crane, {"turn": turn, "reach": reach})
        for one in columns:
            pose = single[one.joint.child]
            assert one.translations[row] == pytest.approx(pose.translation, abs=1e-12)
            assert one.rotations[row] == pytest.approx(pose.rotation, abs=1e-12)


def test_the_batch_leaves_out_joints_that_were_not_given(crane):
    assert [one.joint.name for one in crane.batch(["turn"], [[1.0]])] == ["turn"]


def test_the_batch_refuses_a_shape_that_does_not_fit(crane):
    with pytest.raises(ValueError, match=r"\(n, 2\)"):
        crane.batch(["turn", "reach"], np.zeros((4, 3)))


def test_a_robots_buffer_answers_lookups_between_any_links(crane):
    buffer = crane.buffer({"turn": math.pi / 2, "reach": 4.0, "grip": 0.0})

    found = buffer.lookup_transform("base", "claw").transform

    # After two quarter turns, the boom's y axis, along which the hook slides, points to -x.
    assert found.translation == pytest.approx((-4, 0, 2))


def test_forward_kinematics_agrees_with_another_implementation(tmp_path):
    yourdfpy = pytest.importorskip("yourdfpy", reason="yourdfpy is not installed")
    path = tmp_path / "crane.urdf"
    path.write_text(TEXT)
    other = yourdfpy.URDF.load(str(path))
    robot = tftool.load_urdf(path)
    random = np.random.default_rng(5)

    for turn, reach in random.uniform(-5, 5, (50, 2)):
        other.update_cfg({"turn": turn, "reach": reach})
        ours = robot.buffer({"turn": turn, "reach": reach})
        # yourdfpy follows one mimic joint, but no chain of them, so the eye is left out.
        expected = other.get_transform("claw", "base")
        found = ours.lookup_transform("base", "claw").transform.matrix()
        assert np.allclose(found, expected, atol=1e-12)
