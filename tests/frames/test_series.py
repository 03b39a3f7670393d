"""Tests of curves over time: units, gaps, and refusals."""

import math

import numpy as np
import pytest

from tftool import Buffer, Transform, TransformStamped, UsageError, seconds
from tftool.frames.pair_samples import Moments, sample
from tftool.frames.pair_series import QUANTITIES, chosen, panels, reasons, shades, thinned
from tftool.geometry.conversions import quaternion_from_rpy

SECOND = seconds(1)


def circling(stamps):
    """Return a frame on a circle of 2 m about the origin, one turn in 10 s, facing ahead."""
    buffer = Buffer(seconds(1000))
    for second in stamps:
        angle = 0.2 * math.pi * second
        pose = Transform(
            (2.0 * math.cos(angle), 2.0 * math.sin(angle), 0.5),
            quaternion_from_rpy(0.0, 0.0, angle + 0.5 * math.pi),
        )
        buffer.set_transform(TransformStamped(int(second * SECOND), "map", "car", pose))
    return buffer


def curves(found, *names, start=SECOND):
    return {
        one.label: one
        for panel in panels(found, start, names or QUANTITIES)
        for one in panel.curves
    }


def test_curves_of_a_circle_have_its_distance_speed_turn_rate_and_yaw():
    found = sample(circling(np.arange(1.0, 21.0, 0.05)), "map", "car")

    drawn = curves([found])

    middle = slice(5, -5)
    assert drawn["distance"].values[middle] == pytest.approx(math.sqrt(4.25))
    assert drawn["speed"].values[middle] == pytest.approx(0.4 * math.pi, rel=1e-3)
    assert drawn["turn rate"].values[middle] == pytest.approx(36.0, rel=1e-3)
    assert drawn["x"].times[0] == 0.0
    yaw = drawn["yaw"].values
    assert np.nanmax(np.abs(yaw)) <= 180.0
    # The yaw passes half a turn twice in 20 s, and no line is drawn at these points.
    assert np.count_nonzero(np.isnan(yaw)) == 2
    steps = np.abs(np.diff(yaw))
    assert np.nanmax(steps) < 2.0


def test_panels_are_by_kind_for_one_pair_and_by_quantity_for_several():
    found = sample(circling(np.arange(1.0, 3.0, 0.1)), "map", "car")
    back = sample(circling(np.arange(1.0, 3.0, 0.1)), "car", "map")

    assert [(one.title, one.unit, len(one.curves)) for one in panels([found], 0)] == [
        ("position", "m", 3),
        ("rotation", "°", 3),
        ("distance", "m", 1),
        ("speed", "m/s", 1),
        ("turn rate", "°/s", 1),
    ]
    both = panels([found, back], 0, ("x", "speed"))
    assert [one.title for one in both] == ["x", "speed"]
    assert [one.label for one in both[0].curves] == ["car in map", "map in car"]


def test_a_long_silence_is_a_gap():
    seconds_with_a_gap = [*np.arange(1.0, 3.0, 0.1), *np.arange(8.0, 10.0, 0.1)]

    drawn = curves([sample(circling(seconds_with_a_gap), "map", "car")], "x")["x"]

    assert np.count_nonzero(np.isnan(drawn.values)) == 1
    assert 2.9 <= drawn.times[np.flatnonzero(np.isnan(drawn.values))[0]] + 1.0 <= 8.0


def test_refused_moments_become_a_span_with_its_reason():
    buffer = circling(np.arange(1.0, 3.0, 0.1))
    found = sample(buffer, "map", "car", Moments(end=4 * SECOND, period=SECOND // 2))

    (span,) = shades([found], SECOND)

    assert (span.first, span.last) == (2.0, 3.0)
    told = "No pose from 2.000 s to 3.000 s: the data ends earlier (car in map)."
    assert reasons([span])[0] == told
    assert reasons([span] * 5)[-1] == "... and in 2 more spans."


def test_a_thinned_curve_keeps_its_peaks_and_gaps():
    times = np.arange(100_000.0)
    values = np.sin(times / 1000.0)
    values[77_777], values[5] = 9.0, -9.0
    values[50_000:50_010] = np.nan

    fewer, kept = thinned(times, values, 1000)

    assert len(kept) <= 1600
    assert (np.nanmax(kept), np.nanmin(kept)) == (9.0, -9.0)
    assert np.isnan(kept).any()
    assert (np.diff(fewer) > 0).all()


def test_limits_are_never_one_and_the_same():
    still = circling([1.0, 1.5])
    (panel,) = panels([sample(still, "map", "car")], 0, ("z",))

    low, high = panel.limits()

    assert low < 0.5 < high


def test_words_choose_what_is_drawn():
    assert chosen([]) == QUANTITIES
    assert chosen(["position", "yaw", "turn-rate", "x"]) == ("x", "y", "z", "yaw", "turn rate")
    with pytest.raises(UsageError, match="'wobble' cannot be plotted: use position"):
        chosen(["wobble"])
