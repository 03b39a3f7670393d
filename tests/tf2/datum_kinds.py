"""Vectors of kind `do_transform`: transformed points, poses and other data.

They use the modules that nodes import as tf2_geometry_msgs and tf2_sensor_msgs. These have no
function for a bare quaternion, which tftool's own product transforms instead.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tests.tf2.loader import Unknown, close, fields, negated
from tftool.geometry import quaternions
from tftool.messages.classes import INTERFACES
from tftool.ros.host import values
from tftool.ros.tf2 import do_transform as tf2

Step = Mapping[str, Any]


def geometry(name: str, **parts: Any) -> Any:
    return INTERFACES.message(f"geometry_msgs/{name}")(**parts)


def vector(numbers: Any, kind: str = "Vector3") -> Any:
    x, y, z = numbers
    return geometry(kind, x=x, y=y, z=z)


def quaternion(numbers: Any) -> Any:
    x, y, z, w = numbers
    return geometry("Quaternion", x=x, y=y, z=z, w=w)


def pose(given: Step) -> Any:
    return geometry(
        "Pose", position=vector(given["xyz"], "Point"), orientation=quaternion(given["q"])
    )


def cloud(points: Any) -> Any:
    field = INTERFACES.message("sensor_msgs/PointField")
    made = INTERFACES.message("sensor_msgs/PointCloud2")(
        height=1, width=len(points), point_step=24, row_step=24 * len(points)
    )
    made.fields = [
        field(name=name, offset=8 * index, datatype=8, count=1) for index, name in enumerate("xyz")
    ]
    made.data = np.array(points, dtype="<f8").tobytes()
    return made


def headed(message: Any, given: Step) -> Any:
    message.header.frame_id = given["frame"]
    message.header.stamp = values.time_message(given["stamp"])
    return message


def xyz(part: Any) -> list[float]:
    return [part.x, part.y, part.z]


def moved_point(given: Step, by: Any) -> list[float]:
    point = geometry("PointStamped", point=vector(given["xyz"], "Point"))
    return xyz(tf2.do_transform_point(point, by).point)


def moved_vector(given: Step, by: Any) -> list[float]:
    message = geometry("Vector3Stamped", vector=vector(given["xyz"]))
    return xyz(tf2.do_transform_vector3(message, by).vector)


def numbers_of(found: Any) -> list[float]:
    return [*xyz(found.position), *xyz(found.orientation), found.orientation.w]


def moved_pose(given: Step, by: Any) -> list[float]:
    found = tf2.do_transform_pose_stamped(geometry("PoseStamped", pose=pose(given)), by).pose
    assert tf2.do_transform_pose(pose(given), by) == found
    return numbers_of(found)


def moved_pose_with_covariance(given: Step, by: Any) -> list[float]:
    message = geometry("PoseWithCovarianceStamped")
    message.pose.pose = pose(given)
    message.pose.covariance = given["cov"]
    found = tf2.do_transform_pose_with_covariance_stamped(message, by).pose
    return [*numbers_of(found.pose), *found.covariance]


def moved_wrench(given: Step, by: Any) -> list[float]:
    wrench = geometry("Wrench", force=vector(given["force"]), torque=vector(given["torque"]))
    found = tf2.do_transform_wrench_stamped(geometry("WrenchStamped", wrench=wrench), by).wrench
    return [*xyz(found.force), *xyz(found.torque)]


def moved_polygon(given: Step, by: Any) -> list[float]:
    message = geometry("PolygonStamped")
    message.polygon.points = [vector(point, "Point32") for point in given["points"]]
    points = tf2.do_transform_polygon_stamped(message, by).polygon.points
    return [number for point in points for number in xyz(point)]


def moved_cloud(given: Step, by: Any) -> list[float]:
    data = tf2.do_transform_cloud(cloud(given["points"]), by).data.tobytes()
    return [float(number) for number in np.frombuffer(data, dtype="<f8")]


def moved_quaternion(given: Step, by: Any) -> list[float]:
    turn = values.pack_transform(by).transform.rotation
    return [*quaternions.multiply(turn, tuple(given["q"]))]


MOVE: dict[str, Callable[[Step, Any], list[float]]] = {
    "point": moved_point,
    "vector": moved_vector,
    "pose": moved_pose,
    "pose_with_covariance": moved_pose_with_covariance,
    "wrench": moved_wrench,
    "polygon": moved_polygon,
    "points": moved_cloud,
    # A pose with another name
    "transform": moved_pose,
    "quaternion": moved_quaternion,
}

HEADERS: dict[str, Callable[[Step, Any], Any]] = {
    "point_header": lambda given, by: tf2.do_transform_point(
        headed(geometry("PointStamped"), given), by
    ),
    "points_header": lambda given, by: tf2.do_transform_cloud(
        headed(cloud([[0.0, 0.0, 0.0]]), given), by
    ),
}

ORDER = ("xyz", "q", "cov", "force", "torque", "points")
"""Fields of a datum, in the order in which their numbers are compared."""


def flat(wanted: Step) -> list[float]:
    return [float(x) for key in ORDER if key in wanted for x in np.ravel(wanted[key])]


def run(case: Step) -> None:
    said = case["transform"]
    by = geometry(
        "TransformStamped",
        child_frame_id=said["child"],
        transform=geometry(
            "Transform", translation=vector(said["xyz"]), rotation=quaternion(said["q"])
        ),
    )
    headed(by, {"frame": said["parent"], "stamp": said["stamp"]})
    before = str(by)
    for step in case["steps"]:
        if step["op"] not in MOVE and step["op"] not in HEADERS:
            raise Unknown(f"operation {step['op']}")
        fields(step, "input", "want", "up_to_sign")
        given, want = step["input"], step["want"]
        if step["op"] in HEADERS:
            header = HEADERS[step["op"]](given, by).header
            assert (header.frame_id, values.stamp_of(header.stamp)) == (
                want["frame"],
                want["stamp"],
            )
            continue
        found, wanted = MOVE[step["op"]](given, by), flat(want)
        assert close(found, wanted) or (step.get("up_to_sign") and close(found, negated(wanted))), (
            step
        )
        assert str(by) == before
