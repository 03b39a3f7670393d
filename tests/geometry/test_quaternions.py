import math

import pytest
from hypothesis import given

from tests.strategies import angles, fractions, rotations, vectors
from tftool.geometry import quaternions
from tftool.geometry.quaternions import IDENTITY


def same(found, wanted, tolerance=1e-12):
    return quaternions.angle_between(found, wanted) < tolerance


@given(rotations, rotations, rotations)
def test_products_associate(a, b, c):
    left = quaternions.multiply(quaternions.multiply(a, b), c)
    right = quaternions.multiply(a, quaternions.multiply(b, c))

    assert left == pytest.approx(right, abs=1e-14)


@given(rotations)
def test_a_rotation_and_its_conjugate_undo_each_other(turn):
    assert same(quaternions.multiply(turn, quaternions.conjugate(turn)), IDENTITY)


@given(rotations, vectors)
def test_turning_a_vector_is_what_its_matrix_does(turn, vector):
    by_matrix = [sum(row[k] * vector[k] for k in range(3)) for row in quaternions.matrix(turn)]

    assert quaternions.rotate(turn, vector) == pytest.approx(by_matrix, abs=1e-11)


def out_of_a_matrix(m):
    """Convert a matrix to a quaternion as tf2 does, with the canonical sign of the spec."""
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0.0:
        w = 0.5 * math.sqrt(trace + 1.0)
        vector = (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1])
        return (*(part / (4.0 * w) for part in vector), w)
    i = max(range(3), key=lambda n: m[n][n])
    j, k = (i + 1) % 3, (i + 2) % 3
    q = [0.0, 0.0, 0.0]
    q[i] = 0.5 * math.sqrt(m[i][i] - m[j][j] - m[k][k] + 1.0)
    q[j], q[k] = (m[j][i] + m[i][j]) / (4.0 * q[i]), (m[k][i] + m[i][k]) / (4.0 * q[i])
    return (*q, (m[k][j] - m[j][k]) / (4.0 * q[i]))


@given(rotations)
def test_the_sign_is_the_one_that_comes_out_of_a_matrix(turn):
    by_matrix = out_of_a_matrix(quaternions.matrix(turn))
    by_rule = quaternions.canonical(turn)

    # At the limits between the cases, rounding decides, and both signs are right.
    near_a_limit = abs(turn[3] ** 2 - 0.25) < 1e-9 or any(
        abs(abs(turn[i]) - abs(turn[j])) < 1e-9 for i, j in ((0, 1), (0, 2), (1, 2))
    )
    if not near_a_limit:
        assert by_rule == pytest.approx(by_matrix, abs=1e-9)
    assert same(by_rule, by_matrix, 1e-6)


@given(rotations, rotations, fractions)
def test_slerp_goes_the_same_way_back(start, end, fraction):
    there = quaternions.slerp(start, end, fraction)
    back = quaternions.slerp(end, start, 1.0 - fraction)

    # Between opposite rotations, both arcs are equally short.
    if abs(sum(a * b for a, b in zip(start, end, strict=True))) > 1e-6:
        assert same(there, back, 1e-9)
    assert math.hypot(*there) == pytest.approx(1.0)


@given(rotations, rotations, fractions)
def test_slerp_covers_its_share_of_the_angle(start, end, fraction):
    whole = quaternions.angle_between(start, end)

    part = quaternions.angle_between(start, quaternions.slerp(start, end, fraction))

    assert part == pytest.approx(fraction * whole, abs=1e-7)


@given(rotations)
def test_slerp_between_equals_stays_to_the_last_bit(turn):
    x, y, z, w = turn
    # The terms are added in slerp's order; from Python 3.12 on, `sum` rounds less.
    cosine = x * x + y * y + z * z + w * w

    assert quaternions.slerp(turn, turn, 0.3) == (turn if cosine >= 1.0 else pytest.approx(turn))


@given(angles)
def test_small_turns_keep_all_their_digits(angle):
    tiny = angle * 1e-9
    turn = (0.0, 0.0, math.sin(tiny / 2), math.cos(tiny / 2))

    assert quaternions.angle_between(IDENTITY, turn) == pytest.approx(abs(tiny), rel=1e-12)


@pytest.mark.parametrize(
    "hopeless",
    [
        (0.0, 0.0, 0.0, 0.0),
        (math.nan, 0.0, 0.0, 1.0),
        (math.inf, 0.0, 0.0, 1.0),
        (0.0, -math.inf, math.inf, 1.0),
        (1e-160, 0.0, 0.0, 0.0),
    ],
)
def test_the_unit_of_a_zero_tiny_or_non_finite_quaternion_is_nan(hopeless):
    assert all(math.isnan(part) for part in quaternions.unit(hopeless))


@pytest.mark.parametrize("scale", [1e-150, 1e-3, 2.0, 1e150, 1e200, 1e308])
def test_any_other_size_is_scaled_to_length_one(scale):
    found = quaternions.unit((0.6 * scale, 0.0, 0.0, -0.8 * scale))

    assert found == pytest.approx((0.6, 0.0, 0.0, -0.8), abs=1e-15)


def test_a_unit_quaternion_is_left_as_it_is():
    turn = (0.0, 0.0, math.sin(0.35), math.cos(0.35))

    assert quaternions.unit(turn) == turn
