"""Options that contradict each other: each command lists its rules, one function checks them."""

from tftool.base.errors import UsageError

Rule = tuple[object, str]
"""Condition of a contradiction between options, and its sentence."""


def refuse(*rules: Rule) -> None:
    """Refuse options by the first rule that applies.

    Raises:
        UsageError: If one does.
    """
    for holds, sentence in rules:
        if holds:
            raise UsageError(sentence)
