"""ROS 2's bytes: plain CDR, behind its header of four bytes.

Bytes come from strangers: a length is compared with what has arrived before
anything is made from it, and whatever does not fit is refused with a sentence.
Alignment counts from behind the header. We write little endian and read both.
"""

import struct
from typing import Final

from tftool.errors import MalformedMessage

HEADER: Final = b"\x00\x01\x00\x00"
"""Plain CDR, little endian, no options."""

LARGEST: Final = 64 * 1024 * 1024
"""Bytes of the largest message we look at."""

MOST_ITEMS: Final = 1_000_000
"""Texts and messages in the lists of one message: each becomes an object many times its bytes."""

LITTLE: Final = "<"
"""Little endian, as `struct` writes it."""

BIG: Final = ">"
"""Big endian."""

_ORDERS = {b"\x00\x01": LITTLE, b"\x00\x00": BIG}
_LENGTHS = {order: struct.Struct(f"{order}I") for order in (LITTLE, BIG)}


def check_header(kind: str, payload: bytes) -> str:
    """The byte order of a message, as `struct` writes it; what we do not read is refused.

    Raises:
        MalformedMessage: If it is too short, too long or written another way.
    """
    if len(payload) < 4:
        raise MalformedMessage(kind, f"{len(payload)} bytes are too few for a header")
    if len(payload) > LARGEST:
        raise MalformedMessage(kind, f"{len(payload)} bytes are more than we read ({LARGEST})")
    order = _ORDERS.get(payload[:2])
    if order is None:
        raise MalformedMessage(kind, f"its header {payload[:2].hex()} is not that of plain CDR")
    return order


def check_rest(kind: str, rest: int) -> None:
    """Refuse a message that goes on behind its end.

    Raises:
        MalformedMessage: If it does.
    """
    # Some writers round a message up to a full word.
    if rest > 7:
        raise MalformedMessage(kind, f"{rest} bytes are left over behind it")


def write_length(out: bytearray, length: int) -> None:
    """Append a length where it belongs."""
    out += bytes(-len(out) % 4) + _LENGTHS[LITTLE].pack(length)


def write_text(out: bytearray, text: str) -> None:
    """Append a text.

    Raises:
        ValueError: If it holds a zero character, which would end it.
    """
    raw = text.encode()
    if b"\x00" in raw:
        raise ValueError(f"{text!r} holds a zero character, which ends a text")
    write_length(out, len(raw) + 1)
    out += raw
    out.append(0)


def read_text(raw: bytes) -> str:
    """The text of a string's bytes, its closing zero included.

    Raises:
        MalformedMessage: If it is none.
    """
    if raw and raw[-1] != 0:
        raise MalformedMessage("string", "a text does not end with its zero byte")
    try:
        text = raw[:-1].decode()
    except UnicodeDecodeError as error:
        raise MalformedMessage("string", "a text is not UTF-8") from error
    if "\x00" in text:
        raise MalformedMessage("string", "a text goes on behind its zero byte")
    return text


class Reader:
    """Walks the bytes of one message."""

    __slots__ = ("items", "kind", "order", "payload", "position")

    def __init__(self, kind: str, payload: bytes) -> None:
        self.kind = kind
        self.order = check_header(kind, payload)
        self.payload = payload
        self.position = 4
        self.items = 0

    def take(self, length: int, align: int = 1) -> int:
        """Step over some bytes; where they begin."""
        start = self.position + -(self.position - 4) % align
        rest = len(self.payload) - start
        if length > rest:
            raise MalformedMessage(
                self.kind, f"{length} bytes are announced and {max(rest, 0)} have arrived"
            )
        self.position = start + length
        return start

    def count(self, smallest: int, bound: int | None) -> int:
        """How many items follow, each of so many bytes at least."""
        (count,) = _LENGTHS[self.order].unpack_from(self.payload, self.take(4, 4))
        rest = len(self.payload) - self.position
        if count * smallest > rest:
            raise MalformedMessage(
                self.kind, f"a list announces {count} items and {rest} bytes have arrived"
            )
        if bound is not None and count > bound:
            raise MalformedMessage(
                self.kind, f"a list announces {count} items where at most {bound} are allowed"
            )
        return int(count)

    def admit(self, items: int) -> None:
        """Allow for so many texts or messages of a list, on top of those before them."""
        self.items += items
        if self.items > MOST_ITEMS:
            raise MalformedMessage(
                self.kind, f"its lists hold more than {MOST_ITEMS} texts and messages"
            )

    def text(self, bound: int | None) -> str:
        """The text that comes next."""
        (length,) = _LENGTHS[self.order].unpack_from(self.payload, self.take(4, 4))
        start = self.take(length)
        text = read_text(self.payload[start : start + length])
        if bound is not None and len(text) > bound:
            raise MalformedMessage(self.kind, f"a text is longer than {bound} characters")
        return text
