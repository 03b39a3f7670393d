"""Import of native (C) modules, and allocation of memory in large pages.

Native modules are built with the package if there is a C compiler. Without native modules,
everything runs in plain Python with equal results. `TFTOOL_PURE=1` switches the native modules off.
"""

import mmap
import os
from importlib import import_module
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from types import ModuleType


SWITCH = "TFTOOL_PURE"
"""Environment variable that switches the native modules off, unless it is empty or 0."""


def built(name: str, interface: int) -> "ModuleType | None":
    """Import a native module; return None if the module is not built, or `TFTOOL_PURE` is set.

    Args:
        name: Full name of the module.
        interface: Expected interface version. For a module with another version, None is returned.
    """
    if os.environ.get(SWITCH, "") not in ("", "0"):
        return None
    try:
        found = import_module(name)
    except ImportError:
        return None
    return found if interface == found.INTERFACE else None


PAGE: Final = 1 << 21
"""Size of a large page, bytes."""

_HUGE: Final = getattr(mmap, "MADV_HUGEPAGE", None)


def large_pages(size: int, end: int) -> "mmap.mmap | None":
    """Allocate memory that begins with large pages of 2 MB; return None if not supported.

    Args:
        size: Minimum number of bytes, rounded up to a whole page. Bytes that are never written
            occupy no memory.
        end: Offset in bytes up to which large pages are requested; later pages have the usual
            size.
    """
    if _HUGE is None:
        return None
    try:
        # Recent kernels align memory of this length to a large page.
        pages = mmap.mmap(-1, size + PAGE - 1 & -PAGE, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
        pages.madvise(_HUGE, 0, end)
    except OSError:
        # The kernel has no large pages, or not enough addresses.
        return None
    return pages
