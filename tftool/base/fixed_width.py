"""Functions that fit text from outside into a fixed number of terminal cells."""

from collections.abc import Iterable

from rich.cells import cell_len

from tftool.base.plain_text import visible

# Joiners and variation selectors, which change a character's width in some terminals only.
# Without them the computed width is right on every terminal.
_SWITCHES = dict.fromkeys((0x200C, 0x200D, *range(0xFE00, 0xFE10)))


def plain(text: str) -> str:
    """Escape a text to one line whose width in cells is the same on every terminal."""
    if text.isascii() and text.isprintable():
        return text
    return visible(text).translate(_SWITCHES)


def fitted(text: str, width: int, *, more: str = "…") -> str:
    """Return a text as one line of at most `width` cells; `more` replaces the omitted end."""
    # Measure only the beginning of a long text.
    shown = plain(text[: 4 * max(0, width) + 4])
    if cell_len(shown) <= width:
        return shown
    room = width - cell_len(more)
    if room < 0:
        return ""
    kept, used = 0, 0
    for sign in shown:
        used += cell_len(sign)
        if used > room:
            break
        kept += 1
    return shown[:kept] + more


def middle_cut(text: str, width: int, *, more: str = "…") -> str:
    """Return a text as one line of at most `width` cells by cutting its middle.

    The beginning and the end stay; `more` replaces the middle.
    """
    shown = plain(text)
    if cell_len(shown) <= width:
        return shown
    room = width - cell_len(more)
    if room < 0:
        return ""
    end = _within(reversed(shown), room // 2)
    start = _within(shown, room - sum(map(cell_len, end)))
    return "".join(start) + more + "".join(reversed(end))


def _within(signs: Iterable[str], room: int) -> list[str]:
    """Return as many characters from the beginning of `signs` as fit into `room` cells."""
    kept = []
    for sign in signs:
        room -= cell_len(sign)
        if room < 0:
            break
        kept.append(sign)
    return kept


def wrap_words(sentence: str, width: int) -> list[str]:
    """Wrap a sentence at spaces only, into lines of at most `width` cells.

    A word longer than a line gets a line of its own, uncut.
    """
    lines = [""]
    for word in sentence.split(" "):
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if lines[-1] and cell_len(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def padded(text: str, width: int, *, more: str = "…") -> str:
    """Return a text as one line of exactly `width` cells: cut, or padded with spaces."""
    shown = fitted(text, width, more=more)
    return shown + " " * (width - cell_len(shown))
