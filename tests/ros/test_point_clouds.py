"""Tests of sensor_msgs_py: points to clouds and back."""

import math
import struct

import numpy as np
import pytest


@pytest.fixture
def header(node):
    from std_msgs.msg import Header

    return Header(frame_id="laser")


def test_a_cloud_of_three_floats_lies_in_memory_as_ros_lays_it_out(header):
    from sensor_msgs_py.point_cloud2 import create_cloud_xyz32

    cloud = create_cloud_xyz32(header, [(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)])

    assert cloud.data.tobytes() == struct.pack("<6f", 1, 2, 3, 4, 5, 6)
    assert (cloud.width, cloud.height, cloud.point_step, cloud.row_step) == (2, 1, 12, 24)
    assert [(field.name, field.offset) for field in cloud.fields] == [("x", 0), ("y", 4), ("z", 8)]
    assert cloud.header.frame_id == "laser"


def mixed(header, points):
    from sensor_msgs.msg import PointField
    from sensor_msgs_py import point_cloud2

    fields = [
        PointField(name="x", offset=0, datatype=PointField.FLOAT32, count=1),
        PointField(name="ring", offset=4, datatype=PointField.UINT16, count=1),
    ]
    return point_cloud2.create_cloud(header, fields, points, 8)


def test_fields_of_other_kinds_and_gaps_come_back_as_they_were_given(header):
    from sensor_msgs_py import point_cloud2

    cloud = mixed(header, [(1.5, 7), (math.nan, 8), (2.5, 9)])

    assert cloud.point_step == 8
    assert list(point_cloud2.read_points(cloud, ["ring"])["ring"]) == [7, 8, 9]
    kept = point_cloud2.read_points_list(cloud, skip_nans=True)
    assert [(point.x, point.ring) for point in kept] == [(1.5, 7), (2.5, 9)]
    assert list(point_cloud2.read_points(cloud, ["ring"], uvs=[2, 0])["ring"]) == [9, 7]


def test_a_plain_array_needs_fields_of_one_kind(header):
    from sensor_msgs_py import point_cloud2

    cloud = mixed(header, [(1.5, 7)])

    with pytest.raises(AssertionError, match="same datatype"):
        point_cloud2.read_points_numpy(cloud)
    assert point_cloud2.read_points_numpy(cloud, ["x"]).tolist() == [[1.5]]


def test_a_picture_of_points_keeps_its_rows(header):
    from sensor_msgs_py import point_cloud2

    points = np.arange(18, dtype=np.float32).reshape(2, 3, 3)
    cloud = point_cloud2.create_cloud_xyz32(header, points)

    assert (cloud.height, cloud.width) == (2, 3)
    found = point_cloud2.read_points(cloud, reshape_organized_cloud=True)
    assert found["y"].tolist() == points[..., 1].tolist()
    assert point_cloud2.read_points(cloud, ["x"], uvs=[(2, 1)])["x"].tolist() == [15.0]


def test_no_points_are_an_empty_cloud(header):
    from sensor_msgs_py import point_cloud2

    cloud = point_cloud2.create_cloud_xyz32(header, [])

    assert (cloud.width, len(cloud.data)) == (0, 0)
    assert len(point_cloud2.read_points(cloud)) == 0


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (lambda cloud: setattr(cloud, "data", cloud.data[:-1]), "are needed"),
        (lambda cloud: setattr(cloud.fields[0], "datatype", 99), "datatype 99"),
        (lambda cloud: setattr(cloud.fields[0], "count", 2**32 - 1), "need more than"),
        (lambda cloud: setattr(cloud, "point_step", 2), "need more than"),
    ],
)
def test_a_cloud_that_does_not_fit_itself_is_refused(header, spoil, told):
    from sensor_msgs_py import point_cloud2

    cloud = point_cloud2.create_cloud_xyz32(header, [(1.0, 2.0, 3.0)])
    spoil(cloud)

    with pytest.raises((AssertionError, ValueError), match=told):
        point_cloud2.read_points(cloud)


def test_points_are_moved_by_a_transform(node):
    from geometry_msgs.msg import Transform
    from tf2_sensor_msgs import transform_points

    half_turn = Transform()
    half_turn.translation.z = 100.0
    half_turn.rotation.x, half_turn.rotation.w = 1.0, 0.0

    moved = transform_points(np.array([[1, 2, 0], [10, 20, 30]], dtype=np.float32), half_turn)

    assert np.allclose(moved, [[1, -2, 100], [10, -20, 70]])
