"""Loop of `tftool record`: write messages, watch for findings, show progress."""

import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tftool.base.errors import MalformedMessage
from tftool.base.escaping import visible
from tftool.base.short_numbers import short_size
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.commands.shared.notices import notice
from tftool.doctor.evidence import evidence_of_log
from tftool.doctor.judge import judge
from tftool.frames.transform_log import TransformLog
from tftool.messages.transforms import decode_transforms
from tftool.recordings.compression import best_compression
from tftool.recordings.rolling_writer import Kept, RollingRecording
from tftool.world.clock import Clock, Phase
from tftool.world.nodes.recorder import Recorder
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.doctor.findings import Finding

TICK: Final = seconds(0.25)
"""How often new topics are looked for, chunks closed and the line drawn."""

LOOK_EVERY: Final = seconds(2)
"""How often the doctor looks at what the ring holds."""

MOST_JUDGED: Final = 20_000
"""Messages that are looked at, the newest: it must take less than the time between two looks."""

_ERASE: Final = "\r\x1b[K"


class RecordingRun:
    """One run of a recorder, on one clock."""

    def __init__(
        self,
        recorder: Recorder,
        rolling: RollingRecording,
        clock: Clock,
        finding: str | None = None,
    ) -> None:
        """Make a run of a recorder.

        Args:
            recorder: The recorder.
            rolling: Writer of the recording.
            clock: When to look.
            finding: Id of the finding that ends recording; None for none.
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
        """Record for `duration` nanoseconds or until a finding; without either until stopped.

        Raises:
            InputError: If it cannot be written any more; the data so far is readable.
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
        """Whether the doctor reports the finding for the content of the ring buffer."""
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
        """Redraw the line, if stderr is a terminal."""
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
        """Erase the line."""
        if self._is_terminal:
            sys.stderr.write(_ERASE)
            sys.stderr.flush()


@contextmanager
def recorded(world: World, path: Path, *, force: bool = False) -> Iterator[RollingRecording]:
    """Record all topics of this process's world while the block runs.

    Raises:
        UsageError: If something has that name and `force` is not given.
        InputError: If it cannot be written.
    """
    rolling = RollingRecording(path, compression=best_compression(), force=force)
    recorder = Recorder(world, rolling, everything=True)
    try:
        yield rolling
        recorder.refresh()
    finally:
        recorder.close()
        rolling.close()


def heard(messages: list[Kept]) -> TransformLog:
    """Return the content of some messages in the doctor's form."""
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
    """Report the numbers of recorded and missed messages."""
    for name, reason in recorder.left_out.items():
        notice(f"'{visible(name)}' is not recorded: {visible(reason)}.")
    for name in recorder.missing:
        notice(f"'{visible(name)}' was never published.")
    if not rolling.transforms:
        notice("No transform arrived: 'tftool monitor' shows the traffic.")
