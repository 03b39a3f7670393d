"""Checks of arrivals: times without any message, and streams that stall."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from tftool.base.stamps import NANOSECONDS, Duration, Stamp
from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.findings import Area, Fact, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import Heard, Places, Track
from tftool.doctor.wording import moment, several, span

check = checks_of(Area.COVERAGE)

Name = TypeVar("Name")


@check(
    "outage",
    Severity.WARNING,
    rule="on half or more of the streams with {hz:g} Hz or more, nothing arrives for more than "
    "{seconds:g} s and {periods:g} periods. One of these streams or more is a topic, and one or "
    "more is a transform. If half or more are silent more than twice as long as all of them, the "
    "headline is about these. Afterwards the streams continue, with a gap in their stamps or with "
    "delayed data. A constant difference between the clocks is subtracted first. A second case: "
    "{times:g} times, no message at all arrives for {again:g} s, and messages on /clock then "
    "arrive in a burst. The evidence also counts shorter times, of {short:g} s or more, without "
    "arrivals on the same streams. If a static transform is sent again with a new stamp, during "
    "an outage or up to 1 s later and at no other time, the programs were started again",
    headline="nothing arrived for {length:span} on {streams} of {of} streams{longer}{often}",
    detail="from {begin:moment} to {end:moment} (log times): {names}; {lost}",
    consequence="data stamped in this time arrived late, in a burst, or never",
    causes=(
        "a network that was down",
        "a recorder or a disk that was blocked",
    ),
    limits={"seconds": 2.0, "periods": 10, "hz": 1.0, "again": 0.2, "times": 10, "short": 0.4},
    needs=("log times",),
)
def outage(model: Model, limits: Limits) -> Iterator[Hit]:
    """Most topics stop at the same time, and resume later."""
    if (stalled := _receiver_stalls(model, limits)) is not None:
        yield stalled
        return
    outages = [one for one in _outages(model, limits) if one.lost or 2 * one.held > one.length]
    if not outages:
        return  # or a player or a simulation paused
    worst = max(outages, key=lambda one: one.length)
    others = [
        f"{moment(one.begin)} to {moment(one.end)} ({several([s.name for s in one.streams])})"
        for one in outages
        if one is not worst
    ]
    also = f"; also from {several(others, 3)}" if others else ""
    again = _sent_again(model, outages)
    begin, end, streams, longer = _headline(worst)
    apart = [one.length for one in outages if one.end <= begin or one.begin >= end]
    total = span(end - begin + sum(apart))
    yield Hit(
        edges=_unique(s.edge for one in outages for s in one.streams if isinstance(s, Track)),
        topics=_unique(s.topic for one in outages for s in one.streams if isinstance(s, Heard)),
        since=outages[0].begin,
        until=outages[-1].end,
        count=len(outages),
        facts={
            "begin": begin,
            "end": end,
            "length": end - begin,
            "streams": len(streams),
            "names": [stream.name for stream in streams],
            "longer": longer,
            "of": worst.of,
            "lost": _lost(worst) + again + also + _shorter(worst, outages, limits),
            "often": f", the longest of {len(apart) + 1} outages ({total} in all)" if apart else "",
        },
        fixes=(_RESTARTED if again else _NETWORK,),
        alone=True,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Outage:
    """One time without arrivals on several streams.

    Attributes:
        begin: Log time at which the last of the streams fell silent.
        end: Log time at which the first of the streams resumed.
        streams: The silent streams.
        silences: For each silent stream, the log times of the last arrival before the outage and
            of the first one after it.
        of: Number of streams that began before `end`.
        holes: For each silent stream, the largest step between the stamps of that time,
            nanoseconds; 0 if it is not above 3 periods.
        held: Largest delay of the first message afterwards, beyond the usual delay, nanoseconds.
        gone: Names of the streams that ended at the begin or meanwhile.
    """

    begin: Stamp
    end: Stamp
    streams: tuple[Track | Heard, ...]
    silences: tuple[tuple[Stamp, Stamp], ...]
    of: int
    holes: tuple[Duration, ...]
    held: Duration
    gone: tuple[str, ...]

    @property
    def length(self) -> Duration:
        """Return the time between `begin` and `end`, nanoseconds."""
        return self.end - self.begin

    @property
    def lost(self) -> int:
        """Return the number of streams without stamps for half of the outage or more."""
        return sum(2 * hole > self.length for hole in self.holes)


_NETWORK = Fix("look at the network and the recorder at that time")
"""Remedy for an outage of unknown cause."""

_RESTARTED = Fix("the programs were started again: find out why they had stopped")
"""Remedy for an outage at whose end the static transforms are new."""


def _sent_again(model: Model, outages: list[_Outage]) -> str:
    """Return a clause about static transforms that show that programs were started again, or "".

    Such a transform is sent at the start of its program only: in an outage or up to 1 s later, with
    another stamp than before.
    """
    for track in model.statics:
        logs, stamps = (column[track.logs < model.end] for column in (track.logs, track.stamps))
        in_outage = np.zeros(len(logs), dtype=np.bool_)
        for one in outages:
            in_outage |= (logs > one.begin) & (logs < one.end + NANOSECONDS)
        is_new = np.append(False, np.diff(stamps) > 0)[: len(logs)]
        again = is_new & in_outage
        if again.any() and bool((in_outage == is_new)[logs >= outages[0].begin].all()):
            at = moment(int(logs[again][0]))
            return f"; at {at}, {track.topics[0]} was sent again, with a new stamp"
    return ""


def _outages(model: Model, limits: Limits) -> list[_Outage]:
    """Return the times without arrivals on most streams, in the order of time.

    Of outages that overlap, the one with the most streams is kept.
    """
    rows: list[tuple[int, int, Track | Heard]] = []
    every: list[Track | Heard] = [*model.dynamic, *(h for h in model.heard if h.is_spatial)]
    judged: list[Track | Heard] = []
    for stream in every:
        steps = np.diff(stream.logs)
        if len(steps) < 10 or (usual := int(np.median(steps))) * limits["hz"] > NANOSECONDS:
            continue
        judged.append(stream)
        least = max(limits["seconds"] * NANOSECONDS, limits["periods"] * usual)
        wide = np.flatnonzero(steps > least)
        ends = zip(stream.logs[wide].tolist(), stream.logs[wide + 1].tolist(), strict=True)
        rows += [(low, high, stream) for low, high in ends]
    found: list[tuple[int, int, list[tuple[int, int, Track | Heard]]]] = []
    silent: list[tuple[int, int, Track | Heard]] = []
    for row in sorted(rows, key=lambda row: row[0]):
        begin = row[0]
        silent = [one for one in silent if one[1] > begin] + [row]
        end = min(one[1] for one in silent)
        of = sum(int(stream.logs[0]) < end for stream in judged)
        is_most = len({type(one[2]) for one in silent}) == 2 and 2 * len(silent) >= of
        if is_most and end - begin >= limits["seconds"] * NANOSECONDS:
            found.append((begin, end, silent))
    kept: list[tuple[int, int, list[tuple[int, int, Track | Heard]]]] = []
    for one in sorted(found, key=lambda one: (-len(one[2]), one[0] - one[1])):
        if all(one[0] >= other[1] or one[1] <= other[0] for other in kept):
            kept.append(one)
    return [
        _Outage(
            begin,
            end,
            tuple(stream for _, _, stream in rows),
            tuple((low, high) for low, high, _ in rows),
            # A stream that begins meanwhile is not silent.
            sum(int(stream.logs[0]) < end for stream in judged),
            tuple(_hole(stream, begin, end) for _, _, stream in rows),
            max(_held(stream, end) for _, _, stream in rows),
            tuple(s.name for s in every if begin - NANOSECONDS < s.logs[-1] < end),
        )
        for begin, end, rows in sorted(kept, key=lambda one: one[0])
    ]


def _held(stream: Track | Heard, end: Stamp) -> Duration:
    return int(stream.latency[stream.logs >= end][0]) - stream.median_latency


def _hole(stream: Track | Heard, begin: Stamp, end: Stamp) -> Duration:
    """Return the largest step between a stream's stamps in an outage; 0 if up to 3 periods.

    The stamps are moved by the stream's usual latency, because its clock may differ from the
    recorder's by a constant.

    Args:
        stream: The stream.
        begin: Log time of the last arrival before the outage.
        end: Log time of the first arrival after the outage.
    """
    stamps = np.sort(stream.stamps)
    steps = np.diff(stamps)
    place = int(np.searchsorted(stream.logs, begin, side="right")) - 1
    by = int(stream.arrivals[place] - stream.logs[place]) - stream.median_latency
    inside = (stamps[1:] > begin + by) & (stamps[:-1] < end + by)
    hole = int(steps[inside].max(initial=0))
    return hole if hole > 3 * int(np.median(steps)) else 0


def _headline(outage: _Outage) -> tuple[Stamp, Stamp, list[Track | Heard], str]:
    """Return the parts of an outage's headline: begin, end, silent streams, and a further clause.

    If half or more of the streams were silent more than twice as long as all, these streams are
    returned, and the clause says how long all were silent; otherwise it is "".
    """
    rows = list(zip(outage.silences, outage.streams, strict=True))
    longer = [row for row in rows if row[0][1] - row[0][0] > 2 * outage.length]
    told, begin, end = "", outage.begin, outage.end
    if 2 * len(longer) >= outage.of:
        rows, told = longer, f", and for {span(outage.length)} on {len(rows)}"
        begin, end = max(low for (low, _), _ in rows), min(high for (_, high), _ in rows)
    return begin, end, [stream for _, stream in rows], told


def _lost(outage: _Outage) -> str:
    """Return a clause about what became of the messages of an outage."""
    lost = "all data of that time arrived afterwards"
    if any(outage.holes):
        wide = sum(map(bool, outage.holes))
        lost = f"on {wide} of {len(outage.streams)} streams, data of that time is missing "
        lost += f"(up to {span(max(outage.holes))})"
    return f"{lost}; {several(outage.gone)} never resumed" if outage.gone else lost


def _shorter(worst: _Outage, outages: list[_Outage], limits: Limits) -> str:
    """Return a clause about the shorter times without arrivals on the streams of an outage.

    Args:
        worst: The outage.
        outages: All outages, which do not count again.
        limits: Thresholds of `outage`.
    """
    logs = np.unique(np.concatenate([stream.logs for stream in worst.streams]))
    usual = max(int(np.median(np.diff(stream.logs))) for stream in worst.streams)
    steps = np.diff(logs)
    short = steps > max(limits["short"] * NANOSECONDS, _MISSED * usual)
    for one in outages:
        short &= (logs[1:] <= one.begin) | (logs[:-1] >= one.end)
    number = int(np.count_nonzero(short))
    if number < _SEVERAL:
        return ""
    total, longest = span(int(steps[short].sum())), span(int(steps[short].max()))
    return (
        f"; on all {len(worst.streams)} streams, nothing arrived {number} more times, for up to "
        f"{longest} ({total} in all)"
    )


_SEVERAL = 2
"""Minimum number of shorter times that are told."""

_MISSED = 3
"""Number of periods without a message after which a stream is silent."""


def _unique(names: Iterable[Name]) -> tuple[Name, ...]:
    return tuple(dict.fromkeys(names))


def _receiver_stalls(model: Model, limits: Limits) -> Hit | None:
    """Return a hit if the recorder itself stalled again and again; else None.

    During a stall, nothing arrives. Afterwards several messages of `/clock` arrive at once, and the
    times in these messages show that the simulation continued.
    """
    times, clock = model.evidence.clock
    streams: list[Track | Heard] = [*model.dynamic, *model.heard]
    if len(clock) < limits["times"] or not model.dynamic or not model.heard:
        return None
    logs = np.sort(np.concatenate([clock, *(one.logs for one in (*model.tracks, *model.heard))]))
    silent = np.diff(logs) > limits["again"] * NANOSECONDS
    after = np.searchsorted(clock, logs[1:][silent])
    known = (after > 0) & (after + _BURST < len(clock))
    begins, ends, after = logs[:-1][silent][known], logs[1:][silent][known], after[known]
    at_once = clock[after + _BURST] - clock[after] < (ends - begins) // 10
    went_on = 2 * (times[after + _BURST] - times[after - 1]) > ends - begins
    places = np.flatnonzero(at_once & went_on)
    if len(places) < max(limits["times"], len(silent.nonzero()[0]) // 2):
        return None
    worst = int(places[(ends - begins)[places].argmax()])
    return Hit(
        edges=tuple(track.edge for track in model.dynamic),
        topics=tuple(heard.topic for heard in model.heard),
        since=int(begins[places[0]]),
        until=int(ends[places[-1]]),
        count=len(places),
        facts={
            "begin": int(begins[worst]),
            "end": int(ends[worst]),
            "length": int(ends[worst] - begins[worst]),
            "streams": len(streams) + 1,
            "of": len(streams) + 1,
            "names": ["/clock", *(one.name for one in streams)],
            "lost": "/clock continued meanwhile, and came in a burst afterwards: the recorder, its "
            "computer or the network stalled",
            "longer": "",
            "often": f", again and again: {len(places)} times",
        },
        fixes=(
            Fix("look at the recorder (its cache, its disk), its computer's load and the network"),
        ),
        alone=True,
    )


_BURST = 3
"""Number of messages of `/clock` that arrive at once after the receiver stalled."""


STALL = {"seconds": 0.5, "periods": 10, "slow_seconds": 1.0, "slow_periods": 5, "samples": 50}
"""Usual thresholds of `stall`."""


@check(
    "stall",
    Severity.NOTE,
    rule="a regular transform or Odometry topic pauses for {seconds:g} s and {periods:g} periods "
    "or more, or for {slow_seconds:g} s and {slow_periods:g} periods or more, among {samples:g} "
    "samples or more. The next message is then older than usual by at least half of the pause",
    headline="{where} {concerned:stalls|stall} for {length:span}",
    detail="{what}: {stalls:times}, the longest from {begin:moment} on (log time); usually every "
    "{period:span}",
    consequence="the delayed messages arrive late, in one burst",
    causes=("load", "a network that drops messages", "a node that waits for another"),
    limits=STALL,
    needs=("log times",),
    because_of=(
        ("anything", "time-jump-back"),
        ("stream", "outage clock-mixture clock-offset"),
    ),
)
def stall(model: Model, limits: Limits) -> Iterator[Hit]:
    """A regular stream pauses, and its messages then arrive in a burst."""
    odometry = (h for h in model.heard if h.type == "nav_msgs/Odometry")
    streams: list[Track | Heard] = [*model.dynamic, *odometry]
    for stream in streams:
        places = stalls_of(stream, limits)
        if len(places):
            steps = np.diff(stream.logs)
            place = int(places[steps[places].argmax()])
            facts: dict[str, Fact] = {
                "what": stream.name,
                "length": int(steps[place]),
                "begin": int(stream.logs[place]),
                "period": int(np.median(np.diff(np.sort(stream.stamps)))),
                "stalls": len(places),
            }
            yield hit_of(stream, facts, since=int(stream.logs[place]), count=len(places))


def stalls_of(stream: Track | Heard, limits: Limits = STALL) -> Places:
    """Return the indices of the messages after which a regular stream stalls."""
    steps = np.diff(stream.logs)
    if len(steps) < limits["samples"] or stream.families[0]:
        return np.zeros(0, dtype=np.intp)
    period = int(np.median(np.diff(np.sort(stream.stamps))))
    least = min(
        max(limits["periods"] * period, limits["seconds"] * NANOSECONDS),
        max(limits["slow_periods"] * period, limits["slow_seconds"] * NANOSECONDS),
    )
    held = stream.latency[1:] - stream.median_latency > 0.5 * steps
    return np.flatnonzero((steps > least) & held)
