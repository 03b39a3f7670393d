"""Memory in large pages (usually 2 MiB), which makes random reads faster.

Memory from Python or numpy begins at any address, so that only its middle can be in large pages.
"""

import mmap
from typing import Final

PAGE: Final = 1 << 21
"""Size of a large page, bytes."""

_HUGE: Final = getattr(mmap, "MADV_HUGEPAGE", None)


def large_pages(size: int, end: int) -> "mmap.mmap | None":
    """Allocate memory in large pages; None if the system does not support it.

    Args:
        size: Minimum number of bytes, rounded up to a whole page. Bytes that are never written
            occupy no memory.
        end: Offset, bytes, from which on ordinary pages are requested.
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
