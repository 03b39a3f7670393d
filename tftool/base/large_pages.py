"""Memory in large pages, for data that is read at random.

Memory from Python and numpy begins and ends anywhere, and can only partly be on large pages.
"""

import mmap
from typing import Final

PAGE: Final = 1 << 21
"""Bytes of a large page of memory."""

_HUGE: Final = getattr(mmap, "MADV_HUGEPAGE", None)


def large_pages(size: int, end: int) -> "mmap.mmap | None":
    """Allocate memory in large pages, rounded up to a whole page; None if unsupported.

    Args:
        size: How many bytes it has at least. Those that are never written cost nothing.
        end: First byte at which no large page may begin.
    """
    if _HUGE is None:
        return None
    try:
        # So long a piece recent kernels begin at a large page.
        pages = mmap.mmap(-1, size + PAGE - 1 & -PAGE, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
        pages.madvise(_HUGE, 0, end)
    except OSError:
        # A kernel without them, or not as many addresses.
        return None
    return pages
