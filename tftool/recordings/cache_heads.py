"""Folder, keys and file headers of the cache of decoded recordings, without numpy.

The completion of frame names in a shell reads only the header of a cache file, in milliseconds.
"""

import hashlib
import json
import os
import sys
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from tftool.base.named_files import open_regular
from tftool.recordings.find import METADATA, Found

FORMAT: Final = 3
"""Version of the cache; raised if a release computes other columns, or stores them otherwise."""

WORTHWHILE: Final = 4 << 20
"""Size of a recording, bytes, from which its columns are cached; small ones are read quickly."""

MAGIC: Final = b"tftool columns\n"
SUFFIX: Final = ".columns"

_END: Final = 4096
_MOST_HEAD: Final = 64 << 20


def default_folder() -> Path | None:
    """Return the folder of the cache, in `XDG_CACHE_HOME` or else in the system's usual folder.

    Return None if HOME is not set and the system does not know the user's home folder.
    """
    given = os.environ.get("XDG_CACHE_HOME", "")
    if os.path.isabs(given):
        return Path(given) / "tftool"
    try:
        home = Path.home()
    except RuntimeError:
        return None
    if sys.platform == "win32":
        local = os.environ.get("LOCALAPPDATA")
        return Path(local or home / "AppData" / "Local") / "tftool" / "Cache"
    if sys.platform == "darwin":
        return home / "Library" / "Caches" / "tftool"
    return home / ".cache" / "tftool"


def key_of(found: Found, *, any_size: bool = False) -> str:
    """Return the key of a recording in the cache; "" if the recording is too small to be cached.

    Args:
        found: The recording.
        any_size: Whether to return a key for small recordings too.

    Raises:
        OSError: If a file of the recording cannot be read.
    """
    told: list[tuple[object, ...]] = [(FORMAT, found.kind.value, sys.byteorder)]
    total = 0
    for path in _files(found):
        with path.open("rb") as file:
            status = os.fstat(file.fileno())
            total += status.st_size
            first = file.read(_END)
            file.seek(max(0, status.st_size - _END))
            last = file.read(_END)
        where = os.fsencode(os.path.abspath(path)).hex()
        told.append((where, status.st_size, status.st_mtime_ns, first.hex(), last.hex()))
    if total < WORTHWHILE and not any_size:
        return ""
    return hashlib.blake2b(json.dumps(told).encode(), digest_size=16).hexdigest()


def _files(found: Found) -> Iterator[Path]:
    for path in found.paths:
        if path.is_dir():
            yield from sorted(one for one in path.iterdir() if one.is_file())
        else:
            yield path
            beside = path.with_name(path.name + "-wal")
            if beside.is_file():
                yield beside
            metadata = path.parent / METADATA
            if metadata.is_file():
                yield metadata


def head_size(start: bytes) -> int:
    """Return the size of the header of a cache file in bytes, from the first bytes of the file.

    Raises:
        ValueError: If the bytes are not the beginning of a cache file.
    """
    length = int.from_bytes(start[len(MAGIC) : len(MAGIC) + 8], "little")
    if not start.startswith(MAGIC) or not 0 < length <= _MOST_HEAD:
        raise ValueError("no columns")
    return len(MAGIC) + 12 + length


def parsed_head(data: bytes, key: str) -> dict[str, Any]:
    """Parse the JSON header of a cache file; the header contains the names of the frames.

    Args:
        data: Bytes of the file before the columns.
        key: Key of the recording.

    Raises:
        ValueError: If the header is damaged, or belongs to another recording.
    """
    start = len(MAGIC) + 12
    if head_size(data[:start]) != len(data):
        raise ValueError("cut")
    raw = data[start:]
    if zlib.crc32(raw) != int.from_bytes(data[start - 4 : start], "little"):
        raise ValueError("the head is damaged")
    head: dict[str, Any] = json.loads(raw)
    if head["key"] != key:
        raise ValueError("of another recording")
    return head


def frames_kept(found: Found) -> list[str] | None:
    """Return the sorted frame names of a recording from the cache; None if they are not cached."""
    folder = default_folder()
    if folder is None:
        return None
    try:
        key = key_of(found, any_size=True)
        with open_regular(folder / f"{key}{SUFFIX}") as file:
            first = file.read(len(MAGIC) + 12)
            head = parsed_head(first + file.read(head_size(first) - len(first)), key)
        links = [(str(edge[0]), str(edge[1])) for edge in head["edges"]]
    except (OSError, ValueError, KeyError, TypeError, IndexError):
        return None
    return sorted({name for link in links for name in link})
