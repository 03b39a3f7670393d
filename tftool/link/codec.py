"""Messages as ROS 2's bytes and back, by their definitions.

A type is planned once, as a row of steps: a run of numbers, a text, an array, a list
of messages. Each step writes itself from a message, and reads the values of its fields.
"""

import array
import struct
import sys
from collections.abc import Callable, Iterator
from operator import attrgetter
from typing import Any, Final

from tftool.errors import MalformedMessage
from tftool.interfaces.checks import packed, typecode
from tftool.interfaces.classes import Field, Message
from tftool.link.cdr import BIG, HEADER, LITTLE, Reader, check_rest, write_length, write_text

_NATIVE = LITTLE if sys.byteorder == "little" else BIG
_SMALLEST_TEXT: Final = 4


class Codec:
    """One message type's bytes.

    Whatever has the fields as attributes can be written, a message of ours or not; what is
    read is a message of the class.
    """

    def __init__(self, kind: type[Message]) -> None:
        """Plan how a class's fields lie.

        Raises:
            MalformedMessage: If a field is of a type whose bytes differ between ROS 2 releases.
        """
        self.kind = kind
        self.name = kind.interface__
        self._plan = _Plan(kind)

    def encode(self, message: Any) -> bytes:
        """The bytes of one message.

        Raises:
            MalformedMessage: If a value does not fit its field.
        """
        out = bytearray(HEADER)
        try:
            self._plan.write(out, message)
        except (struct.error, OverflowError, AttributeError, TypeError, ValueError) as error:
            raise MalformedMessage(self.name, f"a value does not fit its field: {error}") from error
        return bytes(out)

    def decode(self, payload: bytes) -> Any:
        """The message of some bytes.

        Raises:
            MalformedMessage: If they are not one.
        """
        reader = Reader(self.name, payload)
        if len(payload) == len(HEADER) and not self.kind.fields__:
            # Some writers leave the empty structure's one byte out.
            return self.kind()
        message = self._plan.read(reader)
        check_rest(self.name, len(payload) - reader.position)
        return message


_codecs: dict[Any, Codec] = {}


def codec(kind: type[Message]) -> Codec:
    """The codec of a message's class, made once."""
    found = _codecs.get(kind)
    if found is None:
        found = _codecs[kind] = Codec(kind)
    return found


class _Run:
    """Numbers of fixed size next to each other, those of parts of the message included."""

    def __init__(self, leaves: list[tuple[str, str]]) -> None:
        self._get = _getter([name for name, _ in leaves])
        self._letters = [letter for _, letter in leaves]
        self.smallest = sum(map(struct.calcsize, self._letters))
        # How much padding there is depends on where the run begins on the grid of 8.
        self._structs: dict[str, list[struct.Struct]] = {
            order: [self._struct(order, phase) for phase in range(8)] for order in (LITTLE, BIG)
        }

    def _struct(self, order: str, phase: int) -> struct.Struct:
        layout, place = order, phase
        for letter in self._letters:
            size = struct.calcsize(letter)
            layout += "x" * (-place % size) + letter
            place += -place % size + size
        return struct.Struct(layout)

    def write(self, out: bytearray, message: Any) -> None:
        # Behind a header of 4 bytes.
        out += self._structs[LITTLE][(len(out) - 4) & 7].pack(*self._get(message))

    def read(self, reader: Reader, values: list[Any]) -> None:
        chosen = self._structs[reader.order][(reader.position - 4) & 7]
        values += chosen.unpack_from(reader.payload, reader.take(chosen.size))


class _Text:
    """A text: its length, its bytes, a zero byte."""

    smallest = _SMALLEST_TEXT

    def __init__(self, path: str, bound: int | None) -> None:
        self._get = attrgetter(path)
        self._bound = bound

    def write(self, out: bytearray, message: Any) -> None:
        write_text(out, self._get(message))

    def read(self, reader: Reader, values: list[Any]) -> None:
        values.append(reader.text(self._bound))


class _Array:
    """Numbers, bytes or truth values: a fixed array, or a sequence with its length in front."""

    def __init__(self, path: str, field: Field) -> None:
        self._get = attrgetter(path)
        self._field = field
        assert isinstance(field.kind, str)
        self._kind = field.kind
        self._code = typecode(field.kind) or "B"
        self._item = struct.calcsize(self._code)
        self._count = field.size if field.size is not None and field.size >= 0 else None
        self.smallest = 4 if self._count is None else self._count * self._item

    def write(self, out: bytearray, message: Any) -> None:
        value = self._get(message)
        _check_count(self._field, len(value))
        if self._count is None:
            write_length(out, len(value))
        raw = self._raw(value)
        if raw:
            out += bytes(-(len(out) - 4) % self._item) + raw

    def _raw(self, value: Any) -> bytes:
        if self._kind == "byte":
            return b"".join(value)
        if self._kind == "bool":
            return bytes(map(bool, value))
        if not isinstance(value, array.array) or value.typecode != self._code:
            value = array.array(self._code, value.tolist() if hasattr(value, "tolist") else value)
        return self._turned(value, LITTLE).tobytes()

    def read(self, reader: Reader, values: list[Any]) -> None:
        count = reader.count(self._item, self._field.bound) if self._count is None else self._count
        start = reader.take(count * self._item, self._item if count else 1)
        raw = reader.payload[start : reader.position]
        if self._kind == "byte":
            values.append([raw[place : place + 1] for place in range(count)])
        elif self._kind == "bool":
            # Anything but 0 is true, and nothing is refused for it.
            values.append(list(map(bool, raw)))
        else:
            found = self._turned(array.array(self._code, raw), reader.order)
            values.append(found if self._count is None else packed(self._kind, count, found))

    def _turned(self, numbers: "array.array[Any]", order: str) -> "array.array[Any]":
        if order != _NATIVE and self._item > 1:
            numbers = numbers[:]
            numbers.byteswap()
        return numbers


class _List:
    """Texts or messages: as many as the type says, or a sequence with its length in front."""

    def __init__(self, path: str, field: Field) -> None:
        self._get = attrgetter(path)
        self._field = field
        self._plan = None if isinstance(field.kind, str) else _Plan(field.kind)
        self._item = _SMALLEST_TEXT if self._plan is None else self._plan.smallest
        self._count = field.size if field.size is not None and field.size >= 0 else None
        self.smallest = 4 if self._count is None else self._count * self._item

    def write(self, out: bytearray, message: Any) -> None:
        items = self._get(message)
        _check_count(self._field, len(items))
        if self._count is None:
            write_length(out, len(items))
        for item in items:
            if self._plan is None:
                write_text(out, item)
            else:
                self._plan.write(out, item)

    def read(self, reader: Reader, values: list[Any]) -> None:
        count = reader.count(self._item, self._field.bound) if self._count is None else self._count
        reader.admit(count)
        if self._plan is None:
            values.append([reader.text(self._field.text_bound) for _ in range(count)])
        else:
            values.append([self._plan.read(reader) for _ in range(count)])


_Step = _Run | _Text | _Array | _List


def _steps(kind: type[Message]) -> list[_Step]:
    steps: list[_Step] = []
    run: list[tuple[str, str]] = []

    def end_run() -> None:
        if run:
            steps.append(_Run(list(run)))
            run.clear()

    def add(owner: type[Message], path: str) -> None:
        if not owner.fields__:
            # IDL knows no structure without a member, so an empty one is one byte.
            run.append(("", "B"))
        for field in owner.fields__:
            place = f"{path}{field.name}"
            if field.kind == "wstring":
                raise MalformedMessage(
                    kind.interface__, f"'{place}' is a wstring, whose bytes differ between releases"
                )
            letter = _letter(field.kind)
            if field.size is not None:
                end_run()
                steps.append((_Array if letter else _List)(place, field))
            elif letter:
                run.append((place, letter))
            elif isinstance(field.kind, str):
                end_run()
                steps.append(_Text(place, field.text_bound))
            else:
                add(field.kind, f"{place}.")

    add(kind, "")
    end_run()
    return steps


def _letter(kind: str | type[Message]) -> str | None:
    """How a single value of fixed size is written by `struct`; None for what has no such."""
    if kind == "bool":
        return "?"
    return "c" if kind == "byte" else typecode(kind)


def _getter(paths: list[str]) -> Callable[[Any], tuple[Any, ...]]:
    if len(paths) > 1 and all(paths):
        return attrgetter(*paths)
    getters = [attrgetter(path) if path else _placeholder for path in paths]
    return lambda message: tuple(get(message) for get in getters)


def _placeholder(_: Any) -> int:
    return 0


def _check_count(field: Field, count: int) -> None:
    if field.size is not None and 0 <= field.size != count:
        raise ValueError(f"'{field.name}' takes {field.size} values, not {count}")
    if field.bound is not None and count > field.bound:
        raise ValueError(f"'{field.name}' takes at most {field.bound} values, not {count}")


class _Shape:
    """How the values of a message's fields, in order, make the message."""

    def __init__(self, kind: type[Message]) -> None:
        self._kind = kind
        self._slots: list[tuple[str, _Shape | None]] = []
        for field in kind.fields__:
            # A single message's fields lie in line with the others.
            is_part = field.size is None and not isinstance(field.kind, str)
            part = _Shape(field.kind) if is_part else None  # type: ignore[arg-type]
            self._slots.append((f"_{field.name}", part))

    def build(self, values: Iterator[Any]) -> Any:
        """The message, past the checks of assignment: its values were made to fit."""
        message = object.__new__(self._kind)
        for slot, part in self._slots:
            setattr(message, slot, next(values) if part is None else part.build(values))
        if not self._slots:
            next(values)
        return message


class _Plan:
    """How one type of message lies in its bytes."""

    def __init__(self, kind: type[Message]) -> None:
        self._steps = _steps(kind)
        self._shape = _Shape(kind)
        self.smallest: int = sum(step.smallest for step in self._steps)

    def write(self, out: bytearray, message: Any) -> None:
        for step in self._steps:
            step.write(out, message)

    def read(self, reader: Reader) -> Any:
        values: list[Any] = []
        for step in self._steps:
            step.read(reader, values)
        return self._shape.build(iter(values))
