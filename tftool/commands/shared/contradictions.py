"""Options that contradict each other: each command lists its rules, and one place refuses."""

from tftool.base.errors import UsageError

Rule = tuple[object, str]
"""What holds where options do not fit together, and the sentence that says so."""


def refuse(*rules: Rule) -> None:
    """Refuse options by the first rule that holds.

    Raises:
        UsageError: If one does.
    """
    for holds, sentence in rules:
        if holds:
            raise UsageError(sentence)
