"""tf2_geometry_msgs and tf2_sensor_msgs: messages moved into another frame.

The message that is passed is never changed, nor is the transform.
"""

import array
import math
import struct
from typing import Any

from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.interfaces.classes import INTERFACES, duplicate
from tftool.ros.tf.registry import ConvertRegistration, TransformRegistration


def _transform_of(stamped: Any) -> Transform:
    body = stamped.transform if hasattr(stamped, "transform") else stamped
    moved, turned = body.translation, body.rotation
    rotation = (turned.x, turned.y, turned.z, turned.w)
    length = math.sqrt(sum(part * part for part in rotation))
    if length * length < 2.2e-16:
        rotation, length = (0.0, 0.0, 0.0, 1.0), 1.0
    return Transform((moved.x, moved.y, moved.z), [part / length for part in rotation])


def _turned(transform: Transform, vector: Any) -> Vector3:
    return Transform((0.0, 0.0, 0.0), transform.rotation).apply((vector.x, vector.y, vector.z))


def _put(target: Any, value: Vector3) -> None:
    target.x, target.y, target.z = value


def _pose(transform: Transform, pose: Any) -> Any:
    result = duplicate(pose)
    here = Transform(
        (pose.position.x, pose.position.y, pose.position.z),
        (pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w),
    )
    moved = transform @ here
    _put(result.position, moved.translation)
    turned: Quaternion = moved.rotation
    # Like the original, which goes through a matrix: of the two signs, w is not negative.
    sign = -1.0 if turned.w < 0 else 1.0
    orientation = result.orientation
    orientation.x, orientation.y, orientation.z, orientation.w = (sign * part for part in turned)
    return result


def _headed(data: Any, transform: Any) -> Any:
    result = duplicate(data)
    if hasattr(transform, "header"):
        result.header = duplicate(transform.header)
    return result


def do_transform_point(point: Any, transform: Any) -> Any:
    """A PointStamped in the transform's frame."""
    result = _headed(point, transform)
    at = point.point
    _put(result.point, _transform_of(transform).apply((at.x, at.y, at.z)))
    return result


def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """A Vector3Stamped, turned and not moved."""
    result = _headed(vector3, transform)
    _put(result.vector, _turned(_transform_of(transform), vector3.vector))
    return result


def do_transform_pose(pose: Any, transform: Any) -> Any:
    """A Pose in the transform's frame."""
    return _pose(_transform_of(transform), pose)


def do_transform_pose_stamped(pose: Any, transform: Any) -> Any:
    """A PoseStamped in the transform's frame."""
    result = _headed(pose, transform)
    result.pose = _pose(_transform_of(transform), pose.pose)
    return result


def do_transform_pose_with_covariance_stamped(pose: Any, transform: Any) -> Any:
    """A PoseWithCovarianceStamped in the transform's frame."""
    result = _headed(pose, transform)
    moved = _transform_of(transform)
    result.pose.pose = _pose(moved, pose.pose.pose)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def transform_covariance(cov_in: Any, transform: Any) -> Any:
    """A 6×6 covariance, turned: D·C·Dᵀ with the rotation twice on D's diagonal."""
    import numpy as np

    matrix = np.array(_transform_of(transform).matrix())[:3, :3]
    turn = np.zeros((6, 6))
    turn[:3, :3] = turn[3:, 3:] = matrix
    return (turn @ np.asarray(cov_in, dtype=float).reshape(6, 6) @ turn.T).reshape(36)


def do_transform_polygon_stamped(polygon: Any, transform: Any) -> Any:
    """A PolygonStamped in the transform's frame."""
    result = _headed(polygon, transform)
    moved = _transform_of(transform)
    for point in result.polygon.points:
        _put(point, moved.apply((point.x, point.y, point.z)))
    return result


def do_transform_wrench(wrench: Any, transform: Any) -> Any:
    """A Wrench in the transform's frame: the torque gains the force's arm."""
    result = duplicate(wrench)
    moved = _transform_of(transform)
    force, torque = _turned(moved, wrench.force), _turned(moved, wrench.torque)
    arm = moved.translation
    _put(result.force, force)
    _put(
        result.torque,
        Vector3(
            torque.x + arm.y * force.z - arm.z * force.y,
            torque.y + arm.z * force.x - arm.x * force.z,
            torque.z + arm.x * force.y - arm.y * force.x,
        ),
    )
    return result


def do_transform_wrench_stamped(wrench: Any, transform: Any) -> Any:
    """A WrenchStamped in the transform's frame."""
    result = _headed(wrench, transform)
    result.wrench = do_transform_wrench(wrench.wrench, transform)
    return result


def do_transform_cloud(cloud: Any, transform: Any) -> Any:
    """A PointCloud2 in the transform's frame; other fields, layout and stamp stay.

    Raises:
        AssertionError: If it has no fields x, y and z.
    """
    places = {field.name: field for field in cloud.fields}
    if not {"x", "y", "z"} <= set(places):
        raise AssertionError("Point cloud needs the fields x, y, and z for the transformation")
    result = duplicate(cloud)
    if hasattr(transform, "header"):
        result.header.frame_id = transform.header.frame_id
    moved = _transform_of(transform)
    order = ">" if cloud.is_bigendian else "<"
    formats = [
        (struct.Struct(order + {7: "f", 8: "d"}[places[axis].datatype]), places[axis].offset)
        for axis in "xyz"
    ]
    data = bytearray(cloud.data.tobytes())
    for row in range(cloud.height):
        for column in range(cloud.width):
            start = row * cloud.row_step + column * cloud.point_step
            point = [one.unpack_from(data, start + offset)[0] for one, offset in formats]
            for (one, offset), value in zip(formats, moved.apply(point), strict=True):
                one.pack_into(data, start + offset, value)
    result.data = array.array("B", data)
    return result


def to_msg_msg(msg: Any) -> Any:
    """The message itself."""
    return msg


def from_msg_msg(msg: Any) -> Any:
    """The message itself."""
    return msg


def register() -> None:
    """Have buffers transform these types."""
    transforms, conversions = TransformRegistration(), ConvertRegistration()
    for name, function in (
        ("geometry_msgs/PointStamped", do_transform_point),
        ("geometry_msgs/Vector3Stamped", do_transform_vector3),
        ("geometry_msgs/Pose", do_transform_pose),
        ("geometry_msgs/PoseStamped", do_transform_pose_stamped),
        (
            "geometry_msgs/PoseWithCovarianceStamped",
            do_transform_pose_with_covariance_stamped,
        ),
        ("geometry_msgs/PolygonStamped", do_transform_polygon_stamped),
        ("geometry_msgs/Wrench", do_transform_wrench),
        ("geometry_msgs/WrenchStamped", do_transform_wrench_stamped),
        ("sensor_msgs/PointCloud2", do_transform_cloud),
    ):
        kind = INTERFACES.message(name)
        transforms.add(kind, function)
        conversions.add_from_msg(kind, from_msg_msg)
        conversions.add_to_msg(kind, to_msg_msg)


register()
