"""Safe reading of YAML: plain values only, with limits on size, depth and expansion.

A few lines of YAML can expand to billions of values, by aliases of aliases and by merge keys. So
all YAML is read through this module, which counts the values of an alias again at each use.
"""

from collections.abc import Iterator
from typing import Any

import yaml

LARGEST = 4 * 1024 * 1024
"""Maximum number of characters of a text."""

DEEPEST = 100
"""Maximum depth of nesting."""

MOST_VALUES = 200_000
"""Maximum number of values, with every alias expanded."""


class TooMuch(yaml.MarkedYAMLError):
    """Error for a YAML text that is too large, nested too deeply, or expands to too many values."""

    def __init__(self, problem: str, mark: Any = None) -> None:
        super().__init__(problem=problem, problem_mark=mark)


def events(
    text: str,
    loader: Any = yaml.SafeLoader,
    *,
    largest: int = LARGEST,
    deepest: int = DEEPEST,
    most_values: int = MOST_VALUES,
) -> Iterator[yaml.Event]:
    """Yield the parser events of a YAML text, within the limits.

    Args:
        text: The YAML text.
        loader: Loader whose scanner and parser are used.
        largest: Maximum number of characters.
        deepest: Maximum depth of nesting.
        most_values: Maximum number of values, with every alias expanded.

    Raises:
        TooMuch: If the text exceeds a limit; `problem_mark` of the error is the position.
        yaml.YAMLError: If the text is not YAML.
    """
    if len(text) > largest:
        raise TooMuch(f"the YAML has more characters than the limit of {largest:,}")
    values = 0
    sizes: dict[str, int] = {}
    # For each open collection: its anchor, and the number of values before it.
    opened: list[tuple[str | None, int]] = []
    for event in yaml.parse(text, loader):
        if isinstance(event, yaml.AliasEvent):
            if any(anchor == event.anchor for anchor, _ in opened):
                raise TooMuch(
                    f"the alias *{event.anchor} is used inside its own value",
                    event.start_mark,
                )
            # The reader of the events refuses an unknown alias.
            values += sizes.get(event.anchor or "", 1)
        elif isinstance(event, yaml.NodeEvent):
            if event.anchor is not None and isinstance(event, yaml.ScalarEvent):
                sizes[event.anchor] = 1
            if isinstance(event, yaml.CollectionStartEvent):
                opened.append((event.anchor, values))
                if len(opened) > deepest:
                    raise TooMuch(
                        f"the YAML has more nested levels than the limit of {deepest}",
                        event.start_mark,
                    )
            values += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            anchor, before = opened.pop()
            if anchor is not None:
                sizes[anchor] = values - before
        if values > most_values:
            raise TooMuch(
                f"the YAML has more values than the limit of {most_values:,}",
                event.start_mark,
            )
        yield event


def compose(text: str, loader: Any = yaml.SafeLoader) -> yaml.Node | None:
    """Return the root node of a YAML text; None for an empty text.

    Raises:
        yaml.YAMLError: If the text is not YAML, or exceeds a limit.
    """
    for _ in events(text, loader):
        pass
    return yaml.compose(text, Loader=loader)


def construct(node: yaml.Node, loader: Any = yaml.SafeLoader) -> Any:
    """Return the plain value of a YAML node.

    Raises:
        yaml.YAMLError: If the node has a tag that is not one of YAML's own types.
    """
    maker = loader("")
    try:
        return maker.construct_document(node)
    except (ValueError, ArithmeticError, AttributeError, TypeError) as error:
        # PyYAML raises these for a value with a wrong tag: !!timestamp x.
        tag = str(node.tag).rpartition(":")[2]
        problem = f"a value has the tag !!{tag}, but is not of this type"
        if not isinstance(node, yaml.ScalarNode):
            problem = "a value does not fit its tag"
        raise yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark) from error
    finally:
        maker.dispose()


def load(text: str, loader: Any = yaml.SafeLoader) -> Any:
    """Return the plain value of a YAML text.

    Raises:
        yaml.YAMLError: If the text is not YAML, exceeds a limit, or has a wrong tag.
    """
    node = compose(text, loader)
    return None if node is None else construct(node, loader)
