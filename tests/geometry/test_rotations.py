"""Tests of pasted rotations against scipy and transforms3d."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from tftool import Transform, UsageError
from tftool.geometry.conversions import AXES
from tftool.geometry.notation.rotations import read

HALF = math.sqrt(0.5)
QUARTER = (0.0, 0.0, HALF, HALF)
"""Quaternion of a quarter turn to the left."""

PASTED = {
    "brackets": ("[0, 0, 0.7, 0.7]", "xyzw"),
    "w first": ("0.7 0 0 0.7", "wxyz"),
    "named in the text": ("xyzw: 0 0 0.7071068 0.7071068", None),
    "ROS's YAML": ("rotation:\n  x: 0.0\n  y: 0.0\n  z: 0.7071068\n  w: 0.7071068\n", None),
    "YAML in one line": ("{w: 0.7071068, x: 0.0, y: 0.0, z: 0.7071068}", None),
    "JSON": ('{"x": 0.0, "y": 0.0, "z": 0.7071068, "w": 0.7071068}', None),
    "rclpy's repr": ("geometry_msgs.msg.Quaternion(x=0.0, y=0.0, z=0.7071068, w=0.7071068)", None),
    "numpy's print": ("[[ 0. -1.  0.]\n [ 1.  0.  0.]\n [ 0.  0.  1.]]", None),
    "numpy's repr": (
        "array([[ 0., -1.,  0.],\n       [ 1.,  0.,  0.],\n       [ 0.,  0.,  1.]], dtype=float32)",
        None,
    ),
    "rounded by its printer": ("0.0008 -1.0 0\n1.0 0.0008 0\n0 0 1", None),
    "roll pitch yaw": ("rpy 0 0 1.5707963", None),
    "with π": ("0 0 pi/2", "rpy"),
    "yaw pitch roll": ("[1.5707963, 0, 0]", "ypr"),
    "degrees, said in the text": ("rpy 0 0 90 deg", None),
    "labelled angles": ("roll: 0.0 pitch: 0.0 yaw: 1.5707963", None),
    "labelled angles with π": ("yaw: ${pi/2}", None),
    "axis and angle": ("axis [0, 0, 2] angle 90°", None),
    "rotation vector": ("0 0 1.5707963", "rotvec"),
    "rotating z y x": ("1.5707963 0 0", "rzyx"),
    "xacro": ('<origin rpy="0 0 ${pi/2}"/>', None),
}


@pytest.mark.parametrize(("text", "form"), PASTED.values(), ids=PASTED)
def test_a_quarter_turn_is_read_however_it_is_pasted(text, form):
    found = read(text, form)

    assert not found.has_translation
    assert np.allclose(found.transform.rotation, QUARTER, atol=1e-3)
    assert math.isclose(math.hypot(*found.transform.rotation), 1.0, abs_tol=1e-12)


POSES = {
    "tf2_echo's block": "At time 0.0\n- Translation: [1.000, -2.000, 3.000]\n- Rotation: in "
    "Quaternion (xyzw) [0.000, 0.000, 0.707, 0.707]\n- Rotation: in RPY (radian) [0, 0, 1.571]\n",
    "ROS 1's tf_echo": "At time 1.5\n- Translation: [1.000, -2.000, 3.000]\n- Rotation: in "
    "Quaternion [0.000, 0.000, 0.707, 0.707]\n            in RPY (radian) [0, 0, 1.571]",
    "URDF": '<origin xyz="1 -2 3" rpy="0 0 1.5707963"/>',
    "SDF": '<origin xyz="1 -2 3" rpy="0 0 90" degrees="true"/>',
    "old words": "ros2 run tf2_ros static_transform_publisher 1 -2 3 1.5707963 0 0 map odom",
    "ROS 1's words": "rosrun tf static_transform_publisher 1 -2 3 1.5707963 0 0 map odom 100",
    "new words": "ros2 run tf2_ros static_transform_publisher --x 1 --y -2 --z 3 --yaw 1.5707963 "
    "--frame-id map --child-frame-id odom",
    "its options alone": "--x 1 --y -2 --z=3 --qz 0.7071068 --qw 0.7071068",
    "4×4 matrix": "[[0, -1, 0, 1], [1, 0, 0, -2], [0, 0, 1, 3], [0, 0, 0, 1]]",
    "3×4 matrix": "0 -1 0 1 1 0 0 -2 0 0 1 3",
    "TransformStamped": "header:\n  stamp:\n    sec: 7\n    nanosec: 5\n  frame_id: x\n"
    "child_frame_id: y\ntransform:\n  translation:\n    x: 1.0\n    y: -2.0\n    z: 3.0\n"
    "  rotation:\n    x: 0.0\n    y: 0.0\n    z: 0.7071068\n    w: 0.7071068\n",
    "w first": "translation: {x: 1, y: -2, z: 3}, "
    "rotation: {w: 0.7071068, x: 0, y: 0, z: 0.7071068}",
    "q names": "x: 1 y: -2 z: 3 qx: 0 qy: 0 qz: 0.7071068 qw: 0.7071068",
}


@pytest.mark.parametrize("text", POSES.values(), ids=POSES)
def test_a_pose_is_read_however_it_is_pasted(text):
    found = read(text)

    assert found.has_translation
    assert found.transform.translation == (1.0, -2.0, 3.0)
    assert np.allclose(found.transform.rotation, QUARTER, atol=1e-6)


@pytest.mark.parametrize(
    ("text", "form", "told"),
    [
        ("0 0 0.7 0.7", None, "--as xyzw or --as wxyz"),
        ("0 0 1.57", None, "--as rpy"),
        ("", None, "no number"),
        ("0 0 0 0", "xyzw", "four zeros"),
        ("0 0 0 0", "axis-angle", "not an axis"),
        ("1 2 3 4 5 6 7 8 9", None, "not a rotation"),
        ("90deg", None, "^1 number is not a rotation: give 4 numbers"),
        ("1 2", None, "^2 numbers are not a rotation: give 4 numbers"),
        ("1 0 0 0 1 0 0 0 -1", None, "mirrors"),
        ("1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1", None, "column by column"),
        ("0 0 wat 1", "xyzw", "'wat'"),
        ("0 0 nan 1", "xyzw", "'nan'"),
        ("0 0 1e999 1", "xyzw", "too large"),
        ("0 0 1", "xyzw", "needs 4 numbers, but there are 3"),
        ("0 0 pi/0", "rpy", "divides by zero"),
        ("0 0 1", "zyxw", "not a notation"),
        ("x: 0 y: 0 z: 0 w: 0", None, "four zeros"),
        ("static_transform_publisher 1 2 3", None, "8 words"),
        ("static_transform_publisher '1 2 3", None, "quote"),
        ('<origin rpy="0 0 left"/>', None, "'left'"),
        ('<origin rpy="0 0"/>', None, "needs 3"),
        ("7" * (2 << 20), None, "longer than"),
    ],
)
def test_an_invalid_or_ambiguous_rotation_is_refused_with_the_reason(text, form, told):
    with pytest.raises(UsageError, match=told):
        read(text, form)


def test_a_quaternion_that_is_scaled_is_said():
    assert "length 0.989949" in read("0 0 0.7 0.7", "xyzw").notes[0]
    assert read("0 0 0.70711 0.70711", "xyzw").notes == ()


def test_radians_that_look_like_degrees_are_said():
    assert "--degrees" in read("0 0 90", "rpy").notes[0]


@pytest.mark.parametrize("axes", AXES)
def test_every_order_of_axes_is_scipys(axes):
    angles = (0.3, -0.4, 1.2)
    # scipy uses capital letters for rotating axes, and small letters for fixed ones.
    order = axes[1:].upper() if axes[0] == "r" else axes[1:]
    wanted = Rotation.from_euler(order, angles)

    found = read("0.3, -0.4, 1.2", axes).transform.rotation

    assert (Rotation.from_quat(found) * wanted.inv()).magnitude() < 1e-14


numbers = st.floats(-1.0, 1.0, allow_nan=False)


@settings(max_examples=30)
@given(st.tuples(numbers, numbers, numbers, numbers).filter(lambda q: math.hypot(*q) > 1e-3))
def test_every_way_out_is_a_way_in(turn):
    from tftool.drawing.notation_view import TARGETS, alone

    pose = Transform(
        (0.25, -1e-7, 12345.678), read(" ".join(map(str, turn)), "xyzw").transform.rotation
    )
    # transforms3d's angles lose digits near their poles, which have a test of their own.
    for form in (one for one in TARGETS if one not in AXES):
        text = alone(pose, form)
        bare = None if form in ("matrix4", "urdf", "static") else form

        back = read(text, bare).transform

        apart = Rotation.from_quat(back.rotation) * Rotation.from_quat(pose.rotation).inv()
        assert apart.magnitude() < 1e-12, form
        if bare is None:
            assert back.translation == pose.translation
