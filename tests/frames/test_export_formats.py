"""Tests of the export formats and their writers."""

from tftool.frames.export.export_formats import Format
from tftool.frames.export.static_files import LINK_WRITERS
from tftool.frames.export.trajectory_files import TRAJECTORY_WRITERS


def test_every_format_has_a_writer_of_its_own():
    # MCAP contains messages over time, and is written from the buffer itself.
    of_links = {form for form in Format if not form.is_trajectory} - {Format.mcap}

    assert set(TRAJECTORY_WRITERS) == {form for form in Format if form.is_trajectory}
    assert set(LINK_WRITERS) == of_links
    assert len(set(TRAJECTORY_WRITERS.values())) == len(TRAJECTORY_WRITERS)


def test_names_end_in_different_ways():
    suffixes = [suffix for form in Format for suffix in form.suffixes]

    assert len(set(suffixes)) == len(suffixes)
