"""Tests of odometry and poses that are read as transforms on request."""

import pytest

pytest.importorskip("rosbags", reason="writes the test files")

from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

from tests.recordings.writers import SECOND, Sent, numbers, write_rosbag1
from tftool import open_recording

STORE = get_typestore(Stores.ROS1_NOETIC)
TYPES = STORE.types


def header(stamp, frame):
    time = TYPES["builtin_interfaces/msg/Time"](stamp // SECOND, stamp % SECOND)
    return TYPES["std_msgs/msg/Header"](1, time, frame)


def pose(x):
    point = TYPES["geometry_msgs/msg/Point"](x, 0.0, 0.0)
    return TYPES["geometry_msgs/msg/Pose"](
        point, TYPES["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
    )


def odometry(stamp, x):
    import numpy as np

    zero = TYPES["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    twist = TYPES["geometry_msgs/msg/Twist"](zero, zero)
    none = np.zeros(36)
    return TYPES["nav_msgs/msg/Odometry"](
        header(stamp, "odom"),
        "base_link",
        TYPES["geometry_msgs/msg/PoseWithCovariance"](pose(x), none),
        TYPES["geometry_msgs/msg/TwistWithCovariance"](twist, none),
    )


@pytest.fixture
def bag(tmp_path):
    """Write a bag without transforms: odometry, and poses of a marker that a camera sees."""
    path = tmp_path / "run.bag"
    with Writer(path) as writer:
        for topic, kind in (
            ("/odom", "nav_msgs/msg/Odometry"),
            ("/vicon/marker", "geometry_msgs/msg/PoseStamped"),
        ):
            connection = writer.add_connection(topic, kind, typestore=STORE)
            for number in range(1, 5):
                stamp = (100 + number) * SECOND
                message = (
                    odometry(stamp, float(number))
                    if topic == "/odom"
                    else TYPES[kind](header(stamp, "map"), pose(-float(number)))
                )
                writer.write(connection, stamp, STORE.serialize_ros1(message, kind))
    return path


def test_they_count_only_where_that_is_asked_for(bag):
    with open_recording(bag) as recording:
        assert recording.edges == ()
    with open_recording(bag, with_odometry=True) as recording:
        found = {(edge.parent, edge.child): edge for edge in recording.edges}
        assert [topic.name for topic in recording.odometry] == ["/odom", "/vicon/marker"]
        at = recording.buffer.lookup_transform("odom", "base_link", 102 * SECOND + SECOND // 2)

    assert found.keys() == {("odom", "base_link"), ("map", "vicon/marker")}
    assert at.transform.translation == (2.5, 0.0, 0.0)


def test_frames_that_tf_has_are_left_to_it(tmp_path, bag):
    sent = [Sent(101 * SECOND, "/tf", ((101 * SECOND, "map", "vicon/marker", numbers(1)),))]
    other = write_rosbag1(tmp_path / "tf.bag", sent)
    with open_recording(str(tmp_path / "*.bag"), with_odometry=True) as recording:
        found = {edge.child: edge for edge in recording.edges}

    assert other.exists()
    assert len(found["vicon/marker"]) == 1
    assert len(found["base_link"]) == 4


def test_the_command_names_them_as_such(tftool, bag):
    without = tftool("info", bag)
    within = tftool("tree", bag, "--with-odometry")

    assert "No transform was recorded; --with-odometry uses these messages instead:" in without.err
    assert "'/odom' (nav_msgs/Odometry), '/vicon/marker' (geometry_msgs/PoseStamped)" in without.err
    assert "'/odom' (nav_msgs/Odometry, 4 messages) is used as transforms." in within.err
    assert "base_link" in within.out


def test_a_scenario_has_none(tftool):
    result = tftool("tree", "turtles", "--with-odometry")

    assert result.status == 2
    assert "leave out --with-odometry" in result.err


@pytest.mark.parametrize("command", ["plot", "export"])
def test_plot_and_export_answer_from_odometry_only_with_its_option(tftool, bag, tmp_path, command):
    to = ("-o", tmp_path / "path.csv") if command == "export" else ()
    asked = (command, "odom", "base_link", bag, *to, "--no-cache")
    assert tftool(*asked).status != 0
    assert tftool(*asked, "--with-odometry").status == 0


def test_a_scenario_that_is_plotted_has_no_odometry_to_take(tftool):
    result = tftool("plot", "turtle2", "turtle1", "turtles", "--with-odometry")
    assert result.status == 2
    assert "leave out --with-odometry" in result.err
