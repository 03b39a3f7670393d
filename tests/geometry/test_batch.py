"""Tests that functions for arrays give, row by row, the result of the function for one value."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import rotations, vectors
from tftool.geometry import quaternions
from tftool.geometry import rigid_arrays as batch

several = st.lists(rotations, min_size=1, max_size=5)
ODD = [
    (0.0, 0.0, 0.0, 0.0),
    (math.nan, 0.0, 0.0, 1.0),
    (math.inf, 0.0, 0.0, 1.0),
    (3e200, 0.0, 0.0, 4e200),
    (1e-200, 0.0, 0.0, 0.0),
    (1e-160, 0.0, 0.0, 0.0),
    (0.0, 0.0, 0.6, -0.8),
    (0.0, 0.0, 0.0, 2.0),
]


@given(st.lists(st.one_of(rotations, st.sampled_from(ODD)), max_size=6))
def test_unit_and_canonical_are_the_single_ones_to_the_last_bit(given_rows):
    rows = np.array(given_rows).reshape(-1, 4)

    found = batch.canonical(batch.unit(rows))

    wanted = [quaternions.canonical(quaternions.unit(tuple(row))) for row in rows.tolist()]
    np.testing.assert_array_equal(found, np.array(wanted).reshape(-1, 4))


@given(several, rotations, vectors)
def test_products_and_turns_are_the_single_ones(given_rows, other, vector):
    rows = np.array(given_rows)

    products = batch.multiply(rows, np.array(other))
    turned = batch.rotate(rows, np.array(vector))

    for row, quad in enumerate(given_rows):
        assert tuple(products[row]) == pytest.approx(quaternions.multiply(quad, other), abs=1e-15)
        assert tuple(turned[row]) == pytest.approx(quaternions.rotate(quad, vector), abs=1e-12)
        assert tuple(batch.conjugate(rows)[row]) == quaternions.conjugate(quad)


@given(several)
def test_rotation_vectors_turn_as_far_and_about_the_same_axis(given_rows):
    rows = np.array(given_rows)

    found = batch.rotation_vectors(rows)

    for vector, quad in zip(found, given_rows, strict=True):
        angle = float(np.linalg.norm(vector))
        assert angle == pytest.approx(
            quaternions.angle_between(quad, quaternions.IDENTITY), abs=1e-9
        )
        half = math.sin(angle / 2.0)
        again = (*(vector / angle * half if angle > 0.0 else vector), math.cos(angle / 2.0))
        assert quaternions.angle_between(tuple(again), quad) < 1e-7


@given(several, rotations)
def test_angles_between_are_the_single_ones(given_rows, other):
    rows = batch.unit(np.array(given_rows))
    one = quaternions.unit(tuple(other))

    found = batch.angles_between(rows, np.array(one))

    wanted = [quaternions.angle_between(tuple(row), one) for row in rows.tolist()]
    np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-12)
