"""Sentences about an exception from users' code."""

import builtins
import linecache
import re
import traceback
from types import TracebackType

from tftool.base.errors import InputError, UsageError
from tftool.base.near_names import did_you_mean, near_names
from tftool.ros.host.fibers import StuckError, user_line_of_error
from tftool.ros.host.missing_names import missing_package, near_keyword


def error_sentence(error: BaseException) -> str:
    """Return the error in users' code: file, line, function, the line, the error."""
    if isinstance(error, SyntaxError):
        return syntax_sentence(error)
    if isinstance(error, InputError | UsageError | StuckError):
        return str(error)
    what = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    if isinstance(error, ModuleNotFoundError) and error.name and str(error).endswith("'"):
        # Python's own sentence, which ends after the name.
        what += f"; {missing_package(error.name.partition('.')[0])}"
    what += _near_name(error)
    place = user_line_of_error(error.__traceback__)
    return what if place is None else f"{what}\n    {place}"


_UNEXPECTED = re.compile(r"([\w.]+)\(\) got an unexpected keyword argument '(\w+)'")
_MISSING = re.compile(r"missing 1 required (?:keyword-only|positional) argument: '(\w+)'")
_KEYWORD = re.compile(r"\b(\w+)\s*=(?!=)")


def _keywords_of_call(trace: TracebackType | None) -> list[str]:
    """Return the keywords in the source of the call that failed."""
    last = traceback.extract_tb(trace)[-1]
    # Before Python 3.11 only the first line of the call is known.
    first = last.lineno or 0
    end = getattr(last, "end_lineno", None) or first
    lines = [linecache.getline(last.filename, number) for number in range(first, end + 1)]
    return _KEYWORD.findall("".join(lines))


def _near_name(error: BaseException) -> str:
    """Return the known name similar to a misspelt one, as the end of a sentence."""
    frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
    if not frames or "did you mean" in str(error):
        return ""
    if isinstance(error, AttributeError) and isinstance(error.name, str):
        return did_you_mean(error.name, dir(error.obj)) if error.obj is not None else ""
    # A call is refused in the frame that calls: the names are known there.
    names = {**vars(builtins), **frames[-1].f_globals, **frames[-1].f_locals}
    if isinstance(error, NameError) and isinstance(error.name, str):
        return did_you_mean(error.name, names)
    missing = _MISSING.search(str(error)) if isinstance(error, TypeError) else None
    if missing is not None:
        for word in _keywords_of_call(error.__traceback__):
            if near_names(word, [missing[1]]):
                return f"; did you mean '{missing[1]}' by '{word}'?"
    found = _UNEXPECTED.search(str(error)) if isinstance(error, TypeError) else None
    return "" if found is None else near_keyword(found[2], names.get(found[1].partition(".")[0]))


def syntax_sentence(error: SyntaxError) -> str:
    """Return the position of a syntax error, and the user's line with a caret below it."""
    where = f"{error.filename}:{error.lineno}:{error.offset}"
    sentence = f"{where}: {type(error).__name__}: {error.msg}"
    text = (error.text or "").rstrip("\n")
    if not text and error.filename and error.lineno:
        text = linecache.getline(error.filename, error.lineno).rstrip("\n")
    if not text:
        return sentence
    line = text.lstrip()
    column = max(0, (error.offset or 1) - 1 - (len(text) - len(line)))
    return f"{sentence}\n    {line}\n    {' ' * column}^"
