"""Tests of tf2_ros's lookups in another node's buffer."""

import pytest

SERVER = """
import rclpy
from rclpy.node import Node
from tf2_ros import Buffer, BufferServer, TransformListener
rclpy.init()
node = Node("keeper")
buffer = Buffer()
listener = TransformListener(buffer, node)
server = BufferServer(buffer, node, "tf_action")
rclpy.spin(node)
"""


@pytest.fixture
def client(node, ros_runtime, tmp_path):
    from tf2_ros import BufferClient

    file = tmp_path / "keeper.py"
    file.write_text(SERVER)
    ros_runtime.start(file)
    client = BufferClient(node, "tf_action", timeout_padding=1.0)
    assert client.action_client.wait_for_server(timeout_sec=5.0)
    return client


def broadcast(node, parent, child, x):
    from geometry_msgs.msg import TransformStamped
    from tf2_ros import StaticTransformBroadcaster

    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id = parent
    sent.transform.translation.x = x
    sent.transform.rotation.w = 1.0
    StaticTransformBroadcaster(node).sendTransform(sent)


def test_a_client_is_given_what_the_servers_buffer_holds(client, node):
    from geometry_msgs.msg import PointStamped
    from rclpy.time import Time
    from tf2_geometry_msgs import do_transform_point  # noqa: F401 -- registers points

    broadcast(node, "map", "base", 2.0)
    point = PointStamped()
    point.header.frame_id = "base"
    point.point.x = 1.0

    assert client.lookup_transform("map", "base", Time()).transform.translation.x == 2.0
    assert client.can_transform("map", "base", Time())
    full = client.lookup_transform_full("map", Time(), "base", Time(), "map")
    assert full.transform.translation.x == 2.0
    assert client.transform(point, "map").point.x == 3.0


def test_a_refusal_comes_back_as_the_exception_it_was(client, node):
    from rclpy.time import Time
    from tf2_ros import ConnectivityException, LookupException

    broadcast(node, "map", "base", 2.0)
    broadcast(node, "other", "tool", 2.0)

    with pytest.raises(LookupException, match="does not exist"):
        client.lookup_transform("map", "nowhere", Time())
    with pytest.raises(ConnectivityException):
        client.lookup_transform("map", "tool", Time())
    assert not client.can_transform("map", "tool", Time())


def test_the_server_waits_for_a_transform_as_long_as_it_is_asked_to(client, node, ros_runtime):
    from rclpy.duration import Duration
    from rclpy.time import Time
    from tf2_ros import LookupException

    before = ros_runtime.elapsed()
    with pytest.raises(LookupException):
        client.lookup_transform("map", "late", Time(), Duration(seconds=2.0))
    assert ros_runtime.elapsed() - before == pytest.approx(2.0, abs=0.01)

    node.create_timer(0.5, lambda: broadcast(node, "map", "late", 4.0))
    found = client.lookup_transform("map", "late", Time(), Duration(seconds=2.0))

    assert found.transform.translation.x == 4.0


def test_without_a_server_a_client_says_so(node):
    from rclpy.time import Time
    from tf2_ros import BufferClient, TimeoutException

    with pytest.raises(TimeoutException, match="not ready"):
        BufferClient(node, "elsewhere").lookup_transform("map", "base", Time())


def test_a_listener_fills_the_buffer_it_was_given_last(node, ros_runtime):
    from rclpy.time import Time
    from tf2_ros import Buffer, TransformListener

    first, second = Buffer(), Buffer()
    listener = TransformListener(first, node)
    listener.buffer = second

    broadcast(node, "map", "base", 2.0)

    assert second.can_transform("map", "base", Time())
    assert not first.can_transform("map", "base", Time())


def test_to_set_a_transform_gives_nothing_back_as_in_ros(node):
    from geometry_msgs.msg import TransformStamped
    from tf2_ros import Buffer

    sample = TransformStamped(child_frame_id="base")
    sample.header.frame_id = "map"
    sample.transform.rotation.w = 1.0

    assert Buffer().set_transform(sample, "test") is None
    assert Buffer().set_transform_static(sample, "test") is None
