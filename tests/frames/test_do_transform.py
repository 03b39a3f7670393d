from dataclasses import dataclass

import numpy as np
import pytest

from tftool.errors import LookupException
from tftool.frames import do_transform as moving
from tftool.frames.buffer import Buffer
from tftool.frames.do_transform import Cloud, Point, Polygon, Stamped, TypeException
from tftool.frames.sample import TransformStamped
from tftool.geometry.carry import Twist
from tftool.geometry.rigid import Transform, Vector3
from tftool.stamps import seconds


@pytest.fixture
def buffer():
    buffer = Buffer()
    for at in (1, 2, 3):
        pose = Transform((float(at), 0.0, 0.0))
        buffer.set_transform(TransformStamped(seconds(at), "map", "robot", pose), "test")
    return buffer


def test_a_datum_is_taken_to_another_frame_at_its_own_moment(buffer):
    point = Stamped(seconds(1.5), "robot", Point(1.0, 2.0, 3.0))

    moved = moving.transform(buffer, point, "map")

    assert moved == Stamped(seconds(1.5), "map", Point(2.5, 2.0, 3.0))
    assert type(moved.datum) is Point
    assert moving.transform(buffer, Stamped(0, "robot", Point(0, 0, 0)), "map").stamp == seconds(3)


def test_a_datum_may_be_seen_from_another_moment(buffer):
    point = Stamped(seconds(1), "robot", Point(0.0, 0.0, 0.0))

    moved = moving.transform_full(buffer, point, "robot", seconds(3), "map")

    assert moved.datum == (-2.0, 0.0, 0.0)


def test_a_direction_is_not_moved(buffer):
    vector = Stamped(seconds(1), "robot", Vector3(1.0, 0.0, 0.0))

    assert moving.transform(buffer, vector, "map").datum == (1.0, 0.0, 0.0)


def test_a_cloud_keeps_its_stamp_and_whatever_else_it_holds(buffer):
    points = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    cloud = Stamped(0, "robot", Cloud(points, fields={"intensity": [1, 2]}))

    moved = moving.transform(buffer, cloud, "map")

    assert moved.stamp == 0
    assert moved.datum.points.tolist() == [[4.0, 0.0, 0.0], [3.0, 1.0, 0.0]]
    assert moved.datum.fields == {"intensity": [1, 2]}
    assert points[0, 0] == 1.0


def test_polygons_and_twists_move_too(buffer):
    polygon = Stamped(seconds(1), "robot", Polygon((Vector3(0.0, 0.0, 0.0),)))
    twist = Stamped(seconds(1), "robot", Twist(Vector3(0, 0, 0), Vector3(0, 0, 1)))

    assert moving.transform(buffer, polygon, "map").datum.points == ((1.0, 0.0, 0.0),)
    assert moving.transform(buffer, twist, "map").datum.linear == (0.0, -1.0, 0.0)


def test_refusals_are_the_lookups(buffer):
    with pytest.raises(LookupException):
        moving.transform(buffer, Stamped(0, "ghost", Point(0, 0, 0)), "map")


def test_an_unknown_type_is_refused_until_it_is_taught(buffer):
    @dataclass(frozen=True)
    class Landmark:
        name: str
        place: Vector3

    landmark = Stamped(seconds(2), "robot", Landmark("tree", Vector3(1.0, 0.0, 0.0)))
    with pytest.raises(TypeException, match=r"Type .*Landmark.* is not loaded or supported"):
        moving.transform(buffer, landmark, "map")

    moving.teach(
        Landmark, lambda move, seen: Landmark(seen.name, move.apply(seen.place)), keep_stamp=True
    )
    moved = moving.transform(buffer, landmark, "map")
    assert moved.datum == Landmark("tree", Vector3(3.0, 0.0, 0.0))
