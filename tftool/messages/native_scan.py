"""The native scanner of recorded messages, if it was built; see `tftool.base.native`."""

from typing import Any, Final

from tftool.base.native import built

SCAN: Final[Any] = built("tftool.messages._scan", 4)
"""The native module; None if it is not used."""
