"""Escaping of control characters in names from outside; the names stay recognisable.

Before drawing, `visible` replaces the dangerous characters of a name: control characters, changes
of writing direction, and characters that XML forbids. Afterwards each output format escapes its
reserved characters.
"""

import unicodedata
from collections.abc import Iterable

_JOINERS = frozenset("\u200c\u200d")
"""Zero width joiners: emoji and several scripts are written with them; they act on nothing else."""


def visible(name: str) -> str:
    """Escape a name so that every character is visible.

    A control character becomes its Unicode picture (ESC becomes ␛). Other invisible characters, and
    characters that change the writing direction, become their number, such as ⟨U+202E⟩.
    """
    if name.isascii() and name.isprintable():
        return name
    return "".join(map(_shown, name))


def visible_lines(text: str) -> str:
    """Escape a text so that every character is visible; line breaks are kept.

    A text of more than 400 lines keeps its beginning and end, with the number of omitted lines in
    between: tf2's sentence about a loop names every frame.
    """
    lines = text.split("\n")
    if len(lines) > MOST_LINES:
        half = MOST_LINES // 2
        lines[half:-half] = [f"… {len(lines) - 2 * half:,} lines more …"]
    return "\n".join(map(visible, lines))


MOST_LINES = 400
"""Lines of one sentence, or links of one chain, that are printed whole."""


def _shown(char: str) -> str:
    code = ord(char)
    if code < 0x20:
        return chr(0x2400 + code)
    if code == 0x7F:
        return "\u2421"
    if char not in _JOINERS and unicodedata.category(char) in _SHAPELESS:
        return f"⟨U+{code:04X}⟩"
    return char


_SHAPELESS = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


def distinct(names: Iterable[str]) -> dict[str, str]:
    """Map every name to its escaped form; different names get different forms."""
    shown: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        plain = written = visible(name)
        number = 2
        while written in taken:
            written = f"{plain} ({number})"
            number += 1
        taken.add(written)
        shown[name] = written
    return shown


def shorten(text: str, most: int) -> str:
    """Shorten a text to `most` characters by cutting its middle, where frame names differ least."""
    if len(text) <= most:
        return text
    tail = (most - 1) // 2
    return f"{text[: most - 1 - tail]}…{text[len(text) - tail :]}"
