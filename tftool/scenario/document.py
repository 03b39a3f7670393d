"""YAML text as a small tree in which every value knows its place.

Only YAML's syntax is used: its event stream. What a plain word means is
decided later by whoever reads it, so `no` can be a frame and `1e-3` a number,
and no tag can construct anything.
"""

import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn

import yaml

from tftool.errors import Mistake, ScenarioError

LARGEST = 256 * 1024
"""Characters a scenario may have."""

DEEPEST = 20
"""Levels of nesting a scenario may have."""

MOST_VALUES = 20_000
"""Values a scenario may have, with every alias written out."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where something stands: line and column from 0, and how wide it is."""

    line: int
    column: int
    width: int = 1


@dataclass(frozen=True, slots=True)
class Scalar:
    """A single value, as written; `plain` when it stands without quotes."""

    place: Place
    text: str
    plain: bool = True

    @property
    def is_nothing(self) -> bool:
        """Whether nothing was written, or YAML's words for it."""
        return self.plain and self.text in {"", "~", "null"}


@dataclass(frozen=True, slots=True)
class Mapping:
    """Keys and values in the order of the file; keys may be there twice."""

    place: Place
    entries: tuple[tuple[Scalar, "Node"], ...]


@dataclass(frozen=True, slots=True)
class Sequence:
    """Values in a row."""

    place: Place
    items: tuple["Node", ...]


Node = Scalar | Mapping | Sequence


class Document:
    """A text under a name: shows its lines, and reads its tree.

    Args:
        text: The whole text.
        name: What to call it in messages, usually its path.

    Attributes:
        mistakes: What was wrong with it and still let the rest be read.
    """

    def __init__(self, text: str, name: str) -> None:
        self.text = text.removeprefix("\ufeff")
        self.name = name
        self.mistakes: list[Mistake] = []
        # Not splitlines: YAML's own idea of a line has neither form feed nor \x1c.
        unified = self.text.replace("\r\n", "\n").replace("\r", "\n").replace("\x85", "\n")
        self._lines = unified.replace("\u2028", "\n").replace("\u2029", "\n").split("\n")

    def mistake(self, place: Place, text: str) -> Mistake:
        """Say what is wrong at a place, with its line and a caret under it."""
        line = self._lines[place.line] if place.line < len(self._lines) else ""
        start = max(0, place.column - 60)
        shown = line[start : start + 120]
        before = sum(_cells(char) for char in line[start : place.column])
        inside = line[place.column : min(place.column + place.width, start + 120)].rstrip()
        marks = " " * before + "^" * max(1, sum(_cells(char) for char in inside))
        return Mistake(self.name, place.line + 1, place.column + 1, text, _showable(shown), marks)

    def read(self) -> Node:
        """Read the tree.

        Raises:
            ScenarioError: When the text is no YAML, is empty, holds more than one
                document, or is too large, too deep or too much.
        """
        if len(self.text) > LARGEST:
            self.refuse(Place(0, 0), f"more than {LARGEST:,} characters are too many")
        try:
            reader = _Reader(self)
            root = reader.read()
        except yaml.reader.ReaderError as error:
            before = self.text[: error.position]
            place = Place(before.count("\n"), len(before) - before.rfind("\n") - 1)
            self.refuse(place, f"the character {error.character:#06x} is not allowed here", error)
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            place = Place(mark.line, mark.column) if mark else Place(0, 0)
            said = ", ".join(part for part in (error.context, error.problem) if part)
            self.refuse(place, f"this is not YAML: {_showable(said)}", error)
        except (ValueError, OverflowError) as error:
            # "\\UFFFFFFFF" in quotes names a character that does not exist.
            self.refuse(Place(0, 0), "an escape in quotes names no character", error)
        return root

    def refuse(self, place: Place, text: str, cause: Exception | None = None) -> NoReturn:
        """Give up on the whole text because of one place."""
        raise ScenarioError(self.name, [*self.mistakes, self.mistake(place, text)]) from cause


class _Reader:
    """Turns the event stream into nodes."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.events: Iterator[yaml.Event] = iter(yaml.parse(document.text, yaml.SafeLoader))
        self.anchors: dict[str, tuple[Node, int]] = {}
        self.values = 0

    def read(self) -> Node:
        root: Node | None = None
        for event in self.events:
            if isinstance(event, yaml.DocumentStartEvent):
                if root is not None:
                    self.refuse(event, "a second document starts here; one file is one scenario")
            elif isinstance(event, yaml.NodeEvent):
                root = self.node(event, 0)
        if root is None:
            self.document.refuse(Place(0, 0), "the file is empty")
        return root

    def node(self, event: yaml.Event, depth: int) -> Node:
        if isinstance(event, yaml.AliasEvent):
            return self.alias(event)
        if depth > DEEPEST:
            self.refuse(event, f"more than {DEEPEST} levels of nesting are too deep")
        assert isinstance(event, yaml.NodeEvent)
        tag: str | None = getattr(event, "tag", None)
        if tag is not None and tag != "!":
            # Noted, not more: nothing is ever constructed, and the rest can be read.
            text = f"tags ({_showable(tag)}) are not used in scenarios"
            self.document.mistakes.append(self.document.mistake(_place(event), text))
        before = self.values
        self.count(event, 1)
        place = _place(event)
        node: Node
        if isinstance(event, yaml.ScalarEvent):
            node = Scalar(place, event.value, event.style is None)
        elif isinstance(event, yaml.SequenceStartEvent):
            items = []
            while not isinstance(item := next(self.events), yaml.SequenceEndEvent):
                items.append(self.node(item, depth + 1))
            node = Sequence(place, tuple(items))
        else:
            entries = []
            while not isinstance(key_event := next(self.events), yaml.MappingEndEvent):
                key = self.node(key_event, depth + 1)
                if not isinstance(key, Scalar):
                    self.refuse(key_event, "a key is one word, not a list or a mapping")
                entries.append((key, self.node(next(self.events), depth + 1)))
            node = Mapping(place, tuple(entries))
        if event.anchor is not None:
            self.anchors[event.anchor] = (node, self.values - before)
        return node

    def alias(self, event: yaml.AliasEvent) -> Node:
        anchor = event.anchor or ""
        known = self.anchors.get(anchor)
        if known is None:
            self.refuse(event, f"*{_showable(anchor)} names no anchor that ends before it")
        node, size = known
        # What an alias stands for is counted each time: a few lines can mean billions.
        self.count(event, size)
        return node

    def count(self, event: yaml.Event, more: int) -> None:
        self.values += more
        if self.values > MOST_VALUES:
            self.refuse(event, f"more than {MOST_VALUES:,} values are too many")

    def refuse(self, event: yaml.Event, text: str) -> NoReturn:
        self.document.refuse(_place(event), text)


def _place(event: yaml.Event) -> Place:
    start, end = event.start_mark, event.end_mark
    assert start is not None
    assert end is not None
    width = end.column - start.column if end.line == start.line else 1
    if not isinstance(event, yaml.ScalarEvent | yaml.AliasEvent):
        width = 1
    return Place(start.line, start.column, max(1, width))


def _showable(text: str) -> str:
    """Replace what a terminal might obey, one character for one."""
    return "".join(
        char if char.isprintable() else (" " if char == "\t" else "\ufffd") for char in text
    )


def _cells(char: str) -> int:
    """How many columns of a terminal a character takes."""
    if unicodedata.combining(char):
        return 0
    return 2 if unicodedata.east_asian_width(char) in "WF" else 1
