"""`tftool record`: a session as a recording."""

import json
import re
import signal
import sys
import threading
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.near_names import near_names
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.options import OUTPUT, WHEN, Force, Json, RunFor, option, seconds_option

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tftool.commands.shared.connection import Connection
    from tftool.commands.shared.record_loop import RecordingRun
    from tftool.recordings.rolling_writer import RollingRecording

_SIZE = re.compile(r"(\d+(?:\.\d+)?)\s*([kMG]?)(?:i?B)?", re.ASCII)
_UNITS = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}
_LEAST_SIZE = 100_000
RING = seconds(60)
"""How much of the past is kept with `--on` where nothing is said."""


def record(
    connection: "Connection",
    output: Annotated[
        Path,
        option(
            "What to write: a name ending in .mcap, or without a suffix a folder.",
            "--output",
            "-o",
            metavar="FILE",
            panel=OUTPUT,
        ),
    ],
    topics: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[TOPIC]...", help="Topics beside /tf and /tf_static.", show_default=False
        ),
    ] = None,
    everything: Annotated[bool, option("Record every topic.", "--all")] = False,
    place: Annotated[
        str | None,
        option("Host this scenario, and record what it does.", "--in", metavar="SCENARIO"),
    ] = None,
    run_for: RunFor = None,
    ring: Annotated[
        Duration | None,
        seconds_option("Keep only so much of the past, in memory, and write it in the end."),
    ] = None,
    finding: Annotated[
        str | None,
        option(
            "Write the last minute (--ring) when the doctor finds this, and stop.",
            "--on",
            metavar="FINDING",
            panel=WHEN,
        ),
    ] = None,
    max_size: Annotated[
        str | None,
        option("Begin a new file from a size on: 500M, 2G.", metavar="SIZE", panel=OUTPUT),
    ] = None,
    max_duration: Annotated[
        Duration | None, seconds_option("Begin a new file after so long.", panel=OUTPUT)
    ] = None,
    force: Force = False,
    for_programs: Json = False,
) -> ExitStatus:
    """Record a session (ros2 bag record).

    Every file begins with all statics. Ctrl-C ends it; what a recorder that was killed leaves,
    a second is missing from at most, and 'tftool edit' makes it whole.

    tftool record -o run.mcap
    tftool record -o long --max-duration 600 --all
    tftool record -o before.mcap --ring 30 --on two-parents
    """
    from tftool.base.escaping import visible
    from tftool.commands.shared.hosting import NO_SESSION, open_session
    from tftool.commands.shared.interrupts import interruptible
    from tftool.commands.shared.record_loop import RecordingRun, tell
    from tftool.recordings.compression import best_compression
    from tftool.recordings.rolling_writer import RecordLimits, RollingRecording
    from tftool.world.clock import pace_of
    from tftool.world.nodes.recorder import Recorder

    if finding is not None:
        _check_finding(finding)
        ring = ring or RING
    if ring is not None and (max_size or max_duration):
        raise UsageError(
            "--ring writes one file in the end: leave out --max-size and --max-duration."
        )
    _refuse_places(topics or ())
    limits = RecordLimits(_size(max_size), max_duration or 0, ring or 0)
    running: RecordingRun | None = None
    with interruptible(), _ended_by_hangup():
        rolling = RollingRecording(output, limits, compression=best_compression(), force=force)
        try:
            session = open_session(connection, place, needs_messages=True, because=NO_SESSION)
        except BaseException:
            rolling.discard()
            raise
        world = session.world

        async def recorded() -> None:
            nonlocal running
            link = None if session.is_hosted else session.link
            recorder = Recorder(
                world, rolling, link=link, names=topics or (), everything=everything
            )
            running = RecordingRun(recorder, rolling, pace_of(world.clock), finding)
            try:
                await running.run(run_for)
            finally:
                recorder.close()
                running.clear()

        try:
            session.run(recorded())
        except KeyboardInterrupt:
            rolling.close()
            sys.stdout.write(f"{_summed_up(rolling)}\n")
            raise
        finally:
            # Whatever ends it: what was recorded is kept.
            rolling.close()
    assert running is not None
    tell(rolling, running.recorder)
    if for_programs:
        sys.stdout.write(f"{_as_json(output, running)}\n")
    else:
        if running.found is not None:
            sys.stdout.write(f"{visible(running.found.message)}\n")
        sys.stdout.write(f"{_summed_up(rolling)}\n")
    return ExitStatus.DONE if running.found is None else ExitStatus.FAILED


@contextmanager
def _ended_by_hangup() -> "Iterator[None]":
    """Let a terminal that is closed end it as Ctrl-C does."""
    if not hasattr(signal, "SIGHUP") or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGHUP, lambda *_: signal.raise_signal(signal.SIGTERM))
    try:
        yield
    finally:
        signal.signal(signal.SIGHUP, before)


def _as_json(output: Path, running: "RecordingRun") -> str:
    rolling = running.rolling
    document = {
        "output": str(output),
        "files": rolling.files,
        "messages": rolling.messages,
        "transforms": rolling.transforms,
        "topics": sorted(running.recorder.topics),
        "finding": running.found.message if running.found is not None else None,
    }
    return json.dumps(document, indent=2)


def _summed_up(rolling: "RollingRecording") -> str:
    from tftool.base.counts import count
    from tftool.base.escaping import visible
    from tftool.base.short_numbers import short_size

    many = f" in {len(rolling.files)} files" if len(rolling.files) > 1 else ""
    return (
        f"{visible(str(rolling.path))}: {count(rolling.messages, 'message')}, "
        f"{count(rolling.transforms, 'transform')}, {short_size(rolling.size)}{many}"
    )


def _size(text: str | None) -> int:
    """A size as people write it."""
    if text is None:
        return 0
    match = _SIZE.fullmatch(text.strip())
    if match is None:
        raise UsageError(f"--max-size takes a number and k, M or G, such as 500M, not '{text}'.")
    found = int(float(match[1]) * _UNITS[match[2]])
    if found < _LEAST_SIZE:
        raise UsageError(f"--max-size {text} is less than a file needs: 100k at least.")
    return found


def _refuse_places(topics: "Sequence[str]") -> None:
    """See that no scenario or file stands where a topic's name is wanted.

    Raises:
        UsageError: If one does.
    """
    from tftool.base.escaping import visible
    from tftool.scenario import builtin

    for word in topics:
        if word.startswith("/"):
            continue
        if builtin.path_of(word) is not None or Path(word).is_file():
            shown = visible(word)
            raise UsageError(
                f"'{shown}' is a scenario or a file, and topics are named here: --in {shown} "
                f"records a scenario, /{shown} a topic of that name."
            )


def _check_finding(name: str) -> None:
    from tftool.doctor.judge import CHECKS

    if name not in CHECKS:
        near = near_names(name, CHECKS, 3)
        hint = (
            f"did you mean {' or '.join(near)}?" if near else "'tftool doctor --list' names them."
        )
        raise UsageError(f"--on: the doctor has no finding '{name}'; {hint}")
