"""The program to compare with: ROS 1's compiled tf2 from Debian, run by the system's own Python.

It reads one world per line (JSON) from standard input, and writes one line of answers per world. An
answer is a list that begins with the kind of the result. Nothing of tftool is imported.
"""

import json
import sys

import genpy
import tf2_py
from geometry_msgs.msg import TransformStamped


def moment(nanoseconds):
    return genpy.Time(nanoseconds // 10**9, nanoseconds % 10**9)


def message(parent, child, stamp, pose):
    made = TransformStamped()
    made.header.stamp = moment(stamp)
    made.header.frame_id = parent
    made.child_frame_id = child
    place, turn = made.transform.translation, made.transform.rotation
    place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w = pose
    return made


def pose(found):
    place, turn = found.transform.translation, found.transform.rotation
    stamp = found.header.stamp
    return [
        stamp.secs * 10**9 + stamp.nsecs,
        [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w],
    ]


def ask(core, step):
    kind, words = step[0], step[1:]
    if kind == "lookup":
        target, source, time = words
        return pose(core.lookup_transform_core(target, source, moment(time)))
    if kind == "lookup_full":
        target, target_time, source, source_time, fixed = words
        return pose(
            core.lookup_transform_full_core(
                target, moment(target_time), source, moment(source_time), fixed
            )
        )
    if kind == "can":
        target, source, time = words
        return bool(core.can_transform_core(target, source, moment(time))[0])
    if kind == "can_full":
        target, target_time, source, source_time, fixed = words
        return bool(
            core.can_transform_full_core(
                target, moment(target_time), source, moment(source_time), fixed
            )[0]
        )
    if kind == "latest":
        found = core.get_latest_common_time(*words)
        return found.secs * 10**9 + found.nsecs
    if kind == "exists":
        return bool(core._frameExists(words[0]))
    return core._getFrameStrings()


def live(world):
    cache, steps = world
    core = tf2_py.BufferCore(genpy.Duration(cache // 10**9, cache % 10**9))
    answers = []
    for step in steps:
        if step[0] == "set":
            _, parent, child, stamp, numbers, static = step
            set_ = core.set_transform_static if static else core.set_transform
            set_(message(parent, child, stamp, numbers), "differential")
            continue
        try:
            answers.append(["is", ask(core, step)])
        except tf2_py.TransformException as refused:
            answers.append(["refused", type(refused).__name__])
    return answers


def main():
    for line in sys.stdin:
        sys.stdout.write(json.dumps(live(json.loads(line))) + "\n")


if __name__ == "__main__":
    main()
