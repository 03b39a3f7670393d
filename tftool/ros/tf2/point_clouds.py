"""Functions of sensor_msgs_py.point_cloud2, which convert PointCloud2 messages and numpy arrays."""

import array
from collections import namedtuple
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.lib.recfunctions import structured_to_unstructured

from tftool.geometry import quantities
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES

DUMMY_FIELD_PREFIX = "unnamed_field"
"""Name of a field without a name, followed by its number."""

_KINDS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
"""numpy's type code for each datatype of a PointField."""


def _numbers_of_point(fields: Iterable[Any]) -> list[tuple[str, Any]]:
    """Return (name, (field, index in the field)) for each number of a point.

    A field `x` with a count of 3 has three numbers, named x_0, x_1 and x_2.
    """
    named = []
    for number, field in enumerate(fields):
        name = field.name or f"{DUMMY_FIELD_PREFIX}_{number}"
        several = field.count > 1
        named += [
            (f"{name}_{element}" if several else name, (field, element))
            for element in range(field.count)
        ]
    return named


def dtype_from_fields(
    fields: Iterable[Any], point_step: int | None = None, is_bigendian: bool = False
) -> "np.dtype[Any]":
    """Return the structured numpy dtype of one point.

    Args:
        fields: PointField messages.
        point_step: Bytes from one point to the next; None if the fields have no gaps.
        is_bigendian: Whether the numbers are big-endian.

    Raises:
        ValueError: If a field's datatype is unknown, or the fields are larger than a point.
    """
    fields = list(fields)
    if point_step is not None and sum(field.count for field in fields) > point_step:
        raise ValueError(
            f"the fields need more than the {point_step} bytes of a point: correct point_step or "
            "the offsets"
        )
    order = ">" if is_bigendian else "<"
    names, formats, offsets = [], [], []
    for name, (field, element) in _numbers_of_point(fields):
        kind = _KINDS.get(field.datatype)
        if kind is None:
            raise ValueError(f"field '{name}' has the unknown datatype {field.datatype}")
        form = np.dtype(order + kind)
        names.append(name)
        formats.append(form)
        offsets.append(field.offset + element * form.itemsize)
    layout: dict[str, Any] = {"names": names, "formats": formats, "offsets": offsets}
    if point_step is not None:
        layout["itemsize"] = point_step
    return np.dtype(layout)  # type: ignore[call-overload, no-any-return]


def points_array(cloud: Any, fields: Iterable[Any], data: bytes | bytearray) -> npt.NDArray[Any]:
    """Return some fields of a cloud's points as a structured array of shape (height, width)."""
    form = dtype_from_fields(fields, cloud.point_step, cloud.is_bigendian)
    steps = (cloud.row_step, cloud.point_step)
    return np.ndarray((cloud.height, cloud.width), form, data, 0, steps)


def transformed_data(cloud: Any, target_from_source: Transform) -> "array.array[int]":
    """Return the data of a cloud with its points transformed, and all other fields unchanged.

    Raises:
        AssertionError: If the cloud has no fields x, y and z.
    """
    fields = {field.name: field for field in cloud.fields}
    if not {"x", "y", "z"} <= set(fields):
        raise AssertionError("Point cloud needs the fields x, y, and z for the transformation")
    data = bytearray(cloud.data.tobytes())
    # A view of the coordinates in the data: writing to it changes the data.
    rows = points_array(cloud, [fields[axis] for axis in "xyz"], data)
    points = np.stack([rows[axis].ravel() for axis in "xyz"], axis=1)
    for axis, values in zip("xyz", quantities.points(target_from_source, points).T, strict=True):
        rows[axis] = values.reshape(rows.shape)
    return array.array("B", data)


def read_points(
    cloud: Any,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Any = None,
    reshape_organized_cloud: bool = False,
) -> npt.NDArray[Any]:
    """Return the points of a cloud as a structured array, one element per point.

    Args:
        cloud: PointCloud2 message.
        field_names: Names of the fields to read, in this order; None for all fields.
        skip_nans: Whether to leave out points that contain a NaN.
        uvs: Points to read: indices, or pairs (u, v) for an organized cloud; None for all points.
        reshape_organized_cloud: Whether to return the points of an organized cloud in rows.

    Raises:
        AssertionError: If the message is not a PointCloud2, lacks a field or has too little data.
    """
    kind: Any = INTERFACES.message("sensor_msgs/PointCloud2")
    if not isinstance(cloud, kind):
        raise AssertionError("Cloud is not a sensor_msgs.msg.PointCloud2")
    data = cloud.data.tobytes() if hasattr(cloud.data, "tobytes") else bytes(cloud.data)
    needed = (cloud.height - 1) * cloud.row_step + cloud.width * cloud.point_step
    if cloud.width and cloud.height and len(data) < needed:
        raise AssertionError(f"the cloud's data has {len(data)} bytes, but {needed} are needed")
    points: npt.NDArray[Any] = points_array(cloud, cloud.fields, data or bytes(1)).ravel()
    if field_names is not None:
        missing = [name for name in field_names if name not in (points.dtype.names or ())]
        if missing:
            raise AssertionError(f"the cloud has no field {', '.join(missing)}")
        points = points[list(field_names)]
    if skip_nans and len(points):
        bad = np.zeros(len(points), dtype=np.bool_)
        for name in points.dtype.names or ():
            if points[name].dtype.kind == "f":
                bad |= np.isnan(points[name])
        points = points[~bad]
    if uvs is not None:
        chosen = np.asarray(uvs if isinstance(uvs, np.ndarray) else list(uvs))
        if chosen.ndim == 2:
            chosen = chosen[:, 1] * cloud.width + chosen[:, 0]
        points = points[chosen]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.height, cloud.width)
    return points


def read_points_numpy(
    cloud: Any,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Any = None,
    reshape_organized_cloud: bool = False,
) -> npt.NDArray[Any]:
    """Return the points of a cloud as an unstructured array, one row per point.

    For the arguments see `read_points`.

    Raises:
        AssertionError: If the fields have different types, or for the reasons in `read_points`.
    """
    wanted = _numbers_of_point(cloud.fields)
    if field_names is not None:
        wanted = [pair for pair in wanted if pair[0] in field_names]
    if len({field.datatype for _, (field, _) in wanted}) > 1:
        raise AssertionError("All fields need to have the same datatype. Use `read_points()` then.")
    points = read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    return structured_to_unstructured(points)


def read_points_list(
    cloud: Any, field_names: Sequence[str] | None = None, skip_nans: bool = False, uvs: Any = None
) -> list[Any]:
    """Return the points of a cloud as named tuples; for the arguments see `read_points`."""
    points = read_points(cloud, field_names, skip_nans, uvs)
    kind = namedtuple("Point", points.dtype.names or ())  # type: ignore[misc]
    return [kind._make(point) for point in points.tolist()]


def create_cloud(
    header: Any, fields: Sequence[Any], points: Any, step: int | None = None, point_step: Any = None
) -> Any:
    """Return a PointCloud2 message with the given points.

    Args:
        header: Header of the message.
        fields: PointField messages.
        points: Tuples with a number for each field, or an array: structured, or with one row per
            point. An array of shape (height, width, fields), or a structured array of shape
            (height, width), makes an organized cloud.
        step: Bytes from one point to the next; None if the fields have no gaps.
        point_step: Another name for `step`.

    Raises:
        AssertionError: If a point does not have as many numbers as there are fields.
    """
    step = step if step is not None else point_step
    form = dtype_from_fields(fields, step)
    if isinstance(points, np.ndarray) and points.dtype.names is not None:
        made = points.astype(form)
    else:
        rows = np.asarray(points if isinstance(points, np.ndarray) else list(points))
        if rows.size == 0:
            rows = rows.reshape(0, len(form.names or ()))
        if rows.shape[-1] != len(form.names or ()):
            raise AssertionError(
                f"a point has {rows.shape[-1]} numbers, but the fields need {len(form.names or ())}"
            )
        made = np.zeros(rows.shape[:-1], form)
        for place, name in enumerate(form.names or ()):
            made[name] = rows[..., place]
    height, width = made.shape if made.ndim == 2 else (1, len(made))
    kind: Any = INTERFACES.message("sensor_msgs/PointCloud2")
    return kind(
        header=header,
        height=height,
        width=width,
        is_dense=False,
        is_bigendian=False,
        fields=list(fields),
        point_step=form.itemsize,
        row_step=form.itemsize * width,
        data=array.array("B", made.tobytes()),
    )


def create_cloud_xyz32(header: Any, points: Any, step: int | None = None) -> Any:
    """Return a PointCloud2 message with points (x, y, z) as 32-bit floats."""
    field: Any = INTERFACES.message("sensor_msgs/PointField")
    fields = [
        field(name=name, offset=4 * place, datatype=field.FLOAT32, count=1)
        for place, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points, step)
