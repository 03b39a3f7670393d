"""Cache of the transforms of recordings as decoded columns, in the user's cache folder.

The key of a recording is computed from paths, sizes, times, and first and last bytes of its files.
An incomplete or damaged cache file counts as missing, because another process may be writing it.
"""

import contextlib
import json
import os
import stat
import tempfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np

from tftool.base.named_files import open_regular
from tftool.recordings.cache_heads import MAGIC, SUFFIX, head_size, key_of, parsed_head
from tftool.recordings.contract import Edge, Publisher, Transforms
from tftool.recordings.find import Found

MOST_BYTES: Final = 1 << 30
"""Maximum size of the whole cache, bytes; the least recently used entries are removed first."""

LARGEST: Final = MOST_BYTES // 2
"""Maximum size of one recording's entry, bytes."""


class ColumnCache:
    """Folder with one cache file per recording, shared by all processes of the user."""

    def __init__(self, folder: Path, *, most_bytes: int = MOST_BYTES) -> None:
        """Create a cache in a folder; `store` creates the folder if the folder is missing.

        Args:
            folder: Folder of the cache files.
            most_bytes: Maximum size of all cache files together, bytes.
        """
        self.folder = folder
        self._most_bytes = most_bytes

    def load(self, key: str) -> Transforms | None:
        """Return the cached transforms of a key; None if the cache file is missing or damaged."""
        if not key:
            return None
        path = self.folder / f"{key}{SUFFIX}"
        try:
            with open_regular(path) as file:
                size = os.fstat(file.fileno()).st_size
                if size > LARGEST:
                    return None
                data = bytearray(size)
                if file.readinto(data) != size:
                    return None
            found = _unpacked(data, key)
            # Entries are removed by this time, the least recently used first.
            os.utime(path)
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return None
        return found

    def store(self, key: str, transforms: Transforms) -> bool:
        """Write transforms to the cache file of a key, and return whether the file was written.

        Return False, without an error, if the disk is full or the folder is read-only.
        """
        if not key or len(transforms) * 68 > min(LARGEST, self._most_bytes):
            return False
        try:
            self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            number, name = tempfile.mkstemp(dir=self.folder, suffix=".part")
            try:
                with os.fdopen(number, "wb") as file:
                    for part in _packed(transforms, key):
                        file.write(part)
                os.replace(name, self.folder / f"{key}{SUFFIX}")
            except BaseException:
                with contextlib.suppress(OSError):
                    os.unlink(name)
                raise
            self._prune()
        except OSError:
            return False
        return True

    def _prune(self) -> None:
        """Remove incomplete cache files, and the least recently used files above the size limit."""
        entries = []
        newest = 0.0
        for path in self.folder.iterdir():
            if path.suffix in (SUFFIX, ".part"):
                with contextlib.suppress(OSError):
                    status = path.stat()
                    if not stat.S_ISREG(status.st_mode):
                        continue  # not an entry
                    entries.append((status.st_mtime, status.st_size, path))
                    newest = max(newest, status.st_mtime)
        total = sum(size for _, size, _ in entries)
        for used, size, path in sorted(entries):
            is_left = path.suffix == ".part" and newest - used > 3600
            if not is_left and (total <= self._most_bytes or path.suffix == ".part"):
                continue
            # Another process may have removed the entry, or keep it open.
            with contextlib.suppress(OSError):
                path.unlink()
                total -= size


def _packed(transforms: Transforms, key: str) -> Iterator[bytes | memoryview]:
    """Yield the bytes of a cache file: a JSON header, then all columns, the widest types first."""
    edges = transforms.edges
    columns: list[np.ndarray[Any, Any]] = [
        transforms.log_times,
        *(edge.records for edge in edges),
        transforms.senders,
        *(edge.messages for edge in edges),
    ]
    parts = [np.ascontiguousarray(one).data.cast("B") for one in columns]
    check = 0
    for part in parts:
        check = zlib.crc32(part, check)
    head = json.dumps(
        {
            "key": key,
            "messages": len(transforms.log_times),
            "edges": [
                (edge.parent, edge.child, edge.static, edge.slashed, len(edge), edge.kept)
                for edge in edges
            ],
            "publishers": [
                (one.topic, one.node, one.durability, one.reliability, one.offers)
                for one in transforms.publishers
            ],
            "damage": transforms.damage,
            "check": check,
        }
    ).encode()
    head += b" " * (-(len(MAGIC) + 12 + len(head)) % 8)
    yield MAGIC
    yield len(head).to_bytes(8, "little")
    yield zlib.crc32(head).to_bytes(4, "little")
    yield head
    yield from parts


def _unpacked(data: bytearray, key: str) -> Transforms:
    """Return the transforms in the bytes of a cache file.

    Raises:
        ValueError: If the bytes are incomplete or damaged.
    """
    start = head_size(bytes(data[: len(MAGIC) + 12]))
    head = parsed_head(bytes(data[:start]), key)
    messages, counts = int(head["messages"]), [int(edge[4]) for edge in head["edges"]]
    rows = sum(counts)
    if min(messages, *counts, 0) < 0 or len(data) - start != 12 * messages + 68 * rows:
        raise ValueError("cut")
    if zlib.crc32(memoryview(data)[start:]) != head["check"]:
        raise ValueError("damaged")
    # One array for the rows of all edges, because there may be many edges.
    wide = np.frombuffer(data, "<i8", messages + 8 * rows, start)
    narrow = np.frombuffer(data, "<i4", messages + rows, start + wide.nbytes)
    records, places = wide[messages:].reshape(rows, 8), narrow[messages:]
    edges, end = [], 0
    for parent, child, static, slashed, count, kept in head["edges"]:
        begin, end = end, end + count
        edges.append(
            Edge(parent, child, static, slashed, records[begin:end], places[begin:end], kept)
        )
    publishers = tuple(Publisher(*one) for one in head["publishers"])
    log_times, senders = wide[:messages], narrow[:messages]
    return Transforms(tuple(edges), log_times, senders, publishers, tuple(head["damage"]))


class KeptColumns:
    """Cached transforms of one recording, valid while the files of the recording do not change."""

    def __init__(self, cache: ColumnCache, found: Found) -> None:
        """Compute the key of the recording from the present state of its files.

        Args:
            cache: The cache.
            found: The recording.
        """
        self._cache = cache
        self._found = found
        self._key = self._key_now()

    def load(self) -> Transforms | None:
        """Return the transforms of the recording from the cache; None if they are not cached."""
        return self._cache.load(self._key)

    def store(self, transforms: Transforms) -> None:
        """Store the transforms of the recording, unless its files have changed meanwhile."""
        if self._key and self._key_now() == self._key:
            self._cache.store(self._key, transforms)

    def _key_now(self) -> str:
        try:
            return key_of(self._found)
        except OSError:
            return ""
