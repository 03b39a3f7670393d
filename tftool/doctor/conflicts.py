"""Evidence that two sources publish one transform with different values."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tftool.base.stamps import CACHE_TIME, NANOSECONDS, seconds
from tftool.doctor.findings import Confidence, Fact, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import Mask, Places, Track, last_part
from tftool.doctor.wording import moment, several, span
from tftool.geometry.quaternions import angle_between
from tftool.geometry.rigid_arrays import (
    Floats,
    angles_between,
    conjugate,
    multiply,
    rotate,
    rotation_vectors,
    unit,
)
from tftool.recordings.contract import percentile

MOST_FOLLOWED = 20_000
"""Maximum number of an edge's samples that are followed one by one; these are enough evidence."""

_TWO_CLOCKS = seconds(1)
"""Difference between the latencies of two publishers above which they have two clocks."""

_RADIAN = 0.5
"""Length in metres that equals a radian, where one number combines a distance and an angle."""


def severity_of(model: Model, track: Track, hit: Hit, limits: Limits) -> Severity | None:
    """Return NOTE for a possible conflict, WARNING if likely or harmless, else None (the default).

    A likely conflict about a detected object that comes and goes is a noisy detection, a NOTE. A
    harmless conflict is between two nearly equal poses, or concerns a minor part of the robot,
    such as a wheel.
    """
    if hit.confidence is not Confidence.CERTAIN:
        is_noise = track.child in model.passing and len(track.publishers) == 1
        is_possible = hit.confidence is Confidence.POSSIBLE
        return Severity.NOTE if is_possible or is_noise else Severity.WARNING
    worst, turned = hit.facts["worst"], hit.facts["most_turned"]
    assert isinstance(worst, float)
    assert isinstance(turned, float)
    if worst < limits["slight"] and turned < np.radians(limits["slight_degrees"]):
        poses = np.hstack((track.translations, track.rotations))[track.by_stamp]
        if len(np.unique(poses.round(6), axis=0)) == 2:
            return Severity.WARNING
    return Severity.WARNING if model.is_minor(track) else None


def fed_twice(track: Track, hit: Hit, limits: Limits) -> Hit | None:
    """Return a hit if an edge's samples alternate between one fixed pose and other poses.

    Return None for other edges. A usual cause is a robot_state_publisher with two sources of joint
    states, if one source sends constant values.
    """
    if track.is_localisation or is_odometry(track) or hit.confidence is Confidence.CERTAIN:
        return None
    places = track.by_stamp[:MOST_FOLLOWED]
    poses = np.hstack((track.translations[places], track.rotations[places]))
    _, kinds, counts = np.unique(poses, axis=0, return_inverse=True, return_counts=True)
    rests = kinds.reshape(-1) == counts.argmax()
    moving, resting = places[~rests], places[rests]
    changes = np.count_nonzero(np.diff(rests))
    if changes < 0.3 * len(places) or len(counts) <= limits["samples"]:
        return None
    near = np.clip(
        np.searchsorted(track.stamps[resting], track.stamps[moving]), 0, len(resting) - 1
    )
    owned = (moving, resting[near])
    told = _conflict(track, ("A", "B"), owned, (moving, resting), Confidence.LIKELY)
    text = f"one value {len(resting):,} times, others {len(moving):,} times, alternating"
    facts = {**told.facts, "told": text}
    if not is_revolute(track) and not any("state_publisher" in node for node in track.nodes):
        return replace(told, facts=facts)
    cure = (
        "find who publishes joint states: `{publishers} /joint_states`; look which one always "
        "sends the same value"
    )
    return replace(told, facts=facts, fixes=(Fix(cure),))


def named_conflict(model: Model, track: Track, limits: Limits) -> Hit | None:
    """Return a hit if two nodes with known names publish different poses of an edge; else None."""
    places = track.by_stamp
    senders = track.senders[places]
    numbers, counts = np.unique(senders, return_counts=True)
    publishers = model.evidence.transforms.publishers
    named = [
        number
        for number, count in zip(numbers.tolist(), counts.tolist(), strict=True)
        if count >= limits["least"] and publishers[number].node
    ]
    for first, second in ((a, b) for i, a in enumerate(named) for b in named[i + 1 :]):
        if publishers[first].node == publishers[second].node:
            continue
        sent = mine, theirs = places[senders == first], places[senders == second]
        stamps, others = track.stamps[mine], track.stamps[theirs]
        if stamps[0] > others[-1] or others[0] > stamps[-1]:
            # Publishers on two clocks send at the same time, with other stamps.
            mine, theirs = (places[np.argsort(track.logs[places])] for places in (mine, theirs))
            stamps, others = track.logs[mine], track.logs[theirs]
            if stamps[0] > others[-1] or others[0] > stamps[-1]:
                continue
        inside = (stamps >= others[0]) & (stamps <= others[-1])
        stamps, mine = stamps[inside], mine[inside]
        if len(mine) < limits["least"]:
            continue
        after = np.clip(np.searchsorted(others, stamps), 1, len(others) - 1)
        nearer = np.abs(others[after] - stamps) < np.abs(others[after - 1] - stamps)
        nearest = theirs[np.where(nearer, after, after - 1)]
        apart, turned = track.apart(mine, nearest), track.turned(mine, nearest)
        step = float(np.median(track.apart(mine[1:], mine[:-1]))) if len(mine) > 1 else 0.0
        spin = float(np.median(track.turned(mine[1:], mine[:-1]))) if len(mine) > 1 else 0.0
        least, turns = limits["metres"], limits["degrees"]
        if _is_still(track, mine) and _is_still(track, theirs):
            least, turns = limits["mounts"], limits["mount_degrees"]
        if (
            float(np.median(apart)) > least + step
            or float(np.median(turned)) > np.radians(turns) + spin
        ):
            names = (publishers[first].node, publishers[second].node)
            return _conflict(track, names, (mine, nearest), sent, Confidence.CERTAIN)
    return None


def values_at_one_stamp(track: Track, limits: Limits) -> Hit | None:
    """Return a hit if many stamps of an edge occur twice with different poses; else None."""
    if len(track.steps) == len(track.by_stamp) - 1 or is_corrected(track, limits):
        return None
    # A stamp that occurs more than twice does not change, which is another fault.
    _, firsts, counts = np.unique(track.sorted_stamps, return_index=True, return_counts=True)
    again = firsts[counts == 2]
    mine, theirs = track.by_stamp[again], track.by_stamp[again + 1]
    differ = (track.apart(mine, theirs) > limits["metres"]) | (
        track.turned(mine, theirs) > np.radians(limits["degrees"])
    )
    count = int(np.count_nonzero(differ))
    back = _count_returns(track, again[differ])
    if count < max(limits["stamps"], 1) or back < max(limits["share"] * count, 1):
        return None
    owned = (mine[differ], theirs[differ])
    sure = Confidence.LIKELY if count >= limits["samples"] else Confidence.POSSIBLE
    hit = _conflict(track, ("A", "B"), owned, owned, sure)
    facts: dict[str, Fact] = {**hit.facts, "told": f"{hit.count:,} stamps carry two values"}
    if count < _SOME * len(counts) and _timers(track) is None:
        facts["seen"] = f" at {count:,} of {len(counts):,} stamps"
        facts["so"] = "the frame jumps at these stamps, and so do all frames below"
    return replace(hit, facts=facts)


_SOME = 0.1
"""Fraction of an edge's stamps with two values below which the values do not alternate."""


def with_senders(model: Model, track: Track, hit: Hit) -> Hit:
    """Say what a conflict's recording shows about the senders, if it names only one node.

    In a filtered recording, all transforms have the name of one node. So one node is proved only if
    the recording names another node on the same topic.
    """
    if not len(track.nodes) == len(track.publishers) == 1 or not track.nodes[0]:
        return hit
    node, usual = track.nodes[0], find_publishers([track])
    others = {one.node for one in model.evidence.publishers if one.topic in track.topics}
    if len(others) > 1:
        told = f"both sent by {node}"
        fix = Fix(f"find out where {node} gets each of the two values from")
    else:
        rates = _timers(track)
        told = f"the recording names only {node}"
        if rates:
            told = f"two senders ({rates[0]:.3g} Hz and {rates[1]:.3g} Hz); {told}"
        fix = Fix(f"while the robot runs, list the senders: `{{publishers}} {track.topics[0]}`")
    fixes = tuple(fix if one == usual else one for one in hit.fixes)
    return replace(hit, fixes=fixes, facts={**hit.facts, "seen": f"{hit.facts['seen']}, {told}"})


def _timers(track: Track) -> tuple[float, float] | None:
    """Return the rates of an edge's two motions, if each arrives regularly, at its own rate."""
    order = np.argsort(track.logs, kind="stable")[:MOST_FOLLOWED]
    owners = _nearer_track(track, order)
    rates = []
    for number in (0, 1):
        steps = np.diff(track.logs[order[owners == number]])
        usual = float(np.median(steps)) if len(steps) >= _LEAST_STEPS else 0.0
        if usual <= 0.0 or np.mean(np.abs(steps - usual) < 0.25 * usual) < 0.95:
            return None
        rates.append(NANOSECONDS / usual)
    return None if max(rates) < 1.2 * min(rates) else (rates[0], rates[1])


def _nearer_track(track: Track, order: Places) -> Places:
    """Return the number (0 or 1) of the nearer of two motions for each sample, shape (n,).

    Args:
        track: The edge's samples.
        order: Rows of the samples in the order in which they arrived, shape (n,).
    """
    poses = np.hstack((track.translations[order], unit(track.rotations[order]))).tolist()
    ends, owners = poses[:1], []
    for pose in poses:
        away = [_pose_distance(pose, end, 1.0) for end in ends]
        best = int(away[-1] < away[0])
        if len(ends) == 1 and away[0] >= _APART:
            ends.append(pose)
            best = 1
        ends[best] = pose
        owners.append(best)
    return np.array(owners)


_LEAST_STEPS = 20
"""Minimum number of steps that show the rate of a motion."""

_APART = 0.05
"""Distance of two poses, a radian counting as a metre, from which they are of two motions."""


def follows(upper: Track, lower: Track) -> bool:
    """Whether the jumps of an edge only make up for the two values of the edge below.

    Composed with the nearer of the two motions of the lower edge, the upper edge then moves a tenth
    as far as alone.
    """
    order = np.argsort(lower.logs, kind="stable")[:MOST_FOLLOWED]
    owners = _nearer_track(lower, order)
    rows = upper.by_stamp[upper.sorted_stamps <= lower.stamps[order].max()]
    ways = []
    for number in (0, 1):
        own = order[owners == number]
        own = own[np.argsort(lower.stamps[own], kind="stable")]
        if not len(own):
            return False
        stamps = lower.stamps[own]
        after = np.clip(np.searchsorted(stamps, upper.stamps[rows]), 1, max(1, len(own) - 1))
        after = np.minimum(after, len(own) - 1)
        near = own[
            after - (upper.stamps[rows] - stamps[after - 1] < stamps[after] - upper.stamps[rows])
        ]
        moved = rotate(unit(upper.rotations[rows]), lower.translations[near])
        ways.append(upper.translations[rows] + moved)
    if len(rows) < _LEAST_STEPS:
        return False
    steps = np.stack([np.linalg.norm(to[1:] - since[:-1], axis=1) for since in ways for to in ways])
    alone = float(upper.apart(rows[1:], rows[:-1]).sum())
    return float(steps.min(axis=0).sum()) < 0.1 * alone


def with_doubled(model: Model, track: Track, hit: Hit) -> Hit:
    """Add the edges of other messages that are sent twice, with equal values, to a conflict.

    If the whole software of a robot runs twice, both copies compute these edges from one source.
    """
    others = (t for t in model.dynamic if not np.isin(t.messages, track.messages).any())
    doubled = [other.name for other in others if _is_doubled(other)]
    if not doubled or hit.confidence is Confidence.CERTAIN:
        return hit
    also = f"; {several(doubled, 3)}: sent twice, with equal values"
    fix = Fix("check whether the robot's software was started twice")
    return replace(hit, facts={**hit.facts, "also": also}, fixes=(*hit.fixes, fix))


def _is_doubled(track: Track) -> bool:
    """Whether half of an edge's stamps occur twice, or more of them, with equal poses."""
    again = np.flatnonzero(np.diff(track.sorted_stamps) == 0)
    different = len(track.steps) + 1
    # A stamp that does not change is another fault.
    if not different <= 2 * len(again) <= 2 * different:
        return False
    some, others = track.by_stamp[again], track.by_stamp[again + 1]
    return bool(track.apart(some, others).max() < 1e-6)


def is_corrected(track: Track, limits: Limits) -> bool:
    """Whether one publisher corrects its poses: a later pose with the same stamp replaces a pose.

    Some filters send such corrections. If two publishers had sent the poses, a pose that was
    replaced would appear again at the same stamp.
    """
    if len(track.publishers) != 1:
        return False
    at = track.sorted_stamps
    firsts = np.flatnonzero(at[2:] == at[:-2])
    mine, theirs, after = (track.by_stamp[firsts + step] for step in (0, 1, 2))

    def differ(some: Places, others: Places) -> Mask:
        turned = track.turned(some, others) > np.radians(limits["degrees"])
        return np.asarray((track.apart(some, others) > limits["metres"]) | turned)

    left = differ(mine, theirs)
    returns = np.count_nonzero(left & ~differ(mine, after))
    return not returns and int(np.count_nonzero(left)) >= limits["samples"]


def is_revolute(track: Track) -> bool:
    """Whether an edge has a constant translation and only turns, like a wheel."""
    where = track.translations[track.by_stamp]
    return bool(np.ptp(where, axis=0).max() < 1e-6) if len(where) else False


def _count_returns(track: Track, firsts: Places) -> int:
    """Count the stamps with two poses at which one pose interrupts the motion of the other.

    Two publishers cause such an interruption. A single publisher may send a newer pose with an old
    stamp, but then the motion continues from this newer pose. Such stamps do not count.

    Args:
        track: The edge's samples.
        firsts: For each stamp, the index in `track.by_stamp` of its first sample, shape (n,).
    """
    firsts = firsts[(firsts > 0) & (firsts + 2 < len(track.by_stamp))]
    before, mine, theirs, after = (track.by_stamp[firsts + step] for step in (-1, 0, 1, 2))
    half = 0.5 * (track.apart(mine, theirs) + _RADIAN * track.turned(mine, theirs))
    where, times = track.translations, track.stamps
    gone, left = times[mine] - times[before], times[after] - times[theirs]
    ratio = (left / gone)[:, None]
    returns = np.zeros(len(firsts), dtype=bool)
    for one, other, led in (
        (mine, after, (where[mine] - where[before]) * ratio),
        (before, theirs, (where[after] - where[theirs]) / ratio),
    ):
        turned = _RADIAN * track.turned(one, other)
        for moved in (np.zeros_like(led), led):
            missed = np.linalg.norm(where[one] + moved - where[other], axis=1)
            returns |= missed + turned < half
    return int(np.count_nonzero(returns))


def unnamed_conflict(track: Track, limits: Limits) -> Hit | None:
    """Return a hit if the poses of an edge alternate between two continuous motions; else None."""
    places = track.by_stamp[:MOST_FOLLOWED]
    if len(places) < max(2 * limits["samples"], 2):
        return None
    apart = track.strides[: len(places) - 1]
    if (near := _near_tracks(track, places, apart, limits)) is not None:
        return _conflict(track, ("A", "B"), *near, Confidence.LIKELY)
    # If the edge hardly moves and turns, there cannot be two motions.
    if apart.max() < 0.5 * limits["reach"] and not track.has_turns(
        places[1:], places[:-1], 0.5 * limits["reach"]
    ):
        return None
    times = track.stamps[places] / NANOSECONDS
    jumps = apart + _RADIAN * track.turned(places[1:], places[:-1])
    # If no sample jumps, there cannot be two motions.
    leaves = jumps >= limits["reach"] + limits["speed"] * np.minimum(np.diff(times), 0.2)
    if np.count_nonzero(leaves) < limits["changes"]:
        return None
    if (owned := _two_motions(track, places, limits)) is not None:
        return _conflict(track, ("A", "B"), *owned, Confidence.LIKELY)
    return _brief_conflict(track, places, np.flatnonzero(leaves), limits)


def _brief_conflict(track: Track, places: Places, leaves: Places, limits: Limits) -> Hit | None:
    """Return a hit if an edge has two motions for a short time, at a higher rate; else None.

    Args:
        track: The edge's samples.
        places: Rows of the samples in the order of their stamps, shape (n,).
        leaves: Indices in `places` of the samples before a jump, ascending.
        limits: The thresholds.
    """
    times = track.stamps[places] / NANOSECONDS
    found = []
    for some in np.split(leaves, np.flatnonzero(np.diff(times[leaves]) > _WINDOW) + 1):
        inside = places[some[0] : some[-1] + 2]
        lasts = float(times[some[-1] + 1] - times[some[0]])
        # One source that flickers between two poses sends no more samples than before.
        if len(some) < limits["near_changes"] or len(inside) * track.period / NANOSECONDS < (
            _MORE * lasts
        ):
            continue
        owned = _two_motions(track, inside, limits)
        if owned is not None:
            found.append((lasts, moment(int(track.stamps[inside[0]])), owned))
    if not found:
        return None
    found.sort(key=lambda one: -one[0])
    hit = _conflict(track, ("A", "B"), *found[0][2], Confidence.LIKELY)
    when = several([f"{span(int(lasts * NANOSECONDS))} from {at} on" for lasts, at, _ in found])
    also = f"; only for {when}, in which more samples than usual arrived"
    text = (
        "look for a process that still ran at that time, such as an earlier start of the same "
        "program"
    )
    return replace(hit, facts={**hit.facts, "also": also}, fixes=(Fix(text),))


_WINDOW = 1.0
"""Maximum time between two changes in one time of conflict, seconds."""

_MORE = 1.5
"""Minimum rate of an edge during a short conflict, as a multiple of its usual rate."""


def _two_motions(
    track: Track, places: Places, limits: Limits
) -> tuple[tuple[Places, Places], tuple[Places, Places]] | None:
    """Return the samples of two alternating motions of an edge; else None.

    Args:
        track: The edge's samples.
        places: Rows of the samples in the order of their stamps, shape (n,).
        limits: The thresholds.

    Returns:
        Two pairs: the samples to compare (see `_alternating`), and all samples of each motion.
    """
    if _turns_one_way(track, places):
        return None
    together = _motion_errors(track, places)
    # Two publishers with equal rates alternate strictly, even if each turns a lot in a period.
    for owners in (_follow(track, places, limits), np.arange(len(places)) % 2):
        owned = _alternating(track, places, owners, together, limits)
        if owned is not None:
            return owned
    return None


def _near_tracks(
    track: Track, places: Places, apart: Floats, limits: Limits
) -> tuple[tuple[Places, Places], tuple[Places, Places]] | None:
    """Return the samples of two tracks that are near each other and hardly move; else None.

    Args:
        track: The edge's samples.
        places: Rows of the samples in the order of their stamps, shape (n,).
        apart: Distance from each sample to the next, metres, shape (n - 1,).
        limits: The thresholds.

    Returns:
        Two pairs of rows: each sample of the first track with the sample of the second track to
        compare with, and all samples of each track.
    """
    far = apart >= limits["near"]
    if np.count_nonzero(far) < max(limits["near_changes"], len(apart) // 2):
        return None
    changes = apart >= max(limits["near"], 0.5 * float(np.median(apart[far])))
    owners = np.append(0, np.cumsum(changes)) % 2
    mine, theirs = places[owners == 0], places[owners == 1]
    if min(len(mine), len(theirs)) < limits["near_share"] * len(places):
        return None
    after = np.searchsorted(track.stamps[theirs], track.stamps[mine])
    nearest = theirs[np.clip(after, 0, len(theirs) - 1)]
    steps = [track.apart(own[1:], own[:-1]) for own in (mine, theirs)]
    usual = percentile(np.concatenate(steps), 95)
    if float(np.median(track.apart(mine, nearest))) < limits["near_times"] * usual:
        return None
    return (mine, nearest), (mine, theirs)


def _turns_one_way(track: Track, places: Places) -> bool:
    """Whether an edge has a constant translation and always turns in the same direction."""
    if not is_revolute(track):
        return False
    turned = unit(track.rotations[places])
    turns = rotation_vectors(multiply(conjugate(turned[:-1]), turned[1:]))
    axis = int(np.abs(turns.sum(axis=0)).argmax())
    along = turns[:, axis] * np.sign(turns[:, axis].sum())
    return bool(np.mean(along < -_NO_TURN) < _AGAINST)


_NO_TURN = 1e-3
"""Angle of noise, radians."""

_AGAINST = 0.005
"""Maximum fraction of turns against the usual direction, for a wheel that turns one way."""


def _alternating(
    track: Track, places: Places, owners: Places, single_errors: Floats, limits: Limits
) -> tuple[tuple[Places, Places], tuple[Places, Places]] | None:
    """Return the samples of two alternating motions; None if one motion explains all samples.

    Args:
        track: The edge's samples.
        places: Rows of the samples in the order of their stamps, shape (n,).
        owners: Number of the motion to which each sample is assigned, shape (n,).
        single_errors: Error of each sample under the assumption of a single motion, shape (n,).
        limits: The thresholds.

    Returns:
        Two pairs: the samples to compare (the argument `owned` of `_conflict`), and all samples of
        each motion.
    """
    turns = np.flatnonzero(np.diff(owners)) + 1
    if len(turns) < limits["changes"] or len(turns) <= limits["share"] * (len(owners) - 1):
        return None
    counts = np.bincount(owners, minlength=3)
    enough = np.flatnonzero(
        (counts >= limits["samples"]) & (counts >= limits["share"] * len(owners))
    )
    if len(enough) < 2:
        return None
    alone = np.full(len(places), np.nan)
    for owner in enough.tolist():
        alone[owners == owner] = _motion_errors(track, places[owners == owner])
    judged = turns[np.isfinite(single_errors[turns]) & np.isfinite(alone[turns])]
    if len(judged) < max(limits["samples"], 1):
        return None
    error = float(np.median(single_errors[judged]))
    if error <= max(limits["worse"] * float(np.median(alone[judged])), limits["reach"]):
        return None
    first, second = enough[np.argsort(-counts[enough], kind="stable")][:2].tolist()
    mine, theirs = places[owners == first], places[owners == second]
    near = np.clip(np.searchsorted(track.stamps[theirs], track.stamps[mine]), 0, len(theirs) - 1)
    return (mine, theirs[near]), (mine, theirs)


def _motion_errors(track: Track, places: Places) -> Floats:
    """Return the distance of each sample from the pose predicted by the two previous samples.

    A fast wheel may make a full turn between two samples. So three rotations are predicted: with
    one turn less, as measured, and with one turn more. The nearest prediction is used.

    Args:
        track: The edge's samples.
        places: Rows of the samples in the order of their stamps, shape (n,).

    Returns:
        Distances in metres, shape (n,); a radian counts as `_RADIAN` metres. NaN for the first two
        samples, and for samples next to equal stamps.
    """
    errors = np.full(len(places), np.nan)
    if len(places) < 3:
        return errors
    times = track.stamps[places] / NANOSECONDS
    steps = np.diff(times)
    with np.errstate(all="ignore"):
        ratio = np.where(steps[:-1] > 0.0, steps[1:] / steps[:-1], np.nan)
    where, turned = track.translations[places], unit(track.rotations[places])
    led = where[1:-1] + (where[1:-1] - where[:-2]) * ratio[:, None]
    missed = np.sqrt(np.einsum("ij,ij->i", where[2:] - led, where[2:] - led))
    first = rotation_vectors(multiply(conjugate(turned[:-2]), turned[1:-1]))
    angles = np.sqrt(np.einsum("ij,ij->i", first, first))
    axes = first / np.where(angles > 0.0, angles, 1.0)[:, None]
    best = np.full(len(angles), np.inf)
    for turns in (-1, 0, 1):
        half = 0.5 * (angles + 2.0 * np.pi * turns) * ratio
        led_turn = np.column_stack((axes * np.sin(half)[:, None], np.cos(half)))
        # Without rotation there is no axis for a full turn.
        led_turn = np.where((angles > 0.0)[:, None], led_turn, (0.0, 0.0, 0.0, 1.0))
        best = np.fmin(best, angles_between(multiply(turned[1:-1], led_turn), turned[2:]))
    errors[2:] = missed + _RADIAN * best
    return errors


def _follow(track: Track, places: Places, limits: Limits) -> Places:
    """Assign each sample to the nearest of at most three motions.

    Returns:
        Number of each sample's motion (0 to 2), shape (n,).
    """
    stamps = (track.stamps[places] / NANOSECONDS).tolist()
    poses = np.hstack((track.translations[places], unit(track.rotations[places]))).tolist()
    reach, speed = limits["reach"], limits["speed"]
    ends: list[tuple[float, list[float]]] = []
    owners = []
    for now, pose in zip(stamps, poses, strict=True):
        best, least, continues = -1, np.inf, False
        for number, (then, last) in enumerate(ends):
            away = _pose_distance(pose, last)
            fits = away < reach + speed * min(now - then, 0.2)
            if (fits, -away) > (continues, -least):
                best, least, continues = number, away, fits
        if not continues and len(ends) < 3:
            best = len(ends)
            ends.append((now, pose))
        ends[best] = (now, pose)
        owners.append(best)
    return np.array(owners)


def _pose_distance(a: list[float], b: list[float], radian: float = _RADIAN) -> float:
    away = math.dist(a[:3], b[:3])
    return away + radian * angle_between((a[3], a[4], a[5], a[6]), (b[3], b[4], b[5], b[6]))


def _conflict(
    track: Track,
    names: tuple[str, str],
    owned: tuple[Places, Places],
    sent: tuple[Places, Places],
    confidence: Confidence,
) -> Hit:
    """Return the hit about two publishers of one edge.

    Args:
        track: The edge with two publishers.
        names: Names of the publishers.
        owned: Rows of the first publisher's samples, shape (n,), and for each of these samples the
            row of the second publisher's sample to compare with, shape (n,).
        sent: Rows of all samples of each publisher, in the order of their times.
        confidence: Confidence that there are two publishers.
    """
    rates, late = [], []
    known = confidence is Confidence.CERTAIN
    is_one = not known and len(track.nodes) == 1 and len(track.publishers) == 1
    both = int(np.ptp(track.stamps[np.concatenate(sent)]))
    for places in sent:
        stamps = track.stamps[places]
        lasts = both if is_one else int(np.ptp(stamps))
        rates.append((len(stamps) - 1) * NANOSECONDS / lasts if lasts else 0.0)
        late.append(int(np.median(track.latency[places])))
    apart, turned = track.apart(*owned), track.turned(*owned)
    seen = f": {names[0]} and {names[1]}" if known else ", which alternate"
    fix = find_publishers([track])
    told = f"latencies {span(late[0])} and {span(late[1])}"
    if abs(late[0] - late[1]) > _TWO_CLOCKS:
        # On two clocks, only the recorder's clock shows which samples are dated wrongly.
        real = [int(np.median(track.logs[places] - track.stamps[places])) for places in sent]
        sides = (f"{span(abs(one))} {'after' if one > 0 else 'before'}" for one in real)
        told = f"arriving {' and '.join(sides)} their stamps"
    still = [
        f"; all poses of {name} are equal"
        for name, places in zip(names, owned, strict=True)
        if known and _is_still(track, places)
    ]
    still = still if len(still) == 1 else []
    so = "the frame jumps back and forth, and so do all frames below"
    if abs(late[0] - late[1]) > CACHE_TIME:
        kept, refused = names if late[0] < late[1] else names[::-1]
        so = f"tf2 keeps the samples of {kept}, and refuses the samples of {refused} as too old"
    return Hit(
        edges=(track.edge,),
        publishers=names if known else track.nodes,
        since=int(max(track.logs[places].min() for places in owned)),
        count=min(len(owned[0]), len(np.unique(owned[1]))),
        confidence=confidence,
        facts={
            "edge": track.name,
            "named": track.name,
            "child": track.child,
            "parent": track.parent,
            "first": names[0],
            "second": names[1],
            "rates": rates,
            "latencies": late,
            "told": f"{rates[0]:.3g} and {rates[1]:.3g} Hz, {told}{''.join(still)}",
            "apart": float(np.median(apart)),
            "turned": float(np.median(turned)),
            "worst": float(np.max(apart)),
            "most_turned": float(np.max(turned)),
            "seen": seen,
            "two": 1 if known else 0,
            "so": so,
            "also": "",
        },
        fixes=(fix,),
        alone=True,
    )


def _is_still(track: Track, places: Places) -> bool:
    """Whether the samples in the rows `places` of an edge all have the same pose."""
    first = np.full(len(places), places[0])
    apart, turned = track.apart(places, first), track.turned(places, first)
    return bool(apart.max() < 1e-6 and turned.max() < 1e-4)


def is_odometry(track: Track) -> bool:
    """Whether an edge is odometry, judged by the name of the parent frame."""
    return last_part(track.parent).startswith("odom")


def find_publishers(tracks: Sequence[Track]) -> Fix:
    """Return the remedy for a transform with several publishers: let only one publisher send it."""
    nodes = sorted({node for track in tracks for node in track.nodes})
    if len(nodes) > 1:
        return Fix(f"let only one of these nodes publish the transform: {', '.join(nodes)}")
    topics = sorted({topic for track in tracks for topic in track.topics}) or ["/tf"]
    return Fix("find its publishers: " + ", ".join(f"`{{publishers}} {topic}`" for topic in topics))
