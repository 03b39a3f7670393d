"""Tests that snapshots are taken at a steady rate, and leave time for other work."""

from tftool.screens.browser.client import Cadence

MS = 1_000_000


def turns(cadence, works, late=()):
    """Return the times at which rounds began that took some time each, some of them begun late."""
    begun, due = [], 0
    for number, work in enumerate(works):
        began = due + dict(late).get(number, 0)
        begun.append(began)
        due = cadence.after(began, began + work)
    return begun


def test_short_turns_come_at_the_rate_asked_for():
    assert turns(Cadence(30 * MS, 0), [5 * MS] * 4) == [0, 30 * MS, 60 * MS, 90 * MS]


def test_a_turn_that_came_late_moves_none_of_those_behind_it():
    begun = turns(Cadence(30 * MS, 0), [10 * MS] * 6, late={1: 25 * MS})

    assert begun[1:3] == [55 * MS, 75 * MS]
    assert begun[3:] == [95 * MS, 120 * MS, 150 * MS]


def test_turns_longer_than_half_a_period_take_half_of_the_time():
    assert turns(Cadence(30 * MS, 0), [40 * MS] * 3) == [0, 80 * MS, 160 * MS]


def test_a_very_late_turn_shortens_only_the_interval_after_it():
    begun = turns(Cadence(30 * MS, 0), [10 * MS] * 4, late={1: 5_000 * MS})

    assert begun[2] - begun[1] == 20 * MS
    assert begun[3] - begun[2] == 30 * MS
