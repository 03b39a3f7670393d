"""Message, service and action classes, made from their definitions.

They behave as those that ROS 2 generates: every field has its default, the
constructor takes keywords, an assignment is checked for type and range, messages
compare by value and show themselves with all fields.
"""

import array
import math
import re
import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from tftool.errors import InputError
from tftool.ros.interfaces import definitions

_FLOAT32_MAX = 3.402823466e38
_FLOAT64_MAX = 1.7976931348623157e308

_INTEGERS = {
    "int8": (-(2**7), 2**7 - 1, "b"),
    "int16": (-(2**15), 2**15 - 1, "h"),
    "int32": (-(2**31), 2**31 - 1, "i"),
    "int64": (-(2**63), 2**63 - 1, "q"),
    "uint8": (0, 2**8 - 1, "B"),
    "char": (0, 2**8 - 1, "B"),
    "uint16": (0, 2**16 - 1, "H"),
    "uint32": (0, 2**32 - 1, "I"),
    "uint64": (0, 2**64 - 1, "Q"),
}
_FLOATS = {"float32": "f", "float64": "d", "float": "f", "double": "d"}
_STRINGS = ("string", "wstring")

_FIELD = re.compile(
    r"(?P<type>[A-Za-z0-9_/]+)(?:<=(?P<text>\d+))?"
    r"(?:\[(?P<array>(?:<=)?\d*)\])?\s+(?P<name>[A-Za-z]\w*)\s*"
    r"(?:(?P<constant>=)\s*(?P<value>.+)|(?P<default>.+))?$"
)

_one_float32 = struct.Struct("<f")


def as_float32(value: float) -> float:
    """The number as a 32-bit field brings it to the other side."""
    if not math.isfinite(value):
        return value
    return float(_one_float32.unpack(_one_float32.pack(value))[0])


@dataclass(frozen=True, slots=True)
class Field:
    """One field of an interface.

    Attributes:
        name: What it is called.
        kind: Its element's type: a primitive's name, or a message class.
        size: None for a single value, a number for a fixed array, -1 for a sequence.
        bound: The most elements a bounded sequence may hold, None without a bound.
        default: The text after the name, if any.
    """

    name: str
    kind: "str | type[Message]"
    size: int | None
    bound: int | None
    default: str | None
    check: Callable[[Any], Any]
    make: Callable[[], Any]
    described: str


class Message:
    """What all messages have in common; the fields come from the definitions."""

    __slots__ = ()

    fields__: ClassVar[tuple[Field, ...]] = ()
    interface__: ClassVar[str] = ""

    def __init__(self, **kwargs: Any) -> None:
        """Give every field its default, then those named their values.

        Raises:
            AssertionError: If a name is no field, or a value does not fit its field.
        """
        for field in self.fields__:
            if field.name in kwargs:
                setattr(self, field.name, kwargs.pop(field.name))
            else:
                setattr(self, f"_{field.name}", field.make())
        if kwargs:
            raise AssertionError(
                f"Invalid arguments passed to constructor: {', '.join(sorted(kwargs))}"
                f" ({type(self).__name__} has {', '.join(f.name for f in self.fields__) or 'none'})"
            )

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Every field's type by its name, as ROS 2 writes them."""
        return {field.name: field.described for field in cls.fields__}

    def __repr__(self) -> str:
        package, kind, _ = self.interface__.split("/")
        shown = ", ".join(f"{f.name}={_shown(getattr(self, f.name))}" for f in self.fields__)
        return f"{package}.{kind}.{type(self).__name__}({shown})"

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return False
        return all(
            _equal(getattr(self, field.name), getattr(other, field.name)) for field in self.fields__
        )

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> "Message":
        same = object.__new__(type(self))
        for field in self.fields__:
            setattr(same, f"_{field.name}", getattr(self, field.name))
        return same

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        return duplicate(self)


def _shown(value: Any) -> str:
    return repr(list(value)) if isinstance(value, array.array) and not len(value) else repr(value)


def _equal(one: Any, other: Any) -> bool:
    if hasattr(one, "dtype") or hasattr(other, "dtype"):
        return list(one) == list(other)
    return bool(one == other)


def duplicate(message: Any) -> Any:
    """A deep copy, with 32-bit fields rounded: what arrives at the other end."""
    kind = type(message)
    same = object.__new__(kind)
    for field in kind.fields__:
        slot = f"_{field.name}"
        setattr(same, slot, _duplicated(field, getattr(message, slot)))
    return same


def _duplicated(field: Field, value: Any) -> Any:
    if field.size is None:
        if not isinstance(field.kind, str):
            return duplicate(value)
        return as_float32(value) if field.kind in ("float32", "float") else value
    if not isinstance(field.kind, str):
        return [duplicate(one) for one in value]
    if isinstance(value, list):
        return list(value)
    return value.copy() if hasattr(value, "dtype") else value[:]


# Making the checks


def _check_bool(name: str) -> Callable[[Any], Any]:
    def check(value: Any) -> Any:
        if not isinstance(value, bool):
            raise _mismatch(name, "bool", value)
        return value

    return check


def _check_integer(name: str, kind: str) -> Callable[[Any], Any]:
    low, high, _ = _INTEGERS[kind]
    word = "an unsigned integer" if low == 0 else "an integer"

    def check(value: Any) -> Any:
        if not isinstance(value, int):
            raise _mismatch(name, "int", value)
        if not low <= value <= high:
            raise AssertionError(f"The '{name}' field must be {word} in [{low}, {high}]")
        return value

    return check


def _check_float(name: str, kind: str) -> Callable[[Any], Any]:
    single = kind in ("float32", "float")
    highest = _FLOAT32_MAX if single else _FLOAT64_MAX
    word = "a float" if single else "a double"

    def check(value: Any) -> Any:
        if not isinstance(value, float):
            raise _mismatch(name, "float", value)
        if not (-highest <= value <= highest) and math.isfinite(value):
            raise AssertionError(
                f"The '{name}' field must be {word} in [{-highest!r}, {highest!r}]"
            )
        return value

    return check


def _check_string(name: str, bound: int | None) -> Callable[[Any], Any]:
    def check(value: Any) -> Any:
        if not isinstance(value, str):
            raise _mismatch(name, "str", value)
        if bound is not None and len(value) > bound:
            raise AssertionError(f"The '{name}' field must be string value not longer than {bound}")
        return value

    return check


def _check_byte(name: str) -> Callable[[Any], Any]:
    def check(value: Any) -> Any:
        if not (isinstance(value, bytes | bytearray | memoryview) and len(value) == 1):
            raise AssertionError(f"The '{name}' field must be of type 'bytes' with length 1")
        return bytes(value)

    return check


def _check_message(name: str, kind: "type[Message]") -> Callable[[Any], Any]:
    def check(value: Any) -> Any:
        if not isinstance(value, kind):
            raise AssertionError(
                f"The '{name}' field must be a sub message of type '{kind.__name__}', "
                f"not '{type(value).__name__}'"
            )
        return value

    return check


def _mismatch(name: str, wanted: str, value: Any) -> AssertionError:
    text = f"The '{name}' field must be of type '{wanted}', not '{type(value).__name__}'"
    if wanted == "float" and type(value) is int:
        text += f": write {value}.0"
    return AssertionError(text)


def _element_check(name: str, kind: "str | type[Message]", text: int | None) -> Any:
    if not isinstance(kind, str):
        return _check_message(name, kind)
    if kind in _INTEGERS:
        return _check_integer(name, kind)
    if kind in _FLOATS:
        return _check_float(name, kind)
    if kind in _STRINGS:
        return _check_string(name, text)
    return _check_byte(name) if kind == "byte" else _check_bool(name)


def _array_check(
    name: str, kind: "str | type[Message]", size: int, bound: int | None, element: Any
) -> Callable[[Any], Any]:
    typecode = _typecode(kind)
    word = kind if isinstance(kind, str) else kind.__name__
    number = "float" if word in _FLOATS else "int" if word in _INTEGERS else word

    def check(value: Any) -> Any:
        if isinstance(value, str | Mapping) or not (
            isinstance(value, Sequence | set | array.array) or hasattr(value, "tolist")
        ):
            raise AssertionError(
                f"The '{name}' field must be a set or sequence and each value of type '{number}', "
                f"not '{type(value).__name__}'"
            )
        if isinstance(value, array.array) and value.typecode == typecode and size < 0:
            _check_length(name, len(value), size, bound)
            return value
        if isinstance(value, bytes | bytearray) and kind in ("uint8", "char"):
            values: list[Any] = list(value)
        else:
            values = value.tolist() if hasattr(value, "tolist") else list(value)
        _check_length(name, len(values), size, bound)
        for one in values:
            element(one)
        return _packed(kind, size, values)

    return check


def _check_length(name: str, length: int, size: int, bound: int | None) -> None:
    if size >= 0 and length != size:
        raise AssertionError(
            f"The '{name}' field must be a set or sequence with length {size}, not {length}"
        )
    if bound is not None and length > bound:
        raise AssertionError(
            f"The '{name}' field must be a set or sequence of at most {bound}, not {length}"
        )


def _typecode(kind: "str | type[Message]") -> str | None:
    if not isinstance(kind, str):
        return None
    return _INTEGERS[kind][2] if kind in _INTEGERS else _FLOATS.get(kind)


def _packed(kind: "str | type[Message]", size: int, values: list[Any]) -> Any:
    typecode = _typecode(kind)
    if typecode is None:
        return values
    if size < 0:
        return array.array(typecode, values)
    # ROS 2 keeps fixed arrays of numbers as numpy arrays, and users rely on it.
    import numpy as np

    return np.array(values, dtype=np.dtype(typecode))


# Reading definitions


class Interfaces:
    """Every interface by its name, made when it is first asked for.

    Definitions of a workspace's own packages can be added.
    """

    def __init__(self) -> None:
        self._texts = dict(definitions.table())
        self._made: dict[str, type[Any]] = {}

    def add(self, package: str, texts: Mapping[tuple[str, str], str]) -> None:
        """Answer to a package's own definitions, by (kind, name)."""
        self._texts[package] = dict(texts)

    def packages(self) -> Sequence[str]:
        """Every package that has interfaces."""
        return list(self._texts)

    def names(self, package: str, kind: str) -> list[str]:
        """The interfaces of a package, of kind msg, srv or action."""
        return [name for found, name in self._texts.get(package, {}) if found == kind]

    def find(self, package: str, kind: str, name: str) -> type[Any]:
        """The class of an interface.

        Raises:
            InputError: If there is none of that name.
        """
        full = f"{package}/{kind}/{name}"
        made = self._made.get(full)
        if made is None:
            text = self._texts.get(package, {}).get((kind, name))
            if text is None:
                raise InputError(f"there is no interface {full}")
            made = self._made[full] = self._make(package, kind, name, text)
        return made

    def message(self, full_name: str) -> type[Message]:
        """The class of a message by "package/msg/Name" or "package/Name"."""
        parts = full_name.split("/")
        return self.find(parts[0], "msg", parts[-1])

    def _make(self, package: str, kind: str, name: str, text: str) -> type[Any]:
        if kind == "msg":
            return self._message(package, kind, name, text)
        parts = ("Request", "Response") if kind == "srv" else ("Goal", "Result", "Feedback")
        texts = re.split(r"^\s*---\s*$", text, flags=re.MULTILINE)
        if len(texts) != len(parts):
            raise InputError(
                f"{package}/{kind}/{name}: {len(parts)} parts set apart by '---' make it up, "
                f"this has {len(texts)}"
            )
        made: dict[str, Any] = {
            part: self._message(package, kind, f"{name}_{part}", lines)
            for part, lines in zip(parts, texts, strict=True)
        }
        made["interface__"] = f"{package}/{kind}/{name}"
        made["__module__"] = f"{package}.{kind}"
        return type(name, (), made)

    def _message(self, package: str, kind: str, name: str, text: str) -> type[Message]:
        full = f"{package}/{kind}/{name}"
        members: dict[str, Any] = {}
        fields: list[Field] = []
        for raw in text.splitlines():
            line = raw.split("#")[0].strip() if '"' not in raw else raw.strip()
            if not line or line.startswith("#"):
                continue
            match = _FIELD.match(line)
            if match is None:
                raise InputError(f"{full}: '{line}' is no field; write 'type name'")
            if match["constant"]:
                members[match["name"]] = _literal(match["type"], match["value"])
                continue
            fields.append(self._field(package, full, match))
        for field in fields:
            members[field.name] = _property(field)
        members["__slots__"] = [f"_{field.name}" for field in fields]
        members["fields__"] = tuple(fields)
        members["interface__"] = full
        members["__module__"] = f"{package}.{kind}"
        return type(name, (Message,), members)

    def _field(self, package: str, full: str, match: "re.Match[str]") -> Field:
        name, type_name = match["name"], match["type"]
        kind: str | type[Message] = type_name
        described = {"float32": "float", "float64": "double"}.get(type_name, type_name)
        if type_name not in (*_INTEGERS, *_FLOATS, *_STRINGS, "bool", "byte"):
            owner, _, own = type_name.rpartition("/")
            owner = owner.split("/")[0] or package
            try:
                kind = self.find(owner, "msg", own)
            except InputError as error:
                raise InputError(f"{full}: field '{name}': {error}") from None
            described = f"{owner}/{own}"
        text = int(match["text"]) if match["text"] else None
        check = _element_check(name, kind, text)
        default = match["default"]
        if match["array"] is None:
            return Field(name, kind, None, None, default, check, _single(kind, default), described)
        brackets = match["array"]
        bound = int(brackets[2:]) if brackets.startswith("<=") else None
        size = int(brackets) if brackets and bound is None else -1
        described = f"{described}[{size}]" if size >= 0 else f"sequence<{described}>"
        whole = _array_check(name, kind, size, bound, check)
        make = _several(kind, size, default)
        return Field(name, kind, size, bound, default, whole, make, described)


def _property(field: Field) -> property:
    slot = f"_{field.name}"
    check = field.check

    def read(self: Any) -> Any:
        return getattr(self, slot)

    def write(self: Any, value: Any) -> None:
        setattr(self, slot, check(value))

    return property(read, write, doc=f"{field.described}")


def _single(kind: "str | type[Message]", default: str | None) -> Callable[[], Any]:
    if not isinstance(kind, str):
        return kind
    value = _literal(kind, default) if default is not None else _nothing(kind)
    return lambda: value


def _several(kind: "str | type[Message]", size: int, default: str | None) -> Callable[[], Any]:
    if default is not None and isinstance(kind, str):
        given = [_literal(kind, part) for part in default.strip("[] ").split(",") if part.strip()]
        return lambda: _packed(kind, size, list(given))
    if isinstance(kind, str):
        return lambda: _packed(kind, size, [_nothing(kind)] * max(0, size))
    return lambda: [kind() for _ in range(max(0, size))]


def _nothing(kind: str) -> Any:
    if kind in _INTEGERS:
        return 0
    if kind in _FLOATS:
        return 0.0
    if kind in _STRINGS:
        return ""
    return b"\0" if kind == "byte" else False


def _literal(kind: str, text: str) -> Any:
    text = text.strip()
    if kind in _INTEGERS:
        return int(text, 0)
    if kind in _FLOATS:
        return float(text)
    if kind == "bool":
        return text.lower() in ("true", "1")
    if kind == "byte":
        return bytes([int(text, 0)])
    return text[1:-1] if text[:1] in "\"'" and text[-1:] == text[:1] and len(text) > 1 else text


INTERFACES = Interfaces()
"""The interfaces every part of `ros` shares: a class compares by identity, so one of each."""
