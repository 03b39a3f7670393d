"""System commands of launch files, run as processes beside the nodes."""

import asyncio
import contextlib
import errno
import os
import shlex
import signal
import subprocess
import sys
import threading
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
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
        cwd: Working directory; None for the current one.
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
    reason, errors = "", b""
    try:
        if command.emulate_tty:
            output, status = _run_on_terminal(command)
        else:
            done = subprocess.run(
                command.words,
                env=dict(command.environment),
                cwd=command.cwd,
                capture_output=True,
                check=False,
                timeout=LONGEST_RUN,
            )
            output, errors, status = done.stdout, done.stderr, done.returncode
    except subprocess.TimeoutExpired as error:
        output, errors, status = error.stdout or b"", error.stderr or b"", -signal.SIGKILL
        reason = (
            f"'{shlex.join(command.words)}' had not ended after {LONGEST_RUN:g} s, and simulated "
            "time waits for a command's end; start one that goes on running by itself"
        )
    except OSError as error:
        raise _cannot_run(command, error) from None
    for written, is_stdout in ((output, True), (errors, False)):
        for line in written.decode(errors="replace").splitlines():
            say(line, is_stdout)
    return status, reason


def _run_on_terminal(command: SystemCommand) -> tuple[bytes, int]:
    """Run a command with a terminal for its output; return the output and the exit status.

    Raises:
        subprocess.TimeoutExpired: If the command was killed after `LONGEST_RUN` seconds.
        OSError: If the command cannot be started.
    """
    ours, theirs = os.openpty()
    chunks: list[bytes] = []

    def drain() -> None:
        # The end of a terminal is an error on Linux.
        with contextlib.suppress(OSError):
            while chunk := os.read(ours, 1 << 16):
                chunks.append(chunk)

    try:
        try:
            process = subprocess.Popen(
                command.words,
                env=dict(command.environment),
                cwd=command.cwd,
                stdout=theirs,
                stderr=subprocess.STDOUT,
            )
        finally:
            os.close(theirs)
        reader = threading.Thread(target=drain, name="terminal", daemon=True)
        reader.start()
        try:
            status = process.wait(LONGEST_RUN)
        except subprocess.TimeoutExpired as error:
            process.kill()
            process.wait()
            error.stdout = b"".join(chunks)
            raise
        reader.join(1.0)
        return b"".join(chunks), status
    finally:
        os.close(ours)


async def begin(command: SystemCommand) -> tuple[asyncio.subprocess.Process, Streams]:
    """Start a command in its own process group; return the process and its output streams.

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
            start_new_session=True,
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
    # A folder that is not there is told in the same words as a command that is not.
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
            # It leads a group of its own: a shell alone would not pass the signal on.
            os.killpg(process.pid, number)
