"""Tests of differences as lines, in the width of a terminal."""

import pytest
from rich.cells import cell_len

import tftool
from tests.frames.test_compare import frames
from tftool import Transform
from tftool.drawing.difference_view import lines


@pytest.mark.parametrize("width", [40, 50, 60])
def test_differences_are_written_below_their_links_where_the_width_is_too_small(width):
    moved = Transform((0.1, 0.2, 0.3125))
    found = tftool.diff(frames(), frames(off=0.02, laser=moved))
    wide = lines(found)

    told = lines(found, width)

    assert lines(found, 200) == wide
    assert max(map(cell_len, wide.splitlines())) > width >= max(map(cell_len, told.splitlines()))
    # The words and their order are the same: each edge, followed by its differences.
    assert told.split() == wide.split()
