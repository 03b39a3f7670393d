"""Byte layouts of messages: ROS 2's plain CDR, and ROS 1's serialisation.

CDR has a header of four bytes with the byte order. After the header, every number is aligned to its
size. A string ends with a zero byte, and the string's length counts this byte. tftool writes little
endian and reads both byte orders. ROS 1 has no header, no alignment and no zero byte after strings.

Bytes are untrusted: a length is compared with the available bytes before memory is allocated, and
bytes that do not fit raise an error.
"""

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from tftool.base.errors import MalformedMessage

Payload = bytes | bytearray | memoryview
"""Bytes of one message, as received or as stored in a file."""

LARGEST: Final = 64 * 1024 * 1024
"""Maximum size of a message, bytes."""

MOST_ITEMS: Final = 1_000_000
"""Maximum number of strings and messages in the lists of one message. Each becomes an object much
larger than its bytes.
"""

PASSED_ON: Final = 4096
"""Size of an array, bytes, from which it is passed on as a view instead of a copy."""

LITTLE: Final = "<"
"""Code of `struct` for little endian."""

BIG: Final = ">"
"""Code of `struct` for big endian."""

_LENGTHS = {order: struct.Struct(f"{order}I") for order in (LITTLE, BIG)}
_LENGTH = _LENGTHS[LITTLE]


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """Rules of one byte layout of messages.

    Attributes:
        name: Name of the layout in error messages.
        header: Bytes that are written before the first field.
        headers: Byte order for each header that can be read; empty for a layout without header.
        alignment: Largest alignment of a number, bytes; 1 for no alignment.
        word: Alignment of a length, bytes.
        texts_end_with_zero: Whether a string ends with a zero byte, which the length counts too.
        empty_size: Number of bytes of a structure without fields.
        letters: `struct` letters of the fields whose type in this layout differs from their ROS 2
            definition, by (structure, field).
        hidden: Name and `struct` padding of a first field that only this layout has, by structure:
            `seq` of ROS 1's Header.
    """

    name: str
    header: bytes
    headers: Mapping[bytes, str]
    alignment: int
    word: int
    texts_end_with_zero: bool
    empty_size: int
    letters: Mapping[tuple[str, str], str] = field(default_factory=dict)
    hidden: Mapping[str, tuple[str, str]] = field(default_factory=dict)

    def order(self, kind: str, payload: Payload) -> str:
        """Return the byte order of a message, as a code of `struct`.

        Raises:
            MalformedMessage: If the message is too short, too long or has an unknown header.
        """
        if len(payload) < len(self.header):
            raise MalformedMessage(
                kind, f"{len(payload)} bytes are too few for a message with a header"
            )
        if len(payload) > LARGEST:
            raise MalformedMessage(
                kind, f"{len(payload)} bytes are more than the maximum of {LARGEST}"
            )
        if not self.headers:
            return LITTLE
        order = self.headers.get(bytes(payload[:2]))
        if order is None:
            raise MalformedMessage(
                kind, f"the header {bytes(payload[:2]).hex()} is not a header of plain CDR"
            )
        return order

    def padding(self, position: int, size: int) -> int:
        """Return the padding before a number of `size` bytes, `position` bytes after the header."""
        return -position % min(size, self.alignment)


CDR: Final = Layout(
    name="CDR",
    header=b"\x00\x01\x00\x00",
    headers={b"\x00\x01": LITTLE, b"\x00\x00": BIG},
    alignment=8,
    word=4,
    texts_end_with_zero=True,
    # IDL has no empty structure, so an empty message is one byte.
    empty_size=1,
)
"""Byte layout of ROS 2's messages."""

ROS1: Final = Layout(
    name="ROS 1",
    header=b"",
    headers={},
    alignment=1,
    word=1,
    texts_end_with_zero=False,
    empty_size=0,
    letters={
        ("builtin_interfaces/msg/Time", "sec"): "I",
        ("builtin_interfaces/msg/Duration", "nanosec"): "i",
    },
    # ROS 2 has no sequence number in headers.
    hidden={"std_msgs/msg/Header": ("seq", "4x")},
)
"""Byte layout of ROS 1's messages. Its `time` and `duration` are read as the messages Time and
Duration of builtin_interfaces.
"""


def check_rest(kind: str, rest: int) -> None:
    """Check that only padding follows a message of the type `kind`.

    Raises:
        MalformedMessage: If more than 7 bytes remain.
    """
    # Some writers pad a message to a multiple of 8 bytes.
    if rest > 7:
        raise MalformedMessage(kind, f"{rest} bytes follow after the message")


def text_bytes(text: str) -> bytes:
    """Return a string's bytes in CDR, without the length: UTF-8 and a final zero byte.

    Raises:
        ValueError: If the string contains a zero character, which would end the string early.
    """
    raw = text.encode()
    if b"\x00" in raw:
        raise ValueError(f"{text!r} contains a zero character, which would end the string")
    return raw + b"\x00"


def read_text(raw: bytes) -> str:
    """Return the text of a string in CDR; `raw` includes the final zero byte.

    Raises:
        MalformedMessage: If the bytes are not a CDR string.
    """
    if raw and raw[-1] != 0:
        raise MalformedMessage("string", "a string does not end with a zero byte")
    text = _decoded(raw[:-1])
    if "\x00" in text:
        raise MalformedMessage("string", "a string continues after its zero byte")
    return text


def _decoded(raw: bytes) -> str:
    try:
        return raw.decode()
    except UnicodeDecodeError as error:
        raise MalformedMessage("string", "a string is not UTF-8") from error


class Writer(bytearray):
    """Writer of one message's bytes after its header.

    The writer itself is a bytearray with the bytes since the last large array. Large arrays are
    copied only once, when all parts are joined.

    Attributes:
        before: Number of bytes in `parts`.
        parts: Parts of the message before the bytes in this bytearray.
    """

    # Class attributes instead of a constructor save time: each message creates a writer.
    before: int = 0
    parts: tuple[bytes | memoryview, ...] = ()

    def length(self, length: int, layout: Layout) -> None:
        """Append the length of a string or list, aligned."""
        self += bytes(-(self.before + len(self)) % layout.word) + _LENGTH.pack(length)

    def text(self, text: str, layout: Layout) -> None:
        """Append a string: its length and its bytes.

        Raises:
            ValueError: If the layout ends strings with zero and the text contains a zero character.
        """
        raw = text_bytes(text) if layout.texts_end_with_zero else text.encode()
        self += bytes(-(self.before + len(self)) % layout.word) + _LENGTH.pack(len(raw)) + raw

    def pass_on(self, raw: memoryview) -> None:
        """Append a large array without a copy; its bytes must not change until `finish`."""
        self.parts = (*self.parts, bytes(self), raw)
        self.before += len(self) + raw.nbytes
        self.clear()

    def finish(self, layout: Layout) -> bytes:
        """Return the bytes of the whole message, with the layout's header."""
        return b"".join((layout.header, *self.parts, self)) if self.parts else layout.header + self


class Reader:
    """Reader of one message's bytes, which checks every length before use."""

    __slots__ = ("_items", "_size", "_start", "kind", "layout", "order", "payload", "position")

    def __init__(self, kind: str, payload: Payload, layout: Layout) -> None:
        self.kind = kind
        self.layout = layout
        self.order = layout.order(kind, payload)
        self.payload = payload
        self._start = self.position = len(layout.header)
        self._size = len(payload)
        self._items = 0

    def take(self, length: int, align: int = 1) -> int:
        """Skip padding and then `length` bytes; return the offset of the first of these bytes."""
        start = self.position
        if align > 1:
            start += -(start - self._start) % align
        if length > self._size - start:
            raise self._cut_off(length, start)
        self.position = start + length
        return start

    def _cut_off(self, length: int, start: int) -> MalformedMessage:
        rest = max(self._size - start, 0)
        return MalformedMessage(
            self.kind, f"the next value needs {length} bytes, but only {rest} are left"
        )

    def length(self) -> int:
        """Read the length of a string or list."""
        start = self.position
        start += -(start - self._start) % self.layout.word
        if start + 4 > self._size:
            raise self._cut_off(4, start)
        self.position = start + 4
        length: int
        (length,) = _LENGTHS[self.order].unpack_from(self.payload, start)
        return length

    def count(self, smallest: int, bound: int | None) -> int:
        """Read the number of items of a list, and check that enough bytes remain for the items.

        Args:
            smallest: Smallest size of an item, bytes.
            bound: Maximum number of items; None without a bound.
        """
        count = self.length()
        rest = self._size - self.position
        if count * smallest > rest:
            raise MalformedMessage(
                self.kind, f"a list announces {count} items, but only {rest} bytes follow"
            )
        if bound is not None and count > bound:
            raise MalformedMessage(
                self.kind, f"a list announces {count} items, but at most {bound} are allowed"
            )
        return count

    def admit(self, items: int) -> None:
        """Count further list items of the message; raise an error above `MOST_ITEMS` items."""
        self._items += items
        if self._items > MOST_ITEMS:
            raise MalformedMessage(
                self.kind, f"the lists contain more than {MOST_ITEMS} strings and messages"
            )

    def text(self, bound: int | None) -> str:
        """Read a string of at most `bound` characters."""
        length = self.length()
        start = self.position
        if length > self._size - start:
            raise self._cut_off(length, start)
        self.position = end = start + length
        raw = bytes(self.payload[start:end])
        text = read_text(raw) if self.layout.texts_end_with_zero else _decoded(raw)
        if bound is not None and len(text) > bound:
            raise MalformedMessage(self.kind, f"a string is longer than {bound} characters")
        return text

    def numbers(self, count: int, size: int) -> Payload:
        """Return the bytes of `count` numbers of one size; large blocks are not copied."""
        length = count * size
        # An empty array has no padding.
        start = self.take(length, min(size, self.layout.alignment) if count else 1)
        raw = self.payload if length < PASSED_ON else memoryview(self.payload)
        return raw[start : self.position]
