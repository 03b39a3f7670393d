"""ROS 2's bytes and back: CDR, little endian, behind its header of four bytes.

Bytes come from strangers: a length is compared with what has arrived before
anything is made from it, and whatever does not fit is refused with a sentence.
Alignment counts from behind the header, as the standard has it; with a header
of four bytes that is the same as counting from the start for anything but
eight-byte numbers.
"""

import struct
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Final

from tftool.errors import MalformedMessage
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.stamps import NANOSECONDS, Stamp

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

HEADER: Final = b"\x00\x01\x00\x00"
"""Plain CDR, little endian, no options."""

LARGEST: Final = 64 * 1024 * 1024
"""Bytes of the largest message we look at."""

_SMALLEST_TRANSFORM: Final = 72  # stamp 8, two empty strings 8, seven doubles 56
_STAMP_AND_LENGTH: Final = struct.Struct("<iII")
_LENGTH: Final = struct.Struct("<I")
_SEVEN: Final = struct.Struct("<7d")
_STAMP: Final = struct.Struct("<iI")
_LONGEST_NAME_KEPT: Final = 256
_NAMES_KEPT: Final = 4096

# Names repeat in every message: their bytes are turned into text once. Emptied when
# full, so that a stranger with ever new names cannot make it grow.
_names: dict[bytes, str] = {}
_heads: dict[tuple[str, str, int], bytes] = {}


# Transforms


def encode_transforms(transforms: Sequence[TransformStamped]) -> bytes:
    """The bytes of a tf2_msgs/TFMessage.

    Raises:
        MalformedMessage: If a stamp does not fit into ROS's 32-bit seconds, or a name
            holds a zero character.
    """
    parts = [HEADER, _LENGTH.pack(len(transforms))]
    # Behind the count the first transform starts 4 bytes off the grid of 8, and every
    # other one, behind doubles, on it.
    phase = 4
    for sample in transforms:
        sec, nanosec = divmod(sample.stamp, NANOSECONDS)
        try:
            parts.append(_STAMP.pack(sec, nanosec))
        except struct.error as error:
            raise MalformedMessage(
                "tf2_msgs/TFMessage",
                f"the stamp {sample.stamp} ns does not fit into 32-bit seconds",
            ) from error
        key = (sample.frame_id, sample.child_frame_id, phase)
        parts.append(_heads.get(key) or _head(key))
        transform = sample.transform
        parts.append(_SEVEN.pack(*transform.translation, *transform.rotation))
        phase = 0
    return b"".join(parts)


def decode_transforms(payload: bytes) -> tuple[TransformStamped, ...]:
    """The transforms of a tf2_msgs/TFMessage.

    Raises:
        MalformedMessage: If the bytes are not one.
    """
    count = _count_of_transforms(payload)
    size = len(payload)
    position = 8
    found = []
    new = tuple.__new__
    try:
        for _ in range(count):
            sec, nanosec, length = _STAMP_AND_LENGTH.unpack_from(payload, position)
            position += 12
            end = position + length
            if end > size:
                raise _cut_off(length, size - position)
            raw = payload[position:end]
            parent = _names.get(raw)
            if parent is None:
                parent = _name(raw)
            position = (end + 3) & ~3

            (length,) = _LENGTH.unpack_from(payload, position)
            position += 4
            end = position + length
            if end > size:
                raise _cut_off(length, size - position)
            raw = payload[position:end]
            child = _names.get(raw)
            if child is None:
                child = _name(raw)
            # To the grid of 8 that starts behind the header.
            position = ((end + 3) & ~7) + 4

            seven = _SEVEN.unpack_from(payload, position)
            position += 56
            # Made as plain tuples are, past the constructors: seven doubles need no
            # conversion, and the buffer judges them.
            pose = new(Transform, (new(Vector3, seven[:3]), new(Quaternion, seven[3:])))
            stamp = sec * NANOSECONDS + nanosec
            found.append(new(TransformStamped, (stamp, parent, child, pose)))
    except struct.error as error:
        raise MalformedMessage(
            "tf2_msgs/TFMessage", f"it ends within transform {len(found) + 1} of {count}"
        ) from error
    _check_rest("tf2_msgs/TFMessage", size - position)
    return tuple(found)


class TransformColumns:
    """Many transforms as columns, one row a transform, in the order they came.

    Attributes:
        stamps: Nanoseconds, int64, shape (n,).
        parents: Names of the parents, length n.
        children: Names of the children, length n.
        translations: Metres, shape (n, 3).
        rotations: Quaternions x y z w, shape (n, 4).
    """

    __slots__ = ("children", "parents", "rotations", "stamps", "translations")

    def __init__(
        self,
        stamps: "npt.NDArray[np.int64]",
        parents: Sequence[str],
        children: Sequence[str],
        translations: "npt.NDArray[np.float64]",
        rotations: "npt.NDArray[np.float64]",
    ) -> None:
        self.stamps = stamps
        self.parents = parents
        self.children = children
        self.translations = translations
        self.rotations = rotations

    def __len__(self) -> int:
        return len(self.parents)


def decode_columns(payload: bytes) -> TransformColumns:
    """The transforms of a large tf2_msgs/TFMessage as arrays, without an object for each.

    Raises:
        MalformedMessage: If the bytes are not one.
    """
    import numpy as np

    count = _count_of_transforms(payload)
    size = len(payload)
    words = memoryview(payload)[: size & ~3].cast("I")
    last = len(words)
    starts = np.empty(count, dtype=np.int64)
    numbers = np.empty(count, dtype=np.int64)
    parents: list[str] = []
    children: list[str] = []
    word = 2
    for row in range(count):
        starts[row] = word
        try:
            word = _skim_name(payload, words, word + 2, parents)
            word = _skim_name(payload, words, word, children)
        except IndexError:
            raise _ends_within(row, count) from None
        # Odd words lie on the grid of 8 that starts behind the header.
        word |= 1
        numbers[row] = word
        word += 14
        if word > last:
            raise _ends_within(row, count)
    _check_rest("tf2_msgs/TFMessage", size - word * 4)

    table = np.frombuffer(payload, dtype="<u4", count=last)
    sec = table[starts].astype(np.uint32).view(np.int32).astype(np.int64)
    stamps = sec * NANOSECONDS + table[starts + 1].astype(np.int64)
    seven = np.ascontiguousarray(table[numbers[:, None] + np.arange(14)]).view("<f8")
    return TransformColumns(stamps, parents, children, seven[:, :3], seven[:, 3:])


def _skim_name(payload: bytes, words: "memoryview[int]", word: int, names: list[str]) -> int:
    """Append the text that starts at a word, and return the word behind it."""
    length = words[word]
    begin = word * 4 + 4
    if length > len(payload) - begin:
        raise _cut_off(length, len(payload) - begin)
    raw = payload[begin : begin + length]
    name = _names.get(raw)
    names.append(_name(raw) if name is None else name)
    return word + 1 + ((length + 3) >> 2)


def _head(key: tuple[str, str, int]) -> bytes:
    """Both names with their lengths, padded up to the first double."""
    parent, child, phase = key
    head = _text(parent)
    head += bytes(-len(head) % 4) + _text(child)
    # Eight bytes of stamp lie in front and leave the phase as it is.
    head += bytes(-(phase + len(head)) % 8)
    if len(_heads) >= _NAMES_KEPT:
        _heads.clear()
    _heads[key] = head
    return head


def _text(name: str) -> bytes:
    raw = name.encode()
    if b"\x00" in raw:
        raise MalformedMessage("string", f"{name!r} holds a zero character, which ends a text")
    return _LENGTH.pack(len(raw) + 1) + raw + b"\x00"


def _name(raw: bytes) -> str:
    """The text of a string's bytes, its closing zero included."""
    if raw and raw[-1] != 0:
        raise MalformedMessage("string", "a text does not end with its zero byte")
    try:
        name = raw[:-1].decode()
    except UnicodeDecodeError as error:
        raise MalformedMessage("string", "a text is not UTF-8") from error
    if "\x00" in name:
        raise MalformedMessage("string", "a text goes on behind its zero byte")
    if len(raw) <= _LONGEST_NAME_KEPT:
        if len(_names) >= _NAMES_KEPT:
            _names.clear()
        _names[raw] = name
    return name


def _count_of_transforms(payload: bytes) -> int:
    check_header("tf2_msgs/TFMessage", payload)
    if len(payload) < 8:
        raise MalformedMessage("tf2_msgs/TFMessage", "it ends before its number of transforms")
    (count,) = _LENGTH.unpack_from(payload, 4)
    room = (len(payload) - 8) // _SMALLEST_TRANSFORM
    if count > room:
        raise MalformedMessage(
            "tf2_msgs/TFMessage", f"it announces {count} transforms and has room for {room}"
        )
    return int(count)


def _cut_off(length: int, rest: int) -> MalformedMessage:
    return MalformedMessage(
        "string", f"a text announces {length} bytes and {max(rest, 0)} have arrived"
    )


def _ends_within(row: int, count: int) -> MalformedMessage:
    return MalformedMessage("tf2_msgs/TFMessage", f"it ends within transform {row + 1} of {count}")


def _check_rest(kind: str, rest: int) -> None:
    # Some writers round a message up to a full word.
    if rest > 7:
        raise MalformedMessage(kind, f"{rest} bytes are left over behind it")


# Everything else


def check_header(kind: str, payload: bytes) -> None:
    """Refuse what is too short, too long or written another way than ours.

    Raises:
        MalformedMessage: With the reason.
    """
    if len(payload) < 4:
        raise MalformedMessage(kind, f"{len(payload)} bytes are too few for a header")
    if len(payload) > LARGEST:
        raise MalformedMessage(kind, f"{len(payload)} bytes are more than we read ({LARGEST})")
    if payload[0] != 0 or payload[1] != 1:
        raise MalformedMessage(
            kind, f"its header {payload[:2].hex()} is not that of little-endian CDR (0001)"
        )


class Layout:
    """How the fields of one type lie in its bytes.

    Args:
        kind: The type's ROS name, for refusals.
        fields: One letter a field: `?` bool, `b` `B` `i` `I` `q` integers, `f` `d` floats, as in
            `struct`; `s` text; `u` sixteen bytes; and in brackets a list, of one of them or,
            with several, of tuples: "b[uiI]".
    """

    def __init__(self, kind: str, fields: str) -> None:
        self.kind = kind
        self._plan = _plan(iter(fields))

    def encode(self, values: Iterable[Any]) -> bytes:
        """The bytes of one message.

        Raises:
            MalformedMessage: If a value does not fit its field.
        """
        out = bytearray()
        try:
            # An empty struct is one byte: IDL knows no struct without a member.
            _write(out, self._plan, tuple(values)) if self._plan else out.append(0)
        except (struct.error, OverflowError, AttributeError) as error:
            raise MalformedMessage(self.kind, f"a value does not fit its field: {error}") from error
        return HEADER + bytes(out)

    def decode(self, payload: bytes) -> tuple[Any, ...]:
        """The fields of one message.

        Raises:
            MalformedMessage: If the bytes are not one.
        """
        check_header(self.kind, payload)
        reader = _Reader(self.kind, payload[4:])
        if self._plan:
            values = reader.struct(self._plan)
        else:
            # Some writers leave the empty struct's one byte out.
            values, reader.position = (), min(1, len(reader.body))
        _check_rest(self.kind, len(reader.body) - reader.position)
        return values


_Plan = list["tuple[str, struct.Struct | None, _Plan]"]


def _plan(letters: Any) -> Any:
    plan: list[Any] = []
    for letter in letters:
        if letter == "]":
            break
        if letter == "[":
            plan.append(("[", None, _plan(letters)))
        elif letter in "su":
            plan.append((letter, None, []))
        else:
            plan.append((letter, struct.Struct("<" + letter), []))
    return plan


def _write(out: bytearray, plan: Any, values: Sequence[Any]) -> None:
    if len(values) != len(plan):
        raise struct.error(f"{len(values)} values for {len(plan)} fields")
    for (letter, number, inner), value in zip(plan, values, strict=True):
        if number is not None:
            out += bytes(-len(out) % number.size) + number.pack(value)
        elif letter == "u":
            if len(value) != 16:
                raise struct.error(f"{len(value)} bytes are not 16")
            out += value
        elif letter == "s":
            out += bytes(-len(out) % 4) + _text(value)
        else:
            out += bytes(-len(out) % 4) + _LENGTH.pack(len(value))
            for item in value:
                _write(out, inner, (item,) if len(inner) == 1 else item)


class _Reader:
    """Walks the bytes behind a header."""

    def __init__(self, kind: str, body: bytes) -> None:
        self.kind = kind
        self.body = body
        self.position = 0

    def take(self, length: int, align: int = 1) -> int:
        start = self.position + -self.position % align
        if length > len(self.body) - start:
            raise MalformedMessage(
                self.kind,
                f"{length} bytes are announced and {max(len(self.body) - start, 0)} have arrived",
            )
        self.position = start + length
        return start

    def length(self) -> int:
        (length,) = _LENGTH.unpack_from(self.body, self.take(4, 4))
        return int(length)

    def struct(self, plan: Any) -> tuple[Any, ...]:
        values: list[Any] = []
        for letter, number, inner in plan:
            if letter == "?":
                # Read as a byte: anything but 0 is true, and nothing is refused for it.
                values.append(self.body[self.take(1)] != 0)
            elif number is not None:
                (value,) = number.unpack_from(self.body, self.take(number.size, number.size))
                values.append(value)
            elif letter == "u":
                start = self.take(16)
                values.append(self.body[start : start + 16])
            elif letter == "s":
                length = self.length()
                start = self.take(length)
                values.append(_name(self.body[start : start + length]))
            else:
                values.append(self._list(inner))
        return tuple(values)

    def _list(self, inner: Any) -> tuple[Any, ...]:
        count = self.length()
        # Every item is at least a byte long: more items than bytes is a lie.
        if count > len(self.body) - self.position:
            raise MalformedMessage(
                self.kind,
                f"a list announces {count} items and "
                f"{len(self.body) - self.position} bytes have arrived",
            )
        if len(inner) == 1:
            return tuple(self.struct(inner)[0] for _ in range(count))
        return tuple(self.struct(inner) for _ in range(count))


def stamp_fields(stamp: Stamp) -> tuple[int, int]:
    """Seconds and nanoseconds, as builtin_interfaces/Time has them."""
    return divmod(stamp, NANOSECONDS)
