"""Functions that open files named by users, without blocking on pipes or devices.

A plain `open` of a pipe waits until another process opens the pipe for writing.
"""

import errno
import io
import os
import stat
from pathlib import Path
from typing import BinaryIO, Final

LARGEST: Final = 64 << 20
"""Maximum number of bytes read from a pipe or a device, which may never end."""

_AT_ONCE: Final = getattr(os, "O_NONBLOCK", 0)
_HOW: Final = os.O_RDONLY | _AT_ONCE | getattr(os, "O_BINARY", 0)


def open_regular(path: Path) -> io.BufferedReader:
    """Open a regular file for reading.

    Raises:
        OSError: If the file cannot be opened, or is not a regular file (a pipe, for example).
    """
    file, mode = _opened(path)
    if not stat.S_ISREG(mode):
        file.close()
        raise OSError(errno.EINVAL, "a regular file is needed, not a pipe or a device", str(path))
    return io.BufferedReader(file)


def open_named(path: Path) -> BinaryIO:
    """Open a file, or read a whole pipe, such as a shell's `<(command)`, into memory.

    Raises:
        OSError: If the file cannot be opened, or the pipe has no writer or too much data.
    """
    file, mode = _opened(path)
    if stat.S_ISREG(mode):
        return io.BufferedReader(file)
    with file:
        # None means that a process has the pipe open, but has not written yet.
        first = file.read(io.DEFAULT_BUFFER_SIZE)
        if first == b"" and stat.S_ISFIFO(mode):
            raise OSError(
                errno.EINVAL,
                "no process writes into the pipe: start the writer first",
                str(path),
            )
        os.set_blocking(file.fileno(), True)
        data = bytearray(first or b"")
        while len(data) <= LARGEST and (more := file.read(io.DEFAULT_BUFFER_SIZE)):
            data += more
    if len(data) > LARGEST:
        raise OSError(
            errno.EFBIG,
            f"the pipe has more than {LARGEST >> 20} MiB: save its data to a file",
            str(path),
        )
    return io.BytesIO(data)


def read_named(path: Path) -> bytes:
    """Read a whole file, or a pipe to its end.

    Raises:
        OSError: As in `open_named`.
    """
    with open_named(path) as file:
        return file.read()


def read_named_text(path: Path) -> str:
    """Read a whole file or pipe as UTF-8 text, with universal newlines.

    Raises:
        OSError: As in `open_named`.
        UnicodeDecodeError: If the text is not UTF-8.
    """
    with io.TextIOWrapper(open_named(path), encoding="utf-8") as file:
        return file.read()


def reader_there(path: str, flags: int) -> int:
    """Open a path for writing; raise an error at once for a pipe without a reader.

    This function is used as the argument `opener` of Python's `open`.

    Raises:
        OSError: If the path cannot be opened, or no process reads from the pipe.
    """
    try:
        number = os.open(path, flags | _AT_ONCE, 0o666)
    except OSError as error:
        if error.errno != errno.ENXIO:
            raise
        raise OSError(
            errno.EINVAL, "no process reads from the pipe: start the reader first", path
        ) from None
    if _AT_ONCE:
        os.set_blocking(number, True)
    return number


def _opened(path: Path) -> tuple[io.FileIO, int]:
    """Open a file or pipe without blocking; return the open file and its `st_mode`."""
    number = os.open(path, _HOW)
    try:
        mode = os.fstat(number).st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        return io.FileIO(number), mode
    except BaseException:
        os.close(number)
        raise
