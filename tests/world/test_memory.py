"""Tests of the limit on the bytes of a live world's samples, and of its log messages."""

import pytest

from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.world.clock import SimClock
from tftool.world.memory_limit import EVERY, MAX_BYTES, VARIABLE, allowed
from tftool.world.world import World

KIB = 1 << 10


def moving(child, stamp, parent="world", x=0.0):
    return TransformStamped(stamp, parent, child, Transform((x, 0.0, 0.0)))


def filled(numbers, step=1000):
    buffer = Buffer(seconds(10))
    for child, number in numbers.items():
        for index in range(number):
            sample = moving(child, seconds(100) + index * step, x=float(index))
            assert buffer.set_transform(sample, f"of {child}")
    return buffer


def count(buffer, child):
    return len(buffer.samples(child))


def test_only_the_longest_links_are_cut_and_what_is_kept_still_answers():
    buffer = filled({"small": 10, "large": 4000, "other": 3000})

    cut = buffer.shorten(64 * 4000)

    assert [(one.child, one.authority, one.samples) for one in cut] == [
        ("large", "of large", 4000),
        ("other", "of other", 3000),
    ]
    assert count(buffer, "small") == 10
    assert count(buffer, "large") == count(buffer, "other") == (3000 - 10) // 2
    assert [one.kept for one in cut] == [1495, 1495]
    oldest = seconds(100) + (4000 - 1495) * 1000
    at_oldest = buffer.lookup_transform("world", "large", oldest)
    assert at_oldest.transform.translation == (4000.0 - 1495.0, 0.0, 0.0)
    assert not buffer.can_transform("world", "large", oldest - 1)


def test_nothing_is_cut_that_has_room_and_two_samples_of_each_link_stay():
    buffer = filled({"a": 100, "b": 100})

    assert buffer.shorten(64 * 200) == []
    assert [one.samples for one in buffer.shorten(1)] == [100, 100]
    assert count(buffer, "a") == count(buffer, "b") == 2
    assert buffer.set_transform(moving("a", seconds(200)), "of a")


def test_samples_of_one_stamp_are_cut_too():
    buffer = filled({"a": 100}, step=0)

    assert [one.kept for one in buffer.shorten(64 * 40)] == [30]
    assert buffer.lookup_transform("world", "a", 0).transform.translation == (99.0, 0.0, 0.0)


def test_a_sender_that_floods_a_world_is_named_once_and_the_others_keep_theirs():
    world = World(SimClock(), max_bytes=512 * KIB)
    for index in range(100):
        world.broadcast([moving("calm", seconds(100) + index)], "good")
    for turn in range(4):
        for index in range(EVERY):
            stamp = seconds(100) + turn * EVERY + index
            world.broadcast([moving("flood", stamp, x=float(index))], "bad")

    said = [record.text for record in world.log.records if record.node == "buffer"]
    assert len(said) == 1
    assert "'flood' from 'bad' had" in said[0]
    assert VARIABLE in said[0]
    assert count(world.buffer, "calm") == 100
    assert count(world.buffer, "flood") <= 512 * KIB // 64 + EVERY


def test_a_parent_that_changed_long_ago_is_forgotten_with_its_samples():
    buffer = Buffer(seconds(10))
    for index in range(100):
        parent = "before" if index < 50 else "after"
        buffer.set_transform(moving("child", seconds(100) + index * 1000, parent))

    buffer.shorten(64 * 40)

    assert buffer.can_transform("after", "child", 0)
    assert not buffer.can_transform("before", "child", seconds(100) + 10_000)
    assert set(buffer.samples("child").parents) == {"after"}


@pytest.mark.parametrize(("given", "allows"), [("64", 64 << 20), ("", MAX_BYTES)])
def test_the_environment_says_how_much_may_be_kept(given, allows):
    assert allowed({VARIABLE: given}) == allows


@pytest.mark.parametrize("given", ["0", "-3", "1g", "lots", "9" * 5000])
def test_an_invalid_number_of_megabytes_is_refused(given):
    with pytest.raises(UsageError, match="is not a number of megabytes"):
        allowed({VARIABLE: given})
