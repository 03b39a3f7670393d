"""Tests that earlier lookups never change the result of a later one."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tftool.base.errors import LookupException, TransformException
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

FRAMES = ["root", "a", "m", "s", "t"]
PAIRS = [(target, source) for target in FRAMES for source in FRAMES if target != source]
MOMENTS = range(13)


def build(world):
    buffer = Buffer(8, log=lambda level, text: None)
    for stamp, parent, child, static in world:
        pose = Transform((float(stamp), 1.0, 0.0))
        sample = TransformStamped(stamp, FRAMES[parent], FRAMES[child], pose)
        (buffer.set_transform_static if static else buffer.set_transform)(sample, "law")
    return buffer


def answers(buffer, target, source, time):
    """Return all results of a buffer for one question."""
    try:
        found = buffer.lookup_transform(target, source, time)
    except TransformException as refused:
        found = type(refused), str(refused)
    many = [
        buffer.lookup_transforms(target, source, np.array([time]), missing="nan").valid.tolist()
        if buffer.frame_exists(target) and buffer.frame_exists(source)
        else []
    ]
    why = buffer.why_not(target, source, time)
    return found, buffer.can_transform(target, source, time), why, many


steps = st.tuples(
    st.integers(1, 12), st.integers(0, 4), st.integers(1, 4), st.sampled_from([False] * 5 + [True])
).filter(lambda step: step[1] != step[2])

# s and t are children of m. m is a child of root now, and at first was a child of a, which was a
# child of m.
CIRCLE_ABOVE = [
    *((stamp, 2, child, False) for child in (3, 4) for stamp in (1, 2, 3, 4)),
    *((stamp, 1, 2, False) for stamp in (1, 2)),
    *((stamp, 2, 1, False) for stamp in (1, 2)),
    (3, 0, 2, False),
    (4, 0, 2, False),
]


@given(st.lists(steps, min_size=1, max_size=30), st.sampled_from(PAIRS), st.sampled_from(MOMENTS))
@example(CIRCLE_ABOVE, ("t", "s"), 1)
def test_a_buffer_that_was_asked_everything_answers_as_one_that_was_asked_nothing(
    world, pair, moment
):
    asked = build(world)
    for target, source in PAIRS:
        for time in MOMENTS:
            asked.can_transform(target, source, time)
    for target, source in PAIRS:
        for time in MOMENTS:
            asked.can_transform(target, source, time)

    assert answers(asked, *pair, moment) == answers(build(world), *pair, moment)


def test_a_circle_above_both_frames_is_refused_whatever_was_asked_before():
    buffer = build(CIRCLE_ABOVE)
    assert buffer.lookup_transform("t", "s", 4).stamp == 4
    assert buffer.lookup_transforms("t", "s", [3, 4]).valid.all()

    with pytest.raises(LookupException, match="contains a loop"):
        buffer.lookup_transform("t", "s", 1)
    assert not buffer.can_transform("t", "s", 1)
    assert not buffer.lookup_transforms("t", "s", [1], missing="nan").valid.any()
