"""Exit statuses of the `tftool` command.

This module imports nothing large, because the command imports it before signals can be handled.
"""

from enum import IntEnum


class ExitStatus(IntEnum):
    """Exit status of a command."""

    DONE = 0
    FAILED = 1
    """A scenario's expectation or a node failed, or a check found something."""
    WRONG_USAGE = 2
    UNREADABLE = 3
    """The input cannot be read."""
    NO_TRANSFORM = 4
    """The transform is not available."""
    INTERRUPTED = 130
