"""The native kernel, where it was built: one C file that does what the plain modules say.

It is built with the package where there is a C compiler. Without it everything runs in plain
Python and means the same; `TFTOOL_PURE=1` has it so even where the kernel is there.
"""

import os
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from types import ModuleType

SWITCH = "TFTOOL_PURE"
"""The environment variable that has everything run in plain Python, if it is not empty or 0."""

_INTERFACE = 1
"""What these modules expect of a kernel; one that was built for others is left alone."""


def _kernel() -> "ModuleType | None":
    if os.environ.get(SWITCH, "") not in ("", "0"):
        return None
    try:
        from tftool.frames import _kernel
    except ImportError:
        return None
    return _kernel if _kernel.INTERFACE == _INTERFACE else None


_found = _kernel()

IS_NATIVE: Final[bool] = _found is not None
"""Whether the kernel is used."""

BUILD: Final = "native" if IS_NATIVE else "pure Python"
"""What `tftool --version` says."""
