import math

import numpy as np
import pytest

from tests.world.nodes.harness import play
from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.world.clock import SimClock
from tftool.world.nodes.broadcasters import Noise
from tftool.world.world import World

PERIOD = seconds(0.1)


def places(world_time=10.0, **words):
    """Return x, y, z and yaw of the noisy frame at each broadcast."""
    world = World(SimClock(), cache_time=seconds(1_000))
    Noise(world, parent="base", child="sensor", period=PERIOD, **words)
    play(world, world_time)
    samples = world.buffer.samples("sensor")
    turns = 2 * np.arctan2(samples.rotations[:, 2], samples.rotations[:, 3])
    return samples.translations, turns


def test_the_errors_have_the_spread_that_is_said():
    found, turns = places(400.0, offset=(1.0, 2.0, 3.0), position=0.1, angle=0.02)

    # With 4,000 draws, the standard error of the mean is 0.1 / 63, and of the deviation 1.1 %. Five
    # standard errors are allowed.
    assert found.shape == (4001, 3)
    assert found.mean(axis=0) == pytest.approx((1.0, 2.0, 3.0), abs=0.008)
    assert found.std(axis=0) == pytest.approx((0.1,) * 3, rel=0.06)
    assert turns.std() == pytest.approx(0.02, rel=0.06)


def test_drift_grows_with_the_root_of_the_time():
    ends = [
        places(4.0, position=0.0, angle=0.0, drift=0.3, turn_drift=0.1, seed=seed)
        for seed in range(200)
    ]

    # After four seconds, the deviation is twice the drift. With 200 walks, its standard error is
    # 5 %; four standard errors are allowed.
    last = np.array([found[-1] for found, _ in ends])
    assert last[:, :2].std(axis=0) == pytest.approx((0.3 * math.sqrt(4.0),) * 2, rel=0.2)
    assert not last[:, 2].any()
    assert np.std([turns[-1] for _, turns in ends]) == pytest.approx(0.1 * 2.0, rel=0.2)


def test_the_same_seed_gives_the_same_errors_and_another_one_others():
    first, again, other = places(seed=7), places(seed=7), places(seed=8)

    assert np.array_equal(first[0], again[0])
    assert np.array_equal(first[1], again[1])
    assert not np.array_equal(first[0], other[0])


def test_without_noise_and_drift_it_is_where_it_is():
    found, turns = places(offset=(1.0, 0.0, 0.5), position=0.0, angle=0.0)

    assert (found == (1.0, 0.0, 0.5)).all()
    assert not turns.any()


def test_a_negative_deviation_is_refused():
    with pytest.raises(UsageError, match="zero or more"):
        places(position=-0.1)
