"""Tests of the start, the names and the end of nodes."""

import pytest


def test_a_node_needs_init_and_init_comes_once(ros_runtime):
    import rclpy
    from rclpy.exceptions import NotInitializedException

    with pytest.raises(NotInitializedException):
        rclpy.create_node("early")
    with rclpy.init():
        assert rclpy.ok()
        with pytest.raises(RuntimeError, match="once"):
            rclpy.init()
    assert not rclpy.ok()
    with pytest.raises(RuntimeError, match="initialized"):
        rclpy.shutdown()
    rclpy.try_shutdown()


def test_shutdown_in_a_callback_ends_spin_and_tells_who_asked(node):
    import rclpy

    told = []
    node.context.on_shutdown(lambda: told.append("over"))
    node.create_timer(1.0, rclpy.shutdown)
    rclpy.spin(node)

    assert told == ["over"]
    with pytest.raises(rclpy.executors.ExternalShutdownException):
        rclpy.spin_once(node)


def test_a_node_knows_its_names(ros_runtime):
    import rclpy

    rclpy.init()
    node = rclpy.create_node("probe", namespace="robot1")

    assert node.get_name() == "probe"
    assert node.get_namespace() == "/robot1"
    assert node.get_fully_qualified_name() == "/robot1/probe"
    assert node.resolve_topic_name("scan") == "/robot1/scan"
    assert node.resolve_topic_name("/scan") == "/scan"
    assert node.resolve_topic_name("~/scan") == "/robot1/probe/scan"
    assert node.resolve_topic_name("{ns}/{node}/scan") == "/robot1/robot1/probe/scan"


@pytest.mark.parametrize(
    ("use", "refusal", "told"),
    [
        (
            lambda rclpy, node: rclpy.create_node("2 fast"),
            "InvalidNodeNameException",
            "Invalid node name: it must not contain characters other than letters, digits and '_':"
            "\n  '2 fast'\n    ^",
        ),
        (
            lambda rclpy, node: rclpy.create_node("n", namespace="a//b"),
            "InvalidNamespaceException",
            "Invalid namespace: it must not contain '//':\n  '/a//b'\n      ^",
        ),
        (
            lambda rclpy, node: node.resolve_topic_name("a/2b"),
            "InvalidTopicNameException",
            "Invalid topic name: a part must not start with a number:\n  'a/2b'\n     ^",
        ),
        (
            lambda rclpy, node: node.resolve_service_name("a~"),
            "InvalidServiceNameException",
            "Invalid service name: '~' must be the first character, followed by '/':\n"
            "  'a~'\n    ^",
        ),
    ],
)
def test_an_invalid_name_is_refused_with_a_mark_below_the_wrong_character(node, use, refusal, told):
    import rclpy
    from rclpy import exceptions

    with pytest.raises(exceptions.NameValidationException) as refused:
        use(rclpy, node)

    assert type(refused.value) is getattr(exceptions, refusal)
    assert str(refused.value) == told


def test_a_destroyed_publisher_or_node_refuses_further_use(node):
    from rclpy.exceptions import InvalidHandle
    from std_msgs.msg import Int32

    sender = node.create_publisher(Int32, "numbers", 10)
    assert node.destroy_publisher(sender)
    assert not node.destroy_publisher(sender)
    with pytest.raises(InvalidHandle, match="publisher of '/numbers' is destroyed"):
        sender.publish(Int32())
    node.destroy_node()
    node.destroy_node()
    with pytest.raises(InvalidHandle, match="node 'probe' is destroyed"):
        node.create_timer(1.0, print)


def test_ros_args_rename_nodes_topics_and_set_parameters(ros_runtime):
    import rclpy

    rclpy.init()
    args = ["--ros-args", "-r", "__node:=other", "-r", "__ns:=/here", "-r", "chatter:=talk"]
    node = rclpy.create_node(
        "probe", cli_args=[*args, "-p", "speed:=2.5", "-p", "other:loud:=true"]
    )

    assert node.get_fully_qualified_name() == "/here/other"
    assert node.resolve_topic_name("chatter") == "/here/talk"
    assert node.declare_parameter("speed", 1.0).value == 2.5
    assert node.declare_parameter("loud", False).value is True


def test_two_nodes_of_one_name_are_told_apart_with_a_warning(node, ros_runtime):
    import rclpy

    rclpy.create_node("probe")

    assert any("a node named 'probe' exists already" in text for text in ros_runtime.log())
    before = ros_runtime.log()
    for _ in range(2):
        rclpy.create_node("_tool")
    assert ros_runtime.log() == before


def test_handles_of_a_destroyed_node_and_of_its_entities_are_invalid(node):
    from rclpy.exceptions import InvalidHandle
    from std_msgs.msg import String
    from std_srvs.srv import Trigger

    each = [
        node.create_publisher(String, "said", 1),
        node.create_subscription(String, "said", print, 1),
        node.create_client(Trigger, "asked"),
        node.create_service(Trigger, "asked", print),
        node.create_timer(1.0, print),
    ]
    for one in each:
        with one.handle:
            pass
        one.destroy()
        with pytest.raises(InvalidHandle, match="of 'probe' is destroyed"):
            one.handle.__enter__()
    with node.handle:
        assert node.get_name() == "probe"
    node.destroy_node()
    with pytest.raises(InvalidHandle, match="'probe' is destroyed"):
        node.handle.__enter__()


def test_a_node_of_another_process_of_the_same_name_is_warned_of(ros_runtime):
    import rclpy

    rclpy.init()
    ros_runtime.world.know_far_nodes(["space/talker", "other", "_ros2cli"])
    # Several hidden nodes, such as tools, may have the same name.
    for name, namespace in [("talker", "space"), ("talker", ""), ("_ros2cli", "")]:
        rclpy.create_node(name, namespace=namespace)

    (told,) = [text for text in ros_runtime.log() if "another process" in text]
    assert "has a node named 'space/talker'" in told
    assert "--ros-args -r __node:=" in told


def test_a_nodes_class_may_call_its_own_things_as_it_likes(node, ros_runtime):
    import rclpy
    from rclpy.node import Node

    class Robot(Node):
        def __init__(self):
            super().__init__("robot")
            self.world = self.program = self.graph = self.frames = self.node_state = "map"
            self.entities = self.authority = self.wake = self.late = self.forget = None
            self.declare_parameter("speed", 1.0)
            self.ticks = []
            self.create_timer(1.0, self._tick)

        def _tick(self):
            self.ticks.append(self.get_parameter("speed").value)

        def _keep(self):
            raise AssertionError("this is the user's own")

        _join = _destroy = _all = _known = _fault = _on_get = _keep

    robot = Robot()
    rclpy.spin_once(robot)
    robot.destroy_timer(next(robot.timers))
    robot.destroy_node()

    assert robot.ticks == [1.0]
    assert "robot" not in node.get_node_names()


def test_destroying_a_node_silences_it(node, ros_runtime):
    import rclpy
    from std_msgs.msg import Int32

    other = rclpy.create_node("sender")
    sender = other.create_publisher(Int32, "numbers", 10)
    with node:
        node.create_subscription(Int32, "numbers", print, 10)
        assert sender.get_subscription_count() == 1
    assert sender.get_subscription_count() == 0
    assert "probe" not in other.get_node_names()


def test_arguments_without_those_of_ros_can_be_had(ros_runtime):
    from rclpy.utilities import (
        get_rmw_implementation_identifier,
        remove_ros_args,
        timeout_sec_to_nsec,
    )

    assert remove_ros_args(["a", "--ros-args", "-r", "x:=y"]) == ["a"]
    assert timeout_sec_to_nsec(1.5) == 1_500_000_000
    assert timeout_sec_to_nsec(None) == -1
    assert get_rmw_implementation_identifier() == "tftool"


def test_a_context_of_ones_own_begins_and_ends(ros_runtime):
    import rclpy
    from rclpy.context import Context

    with Context() as context:
        assert context.ok()
        assert context.get_domain_id() == 0
        rclpy.create_node("inside", context=context)
    assert not context.ok()
    with rclpy.init(args=["x", "--ros-args", "-p", "n:=3"]):
        assert rclpy.create_node("a").declare_parameter("n", 1).value == 3


def test_a_node_that_forgets_its_beginning_is_told_so(node):
    from rclpy.node import Node

    class Early(Node):
        def __init__(self):
            self.create_timer(1.0, print)
            super().__init__("early")

    with pytest.raises(AttributeError, match=r"call super\(\).__init__\('its_name'\) before you"):
        Early()
    with pytest.raises(AttributeError, match=r"'Node' object has no attribute 'spead'$"):
        _ = node.spead
    assert not hasattr(node, "spead")
