"""tftool's answers for the comparison, with ROS 1's behaviour where ROS 2 changed it by design.

The differences are imitated in the one function that inserts samples:

- ROS 1 ignores a second value for the same child and stamp. The sample is inserted with a very
  old stamp instead: it is refused too, and the parent's name is known afterwards.
- In ROS 1, a child's first sample decides for ever whether the child is static.
- ROS 1 prunes old samples directly after an insert, not before the next one. Inserting the same
  sample once more prunes them, and adds nothing.

Quaternions have length one, as ROS 1 refuses others, and are compared up to their sign.
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
    """Return tftool's answers to the questions of a world."""
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
    """Return the name that an exception has in the Python binding, which has fewer classes."""
    if isinstance(refused, ExtrapolationException):
        return "ExtrapolationException"
    if step[0] == "latest" and (
        isinstance(refused, ConnectivityException)
        or (isinstance(refused, LookupException) and refused.looped)
    ):
        # The binding raises only the base class in this case.
        return "TransformException"
    return type(refused).__name__


def difference(theirs: Any, ours: Any) -> float:
    """Return the difference of two answers: relative for numbers, infinite for other results."""
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
