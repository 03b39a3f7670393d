"""Comparison of a recording with compiled tf2 that got the transforms as decoded by rosbags."""

import random

import pytest

pytest.importorskip("rosbags", reason="decodes the copy")
pytest.importorskip("mcap", reason="writes the test files")

from rosbags.highlevel import AnyReader

from tests.differential import compare
from tests.differential.ours import difference
from tests.differential.worlds import SECOND, World
from tests.recordings.writers import ROS2, Sent, numbers, write_mcap, write_rosbag1
from tftool import open_recording
from tftool.base.errors import TransformException

QUESTIONS = 1000

# Debian's binding passes stamps as doubles, which represent multiples of this step exactly.
STEP = SECOND // 64
START = 1_750_000_000 * SECOND
MISSING = compare.missing()


def sent():
    """Return a robot with static frames, a moving chain of three, and a frame that starts late."""
    mounts = ((0, "base_link", "laser", numbers(1)), (0, "base_link", "camera", numbers(2)))
    messages = [Sent(START, "/tf_static", mounts, node="/state_publisher")]
    for tick in range(300):
        stamp = START + tick * STEP
        frames = [(stamp, "odom", "base_link", numbers(1000 + tick))]
        if tick % 3 == 0:
            frames.append((stamp, "map", "odom", numbers(2000 + tick)))
        if tick > 100:
            frames.append((stamp - STEP, "base_link", "arm", numbers(3000 + tick)))
        messages.append(Sent(stamp + STEP // 8, "/tf", tuple(frames)))
    return messages


def decoded(path):
    """Return every transform that rosbags finds, as steps of a world."""
    steps = []
    with AnyReader([path], default_typestore=ROS2) as reader:
        wanted = [one for one in reader.connections if one.topic in ("/tf", "/tf_static")]
        for connection, _, raw in reader.messages(wanted):
            for one in reader.deserialize(raw, connection.msgtype).transforms:
                at, turn = one.transform.translation, one.transform.rotation
                stamp = one.header.stamp.sec * SECOND + one.header.stamp.nanosec
                pose = [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]
                static = connection.topic == "/tf_static"
                steps.append(["set", one.header.frame_id, one.child_frame_id, stamp, pose, static])
    return steps


@pytest.mark.skipif(bool(MISSING), reason=MISSING)
@pytest.mark.parametrize(("write", "name"), [(write_mcap, "run.mcap"), (write_rosbag1, "run.bag")])
def test_a_recording_answers_as_compiled_tf2_does(tmp_path, write, name):
    path = write(tmp_path / name, sent())
    steps = decoded(path)
    draw = random.Random(5)
    stamps = [step[3] for step in steps if not step[5]]
    frames = sorted({name for step in steps for name in step[1:3]})
    questions = []
    for _ in range(QUESTIONS):
        moment = draw.choice([0, draw.choice(stamps), draw.choice(stamps) + STEP // 2])
        questions.append(["lookup", draw.choice(frames), draw.choice(frames), moment])
    questions.append(["lookup", "map", "laser", min(stamps) - STEP])
    questions.append(["lookup", "map", "laser", max(stamps) + STEP])
    (theirs,) = compare.their_answers([World(10**6 * SECOND, steps + questions)])

    mine = []
    with open_recording(path) as recording:
        for _, target, source, moment in questions:
            try:
                found = recording.buffer.lookup_transform(target, source, moment)
            except TransformException as refused:
                kind = next(
                    one
                    for one in type(refused).__mro__
                    if one.__module__ == "tftool.base.errors"
                    and not one.__name__.startswith(("Backward", "Forward", "NoData"))
                )
                mine.append(["refused", kind.__name__])
            else:
                pose = [*found.transform.translation, *found.transform.rotation]
                mine.append(["is", [found.stamp, pose]])

    apart = [difference(wanted, found) for wanted, found in zip(theirs, mine, strict=True)]
    worst = max(range(len(apart)), key=apart.__getitem__)
    assert apart[worst] <= 1e-12, (questions[worst], theirs[worst], mine[worst])
    assert {answer[0] for answer in theirs} == {"is", "refused"}
