import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from tests.strategies import angles, rotations
from tftool.geometry import conversions, quaternions

pitches = st.floats(-1.5, 1.5)

NEAR_A_POLE = 1e-5


@given(angles, pitches, angles)
def test_roll_pitch_yaw_come_back(roll, pitch, yaw):
    turned = conversions.quaternion_from_rpy(roll, pitch, yaw)

    back = conversions.rpy_from_quaternion(turned)

    for found, wanted in zip(back, (roll, pitch, yaw), strict=True):
        assert math.remainder(found - wanted, math.tau) == pytest.approx(0.0, abs=1e-6)


@given(rotations)
def test_either_set_of_angles_means_the_same_rotation(turn):
    for angles_of in (
        conversions.rpy_from_quaternion,
        conversions.second_rpy_from_quaternion,
    ):
        again = conversions.quaternion_from_rpy(*angles_of(turn))
        # Near the poles, two of the three angles become one, which loses this accuracy.
        assert quaternions.angle_between(again, turn) < NEAR_A_POLE


@given(angles, st.sampled_from([-math.pi / 2, math.pi / 2]), angles)
def test_at_the_poles_the_angles_still_mean_the_same_rotation(roll, pitch, yaw):
    turned = conversions.quaternion_from_rpy(roll, pitch, yaw)

    found = conversions.rpy_from_quaternion(turned)

    again = conversions.quaternion_from_rpy(*found)
    assert quaternions.angle_between(again, turned) < NEAR_A_POLE
    assert abs(found[1]) == pytest.approx(math.pi / 2, abs=NEAR_A_POLE)
    assert conversions.second_rpy_from_quaternion((0.5, 0.5, -0.5, 0.5)) == pytest.approx(
        conversions.rpy_from_quaternion((0.5, 0.5, -0.5, 0.5))
    )


@given(rotations)
def test_matrices_come_back(turn):
    matrix = conversions.matrix_from_quaternion(turn)

    found = conversions.quaternion_from_matrix(matrix)

    assert quaternions.angle_between(found, turn) < 1e-7


def test_a_homogeneous_matrix_is_read_by_its_upper_left():
    quarter = [[0, -1, 0, 7], [1, 0, 0, 8], [0, 0, 1, 9], [0, 0, 0, 1]]

    found = conversions.quaternion_from_matrix(quarter)

    assert found == pytest.approx((0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))


@pytest.mark.parametrize(
    ("matrix", "told"),
    [
        ([[1, 0, 0], [0, 1, 0], [0, 0, -1]], "mirrors"),
        ([[2, 0, 0], [0, 1, 0], [0, 0, 1]], "not a rotation"),
        ([[math.nan] * 3] * 3, "not a rotation"),
        ([[1, 0], [0, 1]], "three rows"),
        (7, "three rows"),
    ],
)
def test_a_matrix_that_is_not_a_rotation_is_refused(matrix, told):
    with pytest.raises(ValueError, match=told):
        conversions.quaternion_from_matrix(matrix)


@given(rotations)
@example((0.0, 0.0, 2.07e-161, 1.0))
@example((5e-324, 5e-324, 0.0, 1.0))
def test_axis_and_angle_come_back(turn):
    axis, angle = conversions.axis_angle_from_quaternion(turn)

    assert 0.0 <= angle <= math.pi
    assert math.hypot(*axis) == pytest.approx(1.0)
    again = conversions.quaternion_from_axis_angle(axis, angle)
    assert quaternions.angle_between(again, turn) < 1e-7


def test_no_turn_has_an_axis_all_the_same():
    assert conversions.axis_angle_from_quaternion((0, 0, 0, -1)) == ((1.0, 0.0, 0.0), 0.0)


@pytest.mark.parametrize("axis", [(0, 0, 0), (math.inf, 0, 0), (math.nan, 0, 0)])
def test_a_turn_needs_an_axis(axis):
    with pytest.raises(ValueError, match="is not an axis"):
        conversions.quaternion_from_axis_angle(axis, 1.0)


def test_w_goes_first_for_others_and_last_for_us():
    assert conversions.wxyz_from_xyzw((1, 2, 3, 4)) == (4, 1, 2, 3)
    assert conversions.xyzw_from_wxyz((4, 1, 2, 3)) == (1, 2, 3, 4)


@given(angles, pitches, angles)
def test_transforms3d_agrees_about_roll_pitch_yaw(roll, pitch, yaw):
    ours = conversions.quaternion_from_rpy(roll, pitch, yaw)

    assert conversions.quaternion_from_euler((roll, pitch, yaw), "sxyz") == pytest.approx(ours)
    theirs = conversions.euler_from_quaternion(ours, "sxyz")
    # Half a turn is the same rotation with either sign.
    apart = zip(theirs, conversions.rpy_from_quaternion(ours), strict=True)
    assert [math.remainder(a - b, math.tau) for a, b in apart] == pytest.approx([0, 0, 0], abs=1e-6)


@given(angles, pitches, angles, st.sampled_from(conversions.AXES))
def test_every_order_of_axes_means_three_turns_one_after_the_other(first, second, third, axes):
    turned = conversions.quaternion_from_euler((first, second, third), axes)

    by_scipy = Rotation.from_euler(
        axes[1:] if axes[0] == "s" else axes[1:].upper(), [first, second, third]
    )
    assert quaternions.angle_between(turned, tuple(by_scipy.as_quat())) < 1e-7
    for found in (
        conversions.euler_from_quaternion(turned, axes),
        conversions.euler_from_matrix(conversions.matrix_from_quaternion(turned), axes),
    ):
        again = conversions.quaternion_from_euler(found, axes)
        assert quaternions.angle_between(again, turned) < NEAR_A_POLE


def test_there_are_24_orders_of_axes_and_what_is_none_is_refused():
    assert len(set(conversions.AXES)) == 24
    for axes in ("xyz", "sxxz", "qxyz", "", None):
        with pytest.raises(ValueError, match="is not an order of axes: write 's'"):
            conversions.quaternion_from_euler((0, 0, 0), axes)
        with pytest.raises(ValueError, match="is not an order of axes"):
            conversions.euler_from_quaternion((0, 0, 0, 1), axes)
        with pytest.raises(ValueError, match="such as 'sxyz'"):
            conversions.euler_from_matrix(((1, 0, 0), (0, 1, 0), (0, 0, 1)), axes)


@given(
    st.floats(-math.pi, math.pi),
    st.sampled_from([-1.0, 1.0]),
    st.floats(1e-16, 1.0).map(lambda gap: gap**8) | st.floats(0.0, 1.0),
    st.floats(-math.pi, math.pi),
)
def test_precise_angles_give_the_rotation_back_near_the_poles(roll, side, gap, yaw):
    turn = conversions.quaternion_from_rpy(roll, side * (0.5 * math.pi - gap), yaw)

    back = conversions.quaternion_from_rpy(*conversions.precise_rpy_from_quaternion(turn))

    assert quaternions.angle_between(turn, back) < 1e-12
    assert all(abs(angle) <= math.pi for angle in conversions.precise_rpy_from_quaternion(turn))


@given(st.floats(-3.0, 3.0), st.floats(-1.5, 1.5), st.floats(-3.0, 3.0))
def test_precise_angles_are_the_angles(roll, pitch, yaw):
    found = conversions.precise_rpy_from_quaternion(
        conversions.quaternion_from_rpy(roll, pitch, yaw)
    )

    assert found == pytest.approx((roll, pitch, yaw), abs=1e-11)


def test_the_nearest_rotation_to_a_rounded_matrix_is_said_with_how_far_it_is():
    rows, apart = conversions.nearest_rotation(
        [[0.0, -1.004, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    )

    assert np.allclose(rows, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-12)
    assert apart == pytest.approx(0.004)
    assert conversions.nearest_rotation(np.zeros((3, 3)))[1] == math.inf
    assert conversions.nearest_rotation(-np.eye(3))[1] == math.inf
