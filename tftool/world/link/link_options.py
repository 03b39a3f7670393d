"""Options of a process in a session, whatever the middleware."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Final

from tftool.base.errors import UsageError
from tftool.world.link.reach import Reach

LARGEST_DOMAIN = 232
"""ROS 2's own limit."""

MIDDLEWARES: Final = (
    "tftool.world.link.zenoh.reach:ZenohReach",
    "tftool.world.link.dds.reach:DdsReach",
    "tftool.world.link.foxglove.reach:FoxgloveReach",
)
"""What each middleware declares; the first one carries what no option says otherwise."""


def _declared(place: str) -> type[Reach]:
    module, _, name = place.partition(":")
    found: type[Reach] = getattr(import_module(module), name)
    return found


REACHES: Final = tuple(_declared(place) for place in MIDDLEWARES)


def read_reach(given: Mapping[str, Any]) -> Reach:
    """Return a link's reach from options.

    Args:
        given: The values of the middlewares' options, by the names of their parameters.

    Raises:
        UsageError: If options contradict each other.
        InputError: If a file is missing, or not of the stated kind.
        TypeError: If an option is none of theirs.
    """
    unknown = [name for name in given if not any(name in one.OPTIONS for one in REACHES)]
    if unknown:
        raise TypeError(f"no middleware has an option '{unknown[0]}'")
    asked = [one for one in REACHES if any(given.get(name) for name in one.OPTIONS)]
    if len(asked) > 1:
        raise UsageError(asked[-1].ALONE)
    return (asked or REACHES)[0].read(given)


def reach_at(word: str) -> Reach | None:
    """Return the reach to a session by its address; None for other words.

    Raises:
        UsageError: If the address is malformed.
    """
    found = (one.at(word) for one in REACHES)
    return next((one for one in found if one is not None), None)


@dataclass(frozen=True, slots=True)
class Options:
    """Options of a process in a session.

    Attributes:
        command: Command: "demo", "echo".
        domain: Number of the ROS domain.
        reach: Middleware, and reach beyond this machine's own processes.
        read_only: Only look: declare no publisher, no service and no token.
    """

    command: str = "tftool"
    domain: int = 0
    reach: Reach = field(default_factory=REACHES[0])
    read_only: bool = False


def domain_here() -> int:
    """Return the domain in ROS_DOMAIN_ID, else 0.

    Raises:
        UsageError: If the number is not a domain.
    """
    text = os.environ.get("ROS_DOMAIN_ID", "")
    if not text:
        return 0
    if not (text.isascii() and text.isdigit() and int(text[:9]) <= LARGEST_DOMAIN):
        raise UsageError(f"ROS_DOMAIN_ID is '{text}', not a number from 0 to {LARGEST_DOMAIN}.")
    return int(text)
