"""Tests of publishers and subscriptions."""

import pytest

from tests.ros.spinning import spin


def test_messages_arrive_in_order_as_copies_and_a_queue_keeps_the_newest(node):
    import rclpy
    from std_msgs.msg import Int32

    heard, short = [], []
    sender = node.create_publisher(Int32, "numbers", 10)
    node.create_subscription(Int32, "numbers", lambda m: heard.append(m.data), 10)
    node.create_subscription(Int32, "numbers", lambda m: short.append(m.data), 2)
    message = Int32()
    for number in range(5):
        message.data = number
        sender.publish(message)
    spin(node, 0.1)

    assert heard == [0, 1, 2, 3, 4]
    assert short == [3, 4]
    with pytest.raises(TypeError, match=r"Expected .*Int32"):
        sender.publish("5")
    assert rclpy.ok()


def test_a_late_subscriber_gets_what_is_kept_for_it(node):
    from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile
    from std_msgs.msg import String

    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    sender = node.create_publisher(String, "map", latched)
    sender.publish(String(data="old"))
    sender.publish(String(data="new"))
    late, plain = [], []
    node.create_subscription(String, "map", lambda m: late.append(m.data), latched)
    node.create_subscription(
        String, "map", lambda m: plain.append(m.data), QoSPresetProfiles.SENSOR_DATA.value
    )
    spin(node, 0.1)

    assert late == ["new"]
    assert plain == []
    node.destroy_publisher(sender)
    node.create_subscription(String, "map", lambda m: late.append(m.data), latched)
    spin(node, 0.1)
    assert late == ["new"]


def test_a_callback_may_ask_for_the_message_info(node):
    from std_msgs.msg import String

    heard = []
    node.create_subscription(String, "talk", lambda m, info: heard.append(info), 1)
    node.create_publisher(String, "talk", 1).publish(String())
    spin(node, 0.1)

    assert heard[0]["source_timestamp"] == 1000 * 10**9


def test_messages_can_be_had_and_sent_as_their_bytes(node):
    import rclpy
    from rclpy.serialization import deserialize_message, serialize_message
    from std_msgs.msg import Int32, String

    heard = []
    node.create_subscription(Int32, "numbers", heard.append, 10, raw=True)
    sender = node.create_publisher(Int32, "numbers", 10)
    # Plain CDR, little endian: a header of four bytes, and the number's four bytes.
    data = b"\x00\x01\x00\x00\x2a\x00\x00\x00"
    sender.publish(Int32(data=42))
    sender.publish(data)
    rclpy.spin_once(node)
    rclpy.spin_once(node)

    assert heard == [data, data]
    assert deserialize_message(data, Int32) == Int32(data=42)
    text = String(data="día")
    assert deserialize_message(serialize_message(text), String) == text
    with pytest.raises(TypeError, match="expected a message, got str"):
        serialize_message("text")
    with pytest.raises(Exception, match="std_msgs/msg/Int32"):
        sender.publish(b"\x00\x01")


def test_a_twist_keeps_the_parts_a_turtle_does_not_read(node):
    from geometry_msgs.msg import Twist

    heard = []
    node.create_subscription(Twist, "cmd_vel", heard.append, 1)
    sent = Twist()
    sent.linear.x, sent.linear.z, sent.angular.x = 1.0, 2.0, 3.0
    node.create_publisher(Twist, "cmd_vel", 1).publish(sent)
    spin(node, 0.1)

    assert heard == [sent]


def test_a_topic_carries_one_type(node):
    from geometry_msgs.msg import Twist
    from turtlesim.msg import Pose

    node.create_publisher(Twist, "turtle1/cmd_vel", 1)
    with pytest.raises(
        Exception, match="has the type geometry_msgs/msg/Twist, not turtlesim/msg/Pose"
    ):
        node.create_subscription(Pose, "turtle1/cmd_vel", print, 1)


@pytest.mark.parametrize(
    ("make", "error", "told"),
    [
        (lambda node: node.create_publisher(int, "a", 1), RuntimeError, "expected a message class"),
        (lambda node: node.create_timer(1.0, 3), TypeError, "a callback must be callable"),
        (lambda node: node.create_client(int, "a"), RuntimeError, "expected a service class"),
    ],
)
def test_a_wrong_type_or_callback_is_refused(node, make, error, told):
    with pytest.raises(error, match=told):
        make(node)


def test_points_travel_as_our_own_nodes_send_them(node, ros_runtime):
    from geometry_msgs.msg import PointStamped as RosPoint

    from tftool.messages.turtle_messages import PointStamped, point_stamped

    heard = []
    node.create_subscription(RosPoint, "points", heard.append, 1)
    ros_runtime.ask(
        lambda: ros_runtime.world.topic("points", PointStamped).publish(
            point_stamped(1_500_000_000, "world", 1.0, 2.0, 3.0)
        )
    )
    spin(node, 0.1)

    assert heard[0].header.stamp.nanosec == 500_000_000
    assert (heard[0].header.frame_id, heard[0].point.z) == ("world", 3.0)
