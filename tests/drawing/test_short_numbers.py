"""Tests of numbers in few cells."""

import pytest

from tftool.base.plain_text import short_size


@pytest.mark.parametrize(
    ("size", "text"),
    [
        (0, "0 bytes"),
        (999, "999 bytes"),
        (1000, "1.0 KB"),
        (4_700_000, "4.7 MB"),
        (2_000_000_000, "2.0 GB"),
        (30_000_000_000_000, "30.0 TB"),
    ],
)
def test_a_size_is_written_in_the_unit_that_fits(size, text):
    assert short_size(size) == text
