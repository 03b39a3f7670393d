"""Offset between the clocks of two motions of one rigid body, from rotations alone.

In a time window, a rigid body turns by an angle that is the same for all points of the body and in
all fixed frames. Both motions give this angle over time, each on its own clock. The offset is the
time shift at which the two curves correlate best. Windows longer than the sample period reduce the
noise.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.buffer.batch.transform_array import TransformArray
from tftool.frames.calibration.body_motion import BodyMotion, CalibrationRefused, Floats
from tftool.frames.frames import Frames
from tftool.frames.pair_samples import only_chain, sample
from tftool.geometry import rigid_arrays as batch

WINDOWS: Final = (0.3, 0.6, 1.0)
"""Durations, seconds, over which the turned angle is computed; the highest peak is used."""

LEAST_CORRELATION: Final = 0.9
"""Minimum correlation: unrelated motions reach 0.69, motions of one body at least 0.96."""

CLEAR_PEAK: Final = 1.5
"""Minimum ratio of the distances from 1 of the second and the highest peak."""

LEAST_OVERLAP: Final = 5.0
"""Minimum duration of the common time, seconds."""

_NOISE_FLOOR: Final = 1e-3
"""Distance from 1 that every measured correlation has."""

_STEP: Final = 0.01
_MOST_STEPS: Final = 400_000
_BLOCKS: Final = 20
_DRAWS: Final = 200


@dataclass(frozen=True, slots=True, eq=False)
class ClockOffset:
    """Offset of the clock of motion A from the clock of motion B: t_a = t_b + seconds.

    Attributes:
        seconds: The offset.
        interval95: Half-width of the 95 % interval of `seconds`.
        correlation: Height of the highest peak of `curve`; 1 if both motions turn equally.
        second: Height of the second highest peak of `curve`.
        lags: Clock offsets for which the correlation was computed, seconds, shape (n,).
        curve: Correlation at each offset, NaN where the overlap is too small, shape (n,).
    """

    seconds: float
    interval95: float
    correlation: float
    second: float
    lags: Floats
    curve: Floats

    def __float__(self) -> float:
        return self.seconds

    def __repr__(self) -> str:
        return (
            f"<ClockOffset: {self.seconds:.6f} s ± {self.interval95 * 1e3:.1f} ms, "
            f"correlation {self.correlation:.3f}>"
        )


def clock_offset(a: TransformArray | Frames, b: TransformArray | Frames) -> ClockOffset:
    """Measure the offset between the clocks of two motions: t_a = t_b + offset.

        tftool.clock_offset(tftool.open("vicon.csv"), tftool.open("camera.csv")).seconds

    Args:
        a: The first motion: poses over time, or frames that form a single chain.
        b: The second motion, on any clock.

    The moving frames must be on one rigid body. The fixed frames and the offset may be arbitrary.

    Raises:
        InputError: If the frames of an input are not a single chain.
        CalibrationRefused: If the rotations do not agree, the offset is ambiguous, or one motion
            has too few poses.
    """
    return offset_of(BodyMotion.of(path_of(a)), BodyMotion.of(path_of(b)))


def path_of(frames: TransformArray | Frames) -> TransformArray:
    """Return poses unchanged; for opened frames, the poses of a chain's last frame in its root.

    Raises:
        InputError: If the frames are not a single chain.
    """
    if isinstance(frames, TransformArray):
        return frames
    return sample(frames.buffer, *only_chain(frames.buffer)).answered()


def offset_of(a: BodyMotion, b: BodyMotion) -> ClockOffset:
    """Measure the clock offset of two motions; see `clock_offset`."""
    shorter = min(a.duration, b.duration)
    if shorter < LEAST_OVERLAP:
        raise CalibrationRefused(
            f"The motions last {a.duration:.1f} s and {b.duration:.1f} s: at least "
            f"{LEAST_OVERLAP:g} s are needed.",
            "move for half a minute, turning about two axes",
        )
    step = max(_STEP, max(a.duration, b.duration) / _MOST_STEPS)
    found = max((_correlated(a, b, step, window) for window in WINDOWS), key=lambda one: one.height)
    if not found.height >= LEAST_CORRELATION:
        raise CalibrationRefused(
            f"The rotations of {a.name} and {b.name} do not agree at any clock offset (best "
            f"correlation {max(found.height, 0.0):.2f}, {LEAST_CORRELATION:g} is needed): either "
            "the two frames are not on one rigid body, or the body hardly turns.",
            "turn by at least 30° about two axes, at changing speed, for half a minute",
        )
    second = found.second_peak()
    if 1.0 - second < CLEAR_PEAK * max(1.0 - found.height, _NOISE_FLOOR):
        raise CalibrationRefused(
            f"Several clock offsets fit equally well (correlations {found.height:.3f} and "
            f"{second:.3f}): the motion repeats itself.",
            "turn irregularly: at changing speed, by changing angles",
        )
    place, spread = found.refined()
    base = (a.start - b.start) / NANOSECONDS
    lags = base + found.lags * step
    seconds = base + place * step
    return ClockOffset(seconds, spread * step, found.height, second, lags, found.curve)


@dataclass(frozen=True, slots=True, eq=False)
class _Correlation:
    """Correlation of two curves with the same time step, at all time shifts (lags).

    Attributes:
        lags: Time shifts in steps, shape (n,).
        curve: Correlation at each lag; NaN where the overlap is too small, shape (n,).
        first: Values of the first curve, and a mask that is 0 in gaps.
        second: Values of the second curve, and a mask that is 0 in gaps.
    """

    lags: Floats
    curve: Floats
    first: tuple[Floats, Floats]
    second: tuple[Floats, Floats]

    @property
    def peak(self) -> int:
        return int(np.nanargmax(self.curve)) if np.isfinite(self.curve).any() else 0

    @property
    def height(self) -> float:
        return float(self.curve[self.peak]) if np.isfinite(self.curve).any() else -1.0

    def second_peak(self) -> float:
        """Return the height of the second highest peak, outside the flanks of the highest peak."""
        curve, peak = np.nan_to_num(self.curve, nan=-1.0), self.peak
        low, high = peak, peak
        while low > 0 and curve[low - 1] <= curve[low]:
            low -= 1
        while high < len(curve) - 1 and curve[high + 1] <= curve[high]:
            high += 1
        rest = np.concatenate([curve[:low], curve[high + 1 :]])
        return float(rest.max()) if len(rest) else -1.0

    def refined(self) -> tuple[float, float]:
        """Return the position of the peak and the half-width of its 95 % interval, in steps.

        The position is the top of a parabola fitted to nine values. The half-width comes from a
        bootstrap over blocks of time.
        """
        lag = int(self.lags[self.peak])
        near = np.arange(-4, 5)
        (f, has_f), (g, has_g) = self.first, self.second
        sums = []
        for shift in lag + near:
            x, y, both = _overlap(f, has_f, g, has_g, int(shift))
            parts = np.array_split(np.stack([both, x, y, x * x, y * y, x * y]), _BLOCKS, axis=1)
            sums.append([part.sum(axis=1) for part in parts])
        table = np.array(sums).transpose(1, 0, 2)  # block, shift, sum
        dice = np.random.default_rng(0)
        drawn = dice.integers(0, _BLOCKS, (_DRAWS, _BLOCKS))
        places = _tops(table[drawn].sum(axis=1))
        (place,) = _tops(table.sum(axis=0)[None])
        return float(lag + place), float(1.96 * places.std())


def _tops(sums: Floats) -> Floats:
    """Return the top of the parabola through nine correlations around a peak, in steps.

    Args:
        sums: Sums of 1, x, y, x², y² and xy over two curves at each of the nine lags, shape
            (n, 9, 6).

    Returns:
        Positions relative to the middle lag, -4 to 4, shape (n,).
    """
    count, x, y, xx, yy, xy = np.moveaxis(sums, -1, 0)
    count = np.maximum(count, 1.0)
    spread = (xx - x * x / count) * (yy - y * y / count)
    curve = (xy - x * y / count) / np.sqrt(np.maximum(spread, 1e-300))
    near = np.arange(-4, 5)
    design = np.stack([near**2, near, np.ones(9)], axis=1)
    bent, slope, _ = np.linalg.lstsq(design, curve.T, rcond=None)[0]
    tops: Floats = np.clip(-slope / (2.0 * np.minimum(bent, -1e-12)), -4.0, 4.0)
    return tops


def _overlap(
    f: Floats, has_f: Floats, g: Floats, has_g: Floats, lag: int
) -> tuple[Floats, Floats, Floats]:
    """Return the overlapping parts of both curves, and a mask of the overlap; all are 0 in gaps.

    Args:
        f: Values of the first curve.
        has_f: Mask of the first curve, 0 in gaps.
        g: Values of the second curve.
        has_g: Mask of the second curve, 0 in gaps.
        lag: Shift of the second curve, in steps.
    """
    low, high = max(0, lag), min(len(f), len(g) + lag)
    both = has_f[low:high] * has_g[low - lag : high - lag]
    return f[low:high] * both, g[low - lag : high - lag] * both, both


def _course(motion: BodyMotion, step: float, window: float) -> tuple[Floats, Floats]:
    """Return the angle turned in a window after each time of a grid, and a mask of these angles.

    Args:
        motion: The motion.
        step: Step of the grid, seconds.
        window: Length of the window, seconds.

    Returns:
        Angles in radians, and a mask that is 0 without data, each of shape (n,).
    """
    grid = np.arange(0.0, motion.duration - window, step)
    _, first, knows_first = motion.at(grid)
    _, last, knows_last = motion.at(grid + window)
    known = knows_first & knows_last
    return np.where(known, batch.angles_between(first, last), 0.0), known.astype(np.float64)


def _correlated(a: BodyMotion, b: BodyMotion, step: float, window: float) -> _Correlation:
    """Return the correlation of the angles turned in two motions at every lag, ignoring gaps.

    Source:
        Padfield, "Masked object registration in the Fourier domain", 2012.
    """
    f, has_f = _course(a, step, window)
    g, has_g = _course(b, step, window)
    size = 1 << (len(f) + len(g) - 1).bit_length()

    def spectrum(course: Floats) -> "np.ndarray":
        return np.fft.rfft(course, size)

    def against(left: "np.ndarray", right: "np.ndarray") -> Floats:
        whole = np.fft.irfft(left * np.conj(right), size)
        return np.concatenate([whole[-(len(g) - 1) :], whole[: len(f)]])

    # Subtract the means, so that no digits are lost.
    f = (f - f.sum() / max(1.0, has_f.sum())) * has_f
    g = (g - g.sum() / max(1.0, has_g.sum())) * has_g
    mask_f, mask_g, at_f, at_g = map(spectrum, (has_f, has_g, f, g))
    count = np.maximum(against(mask_f, mask_g), 1e-9)
    sum_f, sum_g = against(at_f, mask_g), against(mask_f, at_g)
    spread_f = against(spectrum(f * f), mask_g) - sum_f**2 / count
    spread_g = against(mask_f, spectrum(g * g)) - sum_g**2 / count
    shared = against(at_f, at_g) - sum_f * sum_g / count
    least = max(LEAST_OVERLAP / step, 0.3 * min(has_f.sum(), has_g.sum()))
    # Without motion there is nothing to correlate.
    floor = 1e-3 * count * np.array([(f * f).mean(), (g * g).mean()])[:, None]
    usable = (
        (count >= min(least, 0.9 * count.max())) & (spread_f > floor[0]) & (spread_g > floor[1])
    )
    curve = np.where(usable, shared / np.sqrt(np.where(usable, spread_f * spread_g, 1.0)), np.nan)
    lags = np.arange(-(len(g) - 1), len(f)).astype(np.float64)
    return _Correlation(lags, curve, (f, has_f), (g, has_g))
