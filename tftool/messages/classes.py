"""Message, service and action classes, created from their definitions.

These classes behave like the classes that ROS 2 generates: every field has a default, the
constructor takes keywords, an assignment is checked for type and range, messages compare by value
and print all their fields.
"""

import array
import math
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from operator import attrgetter
from threading import RLock
from typing import Any, ClassVar, Final

from tftool.base.errors import InputError
from tftool.messages import definitions, schema
from tftool.messages.field_checks import Check, array_check, element_check, packed
from tftool.messages.schema import (
    FLOATS,
    INTEGERS,
    PRIMITIVES,
    STRINGS,
    Schema,
    Structure,
    full_name,
)

_one_float32 = struct.Struct("<f")


def as_float32(value: float) -> float:
    """Round a number to the nearest value of a 32-bit field."""
    if not math.isfinite(value):
        return value
    return float(_one_float32.unpack(_one_float32.pack(value))[0])


@dataclass(frozen=True, slots=True)
class MessageField:
    """One field of a message class.

    Attributes:
        name: Name of the field.
        kind: Type of the field or of an array's elements: a primitive's name, or a message class.
        size: Length of a fixed array; -1 for a sequence; None for a single value.
        bound: Maximum length of a bounded sequence; None without a bound.
        text_bound: Maximum number of characters of a bounded string; None without a bound.
        check: Function that checks an assigned value.
        make: Function that returns the default.
        described: Type of the field in ROS 2's notation.
    """

    name: str
    kind: "str | type[Message]"
    size: int | None
    bound: int | None
    text_bound: int | None
    check: Check
    make: Callable[[], Any]
    described: str


class Message:
    """Base class of all messages; subclasses get their fields from definitions."""

    __slots__ = ()

    fields__: ClassVar[tuple[MessageField, ...]] = ()
    stores__: ClassVar[tuple[Callable[[Any, Any], object], ...]] = ()
    interface__: ClassVar[str] = ""

    def __init__(self, **kwargs: Any) -> None:
        """Set all fields to their defaults, then set the fields that are keyword arguments.

        Raises:
            AssertionError: If there is no field with a keyword's name, or a value does not fit.
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
        """Return the type of every field by the field's name, in ROS 2's notation."""
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


def build(kind: Any, *values: Any, **named: Any) -> Any:
    """Create a message of class `kind` without checks; positional values are for the first fields.

    This function is ten times as fast as the constructor, which checks every value.
    """
    message = object.__new__(kind)
    stores = kind.stores__
    for store, value in zip(stores, values, strict=False):
        store(message, value)
    given = len(values)
    if given < len(stores):
        for store, field in zip(stores[given:], kind.fields__[given:], strict=True):
            store(message, named[field.name] if field.name in named else field.make())
    return message


def duplicate(message: Any) -> Any:
    """Return a deep copy of a message, with float32 fields rounded as in serialisation."""
    kind = type(message)
    same = object.__new__(kind)
    for field in kind.fields__:
        slot = f"_{field.name}"
        setattr(same, slot, _duplicated(field, getattr(message, slot)))
    return same


def _duplicated(field: MessageField, value: Any) -> Any:
    if field.size is None:
        if not isinstance(field.kind, str):
            return duplicate(value)
        return as_float32(value) if field.kind in ("float32", "float") else value
    if not isinstance(field.kind, str):
        return [duplicate(one) for one in value]
    if isinstance(value, list):
        return list(value)
    return value.copy() if hasattr(value, "dtype") else value[:]


def _layout_of(kind: type[Message]) -> tuple[Any, ...]:
    """Return names, sizes and types of all fields, recursively for nested messages."""
    return tuple(
        (
            field.name,
            field.size,
            field.bound,
            _layout_of(field.kind) if isinstance(field.kind, type) else field.kind,
        )
        for field in kind.fields__
    )


def interface_name(kind: Any) -> str:
    """Return the ROS name of a class of messages, services or actions; "" for other classes."""
    return str(getattr(kind, "interface__", ""))


def recast(message: Any, kind: type[Message]) -> Any:
    """Return a copy of a message as an object of `kind`, a class with the same fields."""
    copy = duplicate(message)
    if type(copy) is kind:
        return copy
    same = object.__new__(kind)
    for field in kind.fields__:
        setattr(same, f"_{field.name}", getattr(copy, f"_{field.name}"))
    return same


def completed(message: Any, kind: type[Message]) -> Any:
    """Return a message as an object of `kind`; fields that the message lacks get defaults."""
    if type(message) is kind:
        return message
    made = kind()
    inside = {field.name: field.kind for field in kind.fields__}
    for field in message.fields__:
        value, wanted = getattr(message, field.name), inside[field.name]
        if isinstance(wanted, type):
            value = (
                completed(value, wanted)
                if isinstance(value, Message)
                else [completed(one, wanted) for one in value]
            )
        setattr(made, field.name, value)
    return made


def is_part(message: Any, part: str, kind: Any) -> bool:
    """Whether a message is a request of a given service, or a goal of a given action.

    Args:
        message: The message.
        part: "Request" or "Goal".
        kind: The class of the service or action.
    """
    return isinstance(message, Message) and plain_name(message.interface__) == plain_name(
        f"{kind.interface__}_{part}"
    )


def plain_name(ros_type: str) -> str:
    """Return the name of a type, with the package turtlesim instead of turtlesim_msgs."""
    # In newer ROS 2 releases, turtlesim's interfaces are in the package turtlesim_msgs.
    return ros_type.replace("turtlesim_msgs/", "turtlesim/")


# Creation of classes


MOST_NESTED: Final = 64
"""Maximum depth of messages nested in messages."""


class Interfaces(Schema):
    """Classes of all interfaces (messages, services, actions) by name, created on first use.

    The process has one instance, `INTERFACES`. Each recording has its own instance, because its
    definitions may come from another ROS release or from ROS 1.
    """

    def __init__(self) -> None:
        super().__init__()
        self._made: dict[str, type[Any]] = {}
        # Threads of several programs may need a class at the same time. It must be created once,
        # because classes compare by identity. One class may need others, hence the RLock.
        self._lock = RLock()

    def _once(self, full: str, create: Callable[[], type[Any]]) -> type[Any]:
        """Return the class with the name `full`; create the class if there is none."""
        made = self._made.get(full)
        if made is None:
            with self._lock:
                made = self._made.get(full)
                if made is None:
                    made = self._made[full] = create()
        return made

    def add(self, package: str, texts: Mapping[tuple[str, str], str]) -> None:
        """Add the interface definitions of a user's package, by (kind, name)."""
        # Programs start in several threads: without the lock, a class that one of them creates
        # meanwhile would end the loop of another with an error.
        with self._lock:
            # Classes compare by identity, so unchanged definitions must keep their classes.
            if self.knows(package, texts):
                return
            super().add(package, texts)
            for full in [full for full in self._made if full.startswith(f"{package}/")]:
                del self._made[full]

    def find(self, package: str, kind: str, name: str) -> type[Any]:
        """Return the class of a message, service or action.

        Raises:
            InputError: If there is no interface with that name.
        """
        full = f"{package}/{kind}/{name}"
        if kind == "msg":
            return self.part(full)
        return self._once(full, partial(self._compound, package, kind, name))

    def message(self, name: str) -> type[Message]:
        """Return the class of a message, named "package/msg/Name" or "package/Name".

        Raises:
            InputError: If there is no message with that name, or the message contains itself.
        """
        return self.part(full_name(name))

    def recorded(self, name: str, text: str = "") -> type[Message]:
        """Return the class of a recorded message type.

        If a recording has two definitions of one type, each definition gets its own class.

        Args:
            name: Name of the type, "geometry_msgs/PoseStamped" or "geometry_msgs/msg/PoseStamped".
            text: The recorded definition, followed by the definitions of nested types (see
                `define`); "" to use ROS 2's own definition.

        Raises:
            InputError: If the type is unknown or contains itself, or the definition is wrong.
        """
        full = full_name(name)
        if text.strip() and not self.define(full, text):
            return Interfaces().recorded(full, text)
        return self.part(full)

    def earlier(self, full: str) -> list[type[Message]]:
        """Return the classes of a message type in earlier ROS distributions; [] if it never
        changed.

        Each class has other fields than the present class, or nested messages with other fields.
        """
        found: list[type[Message]] = []
        for texts in definitions.EARLIER:
            interfaces = Interfaces()
            for name, text in texts.items():
                interfaces.define(name, text.replace("; ", "\n"))
            kind = interfaces.message(full)
            if _layout_of(kind) not in map(_layout_of, [self.message(full), *found]):
                found.append(kind)
        return found

    def part(self, full: str, within: tuple[str, ...] = ()) -> type[Message]:
        """Return the class of a message, or of a part of a service or action.

        Args:
            full: Full name; a part is named like "std_srvs/srv/SetBool_Request".
            within: Full names of the structures with a field of this class, outermost first.

        Raises:
            InputError: If there is no structure with that name, or the structure contains itself.
        """

        def create() -> type[Message]:
            if full in within:
                raise InputError(f"{full} contains itself, so no message of this type can exist")
            if len(within) >= MOST_NESTED:
                raise InputError(f"{full} is nested in more than {MOST_NESTED} levels of messages")
            return self._class(self.structure(full), (*within, full))

        return self._once(full, create)

    def _compound(self, package: str, kind: str, name: str) -> type[Any]:
        full = f"{package}/{kind}/{name}"
        made: dict[str, Any] = {
            part: self.part(f"{full}_{part}") for part in self.parts(package, kind, name)
        }
        if kind == "srv":
            made["Event"] = _Later(lambda: self.part(f"{full}_Event"))
        if kind == "action":
            made["Impl"] = _Later(lambda: self._derived(full))
        return _holder(full, made)

    def _derived(self, action: str) -> type[Any]:
        """Return the class `Impl` of an action, with its three services and two messages."""

        def create() -> type[Any]:
            services = {
                f"{one}Service": _holder(
                    f"{action}_{one}",
                    {
                        part: self.part(f"{action}_{one}_{part}")
                        for part in ("Request", "Response", "Event")
                    },
                )
                for one in ("SendGoal", "GetResult")
            }
            return _holder(
                f"{action}_Impl",
                {
                    **services,
                    "CancelGoalService": self.find("action_msgs", "srv", "CancelGoal"),
                    "FeedbackMessage": self.part(f"{action}_FeedbackMessage"),
                    "GoalStatusMessage": self.message("action_msgs/GoalStatusArray"),
                },
            )

        return self._once(f"{action}_Impl", create)

    def _class(self, structure: Structure, within: tuple[str, ...]) -> type[Message]:
        package, kind, name = structure.name.split("/")
        members: dict[str, Any] = {
            constant: _literal(f"{structure.name}: '{constant}'", type_name, text)
            for constant, type_name, text in structure.constants
        }
        fields = tuple(self._field(structure.name, field, within) for field in structure.fields)
        for field in fields:
            members[field.name] = _property(field)
        members["__slots__"] = [f"_{field.name}" for field in fields]
        members["fields__"] = fields
        members["interface__"] = structure.name
        members["__module__"] = f"{package}.{kind}"
        made: Any = type(name, (Message,), members)
        made.stores__ = tuple(made.__dict__[slot].__set__ for slot in made.__slots__)
        kind_made: type[Message] = made
        return kind_made

    def _field(
        self, owner: str, field: schema.FieldDefinition, within: tuple[str, ...]
    ) -> MessageField:
        name, type_name, size = field.name, field.type, field.size
        kind: str | type[Message] = type_name
        described = {"float32": "float", "float64": "double"}.get(type_name, type_name)
        if type_name not in PRIMITIVES:
            try:
                kind = self.part(type_name, within)
            except InputError as error:
                raise InputError(f"{owner}: field '{name}': {error}") from None
            described = type_name.replace("/msg/", "/")
        check = element_check(name, kind, field.text_bound)
        if size is None:
            make = _single(f"{owner}: '{name}'", kind, field.default)
        else:
            make = _several(f"{owner}: '{name}'", kind, size, field.default)
            check = array_check(name, kind, size, field.bound, check)
            described = f"{described}[{size}]" if size >= 0 else f"sequence<{described}>"
        return MessageField(name, kind, size, field.bound, field.text_bound, check, make, described)


class _Later:
    """Descriptor of a nested class, such as `Event` of a service, created when first read."""

    def __init__(self, make: Callable[[], type[Any]]) -> None:
        self._make = make

    def __get__(self, instance: object, owner: object) -> type[Any]:
        return self._make()


def _holder(full: str, members: dict[str, Any]) -> type[Any]:
    package, kind, name = full.split("/")
    return type(name, (), members | {"interface__": full, "__module__": f"{package}.{kind}"})


def _property(field: MessageField) -> property:
    slot = f"_{field.name}"
    check = field.check

    def write(self: Any, value: Any) -> None:
        setattr(self, slot, check(value))

    # attrgetter runs in C: fields are read far more often than written.
    return property(attrgetter(slot), write, doc=field.described)


def _single(place: str, kind: "str | type[Message]", default: str | None) -> Callable[[], Any]:
    if not isinstance(kind, str):
        return kind
    value = _literal(place, kind, default) if default is not None else _nothing(kind)
    return lambda: value


def _several(
    place: str, kind: "str | type[Message]", size: int, default: str | None
) -> Callable[[], Any]:
    if default is not None and isinstance(kind, str):
        given = [
            _literal(place, kind, part) for part in default.strip("[] ").split(",") if part.strip()
        ]
        return lambda: packed(kind, size, list(given))
    if isinstance(kind, str):
        return lambda: packed(kind, size, [_nothing(kind)] * max(0, size))
    return list if size <= 0 else lambda: [kind() for _ in range(size)]


def _nothing(kind: str) -> Any:
    if kind in INTEGERS:
        return 0
    if kind in FLOATS:
        return 0.0
    if kind in STRINGS:
        return ""
    return b"\0" if kind == "byte" else False


def _literal(place: str, kind: str, text: str) -> Any:
    """Convert the text of a constant or default to a value; the error message begins with `place`.

    Raises:
        InputError: If the text is not a value of that type.
    """
    text = text.strip()
    try:
        if kind in INTEGERS or kind == "byte":
            # In ROS 1, 010 means ten.
            number = int(text) if text.lstrip("+-").isdecimal() else int(text, 0)
            return bytes([number & 0xFF]) if kind == "byte" else number
        if kind in FLOATS:
            return float(text)
    except ValueError:
        raise InputError(f"{place}: '{text[:80]}' is not a value of type {kind}") from None
    if kind == "bool":
        return text.lower() in ("true", "1")
    return text[1:-1] if text[:1] in "\"'" and text[-1:] == text[:1] and len(text) > 1 else text


INTERFACES = Interfaces()
"""The set of interfaces that the whole process shares, because classes compare by identity."""
