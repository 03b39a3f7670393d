"""Parser of texts with substitutions, such as `$(var name)`, in XML and YAML launch files.

Users' programs import these functions from `launch.frontend`, and register substitutions of their
own with `expose_substitution`.
"""

import inspect
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any, TypeVar

from tftool.base.errors import InputError
from tftool.base.plain_text import near_names
from tftool.ros.host.import_table import tagged
from tftool.ros.host.importing import load
from tftool.ros.launch.elements import DEEPEST
from tftool.ros.launch.substitutions import PythonExpression, TextSubstitution

T = TypeVar("T")


def parsed(text: Any, where: str) -> list[Any]:
    """Parse a text that may contain `$(…)` into a list of substitutions.

    `where` is "file:line" for error texts.

    Raises:
        InputError: If a `$(…)` is not closed or not known, or the text contains too many `$(…)`.
    """
    if str(text).count("$(") > DEEPEST:
        raise InputError(
            f"{where}: a text has {str(text).count('$(')} '$(…)'; at most {DEEPEST} are allowed"
        )
    parts, rest = _parse(str(text), 0, where, closing=False)
    if rest != len(str(text)):
        raise InputError(f"{where}: '{text}' has one ')' too many")
    return parts


class _Quoted(list[Any]):
    """Argument of a substitution, written in quotes and parsed into a list of substitutions."""


_ESCAPED = tuple("$()'\"\\")
"""Characters with a special meaning; after a backslash, each stands for itself."""


def _end_of_quote(text: str, start: int) -> int:
    """Return the index of the closing quote for the quote at `start`; -1 if there is none."""
    at = start + 1
    while at < len(text) and text[at] != text[start]:
        at += 2 if text[at] == "\\" else 1
    return at if at < len(text) else -1


def _parse(text: str, start: int, where: str, *, closing: bool) -> tuple[list[Any], int]:
    parts: list[Any] = []
    plain = ""
    at = start
    while at < len(text):
        if text.startswith("$(", at):
            if plain:
                parts.append(TextSubstitution(text=plain))
                plain = ""
            made, at = _substitution(text, at + 2, where)
            parts.append(made)
        elif text[at] == "\\" and text[at + 1 : at + 2] in _ESCAPED:
            plain += text[at + 1]
            at += 2
        elif closing and (text[at] == ")" or text[at] == " "):
            break
        else:
            plain += text[at]
            at += 1
    if plain:
        parts.append(TextSubstitution(text=plain))
    return parts, at


def _substitution(text: str, start: int, where: str) -> tuple[Any, int]:
    """Parse one `$(name argument argument)` in a text.

    `start` is the index of the character after "$(" in the whole text.

    Returns:
        The substitution, and the index of the character after the closing bracket.

    Raises:
        InputError: If the brackets are not closed, or the name or its arguments are wrong.
    """
    words: list[list[Any]] = []
    at = start
    while at < len(text) and text[at] != ")":
        if text[at] == " ":
            at += 1
        elif text[at] in "'\"":
            end = _end_of_quote(text, at)
            if end < 0:
                raise InputError(f"{where}: a quote in '{text}' is not closed")
            inner, _ = _parse(text[at + 1 : end], 0, where, closing=False)
            words.append(_Quoted(inner))
            at = end + 1
        else:
            word, at = _parse(text, at, where, closing=True)
            words.append(word)
    if at >= len(text):
        raise InputError(f"{where}: '$(' in '{text}' is not closed by ')'")
    if not words or not words[0] or not isinstance(words[0][0], TextSubstitution):
        raise InputError(f"{where}: '$()' in '{text}' is empty: write a name in it")
    name = words[0][0].text
    make, imported = EXPOSED.get(name), tagged().get(f"${name}")
    if make is None and imported is not None:
        make = partial(_create, load(imported))
    if make is None:
        known = (tag.removeprefix("$") for tag in tagged() if tag.startswith("$"))
        near = near_names(name, [*known, *EXPOSED])
        hint = f"; did you mean '$({near[0]} …)'?" if near else ""
        raise InputError(f"{where}: there is no substitution '$({name} …)'{hint}")
    try:
        return make(*words[1:]), at + 1
    except TypeError:
        raise InputError(f"{where}: '$({name} …)' has the wrong number of arguments") from None


def _create(cls: Any, *arguments: list[Any]) -> Any:
    """Create a substitution of the class `cls` from the parsed arguments of a `$(…)`."""
    pairs = zip(inspect.signature(cls).parameters.values(), arguments, strict=False)
    named = {one.name: word for one, word in pairs if one.kind is one.KEYWORD_ONLY}
    return cls(*arguments[: len(arguments) - len(named)], **named)


def _expression(*arguments: list[Any]) -> PythonExpression:
    """Return the substitution for `$(eval …)`.

    If there are exactly two arguments in quotes, the second argument names modules to import.
    """
    if len(arguments) == 2 and all(isinstance(word, _Quoted) for word in arguments):
        plain = "".join(part.text for part in arguments[1] if isinstance(part, TextSubstitution))
        modules = [name.strip() for name in plain.split(",") if name.strip()]
        return PythonExpression(arguments[0], modules)
    return PythonExpression(_spaced(arguments))


def _spaced(words: Iterable[list[Any]]) -> list[Any]:
    joined: list[Any] = []
    for word in words:
        joined += [TextSubstitution(text=" "), *word] if joined else word
    return joined


EXPOSED: dict[str, Callable[..., Any]] = {"eval": _expression}
"""Functions that create substitutions, by tag: for `$(eval …)` and for users' own tags."""


def parse_substitution(value: Any) -> list[Any]:
    """Parse a text that may contain `$(…)` into a list of substitutions."""
    return parsed(value, "a text") or [TextSubstitution(text="")]


def parse_if_substitutions(value: Any) -> Any:
    """Parse a text that contains `$(` into a list of substitutions; return other values unchanged.

    In a list, each text is parsed separately.
    """
    if isinstance(value, list):
        return [parse_if_substitutions(one) for one in value]
    return parse_substitution(value) if isinstance(value, str) and "$(" in value else value


def expose_substitution(name: str) -> Callable[[T], T]:
    """Return a decorator that registers a class or function as the parser of `$(name …)`."""

    def expose(exposed: T) -> T:
        is_method = isinstance(exposed, type) and hasattr(exposed, "parse")
        read: Any = exposed.parse if is_method else exposed  # type: ignore[attr-defined]
        if isinstance(read, type) or not callable(read):
            named = getattr(exposed, "__name__", repr(exposed))
            raise RuntimeError(f"'{named}' is neither a function nor a class with a method parse")

        def make(*words: Any) -> Any:
            kind, settings = read(list(words))
            return kind(**settings)

        EXPOSED[name] = make
        return exposed

    return expose
