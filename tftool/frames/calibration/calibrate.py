"""Calibration of a mount (pose of one frame on another) from two motions of one rigid body."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.buffer.batch.transform_array import TransformArray
from tftool.frames.calibration.body_motion import (
    ANGLES,
    AXES,
    BodyMotion,
    CalibrationRefused,
    Floats,
)
from tftool.frames.calibration.clock_offset import (
    LEAST_OVERLAP,
    ClockOffset,
    offset_of,
    path_of,
)
from tftool.frames.calibration.mount_fit import (
    DRIFT,
    SCALE,
    SHIFT,
    Fit,
    MotionPairs,
    Problem,
    about_one_axis,
    kabsch,
    lever,
    pairs_of,
    refine,
    shortest_turn,
    spread,
)
from tftool.frames.frames import Frames
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.rigid import Quaternion, Transform, Vector3

LEAST_TURN: Final = math.radians(5.0)
"""Turn within ten seconds below which the motion does not determine a translation."""

SECOND_AXIS: Final = math.radians(3.0)
"""Root mean square of turns about the second axis, above which a motion has two axes."""

HIDDEN: Final = 0.3
"""An axis is undetermined if it has at least this component along an undetermined direction."""

LONG: Final = 120.0
"""Duration, seconds, from which the drift between the clocks is estimated."""

_MOST_POSES: Final = 4000
_SEGMENTS: Final = (2.0, 5.0, 15.0)
"""Lengths of time segments to try in addition to the whole time, seconds."""

_GROWN: Final = 1.3
"""Ratio of residuals with longer to shorter segments above which a chain drifts."""

TWO_AXES: Final = "turn about a second axis by at least 30°, back and forth, while recording"
FIGURE: Final = "drive a figure of eight"

Trio = tuple[float | None, float | None, float | None]


@dataclass(frozen=True, slots=True)
class Interval:
    """Half-widths of a pose's 95 % interval; None for directions that the motion cannot determine.

    The mount is the pose of the frame moving_b in moving_a. The fixed mount is the pose of fixed_b
    in fixed_a. See `calibrate` for these frames.

    Attributes:
        translation: Half-widths in metres: for the mount along the axes of moving_a, for the fixed
            mount along the axes of fixed_a.
        rotation_deg: Half-widths in degrees: for the mount about the axes of moving_b, for the
            fixed mount about the axes of fixed_b.
    """

    translation: Trio
    rotation_deg: Trio


@dataclass(frozen=True, slots=True, eq=False)
class Calibration:
    """Result of a calibration: the mount of one moving frame on another.

    A and B are the two recorded motions: of the frame moving_a in fixed_a, and of the frame
    moving_b in fixed_b.

    Attributes:
        verdict: "solved", "partial" (`unseen` names the undetermined parts), or "refused".
        why: Reason for the verdict, a sentence.
        moving: Names of the frames moving_a and moving_b.
        fixed: Names of the frames fixed_a and fixed_b.
        mount: Pose of moving_b in moving_a; None if the calibration was refused.
        fixed_mount: Pose of fixed_b in fixed_a; None if the calibration was refused.
        interval95: 95 % interval of `mount`.
        fixed_interval95: 95 % interval of `fixed_mount`.
        clock_offset: Offset of A's clock from B's, t_a = t_b + offset, seconds, at the middle of
            the common time.
        offset_interval95: Half-width of the 95 % interval of `clock_offset`, seconds.
        drift_ppm: Change of `clock_offset`, microseconds per second; None for a short recording.
        clock: Correlation from which the offset was measured.
        halves_differ: Distance (metres) and angle (degrees) between the mounts from both halves
            of the recording; None if a half has too few poses.
        unseen: Undetermined parts of the mount, some of x, y, z, roll, pitch and yaw.
        unseen_direction: Undetermined direction, a unit vector in moving_a, if it is oblique to the
            x, y and z axes; else None.
        inverted: Whether the poses of A, and whether the poses of B, were inverted.
        next_motion: The motion to record next; None if no other motion is needed.
        scale: Factor of A's translations, and half-width of the factor's 95 % interval; None if no
            scale was requested.
        notes: Sentences about the inputs.
    """

    verdict: Literal["solved", "partial", "refused"]
    why: str
    moving: tuple[str, str]
    fixed: tuple[str, str]
    mount: Transform | None = None
    fixed_mount: Transform | None = None
    interval95: Interval | None = None
    fixed_interval95: Interval | None = None
    clock_offset: float | None = None
    offset_interval95: float | None = None
    drift_ppm: float | None = None
    clock: ClockOffset | None = None
    halves_differ: tuple[float, float] | None = None
    unseen: tuple[str, ...] = ()
    unseen_direction: tuple[float, float, float] | None = None
    inverted: tuple[bool, bool] = (False, False)
    next_motion: str | None = None
    scale: tuple[float, float] | None = None
    notes: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        return self.verdict != "refused"


def calibrate(
    a: TransformArray | Frames,
    b: TransformArray | Frames,
    *,
    planar: bool = False,
    scale: bool = False,
    published: Transform | None = None,
    inverted: tuple[bool, bool | None] = (False, None),
    seed: int = 0,
    progress: Callable[[int, int], object] | None = None,
) -> Calibration:
    """Estimate the mount of one moving frame on another, from the motions of both.

        found = tftool.calibrate(tftool.open("vicon.csv"), tftool.open("camera.csv"))
        found.mount, found.interval95.translation

    The function solves A(t + d) · X = Y · B(t). A and B are the two motions, X is the mount, Y is
    the pose of fixed_b in fixed_a, and d is the clock offset. See docs/do/calibrate.md for the
    motion to record.

    Args:
        a: Motion A: the poses of a frame moving_a in a frame fixed_a over time, for example of
            base_link in odom; or frames that form a single chain.
        b: Motion B: the poses of moving_b in fixed_b, for example of camera in world; or frames
            that form a single chain. B may be on another clock than A.
        planar: Whether to estimate only x, y and yaw of the mount.
        scale: Whether to estimate a scale of A's translations, for wheel odometry.
        published: The published mount, used for parts that the motion does not determine.
        inverted: Whether to invert the poses of A, and of B; None to try both for B.
        seed: Seed of the random numbers with which intervals are estimated.
        progress: Function called with the number of finished steps and the total number of steps.

    Returns:
        The calibration, whose truth value is False if the mount cannot be determined.

    Raises:
        InputError: If the frames of an input are not a single chain.
    """
    a, b = path_of(a), path_of(b)
    names = (a.child_frame_id, b.child_frame_id), (a.frame_id, b.frame_id)
    solver = _Solver(planar, scale, published, seed, progress or (lambda done, total: None))
    try:
        first, second = BodyMotion.of(a), BodyMotion.of(b)
        if inverted[0]:
            first = first.inverted()
            names = (names[1][0], names[0][1]), (names[0][0], names[1][1])
        if inverted[1]:
            second, names = _swapped(second, names)
        return solver.solve(first, second, names, inverted)
    except CalibrationRefused as refusal:
        return Calibration("refused", str(refusal), *names, next_motion=refusal.next_motion or None)


Names = tuple[tuple[str, str], tuple[str, str]]


def _swapped(second: BodyMotion, names: Names) -> tuple[BodyMotion, Names]:
    (moving_a, moving_b), (fixed_a, fixed_b) = names
    return second.inverted(), ((moving_a, fixed_b), (fixed_a, moving_b))


@dataclass(frozen=True, slots=True, eq=False)
class _Shown:
    """Parts of the mount that the motion determines.

    Attributes:
        free: Directions, among the nine parameters of a fit, that the motion determines.
        axis: The axis of rotation in the frame moving_a, if there is only one; else None.
        unseen: Names of the parts that the motion does not determine.
    """

    free: tuple[Floats, ...]
    axis: Floats | None
    unseen: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Solver:
    planar: bool
    scaled: bool
    published: Transform | None
    seed: int
    progress: Callable[[int, int], object]

    def solve(
        self, a: BodyMotion, b: BodyMotion, names: Names, inverted: tuple[bool, bool | None]
    ) -> Calibration:
        clock = offset_of(a, b)
        self.progress(1, 8)
        turned = bool(inverted[1])
        problem = _problem(a, b, clock)
        start, pairs, shown, error = self._start(problem)
        notes: list[str] = []
        if inverted[1] is None:
            other = _problem(a, b.inverted(), clock)
            start_2, pairs_2, shown_2, error_2 = self._start(other)
            if error_2 < 0.5 * error:
                problem, start, pairs, shown = other, start_2, pairs_2, shown_2
                _, names = _swapped(b, names)
                turned = True
                notes.append(
                    f"The second motion was inverted: only the poses of {names[0][1]} in "
                    f"{names[1][1]} fit the first motion."
                )
        self.progress(2, 8)
        fit, length = self._best(problem, start, shown)
        shown = self._judged(pairs, fit, shown)
        free = self._with_clock(shown, problem)
        fit = refine(problem, fit, free, _segments(problem, length))
        self.progress(6, 8)
        halves = self._halves(problem, fit, free, length)
        self.progress(7, 8)
        return self._answer(
            problem, fit, free, shown, clock, names, halves, notes, (inverted[0], turned)
        )

    def _start(self, problem: Problem) -> tuple[Fit, MotionPairs, _Shown, float]:
        """Compute a first estimate of the mount.

        Returns:
            The estimate, the pairs of poses used, the parts of the mount that the motion
            determines, and the median error, metres.
        """
        pairs = pairs_of(problem)
        if pairs.largest < LEAST_TURN or len(pairs.turns_a) < 20:
            raise CalibrationRefused(
                f"{problem.a.name} turns by {math.degrees(pairs.largest):.1f}° at most within ten "
                "seconds: without rotation the translation cannot be determined.",
                f"turn by at least 30° about two axes; with a vehicle, {FIGURE}",
            )
        turn, weights = kabsch(pairs)
        scatter = (pairs.turns_a * weights[:, None]).T @ pairs.turns_a / weights.sum()
        values, vectors = np.linalg.eigh(scatter)
        second = math.sqrt(max(values[1], 0.0))
        axis = vectors[:, -1] * np.sign(vectors[np.abs(vectors[:, -1]).argmax(), -1])
        is_planar = self.planar or problem.a.is_planar()
        if self.planar and second > 2.0 * SECOND_AXIS:
            raise CalibrationRefused(
                f"{problem.a.name} tilts by {math.degrees(second):.1f}° on average, so the motion "
                "is not planar: leave out --planar; this motion determines the whole mount.",
            )
        if second < SECOND_AXIS or is_planar:
            if is_planar:
                axis = np.array([0.0, 0.0, 1.0])
            other = np.linalg.eigh(pairs.turns_b.T @ pairs.turns_b)[1][:, -1]
            other *= np.sign(np.sum((pairs.turns_a @ axis) * (pairs.turns_b @ other))) or 1.0
            begin = self._prior_turn(shortest_turn(other, axis), is_planar)
            turn, shift, error = about_one_axis(pairs, axis, begin)
            begun = Fit(turn, self._along(shift, axis), 0.0)
            return begun, pairs, _one_axis(axis, turn, is_planar), error
        shift, error = lever(pairs, turn, weights)
        directions = tuple(np.eye(9)[:6])
        return Fit(turn, shift, 0.0), pairs, _Shown(directions, None, ()), error

    def _prior_turn(self, found: Floats, is_planar: bool) -> Floats:
        """Return the published rotation if there is one and the motion is planar, else `found`."""
        if not is_planar or self.published is None:
            return found
        return np.array(self.published.rotation)

    def _along(self, shift: Floats, axis: Floats) -> Floats:
        """Replace a translation's component along `axis` by this component of the published mount.

        Without a published mount, the component becomes 0.
        """
        kept = 0.0 if self.published is None else np.array(self.published.translation) @ axis
        return np.asarray(shift - (shift @ axis) * axis + kept * axis)

    def _best(self, problem: Problem, start: Fit, shown: _Shown) -> tuple[Fit, float]:
        """Return the fit with the smallest confidence intervals.

        Each fit divides the time into segments of its own length. Segments in which the residuals
        grow are too long: odometry drifts in them, and bootstrapped intervals hide such a drift.

        Returns:
            The fit, and the length of its segments, seconds.
        """
        whole = float(problem.times[-1] - problem.times[0])
        lengths = [*(one for one in _SEGMENTS if one * 4.0 <= whole), math.inf]
        free = (*shown.free, np.eye(9)[SHIFT])
        best: tuple[float, Fit, float] | None = None
        least = np.full(2, math.inf)
        for number, length in enumerate(lengths):
            fit = refine(problem, start, free, _segments(problem, length), 8)
            if (np.array(fit.noise) > _GROWN * least).any():
                break
            least = np.minimum(least, fit.noise)
            sizes = spread(fit, 60, self.seed)[: len(shown.free)]
            score = float(np.exp(np.mean(np.log(np.maximum(sizes, 1e-12)))))
            if best is None or score < best[0]:
                best = score, fit, length
            self.progress(3 + number * 3 // len(lengths), 8)
        assert best is not None
        return best[1], best[2]

    def _judged(self, pairs: MotionPairs, fit: Fit, shown: _Shown) -> _Shown:
        """Return `shown`, or the parts that one axis determines if a second axis is only noise."""
        if shown.axis is not None:
            return shown
        values, vectors = np.linalg.eigh(pairs.turns_a.T @ pairs.turns_a / len(pairs.turns_a))
        if math.sqrt(max(values[1], 0.0)) > 6.0 * fit.noise[0]:
            return shown
        axis = vectors[:, -1] * np.sign(vectors[np.abs(vectors[:, -1]).argmax(), -1])
        return _one_axis(axis, fit.turn, is_planar=False)

    def _with_clock(self, shown: _Shown, problem: Problem) -> tuple[Floats, ...]:
        more = [SHIFT]
        if problem.times[-1] - problem.times[0] >= LONG:
            more.append(DRIFT)
        if self.scaled:
            more.append(SCALE)
        return (*shown.free, *np.eye(9)[more])

    def _halves(
        self, problem: Problem, fit: Fit, free: tuple[Floats, ...], length: float
    ) -> tuple[float, float] | None:
        """Return the difference between the mounts from both halves of the recording.

        Returns:
            Distance in metres and angle in degrees; None if a half has fewer than ten poses.
        """
        middle = float(np.median(problem.times))
        found = []
        for begin, end in ((-math.inf, middle), (middle, math.inf)):
            half = problem.between(begin, end)
            if len(half.times) < 10:
                return None
            fresh = replace(fit, joins=fit.joins[:0], places=fit.places[:0])
            found.append(refine(half, fresh, free, _segments(half, length), 6))
        one, other = found
        angle = batch.angles_between(one.turn, other.turn)
        return float(np.linalg.norm(one.shift - other.shift)), math.degrees(float(angle))

    def _answer(
        self,
        problem: Problem,
        fit: Fit,
        free: tuple[Floats, ...],
        shown: _Shown,
        clock: ClockOffset,
        names: Names,
        halves: tuple[float, float] | None,
        notes: list[str],
        inverted: tuple[bool, bool],
    ) -> Calibration:
        sizes = WIDTH * spread(fit, seed=self.seed)
        whole = fit
        if len(fit.joins) > 1:
            # X was estimated on this half; estimate only Y on the whole time.
            fresh = replace(fit, joins=fit.joins[:0], places=fit.places[:0])
            found = refine(problem, fresh, [np.eye(9)[SHIFT]], _segments(problem, math.inf), 6)
            whole = replace(found, turn=fit.turn, shift=fit.shift)
        ends = WIDTH * spread(whole, seed=self.seed)[-6:]
        turned, moved = _doubt(sizes[: len(shown.free)], shown, halves)
        sizes[: len(shown.free)] *= [turned if one[:3].any() else moved for one in shown.free]
        ends *= np.repeat([turned, moved], 3)
        clocked = len(shown.free)
        drifts = any(one[DRIFT] for one in free)
        why, following = _reason(shown)
        return Calibration(
            "partial" if shown.unseen else "solved",
            why,
            *names,
            _transform(fit.turn, fit.shift),
            _transform(whole.joins[0], whole.places[0]),
            _interval(sizes[:clocked], shown),
            _fixed_interval(ends, shown, problem, whole),
            clock.seconds + fit.offset,
            float(sizes[clocked]),
            fit.drift * 1e6 if drifts else None,
            clock,
            halves,
            shown.unseen,
            _tilted(shown),
            inverted,
            following,
            (fit.scale, float(sizes[len(free) - 1])) if self.scaled else None,
            tuple(notes),
        )


WIDTH: Final = 2.1
"""Half-width of a 95 % interval in standard deviations, for the few time blocks of a recording."""


def _doubt(sizes: Floats, shown: _Shown, halves: tuple[float, float] | None) -> tuple[float, float]:
    """Return two factors, at least 1, that widen the intervals of rotation and translation.

    If the mounts from both halves of the recording differ by more than the interval, the
    bootstrap missed an error, such as a wrong scale or a drift.
    """
    if halves is None:
        return 1.0, 1.0
    is_turn = np.array([one[:3].any() for one in shown.free])
    turns, moves = (float(np.linalg.norm(sizes[chosen])) for chosen in (is_turn, ~is_turn))
    return max(1.0, math.radians(halves[1]) / turns), max(1.0, halves[0] / moves)


def _problem(a: BodyMotion, b: BodyMotion, clock: ClockOffset) -> Problem:
    """Convert the motion `b` to the clock of `a`, with at most as many poses as the fit needs.

    Raises:
        CalibrationRefused: If the two motions overlap too little.
    """
    times = b.times + (clock.seconds - (a.start - b.start) / NANOSECONDS)
    _, _, valid = a.at(times)
    kept = np.flatnonzero(valid)
    if len(kept) < 20 or times[kept[-1]] - times[kept[0]] < LEAST_OVERLAP:
        raise CalibrationRefused(
            f"{a.name} and {b.name} overlap in time by {len(kept)} poses, which is too little: "
            "record both motions for half a minute at the same time.",
        )
    kept = kept[:: -(-len(kept) // _MOST_POSES)]
    middle = 0.5 * float(times[kept[0]] + times[kept[-1]])
    return Problem(a, times[kept], b.positions[kept], b.rotations[kept], middle)


def _segments(problem: Problem, length: float) -> "np.ndarray":
    """Return the time segment of each pose of the second motion, numbered from 0 without gaps."""
    if not math.isfinite(length):
        return np.zeros(len(problem.times), dtype=np.intp)
    numbers = ((problem.times - problem.times[0]) // length).astype(np.intp)
    found: np.ndarray = np.unique(numbers, return_inverse=True)[1]
    return found


def _one_axis(axis: Floats, turn: Floats, is_planar: bool) -> _Shown:
    """Return the parts of the mount that a motion about one axis determines.

    A translation along the axis is undetermined. A planar motion also leaves roll and pitch
    undetermined.
    """
    free = np.zeros((5, 9))
    free[:3, :3] = np.eye(3)
    free[3:, 3:6] = np.linalg.svd(axis[None])[2][1:]
    unseen = [name for name, part in zip(AXES, axis, strict=True) if abs(part) > HIDDEN]
    if not is_planar:
        return _Shown(tuple(free), axis, tuple(unseen))
    about = np.zeros(9)
    about[:3] = batch.rotate(batch.conjugate(turn[None]), axis[None])[0]
    return _Shown((about, *free[3:]), axis, (*unseen, "roll", "pitch"))


def _reason(shown: _Shown) -> tuple[str, str | None]:
    if shown.axis is None:
        return "The motion turns about two axes or more: it determines the whole mount.", None
    if "roll" in shown.unseen:
        return (
            "One motion is planar: height, roll and pitch of the mount are not determined.",
            "tilt the robot as well, and use a source that measures the tilt",
        )
    along = ", ".join(shown.unseen)
    return (
        f"The motion turns about one axis: the translation along this axis ({along}) is not "
        "determined.",
        (TWO_AXES),
    )


def _tilted(shown: _Shown) -> tuple[float, float, float] | None:
    """Return the undetermined direction if it is not along x, y or z of moving_a; else None."""
    if shown.axis is None or np.abs(shown.axis).max() > math.cos(math.radians(3.0)):
        return None
    x, y, z = shown.axis.tolist()
    return x, y, z


def _interval(sizes: Floats, shown: _Shown) -> Interval:
    """Return the interval of the mount from half-widths along the determined directions."""
    free = np.array(shown.free)[:, :6]
    widths = np.sqrt(((free * sizes[:, None]) ** 2).sum(axis=0))
    known = [name not in shown.unseen for name in (*ANGLES, *AXES)]
    parts = [float(one) if seen else None for one, seen in zip(widths, known, strict=True)]
    turns = [None if one is None else math.degrees(one) for one in parts[:3]]
    return Interval((parts[3], parts[4], parts[5]), (turns[0], turns[1], turns[2]))


def _fixed_interval(sizes: Floats, shown: _Shown, problem: Problem, fit: Fit) -> Interval:
    """Return the interval of the fixed mount: the pose of one fixed frame in the other.

    Undetermined parts of the mount are undetermined in the fixed mount too. A single axis of
    rotation has a constant direction in both fixed frames.
    """
    turns, moves = np.degrees(sizes[:3]), sizes[3:]
    if shown.axis is None:
        return Interval(_trio(moves, np.zeros(3)), _trio(turns, np.zeros(3)))
    _, rotations, _ = problem.a.at(problem.times[:1])
    axis = batch.rotate(rotations, shown.axis[None])
    across = np.zeros(3)
    if "roll" in shown.unseen:
        across = 1.0 - batch.rotate(batch.conjugate(fit.joins[:1]), axis)[0] ** 2
    return Interval(_trio(moves, np.abs(axis[0])), _trio(turns, np.sqrt(across.clip(0.0))))


def _trio(values: Floats, unseen: Floats) -> Trio:
    """Return half-widths along x, y and z; None for an axis that is mostly undetermined.

    Args:
        values: Half-widths, shape (3,).
        unseen: Undetermined fraction of each axis, 0 to 1, shape (3,).
    """
    x, y, z = (
        None if part > HIDDEN else float(value) for value, part in zip(values, unseen, strict=True)
    )
    return x, y, z


def _transform(turn: Floats, shift: Floats) -> Transform:
    return Transform(Vector3(*shift.tolist()), Quaternion(*batch.canonical(turn[None])[0].tolist()))
