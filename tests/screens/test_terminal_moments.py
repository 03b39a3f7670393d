"""Tests of the turtles' screen at a past moment."""

import pytest

from tests.screens.visiting import shown, told
from tftool.base.stamps import seconds


def test_time_travel_shows_everything_at_that_moment(danced):
    at = danced.world.clock.now() - seconds(2.2)
    found = danced.world.buffer.lookup_transform("turtle2", "turtle1", at)
    x, y, z = found.transform.translation

    text = "\n".join(shown(danced, keys=("{", "{", "[", "[")))

    assert "11.8 s  ◀◀ 2.2 s ago" in text
    assert f"xyz   {x:7.3f} {y:7.3f} {z:7.3f}" in text
    assert "at    11.800 s" in text
    assert "l live" in text


def test_one_comes_back_from_the_past(danced):
    live_screen = told(shown(danced))

    assert told(shown(danced, keys=("[", "[", "]", "]"))) == live_screen
    assert told(shown(danced, keys=("{", "l"))) == live_screen
    assert told(shown(danced, keys=("]", "}"))) == live_screen
    assert told(shown(danced, keys=("[",))) != live_screen


def test_an_earlier_moment_is_marked_in_the_plots(danced):
    def cursor(*keys):
        lines = shown(danced, (100, 40), keys=keys)
        return {line.index("┃") for line in lines if "┃" in line}

    assert cursor() == set()
    (early,), (late,) = cursor("{", "{", "{", "{"), cursor("{")
    assert early < late


def test_scrubbed_to_a_moment_the_tree_shows_the_rates_of_that_moment(turtles):
    """Check an edge that begins at 2 s, 100 ms later: six samples in 80 ms, as tf2 counts."""
    scene = turtles(9.0, (), followed=True)
    spawned = scene.world.buffer.samples("turtle2").stamps[0]

    at = int(spawned) + seconds(0.1)
    info = scene.moment(at, "turtle2", "turtle1").snapshot.frame("turtle2")

    early = [one for one in scene.world.buffer.samples("turtle2").stamps.tolist() if one <= at]
    assert (info.samples, info.oldest, info.newest) == (len(early), early[0], early[-1])
    assert info.rate == pytest.approx(len(early) / ((early[-1] - early[0]) / 1e9))
    assert info.rate > 70


def test_one_cannot_go_further_back_than_the_buffer(danced):
    text = "\n".join(shown(danced, keys=("{",) * 20))

    assert "10.0 s ago" in text


def test_in_the_past_another_pair_can_be_picked(danced):
    at = danced.world.clock.now() - seconds(1)
    x, y, z = danced.world.buffer.lookup_transform("turtle1", "turtle2", at).transform.translation

    text = "\n".join(shown(danced, keys=("{", "x")))

    assert "turtle2 in turtle1" in text
    assert f"xyz   {x:7.3f} {y:7.3f} {z:7.3f}" in text
