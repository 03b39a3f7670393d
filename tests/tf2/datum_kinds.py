"""Cases of kind `do_transform`: what becomes of points, poses and the rest."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tests.tf2.loader import Unknown, close, fields, negated
from tftool.frames.do_transform import Cloud, Point, Polygon, Stamped, do_transform
from tftool.frames.sample import TransformStamped
from tftool.geometry.carry import PoseWithCovariance, Wrench
from tftool.geometry.rigid import Quaternion, Transform, Vector3

Step = Mapping[str, Any]


def pose(given: Step) -> Transform:
    return Transform(given["xyz"], given["q"])


def corners(points: list[list[float]]) -> tuple[Vector3, ...]:
    return tuple(Vector3(*point) for point in points)


def flat(found: Any) -> list[float]:
    """All numbers of a datum, in order."""
    if isinstance(found, Cloud):
        return [float(number) for number in found.points.ravel()]
    if isinstance(found, Polygon):
        return [number for point in found.points for number in point]
    if isinstance(found, Transform | PoseWithCovariance | Wrench):
        return [number for part in found for number in flat(part)]
    return list(found)


BUILD: dict[str, Callable[[Step], Any]] = {
    "point": lambda given: Point(*given["xyz"]),
    "vector": lambda given: Vector3(*given["xyz"]),
    "pose": pose,
    "transform": pose,
    "pose_with_covariance": lambda given: PoseWithCovariance(pose(given), tuple(given["cov"])),
    "quaternion": lambda given: Quaternion(*given["q"]),
    "wrench": lambda given: Wrench(Vector3(*given["force"]), Vector3(*given["torque"])),
    "points": lambda given: Cloud(np.array(given["points"])),
    "polygon": lambda given: Polygon(corners(given["points"])),
}

HEADERS: dict[str, Any] = {
    "point_header": Point(0.0, 0.0, 0.0),
    "points_header": Cloud(np.zeros((1, 3))),
}


def run(case: Step) -> None:
    said = case["transform"]
    transform = TransformStamped(said["stamp"], said["parent"], said["child"], pose(said))
    for step in case["steps"]:
        if step["op"] not in BUILD and step["op"] not in HEADERS:
            raise Unknown(f"operation {step['op']}")
        fields(step, "input", "want", "up_to_sign")
        given, want = step["input"], step["want"]
        if step["op"] in HEADERS:
            moved = do_transform(
                Stamped(given["stamp"], given["frame"], HEADERS[step["op"]]), transform
            )
            assert (moved.frame_id, moved.stamp) == (want["frame"], want["stamp"])
            continue
        datum = BUILD[step["op"]](given)
        before = flat(datum)
        found = flat(do_transform(Stamped(0, said["child"], datum), transform).datum)
        wanted = flat(BUILD[step["op"]](want))
        assert close(found, wanted) or (step.get("up_to_sign") and close(found, negated(wanted))), (
            step
        )
        assert flat(datum) == before
