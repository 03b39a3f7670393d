"""Sentences for a command line that click refuses."""

import re
from collections.abc import Sequence
from difflib import SequenceMatcher
from typing import Any

from tftool.app.index import COMMANDS

PLAINLY = (
    (r"is not a valid int( range)?\b", "is not a whole number"),
    (r"is not a valid float( range)?\b", "is not a number"),
    (r"is not in the range (\S+)<=x<=(\S+?)\.?$", r"is not between \1 and \2."),
    (r"is not in the range x>=(\S+?)\.?$", r"is less than \1."),
    (r"(?<![.?])$", "."),
)
"""What click says in a programmer's words, and what we say instead."""

UNLIKE = 0.5
"""Two words that are less alike than this, from 0 to 1, are not mistaken for one another."""


def sentence_of(error: Any, argv: Sequence[str] = ()) -> tuple[str, str]:
    """Return the name of the command that refused, and click's reason as a plain sentence."""
    context = getattr(error, "ctx", None)
    command = " ".join(["tftool", *(word for word in argv[:1] if word in COMMANDS)])
    if context is not None:
        command = context.command_path
    sentence = error.format_message()
    unknown = re.match(r"No such command '(.*?)'", sentence, re.DOTALL)
    if unknown is not None:
        # Suggested by typer in the order of the list, and only when very alike.
        sentence = unknown[0] + "."
        near = _nearest(unknown[1], list(COMMANDS))
        if near:
            meant = " or ".join(f"'{one}'" for one in near)
            sentence = f"{unknown[0]}. Did you mean {meant}?"
        return command, f"{sentence} Try '{command} --help'."
    near = [one for one in getattr(error, "possibilities", None) or () if "help" not in one]
    if hasattr(error, "possibilities"):
        sentence = error.message
        near = _nearest(str(getattr(error, "option_name", "")), near)
    if near:
        # click sorts them by the alphabet; here the nearest comes first.
        sentence = f"{error.message.rstrip('.')}. Did you mean {' or '.join(near)}?"
    for pattern, words in PLAINLY:
        sentence = re.sub(pattern, words, sentence)
    return command, f"{sentence} Try '{command} --help'."


def _nearest(written: str, near: list[str]) -> list[str]:
    """Return the options nearly as similar to the written word as the best match, best first."""

    def likeness_of(one: str) -> float:
        # The first letter is the one that is seldom mistyped.
        same = one.lstrip("-")[:1] == written.lstrip("-")[:1]
        return SequenceMatcher(None, written, one).ratio() + 0.1 * same

    likeness = {one: likeness_of(one) for one in near}
    best = max(likeness.values(), default=0.0)
    return sorted(
        (one for one in near if likeness[one] > max(best - 0.1, UNLIKE)),
        key=lambda one: -likeness[one],
    )
