"""Tests of the tutorial's own nodes against reference numbers, on simulated time."""

from pathlib import Path

import pytest
import yaml

from tests.ros.tutorial import TUTORIAL, start
from tftool.messages.turtle_messages import Twist, twist
from tftool.ros.testing import RosRuntime
from tftool.world.nodes.turtlesim import Turtlesim

VECTORS = yaml.safe_load(
    (Path(__file__).parent.parent / "reference" / "turtlesim_vectors.yaml").read_text()
)


def case(group, name):
    return next(one for one in VECTORS[group] if one["id"] == name)


def the_tutorial(runtime, *extra):
    """Start the simulator, two broadcasters, and further executables of the package."""

    def begin():
        world = runtime.world
        Turtlesim(world)
        for number in (1, 2):
            start(
                world,
                "turtle_tf_broadcaster",
                *("--ros-args", "-r", f"__node:=broadcaster{number}"),
                *("-p", f"turtlename:=turtle{number}"),
            )
        for words in extra:
            start(world, *words)

    runtime.ask(begin)


def commands(runtime, turtle="turtle2"):
    """Return a turtle's commands and its poses then: (t, x, y, theta, linear, angular)."""
    rows = []
    world = runtime.world

    def told(twist):
        place = world.node("turtlesim").turtles[turtle].place
        rows.append((runtime.elapsed(), *place, twist.linear.x, twist.angular.z))

    runtime.ask(lambda: world.topic(f"{turtle}/cmd_vel", Twist).subscribe(told))
    return rows


def test_two_runs_are_equal_to_the_last_bit():
    def once():
        with RosRuntime() as runtime:
            rows = commands(runtime)
            the_tutorial(runtime, ("turtle_following",), ("fixed_carrot",), ("point_sender",))
            runtime.sleep(20)
            return rows, runtime.world.buffer.all_frames_as_yaml(runtime.clock.now())

    assert once() == once()


def test_the_fixed_carrot_is_followed(ros_runtime):
    the_tutorial(
        ros_runtime,
        ("turtle_following", "--ros-args", "-p", "source_frame:=carrot1"),
        ("fixed_carrot",),
    )
    ros_runtime.sleep(20)

    x, y, _ = ros_runtime.world.node("turtlesim").turtles["turtle2"].place
    assert (x, y) == pytest.approx((5.5444, 7.5444), abs=0.01)


def test_the_dynamic_carrot_jumps_from_side_to_side_each_second(ros_runtime):
    the_tutorial(ros_runtime, ("dynamic_carrot",))
    sides = []
    for _ in range(4):
        ros_runtime.sleep(1)
        found = ros_runtime.world.buffer.lookup_transform("turtle1", "carrot1")
        sides.append(round(found.transform.translation.y, 6))

    assert sides == [-10.0, 10.0, -10.0, 10.0]


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (("a",), 1, "Usage: static_turtle child_frame_name x y z roll pitch yaw"),
        (
            ("world", "0", "0", "0", "0", "0", "0"),
            2,
            'Your static turtle name cannot be "world"',
        ),
    ],
)
def test_a_node_that_exits_has_its_own_exit_status(ros_runtime, words, status, told):
    ended = []
    ros_runtime.ask(lambda: start(ros_runtime.world, "static_turtle", *words, on_exit=ended.append))
    ros_runtime.sleep(1)

    assert ended[0].status == status
    assert ros_runtime.log("logger") == [told]


def test_a_message_filter_hands_points_on_once_their_frame_is_known(ros_runtime):
    the_tutorial(
        ros_runtime,
        ("point_sender",),
        ("point_listener", "--ros-args", "-p", "target_frame:=turtle1"),
    )
    ros_runtime.sleep(2.5)

    assert ros_runtime.log("point_listener") == ["Point in turtle1: x:0.000 y:0.000 z:0.000"] * 3


def test_a_parameter_callback_judges_what_is_set(ros_runtime):
    import rclpy
    from rcl_interfaces.srv import SetParameters
    from rclpy.parameter import Parameter

    the_tutorial(ros_runtime, ("tunable",))
    rclpy.init()
    node = rclpy.create_node("setter")
    client = node.create_client(SetParameters, "/tunable/set_parameters")
    client.wait_for_service()

    def ask(value):
        request = SetParameters.Request(
            parameters=[Parameter("speed", value=value).to_parameter_msg()]
        )
        result = client.call(request).results[0]
        return result.successful, result.reason

    assert ask(0.5) == (True, "")
    assert ask(5.0) == (False, "too fast")
    successful, reason = ask(1)
    assert not successful
    assert "is of type {DOUBLE}, setting it to {INTEGER} is not allowed: write 1.0" in reason
    ros_runtime.sleep(1)
    assert ros_runtime.world.topic("turtle1/cmd_vel", Twist).latest == twist(0.5)


def test_ctrl_c_reaches_every_node_and_destroys_it(tmp_path):
    file = tmp_path / "ends.py"
    file.write_text(
        """
import rclpy
from rclpy.node import Node

class Ends(Node):
    def destroy_node(self):
        self.get_logger().info('destroyed')
        super().destroy_node()

rclpy.init()
node = Ends('ends')
rclpy.spin(node)
"""
    )
    with RosRuntime() as runtime:
        program = runtime.start(file)
        runtime.sleep(1)

    assert program.status == 130
    assert runtime.log("ends") == ["destroyed"]


def test_blocking_code_in_one_node_hangs_no_other(ros_runtime, tmp_path):
    file = tmp_path / "sleeper.py"
    file.write_text(
        """
import time
import rclpy
rclpy.init()
node = rclpy.create_node('sleeper')
node.create_timer(1.0, lambda: time.sleep(5.0))
rclpy.spin(node)
"""
    )
    rows = commands(ros_runtime)
    the_tutorial(ros_runtime, ("turtle_following",))
    ros_runtime.start(file)
    ros_runtime.sleep(10)

    assert [row[0] for row in rows] == [3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]


def test_the_package_is_found_with_all_its_scripts():
    from tftool.ros.host.workspace import Workspace

    package = Workspace(TUTORIAL / "pkg_tf").package("pkg_tf")

    assert package.path == TUTORIAL
    assert package.scripts["turtle_following"] == "pkg_tf.turtle_following:main"
    assert len(package.scripts) == 11
