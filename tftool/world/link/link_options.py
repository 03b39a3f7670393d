"""Options of a process in a session, for any middleware."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Final

from tftool.base.errors import UsageError
from tftool.world.link.reach import Reach

LARGEST_DOMAIN = 232
"""Largest domain number of ROS 2."""

MIDDLEWARES: Final = (
    "tftool.world.link.zenoh.reach:ZenohReach",
    "tftool.world.link.dds.reach:DdsReach",
    "tftool.world.link.foxglove.reach:FoxgloveReach",
)
"""Declaration (`Reach`) of each middleware; the first one is the default."""


def _declared(place: str) -> type[Reach]:
    module, _, name = place.partition(":")
    found: type[Reach] = getattr(import_module(module), name)
    return found


REACHES: Final = tuple(_declared(place) for place in MIDDLEWARES)

_OWNERS: Final = {name: one for one in REACHES for name in one.OPTIONS}


REACH_OPTIONS: Final = frozenset(_OWNERS)
"""Names of the parameters of all middlewares' options."""


def read_reach(given: Mapping[str, Any]) -> Reach:
    """Create the `Reach` (networks that this process may use) from the given options.

    Args:
        given: Values of the middlewares' options, by the names of their parameters.

    Raises:
        UsageError: If options contradict each other.
        InputError: If a file that an option names is missing, or of the wrong kind.
        TypeError: If no middleware has such an option.
    """
    asked: set[type[Reach]] = set()
    for name, value in given.items():
        if name not in _OWNERS:
            raise TypeError(f"no middleware has an option '{name}'")
        if value:
            asked.add(_OWNERS[name])
    if len(asked) > 1:
        raise UsageError(max(asked, key=REACHES.index).ALONE)
    return asked.pop().read(given) if asked else REACHES[0]()


def reach_at(word: str) -> Reach | None:
    """Return the `Reach` of the session at an address; None for a word that is not an address.

    Raises:
        UsageError: If the address is malformed.
    """
    for one in REACHES:
        if word.lower().startswith(one.SCHEMES):
            return one.at(word)
    return None


@dataclass(frozen=True, slots=True)
class Options:
    """Options of a process in a session.

    Attributes:
        command: Name of the command, such as "demo" or "echo".
        domain: Number of the ROS domain.
        reach: Middleware to use, and the networks that it may use.
        read_only: Whether to announce no node, publisher or service.
    """

    command: str = "tftool"
    domain: int = 0
    reach: Reach = field(default_factory=REACHES[0])
    read_only: bool = False


def domain_here() -> int:
    """Return the domain in the variable ROS_DOMAIN_ID; 0 if the variable is not set.

    Raises:
        UsageError: If the variable's value is not the number of a domain.
    """
    text = os.environ.get("ROS_DOMAIN_ID", "")
    if not text:
        return 0
    if not (text.isascii() and text.isdigit() and int(text[:9]) <= LARGEST_DOMAIN):
        raise UsageError(f"ROS_DOMAIN_ID is '{text}', not a number from 0 to {LARGEST_DOMAIN}.")
    return int(text)
