"""The native scan of recorded messages, where it was built; see `tftool.frames.native`."""

import os
from typing import TYPE_CHECKING, Any, Final

from tftool.frames.native import SWITCH

if TYPE_CHECKING:
    from types import ModuleType

_INTERFACE = 2
"""What these modules expect of a scan; one that was built for others is left alone."""


def _scan() -> "ModuleType | None":
    if os.environ.get(SWITCH, "") not in ("", "0"):
        return None
    try:
        from tftool.wire import _scan
    except ImportError:
        return None
    return _scan if _scan.INTERFACE == _INTERFACE else None


SCAN: Final[Any] = _scan()
"""The module; None where it is not used."""
