"""Base class of writers of MCAP files and ROS 1 bags, which consist of chunks."""

import io
import zlib
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Final

from tftool.recordings.channel import Channel
from tftool.recordings.container import Extras, Piece
from tftool.recordings.decompression import compressor

_LARGE_PIECE: Final = 1 << 16  # bytes; joining larger pieces takes longer than writing them apart

NOTHING_YET: Final = 2**64 - 1
"""First log time while there are no messages."""


class ChunkedWriter:
    """Base class of writers of files with chunks; see `ContainerWriter`.

    A chunk is written when the chunk is full, and by `flush`. If the program crashes, the
    file can be read up to the last written chunk.

    Attributes:
        method: Compression of the chunks.
        position: Number of bytes in the file so far.
        counts: Number of messages of each channel.
        first_free: Smallest number for a channel that is registered without a number.
    """

    first_free = 0

    def __init__(self, path: Path, method: str, *, with_crc: bool = False) -> None:
        """Create the file; replace an existing file.

        Args:
            path: Path of the file.
            method: Compression of the chunks.
            with_crc: Whether to compute the CRC of all written bytes.

        Raises:
            UsageError: If the compression is not installed.
            OSError: If the file cannot be written.
        """
        self.method = method
        self._pack: Callable[[bytes], bytes] = compressor(method)
        self._known: dict[Channel, int] = {}
        self._channel_records: dict[int, bytes] = {}
        self._defined: set[int] = (
            set()
        )  # channels whose records are in the file or the current chunk
        self.counts: dict[int, int] = {}
        self.position = 0
        self._with_crc = with_crc
        self._crc = 0
        self._path = path
        self._new_chunk()
        self._file = io.FileIO(path, "wb+")

    def _new_chunk(self) -> None:
        self._pieces: list[bytes] = []
        self._length = 0
        self._indexes: dict[int, array[int]] = {}
        self._chunk_low, self._chunk_high = NOTHING_YET, 0

    @property
    def size(self) -> int:
        """Bytes written so far, including the bytes buffered for the current chunk."""
        return self.position + self._length

    def copy_extras(self, extras: Extras, schemas: Mapping[int, tuple[str, str, bytes]]) -> None:
        """Do nothing; only the writer of MCAP files copies attachments, metadata and schemas.

        Args:
            extras: Attachments and metadata of another file.
            schemas: Name, encoding and definition of message types, by number in the other file.
        """

    def abandon(self) -> None:
        """Close the file without an index; readers must then read the file sequentially."""
        self._file.close()

    def _keep(self, piece: bytes) -> None:
        self._pieces.append(piece)
        self._length += len(piece)

    def _copy(self, piece: Piece) -> None:
        before = self._crc if self._with_crc else None
        self._crc = piece.copy_to(self._file.fileno(), self.position, before)
        self.position = self._file.seek(self.position + piece.length)

    def _put(self, *pieces: bytes) -> None:
        """Append bytes to the file; `position` moves only after all bytes were written."""
        for run in _runs(pieces):
            view = memoryview(run)
            # An unbuffered file may write fewer bytes than given.
            while view:
                view = view[self._file.write(view) or 0 :]
        if self._with_crc:
            for piece in pieces:
                self._crc = zlib.crc32(piece, self._crc)
        self.position += sum(map(len, pieces))


def _runs(pieces: Sequence[bytes]) -> Iterator[bytes]:
    """Yield the bytes to write: neighbouring small pieces joined, large pieces unchanged."""
    small: list[bytes] = []
    for piece in pieces:
        if len(piece) < _LARGE_PIECE:
            small.append(piece)
            continue
        yield b"".join(small)
        small.clear()
        yield piece
    yield b"".join(small)
