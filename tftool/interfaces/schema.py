"""Definitions read: what an interface is made of, and the structures derived from it.

A service travels as a request and a response, an action as three services' worth of
messages; ROS 2 derives those, and an event for every service, from the definition.
Each is a `Structure` by a name of its own: "std_srvs/srv/SetBool_Request".
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from tftool.errors import InputError
from tftool.interfaces import definitions

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
"""Whole numbers, and their letters in `struct` and `array`."""

FLOATS: Final = {"float32": "f", "float64": "d", "float": "f", "double": "d"}
"""Floating-point numbers, and their letters."""

STRINGS: Final = ("string", "wstring")

PRIMITIVES: Final = frozenset([*INTEGERS, *FLOATS, *STRINGS, "bool", "byte"])

_PARTS: Final = {"srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}

_FIELD = re.compile(
    r"(?P<type>[A-Za-z0-9_/]+)(?:<=(?P<text>\d+))?"
    r"(?:\[(?P<array>(?:<=)?\d*)\])?\s+(?P<name>[A-Za-z]\w*)\s*"
    r"(?:(?P<constant>=)\s*(?P<value>.+)|(?P<default>.+))?$"
)

_GOAL_ID = "unique_identifier_msgs/UUID goal_id\n"


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a structure.

    Attributes:
        name: What it is called.
        type: Its element's type: a primitive, or a structure's full name.
        size: None for a single value, a number for a fixed array, -1 for a sequence.
        bound: The most elements a bounded sequence may hold, None without a bound.
        text_bound: The most characters of a bounded text, None without a bound.
        default: The text after the name, if any.
    """

    name: str
    type: str
    size: int | None = None
    bound: int | None = None
    text_bound: int | None = None
    default: str | None = None


@dataclass(frozen=True, slots=True)
class Structure:
    """What lies in one message, in order.

    Attributes:
        name: Its full name, "geometry_msgs/msg/Pose".
        fields: What it holds.
        constants: Name, type and text of each constant.
    """

    name: str
    fields: tuple[Field, ...]
    constants: tuple[tuple[str, str, str], ...] = ()


class Schema:
    """Every interface's structures by their names, read when they are first asked for.

    Definitions of a workspace's own packages can be added.
    """

    def __init__(self) -> None:
        self._texts = dict(definitions.table())
        self._read: dict[str, Structure] = {}

    def add(self, package: str, texts: Mapping[tuple[str, str], str]) -> None:
        """Answer to a package's own definitions, by (kind, name)."""
        self._texts[package] = dict(texts)
        for full in [full for full in self._read if full.startswith(f"{package}/")]:
            del self._read[full]

    def knows(self, package: str, texts: Mapping[tuple[str, str], str]) -> bool:
        """Whether a package has these very definitions."""
        return self._texts.get(package) == texts

    def packages(self) -> Sequence[str]:
        """Every package that has interfaces."""
        return list(self._texts)

    def names(self, package: str, kind: str) -> list[str]:
        """The interfaces of a package, of kind msg, srv or action."""
        return [name for found, name in self._texts.get(package, {}) if found == kind]

    def parts(self, package: str, kind: str, name: str) -> dict[str, str]:
        """The parts of a service's or an action's definition, by "Request", "Goal" and so on.

        Raises:
            InputError: If there is no such interface, or it has other parts.
        """
        full = f"{package}/{kind}/{name}"
        text = self._texts.get(package, {}).get((kind, name))
        if text is None:
            raise InputError(f"there is no interface {full}")
        parts = _PARTS[kind]
        texts = re.split(r"^\s*---\s*$", text, flags=re.MULTILINE)
        if len(texts) != len(parts):
            raise InputError(
                f"{full}: {len(parts)} parts set apart by '---' make it up, this has {len(texts)}"
            )
        return dict(zip(parts, texts, strict=True))

    def structure(self, full: str) -> Structure:
        """A structure by its full name.

        Raises:
            InputError: If there is none of that name, or its definition is wrong.
        """
        found = self._read.get(full)
        if found is None:
            found = self._read[full] = _parse(full, self._text(full))
        return found

    def has(self, full: str) -> bool:
        """Whether there is a message, service or action of that name (package/kind/Name)."""
        package, _, rest = full.partition("/")
        kind, _, name = rest.partition("/")
        return (kind, name) in self._texts.get(package, {})

    def _text(self, full: str) -> str:
        package, kind, name = full.split("/")
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
        # The service itself is a structure too: of its three messages, for its hash.
        return (
            f"{full}_Request request_message\n{full}_Response response_message\n"
            f"{full}_Event event_message"
        )


def _of_action(folder: str, base: str, part: str) -> str | None:
    """The lines of what ROS 2 derives from an action; None for what its definition says."""
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


def _parse(full: str, text: str) -> Structure:
    package = full.partition("/")[0]
    fields: list[Field] = []
    constants: list[tuple[str, str, str]] = []
    for raw in text.splitlines():
        line = _without_comment(raw).strip()
        if not line:
            continue
        match = _FIELD.match(line)
        if match is None:
            raise InputError(f"{full}: '{line}' is no field; write 'type name'")
        if match["constant"]:
            constants.append((match["name"], match["type"], match["value"]))
        else:
            fields.append(_field(package, match))
    return Structure(full, tuple(fields), tuple(constants))


def _without_comment(line: str) -> str:
    """A line up to its comment; a '#' between quotes begins none."""
    quote = ""
    for at, char in enumerate(line):
        if quote:
            quote = "" if char == quote else quote
        elif char in "\"'":
            quote = char
        elif char == "#":
            return line[:at]
    # An apostrophe that nothing closes is no quote.
    return line.partition("#")[0] if quote else line


def _field(package: str, match: "re.Match[str]") -> Field:
    kind = match["type"]
    if kind not in PRIMITIVES:
        parts = kind.split("/")
        # "Pose", "geometry_msgs/Pose" and "geometry_msgs/msg/Pose" are all written.
        folder = parts[1] if len(parts) == 3 else "msg"
        kind = f"{parts[0] if len(parts) > 1 else package}/{folder}/{parts[-1]}"
    size = bound = None
    brackets = match["array"]
    if brackets is not None:
        bound = int(brackets[2:]) if brackets.startswith("<=") else None
        size = int(brackets) if brackets and bound is None else -1
    text = int(match["text"]) if match["text"] else None
    return Field(match["name"], kind, size, bound, text, match["default"])
