"""Order and times in which `tftool play` publishes the transforms of a recording."""

from collections import Counter
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import SIMULATED_BELOW, Stamp
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.recordings.container_reader import Recorded
from tftool.recordings.contract import Edge, Indexes, Stamps, Transforms

_NOTHING: Final = np.zeros(0, dtype=np.int64)


def through_clock(logs: Stamps, read: Stamps, received: Stamps) -> Stamps:
    """Convert log times to the time of `/clock`, interpolated between messages on `/clock`.

    Before the first and after the last message the clock is assumed to run at rate 1.

    Args:
        logs: Log times to convert, nanoseconds.
        read: Times in the messages on `/clock`, nanoseconds.
        received: Log times of these messages, nanoseconds.
    """
    base_log, base = int(received[0]), int(read[0])
    order = np.argsort(received, kind="stable")
    at = (received[order] - base_log).astype(np.float64)
    shown = (read[order] - base).astype(np.float64)
    asked = (logs - base_log).astype(np.float64)
    mapped = np.interp(asked, at, shown)
    mapped += np.minimum(asked - at[0], 0.0) + np.maximum(asked - at[-1], 0.0)
    return np.rint(mapped).astype(np.int64) + base


class PlayClock:
    """Conversion of log times to the clock of the stamps, which playback publishes on `/clock`.

    If `/clock` was recorded, its messages give the conversion. If not, and only the stamps are
    simulation times, the median difference of log time and stamp is subtracted. In all other cases
    log times are used unchanged.
    """

    def __init__(self, transforms: Transforms, read: Stamps, received: Stamps) -> None:
        """Compare stamps with log times, to choose how log times are converted to stamps.

        Args:
            transforms: All transforms of the recording.
            read: Times in the messages on `/clock`, nanoseconds.
            received: Log times of these messages, nanoseconds.
        """
        self._read, self._received = read, received
        self._offset = 0
        later = [
            transforms.log_times_of(edge)[chosen] - edge.stamps[chosen]
            for edge in transforms.edges
            if not edge.static
            for chosen in [(edge.stamps > 0) & (edge.stamps < SIMULATED_BELOW)]
        ]
        moving = sum(len(edge) for edge in transforms.edges if not edge.static)
        simulated = np.concatenate(later) if later else _NOTHING
        logs = transforms.log_times
        is_wall = len(logs) > 0 and int(np.median(logs)) >= SIMULATED_BELOW
        self._is_other = is_wall and len(simulated) * 2 > moving
        if self._is_other:
            self._offset = int(np.median(simulated))

    def of(self, log_times: Stamps) -> Stamps:
        """Convert log times to times on the clock of the stamps, nanoseconds, shape (n,)."""
        if not self._is_other:
            return log_times
        if len(self._read):
            return through_clock(log_times, self._read, self._received)
        return log_times - self._offset


@dataclass(frozen=True, slots=True)
class Due:
    """Transforms of one message, to be published at one time.

    Attributes:
        moment: Time to publish, on the clock of the stamps.
        node: Node that sent the message; empty if not recorded.
        topic: Topic of the message.
        static: Whether the transforms are static.
        transforms: The recorded transforms, with names without a leading slash.
    """

    moment: Stamp
    node: str
    topic: str
    static: bool
    transforms: tuple[TransformStamped, ...]


@dataclass(frozen=True, slots=True)
class TimelineRows:
    """Transforms of some messages, in order of reception.

    Attributes:
        edges: Number of the edge of each transform, shape (n,).
        rows: Row of each transform in the columns of its edge, shape (n,).
        places: Number of the message of each transform, shape (n,).
    """

    edges: Indexes
    rows: Indexes
    places: npt.NDArray[np.int64]


class Timeline:
    """A recording's transforms in order of reception.

    Attributes:
        clock: Conversion of log times to the clock of the stamps.
        start: Time of the first message, nanoseconds on the clock of the stamps.
        end: Time of the last message, nanoseconds on the clock of the stamps.
    """

    def __init__(self, source: Recorded, transforms: Transforms) -> None:
        """Sort the messages of a recording.

        Args:
            source: The recording.
            transforms: All transforms of the recording.
        """
        self.clock = PlayClock(transforms, *source.clock())
        self._transforms = transforms
        self._moments_read = self.clock.of(transforms.log_times)  # in the order of reading
        order = np.argsort(self._moments_read, kind="stable")
        self._order = order
        self.moments: Stamps = self._moments_read[order]
        rank = np.empty(len(order), dtype=np.int64)
        rank[order] = np.arange(len(order))
        edges = transforms.edges
        ranks = [rank[edge.messages] for edge in edges]
        by_message = np.concatenate(ranks) if ranks else _NOTHING
        numbers = np.repeat(np.arange(len(edges), dtype=np.int32), [len(edge) for edge in edges])
        rows = [np.arange(len(edge), dtype=np.int32) for edge in edges]
        sequence = np.argsort(by_message, kind="stable")
        self._edges: Indexes = numbers[sequence]
        self._rows: Indexes = np.concatenate(rows)[sequence] if rows else numbers
        self._firsts = np.searchsorted(by_message[sequence], np.arange(len(order) + 1))
        times = self.clock.of(np.array([source.start, source.end], dtype=np.int64))
        low, high = (int(one) for one in times)
        if len(self.moments):
            low, high = min(low, int(self.moments[0])), max(high, int(self.moments[-1]))
        self.start, self.end = low, high

    def __len__(self) -> int:
        return len(self.moments)

    @property
    def frames(self) -> frozenset[str]:
        """Names of all frames of the recording."""
        edges = self._transforms.edges
        return frozenset(name for edge in edges for name in (edge.parent, edge.child))

    def place(self, moment: Stamp, *, after: bool = False) -> int:
        """Return the number of the first message at or after `moment`.

        With `after`, a message exactly at `moment` does not count.
        """
        return int(np.searchsorted(self.moments, moment, side="right" if after else "left"))

    def is_plain(self) -> npt.NDArray[np.bool_]:
        """Return a mask of the messages that a buffer can receive in any order, shape (n,).

        Every frame in such a message is moving, and has only one publisher and one parent.
        """
        transforms = self._transforms
        edges_of = Counter(edge.child for edge in transforms.edges)
        odd = [
            edge.static or edges_of[edge.child] > 1 or bool(np.ptp(transforms.senders_of(edge)))
            for edge in transforms.edges
        ]
        plain = np.ones(len(self), dtype=np.bool_)
        plain[self.rows(0, len(self)).places[np.array(odd, dtype=np.bool_)[self._edges]]] = False
        return plain

    def arrivals_of(self, link: set[str]) -> tuple[Stamps, Stamps] | None:
        """Return arrival times and stamps of the transforms between two frames, both increasing.

        Args:
            link: The names of the two frames.

        Returns:
            Arrival times and stamps, nanoseconds, shape (n,) each; empty for a static link. None if
            a buffer could refuse or reorder some of the transforms, or if the child also has
            another parent or publisher.
        """
        edges = [edge for edge in self._transforms.edges if {edge.parent, edge.child} == link]
        known = [edge for edge in self._transforms.edges if edge.child in link]
        if len(edges) != 1 or sum(edge.child == edges[0].child for edge in known) != 1:
            return None
        edge = edges[0]
        if edge.static:
            return _NOTHING, _NOTHING
        moments = self._moments_read[edge.messages]
        is_ordered = edge.kept == len(edge) and bool(np.all(np.diff(moments) >= 0))
        return (moments, edge.stamps) if is_ordered else None

    def rows(self, first: int, last: int) -> "TimelineRows":
        """Return the transforms of the messages from `first` up to, not including, `last`."""
        begin, end = int(self._firsts[first]), int(self._firsts[last])
        counts = np.diff(self._firsts[first : last + 1])
        places = np.repeat(np.arange(first, last), counts)
        return TimelineRows(self._edges[begin:end], self._rows[begin:end], places)

    def edge(self, number: int) -> Edge:
        """Return an edge by its number in `TimelineRows`."""
        return self._transforms.edges[number]

    def senders(self, places: npt.NDArray[np.int64]) -> tuple[Indexes, tuple[str, ...]]:
        """Return the publisher of each message as an index, and the publishers' names by index.

        A publisher whose node is not recorded has the name of its topic.
        """
        publishers = [one.node or one.topic for one in self._transforms.publishers]
        names = tuple(dict.fromkeys(publishers))
        numbers = np.array([names.index(name) for name in publishers], dtype=np.int32)
        return numbers[self._transforms.senders[self._order[places]]], names

    def message(self, place: int) -> list[Due]:
        """Return the transforms in message number `place`: one `Due` per kind (moving, static)."""
        moment = int(self.moments[place])
        sender = self._transforms.senders[self._order[place]]
        publisher = self._transforms.publishers[int(sender)]
        kinds: dict[bool, list[TransformStamped]] = {}
        for position in range(int(self._firsts[place]), int(self._firsts[place + 1])):
            edge = self._transforms.edges[int(self._edges[position])]
            kinds.setdefault(edge.static, []).append(_sample(edge, int(self._rows[position])))
        return [
            Due(moment, publisher.node, publisher.topic, static, tuple(found))
            for static, found in kinds.items()
        ]

    def known_at(self, moment: Stamp) -> list[Due]:
        """Return every child's last transform that was received up to the time `moment`.

        Static transforms received later are included, because they are valid at all times.
        """
        found: dict[tuple[str, bool], tuple[int, int, Edge, int]] = {}
        for edge in self._transforms.edges:
            moments = self._moments_read[edge.messages]
            if not len(moments):
                continue
            there = moments <= moment
            if there.any():
                candidates = np.flatnonzero(there)
                best = int(candidates[len(candidates) - 1 - np.argmax(moments[there][::-1])])
                key = (1, int(moments[best]), edge, best)
            elif edge.static:
                best = int(np.argmin(moments))
                key = (0, -int(moments[best]), edge, best)
            else:
                continue
            before = found.get((edge.child, edge.static))
            if before is None or key[:2] >= before[:2]:
                found[edge.child, edge.static] = key
        by_sender: dict[tuple[str, str, bool], list[TransformStamped]] = {}
        for (_, static), (_, _, edge, row) in found.items():
            sender = int(self._transforms.senders[edge.messages[row]])
            publisher = self._transforms.publishers[sender]
            sent = publisher.node, publisher.topic, static
            by_sender.setdefault(sent, []).append(_sample(edge, row))
        return [Due(moment, *sent, tuple(samples)) for sent, samples in by_sender.items()]


def _sample(edge: Edge, row: int) -> TransformStamped:
    x, y, z = edge.translations[row].tolist()
    pose = Transform(Vector3(x, y, z), Quaternion(*edge.rotations[row].tolist()))
    return TransformStamped(int(edge.stamps[row]), edge.parent, edge.child, pose)
