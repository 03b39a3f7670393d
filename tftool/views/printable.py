"""Names and texts from strangers, made safe to print."""

import unicodedata

# Characters that act instead of showing: controls, lone surrogates, line separators,
# and the format characters that turn the writing direction around.
_ACTING = {"Cc", "Cs", "Zl", "Zp", "Cf"}
# Joiners inside emoji and scripts; harmless, and a name looks wrong without them.
_HARMLESS = "\u200c\u200d"


def printable(text: str, *, keep: str = "") -> str:
    r"""Give `text` with every character that would act on a terminal written as its escape.

    Args:
        text: Any text, such as a frame name that came in over a link.
        keep: Characters to leave as they are, such as a newline.

    Returns:
        The same text where nothing had to be escaped; otherwise with `\x1b`, `\u202e`
        and so on in their places.
    """
    if text.isascii() and text.isprintable():
        return text
    return "".join(
        character
        if character in keep
        or character in _HARMLESS
        or unicodedata.category(character) not in _ACTING
        else character.encode("unicode_escape", "backslashreplace").decode("ascii")
        for character in text
    )
