"""Parser of definitions of messages, services and actions, and of structures derived from these.

A service consists of a request and a response; an action consists of three services and two
messages. ROS 2 derives these structures, and an event for every service, from the definition. Each
`Structure` has its own name, such as "std_srvs/srv/SetBool_Request".

ROS 2's own definitions are included in tftool. Further definitions come from a workspace, or from a
recording of ROS 1 or ROS 2.
"""

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from tftool.base.errors import InputError
from tftool.messages import definitions

INTEGERS: Final = {
    "int8": "b",
    "int16": "h",
    "int32": "i",
    "int64": "q",
    "uint8": "B",
    "char": "B",
    "uint16": "H",
    "uint32": "I",
    "uint64": "Q",
}
"""Integer types, with their letters in `struct` and `array`."""

FLOATS: Final = {"float32": "f", "float64": "d", "float": "f", "double": "d"}
"""Floating-point types, with their letters in `struct` and `array`."""

STRINGS: Final = ("string", "wstring")

MOST_FIELDS: Final = 10_000
"""Maximum number of fields and constants in one definition."""

PRIMITIVES: Final = frozenset([*INTEGERS, *FLOATS, *STRINGS, "bool", "byte"])

_PARTS: Final = {"srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}

_FIELD = re.compile(
    r"(?P<type>[A-Za-z0-9_/]+)(?:<=(?P<text>\d+))?"
    r"(?:\[(?P<array>(?:<=)?\d*)\])?\s+(?P<name>[A-Za-z]\w*)\s*"
    r"(?:(?P<constant>=)\s*(?P<value>.+)|(?P<default>.+))?$"
)

_SEPARATOR = re.compile(r"^={20,}[ \t]*$", re.MULTILINE)
_HEADING = re.compile(r"\s*(?P<language>MSG|IDL):\s*(?P<name>\S+)[^\n]*(?:\n|$)")
_NAME = re.compile(r"(\w+)/(?:(msg|srv|action)/)?(\w+)", re.ASCII)
_DERIVED = re.compile(r"_(?:Request|Response|Event|Goal|Result|Feedback)$")

_ROS1: Final = {
    # `time` and `duration` are primitive in ROS 1, and messages of the same two numbers in ROS 2.
    "time": "builtin_interfaces/msg/Time",
    "duration": "builtin_interfaces/msg/Duration",
}
_ROS1_MOVED: Final = {"roslib/msg/Header": "std_msgs/msg/Header"}

_GOAL_ID = "unique_identifier_msgs/UUID goal_id\n"


@dataclass(frozen=True, slots=True)
class FieldDefinition:
    """One field of a structure, as defined.

    Attributes:
        name: Name of the field.
        type: Type of the field or of an array's elements: a primitive, or a structure's full name.
        size: Length of a fixed array; -1 for a sequence; None for a single value.
        bound: Maximum length of a bounded sequence; None without a bound.
        text_bound: Maximum number of characters of a bounded string; None without a bound.
        default: Text of the default value; None without a default.
    """

    name: str
    type: str
    size: int | None = None
    bound: int | None = None
    text_bound: int | None = None
    default: str | None = None


@dataclass(frozen=True, slots=True)
class Structure:
    """Parsed definition of one message, or of one part of a service or action.

    Attributes:
        name: Full name, "geometry_msgs/msg/Pose".
        fields: The fields, in order.
        constants: Name, type and text of each constant.
    """

    name: str
    fields: tuple[FieldDefinition, ...]
    constants: tuple[tuple[str, str, str], ...] = ()


def full_name(name: str) -> str:
    """Return an interface's full name: "std_msgs/msg/String" for "std_msgs/String".

    Raises:
        InputError: If the text cannot be an interface's name.
    """
    found = _NAME.fullmatch(name)
    if found is None:
        raise InputError(f"{name[:200]!r} is not the name of an interface: write 'package/Name'")
    package, folder, own = found.groups()
    full = f"{package}/{folder or 'msg'}/{own}"
    return _ROS1_MOVED.get(full, full)


class Schema:
    """Set of interface definitions by name, each parsed when first requested.

    Definitions of a workspace's packages and of recordings can be added.
    """

    def __init__(self) -> None:
        self._texts = dict(definitions.table())
        self._read: dict[str, Structure] = {}

    def add(self, package: str, texts: Mapping[tuple[str, str], str]) -> None:
        """Add the interface definitions of a package; replace earlier definitions of the package.

        Args:
            package: Name of the package.
            texts: Text of each definition, by kind ("msg", "srv", "action") and name.
        """
        self._texts[package] = dict(texts)
        for full in [full for full in list(self._read) if full.startswith(f"{package}/")]:
            del self._read[full]

    def define(self, full: str, text: str) -> bool:
        """Add the definitions that a recording has for one of its types.

        Args:
            full: The type's full name.
            text: The definition as in a .msg or .srv file. Definitions of nested types may follow,
                each after a line of '=' and a line "MSG: package/Name".

        Returns:
            Whether the definitions were added. False if another definition of a structure was
            parsed before, for example if a file has messages of two ROS releases.

        Raises:
            InputError: If a definition is wrong, or in IDL.
        """
        texts = _sections(full, text)
        read = {
            name: _parse(name, own, texts)
            for name, own in texts.items()
            if name.split("/")[1] == "msg"
        }
        if any(self._read.get(name, one) != one for name, one in read.items()):
            return False
        if any(name not in read and self._is_other(name, own) for name, own in texts.items()):
            return False
        for name, own in texts.items():
            package, kind, short = name.split("/")
            self._texts[package] = {**self._texts.get(package, {}), (kind, short): own}
        self._read |= read
        return True

    def _is_other(self, full: str, text: str) -> bool:
        """Whether a service or action was already parsed from another definition."""
        package, kind, name = full.split("/")
        known = self._texts.get(package, {}).get((kind, name), text)
        return known != text and any(one.startswith(f"{full}_") for one in list(self._read))

    def knows(self, package: str, texts: Mapping[tuple[str, str], str]) -> bool:
        """Whether exactly these definitions were already added for a package."""
        return self._texts.get(package) == texts

    def packages(self) -> Sequence[str]:
        """Return the names of the packages with interfaces."""
        return list(self._texts)

    def names(self, package: str, kind: str) -> list[str]:
        """Return the names of a package's interfaces of one kind: msg, srv or action."""
        return [name for found, name in self._texts.get(package, {}) if found == kind]

    def text(self, package: str, kind: str, name: str) -> str:
        """Return the text of an interface's definition, as in its file.

        Raises:
            InputError: If there is no such interface.
        """
        text = self._texts.get(package, {}).get((kind, name))
        if text is None:
            raise InputError(f"there is no interface {package}/{kind}/{name}")
        return text

    def parts(self, package: str, kind: str, name: str) -> dict[str, str]:
        """Return the parts of a service's or action's definition by name: "Request", "Goal", ….

        Raises:
            InputError: If the interface is unknown, or the definition has a wrong number of parts.
        """
        full = f"{package}/{kind}/{name}"
        text = self.text(package, kind, name)
        parts = _PARTS[kind]
        texts = re.split(r"^\s*---\s*$", text, flags=re.MULTILINE)
        if len(texts) != len(parts):
            raise InputError(
                f"{full} needs {len(parts)} parts separated by '---', but has {len(texts)}"
            )
        return dict(zip(parts, texts, strict=True))

    def structure(self, full: str) -> Structure:
        """Return the parsed definition with a full name.

        Raises:
            InputError: If there is no structure with that name, or its definition is wrong.
        """
        found = self._read.get(full)
        if found is None:
            found = self._read[full] = _parse(full, self._text(full))
        return found

    def has(self, full: str) -> bool:
        """Whether there is an interface with this full name ("package/kind/Name")."""
        package, _, rest = full.partition("/")
        kind, _, name = rest.partition("/")
        return (kind, name) in self._texts.get(package, {})

    def _text(self, full: str) -> str:
        package, kind, name = full_name(full).split("/")
        if kind == "msg":
            text = self._texts.get(package, {}).get((kind, name))
            if text is None:
                raise InputError(f"there is no interface {full}")
            return text
        base, _, part = name.rpartition("_")
        if part == "Event":
            return (
                "service_msgs/ServiceEventInfo info\n"
                f"{package}/{kind}/{base}_Request[<=1] request\n"
                f"{package}/{kind}/{base}_Response[<=1] response"
            )
        if kind == "action":
            derived = _of_action(f"{package}/{kind}/", base, part)
            if derived is not None:
                return derived
        if part in _PARTS[kind] and base:
            return self.parts(package, kind, base)[part]
        # For its hash, a service is also a structure, with its three messages as fields.
        return (
            f"{full}_Request request_message\n{full}_Response response_message\n"
            f"{full}_Event event_message"
        )


def _of_action(folder: str, base: str, part: str) -> str | None:
    """Return the definition of a type that ROS 2 derives from an action; None for other types."""
    action = base.rpartition("_")[0]
    if part == "FeedbackMessage":
        return f"{_GOAL_ID}{folder}{base}_Feedback feedback"
    if base.endswith("_SendGoal"):
        if part == "Request":
            return f"{_GOAL_ID}{folder}{action}_Goal goal"
        return "bool accepted\nbuiltin_interfaces/Time stamp"
    if base.endswith("_GetResult"):
        return _GOAL_ID if part == "Request" else f"int8 status\n{folder}{action}_Result result"
    return None


def _sections(full: str, text: str) -> dict[str, str]:
    """Return the definition of each type in a recorded definition, by the type's full name."""
    first, *others = _SEPARATOR.split(text)
    # For a service's event, the recorded definition is that of the service.
    name = _DERIVED.sub("", full) if "/msg/" not in full and "---" in first else full
    found = {name: first}
    for other in others:
        heading = _HEADING.match(other)
        if heading is None:
            raise InputError(f"{full}: a definition after '=====' does not begin with 'MSG: name'")
        if heading["language"] == "IDL":
            raise InputError(
                f"the definition of {full} is in IDL, but only .msg definitions can be read"
            )
        found.setdefault(full_name(heading["name"]), other[heading.end() :])
    return found


def _parse(full: str, text: str, recorded: Collection[str] | None = None) -> Structure:
    """Parse the definition of one structure.

    Args:
        full: Full name of the structure.
        text: Text of the definition.
        recorded: Names of the types in a recorded definition, which may use ROS 1's types; None
            for a definition of ROS 2.
    """
    fields: list[FieldDefinition] = []
    constants: list[tuple[str, str, str]] = []
    for raw in text.splitlines():
        line = _without_comment(raw).strip()
        if not line:
            continue
        if len(fields) + len(constants) >= MOST_FIELDS:
            raise InputError(f"{full} has more than {MOST_FIELDS} fields")
        match = _FIELD.match(line)
        if match is None:
            raise InputError(f"{full}: '{line[:200]}' is not a field; write 'type name'")
        if match["constant"]:
            constants.append((match["name"], match["type"], match["value"]))
        else:
            fields.append(_field(full, match, recorded))
    return Structure(full, tuple(fields), tuple(constants))


def _without_comment(line: str) -> str:
    """Return a line of a definition without its comment; a '#' within quotes begins no comment."""
    quote = ""
    for at, char in enumerate(line):
        if quote:
            quote = "" if char == quote else quote
        elif char in "\"'":
            quote = char
        elif char == "#":
            return line[:at]
    # An apostrophe without a second one does not begin a quoted text.
    return line.partition("#")[0] if quote else line


def _field(full: str, match: "re.Match[str]", recorded: Collection[str] | None) -> FieldDefinition:
    kind, package = match["type"], full.partition("/")[0]
    if recorded is not None and kind in _ROS1:
        kind = _ROS1[kind]
    elif recorded is not None and kind == "Header" and f"{package}/msg/Header" not in recorded:
        # In ROS 1, the package of Header may be left out.
        kind = "std_msgs/msg/Header"
    elif kind not in PRIMITIVES:
        kind = full_name(kind if "/" in kind else f"{package}/{kind}")
    size = bound = None
    brackets = match["array"]
    if brackets is not None:
        bound = _size(full, brackets[2:]) if brackets.startswith("<=") else None
        size = _size(full, brackets) if brackets and bound is None else -1
    text = _size(full, match["text"]) if match["text"] else None
    return FieldDefinition(match["name"], kind, size, bound, text, match["default"])


def _size(full: str, digits: str) -> int:
    if not (digits.isascii() and digits.isdecimal() and len(digits) <= 10):
        raise InputError(f"{full}: {digits[:20]} is not a valid size of an array or a string")
    return int(digits)
