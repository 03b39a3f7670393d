"""Import of the native modules, if built and not switched off.

Each is built with the package where there is a C compiler. Without it everything runs in plain
Python and means the same; `TFTOOL_PURE=1` has it so even where the kernel is there.
"""

import os
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

SWITCH = "TFTOOL_PURE"
"""The environment variable that has everything run in plain Python, if it is not empty or 0."""


def built(name: str, interface: int) -> "ModuleType | None":
    """Import a native module; return None if it is not built, or switched off.

    Args:
        name: Its full name.
        interface: Expected version; one that was built for others is left alone.
    """
    if os.environ.get(SWITCH, "") not in ("", "0"):
        return None
    try:
        found = import_module(name)
    except ImportError:
        return None
    return found if interface == found.INTERFACE else None
