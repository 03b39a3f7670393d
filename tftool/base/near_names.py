"""Search for known names that resemble an unknown name, for "did you mean"."""

from collections.abc import Iterable

LONGEST = 100
"""Number of characters that are compared; the time of the search grows with its square."""


def near_names(word: str, known: Iterable[str], most: int = 1, *, alike: float = 0.6) -> list[str]:
    """Return the known names most similar to a word, ignoring case, most similar first.

    Args:
        word: The unknown name.
        known: The existing names. If names differ only in case, one of them is returned.
        most: Maximum number of names to return.
        alike: Minimum similarity of a name to the word, from 0 to 1.
    """
    from difflib import get_close_matches  # slow import, needed only for errors

    by_lower = {name.lower(): name for name in known}
    found = get_close_matches(word[:LONGEST].lower(), by_lower, n=most, cutoff=alike)
    return [by_lower[name] for name in found]


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return the "did you mean" ending of a sentence; empty if no name is similar."""
    near = near_names(word, known)
    return f"; did you mean '{near[0]}'?" if near else ""
