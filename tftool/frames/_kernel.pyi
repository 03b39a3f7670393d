"""What the native kernel offers; each function says what it is the twin of."""

from collections.abc import Mapping
from typing import Any

from tftool.frames.sample import TransformStamped

INTERFACE: int

class Fields:
    """The fields of a link, laid out so that the kernel can read them: see `history`."""

def lookup(
    paths: Mapping[str, Mapping[str, Any]], target: str, source: str, time: object, /
) -> TransformStamped | None:
    """The answer of `Buffer.lookup_transform` by a known path; None if it is not plain."""

def at(link: object, time: int, /) -> tuple[float, float, float, float, float, float, float] | None:
    """`History.at`; None if it is not plain."""

def insert(senders: Mapping[str, Any], transform: object, authority: str, /) -> bool:
    """`Buffer.set_transform` of a plain sample; False, and nothing was done, if it is not."""

def solve(
    up: tuple[Any, ...],
    down: tuple[Any, ...],
    times: object,
    translations: object,
    rotations: object,
    valid: object,
    /,
) -> int:
    """Poses of a path at many moments; how many rows have none."""
