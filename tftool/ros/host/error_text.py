"""Error texts for exceptions in users' programs, and for ROS names that tftool does not provide."""

import builtins
import inspect
import linecache
import re
import traceback
from collections.abc import Iterable, Sequence
from types import TracebackType
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.base.plain_text import did_you_mean, near_names
from tftool.messages.classes import INTERFACES
from tftool.ros.host import import_table
from tftool.ros.host.fibers import StuckError, user_line_of_error

FEW = 12
"""Largest number of names that a sentence lists, so that it stays readable."""

WHERE_TO_LOOK = (
    "the page 'Supported parts of ROS' in tftool's docs lists what runs without ROS; "
    "with a sourced ROS 2 the real module is used"
)

DEFINED = (
    "interfaces need a definition: put the .msg, .srv or .action file into its package in the "
    "workspace's src"
)


def missing_name(module: str, name: str, existing: Sequence[str]) -> str:
    """Return the error text for importing a name that tftool's version of a ROS module lacks."""
    # Propose only very similar names, because another name of ROS 2 is probably no misspelling.
    near = near_names(name, existing, alike=0.8)
    package = module.partition(".")[0]
    elsewhere = sorted(
        one
        for one, names in import_table.table().items()
        if one.partition(".")[0] == package and name in names and names[name].name == name
    )
    if near:
        hint = f"; did you mean '{near[0]}'?"
    elif elsewhere:
        hint = f"; {elsewhere[0]} has it."
    else:
        hint = f"{_listed(module, existing)}."
    remedy = DEFINED if package in INTERFACES.packages() else WHERE_TO_LOOK
    return f"'{name}' of {module} is not supported{hint} {_sentence(remedy)}"


def undeclared(parameter: str, declared: Iterable[str]) -> str:
    """Return the warning that a node was started with a parameter that it never declares."""
    hint = did_you_mean(parameter, declared)
    return f"parameter '{parameter}' was set, but the node declares no such parameter{hint}"


def near_keyword(keyword: str, callee: Any) -> str:
    """Return a hint "; did you mean …" with the parameter of `callee` most similar to `keyword`.

    Returns:
        The hint; "" if no parameter has a similar name.
    """
    kinds = getattr(callee, "__mro__", None)
    known: set[str] = set()
    for function in [callee] if kinds is None else [vars(one).get("__init__") for one in kinds]:
        try:
            known |= set(inspect.signature(function).parameters)
        except (TypeError, ValueError):
            continue  # A function in C, or none.
    return did_you_mean(keyword, known - {"self", "args", "kwargs"})


def missing_module(name: str) -> str:
    """Return the error text for importing a submodule that tftool's copy of a ROS package lacks."""
    package = name.partition(".")[0]
    known = sorted(one for one in import_table.table() if one.startswith(f"{package}."))
    near = near_names(name, known, alike=0.8)
    hint = f"; did you mean '{near[0]}'?" if near else f"{_listed(package, known)}."
    return f"{name} is not supported{hint} {_sentence(WHERE_TO_LOOK)}"


def missing_package(name: str, use: str = "") -> str:
    """Return advice for a failed import of a package that tftool does not provide.

    Args:
        name: Name of the package, such as "cv_bridge".
        use: Line of the user's code that imports the package.
    """
    packages = sorted(
        {one.partition(".")[0] for one in import_table.table()} | set(INTERFACES.packages())
    )
    near = near_names(name, packages, alike=0.8)
    hint = f"did you mean '{near[0]}'?" if near else ""
    is_imported = re.search(rf"\b{re.escape(name)}\.(msg|srv|action)\b", use) is not None
    if is_imported or name.endswith(("_msgs", "_srvs", "_interfaces", "_actions")):
        # Another package of ROS 2, such as nav2_msgs, may have a similar name.
        return (
            f"{hint and f'{hint} If not, '}tftool has no definitions of {name}: put "
            "the package with its .msg, .srv and .action files into the workspace's src"
        )
    if near:
        return hint
    return (
        "the package is not installed in the Python that runs tftool; of ROS 2, tftool provides "
        f"{', '.join(one for one in packages if one not in INTERFACES.packages())} and "
        "interface packages"
    )


def _listed(module: str, known: Sequence[str]) -> str:
    if not known:
        return ""
    return f": {module} has {', '.join(known)} here" if len(known) <= FEW else ""


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}"


def error_sentence(error: BaseException) -> str:
    """Return the error's text and, on a second line, the line of the user's code that raised it."""
    if isinstance(error, SyntaxError):
        return syntax_sentence(error)
    if isinstance(error, InputError | UsageError | StuckError):
        return str(error)
    what = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    place = user_line_of_error(error.__traceback__)
    if isinstance(error, ModuleNotFoundError) and error.name and str(error).endswith("'"):
        # The error text is Python's own, which ends with the quoted name.
        line = place.text if place is not None else ""
        what += f"; {missing_package(error.name.partition('.')[0], line)}"
    what += _near_name(error)
    return what if place is None else f"{what}\n    {place}"


_SET_BY_ROS = [("AMENT_PREFIX_PATH",), ("COLCON_PREFIX_PATH",)]
_UNEXPECTED = re.compile(r"([\w.]+)\(\) got an unexpected keyword argument '(\w+)'")
_MISSING = re.compile(r"missing 1 required (?:keyword-only|positional) argument: '(\w+)'")
_KEYWORD = re.compile(r"\b(\w+)\s*=(?!=)")


def _keywords_of_call(trace: TracebackType | None) -> list[str]:
    """Return the names of the keyword arguments in the source lines of the call that failed."""
    last = traceback.extract_tb(trace)[-1]
    # Before Python 3.11 only the first line of the call is known.
    first = last.lineno or 0
    end = getattr(last, "end_lineno", None) or first
    lines = [linecache.getline(last.filename, number) for number in range(first, end + 1)]
    return _KEYWORD.findall("".join(lines))


def _near_name(error: BaseException) -> str:
    """Return a hint "; did you mean …" if Python reports a name, attribute or keyword as unknown.

    Return "" for other errors, and if no similar name exists where the error occurred.
    """
    frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
    if not frames or "did you mean" in str(error):
        return ""
    if isinstance(error, KeyError) and error.args in _SET_BY_ROS:
        return "; a setup file of ROS 2 sets this variable: set it yourself"
    if isinstance(error, AttributeError) and isinstance(error.name, str):
        return did_you_mean(error.name, dir(error.obj)) if error.obj is not None else ""
    # Python refuses a call in the calling frame, where the function's name is defined.
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
    """Return a syntax error's position, and the source line with a caret below it."""
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
