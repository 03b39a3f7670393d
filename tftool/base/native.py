"""Import of the native (C) modules, if they were built and are not switched off.

Native modules are built with the package if there is a C compiler. Without them everything runs in
plain Python with equal results. `TFTOOL_PURE=1` switches them off.
"""

import os
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

SWITCH = "TFTOOL_PURE"
"""Environment variable that switches the native modules off, unless it is empty or 0."""


def built(name: str, interface: int) -> "ModuleType | None":
    """Import a native module; return None if it is not built, or switched off.

    Args:
        name: Full name of the module.
        interface: Expected interface version; a module with another version is not used.
    """
    if os.environ.get(SWITCH, "") not in ("", "0"):
        return None
    try:
        found = import_module(name)
    except ImportError:
        return None
    return found if interface == found.INTERFACE else None
