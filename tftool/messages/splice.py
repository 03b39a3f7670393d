"""Editing of single transforms in a recorded tf2_msgs/TFMessage; all other bytes are kept."""

import struct
from collections.abc import Sequence
from typing import Final, NamedTuple

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.messages.layouts import CDR, Layout
from tftool.messages.transform_rows import Place, Walked, sample, walk
from tftool.messages.transforms import KIND

_WORD: Final = struct.Struct("<I")
_SEVEN: Final = struct.Struct("<7d")


class TransformRow(NamedTuple):
    """One transform of a message.

    Attributes:
        stamp: Nanoseconds.
        parent: Name of the parent, as sent.
        child: Name of the child, as sent.
        numbers: x y z in metres, and x y z w of the quaternion.
        sequence: Sequence number of a ROS 1 header; 0 in ROS 2.
    """

    stamp: Stamp
    parent: str
    child: str
    numbers: tuple[float, ...]
    sequence: int = 0


class TransformRows:
    """A parsed TFMessage with the byte range of each transform.

    Attributes:
        payload: Bytes of the message.
        rows: Transforms of the message.
    """

    __slots__ = ("_layout", "_walked", "payload", "rows")

    def __init__(self, layout: Layout, payload: bytes) -> None:
        """Parse the message.

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
            # ROS 1's header begins with it, right before the stamp.
            (sequence,) = _WORD.unpack_from(self.payload, place.stamp - 4)
        return TransformRow(stamp, place.parent, place.child, numbers, sequence)

    def rewritten(self, rows: Sequence[TransformRow]) -> bytes:
        """Return the bytes of the message with other transforms.

        If only stamps and numbers differ, everything else is kept bit by bit.

        Raises:
            MalformedMessage: If a stamp does not fit into ROS's seconds.
        """
        # Lengths of names decide all offsets: only with the same names, in the same order, can
        # bytes be replaced in place.
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
            # By identity: NaN differs from itself, and numbers nobody touched must keep every bit.
            if row.numbers is not old.numbers:
                struct.pack_into(f"{order}7d", patched, place.numbers, *row.numbers)
        return bytes(patched)


def encode_rows(layout: Layout, rows: Sequence[TransformRow]) -> bytes:
    """Return the bytes of a TFMessage of some transforms.

    Raises:
        MalformedMessage: If a stamp does not fit into ROS's seconds.
    """
    is_cdr = layout is CDR
    found = bytearray(layout.header + _WORD.pack(len(rows)))
    for row in rows:
        if not is_cdr:
            found += _WORD.pack(row.sequence)
        found += _packed_stamp(layout, row.stamp, "<")
        for name in (row.parent, row.child):
            # A name from a command line may hold bytes that are no UTF-8.
            raw = name.encode("utf-8", "surrogateescape")
            raw = raw + b"\x00" if is_cdr else raw
            if is_cdr:
                found += bytes(-len(found) % 4)
            found += _WORD.pack(len(raw)) + raw
        if is_cdr:
            # To the grid of 8 that starts behind the header.
            found += bytes((4 - len(found)) % 8)
        found += _SEVEN.pack(*row.numbers)
    return bytes(found)


def _packed_stamp(layout: Layout, stamp: Stamp, order: str) -> bytes:
    sec, nanosec = divmod(stamp, NANOSECONDS)
    try:
        return struct.pack(f"{order}{'i' if layout is CDR else 'I'}I", sec, nanosec)
    except struct.error as error:
        raise MalformedMessage(
            KIND, f"the stamp {stamp} ns does not fit into 32-bit seconds"
        ) from error
