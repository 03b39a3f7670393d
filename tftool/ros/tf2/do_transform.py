"""Functions of tf2_geometry_msgs and tf2_sensor_msgs that transform messages to another frame.

The functions return new messages. The formula for each kind of quantity is in
`tftool.geometry.quantities`.
"""

from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from tftool.geometry import quantities as carry
from tftool.geometry.rigid import Transform, Vector3, transform
from tftool.messages.classes import INTERFACES, duplicate
from tftool.ros.tf2.buffer import ConvertRegistration, TransformRegistration

Do = TypeVar("Do", bound=Callable[[Any, Any], Any])


def to_msg_msg(msg: Any) -> Any:
    """Return the given message, which needs no conversion."""
    return msg


from_msg_msg = to_msg_msg


def _registered(name: str) -> Callable[[Do], Do]:
    """Return a decorator that registers a function as the transformation of one message type.

    Buffers then use the function for messages of the type `name`.
    """
    kind = INTERFACES.message(name)

    def register(function: Do) -> Do:
        TransformRegistration().add(kind, function)
        conversions = ConvertRegistration()
        conversions.add_from_msg(kind, from_msg_msg)
        conversions.add_to_msg(kind, to_msg_msg)
        return function

    return register


def _transform_of(stamped: Any) -> Transform:
    body = stamped.transform if hasattr(stamped, "transform") else stamped
    return _placed(body.translation, body.rotation)


def _placed(place: Any, turn: Any) -> Transform:
    # The rotation is not checked here: a rotation of zeros means no rotation.
    return transform((place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w))


def _xyz(vector: Any) -> Vector3:
    return Vector3(vector.x, vector.y, vector.z)


def _put(target: Any, value: Iterable[float]) -> None:
    target.x, target.y, target.z = value


def _pose(a_from_b: Transform, pose: Any) -> Any:
    result = duplicate(pose)
    moved = carry.pose(a_from_b, _placed(pose.position, pose.orientation))
    _put(result.position, moved.translation)
    turn = result.orientation
    turn.x, turn.y, turn.z, turn.w = moved.rotation
    return result


def _headed(data: Any, transform: Any) -> Any:
    result = duplicate(data)
    if hasattr(transform, "header"):
        result.header = duplicate(transform.header)
    return result


@_registered("geometry_msgs/PointStamped")
def do_transform_point(point: Any, transform: Any) -> Any:
    """Transform a PointStamped message by a TransformStamped."""
    result = _headed(point, transform)
    _put(result.point, carry.point(_transform_of(transform), _xyz(point.point)))
    return result


@_registered("geometry_msgs/Vector3Stamped")
def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """Rotate a Vector3Stamped message by a TransformStamped, whose translation is ignored."""
    result = _headed(vector3, transform)
    _put(result.vector, carry.vector(_transform_of(transform), _xyz(vector3.vector)))
    return result


@_registered("geometry_msgs/Pose")
def do_transform_pose(pose: Any, transform: Any) -> Any:
    """Transform a Pose message by a TransformStamped."""
    return _pose(_transform_of(transform), pose)


@_registered("geometry_msgs/PoseStamped")
def do_transform_pose_stamped(pose: Any, transform: Any) -> Any:
    """Transform a PoseStamped message by a TransformStamped."""
    result = _headed(pose, transform)
    result.pose = _pose(_transform_of(transform), pose.pose)
    return result


@_registered("geometry_msgs/PoseWithCovarianceStamped")
def do_transform_pose_with_covariance_stamped(pose: Any, transform: Any) -> Any:
    """Transform the pose and the covariance in a PoseWithCovarianceStamped message."""
    result = _headed(pose, transform)
    result.pose.pose = _pose(_transform_of(transform), pose.pose.pose)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def transform_covariance(cov_in: Any, transform: Any) -> Any:
    """Rotate a 6×6 covariance C: return D·C·Dᵀ, where D is block-diagonal with two rotations."""
    import numpy as np

    return np.array(carry.covariance(_transform_of(transform), cov_in))


@_registered("geometry_msgs/PolygonStamped")
def do_transform_polygon_stamped(polygon: Any, transform: Any) -> Any:
    """Transform the points of a PolygonStamped message by a TransformStamped."""
    result = _headed(polygon, transform)
    a_from_b = _transform_of(transform)
    for point in result.polygon.points:
        _put(point, carry.point(a_from_b, _xyz(point)))
    return result


@_registered("geometry_msgs/Wrench")
def do_transform_wrench(wrench: Any, transform: Any) -> Any:
    """Transform a Wrench message; the torque includes the force times its lever arm."""
    result = duplicate(wrench)
    force, torque = carry.wrench(_transform_of(transform), _xyz(wrench.force), _xyz(wrench.torque))
    _put(result.force, force)
    _put(result.torque, torque)
    return result


@_registered("geometry_msgs/WrenchStamped")
def do_transform_wrench_stamped(wrench: Any, transform: Any) -> Any:
    """Transform a WrenchStamped message by a TransformStamped."""
    result = _headed(wrench, transform)
    result.wrench = do_transform_wrench(wrench.wrench, transform)
    return result


@_registered("sensor_msgs/PointCloud2")
def do_transform_cloud(cloud: Any, transform: Any) -> Any:
    """Transform the points of a PointCloud2 message; keep the layout and all other fields.

    Raises:
        AssertionError: If the cloud has no fields x, y and z.
    """
    from tftool.ros.tf2.point_clouds import transformed_data

    result = duplicate(cloud)
    result.data = transformed_data(cloud, _transform_of(transform))
    if hasattr(transform, "header"):
        result.header.frame_id = transform.header.frame_id
    return result


def transform_points(point_cloud: Any, transform: Any) -> Any:
    """Transform an array of points, shape (n, 3), by a Transform message."""
    import numpy as np

    points = np.asarray(point_cloud)
    return carry.points(_transform_of(transform), points.astype(np.float64)).astype(points.dtype)
