"""Sentences about names and modules of ROS 2 that are not provided."""

import inspect
from collections.abc import Iterable, Sequence
from typing import Any

from tftool.base.near_names import did_you_mean, near_names
from tftool.messages.classes import INTERFACES
from tftool.ros.host import import_table

FEW = 12
"""How many names a sentence lists; more would hide what it says."""

WHERE_TO_LOOK = (
    "the page 'What of ROS is covered' in tftool's docs lists what runs without ROS; "
    "with a sourced ROS 2 the real module is used"
)

DEFINED = (
    "an interface is known by its definition: put the .msg, .srv or .action file into its "
    "package in the workspace's src"
)


def missing_name(module: str, name: str, known: Sequence[str]) -> str:
    """Return a sentence about a name that one of our modules lacks.

    Args:
        module: The module.
        name: The name that was asked for.
        known: The names it has.
    """
    # Only what may be a slip: another name of ROS 2's is none.
    near = near_names(name, known, alike=0.8)
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
        hint = f"{_listed(module, known)}."
    remedy = DEFINED if package in INTERFACES.packages() else WHERE_TO_LOOK
    return f"'{name}' of {module} is not covered{hint} {_sentence(remedy)}"


def undeclared(parameter: str, known: Iterable[str]) -> str:
    """Return a sentence about a parameter that was given but not declared."""
    hint = did_you_mean(parameter, known)
    return f"parameter '{parameter}' was given, but the node declares none of that name{hint}"


def near_keyword(keyword: str, called: Any) -> str:
    """Return the end of a sentence about an unknown keyword of a function or class."""
    kinds = getattr(called, "__mro__", None)
    known: set[str] = set()
    for function in [called] if kinds is None else [vars(one).get("__init__") for one in kinds]:
        try:
            known |= set(inspect.signature(function).parameters)
        except (TypeError, ValueError):
            continue  # One in C, or none.
    return did_you_mean(keyword, known - {"self", "args", "kwargs"})


def missing_module(name: str) -> str:
    """Return a sentence about a missing module of a package that we provide."""
    package = name.partition(".")[0]
    known = sorted(one for one in import_table.table() if one.startswith(f"{package}."))
    near = near_names(name, known, alike=0.8)
    hint = f"; did you mean '{near[0]}'?" if near else f"{_listed(package, known)}."
    return f"{name} is not covered{hint} {_sentence(WHERE_TO_LOOK)}"


def missing_package(name: str) -> str:
    """Return a sentence about a package that is neither installed nor provided."""
    packages = sorted(
        {one.partition(".")[0] for one in import_table.table()} | set(INTERFACES.packages())
    )
    near = near_names(name, packages, alike=0.8)
    if near:
        return f"did you mean '{near[0]}'?"
    if name.endswith(("_msgs", "_srvs", "_interfaces", "_actions")):
        return (
            f"the definitions of {name} are not among tftool's: put the package with its .msg, "
            ".srv and .action files into the workspace's src"
        )
    return (
        "it is not installed in the Python that runs tftool, and of ROS 2 tftool answers to "
        f"{', '.join(one for one in packages if one not in INTERFACES.packages())} and "
        "interface packages"
    )


def _listed(module: str, known: Sequence[str]) -> str:
    if not known:
        return ""
    return f": {module} has {', '.join(known)} here" if len(known) <= FEW else ""


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}"
