"""Styles of a screen's text, and wrapping of sentences."""

from typing import NamedTuple

from rich.cells import cell_len
from rich.style import Style
from rich.text import Text

from tftool.base.color import Color
from tftool.drawing import theme
from tftool.drawing.table_columns import fitted, plain


class Look(NamedTuple):
    """Palette of a screen, and whether the screen is limited to ASCII."""

    palette: theme.Palette = theme.DARK
    ascii_only: bool = False

    @property
    def more(self) -> str:
        """Character that marks the place where text was left out."""
        return "~" if self.ascii_only else "…"

    def ink(self, color: Color, *, bold: bool = False) -> Style:
        """Return the style of text in a colour."""
        return theme.ink(color, bold=bold)

    def of_name(self, name: str) -> Color:
        """Return the colour that is computed from a frame's name, readable on the panel."""
        return theme.readable(theme.of_name(name), self.palette)


def wrapped(
    words: str, width: int, style: Style | None = None, *, first: int | None = None
) -> list[Text]:
    """Wrap a sentence into lines, at blanks if possible.

    Args:
        words: The sentence, in which control characters are replaced.
        width: Longest line in cells.
        style: Style of the text.
        first: Largest width of the first line in cells; None for `width`.
    """
    width = max(1, width)
    lines: list[str] = []
    line, room = "", width if first is None else first
    for word in plain(words).split(" "):
        longer = f"{line} {word}" if line else word
        if cell_len(longer) <= room:
            line = longer
            continue
        if line:
            lines.append(line)
            room = width
        line = word
        while cell_len(line) > room:
            head = fitted(line, room, more="") or line[:1]
            lines.append(head)
            line, room = line[len(head) :], width
    return [Text(one, style or "") for one in [*lines, line]]
