"""Sentences about an exception from users' code."""

import linecache

from tftool.base.errors import InputError, UsageError
from tftool.ros.host.fibers import StuckError, user_line_of_error
from tftool.ros.host.missing_names import missing_package


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
    place = user_line_of_error(error.__traceback__)
    return what if place is None else f"{what}\n    {place}"


def syntax_sentence(error: SyntaxError) -> str:
    """Return the place of a syntax error, and the user's own line with a caret below it."""
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
