"""System commands in launch files, run as child processes of tftool."""

import asyncio
import contextlib
import errno
import os
import signal
import sys
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

from tftool.base.errors import UsageError
from tftool.ros.host.fibers import finish
from tftool.world.clock import held, paced
from tftool.world.node import Node

LONGEST_LINE: Final = 1 << 20
"""Bytes of output without a line end that are passed on as a line of their own."""

LONGEST_RUN: Final = 60.0
"""Real seconds for which a launch file waits for the output of a command."""

LONGEST_HOLD: Final = 10.0
"""Real seconds for which simulated time waits for a command to end."""


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


OnStart = Callable[[asyncio.subprocess.Process], object]
OnLine = Callable[[str, bool], object]

Streams = Sequence[tuple[asyncio.StreamReader, bool]]
"""Output streams of a command, as (stream, whether the stream is standard output)."""


async def start_command(command: SystemCommand) -> tuple[asyncio.subprocess.Process, Streams]:
    """Start a command in a new process group; return the process and its output streams.

    Raises:
        UsageError: If the command cannot be run.
    """
    ours, output = os.openpty() if command.emulate_tty else (None, asyncio.subprocess.PIPE)
    try:
        process = await asyncio.create_subprocess_exec(
            *command.words,
            env=dict(command.environment),
            cwd=command.cwd,
            # As in ROS 2, a command does not read tftool's own input.
            stdin=asyncio.subprocess.PIPE,
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
    # The error text for a missing folder has the same form as for a missing command.
    missing = "" if error.filename in (None, command.words[0]) else f" '{error.filename}'"
    return UsageError(f"cannot run '{command.words[0]}': {error.strerror}{missing}")


async def _chunk_of(stream: asyncio.StreamReader) -> bytes:
    try:
        return await stream.read(1 << 16)
    except OSError as error:
        if error.errno == errno.EIO:  # the end of a terminal, on Linux
            return b""
        raise


async def read_lines(stream: asyncio.StreamReader) -> AsyncIterator[str]:
    """Yield the lines of a command's output; split lines longer than 1 MiB.

    The method `readline` of the stream would raise an error at 64 KiB.
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
    """Send SIGINT to a process and its children; if they do not end, SIGTERM and later SIGKILL."""
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


class CommandRunner:
    """Runner of the system commands of one launch."""

    def __init__(self, node: Node, warn: Callable[[str], object], *, stops_time: bool) -> None:
        """Create a runner for the system commands of the launch `node`.

        Args:
            node: The launch, whose clock the commands use.
            warn: Function called with the text of each warning.
            stops_time: Whether simulated time stops until a command ends, at most for
                `LONGEST_HOLD` real seconds. If false, simulated time advances no faster than real
                time during a command.
        """
        self._node = node
        self._warn = warn
        self._stops_time = stops_time
        self._turns = asyncio.Lock()
        self._limit: asyncio.Future[None] | None = None
        self._is_ending = False

    def end(self) -> None:
        """Let simulated time continue at once, because the user has interrupted the launch."""
        self._is_ending = True
        if self._limit is not None:
            finish(self._limit)

    async def run(
        self, command: SystemCommand, label: str, on_start: OnStart, on_line: OnLine
    ) -> int:
        """Run a command until it ends; return its exit status.

        `on_start` is called with the process, so that the caller can interrupt the process. For a
        short command that ends while simulated time is stopped, `on_start` is not called. `on_line`
        is called with each line of output, and with True for a line of standard output.

        Raises:
            UsageError: If the command cannot be started.
        """
        if self._stops_time and not self._is_ending:
            # One command after the other, so that every run gives the same lines.
            async with self._turns:
                running = await self._run_in_stopped_time(command, label, on_start, on_line)
        else:
            running = asyncio.ensure_future(_run(command, on_start, on_line))
        with paced(self._node.clock):
            return await running

    async def _run_in_stopped_time(
        self, command: SystemCommand, label: str, on_start: OnStart, on_line: OnLine
    ) -> "asyncio.Task[int]":
        """Start a command while simulated time is stopped; return the task that runs the command.

        Return when the command has ended or `LONGEST_HOLD` real seconds have passed.
        """
        clock = self._node.clock
        early: list[tuple[str, bool]] = []
        started: list[asyncio.subprocess.Process] = []
        is_held = True

        def take(line: str, is_stdout: bool) -> None:
            if is_held:
                early.append((line, is_stdout))
            else:
                on_line(line, is_stdout)

        with held(clock):
            running = asyncio.ensure_future(_run(command, started.append, take))
            self._limit = clock.real_timer(LONGEST_HOLD)
            running.add_done_callback(partial(finish, self._limit))
            await self._limit
        # Wait for this instant's programs, whose output would otherwise mix with the lines by
        # chance.
        await clock.timer(clock.now(), self._node.phase, self._node.rank)
        is_held = False
        for line, is_stdout in early:
            on_line(line, is_stdout)
        if not running.done():
            for process in started:
                on_start(process)
            if not self._is_ending:
                self._warn(
                    f"{label} has not ended after {LONGEST_HOLD:g} s: from now on simulated time "
                    "passes no faster than real time"
                )
        return running


async def _run(command: SystemCommand, on_start: OnStart, on_line: OnLine) -> int:
    process, streams = await start_command(command)
    on_start(process)

    async def read(stream: asyncio.StreamReader, is_stdout: bool) -> None:
        async for line in read_lines(stream):
            on_line(line, is_stdout)

    await asyncio.gather(*(read(*one) for one in streams))
    return await process.wait()
