"""Compression of a recording's pieces; see `recordings/decompression.py`."""

import bz2
from collections.abc import Callable
from typing import Final

from tftool.base.errors import UsageError
from tftool.recordings.decompression import lz4_frame, zstandard

ZSTD_LEVEL: Final = 1
"""Higher levels cost a recorder more than they save on its disk."""


def compressor(method: str) -> Callable[[bytes], bytes]:
    """Return the compressor of a method: "", "none", "zstd", "lz4" or "bz2".

    Raises:
        UsageError: If there is no such method, or its package is not installed.
    """
    if method in ("", "none"):
        return bytes
    if method == "bz2":
        return bz2.compress
    if method == "zstd":
        packed: Callable[[bytes], bytes] = zstandard().ZstdCompressor(level=ZSTD_LEVEL).compress
        return packed
    if method == "lz4":
        frame = lz4_frame()
        # ROS 1 reads frames of independent blocks alone, without their size in front.
        return lambda piece: bytes(
            frame.compress(piece, block_linked=False, content_checksum=True, store_size=False)
        )
    raise UsageError(f"'{method}' is an unknown compression: none, zstd, lz4 and bz2 are known.")


def best_compression() -> str:
    """Return the compression of a new MCAP file: zstd where installed."""
    try:
        zstandard()
    except UsageError:
        return "none"
    return "zstd"
