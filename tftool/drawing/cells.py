"""Cells of a terminal, joined to the lines that rich draws."""

from collections.abc import Iterator
from functools import lru_cache
from typing import TypeAlias

from rich.cells import cell_len
from rich.segment import Segment
from rich.style import Style

from tftool.base.color import Color
from tftool.drawing import theme
from tftool.drawing.sprites import Cell

Line: TypeAlias = list[Segment]


def cells_of(text: str) -> Iterator[tuple[int, str]]:
    """Share a text out over cells; the cell after a wide sign holds nothing."""
    offset = 0
    shown: list[tuple[int, str]] = []
    for sign in text:
        width = cell_len(sign)
        if width == 0:
            # A mark stands on the sign before it; one with nothing to stand on has no cell.
            if shown:
                start, before = shown[-1]
                shown[-1] = start, before + sign
            continue
        shown.append((offset, sign))
        shown.extend((offset + more, "") for more in range(1, width))
        offset += width
    yield from shown


def line_of(cells: list[Cell]) -> Line:
    """Join cells that look the same into segments."""
    line: Line = []
    text: list[str] = []
    look: tuple[Color | None, Color | None, bool] = (None, None, False)
    for cell in cells:
        mine = cell.ink, cell.ground, cell.bold
        if cell.text == " " and text and cell.ground == look[1]:
            # A blank has no ink: it needs no segment, and a terminal no code, of its own.
            mine = look
        if mine != look and cell.text:
            if text:
                line.append(Segment("".join(text), style_of(*look)))
            text, look = [], mine
        text.append(cell.text)
    if text:
        line.append(Segment("".join(text), style_of(*look)))
    return line


@lru_cache(maxsize=4096)
def style_of(ink: Color | None, ground: Color | None, bold: bool) -> Style:
    """How rich shows a cell: None for a colour that the terminal chooses."""
    return Style(
        color=None if ink is None else theme.hexadecimal(ink),
        bgcolor=None if ground is None else theme.hexadecimal(ground),
        bold=bold or None,
    )
