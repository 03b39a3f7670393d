"""Check of jumps: a frame moves faster than it can."""

from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp, seconds
from tftool.doctor.check import REP105, checks_of, hit_of, threads
from tftool.doctor.findings import Area, Edge, Hit, Severity
from tftool.doctor.gap_checks import base_at, is_detection
from tftool.doctor.missing_joins import is_world
from tftool.doctor.model import WARM_UP, Limits, Model
from tftool.doctor.pose_checks import OUTLIER, look_at, marker_fix, outliers
from tftool.doctor.stamp_stream import BASES, Places, Track, last_part
from tftool.doctor.wording import metres, moment, several, span
from tftool.geometry.rigid_arrays import Floats, rotate, unit
from tftool.recordings.contract import Stamps, percentile

check = checks_of(Area.VALUES)


@check(
    "teleport",
    Severity.WARNING,
    rule="a step is above {metres:g} m at more than {speed:g} m/s (or above {radians:g} rad at "
    "more than {turning:g} rad/s), and its speed is {times:g} times the 95 % quantile of all "
    "speeds. Such steps are at most a share of {share:g} of all steps ({triggered:g} if each step "
    "comes within 50 ms after a position message) or at most {few:g} steps, among {samples:g} "
    "samples or more of one publisher. A note for a part of a robot if no sensor message is in its "
    "frame, and for one of three or more objects of one publisher that come and go. A localiser is "
    "reported for {corrections:g} steps or more that move the robot by {corrected:g} m, not "
    "counting the step to an initial pose. One such step of {once:g} m, {steady:g} s or more after "
    "the first sample, is enough, unless a gap or a message with an initial pose comes before it. "
    "An object that a camera detects is reported for "
    "{corrections:g} steps or more of {detected:g} m and 2 m/s within 1 s; after a gap of three "
    "periods, at twice the 95 % quantile of all speeds. Not reported in a world "
    "frame for a step less than 1 s after a gap of 0.2 s and 8 periods or more, if the "
    "speed from the last pose before the gap is below {speed:g} m/s. If the turn is a jump too, "
    "the step must be at most one period after the gap, and the turn since the gap below 90°",
    headline="{named}",
    detail="{edge}: {jump:m} and {turn:deg} at {at:moment}, {count:times}{others}{usual}{after}",
    consequence="data placed before and after the jump does not fit together{also}",
    causes=(
        "encoder overflow",
        "a reset of the filter",
        "wheel slip",
        "a satellite receiver in the filter of the odometry",
        "a localiser that is lost",
    ),
    links=(
        *threads("ROBOTIS-GIT/turtlebot3#926"),
        REP105,
    ),
    limits={
        "metres": 0.25,
        "speed": 5.0,
        "radians": 0.5,
        "turning": 20.0,
        "times": 8.0,
        "share": 0.02,
        "triggered": 0.05,
        "few": 3,
        "samples": 10,
        "corrections": 3,
        "corrected": 0.5,
        "once": 2.0,
        "steady": 10.0,
        "detected": 1.0,
    },
    why="steady motion has a usual speed, which a jump exceeds. More jumps than the rule allows "
    "are noise, or come from two publishers",
    because_of=(
        ("anything", "time-jump-back"),
        ("mixed", "publisher-conflict two-parents"),
        ("edge", "placeholder-pose frozen-pose"),
    ),
)
def teleport(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame jumps faster than it can move."""
    is_named = model.has_named_publishers
    for track in model.dynamic:
        if track.is_localisation:
            corrected = _corrections(model, track, limits)
            if corrected is not None:
                yield corrected
            continue
        senders = track.senders[track.by_stamp] if is_named and len(track.nodes) > 1 else None
        for number in (0,) if senders is None else np.unique(senders).tolist():
            places = track.by_stamp if senders is None else track.by_stamp[senders == number]
            hit = _jump(model, track, places, limits) if len(places) >= limits["samples"] else None
            if hit is not None and _is_of_a_person(model, track):
                hit = None
            hit = hit or _poor_detections(model, track, limits)
            if hit is not None:
                yield hit


def _jump(model: Model, track: Track, places: Places, limits: Limits) -> Hit | None:
    """Return a hit about jumps in one publisher's samples of an edge; None without jumps.

    Args:
        model: Model of the evidence.
        track: The edge.
        places: Indices of the publisher's samples, sorted by stamp, shape (n,).
        limits: Thresholds of `teleport`.
    """
    some, others = places[:-1], places[1:]
    is_whole = len(places) == len(track.by_stamp)
    apart = track.strides if is_whole else track.apart(some, others)
    spins = track.has_turns(some, others, limits["radians"])
    if not spins and not (apart > limits["metres"]).any():
        return None
    stamps = track.sorted_stamps if is_whole else track.stamps[places]
    gaps = np.diff(stamps) / NANOSECONDS
    later = gaps > 0.0
    gaps = np.where(later, gaps, 1.0)
    turned = track.turned(some, others)
    moved = _jumps(apart, gaps, limits["metres"], limits["speed"], limits["times"])
    spun = _jumps(turned, gaps, limits["radians"], limits["turning"], limits["times"])
    jumps = np.flatnonzero((moved | spun) & later)
    if is_whole and len(jumps):
        # The check `outlier` reports the steps away and back.
        ends = [end - 1 for run in outliers(track, OUTLIER) for end in run]
        jumps = np.setdiff1d(jumps, ends)
        if is_world(track.parent) and not track.is_odometry:
            kept = [
                not _ends_gap(track, jump, limits, spun=bool(spun[jump])) for jump in jumps.tolist()
            ]
            jumps = jumps[np.array(kept, dtype=np.bool_)]
    topic, after = _trigger(model, track.logs[others[jumps]])
    share = limits["triggered"] if topic else limits["share"]
    if not len(jumps) or len(jumps) > max(limits["few"], share * len(gaps)):
        return None
    worst = int(jumps[np.argmax(apart[jumps])])
    if not moved[worst]:
        worst = int(jumps[np.argmax(turned[jumps])])
    is_odometry = last_part(track.parent).startswith("odom")
    also = "; REP-105 wants this transform continuous" if is_odometry else ""
    usual = float(np.median(apart[later] / gaps[later]))
    far = metres(float(apart[worst])) if moved[worst] else f"{np.degrees(turned[worst]):.3g}°"
    within, told = int(stamps[worst + 1] - stamps[worst]), ""
    changes = np.flatnonzero((apart > _SAME) | (turned > _SAME))
    if len(before := changes[changes < worst]):
        # A pose that is repeated with new stamps was measured when it was new. A robot that rests
        # for long also repeats its pose, but does not jump in that time.
        new = int(before[-1]) + 1
        since = int(stamps[worst + 1] - stamps[new])
        if within < since <= 3 * np.median(np.diff(stamps[changes])):
            within, told = since, f"; the previous pose is sent {worst + 1 - new} times"
    how = f" within {span(within)}"
    first = "" if topic else _first_message(model, int(track.logs[others[worst]]))
    return hit_of(
        track,
        {
            "jump": float(apart[worst]),
            "turn": float(turned[worst]),
            "far": far,
            "named": f"{track.name} jumps {far}{how}",
            "within": within,
            "how": how,
            "at": int(track.stamps[others[worst]]),
            "others": _others(track, others[jumps], int(others[worst])),
            "usual": f"{told}; usual {usual:.2g} m/s" if usual else told,
            "after": f"; each at most {span(after)} after a message of {topic}" if topic else first,
            "count": len(jumps),
            "also": also,
            "mixed": is_whole,
        },
        since=int(track.logs[others[jumps[0]]]),
        until=int(track.logs[others[jumps[-1]]]),
        count=len(jumps),
        severity=Severity.NOTE if model.is_minor(track) or track.child in model.passing else None,
        group=also,
        fixes=(
            *look_at(model, track.edge, *track.stamps[places[[worst, worst + 1]]].tolist()),
            *marker_fix(track, float(turned[worst])),
        ),
    )


def _ends_gap(track: Track, jump: int, limits: Limits, *, spun: bool) -> bool:
    """Whether the frame may have moved to the pose after a jump since the begin of a recent gap.

    The gap ends less than 1 s before the jump. If a tracker's poses are delayed, they are often
    stamped on arrival, so the frame seems to catch up in one step after the gap.

    Args:
        track: The edge.
        jump: Index in `track.by_stamp` of the sample before the jump.
        limits: Thresholds of `teleport`.
        spun: Whether the frame also turns. Then the gap must end at most one period before the
            jump, and the turn since its begin must be below 90°: a larger turn is a tracker's flip.
    """
    stamps, after = track.sorted_stamps, jump + 1
    steps = np.diff(stamps[:after])
    least = max(_HELD_UP, _HELD_PERIODS * track.period)
    soon = track.period + 1 if spun else NANOSECONDS
    gaps = np.flatnonzero((steps >= least) & (stamps[jump] - stamps[1:after] < soon))
    before, here = track.by_stamp[gaps], np.full(len(gaps), track.by_stamp[after])
    since = (stamps[after] - stamps[gaps]) / NANOSECONDS
    may_move = track.apart(before, here) < limits["speed"] * since
    if spun:
        may_move &= track.turned(before, here) < np.pi / 2
    return bool(may_move.any())


_HELD_UP = seconds(0.2)
"""Shortest gap, nanoseconds, after which a frame may seem to catch up in one step."""

_HELD_PERIODS = 8
"""Fewest usual periods in such a gap."""


def _is_of_a_person(model: Model, track: Track) -> bool:
    """Whether an edge is one of several limbs that a tracker of people sends below its sensor.

    The limbs jump when the tracker finds a person or loses a limb, and nothing is placed on them.
    """
    if is_world(track.parent) or last_part(track.parent) in BASES:
        return False
    frames = {heard.frame for heard in model.heard}
    limbs = [
        one
        for one in model.dynamic
        if (one.parent, one.nodes) == (track.parent, track.nodes)
        and len(model.below(one.child)) == 1
        and one.child not in frames
    ]
    return track in limbs and len(limbs) >= _FEWEST_LIMBS


_FEWEST_LIMBS = 4
"""Minimum number of frames without children, directly below one sensor, that show a person."""


def _others(track: Track, places: Places, worst: int) -> str:
    """Return the stamps of all jumps except the worst jump, as a clause of a sentence."""
    others = [moment(int(track.stamps[place])) for place in places.tolist() if place != worst]
    return f"; also at {several(others)}" if others else ""


def _corrections(model: Model, track: Track, limits: Limits) -> Hit | None:
    """Return a hit if a localiser corrects the robot's pose again and again; else None.

    A first step that is also the largest step is the initial pose, and does not count.
    """
    is_few = len(track.by_stamp) < max(limits["samples"], 1)
    if is_few or last_part(track.parent).startswith("odom"):
        return None
    # tf2 keeps the first of several samples with one stamp.
    places = track.by_stamp[np.append(True, np.diff(track.sorted_stamps) > 0)]
    some, others = places[:-1], places[1:]
    robot, shown = np.zeros((len(others), 3)), track.edge
    # A step across a long pause, or from the stamps of one clock to those of another, is none.
    is_step = np.diff(track.stamps[places]) < model.settings.cache_time
    if (base := base_at(model, track, track.logs[others])) is not None:
        below, rows = base
        rows = rows.clip(1)
        robot = below.translations[rows]
        pauses = below.logs[rows] - below.logs[rows - 1]
        is_step &= track.logs[others] <= below.logs[-1]
        is_step &= pauses < model.settings.cache_time
        shown = track.parent, below.child
    # A turn of odom moves the robot by its distance from the origin of odom.
    before, after = (
        track.translations[one] + rotate(unit(track.rotations[one]), robot)
        for one in (some, others)
    )
    moved = np.linalg.norm(after - before, axis=1)
    steps = np.flatnonzero((moved > limits["corrected"]) & is_step)
    also, after = "; the localiser may be lost", f", measured at {shown[1]}"
    if len(steps) == 1 and _is_lonely(model, track, places, moved, int(steps[0]), limits):
        steady = span(int(track.stamps[places[steps[0]]] - track.stamps[places[0]]))
        words = f"after {steady} without a step of {limits['corrected']:g} m", after, ""
        return _repeated_jumps(model, track, places, (steps, moved), words, shown)
    if len(steps) and moved[steps[0]] > 0.999 * moved.max():
        steps = steps[1:]
    if len(steps) < limits["corrections"]:
        return None
    how = f"{limits['corrected']:g} m: its localiser corrects it again and again"
    return _repeated_jumps(model, track, places, (steps, moved), (how, after, also), shown)


def _is_lonely(
    model: Model, track: Track, places: Places, moved: Floats, step: int, limits: Limits
) -> bool:
    """Whether the only large step of a localiser is a jump, and no initial pose and no gap.

    Args:
        model: Model of the evidence.
        track: The edge from map to odometry.
        places: Rows of its samples, sorted by stamp, shape (n + 1,).
        moved: Distance by which each step moves the robot, metres, shape (n,).
        step: Index of the step.
        limits: Thresholds of `teleport`.
    """
    stamps = track.stamps[places]
    log = int(track.logs[places[step + 1]])
    asked = [
        heard.logs
        for heard in model.heard
        if last_part(heard.topic).startswith("initial") and "Pose" in heard.type
    ]
    return bool(
        moved[step] >= limits["once"]
        and stamps[step] - stamps[0] >= limits["steady"] * NANOSECONDS
        and stamps[step + 1] - stamps[step] <= 2 * track.period
        and not any(((logs <= log) & (logs > log - _ASKED)).any() for logs in asked)
    )


_ASKED = seconds(5)
"""Time, nanoseconds, within which a localiser takes over an initial pose."""


def _poor_detections(model: Model, track: Track, limits: Limits) -> Hit | None:
    """Return a hit if a detected object jumps by metres from detection to detection; else None."""
    if is_world(track.parent) or len(track.by_stamp) < 2 or not is_detection(model, track):
        return None
    gaps = np.diff(track.sorted_stamps) / NANOSECONDS
    # After a time without detections, a fast object has moved on.
    fast = percentile(track.strides[gaps > 0.0] / gaps[gaps > 0.0], 95) if gaps.any() else 0.0
    is_next = (gaps * NANOSECONDS <= 3 * track.period) | (track.strides > 2.0 * fast * gaps)
    far = (track.strides > limits["detected"]) & (track.strides > 2.0 * gaps) & (gaps < 1.0)
    steps = np.flatnonzero(far & is_next)
    if len(steps) < limits["corrections"]:
        return None
    away = np.linalg.norm(track.translations[track.by_stamp], axis=1)
    after = f"; seen at {away.min():.3g} m to {metres(float(away.max()))}"
    words = f"{limits['detected']:g} m within 1 s", after, ""
    every = track.by_stamp
    return _repeated_jumps(model, track, every, (steps, track.strides), words, track.edge)


def _repeated_jumps(
    model: Model,
    track: Track,
    places: Places,
    jumps: tuple[Places, Floats],
    words: tuple[str, str, str],
    shown: Edge,
) -> Hit:
    """Return a hit about several steps of an edge.

    Args:
        model: Model of the evidence.
        track: The edge.
        places: Rows of the samples, sorted by stamp, shape (n + 1,).
        jumps: Indices of the reported steps, shape (m,), and lengths of all steps, metres,
            shape (n,).
        words: Clauses about the size of the steps, the longest step, and the consequence.
        shown: Target and source of the lookup that shows the steps.
    """
    steps, moved = jumps
    worst = int(steps[moved[steps].argmax()])
    far = f"by up to {metres(float(moved[worst]))}"
    how = f", {len(steps)} times by more than {words[0]}"
    if len(steps) == 1:
        far, how = metres(float(moved[worst])), f", {words[0]}"
    return hit_of(
        track,
        {
            "jump": float(moved[worst]),
            "turn": float(track.turned(places[[worst]], places[[worst + 1]])[0]),
            "far": far,
            "how": how,
            "named": f"{track.name} jumps {far}{how}",
            "at": int(track.stamps[places[worst + 1]]),
            "others": _others(track, places[steps + 1], int(places[worst + 1])),
            "usual": "",
            "after": words[1],
            "count": len(steps),
            "also": words[2],
            "mixed": True,
        },
        since=int(track.logs[places[steps[0] + 1]]),
        until=int(track.logs[places[steps[-1] + 1]]),
        count=len(steps),
        severity=Severity.NOTE if track.child in model.passing else None,
        group=words[2],
        fixes=look_at(model, shown, *track.stamps[places[[worst, worst + 1]]].tolist()),
    )


_SAME = 1e-6
"""Distance, metres, or angle, radians, below which two poses are one pose."""

_SOON = seconds(0.05)
"""Maximum time, nanoseconds, from a message to the jump that it triggers."""


def _trigger(model: Model, jumps: Stamps) -> tuple[str, int]:
    """Find the position topic of low rate, such as GPS, whose messages trigger all jumps.

    Args:
        model: Model of the evidence.
        jumps: Log times of the jumps, nanoseconds, shape (n,).

    Returns:
        The topic, empty if there is none, and the longest delay from a message to its jump,
        nanoseconds.
    """
    best = "", _SOON
    for heard in model.heard:
        if last_part(heard.type) not in ("NavSatFix", "Odometry") or len(jumps) < 3:
            continue
        before = np.searchsorted(heard.logs, jumps, side="right") - 1
        delays = jumps - heard.logs[before]
        lasts = int(heard.logs[-1] - heard.logs[0])
        is_rare = 2 * len(heard.logs) * _SOON < lasts
        if is_rare and before.min() >= 0 and delays.max() < best[1]:
            best = heard.topic, int(delays.max())
    return best


def _first_message(model: Model, jump: Stamp) -> str:
    """Return a clause about a topic of positions that began with a jump; "" without such a topic.

    Args:
        model: Model of the evidence.
        jump: Log time of the jump, nanoseconds.
    """
    for heard in model.heard:
        since = jump - int(heard.logs[0])
        is_position = last_part(heard.type) in ("NavSatFix", "Odometry") or "Pose" in heard.type
        if is_position and 0 <= since < _SOON and heard.logs[0] > model.start + WARM_UP:
            return f"; the first message of {heard.topic} arrived {span(since)} before the jump"
    return ""


def _jumps(
    steps: "np.ndarray[tuple[int], np.dtype[np.float64]]",
    gaps: "np.ndarray[tuple[int], np.dtype[np.float64]]",
    least: float,
    speed: float,
    times: float,
) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    speeds = steps / gaps
    limit = max(speed, times * percentile(speeds, 95))
    found: np.ndarray[tuple[int], np.dtype[np.bool_]] = (steps > least) & (speeds > limit)
    return found
