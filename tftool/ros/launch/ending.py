"""Ending of system commands as in ROS 2: SIGINT, SIGTERM, SIGKILL."""

import asyncio
import os
import signal
import sys
from contextlib import suppress

PATIENCE = 5.0
"""Real seconds a process has to follow one signal before the next is sent; ROS 2's own."""


def interrupt(process: asyncio.subprocess.Process) -> None:
    """End a process and its children: SIGINT, after a while SIGTERM, then SIGKILL."""
    if sys.platform == "win32":
        process.terminate()
        return
    loop = asyncio.get_running_loop()
    _send(process, signal.SIGINT)
    for count, number in enumerate((signal.SIGTERM, signal.SIGKILL), start=1):
        loop.call_later(count * PATIENCE, _send, process, number)


def _send(process: asyncio.subprocess.Process, number: int) -> None:
    if process.returncode is None:
        with suppress(ProcessLookupError):
            # It leads a group of its own: a shell alone would not pass the signal on.
            os.killpg(process.pid, number)
