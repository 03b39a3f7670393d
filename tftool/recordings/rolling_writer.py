"""Writer of a live recording; if the process is killed, at most the last second is lost.

An open file has the suffix `.active`, as with ROS 1's recorder; its contents can be read, and
`tftool edit` repairs it.
"""

import os
from collections import deque
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NamedTuple, cast

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.messages.layouts import CDR
from tftool.messages.transform_rows import TransformRow, TransformRows, encode_rows
from tftool.recordings.channel import Channel, RecordedWriter
from tftool.recordings.containers import RECORDED, library_name
from tftool.recordings.find import ACTIVE
from tftool.recordings.rosbag2.format import FileFacts, metadata_text, write_metadata
from tftool.recordings.target import failed, refuse_existing, synced

CHUNK_SIZE: Final = 256 * 1024
"""Size of a chunk's uncompressed messages, bytes; a killed process loses an unfinished chunk."""

CHUNK_TIME: Final = seconds(1)
"""Maximum time that messages wait in a chunk before it is written."""

MOST_HELD: Final = 1 << 30
"""Maximum size of messages in the ring buffer, bytes; beyond it, the oldest are dropped."""


class Kept(NamedTuple):
    """One message in the ring buffer, with the number of transforms in the message."""

    channel: Channel
    log_time: Stamp
    payload: bytes
    transforms: int = 0


@dataclass(frozen=True, slots=True)
class RecordLimits:
    """Limits at which a new file begins, or the oldest messages of the ring buffer are dropped.

    Attributes:
        size: Size of a file, bytes, at which the next file begins; 0 for no limit.
        duration: Duration of a file, nanoseconds, at which the next file begins; 0 for no limit.
        ring: Duration, nanoseconds, of the ring buffer in memory, which is written only at the
            end; 0 to write at once.
    """

    size: int = 0
    duration: Duration = 0
    ring: Duration = 0

    @property
    def splits(self) -> bool:
        """Whether the size or duration of a file is limited, so that several files may result."""
        return bool(self.size or self.duration)


class RollingRecording:
    """Writer of an MCAP file, or of a folder of MCAP files, for messages as they arrive.

    Attributes:
        path: Final name of the file or folder.
        messages: Number of received messages; once a recording with a ring buffer is closed, the
            number of written messages.
        transforms: Number of transforms in the messages that `messages` counts.
        size: Number of bytes written, plus the bytes in the ring buffer.
        files: Names of the completed files, in order.
    """

    def __init__(
        self,
        path: Path,
        limits: RecordLimits | None = None,
        *,
        compression: str = "zstd",
        force: bool = False,
    ) -> None:
        """Start the recording; with a ring buffer nothing is written before `close`.

        Args:
            path: Path that ends in ".mcap", or without a suffix for a folder.
            limits: Limits at which a new file begins; None for no limits.
            compression: "zstd", "lz4" or "none".
            force: Whether existing files may be replaced.

        Raises:
            UsageError: If the path exists and `force` is not given, or the suffix is wrong.
            InputError: If the file cannot be written.
        """
        self.path = path
        self._limits = limits or RecordLimits()
        self._compression = compression
        self._is_folder = not path.suffix
        if path.suffix not in ("", RECORDED.suffix):
            raise UsageError(
                f"'{path.name}' has an unsupported suffix: use '{RECORDED.suffix}', or none for a "
                "folder."
            )
        if self._limits.splits and not self._is_folder:
            raise UsageError(
                "--max-size and --max-duration write several files into a folder: name a folder, "
                f"without '{path.suffix}' (-o {path.with_suffix('')}). To stop after some time, "
                "use --for SECONDS."
            )
        self.messages = self.transforms = 0
        self.files: list[str] = []
        self._facts: list[FileFacts] = []
        self._topics: dict[Channel, int] = {}
        self._statics: dict[Channel, dict[tuple[str, str], TransformRow]] = {}
        self._held: deque[Kept] = deque()
        self._held_bytes = 0
        self._written = 0
        self._writer: RecordedWriter | None = None
        self._numbers: dict[int, tuple[int, Channel]] = {}
        self._file_start: Stamp | None = None
        self._last = 0
        self._flushed: Stamp = 0
        self._closed = False
        self._make_way(force)
        if not self._limits.ring:
            # Create the file now, so that an error does not appear only after an hour.
            self._open()

    def _make_way(self, force: bool) -> None:
        active = self._place(0).with_name(self._place(0).name + ACTIVE)
        if active.exists() and not force:
            raise UsageError(
                f"'{active}' was left by a recorder that was killed: repair the file with 'tftool "
                f"edit {active} -o FILE.mcap', or replace the file with --force."
            )
        if self._is_folder and os.path.lexists(self.path):
            # Replacing a folder would remove its files before there are new ones.
            raise UsageError(
                f"'{self.path}' exists, and --force does not replace folders: choose another name."
            )
        refuse_existing(self.path, force=force)
        try:
            if self._is_folder:
                self.path.mkdir()
            elif self.path.is_dir():
                raise UsageError(
                    f"'{self.path}' is a folder, which --force does not replace: choose another "
                    "name."
                )
            elif not os.access(self.path.parent, os.W_OK):
                # The ring buffer is written at the end: check now that this is possible.
                active.open("xb").close()
                active.unlink()
        except OSError as error:
            raise failed(self.path, error) from error

    @property
    def size(self) -> int:
        """Number of bytes written so far, plus the bytes in the ring buffer."""
        return self._written + self._held_bytes + (self._writer.size if self._writer else 0)

    def _place(self, number: int) -> Path:
        if not self._is_folder:
            return self.path
        return self.path / f"{self.path.name}_{number}{RECORDED.suffix}"

    # Messages

    def take(self, channel: Channel, log_time: Stamp, payload: bytes, transforms: int = 0) -> None:
        """Append one message to the recording.

        Args:
            channel: Channel of the message.
            log_time: Time of reception, nanoseconds.
            payload: Bytes of the message.
            transforms: Number of transforms in the message.

        Raises:
            InputError: If the file cannot be written; earlier data stays readable.
        """
        if self._closed:
            return
        self.messages += 1
        self.transforms += transforms
        self._last = log_time
        if self._limits.ring:
            self._held.append(Kept(channel, log_time, payload, transforms))
            self._held_bytes += len(payload)
            self._forget(log_time)
        else:
            self._write(channel, log_time, payload)
        if transforms and channel.topic.rpartition("/")[2] == "tf_static":
            self._keep_static(channel, payload)

    def _forget(self, now: Stamp) -> None:
        """Drop the oldest messages until the ring buffer is within its duration and its size."""
        held, oldest = self._held, now - self._limits.ring
        while held and (held[0].log_time < oldest or self._held_bytes > MOST_HELD):
            self._held_bytes -= len(held.popleft().payload)

    def _keep_static(self, channel: Channel, payload: bytes) -> None:
        try:
            rows = TransformRows(CDR, payload).rows
        except InputError:
            return
        kept = self._statics.setdefault(channel, {})
        for row in rows:
            kept[row.parent, row.child] = row
            # A child has one static transform: the last one of all publishers.
            for other, others in self._statics.items():
                for link in [one for one in others if one[1] == row.child]:
                    if other != channel or link[0] != row.parent:
                        del others[link]

    def _write(self, channel: Channel, log_time: Stamp, payload: bytes) -> None:
        try:
            writer = self._writer
            if writer is None or self._is_full(writer, log_time):
                writer = self._next(log_time)
            if self._file_start is None:
                self._file_start = self._flushed = log_time
            # By identity, because hashing a channel's texts takes as long as writing a message.
            known = self._numbers.get(id(channel))
            number = self._number(writer, channel) if known is None else known[0]
            writer.write(number, log_time, payload)
            if log_time - self._flushed >= CHUNK_TIME:
                writer.flush()
                self._flushed = log_time
        except OSError as error:
            raise self._rescued(error) from error

    def _number(self, writer: RecordedWriter, channel: Channel) -> int:
        """Return a channel's number in the open file, registering the channel if it is new."""
        number = writer.channel(channel)
        self._numbers[id(channel)] = number, channel
        return number

    def _is_full(self, writer: RecordedWriter, now: Stamp) -> bool:
        limits = self._limits
        if self._file_start is None:
            return False
        too_large = limits.size and writer.size >= limits.size
        too_long = limits.duration and now - self._file_start >= limits.duration
        return bool(too_large or too_long)

    def _next(self, now: Stamp) -> RecordedWriter:
        """Start the next file, and write all static transforms at its beginning."""
        if self._writer is not None:
            self._close_file()
        writer = self._open()
        self._file_start = self._flushed = now
        self._write_statics(writer, now)
        return writer

    def _write_statics(self, writer: RecordedWriter, now: Stamp) -> None:
        for channel, rows in self._statics.items():
            if rows:
                number = self._number(writer, channel)
                writer.write(number, now, encode_rows(CDR, tuple(rows.values())))
        writer.flush()

    def _open(self) -> RecordedWriter:
        place = self._place(len(self.files))
        try:
            writer = RECORDED.create(
                place.with_name(place.name + ACTIVE),
                library=library_name(),
                compression=self._compression,
                chunk_size=CHUNK_SIZE,
            )
        except OSError as error:
            raise failed(place, error) from error
        self._numbers = {}
        self._file_start = None
        self._writer = cast("RecordedWriter", writer)
        return self._writer

    def tick(self, now: Stamp) -> None:
        """Write the buffered messages, if the last write was at least a second ago.

        The owner of the recording must call this function several times per second.

        Raises:
            InputError: If the file cannot be written; earlier data stays readable.
        """
        if self._writer is None or now - self._flushed < CHUNK_TIME:
            return
        try:
            self._writer.flush()
        except OSError as error:
            raise self._rescued(error) from error
        self._flushed = now

    def held(self) -> list[Kept]:
        """Return the static transforms, then the ring buffer's messages, oldest first."""
        statics = [
            Kept(
                channel,
                self._held[0].log_time if self._held else self._last,
                payload,
                len(rows),
            )
            for channel, rows in self._statics.items()
            if rows
            for payload in (encode_rows(CDR, tuple(rows.values())),)
        ]
        return [*statics, *self._held]

    # End of the recording

    def close(self) -> None:
        """Complete the last file, and give it its final name.

        Raises:
            InputError: If the file cannot be completed; data written before stays readable.
        """
        if self._closed:
            return
        try:
            if self._limits.ring:
                # From now on the counts describe the file, not the received messages.
                held = self.held()
                self.messages = len(held)
                self.transforms = sum(kept.transforms for kept in held)
                if held:
                    self._next(held[0].log_time)
                # Static transforms received within the ring's duration are written once more here.
                for kept in self._held:
                    self._write(kept.channel, kept.log_time, kept.payload)
                self._held.clear()
                self._held_bytes = 0
            self._closed = True
            if self._writer is None:
                self._open()
            self._close_file()
            if self._is_folder:
                write_metadata(
                    self.path, metadata_text(RECORDED.storage, self._facts, self._topics)
                )
                synced(self.path)
        except OSError as error:
            raise self._rescued(error) from error

    def discard(self) -> None:
        """Close the recording, and remove all files it wrote."""
        self._closed = True
        if self._writer is not None:
            self._writer.abandon()
            self._writer = None
        for number in range(len(self.files)):
            self._place(number).unlink(missing_ok=True)
        place = self._place(len(self.files))
        place.with_name(place.name + ACTIVE).unlink(missing_ok=True)
        if self._is_folder:
            self.path.rmdir()

    def _close_file(self) -> None:
        writer = self._writer
        assert writer is not None
        writer.finish()
        self._named(writer)

    def _named(self, writer: RecordedWriter) -> None:
        """Rename the file of a closed writer from its temporary to its final name."""
        place = self._place(len(self.files))
        active = place.with_name(place.name + ACTIVE)
        synced(active)
        active.replace(place)
        synced(place.parent)
        self._writer = None
        self._written += place.stat().st_size
        self.files.append(place.name)
        for number, channel in dict(self._numbers.values()).items():
            self._topics[channel] = self._topics.get(channel, 0) + writer.counts.get(number, 0)
        start, end = writer.span
        self._facts.append(FileFacts(place.name, start, end, sum(writer.counts.values())))

    def _rescued(self, error: OSError) -> InputError:
        """Complete the file after a failed write, and return an `InputError` for the user."""
        self._closed = True
        writer, self._writer = self._writer, None
        where = self.path
        kept = sum(one.count for one in self._facts)
        if writer is not None:
            kept += sum(writer.counts.values())
            place = self._place(len(self.files))
            if writer.rescue():
                self._named(writer)
            elif self.files or not self._is_folder:
                where = place.with_name(place.name + ACTIVE)
        refusal = failed(self.path, error)
        return InputError(f"{refusal} {kept} earlier messages can be read in '{where}'.")
