"""Parser of texts in XML and YAML launch files: `$(var name)`, `$(find-pkg-share pkg)`, nested."""

from collections.abc import Callable, Iterable
from typing import Any

from tftool.base.errors import InputError
from tftool.base.near_names import near_names
from tftool.ros.launch import logic, substitutions
from tftool.ros.launch.elements import DEEPEST
from tftool.ros.launch.substitutions import TextSubstitution


def parsed(text: Any, where: str) -> list[Any]:
    """Parse a text with `$(…)` parts into substitutions.

    Raises:
        InputError: If a part is not closed or not known, or there are too many.
    """
    if str(text).count("$(") > DEEPEST:
        raise InputError(f"{where}: one text can have at most {DEEPEST} '$(…)'")
    parts, rest = _parse(str(text), 0, where, closing=False)
    if rest != len(str(text)):
        raise InputError(f"{where}: '{text}' has one ')' too many")
    return parts


class _Quoted(list[Any]):
    """A quoted word."""


_ESCAPED = tuple("$()'\"\\")
"""What a backslash before it makes an ordinary character."""


def _end_of_quote(text: str, start: int) -> int:
    """Return the end of the quote that begins at `start`; -1 if there is none."""
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
    """Parse one `$(name argument argument)`, after its bracket."""
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
        raise InputError(f"{where}: '$()' in '{text}' names nothing")
    name = words[0][0].text
    make = SUBSTITUTIONS.get(name)
    if make is None:
        near = near_names(name, SUBSTITUTIONS)
        hint = f"; did you mean '$({near[0]} …)'?" if near else ""
        raise InputError(f"{where}: '$({name} …)' is not known{hint}")
    try:
        return make(*words[1:]), at + 1
    except TypeError:
        raise InputError(f"{where}: '$({name} …)' has the wrong number of words") from None


SUBSTITUTIONS: dict[str, Callable[..., Any]] = {
    "var": lambda name, default=None: substitutions.LaunchConfiguration(name, default=default),
    "env": lambda name, default=None: substitutions.EnvironmentVariable(
        name, default_value=default
    ),
    "find-pkg-share": substitutions.FindPackageShare,
    "find-pkg-prefix": substitutions.FindPackageShare,
    "dirname": substitutions.ThisLaunchFileDir,
    "filename": substitutions.ThisLaunchFile,
    "log_dir": substitutions.LaunchLogDir,
    "launch_log_dir": substitutions.LaunchLogDir,
    "eval": lambda *words: _expression(words),
    "command": lambda command, on_stderr="fail": substitutions.Command(
        command, on_stderr=on_stderr
    ),
    "file-content": substitutions.FileContent,
    "exec-in-pkg": substitutions.ExecutableInPackage,
    "anon": substitutions.AnonName,
    "not": logic.NotSubstitution,
    "and": logic.AndSubstitution,
    "or": logic.OrSubstitution,
    "equals": logic.EqualsSubstitution,
    "not-equals": logic.NotEqualsSubstitution,
    "any": lambda *words: logic.AnySubstitution(*words),
    "all": lambda *words: logic.AllSubstitution(*words),
    "if": logic.IfElseSubstitution,
    "find-exec": lambda name: substitutions.FindExecutable(name=name),
}


def _expression(words: tuple[list[Any], ...]) -> substitutions.PythonExpression:
    """Return `$(eval …)`: an expression; of two in quotes, the second lists modules."""
    if len(words) == 2 and all(isinstance(word, _Quoted) for word in words):
        plain = "".join(part.text for part in words[1] if isinstance(part, TextSubstitution))
        modules = [name.strip() for name in plain.split(",") if name.strip()]
        return substitutions.PythonExpression(words[0], modules)
    return substitutions.PythonExpression(_spaced(words))


def _spaced(words: Iterable[list[Any]]) -> list[Any]:
    joined: list[Any] = []
    for word in words:
        joined += [TextSubstitution(text=" "), *word] if joined else word
    return joined
