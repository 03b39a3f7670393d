"""One lookup's exact trace: which link refuses, by how much, and what would let it through.

The listener is imagined: at the moment it asks it holds what had arrived by then, pruned as
tf2 prunes. What it would be told is asked of a buffer that holds the same; why, and what
helps, comes from the links and never from that text, which may quote a link that the answer
does not need.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from tftool.diagnostics.coverage import Waits, least_rate, rounded_up, waits_of
from tftool.diagnostics.findings import Edge
from tftool.diagnostics.model import Model, Settings
from tftool.diagnostics.names import alike_frames
from tftool.diagnostics.shape import missing_join, static_publisher
from tftool.diagnostics.streams import NEVER, Heard, Track
from tftool.diagnostics.wording import dated, moment, span
from tftool.errors import ExtrapolationException, InputError, TransformException
from tftool.frames.buffer import Buffer
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.sources.contract import SIMULATED_BELOW, Stamps
from tftool.stamps import LATEST, NANOSECONDS, Duration, Stamp

MOST_SET = 200_000
"""Samples of one link that the imagined buffer is given: the newest ones."""

USUAL_WAIT = 0.1
"""Seconds that most consumers wait for a transform."""


class LinkVerdict(Enum):
    """What a link says to a question."""

    ANSWERS = "answers"
    FORWARD = "forward"
    BACKWARD = "backward"
    NO_DATA = "no-data"
    PRUNED = "pruned"


class Cause(Enum):
    """Why a lookup is refused; WORKS where it is not."""

    LATE = "late"
    CLOCK_OFFSET = "clock-offset"
    CLOCK_MIXTURE = "clock-mixture"
    STOPPED = "stopped"
    GAP = "gap"
    BEFORE_START = "before-start"
    CACHE = "cache"
    UNKNOWN_FRAME = "unknown-frame"
    SPLIT = "split"
    SINGLE = "single"
    NAME = "name"
    LOOP = "loop"
    WORKS = "works"


CHECK_OF = {
    Cause.LATE: "sensor-outruns-tf",
    Cause.CLOCK_OFFSET: "clock-offset",
    Cause.CLOCK_MIXTURE: "clock-mixture",
    Cause.STOPPED: "edge-stopped",
    Cause.GAP: "gap",
    Cause.BEFORE_START: "late-start",
    Cause.CACHE: "cache-short",
    Cause.UNKNOWN_FRAME: "unknown-frame",
    Cause.SPLIT: "split-tree",
    Cause.SINGLE: "single-sample",
    Cause.NAME: "slash-twins",
    Cause.LOOP: "loop",
}
"""The check that looks for each cause."""


@dataclass(frozen=True, slots=True)
class TracedLink:
    """One link of the way, as the imagined listener holds it.

    Attributes:
        parent: Its parent.
        child: Its child.
        is_static: Whether it holds at all times.
        publisher: Who sends it; None where that is not known.
        count: Samples held.
        oldest: Stamp of the oldest one held, of a static its arrival; None where none is.
        newest: Stamp of the newest one held.
        period: Median step of its stamps, nanoseconds; 0 where there is none.
        latency: Median of arrival minus stamp, nanoseconds.
        verdict: What it says.
        short_by: How far the question lies outside, nanoseconds.
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
        """Parent and child."""
        return self.parent, self.child

    @property
    def name(self) -> str:
        """For people."""
        return f"{self.child} in {self.parent}"


@dataclass(frozen=True, slots=True)
class Remedy:
    """What would let the lookup through.

    Attributes:
        kind: "timeout", "rate", "cache", "skip", "name", "join", "publisher", "clock".
        text: A sentence.
        command: The line to type; empty where there is none.
        least: How much is enough, in nanoseconds; None where it is no amount.
        advised: How much to set, in nanoseconds.
        possible: Whether it can help at all.
    """

    kind: str
    text: str
    command: str = ""
    least: Duration | None = None
    advised: Duration | None = None
    possible: bool = True


@dataclass(frozen=True, slots=True)
class Explanation:
    """Why a lookup answers or refuses.

    Attributes:
        target: The frame asked for.
        source: The frame asked about.
        stamp: The moment asked about; 0 for the latest.
        asked: The log time at which it is asked.
        because: Why then: "when /scan of that stamp arrived"; empty where it was said.
        after: How long after the stamp that is, on the clock of the stamps, nanoseconds.
        available: Whether it answers.
        exception: What tf2 raises; empty where it answers.
        text: What that says.
        epoch: The first stamp of what moves.
        links: The way from source to target, in this order.
        refusing: The edge that refuses; None where none does, or there is no way.
        answerable_from: Log time from which on it answers; None where it never does.
        answerable_until: Log time at which what it needs is pruned; None where it never is.
        cause: Why.
        why: The same in sentences.
        remedies: What helps, the least first.
        useless: What people try and does not help, in sentences.
        failed: Of a session that was listened to, for which share of that time the same
            question would have been refused; None elsewhere.
    """

    target: str
    source: str
    stamp: Stamp
    asked: Stamp
    because: str
    after: Duration | None
    available: bool
    exception: str
    text: str
    epoch: Stamp
    links: tuple[TracedLink, ...]
    refusing: Edge | None
    answerable_from: Stamp | None
    answerable_until: Stamp | None
    cause: Cause
    why: tuple[str, ...] = ()
    remedies: tuple[Remedy, ...] = ()
    useless: tuple[str, ...] = ()
    failed: float | None = None

    @property
    def check(self) -> str | None:
        """The id of the check that looks for this cause; None where it works."""
        return CHECK_OF.get(self.cause)


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked, and by which listener.

    Attributes:
        target: The frame to express things in.
        source: The frame they are given in.
        stamp: The moment; 0 for the latest.
        asked: The log time at which it is asked; None for the arrival of the message of that
            stamp in the source frame, else the moment itself.
        settings: How long the listener remembers.
        timeout: How long it waits, nanoseconds.
        topic: The topic whose message asks; empty where none does.
    """

    target: str
    source: str
    stamp: Stamp = LATEST
    asked: Stamp | None = None
    settings: Settings = field(default_factory=Settings)
    timeout: Duration = 0
    topic: str = ""


def message_of(model: Model, topic: str, near: Stamp | None) -> tuple[Heard, Stamp]:
    """The message of a topic that is stamped nearest to a moment, the first one without it.

    Returns:
        The messages of its frame, and its stamp.

    Raises:
        InputError: If there is no message with a header on the topic.
    """
    heards = [heard for heard in model.heard if heard.topic == topic and len(heard.stamps)]
    if not heards:
        from difflib import get_close_matches

        known = sorted({heard.topic for heard in model.heard})
        hint = get_close_matches(topic, known, 1) or known[:5]
        told = f" There are {', '.join(hint)}." if hint else ""
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


class _Trace:
    """The work on one question."""

    def __init__(self, model: Model, question: Question) -> None:
        self.model = model
        self.question = question
        self.stamp = question.stamp
        self.moment = question.stamp
        self.cache = question.settings.cache_time
        self.heard = self._message()
        self.asked, self.because, self.after = self._asked()

    def _message(self) -> Heard | None:
        """The messages of which one asks: of the topic named, else in the source frame."""
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
                told = f"when {self.heard.topic} of that stamp arrived"
                after = int(self.heard.latency[place])
                return int(self.heard.logs[place]) + self.question.timeout, told, after
        return self.model.log_of(self.stamp) + self.question.timeout, "at that moment", 0

    # What is held

    def arrived(self, track: Track) -> "np.ndarray[tuple[int], np.dtype[np.intp]]":
        """Places of the usable samples that had arrived."""
        places: np.ndarray[tuple[int], np.dtype[np.intp]] = np.flatnonzero(
            track.usable & (track.logs <= self.asked)
        )
        return places

    def held(self, track: Track) -> Stamps:
        """Stamps held, sorted: what had arrived and is not pruned."""
        stamps = track.stamps[self.arrived(track)]
        if not track.static and len(stamps) > 1:
            # tf2 prunes before it inserts: by what was the newest without the last one.
            stamps = stamps[stamps >= self.newest_before(stamps) - self.cache]
        return np.sort(stamps)

    @staticmethod
    def newest_before(stamps: Stamps) -> Stamp:
        """The newest of what came before the last; of one, that."""
        return int(stamps[:-1].max(initial=stamps[0]))

    def way(self) -> list[Track] | None:
        """The edges from source to target by the parents at the moment; None without a join."""
        ups, downs = self._above(self.question.source), self._above(self.question.target)
        names = [self.question.source, *(track.parent for track in ups)]
        others = [self.question.target, *(track.parent for track in downs)]
        for place, name in enumerate(names):
            if name in others:
                return ups[:place] + list(reversed(downs[: others.index(name)]))
        return None

    def _above(self, frame: str) -> list[Track]:
        edges: list[Track] = []
        seen = {frame}
        while (track := self._parent(frame)) is not None:
            edges.append(track)
            frame = track.parent
            if frame in seen:
                break
            seen.add(frame)
        return edges

    def _parent(self, frame: str) -> Track | None:
        """The edge above a frame at the moment asked about; of several, the nearest in time."""
        tracks = [t for t in self.model.tracks if t.child == frame and len(t.by_stamp)]
        if len(tracks) < 2:
            return tracks[0] if tracks else None
        if self.stamp == LATEST or any(track.static for track in tracks):
            return max(tracks, key=lambda track: int(track.logs[-1]))
        return min(tracks, key=lambda track: int(np.abs(track.sorted_stamps - self.stamp).min()))

    def link(self, track: Track) -> TracedLink:
        held = self.held(track)
        verdict, short_by = self._verdict(track, held)
        if track.static and len(held):
            # It holds since it is known, whatever its stamp says.
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
        """A buffer that holds what had arrived."""
        buffer = Buffer(self.cache, log=_silent)
        tracks = sorted(self.model.tracks, key=lambda track: track.static)
        for track in tracks:
            places = self.arrived(track)[-MOST_SET:]
            if not len(places):
                continue
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

    def settle(self, way: Sequence[Track]) -> None:
        """Of a question for the latest, find the moment that is asked about: the last in common."""
        if self.stamp == LATEST:
            newest = [int(held[-1]) for t in way if not t.static and len(held := self.held(t))]
            self.moment = min(newest, default=LATEST)

    # When it answers

    def answerable(self, tracks: Sequence[Track]) -> tuple[Stamp | None, Stamp | None]:
        """Log times from which and until which the moment can be answered."""
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
                # The next insert prunes, by the newest of what is there before it.
                ends.append(int(np.partition(logs[pruned:], 1)[1]))
        begin = max(begins, default=self.asked)
        end = min(ends, default=None)
        return (begin, end) if end is None or begin < end else (None, None)


def _silent(_level: str, _text: str) -> None:
    """What the imagined buffer refuses is told by the checks."""


def traced(model: Model, question: Question) -> Explanation:
    """Trace one lookup through what a listener would hold.

    Args:
        model: What is known of the frames.
        question: What is asked, when, and by which listener.
    """
    trace = _Trace(model, question)
    exception, text, quoted = "", "", None
    try:
        trace.buffer().lookup_transform(question.target, question.source, question.stamp)
    except TransformException as refused:
        exception, text = type(refused).__name__, str(refused).strip("\n")
        if isinstance(refused, ExtrapolationException):
            quoted = (refused.frame, refused.available)
    named = _misnamed(trace)
    way = None if named is not None else trace.way()
    trace.settle(way or ())
    links = tuple(trace.link(track) for track in way or ())
    refusing = next(
        (number for number, link in enumerate(links) if link.verdict is not LinkVerdict.ANSWERS),
        None,
    )
    begin, end = trace.answerable(way) if way is not None else (None, None)
    known = _Known(trace, way, links, refusing, begin, end, available=not exception)
    if named is not None:
        told = named
    elif way is None:
        told = _split(known)
    elif known.available:
        told = _works(known)
    else:
        told = _refused(known)
    misleading = _misleading(links, quoted)
    return Explanation(
        target=question.target,
        source=question.source,
        stamp=question.stamp,
        asked=trace.asked,
        because=trace.because,
        after=trace.after,
        available=known.available,
        exception=exception,
        text=text,
        epoch=model.epoch,
        links=links,
        refusing=None if refusing is None or known.available else links[refusing].edge,
        answerable_from=begin,
        answerable_until=end,
        cause=told.cause,
        why=(*told.why, *misleading),
        remedies=told.remedies,
        useless=told.useless,
    )


MOMENTS = 1000
"""At how many moments of a session's last seconds a question is asked again."""


def over_time(model: Model, question: Question, found: Explanation) -> Explanation:
    """Add to an explanation for which share of the time the question would have been refused.

    Args:
        model: What was heard of a session.
        question: What was asked at its end.
        found: What was answered.
    """
    trace = _Trace(model, question)
    way = None if _misnamed(trace) is not None else trace.way()
    # Who begins to listen has heard of each link after a period of it, at the latest two.
    grace = 2 * max((track.period for track in way or ()), default=0)
    begin = min(model.start + grace, (model.start + model.end) // 2)
    asks = np.linspace(begin, model.end, MOMENTS).astype(np.int64)
    holds = np.zeros(MOMENTS, dtype=bool) if way is None else _holds(way, asks, question)
    failed = float(np.count_nonzero(~holds)) / MOMENTS
    length = span(model.end - model.start)
    words = "works now; it would have failed" if found.available else "fails now, and would have"
    share = f"{failed * 100:.0f} %" if failed >= 0.005 or not failed else "less than 1 %"
    told = f"this lookup {words} for {share} of the last {length}"
    why = (told, *found.why) if failed or not found.available else found.why
    return replace(found, failed=failed, why=why)


def _holds(
    way: Sequence[Track], asks: Stamps, question: Question
) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    """At which of these log times a question is answered."""
    holds = np.ones(len(asks), dtype=bool)
    newest, oldest = [], []
    for track in way:
        if track.static:
            holds &= asks >= int(track.logs[0])
            continue
        usable = np.flatnonzero(track.usable)
        came = np.searchsorted(track.logs[usable], asks, side="right") - 1
        holds &= came >= 0
        if not len(usable):
            continue
        last = np.maximum.accumulate(track.stamps[usable])[np.maximum(came, 0)]
        first = np.minimum.accumulate(track.stamps[usable])[np.maximum(came, 0)]
        newest.append(last)
        oldest.append(np.maximum(first, last - question.settings.cache_time))
    if newest:
        common = np.minimum.reduce(newest)
        at = common if question.stamp == LATEST else np.full(len(asks), question.stamp)
        holds &= (np.maximum.reduce(oldest) <= at) & (at <= common)
    return holds


def _misleading(
    links: tuple[TracedLink, ...], quoted: tuple[str | None, Stamp] | None
) -> tuple[str, ...]:
    """That tf2 quotes a link off the way: above the target it raises what fails first."""
    if quoted is None or not links or quoted[0] in {link.child for link in links}:
        return ()
    frame, stamp = quoted
    return (
        f"tf2's text quotes {moment(stamp)}, a time of {frame}, which is not on the way: "
        "leave it out of account",
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Known:
    """What is known when a reason is looked for."""

    trace: _Trace
    way: list[Track] | None
    links: tuple[TracedLink, ...]
    refusing: int | None
    begin: Stamp | None
    end: Stamp | None
    available: bool


@dataclass(frozen=True, slots=True)
class _Told:
    """A reason, and what helps."""

    cause: Cause
    why: tuple[str, ...]
    remedies: tuple[Remedy, ...] = ()
    useless: tuple[str, ...] = ()


def _misnamed(trace: _Trace) -> _Told | None:
    """What is wrong with a name; None where both are known."""
    model = trace.model
    for name in (trace.question.target, trace.question.source):
        if name.startswith("/") or not name:
            bare = name.lstrip("/")
            known = f"; tf knows {bare}" if bare in model.frames else ""
            users = sorted({heard.topic for heard in model.heard if heard.frame == name})
            where = f" in the publisher of {', '.join(users)}" if users else ""
            why = "the name is empty" if not name else f"{name} has ROS 1's leading slash{known}"
            return _Told(Cause.NAME, (why,), (Remedy("name", f'frame_id "{bare}"{where}'),))
        if name not in model.frames:
            return _unknown(trace, name)
    return None


def _described(model: Model, name: str) -> str | None:
    """Why tf lacks a link that the robot's description has; None if it has none of that name."""
    robot, states = model.material.robot, model.material.joints
    if robot is None or name not in robot.links or name == robot.root:
        return None
    joint = robot.joint_above(name)
    told = f"the robot's description has it, in {joint.parent} by joint '{joint.name}'"
    if joint.type == "floating":
        return f"{told}, which is floating: robot_state_publisher skips it"
    if not joint.moves:
        return f"{told}, which is fixed: robot_state_publisher was not heard"
    leader = robot.leader(joint.name, states or ())
    if states is None or leader not in states:
        return f"{told}, whose position is not known: no joint state names '{leader}'"
    return f"{told}, and joint states say where that is: robot_state_publisher was not heard"


def _unknown(trace: _Trace, name: str) -> _Told:
    model = trace.model
    says = {heard.topic: len(heard.stamps) for heard in model.heard if heard.frame == name}
    why = [f"no transform names {name}"]
    why += [f"{topic} says it, {count:,} times" for topic, count in says.items()]
    described = _described(model, name)
    if described is not None:
        return _Told(Cause.UNKNOWN_FRAME, (*why, described))
    alike = alike_frames(model, name)
    remedies = []
    if alike:
        why.append(f"in tf, {' and '.join(alike)} {'is' if len(alike) == 1 else 'are'} near")
        remedies.append(Remedy("name", f"set frame_id of the driver to {alike[0]}"))
    if model.trees:
        parent = missing_join(model.trees[0], name)[0]
        text = "or, if they are two things, publish where it is:" if alike else "publish it:"
        remedies.append(Remedy("join", text, static_publisher(parent, name)))
    return _Told(
        Cause.UNKNOWN_FRAME, tuple(why), tuple(remedies), ("a timeout: nothing publishes it",)
    )


def _split(known: _Known) -> _Told:
    model, question = known.trace.model, known.trace.question
    ours, theirs = model.tree_of[question.source], model.tree_of[question.target]
    lesser, main = (ours, theirs) if len(ours.frames) <= len(theirs.frames) else (theirs, ours)
    parent, child = missing_join(main, lesser.root)
    used = sorted({h.topic for h in model.heard if h.frame in lesser.frames})
    by = f" (used by {', '.join(used)})" if used else ""
    why = (
        f"{lesser.root} has no parent; its tree: {', '.join(sorted(lesser.frames))}{by}",
        f"the tree of {main.root}: {', '.join(sorted(main.frames))}",
        f"the join is missing; probably {child} belongs on {parent}",
    )
    join = Remedy("join", "publish it:", static_publisher(parent, child))
    return _Told(Cause.SPLIT, why, (join,), ("a timeout: nothing publishes the join",))


def _works(known: _Known) -> _Told:
    model, question = known.trace.model, known.trace.question
    for frame in (question.source, question.target):
        tree = model.tree_of.get(frame)
        if tree is not None and tree.is_circle:
            return _Told(
                Cause.LOOP,
                (
                    "it answers, but the frames hang in a circle: what walks to the root fails, "
                    "and the other way round may mean another pose",
                ),
                (Remedy("publisher", "publish one direction only"),),
            )
    return _Told(
        Cause.WORKS,
        (
            "this lookup works. If yours refuses: is there a listener, does the callback that "
            "waits block its executor, had the buffer time to fill?",
        ),
    )


def _refused(known: _Known) -> _Told:
    """Why a link on the way refuses; each reason is one function's."""
    trace = known.trace
    if known.refusing is None or known.way is None:
        return _Told(Cause.LATE, ("tf2 refuses, although every link answers",))
    link, track = known.links[known.refusing], known.way[known.refusing]
    if track.static:
        late = int(track.logs[0]) - trace.asked
        return _Told(
            Cause.LATE,
            (f"the static {link.name} arrives {span(late)} after the question",),
            (_timeout(known, None),),
        )
    if _is_simulated(trace.moment) != _is_simulated(int(track.sorted_stamps[-1])):
        return _two_clocks(link, track, trace)
    if len(track.by_stamp) == 1:
        at = int(track.sorted_stamps[0])
        return _Told(
            Cause.SINGLE,
            (f"{link.name} was sent once, at {moment(at)}: one sample answers for its own stamp",),
            (Remedy("publisher", "send it with a StaticTransformBroadcaster (on /tf_static)"),),
            ("a timeout: no second sample comes",),
        )
    if link.verdict is LinkVerdict.PRUNED:
        return _pruned(known, link, track)
    first, last = int(track.sorted_stamps[0]), int(track.sorted_stamps[-1])
    if trace.moment < first:
        return _before_start(known, link, track, first)
    if trace.moment > last:
        return _stopped(link, track, trace, last)
    return _late(known, link, track)


def _is_simulated(stamp: Stamp) -> bool:
    return stamp < SIMULATED_BELOW


def _two_clocks(link: TracedLink, track: Track, trace: _Trace) -> _Told:
    stamp = int(track.sorted_stamps[-1])
    clock = "the simulation's clock" if _is_simulated(stamp) else "the wall clock"
    other = "the wall clock" if _is_simulated(stamp) else "the simulation's"
    setting = "false" if _is_simulated(stamp) else "true"
    return _Told(
        Cause.CLOCK_MIXTURE,
        (
            f"{link.name} is stamped with {clock}: {dated(stamp)}",
            f"the question is on {other}: {dated(trace.moment)}",
        ),
        (Remedy("clock", f"use_sim_time: {setting} for the node that publishes {link.name}"),),
        ("a timeout, a larger cache: the two clocks never meet",),
    )


def _pruned(known: _Known, link: TracedLink, track: Track) -> _Told:
    trace = known.trace
    newest = int(track.stamps[trace.arrived(track)].max())
    needed = newest - trace.moment
    # What is needed is the sample before the moment, if it is not stamped just then. ROS 2 prunes
    # before it adds the newest one, ROS 1 after: so much is enough for both.
    before = track.sorted_stamps[track.sorted_stamps <= trace.moment]
    least = newest - int(before[-1]) if len(before) else needed
    advised = math.ceil((least + NANOSECONDS) / NANOSECONDS)
    why = f"the buffer keeps {span(trace.cache)}, and {link.name} is {span(needed)} further on"
    if trace.heard is not None and trace.after is not None:
        why = (
            f"{trace.heard.topic} arrives {span(trace.after)} after its stamp; the buffer keeps "
            f"{span(trace.cache)}"
        )
    return _Told(
        Cause.CACHE,
        (why,),
        (
            Remedy(
                "cache",
                f"keep more, at least {span(least)}:",
                f"Buffer(cache_time=Duration(seconds={advised}))",
                least,
                advised * NANOSECONDS,
            ),
            Remedy("skip", "or look up when the measurement arrives, and keep the result"),
        ),
        ("a timeout: what was dropped does not come back",),
    )


def _before_start(known: _Known, link: TracedLink, track: Track, first: Stamp) -> _Told:
    trace = known.trace
    why = [
        f"{link.name} begins at {moment(first)}, {span(first - trace.moment)} after the question"
    ]
    if track.median_latency < 0:
        why.append(
            f"it is dated {span(-track.median_latency)} ahead (transform_tolerance): nothing "
            "before its first stamp can ever be placed through it"
        )
    lost = ""
    if trace.heard is not None:
        count = int(np.count_nonzero(trace.heard.stamps < first))
        lost = f"; the first {count} messages of {trace.heard.topic} are lost"
    return _Told(
        Cause.BEFORE_START,
        tuple(why),
        (Remedy("skip", f"skip messages before {moment(first)}{lost}"),),
        ("a timeout, a larger cache: older data will not come",),
    )


def _stopped(link: TracedLink, track: Track, trace: _Trace, last: Stamp) -> _Told:
    return _Told(
        Cause.STOPPED,
        (
            f"{link.name} ended at {moment(last)}, {span(trace.moment - last)} before the "
            "question, and nothing follows",
        ),
        (Remedy("publisher", "look at the node that publishes it: it died, or hangs"),),
        ("a timeout: nothing comes any more",),
    )


def _late(known: _Known, link: TracedLink, track: Track) -> _Told:
    trace = known.trace
    stamps = track.sorted_stamps
    after = int(np.searchsorted(stamps, trace.moment, side="left"))
    step = int(stamps[after] - stamps[after - 1]) if after else 0
    heard = trace.heard
    is_gap = step > max(5 * track.period, NANOSECONDS // 2)
    why = f"{link.name} comes every {span(track.period)}, {span(link.latency)} after its stamp"
    cause = Cause.LATE
    if is_gap:
        cause = Cause.GAP
        why = f"{link.name} has a hole of {span(step)} from {moment(int(stamps[after - 1]))} on"
    elif heard is not None and heard.median_latency < -20_000_000:
        cause = Cause.CLOCK_OFFSET
        why = (
            f"{heard.topic} is stamped {span(-heard.median_latency)} ahead of its arrival: its "
            "clock is ahead"
        )
    elif heard is not None:
        why += f"; {heard.topic} after {span(heard.median_latency)}"
    remedies = [_timeout(known, heard)]
    if cause is Cause.CLOCK_OFFSET:
        remedies.insert(0, Remedy("clock", "synchronise the clocks (chronyc tracking; PTP)"))
    elif cause is Cause.LATE:
        later = link.latency - (heard.median_latency if heard is not None else 0)
        left = USUAL_WAIT - later / NANOSECONDS
        remedies.append(
            Remedy(
                "rate",
                least_rate(later, USUAL_WAIT),
                least=None if left <= 0 else round(left * NANOSECONDS),
                possible=left > 0,
            )
        )
    useless = [
        f"latest instead of the stamp: {trace.question.source} would be placed where it was "
        f"{span(link.short_by)} before",
        "a larger cache: what is missing has not come yet",
    ]
    return _Told(cause, (why,), tuple(remedies), tuple(useless))


def _waits(trace: _Trace, heard: Heard) -> Waits | None:
    return waits_of(trace.model, heard, trace.question.target, warm=False)


def _timeout(known: _Known, heard: Heard | None) -> Remedy:
    """How long to wait, for this question and for the others of its topic."""
    trace = known.trace
    if known.begin is None:
        text = "a timeout does not help: by the time the one end comes, the other is pruned"
        return Remedy("timeout", text, possible=False)
    least = max(0, known.begin - trace.asked)
    advised = rounded_up(least)
    text = f"a timeout of {advised // 10**6} ms (least: {least / 1e6:.1f})"
    waits = None if heard is None else _waits(trace, heard)
    if heard is not None and waits is not None and len(waits.served):
        p95, worst = waits.serves(95), int(waits.served.max())
        text += (
            f"; {p95 / 1e6:.1f} ms serve 95 % of {heard.topic}, {worst / 1e6:.1f} ms all "
            f"{int(np.count_nonzero(waits.waits != NEVER))} that are ever served"
        )
    return Remedy("timeout", text, "", least, advised)
