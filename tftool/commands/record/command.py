"""`tftool record`: a session as a recording."""

import json
import re
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.near_names import near_names
from tftool.base.short_numbers import count, short_size
from tftool.base.stamps import seconds
from tftool.commands.record import RecordOptions
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.interrupts import interruptible
from tftool.commands.shared.open_from import NO_SESSION
from tftool.commands.shared.record_loop import RecordingRun, tell
from tftool.doctor.judge import CHECKS
from tftool.recordings.compression import best_compression
from tftool.recordings.rolling_writer import RecordLimits, RollingRecording
from tftool.scenario import builtin
from tftool.world.clock import pace_of
from tftool.world.nodes.recorder import Recorder

_SIZE = re.compile(r"(\d+(?:\.\d+)?)\s*([kMG]?)(?:i?B)?", re.ASCII)


_UNITS = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}


_LEAST_SIZE = 100_000


RING = seconds(60)
"""How much of the past is kept with `--on` where nothing is said."""


@contextmanager
def _ended_by_hangup() -> Iterator[None]:
    """End the recording as Ctrl-C does when the terminal is closed."""
    if not hasattr(signal, "SIGHUP") or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGHUP, lambda *_: signal.raise_signal(signal.SIGTERM))
    try:
        yield
    finally:
        signal.signal(signal.SIGHUP, before)


def _as_json(output: Path, running: RecordingRun) -> str:
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


def _summed_up(rolling: RollingRecording) -> str:

    many = f" in {len(rolling.files)} files" if len(rolling.files) > 1 else ""
    return (
        f"{visible(str(rolling.path))}: {count(rolling.messages, 'message')}, "
        f"{count(rolling.transforms, 'transform')}, {short_size(rolling.size)}{many}"
    )


def _size(text: str | None) -> int:
    """Parse a size such as 500MB."""
    if text is None:
        return 0
    match = _SIZE.fullmatch(text.strip())
    if match is None:
        raise UsageError(f"--max-size takes a number and k, M or G, such as 500M, not '{text}'.")
    found = int(float(match[1]) * _UNITS[match[2]])
    if found < _LEAST_SIZE:
        raise UsageError(f"--max-size {text} is too small: 100k is the minimum.")
    return found


def _refuse_places(topics: Sequence[str]) -> None:
    """Refuse a scenario or file given in place of a topic's name.

    Raises:
        UsageError: If one does.
    """
    for word in topics:
        if word.startswith("/"):
            continue
        if builtin.path_of(word) is not None or Path(word).is_file():
            shown = visible(word)
            raise UsageError(
                f"'{shown}' is a scenario or a file, and the words here are topics: --in {shown} "
                f"records a scenario, /{shown} a topic of that name."
            )


def _check_finding(name: str) -> None:

    if name not in CHECKS:
        near = near_names(name, CHECKS, 3)
        hint = (
            f"did you mean {' or '.join(near)}?" if near else "'tftool doctor --list' names them."
        )
        raise UsageError(f"--on: the doctor has no finding '{name}'; {hint}")


def run(connection: Connection, options: RecordOptions) -> ExitStatus:
    """Run `tftool record`."""
    ring = options.ring
    if options.finding is not None:
        _check_finding(options.finding)
        ring = ring or RING
    if ring is not None and (options.max_size or options.max_duration):
        raise UsageError(
            "--ring writes one file at the end: leave out --max-size and --max-duration."
        )
    _refuse_places(options.topics or ())
    limits = RecordLimits(_size(options.max_size), options.max_duration or 0, ring or 0)
    running: RecordingRun | None = None
    with interruptible(), _ended_by_hangup():
        rolling = RollingRecording(
            options.output, limits, compression=best_compression(), force=options.force
        )
        try:
            session = open_session(connection, options.place, because=NO_SESSION)
        except BaseException:
            rolling.discard()
            raise
        world = session.world

        async def recorded() -> None:
            nonlocal running
            link = None if session.is_hosted else session.link
            recorder = Recorder(
                world, rolling, link=link, names=options.topics or (), everything=options.everything
            )
            running = RecordingRun(recorder, rolling, pace_of(world.clock), options.finding)
            try:
                await running.run(options.run_for)
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
            # Whatever ends it, the recording is kept.
            rolling.close()
    assert running is not None
    tell(rolling, running.recorder)
    if options.for_programs:
        sys.stdout.write(f"{_as_json(options.output, running)}\n")
    else:
        if running.found is not None:
            sys.stdout.write(f"{visible(running.found.message)}\n")
        sys.stdout.write(f"{_summed_up(rolling)}\n")
    return ExitStatus.DONE if running.found is None else ExitStatus.FAILED
