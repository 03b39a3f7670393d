"""Readers that convert YAML of a known structure to values, and report all mistakes together.

A reader is a function that converts a node of the YAML tree to a value. A reader that finds a
mistake records the mistake and raises `Unreadable`. A reader of several values catches this
exception and continues with the next value, so that one pass finds all mistakes.
"""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import FrozenInstanceError, dataclass
from typing import Any, ClassVar, NamedTuple, TypeAlias, TypeVar, dataclass_transform

from tftool.base.errors import Mistake
from tftool.base.plain_text import did_you_mean, near_names, visible
from tftool.scenario import document
from tftool.scenario.document import Document, Node, Scalar, TextPlace

T = TypeVar("T")

Reader: TypeAlias = Callable[[Node, "Reading"], Any]

REQUIRED: Any = object()
"""Default that marks a field which must be given."""

UNREAD: Any = object()
"""Placeholder for a value that could not be read."""

_ARGUMENT = re.compile(r"\$(?:\$|\{(\w+)\}|(\w+))")


class Unreadable(Exception):
    """Exception for a value that could not be read, after its mistake was recorded."""


@dataclass(frozen=True, slots=True)
class Key:
    """Reader of a key's value, and the default value if the key is missing."""

    read: Reader
    default: Any = REQUIRED


class Reading:
    """One pass over a document, with the scenario's arguments and the mistakes found."""

    def __init__(self, source: Document) -> None:
        self.source = source
        self.arguments: dict[str, str] = {}
        self.mistakes: list[Mistake] = []
        self._noted: set[tuple[TextPlace, str]] = set()

    def note(self, where: Node | TextPlace, text: str) -> None:
        """Record a mistake once, even if a YAML alias repeats the value."""
        place = where if isinstance(where, TextPlace) else where.place
        if (place, text) not in self._noted:
            self._noted.add((place, text))
            self.mistakes.append(self.source.mistake(place, text))

    def refuse(self, where: Node | TextPlace, text: str) -> Unreadable:
        """Record a mistake, and return the exception to raise."""
        self.note(where, text)
        return Unreadable()

    def try_read(self, read: Reader, node: Node) -> Any:
        """Read a value; return `UNREAD` if the value has a mistake."""
        try:
            return read(node, self)
        except Unreadable:
            return UNREAD

    def whole(self, values: Iterable[T]) -> list[T]:
        """Return the values as a list; raise Unreadable if a value is `UNREAD`."""
        found = list(values)
        if any(value is UNREAD for value in found):
            raise Unreadable
        return found

    def part(self, node: Node, text: str) -> Scalar:
        """Return a part `text` of the value `node` as a value with the position of `node`."""
        return Scalar(node.place, text.replace("$", "$$"))

    def text(self, node: Node, noun: str) -> str:
        """Return the text of a single value, with arguments inserted.

        Args:
            node: Node of the document to read.
            noun: Noun for messages, with its article, such as "a frame".
        """
        if not isinstance(node, Scalar):
            kind = "a list" if isinstance(node, document.Sequence) else "a mapping"
            raise self.refuse(node, f"expected {noun}, not {kind}")
        if node.is_nothing:
            raise self.refuse(node, f"expected {noun}, found nothing")

        def value(match: re.Match[str]) -> str:
            name = match[1] or match[2]
            if name is None:
                return "$"
            if name not in self.arguments:
                near = suggest(name, self.arguments)
                known = near or (
                    f"; there are {listed(self.arguments)}"
                    if self.arguments
                    else "; declare it under 'arguments'"
                )
                raise self.refuse(node, f"unknown argument '${name}'{known}")
            return self.arguments[name]

        return _ARGUMENT.sub(value, node.text)

    def entries(self, node: Node, noun: str) -> dict[str, tuple[Scalar, Node]]:
        """Return a mapping's entries by key; a repeated key is a mistake."""
        if isinstance(node, Scalar) and node.is_nothing:
            return {}
        if not isinstance(node, document.Mapping):
            kind = "a list" if isinstance(node, document.Sequence) else quoted(node.text)
            raise self.refuse(node, f"expected a mapping ({noun}), not {kind}")
        found: dict[str, tuple[Scalar, Node]] = {}
        for key, value in node.entries:
            if key.text in found:
                line = found[key.text][0].place.line + 1
                self.note(key, f"the key {quoted(key.text)} is given twice, first in line {line}")
            else:
                found[key.text] = (key, value)
        return found

    def items(self, node: Node, noun: str) -> tuple[Node, ...]:
        """Return the items of a list; an empty value is an empty list."""
        if isinstance(node, Scalar) and node.is_nothing:
            return ()
        if not isinstance(node, document.Sequence):
            raise self.refuse(node, f"expected a list ({noun}); begin each item with '- '")
        return node.items

    def record(self, node: Node, readers: Mapping[str, Key], noun: str) -> dict[str, Any]:
        """Read a mapping; return the value of each known key, or the default of a missing key.

        Args:
            node: The mapping.
            readers: Readers of the known keys.
            noun: Noun for messages, with its article, such as "a broadcaster".
        """
        entries = self.entries(node, ", ".join(readers) or "empty")
        return self.values(node.place, entries, readers, noun)

    def values(
        self,
        position: TextPlace,
        entries: Mapping[str, tuple[Scalar, Node]],
        readers: Mapping[str, Key],
        noun: str,
    ) -> dict[str, Any]:
        """Read a mapping's entries with the readers of the known keys, as `record` does."""
        whole = True
        meant = set()
        for name, (key, _) in entries.items():
            if name not in readers:
                whole = False
                meant.update(near_names(name, readers))
                near = suggest(name, readers, always=True)
                self.note(key, f"{noun} has no key {quoted(name)}{near}")
        found: dict[str, Any] = {}
        for name, wanted in readers.items():
            if name in entries:
                found[name] = self.try_read(wanted.read, entries[name][1])
            elif wanted.default is REQUIRED:
                whole = False
                # A misspelt key is not also reported as missing.
                if name not in meant:
                    self.note(position, f"{noun} needs the key '{name}'")
            else:
                found[name] = wanted.default
        self.whole(found.values())
        if not whole:
            raise Unreadable
        return found


class DeclaredField(NamedTuple):
    """Field that a class reads from a scenario; see `reads`."""

    read: Reader
    default: Any
    key: str | None
    beside: bool


def reads(read: Reader, *default: Any, key: str | None = None, beside: bool = False) -> Any:
    """Declare a field that a class reads from a scenario.

    Args:
        read: Reader of the value.
        default: Default value; without a default, the key is required.
        key: Key in the scenario, if different from the field's name.
        beside: Whether the field is written next to the key of the class, not inside that key's
            value.
    """
    return DeclaredField(read, default[0] if default else REQUIRED, key, beside)


@dataclass_transform(kw_only_default=True, frozen_default=True, field_specifiers=(reads,))
class Declared:
    """Base of classes with immutable fields read from a scenario, compared by these fields.

    The base replaces dataclasses, because generating their code took a sixth of the start-up time.
    """

    declared: ClassVar[Mapping[str, DeclaredField]] = {}

    def __init_subclass__(cls) -> None:
        own = {name: one for name, one in vars(cls).items() if isinstance(one, DeclaredField)}
        cls.declared = {**cls.declared, **own}

    def __init__(self, **given: Any) -> None:
        values = {name: given.pop(name, one.default) for name, one in self.declared.items()}
        missing = [name for name, value in values.items() if value is REQUIRED]
        if missing or given:
            raise TypeError(f"{type(self).__name__}: fields missing {missing}, unknown {[*given]}")
        vars(self).update(values)

    def __setattr__(self, name: str, value: object) -> None:
        raise FrozenInstanceError(f"cannot assign to field {name!r}")

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash((type(self), *vars(self).values()))

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"{type(self).__name__}({values})"


def declare(kinds: dict[str, type[Any]], key: str, **facts: object) -> Callable[[type[T]], type[T]]:
    """Register the decorated class in a table, under its key.

    Args:
        kinds: Table of classes, by their keys.
        key: Key of the class in a scenario.
        facts: Further attributes of the class. The attribute `short` names the field to set if the
            scenario has a single value in place of a mapping.
    """

    def enter(kind: type[T]) -> type[T]:
        for name, value in {"key": key, **facts}.items():
            setattr(kind, name, value)
        kinds[key] = kind
        return kind

    return enter


def parts_of(kind: type[Declared]) -> dict[str, tuple[Key, bool]]:
    """Return the readers of a class's keys.

    Returns:
        Mapping from each key that the class reads to (`Key`, whether the key is written next to the
        class's own key).
    """
    return {
        one.key or name: (Key(one.read, one.default), one.beside)
        for name, one in kind.declared.items()
    }


def attribute_names(kind: type[Declared]) -> dict[str, str]:
    """Return the name of a class's attribute for each key that the class reads."""
    return {one.key or name: name for name, one in kind.declared.items()}


def suggest(word: str, known_words: Iterable[str], *, always: bool = False) -> str:
    """Return the end of a message about an unknown word: a similar known word, or all known words.

    Args:
        word: Unknown word.
        known_words: Words that would be right.
        always: Whether to list all known words if no known word is similar.

    Returns:
        Text that begins with "; "; "" if no known word is similar and `always` is false.
    """
    choices = list(known_words)
    meant = did_you_mean(word, choices)
    if meant or not always:
        return meant
    return f"; it may have {listed(choices)}" if choices else "; it has none"


def listed(words: Iterable[str]) -> str:
    """Join words with commas."""
    return ", ".join(words)


def quoted(text: str) -> str:
    """Quote a value from a file for a message; shorten a long value."""
    shown = visible(text)
    return f"'{shown[:60]}…'" if len(shown) > 60 else f"'{shown}'"


def tagged(
    node: Node,
    reading: Reading,
    noun: str,
    kinds: Mapping[str, type],
    common: Mapping[str, Key],
    beside: Mapping[str, Mapping[str, Key]],
) -> tuple[str, Any, dict[str, Any]]:
    """Read a mapping with one key that names a class, and optional further keys.

    Args:
        node: The mapping.
        reading: Pass over the document.
        noun: Noun for messages, with its article, such as "an expectation".
        kinds: Class for each key that names a class.
        common: Further keys that are allowed with every class.
        beside: For each key that names a class, the further keys allowed with this class only.

    Returns:
        The key that names the class, an object of the class, and the values of the further keys.
    """
    entries = reading.entries(node, f"{listed(common)} and what {noun} is about")
    tag = _tag(node, reading, noun, kinds, common, beside)
    kind = kinds[tag]
    parts = parts_of(kind)
    outside = {
        **common,
        **{key: field for key, (field, aside) in parts.items() if aside},
        **beside.get(tag, {}),
    }
    inside = {key: field for key, (field, aside) in parts.items() if not aside}
    rest = {key: entry for key, entry in entries.items() if key != tag}
    given = reading.try_read(lambda n, r: r.values(n.place, rest, outside, f"{noun} ({tag})"), node)
    key, value = entries[tag]
    within = {} if _is_nothing(value) else reading.try_read(_entries_of(kind, key), value)
    if within is UNREAD:
        raise Unreadable
    place = key.place if _is_nothing(value) else value.place
    found = reading.try_read(lambda _, r: r.values(place, within, inside, tag), value)
    if given is UNREAD or found is UNREAD:
        raise Unreadable
    everything = {**found, **given}
    built = kind(**{field: everything[key] for key, field in attribute_names(kind).items()})
    problem = getattr(built, "problem", "")
    if problem:
        raise reading.refuse(value, problem)
    return tag, built, given


def _tag(
    node: Node,
    reading: Reading,
    noun: str,
    kinds: Mapping[str, type],
    common: Mapping[str, Key],
    beside: Mapping[str, Mapping[str, Key]],
) -> str:
    """Return the key that names a class; record a mistake unless there is exactly one such key."""
    entries = reading.entries(node, "")
    tags = [key for key in entries if key in kinds]
    if len(tags) == 1:
        return tags[0]
    rest = {key: entry for key, entry in entries.items() if key in common}
    reading.try_read(lambda n, r: r.values(n.place, rest, common, noun), node)
    if tags:
        second, _ = entries[tags[1]]
        raise reading.refuse(
            second,
            f"{noun} can have only one of these keys: write {listed(tags)} as separate items",
        )
    anywhere = set(common)
    for name, kind in kinds.items():
        anywhere |= {key for key, (_, aside) in parts_of(kind).items() if aside}
        anywhere |= set(beside.get(name, {}))
    strange = [key for name, (key, _) in entries.items() if name not in anywhere]
    if not strange:
        raise reading.refuse(node, f"{noun} needs one of {listed(kinds)}")
    for key in strange:
        near = suggest(key.text, kinds) or suggest(key.text, anywhere)
        near = near or f"; {noun} is one of {listed(kinds)}"
        reading.note(key, f"unknown key {quoted(key.text)}{near}")
    raise Unreadable


def _entries_of(kind: type, key: Scalar) -> Reader:
    """Return a reader for the value of `key`, which names a class; the reader returns the fields.

    The value is a mapping, or a single value for the class's field `short`.
    """
    short = getattr(kind, "short", None)

    def read(value: Node, reading: Reading) -> dict[str, tuple[Scalar, Node]]:
        if short is not None and not isinstance(value, document.Mapping):
            return {short: (key, value)}
        return reading.entries(value, listed(parts_of(kind)) or "empty")

    return read


def _is_nothing(value: Node) -> bool:
    return isinstance(value, Scalar) and value.is_nothing
