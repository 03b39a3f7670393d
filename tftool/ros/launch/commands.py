"""Commands of the system, run beside the nodes."""

import asyncio
import shlex
import signal
import subprocess
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from tftool.base.errors import UsageError

LONGEST_LINE: Final = 1 << 20
"""Bytes of a command's output after which a line is shown though it has not ended."""

LONGEST_RUN: Final = 60.0
"""Seconds of real time that a command may keep simulated time, or a launch file, waiting."""


@dataclass(frozen=True, slots=True)
class SystemCommand:
    """A command of the system.

    Attributes:
        words: It and its arguments.
        environment: Its environment variables, all of them.
        cwd: Where it runs; None for here.
    """

    words: Sequence[str]
    environment: Mapping[str, str]
    cwd: str | None


def run_at_once(command: SystemCommand, say: Callable[[str], object]) -> tuple[int, str]:
    """Run a command to its end, killing it if that does not come; `say` is told its lines.

    Returns:
        Its exit status, and why it was killed ("" if it was not).

    Raises:
        UsageError: If it cannot be run.
    """
    reason = ""
    try:
        done = subprocess.run(
            command.words,
            env=dict(command.environment),
            cwd=command.cwd,
            capture_output=True,
            check=False,
            timeout=LONGEST_RUN,
        )
        output, status = done.stdout + done.stderr, done.returncode
    except subprocess.TimeoutExpired as error:
        output, status = (error.stdout or b"") + (error.stderr or b""), -signal.SIGKILL
        reason = (
            f"'{shlex.join(command.words)}' had not ended after {LONGEST_RUN:g} s, and simulated "
            "time waits for a command's end; start one that goes on running by itself"
        )
    except OSError as error:
        raise _cannot_run(command, error) from None
    for line in output.decode(errors="replace").splitlines():
        say(line)
    return status, reason


async def begin(command: SystemCommand) -> asyncio.subprocess.Process:
    """Start a command, leading a group of its own.

    Raises:
        UsageError: If it cannot be run.
    """
    try:
        return await asyncio.create_subprocess_exec(
            *command.words,
            env=dict(command.environment),
            cwd=command.cwd,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.STDOUT,
            start_new_session=True,
        )
    except OSError as error:
        raise _cannot_run(command, error) from None


def _cannot_run(command: SystemCommand, error: OSError) -> UsageError:
    # A folder that is not there is told in the same words as a command that is not.
    missing = "" if error.filename in (None, command.words[0]) else f" '{error.filename}'"
    return UsageError(f"cannot run '{command.words[0]}': {error.strerror}{missing}")


async def lines_of(stream: asyncio.StreamReader) -> AsyncIterator[str]:
    """What a command writes, line by line.

    asyncio's own reader raises where a line is longer than 64 KiB.
    """
    rest = b""
    while chunk := await stream.read(1 << 16):
        *lines, rest = (rest + chunk).split(b"\n")
        if len(rest) > LONGEST_LINE:
            lines.append(rest)
            rest = b""
        for line in lines:
            yield line.decode(errors="replace")
    if rest:
        yield rest.decode(errors="replace")
