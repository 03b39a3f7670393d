"""Trace of a lookup: the buffer of an assumed listener, and the outcome at each edge."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property

import numpy as np

from tftool.base.common_ancestor import climbed, up_to_join
from tftool.base.errors import InputError
from tftool.base.plain_text import near_names
from tftool.base.stamps import LATEST, Duration, Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.doctor.findings import Edge
from tftool.doctor.model import Model, Settings
from tftool.doctor.stamp_stream import Heard, Track
from tftool.doctor.wording import is_ros1
from tftool.geometry.rigid import Transform
from tftool.recordings.contract import Stamps
from tftool.recordings.recording import MOST_FRAMES

MOST_SET = 200_000
"""Maximum number of samples of one link in the assumed buffer; the newest are used."""


class LinkVerdict(Enum):
    """Outcome of a lookup at one edge (link) of the path."""

    ANSWERS = "answers"
    FORWARD = "forward"
    BACKWARD = "backward"
    NO_DATA = "no-data"
    PRUNED = "pruned"


@dataclass(frozen=True, slots=True)
class TracedLink:
    """One edge (link) of a lookup's path, with the samples in the assumed listener's buffer.

    Attributes:
        parent: Parent frame.
        child: Child frame.
        is_static: Whether the edge is static.
        publisher: Publisher of the edge; None if unknown.
        count: Number of samples in the buffer.
        oldest: Stamp of the oldest sample in the buffer, or arrival time of a static edge; None
            without samples.
        newest: Stamp of the newest sample in the buffer, or arrival time of a static edge; None
            without samples.
        period: Median period, nanoseconds; 0 if unknown.
        latency: Median time from stamp to arrival, nanoseconds.
        verdict: Outcome of the lookup at this edge.
        short_by: Time from the lookup's time to the nearest sample, nanoseconds; 0 if the edge has
            data.
    """

    parent: str
    child: str
    is_static: bool
    publisher: str | None
    count: int
    oldest: Stamp | None
    newest: Stamp | None
    period: Duration
    latency: Duration
    verdict: LinkVerdict
    short_by: Duration = 0

    @property
    def edge(self) -> Edge:
        """Names of the parent and the child frame."""
        return self.parent, self.child

    @property
    def name(self) -> str:
        """Name of the edge for messages: "child in parent"."""
        return f"{self.child} in {self.parent}"


@dataclass(frozen=True, slots=True)
class Question:
    """A lookup, with the settings of the assumed listener that makes the lookup.

    Attributes:
        target: Target frame.
        source: Source frame.
        stamp: Time of the lookup; 0 for the latest.
        asked: Log time at which the lookup is made. None for the arrival of the message with the
            stamp `stamp` in the source frame; without such a message, `stamp` itself. For the
            latest time, None is the end of the data.
        settings: Settings of the listener.
        timeout: Timeout of the lookup, nanoseconds.
        topic: Topic of the message that needs the transform; empty for any topic.
    """

    target: str
    source: str
    stamp: Stamp = LATEST
    asked: Stamp | None = None
    settings: Settings = field(default_factory=Settings)
    timeout: Duration = 0
    topic: str = ""


def message_of(model: Model, topic: str, near: Stamp | None) -> tuple[Heard, Stamp]:
    """Find the message of a topic whose stamp is nearest to a time.

    Args:
        model: Model of the evidence.
        topic: Name of the topic.
        near: The time; None for the topic's first message.

    Returns:
        The stream with the message, and the message's stamp.

    Raises:
        InputError: If the topic has no message with a header.
    """
    heards = [heard for heard in model.heard if heard.topic == topic and len(heard.stamps)]
    if not heards:
        known = sorted({heard.topic for heard in model.heard})
        hint = near_names(topic, known) or known[:5]
        told = f" Topics with headers: {', '.join(hint)}." if hint else ""
        raise InputError(f"No message with a header was recorded on '{topic}'.{told}")
    if near is None:
        first = min(heards, key=lambda heard: int(heard.logs[0]))
        return first, int(first.stamps[0])
    found = [
        (abs(int(heard.stamps[place]) - near), number, int(heard.stamps[place]))
        for number, heard in enumerate(heards)
        for place in [int(np.argmin(np.abs(heard.stamps - near)))]
    ]
    _, number, stamp = min(found)
    return heards[number], stamp


class LookupTrace:
    """One lookup of an assumed listener, with the samples that its buffer has at that time."""

    def __init__(self, model: Model, question: Question) -> None:
        self.model = model
        self.question = question
        self.stamp = question.stamp
        self.moment = question.stamp
        self.cache = question.settings.cache_time
        self.heard = self._message()
        self.asked, self.because, self.after = self._asked()

    def _message(self) -> Heard | None:
        """Return the topic whose messages in the source frame need the lookup; None if unknown.

        This is the topic of the question, else the first topic with a message of the lookup's time.
        """
        for heard in self.model.heard:
            if heard.frame != self.question.source or not len(heard.stamps):
                continue
            if self.question.topic and heard.topic != self.question.topic:
                continue
            if self.question.topic or bool((heard.stamps == self.stamp).any()):
                return heard
        return None

    def _asked(self) -> tuple[Stamp, str, Duration | None]:
        if self.question.asked is not None:
            return self.question.asked + self.question.timeout, "", None
        if self.stamp == LATEST:
            return self.model.end + self.question.timeout, "at the end", None
        if self.heard is not None:
            places = np.flatnonzero(self.heard.stamps == self.stamp)
            if len(places):
                place = int(places[0])
                told = f"when the message on {self.heard.topic} with this stamp arrived"
                after = int(self.heard.latency[place])
                return int(self.heard.logs[place]) + self.question.timeout, told, after
        return self.model.log_of(self.stamp) + self.question.timeout, "at that moment", 0

    # Samples in the buffer

    def arrived(self, track: Track) -> "np.ndarray[tuple[int], np.dtype[np.intp]]":
        """Return the indices of an edge's usable samples that arrived before the lookup."""
        places: np.ndarray[tuple[int], np.dtype[np.intp]] = np.flatnonzero(
            track.usable & (track.logs <= self.asked)
        )
        return places

    def held(self, track: Track) -> Stamps:
        """Return the stamps of an edge's samples in the buffer when the lookup is made, sorted.

        These samples have arrived, and tf2 has not pruned them.
        """
        stamps = track.stamps[self.arrived(track)]
        if not track.static and len(stamps) > 1:
            # tf2 prunes before it inserts: by the newest stamp before the last sample.
            stamps = stamps[stamps >= self.newest_without_last(stamps) - self.cache]
        return np.sort(stamps)

    @staticmethod
    def newest_without_last(stamps: Stamps) -> Stamp:
        """Return the newest stamp before the last sample arrived; for a single sample, its stamp.

        Args:
            stamps: Stamps in order of arrival, nanoseconds, shape (n,).
        """
        return int(stamps[:-1].max(initial=stamps[0]))

    def way(self) -> list[Track] | None:
        """Return the edges from source to target at the lookup's time; None without a path."""
        legs = up_to_join(
            self.question.source,
            self.question.target,
            lambda frame: climbed(frame, self._parent),
        )
        return None if legs is None else [*legs[0], *reversed(legs[1])]

    def _parent(self, frame: str) -> Track | None:
        """Return the edge from a frame's parent at the lookup's time; None for a root.

        If the frame has several parents, the edge with the sample nearest in time is returned.
        """
        tracks = [t for t in self._stored.get(frame, ()) if len(t.by_stamp)]
        if len(tracks) < 2:
            return tracks[0] if tracks else None
        if self.stamp == LATEST or any(track.static for track in tracks):
            return max(tracks, key=lambda track: int(track.logs[-1]))
        return min(tracks, key=lambda track: int(np.abs(track.sorted_stamps - self.stamp).min()))

    @cached_property
    def _stored(self) -> dict[str, list[Track]]:
        """Mapping from each child's name to the edges that end at it, as the listener has them.

        tf2 of ROS 1 stores all transforms to a child as the kind that comes first.
        """
        edges = self.model.edges_above
        if not is_ros1(self.model.evidence):
            return edges
        return {
            child: [one.stored_as(static=self.model.first_of(child).static) for one in tracks]
            for child, tracks in edges.items()
        }

    def link(self, track: Track) -> TracedLink:
        """Return the state of an edge in the buffer, and the lookup's outcome at this edge."""
        held = self.held(track)
        verdict, short_by = self._verdict(track, held)
        if track.static and len(held):
            # A static link is valid since its arrival, whatever its stamp.
            since = int(track.arrivals[self.arrived(track)[0]])
            held = np.full(len(held), since)
        return TracedLink(
            track.parent,
            track.child,
            track.static,
            track.nodes[0] if track.nodes else None,
            len(held),
            int(held[0]) if len(held) else None,
            int(held[-1]) if len(held) else None,
            track.period,
            track.median_latency,
            verdict,
            short_by,
        )

    def _verdict(self, track: Track, held: Stamps) -> tuple[LinkVerdict, Duration]:
        if not len(held):
            return LinkVerdict.NO_DATA, 0
        if track.static or self.moment == LATEST:
            return LinkVerdict.ANSWERS, 0
        oldest, newest = int(held[0]), int(held[-1])
        if len(held) == 1 and oldest != self.moment and len(track.by_stamp) == 1:
            return LinkVerdict.NO_DATA, abs(self.moment - oldest)
        if self.moment > newest:
            return LinkVerdict.FORWARD, self.moment - newest
        if self.moment < oldest:
            came = track.stamps[self.arrived(track)]
            pruned = bool((came <= self.moment).any())
            return (LinkVerdict.PRUNED if pruned else LinkVerdict.BACKWARD), oldest - self.moment
        return LinkVerdict.ANSWERS, 0

    def buffer(self) -> Buffer:
        """Return a buffer with all samples that had arrived when the lookup was made."""
        # Allow as many frames as a recording: no frame may be missing because of a limit.
        buffer = Buffer(self.cache, log=_silent, max_frames=MOST_FRAMES)
        tracks = [track for above in self._stored.values() for track in above]
        sent = [(track, self.arrived(track)[-MOST_SET:]) for track in tracks]
        sent = [(track, places) for track, places in sent if len(places)]
        # If a frame is sent as static and as moving, the kind received last is kept,
        # in ROS 2.
        for track, places in sorted(sent, key=lambda one: int(one[0].logs[one[1][-1]])):
            if not track.static:
                buffer.set_transforms(
                    track.parent,
                    track.child,
                    track.stamps[places],
                    track.translations[places],
                    track.rotations[places],
                )
                continue
            place = int(places[-1])
            x, y, z = track.translations[place].tolist()
            qx, qy, qz, qw = track.rotations[place].tolist()
            pose = Transform((x, y, z), (qx, qy, qz, qw))
            stamp = int(track.stamps[place])
            buffer.set_transform_static(
                TransformStamped(stamp, track.parent, track.child, pose), "recorded"
            )
        return buffer

    def settle(self, path: Sequence[Track]) -> None:
        """Set `moment` to the latest common time of the edges, for a lookup of the latest time."""
        if self.stamp == LATEST:
            newest = [int(held[-1]) for t in path if not t.static and len(held := self.held(t))]
            self.moment = min(newest, default=LATEST)

    # Times at which the lookup succeeds

    def answerable(self, tracks: Sequence[Track]) -> tuple[Stamp | None, Stamp | None]:
        """Return the first and the last log time at which the lookup can succeed.

        Both times are None if the lookup always fails. The last time is None if the lookup succeeds
        until the end.
        """
        begins: list[int] = []
        ends: list[int] = []
        for track in tracks:
            if track.static:
                begins.append(int(track.logs[0]))
                continue
            logs = track.logs[track.by_stamp]
            stamps = track.sorted_stamps
            if self.stamp == LATEST:
                begins.append(int(logs.min()))
                continue
            after = int(np.searchsorted(stamps, self.stamp, side="left"))
            before = int(np.searchsorted(stamps, self.stamp, side="right")) - 1
            if before < 0 or after >= len(stamps):
                return None, None
            first = int(logs[after:].min())
            begins.append(max(first, int(logs[before])))
            pruned = int(np.searchsorted(stamps, int(stamps[before]) + self.cache, side="right"))
            if pruned + 1 < len(stamps):
                # The next insertion prunes, by the newest sample before it.
                ends.append(int(np.partition(logs[pruned:], 1)[1]))
        begin = max(begins, default=self.asked)
        end = min(ends, default=None)
        return (begin, end) if end is None or begin < end else (None, None)


def _silent(_level: str, _text: str) -> None:
    """Ignore the log of the assumed listener's buffer, because the checks report the faults."""
