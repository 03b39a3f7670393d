"""All frames of a source over its whole time span, as returned by `tftool.open`."""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Literal, Self, TypeAlias

from tftool.base.plain_text import visible
from tftool.base.stamps import LATEST, Stamp, as_seconds, seconds
from tftool.buffer.buffer import Buffer
from tftool.frames.source_options import At, checked_moment

if TYPE_CHECKING:
    from tftool.frames.transform_log import TransformLog
    from tftool.recordings.find import Found
    from tftool.recordings.recording import Recording
    from tftool.robots.robot_model import Robot

FramesKind: TypeAlias = Literal[
    "recording", "robot description", "file of static transforms", "scenario", "session"
]


class Frames:
    """Frames of a recording, a robot description, a launch file, a scenario or a session.

    `tftool.open` returns an object of this class. Nothing is pruned: lookups work at every recorded
    time. The files are closed at the end of a `with` block, but data already read stays available.

        with tftool.open("run.mcap") as frames:
            frames.buffer.lookup_transform("map", "laser", frames.at(12.5))

    Attributes:
        kind: Kind of the source.
        name: Name of the source, such as "run.mcap" or "turtles".
        recording: Recording that the frames were read from; None for other sources.
        found: Files that were read; None for a session.
        log: Log of all transforms in order of arrival, for a scenario or a session; else None.
    """

    def __init__(
        self,
        kind: FramesKind,
        name: str,
        *,
        buffer: Buffer | None = None,
        span: tuple[Stamp, Stamp] | None = None,
        recording: "Recording | None" = None,
        robot: "Robot | None" = None,
        log: "TransformLog | None" = None,
        found: "Found | None" = None,
        notes: tuple[str, ...] | Callable[[], Iterable[str]] = (),
    ) -> None:
        """Create the object; for a recording, leave out `buffer`, `span` and `robot`.

        Args:
            kind: Kind of the source.
            name: Name of the source.
            buffer: Buffer with all frames; None for a recording.
            span: First and last stamp; None if all transforms are static.
            recording: Recording that was read, if any.
            robot: Robot of the description, if any.
            log: Log of all transforms in order of arrival, if any.
            found: Files that were read, if any.
            notes: Sentences about the files, or a function that returns such sentences.
        """
        self.kind: FramesKind = kind
        self.name = name
        self.found = found
        self.log = log
        self._buffer = buffer
        self._span: tuple[Stamp | None, Stamp | None] = span or (None, None)
        self.recording = recording
        self._robot = robot
        self._notes = notes

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def __repr__(self) -> str:
        start, end = self.start, self.end
        lasts = "" if start is None or end is None else f", {as_seconds(end - start):g} s"
        return f"<Frames of {self.title}{lasts}>"

    def close(self) -> None:
        """Close the files; data already read stays available."""
        if self.recording is not None:
            self.recording.close()

    @property
    def title(self) -> str:
        """Kind and name of the source for a sentence, such as "recording 'run.mcap'"."""
        if self.kind == "session":
            return self.name
        return f"{self.kind} '{visible(self.name)}'"

    @property
    def label(self) -> str:
        """Name of the file as the user gave it; `title` for a scenario or a session."""
        return self.title if self.kind in ("scenario", "session") else self.name

    @property
    def buffer(self) -> Buffer:
        """Buffer with all frames, in which nothing is pruned."""
        if self._buffer is None:
            self._buffer = Buffer() if self.recording is None else self.recording.buffer
        return self._buffer

    @property
    def robot(self) -> "Robot | None":
        """Robot of the description or recording; None without a robot."""
        return self._robot if self.recording is None else self.recording.robot

    @property
    def start(self) -> Stamp | None:
        """First stamp, nanoseconds; None if all transforms are static."""
        return self.recording.start if self.recording is not None else self._span[0]

    @property
    def end(self) -> Stamp | None:
        """Last stamp, nanoseconds; None if all transforms are static."""
        return self.recording.end if self.recording is not None else self._span[1]

    @property
    def span(self) -> tuple[Stamp, Stamp]:
        """First and last stamp, nanoseconds; 0 and 0 if all transforms are static."""
        return self.start or LATEST, self.end or LATEST

    @property
    def moving(self) -> frozenset[str] | None:
        """Links of a robot description that a joint moves; None for other sources."""
        if self.kind != "robot description" or self._robot is None:
            return None
        return frozenset(one.child for one in self._robot.joints.values() if one.moves)

    @property
    def static_edges(self) -> list[tuple[str, str]]:
        """Parent and child of every static transform, also of those that a later one replaced."""
        if self.recording is not None:
            return [(one.parent, one.child) for one in self.recording.edges if one.static]
        return [] if self.log is None else self.log.static_edges()

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences about damage, missing frames and joints without a position."""
        return tuple(self._notes() if callable(self._notes) else self._notes)

    def at(self, time: float) -> Stamp:
        """Return the stamp `time` seconds after the start; 0 (latest) if all frames are static."""
        start = self.start
        return LATEST if start is None else start + seconds(time)

    def moment(self, at: At) -> Stamp:
        """Return the stamp of a time in the notation of the option `--at`.

        Raises:
            UsageError: If the time is before the start or after the end of the source.
        """
        start, end = self.span
        received = 0
        if self.recording is not None:
            source = self.recording.source
            received = source.end - source.start
        return checked_moment(at, self.title, start, end - start, received)
