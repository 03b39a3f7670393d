"""Writer of changed recordings for `tftool edit`; all unchanged bytes are copied.

Every chunk is copied if none of its messages change, else parsed and changed. Then the output is
read back, and compared completely with the intended content. Finally the output gets its final
name.
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

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel
from tftool.recordings.chunked import Chunk, ChunkedReader
from tftool.recordings.container import Block, ContainerReader, MessageTable
from tftool.recordings.container_reader import LAYOUTS, has_transforms
from tftool.recordings.containers import PACKED_SUFFIX, container_named, container_of
from tftool.recordings.contract import Progress
from tftool.recordings.decompression import zstandard
from tftool.recordings.edit.changes import Edits, carries_transforms
from tftool.recordings.edit.database import EditedDatabase, Unsound
from tftool.recordings.edit.heads import StaticHeads
from tftool.recordings.edit.outputs import EditedFile, digest_table
from tftool.recordings.edit.plan import EditedInput, changer_for, open_input, open_reader
from tftool.recordings.recording import Recording, open_recording
from tftool.recordings.rosbag2.format import FileFacts, metadata_text, write_metadata
from tftool.recordings.rosbag2.read import Sqlite
from tftool.recordings.target import Target, check_room, failed, part_of

MOST_PARTS: Final = 10_000
_ROOM: Final = 1 << 20
_AHEAD: Final = 3  # chunks that are verified ahead of writing


@dataclass(slots=True)
class EditReport:
    """Result of an edit: counts of changes, and the files written.

    Attributes:
        messages: Number of messages in the result.
        counts: Number of changes, by name of the change.
        notes: Further notes, as sentences.
        files: Names of the written files.
        copied: Number of chunks that were copied unchanged.
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
    ros2: bool = False,
    progress: Progress | None = None,
) -> EditReport:
    """Write a new recording from one or several recordings, with changes.

    Args:
        names: Files or folders of the recordings; several recordings are joined.
        output: Path to write. The suffix selects the file format; a path without a suffix is a
            rosbag2 folder.
        edits: Changes to make.
        force: Whether existing files may be replaced.
        dry_run: Whether to report the changes without writing.
        ros2: Whether ROS 1 messages are converted to ROS 2 in an MCAP file.
        progress: Function called with the progress.

    Raises:
        UsageError: If the changes cannot be made to these recordings, a recording is named twice,
            or the output exists or is an input.
        InputError: If a recording cannot be read, or the output cannot be written.
    """
    container = container_of(output)
    with contextlib.ExitStack() as stack:
        inputs = [stack.enter_context(open_input(name)) for name in names]
        _refuse_twice(inputs)
        _refuse_the_input(inputs, output)
        recordings = [stack.enter_context(open_recording(name)) for name in names]
        job = _Job(inputs, recordings, output, container, edits, progress, ros2=ros2)
        if dry_run:
            return job.tried()
        return job.done(force=force)


def _refuse_twice(inputs: Sequence[EditedInput]) -> None:
    """Raise an error if a file is among the inputs twice: its messages would be duplicated.

    Raises:
        UsageError: If a file is named twice, even by different paths.
    """
    seen: dict[Path, str] = {}
    for one in inputs:
        for path in {path.resolve() for path in one.paths}:
            if path in seen:
                raise UsageError(
                    f"'{one.name}' is already an input, as '{seen[path]}': name each recording "
                    "only once."
                )
            seen[path] = one.name


def _refuse_the_input(inputs: Sequence[EditedInput], output: Path) -> None:
    """Raise an error if the output would overwrite an input, even by another path.

    Raises:
        UsageError: If the output is an input.
    """
    for one in inputs:
        for path in [Path(one.name), *one.paths]:
            if output.exists() and path.exists() and output.samefile(path):
                raise UsageError(f"'{output}' is the input: name another output.")
            part = part_of(output)
            if part.exists() and path.exists() and part.samefile(path):
                raise UsageError(
                    f"'{path}' is an input, but has the temporary name of '{output}': choose "
                    "another output."
                )
            if path.parent.resolve() == output.resolve() and output.exists():
                raise UsageError(f"'{output}' contains the input: name another output.")


class _Job:
    """One edit, from opened inputs to the verified output."""

    def __init__(
        self,
        inputs: Sequence[EditedInput],
        recordings: Sequence[Recording],
        output: Path,
        container: str,
        edits: Edits,
        progress: Progress | None,
        *,
        ros2: bool,
    ) -> None:
        self._inputs = inputs
        self._recordings = recordings
        self._path = output
        self._edits = edits
        self._progress = progress
        self._readers: list[ContainerReader] = [reader for one in inputs for reader in one.readers]
        self._is_folder = not container
        encoding = container_named(container).encoding if container else ""
        if ros2 and encoding == "ros1":
            raise UsageError(
                f"A {output.suffix} file contains messages of ROS 1, but --ros2 converts messages "
                f"to ROS 2: write '{output.stem}.mcap' or '{output.stem}.db3'."
            )
        self._ros2 = ros2 or encoding == "cdr"
        if edits.split_every and container:
            raise UsageError(
                "--split-every writes several files into a folder: name the output "
                f"'{output.stem}', not '{output.name}'."
            )
        if not container:
            kinds = {reader.container for reader in self._readers}
            container = "db3" if kinds == {"db3"} else "mcap"
            # rosbag2 has no folders of ROS 1 bags; splitting a bag makes one.
            if kinds == {"bag"} and edits.split_every:
                container = "bag"
            self._ros2 = ros2 or container != "bag"
        self._container = container
        first = inputs[0]
        self._mode = first.mode if self._is_folder and container == "db3" else ""
        # Each file of a folder becomes one file of the result.
        self._by_input = (
            self._is_folder and len(inputs) == 1 and first.is_folder and not edits.split_every
        )
        self.report = EditReport()
        self._changer = changer_for(edits, recordings)
        starts = [one.source.start for one in recordings if one.source.start]
        self._start: Stamp = min(starts, default=0)
        if self._changer.window is not None:
            self._start = max(self._start, self._changer.window.start)
        self._outputs: dict[int, EditedFile] = {}
        self._databases: list[EditedDatabase] = []
        self._order: list[int] = []
        self._heads = StaticHeads(
            edits,
            self._readers,
            self._changer,
            self._start,
            by_input=self._by_input,
            ros2=self._ros2,
        )

    # The runs

    def tried(self) -> EditReport:
        """Return a report of the changes that the edit would make, without writing."""
        self._heads.collect()
        done = 0
        for reader in self._readers:
            for block in reader.blocks():
                if self._stays_unseen(block, reader) and block.sound():
                    self.report.messages += sum((block.counts or {}).values())
                    self.report.copied += self._in_one_part(block)
                    continue
                table = block.table()
                after = self._changer.changed_table(table, reader.channels)
                self.report.messages += len(after)
                self.report.copied += after is table and self._in_one_part(block)
            done += reader.size
            self._tell(done)
        self._sum_up()
        return self.report

    def done(self, *, force: bool) -> EditReport:
        """Run the edit, and return a report of the changes."""
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
        same = {reader.container for reader in self._readers} == {self._container}
        # Another container may compress less, which is unknown before writing.
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
        self._heads.collect()
        total, done = sum(reader.size for reader in self._readers), 0
        for source, reader in enumerate(self._readers):
            for block in self._examined_ahead(reader):
                if self._by_input and source not in self._outputs:
                    self._output(source, part, block.start or self._start)
                self._write_block(source, reader, block, part)
                if isinstance(block, Chunk):
                    self._tell(done + min(block.behind, reader.size), 2 * total)
            if self._by_input:
                self._output(source, part)
            done += reader.size
            self._tell(done, 2 * total)
        if not self._outputs:
            self._output(0, part)
        for number, output in self._outputs.items():
            whose = [self._readers[number]] if self._by_input else self._readers
            output.finish(whose if self._by_input or number == self._order[0] else [])

    def _examined_ahead(self, reader: ContainerReader) -> Iterator[Block]:
        """Yield the blocks of an input, while a thread verifies the following blocks.

        Decompressing a chunk and checking its CRC takes as long as copying it, and both release
        the GIL.
        """
        waiting: deque[tuple[Block, Future[bool] | None]] = deque()
        with ThreadPoolExecutor(1, "tftool-examine") as pool:
            try:
                for block in reader.blocks():
                    stays = self._stays_unseen(block, reader)
                    waiting.append((block, pool.submit(block.sound) if stays else None))
                    if len(waiting) > _AHEAD:
                        yield _examined(*waiting.popleft())
                while waiting:
                    yield _examined(*waiting.popleft())
            finally:
                for _, examined in waiting:
                    if examined is not None:
                        examined.cancel()

    def _stays_unseen(self, block: Block, reader: ContainerReader) -> bool:
        """Whether the index alone shows that the edit changes nothing in a block."""
        return (
            block.whole
            and bool(block.counts)
            and self._changer.keeps_all(block.start, block.end)
            and not any(self._changer.touches(reader.channels[n]) for n in block.counts or ())
        )

    # Databases

    def _changed_in_place(self) -> list[Sqlite]:
        """Return the input databases if the edit can copy them and update rows; else []."""
        readers = [reader for reader in self._readers if isinstance(reader, Sqlite)]
        alike = len(readers) == len(self._readers) and self._container == "db3"
        one_to_one = self._by_input or (len(readers) == 1 and not self._edits.split_every)
        # Copying is impossible if messages must be compressed again, or damaged rows be skipped.
        packed = self._mode == "message" or any(one.mode == "message" for one in self._inputs)
        damaged = any(one.damage for one in self._inputs) or any(
            reader.damage for reader in readers
        )
        if not alike or not one_to_one or packed or damaged or self._heads.wanted:
            return []
        return readers

    def _change_databases(self, readers: Sequence[Sqlite], part: Path) -> None:
        total, done = sum(reader.size for reader in readers), 0
        for reader in readers:
            database = EditedDatabase(self._path_in(part, len(self._databases)), reader)
            self._databases.append(database)
            done += reader.size
            self._tell(done // 2, 2 * total)
            touched = [n for n, one in reader.channels.items() if self._changer.touches(one)]
            database.change(self._changer.changed_table, touched)
            database.finish()
            self._tell(done, 2 * total)

    def _forget_databases(self) -> None:
        for database in self._databases:
            database.abandon()
            database.path.unlink(missing_ok=True)
        self._databases.clear()
        self._changer.counts = Counter()

    def _path_in(self, part: Path, number: int) -> Path:
        """Return the path of the output file `number`, counted from 0."""
        if not self._is_folder:
            return part
        suffix = container_named(self._container).suffix
        return part / f"{self._path.name}_{number}{suffix}"

    def _write_block(
        self, input_number: int, reader: ContainerReader, block: Block, part: Path
    ) -> None:
        stays = self._stays_unseen(block, reader) and block.sound()
        table = after = None
        done = Counter[str]()
        if not stays:
            counts, self._changer.counts = self._changer.counts, done
            table = block.table()
            after = self._changer.changed_table(table, reader.channels)
            self._changer.counts = counts
        keeps = not self._edits.links or self._changer.keeps_all(block.start, block.end)
        if after is table and keeps and self._in_one_part(block):
            assert isinstance(block, Chunk)
            output = self._output(self._part_of(input_number, block.start), part)
            if output.can_copy(input_number, block, reader):
                output.copy(block)
                return
        self._changer.counts.update(done)
        for number, rows in self._by_part(input_number, block.table() if after is None else after):
            output = self._output(number, part)
            if output.write(input_number, rows, reader):
                output.closed_block(block)

    def _by_part(
        self, input_number: int, table: MessageTable
    ) -> Iterator[tuple[int, MessageTable]]:
        """Yield the number of each output file, with the messages that belong in the file."""
        if not self._edits.split_every:
            if len(table):
                yield self._part_of(input_number, 0), table
            return
        parts = np.maximum(0, (table.log_times - self._start) // self._edits.split_every)
        for number in dict.fromkeys(parts.tolist()):
            yield number, table.chosen(np.flatnonzero(parts == number))

    def _in_one_part(self, block: Block) -> bool:
        """Whether a block is an undamaged chunk whose messages all belong in one output file."""
        is_one = self._part_of(0, block.start) == self._part_of(0, block.end)
        return is_one and block.whole and bool(block.counts) and isinstance(block, Chunk)

    # Parts

    def _part_of(self, input_number: int, log_time: Stamp) -> int:
        """Return the number of the output file for a message of an input."""
        if self._by_input:
            return input_number
        if not self._edits.split_every:
            return 0
        return max(0, (log_time - self._start) // self._edits.split_every)

    def _output(self, number: int, part: Path, start: Stamp | None = None) -> EditedFile:
        """Return the output file `number`; a new file begins with the static transforms.

        Args:
            number: Number of the file, from 0.
            part: Path of the incomplete output: a file, or the folder of several files.
            start: Log time of the static transforms; None for the start of the output.
        """
        found = self._outputs.get(number)
        if found is not None:
            return found
        if len(self._outputs) >= MOST_PARTS:
            raise UsageError(
                f"--split-every would make more than {MOST_PARTS} files: choose a longer time."
            )
        path = self._path_in(part, len(self._outputs))
        reader = self._readers[number if self._by_input else 0]
        output = self._outputs[number] = EditedFile(
            path,
            self._container,
            reader,
            ros2=self._ros2,
            packs=self._mode == "message",
            latched=self._heads.topics,
            first_free=self._first_free(),
        )
        self._order.append(number)
        self._heads.write(number, output, self._start if start is None else start)
        return output

    def _first_free(self) -> int:
        """Return the smallest number above the numbers of all the inputs' channels and schemas."""
        used = [0]
        for reader in self._readers:
            used += reader.channels
            if isinstance(reader, ChunkedReader):
                used += reader.schemas
        return max(used) + 1

    # Comparison

    def _compare(self) -> None:
        """Read the output back, and compare the output with the intended content.

        Raises:
            InputError: If the output differs from the intended content.
        """
        for database in self._databases:
            database.compare()
            self.report.messages += sum(database.counts.values())
        total = sum(reader.size for reader in self._readers)
        sizes = [one.path.stat().st_size for one in self._outputs.values()]
        done = 0
        for output, size in zip(self._outputs.values(), sizes, strict=True):
            reader = open_reader(output.path, unpacks=self._mode == "message")
            try:
                self._compare_one(output, reader)
            finally:
                reader.close()
            done += size
            self._tell(total + total * done // max(sum(sizes), 1), 2 * total)

    def _compare_one(self, output: EditedFile, reader: ContainerReader) -> None:
        counts: Counter[tuple[str, str]] = Counter()
        found: dict[tuple[str, str], int] = {}
        for block in reader.blocks():
            if isinstance(block, Chunk) and block.position in output.copied:
                # The bytes of a copied chunk were compared when they were copied.
                position = block.position
                if block.raw().length != output.copied[position]:
                    raise InputError(f"'{self._path}' differs from its input at byte {position}.")
                for number, count in (block.counts or {}).items():
                    channel = reader.channels[number]
                    counts[channel.topic, channel.type] += count
                continue
            table = block.table()
            for number, count in Counter(table.channels.tolist()).items():
                channel = reader.channels[number]
                counts[channel.topic, channel.type] += count
            digest_table(found, table, reader.channels, output.container)
        wanted: Counter[tuple[str, str]] = Counter()
        for number, count in output.counts.items():
            channel = output.channels[number]
            wanted[channel.topic, channel.type] += count
        if reader.damage or counts != wanted or found != output.digests:
            what = (
                reader.damage[0] if reader.damage else "messages differ from the written messages"
            )
            raise InputError(f"'{self._path}' failed the check after writing: {what}.")
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
        storage = container_named(self._container).storage
        if not storage:
            return
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
            report.notes += [*one.notes, *one.damage]
            for reader in one.readers:
                report.notes += reader.damage
        for output in self._outputs.values():
            for topic, fate in output.refused.items():
                text = f"'{topic}' {fate}"
                if text not in report.notes:
                    report.notes.append(text)
        for topic, reason in self._changer.passed_over.items():
            report.notes.append(
                f"The frame names on '{topic}' are unchanged: {reason.rstrip('.')}."
            )
        report.notes += self._unchanged_transforms()
        if self._edits.names and not self._edits.everywhere:
            report.notes += self._old_names()
        ros1 = any(
            one.encoding == "ros1" for reader in self._readers for one in reader.channels.values()
        )
        if ros1 and not container_named(self._container).encoding and not self._ros2:
            report.notes.append(
                "Messages keep the encoding of ROS 1 (profile ros1): --ros2 converts to ROS 2."
            )
        if not report.files:
            report.files = [self._path.name]

    def _unchanged_transforms(self) -> Iterator[str]:
        """Yield sentences about topics whose transforms have a form that an edit cannot change."""
        if not self._edits.links:
            return
        channels = {one for reader in self._readers for one in reader.channels.values()}
        has_lists = any(map(carries_transforms, channels))
        for one in sorted(channels, key=lambda channel: channel.topic):
            if carries_transforms(one) or not has_transforms(one):
                continue
            # Other topics beside /tf with single transforms of ROS: --everywhere changes names.
            if (one.encoding in LAYOUTS and has_lists) or one.topic in self._changer.passed_over:
                continue
            yield (
                f"The transforms on '{one.topic}' are unchanged: an edit changes "
                f"tf2_msgs/TFMessage in the encodings of ROS, and these are {one.type} in "
                f"{one.encoding}."
            )

    def _old_names(self) -> Iterator[str]:
        """Yield sentences about topics in which frame names could not be changed."""
        for recording in self._recordings:
            for topic, headers in recording.source.headers().items():
                old = [self._edits.name(name) != name and bool(name) for name in headers.names]
                count = int(np.count_nonzero(np.array(old, dtype=bool)[headers.frames]))
                if count:
                    yield (
                        f"{count} messages on '{topic}' still use old frame names: "
                        "--everywhere changes these names as well."
                    )

    def _tell(self, done: int, total: int = 0) -> None:
        if self._progress is not None:
            self._progress(done, total or sum(reader.size for reader in self._readers))


def _examined(block: Block, examined: "Future[bool] | None") -> Block:
    if examined is not None:
        examined.result()
    return block


def _packed(path: Path) -> Path:
    """Replace an output file by a zstd-compressed file, and return the new file's path."""
    packed = path.with_name(path.name + PACKED_SUFFIX)
    with path.open("rb") as source, packed.open("wb") as out:
        writer = zstandard().ZstdCompressor(level=1).stream_writer(out, closefd=False)
        with writer:
            shutil.copyfileobj(source, writer, 1 << 20)
    path.unlink()
    return packed
