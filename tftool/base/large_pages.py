"""Memory in large pages (usually 2 MiB), which makes random reads faster.

Python and numpy allocate memory at arbitrary addresses; the system can put only the whole large
pages within it on large pages.
"""

import mmap
from typing import Final

PAGE: Final = 1 << 21
"""Bytes of a large page of memory."""

_HUGE: Final = getattr(mmap, "MADV_HUGEPAGE", None)


def large_pages(size: int, end: int) -> "mmap.mmap | None":
    """Allocate memory in large pages, rounded up to a whole page; None if unsupported.

    Args:
        size: Minimum number of bytes. Bytes that are never written occupy no memory.
        end: Offset from which on no large page is requested, bytes.
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
