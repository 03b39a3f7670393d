"""Copying and verification of byte ranges between files, without creating Python objects."""

import os
import zlib
from dataclasses import dataclass
from typing import Final

from tftool.base.errors import InputError

_STEP: Final = 1 << 19
"""Bytes at a time: they are still in the processor's cache when they are read back."""

_one, _other = bytearray(_STEP), bytearray(_STEP)


@dataclass(frozen=True, slots=True)
class Piece:
    """Byte range of an open file.

    Attributes:
        file: The file's number.
        place: Offset of the first.
        length: How many they are.
    """

    file: int
    place: int
    length: int

    def copy_to(self, file: int, place: int, crc: int | None = None) -> int:
        """Copy the bytes to another file, read them back, and compare.

        Measured on 2 GB: 1.1 times the time of `copy_file_range` alone, which is slow if the two
        places have different offsets in their pages.

        Args:
            file: The other file's number; it is open for writing and reading.
            place: Offset in it at which to write them.
            crc: The CRC of the bytes before them, if one is wanted.

        Returns:
            The CRC with theirs; 0 if none is wanted.

        Raises:
            InputError: If the file has become shorter, or other bytes are read back.
            OSError: If they cannot be written.
        """
        done = 0
        while done < self.length:
            # Up to a multiple of the step in the other file: whole pages are written faster.
            count = min(_STEP - (place + done) % _STEP, self.length - done)
            read = memoryview(_one)[:count]
            count = os.preadv(self.file, [read], self.place + done)
            if not count:
                raise self._shortened(done)
            count = os.pwrite(file, read[:count], place + done)
            again = os.preadv(file, [memoryview(_other)[:count]], place + done)
            if again != count or not _begin_alike(count):
                raise InputError(f"the bytes written at byte {place + done} differ from those read")
            if crc is not None:
                crc = zlib.crc32(read[:count], crc)
            done += count
        return crc or 0

    def crc(self) -> int:
        """Return the CRC, computed in steps.

        Raises:
            InputError: If the file has become shorter.
        """
        found, done, room = 0, 0, memoryview(bytearray(min(_STEP, self.length)))
        while done < self.length:
            count = os.preadv(self.file, [room[: self.length - done]], self.place + done)
            if not count:
                raise self._shortened(done)
            found = zlib.crc32(room[:count], found)
            done += count
        return found

    def _shortened(self, done: int) -> InputError:
        return InputError(
            f"a recording was shortened to {self.place + done} bytes while it was read: "
            "edit it when no program writes to it"
        )


def _begin_alike(count: int) -> bool:
    """Whether written bytes and those read back are equal."""
    # Compared whole where that can be, as that makes no copy.
    return _one == _other if count == _STEP else _one[:count] == _other[:count]
