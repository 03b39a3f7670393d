"""Tests of users' nodes, each started by a separate `tftool run`, as in several terminals."""

import re
import sys
from pathlib import Path

import pytest

from tests.world.link.processes import Process

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="interrupts as POSIX does")

NODES = Path(__file__).parent / "nodes"


def node(name, *words):
    return Process("run", *words, NODES / f"{name}.py")


@pytest.mark.parametrize("order", [("talker", "listener"), ("listener", "talker")])
def test_a_talker_and_a_listener_in_two_terminals_find_each_other_in_any_order(order):
    first, second = order
    with node(first) as one:
        one.says("No session is running here")
        with node(second) as other:
            other.says("Joined the session of 'tftool run'")
            listener = one if first == "listener" else other
            listener.says("[listener]: I heard: Hello")
            assert other.interrupt() == 130
        assert one.interrupt() == 130
    assert "Traceback" not in one.text + other.text


def test_a_listener_that_comes_late_knows_statics_sent_before():
    with Process("static", "--z", "3", "--frame-id", "A", "--child-frame-id", "B") as static:
        static.says("Spinning")
        with node("listener") as listener:
            listener.says("B is 3.0 above A")


def test_services_parameters_actions_and_latched_topics_reach_another_terminal():
    with node("server") as server:
        server.says("No session is running here")
        with node("client") as client:
            assert client.end() == 0
            server.says("New subscription discovered on topic '/noise' (node 'client')")
    told = [line.partition("[client]: ")[2] for line in client.lines if "[INFO]" in line]
    assert told == [
        "parameters: ['speed', 'start_type_description_service', 'use_sim_time']",
        "set: True",
        "set: False",
        "changed: speed 4.5",
        "enabled: std_srvs.srv.SetBool_Response(success=True, message='speed 4.5')",
        "map: the attic",
        "fibonacci: 4 [0, 1, 1, 2, 3, 5]",
    ]
    warning = "New publisher discovered on topic '/noise' (node 'server'), offering incompatible"
    assert sum(warning in line for line in client.lines) == 1
    assert "the noise was heard" not in client.text
    assert "Traceback" not in server.text + client.text


BALLS = {
    "src/toys/package.xml": "<package><name>toys</name></package>",
    "src/toys/msg/Ball.msg": "string<=8 color\nfloat32[<=3] bounces\ngeometry_msgs/Point place\n",
    "thrower.py": """
import rclpy
from geometry_msgs.msg import Point
from toys.msg import Ball

rclpy.init()
node = rclpy.create_node("thrower")
balls = node.create_publisher(Ball, "balls", 10)
ball = Ball(color="red", bounces=[0.5, 0.25], place=Point(x=1.0))
node.create_timer(0.1, lambda: balls.publish(ball))
rclpy.spin(node)
""",
    "catcher.py": """
import rclpy
from toys.msg import Ball

rclpy.init()
node = rclpy.create_node("catcher")
node.create_subscription(Ball, "balls", lambda m: node.get_logger().info(f"caught {m}"), 10)
rclpy.spin(node)
""",
}


def test_messages_that_a_workspace_defines_itself_reach_another_terminal(tmp_path):
    for name, text in BALLS.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    with Process("run", "thrower.py", cwd=tmp_path) as thrower:
        thrower.says("No session is running here")
        with Process("run", "catcher.py", cwd=tmp_path) as catcher:
            catcher.says(
                "caught toys.msg.Ball(color='red', bounces=array('f', [0.5, 0.25]), "
                "place=geometry_msgs.msg.Point(x=1.0, y=0.0, z=0.0))"
            )


def test_run_and_launch_say_that_read_only_nodes_send_nothing_to_other_processes(tmp_path):
    launched = tmp_path / "talk.launch.py"
    launched.write_text(
        "from launch import LaunchDescription\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([])\n"
    )
    told = "--read-only: other processes receive no messages and no answers from the nodes here."
    with node("listener") as listener:
        listener.says("No session is running here")
        run = ["run", "--read-only", "--for", 1, NODES / "talker.py"]
        with Process(*run) as talker:
            talker.says(told)
            assert talker.end() == 0
        with Process("launch", "--read-only", launched) as launch:
            launch.says(told)
            assert launch.end() == 0
        assert "I heard" not in listener.text


WHEN = """
import rclpy

rclpy.init()
node = rclpy.create_node("when")

def tell():
    began = node.get_clock().now().nanoseconds
    if began:
        node.get_logger().info(f"time {began // 10**9}")
        rclpy.shutdown()

node.create_timer(0.1, tell)
try:
    rclpy.spin(node)
except rclpy.executors.ExternalShutdownException:
    pass
"""


@pytest.mark.parametrize("command", ["run", "launch"])
def test_beside_a_playback_only_nodes_with_use_sim_time_have_its_time(tmp_path, command):
    recording, file = tmp_path / "run.mcap", tmp_path / "when.py"
    file.write_text(WHEN)
    (tmp_path / "when.launch.py").write_text(
        "from launch import LaunchDescription\n"
        "from launch.substitutions import LaunchConfiguration\n"
        "from launch_ros.actions import Node\n"
        "def generate_launch_description():\n"
        "    given = {'use_sim_time': LaunchConfiguration('simulated', default='false')}\n"
        f"    return LaunchDescription([Node(executable={str(file)!r}, parameters=[given])])\n"
    )
    program, further = {
        "run": (file, ("--ros-args", "-p", "use_sim_time:=true")),
        "launch": (tmp_path / "when.launch.py", ("simulated:=true",)),
    }[command]
    with Process("export", "robot", "-o", recording) as export:
        assert export.end() == 0
    with Process("play", recording, "--paused") as play:
        with Process(command, program, *further) as told:
            assert told.end() == 0
        with Process(command, program) as untold:
            assert untold.end() == 0
        assert play.interrupt() == 130
    # The recording begins at 1000 s; the machine's time counts from 1970.
    assert "[when]: time 1000" in told.text
    assert re.search(r"\[when\]: time \d{10}", untold.text)
