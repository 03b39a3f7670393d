"""System commands of launch files, run as processes beside the nodes."""

import asyncio
import contextlib
import errno
import os
import shlex
import signal
import sys
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Final

from tftool.base.errors import UsageError

LONGEST_LINE: Final = 1 << 20
"""Bytes of an output line that has not ended, after which its beginning counts as a line."""

LONGEST_RUN: Final = 60.0
"""Real seconds for which simulated time, or a launch file, waits for a command to end."""


@dataclass(frozen=True, slots=True)
class SystemCommand:
    """Command to run as a process.

    Attributes:
        words: The command and its arguments.
        environment: All environment variables of the process.
        cwd: Working directory; None for tftool's own.
        emulate_tty: Whether the command's output is a terminal instead of a pipe.
    """

    words: Sequence[str]
    environment: Mapping[str, str]
    cwd: str | None
    emulate_tty: bool = False


Streams = Sequence[tuple[asyncio.StreamReader, bool]]
"""Streams of a command's output, each with whether it is the standard output."""


def run_at_once(command: SystemCommand, say: Callable[[str, bool], object]) -> tuple[int, str]:
    """Run a command to its end, or kill it after `LONGEST_RUN` seconds.

    Args:
        command: Command to run.
        say: Function called with each output line, and whether it is from standard output.

    Returns:
        Exit status, and the reason if the command was killed ("" if not).

    Raises:
        UsageError: If the command cannot be started.
    """
    # The command needs a separate event loop, because the world's loop waits meanwhile.
    with ThreadPoolExecutor(1) as pool:
        lines, status, is_killed = pool.submit(asyncio.run, _run_to_end(command)).result()
    for line, is_stdout in lines:
        say(line, is_stdout)
    reason = (
        f"'{shlex.join(command.words)}' had not ended after {LONGEST_RUN:g} s, and simulated "
        "time waits for a command's end; start one that goes on running by itself"
    )
    return status, reason if is_killed else ""


async def _run_to_end(command: SystemCommand) -> tuple[list[tuple[str, bool]], int, bool]:
    """Run a command; return its output lines, its exit status and whether it was killed."""
    # The command is in tftool's process group, so that Ctrl-C ends the command too.
    process, streams = await begin(command, leads_group=False)
    lines: list[tuple[str, bool]] = []

    async def read(stream: asyncio.StreamReader, is_stdout: bool) -> None:
        async for line in lines_of(stream):
            # One list for both streams has the lines in the order of their arrival.
            lines.append((line, is_stdout))  # noqa: PERF401

    _, late = await asyncio.wait(
        [asyncio.ensure_future(read(*one)) for one in streams], timeout=LONGEST_RUN
    )
    if late:
        process.kill()
    return lines, await process.wait(), bool(late)


async def begin(
    command: SystemCommand, *, leads_group: bool = True
) -> tuple[asyncio.subprocess.Process, Streams]:
    """Start a command; return the process and its output streams.

    Args:
        command: Command to start.
        leads_group: Whether the process begins a process group of its own.

    Raises:
        UsageError: If the command cannot be run.
    """
    ours, output = os.openpty() if command.emulate_tty else (None, asyncio.subprocess.PIPE)
    try:
        process = await asyncio.create_subprocess_exec(
            *command.words,
            env=dict(command.environment),
            cwd=command.cwd,
            stdout=output,
            stderr=output,
            start_new_session=leads_group,
        )
    except OSError as error:
        if ours is not None:
            os.close(ours)
        raise _cannot_run(command, error) from None
    finally:
        if ours is not None:
            os.close(output)
    if ours is None:
        assert process.stdout is not None
        assert process.stderr is not None
        return process, ((process.stdout, True), (process.stderr, False))
    reader = asyncio.StreamReader()
    await asyncio.get_running_loop().connect_read_pipe(
        lambda: asyncio.StreamReaderProtocol(reader), os.fdopen(ours, "rb", buffering=0)
    )
    return process, ((reader, True),)


def _cannot_run(command: SystemCommand, error: OSError) -> UsageError:
    # The error text for a missing folder has the form of the one for a missing command.
    missing = "" if error.filename in (None, command.words[0]) else f" '{error.filename}'"
    return UsageError(f"cannot run '{command.words[0]}': {error.strerror}{missing}")


async def _chunk_of(stream: asyncio.StreamReader) -> bytes:
    try:
        return await stream.read(1 << 16)
    except OSError as error:
        if error.errno == errno.EIO:  # the end of a terminal, on Linux
            return b""
        raise


async def lines_of(stream: asyncio.StreamReader) -> AsyncIterator[str]:
    """Yield the lines of a command's output stream, of any length up to 1 MiB.

    asyncio's own reader raises for a line longer than 64 KiB.
    """
    rest = b""
    while chunk := await _chunk_of(stream):
        *lines, rest = (rest + chunk).split(b"\n")
        if len(rest) > LONGEST_LINE:
            lines.append(rest)
            rest = b""
        for line in lines:
            yield line.removesuffix(b"\r").decode(errors="replace")
    if rest:
        yield rest.decode(errors="replace")


PATIENCE = 5.0
"""Real seconds between two signals to a process that does not end; the same as in ROS 2."""


def interrupt(process: asyncio.subprocess.Process) -> None:
    """End a process and its children by SIGINT; if they go on, by SIGTERM, then SIGKILL."""
    if sys.platform == "win32":
        process.terminate()
        return
    loop = asyncio.get_running_loop()
    _send(process, signal.SIGINT)
    for count, number in enumerate((signal.SIGTERM, signal.SIGKILL), start=1):
        loop.call_later(count * PATIENCE, _send, process, number)


def _send(process: asyncio.subprocess.Process, number: int) -> None:
    if process.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            # The command has its own process group: a shell would not pass the signal to its
            # children.
            os.killpg(process.pid, number)
