"""Opening of rosbag2 folders, of several files, and of files that are compressed as a whole.

The metadata of rosbag2 may be wrong, so files are read even if the metadata does not list them.
"""

import shutil
import tempfile
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np

from tftool.base.errors import InputError
from tftool.base.plain_text import natural_key
from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch
from tftool.recordings.container import MOST_STREAMS, Container
from tftool.recordings.containers import CONTAINERS
from tftool.recordings.contract import Progress
from tftool.recordings.decompression import most_of, zstandard
from tftool.recordings.find import (
    BESIDE,
    METADATA,
    Found,
    Kind,
    container_in,
    kind_of_file,
    refusal,
)
from tftool.recordings.rosbag2.format import read_metadata

_PARTS: Final = (*(Kind(one.words) for one in CONTAINERS if one.storage), Kind.ZSTD)
_LARGEST_UNPACKED: Final = 1 << 34
_STEP: Final = 1 << 20


def open_parts(found: Found) -> Container:
    """Open a folder, several files, or a file that is compressed as a whole; see `open_found`."""
    if found.kind is Kind.SEVERAL:
        return _joined(found.paths, [], by_time=True)
    return _open_file(found.paths[0])


def _open_file(path: Path) -> Container:
    if path.is_dir():
        return _open_folder(path)
    kind = kind_of_file(path)
    if kind is Kind.ZSTD:
        return _Unpacked(path)
    return container_in(path, kind).open(path)


def _open_folder(folder: Path) -> Container:
    """Open the files of one rosbag2 recording."""
    damage: list[str] = []
    files = files_of_folder(folder, damage)
    container = _joined(files, damage)
    if len(files) == 1 and len(damage) == 2:  # a name in the metadata, and the file read instead
        held = sum(container.counts)
        if held and held == read_metadata(folder).get("message_count"):
            container.damage[1] += (
                f" This file has all {held} messages that the metadata counts: rename the file, "
                "because 'ros2 bag play' needs the name in the metadata."
            )
    return container


def files_of_folder(folder: Path, damage: list[str]) -> list[Path]:
    """Return the files of a rosbag2 recording, in order; append sentences about faults to `damage`.

    Raises:
        InputError: If there are no files.
    """
    there = sorted(
        (path for path in folder.iterdir() if path.is_file() and _is_part(path)),
        key=lambda path: natural_key(path.name),
    )
    listed = _listed(folder, damage)
    # Opening a file that is not a recording (an empty file, for example) reports it.
    parts = [folder / name for name in listed if (folder / name).is_file()]
    missing = [name for name in listed if not (folder / name).is_file()]
    others = [path for path in there if path not in parts]
    if missing:
        damage.append(
            f"The {METADATA} names {_few(missing)}, which {'is' if len(missing) == 1 else 'are'} "
            "missing."
        )
        if not parts and others:
            damage.append(f"Read instead: {_few([path.name for path in others])}.")
    if not listed or missing or not set(parts) <= set(there):
        # Parts that were renamed are read too, after those in the metadata.
        parts += others
    if not parts:
        raise InputError(
            f"'{folder}' has the {METADATA} of a rosbag2 recording, but none of its files"
            + (f": add {_few(missing)} to the folder." if missing else ".")
        )
    return parts


def _joined(paths: Sequence[Path], damage: list[str], *, by_time: bool = False) -> Container:
    """Open files as one recording; raise an error only if no file can be read.

    Args:
        paths: Paths of the files.
        damage: List to which sentences about unreadable files are appended.
        by_time: Whether to order files by the time of their first message instead of by name.
    """
    parts: list[tuple[str, Container]] = []
    refused: list[InputError] = []
    for path in paths:
        try:
            parts.append((path.name, _open_file(path)))
            continue
        except InputError as error:
            refused.append(error)
        except OSError as error:
            refused.append(refusal(path, error))
        damage.append(f"{path.name} is left out: {refused[-1]}")
    if not parts:
        raise refused[0]
    if len(parts) == 1 and len(paths) == 1:
        parts[0][1].damage[:0] = damage
        return parts[0][1]
    if by_time:
        parts.sort(key=lambda part: part[1].start)
    return Joined(parts, damage)


def _listed(folder: Path, damage: list[str]) -> list[str]:
    """Return the file names in a folder's metadata, without paths; append faults to `damage`."""
    path = folder / METADATA
    if not path.exists():
        damage.append(f"There is no {METADATA}: the files are read without metadata.")
        return []
    try:
        names = read_metadata(folder)["relative_file_paths"]
        return [Path(str(name)).name for name in names][:10_000]
    except (OSError, ValueError, KeyError, TypeError) as error:
        why = getattr(error, "strerror", None) or str(error) or type(error).__name__
        first = why.splitlines()[0]
        damage.append(
            f"The {METADATA} cannot be read ({first}): the files are read without metadata."
        )
        return []


def _is_part(path: Path) -> bool:
    """Whether a file in a rosbag2 folder is one of the recording's files."""
    if path.name == METADATA or path.name.endswith(BESIDE):
        return False
    try:
        return kind_of_file(path) in _PARTS
    except PermissionError:
        return True  # it may be a part, and opening it will report the error
    except InputError:
        return False


def _few(names: Sequence[str]) -> str:
    shown = ", ".join(f"'{name}'" for name in names[:3])
    return shown if len(names) <= 3 else f"{shown} and {len(names) - 3} more"


class _Unpacked:
    """Container of a compressed file, which is decompressed to a temporary file."""

    def __init__(self, path: Path) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="tftool-")
        try:
            target = Path(self._folder.name) / path.stem
            cut = unpack_file(path, target)
            self._inner = _open_file(target)
        except BaseException:
            self._folder.cleanup()
            raise
        if cut:
            self._inner.damage.insert(0, cut)
        self.kind = f"{self._inner.kind}, zstd"
        self.size = self._inner.size
        self.start = self._inner.start
        self.end = self._inner.end
        self.streams = self._inner.streams
        self.damage = self._inner.damage
        self.batches = self._inner.batches
        self.expected = self._inner.expected

    @property
    def counts(self) -> list[int]:
        """Return the number of messages of each stream."""
        return self._inner.counts

    def close(self) -> None:
        """Close the file, and remove the temporary file."""
        self._inner.close()
        self._folder.cleanup()


def unpack_file(path: Path, target: Path) -> str:
    """Decompress a file to `target`; return a sentence about damage of the file, or ""."""
    free = shutil.disk_usage(target.parent).free
    limit = min(_LARGEST_UNPACKED, free - (1 << 26))
    plausible = most_of(path.stat().st_size)
    done = 0
    with path.open("rb") as packed, target.open("wb") as out:
        stream = zstandard().ZstdDecompressor().stream_reader(packed, read_across_frames=True)
        while True:
            try:
                piece = stream.read(_STEP)
            except zstandard().ZstdError as error:
                if not done:
                    raise InputError(f"'{path}' is damaged zstd data ({error}).") from error
                return f"The zstd data is damaged after byte {done} ({error})."
            if not piece:
                if not done:
                    raise InputError(
                        f"'{path}' ends after {path.stat().st_size} bytes without any content: it "
                        "was truncated, or never finished."
                    )
                return ""
            done += len(piece)
            if done > plausible:
                raise InputError(
                    f"'{path}' unpacks to more than {plausible} bytes, which is implausible: "
                    "fetch the file again."
                )
            if done > limit:
                raise InputError(
                    f"'{path}' unpacks to more than {limit} bytes, more than fits on this disk: "
                    "unpack it on a larger disk ('zstd -d')."
                )
            out.write(piece)


class Joined:
    """Several containers that are read one after the other; see `Container`."""

    def __init__(self, parts: Sequence[tuple[str, Container]], damage: Sequence[str] = ()) -> None:
        """Join containers.

        Args:
            parts: Name and container of each part.
            damage: Sentences about further damage of the recording.
        """
        self._parts = parts
        self._damage = list(damage)
        containers = [part for _, part in parts]
        kinds = list(dict.fromkeys(part.kind for part in containers))
        self.kind = f"{' and '.join(kinds)}, {len(parts)} files"
        self.size = sum(part.size for part in containers)
        self.start = min((part.start for part in containers if part.start), default=0)
        self.end = max((part.end for part in containers), default=0)
        numbers: dict[Channel, int] = {}
        self._maps = []
        for part in containers:
            for stream in part.streams:
                if len(numbers) < MOST_STREAMS:
                    numbers.setdefault(stream, len(numbers))
            found = [numbers.get(stream, -1) for stream in part.streams]
            self._maps.append(np.array(found, dtype=np.int32))
        self.streams = list(numbers)

    @property
    def counts(self) -> list[int]:
        """Return the number of messages of each stream, in all parts together."""
        found = [0] * len(self.streams)
        for (_, part), numbers in zip(self._parts, self._maps, strict=True):
            for number, count in zip(numbers.tolist(), part.counts, strict=True):
                if number >= 0:
                    found[number] += count
        return found

    @property
    def damage(self) -> list[str]:
        """Return sentences about the damage of all parts, with the names of the files."""
        return [
            *self._damage,
            *(f"{name}: {damage}" for name, part in self._parts for damage in part.damage),
        ]

    def expected(self, wanted: Collection[int]) -> int:
        """Return 0 (unknown), because the files are opened one after the other."""
        return 0

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield the messages of some streams, file after file; see `Container`."""
        before = 0
        for (_, part), numbers in zip(self._parts, self._maps, strict=True):
            chosen = {n for n, number in enumerate(numbers.tolist()) if number in wanted}
            for batch in part.batches(chosen, _moved(progress, before, self.size), head):
                yield Batch(
                    batch.buffer,
                    batch.starts,
                    batch.lengths,
                    batch.log_times,
                    numbers[batch.senders],
                )
            before += part.size

    def close(self) -> None:
        """Close all files."""
        for _, part in self._parts:
            part.close()


def _moved(progress: Progress | None, before: int, size: int) -> Progress | None:
    """Return a function that adds the progress in one file to the progress in earlier files.

    Args:
        progress: Function called with the progress in the whole recording; None for no reports.
        before: Size of the files already read, bytes.
        size: Size of all files, bytes.
    """
    if progress is None:
        return None

    def told(done: int, total: int) -> None:
        progress(before + done, size)

    return told
