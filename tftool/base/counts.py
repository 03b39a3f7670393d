"""How many there are of something, in words."""


def count(number: int, word: str) -> str:
    """A number and what is counted: "1 link", "2,104 links"."""
    return f"{number:,} {word}" if number == 1 else f"{number:,} {word}s"
