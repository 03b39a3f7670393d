import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len

from tftool.drawing.table_columns import fitted, padded, plain


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("turtle1", "turtle1"),
        ("[bold]", "[bold]"),
        ("a\x1b[31mb", "a␛[31mb"),
        ("two\nlines", "two␊lines"),
        ("\u202eevil", "⟨U+202E⟩evil"),
        ("👩\u200d🚀", "👩🚀"),
        ("☀\ufe0f", "☀"),
    ],
)
def test_control_and_invisible_characters_are_replaced_or_removed(text, shown):
    assert plain(text) == shown


@given(st.text(max_size=30), st.integers(0, 12))
def test_a_padded_text_has_exactly_the_width_asked_for(text, width):
    assert cell_len(padded(text, width)) == width


def test_a_text_is_cut_where_it_ends_and_says_so():
    assert fitted("turtle1", 7) == "turtle1"
    assert fitted("turtle1", 6) == "turtl…"
    assert fitted("turtle1", 6, more="~") == "turtl~"
    assert fitted("turtle1", 0) == ""
    assert fitted("🐢🐢🐢", 4) == "🐢…"
