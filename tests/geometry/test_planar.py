import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import angles, numbers
from tftool.geometry import rigid
from tftool.geometry.rigid import Transform


@given(numbers, numbers, angles)
def test_a_pose_in_the_plane_comes_back(x, y, heading):
    pose = rigid.transform_from_pose(x, y, heading)

    assert pose.translation == (x, y, 0.0)
    assert pose.rotation == (0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2))
    back = math.remainder(rigid.heading(pose) - heading, math.tau)
    assert back == pytest.approx(0.0, abs=1e-12)


@given(st.floats(-1e6, 1e6))
def test_a_wrapped_angle_is_the_same_direction_in_the_range(angle):
    wrapped = rigid.wrap(angle)

    assert -math.pi <= wrapped < math.pi
    assert math.remainder(wrapped - angle, math.tau) == pytest.approx(0.0, abs=1e-9)


@given(st.floats(-math.pi, math.pi, exclude_max=True))
def test_an_angle_in_the_range_stays_to_the_last_bit(angle):
    assert rigid.wrap(angle) == angle


def test_bearing_and_distance_point_at_the_other_origin():
    other = Transform((3, 4, 9))

    assert rigid.bearing(other) == math.atan2(4, 3)
    assert rigid.bearing(Transform()) == 0.0


def test_the_heading_of_a_tilted_pose_is_its_yaw():
    tilted = Transform(
        (0, 0, 0), (0.034270798550482, 0.106020511061796, 0.143572175027392, 0.983347443256356)
    )

    assert rigid.heading(tilted) == pytest.approx(0.3)
