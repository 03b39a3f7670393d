"""Serialisation of messages into bytes, and back, by the messages' definitions.

For each layout, a type is compiled once into a list of steps: a run of numbers, a string, an array,
a list of messages. Each step writes and reads its part of a message. Arrays of numbers are copied
once when writing and once when reading.
"""

import array
import struct
import sys
from collections.abc import Callable, Iterator
from operator import attrgetter
from typing import Any, Final

from tftool.base.errors import MalformedMessage
from tftool.messages.classes import Interfaces, Message, MessageField
from tftool.messages.field_checks import packed, typecode
from tftool.messages.layouts import (
    BIG,
    CDR,
    LITTLE,
    PASSED_ON,
    Layout,
    Payload,
    Reader,
    Writer,
    check_rest,
)

MOST_FIELDS: Final = 50_000
"""Maximum number of fields of one type, including nested fields, which can double in each line."""

_NATIVE = LITTLE if sys.byteorder == "little" else BIG
_SMALLEST_TEXT: Final = 4


class Codec:
    """Serialiser of one message type in one byte layout.

    `encode` accepts any object with the fields as attributes; `decode` returns a message.
    """

    def __init__(self, kind: type[Message], layout: Layout = CDR) -> None:
        """Compile a message class for one byte layout.

        Args:
            kind: The class of the messages.
            layout: Byte layout of the messages.

        Raises:
            MalformedMessage: If a field is a wstring, whose bytes differ between ROS 2 releases, or
                the type has more than `MOST_FIELDS` fields.
        """
        self.kind = kind
        self.layout = layout
        self.name = kind.interface__
        self._plan = _Planner(self.name, layout).plan(kind)

    def encode(self, message: Any) -> bytes:
        """Serialise a message; return the bytes.

        Raises:
            MalformedMessage: If a value does not fit its field.
        """
        writer = Writer()
        try:
            self._plan.write(writer, message)
            return writer.finish(self.layout)
        except (struct.error, OverflowError, AttributeError, TypeError, ValueError) as error:
            raise MalformedMessage(self.name, f"a value does not fit its field: {error}") from error

    def decode(self, payload: Payload) -> Any:
        """Deserialise a message; the message contains copies of the bytes, not references.

        Raises:
            MalformedMessage: If the bytes are not a message of this type.
        """
        reader = Reader(self.name, payload, self.layout)
        if len(payload) == len(self.layout.header) and not self.kind.fields__:
            # Some writers leave out the one byte of an empty message.
            return self.kind()
        message = self._plan.read(reader)
        check_rest(self.name, len(payload) - reader.position)
        return message


class RecordedCodec:
    """Serialiser of a message type that was recorded without its definition.

    The definitions of all ROS distributions are tried. A message of an earlier distribution gets a
    class of its own, and is serialised again by that class.
    """

    def __init__(self, interfaces: Interfaces, full: str, layout: Layout) -> None:
        """Compile the present and the earlier definitions of a type.

        Args:
            interfaces: The present definitions.
            full: The type's full name.
            layout: Byte layout of the messages.

        Raises:
            InputError: If the type is not known.
        """
        self.kind = interfaces.message(full)
        kinds = [self.kind, *(interfaces.earlier(full) if layout is CDR else [])]
        self._codecs = [Codec(kind, layout) for kind in kinds]

    def encode(self, message: Any) -> bytes:
        """Serialise a message by the definition that its class has; return the bytes.

        Raises:
            MalformedMessage: If a value does not fit its field.
        """
        return next(one for one in self._codecs if one.kind is type(message)).encode(message)

    def decode(self, payload: Payload) -> Any:
        """Deserialise a message by the first definition that fits the bytes.

        Raises:
            MalformedMessage: If no definition fits the bytes.
        """
        first: MalformedMessage | None = None
        for one in self._codecs:
            try:
                return one.decode(payload)
            except MalformedMessage as error:
                first = first or error
        assert first is not None
        raise first


_codecs: dict[Any, Codec] = {}


def codec(kind: type[Message]) -> Codec:
    """Return the serialiser of a message class in ROS 2's layout (CDR), from a cache."""
    found = _codecs.get(kind)
    if found is None:
        found = _codecs[kind] = Codec(kind)
    return found


class _Run:
    """Step of a codec for consecutive numbers of fixed size, also across nested messages."""

    def __init__(self, leaves: list[tuple[str, str]], layout: Layout) -> None:
        """Compile pairs of a field's path and its `struct` letter; the path of padding is ""."""
        self._get = _getter([path for path, _ in leaves if path])
        self._letters = [letter for _, letter in leaves]
        self.smallest = sum(map(struct.calcsize, self._letters))
        self._start = len(layout.header)
        # The amount of padding depends on the position of the run, modulo the alignment.
        self._mask = layout.alignment - 1
        self._structs: dict[str, list[struct.Struct]] = {
            order: [self._struct(order, phase, layout) for phase in range(layout.alignment)]
            for order in {LITTLE, *layout.headers.values()}
        }
        self._little = self._structs[LITTLE]

    def _struct(self, order: str, phase: int, layout: Layout) -> struct.Struct:
        text, place = order, phase
        for letter in self._letters:
            size = struct.calcsize(letter)
            padding = layout.padding(place, size)
            text += "x" * padding + letter
            place += padding + size
        return struct.Struct(text)

    def write(self, writer: Writer, message: Any) -> None:
        chosen = self._little[(writer.before + len(writer)) & self._mask]
        writer += chosen.pack(*self._get(message))

    def read(self, reader: Reader, values: list[Any]) -> None:
        chosen = self._structs[reader.order][(reader.position - self._start) & self._mask]
        values += chosen.unpack_from(reader.payload, reader.take(chosen.size))


class _Text:
    """Step of a codec for a string: its length, then its bytes."""

    smallest = _SMALLEST_TEXT

    def __init__(self, path: str, bound: int | None, layout: Layout) -> None:
        self._get = attrgetter(path)
        self._layout = layout
        self._bound = bound

    def write(self, writer: Writer, message: Any) -> None:
        writer.text(self._get(message), self._layout)

    def read(self, reader: Reader, values: list[Any]) -> None:
        values.append(reader.text(self._bound))


class _Array:
    """Step of a codec for numbers, bytes or booleans: a fixed array, or a sequence."""

    def __init__(self, path: str, field: MessageField, layout: Layout) -> None:
        self._get = attrgetter(path)
        self._field = field
        self._layout = layout
        assert isinstance(field.kind, str)
        self._kind = field.kind
        self._code = typecode(field.kind) or "B"
        self._item = struct.calcsize(self._code)
        self._align = min(self._item, layout.alignment)
        self._count = field.size if field.size is not None and field.size >= 0 else None
        self.smallest = 4 if self._count is None else self._count * self._item

    def write(self, writer: Writer, message: Any) -> None:
        value = self._get(message)
        count = len(value)
        _check_count(self._field, count)
        if self._count is None:
            writer.length(count, self._layout)
        if not count:
            return
        writer += bytes(-(writer.before + len(writer)) % self._align)
        raw = self._raw(value)
        if raw.nbytes < PASSED_ON:
            writer += raw
        else:
            writer.pass_on(raw)

    def _raw(self, value: Any) -> memoryview:
        """Return the little-endian bytes of an array, without a copy if possible."""
        if self._kind == "byte":
            return memoryview(b"".join(value))
        if self._kind == "bool":
            return memoryview(bytes(map(bool, value)))
        held = _numbers_held(value)
        if held is None or _letter_of(held) != self._code or _NATIVE != LITTLE:
            numbers = array.array(self._code, value.tolist() if hasattr(value, "tolist") else value)
            held = memoryview(self._turned(numbers, LITTLE))
        return held.cast("B")

    def read(self, reader: Reader, values: list[Any]) -> None:
        count = reader.count(self._item, self._field.bound) if self._count is None else self._count
        raw = reader.numbers(count, self._item)
        if self._kind == "byte":
            values.append([bytes(raw[place : place + 1]) for place in range(count)])
        elif self._kind == "bool":
            # Every byte except 0 means true.
            values.append(list(map(bool, raw)))
        else:
            found = array.array(self._code)
            found.frombytes(raw)
            found = self._turned(found, reader.order)
            values.append(found if self._count is None else packed(self._kind, count, found))

    def _turned(self, numbers: "array.array[Any]", order: str) -> "array.array[Any]":
        """Convert numbers between the native byte order and `order` in place; return `numbers`."""
        if order != _NATIVE and self._item > 1:
            numbers.byteswap()
        return numbers


class _List:
    """Step of a codec for a field of several strings or messages: a fixed array, or a sequence."""

    def __init__(
        self, path: str, field: MessageField, plan: "_Plan | None", layout: Layout
    ) -> None:
        self._get = attrgetter(path)
        self._field = field
        self._layout = layout
        self._plan = plan
        self._item = _SMALLEST_TEXT if plan is None else plan.smallest
        self._count = field.size if field.size is not None and field.size >= 0 else None
        self.smallest = 4 if self._count is None else self._count * self._item

    def write(self, writer: Writer, message: Any) -> None:
        items = self._get(message)
        _check_count(self._field, len(items))
        if self._count is None:
            writer.length(len(items), self._layout)
        for item in items:
            if self._plan is None:
                writer.text(item, self._layout)
            else:
                self._plan.write(writer, item)

    def read(self, reader: Reader, values: list[Any]) -> None:
        count = reader.count(self._item, self._field.bound) if self._count is None else self._count
        reader.admit(count)
        if self._plan is None:
            values.append([reader.text(self._field.text_bound) for _ in range(count)])
        else:
            values.append([self._plan.read(reader) for _ in range(count)])


_WIDE: Final = {"l": "q", "L": "Q"}

_Step = _Run | _Text | _Array | _List


class _Planner:
    """Compiler of message classes for one byte layout; each nested type is compiled once."""

    def __init__(self, name: str, layout: Layout) -> None:
        self._name = name
        self._layout = layout
        self._plans: dict[type[Message], _Plan] = {}
        self._fields = 0

    def plan(self, kind: type[Message]) -> "_Plan":
        """Return the compiled byte layout of a message class."""
        found = self._plans.get(kind)
        if found is None:
            found = self._plans[kind] = _Plan(kind, self._steps(kind))
        return found

    def _steps(self, kind: type[Message]) -> list[_Step]:
        steps: list[_Step] = []
        run: list[tuple[str, str]] = []

        def end_run() -> None:
            if run:
                steps.append(_Run(list(run), self._layout))
                run.clear()

        def add(owner: type[Message], path: str) -> None:
            if not owner.fields__ and self._layout.empty_size:
                run.append(("", f"{self._layout.empty_size}x"))
            hidden = self._layout.hidden.get(owner.interface__)
            if hidden is not None and owner.fields__[:1] and owner.fields__[0].name != hidden[0]:
                run.append(("", hidden[1]))
            for field in owner.fields__:
                self._count_field()
                place = f"{path}{field.name}"
                letter = self._letter(owner, field)
                if field.size is not None:
                    end_run()
                    if letter:
                        steps.append(_Array(place, field, self._layout))
                    else:
                        part = None if isinstance(field.kind, str) else self.plan(field.kind)
                        steps.append(_List(place, field, part, self._layout))
                elif letter:
                    run.append((place, letter))
                elif isinstance(field.kind, str):
                    end_run()
                    steps.append(_Text(place, field.text_bound, self._layout))
                else:
                    add(field.kind, f"{place}.")

        add(kind, "")
        end_run()
        return steps

    def _letter(self, owner: type[Message], field: MessageField) -> str | None:
        """Return `struct`'s letter for a numeric field; None for strings and messages."""
        if field.kind == "wstring":
            raise MalformedMessage(
                self._name,
                f"field '{field.name}' is a wstring, which cannot be read, because releases of "
                "ROS 2 encode it differently",
            )
        if field.kind == "bool":
            return "?"
        if field.kind == "byte":
            return "c"
        return self._layout.letters.get((owner.interface__, field.name)) or typecode(field.kind)

    def _count_field(self) -> None:
        self._fields += 1
        if self._fields > MOST_FIELDS:
            raise MalformedMessage(
                self._name, f"the definition expands to more than {MOST_FIELDS} fields"
            )


def _numbers_held(value: Any) -> memoryview | None:
    """Return a memoryview of an array of numbers; None for other values."""
    try:
        view = memoryview(value)
    except TypeError:
        return None
    return view if view.ndim == 1 and view.c_contiguous else None


def _letter_of(view: memoryview) -> str:
    """Return the `struct` letter of the numbers in a numpy or Python array."""
    # Where C's long has 8 bytes, arrays call such integers "l"; fields always call them "q".
    letter = view.format
    return _WIDE.get(letter, letter) if view.itemsize == 8 else letter


def _getter(paths: list[str]) -> Callable[[Any], tuple[Any, ...]]:
    """Return a function that reads a message's attributes at these paths as a tuple."""
    if len(paths) > 1:
        return attrgetter(*paths)
    getters = [attrgetter(path) for path in paths]
    return lambda message: tuple(get(message) for get in getters)


def _check_count(field: MessageField, count: int) -> None:
    if field.size is not None and 0 <= field.size != count:
        raise ValueError(f"field '{field.name}' needs {field.size} values, not {count}")
    if field.bound is not None and count > field.bound:
        raise ValueError(f"field '{field.name}' may have at most {field.bound} values, not {count}")


class _Shape:
    """Constructor of a message from the values of its fields, in order."""

    def __init__(self, kind: type[Message]) -> None:
        self._kind = kind
        self._slots: list[tuple[str, _Shape | None]] = []
        for field in kind.fields__:
            # The fields of a single nested message follow in the same row of values.
            part = None
            if field.size is None and not isinstance(field.kind, str):
                part = _Shape(field.kind)
            self._slots.append((f"_{field.name}", part))

    def build(self, values: Iterator[Any]) -> Any:
        """Create a message without checks: decoded values always fit their fields."""
        message = object.__new__(self._kind)
        for slot, part in self._slots:
            setattr(message, slot, next(values) if part is None else part.build(values))
        return message


class _Plan:
    """Byte layout of one message class: the steps that write and read its fields."""

    def __init__(self, kind: type[Message], steps: list[_Step]) -> None:
        self._steps = steps
        self._shape = _Shape(kind)
        self.smallest: int = sum(step.smallest for step in steps)

    def write(self, writer: Writer, message: Any) -> None:
        for step in self._steps:
            step.write(writer, message)

    def read(self, reader: Reader) -> Any:
        values: list[Any] = []
        for step in self._steps:
            step.read(reader, values)
        return self._shape.build(iter(values))
