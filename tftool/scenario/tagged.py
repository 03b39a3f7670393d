"""Mappings in which one key says what they are, and the others stand beside it."""

from collections.abc import Mapping
from typing import Any

from tftool.scenario import document
from tftool.scenario.document import Node, Scalar
from tftool.scenario.reading import (
    UNREAD,
    Field,
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
    common: Mapping[str, Field],
    beside: Mapping[str, Mapping[str, Field]],
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
    tags = [key for key in entries if key in kinds]
    if len(tags) != 1:
        rest = {key: entry for key, entry in entries.items() if key in common}
        reading.try_read(lambda n, r: r.values(n.place, rest, common, what), node)
        if tags:
            second = entries[tags[1]][0]
            raise reading.refuse(second, f"{what} is about one thing; write {listed(tags)} apart")
        anywhere = set(common)
        for name, kind in kinds.items():
            anywhere |= {key for key, (_, aside) in parts_of(kind).items() if aside}
            anywhere |= set(beside.get(name, {}))
        strange = [entry for key, entry in entries.items() if key not in anywhere]
        if not strange:
            raise reading.refuse(node, f"{what} needs one of {listed(kinds)}")
        for key, _ in strange:
            near = suggest(key.text, kinds) or suggest(key.text, anywhere)
            reading.note(
                key,
                f"unknown key {quoted(key.text)}{near or f'; {what} is one of {listed(kinds)}'}",
            )
        raise Unreadable
    tag = tags[0]
    kind = kinds[tag]
    parts = parts_of(kind)
    outside = {
        **common,
        **{key: field for key, (field, aside) in parts.items() if aside},
        **beside.get(tag, {}),
    }
    rest = {key: entry for key, entry in entries.items() if key != tag}
    given = reading.try_read(lambda n, r: r.values(n.place, rest, outside, f"{what} ({tag})"), node)
    inside = {key: field for key, (field, aside) in parts.items() if not aside}
    key, value = entries[tag]
    short = getattr(kind, "short", None)
    if short is not None and not (
        isinstance(value, document.Mapping) or (isinstance(value, Scalar) and value.is_nothing)
    ):
        found = reading.try_read(
            lambda n, r: r.values(n.place, {short: (key, n)}, inside, tag), value
        )
    elif isinstance(value, Scalar) and value.is_nothing:
        found = reading.try_read(lambda n, r: r.values(key.place, {}, inside, tag), value)
    else:
        found = reading.try_read(lambda n, r: r.record(n, inside, tag), value)
    if given is UNREAD or found is UNREAD:
        raise Unreadable
    everything = {**found, **given}
    built = kind(**{field: everything[key] for key, field in attribute_names(kind).items()})
    problem = getattr(built, "problem", "")
    if problem:
        raise reading.refuse(value, problem)
    return tag, built, given
