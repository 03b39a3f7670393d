"""What a command says beside its results: on stderr, a sentence at a time."""

import sys
from typing import TYPE_CHECKING

from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.runtime.log import LogRecord


def is_news(record: "LogRecord") -> bool:
    """Whether the link has something to say that every user wants to know."""
    return record.node == "link" and record.level == "WARN"


def tell_news(record: "LogRecord") -> None:
    """Tell the user what the link has to say, and nothing else."""
    if is_news(record):
        notice(visible(record.text))


def notice(sentence: str) -> None:
    """Tell the user something that is no result."""
    sys.stderr.write(sentence + "\n")
    sys.stderr.flush()
