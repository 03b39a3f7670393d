"""Values of parameters in YAML, and parameter files, read as in ROS 2."""

import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from tftool.base import yaml_guard
from tftool.base.errors import InputError
from tftool.base.named_files import read_named_text
from tftool.ros.host.names import join


def yaml_value(text: str) -> Any:
    """Parse a parameter's value as YAML, as ROS 2 does: `2` is an int, `2.0` a float."""
    try:
        return strict_yaml_value(text)
    except ValueError:
        return text


def strict_yaml_value(text: str) -> Any:
    """Parse a parameter's value as YAML; raise an error for text that is not YAML.

    Raises:
        ValueError: If the text is not YAML.
    """
    try:
        return yaml_guard.load(text, _loader()) if text else ""
    except (yaml.YAMLError, ValueError):
        raise ValueError(
            f"Unable to parse '{text}' as YAML; for a text, write ParameterValue(…, value_type=str)"
        ) from None


@cache
def _loader() -> Any:
    """Return a YAML loader that reads `12:30` and `2024-01-05` as texts, as ROS 2 does."""

    # ROS 2 reads with libyaml too, which permits a tab after a value.
    class Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
        pass

    kinds = {
        "int": r"[-+]?(?:0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)$",
        "float": r"[-+]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
        r"|\.(?:inf|Inf|INF))$|\.(?:nan|NaN|NAN)$",
    }
    others = {f"tag:yaml.org,2002:{kind}" for kind in (*kinds, "timestamp")}
    Loader.yaml_implicit_resolvers = {
        first: [pair for pair in pairs if pair[0] not in others]
        for first, pairs in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }
    for kind, pattern in kinds.items():
        tag = f"tag:yaml.org,2002:{kind}"
        Loader.add_implicit_resolver(tag, re.compile(pattern), list("-+.0123456789"))
    return Loader


def read_parameters(
    path: Path, substitute: Callable[[str], str] = str
) -> list[tuple[str, str, Any]]:
    """Read a ROS 2 parameter file; return a tuple (node pattern, name, value) for each parameter.

    `substitute` rewrites the file's text before it is parsed.

    Raises:
        InputError: If the file cannot be read, is not YAML, or is not a parameter file.
    """
    try:
        text = read_named_text(path)
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise InputError(f"cannot read the parameter file '{path}': {reason}") from None
    try:
        tree = yaml_guard.compose(substitute(text), _loader())
        found = list(_parameters_in(tree, ""))
    except (yaml.YAMLError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        where = f":{mark.line + 1}:{mark.column + 1}" if mark is not None else ""
        problem = getattr(error, "problem", None) or str(error) or "not YAML"
        raise InputError(f"{path}{where}: {problem}") from None
    if not found and tree is not None:
        raise InputError(
            f"{path}: the file contains no parameters: write 'node_name:', indented below it "
            "'ros__parameters:', and indented below that 'name: value'"
        )
    return found


def _parameters_in(tree: Any, node: str) -> Iterator[tuple[str, str, Any]]:
    """Yield (node pattern, name, value) for each parameter below a YAML node.

    Working on YAML nodes instead of mappings preserves keys that occur more than once.

    The keys above `tree` form `node`, a pattern of node names.
    """
    if not isinstance(tree, yaml.MappingNode):
        return
    for key, value in tree.value:
        if key.value == "ros__parameters":
            settings = yaml_guard.construct(value, _loader())
            yield from ((f"/{node}", name, one) for name, one in flatten(settings or {}))
        else:
            yield from _parameters_in(value, join(node, str(key.value).strip("/")))


def flatten(tree: Any, prefix: str = "") -> list[tuple[str, Any]]:
    """Return the values in nested mappings as a list of (name, value).

    A name consists of the keys of all levels, joined by dots, after `prefix`.
    """
    found: list[tuple[str, Any]] = []
    for key, value in tree.items() if isinstance(tree, Mapping) else ():
        if isinstance(value, Mapping):
            found += flatten(value, f"{prefix}{key}.")
        else:
            found.append((f"{prefix}{key}", value))
    return found
