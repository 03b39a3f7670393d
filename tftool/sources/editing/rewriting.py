"""A recording written anew with changes: what they do not touch stays as it was, byte for byte.

Every piece is read once, copied where it may be, else taken apart and changed. Then the result
is opened, and all of it compared with what was to be written. Only then it gets its name.
"""

import contextlib
import shutil
from collections import Counter, deque
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import numpy as np

from tftool.errors import InputError, TransformException, UsageError
from tftool.frames.sample import TransformStamped
from tftool.frames.tree import stripped
from tftool.geometry.rigid import Transform
from tftool.sources.contract import Progress
from tftool.sources.editing.changes import (
    LAYOUTS,
    Changer,
    Edits,
    LinkName,
    Reparenting,
    Window,
    carries_statics,
    carries_transforms,
    fits,
)
from tftool.sources.editing.database import EditedDatabase, Unsound
from tftool.sources.editing.inputs import EditedInput, open_input, open_tape
from tftool.sources.editing.mcap_tape import McapChunk
from tftool.sources.editing.outputs import EditedFile, digest
from tftool.sources.editing.rosbag1_tape import Rosbag1Chunk
from tftool.sources.editing.sqlite_tape import SqliteTape
from tftool.sources.editing.tape import Block, Taken, Tape
from tftool.sources.recording import Recording, open_recording
from tftool.sources.writing.channel import Channel
from tftool.sources.writing.containers import container_of
from tftool.sources.writing.folder import FileFacts, metadata_text, write_metadata
from tftool.sources.writing.ros2 import TRANSFORMS, ros2_channel
from tftool.sources.writing.target import PART, Target, check_room, failed
from tftool.stamps import Stamp
from tftool.wire.splicing import TransformRow, TransformRows, encode_rows

MOST_PARTS: Final = 10_000
_LATEST: Final = 2**63 - 1
_ROOM: Final = 1 << 20
_AHEAD: Final = 3  # chunks that are examined before they are wanted


@dataclass(slots=True)
class EditReport:
    """What editing did.

    Attributes:
        messages: How many the result has.
        counts: How often each thing was done, by its name.
        notes: What else is to be known, as sentences.
        files: The names of what was written.
        copied: Chunks that were copied as they were.
    """

    messages: int = 0
    counts: "Counter[str]" = field(default_factory=Counter)
    notes: list[str] = field(default_factory=list)
    files: list[str] = field(default_factory=list)
    copied: int = 0


def edit(
    names: Sequence[str],
    output: Path,
    edits: Edits,
    *,
    force: bool = False,
    dry_run: bool = False,
    progress: Progress | None = None,
) -> EditReport:
    """Write recordings anew, as one, with changes.

    Args:
        names: The recordings: files or folders; several are joined.
        output: What to write: its suffix names the container, none a folder as of rosbag2.
        edits: What to change.
        force: Whether it may replace what has that name.
        dry_run: Whether only to find out what would be done.
        progress: Is told how far it has come.

    Raises:
        UsageError: If the changes cannot be made to these recordings, or the output is one of
            them, or there already.
        InputError: If a recording cannot be read, or the output not be written.
    """
    container = container_of(output)
    with contextlib.ExitStack() as stack:
        inputs = [stack.enter_context(open_input(name)) for name in names]
        _refuse_the_input(inputs, output)
        recordings = [stack.enter_context(open_recording(name)) for name in names]
        job = _Job(inputs, recordings, output, container, edits, progress)
        if dry_run:
            return job.tried()
        return job.done(force=force)


def _refuse_the_input(inputs: Sequence[EditedInput], output: Path) -> None:
    """Refuse to write onto what is read, under whatever name.

    Raises:
        UsageError: If the output is an input.
    """
    for one in inputs:
        for path in [Path(one.name), *one.paths]:
            if output.exists() and path.exists() and output.samefile(path):
                raise UsageError(f"'{output}' is the input: name another output.")
            part = output.with_name(output.name + PART)
            if part.exists() and path.exists() and part.samefile(path):
                raise UsageError(
                    f"'{path}' is where '{output}' would be written: rename it before."
                )
            if path.parent.resolve() == output.resolve() and output.exists():
                raise UsageError(f"'{output}' holds the input: name another output.")


class _Job:
    """One run over some recordings."""

    def __init__(
        self,
        inputs: Sequence[EditedInput],
        recordings: Sequence[Recording],
        output: Path,
        container: str,
        edits: Edits,
        progress: Progress | None,
    ) -> None:
        self._inputs = inputs
        self._recordings = recordings
        self._path = output
        self._edits = edits
        self._progress = progress
        self._tapes: list[Tape] = [tape for one in inputs for tape in one.tapes]
        self._is_folder = not container
        self._ros2 = container == "db3"
        if edits.split_every and container:
            raise UsageError(
                f"--split-every writes several files into a folder: '{output.stem}', not "
                f"'{output.name}'."
            )
        if not container:
            kinds = {tape.container for tape in self._tapes}
            container = "db3" if kinds == {"db3"} else "mcap"
            # A folder of bags is no recording of rosbag2's, but what splitting one gives.
            if kinds == {"bag"} and edits.split_every:
                container = "bag"
            self._ros2 = container != "bag"
        self._container = container
        first = inputs[0]
        self._mode = first.mode if self._is_folder and container == "db3" else ""
        # The files of a folder stay the files of the result.
        self._by_tape = (
            self._is_folder and len(inputs) == 1 and first.is_folder and not edits.split_every
        )
        self.report = EditReport()
        self._check_names()
        window = self._window()
        self._changer = Changer(edits, window, self._reparenting())
        self._changer.topics = self._concerned()
        starts = [one.source.start for one in recordings if one.source.start]
        self._start: Stamp = min(starts, default=0)
        if window is not None:
            self._start = max(self._start, window.start)
        self._outputs: dict[int, EditedFile] = {}
        self._databases: list[EditedDatabase] = []
        self._order: list[int] = []
        self._heads = bool(
            edits.statics_first or edits.statics_from or edits.cuts or edits.split_every
        )
        self._statics: list[_Static] = []

    # What the options name

    def _check_names(self) -> None:
        edits = self._edits
        wanted: list[LinkName] = [*edits.drop, *edits.poses, *edits.reparent]
        if not (wanted or edits.rename):
            return
        links = {(e.parent, e.child) for one in self._recordings for e in one.edges}
        frames = {name for link in links for name in link}
        for link in wanted:
            if not any(fits(one, link) for one in links):
                raise UsageError(_no_such_link(link, links))
        for name in edits.rename:
            if name not in frames:
                raise UsageError(_no_such_frame(name, frames))
        after = Counter(edits.name(name) for name in frames)
        clash = [name for name, count in after.items() if count > 1]
        if clash and edits.rename:
            both = sorted(name for name in frames if edits.name(name) == clash[0])
            raise UsageError(
                f"Two frames would be called '{clash[0]}': {' and '.join(map(repr, both))}."
            )

    def _concerned(self) -> frozenset[str] | None:
        """The topics of the links that are named; None where all links change."""
        edits = self._edits
        wanted = [*edits.drop, *edits.poses, *edits.reparent]
        if not wanted or edits.names or edits.stamps or edits.statics_from:
            return None
        found: set[str] = set()
        for recording in self._recordings:
            transforms = recording.transforms
            if recording.damage:
                return None
            for edge in transforms.edges:
                if any(fits((edge.parent, edge.child), link) for link in wanted):
                    senders = np.unique(transforms.senders_of(edge)).tolist()
                    found |= {transforms.publishers[sender].topic for sender in senders}
        return frozenset(found)

    def _window(self) -> Window | None:
        edits = self._edits
        if not edits.cuts:
            return None
        low = edits.start if edits.start is not None else 0
        high = edits.end if edits.end is not None else _LATEST
        if high < low:
            raise UsageError("--to lies before --from.")
        moving = [(one, edge) for one in self._recordings for edge in one.edges if not edge.static]
        spans: dict[LinkName, tuple[Stamp, Stamp]] = {}
        offsets, logs = [], []
        for recording, edge in moving:
            log_times = recording.transforms.log_times_of(edge)
            moments = log_times if edits.by_record_time else edge.stamps
            first, last = _widened(moments, low, high)
            link = edge.parent, edge.child
            if link in spans:
                first, last = min(first, spans[link][0]), max(last, spans[link][1])
            spans[link] = first, last
            kept = log_times[(moments >= first) & (moments <= last)]
            if len(kept):
                logs.append(int(kept.min()))
            offsets.append(log_times - edge.stamps)
        if edits.by_record_time or not offsets:
            return Window(low, high, None, spans if edits.by_record_time else {})
        offset = int(np.median(np.concatenate(offsets)))
        end = high if high == _LATEST else high + offset
        start = 0 if edits.start is None else low + offset
        return Window(start, end, (low, high), spans)

    def _reparenting(self) -> Reparenting | None:
        edits = self._edits
        if not edits.reparent:
            return None
        if len(self._recordings) > 1:
            raise UsageError("--reparent works on one recording: join them first.")
        recording = self._recordings[0]
        static = {edge.child: edge.parent for edge in recording.edges if edge.static}
        parents: dict[str, set[str]] = {}
        for edge in recording.edges:
            parents.setdefault(edge.child, set()).add(edge.parent)
        frames = parents.keys() | {name for found in parents.values() for name in found}
        for (parent, child), new in edits.reparent.items():
            if new not in frames:
                raise UsageError(_no_such_frame(new, frames))
            if child in _above(new, parents):
                raise UsageError(f"'{new}' hangs from '{child}': it cannot become its parent.")
            is_static = static.get(child) == parent
            if is_static and not _joined_by_statics(parent, new, static):
                raise UsageError(
                    f"'{child}' is static, and '{new}' moves against '{parent}': it cannot hang "
                    "there and stay where it is."
                )
        buffer = recording.buffer

        def found(link: LinkName, stamp: Stamp) -> Transform | None:
            try:
                return buffer.lookup_transform(edits.reparent[link], link[0], stamp).transform
            except TransformException:
                return None

        return found

    # The runs

    def tried(self) -> EditReport:
        """What would be done."""
        self._collect_statics()
        done = 0
        for source, tape in enumerate(self._tapes):
            for block in tape.blocks():
                if not self._untouched(block, tape):
                    for message in block.messages():
                        after = self._changer.changed(message, tape.channels[message.channel])
                        self.report.messages += after is not None
                else:
                    self.report.messages += sum((block.channels or {}).values())
                    self.report.copied += 1
            done += tape.size
            self._tell(done)
            del source
        self._sum_up()
        return self.report

    def done(self, *, force: bool) -> EditReport:
        """Do it."""
        self._check_room()
        with Target(self._path, folder=self._is_folder, force=force) as target:
            try:
                self._write(target.part)
                self._compare()
                if self._is_folder:
                    self._finish_folder(target.part)
            except OSError as error:
                raise failed(self._path, error) from error
            finally:
                for one in self._outputs.values():
                    one.writer.abandon()
                for database in self._databases:
                    database.abandon()
        self._sum_up()
        return self.report

    def _check_room(self) -> None:
        size = sum(one.size for one in self._inputs)
        same = {tape.container for tape in self._tapes} == {self._container}
        # Another container may compress less; how much shows only while it is written.
        check_room(self._path, (size if same else size // 2) + _ROOM)

    def _write(self, part: Path) -> None:
        databases = self._changed_in_place()
        if databases:
            try:
                self._change_databases(databases, part)
            except Unsound:
                self._forget_databases()
            else:
                return
        self._collect_statics()
        total, done = sum(tape.size for tape in self._tapes), 0
        for source, tape in enumerate(self._tapes):
            for block in self._examined_ahead(tape):
                if self._by_tape and source not in self._outputs:
                    self._output(source, part, block.start or self._start)
                self._write_block(source, tape, block, part)
                if isinstance(block, McapChunk | Rosbag1Chunk):
                    self._tell(done + min(block.behind, tape.size), 2 * total)
            if self._by_tape:
                self._output(source, part)
            done += tape.size
            self._tell(done, 2 * total)
        if not self._outputs:
            self._output(0, part)
        for number, output in self._outputs.items():
            whose = [self._tapes[number]] if self._by_tape else self._tapes
            output.finish(whose if self._by_tape or number == self._order[0] else [])

    def _examined_ahead(self, tape: Tape) -> Iterator[Block]:
        """A tape's pieces; what is copied whole is examined while those before it are written.

        To unpack a chunk and hold its CRC against it takes as long as to copy it, and both
        work without Python's lock.
        """
        waiting: deque[tuple[Block, Future[bool] | None]] = deque()
        with ThreadPoolExecutor(1, "tftool-examine") as pool:
            try:
                for block in tape.blocks():
                    stays = self._stays_unseen(block, tape)
                    waiting.append((block, pool.submit(block.sound) if stays else None))
                    if len(waiting) > _AHEAD:
                        yield _examined(*waiting.popleft())
                while waiting:
                    yield _examined(*waiting.popleft())
            finally:
                for _, examined in waiting:
                    if examined is not None:
                        examined.cancel()

    def _stays_unseen(self, block: Block, tape: Tape) -> bool:
        """Whether a block stays as it is by what its index tells, if it is sound."""
        return (
            block.whole
            and bool(block.channels)
            and self._changer.keeps_all(block.start, block.end)
            and not any(self._changer.touches(tape.channels[n]) for n in block.channels or ())
        )

    # Databases

    def _changed_in_place(self) -> list[SqliteTape]:
        """The databases, if each becomes one that differs in some rows only; else none."""
        tapes = [tape for tape in self._tapes if isinstance(tape, SqliteTape)]
        alike = len(tapes) == len(self._tapes) and self._container == "db3"
        one_to_one = self._by_tape or (len(tapes) == 1 and not self._edits.split_every)
        # Messages that are packed each by itself are packed anew, and what is damaged is sought
        # for row by row.
        packed = self._mode == "message" or any(one.mode == "message" for one in self._inputs)
        damaged = any(one.damage for one in self._inputs) or any(tape.damage for tape in tapes)
        if not alike or not one_to_one or packed or damaged or self._heads:
            return []
        return tapes

    def _change_databases(self, tapes: Sequence[SqliteTape], part: Path) -> None:
        total, done = sum(tape.size for tape in tapes), 0
        for tape in tapes:
            database = EditedDatabase(self._path_in(part, len(self._databases)), tape)
            self._databases.append(database)
            done += tape.size
            self._tell(done // 2, 2 * total)
            touched = [n for n, one in tape.channels.items() if self._changer.touches(one)]
            database.change(self._changer.changed, touched)
            database.finish()
            self._tell(done, 2 * total)

    def _forget_databases(self) -> None:
        for database in self._databases:
            database.abandon()
            database.path.unlink(missing_ok=True)
        self._databases.clear()
        self._changer.counts = Counter()

    def _path_in(self, part: Path, number: int) -> Path:
        """Where a file of the result is written."""
        if not self._is_folder:
            return part
        suffix = {"mcap": ".mcap", "db3": ".db3", "bag": ".bag"}[self._container]
        return part / f"{self._path.name}_{number}{suffix}"

    def _write_block(self, source: int, tape: Tape, block: Block, part: Path) -> None:
        if self._untouched(block, tape):
            output = self._output(self._part_of(source, block.start), part)
            if output.can_copy(source, block, tape):
                output.copy(block)
                return
        touched = set()
        for message in block.messages():
            after = self._changer.changed(message, tape.channels[message.channel])
            if after is None:
                continue
            output = self._output(self._part_of(source, after.log_time), part)
            if output.write(source, after, tape.channels[after.channel], tape):
                touched.add(output)
        for output in touched:
            output.closed_block(block)

    def _untouched(self, block: Block, tape: Tape) -> bool:
        """Whether a block stays as it is, as far as it shows without a look inside, or with one."""
        if not block.whole or not block.channels:
            return False
        if not self._changer.keeps_all(block.start, block.end):
            window_only = not self._edits.links
            if not window_only or not self._keeps_each(block, tape):
                return False
        if self._part_of(0, block.start) != self._part_of(0, block.end):
            return False
        changing = [n for n in block.channels if self._changer.touches(tape.channels[n])]
        if changing and not self._keeps_each(block, tape):
            return False
        return block.sound()

    def _keeps_each(self, block: Block, tape: Tape) -> bool:
        """Whether all messages of a block stay as they are."""
        before = Counter(self._changer.counts)
        for message in block.messages():
            if self._changer.changed(message, tape.channels[message.channel]) is not message:
                self._changer.counts = before
                return False
        self._changer.counts = before
        return True

    # Parts

    def _part_of(self, source: int, log_time: Stamp) -> int:
        if self._by_tape:
            return source
        if not self._edits.split_every:
            return 0
        return max(0, (log_time - self._start) // self._edits.split_every)

    def _output(self, number: int, part: Path, start: Stamp | None = None) -> EditedFile:
        """The file of a part; when it is first asked for it begins with its statics, at `start`."""
        found = self._outputs.get(number)
        if found is not None:
            return found
        if len(self._outputs) >= MOST_PARTS:
            raise UsageError(f"That makes more than {MOST_PARTS} files: split less often.")
        path = self._path_in(part, len(self._outputs))
        tape = self._tapes[number if self._by_tape else 0]
        latched = frozenset(one.channel.topic for one in self._statics)
        if self._edits.statics_from:
            latched |= {"/tf_static"}
        output = self._outputs[number] = EditedFile(
            path,
            self._container,
            tape,
            ros2=self._ros2,
            packs=self._mode == "message",
            latched=latched if self._heads else frozenset(),
            first_free=self._first_free(),
        )
        self._order.append(number)
        if self._heads:
            self._write_head(number, output, self._start if start is None else start)
        return output

    def _first_free(self) -> int:
        """The first number that none of the inputs uses."""
        used = [0]
        for tape in self._tapes:
            used += tape.channels
            used += getattr(tape, "schemas", ())
        return max(used) + 1

    # Statics

    def _collect_statics(self) -> None:
        if not self._heads:
            return
        edits = self._edits
        for source, tape in enumerate(self._tapes):
            for block in tape.blocks():
                if block.channels is not None and block.whole:
                    known = [tape.channels[number] for number in block.channels]
                    if not any(map(carries_statics, known)):
                        continue
                for message in block.messages():
                    channel = tape.channels[message.channel]
                    if carries_statics(channel):
                        self._take_statics(source, message, channel)
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

    def _take_statics(self, source: int, message: Taken, channel: Channel) -> None:
        with contextlib.suppress(InputError):
            rows = TransformRows(LAYOUTS[channel.encoding], message.payload).rows
            self._statics += [
                _Static(source, message.channel, channel, message.log_time, row) for row in rows
            ]

    def _write_head(self, number: int, output: EditedFile, start: Stamp) -> None:
        """The latest value of every static, in one message for each channel."""
        edits = self._edits
        start, end = max(start, self._start), _LATEST
        if edits.split_every:
            start = self._start + number * edits.split_every
            end = start + edits.split_every - 1
        if edits.cuts:
            window = self._changer.window
            assert window is not None
            end = min(end, window.end)
        chosen: dict[str, _Static] = {}
        for one in self._statics:
            if self._by_tape and not edits.cuts and one.source > number:
                continue
            child = stripped(one.row.child)
            held = chosen.get(child)
            # The last one up to the end; what comes up only behind it is better than nothing.
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
            message = Taken(own, start, payload, start, 0)
            output.write(source, message, channel, self._tapes[source])
        if added:
            self._write_added(output, added, start)
        output.writer.flush()
        self._changer.counts["statics put first"] += len(chosen) + len(edits.statics_from)

    def _write_added(self, output: EditedFile, rows: Sequence[TransformRow], start: Stamp) -> None:
        """The statics of another recording, where this one has no topic for them."""
        from tftool.sources.writing.converting import as_ros1

        channel = ros2_channel("/tf_static", TRANSFORMS, static=True)
        ros1 = output.container == "bag" or all(
            channel.encoding == "ros1"
            for tape in self._tapes
            for channel in tape.channels.values()
            if carries_transforms(channel)
        )
        if output.container == "bag" or (ros1 and output.container == "mcap" and not self._ros2):
            channel = as_ros1(channel).channel
        payload = encode_rows(LAYOUTS[channel.encoding], rows)
        number = output.channel(channel)
        output.append(number, Taken(number, start, payload, start, 0))

    # The end

    def _compare(self) -> None:
        """Read what was written, and compare it with what was to be written.

        Raises:
            InputError: If it differs.
        """
        for database in self._databases:
            database.compare()
            self.report.messages += sum(database.counts.values())
        total = sum(tape.size for tape in self._tapes)
        sizes = [one.path.stat().st_size for one in self._outputs.values()]
        done = 0
        for output, size in zip(self._outputs.values(), sizes, strict=True):
            tape = open_tape(output.path, unpacks=self._mode == "message")
            try:
                self._compare_one(output, tape)
            finally:
                tape.close()
            done += size
            self._tell(total + total * done // max(sum(sizes), 1), 2 * total)

    def _compare_one(self, output: EditedFile, tape: Tape) -> None:
        counts: Counter[tuple[str, str]] = Counter()
        found: dict[tuple[str, str], int] = {}
        for block in tape.blocks():
            position = getattr(block, "position", None)
            copied = output.copied.get(position) if position is not None else None
            if copied is not None:
                assert isinstance(block, McapChunk | Rosbag1Chunk)
                # Its bytes were read back and compared when they were copied.
                if block.raw().length != copied.chunk.raw().length:
                    raise InputError(f"'{self._path}' differs from its input at byte {position}.")
                for number, count in (block.channels or {}).items():
                    channel = tape.channels[number]
                    counts[channel.topic, channel.type] += count
                continue
            for message in block.messages():
                channel = tape.channels[message.channel]
                key = channel.topic, channel.type
                counts[key] += 1
                found[key] = digest(found.get(key, 0), message, output.container)
        wanted: Counter[tuple[str, str]] = Counter()
        for number, count in output.counts.items():
            channel = output.channels[number]
            wanted[channel.topic, channel.type] += count
        if tape.damage or counts != wanted or found != output.digests:
            what = tape.damage[0] if tape.damage else "its messages differ from what was written"
            raise InputError(f"'{self._path}' was not written as it should be: {what}.")
        self.report.messages += sum(counts.values())
        self.report.copied += len(output.copied)

    def _finish_folder(self, part: Path) -> None:
        facts, topics, names = [], dict[Channel, int](), []
        files: list[EditedFile | EditedDatabase] = [*self._outputs.values(), *self._databases]
        for output in files:
            count = sum(output.counts.values())
            start = output.start if count else 0
            names.append(output.path.name)
            for number, channel in output.channels.items():
                topics[channel] = topics.get(channel, 0) + output.counts[number]
            name = output.path.name
            if self._mode == "file":
                name = _packed(output.path).name
            facts.append(FileFacts(name, start, output.end, count))
        self.report.files = [one.name for one in facts]
        if self._container == "bag":
            return
        storage = {"mcap": "mcap", "db3": "sqlite3"}[self._container]
        compression = ("zstd", self._mode.upper()) if self._mode else ("", "")
        old: Mapping[str, object] | None = None
        if len(self._inputs) == 1:
            old = self._inputs[0].metadata
        text = metadata_text(storage, facts, topics, compression=compression, old=old)
        write_metadata(part, text)

    def _sum_up(self) -> None:
        report = self.report
        report.counts = self._changer.counts
        for one in self._inputs:
            report.notes += one.damage
            for tape in one.tapes:
                report.notes += tape.damage
        for output in self._outputs.values():
            for topic, reason in output.left_out.items():
                text = f"'{topic}' is left out: {reason}."
                if text not in report.notes:
                    report.notes.append(text)
        for topic, reason in self._changer.passed_over.items():
            report.notes.append(f"'{topic}' keeps its names: {reason.rstrip('.')}.")
        if self._edits.names and not self._edits.everywhere:
            report.notes += self._old_names()
        if not report.files:
            report.files = [self._path.name]

    def _old_names(self) -> Iterator[str]:
        """Which topics go on using names that were changed."""
        for recording in self._recordings:
            for topic, headers in recording.source.headers().items():
                old = [self._edits.name(name) != name and bool(name) for name in headers.names]
                count = int(np.count_nonzero(np.array(old, dtype=bool)[headers.frames]))
                if count:
                    yield (
                        f"{count} messages on '{topic}' still use old names: --everywhere "
                        "changes them as well."
                    )

    def _tell(self, done: int, total: int = 0) -> None:
        if self._progress is not None:
            self._progress(done, total or sum(tape.size for tape in self._tapes))


def _examined(block: Block, examined: "Future[bool] | None") -> Block:
    if examined is not None:
        examined.result()
    return block


@dataclass(slots=True)
class _Static:
    """One static transform as it was recorded."""

    source: int
    number: int
    channel: Channel
    log_time: Stamp
    row: TransformRow


def _row_of(sample: TransformStamped) -> TransformRow:
    numbers = (*sample.transform.translation, *sample.transform.rotation)
    return TransformRow(sample.stamp, sample.frame_id, sample.child_frame_id, numbers)


def _widened(moments: "np.ndarray", low: Stamp, high: Stamp) -> tuple[Stamp, Stamp]:
    """A span and one sample more at either end, so that both ends can be interpolated."""
    before, behind = moments[moments <= low], moments[moments >= high]
    first = int(before.max()) if len(before) else low
    last = int(behind.min()) if len(behind) else high
    return first, last


def _packed(path: Path) -> Path:
    """A file compressed as a whole, in its place."""
    from tftool.sources.compressed import zstandard

    packed = path.with_name(path.name + ".zstd")
    with path.open("rb") as source, packed.open("wb") as out:
        writer = zstandard().ZstdCompressor(level=1).stream_writer(out, closefd=False)
        with writer:
            shutil.copyfileobj(source, writer, 1 << 20)
    path.unlink()
    return packed


def _above(frame: str, parents: Mapping[str, set[str]]) -> set[str]:
    """A frame and all it ever hung from."""
    found, waiting = {frame}, [frame]
    while waiting:
        for parent in parents.get(waiting.pop(), ()):
            if parent not in found:
                found.add(parent)
                waiting.append(parent)
    return found


def _joined_by_statics(one: str, other: str, static: Mapping[str, str]) -> bool:
    """Whether two frames never move against each other."""

    def up(frame: str) -> list[str]:
        found = [frame]
        while frame in static and static[frame] not in found:
            frame = static[frame]
            found.append(frame)
        return found

    return not set(up(one)).isdisjoint(up(other))


def _no_such_link(link: LinkName, links: "set[LinkName]") -> str:
    parent, child = link
    others = sorted(p for p, c in links if c == child)
    if others:
        hint = f"'{child}' hangs from '{others[0]}': {others[0]}:{child}"
    else:
        hint = _near(child, {c for _, c in links})
    return f"No link {parent}:{child} was recorded; {hint}."


def _no_such_frame(name: str, frames: "set[str]") -> str:
    return f"No frame '{name}' was recorded; {_near(name, frames)}."


def _near(name: str, names: "set[str]") -> str:
    import difflib

    near = difflib.get_close_matches(name, sorted(names), n=3)
    if near:
        return f"did you mean {' or '.join(near)}?".rstrip("?")
    shown = ", ".join(sorted(names)[:8])
    return f"there are {shown}{' ...' if len(names) > 8 else ''}"
