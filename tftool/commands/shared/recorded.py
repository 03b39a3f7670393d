"""A recording as FROM: opened with a bar where reading takes time, its damage told once."""

import os
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from tftool.base.counts import count
from tftool.base.escaping import visible
from tftool.base.stamps import seconds
from tftool.commands.shared.notices import notice
from tftool.world.clock import WallClock

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

    from rich.progress import Progress, TaskID

    from tftool.buffer.sample import TransformStamped
    from tftool.commands.shared.robot_at_rest import StoredFrames
    from tftool.frames.source_options import RecordingOptions, RobotOptions
    from tftool.recordings.description_frames import DescribedFrames
    from tftool.recordings.find import Found
    from tftool.recordings.recording import Recording
    from tftool.robots.robot_model import Robot

PATIENCE = seconds(0.5)
"""How long reading goes on before a bar shows."""

_REDRAWN = seconds(0.1)
_MOST_NOTICES = 8
_LONGEST_NAME = 24


def read(
    found: "Found",
    urdf: "RobotOptions | None" = None,
    options: "RecordingOptions | None" = None,
) -> "Recording":
    """Open a recording and read its transforms.

    Args:
        found: The recording.
        urdf: The description of its robot, where one is given.
        options: How it is read.

    Raises:
        InputError: If it cannot be read.
        UsageError: If it needs an extra that is not installed.
    """
    from tftool.recordings.cache_heads import default_folder
    from tftool.recordings.column_cache import ColumnCache
    from tftool.recordings.recording import open_recording

    with_odometry = options is not None and options.with_odometry
    no_cache = options is not None and options.no_cache
    folder = None if no_cache else default_folder()
    # The end of a path is what tells files apart, and all of it would not fit beside the bar.
    short = found.name.rstrip("/").rpartition("/")[2][-_LONGEST_NAME:]
    bar = Bar(f"Reading {visible(short)}")
    recording = open_recording(
        found.name,
        progress=bar,
        robot=_robot(urdf),
        cache=None if folder is None else ColumnCache(folder),
        with_odometry=with_odometry,
    )
    try:
        _ = recording.transforms
    except BaseException:
        recording.close()
        raise
    finally:
        bar.stop()
    for text in found.told():
        notice(visible(text))
    return recording


def _robot(options: "RobotOptions | None") -> "Robot | None":
    if options is None:
        return None
    if options.joints:
        options.refuse("In a recording joints are where they were")
    if options.urdf is None:
        options.refuse("Only a description takes arguments: give it with --urdf FILE")
        return None
    from tftool.robots.robot_model import load_urdf

    robot = load_urdf(options.urdf, options.arguments)
    for note in robot.notes:
        notice(visible(note))
    return robot


def read_and_tell(
    found: "Found", robot: "RobotOptions | None" = None, options: "RecordingOptions | None" = None
) -> "Recording":
    """The same; what is damaged or odd, and what a description adds, is told on stderr."""
    recording = read(found, robot, options)
    told = [
        *recording.damage,
        *told_of_odometry(recording),
        *_told(recording.described),
        *(f"{text} ({count} times)." for text, count in recording.oddities.items()),
    ]
    for text in told[:_MOST_NOTICES]:
        notice(visible(text))
    if len(told) > _MOST_NOTICES:
        notice(f"... and {len(told) - _MOST_NOTICES} more: 'tftool info {visible(found.name)}'.")
    return recording


def told_of_odometry(recording: "Recording") -> "Iterator[str]":
    """What was taken for transforms, or could be, as sentences."""
    from tftool.recordings.odometry import implying

    for topic in recording.odometry:
        messages = count(topic.count, "message")
        yield f"'{topic.name}' ({topic.type}, {messages}) is taken for transforms."
    if not recording.edges:
        found = [f"'{topic.name}' ({topic.type})" for topic in implying(recording.topics)]
        if found:
            yield (
                "No transform was recorded; --with-odometry takes these messages for some: "
                f"{', '.join(found[:5])}{' …' if len(found) > 5 else ''}."
            )


def _told(described: "DescribedFrames | None") -> "Iterator[str]":
    """What a robot's description added, as sentences."""
    if described is None:
        return
    added = len(described.still) + len(described.moving)
    if added:
        yield (
            f"{count(added, 'frame')} that tf lacks: from the robot's description, "
            f"{len(described.moving)} of them moved by joint states."
        )
    if described.gaps:
        shown = ", ".join(described.gaps[:5]) + (" …" if len(described.gaps) > 5 else "")
        yield (
            f"{count(len(described.gaps), 'link')} without a frame, as neither tf nor joint states "
            f"say where: {shown}."
        )


class Bar:
    """A bar on stderr, if that is a terminal, once reading has taken half a second."""

    def __init__(self, what: str) -> None:
        """Begin to wait.

        Args:
            what: What it says in front, fit for a terminal.
        """
        self._what = what
        self._clock = WallClock()
        self._since = self._drawn = self._clock.now()
        self._progress: Progress | None = None
        self._task: TaskID | None = None
        self._handlers: dict[int, Any] = {}

    def __call__(self, done: int, total: int) -> None:
        """Show how far it has come: bytes, rate, time left."""
        now = self._clock.now()
        if now - self._since < PATIENCE or now - self._drawn < _REDRAWN or not sys.stderr.isatty():
            return
        self._drawn = now
        if self._progress is None:
            self._begin(done, total)
        assert self._progress is not None
        assert self._task is not None
        self._progress.update(self._task, completed=done, total=total)
        self._progress.refresh()

    def _begin(self, done: int, total: int) -> None:
        from rich.console import Console
        from rich.markup import escape
        from rich.progress import (
            BarColumn,
            DownloadColumn,
            Progress,
            TextColumn,
            TimeRemainingColumn,
            TransferSpeedColumn,
        )

        self._progress = Progress(
            TextColumn(escape(self._what)),
            BarColumn(),
            DownloadColumn(),
            TransferSpeedColumn(),
            TimeRemainingColumn(),
            console=Console(stderr=True),
            transient=True,
            auto_refresh=False,
            # Nothing else is printed meanwhile.
            redirect_stdout=False,
            redirect_stderr=False,
        )
        # Drawn as it starts, and shown until the next round: with how far it is by now.
        self._task = self._progress.add_task("", completed=done, total=total)
        self._progress.start()
        # A signal ends the process at once: what it leaves behind must be as it was.
        self._progress.console.show_cursor(True)
        self._erase_when_killed()

    def _erase_when_killed(self) -> None:
        """Take the bar away first when a signal ends the process."""
        import signal
        import threading

        if threading.current_thread() is not threading.main_thread():
            return
        for number in (signal.SIGINT, signal.SIGTERM):
            before = signal.getsignal(number)
            if not callable(before):
                continue

            def leave(
                number: int,
                frame: "FrameType | None",
                before: "Callable[[int, FrameType | None], object]" = before,
            ) -> None:
                # Past Python's own buffer, which the signal may have met in the middle of a write.
                with suppress(OSError):
                    os.write(2, b"\r\x1b[2K")
                before(number, frame)

            signal.signal(number, leave)
            self._handlers[number] = before

    def stop(self) -> None:
        """Take the bar away."""
        import signal

        while self._handlers:
            signal.signal(*self._handlers.popitem())
        if self._progress is not None:
            self._progress.stop()
            self._progress = None


def moments(
    stored: "StoredFrames",
    target: str,
    source: str,
    *,
    rate: float | None,
    topic: str | None,
    most: int | None,
) -> "Iterator[TransformStamped]":
    """Look a pair up at many moments of a recording; how many have no answer goes to stderr.

    Args:
        stored: The recording.
        target: What the answers are expressed in.
        source: What is asked about.
        rate: Moments a second, from the first stamp on; once a second if None.
        topic: Ask at the stamps of its messages instead.
        most: How many to give; all if None.

    Raises:
        InputError: If it has no such topic.
        UsageError: If there are more moments than can be asked for at once.
        TransformException: If the pair cannot be looked up at any of them.
    """
    import numpy as np

    from tftool.buffer.sample import TransformStamped
    from tftool.frames.pair_samples import evenly
    from tftool.geometry.rigid import Transform
    from tftool.recordings.recording import Recording

    if topic is not None and isinstance(stored, Recording):
        stamps = stored.headers(topic).stamps
    else:
        period = seconds(1.0 / (rate or 1.0))
        stamps = evenly(stored.start, stored.end, period)
    path = stored.buffer.lookup_transforms(target, source, stamps, missing="nan")
    places = np.flatnonzero(path.valid)
    if len(stamps) and not len(places):
        # Says why, of the first.
        stored.buffer.lookup_transform(target, source, int(stamps[0]))
    for place in places[:most].tolist():
        x, y, z = path.translations[place].tolist()
        qx, qy, qz, qw = path.rotations[place].tolist()
        pose = Transform((x, y, z), (qx, qy, qz, qw))
        yield TransformStamped(int(stamps[place]), target, source, pose)
    if len(places) < len(stamps):
        notice(f"At {len(stamps) - len(places)} of {len(stamps)} moments there is no answer.")
