"""Fast serialiser of tf2_msgs/TFMessage, the most frequent message between processes.

The bytes equal those of the general codec, at a fraction of the cost. Large messages can be read as
arrays, without an object for each transform.
"""

import struct
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import NANOSECONDS
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.messages.layouts import CDR, LITTLE, check_rest, read_text, text_bytes

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

KIND: Final = "tf2_msgs/TFMessage"
"""The type of the messages on tf and tf_static."""

_SMALLEST_TRANSFORM: Final = 72  # stamp 8, two empty strings 8, seven doubles 56
_STAMP_AND_LENGTH: Final = struct.Struct("<iII")
_LENGTH: Final = struct.Struct("<I")
_SEVEN: Final = struct.Struct("<7d")
_STAMP: Final = struct.Struct("<iI")
_LONGEST_NAME_KEPT: Final = 256
_NAMES_KEPT: Final = 4096

# Names repeat in every message, so each is decoded once. The cache is emptied when full, so that a
# sender of ever new names cannot make it grow.
_names: dict[bytes, str] = {}
_heads: dict[tuple[str, str, int], bytes] = {}


def encode_transforms(transforms: Sequence[TransformStamped]) -> bytes:
    """Return the bytes of a tf2_msgs/TFMessage with these transforms.

    Raises:
        MalformedMessage: If a stamp does not fit into ROS's 32-bit seconds, or a name contains a
            zero character.
    """
    parts = [CDR.header, _LENGTH.pack(len(transforms))]
    # The first transform, after the count, begins 4 bytes after a multiple of 8; the others,
    # after doubles, begin at a multiple of 8.
    phase = 4
    for sample in transforms:
        sec, nanosec = divmod(sample.stamp, NANOSECONDS)
        try:
            parts.append(_STAMP.pack(sec, nanosec))
        except struct.error as error:
            raise MalformedMessage(
                KIND,
                f"the stamp {sample.stamp} ns does not fit into 32-bit seconds",
            ) from error
        key = (sample.frame_id, sample.child_frame_id, phase)
        parts.append(_heads.get(key) or _head(key))
        transform = sample.transform
        parts.append(_SEVEN.pack(*transform.translation, *transform.rotation))
        phase = 0
    return b"".join(parts)


def decode_transforms(payload: bytes) -> tuple[TransformStamped, ...]:
    """Return the transforms of a tf2_msgs/TFMessage.

    Raises:
        MalformedMessage: If the bytes are not a TFMessage.
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
            # Align to 8 bytes, counted from the end of the header.
            position = ((end + 3) & ~7) + 4

            seven = _SEVEN.unpack_from(payload, position)
            position += 56
            # Created without the constructors' checks: seven doubles need no conversion, and
            # the buffer checks them.
            pose = new(Transform, (new(Vector3, seven[:3]), new(Quaternion, seven[3:])))
            stamp = sec * NANOSECONDS + nanosec
            found.append(new(TransformStamped, (stamp, parent, child, pose)))
    except struct.error as error:
        raise MalformedMessage(
            KIND, f"the message ends within transform {len(found) + 1} of {count}"
        ) from error
    check_rest(KIND, size - position)
    return tuple(found)


class TransformColumns:
    """Many transforms as columns, one row per transform, in the order of the message.

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
    """Return the transforms of a large tf2_msgs/TFMessage as arrays with a row per transform.

    Raises:
        MalformedMessage: If the bytes are not a TFMessage.
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
        # Odd 4-byte words are aligned to 8 bytes, counted from the end of the header.
        word |= 1
        numbers[row] = word
        word += 14
        if word > last:
            raise _ends_within(row, count)
    check_rest(KIND, size - word * 4)

    table = np.frombuffer(payload, dtype="<u4", count=last)
    sec = table[starts].astype(np.uint32).view(np.int32).astype(np.int64)
    stamps = sec * NANOSECONDS + table[starts + 1].astype(np.int64)
    seven = np.ascontiguousarray(table[numbers[:, None] + np.arange(14)]).view("<f8")
    return TransformColumns(stamps, parents, children, seven[:, :3], seven[:, 3:])


def _skim_name(payload: bytes, words: "memoryview[int]", word: int, names: list[str]) -> int:
    """Append the name at `word`, an offset in 4-byte words, to `names`; return the next offset."""
    length = words[word]
    begin = word * 4 + 4
    if length > len(payload) - begin:
        raise _cut_off(length, len(payload) - begin)
    raw = payload[begin : begin + length]
    name = _names.get(raw)
    names.append(_name(raw) if name is None else name)
    return word + 1 + ((length + 3) >> 2)


def _head(key: tuple[str, str, int]) -> bytes:
    """Return the encoded frame names of a transform, padded up to the transform's first double.

    Args:
        key: Parent, child, and offset of the names modulo 8.
    """
    parent, child, phase = key
    head = _text(parent)
    head += bytes(-len(head) % 4) + _text(child)
    # The eight bytes of the stamp before the names do not change the alignment.
    head += bytes(-(phase + len(head)) % 8)
    if len(_heads) >= _NAMES_KEPT:
        _heads.clear()
    _heads[key] = head
    return head


def _text(name: str) -> bytes:
    try:
        raw = text_bytes(name)
    except ValueError as error:
        raise MalformedMessage(KIND, str(error)) from error
    return _LENGTH.pack(len(raw)) + raw


def _name(raw: bytes) -> str:
    name = read_text(raw)
    if len(raw) <= _LONGEST_NAME_KEPT:
        if len(_names) >= _NAMES_KEPT:
            _names.clear()
        _names[raw] = name
    return name


def _count_of_transforms(payload: bytes) -> int:
    if CDR.order(KIND, payload) != LITTLE:
        raise MalformedMessage(KIND, "only little-endian transforms can be read")
    if len(payload) < 8:
        raise MalformedMessage(KIND, "the message is too short to contain the number of transforms")
    (count,) = _LENGTH.unpack_from(payload, 4)
    room = (len(payload) - 8) // _SMALLEST_TRANSFORM
    if count > room:
        raise MalformedMessage(
            KIND, f"the message announces {count} transforms, but has bytes for only {room}"
        )
    return int(count)


def _cut_off(length: int, rest: int) -> MalformedMessage:
    return MalformedMessage(
        "string", f"a string has {length} bytes, but only {max(rest, 0)} are left in the message"
    )


def _ends_within(row: int, count: int) -> MalformedMessage:
    return MalformedMessage(KIND, f"the message ends within transform {row + 1} of {count}")
