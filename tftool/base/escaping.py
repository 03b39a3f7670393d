"""Escaping of control characters in names from outside, so that they can be printed safely.

Before drawing, `visible` replaces the dangerous characters of a name: control characters, changes
of writing direction, and characters that XML forbids. Afterwards each output format escapes its
reserved characters.
"""

import unicodedata
from collections.abc import Iterable

_JOINERS = frozenset("\u200c\u200d")
"""Zero width joiners, which emoji and several scripts need, and which affect nothing else."""


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
    between: tf2's error message about a loop, for example, names every frame.
    """
    lines = text.split("\n")
    if len(lines) > MOST_LINES:
        half = MOST_LINES // 2
        lines[half:-half] = [f"… {len(lines) - 2 * half:,} lines more …"]
    return "\n".join(map(visible, lines))


MOST_LINES = 400
"""Maximum number of lines of a text, or of links of a chain, that are printed completely."""


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
    """Map every name to its escaped form; different names have different forms."""
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
