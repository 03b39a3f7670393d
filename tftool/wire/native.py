"""The native scan of recorded messages, where it was built; see `tftool.frames.native`."""

from typing import Any, Final

from tftool.frames.native import built

SCAN: Final[Any] = built("tftool.wire._scan", 4)
"""The module; None where it is not used."""
