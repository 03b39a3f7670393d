import copy
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given

from tests.strategies import transforms, vectors
from tftool.buffer.sample import TransformStamped
from tftool.geometry import quaternions, rigid
from tftool.geometry.rigid import IDENTITY, Quaternion, Transform, Vector3


def same(found, wanted, tolerance=1e-9):
    return found.translation == pytest.approx(wanted.translation, abs=tolerance) and (
        quaternions.angle_between(found.rotation, wanted.rotation) < tolerance
    )


@given(transforms)
def test_an_inverse_undoes(a_from_b):
    assert same(a_from_b @ a_from_b.inverse(), IDENTITY)
    assert same(a_from_b.inverse() @ a_from_b, IDENTITY)
    assert same(a_from_b.inverse().inverse(), a_from_b)


@given(transforms, transforms, transforms)
def test_chains_associate(a_from_b, b_from_c, c_from_d):
    assert same((a_from_b @ b_from_c) @ c_from_d, a_from_b @ (b_from_c @ c_from_d))


@given(transforms, transforms, vectors)
def test_applying_a_product_is_applying_one_after_the_other(a_from_b, b_from_c, point):
    one_by_one = a_from_b.apply(b_from_c.apply(point))

    assert (a_from_b @ b_from_c).apply(point) == pytest.approx(one_by_one, abs=1e-9)


@given(transforms, vectors)
def test_the_matrix_moves_points_as_apply_does(a_from_b, point):
    rows = a_from_b.matrix()
    by_matrix = [sum(row[k] * point[k] for k in range(3)) + row[3] for row in rows[:3]]

    assert a_from_b.apply(point) == pytest.approx(by_matrix, abs=1e-9)
    assert rows[3] == (0.0, 0.0, 0.0, 1.0)


@given(transforms, vectors)
def test_rotate_is_apply_without_the_translation(a_from_b, vector):
    moved = Vector3(
        *(a - b for a, b in zip(a_from_b.apply(vector), a_from_b.translation, strict=True))
    )

    assert a_from_b.rotate(vector) == pytest.approx(moved, abs=1e-9)


def test_a_transform_is_a_value():
    one = Transform((1, 2, 3), [0, 0, 0, 1])

    assert one == Transform((1.0, 2.0, 3.0))
    assert hash(one) == hash(Transform((1.0, 2.0, 3.0)))
    assert one.translation == Vector3(1.0, 2.0, 3.0)
    assert isinstance(one.translation.x, float)
    assert isinstance(one.rotation, Quaternion)
    assert pickle.loads(pickle.dumps(one)) == one
    assert copy.deepcopy(one) == one
    with pytest.raises(AttributeError):
        one.translation = (0, 0, 0)
    assert Transform.identity() == Transform()


@pytest.mark.parametrize(
    ("translation", "rotation", "told"),
    [
        ((1, 2), (0, 0, 0, 1), "a translation is 3 numbers, not 2"),
        ((1, 2, 3), (0, 0, 1), "a rotation is 4 numbers, not 3"),
        (("x", 2, 3), (0, 0, 0, 1), "a translation is 3 numbers, not"),
        (None, (0, 0, 0, 1), "a translation is 3 numbers, not None"),
        ((1, 2, 3), (0, 0, 0, 0), r"the identity is \(0, 0, 0, 1\)"),
    ],
)
def test_an_invalid_translation_or_rotation_is_refused_with_the_reason(translation, rotation, told):
    with pytest.raises(ValueError, match=told):
        Transform(translation, rotation)


def test_the_quaternion_is_kept_but_its_length_does_not_matter():
    twice = Transform((1, 0, 0), (0, 0, 2, 0))

    assert twice.rotation == (0, 0, 2, 0)
    assert twice.apply((1, 2, 3)) == (0, -2, 3)
    assert (twice @ twice).rotation == (0, 0, 0, -1)
    assert rigid.canonical(twice).rotation == (0, 0, 1, 0)


def test_a_zero_quaternion_makes_results_nan_and_nothing_worse():
    nothing = rigid.transform((1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))

    assert math.isnan(nothing.apply((1, 2, 3)).x)
    assert math.isnan(nothing.matrix()[0][0])


def test_coinciding_origins_differ_by_exactly_nothing():
    at = (5.544445, 2.3, 0.0)
    leader = Transform(at, (0, 0, math.sin(0.7), math.cos(0.7)))
    follower = Transform(at, (0, 0, math.sin(-1.1), math.cos(-1.1)))

    assert (follower.inverse() @ leader).translation == (0.0, 0.0, 0.0)


def test_distance_is_between_the_origins():
    assert rigid.distance(Transform((3, 4, 12))) == 13.0


def test_vectors_add_subtract_and_scale():
    a, b = Vector3(1.0, 2.0, 3.0), Vector3(0.5, 0.0, -1.0)

    assert a + b == Vector3(1.5, 2.0, 2.0)
    assert a - b == Vector3(0.5, 2.0, 4.0)
    assert 2 * a == a * 2.0 == Vector3(2.0, 4.0, 6.0)
    assert a / 2.0 == Vector3(0.5, 1.0, 1.5)
    assert -a == Vector3(-1.0, -2.0, -3.0)
    assert a.cross(b) == Vector3(-2.0, 2.5, -1.0)
    ones = (1, 1, 1)
    assert a + ones == ones + a == Vector3(2.0, 3.0, 4.0)
    assert ones - a == Vector3(0.0, -1.0, -2.0)
    assert sum([a, b], Vector3(0.0, 0.0, 0.0)) == a + b
    assert isinstance(a + b, Vector3)
    assert (np.array([1.0, 0.0, 0.0]) + a).tolist() == [2.0, 2.0, 3.0]
    assert (a + np.array([1.0, 0.0, 0.0])).tolist() == [2.0, 2.0, 3.0]
    assert (a * np.array([1.0, 0.0, 2.0])).tolist() == [1.0, 0.0, 6.0]


@pytest.mark.parametrize("other", [(1, 2), "abc", [1, 2, 3], None, Quaternion(0, 0, 0, 1)])
def test_a_vector_adds_to_nothing_but_vectors(other):
    with pytest.raises(TypeError):
        Vector3(1.0, 2.0, 3.0) + other
    with pytest.raises(TypeError):
        other - Vector3(1.0, 2.0, 3.0)
    with pytest.raises(TypeError):
        Vector3(1.0, 2.0, 3.0) * other


@pytest.mark.parametrize(
    "value",
    [
        Quaternion(0.0, 0.0, 0.0, 1.0),
        Transform(),
        TransformStamped(1, "a", "b", Transform()),
    ],
)
def test_other_values_are_neither_put_together_nor_repeated(value):
    name, plain = type(value).__name__, (1, 2)
    for compute in (
        lambda: value + value,
        lambda: value * 2,
        lambda: 2 * value,
        lambda: plain + value,
    ):
        with pytest.raises(TypeError, match=f"a {name} does not support"):
            compute()


@pytest.mark.parametrize("module", ["geometry.rigid", "geometry.conversions", "buffer.buffer"])
def test_the_scalar_path_loads_no_numpy(module):
    code = (
        f"import sys, tftool.{module}; "
        "print([name for name in ('numpy', 'rich', 'asyncio', 'logging') if name in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert told.stdout.strip() == "[]"


@given(transforms)
def test_a_matrix_gives_its_transform_back(a_from_b):
    assert same(Transform.from_matrix(a_from_b.matrix()), a_from_b, 1e-6)
    assert same(Transform.from_matrix(np.array(a_from_b.matrix())), a_from_b, 1e-6)


@pytest.mark.parametrize(
    ("matrix", "said"),
    [
        (np.eye(3), "4 numbers, not 3"),
        (np.eye(4)[:3], "not of 3 rows"),
        ([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 2, 3, 1]], "transpose the matrix"),
        (np.diag([2.0, 2.0, 2.0, 1.0]), "not a rotation"),
        (np.diag([1.0, 1.0, -1.0, 1.0]), "mirrors"),
        (np.full((4, 4), np.nan), "not a rotation"),
        (7, "4×4 numbers"),
    ],
)
def test_a_matrix_that_is_no_transform_is_refused(matrix, said):
    with pytest.raises(ValueError, match=said):
        Transform.from_matrix(matrix)


def test_a_quaternion_chains_inverts_and_shows_its_angles():
    quarter = Quaternion.from_rpy(0.0, 0.0, math.pi / 2)

    assert quarter == pytest.approx((0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))
    assert (quarter @ quarter).rpy() == pytest.approx((0.0, 0.0, math.pi))
    assert quarter.inverse().rpy() == pytest.approx((0.0, 0.0, -math.pi / 2))
    assert Quaternion(0.0, 0.0, 2.0, 2.0) @ quarter.inverse() == pytest.approx((0, 0, 0, 1))
    with pytest.raises(TypeError, match="unsupported operand"):
        quarter @ (1.0, 2.0, 3.0)


def test_a_vector_has_a_length():
    assert Vector3(3.0, -4.0, 12.0).norm() == 13.0
