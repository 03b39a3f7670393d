"""Tests of small curves of rate and delay beside each frame."""

import pytest

from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import Traffic
from tftool.drawing.sparklines import TrafficHistory, sparkline
from tftool.geometry.rigid import Transform


def test_a_curve_goes_from_nothing_to_its_largest_value():
    assert sparkline([0, 5, 10], 3) == "▁▄▇"
    assert sparkline([0, 5, 10], 3, ascii_only=True).isascii()
    assert sparkline([1, None, 1, 1], 6) == "▇▇ ▇▇▇"
    assert sparkline([9, 1, 2], 2) == "▇▂"
    assert sparkline([None, None], 4) == ""
    assert sparkline([0.0, -1.0], 2) == "▁▁"


@pytest.mark.parametrize(("room", "cells"), [(30, 13), (104, 50), (400, 60)])
def test_rate_and_delay_are_counted_from_look_to_look(room, cells):
    traffic, history = Traffic(), TrafficHistory()
    now = seconds(100)
    for look in range(20):
        now += seconds(0.5)
        # Ten messages per look at first, and none later; each is 0.1 s old.
        for _ in range(10 if look < 10 else 0):
            sample = TransformStamped(now - seconds(0.1), "map", "base", Transform.identity())
            traffic.receive(now, [sample], "driver", is_static=False)
        history.look(now, traffic)

    rate, delay = history.columns(["base", "map"], room)

    # The maximum of the curve is written after the curve: 20 Hz, and 100 ms.
    curve, most = rate.cells[0][0].split()
    assert curve.endswith("▁")
    assert "▇" in curve
    assert float(most) == pytest.approx(20.0, abs=0.5)
    curve, most = delay.cells[0][0].split()
    assert (set(curve), most) == ({"▇"}, "100")
    assert rate.cells[1][0] == delay.cells[1][0] == ""
    assert rate.width == delay.width == cells
    assert [one.heading for one in history.columns(["base"], 20)] == ["rate, max Hz"]
    assert history.columns(["base"], 12) == []


def test_the_delay_of_a_burst_between_two_looks_is_in_the_curve():
    traffic, history = Traffic(), TrafficHistory()
    now = seconds(100)
    for delay in (0.01, 0.3, 0.01):
        now += seconds(0.1)
        sample = TransformStamped(now - seconds(delay), "map", "base", Transform.identity())
        traffic.receive(now, [sample], "driver", is_static=False)
    history.look(now, traffic)

    (look,) = history.looks("base")

    assert look.delay == pytest.approx(0.3)
