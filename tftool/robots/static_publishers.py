"""Reader of static transforms from launch files and shell scripts, without running these files.

A launch file in Python is parsed, not executed, so computed values are unknown and reported.
"""

import ast
import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final
from xml.parsers import expat

from tftool.base.errors import InputError, UsageError
from tftool.base.named_files import read_named
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.notation.static_arguments import StaticArguments, beyond_a_turn, of_line

PUBLISHER: Final = "static_transform_publisher"

LARGEST: Final = 16 * 1024 * 1024
"""Maximum size of a file, bytes."""

_EXECUTABLES: Final = ("exec", "executable", "node_executable", "type")


@dataclass(frozen=True, slots=True, eq=False)
class StaticFrames:
    """Static transforms that a launch file or a shell script publishes.

    Attributes:
        name: Name of the file, as the user gave it.
        links: Published transforms, in the order of the file.
        notes: Sentences about parts that cannot be read.
        start: Always 0, because static transforms are valid at all times.
        end: Always 0, like `start`.
    """

    name: str
    links: tuple[StaticArguments, ...]
    notes: tuple[str, ...] = ()
    start: Stamp = 0
    end: Stamp = 0

    @property
    def buffer(self) -> Buffer:
        """Return a buffer with all transforms; for each child, only the last transform counts."""
        found = Buffer(NO_LIMIT)
        for one in self.links:
            sample = TransformStamped(0, one.parent, one.child, one.transform)
            found.set_transform_static(sample, self.name)
        return found

    def close(self) -> None:
        """Do nothing, because no file is open."""


def load_statics(path: Path, name: str | None = None) -> StaticFrames:
    """Read the static transforms that a launch file or script publishes.

    Raises:
        InputError: If the file cannot be read, or contains no static transform that can be read.
    """
    name = name or str(path)
    links, mistakes, computed = read_statics(path, name)
    notes = sorted((*mistakes, *computed))
    if not links:
        why = f" {notes[0][1]}" if notes else f" The file has no {PUBLISHER}."
        raise InputError(f"'{name}' publishes no readable static transform.{why}")
    return StaticFrames(name, tuple(links), tuple(text for _, text in notes))


Remark = tuple[int, str]
"""Line of a publisher that was skipped or has a mistake, and a sentence about it."""


def read_statics(path: Path, name: str) -> tuple[list[StaticArguments], list[Remark], list[Remark]]:
    """Return a file's static transforms, remarks on mistakes, and remarks on computed values.

    Raises:
        InputError: If the file cannot be read.
    """
    try:
        if path.stat().st_size > LARGEST:
            raise InputError(f"'{name}' is larger than {LARGEST} bytes: it is not a launch file.")
        text = read_named(path).decode("utf-8-sig", "replace")
    except OSError as error:
        raise InputError(f"'{name}' cannot be read: {error.strerror or error}.") from error
    start = text.lstrip()
    links: list[StaticArguments] = []
    mistakes: list[Remark] = []
    computed: list[Remark] = []
    for line, words in _publishers(start if start.startswith("<") else text, name):
        try:
            if words is None:
                computed.append(_ignored(name, line, "its arguments are computed at run time"))
            elif (said := of_line(words)) is not None:
                links.append(said)
                mistakes += [(line, f"{name}:{line}: {why}") for why in beyond_a_turn(said)]
        except UsageError as error:
            mistakes.append(_ignored(name, line, str(error)))
    return links, mistakes, computed


def _ignored(name: str, line: int, why: str) -> Remark:
    return line, f"{name}:{line}: a {PUBLISHER} was ignored: {why}"


Publisher = tuple[int, str | None]
"""Line of a publisher, and its arguments as text; None if they are computed."""


def _publishers(text: str, name: str) -> Iterator[Publisher]:
    if text.startswith("<"):
        return _of_xml(text, name)
    if re.search(r"^\s*launch\s*:", text, re.MULTILINE):
        return _of_yaml(text, name)
    if "generate_launch_description" in text or "LaunchDescription" in text:
        return _of_python(text, name)
    return _of_shell(text)


def _of_shell(text: str) -> Iterator[Publisher]:
    number = 1
    for line in text.replace("\\\r\n", "\\\n").split("\n"):
        # `_joined_line` adds the continuation lines.
        if PUBLISHER in line and not line.lstrip().startswith("#"):
            yield number, _joined_line(text, number)
        number += 1


def _joined_line(text: str, number: int) -> str:
    lines = text.split("\n")[number - 1 :]
    found = []
    for line in lines:
        stripped = line.rstrip()
        found.append(stripped.removesuffix("\\"))
        if not stripped.endswith("\\"):
            break
    return " ".join(found)


def _of_xml(text: str, name: str) -> Iterator[Publisher]:
    found: list[Publisher] = []
    parser = expat.ParserCreate("utf-8")

    def begin(tag: str, attributes: dict[str, str]) -> None:
        if tag == "node" and PUBLISHER in {attributes.get(one) for one in _EXECUTABLES}:
            words = attributes.get("args", "")
            computed = "$(" in words
            found.append((parser.CurrentLineNumber, None if computed else f"{PUBLISHER} {words}"))

    def refuse(*_: Any) -> None:
        raise InputError(f"'{name}': <!DOCTYPE is not allowed: remove it.")

    parser.StartElementHandler = begin
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(text.encode("utf-8", "replace"), True)
    except expat.ExpatError as error:
        raise InputError(
            f"'{name}' is not XML: {expat.ErrorString(error.code)} in line {error.lineno}."
        ) from error
    return iter(found)


def _of_yaml(text: str, name: str) -> Iterator[Publisher]:
    # Imported here because `tftool info` imports this module for every recording.
    import yaml

    from tftool.base import yaml_guard

    try:
        root = yaml_guard.compose(text)
    except yaml.YAMLError as error:
        raise InputError(f"'{name}' is not YAML: {' '.join(str(error).split())}") from error
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, yaml.SequenceNode):
            waiting += reversed(node.value)
        if not isinstance(node, yaml.MappingNode):
            continue
        values = {str(key.value): value for key, value in node.value}
        waiting += reversed(list(values.values()))
        executables = [values[one] for one in _EXECUTABLES if one in values]
        if any(one.value == PUBLISHER for one in executables):
            given = values.get("args")
            words = given.value if isinstance(given, yaml.ScalarNode) else ""
            computed = "$(" in words
            yield node.start_mark.line + 1, None if computed else f"{PUBLISHER} {words}"


def _of_python(text: str, name: str) -> Iterator[Publisher]:
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise InputError(f"'{name}' is not Python: {error}.") from error
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        given = {one.arg: one.value for one in node.keywords}
        named = [given[one] for one in _EXECUTABLES if one in given]
        if not any(isinstance(one, ast.Constant) and one.value == PUBLISHER for one in named):
            continue
        try:
            words = [str(one) for one in ast.literal_eval(given["arguments"])]
        except (KeyError, ValueError, TypeError, RecursionError):
            yield node.lineno, None
        else:
            yield node.lineno, f"{PUBLISHER} {shlex.join(words)}"
