"""Mappings in which one key says what they are, and the others stand beside it."""

from collections.abc import Mapping
from typing import Any

from tftool.scenario import document
from tftool.scenario.document import Node, Scalar
from tftool.scenario.fields import (
    UNREAD,
    Key,
    Reader,
    Reading,
    Unreadable,
    attribute_names,
    listed,
    parts_of,
    quoted,
    suggest,
)


def tagged(
    node: Node,
    reading: Reading,
    what: str,
    kinds: Mapping[str, type],
    common: Mapping[str, Key],
    beside: Mapping[str, Mapping[str, Key]],
) -> tuple[str, Any, dict[str, Any]]:
    """Read a mapping in which one key says what it is, and the others stand beside it.

    Args:
        node: The mapping.
        reading: The pass it is read in.
        what: What it is, with its article.
        kinds: The dataclass each such key stands for.
        common: What may stand beside all of them.
        beside: What may stand beside each, besides fields of the dataclass that say so.

    Returns:
        The key, its dataclass, and the values beside it.
    """
    entries = reading.entries(node, f"{listed(common)} and what it is about")
    tag = _tag(node, reading, what, kinds, common, beside)
    kind = kinds[tag]
    parts = parts_of(kind)
    outside = {
        **common,
        **{key: field for key, (field, aside) in parts.items() if aside},
        **beside.get(tag, {}),
    }
    inside = {key: field for key, (field, aside) in parts.items() if not aside}
    rest = {key: entry for key, entry in entries.items() if key != tag}
    given = reading.try_read(lambda n, r: r.values(n.place, rest, outside, f"{what} ({tag})"), node)
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
    what: str,
    kinds: Mapping[str, type],
    common: Mapping[str, Key],
    beside: Mapping[str, Mapping[str, Key]],
) -> str:
    """The one key that says what a mapping is, or what is wrong with its keys."""
    entries = reading.entries(node, "")
    tags = [key for key in entries if key in kinds]
    if len(tags) == 1:
        return tags[0]
    rest = {key: entry for key, entry in entries.items() if key in common}
    reading.try_read(lambda n, r: r.values(n.place, rest, common, what), node)
    if tags:
        second, _ = entries[tags[1]]
        raise reading.refuse(second, f"{what} is about one thing; write {listed(tags)} apart")
    anywhere = set(common)
    for name, kind in kinds.items():
        anywhere |= {key for key, (_, aside) in parts_of(kind).items() if aside}
        anywhere |= set(beside.get(name, {}))
    strange = [key for name, (key, _) in entries.items() if name not in anywhere]
    if not strange:
        raise reading.refuse(node, f"{what} needs one of {listed(kinds)}")
    for key in strange:
        near = suggest(key.text, kinds) or suggest(key.text, anywhere)
        near = near or f"; {what} is one of {listed(kinds)}"
        reading.note(key, f"unknown key {quoted(key.text)}{near}")
    raise Unreadable


def _entries_of(kind: type, key: Scalar) -> Reader:
    """A reader of what stands behind a tag: a mapping, or its one main value by itself."""
    short = getattr(kind, "short", None)

    def read(value: Node, reading: Reading) -> dict[str, tuple[Scalar, Node]]:
        if short is not None and not isinstance(value, document.Mapping):
            return {short: (key, value)}
        return reading.entries(value, listed(parts_of(kind)) or "empty")

    return read


def _is_nothing(value: Node) -> bool:
    return isinstance(value, Scalar) and value.is_nothing
