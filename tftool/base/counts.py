"""Counts in words."""


def count(number: int, word: str) -> str:
    """Return a number with its noun: "1 link", "2,104 links"."""
    return f"{number:,} {word}" if number == 1 else f"{number:,} {word}s"
