"""Frames over their whole time span as one block of bytes, for a page without a server.

Before compression with deflate, a block is: `MAGIC`; the length of the header in 32 bits; the
header as JSON, padded to a multiple of eight bytes; and the sections, to which the header refers as
[offset, length], counted from the end of the header. Numbers are little-endian. `page/packed.js`
reads the block.

Each column of numbers has the encoding that is smallest after deflate. In the header, a column is:

  {"value": x}            every number is x
  {"bits": section}       doubles, each XORed with the previous double; the section has the first
                          bytes of all numbers, then the second bytes, up to the eighth
  {"whole": section,      whole numbers times `step`: their differences, taken `order` times, in
   "order": 1 or 2,       zigzag coding (0, -1, 1, -2 …), with bytes in the order of `bits`
   "step": s}
"""

import hashlib
import json
import struct
import zlib
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Final

import numpy as np
import numpy.typing as npt

MAGIC: Final = b"TFS1"

METRES: Final = 1e-6
"""Step in metres to which translations are rounded if the file would be too large."""

QUATERNION: Final = 1e-7
"""Step of a quaternion's numbers in a rounded file: an angle of a fifth of a microradian."""

_WHOLE_BELOW: Final = 2.0**52
_PIECE: Final = 1 << 20

Progress = Callable[[int, int], object]
"""Function called with the progress: bytes done, and bytes in all."""


class TooLarge(Exception):
    """Error that packed data is larger than the permitted size."""


class PackedBlock:
    """Block of packed data under construction.

    Sections are appended one by one; equal columns of numbers are stored once.
    """

    def __init__(self, *, is_rounded: bool = False) -> None:
        """Create an empty block.

        Args:
            is_rounded: Whether numbers may be rounded to `METRES` and `QUATERNION`.
        """
        self.is_rounded = is_rounded
        self._sections: list[bytes] = []
        self._length = 0
        self._known: dict[bytes, dict[str, Any]] = {}

    def section(self, content: bytes) -> list[int]:
        """Append `content` to the block; return the offset and the length."""
        where = [self._length, len(content)]
        padded = content + bytes(-len(content) % 8)
        self._sections.append(padded)
        self._length += len(padded)
        return where

    def wholes(self, numbers: npt.NDArray[np.int64], step: float = 1.0) -> dict[str, Any]:
        """Append integers as a column, and return the header entry that describes the column.

        First or second differences are stored, whichever are smaller.

        Args:
            numbers: Integers, shape (n,).
            step: Factor from integers to values, for example 0.001 from millimetres to metres.
        """
        if len(numbers) and (numbers == numbers[0]).all():
            return {"value": float(numbers[0]) * step}
        return self._once(numbers, lambda: self._differences(numbers, step))

    def doubles(self, numbers: npt.NDArray[np.float64], step: float) -> dict[str, Any]:
        """Append doubles as a column, and return the header entry that describes the column.

        Args:
            numbers: Doubles, shape (n,).
            step: Rounding step, used only if the block is rounded.
        """
        numbers = np.ascontiguousarray(numbers, dtype=np.float64)
        bits = numbers.view(np.uint64)
        if len(bits) and (bits == bits[0]).all():
            return {"value": float(numbers[0])}
        if self.is_rounded and float(np.abs(numbers).max()) / step < _WHOLE_BELOW:
            return self.wholes(np.rint(numbers / step).astype(np.int64), step)

        def stored() -> dict[str, Any]:
            changed = bits.copy()
            changed[1:] ^= bits[:-1]
            return {"bits": self.section(_planes(changed))}

        return self._once(bits, stored)

    def _differences(self, numbers: npt.NDArray[np.int64], step: float) -> dict[str, Any]:
        first = np.diff(numbers, prepend=np.int64(0))
        second = np.diff(first, prepend=np.int64(0))
        order, chosen = min(
            ((1, first), (2, second)), key=lambda one: float(np.abs(one[1][2:]).astype(float).sum())
        )
        zigzag = (chosen << 1) ^ (chosen >> 63)
        return {"whole": self.section(_planes(zigzag)), "order": order, "step": step}

    def _once(
        self, numbers: npt.NDArray[Any], store: Callable[[], dict[str, Any]]
    ) -> dict[str, Any]:
        # Edges that are sent together have the same stamps.
        key = numbers.dtype.char.encode() + hashlib.blake2b(numbers.tobytes()).digest()
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = store()
        return known

    def plain(self, header: object) -> bytes:
        """Return the whole block without compression, with `header` at the beginning."""
        return b"".join([_head(header), *self._sections])

    def deflated(
        self,
        header: object,
        *,
        most: int | None = None,
        progress: Progress | None = None,
        level: int = 9,
    ) -> bytes:
        """Return the whole block, compressed with zlib.

        Args:
            header: Value to write as JSON at the beginning.
            most: Largest number of bytes; None for no limit.
            progress: Function called with the progress.
            level: Level of compression, 1 to 9.

        Raises:
            TooLarge: If the result is larger than `most`.
        """
        head = _head(header)
        squeeze = zlib.compressobj(level)
        packed = []
        done = taken = 0
        for piece in _pieces([head, *self._sections]):
            packed.append(squeeze.compress(piece))
            taken += len(packed[-1])
            done += len(piece)
            if most is not None and taken > most:
                raise TooLarge
            if progress is not None:
                progress(done, len(head) + self._length)
        packed.append(squeeze.flush())
        if most is not None and taken + len(packed[-1]) > most:
            raise TooLarge
        return b"".join(packed)


def _head(header: object) -> bytes:
    text = json.dumps(header, separators=(",", ":"), allow_nan=False).encode("ascii")
    text += b" " * (-(len(MAGIC) + 4 + len(text)) % 8)
    return MAGIC + struct.pack("<I", len(text)) + text


def _planes(words: npt.NDArray[Any]) -> bytes:
    """Reorder the bytes of 8-byte words: all first bytes, then all second bytes, and so on."""
    little = np.ascontiguousarray(words).astype("<u8", copy=False)
    return np.ascontiguousarray(little.view(np.uint8).reshape(-1, 8).T).tobytes()


def _pieces(parts: Sequence[bytes]) -> Iterator[memoryview]:
    for part in parts:
        view = memoryview(part)
        for start in range(0, len(view), _PIECE):
            yield view[start : start + _PIECE]
