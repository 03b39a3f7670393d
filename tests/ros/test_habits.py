"""Tests of common code, and common mistakes, in ROS nodes."""

import pytest

from tests.ros.spinning import spin
from tftool.ros.testing import RosRuntime


def test_a_stamp_without_to_msg_is_refused_with_the_remedy(node):
    from geometry_msgs.msg import TransformStamped

    message = TransformStamped()
    with pytest.raises(
        AssertionError, match=r"not 'Time', which is rclpy's own: append \.to_msg\(\)"
    ):
        message.header.stamp = node.get_clock().now()


def test_a_parameter_as_a_message_is_refused_with_the_remedy(node):
    from rcl_interfaces.msg import ParameterEvent
    from rclpy.parameter import Parameter

    with pytest.raises(AssertionError, match=r"own: append \.to_parameter_msg\(\)"):
        ParameterEvent(changed_parameters=[Parameter("speed", value=1.0)])


def test_a_node_that_is_never_spun_is_told_of(ros_runtime, tmp_path):
    file = tmp_path / "still.py"
    file.write_text(
        "import rclpy\nfrom std_msgs.msg import String\nrclpy.init()\n"
        "node = rclpy.create_node('still')\n"
        "node.create_timer(1.0, lambda: None)\n"
        "node.create_subscription(String, 'chatter', print, 10)\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    assert program.status == 0
    assert ros_runtime.log(program.name) == [
        "node 'still' has ended without being spun, so none of its 2 callbacks was called: "
        "call rclpy.spin(node)"
    ]


def test_a_programs_own_handler_of_ctrl_c_is_called_at_the_end(tmp_path):
    file = tmp_path / "polite.py"
    file.write_text(
        "import rclpy, signal, sys\nrclpy.init()\nnode = rclpy.create_node('polite')\n"
        "def stop(number, frame):\n    node.get_logger().info(f'stop {number}')\n    sys.exit(0)\n"
        "first = signal.getsignal(signal.SIGINT)\nbefore = signal.signal(signal.SIGINT, stop)\n"
        "signal.signal(signal.SIGTERM, lambda *_: None)\n"
        "assert signal.getsignal(signal.SIGINT) is stop and before == first\n"
        "rclpy.spin(node)\n"
    )
    with RosRuntime() as runtime:
        program = runtime.start(file)
        runtime.sleep(1.0)
        assert program.status is None

    assert runtime.log("polite") == ["stop 2"]
    assert program.status == 0


def test_a_node_that_only_publishes_need_not_be_spun(ros_runtime, tmp_path):
    file = tmp_path / "once.py"
    file.write_text(
        "import rclpy\nfrom std_msgs.msg import String\nrclpy.init()\n"
        "node = rclpy.create_node('single')\n"
        "node.create_publisher(String, 'chatter', 10).publish(String(data='x'))\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    assert ros_runtime.log(program.name) == []


def test_a_call_that_takes_too_long_raises_timeout_error(node):
    from std_srvs.srv import Empty

    client = node.create_client(Empty, "nothing")
    with pytest.raises(TimeoutError, match=r"'/nothing' has not responded in 1\.5 s"):
        client.call(Empty.Request(), timeout_sec=1.5)


def test_publishers_and_timers_leave_with_their_block(node):
    from std_msgs.msg import String

    with node.create_publisher(String, "chatter", 10):
        assert node.count_publishers("chatter") == 1
    assert node.count_publishers("chatter") == 0
    with node.create_timer(0.1, None) as timer:
        spin(node, 0.25)
        assert timer.time_since_last_call() == 50_000_000
    assert list(node.timers) == []


def test_a_duration_and_a_time_add_either_way_round():
    from tftool.ros.rclpy.time import Duration, Time

    second, moment = Duration(seconds=1), Time(nanoseconds=5)
    assert second + moment == moment + second == Time(nanoseconds=1_000_000_005)


def test_values_keep_to_the_steps_of_their_range(node):
    from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
    from rclpy.parameter import Parameter

    whole = IntegerRange(from_value=1, to_value=10, step=3)
    node.declare_parameter("n", 4, ParameterDescriptor(integer_range=[whole]))
    part = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.1)
    node.declare_parameter("x", 0.3, ParameterDescriptor(floating_point_range=[part]))

    def accepted(name, value):
        return node.set_parameters([Parameter(name, value=value)])[0].successful

    assert [accepted("n", value) for value in (1, 7, 10, 5)] == [True, True, True, False]
    assert [accepted("x", value) for value in (0.7, 1.0, 0.75)] == [True, True, False]
    assert "not a valid step" in node.set_parameters([Parameter("n", value=5)])[0].reason


def test_a_parameter_set_to_nothing_is_undeclared(node):
    from rcl_interfaces.msg import ParameterDescriptor
    from rclpy.parameter import Parameter

    node.declare_parameter("a", 1, ParameterDescriptor(dynamic_typing=True))
    (result,) = node.set_parameters([Parameter("a", Parameter.Type.NOT_SET, None)])

    assert result.successful
    assert not node.has_parameter("a")


def test_callbacks_of_parameters_can_be_removed_and_undeclared_ones_described(ros_runtime):
    import rclpy
    from rclpy.parameter import Parameter

    rclpy.init()
    node, seen = rclpy.create_node("open", allow_undeclared_parameters=True), []

    def before(changes):
        seen.append("before")
        return changes

    def after(changes):
        seen.append("after")

    node.add_pre_set_parameters_callback(before)
    node.add_post_set_parameters_callback(after)
    node.set_parameters([Parameter("a", value=1)])
    node.remove_pre_set_parameters_callback(before)
    node.remove_post_set_parameters_callback(after)
    node.set_parameters([Parameter("a", value=2)])

    assert seen == ["before", "after"]
    assert node.describe_parameter("nothing").name == ""


def test_profiles_are_compared_and_hidden_names_told(ros_runtime):
    from rclpy.qos import (
        QoSCompatibility,
        QoSProfile,
        ReliabilityPolicy,
        qos_check_compatible,
        qos_profile_sensor_data,
    )
    from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

    reliable = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)

    assert qos_check_compatible(reliable, qos_profile_sensor_data) == (QoSCompatibility.OK, "")
    told, reason = qos_check_compatible(qos_profile_sensor_data, reliable)
    assert told is QoSCompatibility.ERROR
    assert reason == "ERROR: Best effort publisher and reliable subscription;"
    assert topic_or_service_is_hidden("/a/_b")
    assert not topic_or_service_is_hidden("/a/b")


def test_a_lookup_before_the_node_is_spun_is_explained_once(ros_runtime, tmp_path):
    file = tmp_path / "early.py"
    file.write_text(
        "import rclpy\nfrom rclpy.time import Time\n"
        "from tf2_ros import Buffer, LookupException, TransformListener\nrclpy.init()\n"
        "node = rclpy.create_node('early_node')\nbuffer = Buffer()\n"
        "TransformListener(buffer, node)\n"
        "for _ in range(2):\n"
        "    try:\n"
        "        buffer.lookup_transform('a', 'b', Time())\n"
        "    except LookupException:\n"
        "        pass\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    (line,) = ros_runtime.log(program.name)
    assert "nothing has arrived yet" in line
    assert "look up in a timer's callback" in line
