"""Tests of `ros2` commands in launch files and on the command line."""

import re

import pytest

from tests.ros.test_launch import described
from tftool.base.errors import NodeFailed, UsageError
from tftool.ros.host import rosidl_runtime
from tftool.ros.host.workspace import Workspace
from tftool.ros.ros2 import ros2_program
from tftool.world.nodes.turtlesim import Turtlesim

SIM = "Node(package='turtlesim', executable='turtlesim_node', name='sim')"


def ran(ros_runtime, tmp_path, *words, seconds=5.0):
    """Run a command beside the simulator; return its status and lines."""
    from tftool.ros.host.program import Program

    lines, ended = [], []
    if not any(isinstance(node, Turtlesim) for node in ros_runtime.world.nodes):
        ros_runtime.ask(lambda: Turtlesim(ros_runtime.world))
    body = ros2_program.body(words, Workspace(tmp_path), lines.append)
    (program,) = ros_runtime.ask(
        lambda: [Program(ros_runtime.world, "ros2", body, on_exit=ended.append)]
    )
    ros_runtime.sleep(seconds)
    ros_runtime.ask(lambda: ros_runtime.world.remove(program))
    if not ended:
        return None, lines
    failed = isinstance(ended[0].failure, UsageError)
    return ended[0].failure if failed else ended[0].status, lines


def test_the_tutorials_event_handlers_spawn_and_set_by_ros2(tmp_path):
    done = described(
        tmp_path,
        SIM,
        "ExecuteProcess(cmd=[[FindExecutable(name='ros2'), ' service call ', '/spawn ', "
        "'turtlesim/srv/Spawn ', '\"{x: 2, y: 3, theta: 0.2}\"']], shell=True)",
        "ExecuteProcess(cmd=['ros2', 'param', 'set', 'sim', 'background_r', '120'])",
        "RegisterEventHandler(OnProcessExit(on_exit=LogInfo(msg='one has ended')))",
        seconds=5.0,
    )

    assert done.places["turtle2"][:2] == (2.0, 3.0)
    assert done.failed == []
    assert "response:" in done.said("ros2-2")
    assert "turtlesim.srv.Spawn_Response(name='turtle2')" in done.said("ros2-2")
    assert "Set parameter successful" in done.said("ros2-3")
    assert done.said("launch").count("one has ended") >= 2


def test_ros2_run_in_a_launch_file_starts_a_node(tmp_path):
    done = described(
        tmp_path,
        "ExecuteProcess(cmd=['ros2', 'run', 'turtlesim', 'turtlesim_node', '--ros-args', '-r', "
        "'__node:=mine'])",
    )

    assert "mine" in done.nodes


OTHER_LAUNCH = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

def generate_launch_description():
    name = LaunchConfiguration("called")
    return LaunchDescription([
        DeclareLaunchArgument("called"),
        Node(package="turtlesim", executable="turtlesim_node", name=name),
    ])
"""


def test_ros2_launch_in_a_launch_file_runs_the_other_file_with_its_arguments(tmp_path):
    other = tmp_path / "other.launch.py"
    other.write_text(OTHER_LAUNCH)
    done = described(
        tmp_path, f"ExecuteProcess(cmd=['ros2', 'launch', {str(other)!r}, 'called:=inner'])"
    )

    assert "inner" in done.nodes
    assert done.failed == []


def test_a_handler_sees_that_ros2_launch_in_a_launch_file_has_ended(tmp_path, capfd):
    other = tmp_path / "other.launch.py"
    other.write_text(
        "from launch import LaunchDescription\nfrom launch.actions import LogInfo\n"
        "def generate_launch_description():\n    return LaunchDescription([LogInfo(msg='hi')])\n"
    )
    done = described(
        tmp_path,
        "RegisterEventHandler(OnProcessExit(on_exit=LogInfo(msg='one has ended')))",
        f"ExecuteProcess(cmd=['ros2', 'launch', {str(other)!r}])",
    )

    assert "one has ended" in done.said("launch")
    assert "[INFO] [launch]: hi" in capfd.readouterr().err


def test_a_wrong_command_in_a_launch_file_is_named_with_its_line(tmp_path):
    with pytest.raises(NodeFailed, match=r"some\.launch\.py:\d+: ros2 service: .*invalid choice"):
        described(tmp_path, "ExecuteProcess(cmd=['ros2', 'service', 'cal', '/spawn'])")


def test_lists_name_what_is_there_and_hide_what_is_hidden(ros_runtime, tmp_path):
    _, topics = ran(ros_runtime, tmp_path, "topic", "list", "-t")
    _, services = ran(ros_runtime, tmp_path, "service", "list")
    _, nodes = ran(ros_runtime, tmp_path, "node", "list")
    _, actions = ran(ros_runtime, tmp_path, "action", "list", "-t")

    assert "/turtle1/cmd_vel [geometry_msgs/msg/Twist]" in topics
    assert "/spawn" in services
    assert nodes == ["/turtlesim"]
    assert actions == ["/turtle1/rotate_absolute [turtlesim/action/RotateAbsolute]"]


def test_a_topic_is_echoed_as_yaml(ros_runtime, tmp_path):
    status, lines = ran(ros_runtime, tmp_path, "topic", "echo", "--once", "/turtle1/pose")

    assert status == 0
    assert lines[0].startswith("x: 5.544")
    assert lines[-2:] == ["angular_velocity: 0.0", "---"]


def test_a_rate_is_measured(ros_runtime, tmp_path):
    _, lines = ran(ros_runtime, tmp_path, "topic", "hz", "/turtle1/pose", seconds=3.5)

    assert lines[0] == "average rate: 62.500"


def test_a_twist_is_published_until_the_turtle_has_moved(ros_runtime, tmp_path):
    status, lines = ran(
        ros_runtime, tmp_path, "topic", "pub", "--once", "/turtle1/cmd_vel",
        "geometry_msgs/msg/Twist", "{linear: {x: 2, y: 0.0}}",
    )  # fmt: skip
    simulator = next(n for n in ros_runtime.world.nodes if isinstance(n, Turtlesim))

    assert status == 0
    assert lines[0] == "publisher: beginning loop"
    assert lines[1].startswith("publishing #1: geometry_msgs.msg.Twist(linear=")
    assert simulator.turtles["turtle1"].place[0] > 7.0
    assert not any("without being spun" in text for text in ros_runtime.log())


def test_parameters_are_listed_read_set_and_dumped(ros_runtime, tmp_path):
    assert ran(ros_runtime, tmp_path, "param", "set", "/turtlesim", "background_g", "7")[0] == 0
    assert ran(ros_runtime, tmp_path, "param", "get", "/turtlesim", "background_g") == (
        0,
        ["Integer value is: 7"],
    )
    assert "  background_g" in ran(ros_runtime, tmp_path, "param", "list", "/turtlesim")[1]
    dumped = ran(ros_runtime, tmp_path, "param", "dump", "turtlesim")[1]
    assert dumped[:2] == ["/turtlesim:", "  ros__parameters:"]
    assert "    background_g: 7" in dumped
    assert ran(ros_runtime, tmp_path, "param", "get", "/turtlesim", "none") == (
        1,
        ["Parameter not set"],
    )


def test_an_action_is_sent_and_its_result_shown(ros_runtime, tmp_path):
    status, lines = ran(
        ros_runtime, tmp_path, "action", "send_goal", "/turtle1/rotate_absolute",
        "turtlesim/action/RotateAbsolute", "{theta: 1.0}", seconds=20.0,
    )  # fmt: skip

    assert status == 0
    assert re.fullmatch(r"Goal accepted with ID: [0-9a-f]{32}", lines[2])
    assert lines[-1] == "Goal finished with status: SUCCEEDED"
    assert any(line.strip().startswith("delta: ") for line in lines)


def test_the_feedback_of_an_action_is_echoed(ros_runtime, tmp_path):
    server = tmp_path / "server.py"
    server.write_text(
        "import rclpy\nfrom example_interfaces.action import Fibonacci\n"
        "from rclpy.action import ActionClient, ActionServer\n"
        "rclpy.init()\nnode = rclpy.create_node('counts')\n"
        "def execute(handle):\n"
        "    handle.publish_feedback(Fibonacci.Feedback(sequence=[4, 2]))\n"
        "    handle.succeed()\n    return Fibonacci.Result()\n"
        "server = ActionServer(node, Fibonacci, 'count', execute)\n"
        "client = ActionClient(node, Fibonacci, 'count')\n"
        "node.create_timer(0.5, lambda: client.send_goal_async(Fibonacci.Goal()))\n"
        "rclpy.spin(node)\n"
    )
    ros_runtime.start(server)
    ros_runtime.sleep(0.1)
    status, lines = ran(ros_runtime, tmp_path, "topic", "echo", "--once", "/count/_action/feedback")

    assert status == 0
    assert [line.strip() for line in lines][-4:] == ["sequence:", "- 4", "- 2", "---"]


def test_interfaces_and_packages_are_shown(ros_runtime, tmp_path):
    assert ran(ros_runtime, tmp_path, "interface", "show", "geometry_msgs/msg/Vector3")[1][-3:] == [
        "float64 x",
        "float64 y",
        "float64 z",
    ]
    assert "turtlesim" in ran(ros_runtime, tmp_path, "pkg", "list")[1]


def test_topics_are_found_by_their_type(ros_runtime, tmp_path):
    assert ran(ros_runtime, tmp_path, "topic", "find", "turtlesim/msg/Pose") == (
        0,
        ["/turtle1/pose"],
    )


def test_the_bandwidth_of_a_topic_is_measured(ros_runtime, tmp_path):
    _, lines = ran(ros_runtime, tmp_path, "topic", "bw", "/turtle1/pose", seconds=2.5)

    # A pose has five floats after CDR's header of four bytes, 62.5 times a second.
    assert re.fullmatch(r"1\.5\d KB/s from 6\d messages", lines[0])
    assert lines[1] == "\tMessage size mean: 24 B min: 24 B max: 24 B"


def test_the_delay_of_a_topic_without_header_is_refused(ros_runtime, tmp_path):
    failure, _ = ran(ros_runtime, tmp_path, "topic", "delay", "/turtle1/pose", seconds=2.5)

    assert "Pose has no header" in str(failure)


def test_one_field_of_a_topic_is_echoed(ros_runtime, tmp_path):
    echo = ("topic", "echo", "--once", "/turtle1/pose", "--field")
    assert ran(ros_runtime, tmp_path, *echo, "angular_velocity") == (0, ["0.0", "---"])

    failure, _ = ran(ros_runtime, tmp_path, *echo, "thet")
    assert "Pose has no field 'thet'; did you mean 'theta'?" in str(failure)


def test_messages_are_echoed_in_part(ros_runtime, tmp_path):
    from tftool.ros.host.program import Program

    said = "{name: [long, ä], position: [1, 2, 3, 4]}"
    words = ["topic", "pub", "/joints", "sensor_msgs/msg/JointState", said, "-r", "10"]
    body = ros2_program.body(words, Workspace(tmp_path), lambda line: None)
    ros_runtime.ask(lambda: [Program(ros_runtime.world, "pub", body, on_exit=lambda _: None)])
    ros_runtime.sleep(0.5)

    def echo(*options):
        return ran(ros_runtime, tmp_path, "topic", "echo", "/joints", "--once", *options)[1]

    assert echo("--csv") == ["0,0,,long,ä,1.0,2.0,3.0,4.0"]
    assert echo("--field", "position", "-l", "2", "--flow-style") == ["[1.0, 2.0, '...']", "---"]
    assert echo("--no-arr")[-4:-2] == [
        "position: '<sequence type: double, length: 4>'",
        "velocity: '<sequence type: double, length: 0>'",
    ]
    assert echo("--no-str")[5:7] == ["name:", "- '<string length: <4>>'"]
    assert echo("--truncate-length", "3", "--field", "name")[0] == "- lon..."
    assert echo("--filter", "m.position[3] == 4", "--field", "name") == ["- long", "- ä", "---"]
    fails = ("topic", "echo", "/joints", "--filter", "m.pos")
    assert "the expression of --filter fails" in str(ran(ros_runtime, tmp_path, *fails)[0])
    with pytest.raises(
        UsageError, match=r"'m' is not a Python expression|'m is' is not a Python expression"
    ):
        ros2_program.body(
            ["topic", "echo", "/joints", "--filter", "m is"], Workspace(tmp_path), print
        )


def test_a_message_of_many_elements_is_cut_as_in_ros_unless_whole(ros_runtime, tmp_path):
    from tftool.ros.host.rosidl_runtime import plain

    assert plain(list(range(5)), truncate_length=3) == [0, 1, 2, "..."]
    assert plain("abcde", truncate_length=5) == "abcde"
    assert plain("abcde") == "abcde"


def test_lists_are_counted_and_described(ros_runtime, tmp_path):
    _, lines = ran(ros_runtime, tmp_path, "topic", "list", "-v", "--no-daemon", "--spin-time", "1")
    assert lines[0] == "Published topics:"
    assert " * /turtle1/pose [turtlesim/msg/Pose] 1 publisher" in lines
    subscribed = lines[lines.index("Subscribed topics:") :]
    assert " * /turtle1/cmd_vel [geometry_msgs/msg/Twist] 1 subscriber" in subscribed
    counts = [
        ran(ros_runtime, tmp_path, noun, "list", "-c")[1] for noun in ("node", "action", "service")
    ]
    assert counts[:2] == [["1"], ["1"]]
    assert int(counts[2][0]) == len(ran(ros_runtime, tmp_path, "service", "list")[1])


def test_a_topic_is_published_and_described_with_the_quality_asked_for(ros_runtime, tmp_path):
    from tftool.ros.host.program import Program

    words = ["topic", "pub", "/word", "std_msgs/msg/String", "--qos-durability", "transient_local",
             "--qos-reliability", "best_effort", "--qos-depth", "7"]  # fmt: skip
    body = ros2_program.body(words, Workspace(tmp_path), lambda line: None)
    ros_runtime.ask(lambda: [Program(ros_runtime.world, "pub", body, on_exit=lambda _: None)])
    ros_runtime.sleep(0.5)
    _, lines = ran(ros_runtime, tmp_path, "topic", "info", "-v", "/word")

    assert lines[:4] == ["Type: std_msgs/msg/String", "", "Publisher count: 1", ""]
    assert "  Reliability: BEST_EFFORT" in lines
    assert "  History (Depth): KEEP_LAST (7)" in lines
    assert "  Durability: TRANSIENT_LOCAL" in lines
    assert "  Deadline: Infinite" in lines
    assert "  Liveliness: AUTOMATIC" in lines
    assert "Subscription count: 0" in lines


def test_services_are_described_and_found_by_their_type(ros_runtime, tmp_path):
    assert ran(ros_runtime, tmp_path, "service", "info", "/spawn") == (
        0,
        ["Type: turtlesim/srv/Spawn", "Clients count: 0", "Services count: 1"],
    )
    assert ran(ros_runtime, tmp_path, "service", "find", "turtlesim/srv/Spawn")[1] == ["/spawn"]


def test_parameters_are_described_and_loaded_from_a_file(ros_runtime, tmp_path):
    file = tmp_path / "blue.yaml"
    file.write_text("/turtlesim:\n  ros__parameters:\n    background_b: 9\n")

    assert ran(ros_runtime, tmp_path, "param", "load", "/turtlesim", str(file)) == (
        0,
        ["Set parameter background_b successful"],
    )
    assert ran(ros_runtime, tmp_path, "param", "get", "/turtlesim", "background_b")[1] == [
        "Integer value is: 9"
    ]
    shown = ran(ros_runtime, tmp_path, "param", "get", "--hide-type", "/turtlesim", "background_b")
    assert shown[1] == ["9"]
    typed = ran(ros_runtime, tmp_path, "param", "list", "/turtlesim", "--param-type")[1]
    assert "  background_b (type: integer)" in typed
    refused = ran(ros_runtime, tmp_path, "param", "delete", "/turtlesim", "background_b")
    assert refused[1][0].startswith("Deleting parameter failed: ")
    _, lines = ran(ros_runtime, tmp_path, "param", "describe", "/turtlesim", "background_b")
    assert lines[:2] == ["Parameter name: background_b", "  Type: integer"]


def test_a_file_of_parameters_that_is_missing_or_of_others_is_refused(ros_runtime, tmp_path):
    other = tmp_path / "other.yaml"
    other.write_text("/talker:\n  ros__parameters:\n    rate: 9\n")

    failure, _ = ran(ros_runtime, tmp_path, "param", "load", "turtlesim", "none.yaml")
    assert "there is no parameter file 'none.yaml'" in str(failure)
    failure, _ = ran(ros_runtime, tmp_path, "param", "load", "turtlesim", str(other))
    assert "other.yaml' contains no parameters of /turtlesim" in str(failure)


def test_actions_are_described(ros_runtime, tmp_path):
    name = "/turtle1/rotate_absolute"

    assert ran(ros_runtime, tmp_path, "action", "type", name) == (
        0,
        ["turtlesim/action/RotateAbsolute"],
    )
    assert ran(ros_runtime, tmp_path, "action", "info", name)[1] == [
        f"Action: {name}",
        "Action clients: 0",
        "Action servers: 1",
        "    /turtlesim",
    ]


def test_a_node_is_described_with_its_actions_and_without_hidden_topics(ros_runtime, tmp_path):
    _, lines = ran(ros_runtime, tmp_path, "node", "info", "/turtlesim")

    servers = lines[lines.index("  Action Servers:") :]
    assert servers[1] == "    /turtle1/rotate_absolute: turtlesim/action/RotateAbsolute"
    assert servers[-1] == "  Action Clients:"
    assert not any("/_action/" in line for line in lines)


def test_interfaces_are_listed_by_kind_and_package_and_shown_as_a_prototype(ros_runtime, tmp_path):
    def show(*words):
        return ran(ros_runtime, tmp_path, "interface", *words)[1]

    assert show("list", "-s")[0] == "Services:"
    assert "    turtlesim/srv/Spawn" in show("list", "-s")
    assert "turtlesim/action/RotateAbsolute" in show("package", "turtlesim")
    assert "tf2_msgs" in show("packages")
    assert show("proto", "geometry_msgs/msg/Point") == ['"x: 0.0', "y: 0.0", "z: 0.0", '"']
    assert show("proto", "--no-quotes", "turtlesim/srv/Kill") == ["name: ''"]


def test_executables_and_prefixes_of_packages_are_shown(ros_runtime, tmp_path):
    package = tmp_path / "mine"
    package.mkdir()
    (package / "setup.py").write_text(
        "from setuptools import setup\nsetup(name='mine', "
        "entry_points={'console_scripts': ['go = mine.go:main']})\n"
    )

    assert ran(ros_runtime, tmp_path, "pkg", "executables", "mine")[1] == ["mine go"]
    assert "turtlesim mimic" in ran(ros_runtime, tmp_path, "pkg", "executables")[1]
    assert ran(ros_runtime, tmp_path, "pkg", "prefix", "mine")[1] == [str(package)]
    (package / "package.xml").write_text("<package>\n<name>mine</name>\n<x a='b'>one</x></package>")
    assert ran(ros_runtime, tmp_path, "pkg", "xml", "mine")[1][1] == "<name>mine</name>"
    assert ran(ros_runtime, tmp_path, "pkg", "xml", "mine", "-t", "x")[1] == ["one"]
    assert ran(ros_runtime, tmp_path, "pkg", "prefix", "--share", "turtlesim")[0] == 0


def test_a_missing_topic_or_node_is_named_in_the_error(ros_runtime, tmp_path):
    failure, _ = ran(ros_runtime, tmp_path, "topic", "echo", "/nothing", seconds=15.0)
    assert "There is no topic '/nothing' after 10 s" in str(failure)
    failure, _ = ran(ros_runtime, tmp_path, "param", "list", "/nobody", seconds=15.0)
    assert "Node '/nobody' does not exist" in str(failure)
    failure, _ = ran(ros_runtime, tmp_path, "node", "info", "/nobody", seconds=15.0)
    assert "There is no node '/nobody'" in str(failure)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["topik", "list"], "invalid choice: 'topik'"),
        (["service", "call", "/spawn"], "the following arguments are required: type"),
        (
            ["service", "call", "/spawn", "turtlesim/srv/Spwan"],
            "did you mean 'turtlesim/srv/Spawn'",
        ),
        (
            ["service", "call", "/spawn_entity", "gazebo_msgs/SpawnEntity"],
            "kind srv; tftool has no definitions of gazebo_msgs: put the package",
        ),
        (
            ["service", "call", "/spawn", "turtlesim/srv/Spawn", "{y: 1, z: 2}"],
            r"Spawn_Request has no field 'z' \(it has x, y, theta, name\)",
        ),
        (
            ["service", "call", "/spawn", "turtlesim/srv/Spawn", "{x: far}"],
            "field 'x' cannot be 'far'",
        ),
        (["service", "call", "/spawn", "turtlesim/srv/Spawn", "7"], "needs fields"),
        (["topic", "pub", "/a", "geometry_msgs/msg/Polygon", "{points: 3}"], "a list is needed"),
        (["topic", "pub", "/a", "std_msgs/msg/Empty", "-r", "0"], "0 is not a rate"),
        (["topic", "pub", "/a", "std_msgs/msg/Empty", "-r", "nan"], "nan is not a rate"),
        (["interface", "show", "std_msgs/msg/Strin"], "did you mean 'std_msgs/msg/String'"),
    ],
)
def test_wrong_words_are_refused_with_a_sentence(tmp_path, words, told):
    with pytest.raises(UsageError, match=told):
        ros2_program.body(words, Workspace(tmp_path), print)


def test_lists_of_messages_are_filled_element_by_element():
    polygon = rosidl_runtime.interface("geometry_msgs/Polygon", "msg")()
    rosidl_runtime.fill(polygon, {"points": [{"x": 1}, {"y": 2.0}]})

    assert rosidl_runtime.plain(polygon) == {
        "points": [{"x": 1.0, "y": 0.0, "z": 0.0}, {"x": 0.0, "y": 2.0, "z": 0.0}]
    }
