"""Fast decoder of many recorded tf2_msgs/TFMessages into rows of a numpy array.

A publisher sends the same frames again and again: its messages have equal lengths and names, and
differ only in stamps and numbers. Python parses the first message and stores the byte offsets of
stamps and numbers. A later message of the same length is not parsed: numpy only checks that
its other bytes equal the bytes of the first message.
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import MalformedMessage
from tftool.base.native import built
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.messages.layouts import CDR, Layout
from tftool.messages.transforms import KIND

SCAN: Final[Any] = built("tftool.messages._scan", 4)
"""The native module; None if it is not used."""


Bytes: TypeAlias = npt.NDArray[np.uint8]
"""Array of bytes."""

Words: TypeAlias = npt.NDArray[np.uint64]
"""Messages as 64-bit words, one row per message, shape (n, words)."""

Records: TypeAlias = npt.NDArray[np.int64]
"""Transforms, one row each: the stamp, and the bits of seven doubles, shape (n, 8)."""

LONGEST_NAME: Final = 4096
"""Maximum length of a frame name, bytes."""

SMALLEST: Final = 72
"""Size of a transform with empty names, bytes: stamp 8, two lengths 8, seven doubles 56."""

_LITTLE: Final = b"\x00\x01"
_BIG: Final = b"\x00\x00"
_SEVEN: Final = {order: struct.Struct(f"{order}7d") for order in "<>"}
_WORD: Final = {order: struct.Struct(f"{order}I") for order in "<>"}


@dataclass(frozen=True, slots=True)
class Place:
    """Frame names of one transform in a message, and byte offsets of its stamp and numbers.

    Attributes:
        parent: Name of the parent, as sent.
        child: Name of the child, as sent.
        stamp: Offset of the stamp: seconds and nanoseconds, 4 bytes each.
        numbers: Offset of the seven doubles x y z and x y z w.
    """

    parent: str
    child: str
    stamp: int
    numbers: int


@dataclass(frozen=True, slots=True)
class Walked:
    """Byte offsets of the transforms in one message.

    Attributes:
        order: Byte order of the message, in `struct`'s notation.
        places: Frame names and byte offsets of each transform.
        fixed: Ranges (begin, end) of the bytes that are equal in all messages with the same frames.
    """

    order: str
    places: tuple[Place, ...]
    fixed: tuple[tuple[int, int], ...]


def walk(layout: Layout, payload: bytes) -> Walked:
    """Find the byte offsets of all transforms in a message.

    Raises:
        MalformedMessage: If the bytes are not a TFMessage.
    """
    is_cdr = layout is CDR
    order = _byte_order(payload) if is_cdr else "<"
    position = 4 if is_cdr else 0
    word = _WORD[order]
    size = len(payload)
    places: list[Place] = []
    fixed: list[tuple[int, int]] = []
    try:
        (count,) = word.unpack_from(payload, position)
        fixed.append((0, position + 4))
        position += 4
        # A transform has at least 72 bytes: stamp and numbers 64, two lengths 8.
        if count * SMALLEST > size - position:
            room = (size - position) // SMALLEST
            raise MalformedMessage(
                KIND, f"the message announces {count} transforms, but has bytes for only {room}"
            )
        for _ in range(count):
            stamp = position if is_cdr else position + 4  # after the sequence number
            position = stamp + 8
            names = []
            for _ in range(2):
                if is_cdr:
                    position = (position + 3) & ~3
                (length,) = word.unpack_from(payload, position)
                end = position + 4 + length
                if length > LONGEST_NAME or end > size:
                    raise MalformedMessage(KIND, f"a frame name cannot have {length} bytes")
                raw = payload[position + 4 : end]
                # In ROS 2 the length includes the final zero byte.
                raw = raw.removesuffix(b"\x00") if is_cdr else raw
                # A name that is not UTF-8 must not make the message unreadable: escape its bytes.
                names.append(raw.decode("utf-8", "backslashreplace"))
                fixed.append((position, end))
                position = end
            if is_cdr:
                # Align to 8 bytes, counted from the end of the header.
                position = ((position + 3) & ~7) + 4
            places.append(Place(names[0], names[1], stamp, position))
            position += 56
            if position > size:
                raise MalformedMessage(KIND, f"the message ends within transform {len(places)}")
    except struct.error as error:
        raise MalformedMessage(
            KIND, f"the message ends within transform {len(places) + 1}"
        ) from error
    # Some writers pad a message to a multiple of 8 bytes.
    if size - position > (7 if is_cdr else 0):
        raise MalformedMessage(KIND, f"{size - position} bytes follow after the message")
    return Walked(order, tuple(places), tuple(fixed))


def sample(payload: bytes, order: str, place: Place) -> tuple[Stamp, tuple[float, ...]]:
    """Return the stamp and the seven numbers of one transform in a message."""
    word = _WORD[order]
    (sec,) = word.unpack_from(payload, place.stamp)
    (nanosec,) = word.unpack_from(payload, place.stamp + 4)
    return _signed(sec) * NANOSECONDS + nanosec, _SEVEN[order].unpack_from(payload, place.numbers)


def _signed(sec: int) -> int:
    return sec - 2**32 if sec >= 2**31 else sec


def _byte_order(payload: bytes) -> str:
    head = payload[:2]
    if head == _LITTLE:
        return "<"
    if head == _BIG:
        return ">"
    raise MalformedMessage(KIND, f"the header {payload[:4].hex()} is not a header of plain CDR")


def row_span(layout: Layout, length: int) -> tuple[int, int]:
    """Return offset and width of the row of 64-bit words that contains a message.

    Returns:
        Offset of the row from the first byte of the message, and its width in bytes. A row begins
            before its message (4 bytes for ROS 2, up to 7 bytes for ROS 1), so that the doubles of
            the message are aligned to 8 bytes in the row.
    """
    if layout is CDR:
        return -4, (length + 4) & ~7
    before = -length % 8
    return -before, length + before


def rows_of(buffer: Bytes, starts: npt.NDArray[np.int64], width: int) -> Words:
    """Copy rows of equal width from a buffer.

    Args:
        buffer: Buffer with the rows.
        starts: Offset of each row, shape (n,); every row is within the buffer.
        width: Width of a row, bytes, a multiple of 8.

    Returns:
        The rows as 64-bit words, shape (n, width / 8).
    """
    # Treat each row as one large item, which numpy copies in one step.
    items: npt.NDArray[np.void] = np.ndarray(
        (len(buffer) - width + 1,), dtype=f"V{width}", buffer=buffer.data, strides=(1,)
    )
    return items[starts].view(np.uint64).reshape(len(starts), width // 8)


def _items(rows: npt.NDArray[Any], begin: int, size: int) -> npt.NDArray[np.void]:
    """Return a view of one byte range of every row, with one item of `size` bytes per row."""
    return np.ndarray(
        (len(rows),), f"V{size}", buffer=rows.data, offset=begin, strides=rows.strides[:1]
    )


class Template:
    """Common bytes of all messages with the same layout, length and frames.

    Attributes:
        places: Frame names and byte offsets of each transform.
    """

    __slots__ = ("_begin", "_masks", "_values", "_words", "places")

    def __init__(self, layout: Layout, payload: bytes, walked: Walked) -> None:
        """Create the template from a little-endian message and its offsets, found by `walk`."""
        self.places = walked.places
        begin, width = row_span(layout, len(payload))
        self._begin = begin
        mask = np.zeros(width, dtype=np.uint8)
        row = np.zeros(width, dtype=np.uint8)
        for first, end in walked.fixed:
            place = slice(first - begin, end - begin)
            mask[place] = 0xFF
            row[place] = np.frombuffer(payload, np.uint8)[first:end]
        masks = mask.view(np.uint64)
        self._words = np.flatnonzero(masks)
        self._masks = masks[self._words]
        self._values = row.view(np.uint64)[self._words]

    def fits(self, rows: Words) -> "npt.NDArray[np.bool_] | None":
        """Return a mask of the rows with this template's frames, shape (n,); None if all match."""
        # This copy is changed in place. Rows with bits that are set after masking do not match.
        apart = rows.take(self._words, axis=1)
        apart ^= self._values
        apart &= self._masks
        if not apart.any():
            return None
        found: npt.NDArray[np.bool_] = np.logical_not(apart.any(axis=1))
        return found

    def cut(self, rows: Words, place: Place, records: Records) -> None:
        """Copy the transform at `place` from each row into `records`, an array of shape (n, 8)."""
        if not len(rows):
            return
        _items(records, 8, 56)[:] = _items(rows, place.numbers - self._begin, 56)
        # Copy first: numpy views only contiguous items as another type.
        times = _items(rows, place.stamp - self._begin, 8).copy().view(np.int32).reshape(-1, 2)
        stamps = times[:, 0].astype(np.int64)
        stamps *= NANOSECONDS
        # Seconds are signed, nanoseconds are not.
        stamps += times[:, 1].view(np.uint32)
        records[:, 0] = stamps


class TransformRow(NamedTuple):
    """One transform of a recorded message.

    Attributes:
        stamp: Nanoseconds.
        parent: Name of the parent, as sent.
        child: Name of the child, as sent.
        numbers: x y z in metres, and x y z w of the quaternion.
        sequence: Sequence number of the ROS 1 header; 0 in ROS 2.
    """

    stamp: Stamp
    parent: str
    child: str
    numbers: tuple[float, ...]
    sequence: int = 0


class TransformRows:
    """A parsed TFMessage that can be serialised again with other transforms.

    Attributes:
        payload: Bytes of the message.
        rows: Transforms of the message.
    """

    __slots__ = ("_layout", "_walked", "payload", "rows")

    def __init__(self, layout: Layout, payload: bytes) -> None:
        """Parse the bytes of a TFMessage.

        Raises:
            MalformedMessage: If the bytes are not a TFMessage.
        """
        self._layout = layout
        self.payload = payload
        self._walked: Walked = walk(layout, payload)
        self.rows = tuple(self._row(place) for place in self._walked.places)

    def _row(self, place: Place) -> TransformRow:
        stamp, numbers = sample(self.payload, self._walked.order, place)
        sequence = 0
        if self._layout is not CDR:
            # The sequence number is right before the stamp in ROS 1's header.
            (sequence,) = _WORD["<"].unpack_from(self.payload, place.stamp - 4)
        return TransformRow(stamp, place.parent, place.child, numbers, sequence)

    def rewritten(self, rows: Sequence[TransformRow]) -> bytes:
        """Return the bytes of the message with other transforms.

        If the frame names stay the same, all bytes except stamps and numbers stay unchanged.

        Raises:
            MalformedMessage: If a stamp does not fit into ROS's seconds.
        """
        # The lengths of names determine all offsets: bytes can be replaced in place only if the
        # names and their order are the same.
        same = len(rows) == len(self.rows) and all(
            one[1:3] == other[1:3] for one, other in zip(rows, self.rows, strict=True)
        )
        if not same:
            return encode_rows(self._layout, rows)
        order = self._walked.order
        patched = bytearray(self.payload)
        for place, row, old in zip(self._walked.places, rows, self.rows, strict=True):
            if row.stamp != old.stamp:
                patched[place.stamp : place.stamp + 8] = _packed_stamp(
                    self._layout, row.stamp, order
                )
            # Compare by identity: NaN differs from itself, and unchanged numbers must stay as is.
            if row.numbers is not old.numbers:
                struct.pack_into(f"{order}7d", patched, place.numbers, *row.numbers)
        return bytes(patched)


def encode_rows(layout: Layout, rows: Sequence[TransformRow]) -> bytes:
    """Return the bytes of a TFMessage with these transforms.

    Raises:
        MalformedMessage: If a stamp does not fit into ROS's seconds.
    """
    is_cdr = layout is CDR
    found = bytearray(layout.header + _WORD["<"].pack(len(rows)))
    for row in rows:
        if not is_cdr:
            found += _WORD["<"].pack(row.sequence)
        found += _packed_stamp(layout, row.stamp, "<")
        for name in (row.parent, row.child):
            # A name from a command line may contain bytes that are not UTF-8.
            raw = name.encode("utf-8", "surrogateescape")
            raw = raw + b"\x00" if is_cdr else raw
            if is_cdr:
                found += bytes(-len(found) % 4)
            found += _WORD["<"].pack(len(raw)) + raw
        if is_cdr:
            # Align to 8 bytes, counted from the end of the header.
            found += bytes((4 - len(found)) % 8)
        found += _SEVEN["<"].pack(*row.numbers)
    return bytes(found)


def _packed_stamp(layout: Layout, stamp: Stamp, order: str) -> bytes:
    sec, nanosec = divmod(stamp, NANOSECONDS)
    try:
        return struct.pack(f"{order}{'i' if layout is CDR else 'I'}I", sec, nanosec)
    except struct.error as error:
        raise MalformedMessage(
            KIND, f"the stamp {stamp} ns does not fit into 32-bit seconds"
        ) from error
