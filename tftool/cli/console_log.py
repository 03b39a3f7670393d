"""The world's log on stderr, as ROS 2's console shows one."""

import os
import sys
from collections.abc import Mapping

from tftool.cli.notices import notice
from tftool.runtime.log import LogRecord
from tftool.views.escaping import visible_lines

_COLORS = {"DEBUG": 32, "WARN": 33, "ERROR": 31, "FATAL": 31}
"""ROS 2's: green, yellow, red; INFO keeps the terminal's own."""


def tell(record: LogRecord, *, label: str = "") -> None:
    """Show a line of the log.

    Args:
        record: The line.
        label: The program it comes from, where there are several.
    """
    line = visible_lines(str(record).rstrip())
    color = _COLORS.get(record.level)
    if color is not None and wants_color(os.environ, is_terminal=sys.stderr.isatty()):
        line = f"\033[{color}m{line}\033[0m"
    notice(f"[{label}] {line}" if label else line)


def wants_color(environment: Mapping[str, str], *, is_terminal: bool) -> bool:
    """Whether lines are to be coloured; ROS 2's own variable decides before all others."""
    asked = environment.get("RCUTILS_COLORIZED_OUTPUT", "")
    if asked in ("0", "1"):
        return asked == "1"
    return is_terminal and not environment.get("NO_COLOR") and environment.get("TERM") != "dumb"
