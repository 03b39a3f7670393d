"""Comparison of an output with expected texts, regular expressions, or lists of these."""

import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

Span = tuple[int, int] | None
"""Match as (index, index after the match); None without a match."""

_ESCAPES = re.compile(r"\x1b\[[0-?]*[ -/]*[@-~]")


def without_escapes(text: str) -> str:
    """Return a text without its ANSI escape sequences."""
    return _ESCAPES.sub("", text)


def _in_order(first: Any, others: Sequence[Any], *, strict: bool) -> Callable[..., Span]:
    """Return a function that finds several items, one after the other, in an output.

    With `strict`, each item must begin where the previous item ends.
    """

    def match(actual: Any, start: int = 0) -> Span:
        found = first(actual, start)
        if found is None or (strict and found[0] != start):
            return None
        begin, end = found
        for other in others:
            found = other(actual, end)
            if found is None or (strict and found[0] != end):
                return None
            end = found[1]
        return begin, end

    return match


def build_text_match(expected_text: Any, *, strict: bool = False) -> Callable[..., Span]:
    """Return a function that searches an output for a text, a pattern, or a list of these.

    The function takes the output and an index at which the search begins. It returns the start and
    the end of the match as (index, index after the match); None without a match.

    Args:
        expected_text: Text, pattern, or list of texts and patterns, which are found in order.
        strict: Whether the match must begin at the index, without gaps between the items of a
            list; a single text must match the whole rest of the output.

    Raises:
        ValueError: If `expected_text` is not a text, a pattern or a list of these.
    """
    if isinstance(expected_text, str):
        wanted = expected_text

        def find(actual: str, start: int = 0) -> Span:
            actual = actual.replace("\r\n", "\n")
            at = actual.find(wanted, start)
            if strict:
                at = start if actual[start:] == wanted else -1
            return None if at < 0 else (at, at + len(wanted))

        return find
    if isinstance(expected_text, re.Pattern):
        look = expected_text.match if strict else expected_text.search

        def search(actual: str, start: int = 0) -> Span:
            found = look(actual.replace("\r\n", "\n"), start)
            return None if found is None else found.span()

        return search
    if isinstance(expected_text, Iterable):
        first, *others = [build_text_match(one) for one in expected_text]
        return _in_order(first, others, strict=strict)
    raise ValueError(f"expected_text must be a text, a pattern or a list, not {expected_text!r}")


def build_line_match(expected_lines: Any, *, strict: bool = False) -> Callable[..., Span]:
    """Return a function that searches lines for a text, a pattern, or a list of these.

    The function takes the lines and the index of the line at which the search begins. It returns
    the matching lines as (index, index after the last line); None without a match.

    Args:
        expected_lines: Text, pattern, or list of texts and patterns, each for one line.
        strict: Whether the items of a list must match consecutive lines from the index on; a single
            item must match every line.

    Raises:
        ValueError: If `expected_lines` is not a text, a pattern or a list of these.
    """
    if isinstance(expected_lines, str | re.Pattern):

        def holds(line: str) -> bool:
            if isinstance(expected_lines, re.Pattern):
                return expected_lines.match(line) is not None
            return expected_lines == line if strict else expected_lines in line

        def find(actual: Sequence[str], start: int = 0) -> Span:
            if strict:
                return (start, len(actual)) if all(map(holds, actual[start:])) else None
            lines = enumerate(actual[start:], start)
            return next(((at, at + 1) for at, line in lines if holds(line)), None)

        return find
    if isinstance(expected_lines, Iterable):
        first, *others = [build_line_match(one) for one in expected_lines]
        return _in_order(first, others, strict=strict)
    raise ValueError(f"expected_lines must be a text, a pattern or a list, not {expected_lines!r}")


def expect_output(
    text: str | None = None,
    *,
    lines: Sequence[str] | None = None,
    expected_text: Any = None,
    expected_lines: Any = None,
    strip_ansi_escape_sequences: bool = True,
    strict: bool = False,
) -> bool:
    """Return whether an output contains the expected texts or patterns.

    The output is given as a text or as lines. For the expected texts or lines, and for `strict`,
    see `build_text_match` and `build_line_match`.

    Raises:
        ValueError: Unless exactly one of `text` and `lines`, and exactly one of `expected_text` and
            `expected_lines`, is given.
    """
    if (text is None) == (lines is None):
        raise ValueError("give either text or lines, not both or neither")
    if (expected_text is None) == (expected_lines is None):
        raise ValueError("give either expected_text or expected_lines, not both or neither")
    whole = text if text is not None else "\n".join(lines or ())
    if strip_ansi_escape_sequences:
        whole = without_escapes(whole)
    if expected_text is not None:
        return build_text_match(expected_text, strict=strict)(whole) is not None
    return build_line_match(expected_lines, strict=strict)(whole.splitlines()) is not None


def expected_output_from_file(path: str, encoding: str | None = None) -> list[Any]:
    """Return expected lines: texts from the file `path`.txt, or patterns from `path`.regex.

    Raises:
        RuntimeError: If neither file exists.
    """
    for suffix, read in ((".txt", str), (".regex", re.compile)):
        file = Path(f"{path}{suffix}")
        if file.is_file():
            return [read(line) for line in file.read_text(encoding=encoding).splitlines()]
    raise RuntimeError(f"there is neither '{path}.txt' nor '{path}.regex'")


def basic_output_filter(
    filtered_prefixes: Sequence[str] | None = None,
    filtered_patterns: Sequence[str] | None = None,
    filtered_rmw_implementation: str | None = None,
) -> Callable[[str], str]:
    """Return a function that removes lines that begin with a prefix or match a pattern.

    By default, lines that begin with "pid" and "rc" are removed. `filtered_rmw_implementation` is
    ignored, because tftool prints no lines of a middleware.
    """
    prefixes = tuple(get_default_filtered_prefixes() if filtered_prefixes is None
                     else filtered_prefixes)  # fmt: skip
    patterns = [re.compile(one) for one in filtered_patterns or ()]

    def kept(output: str) -> str:
        lines = output.splitlines(keepends=True)
        return "".join(
            line
            for line in lines
            if not line.startswith(prefixes) and not any(one.match(line) for one in patterns)
        )

    return kept


def get_default_filtered_prefixes() -> list[str]:
    """Return the default of `filtered_prefixes` in `basic_output_filter`."""
    return ["pid", "rc"]


def get_default_filtered_patterns() -> list[str]:
    """Return the default of `filtered_patterns` in `basic_output_filter`, an empty list."""
    return []
