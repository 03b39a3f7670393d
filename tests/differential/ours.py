"""Our side of the comparison, made to differ from ROS 1 nowhere but where it must not.

What ROS 1 does otherwise by design (ROS 2 changed it) is done here for our buffer, in the
one place where samples go in:

- a second value for the same child and stamp is ignored, not kept: it is sent as one
  from ages ago, which is refused as well and leaves the parent's name known as well;
- a child's first sample decides for good whether it is static;
- old samples go right after an insert and not before the next one: sending the very
  same sample again forgets them, and adds nothing.

Quaternions are unit ones, as ROS 1 refuses others, and compared up to sign.
"""

import math
from typing import Any

from tests.differential.worlds import World
from tftool.base.errors import (
    ConnectivityException,
    ExtrapolationException,
    LookupException,
    TransformException,
)
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry import rigid

AGES_AGO = -(10**18)


def live(world: World) -> list[list[Any]]:
    """Our answers, one for each question."""
    buffer = Buffer(world.cache, log=lambda level, text: None)
    stamps: dict[str, set[int]] = {}
    static_children: dict[str, bool] = {}
    answers: list[list[Any]] = []
    for step in world.steps:
        if step[0] == "set":
            _, parent, child, stamp, numbers, static = step
            name = child.removeprefix("/")
            static = static_children.get(name, static)
            if not static and stamp in stamps.get(name, ()):
                stamp = AGES_AGO
            sample = TransformStamped(
                stamp, parent, child, rigid.transform(tuple(numbers[:3]), tuple(numbers[3:]))
            )
            set_ = buffer.set_transform_static if static else buffer.set_transform
            if set_(sample, "differential"):
                static_children.setdefault(name, static)
                stamps.setdefault(name, set()).add(stamp)
                set_(sample, "differential")
            continue
        try:
            answers.append(["is", _ask(buffer, step)])
        except TransformException as refused:
            answers.append(["refused", _kind(step, refused)])
    return answers


def _ask(buffer: Buffer, step: list[Any]) -> Any:
    kind, words = step[0], step[1:]
    if kind in ("lookup", "lookup_full"):
        ask = buffer.lookup_transform if kind == "lookup" else buffer.lookup_transform_full
        found = ask(*words)
        return [found.stamp, [*found.transform.translation, *found.transform.rotation]]
    if kind == "can":
        return buffer.can_transform(*words)
    if kind == "can_full":
        return buffer.can_transform_full(*words)
    if kind == "latest":
        return buffer.get_latest_common_time(*words)
    if kind == "exists":
        return buffer.frame_exists(*words)
    return buffer.frames()


def _kind(step: list[Any], refused: TransformException) -> str:
    """The class by its name in the Python binding, which has fewer than C++."""
    if isinstance(refused, ExtrapolationException):
        return "ExtrapolationException"
    if step[0] == "latest" and (
        isinstance(refused, ConnectivityException)
        or (isinstance(refused, LookupException) and refused.looped)
    ):
        # There the binding knows the base class only.
        return "TransformException"
    return type(refused).__name__


def difference(theirs: Any, ours: Any) -> float:
    """How far apart two answers are: relative for numbers, infinite where they disagree."""
    if theirs[0] != ours[0]:
        return math.inf
    found, wanted = ours[1], theirs[1]
    if not (isinstance(wanted, list) and len(wanted) == 2 and isinstance(wanted[1], list)):
        return 0.0 if found == wanted else math.inf
    if found[0] != wanted[0]:
        return math.inf
    place = max(
        abs(one - other) / max(1.0, abs(other))
        for one, other in zip(found[1][:3], wanted[1][:3], strict=True)
    )
    turn = min(
        max(abs(one - sign * other) for one, other in zip(found[1][3:], wanted[1][3:], strict=True))
        for sign in (1.0, -1.0)
    )
    return max(place, turn)
