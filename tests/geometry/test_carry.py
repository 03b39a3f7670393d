import numpy as np
import pytest
from hypothesis import given

from tests.strategies import transforms, vectors
from tftool.geometry import quantities as carry
from tftool.geometry import quaternions
from tftool.geometry.rigid import Transform, transform


@given(transforms, vectors, vectors)
def test_a_wrench_does_the_same_work_in_either_frame(a_from_b, first, second):
    force, torque = first, second
    linear, angular = second, first

    power_in_b = np.dot(force, linear) + np.dot(torque, angular)
    moved_force, moved_torque = carry.wrench(a_from_b, force, torque)

    # The power is computed from the velocity of the same body at the origin of a.
    spin = a_from_b.rotate(angular)
    speed = a_from_b.rotate(linear) + np.cross(a_from_b.translation, spin)
    power_in_a = np.dot(moved_force, speed) + np.dot(moved_torque, spin)
    assert power_in_a == pytest.approx(power_in_b, rel=1e-6, abs=1e-5)


@given(transforms)
def test_a_covariance_is_turned_like_its_blocks(a_from_b):
    covariance = np.arange(36.0).reshape(6, 6)
    turn = np.array(quaternions.matrix(a_from_b.rotation))
    both = np.kron(np.eye(2), turn)

    found = carry.covariance(a_from_b, covariance.ravel())

    assert np.array(found) == pytest.approx((both @ covariance @ both.T).ravel(), abs=1e-9)


@given(transforms, vectors)
def test_many_points_move_as_one_does(a_from_b, place):
    found = carry.points(a_from_b, [place, (0, 0, 0)])

    assert found[0] == pytest.approx(carry.point(a_from_b, place), abs=1e-9)
    assert found[1] == pytest.approx(a_from_b.translation, abs=1e-9)


@pytest.mark.parametrize("shape", [(3,), (2, 2), (1, 3, 1)])
def test_points_of_another_shape_are_refused(shape):
    with pytest.raises(ValueError, match=r"the shape \(n, 3\), not"):
        carry.points(Transform(), np.zeros(shape))


def test_a_covariance_of_another_size_is_refused():
    with pytest.raises(ValueError, match="36 numbers, not 9"):
        carry.covariance(Transform(), [0.0] * 9)


def test_a_transform_without_rotation_numbers_only_moves():
    no_rotation = transform((1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 0.0))

    assert carry.point(no_rotation, (1, 1, 1)) == (2, 3, 4)
    assert carry.vector(no_rotation, (1, 1, 1)) == (1, 1, 1)
    assert carry.pose(no_rotation, no_rotation) == Transform((2, 4, 6))
