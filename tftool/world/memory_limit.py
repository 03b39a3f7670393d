"""Limit on the memory for a live world's transforms, kept by dropping the oldest samples.

A buffer, like tf2's, drops samples only by age. So a publisher with a very high rate, or with
stamps a nanosecond apart, could fill the memory of every subscriber. Buffers of recordings have no
limit, because a recording has an end.
"""

import os
from collections.abc import Callable, Mapping
from typing import Final

from tftool.base.errors import UsageError
from tftool.buffer.buffer import Buffer

MAX_BYTES: Final = 512 << 20
"""Default limit in bytes, about eight million samples: 800 edges at 1000 Hz for 10 s."""

VARIABLE: Final = "TFTOOL_BUFFER_MB"
"""Environment variable with another limit, in megabytes."""

EVERY: Final = 16_384
"""Number of new samples, about a megabyte, after which the memory is checked again."""

Say = Callable[[str], object]
"""Function called with a sentence about dropped samples."""


def allowed(environment: Mapping[str, str] = os.environ) -> int:
    """Return the memory limit in bytes: from the variable TFTOOL_BUFFER_MB, else `MAX_BYTES`.

    Raises:
        UsageError: If the variable's value is not a number of megabytes.
    """
    given = environment.get(VARIABLE, "")
    if not given:
        return MAX_BYTES
    megabytes = int(given) if given.isdecimal() and len(given) < 10 else 0
    if not megabytes:
        raise UsageError(
            f"{VARIABLE}={given[:40]!r} is not a number of megabytes: set it to "
            f"{MAX_BYTES >> 20}, or unset it."
        )
    return megabytes << 20


class MemoryBound:
    """Limit that keeps a live buffer's samples within a number of bytes.

    Attributes:
        limit: Largest number of bytes.
    """

    __slots__ = ("_buffer", "_said", "_say", "_unseen", "limit")

    def __init__(self, buffer: Buffer, say: Say, limit: int) -> None:
        """Limit a buffer; call `say` once for each frame that loses samples."""
        self.limit = limit
        self._buffer = buffer
        self._say = say
        self._unseen = 0
        self._said: set[str] = set()

    def note(self, samples: int) -> None:
        """Count new samples; after many samples, check how much memory all samples use."""
        self._unseen += samples
        if self._unseen >= EVERY:
            self._unseen = 0
            self._look()

    def _look(self) -> None:
        for cut in self._buffer.shorten(self.limit):
            if cut.child in self._said:
                continue
            self._said.add(cut.child)
            self._say(
                f"'{cut.child}' from '{cut.authority}' had {cut.samples} samples in memory, and "
                f"the transforms of a session may take {self.limit >> 20} MB: only the newest "
                f"{cut.kept} are kept. Lower the publishing rate, or raise the limit: {VARIABLE}=…"
            )
