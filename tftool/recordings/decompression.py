"""Compression and decompression of recordings' chunks; sizes are checked before allocation."""

import bz2
import contextlib
import ctypes
import os
from collections.abc import Callable, Iterable
from functools import cache
from importlib import import_module
from queue import SimpleQueue
from threading import Lock, Thread
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from tftool.base.errors import InputError, UsageError

if TYPE_CHECKING:
    from types import ModuleType


LARGEST: Final = 3 << 27
"""Maximum number of bytes that are read or decompressed at once. lz4 needs twice this memory, and a
reader of a single message needs three times this memory, which is still below 2 GB.
"""

MOST_GAIN: Final = 1100
"""Maximum ratio of uncompressed to compressed size; known files are below it."""

_SLACK: Final = 1 << 20

LARGEST_DAMAGED: Final = 1 << 26
"""Maximum number of bytes that are decompressed from damaged bytes, which needs this memory
twice.
"""

_LARGEST_AHEAD: Final = 16 << 20
_MOST_WORKERS: Final = 4
_WAITING: Final = 3  # minimum number of chunks that wait for a thread, or for the reader
_SMALL: Final = 2 << 20  # size of a chunk up to which twice as many wait, bytes
_LARGEST_KEPT: Final = 31 << 20
_LZ4F_VERSION: Final = 100  # of the interface of lz4's C library

Packed: TypeAlias = tuple[str, Callable[[], bytes], int]
"""Compressed chunk: compression, function that reads the bytes, and stated uncompressed size."""


def unpack(method: str, packed: bytes, size: int) -> bytes:
    """Decompress bytes of a recording; the file states the uncompressed size.

    Args:
        method: "", "none", "zstd", "lz4" or "bz2", as in the container.
        packed: Compressed bytes.
        size: Stated number of uncompressed bytes.

    Raises:
        InputError: If the stated size is too large or wrong, or the bytes are damaged.
        UsageError: If the package for decompression is not installed.
    """
    if method in ("", "none"):
        if len(packed) != size:
            raise InputError(f"the data has {len(packed)} bytes instead of {size}")
        return packed
    check_size(len(packed), size)
    try:
        found = _whole(method, packed, size)
    except (InputError, UsageError, MemoryError):
        raise
    except Exception as error:
        raise InputError(f"the {method} data is damaged ({error})") from error
    if len(found) != size:
        raise InputError(f"the {method} data expands to {len(found)} bytes instead of {size}")
    return found


class _Room:
    """Reusable memory for decompressed bytes, because allocation of new memory is slow."""

    def __init__(self) -> None:
        self._bytes = bytearray()
        self._zstd: Any = None

    def unpack(self, method: str, read: Callable[[], bytes], size: int) -> "bytes | memoryview":
        """Read and decompress bytes into the memory, which the next call overwrites.

        Args:
            method: Compression, as for the function `unpack`.
            read: Function that returns the compressed bytes.
            size: Stated number of uncompressed bytes.
        """
        # The thread also reads the file: waiting for the disk does not hold the GIL.
        packed = read()
        read_frame = {"zstd": self._read_zstd, "lz4": _read_lz4}.get(method)
        if read_frame is not None:
            check_size(len(packed), size)
            if len(self._bytes) < size:
                self._bytes = bytearray(size)
            room = memoryview(self._bytes)[:size]
            try:
                if read_frame(packed, room):
                    return room
            except Exception:
                # `unpack` below raises an error that names the damage.
                pass
        return unpack(method, packed, size)

    def _read_zstd(self, packed: bytes, room: memoryview) -> bool:
        """Decompress a zstd frame, and return whether the frame fills the memory exactly."""
        module, size = zstandard(), len(room)
        if module.frame_content_size(packed) != size:
            return False
        self._zstd = self._zstd or module.ZstdDecompressor()
        with self._zstd.stream_reader(packed) as reader:
            found: int = reader.readinto(room)
            return found == size and not reader.read(1)


def _read_lz4(packed: bytes, room: memoryview) -> bool:
    """Decompress an lz4 frame, and return whether the frame fills the memory exactly.

    The package `lz4` decompresses into new memory and copies the bytes, a seventh of its time. This
    function calls the package's C library instead, and passes the given memory to it.
    """
    functions = _lz4_functions()
    if functions is None:
        return False
    create, decompress, free = functions
    first, context = ctypes.c_char.from_buffer(room), ctypes.c_void_p()
    found, read = ctypes.c_size_t(len(room)), ctypes.c_size_t(len(packed))
    if create(context, _LZ4F_VERSION):
        return False
    # 0 means that the frame is complete; any error is a large number.
    rest = decompress(context, ctypes.byref(first), found, packed, read, None)
    free(context)
    return bool(rest == 0 and found.value == len(room))


@cache
def _lz4_functions() -> tuple[Any, Any, Any] | None:
    """Return the C functions in the package `lz4` that create a context, decompress, and free.

    Return None if the functions are not accessible: other builds of the package may hide them.
    """
    try:
        path = import_module("lz4.frame._frame").__file__
        # Only decompression releases the GIL: after a short call, getting it back takes longer.
        short, long = ctypes.PyDLL(path), ctypes.CDLL(path)
        create, free = short.LZ4F_createDecompressionContext, short.LZ4F_freeDecompressionContext
        decompress = long.LZ4F_decompress
    except (ImportError, OSError, AttributeError, TypeError):
        return None
    place, size = ctypes.c_void_p, ctypes.POINTER(ctypes.c_size_t)
    create.argtypes = [ctypes.POINTER(place), ctypes.c_uint]
    decompress.argtypes = [place, place, size, place, size, place]
    free.argtypes = [place]
    create.restype = decompress.restype = free.restype = ctypes.c_size_t
    return create, decompress, free


class Coming:
    """A chunk that is being decompressed, or waits to be decompressed.

    The first thread that calls `unpack` decompresses the chunk. The class uses two locks, because a
    future of `concurrent.futures` made reading an lz4 recording 4 % slower.

    Attributes:
        room: Memory for the result.
    """

    __slots__ = ("_begun", "_error", "_found", "_piece", "_undone", "room")

    def __init__(self, piece: Packed, room: _Room) -> None:
        self.room = room
        self._piece = piece
        self._begun, self._undone = Lock(), Lock()
        self._undone.acquire()  # released when the result is there
        self._error: Exception | None = None
        self._found: bytes | memoryview = b""

    def unpack(self) -> None:
        """Decompress the chunk in this thread, unless another thread has begun or dropped it."""
        if not self._begun.acquire(blocking=False):
            return
        try:
            self._found = self.room.unpack(*self._piece)
        except Exception as error:
            self._error = error
        self._undone.release()

    def drop(self) -> bool:
        """Cancel the decompression if it has not begun; return whether the memory is unused."""
        return self._begun.acquire(blocking=False) or self.is_done

    @property
    def is_done(self) -> bool:
        """Whether the decompressed bytes are ready."""
        return not self._undone.locked()

    def result(self) -> "bytes | memoryview":
        """Wait for the decompressed bytes, and return them.

        Raises:
            Exception: If the chunk cannot be read or decompressed; see `unpack`.
        """
        with self._undone:
            if self._error is not None:
                raise self._error
            return self._found


class Ahead:
    """Threads that read and decompress the next chunks of a file; a context manager.

    Reading and decompressing release the GIL, so that on two processors decompression ahead costs
    no time. If a chunk is not ready when the caller needs it, the caller decompresses a later chunk
    meanwhile. So every processor is busy, and no processor runs two threads.
    """

    def __init__(self, keys: Iterable[object], packed: Callable[[Any], Packed | None]) -> None:
        """Create the pool for the chunks of one file.

        Args:
            keys: Distinct keys of the chunks, in the order of reading; the reader can skip chunks.
            packed: Function that returns the compressed chunk with a key, or None for a chunk that
                must not be decompressed ahead. The function is called in the thread of the reader,
                shortly before the chunk is read.
        """
        self._keys = iter(keys)
        self._packed = packed
        # By key, in order; None for chunks that are not decompressed ahead.
        self._coming: dict[object, Coming | None] = {}
        self._spare: list[_Room] = []
        self._lent: _Room | None = None
        self._workers = min(_processors() - 1, _MOST_WORKERS)
        self._waiting = _WAITING
        self._queue: SimpleQueue[Coming | None] = SimpleQueue()
        self._threads: list[Thread] = []

    def __enter__(self) -> "Ahead":
        return self

    def __exit__(self, *error: object) -> None:
        for coming in self._coming.values():
            if coming is not None:
                coming.drop()
        for _ in self._threads:
            self._queue.put(None)
        for thread in self._threads:
            thread.join()

    def take(self, key: object) -> Coming | None:
        """Return a chunk, which may not be ready; None for a chunk not decompressed ahead.

        The bytes of the previous call must not be used any more: their memory is reused.
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
            # The wanted chunk is ready, so this thread need not help any more.
            if found.is_done:
                break
            if other is not None:
                other.unpack()
        return found

    def _come_to(self, key: object) -> Coming | None:
        """Return the queued chunk with a key; drop the chunks before it, and queue more chunks.

        Return None if the chunk is not decompressed ahead.
        """
        self._start()
        while self._coming:
            passed = next(iter(self._coming))
            found = self._coming.pop(passed)
            if passed == key:
                return found
            # The memory of a chunk that a thread is decompressing cannot be reused yet.
            if found is not None and found.drop():
                self._spare.append(found.room)
            self._start()
        return None

    def _start(self) -> None:
        """Queue the next chunks, until there are `_waiting` more queued chunks than threads."""
        while self._workers > 0 and len(self._coming) < self._workers + self._waiting:
            key = next(self._keys, None)
            if key is None:
                return
            piece = self._packed(key)
            if piece is None or piece[0] in ("", "none") or piece[2] > _LARGEST_AHEAD:
                self._coming[key] = None
                continue
            while len(self._threads) < self._workers:
                self._threads.append(Thread(target=self._run, name="tftool-unpack", daemon=True))
                self._threads[-1].start()
            # Many small chunks keep the threads busy while the reader allocates columns.
            self._waiting = _WAITING if piece[2] > _SMALL else 2 * _WAITING
            room = self._spare.pop() if self._spare else _Room()
            self._coming[key] = coming = Coming(piece, room)
            self._queue.put(coming)

    def _run(self) -> None:
        """Decompress queued chunks, until the queue ends with None."""
        while (coming := self._queue.get()) is not None:
            coming.unpack()


def _processors() -> int:
    """Return the number of processors available to this process."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def unpack_beginning(method: str, packed: bytes, size: int) -> bytes:
    """Decompress as much as possible of cut or damaged bytes; the result may be empty."""
    size = min(size, LARGEST, most_of(len(packed)))
    if method in ("", "none"):
        return packed[:size]
    size = min(size, LARGEST_DAMAGED)
    try:
        if method == "zstd":
            return _beginning_of_zstd(packed, size)
        found, broken = _in_steps(method, packed, size, len(packed))
        if broken < len(packed) and method != "bz2":
            # Repeat the failed step byte by byte; this does not help with bz2's large blocks.
            found, _ = _in_steps(method, packed, size, broken)
    except InputError:
        return b""
    return bytes(memoryview(found)[:size])


def _beginning_of_zstd(packed: bytes, size: int) -> bytes:
    found, decompressor = bytearray(), zstandard().ZstdDecompressor()
    with contextlib.suppress(Exception), decompressor.stream_reader(packed) as it:
        # The step that fails returns nothing, so steps are small.
        while len(found) < size and (more := it.read(min(4096, size - len(found)))):
            found += more
    return bytes(found)


def _in_steps(method: str, packed: bytes, size: int, coarse: int) -> tuple[bytearray, int]:
    """Decompress in steps of 4096 bytes up to the offset `coarse`, then byte by byte.

    Returns:
        The decompressed bytes, and the offset of the failed step; `len(packed)` if none failed.

    Raises:
        InputError: If the compression is unknown.
    """
    stream, found, start = _stream(method), bytearray(), 0
    while start < len(packed) and len(found) < size and not stream.eof:
        step = 4096 if start < coarse else 1
        try:
            # A few compressed bytes may expand to more than the wanted size.
            data = packed[start : start + step]
            while data or not (stream.eof or stream.needs_input or len(found) >= size):
                found += stream.decompress(data, max_length=size - len(found))
                data = b""
        except Exception:
            return found, start
        start += step
    return found, len(packed)


def most_of(packed: int) -> int:
    """Return the largest plausible uncompressed size of `packed` compressed bytes."""
    return MOST_GAIN * packed + _SLACK


def check_size(packed: int, size: int) -> None:
    """Raise an error if the stated uncompressed size is implausible (a decompression bomb).

    Raises:
        InputError: If the size is too large for `packed` bytes.
    """
    if size > LARGEST or size > most_of(packed):
        raise InputError(
            f"{packed} bytes cannot expand to {size} as stated "
            f"(limits: {LARGEST} bytes, {MOST_GAIN} times the size)"
        )


def zstandard() -> "ModuleType":
    """Return the Python package `zstandard`, imported at the first call."""
    try:
        import zstandard
    except ImportError:
        raise _missing("zstd", "zstandard") from None
    return zstandard


@cache
def lz4_frame() -> Any:
    """Return the Python module `lz4.frame`, imported at the first call."""
    try:
        import lz4.frame
    except ImportError:
        raise _missing("lz4", "lz4") from None
    # lz4 allocates memory twice for every chunk, which takes twice as long as decompression.
    keep_freed_memory()
    return lz4.frame


@cache
def keep_freed_memory() -> None:
    """Make malloc reuse freed memory of up to `_LARGEST_KEPT` bytes, instead of returning it.

    Otherwise the system clears new pages for every chunk, a tenth of the time of reading.
    """
    import numpy as np

    # Linux's malloc reuses freed memory only up to the largest size it has freed before: allocate
    # and free a large array once. Its memory is never written.
    np.empty(_LARGEST_KEPT, dtype=np.uint8)


def _missing(method: str, package: str) -> UsageError:
    # Some Python versions have no wheel of the package, so it is not always installed.
    return UsageError(
        f"Recordings compressed with {method} need a package that is missing here: "
        f"pip install {package}"
    )


def _whole(method: str, packed: bytes, size: int) -> bytes:
    if method == "zstd":
        module = zstandard()
        declared = module.frame_content_size(packed)
        if declared not in (-1, size):
            raise InputError(f"the zstd data states {declared} bytes, but the file states {size}")
        found: bytes = module.ZstdDecompressor().decompress(packed, max_output_size=size)
        return found
    if method == "lz4":
        # One byte more than stated, to detect data that is too long.
        unpacked: bytes = lz4_frame().LZ4FrameDecompressor().decompress(packed, max_length=size + 1)
        return unpacked
    if method == "bz2":
        return bz2.BZ2Decompressor().decompress(packed, max_length=size + 1)
    raise InputError(f"the compression {method!r} is unknown")


def _stream(method: str) -> Any:
    if method == "lz4":
        return lz4_frame().LZ4FrameDecompressor()
    if method == "bz2":
        return bz2.BZ2Decompressor()
    raise InputError(f"the compression {method!r} is unknown")


ZSTD_LEVEL: Final = 1
"""Compression level of zstd. Higher levels cost a recorder more time than they save on its disk."""


def compressor(method: str) -> Callable[[bytes], bytes]:
    """Return a function that compresses bytes by a method: "", "none", "zstd", "lz4" or "bz2".

    Raises:
        UsageError: If the method is unknown, or the method's package is not installed.
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
        # ROS 1 can only read frames with independent blocks and without a stored size.
        return lambda piece: bytes(
            frame.compress(piece, block_linked=False, content_checksum=True, store_size=False)
        )
    raise UsageError(f"'{method}' is not a known compression: use none, zstd, lz4 or bz2.")


def best_compression() -> str:
    """Return the compression for a new MCAP file: "zstd" if installed, else "none"."""
    try:
        zstandard()
    except UsageError:
        return "none"
    return "zstd"
