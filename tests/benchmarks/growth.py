"""Growth of the time per lookup with depth, samples and frames, computed from measurements."""

import math

DEPTHS = (2, 5, 20, 100)
SAMPLES = (100, 1000, 10_000, 100_000)
FRAMES = (100, 1000, 10_000)


def fit(xs: list[float], ys: list[float]) -> tuple[float, float]:
    """Fit a line to points; return its start and its slope.

    The relative distances are minimised, so that a line through depths from 2 to 100 also fits
    at 2.
    """
    weights = [1.0 / (y * y) for y in ys]
    total = sum(weights)
    x_mean = sum(w * x for w, x in zip(weights, xs, strict=True)) / total
    y_mean = sum(w * y for w, y in zip(weights, ys, strict=True)) / total
    slope = sum(
        w * (x - x_mean) * (y - y_mean) for w, x, y in zip(weights, xs, ys, strict=True)
    ) / sum(w * (x - x_mean) ** 2 for w, x in zip(weights, xs, strict=True))
    return y_mean - slope * x_mean, slope


def lines(table: dict[str, dict[str, float]]) -> list[str]:
    """Return a line about the growth for each compared program.

    Args:
        table: Nanoseconds by workload and side.
    """
    deep = [table.get(f"any time in 1,000 samples, {depth} links", {}) for depth in DEPTHS]
    long = [table.get(f"any time in {count:,} samples, 5 links", {}) for count in SAMPLES]
    wide = [table.get(f"{count:,} frames, any two siblings", {}) for count in FRAMES]
    told = ["growth of one lookup: with depth, with the samples of a link, with frames"]
    for side in deep[0]:
        if not all(side in one for one in (*deep, *long, *wide)):
            continue
        costs = [one[side] for one in deep]
        start, slope = fit([float(depth) for depth in DEPTHS], costs)
        worst = max(
            abs(cost / (start + slope * depth) - 1.0)
            for depth, cost in zip(DEPTHS, costs, strict=True)
        )
        doubling = (long[-1][side] - long[0][side]) / math.log2(SAMPLES[-1] / SAMPLES[0])
        longer = f"{long[1][side] / long[0][side]:.2f} → {long[-1][side] / long[0][side]:.2f} times"
        told.append(
            f"  {side:<10} {start:6.0f} ns + {slope:5.0f} ns a link, at most {worst:4.0%} off"
            f"   100 → 1,000 → 100,000 samples: 1 → {longer}, "
            f"{doubling / long[0][side]:+.1%} a doubling"
            f"   100 → 10,000 frames: {wide[-1][side] / wide[0][side]:.2f} times"
        )
    for depth in DEPTHS:
        short = table.get(f"any time in 1,000 samples, {depth} links")
        full = table.get(f"any time in 100,000 samples, {depth} links")
        if short and full:
            ratios = ", ".join(f"{side} {full[side] / short[side]:.2f}" for side in short)
            told.append(
                f"  100,000 samples against 1,000, {depth} links: {ratios}"
                + ("   wanted of ours: 1.3 at most" if depth == 5 else "")
            )
    return told
