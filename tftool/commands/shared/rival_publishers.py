"""Notices about frames published by several nodes."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from tftool.base.escaping import visible
from tftool.base.short_numbers import count

if TYPE_CHECKING:
    from tftool.buffer.buffer import Buffer

MOST_TOLD = 3
"""Frames that are named; of more it is said how many there are."""


def rivalries(buffer: "Buffer", frames: Iterable[str]) -> list[str]:
    """Return a sentence for each frame that several nodes publish alternately."""
    told: list[str] = []
    more = 0
    for frame in frames:
        senders = buffer.rivals(frame)
        if not senders:
            continue
        if len(told) == MOST_TOLD:
            more += 1
            continue
        names = " and ".join(f"'{visible(sender)}'" for sender in senders)
        told.append(
            f"{visible(frame)} is broadcast by {len(senders)} nodes in turns, {names}: it jumps "
            "between what they say. One child frame should have one broadcaster."
        )
    if more:
        told.append(f"So {'is' if more == 1 else 'are'} {count(more, 'frame')} more.")
    return told
