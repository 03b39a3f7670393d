"""Memory limit for a live world's transforms; beyond it the oldest are dropped.

Like tf2's, a buffer prunes only by time: a publisher at a very high rate, or with stamps a
nanosecond apart, could fill the memory of every subscriber. Recordings are not limited here: they
end.
"""

import os
from collections.abc import Callable, Mapping
from typing import Final

from tftool.base.errors import UsageError
from tftool.buffer.buffer import Buffer

MAX_BYTES: Final = 512 << 20
"""About eight million samples: 800 links at 1000 Hz for 10 s."""

VARIABLE: Final = "TFTOOL_BUFFER_MB"
"""The environment variable that says otherwise, in megabytes."""

EVERY: Final = 16_384
"""After how many samples it is looked again: a megabyte of them."""

Say = Callable[[str], object]
"""Called with a sentence about dropped samples."""


def allowed(environment: Mapping[str, str] = os.environ) -> int:
    """Return the number of bytes for samples: from the environment, else `MAX_BYTES`.

    Raises:
        UsageError: If the environment names no number of megabytes.
    """
    given = environment.get(VARIABLE, "")
    if not given:
        return MAX_BYTES
    megabytes = int(given) if given.isdecimal() and len(given) < 10 else 0
    if not megabytes:
        raise UsageError(
            f"{VARIABLE}={given[:40]!r} is no number of megabytes: set it to {MAX_BYTES >> 20}, "
            "or unset it."
        )
    return megabytes << 20


class MemoryBound:
    """Keeps the samples of a live buffer within a memory limit.

    Attributes:
        limit: Largest number of bytes.
    """

    __slots__ = ("_buffer", "_said", "_say", "_unseen", "limit")

    def __init__(self, buffer: Buffer, say: Say, limit: int) -> None:
        """Watch a buffer; `say` is called once for each frame whose history is shortened."""
        self.limit = limit
        self._buffer = buffer
        self._say = say
        self._unseen = 0
        self._said: set[str] = set()

    def note(self, samples: int) -> None:
        """Count `samples` more; now and then check the memory that all of them use."""
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
                f"{cut.kept} are kept. Have them sent less often, or allow more: {VARIABLE}=…"
            )
