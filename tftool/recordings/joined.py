"""Several files read as one recording: parts of a split one, a folder, a glob."""

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch
from tftool.recordings.container import MOST_STREAMS, Container
from tftool.recordings.contract import Progress


class Joined:
    """Containers in sequence; see `Container`."""

    def __init__(self, parts: Sequence[tuple[str, Container]], damage: Sequence[str] = ()) -> None:
        """Join containers.

        Args:
            parts: Each with its name.
            damage: Further damage to report.
        """
        self._parts = parts
        self._damage = list(damage)
        containers = [part for _, part in parts]
        kinds = list(dict.fromkeys(part.kind for part in containers))
        self.kind = f"{' and '.join(kinds)}, {len(parts)} files"
        self.size = sum(part.size for part in containers)
        self.start = min((part.start for part in containers if part.start), default=0)
        self.end = max((part.end for part in containers), default=0)
        numbers: dict[Channel, int] = {}
        self._maps = []
        for part in containers:
            for stream in part.streams:
                if len(numbers) < MOST_STREAMS:
                    numbers.setdefault(stream, len(numbers))
            found = [numbers.get(stream, -1) for stream in part.streams]
            self._maps.append(np.array(found, dtype=np.int32))
        self.streams = list(numbers)

    @property
    def counts(self) -> list[int]:
        """Return the number of messages per stream."""
        found = [0] * len(self.streams)
        for (_, part), numbers in zip(self._parts, self._maps, strict=True):
            for number, count in zip(numbers.tolist(), part.counts, strict=True):
                if number >= 0:
                    found[number] += count
        return found

    @property
    def damage(self) -> list[str]:
        """Return the damage with the names of the files."""
        return [
            *self._damage,
            *(f"{name}: {damage}" for name, part in self._parts for damage in part.damage),
        ]

    def expected(self, wanted: Collection[int]) -> int:
        """Return 0: unknown before every part is read."""
        return 0

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield the messages of some streams, file after file; see `Container`."""
        before = 0
        for (_, part), numbers in zip(self._parts, self._maps, strict=True):
            chosen = {n for n, number in enumerate(numbers.tolist()) if number in wanted}
            for batch in part.batches(chosen, _moved(progress, before, self.size), head):
                yield Batch(
                    batch.buffer,
                    batch.starts,
                    batch.lengths,
                    batch.log_times,
                    numbers[batch.senders],
                )
            before += part.size

    def close(self) -> None:
        """Close all files."""
        for _, part in self._parts:
            part.close()


def _moved(progress: Progress | None, before: int, size: int) -> Progress | None:
    """Convert a part's progress to that of the whole."""
    if progress is None:
        return None

    def told(done: int, total: int) -> None:
        progress(before + done, size)

    return told
