"""Checks of delays between a stamp and the arrival of its transform or message."""

from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp, seconds
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import STALE_AFTER, Area, Fact, Fix, Hit, Severity
from tftool.doctor.gap_checks import is_detection
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_checks import COMPARE_CLOCKS, stands_still
from tftool.doctor.stamp_stream import ROUNDED, Heard, Track, are_same, last_part
from tftool.doctor.wording import moment, several, span
from tftool.recordings.contract import percentile

check = checks_of(Area.CLOCKS)


@check(
    "stale-stamp",
    Severity.NOTE,
    rule="the median latency is above {transforms:g} s for a transform or {messages:g} s for "
    "messages. A warning in five cases. Another topic with the same stamps, or from which the "
    "late topic is computed, arrives in time. The poses of a transform with a latency above "
    "{odometry:g} s arrive in time in Odometry messages. A transform is steadily late, and a "
    "moving transform in the same tree arrives in time. One sample in ten of a moving transform "
    "is later than {tenth:g} s and {often:g} times the median, while other data arrives in time. "
    "One in twenty poses of a regular topic is later than {burst:g} s and {rarely:g} times the "
    "median. Not reported if all late data arrives within 0.2 s",
    headline="{where} {concerned:is|are} dated {upto}{late:span} before {concerned:its|their} "
    "arrival",
    detail="{what}: {late:span} late ({of}){varies}",
    consequence="a program that uses the present time gets older data, or none",
    causes=(
        "the stamp is copied from an old measurement",
        "the publisher's clock is behind",
        "a slow network",
    ),
    links=threads("cartographer-project/cartographer_ros#143"),
    limits={
        "transforms": STALE_AFTER,
        "messages": 2.0,
        "odometry": 0.2,
        "tenth": 0.25,
        "often": 4.0,
        "burst": 0.2,
        "rarely": 8.0,
    },
    needs=("log times",),
    because_of=(
        ("anything", "time-jump-back"),
        ("stream", "clock-mixture"),
        ("stream", "cache-short"),
        ("stream", "clock-offset"),
    ),
)
def stale_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms or messages are stamped long before they arrive."""
    for track in model.dynamic:
        least = limits["transforms"] * NANOSECONDS
        if track.is_localisation:
            least = max(least, track.period)
        if len(track.stamps) < 2 or stands_still(track):
            continue
        if (told := _in_time(model, track, limits["odometry"])) is not None:
            yield told
        elif track.median_latency > least:
            yield _late(model, track)
        elif (late := _falls_behind(model, track, limits)) is not None:
            yield late
    for heard in model.heard:
        # A latched message may be old, and without motion an old message is as good as a new one.
        if len(heard.stamps) < 3 or not heard.is_spatial or model.rests(heard.frame):
            continue
        if heard.median_latency > limits["messages"] * NANOSECONDS and not stands_still(heard):
            yield _late(model, heard)
    poses = [_falls_behind(model, heard, limits) for heard in model.heard]
    # The latest of them is in the headline.
    yield from sorted(filter(None, poses), key=lambda hit: -_most_late(hit))


def _most_late(hit: Hit) -> int:
    late = hit.facts["late"]
    assert isinstance(late, int)
    return late


def _falls_behind(model: Model, track: Track | Heard, limits: Limits) -> Hit | None:
    """Return a hit if some data of an edge or topic is late while other data arrives in time."""
    if len(track.stamps) < _FEWEST_LATE:
        return None
    if isinstance(track, Track):
        share, told, least, times = 90, "one in ten", limits["tenth"], limits["often"]
        is_judged = track.moves and not track.is_localisation
    else:
        share, told, least, times = 95, "one in twenty", limits["burst"], limits["rarely"]
        is_judged = _is_regular_pose(track)
    usual, tenth = (int(percentile(track.latency, percent)) for percent in (50, share))
    if not is_judged or tenth < max(least * NANOSECONDS, times * usual):
        return None
    late = np.flatnonzero(track.latency >= tenth)
    begin, end = int(track.logs[late[0]]), int(track.logs[late[-1]])
    if end - begin < _BURST:
        # Everything arrives at once: a backlog, as at the start of a recorder.
        return None
    others: list[Track | Heard] = [h for h in model.heard if h.is_spatial]
    # A localiser dates its transforms ahead, so they always seem to be in time.
    others += [one for one in model.dynamic if one is not track and not one.is_localisation]
    prompt = [other.name for other in others if _is_prompt(other, begin, end, tenth)]
    if not prompt:
        return None
    facts: dict[str, Fact] = {
        "what": track.name,
        "upto": "up to ",
        "late": int(track.latency.max()),
        "of": "at most",
        "varies": f"; {told} {span(tenth)} or more, usually {span(usual)}",
    }
    when = f"from {moment(begin)} to {moment(end)}"
    cure = f"look at its publisher and the network {when}: {several(prompt, 3)} arrived in time"
    alone, group = isinstance(track, Track), "poses"
    given = {"severity": Severity.WARNING, "count": len(late), "fixes": (Fix(cure),)}
    return hit_of(track, facts, alone=alone, group=group, **given)


def _is_prompt(stream: Track | Heard, begin: Stamp, end: Stamp, late: int) -> bool:
    """Whether a stream's items arrived in time while another stream was late.

    Args:
        stream: The stream.
        begin: Log time of the first late item of the other stream.
        end: Log time of the last late item of the other stream.
        late: Latency of the other stream, nanoseconds.
    """
    is_near = (stream.logs >= begin - NANOSECONDS) & (stream.logs <= end + NANOSECONDS)
    latency = stream.latency[is_near]
    if len(stream.stamps) <= _FEWEST_LATE or len(latency) < _FEWEST_NEAR:
        return False
    return 4 * max(abs(percentile(latency, percent)) for percent in (5, 95)) < late


def _is_regular_pose(heard: Heard) -> bool:
    """Whether a topic has poses at a constant rate, such as those of a motion capture system."""
    steps = np.diff(np.sort(heard.stamps))
    is_pose = heard.type in ("geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped")
    return is_pose and bool(np.mean(steps < 2 * np.median(steps)) > _REGULAR)


_REGULAR = 0.95
"""Minimum fraction of steps between stamps that are near the period of a regular topic."""

_FEWEST_LATE = 50
"""Minimum number of samples for a judgement of the latest tenth."""

_FEWEST_NEAR = 10
"""Minimum number of items from a second before the late data to a second after it."""

_BURST = seconds(0.2)
"""Maximum time in which a backlog arrives, nanoseconds."""

_STEADY = seconds(0.1)
"""Maximum variation, from 10 % to 90 % quantile, of a delay that no queue causes."""


def _in_time(model: Model, track: Track, least: float) -> Hit | None:
    """Return a hit if a late transform's poses arrive in time on an Odometry topic; else None.

    Args:
        model: Model of the evidence.
        track: The transform.
        least: Minimum median latency of a late transform, seconds.
    """
    odometry = model.evidence.odometry
    is_late = track.median_latency > least * NANOSECONDS
    if odometry is None or not is_late or not track.moves:
        return None
    for edge in odometry.edges:
        other = Track(edge, odometry)
        if other.edge != track.edge or len(other.stamps) < _FEWEST_POSES:
            continue
        by = 0 if model.shift is None else model.shift.by
        latency = int(np.median(other.logs - other.stamps)) - by
        if 4 * abs(latency) > track.median_latency:
            continue
        # The message of a pose arrives at nearly the same time as the transform.
        after = np.searchsorted(other.logs, track.logs)
        own = np.arange(len(track.stamps))
        near = [np.clip(after + step, 0, len(other.logs) - 1) for step in (-1, 0)]
        same = [are_same(track, own, other, one) for one in near]
        if np.mean(same[0] | same[1]) < _SAME_POSES:
            continue
        rows = np.where(same[1], near[1], near[0])
        told = other.translations[rows]
        later = (other.stamps[rows] - track.stamps)[same[0] | same[1]]
        signs = (np.abs(track.translations - told) > ROUNDED).mean(axis=0) > 0.5
        axes = [axis for axis, differs in zip("xyz", signs.tolist(), strict=True) if differs]
        but = f" (with another sign of {', '.join(axes)})" if axes else ""
        topic = other.topics[0]
        facts = {"what": track.name, "late": track.median_latency, "varies": "", **_median(model)}
        cure = (
            f"{topic} has the same poses{but}, stamped {span(int(np.median(later)))} later: look "
            "at where the publisher of the transform takes its stamps from"
        )
        return hit_of(track, facts, severity=Severity.WARNING, fixes=(Fix(cure),))
    return None


_FEWEST_POSES = 10
"""Minimum number of Odometry messages that show the right stamps of their poses."""

_SAME_POSES = 0.8
"""Minimum share of a transform's samples with the pose of an Odometry message."""


def _median(model: Model) -> dict[str, Fact]:
    """Return the facts of a median latency, which does not contain a shifted clock's offset."""
    shift = model.shift
    apart = (
        "" if shift is None else f", without the {span(abs(shift.by))} by which the clock is off"
    )
    return {"upto": "", "of": f"median{apart}"}


def _late(model: Model, stream: "Track | Heard") -> Hit:
    low, high = (int(percentile(stream.latency, percent)) for percent in (10, 90))
    varies = f", from {span(low)} to {span(high)} for 80 %" if high - low > _STEADY else ""
    shown = _relayed_late(model, stream)
    for other in model.heard if isinstance(stream, Track) else ():
        # No node can copy the stamp of a message that has not arrived.
        soon = 4 * abs(other.median_latency) < stream.median_latency
        if soon and not shown and np.isin(stream.stamps, other.stamps).mean() > 0.5:
            shown = (
                f"{other.topic} has the same stamps, {span(other.median_latency)} late: these "
                "messages wait in their publisher or on their way, and no clock is the cause"
            )
    facts = {"what": stream.name, "late": stream.median_latency, "varies": varies, **_median(model)}
    if isinstance(stream, Track) and not shown and 2 * (high - low) < stream.median_latency:
        prompt = _prompt_beside(model, stream)
        if prompt:
            shown = f"{several(prompt, 3)} of the same tree arrived in time: {COMPARE_CLOCKS.text}"
    if not shown:
        return hit_of(stream, facts, fixes=() if varies else (COMPARE_CLOCKS,))
    return hit_of(stream, facts, severity=Severity.WARNING, fixes=(Fix(shown),))


def _prompt_beside(model: Model, track: Track) -> list[str]:
    """Return the names of moving transforms that arrive in time, in the tree of a late edge.

    The result is empty for a localiser, and for objects that a camera detects, because their poses
    take time to compute. It is also empty for an edge on another clock: see `clock-offset`.
    """
    above = [
        one for one in model.above(track.child) if 2 * one.median_latency > track.median_latency
    ]
    if track.is_localisation or track in model.unshifted:
        return []
    if any(is_detection(model, one) for one in above[-1:]):
        return []
    tree = model.tree_of[track.child]
    return [
        one.name
        for one in model.dynamic
        if one.moves
        and not one.is_localisation
        and len(one.stamps) >= _FEWEST_LATE
        and one.child in tree.frames
        and 4 * abs(one.median_latency) < track.median_latency
    ]


def _relayed_late(model: Model, stream: "Track | Heard") -> str:
    """Return a remedy if a node received data in time but sent it late; else an empty string."""
    for source in model.heard:
        if not source.is_spatial or 4 * abs(source.median_latency) > stream.median_latency:
            continue
        part = last_part(source.topic)
        for other in model.heard:
            made = last_part(other.topic)
            is_late = 2 * other.median_latency > stream.median_latency
            is_same = (other.type, other.frame) == (source.type, source.frame)
            is_made = made != part and made.endswith(part) and stream.name.endswith(made)
            if is_late and is_same and is_made:
                told = " and ".join(sorted({stream.name, other.topic}))
                return (
                    f"{source.topic} arrives {span(source.median_latency)} after its stamp, and "
                    f"{told} late: look at the node that makes {other.topic} from it"
                )
    return ""
