"""Notices and a world's log on stderr, separate from a command's results on stdout."""

import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from tftool.base.plain_text import count, near_names, visible, visible_lines

if TYPE_CHECKING:
    from tftool.buffer.buffer import Buffer
    from tftool.world.log import LogRecord
    from tftool.world.world import World

MOST_NAMED = 12
"""Most frames that a hint names."""

_COLORS = {"DEBUG": 32, "WARN": 33, "ERROR": 31, "FATAL": 31}
"""Numbers of ROS 2's colours for each severity: green, yellow, red; INFO is not coloured."""


def notice(sentence: str) -> None:
    """Print a notice to stderr; on a terminal, wrap the text between words."""
    _write(fitting(sentence))


def complain(command: str, sentence: str) -> None:
    """Print an error of a command to stderr, with escaped control characters.

    Args:
        command: Name of the command.
        sentence: Text of the error.
    """
    notice(f"{command}: {visible_lines(sentence.rstrip())}")


def name_frames(
    frames: Sequence[str], requested: Iterable[str | None], when: str = "", advice: str = ""
) -> bool:
    """Print the existing frames if a requested frame does not exist.

    Args:
        frames: Names of the existing frames.
        requested: Names of the requested frames; None is ignored.
        when: Text after "frames", such as "so far" if more frames may follow.
        advice: Sentence to append.

    Returns:
        Whether the existing frames were printed.
    """
    missing = [frame for frame in requested if frame is not None and frame not in frames]
    if not frames and not when:
        notice("There are no frames at all.")
    if not missing or not frames:
        return False
    near = near_names(missing[0], frames)
    named = ", ".join(visible(frame) for frame in frames[:MOST_NAMED])
    more = f" and {len(frames) - MOST_NAMED} more" if len(frames) > MOST_NAMED else ""
    there = f"Existing frames {when}".rstrip()
    meant = f" Did you mean {visible(near[0])}?" if near else ""
    notice(f"{there}: {named}{more}.{meant} {advice}".rstrip())
    return True


def _write(text: str) -> None:
    sys.stderr.write(text + "\n")
    sys.stderr.flush()


def fitting(sentence: str) -> str:
    """Wrap a text between words to the width of the terminal; without a terminal, change nothing.

    Lines that begin with a space stay unchanged: they are excerpts of files, or tracebacks.
    """
    try:
        width = os.get_terminal_size(sys.stderr.fileno()).columns
    except (OSError, ValueError):
        # Not a terminal, or a terminal of unknown width.
        return sentence
    # No character is wider than two cells.
    if width < 20 or all(len(line) <= width // 2 for line in sentence.split("\n")):
        return sentence
    from tftool.drawing.table_columns import wrap_words

    return "\n".join(
        piece
        for line in sentence.split("\n")
        for piece in ([line] if line.startswith(" ") else wrap_words(line, width))
    )


def is_news(record: "LogRecord") -> bool:
    """Return whether a log message is a warning about the session, which every user should see."""
    return record.node == "link" and record.level == "WARN"


def tell_news(record: "LogRecord") -> None:
    """Print a log message if the message is a warning about the session."""
    if is_news(record):
        notice(visible(record.text))


def tell_record(record: "LogRecord", *, label: str = "") -> None:
    """Print a log message of a node to stderr, in the format of ROS 2's console.

    Args:
        record: Log message.
        label: Name of the program that has logged the message; "" to print no name.
    """
    line = visible_lines(str(record).rstrip())
    label = f"[{label}] " if label else ""
    line = fitting(label + line)[len(label) :]
    color = _COLORS.get(record.level)
    if color is not None and wants_color(os.environ, is_terminal=sys.stderr.isatty()):
        line = f"\033[{color}m{line}\033[0m"
    _write(label + line)


def tell_log(world: "World", label_of: "Callable[[LogRecord], str] | None" = None) -> None:
    """Print a world's log messages from now on.

    Args:
        world: World whose log is printed.
        label_of: Function that returns the name of a message's program; None for a single program.
    """

    def tell(record: "LogRecord") -> None:
        # The session prints the connection's messages.
        if record.node != "link":
            tell_record(record, label="" if label_of is None else label_of(record))

    world.log.listen(tell, "console")


class FoldedLog:
    """Printer of a world's log, which prints equal messages once and counts the repetitions."""

    def __init__(self, *, prints_all: bool = False) -> None:
        """Start with all counts at zero.

        Args:
            prints_all: Whether to print every message, including repeated messages.
        """
        self._whole = prints_all
        self._more: dict[tuple[str, str, str], tuple[LogRecord, int]] = {}

    def tell(self, record: "LogRecord") -> None:
        """Print a log message; only count the message if an equal message was printed before."""
        kind = (record.node, record.level, record.text)
        first, more = self._more.get(kind, (record, -1))
        self._more[kind] = (first, more + 1)
        if self._whole or more < 0:
            tell_record(record)

    def end(self) -> None:
        """Print how often each message was repeated without being printed, and reset the counts."""
        for first, more in () if self._whole else self._more.values():
            if more:
                text = visible(first.text.splitlines()[0] if first.text else "")
                times = "once more" if more == 1 else f"{more} more times"
                notice(f"[{visible(first.node)}]: {times} '{text}'; --verbose shows each")
        self._more.clear()


def wants_color(environment: Mapping[str, str], *, is_terminal: bool) -> bool:
    """Return whether to print log messages in colour.

    RCUTILS_COLORIZED_OUTPUT=0 or 1, as in ROS 2, takes precedence over NO_COLOR and the terminal.
    """
    asked = environment.get("RCUTILS_COLORIZED_OUTPUT", "")
    if asked in ("0", "1"):
        return asked == "1"
    return is_terminal and not environment.get("NO_COLOR") and environment.get("TERM") != "dumb"


MOST_TOLD = 3
"""Most frames that get a sentence; further frames are counted."""


def rivalries(buffer: "Buffer", frames: Iterable[str]) -> list[str]:
    """Return a sentence about each frame that several nodes publish alternately."""
    told: list[str] = []
    more = 0
    for frame in frames:
        senders = buffer.rivals(frame)
        if not senders:
            continue
        if len(told) == MOST_TOLD:
            more += 1
            continue
        names = " and ".join(f"'{visible(sender)}'" for sender in senders)
        told.append(
            f"{visible(frame)} is broadcast by {len(senders)} nodes in turns, {names}, so that the "
            "frame jumps between their poses. One child frame should have one broadcaster."
        )
    if more:
        has = "has" if more == 1 else "have"
        told.append(f"{count(more, 'more frame')} {has} several broadcasters.")
    return told
