"""Compression and decompression of a recording's pieces; sizes are checked before allocation."""

import bz2
import contextlib
import os
from collections.abc import Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cache
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from tftool.base.errors import InputError, UsageError

if TYPE_CHECKING:
    from types import ModuleType


LARGEST: Final = 3 << 27
"""Bytes of the largest piece that is read or unpacked: lz4 holds twice as many, and who looks at
its one message once more, which is below 2 GB."""

MOST_GAIN: Final = 1100
"""Largest ratio of a piece's size to its packed size; known files stay below it."""

_SLACK: Final = 1 << 20

LARGEST_DAMAGED: Final = 1 << 26
"""Bytes that are unpacked of a damaged piece, which is held twice."""

_LARGEST_AHEAD: Final = 16 << 20
_MOST_WORKERS: Final = 4
_WAITING: Final = 3  # pieces that no thread has begun with, at least
_LARGEST_KEPT: Final = 31 << 20

Packed: TypeAlias = tuple[str, Callable[[], bytes], int]
"""A piece: how it is packed, what reads its bytes, and how many it says it will be."""


def unpack(method: str, packed: bytes, size: int) -> bytes:
    """Decompress a piece of known size.

    Args:
        method: "", "none", "zstd", "lz4" or "bz2", as the container writes it.
        packed: Compressed bytes.
        size: Stated number of uncompressed bytes.

    Raises:
        InputError: If the stated size is too large or wrong, or the bytes are damaged.
        UsageError: If the package for decompression is not installed.
    """
    if method in ("", "none"):
        if len(packed) != size:
            raise InputError(f"{len(packed)} bytes instead of {size}")
        return packed
    check_size(len(packed), size)
    try:
        found = _whole(method, packed, size)
    except (InputError, UsageError, MemoryError):
        raise
    except Exception as error:
        raise InputError(f"its {method} data is damaged ({error})") from error
    if len(found) != size:
        raise InputError(f"its {method} data gives {len(found)} bytes instead of {size}")
    return found


class _Room:
    """Memory reused for decompressed pieces, as new memory is slower."""

    def __init__(self) -> None:
        self._bytes = bytearray()
        self._zstd: Any = None

    def unpack(self, method: str, read: Callable[[], bytes], size: int) -> "bytes | memoryview":
        """Decompress a piece like the function `unpack`; valid until the next call."""
        # Reading happens in the thread as well: it waits for the disk without Python's lock.
        packed = read()
        if method == "zstd":
            check_size(len(packed), size)
            try:
                if self._read(packed, size):
                    return memoryview(self._bytes)[:size]
            except Exception:
                # The other one names the damage.
                pass
        return unpack(method, packed, size)

    def _read(self, packed: bytes, size: int) -> bool:
        """Decompress a zstd frame to its end; return whether its length is as declared."""
        module = zstandard()
        if module.frame_content_size(packed) != size:
            return False
        if len(self._bytes) < size:
            self._bytes = bytearray(size)
        self._zstd = self._zstd or module.ZstdDecompressor()
        with self._zstd.stream_reader(packed) as reader:
            found: int = reader.readinto(memoryview(self._bytes)[:size])
            return found == size and not reader.read(1)


class _Coming:
    """A piece being decompressed.

    Attributes:
        room: Memory to write to.
        future: Future of the result.
    """

    def __init__(self, piece: Packed, room: _Room, pool: ThreadPoolExecutor) -> None:
        self.room = room
        self._piece = piece
        self.future: Future[bytes | memoryview] = pool.submit(room.unpack, *piece)

    def unpack_here(self) -> None:
        """Decompress the piece in this thread, if no other has started it."""
        # A future that cannot be cancelled is being unpacked by a thread.
        if not self.future.cancel():
            return
        self.future = Future()
        try:
            self.future.set_result(self.room.unpack(*self._piece))
        except Exception as error:
            self.future.set_exception(error)


class Ahead:
    """Threads that read and decompress pieces ahead of the reader; a context manager.

    Reading and unpacking release Python's lock, so that on two processors unpacking ahead costs no
    time. Nothing else runs in a thread. A caller that needs a piece before it is ready unpacks a
    later one meanwhile: so every processor is busy, and none runs two threads.
    """

    def __init__(self, keys: Iterable[object], packed: Callable[[Any], Packed | None]) -> None:
        """Take the list of pieces to decompress.

        Args:
            keys: Distinct names of the pieces, in the order in which they will be asked
                for; some may be passed over.
            packed: Tells of a piece; None where it is not to be unpacked ahead. Is called in the
                thread that asks, not long before that piece is asked for.
        """
        self._keys = iter(keys)
        self._packed = packed
        # In the order of their keys; None for pieces that are not unpacked ahead.
        self._coming: dict[object, _Coming | None] = {}
        self._spare: list[_Room] = []
        self._lent: _Room | None = None
        self._workers = min(_processors() - 1, _MOST_WORKERS)
        self._pool: ThreadPoolExecutor | None = None

    def __enter__(self) -> "Ahead":
        return self

    def __exit__(self, *_: object) -> None:
        if self._pool is not None:
            self._pool.shutdown(wait=True, cancel_futures=True)

    def take(self, key: object) -> "Future[bytes | memoryview] | None":
        """Return the future of a decompressed piece; None if it was not started.

        A piece taken before must not be looked at any more: its memory is used again.
        """
        if self._lent is not None:
            self._spare.append(self._lent)
            self._lent = None
        found = self._come_to(key)
        if found is None:
            return None
        self._lent = found.room
        self._start()
        for other in self._coming.values():
            # The piece asked for is there: nothing more to help with.
            if found.future.done():
                break
            if other is not None:
                other.unpack_here()
        return found.future

    def _come_to(self, key: object) -> _Coming | None:
        """Return the piece of a key; skip earlier ones and start others in their place."""
        self._start()
        while self._coming:
            passed = next(iter(self._coming))
            found = self._coming.pop(passed)
            if passed == key:
                return found
            # What a thread is unpacking now keeps its memory until that is done.
            if found is not None and (found.future.cancel() or found.future.done()):
                self._spare.append(found.room)
            self._start()
        return None

    def _start(self) -> None:
        """Start as many pieces as there are threads, and some more."""
        while self._workers > 0 and len(self._coming) < self._workers + _WAITING:
            key = next(self._keys, None)
            if key is None:
                return
            piece = self._packed(key)
            if piece is None or piece[0] in ("", "none") or piece[2] > _LARGEST_AHEAD:
                self._coming[key] = None
                continue
            if self._pool is None:
                self._pool = ThreadPoolExecutor(self._workers, "tftool-unpack")
            room = self._spare.pop() if self._spare else _Room()
            self._coming[key] = _Coming(piece, room, self._pool)


def _processors() -> int:
    """Return the number of processors available to this process."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def unpack_beginning(method: str, packed: bytes, size: int) -> bytes:
    """Decompress as much as possible of a cut or damaged piece; may return nothing."""
    size = min(size, LARGEST, most_of(len(packed)))
    if method in ("", "none"):
        return packed[:size]
    size = min(size, LARGEST_DAMAGED)
    try:
        if method == "zstd":
            return _beginning_of_zstd(packed, size)
        found, broken = _in_steps(method, packed, size, len(packed))
        if broken < len(packed) and method != "bz2":
            # Of the step in which it broke nothing came out. A block of bz2 is all wrong then.
            found, _ = _in_steps(method, packed, size, broken)
    except InputError:
        return b""
    return bytes(memoryview(found)[:size])


def _beginning_of_zstd(packed: bytes, size: int) -> bytes:
    found, decompressor = bytearray(), zstandard().ZstdDecompressor()
    with contextlib.suppress(Exception), decompressor.stream_reader(packed) as it:
        # Of the step in which it breaks nothing comes out.
        while len(found) < size and (more := it.read(min(4096, size - len(found)))):
            found += more
    return bytes(found)


def _in_steps(method: str, packed: bytes, size: int, coarse: int) -> tuple[bytearray, int]:
    """Decompress in large steps up to an offset, and byte by byte after it.

    Returns:
        The unpacked bytes, and the begin of the step that failed; the end if none did.

    Raises:
        InputError: If the compression is unknown.
    """
    stream, found, start = _stream(method), bytearray(), 0
    while start < len(packed) and len(found) < size and not stream.eof:
        step = 4096 if start < coarse else 1
        try:
            # In a few bytes there may be more than is wanted of all.
            data = packed[start : start + step]
            while data or not (stream.eof or stream.needs_input or len(found) >= size):
                found += stream.decompress(data, max_length=size - len(found))
                data = b""
        except Exception:
            return found, start
        start += step
    return found, len(packed)


def most_of(packed: int) -> int:
    """Return the size limit of a decompressed piece, far above real ones."""
    return MOST_GAIN * packed + _SLACK


def check_size(packed: int, size: int) -> None:
    """Refuse a declared size beyond any real one.

    Raises:
        InputError: If the size is that of a bomb.
    """
    if size > LARGEST or size > most_of(packed):
        raise InputError(
            f"{packed} bytes claim to unpack to {size}, more than is plausible "
            f"(at most {LARGEST}, and {MOST_GAIN} times)"
        )


def zstandard() -> "ModuleType":
    """Import zstd on first use."""
    try:
        import zstandard
    except ImportError:
        raise _missing("zstd", "zstandard") from None
    return zstandard


@cache
def lz4_frame() -> Any:
    """Import lz4's frames on first use."""
    try:
        import lz4.frame
    except ImportError:
        raise _missing("lz4", "lz4") from None
    import numpy as np

    # It takes new memory for every piece, twice, and to get and clear that takes twice as long as
    # to unpack. C's allocator of Linux keeps pieces that were freed, and gives them out again, up
    # to the size of the largest that it had back from the system; this one is never written.
    np.empty(_LARGEST_KEPT, dtype=np.uint8)
    return lz4.frame


def _missing(method: str, package: str) -> UsageError:
    # Some Pythons have no wheel of it, so that the plain install leaves it out.
    return UsageError(
        f"Recordings compressed with {method} need a package that is missing here: "
        f"pip install {package}"
    )


def _whole(method: str, packed: bytes, size: int) -> bytes:
    if method == "zstd":
        module = zstandard()
        declared = module.frame_content_size(packed)
        if declared not in (-1, size):
            raise InputError(f"its zstd data announces {declared} bytes, and the file {size}")
        found: bytes = module.ZstdDecompressor().decompress(packed, max_output_size=size)
        return found
    if method == "lz4":
        # One byte more than wanted shows whether there is more.
        unpacked: bytes = lz4_frame().LZ4FrameDecompressor().decompress(packed, max_length=size + 1)
        return unpacked
    if method == "bz2":
        return bz2.BZ2Decompressor().decompress(packed, max_length=size + 1)
    raise InputError(f"its compression is unknown ({method!r})")


def _stream(method: str) -> Any:
    if method == "lz4":
        return lz4_frame().LZ4FrameDecompressor()
    if method == "bz2":
        return bz2.BZ2Decompressor()
    raise InputError(f"its compression is unknown ({method!r})")


ZSTD_LEVEL: Final = 1
"""Higher levels cost a recorder more than they save on its disk."""


def compressor(method: str) -> Callable[[bytes], bytes]:
    """Return the compressor of a method: "", "none", "zstd", "lz4" or "bz2".

    Raises:
        UsageError: If there is no such method, or its package is not installed.
    """
    if method in ("", "none"):
        return bytes
    if method == "bz2":
        return bz2.compress
    if method == "zstd":
        packed: Callable[[bytes], bytes] = zstandard().ZstdCompressor(level=ZSTD_LEVEL).compress
        return packed
    if method == "lz4":
        frame = lz4_frame()
        # ROS 1 reads frames of independent blocks alone, without their size in front.
        return lambda piece: bytes(
            frame.compress(piece, block_linked=False, content_checksum=True, store_size=False)
        )
    raise UsageError(f"'{method}' is an unknown compression: none, zstd, lz4 and bz2 are known.")


def best_compression() -> str:
    """Return the compression of a new MCAP file: zstd where installed."""
    try:
        zstandard()
    except UsageError:
        return "none"
    return "zstd"
