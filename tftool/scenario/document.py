"""Tree of a YAML text's values, each with its position in the text.

Only the syntax of YAML is used (the event stream of the parser), not YAML's types. The reader of a
value chooses the type, so that `no` can be the name of a frame and `1e-3` a number. Tags cannot
construct objects.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import yaml

from tftool.base import yaml_guard
from tftool.base.errors import InputError, Mistake, ScenarioError, showable
from tftool.base.named_files import open_named
from tftool.base.plain_text import visible
from tftool.scenario import document

LARGEST = 256 * 1024
"""Longest scenario in characters."""

DEEPEST = 20
"""Largest depth of nesting in a scenario."""

MOST_VALUES = 20_000
"""Largest number of values in a scenario, with every alias written out."""


@dataclass(frozen=True, slots=True)
class TextPlace:
    """Position in a text: line and column from 0, and width in characters."""

    line: int
    column: int
    width: int = 1


@dataclass(frozen=True, slots=True)
class Scalar:
    """Single value as written in the text; `plain` is whether the text has no quotes."""

    place: TextPlace
    text: str
    plain: bool = True

    @property
    def is_nothing(self) -> bool:
        """Whether the value is empty, or one of the words for null, `~` and `null`."""
        return self.plain and self.text in {"", "~", "null"}


@dataclass(frozen=True, slots=True)
class Mapping:
    """Keys and values of a mapping, in the order of the file; keys may be repeated."""

    place: TextPlace
    entries: tuple[tuple[Scalar, "Node"], ...]


@dataclass(frozen=True, slots=True)
class Sequence:
    """Values of a list."""

    place: TextPlace
    items: tuple["Node", ...]


Node = Scalar | Mapping | Sequence


class Document:
    """YAML text to parse, with its name for messages.

    Args:
        text: The whole text.
        name: Name of the text in messages, usually its path.

    Attributes:
        mistakes: Mistakes found so far, after which the reading continued.
    """

    def __init__(self, text: str, name: str) -> None:
        self.text = text.removeprefix("\ufeff")
        self.name = name
        self.mistakes: list[Mistake] = []
        # Not splitlines: in YAML, form feed and \x1c do not end a line.
        unified = self.text.replace("\r\n", "\n").replace("\r", "\n").replace("\x85", "\n")
        self._lines = unified.replace("\u2028", "\n").replace("\u2029", "\n").split("\n")

    def mistake(self, position: TextPlace, text: str) -> Mistake:
        """Return a mistake that shows the line of a position, with a caret below the position."""
        return Mistake.at(
            self.name, self._lines, position.line, position.column, text, width=position.width
        )

    def read(self) -> Node:
        """Parse the text; return the root of the tree.

        Raises:
            ScenarioError: If the text is not YAML, is empty, contains more than one
                document, is too large or too deep, or has too many values.
        """
        try:
            reader = _TreeReader(self)
            root = reader.read()
        except yaml.reader.ReaderError as error:
            before = self.text[: error.position]
            place = TextPlace(before.count("\n"), len(before) - before.rfind("\n") - 1)
            self.refuse(place, f"the character {error.character:#06x} is not allowed here", error)
        except yaml_guard.TooMuch as error:
            mark = error.problem_mark
            place = TextPlace(mark.line, mark.column) if mark else TextPlace(0, 0)
            self.refuse(place, showable(error.problem or ""), error)
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            place = TextPlace(mark.line, mark.column) if mark else TextPlace(0, 0)
            said = ", ".join(part for part in (error.context, error.problem) if part)
            self.refuse(place, f"this is not YAML: {showable(said)}", error)
        except (ValueError, OverflowError) as error:
            # "\\UFFFFFFFF" in quotes names a character that does not exist.
            self.refuse(
                TextPlace(0, 0),
                "an escape such as \\x in quotes is not valid: correct it, or use single quotes",
                error,
            )
        return root

    def refuse(self, position: TextPlace, text: str, cause: Exception | None = None) -> NoReturn:
        """Raise a ScenarioError with all mistakes so far, and with `text` as last mistake."""
        raise ScenarioError(self.name, [*self.mistakes, self.mistake(position, text)]) from cause


class _TreeReader:
    """Converter of YAML events to the nodes of the tree."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.events: Iterator[yaml.Event] = yaml_guard.events(
            document.text, largest=LARGEST, deepest=DEEPEST, most_values=MOST_VALUES
        )
        self.anchors: dict[str, Node] = {}

    def read(self) -> Node:
        root: Node | None = None
        for event in self.events:
            if isinstance(event, yaml.DocumentStartEvent):
                if root is not None:
                    self.refuse(
                        event,
                        "a second YAML document starts here, but a file contains one scenario: "
                        "remove the line '---'",
                    )
            elif isinstance(event, yaml.NodeEvent):
                root = self.node(event)
        if root is None:
            self.document.refuse(TextPlace(0, 0), "the file is empty")
        return root

    def node(self, event: yaml.Event) -> Node:
        if isinstance(event, yaml.AliasEvent):
            return self.alias(event)
        assert isinstance(event, yaml.NodeEvent)
        tag: str | None = getattr(event, "tag", None)
        if tag is not None and tag != "!":
            # Only recorded as a mistake, because tags construct nothing, and the rest can be read.
            text = f"tags ({showable(tag)}) are not allowed in scenarios"
            self.document.mistakes.append(self.document.mistake(_place(event), text))
        place = _place(event)
        node: Node
        if isinstance(event, yaml.ScalarEvent):
            node = Scalar(place, event.value, event.style is None)
        elif isinstance(event, yaml.SequenceStartEvent):
            items = []
            while not isinstance(item := next(self.events), yaml.SequenceEndEvent):
                items.append(self.node(item))
            node = Sequence(place, tuple(items))
        else:
            entries = []
            while not isinstance(key_event := next(self.events), yaml.MappingEndEvent):
                key = self.node(key_event)
                if not isinstance(key, Scalar):
                    self.refuse(key_event, "a key must be one word, not a list or a mapping")
                entries.append((key, self.node(next(self.events))))
            node = Mapping(place, tuple(entries))
        if event.anchor is not None:
            self.anchors[event.anchor] = node
        return node

    def alias(self, event: yaml.AliasEvent) -> Node:
        anchor = event.anchor or ""
        known = self.anchors.get(anchor)
        if known is None:
            self.refuse(event, f"*{showable(anchor)} is not an anchor that was defined before")
        return known

    def refuse(self, event: yaml.Event, text: str) -> NoReturn:
        self.document.refuse(_place(event), text)


def _place(event: yaml.Event) -> TextPlace:
    start, end = event.start_mark, event.end_mark
    assert start is not None
    assert end is not None
    width = end.column - start.column if end.line == start.line else 1
    if not isinstance(event, yaml.ScalarEvent | yaml.AliasEvent):
        width = 1
    return TextPlace(start.line, start.column, max(1, width))


def text_of(path: Path | str) -> str:
    """Return the text of a scenario's file, up to the allowed size.

    Raises:
        InputError: If the file cannot be read, or is not UTF-8.
    """
    try:
        with open_named(Path(path)) as file:
            raw = file.read(4 * document.LARGEST + 1)
    except OSError as error:
        raise InputError(
            f"cannot read '{visible(str(path))}': {error.strerror or error}"
        ) from error
    except ValueError as error:
        raise InputError(f"cannot read '{visible(str(path))}': {error}") from error
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise InputError(
            f"'{visible(str(path))}' is not UTF-8 text: byte {error.start + 1}, in line {line}"
        ) from error
