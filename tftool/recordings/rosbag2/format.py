"""Bulk reader of rosbag2's messages, directly from the pages of the sqlite file.

Only plain pages are read in this way. At the first unexpected page or row the reader stops, and
sqlite itself continues after the last row read.

Source: the SQLite database file format, sections 1.3 to 1.6 and 2.1.
"""

import itertools
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError
from tftool.messages.native_scan import SCAN
from tftool.messages.transform_rows import Bytes
from tftool.recordings.columns import Batch, words_at
from tftool.recordings.container import File
from tftool.recordings.contract import Stamps

Pages: TypeAlias = npt.NDArray[np.int64]
"""Numbers of pages, from 1, shape (n,)."""

_HEAD: Final = 100
_INTERIOR: Final = 0x05
_LEAF: Final = 0x0D
_DEEPEST: Final = 20
_AT_ONCE: Final = 256  # pages read in one step
_MOST_APART: Final = 2  # maximum ratio of pages read to pages needed, to read them with one call
_LEAST_ROW: Final = 8  # minimum size of a row, bytes
_MOST_BYTES: Final = 64 << 20  # bytes in one batch of messages that continue on other pages


class _Odd(Exception):
    """Signal of unusual contents, which sqlite must read."""


def read_pages(path: Path, root: int, streams: dict[int, int]) -> Iterator[tuple[Batch, int]]:
    """Yield the messages of some topics in batches, in the order of rows.

    Args:
        path: Path of the file.
        root: Root page of the table; 0 reads nothing.
        streams: Stream number of each topic number of the file.

    Returns:
        Batches, each with the id of its last row; rows after the last batch must be read by sqlite.
    """
    if root < 2:
        return
    try:
        file = File(path)
    except OSError:
        return
    try:
        yield from _Table(file).batches(root, streams)
    except (_Odd, InputError, struct.error, OSError):
        return
    finally:
        file.close()


class _Table:
    """Reader of the pages of one table in a file."""

    def __init__(self, file: File) -> None:
        head = file.at(0, _HEAD)
        (size,) = struct.unpack_from(">H", head, 16)
        self._file = file
        self._size = 65_536 if size == 1 else size
        self._usable = self._size - head[20]
        self._last = -(2**63)
        if self._size < 512 or self._size & (self._size - 1) or self._usable < 480:
            raise _Odd
        room = _AT_ONCE * (self._size // _LEAST_ROW)
        # Reused for every batch, because new memory is slower.
        self._pages = np.empty(_MOST_APART * _AT_ONCE * self._size, dtype=np.uint8)
        self._senders = np.empty(room, dtype=np.int32)
        self._columns = [np.empty(room, dtype=np.int64) for _ in range(3)]

    def _page(self, number: int) -> bytes:
        if number < 2:
            raise _Odd
        return self._file.at((number - 1) * self._size, self._size)

    def batches(self, root: int, streams: dict[int, int]) -> Iterator[tuple[Batch, int]]:
        """Yield batches of messages with the id of the last row; see `read_pages`."""
        numbered = sorted(one for one in streams.items() if -(2**63) <= one[0] < 2**63)
        wanted = np.array(numbered, dtype=np.int64)
        for pages in self._leaves(root):
            for begin in range(0, len(pages), _AT_ONCE):
                yield self._batch(*self._read(pages[begin : begin + _AT_ONCE]), wanted)

    def _read(self, pages: Pages) -> tuple[Bytes, Pages]:
        """Read pages; return the bytes, and the offset of each page in the bytes."""
        first, apart = int(pages.min()), pages - pages.min()
        span = int(apart.max()) + 1
        if span <= _MOST_APART * len(pages):
            # Reading the pages between them (usually an index) costs less than another call.
            found = self._pages[: span * self._size]
            self._file.into((first - 1) * self._size, found.data)
            return found, apart * self._size
        found = self._pages[: len(pages) * self._size]
        # Begin and end of each run of consecutive pages.
        runs = np.flatnonzero(np.diff(pages, prepend=-1) != 1).tolist()
        for run, end in itertools.pairwise([*runs, len(pages)]):
            room = found.data[run * self._size : end * self._size]
            self._file.into((int(pages[run]) - 1) * self._size, room)
        return found, np.arange(0, len(found), self._size, dtype=np.int64)

    def _leaves(self, root: int) -> Iterator[Pages]:
        """Yield the numbers of the table's leaf pages in order of rows, in groups."""
        page = self._page(root)
        if page[0] == _LEAF:
            yield np.array([root])
            return
        # Pages to visit with their depth; the next page is last.
        waiting, seen = [(root, 0)], 0
        while waiting:
            number, depth = waiting.pop()
            page = self._page(number)
            seen += 1
            if page[0] != _INTERIOR or depth > _DEEPEST or seen > self._file.size // self._size:
                raise _Odd
            children = self._children(page)
            if self._page(int(children[0]))[0] == _LEAF:
                yield children
            else:
                waiting += [(one, depth + 1) for one in reversed(children.tolist())]

    def _children(self, page: bytes) -> Pages:
        (count,) = struct.unpack_from(">H", page, 3)
        if 12 + 2 * count > self._usable:
            raise _Odd
        cells = np.frombuffer(page, dtype=">u2", count=count, offset=12).astype(np.int64)
        if count and int(cells.max()) > self._usable - 4:
            raise _Odd
        found = np.empty(count + 1, dtype=np.int64)
        found[:count] = words_at(np.frombuffer(page, dtype=np.uint8), cells, ">u4")
        (found[count],) = struct.unpack_from(">I", page, 8)
        if int(found.min()) < 2:
            raise _Odd
        return found

    def _batch(self, pages: Bytes, places: Pages, wanted: Stamps) -> tuple[Batch, int]:
        """Return the messages of some leaf pages, and the id of their last row."""
        columns = self._senders, *self._columns
        found = SCAN.rows(pages, places, wanted, *columns, self._size, self._usable, self._last)
        if found is None:
            raise _Odd
        rows, self._last = found
        senders = self._senders[:rows].copy()
        times, starts, lengths = (one[:rows].copy() for one in self._columns)
        apart = np.flatnonzero(starts < 0)
        if len(apart):
            if int(lengths[apart].sum()) > _MOST_BYTES:
                raise _Odd
            raw = pages.tobytes()
            pieces, end = [raw], len(raw)
            for row in apart.tolist():
                pieces.append(self._joined(raw, -1 - int(starts[row]), int(lengths[row])))
                starts[row] = end
                end += len(pieces[-1])
            pages = np.frombuffer(b"".join(pieces), dtype=np.uint8)
        return Batch(pages, starts, lengths, times, senders), self._last

    def _joined(self, raw: bytes, cell: int, length: int) -> bytes:
        """Return the message of a row that continues on other pages."""
        size, place = _varint(raw, cell)
        _, place = _varint(raw, place)
        usable = self._usable
        least = (usable - 12) * 32 // 255 - 23
        here = least + (size - least) % (usable - 4)
        if here > usable - 35:
            here = least
        end = cell // self._size * self._size + usable
        if place + here + 4 > end or size > self._file.size:
            raise _Odd
        parts = [raw[place : place + here]]
        (number,) = struct.unpack_from(">I", raw, place + here)
        left = size - here
        while left > 0:
            page = self._page(number)
            parts.append(page[4 : 4 + min(left, usable - 4)])
            left -= len(parts[-1])
            (number,) = struct.unpack_from(">I", page)
        if number:
            raise _Odd
        # The data is the last column.
        return b"".join(parts)[-length:] if length else b""


def _varint(data: bytes, place: int) -> tuple[int, int]:
    """Parse a variable-length integer of sqlite (up to nine bytes); return it and its end."""
    found = 0
    for end in range(place, place + 8):
        found = found << 7 | data[end] & 0x7F
        if data[end] < 0x80:
            return found, end + 1
    return found << 8 | data[place + 8], place + 9
