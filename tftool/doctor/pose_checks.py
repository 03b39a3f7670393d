"""Checks of poses that are sent although nothing was measured: a placeholder, or the last pose."""

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from tftool.base.plain_text import count
from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, Stamp
from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.findings import Area, Confidence, Edge, Fact, Fix, Hit, Severity
from tftool.doctor.gap_checks import is_detection
from tftool.doctor.missing_joins import is_world, quoted
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import Mask, Places, Track
from tftool.doctor.wording import metres, moment, several, span
from tftool.recordings.contract import Floats, Stamps, percentile

check = checks_of(Area.VALUES)


@check(
    "placeholder-pose",
    Severity.WARNING,
    rule="the pose of an object that a camera detects changes between exactly 0 0 0 without a "
    "rotation, and poses more than 0.25 m away, within 0.5 s. All such objects with one parent and "
    "one publisher together change to 0 0 0 and back 3 times or more",
    headline="{named} {concerned:is|are} sent as exactly 0 0 0 in {share:%} of "
    "{concerned:its|their} samples, alternating with other poses",
    detail="{zeros} of {of} samples; the other poses are up to {away:m} from there",
    consequence="{named} {concerned:jumps|jump} to the origin of {parent} and back",
    fixes=(
        Fix(
            "check whether {sender} has a measurement at these times; without a measurement, it "
            "should send nothing"
        ),
    ),
    causes=("a detector without a depth at the place of the object",),
)
def placeholder_pose(model: Model, limits: Limits) -> Iterator[Hit]:
    """A pose of zeros is sent alternately with real poses."""
    for tracks in with_placeholders(model):
        zeros = sum(int(np.count_nonzero(_is_zero(track))) for track in tracks)
        of = sum(len(track.by_stamp) for track in tracks)
        first = tracks[0]
        children = [track.child for track in tracks]
        yield hit_of(
            first,
            {
                "named": f"{several(children, 3)} in {first.parent}",
                "parent": first.parent,
                "share": zeros / of,
                "sender": ", ".join(first.nodes) or "the publisher",
                "zeros": zeros,
                "of": of,
                "away": max(float(np.linalg.norm(t.translations, axis=1).max()) for t in tracks),
            },
            edges=tuple(track.edge for track in tracks),
            since=min(int(track.logs[0]) for track in tracks),
            count=zeros,
            alone=True,
        )


def with_placeholders(model: Model) -> list[list[Track]]:
    """Return detections that alternate with zeros, one list of edges per parent and publisher."""
    groups: dict[tuple[str, int], list[Track]] = defaultdict(list)
    changes: dict[tuple[str, int], int] = defaultdict(int)
    for track in model.dynamic:
        if len(track.publishers) != 1 or not is_detection(model, track):
            continue
        zero = _is_zero(track)
        if not zero.any():
            continue
        key = track.parent, int(track.senders[0])
        groups[key].append(track)
        near = np.diff(track.sorted_stamps) < _SOON
        far = near & (track.strides > _FAR)
        changes[key] += min(
            int(np.count_nonzero(far & zero[1:] & ~zero[:-1])),
            int(np.count_nonzero(far & zero[:-1] & ~zero[1:])),
        )
    return [tracks for key, tracks in groups.items() if changes[key] >= _CHANGES]


_FAR = 0.25
"""Minimum distance, metres, of a real pose from a placeholder of zeros."""

_SOON = NANOSECONDS // 2
"""Maximum time, nanoseconds, between a placeholder and a real pose."""

_CHANGES = 3
"""Minimum number of changes to the placeholder, and back."""


def _is_zero(track: Track) -> Mask:
    """Return a mask of the usable samples with exactly no translation and no rotation."""
    places = track.by_stamp
    numbers = np.hstack((track.translations[places], track.rotations[places, :3]))
    return np.asarray(~numbers.any(axis=1))


@check(
    "frozen-pose",
    Severity.WARNING,
    rule="a publisher repeats one pose of a moving frame exactly, with new stamps, for "
    "{seconds:g} s or more and {repeats:g} times or more. Then the frame jumps by {metres:g} m or "
    "more, at {times:g} times its speed after the jump or more. Its usual speed explains the "
    "distance of the jump in the time since the pose froze, and the frame moved in the five steps "
    "before and after. "
    "Or a measured pose is repeated for {end:g} s or more, until its last sample. A pose counts as "
    "measured if all seven numbers change in 95 % of its changes. Before, this pose moved at "
    "{speed:g} m/s or more, so a real stop would need {stop:g} m/s² or more. A note if a "
    "measured pose is repeated {often:g} times or more, and each next step is as long as the time "
    "since the pose froze, unless a teleport is one of these steps",
    headline="{where} {concerned:repeats its|repeat their} last pose for up to {longest:span}"
    "{then}",
    detail="{edge}: the same pose {stretches}{told}",
    consequence="while the pose is frozen, lookups return an old pose under a new stamp",
    fixes=(
        Fix(
            "check whether the publisher had a measurement at that time; without a measurement, it "
            "should send nothing"
        ),
    ),
    causes=("a motion capture system lost its object and sends the last pose",),
    limits={
        "seconds": 0.25,
        "repeats": 4,
        "metres": 0.05,
        "times": 3.0,
        "end": 0.5,
        "speed": 0.2,
        "stop": 20.0,
        "often": 5,
    },
)
def frozen_pose(model: Model, limits: Limits) -> Iterator[Hit]:
    """A publisher repeats the last pose of a frame that moves meanwhile."""
    invalid = {track.edge for tracks in with_placeholders(model) for track in tracks}
    for track in model.dynamic:
        if track.is_localisation or track.edge in invalid:
            continue
        parts = [track.by_stamp]
        if len(track.publishers) > 1:
            senders = track.senders[track.by_stamp]
            parts = [track.by_stamp[senders == sender] for sender in np.unique(senders).tolist()]
        for places in parts:
            hit = _frozen(track, places, limits)
            if hit is not None:
                yield hit
                break


def _frozen(track: Track, places: Places, limits: Limits) -> Hit | None:
    """Return a hit if one publisher's poses freeze while the frame moves; else None.

    Args:
        track: The edge.
        places: Indices of the publisher's samples, sorted by stamp, shape (n,).
        limits: Thresholds of `frozen-pose`.
    """
    stamps, where, turns = track.stamps[places], track.translations[places], track.rotations[places]
    changed = np.hstack((where[1:] != where[:-1], turns[1:] != turns[:-1]))
    moves = np.flatnonzero(changed.any(axis=1))
    if len(moves) < _LEAST_MOVES:
        return None
    strides = track.strides if places is track.by_stamp else track.apart(places[1:], places[:-1])
    # Between two moves, the pose is frozen.
    froze, ends = moves[:-1] + 1, moves[1:]
    frozen = _Frozen(track, places, stamps, strides, froze, ends)
    if (hit := _jumps(frozen, moves, limits)) is not None:
        return hit
    # A pose in a plane changes in fewer numbers, and such a robot may rest exactly.
    if track.is_odometry or float(np.mean(changed[moves].all(axis=1))) < _MEASURED:
        return None
    return _until_the_end(frozen, moves, limits) or _catches_up(frozen, limits)


@dataclass(frozen=True, slots=True, eq=False)
class _Frozen:
    """The times in which a publisher's pose does not change.

    Attributes:
        track: The edge.
        places: Indices of the publisher's samples, sorted by stamp, shape (n,).
        stamps: Stamps of these samples, nanoseconds, shape (n,).
        strides: Distance from each of these samples to the next, metres, shape (n - 1,).
        froze: For each time, the index in `places` of the first sample with the pose, shape (m,).
            The publisher's first pose is left out.
        ends: For each time, the index in `places` of the last sample with the pose, shape (m,).
    """

    track: Track
    places: Places
    stamps: Stamps
    strides: Floats
    froze: Places
    ends: Places

    def hit(self, kind: str, rests: Mask, then: str, told: str, **given: Fact) -> Hit:
        """Return a hit about some of the times.

        Args:
            kind: Kind of the hit; hits of one kind are merged.
            rests: Mask of the times, shape (m,).
            then: Clause for the headline about what happens after the pose froze.
            told: Further evidence.
            **given: Further facts.
        """
        froze, ends = self.froze[rests], self.ends[rests]
        lasts = self.stamps[ends] - self.stamps[froze]
        stretches = [
            f"for {span(last)} from {moment(stamp)}"
            for last, stamp in zip(lasts.tolist(), self.stamps[froze].tolist(), strict=True)
        ]
        facts: dict[str, Fact] = {
            "longest": int(lasts.max()),
            "stretches": several(stretches),
            "then": then,
        }
        return hit_of(
            self.track,
            {**facts, "told": told, **given},
            since=int(self.track.logs[self.places[froze[0]]]),
            until=int(self.track.logs[self.places[ends[-1]]]),
            count=len(froze),
            confidence=Confidence.LIKELY,
            severity=Severity.NOTE if kind == "steps" else None,
            group=kind,
        )


def _jumps(frozen: _Frozen, moves: Places, limits: Limits) -> Hit | None:
    """Return a hit if a frame jumps after its pose froze for long; else None.

    Args:
        frozen: The times in which the pose does not change.
        moves: Places of the steps that change the pose, shape (m + 1,).
        limits: Thresholds of `frozen-pose`.
    """
    strides, stamps = frozen.strides, frozen.stamps
    if not (strides >= limits["metres"]).any():
        return None
    speeds = strides / np.maximum(np.diff(stamps) / NANOSECONDS, _SHORT)
    usual = percentile(speeds[moves], 95)
    # Two steps after the jump show the speed.
    is_followed = frozen.ends + 2 < len(strides)
    froze, ends = frozen.froze[is_followed], frozen.ends[is_followed]
    lasts = (stamps[ends] - stamps[froze]) / NANOSECONDS
    rests = (ends - froze >= limits["repeats"]) & (lasts >= limits["seconds"])
    since = (stamps[ends + 1] - stamps[froze]) / NANOSECONDS
    jumps = rests & (strides[ends] >= limits["metres"]) & (strides[ends] <= usual * since)
    jumps &= speeds[ends] >= limits["times"] * np.maximum(speeds[ends + 1], speeds[ends + 2])
    # Beside a long time, the pose may be frozen for single samples too.
    ways = np.append(0.0, np.cumsum(strides))
    for first, last in (
        (np.maximum(froze - _STEPS, 0), froze),
        (ends + 1, np.minimum(ends + 1 + _STEPS, len(strides))),
    ):
        times = (stamps[last] - stamps[first]) / NANOSECONDS
        jumps &= ways[last] - ways[first] >= _SLOW * usual * times
    if not jumps.any():
        return None
    worst = int(ends[np.flatnonzero(jumps)[strides[ends][jumps].argmax()]])
    jump, within = float(strides[worst]), int(stamps[worst + 1] - stamps[worst])
    at = int(stamps[worst + 1])
    told = f"; the jump is at {moment(at)}; usually at most {usual:.2g} m/s"
    then = f", before a jump of {metres(jump)} within {span(within)}"
    shown = np.zeros(len(frozen.ends), dtype=np.bool_)
    shown[: len(rests)] = rests
    return frozen.hit("jump", shown, then, told, jump=jump, within=within, at=at, usual=usual)


def _until_the_end(frozen: _Frozen, moves: Places, limits: Limits) -> Hit | None:
    """Return a hit if a measured pose freezes at speed, until the last sample; else None.

    Args:
        frozen: The times in which the pose does not change.
        moves: Places of the steps that change the pose, shape (m + 1,).
        limits: Thresholds of `frozen-pose`.
    """
    stamps, last = frozen.stamps, len(frozen.stamps) - 1
    begin = int(moves[-1]) + 1
    lasts = int(stamps[last] - stamps[begin])
    if last - begin < limits["repeats"] or lasts < limits["end"] * NANOSECONDS:
        return None
    before = moves[-_STEPS - 1 :]
    way = float(frozen.strides[before[1:]].sum())
    speed = way * NANOSECONDS / max(1, int(stamps[begin] - stamps[before[0] + 1]))
    period = frozen.track.period / NANOSECONDS
    if speed < max(limits["speed"], limits["stop"] * period):
        return None
    at_end = replace(frozen, froze=np.array([begin]), ends=np.array([last]))
    told = f"; before, it moved at {speed:.2g} m/s"
    return at_end.hit("ends", np.array([True]), ", until its last sample", told, speed=speed)


def _catches_up(frozen: _Frozen, limits: Limits) -> Hit | None:
    """Return a hit if a measured pose is often repeated while the frame moves on; else None.

    Args:
        frozen: The times in which the pose does not change.
        limits: Thresholds of `frozen-pose`.
    """
    stamps, ends, froze = frozen.stamps, frozen.ends, frozen.froze
    ways = frozen.strides[ends]
    speeds = ways * NANOSECONDS / np.maximum(stamps[ends + 1] - stamps[froze], 1)
    near = np.abs(np.diff(speeds)) < _STEADY_SPEED * np.minimum(speeds[1:], speeds[:-1])
    steady = np.append(False, near) & np.append(near, False)
    rests = steady & (stamps[ends] > stamps[froze]) & (speeds >= limits["speed"])
    if np.count_nonzero(rests) < limits["often"]:
        return None
    # A long loss, in which the frame may slow down, also ends with a step far above the usual one.
    rests |= (stamps[ends] > stamps[froze]) & (ways >= _LONG_STEP * percentile(ways, 95))
    jump = float(ways[rests].max())
    then = f", before steps of up to {metres(jump)}"
    return frozen.hit("steps", rests, then, "", jump=jump)


_LEAST_MOVES = 10
"""Minimum number of changes of a pose that shows how a frame moves."""

_MEASURED = 0.95
"""Share of a measured pose's changes in which all seven numbers change."""

_STEPS = 5
"""Number of steps that show the speed at which a pose froze."""

_LONG_STEP = 8.0
"""Length of a step after a loss, as a multiple of 95 % of the steps."""

_STEADY_SPEED = 0.3
"""Largest relative difference of two speeds of a frame that moves on."""

_SLOW = 0.1
"""Fraction of the usual speed below which a frame may be at rest."""

_SHORT = 1e-3
"""Minimum time between two samples, seconds, that is used for a speed."""


def look_at(model: Model, edge: Edge, before: Stamp, after: Stamp) -> tuple[Fix, ...]:
    """Return remedies with the commands that print the poses before and after a jump.

    If there is no earlier stamp, `before` and `after` are equal, and one command remains.
    """
    echo = f"tftool echo {quoted(edge[0])} {quoted(edge[1])} RECORDING --at"
    # A small number is seconds since the start of the recording, not a stamp.
    begin = model.epoch if after < SIMULATED_BELOW else 0
    first, then = (
        f"{(one - begin) // NANOSECONDS}.{(one - begin) % NANOSECONDS:09}".rstrip("0").rstrip(".")
        for one in (before, after)
    )
    if before == after:
        return (Fix("compare the jump with the sensors:", f"{echo} {then}"),)
    return (
        Fix("compare the jump with the sensors; before it:", f"{echo} {first}"),
        Fix("after it:", f"{echo} {then}"),
    )


OUTLIER = {
    "metres": 0.25,
    "speed": 5.0,
    "radians": 0.5,
    "times": 8.0,
    "samples": 10,
    "seconds": 0.1,
    "periods": 5,
    "back": 0.3,
    "share": 0.02,
}
"""Default thresholds of the check `outlier`."""

_HALF_TURN = math.radians(150.0)
"""Smallest rotation in one step that counts as a turn to the opposite side, radians."""

_STEADY = math.radians(20.0)
"""Largest usual rotation in one step of a frame whose half turns are errors, radians."""


@check(
    "outlier",
    Severity.WARNING,
    rule="a pose jumps by more than {metres:g} m or {radians:g} rad, and by {times:g} times the "
    "95 % quantile of all steps. Or the pose jumps by more than {metres:g} m, at more than "
    "{speed:g} m/s and {times:g} times the 95 % quantile of all speeds. At most {samples:g} "
    "samples and {seconds:g} s later, the pose is back: the rest is at most {back:%} of the jump. "
    "For a single sample, a turn of 20° is enough, at more than 20 rad/s both away and back, and "
    "{times:g} times the 95 % quantile of all turns. "
    "Such jumps are at most a share of {share:g} of all steps. Turns of 150° or more of a "
    "moving frame that usually turns by less than 20° may be a larger share, and may last "
    "{periods:g} periods. Ten turns of 15° "
    "or more at more than 1000°/s count too, if a body in a world frame usually turns by less "
    "than 1°. A note for one of three or more objects of one publisher that come and go, and for "
    "a part of a robot if no sensor message is in its frame. Not reported for a localiser",
    headline="{named} for {lasting}{often}",
    detail="{edge}: {wrong} at {at:moment}, {jump:m} and {turn:deg} away{others}",
    consequence="a lookup at these times gets a wrong pose",
    causes=(
        "a motion capture system that mistakes its markers for each other",
        "a detection of a symmetric object",
    ),
    limits=OUTLIER,
    because_of=(
        ("anything", "time-jump-back"),
        ("edge", "publisher-conflict two-parents placeholder-pose"),
    ),
)
def outlier(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame jumps away for a few samples, and back."""
    for track in model.dynamic:
        spans = [] if track.is_localisation else outliers(track, limits)
        if not spans:
            continue
        places = track.by_stamp
        begins, ends = (places[list(ones)] for ones in zip(*spans, strict=True))
        lengths = (track.stamps[ends] - track.stamps[begins]).tolist()
        worst = int(np.argmax(lengths))
        begin, end = spans[worst]
        before, first = places[begin - 1 : begin], places[begin : begin + 1]
        jump, turn = float(track.apart(before, first)[0]), float(track.turned(before, first)[0])
        far = metres(jump) if jump > limits["metres"] else f"{np.degrees(turn):.3g}°"
        times = [moment(stamp) for stamp in track.stamps[begins].tolist()]
        most = float(track.turned(places[[one - 1 for one, _ in spans]], begins).max())
        up_to = f"; up to {np.degrees(most):.3g}°" if most > 2.0 * turn else ""
        at = int(track.stamps[first[0]])
        named, lasting = f"{track.name} jumps {far} away", f"{span(lengths[worst])}, and back"
        if track.stamps[before[0]] == at:
            named, lasting = f"{track.name} has two poses, {far} apart,", "one stamp"
        earlier = track.sorted_stamps[: np.searchsorted(track.sorted_stamps, at)]
        yield hit_of(
            track,
            {
                "named": named,
                "lasting": lasting,
                "longest": lengths[worst],
                "often": f", {len(spans)} times" if len(spans) > 1 else "",
                "wrong": count(end - begin, "sample"),
                "at": int(track.stamps[begins[worst]]),
                "jump": jump,
                "turn": turn,
                "others": f"; also at {several(times[:worst] + times[worst + 1 :])}{up_to}"
                if len(times) > 1
                else "",
            },
            since=int(track.logs[begins[0]]),
            until=int(track.logs[ends[-1]]),
            count=len(spans),
            severity=Severity.NOTE
            if model.is_minor(track) or track.child in model.passing
            else None,
            fixes=(
                *look_at(model, track.edge, int(earlier[-1]) if len(earlier) else at, at),
                *marker_fix(track),
            ),
        )


def marker_fix(track: Track, turned: float | None = None) -> tuple[Fix, ...]:
    """Return the remedy for wrong poses of a body in a world frame, as of motion capture.

    Args:
        track: The edge.
        turned: Rotation of a jump, radians, which must be half a turn; None for any jump.
    """
    if not _is_measured(track):
        return ()
    if turned is not None and turned < _HALF_TURN:
        return ()
    text = "check whether its markers were hidden, or look alike from two sides"
    return (Fix(f"if motion capture sends it, {text}"),)


def _is_measured(track: Track) -> bool:
    """Whether an edge is the pose of a body in a world frame, as motion capture measures it."""
    parent = track.parent.lower()
    is_named = any(name in parent for name in ("optitrack", "vicon", "mocap", "qualisys"))
    return (is_named or is_world(track.parent)) and not track.is_odometry


def outliers(track: Track, limits: Limits) -> list[tuple[int, int]]:
    """Return the runs of samples between a jump away and a jump back.

    Returns:
        Indices into `track.by_stamp`: the first wrong sample, and the first sample after the run.
    """
    places = track.by_stamp
    some, others = places[:-1], places[1:]
    apart = track.strides
    spins = track.has_turns(some, others, min(limits["radians"], _FLICKER))
    if len(places) < 3 or not (spins or (apart > limits["metres"]).any()):
        return []
    turned = track.turned(some, others)
    speeds = apart / np.maximum(np.diff(track.sorted_stamps) / NANOSECONDS, _SHORT)
    is_far = (apart > max(limits["metres"], limits["times"] * percentile(apart, 95))) | (
        turned > max(limits["radians"], limits["times"] * percentile(turned, 95))
    )
    is_far |= (apart > limits["metres"]) & (
        speeds > max(limits["speed"], limits["times"] * percentile(speeds, 95))
    )
    is_far |= _single_turns(track, turned, limits)
    longest = limits["seconds"] * NANOSECONDS
    if (flips := _half_turns(apart, turned)) is not None:
        is_far = flips
        longest = max(longest, limits["periods"] * track.period)
    elif (flickers := _flickers(track, turned)) is not None:
        found = _runs_away(track, apart, turned, flickers, longest, {**limits, "radians": _FLICKER})
        if len(found) >= _OFTEN:
            return found
    if flips is None and np.count_nonzero(is_far) > max(2, limits["share"] * len(apart)):
        return []
    return _runs_away(track, apart, turned, is_far, longest, limits)


def _single_turns(track: Track, turned: Floats, limits: Limits) -> Mask:
    """Return a mask of the steps to a single sample that turns too fast, away and back.

    Args:
        track: The edge.
        turned: Rotation of each step, radians, shape (n,).
        limits: Thresholds of `outlier`.
    """
    places, steps = track.by_stamp, np.diff(track.sorted_stamps) / NANOSECONDS
    fast = turned > max(_SINGLE, limits["times"] * percentile(turned, 95))
    fast &= turned / np.maximum(steps, _SHORT) > _SINGLE_SPEED
    away = np.flatnonzero(fast[:-1] & fast[1:])
    rest = track.turned(places[away], places[away + 2])
    single = np.zeros(len(turned), dtype=np.bool_)
    single[away[rest <= limits["back"] * turned[away]]] = True
    return single


_SINGLE = math.radians(20.0)
"""Smallest rotation to a single wrong sample, and back, radians."""

_SINGLE_SPEED = 20.0
"""Smallest speed of these two rotations, radians per second."""


def _flickers(track: Track, turned: Floats) -> Mask | None:
    """Return a mask of the turns that are too far and too fast for a real body.

    Return None without such turns, and for an edge other than the measured pose of a body.

    Args:
        track: The edge.
        turned: Rotation of each step, radians, shape (n,).
    """
    if not _is_measured(track):
        return None
    steps = np.maximum(np.diff(track.sorted_stamps) / NANOSECONDS, _SHORT)
    mask: Mask = (turned > _FLICKER) & (turned / steps > _TOO_FAST)
    is_steady = float(np.median(turned)) < _FLICKER / 15.0
    return mask if is_steady and _OFTEN <= np.count_nonzero(mask) <= 0.1 * len(mask) else None


_FLICKER = math.radians(15.0)
"""Smallest rotation of a measured body that flickers between two poses, radians."""

_TOO_FAST = math.radians(1000.0)
"""Speed above which a body does not turn to and fro, radians per second."""

_OFTEN = 10
"""Minimum number of small turns away and back."""


def _runs_away(
    track: Track, apart: Floats, turned: Floats, is_far: Mask, longest: float, limits: Limits
) -> list[tuple[int, int]]:
    """Return the runs of samples between a jump away and a jump back.

    Args:
        track: The edge.
        apart: Distance of each step, metres, shape (n,).
        turned: Rotation of each step, radians, shape (n,).
        is_far: Mask of the steps that may be jumps away, shape (n,).
        longest: Maximum duration of a run, nanoseconds.
        limits: Thresholds of `outlier`.

    Returns:
        Indices into `track.by_stamp`: the first wrong sample, and the first sample after the run.
    """
    places = track.by_stamp
    found: list[tuple[int, int]] = []
    for out in np.flatnonzero(is_far).tolist():
        if found and found[-1][1] > out:
            continue
        later = places[out + 2 : out + 2 + int(limits["samples"])]
        before = np.full(len(later), places[out])
        # A jump away does not tell how well its publisher measures turns.
        spun = turned[out] > limits["radians"]
        shift = track.apart(before, later) / max(apart[out], limits["metres"])
        turn = track.turned(before, later) / turned[out] if spun else np.zeros(len(later))
        rest = np.maximum(shift, turn)
        in_time = track.stamps[later] - track.stamps[before] <= longest
        backs = np.flatnonzero(in_time & (rest <= limits["back"]))
        if len(backs):
            # The pose before may be off itself, so a pose that is nearer to it than half of the
            # jump is right, too.
            wrong = np.flatnonzero(rest[: backs[0]] > _HALF)
            found.append((out + 1, out + 2 + int(wrong[-1] + 1 if len(wrong) else 0)))
    return found


_HALF = 0.5
"""Share of a jump that a wrong pose is away, at least."""


def _half_turns(apart: Floats, turned: Floats) -> Mask | None:
    """Return a mask of the steps that turn a body by about 180°; None if they may be real motion.

    A body that moves, and usually turns slowly, does not turn by 150° from one sample to the next.
    A wheel, whose joint does not move, may do so.

    Args:
        apart: Distance of each step, metres, shape (n,).
        turned: Rotation of each step, radians, shape (n,).
    """
    flips = turned > _HALF_TURN
    usual = ~flips
    if not 1 < np.count_nonzero(flips) <= _MOST_FLIPS * len(flips):
        return None
    is_slow = percentile(turned[usual], 95) < _STEADY
    mask: Mask = flips
    return mask if is_slow and float(np.median(apart[usual])) > 0.0 else None


_MOST_FLIPS = 0.2
"""Largest share of steps to the opposite side that may be errors."""
