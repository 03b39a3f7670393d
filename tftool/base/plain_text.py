"""Text for people: similar names, escaped control characters, short numbers."""

import math
import re
import unicodedata
from collections.abc import Iterable

from tftool.base.stamps import Duration, as_seconds

LONGEST = 100
"""Number of characters that are compared; the time of the search grows with its square."""


def near_names(word: str, known: Iterable[str], most: int = 1, *, alike: float = 0.6) -> list[str]:
    """Return the known names most similar to a word, ignoring case, most similar first.

    Args:
        word: The unknown name.
        known: The existing names. Of several names that differ only in case, one name is returned.
        most: Maximum number of names to return.
        alike: Minimum similarity of a name to the word, from 0 to 1.
    """
    from difflib import get_close_matches  # slow import, needed only for errors

    by_lower = {name.lower(): name for name in known}
    found = get_close_matches(word[:LONGEST].lower(), by_lower, n=most, cutoff=alike)
    return [by_lower[name] for name in found]


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return the ending "; did you mean …?" of a sentence; "" if no known name is similar."""
    near = near_names(word, known)
    return f"; did you mean '{near[0]}'?" if near else ""


def natural_key(name: str) -> list[tuple[int, str]]:
    """Return a sort key that compares numbers in names by value: `run_2` before `run_10`."""
    words = re.split(r"([0-9]+)", name)
    return [(int(word), "") if place % 2 else (0, word) for place, word in enumerate(words)]


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

    A text of more than 400 lines, such as tf2's error text about a loop of many frames, is
    shortened. The number of omitted lines then replaces the middle.
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
    """Map every name to its escaped form, so that different names get different forms."""
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


def count(number: int, word: str) -> str:
    """Return a number with its noun, in singular or plural: "1 link", "2,104 links"."""
    return f"{number:,} {word}" if number == 1 else f"{number:,} {word}s"


def short_duration(duration: Duration) -> str:
    """Format a duration of nanoseconds as "0.02 s", "2.0 s", "3.5 min", "2.1 h" or "4.0 d"."""
    number = as_seconds(duration)
    size = abs(number)
    if size < 0.995:
        return f"{number if size >= 0.005 else 0.0:.2f} s"
    if size < 99.95:
        return f"{number:.1f} s"
    for most, unit, length in ((99.95 * 60, "min", 60), (47.95 * 3600, "h", 3600)):
        if size < most:
            return f"{number / length:.1f} {unit}"
    return f"{number / 86400:.1f} d"


def three_digits(value: float) -> str:
    """Format a number with three significant digits; round numbers from 1000 on to integers."""
    return f"{value:.3g}" if abs(value) < 999.5 else f"{value:.0f}"


def short_rate(rate: float) -> str:
    """Format a rate in hertz as "0.50 Hz", "62.7 Hz" or "1000 Hz"."""
    if rate < 0.995:
        return f"{rate:.2f} Hz"
    return f"{rate:.1f} Hz" if rate < 999.95 else f"{rate:.0f} Hz"


def short_size(size: int) -> str:
    """Format a number of bytes as "17 bytes", "1.2 KB", "4.7 MB" or "2.0 GB"."""
    for unit, many in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6), ("KB", 1e3)):
        if size >= many:
            return f"{size / many:.1f} {unit}"
    return f"{size} bytes"


def finite(number: float) -> float | None:
    """Return a number unchanged, but None (null in JSON) for NaN and infinities."""
    return number if math.isfinite(number) else None
