"""Tests that numbers written in bulk equal the numbers that Python writes one by one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from tftool.frames.export import trajectory_files

EDGES = [0.0, -0.0, 1.0, -1.0, 0.1, 9999.999999999, 10000.0, 99999999.5, 123456789.25, -6e-10,
    4.9e-10, 1e-9, -8.5e9]  # fmt: skip


def exactly(number):
    text = f"{number:.9f}"
    return "0.000000000" if text == "-0.000000000" else text


@given(arrays(np.float64, (5, 3), elements=st.floats(-9e6, 9e6) | st.floats(-1.0, 1.0)))
def test_rows_are_those_of_python(numbers):
    lines = trajectory_files.rows_as_text(numbers, separator=" ").decode().splitlines()

    for line, row in zip(lines, numbers.tolist(), strict=True):
        for word, number in zip(line.split(" "), row, strict=True):
            # The last digit may be rounded in the other direction if the number is nearly a tie.
            assert word == exactly(number) or abs(float(word) - number) <= 0.5001e-9 + np.spacing(
                abs(number)
            )


@pytest.mark.parametrize("number", EDGES)
def test_edge_values_are_written_as_python_does_but_never_as_minus_zero(number):
    assert trajectory_files.rows_as_text(np.array([[number, number]])).decode() == (
        f"{exactly(number)},{exactly(number)}\n"
    )


@given(st.lists(st.integers(0, 2**63 - 1), min_size=1, max_size=5))
def test_stamps_are_whole_in_either_unit(stamps):
    column, numbers = np.array(stamps, dtype=np.int64), np.zeros((len(stamps), 1))

    whole = trajectory_files.rows_as_text(numbers, stamps=column).decode().splitlines()
    parted = (
        trajectory_files.rows_as_text(numbers, stamps=column, seconds=True, separator=" ")
        .decode()
        .splitlines()
    )

    assert [int(line.split(",")[0]) for line in whole] == stamps
    words = [line.split(" ")[0] for line in parted]
    assert words == [f"{one // 10**9}.{one % 10**9:09}" for one in stamps]
    assert words == [trajectory_files.stamp_text(one) for one in stamps]


def test_other_decimals_are_written_one_by_one():
    numbers = np.array([[0.1 + 0.2, 1e-12, 2.0]])

    assert trajectory_files.exact_rows(numbers, 3).decode() == "0.300,0.000,2.000\n"
    full = (
        trajectory_files.exact_rows(numbers, 17, stamps=np.array([5])).decode().strip().split(",")
    )
    assert [float(word) for word in full[1:]] == numbers[0].tolist()
    assert not any("e" in word for word in full)


def test_numbers_too_large_for_the_fast_way_and_nan_do_not_fit():
    assert trajectory_files.fits(np.array([[8.9e9]]))
    assert not trajectory_files.fits(np.array([[9.1e9]]))
    assert not trajectory_files.fits(np.array([[np.nan]]))
