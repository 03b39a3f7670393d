"""Checks of arrivals: times without any message, and streams that stall."""

from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.findings import Area, Fact, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import Heard, Track
from tftool.doctor.wording import several

check = checks_of(Area.COVERAGE)


@check(
    "outage",
    Severity.WARNING,
    rule="on half or more of the streams with {hz:g} Hz or more, nothing arrives for more than "
    "{seconds:g} s and {periods:g} periods. A topic of messages and a transform are among "
    "these streams. Afterwards the streams go on, with a gap in their stamps or with delayed "
    "data. Or no message at all arrives for {again:g} s, {times:g} times, and messages on "
    "/clock then arrive in a burst",
    headline="nothing arrived for {length:span} on {streams} of {of} streams{often}",
    detail="from {begin:moment} to {end:moment} (log times): {names}; {lost}",
    consequence="data stamped in this time arrived late, in a burst, or never",
    causes=(
        "a network that was gone",
        "a recorder or a disk that hung",
    ),
    limits={"seconds": 2.0, "periods": 10, "hz": 1.0, "again": 0.2, "times": 10},
    needs=("log times",),
)
def outage(model: Model, limits: Limits) -> Iterator[Hit]:
    """Most topics stop at the same time, and resume later."""
    if (stalled := _receiver_stalls(model, limits)) is not None:
        yield stalled
        return
    silent: list[tuple[Track | Heard, int, int]] = []
    count = 0
    streams: list[Track | Heard] = [*model.dynamic, *(h for h in model.heard if h.is_spatial)]
    for stream in streams:
        steps = np.diff(stream.logs)
        if len(steps) < 10 or (usual := int(np.median(steps))) * limits["hz"] > NANOSECONDS:
            continue
        count += 1
        place = int(steps.argmax())
        if steps[place] > max(limits["seconds"] * NANOSECONDS, limits["periods"] * usual):
            silent.append((stream, int(stream.logs[place]), int(stream.logs[place + 1])))
    begin = max((begin for _, begin, _ in silent), default=0)
    end = min((end for _, _, end in silent), default=0)
    kinds = {type(stream) for stream, _, _ in silent}
    if len(kinds) < 2 or 2 * len(silent) < count or end - begin < limits["seconds"] * NANOSECONDS:
        return
    missed = sum(
        _is_hole(stream, begin, end, limits["seconds"] * NANOSECONDS) for stream, _, _ in silent
    )
    held = [one.latency[one.logs >= end][0] - one.median_latency for one, _, _ in silent]
    if not missed and 2 * max(held) < end - begin:
        return  # a player or a simulation paused
    lost = "all of it came afterwards"
    if missed:
        lost = f"on {missed} of them data of that time never came"
    gone = [one.name for one in streams if begin - NANOSECONDS < one.logs[-1] < end]
    yield Hit(
        edges=tuple(stream.edge for stream, _, _ in silent if isinstance(stream, Track)),
        topics=tuple(stream.topic for stream, _, _ in silent if isinstance(stream, Heard)),
        since=begin,
        until=end,
        facts={
            "begin": begin,
            "end": end,
            "length": end - begin,
            "streams": len(silent),
            "of": count,
            "names": [stream.name for stream, _, _ in silent],
            "lost": f"{lost}; {several(gone)} never came back" if gone else lost,
            "often": "",
        },
        fixes=(Fix("look at the network and the recorder at that time"),),
        alone=True,
    )


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
            "lost": "/clock went on meanwhile, and came in a burst afterwards: the recorder or its "
            "computer stalled",
            "often": f", again and again: {len(places)} times",
        },
        fixes=(Fix("look at the recorder (its cache, its disk) and the load of its computer"),),
        alone=True,
    )


_BURST = 3
"""Number of messages of `/clock` that arrive at once after the receiver stalled."""


def _is_hole(stream: Track | Heard, begin: int, end: int, least: float) -> bool:
    """Whether the stamps of a stream also have a gap during a pause of arrivals.

    Args:
        stream: The stream.
        begin: Log time of the last arrival before the pause.
        end: Log time of the first arrival after the pause.
        least: Smallest difference between two stamps that counts as a gap, nanoseconds.
    """
    stamps = np.sort(stream.stamps)
    steps = np.diff(stamps)
    delay = stream.arrivals - stream.logs
    near = int(delay[0]) if len(delay) else 0
    wide = (steps > least) & (stamps[1:] > begin + near) & (stamps[:-1] < end + near)
    return bool(wide.any())


@check(
    "stall",
    Severity.NOTE,
    rule="a regular transform or Odometry topic pauses for {seconds:g} s and {periods:g} periods "
    "or more, among {samples:g} samples or more. The next message is then older than usual by "
    "at least half of the pause",
    headline="{where} {concerned:stalls|stall} for {length:span}",
    detail="{what}: {stalls:times}, the longest from {begin:moment} on (log time); usually every "
    "{period:span}",
    consequence="the delayed messages arrive late, in one burst",
    causes=("load", "a network that drops", "a node that waits for another"),
    limits={"seconds": 0.5, "periods": 10, "samples": 50},
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
        steps = np.diff(stream.logs)
        if len(steps) < limits["samples"] or stream.families[0]:
            continue
        period, usual = int(np.median(np.diff(np.sort(stream.stamps)))), stream.median_latency
        least = max(limits["periods"] * period, limits["seconds"] * NANOSECONDS)
        held = stream.latency[1:] - usual > 0.5 * steps
        places = np.flatnonzero((steps > least) & held)
        if len(places):
            place = int(places[steps[places].argmax()])
            facts: dict[str, Fact] = {
                "what": stream.name,
                "length": int(steps[place]),
                "begin": int(stream.logs[place]),
                "period": period,
                "stalls": len(places),
            }
            yield hit_of(stream, facts, since=int(stream.logs[place]), count=len(places))
