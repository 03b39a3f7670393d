"""Pieces of files copied and compared without bringing them into Python piece by piece."""

import errno
import os
from dataclasses import dataclass
from typing import Final

from tftool.errors import InputError

_STEP: Final = 1 << 17
_FULL: Final = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


@dataclass(frozen=True, slots=True)
class Piece:
    """Some bytes of an open file.

    Attributes:
        file: The file's number.
        place: Where they begin.
        length: How many they are.
    """

    file: int
    place: int
    length: int

    def read(self) -> bytes:
        """The bytes.

        Raises:
            InputError: If the file has become shorter.
        """
        found = os.pread(self.file, self.length, self.place)
        while len(found) < self.length:
            more = os.pread(self.file, self.length - len(found), self.place + len(found))
            if not more:
                raise InputError(f"a file ends at byte {self.place + len(found)}: it was shortened")
            found += more
        return found

    def copy_to(self, file: int, place: int) -> None:
        """Copy them to a place in another file, by the kernel where it can.

        Raises:
            InputError: If the file has become shorter.
            OSError: If they cannot be written.
        """
        done = 0
        while done < self.length and hasattr(os, "copy_file_range"):
            try:
                count = os.copy_file_range(
                    self.file, file, self.length - done, self.place + done, place + done
                )
            except OSError as error:
                if error.errno in _FULL:
                    raise
                break  # across file systems, or not known to this one
            if not count:
                raise InputError(f"a file ends at byte {self.place + done}: it was shortened")
            done += count
        if done < self.length:
            rest = memoryview(Piece(self.file, self.place + done, self.length - done).read())
            while rest:
                count = os.pwrite(file, rest, place + done)
                done, rest = done + count, rest[count:]


_one, _other = bytearray(_STEP), bytearray(_STEP)


def are_equal(one: Piece, other: Piece) -> bool:
    """Whether two pieces hold the same bytes."""
    if one.length != other.length:
        return False
    done = 0
    while one.length - done >= _STEP:
        # Into memory that is there: fresh memory takes longer than the reading.
        counts = (
            os.preadv(one.file, [_one], one.place + done),
            os.preadv(other.file, [_other], other.place + done),
        )
        if counts != (_STEP, _STEP) or _one != _other:
            break
        done += _STEP
    rest = one.length - done
    return (
        Piece(one.file, one.place + done, rest).read()
        == Piece(other.file, other.place + done, rest).read()
    )
