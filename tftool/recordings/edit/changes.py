"""Changes that `tftool edit` makes to the messages and transforms of a recording."""

import struct
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError, TftoolError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, as_seconds
from tftool.buffer.forest import stripped
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import Interfaces, Message
from tftool.messages.codec import Codec, RecordedCodec
from tftool.messages.schema import PRIMITIVES, full_name
from tftool.messages.transform_rows import Bytes, TransformRow, TransformRows
from tftool.recordings.channel import Channel
from tftool.recordings.container import MessageTable, Taken
from tftool.recordings.container_reader import (
    LAYOUTS,
    TRANSFORM_TYPES,
    begins_with_header,
    is_static,
    short_type,
)
from tftool.recordings.contract import Stamps
from tftool.recordings.edit.tables import Kinds, MessageKind, Result, TableChange

LinkName = tuple[str, str]
"""Names of parent and child, each without a leading slash; "*" means any name."""

_HEADER: Final = "std_msgs/msg/Header"

_STAMPS_END: Final = 2**31 * NANOSECONDS
"""End of the stamps that ROS 2 can store, whose seconds have 32 bits with a sign."""


@dataclass(frozen=True, slots=True)
class Edits:
    """Changes to make to a recording. Frame names are the names before the edit.

    Attributes:
        drop: Links (pairs of parent and child) whose transforms are removed.
        rename: New frame names, by old name.
        prefix: Prefix to add to every frame name.
        strip_slash: Whether to remove leading slashes from frame names.
        poses: New poses of links: position x y z (metres) and quaternion x y z w.
        reparent: New parent by link. The poses are recomputed, so that the child does not move.
        statics_first: Whether to write the static transforms at the beginning, in one message
            for each channel.
        statics_from: Static transforms that replace recorded static transforms of the same
            children.
        start: First time to keep, nanoseconds; None for the beginning of the recording.
        end: Last time to keep, nanoseconds; None for the end of the recording.
        by_record_time: Whether `start` and `end` are log times; if not, they are stamps.
        shift: Nanoseconds to add to the stamps of moving transforms.
        restamp: Whether to replace stamps by log times.
        everywhere: Whether to change names and stamps also in all other messages with a header.
        split_every: Duration of each output file, nanoseconds; 0 to write one file.
    """

    drop: tuple[LinkName, ...] = ()
    rename: Mapping[str, str] = field(default_factory=dict)
    prefix: str = ""
    strip_slash: bool = False
    poses: Mapping[LinkName, tuple[float, ...]] = field(default_factory=dict)
    reparent: Mapping[LinkName, str] = field(default_factory=dict)
    statics_first: bool = False
    statics_from: tuple[TransformStamped, ...] = ()
    start: Stamp | None = None
    end: Stamp | None = None
    by_record_time: bool = False
    shift: Duration = 0
    restamp: bool = False
    everywhere: bool = False
    split_every: Duration = 0

    @property
    def cuts(self) -> bool:
        """Whether the edit keeps only part of the time span."""
        return self.start is not None or self.end is not None

    @property
    def names(self) -> bool:
        """Whether the edit changes frame names."""
        return bool(self.rename or self.prefix or self.strip_slash)

    @property
    def stamps(self) -> bool:
        """Whether the edit changes stamps."""
        return bool(self.shift or self.restamp)

    @property
    def links(self) -> bool:
        """Whether the edit changes transforms."""
        return bool(self.drop or self.poses or self.reparent or self.names or self.stamps)

    def name(self, frame: str) -> str:
        """Return the new name of a frame."""
        plain = stripped(frame)
        slash = frame[: len(frame) - len(plain)]
        plain = self.rename.get(plain, plain)
        if self.prefix:
            return self.prefix + plain
        return plain if self.strip_slash else slash + plain

    def stamp(self, stamp: Stamp, log_time: Stamp) -> Stamp:
        """Return the new value of a stamp; --shift leaves 0 ("no stamp") unchanged.

        Raises:
            InputError: If --shift turns a stamp into 0, or into a stamp that ROS cannot store.
        """
        old = log_time if self.restamp else stamp
        if not self.shift or not old:
            return old
        new = old + self.shift
        if not 0 < new < _STAMPS_END:
            raise InputError(
                f"--shift {as_seconds(self.shift):.10g} would change the stamp "
                f"{as_seconds(old):.10g} s to {as_seconds(new):.10g} s: choose a shift after which "
                "all stamps are above 0 and below 2^31 s."
            )
        return new


def fits(link: LinkName, pattern: LinkName) -> bool:
    """Whether a link (parent, child) matches a pattern, in which "*" means any name."""
    return all(word in ("*", name) for name, word in zip(link, pattern, strict=True))


def carries_transforms(channel: Channel) -> bool:
    """Whether a channel's messages are lists of transforms that an edit can change."""
    return short_type(channel.type) in TRANSFORM_TYPES and channel.encoding in LAYOUTS


def carries_statics(channel: Channel) -> bool:
    """Whether a channel's messages are lists of static transforms that an edit can change."""
    return carries_transforms(channel) and is_static(channel)


class Window:
    """Time span of a recording that an edit with --from or --to keeps.

    Attributes:
        start: First log time to keep, for messages without a stamp.
        end: Last log time to keep, for messages without a stamp.
        stamps: First and last stamp to keep, for messages with a header; None to use log times.
        links: First and last stamp to keep, by moving link. If `stamps` is None, `links` has log
            times instead of stamps.
    """

    def __init__(
        self,
        start: Stamp,
        end: Stamp,
        stamps: tuple[Stamp, Stamp] | None,
        links: Mapping[LinkName, tuple[Stamp, Stamp]],
    ) -> None:
        self.start = start
        self.end = end
        self.stamps = stamps
        self.links = links

    def holds(self, moment: Stamp) -> bool:
        """Whether a message with this log time is kept."""
        return self.start <= moment <= self.end

    def holds_stamp(self, stamp: Stamp) -> bool:
        """Whether a message with this stamp in its header is kept."""
        assert self.stamps is not None
        return self.stamps[0] <= stamp <= self.stamps[1]

    def holds_row(self, row: TransformRow, log_time: Stamp) -> bool:
        """Whether a transform of a moving link is kept."""
        span = self.links.get((stripped(row.parent), stripped(row.child)))
        if span is None:
            return self.holds(log_time)
        return span[0] <= (row.stamp if self.stamps is not None else log_time) <= span[1]


Reparenting = Callable[[LinkName, Stamp], Transform | None]
"""Function that returns the pose of a link's old parent in the new parent at a stamp, or None."""


class Changer:
    """Editor of a recording's messages, with counts of its changes.

    Attributes:
        window: Time span to keep; None to keep all times.
        counts: Number of changes, by kind of change.
        topics: Topics whose transforms the edit changes; None if all topics must be examined.
        passed_over: Reason why the frame names on a topic cannot be changed, by topic.
    """

    def __init__(
        self, edits: Edits, window: Window | None = None, reparenting: Reparenting | None = None
    ) -> None:
        """Create an editor that makes the changes in `edits`.

        Args:
            edits: Changes to make.
            window: Time span to keep; None to keep all times.
            reparenting: Function that returns the pose of the old parent in the new parent of a
                link; None if no link gets another parent.
        """
        self._edits = edits
        self.window = window
        self._reparenting = reparenting
        self._replaced = frozenset(stripped(one.child_frame_id) for one in edits.statics_from)
        self._renamers: dict[Channel, Renamer | None] = {}
        self._has_header: dict[Channel, bool] = {}
        self._kinds: dict[Channel, Kinds] = {}
        self.counts: Counter[str] = Counter()
        self.passed_over: dict[str, str] = {}
        self.topics: frozenset[str] | None = None

    def touches(self, channel: Channel) -> bool:
        """Whether the edit, apart from --from and --to, can change or drop a channel's messages."""
        if carries_transforms(channel):
            if self.topics is not None:
                return channel.topic in self.topics
            return self._edits.links or (bool(self._replaced) and carries_statics(channel))
        return self._edits.everywhere and (self._edits.names or self._edits.stamps)

    def keeps_all(self, start: Stamp, end: Stamp) -> bool:
        """Whether the time span to keep contains all messages between two log times."""
        window = self.window
        return window is None or (
            window.stamps is None and window.start <= start and end <= window.end
        )

    def changed(self, message: Taken, channel: Channel) -> Taken | None:
        """Return a message after the edit; None if the edit drops the message."""
        if carries_transforms(channel):
            return self._transforms(message, channel)
        if self.window is not None and not self._kept(message, channel):
            self.counts["messages outside of the cut"] += 1
            return None
        if self.touches(channel):
            return self._other(message, channel)
        return message

    # Transforms

    def _transforms(self, message: Taken, channel: Channel) -> Taken | None:
        static = carries_statics(channel)
        try:
            taken_apart = TransformRows(LAYOUTS[channel.encoding], message.payload)
        except TftoolError:
            self.counts["messages that are no transforms, copied as they are"] += 1
            return message
        rows = [self.row(old, message.log_time, static=static) for old in taken_apart.rows]
        payload = self._rewritten(taken_apart, rows)
        if payload is message.payload:
            return message
        return None if payload is None else message._replace(payload=payload)

    def _rewritten(
        self, before: TransformRows, after: Sequence[TransformRow | None]
    ) -> bytes | None:
        """Return the bytes of a message with changed transforms; None if no transform is left."""
        rows = [row for row in after if row is not None]
        if not rows and before.rows:
            self.counts["messages without a transform left"] += 1
            return None
        if all(one is other for one, other in zip(after, before.rows, strict=True)):
            return before.payload
        return before.rewritten(rows)

    # Many messages at once

    def changed_table(self, table: MessageTable, channels: Mapping[int, Channel]) -> MessageTable:
        """Return messages after the edit; return the same table if no message changes."""
        change = TableChange(table)
        for number in table.owners:
            channel = channels[number]
            transforms = carries_transforms(channel)
            if self.window is None and not transforms and not self.touches(channel):
                continue
            which = np.flatnonzero(table.channels == number)
            if transforms:
                which = self._by_kind(change, which, channel)
            for row in which.tolist():
                message = table.message(row)
                after = self.changed(message, channel)
                if after is None:
                    change.keep[row] = False
                elif after is not message:
                    change.put_one(row, after.payload)
        return change.finished()

    def _by_kind(self, change: TableChange, indices: Stamps, channel: Channel) -> Stamps:
        """Change messages in bulk, and return the indices of messages that are still unchanged.

        Args:
            change: Table that receives the changes.
            indices: Indices of the messages to change.
            channel: Channel of the messages.

        Returns:
            Indices of messages that the caller must change one by one.
        """
        edits, static = self._edits, carries_statics(channel)
        if edits.stamps or edits.reparent:
            return indices
        kinds = self._kinds.get(channel)
        if kinds is None:
            kinds = self._kinds[channel] = Kinds(
                LAYOUTS[channel.encoding], lambda payload: self._learned(payload, channel)
            )
        found, rest = kinds.groups(change.table, indices)
        others = [rest]
        for kind, numbers, rows in found:
            whole: npt.NDArray[np.bool_] = np.ones(len(numbers), dtype=np.bool_)
            if self.window is not None:
                logs = change.table.log_times[numbers]
                inside = self._inside(kind, rows, logs, static=static)
                whole = np.logical_and.reduce(inside, axis=1)
                none = ~np.logical_or.reduce(inside, axis=1)
                change.keep[numbers[none]] = False
                gone = int(none.sum())
                if gone:
                    self.counts["transforms outside of the cut"] += gone * len(kind.places)
                    self.counts["messages without a transform left"] += gone
                others.append(numbers[~whole & ~none])
            if not (edits.links or self._replaced):
                continue
            chosen, count = numbers[whole], int(whole.sum())
            if count:
                self.counts.update({what: many * count for what, many in kind.counts.items()})
            if kind.result.payload is None:
                change.keep[chosen] = False
            elif kind.changes and count:
                length = int(change.table.lengths[chosen[0]])
                change.put(chosen, kind.changed(rows[whole], length))
        return np.sort(np.concatenate(others))

    def _inside(
        self, kind: MessageKind, rows: Bytes, log_times: Stamps, *, static: bool
    ) -> npt.NDArray[np.bool_]:
        """Return a mask of the transforms that a cut keeps, shape (messages, transforms)."""
        window = self.window
        assert window is not None
        found = []
        for number, place in enumerate(kind.places):
            span = (
                None
                if static
                else window.links.get((stripped(place.parent), stripped(place.child)))
            )
            first, last = span or (window.start, window.end)
            moments = log_times
            if span is not None and window.stamps is not None:
                moments = kind.stamps(rows, number)
            found.append((moments >= first) & (moments <= last))
        return np.stack(found, axis=1)

    def _learned(self, payload: bytes, channel: Channel) -> "tuple[Result, Counter[str]]":
        """Change one message, ignoring --from and --to; return the result and counts of changes."""
        layout, static = LAYOUTS[channel.encoding], carries_statics(channel)
        before, self.counts = self.counts, Counter()
        try:
            taken = TransformRows(layout, payload)
            after = [self.edited(row, 0, static=static) for row in taken.rows]
            pairs = zip(taken.rows, after, strict=True)
            given = [
                n for n, (old, new) in enumerate(pairs) if new and new.numbers is not old.numbers
            ]
            kept = [n for n, row in enumerate(after) if row is not None]
            result = Result(self._rewritten(taken, after), layout, kept, frozenset(given))
            return result, self.counts
        finally:
            self.counts = before

    def row(self, old: TransformRow, log_time: Stamp, *, static: bool) -> TransformRow | None:
        """Return a transform after all changes of the edit; None for a dropped transform."""
        edits = self._edits
        if self.window is not None:
            window = self.window
            kept = window.holds(log_time) if static else window.holds_row(old, log_time)
            if not kept:
                self.counts["transforms outside of the cut"] += 1
                return None
        return self.edited(old, log_time, static=static) if edits.links or self._replaced else old

    def edited(self, old: TransformRow, log_time: Stamp, *, static: bool) -> TransformRow | None:
        """Return a transform after all changes except --from and --to; None if it is dropped."""
        edits = self._edits
        link = stripped(old.parent), stripped(old.child)
        if any(fits(link, wanted) for wanted in edits.drop):
            self.counts["transforms dropped"] += 1
            return None
        if static and link[1] in self._replaced:
            self.counts["statics replaced"] += 1
            return None
        row = old
        for wanted, numbers in edits.poses.items():
            if fits(link, wanted):
                self.counts["transforms set"] += 1
                row = row._replace(numbers=numbers)
        new_parent = edits.reparent.get(link)
        if new_parent is not None:
            moved = self._reparented(link, row, static=static)
            if moved is None:
                self.counts[
                    "transforms left out, because the pose in the new parent is unknown"
                ] += 1
                return None
            self.counts["transforms given another parent"] += 1
            row = row._replace(parent=new_parent, numbers=moved)
        if edits.stamps and not static:
            stamp = edits.stamp(row.stamp, log_time)
            if stamp != row.stamp:
                self.counts["stamps changed"] += 1
                row = row._replace(stamp=stamp)
        if edits.names:
            parent, child = edits.name(row.parent), edits.name(row.child)
            if (parent, child) != (row.parent, row.child):
                self.counts["transforms renamed"] += 1
                row = row._replace(parent=parent, child=child)
        return row

    def _reparented(
        self, link: LinkName, row: TransformRow, *, static: bool
    ) -> tuple[float, ...] | None:
        assert self._reparenting is not None
        new_from_old = self._reparenting(link, 0 if static else row.stamp)
        if new_from_old is None:
            return None
        x, y, z, qx, qy, qz, qw = row.numbers
        found = new_from_old @ Transform((x, y, z), (qx, qy, qz, qw))
        return (*found.translation, *found.rotation)

    # Messages other than transforms

    def _kept(self, message: Taken, channel: Channel) -> bool:
        window = self.window
        assert window is not None
        if window.stamps is not None and self.has_header(channel):
            stamp = header_stamp(message.payload, channel.encoding)
            if stamp:
                return window.holds_stamp(stamp)
        return window.holds(message.log_time)

    def has_header(self, channel: Channel) -> bool:
        """Whether a channel's messages begin with a header."""
        found = self._has_header.get(channel)
        if found is None:
            found = self._has_header[channel] = begins_with_header(channel)
        return found

    def _other(self, message: Taken, channel: Channel) -> Taken:
        """Change frame names and stamps in a message that is not a list of transforms."""
        payload = message.payload
        if self._edits.stamps and self.has_header(channel):
            stamp = header_stamp(payload, channel.encoding)
            if stamp is not None and stamp != (new := self._edits.stamp(stamp, message.log_time)):
                self.counts["stamps of other messages changed"] += 1
                payload = _with_stamp(payload, channel.encoding, new)
        if self._edits.names:
            renamer = self._renamer(channel)
            if renamer is not None:
                try:
                    renamed = renamer.renamed(payload)
                except TftoolError as error:
                    self.passed_over.setdefault(channel.topic, str(error))
                    renamed = None
                if renamed is not None:
                    self.counts["other messages renamed"] += 1
                    payload = renamed
        return message if payload is message.payload else message._replace(payload=payload)

    def _renamer(self, channel: Channel) -> "Renamer | None":
        if channel not in self._renamers:
            try:
                self._renamers[channel] = renamer_of(channel, self._edits)
            except TftoolError as error:
                self._renamers[channel] = None
                self.passed_over.setdefault(channel.topic, str(error))
        return self._renamers[channel]


def header_stamp(payload: bytes, encoding: str) -> Stamp | None:
    """Return the stamp of a message that begins with a header; None if the message is too short."""
    if len(payload) < 12:
        return None
    order = ">" if encoding == "cdr" and payload[:2] == b"\x00\x00" else "<"
    sec, nanosec = struct.unpack_from(f"{order}iI", payload, 4)
    return int(sec) * NANOSECONDS + int(nanosec)


def _with_stamp(payload: bytes, encoding: str, stamp: Stamp) -> bytes:
    order = ">" if encoding == "cdr" and payload[:2] == b"\x00\x00" else "<"
    sec, nanosec = divmod(stamp, NANOSECONDS)
    return payload[:4] + struct.pack(f"{order}iI", sec, nanosec) + payload[12:]


class Renamer:
    """Editor of the frame names in messages of one type, including names in nested messages."""

    def __init__(self, codec: Codec | RecordedCodec, edits: Edits) -> None:
        self._codec = codec
        self._edits = edits
        # Search the bytes for the old names first: most messages need not be decoded.
        self._marks: Collection[bytes] = ()
        if not edits.prefix and not edits.strip_slash:
            self._marks = [name.encode() for name in edits.rename]

    def renamed(self, payload: bytes) -> bytes | None:
        """Return the bytes of a message with new frame names; None if no name changes.

        Raises:
            MalformedMessage: If the payload is not a message of the type.
        """
        if self._marks and not any(mark in payload for mark in self._marks):
            return None
        message = self._codec.decode(payload)
        return self._codec.encode(message) if self._rename(message) else None

    def _rename(self, message: Any) -> bool:
        changed = False
        for one in message.fields__:
            value = getattr(message, one.name)
            if isinstance(value, Message):
                changed |= self._rename(value)
            elif isinstance(one.kind, type) and isinstance(value, Sequence):
                for part in value:
                    changed |= self._rename(part)
            elif one.kind == "string" and one.size is None and one.name in _NAMES and value:
                name = self._edits.name(value)
                if name != value:
                    setattr(message, one.name, name)
                    changed = True
        return changed


_NAMES: Final = ("frame_id", "child_frame_id")


def renamer_of(channel: Channel, edits: Edits) -> Renamer | None:
    """Return the editor of frame names in a channel's messages; None for types without header.

    Raises:
        InputError: If the type is unknown.
    """
    if channel.encoding not in LAYOUTS:
        raise InputError(f"messages with the encoding '{channel.encoding}' cannot be changed")
    interfaces = Interfaces()
    text = channel.message_text
    full = full_name(channel.type)
    if text.strip():
        interfaces.define(full, text)
    if not _has_header(interfaces, full):
        return None
    layout = LAYOUTS[channel.encoding]
    if not text.strip():
        return Renamer(RecordedCodec(interfaces, full, layout), edits)
    return Renamer(Codec(interfaces.message(full), layout), edits)


def _has_header(interfaces: Interfaces, full: str) -> bool:
    """Whether a message type contains a header anywhere, also in nested messages."""
    waiting, seen = [full], {full}
    while waiting:
        for one in interfaces.structure(waiting.pop()).fields:
            if one.type == _HEADER:
                return True
            if one.type not in PRIMITIVES and one.type not in seen:
                seen.add(one.type)
                waiting.append(one.type)
    return False
