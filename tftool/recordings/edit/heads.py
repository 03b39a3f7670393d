"""Static transforms that `tftool edit` writes at the start of its output files."""

import contextlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP, Stamp
from tftool.buffer.forest import stripped
from tftool.buffer.sample import TransformStamped
from tftool.messages.transform_rows import TransformRow, TransformRows, encode_rows
from tftool.recordings.channel import Channel
from tftool.recordings.container import ContainerReader, MessageHead, MessageTable, Taken
from tftool.recordings.container_reader import LAYOUTS
from tftool.recordings.containers import container_named
from tftool.recordings.edit.changes import (
    Changer,
    Edits,
    carries_statics,
    carries_transforms,
)
from tftool.recordings.edit.outputs import EditedFile
from tftool.recordings.message_conversion import TRANSFORMS, as_ros1, ros2_channel


@dataclass(slots=True)
class _Static:
    """One static transform as recorded, with its log time and channel."""

    source: int
    number: int
    channel: Channel
    log_time: Stamp
    row: TransformRow


def _row_of(sample: TransformStamped) -> TransformRow:
    numbers = (*sample.transform.translation, *sample.transform.rotation)
    return TransformRow(sample.stamp, sample.frame_id, sample.child_frame_id, numbers)


def _one(channel: int, moment: Stamp, payload: bytes) -> MessageTable:
    return MessageTable.of(payload, [MessageHead(channel, moment, 0, len(payload), moment)])


class StaticHeads:
    """Static transforms for the start of every output file, so that each file is complete.

    Attributes:
        wanted: Whether to write static transforms at the start: if the edit cuts or splits the
            recording, or has the options --statics-first or --statics-from.
    """

    def __init__(
        self,
        edits: Edits,
        readers: Sequence[ContainerReader],
        changer: Changer,
        start: Stamp,
        *,
        by_input: bool,
        ros2: bool,
    ) -> None:
        """Create an empty collection of static transforms, which `collect` fills.

        Args:
            edits: The changes.
            readers: Readers of the input files.
            changer: Editor of messages, which also applies the changes to the static transforms.
            start: Log time of the first message in the output.
            by_input: Whether each input file becomes a separate output file.
            ros2: Whether the result is a ROS 2 recording.
        """
        self.wanted = bool(
            edits.statics_first or edits.statics_from or edits.cuts or edits.split_every
        )
        self._edits = edits
        self._readers = readers
        self._changer = changer
        self._start = start
        self._by_input = by_input
        self._ros2 = ros2
        self._statics: list[_Static] = []

    @property
    def topics(self) -> frozenset[str]:
        """Return the topics of the static transforms at the start; these topics must be latched."""
        if not self.wanted:
            return frozenset()
        found = frozenset(one.channel.topic for one in self._statics)
        return found | {"/tf_static"} if self._edits.statics_from else found

    def collect(self) -> None:
        """Read all static transforms of the inputs, and apply the edit's changes to them."""
        if not self.wanted:
            return
        edits = self._edits
        for source, reader in enumerate(self._readers):
            for block in reader.blocks():
                if block.counts is not None and block.whole:
                    known = [reader.channels[number] for number in block.counts]
                    if not any(map(carries_statics, known)):
                        continue
                table = block.table()
                for place, number in enumerate(table.channels.tolist()):
                    if carries_statics(reader.channels[number]):
                        self._take(source, table.message(place), reader.channels[number])
        counts, self._changer.counts = self._changer.counts, Counter()
        if edits.links or edits.statics_from:
            edited = []
            for one in self._statics:
                row = self._changer.edited(one.row, one.log_time, static=True)
                if row is not None:
                    one.row = row
                    edited.append(one)
            self._statics = edited
        self._changer.counts = counts

    def _take(self, source: int, message: Taken, channel: Channel) -> None:
        with contextlib.suppress(InputError):
            rows = TransformRows(LAYOUTS[channel.encoding], message.payload).rows
            self._statics += [
                _Static(source, message.channel, channel, message.log_time, row) for row in rows
            ]

    def write(self, number: int, output: EditedFile, start: Stamp) -> None:
        """Write the static transforms at the start of an output file, in one message per channel.

        For each child, the transform that is valid at the end of the file is written.

        Args:
            number: Index of the output file, from 0.
            output: The output file, still empty.
            start: Log time of the written messages.
        """
        if not self.wanted:
            return
        edits = self._edits
        start, end = max(start, self._start), LAST_STAMP
        if edits.split_every:
            start = self._start + number * edits.split_every
            end = start + edits.split_every - 1
        if edits.cuts:
            window = self._changer.window
            assert window is not None
            end = min(end, window.end)
        chosen: dict[str, _Static] = {}
        for one in self._statics:
            if self._by_input and not edits.cuts and one.source > number:
                continue
            child = stripped(one.row.child)
            held = chosen.get(child)
            # Use the last transform before the file's end, else the first transform after the end.
            if held is None or one.log_time <= end or held.log_time > end >= one.log_time:
                chosen[child] = one
        groups: dict[tuple[int, int], list[_Static]] = {}
        for one in chosen.values():
            groups.setdefault((one.source, one.number), []).append(one)
        added = [_row_of(sample) for sample in edits.statics_from]
        for (source, own), group in sorted(groups.items()):
            channel = group[0].channel
            rows = [one.row for one in group] + added
            added = []
            payload = encode_rows(LAYOUTS[channel.encoding], rows)
            output.write(source, _one(own, start, payload), self._readers[source])
        if added:
            self._write_added(output, added, start)
        output.writer.flush()
        self._changer.counts["statics put first"] += len(chosen) + len(edits.statics_from)

    def _write_added(self, output: EditedFile, rows: Sequence[TransformRow], start: Stamp) -> None:
        """Write the transforms of --statics-from if no input has a topic of static transforms."""
        channel = ros2_channel("/tf_static", TRANSFORMS, static=True)
        encoding = container_named(output.container).encoding
        ros1 = encoding == "ros1" or all(
            channel.encoding == "ros1"
            for reader in self._readers
            for channel in reader.channels.values()
            if carries_transforms(channel)
        )
        if encoding == "ros1" or (ros1 and not encoding and not self._ros2):
            channel = as_ros1(channel).channel
        payload = encode_rows(LAYOUTS[channel.encoding], rows)
        number = output.channel(channel)
        output.append(_one(number, start, payload))
