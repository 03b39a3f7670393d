"""Implementation of `tftool record`: record a session."""

import json
import os
import re
import shutil
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tftool.base.errors import MalformedMessage, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count, near_names, short_size, visible
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.commands.record import RecordOptions
from tftool.commands.shared.connection import NO_SESSION, Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import notice
from tftool.commands.shared.progress_bars import interruptible
from tftool.doctor.evidence import evidence_of_log
from tftool.doctor.judge import CHECKS, judge
from tftool.frames.transform_log import TransformLog
from tftool.messages.transforms import decode_transforms
from tftool.recordings.decompression import best_compression
from tftool.recordings.rolling_writer import Kept, RecordLimits, RollingRecording
from tftool.scenario import builtin
from tftool.world.clock import Clock, Phase, pace_of
from tftool.world.nodes.recorder import Recorder

if TYPE_CHECKING:
    from tftool.doctor.findings import Finding


TICK: Final = seconds(0.25)
"""Nanoseconds between two searches for new topics, which also close chunks and redraw the line."""

LOOK_EVERY: Final = seconds(2)
"""Nanoseconds between two examinations of the ring buffer by the doctor."""

MOST_JUDGED: Final = 20_000
"""Most messages that the doctor examines, the newest, so that it ends within `LOOK_EVERY`."""

_ERASE: Final = "\r\x1b[K"


class RecordingRun:
    """Loop that writes messages to a file until a time limit, a finding, or a stop by the user."""

    def __init__(
        self,
        recorder: Recorder,
        rolling: RollingRecording,
        clock: Clock,
        finding: str | None = None,
    ) -> None:
        """Prepare the recording.

        Args:
            recorder: Recorder, which receives the messages.
            rolling: Writer of the recording.
            clock: Clock that times the writing.
            finding: Id of the doctor's finding that ends the recording; None to ignore findings.
        """
        self.recorder = recorder
        self.rolling = rolling
        self.found: Finding | None = None
        self._clock = clock
        self._finding = finding
        self._start = clock.now()
        self._before = (self._start, 0)
        self._rate = 0.0
        self._is_terminal = sys.stderr.isatty() and os.environ.get("TERM") != "dumb"

    async def run(self, duration: Duration | None) -> None:
        """Record for `duration`, or until the doctor has the requested finding or the user stops.

        Args:
            duration: Nanoseconds to record; None for no end.

        Raises:
            InputError: If the file cannot be written any more; the part written so far is readable.
        """
        clock = self._clock
        end = None if duration is None else clock.now() + duration
        looked = due = clock.now()
        while self.found is None and (end is None or due < end):
            due = due + TICK if end is None else min(due + TICK, end)
            await clock.sleep_until(due, Phase.WATCH)
            now = clock.now()
            self.recorder.refresh()
            self.rolling.tick(now)
            self._draw(now)
            if self._finding is not None and now - looked >= LOOK_EVERY:
                looked = now
                self.found = self._look(now)

    def _look(self, now: Stamp) -> "Finding | None":
        """Let the doctor examine the ring buffer; return the requested finding, or None."""
        assert self._finding is not None
        held = self.rolling.held()
        material = evidence_of_log(
            heard(held[-MOST_JUDGED:]),
            "live session",
            "live session",
            held[0].log_time if held else now,
            now,
        )
        diagnosis = judge(material, select=[self._finding])
        return next(iter(diagnosis.findings), None)

    def _draw(self, now: Stamp) -> None:
        """Redraw the progress line, if stderr is a terminal."""
        if not self._is_terminal:
            return
        then, count = self._before
        if now - then >= seconds(1):
            self._rate = (self.rolling.transforms - count) / as_seconds(now - then)
            self._before = now, self.rolling.transforms
        rolling = self.rolling
        text = (
            f"{visible(rolling.path.name)}  {as_seconds(now - self._start):.1f} s  "
            f"{self._rate:.0f} transforms/s  {rolling.transforms} transforms  "
            f"{short_size(rolling.size)}  {len(self.recorder.topics)} topics"
        )
        width = shutil.get_terminal_size().columns - 1
        sys.stderr.write(_ERASE + text[:width])
        sys.stderr.flush()

    def clear(self) -> None:
        """Erase the progress line."""
        if self._is_terminal:
            sys.stderr.write(_ERASE)
            sys.stderr.flush()


def heard(messages: list[Kept]) -> TransformLog:
    """Return the transforms of recorded messages as a log for the doctor."""
    hearing = TransformLog()
    for channel, log_time, payload, _ in messages:
        if channel.type != "tf2_msgs/msg/TFMessage":
            continue
        with suppress(MalformedMessage):
            transforms = decode_transforms(payload)
            node = channel.extra("callerid").strip("/")
            is_static = channel.topic.endswith("tf_static")
            hearing.hear(log_time, transforms, node or channel.topic, is_static=is_static)
    return hearing


def tell(rolling: RollingRecording, recorder: Recorder) -> None:
    """Report topics that were not recorded or never published, and a lack of transforms."""
    for name, reason in recorder.left_out.items():
        notice(f"'{visible(name)}' is not recorded: {visible(reason)}.")
    for name in recorder.missing:
        notice(f"'{visible(name)}' was never published.")
    if not rolling.transforms:
        notice("No transform arrived: check with 'tftool monitor' what is published.")


_SIZE = re.compile(r"(\d+(?:\.\d+)?)\s*([kMG]?)(?:i?B)?", re.ASCII)


_UNITS = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}


_LEAST_SIZE = 100_000


RING = seconds(60)
"""Nanoseconds that the ring buffer of `--on` stores by default."""


@contextmanager
def _ended_by_hangup() -> Iterator[None]:
    """Within this block, handle a closed terminal (SIGHUP) like Ctrl-C: end the recording."""
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
    """Parse a number of bytes, such as 500M; return 0 for None."""
    if text is None:
        return 0
    match = _SIZE.fullmatch(text.strip())
    if match is None:
        raise UsageError(f"--max-size must be a number with k, M or G, such as 500M, not '{text}'.")
    found = int(float(match[1]) * _UNITS[match[2]])
    if found < _LEAST_SIZE:
        raise UsageError(f"--max-size {text} is too small: 100k is the minimum.")
    return found


def _refuse_places(topics: Sequence[str]) -> None:
    """Raise UsageError if a word is a scenario or file instead of a topic's name."""
    for word in topics:
        if word.startswith("/"):
            continue
        if builtin.path_of(word) is not None or Path(word).is_file():
            shown = visible(word)
            raise UsageError(
                f"'{shown}' is a scenario or a file, but only topics are expected here: write "
                f"--in {shown} to record a scenario, or /{shown} for a topic of that name."
            )


def _check_finding(name: str) -> None:
    if name not in CHECKS:
        near = near_names(name, CHECKS, 3)
        hint = (
            f"did you mean {' or '.join(near)}?" if near else "'tftool doctor --list' names them."
        )
        raise UsageError(
            f"--on needs the id of a check of the doctor, and '{name}' is not an id; {hint}"
        )


def run(connection: Connection, options: RecordOptions) -> ExitStatus:
    """Run `tftool record`: record a session to a file."""
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
            # However the run ends, the recording is completed.
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
