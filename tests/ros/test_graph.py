"""Tests of queries for other nodes, and of waits for single messages."""

import pytest

from tftool.world.endpoints import PUBLISHER, Endpoint, Quality
from tftool.world.nodes.turtle_drivers import KeyPress
from tftool.world.nodes.turtlesim import Turtlesim


def test_every_node_is_named_with_its_place(node, ros_runtime):
    import rclpy

    rclpy.create_node("arm", namespace="robot/left")
    ros_runtime.ask(lambda: Turtlesim(ros_runtime.world, "sim") and None)

    assert node.get_node_names() == ["probe", "arm", "sim"]
    assert node.get_fully_qualified_node_names()[:2] == ["/probe", "/robot/left/arm"]
    assert node.get_node_names_and_namespaces()[:2] == [("probe", "/"), ("arm", "/robot/left")]
    assert node.get_node_names_and_namespaces_with_enclaves()[1] == ("arm", "/robot/left", "/")
    assert node.wait_for_node("/robot/left/arm", 1.0)
    assert not node.wait_for_node("nobody", 1.0)


def test_topics_are_told_by_types_ends_and_numbers(node, ros_runtime):
    import rclpy
    from geometry_msgs.msg import Twist
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from rclpy.topic_endpoint_info import TopicEndpointTypeEnum
    from std_msgs.msg import String

    other = rclpy.create_node("other", namespace="robot")
    profile = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    other.create_publisher(String, "/chatter", profile)
    node.create_subscription(String, "chatter", print, 10)
    ros_runtime.ask(lambda: Turtlesim(ros_runtime.world, "sim") and None)
    ros_runtime.sleep(0.1)

    ros_runtime.world.topic("keys", KeyPress)
    topics = dict(node.get_topic_names_and_types())
    assert "/keys" not in topics
    assert topics["/chatter"] == ["std_msgs/msg/String"]
    assert topics["/turtle1/pose"] == ["turtlesim/msg/Pose"]
    assert topics["/turtle1/cmd_vel"] == [Twist.interface__]
    (sender,) = node.get_publishers_info_by_topic("chatter")
    assert (sender.node_name, sender.node_namespace) == ("other", "/robot")
    assert sender.topic_type == "std_msgs/msg/String"
    assert sender.endpoint_type is TopicEndpointTypeEnum.PUBLISHER
    assert sender.qos_profile.depth == 3
    (reader,) = node.get_subscriptions_info_by_topic("/chatter")
    assert reader.node_name == "probe"
    assert reader.endpoint_type is TopicEndpointTypeEnum.SUBSCRIPTION
    assert node.get_publishers_info_by_topic("silent") == []
    assert (node.count_publishers("chatter"), node.count_subscribers("chatter")) == (1, 1)
    # The simulator creates no publisher of rclpy, but sends.
    assert node.count_publishers("turtle1/pose") == 1
    assert node.count_subscribers("turtle1/cmd_vel") == 1
    assert node.count_publishers("silent") == node.count_subscribers("silent") == 0


def test_the_subscriptions_of_other_processes_are_counted_and_described(node, ros_runtime):
    from tftool.world.endpoints import SUBSCRIPTION, USUAL, Endpoint

    far = Endpoint(SUBSCRIPTION, "far", "chatter", "std_msgs/msg/String", USUAL, is_remote=True)
    ros_runtime.ask(lambda: ros_runtime.world.endpoints.add(far))

    assert node.count_subscribers("chatter") == 1
    (seen,) = node.get_subscriptions_info_by_topic("chatter")
    assert (seen.node_name, seen.node_namespace) == ("far", "/")


def test_publishers_subscriptions_services_and_clients_are_listed_by_node_name(node):
    import rclpy
    from rclpy.node import NodeNameNonExistentError
    from std_msgs.msg import String
    from std_srvs.srv import Trigger

    other = rclpy.create_node("other", namespace="robot", start_parameter_services=False)
    other.create_publisher(String, "said", 10)
    other.create_subscription(String, "/heard", print, 10)
    other.create_service(Trigger, "go", lambda request, response: response)
    other.create_client(Trigger, "/stop")

    ask = ("other", "/robot")
    string, trigger = ["std_msgs/msg/String"], ["std_srvs/srv/Trigger"]
    assert node.get_publisher_names_and_types_by_node(*ask) == [
        ("/parameter_events", ["rcl_interfaces/msg/ParameterEvent"]),
        ("/robot/said", string),
        ("/rosout", ["rcl_interfaces/msg/Log"]),
    ]
    assert node.get_subscriber_names_and_types_by_node(*ask) == [("/heard", string)]
    assert node.get_service_names_and_types_by_node(*ask) == [("/robot/go", trigger)]
    assert node.get_client_names_and_types_by_node(*ask) == [("/stop", trigger)]
    # In ROS a client is enough for a service to be listed.
    listed = node.get_service_names_and_types()
    assert ("/robot/go", trigger) in listed
    assert ("/stop", trigger) in listed
    assert (node.count_services("/robot/go"), node.count_services("/stop")) == (1, 0)
    assert (node.count_clients("/robot/go"), node.count_clients("/stop")) == (0, 1)
    with pytest.raises(NodeNameNonExistentError, match="/robot/nobody"):
        node.get_publisher_names_and_types_by_node("nobody", "/robot")


def test_one_message_can_be_waited_for(node, ros_runtime):
    import rclpy
    from rclpy.wait_for_message import wait_for_message
    from std_msgs.msg import Int32

    other = rclpy.create_node("other")
    sender = other.create_publisher(Int32, "numbers", 10)
    other.create_timer(1.5, lambda: sender.publish(Int32(data=4)))
    rclpy.get_global_executor().add_node(other)

    assert wait_for_message(Int32, node, "numbers", time_to_wait=1.0) == (False, None)
    assert wait_for_message(Int32, node, "numbers", time_to_wait=1.0) == (True, Int32(data=4))
    assert ros_runtime.elapsed() == 1.5
    assert list(node.subscriptions) == []


def test_one_message_can_be_waited_for_inside_a_callback(node):
    import rclpy
    from rclpy.wait_for_message import wait_for_message
    from std_msgs.msg import Int32

    found = []
    sender = node.create_publisher(Int32, "numbers", 10)
    beside = rclpy.callback_groups.ReentrantCallbackGroup()
    node.create_timer(0.5, lambda: sender.publish(Int32(data=7)), callback_group=beside)
    node.create_timer(1.2, lambda: found.append(wait_for_message(Int32, node, "numbers")))
    while not found:
        rclpy.spin_once(node)

    assert found == [(True, Int32(data=7))]


def test_the_graph_can_be_asked(node):
    from std_msgs.msg import Int32

    node.create_publisher(Int32, "numbers", 1)
    node.create_subscription(Int32, "numbers", print, 1)

    assert ("/numbers", ["std_msgs/msg/Int32"]) in node.get_topic_names_and_types()
    assert ("/tf", ["tf2_msgs/msg/TFMessage"]) in node.get_topic_names_and_types()
    assert node.count_publishers("numbers") == node.count_subscribers("numbers") == 1
    assert node.count_subscribers("nothing") == 0
    assert "/probe/set_parameters" in dict(node.get_service_names_and_types())
    assert [one.topic_name for one in node.publishers] == [
        "/parameter_events",
        "/numbers",
    ]
    assert node.count_publishers("/rosout") == 1
    assert [one.topic_name for one in node.subscriptions] == ["/numbers"]
    assert list(node.clients) == []
    assert len(list(node.services)) == 6
    assert node.wait_for_node("/probe", 1.0)
    assert not node.wait_for_node("/nobody", 0.5)


def test_an_endpoint_of_another_process_is_listed_with_its_gid(node, ros_runtime):
    gid = bytes(range(16))
    far = Endpoint(
        PUBLISHER, "far", "words", "std_msgs/msg/String", Quality(), is_remote=True, gid=gid
    )
    ros_runtime.ask(lambda: ros_runtime.world.endpoints.add(far) and None)

    (told,) = node.get_publishers_info_by_topic("/words")

    assert told.endpoint_gid == list(gid)
    assert "GID: 00.01.02.03.04.05.06.07.08.09.0a.0b.0c.0d.0e.0f\n" in str(told)


def test_a_destroyed_node_offers_no_services(ros_runtime):
    import rclpy

    rclpy.init()
    gone, stays = rclpy.create_node("gone"), rclpy.create_node("stays")
    gone.destroy_node()

    owners = {name.rpartition("/")[0] for name, _ in stays.get_service_names_and_types()}
    assert owners == {"/stays"}


def test_hundreds_of_nodes_offer_their_services(ros_runtime):
    import rclpy

    rclpy.init()
    nodes = [rclpy.create_node(f"node_{number}") for number in range(600)]

    names = dict(nodes[0].get_service_names_and_types())
    assert all(f"/node_{number}/get_parameters" in names for number in range(600))
