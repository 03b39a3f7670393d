"""Tests of `Buffer.samples`, which returns the samples of one frame."""

import threading

import numpy as np
import pytest

from tftool.base.errors import InvalidArgumentException, LookupException
from tftool.base.stamps import seconds
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform


def put(buffer, at, parent="map", child="base", x=0.0, authority="odometry", static=False):
    sample = TransformStamped(seconds(at), parent, child, Transform((x, 0.0, 0.0), (0, 0, 2, 0)))
    setter = buffer.set_transform_static if static else buffer.set_transform
    return setter(sample, authority)


def test_samples_come_oldest_first_with_their_parents_and_authorities():
    buffer = Buffer()
    put(buffer, 3, x=3.0)
    put(buffer, 1, x=1.0, authority="late")
    put(buffer, 2, x=2.0, parent="odom", authority="other")
    put(buffer, 4, x=4.0)

    held = buffer.samples("base")

    assert (held.frame, held.is_static, len(held)) == ("base", False, 4)
    assert held.stamps.tolist() == [seconds(at) for at in (1, 2, 3, 4)]
    assert held.stamps.dtype == np.int64
    assert held.parents.tolist() == ["map", "odom", "map", "map"]
    assert held.authorities.tolist() == ["late", "other", "odometry", "odometry"]
    assert held.poses.shape == (4, 7)
    assert held.translations[:, 0].tolist() == [1.0, 2.0, 3.0, 4.0]
    assert held.rotations.tolist() == [[0.0, 0.0, 1.0, 0.0]] * 4


def test_two_publishers_of_one_link_are_told_apart_while_remembered():
    buffer = Buffer(seconds(10))
    for step in range(200):
        put(buffer, 1 + step, authority="ekf" if step % 2 else "wheels")

    held = buffer.samples("base")

    assert held.parents.tolist() == ["map"] * len(held)
    assert held.authorities.tolist() == [
        "ekf" if at % 2 == 0 else "wheels" for at in (held.stamps // seconds(1)).tolist()
    ]
    for step in range(200, 300):
        put(buffer, 1 + step, authority="ekf")
    assert set(buffer.samples("base").authorities) == {"ekf"}


def test_samples_set_together_keep_who_sent_them():
    buffer = Buffer()
    stamps = np.arange(1, 6) * seconds(1)
    places, turns = np.zeros((5, 3)), np.tile([0.0, 0.0, 0.0, 1.0], (5, 1))
    buffer.set_transforms("map", "base", stamps, places, turns, "first")
    buffer.set_transforms("map", "base", stamps + seconds(0.5), places, turns, "second")

    assert buffer.samples("base").authorities.tolist() == ["first", "second"] * 5


def test_a_static_has_one_sample_and_a_root_has_none():
    buffer = Buffer()
    put(buffer, 5, child="laser", x=0.5, authority="urdf", static=True)

    held = buffer.samples("laser")
    assert (held.is_static, held.stamps.tolist()) == (True, [0])
    assert (held.parents.tolist(), held.authorities.tolist()) == (["map"], ["urdf"])
    assert held.translations.tolist() == [[0.5, 0.0, 0.0]]
    root = buffer.samples("map")
    assert (len(root), root.poses.shape, root.parents.tolist()) == (0, (0, 7), [])


def test_a_cleared_frame_has_no_samples_left():
    buffer = Buffer()
    put(buffer, 1)
    buffer.clear()

    assert len(buffer.samples("base")) == 0
    put(buffer, 0.5, authority="again")
    assert buffer.samples("base").authorities.tolist() == ["again"]


@pytest.mark.parametrize(
    ("child", "refused"),
    [("ghost", LookupException), ("", InvalidArgumentException), ("/a", InvalidArgumentException)],
)
def test_a_frame_that_cannot_be_asked_for_is_refused_by_name(child, refused):
    with pytest.raises(refused, match=f'"{child}" passed to samples'):
        Buffer().samples(child)


def test_returned_samples_are_a_read_only_copy():
    buffer = Buffer()
    put(buffer, 1)
    held = buffer.samples("base")

    for column in (held.stamps, held.parents, held.poses, held.authorities, held.translations):
        with pytest.raises(ValueError, match="read-only"):
            column[0] = 0
    put(buffer, 2)
    assert len(held) == 1


def test_a_buffer_without_a_limit_prunes_nothing():
    buffer = Buffer(NO_LIMIT)
    year = seconds(365 * 86_400)
    stamps = np.arange(1, 101) * year
    buffer.set_transforms(
        "map", "base", stamps, np.zeros((100, 3)), np.tile([0.0, 0.0, 0.0, 1.0], (100, 1))
    )
    put(buffer, 1)
    for at in range(101, 200):
        buffer.set_transform(TransformStamped(at * year, "map", "base", Transform()), "late")

    assert len(buffer.samples("base")) == 200
    assert buffer.can_transform("map", "base", seconds(2))


def test_other_threads_ask_for_many_while_the_owner_sets():
    buffer = Buffer(2_000)

    def set_to(at):
        for child in ("odom", "base"):
            pose = Transform((float(at), 0.0, 0.0))
            parent = "map" if child == "odom" else "odom"
            authority = "even" if at % 2 == 0 else "odd"
            buffer.set_transform(TransformStamped(at, parent, child, pose), authority)

    for at in range(1, 2_001):
        set_to(at)
    failures, answered = [], []
    done = threading.Event()

    def ask():
        try:
            while not done.is_set() or not answered:
                held = buffer.samples("base")
                assert (held.translations[:, 0] == held.stamps).all()
                assert (held.authorities == np.where(held.stamps % 2 == 0, "even", "odd")).all()
                path = buffer.lookup_transforms("map", "base", held.stamps, missing="nan")
                assert (path.translations[path.valid, 0] == 2 * path.stamps[path.valid]).all()
                answered.append(path.valid.sum())
        except BaseException as failure:
            failures.append(failure)
            done.set()

    other = threading.Thread(target=ask)
    other.start()
    for at in range(2_001, 30_001):
        set_to(at)
    done.set()
    other.join()

    assert failures == []
    assert max(answered) > 1_000
