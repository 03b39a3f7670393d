"""Parser of XML and YAML launch files, with the same element class for both formats."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat

import yaml

from tftool.base import yaml_guard
from tftool.base.errors import InputError
from tftool.base.named_files import read_named
from tftool.base.plain_text import did_you_mean

DEEPEST = 100
"""Largest allowed depth of nested elements, or of nested `$(…)`."""


@dataclass(slots=True)
class Element:
    """Element of a launch file: in XML a tag, in YAML a key.

    Attributes:
        tag: Tag or key.
        where: Position in the file, "file:line".
        values: Attributes, from name to value.
        children: Child elements.
        read_names: Names of the attributes that were read so far.
        read_tags: Tags of the child elements that were read so far.
    """

    tag: str
    where: str
    values: dict[str, Any] = field(default_factory=dict)
    children: list["Element"] = field(default_factory=list)
    read_names: set[str] = field(default_factory=set)
    read_tags: set[str] = field(default_factory=set)

    def get(self, name: str, default: Any = None) -> Any:
        """Return an attribute's value; return `default` if the element lacks the attribute."""
        self.read_names.add(name)
        return self.values.get(name, default)

    def required(self, *names: str) -> Any:
        """Return the value of a required attribute, whose name is any of `names`.

        Raises:
            InputError: If the attribute is missing.
        """
        for name in names:
            self.read_names.add(name)
        for name in names:
            if name in self.values:
                return self.values[name]
        raise InputError(f"{self.where}: '{self.tag}' needs the attribute '{names[0]}'")

    def children_with(self, *tags: str) -> list["Element"]:
        """Return the child elements whose tag is in `tags`."""
        self.read_tags.update(tags)
        return [child for child in self.children if child.tag in tags]

    def all_children(self) -> list["Element"]:
        """Return all child elements, whatever their tags are."""
        self.read_tags.update(child.tag for child in self.children)
        return self.children

    def finish(self) -> None:
        """Check that all attributes and child elements were read; others are probably misspelt.

        Raises:
            InputError: If an attribute or child element was not read; the text suggests the most
                similar name that was read.
        """
        for name in self.values:
            if name not in self.read_names:
                raise self.error(f"'{self.tag}' has no attribute '{name}'", name, self.read_names)
        for child in self.children:
            if child.tag not in self.read_tags:
                sentence = f"'{self.tag}' cannot contain '{child.tag}'"
                raise child.error(sentence, child.tag, self.read_tags)

    def depth_error(self) -> InputError:
        """Return the error for elements that are nested too deep."""
        return InputError(f"{self.where}: more than {DEEPEST} levels of nesting are too deep")

    def error(self, sentence: str, wrong: str, allowed: Iterable[str]) -> InputError:
        """Return an error with this element's position in the file and a hint "did you mean …".

        The hint names the allowed word that is most similar to the wrong word.
        """
        hint = did_you_mean(wrong, allowed)
        return InputError(f"{self.where}: {sentence}{hint}")


# Reading


def read(path: Path, data: bytes | None = None) -> list[Element]:
    """Read the elements of a launch file in XML or YAML.

    A file is XML if its text begins with a tag or its name ends in ".xml"; otherwise YAML.

    Without `data`, the content of the file, the file is read here.

    Raises:
        InputError: If the file cannot be read or is not a launch file; the text gives the line.
    """
    if data is None:
        try:
            data = read_named(path)
        except OSError as error:
            raise InputError(f"cannot read '{path}': {error.strerror}") from None
    is_xml = path.suffix == ".xml" or begins_as_xml(data)
    return read_xml(data, path) if is_xml else read_yaml(data, path)


def begins_as_xml(data: bytes) -> bool:
    """Return whether the content of a file begins with an XML tag."""
    return data.lstrip().startswith(b"<")


def read_xml(data: bytes, path: Path) -> list[Element]:
    """Return the elements in the content `data` of an XML launch file.

    Raises:
        InputError: If the content is not a launch file; the text gives the line.
    """
    parser = expat.ParserCreate()
    stack: list[Element] = [Element("", str(path))]

    def start(tag: str, values: dict[str, Any]) -> None:
        element = Element(tag, f"{path}:{parser.CurrentLineNumber}", dict(values))
        if len(stack) > DEEPEST:
            raise element.depth_error()
        stack[-1].children.append(element)
        stack.append(element)

    def refuse(*_: Any) -> None:
        raise InputError(
            f"{path}:{parser.CurrentLineNumber}: XML entities are not supported: write their text "
            "instead"
        )

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: stack.pop()
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        where = f"{path}:{error.lineno}:{error.offset + 1}"
        raise InputError(f"{where}: {expat.ErrorString(error.code)}") from None
    except (LookupError, ValueError) as error:
        # Expat uses Python's codecs for encodings that it lacks.
        raise InputError(f"{path}:1: {error}; save the file as UTF-8") from None
    root = stack[0].children[0]
    if root.tag != "launch":
        raise InputError(f"{root.where}: a launch file's root must be 'launch', not '{root.tag}'")
    return root.children


def read_yaml(data: bytes, path: Path) -> list[Element]:
    """Return the elements in the content `data` of a YAML launch file.

    Raises:
        InputError: If the content is not a launch file; the text gives the line.
    """
    try:
        root = yaml_guard.compose(data.decode("utf-8"))
    except UnicodeDecodeError:
        raise InputError(f"cannot read '{path}': the file is not UTF-8 text") from None
    except yaml.YAMLError as error:
        mark: Any = getattr(error, "problem_mark", None)
        where = f"{path}:{mark.line + 1}:{mark.column + 1}" if mark else str(path)
        raise InputError(f"{where}: {getattr(error, 'problem', None) or 'not YAML'}") from None
    except RecursionError:
        raise Element("", str(path)).depth_error() from None
    top = Element("launch", str(path))
    if not isinstance(root, yaml.MappingNode) or [key.value for key, _ in root.value] != ["launch"]:
        raise InputError(f"{path}: a launch file must have one top-level key, 'launch'")
    _Yaml(path).children(root.value[0][1], top, 1)
    return top.children


class _Yaml:
    """Converter from YAML nodes (parsed YAML) to elements of a launch file."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def children(self, node: Any, parent: Element, depth: int) -> None:
        """Convert a YAML list of actions to child elements of `parent`.

        Each item of the list is a mapping with one key, the tag.
        """
        if not isinstance(node, yaml.SequenceNode):
            where = self.where(node)
            what = f"'{parent.tag}' must be a list of actions"
            raise InputError(f"{where}: {what}: begin each item with '- '")
        for item in node.value:
            if not isinstance(item, yaml.MappingNode) or len(item.value) != 1:
                where = self.where(item)
                raise InputError(
                    f"{where}: an action must be one key, its name, with attributes below the key"
                )
            key, value = item.value[0]
            parent.children.append(self.element(self.word(key), value, depth))

    def element(self, tag: str, node: Any, depth: int) -> Element:
        """Convert a YAML mapping of attributes, or a YAML list of actions, to one element."""
        element = Element(tag, self.where(node))
        # An alias may occur inside its own anchor, without end.
        if depth > DEEPEST:
            raise element.depth_error()
        if isinstance(node, yaml.SequenceNode):
            self.children(node, element, depth + 1)
            return element
        if not isinstance(node, yaml.MappingNode):
            raise InputError(
                f"{element.where}: '{tag}' needs attributes: write 'name: value' below it"
            )
        for key, value in node.value:
            name = self.word(key)
            nested = isinstance(value, yaml.SequenceNode) and any(
                isinstance(one, yaml.MappingNode) for one in value.value
            )
            if nested and name == "children":
                self.children(value, element, depth + 1)
            elif nested:
                element.children += [self.element(name, one, depth + 1) for one in value.value]
            else:
                element.values[name] = self.value(value)
        return element

    def word(self, node: Any) -> str:
        """Return a YAML key as a string.

        Raises:
            InputError: If the key is a list or a mapping.
        """
        if not isinstance(node, yaml.ScalarNode):
            raise InputError(f"{self.where(node)}: a key must be one word, not a list or a mapping")
        return str(node.value)

    def value(self, node: Any) -> Any:
        """Convert the YAML node of an attribute's value to a Python value.

        Raises:
            InputError: If the node has a tag for a type outside standard YAML, such as "!color".
        """
        try:
            return yaml_guard.construct(node)
        except (yaml.YAMLError, ValueError) as error:
            reason = getattr(error, "problem", None) or error
            raise InputError(f"{self.where(node)}: {reason}") from None

    def where(self, node: Any) -> str:
        """Return a YAML node's position, "file:line"."""
        return f"{self.path}:{node.start_mark.line + 1}"
