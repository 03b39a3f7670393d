"""Checks for missing transforms: edges that pause, or have a single sample."""

import re
from collections.abc import Iterator

import numpy as np

from tftool.base.plain_text import count
from tftool.base.stamps import NANOSECONDS, seconds
from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.missing_joins import is_world
from tftool.doctor.model import WARM_UP, Limits, Model
from tftool.doctor.outage_checks import stalls_of
from tftool.doctor.stamp_stream import (
    BASES,
    NEVER,
    PLACED,
    Heard,
    Places,
    Track,
    family,
    last_part,
    rate,
)
from tftool.doctor.wording import metres, several, span
from tftool.geometry.rigid_arrays import rotate, unit
from tftool.recordings.contract import Stamps

check = checks_of(Area.COVERAGE)


def _least_gap(track: Track, limits: Limits) -> float:
    return max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)


def holes(track: Track, limits: Limits) -> list[tuple[int, int]]:
    """Return the gaps that are too long for an edge's period, as (stamp before, stamp after)."""
    # A stamp that is wrong by years does not make a gap.
    stamps = track.sorted_stamps
    if track.wild.any():
        stamps = stamps[~track.wild[track.by_stamp]]
    if len(stamps) < limits["samples"] or not track.period:
        return []
    if len(track.steps) < 0.5 * (len(stamps) - 1):
        return []  # its stamps do not change, which is another fault
    wide = stamps[1:] - stamps[:-1] > _least_gap(track, limits)
    places = wide.nonzero()[0].tolist()
    return [(int(stamps[place]), int(stamps[place + 1])) for place in places]


def _is_used(model: Model, track: Track) -> bool:
    """Whether an edge belongs to a robot, or a message with a position is in a frame below it."""
    below = model.below(track.child)
    return not is_world(track.parent) or any(
        heard.is_spatial and heard.frame.removeprefix("/") in below for heard in model.heard
    )


def needed_in(model: Model, track: Track, begin: int, end: int) -> int:
    """Count the sensor messages, in frames below an edge, with stamps between `begin` and `end`."""
    below = model.below(track.child)
    return sum(
        int(np.count_nonzero((heard.stamps > begin) & (heard.stamps < end)))
        for heard in model.heard
        if last_part(heard.type) in PLACED and heard.frame.removeprefix("/") in below
    )


REPORTS = ("rosgraph_msgs/", "rcl_interfaces/", "diagnostic_msgs/", "bond/")
"""Packages of messages about nodes, which go on when the data of a robot is over."""

_SEEN = re.compile(
    r"tag|marker|aruco|fiducial|charuco|obj|detect|person|people|target|ball|box|obstacle|goal|yolo"
)


def is_detection(model: Model, track: Track) -> bool:
    """Whether the child of an edge is probably an object that a camera detects, such as a marker.

    Such a child is one of several that come and go, or it has no children and no messages, and its
    name or irregular rate fits a detection.
    """
    if track.child in model.passing:
        return True
    if len(model.below(track.child)) > 1 or any(h.frame == track.child for h in model.heard):
        return False
    steps = track.steps
    is_irregular = len(steps) > 1 and float(steps.std()) > float(steps.mean())
    return is_irregular or _SEEN.search(last_part(track.child).lower()) is not None


@check(
    "gap",
    Severity.WARNING,
    rule="the largest step between two samples is above {periods:g} periods and {seconds:g} s, "
    "among {samples:g} samples or more. A note for a gap below {note:g} s, and for transforms that "
    "are published on change: the standard deviation of their steps divided by the mean is above "
    "{variation:g}. They do not count as published on change if the median deviation of the steps "
    "is below half the period and the frame moves by 0.1 m across a gap. A note also if no scan, "
    "point cloud or range in the frame or below it has a stamp in the gap, unless the transform "
    "places a robot in the world. A transform that places a robot in the world is also reported "
    "for {times:g} gaps of {again:g} s and {missed:g} periods or more, if the last gap is more "
    "than 1 s after the first sample. {dense:g} such gaps are enough if they take up a share of "
    "{taken:g} of the time from the first to the last of them. One gap of {lost:g} s and "
    "{lost_periods:g} periods or more, after {samples:g} samples or more, is enough if the "
    "transform turns by {turned:g}° across the gap. A transform with one exact period is also "
    "reported if a share of {share:g} and {few:g} samples or more are missing. This is a note if "
    "the transform turns by less than {lossy:g}° across each of these gaps, if no gap reaches "
    "{short:g} s, and for a part of a robot that no sensor uses. The topics named after 'at the "
    "same time' have messages before and after the gap, or nine of ten of the same gaps",
    headline="{where} {concerned:has a gap|have gaps}{often}",
    detail="{edge}: nothing from {begin:moment} to {end:moment} ({length:span}; usually every "
    "{period:span}){why}{beside}",
    consequence="lookups at a time in the gap interpolate across the gap, or fail while the gap "
    "lasts",
    causes=(
        "load",
        "a network that drops messages",
        "a publisher that was blocked",
    ),
    limits={
        "periods": 5,
        "seconds": 0.5,
        "note": 1.0,
        "samples": 10,
        "variation": 1.0,
        "times": 10,
        "again": 0.2,
        "missed": 8,
        "dense": 5,
        "taken": 0.5,
        "lost": 0.25,
        "lost_periods": 15,
        "turned": 45.0,
        "lossy": 10.0,
        "share": 0.05,
        "few": 20,
        "short": 0.05,
    },
    why="four messages lost in a row are no accident on a reliable topic; the usual "
    "timeouts of consumers cover shorter gaps",
    because_of=(
        ("child", "publisher-conflict two-parents"),
        ("edge", "edge-stopped nan-transform clock-offset outage stale-stamp"),
    ),
)
def gap(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform has a gap."""
    known = {track.edge: _in_service(model, track, limits) for track in model.dynamic}
    for track in model.dynamic:
        again = _repeated(model, track, limits)
        found = known[track.edge] or again
        if max((high - low for low, high in found), default=0) < limits["note"] * NANOSECONDS:
            short = None if again else _turned_or_lossy(model, track, limits)
            if short is not None:
                yield short
                continue
        if not found:
            continue
        begin, end = max(found, key=lambda hole: hole[1] - hole[0])
        also = [
            other.name
            for other in model.dynamic
            if other is not track
            and (
                any(low < end and begin < high for low, high in known[other.edge])
                or (again and _is_silent(other, begin, end))
            )
        ]
        quiet = {h.topic for h in model.heard if _is_silent(h, begin, end)}
        silent = [*also, *sorted(quiet)]
        steps = track.steps
        regular = steps[steps <= _least_gap(track, limits)] if len(found) <= 3 else steps
        mean = float(regular.mean()) if len(regular) else 0.0
        on_change = bool(mean) and float(regular.std()) / mean > limits["variation"]
        on_change = on_change and not _is_steady_and_moved(track, found)
        stamps = track.stamps
        missing = int(np.count_nonzero((stamps > begin) & (stamps < end)))
        needed = needed_in(model, track, begin, end)
        is_long = end - begin > 10 * track.period
        is_lost = bool(needed) or (is_long and _places_robot(model, track, begin))
        why = f"; {missing} samples in the gap are unusable (NaN)" if missing else ""
        why += f"; {count(needed, 'sensor message')} in the gap" if needed else ""
        sent, cure = _cause(model, track, (begin, end), bool(silent))
        why += sent
        if track.moves:
            pair = track.by_stamp[np.searchsorted(track.sorted_stamps, (begin, end))]
            turned = np.degrees(track.turned(pair[:1], pair[1:]))[0]
            why += f"; across the gap: {turned:.3g}° and {metres(_robot_moves(model, track, pair))}"
        every = again or found
        if len(every) > 1:
            least = _least_gap(track, _short(limits) if again else limits)
            total = span(sum(high - low for low, high in every))
            why += f"; the longest of {len(every)} gaps above {span(least)}, {total} in all"
        why += _stalled(track, every) if model.evidence.timed else ""
        yield hit_of(
            track,
            {
                "begin": begin,
                "end": end,
                "length": end - begin,
                "often": f", again and again: {len(again)} times" if again else "",
                "period": track.period,
                "also": also,
                "beside": f"; at the same time: {several(silent)}" if silent else "",
                "unusable": missing,
                "why": why,
            },
            since=begin,
            until=end,
            count=len(again or found),
            severity=Severity.NOTE
            if not again
            and (on_change or end - begin < limits["note"] * NANOSECONDS or not is_lost)
            else Severity.WARNING,
            fixes=(cure,),
        )


def _stalled(track: Track, found: list[tuple[int, int]]) -> str:
    """Return a clause about the gaps of an edge during which the edge stalls; "" without any."""
    places = stalls_of(track)
    low, high = (track.arrivals[at] - track.median_latency for at in (places, places + 1))
    in_gap = [(low < end) & (high > begin) for begin, end in found]
    number = sum(bool(one.any()) for one in in_gap)
    if not number:
        return ""
    longest = span(int((high - low)[np.logical_or.reduce(in_gap)].max()))
    which = "this gap" if len(found) == 1 else f"{number} of these gaps"
    return f"; during {which}, no sample arrived for up to {longest}, and the next sample was late"


def _is_steady_and_moved(track: Track, found: list[tuple[int, int]]) -> bool:
    """Whether an edge has a steady period, and moves across one of its gaps.

    The gaps alone can cause a large deviation of the steps; a publisher that sends only changes
    sends about the same pose after a gap.
    """
    steady = float(np.median(np.abs(track.steps - track.period))) < _STEADY * track.period
    before = np.searchsorted(track.sorted_stamps, [begin for begin, _ in found], side="right") - 1
    before = before[(before >= 0) & (before < len(track.strides))]
    return steady and bool((track.strides[before] > _MOVED).any())


_STEADY = 0.5
"""Largest median deviation of the steps of a steady edge, as a fraction of its period."""

_MOVED = 0.1
"""Smallest distance, metres, across a gap in which a frame moved."""

_SOURCE = Fix("look at the source of all these streams, and at its connection to the recorder")
"""Remedy for a gap of several streams at the same time."""


def base_at(model: Model, track: Track, logs: Stamps) -> tuple[Track, Places] | None:
    """Return the edge to the robot's base directly below an edge, and its rows at some log times.

    The rows are the first samples that arrived at these times or later; after the end, the last
    sample. Log times are used, because the stamps of the two edges may be on different clocks.
    """
    for below in model.dynamic:
        if below.parent == track.child and last_part(below.child) in BASES and len(below.by_stamp):
            return below, np.searchsorted(below.logs, logs).clip(0, len(below.logs) - 1)
    return None


def _robot_moves(model: Model, track: Track, pair: Places) -> float:
    """Return the distance, metres, by which the robot moves from one sample of an edge to another.

    A turn of odom moves the robot by its distance from the origin of odom. Without a base frame
    directly below the edge, the distance is that of the edge's child.
    """
    base = base_at(model, track, track.logs[pair[1:]]) if track.is_localisation else None
    where = np.zeros(3) if base is None else base[0].translations[base[1][0]]
    before, after = track.translations[pair] + rotate(unit(track.rotations[pair]), where)
    return float(np.linalg.norm(after - before))


def _turned_or_lossy(model: Model, track: Track, limits: Limits) -> Hit | None:
    """Return a hit about a short gap while the robot turned far, or about an edge's lost samples.

    Lost samples are missing from an otherwise exact period. Return None if nothing is found.
    """
    if len(track.by_stamp) < limits["samples"] or not track.period or track.wild.any():
        return None
    steps = np.diff(track.sorted_stamps)
    wide = np.flatnonzero(2 * steps > 3 * track.period)
    if not len(wide):
        return None
    turned = np.degrees(track.turned(track.by_stamp[wide + 1], track.by_stamp[wide]))
    small = {**limits, "seconds": limits["lost"], "periods": limits["lost_periods"]}
    long = steps[wide] > _least_gap(track, small)
    # A publisher that has just started may pause once.
    far = long & (turned > limits["turned"]) & (wide >= limits["samples"] - 1)
    place = int(np.where(far, turned, 0.0).argmax())
    often, severity = "", Severity.WARNING
    if not (far[place] and _places_robot(model, track)):
        often = _loss(track, steps, limits)
        if not often:
            return None
        place = int(turned.argmax())
        is_far = turned[place] > limits["lossy"] and not model.is_minor(track)
        is_far &= steps.max() >= limits["short"] * NANOSECONDS
        severity = Severity.WARNING if is_far else Severity.NOTE
    worst = int(wide[place])
    begin, end = int(track.sorted_stamps[worst]), int(track.sorted_stamps[worst + 1])
    moved = metres(_robot_moves(model, track, track.by_stamp[worst : worst + 2]))
    number, total = int(np.count_nonzero(long)), span(int(steps[wide[long]].sum()))
    several_gaps = ""
    if not often and number > 1:
        several_gaps = (
            f"; one of {number} gaps above {span(_least_gap(track, small))}, {total} in all"
        )
    silent = sorted(
        {
            heard.topic
            for heard in model.heard
            if (_has_holes(heard, track, wide) if often else _is_silent(heard, begin, end))
        }
    )
    sent, cure = _cause(model, track, (begin, end), bool(silent))
    return hit_of(
        track,
        {
            "begin": begin,
            "end": end,
            "length": end - begin,
            "often": often,
            "period": track.period,
            "also": [],
            "beside": f"; at the same time: {several(silent)}" if silent else "",
            "unusable": 0,
            "why": f"; across the gap: {turned[place]:.3g}° and {moved}{several_gaps}{sent}",
        },
        since=begin,
        until=end,
        count=1 if often else number,
        severity=severity,
        fixes=(cure,),
    )


def _loss(track: Track, steps: Stamps, limits: Limits) -> str:
    """Return a clause about samples that are missing from an edge with an exact period.

    The clause is empty if few samples are missing, or if the period is not exact.

    Args:
        track: The edge.
        steps: Differences between consecutive stamps, nanoseconds, shape (n,).
        limits: Thresholds of `gap`.
    """
    periods = steps / track.period
    whole = np.rint(periods)
    lost = whole[(whole > 1) & (whole <= limits["few"])]
    missing = int((lost - 1).sum())
    share = missing / (missing + len(steps) + 1)
    is_exact = float(np.mean(np.abs(periods - whole) < _EXACT)) > 1.0 - _EXACT
    if not is_exact or missing < limits["few"] or share < limits["share"]:
        return ""
    most = int(lost.max()) - 1
    return f": {100 * share:.3g} % of its samples are missing, up to {most} in a row"


_EXACT = 0.05
"""Maximum deviation of steps from an exact period, and maximum fraction of larger deviations."""


def _repeated(model: Model, track: Track, limits: Limits) -> list[tuple[int, int]]:
    """Return an edge's short gaps if they are many and the edge is the robot's pose; else []."""
    found = _in_service(model, track, _short(limits))
    many = bool(found) and (len(found) >= limits["times"] or _are_dense(found, limits))
    is_told = many and _places_robot(model, track, found[-1][0])
    return found if is_told else []


def _short(limits: Limits) -> Limits:
    """Return the thresholds of `gap` for short gaps that occur many times."""
    return {**limits, "seconds": limits["again"], "periods": limits["missed"]}


def _are_dense(found: list[tuple[int, int]], limits: Limits) -> bool:
    """Whether several gaps take up most of the time from the first to the last of them."""
    lost = sum(high - low for low, high in found)
    return len(found) >= limits["dense"] and lost >= limits["taken"] * (found[-1][1] - found[0][0])


def _places_robot(model: Model, track: Track, begin: int = NEVER) -> bool:
    """Whether an edge is the pose of a moving robot in odom or a world frame.

    Args:
        model: Model of the evidence.
        track: The edge.
        begin: Last stamp before a gap of the edge. If it is in the first second of the edge, the
            result is False.
    """
    parent = last_part(track.parent)
    if not (is_world(track.parent) or parent.startswith("odom")) or track.is_localisation:
        return False
    started = int(track.sorted_stamps[0]) + WARM_UP
    # The gaps themselves make the rate of a robot's pose irregular.
    usual = track.steps[track.steps < 10 * track.period]
    regular = float(usual.std()) < float(usual.mean())
    named = _SEEN.search(last_part(track.child).lower())
    return begin > started and track.moves and regular and named is None


def _publisher_at(model: Model, track: Track, begin: int, end: int) -> tuple[str, Fix]:
    """Return a clause and the remedy for a gap of one edge, with the streams that continued."""
    streams: list[Track | Heard] = [one for one in model.dynamic if one is not track]
    streams += model.heard
    going = [one for one in streams if _is_going_on(one, begin, end)]
    whole = [one for one in going if _is_going_on(one, begin, end, _WHOLE)]
    first = track.by_stamp[np.searchsorted(track.sorted_stamps, end)]
    late = int(track.latency[first]) - track.median_latency if model.evidence.timed else 0
    if late > _LATE:
        told = f"; the sample after the gap is {span(late)} later than usual"
        return told, _WAY
    if 2 * len(whole) < len(going):
        some = [one.name for one in going if one not in whole]
        return f"; in the gap, samples of {several(some, 3)} are missing too", _WAY
    if whole:
        names = several([one.name for one in whole], 3)
        return "", Fix(f"{names} continued: look at the publisher of the transform at that time")
    return "", Fix("look at its publisher at that time, and at the source of the poses")


_WHOLE = 0.9
"""Minimum fraction of the usual samples of a stream during a gap that the stream does not have."""

_LATE = seconds(0.1)
"""Additional latency, nanoseconds, from which the sample after a gap was held up."""

_WAY = Fix("look at the load, at the network and at the queues at that time")
"""Remedy for a gap that the publisher may not have caused."""


def _sent(model: Model, track: Track, begin: int, end: int) -> str:
    """Return a clause if Odometry messages show that an edge's samples in a gap were sent.

    The messages have the same frames and mostly the same stamps as the edge. Without such messages
    in the gap, the clause is empty.
    """
    odometry = model.evidence.odometry
    for edge in () if odometry is None else odometry.edges:
        assert odometry is not None
        told = Track(edge, odometry)
        inside = np.count_nonzero((told.stamps > begin) & (told.stamps < end))
        is_same = told.edge == track.edge and np.isin(track.stamps, told.stamps).mean() > _SAME
        if inside > 1 and is_same:
            return (
                f"; {told.topics[0]}, which has the same stamps, has {int(inside)} messages in the "
                "gap"
            )
    return ""


_SAME = 0.5
"""Minimum fraction of an edge's stamps that are also those of the Odometry messages."""


def _in_service(model: Model, track: Track, limits: Limits) -> list[tuple[int, int]]:
    """Return the gaps of `holes` that do not begin at the edge's first sample.

    Gaps that end before the start of the recording are left out too.
    """
    found = holes(track, limits)
    if not found or not model.evidence.timed:
        return found
    first = int(track.sorted_stamps[0])
    return [one for one in found if one[0] != first and model.log_of(one[1]) >= model.start]


def _is_going_on(stream: Track | Heard, begin: int, end: int, share: float = 0.5) -> bool:
    """Whether a stream has at least half of its usual samples between two stamps.

    The stamps `begin` and `end` bound a gap of another stream. For a larger `share` of the samples,
    one more may be missing.
    """
    inside = np.count_nonzero((stream.stamps > begin) & (stream.stamps < end))
    usual = len(stream.stamps) * (end - begin) / max(1, int(np.ptp(stream.stamps)))
    return bool(usual > 2 and inside > max(0.5 * usual, share * usual - 1))


def _is_silent(stream: Track | Heard, begin: int, end: int) -> bool:
    """Whether a stream has no samples in the middle of another stream's gap.

    For a stream of low rate, or of messages about nodes, the result is False. The stamps `begin`
    and `end` bound the gap.
    """
    if isinstance(stream, Heard) and stream.type.startswith(REPORTS):
        return False
    margin = (end - begin) // 5
    low, high = np.searchsorted(np.sort(stream.stamps), (begin + margin, end - margin))
    usual = len(stream.stamps) * (end - begin - 2 * margin) / max(1, int(np.ptp(stream.stamps)))
    return bool(0 < low == high < len(stream.stamps)) and usual > 2


def _has_holes(stream: Heard, track: Track, wide: Places) -> bool:
    """Whether a topic that is as fast as an edge has no stamps in nearly all holes of the edge.

    Args:
        stream: The headers of the topic.
        track: The edge.
        wide: For each hole, the index in `track.sorted_stamps` of the sample before it, shape (n,).
    """
    stamps = np.sort(stream.stamps)
    if len(stamps) < 2 or float(np.median(np.diff(stamps))) > 1.5 * track.period:
        return False
    margin = track.period // 4
    low = np.searchsorted(stamps, track.sorted_stamps[wide] + margin)
    high = np.searchsorted(stamps, track.sorted_stamps[wide + 1] - margin)
    shared = (low > 0) & (low == high) & (high < len(stamps))
    return bool(shared.mean() >= _SHARED)


_SHARED = 0.9
"""Minimum fraction of an edge's holes that a topic has too, if both have one source."""


def _without_pose(model: Model, track: Track, begin: int, end: int) -> int:
    """Count the empty messages of an edge's only publisher in a gap of the edge.

    The result is 0 if the publisher is unknown, or sent less than half of its usual messages.

    Args:
        model: Model of the evidence.
        track: The edge.
        begin: Stamp before the gap.
        end: Stamp after the gap.
    """
    transforms = model.evidence.transforms
    if len(track.publishers) != 1 or not model.evidence.timed:
        return 0
    (publisher,) = track.publishers
    others = (one for one in model.tracks if one is not track and publisher in one.publishers)
    if not publisher.node and any(others):
        return 0  # several nodes may send on the topic
    logs = transforms.log_times
    inside = (logs > model.log_of(begin)) & (logs < model.log_of(end)) & model.empty_messages
    number = int(np.count_nonzero(inside & (transforms.senders == track.senders[0])))
    return number if 2 * number * track.period > end - begin else 0


def _cause(model: Model, track: Track, hole: tuple[int, int], silent: bool) -> tuple[str, Fix]:
    """Return a clause about what an edge's publisher sent in a gap, and the remedy.

    Args:
        model: Model of the evidence.
        track: The edge.
        hole: Stamps before and after the gap.
        silent: Whether other streams have the same gap.
    """
    if empty := _without_pose(model, track, *hole):
        text = f"; its publisher sent {count(empty, 'message')} without a transform in the gap"
        return text, Fix(
            "its publisher continued without a pose: its source did not see the object"
        )
    if sent := _sent(model, track, *hole):
        return sent, Fix("the samples were lost on the way: look at the network and the queues")
    return ("", _SOURCE) if silent else _publisher_at(model, track, *hole)


@check(
    "coarse-odometry",
    Severity.NOTE,
    rule="the robot turns by more than {degrees:g}° between two samples of its odometry, among "
    "{samples:g} samples or more. Scans or point clouds come {times:g} times as often as the "
    "odometry",
    headline="{where} {concerned:turns|turn} by up to {turn:deg} between two samples",
    detail="{edge}: {count:times} by more than {least:deg}; {hz:.3g} Hz, {topic} {often:.3g} Hz",
    consequence="a lookup interpolates between two samples, and misses the motion between them",
    causes=("odometry at a low rate",),
    limits={"degrees": 20.0, "times": 2.0, "samples": 20},
    needs=("headers",),
    because_of=(
        ("child", "publisher-conflict two-parents static-and-dynamic"),
        ("edge", "gap edge-stopped teleport clock-offset frozen-stamp"),
    ),
)
def coarse_odometry(model: Model, limits: Limits) -> Iterator[Hit]:
    """Odometry is slower than the scans, and the robot turns far between two samples."""
    scans = [heard for heard in model.heard if last_part(heard.type) in PLACED]
    fastest = max(scans, key=rate, default=None)
    for track in model.dynamic:
        places = track.by_stamp
        is_base = last_part(track.parent).startswith("odom") and last_part(track.child) in BASES
        if fastest is None or not is_base or len(places) < limits["samples"]:
            continue
        if rate(fastest) < limits["times"] * rate(track):
            continue
        turned = track.turned(places[1:], places[:-1])
        least = float(np.radians(limits["degrees"]))
        far = int(np.count_nonzero(turned > least))
        if far > 1:
            facts = {
                "turn": float(turned.max()),
                "count": far,
                "least": least,
                "hz": rate(track),
                "topic": fastest.topic,
                "often": rate(fastest),
            }
            yield hit_of(track, facts, topics=(fastest.topic,), count=far)


@check(
    "single-sample",
    Severity.WARNING,
    rule="a transform on a topic for moving transforms was sent once. A note if the recording "
    "contains no other data, or lasts less than 1 s. A note also for one of three or more objects "
    "of one publisher that come and go, and for a frame in map, odom or world if no message with a "
    "position is in this frame or below it",
    headline="{where} {concerned:was|were} sent once, on /tf",
    detail="{edge}: at {stamp:moment}{beside}",
    consequence="lookups at other times fail",
    causes=("a mount sent with a TransformBroadcaster",),
    why="tf2 interpolates between two samples, and never extrapolates from a single sample",
    because_of=(
        ("child", "static-and-dynamic"),
        ("edge", "zero-stamp placeholder-pose"),
    ),
)
def single_sample(model: Model, limits: Limits) -> Iterator[Hit]:
    """A moving frame has only one sample."""
    for track in model.dynamic:
        if len(track.stamps) == 1 and len(track.by_stamp) == 1:
            sender = several(track.nodes) or "its publisher"
            beside, fix = (
                "",
                Fix(f"if the frame rests, let {sender} send it on /tf_static, else regularly"),
            )
            alike = [other for other in model.dynamic if _is_sibling(track, other)]
            is_passing = track.child in model.passing
            if is_passing or (alike and is_detection(model, track)):
                names = [f"{one.child} {count(len(one.stamps), 'time')}" for one in alike]
                beside = f"; {several(names, 3)}" if names else ""
                fix = Fix("probably a false detection: check whether the object was there")
            is_short = model.end - model.start < NANOSECONDS
            is_all = is_short or (len(model.tracks) == 1 and not model.heard)
            is_shown = _is_used(model, track) and not is_all and not is_passing
            yield hit_of(
                track,
                {"stamp": int(track.stamps[0]), "beside": beside},
                topics=track.topics,
                count=1,
                severity=None if is_shown else Severity.NOTE,
                fixes=(fix,),
                group=f"{fix.text}{beside}",
            )


def _is_sibling(track: Track, other: Track) -> bool:
    """Whether the children of both edges are objects of one kind, and `other` has many samples.

    Such edges have one parent, and children such as marker_7 and marker_12.
    """
    alike = (other.parent, family(other.child)) == (track.parent, family(track.child))
    return alike and len(other.stamps) >= _OFTEN


_OFTEN = 50
"""Number of detections of other objects beside which a single detection is suspicious."""
