"""Tests of tftool's own nodes with their names in ROS 2."""

import math

import pytest

from tests.ros.tutorial import start
from tftool.base.errors import UsageError


def begin(runtime, package, executable, *words):
    return runtime.ask(lambda: start(runtime.world, executable, *words, package=package))


@pytest.mark.parametrize(
    ("executable", "name"),
    [
        ("turtle_tf2_broadcaster", "turtle_tf2_frame_publisher"),
        ("turtle_tf2_listener", "turtle_tf2_frame_listener"),
        ("fixed_frame_tf2_broadcaster", "fixed_frame_tf2_broadcaster"),
        ("dynamic_frame_tf2_broadcaster", "dynamic_frame_tf2_broadcaster"),
        ("turtle_tf2_message_broadcaster", "turtle_tf2_message_broadcaster"),
        ("turtle_tf2_message_filter", "turtle_tf2_pose_drawer"),
    ],
)
def test_the_demos_executables_have_their_nodes_names(ros_runtime, executable, name):
    begin(ros_runtime, "turtlesim", "turtlesim_node")

    assert begin(ros_runtime, "turtle_tf2_py", executable).name == name
    again = begin(ros_runtime, "turtle_tf2_cpp", executable, "--ros-args", "-r", "__ns:=/x")
    assert again.name == f"x/{name}"
    assert begin(ros_runtime, "turtle_tf2_cpp", executable).name == f"{name}_2"


def test_one_of_the_name_of_another_processs_node_says_so(ros_runtime):
    ros_runtime.world.know_far_nodes(["turtle_tf2_frame_publisher"])
    begin(ros_runtime, "turtlesim", "turtlesim_node")
    begin(ros_runtime, "turtle_tf2_py", "turtle_tf2_broadcaster")

    (told,) = [text for text in ros_runtime.log() if "another process" in text]
    assert "has a node named 'turtle_tf2_frame_publisher'" in told


def test_the_square_is_drawn_and_mimicked(ros_runtime):
    for number in (1, 2):
        begin(ros_runtime, "turtlesim", "turtlesim_node", "--ros-args", "-r", f"__ns:=/s{number}")
    begin(
        ros_runtime, "turtlesim", "mimic", "--ros-args",
        "-r", "/input/pose:=/s1/turtle1/pose", "-r", "/output/cmd_vel:=/s2/turtle1/cmd_vel",
    )  # fmt: skip
    from tftool.messages.turtle_messages import Twist, twist

    def drive():
        ros_runtime.world.topic("s1/turtle1/cmd_vel", Twist).publish(twist(1.0))

    ros_runtime.sleep(0.1)
    ros_runtime.ask(drive)
    ros_runtime.sleep(2)
    x1, x2 = (ros_runtime.world.node(f"s{n}/turtlesim").turtles["turtle1"].place.x for n in (1, 2))

    assert x1 == pytest.approx(6.5524, abs=1e-3)
    assert x2 > 6.5


def test_draw_square_draws(ros_runtime):
    begin(ros_runtime, "turtlesim", "turtlesim_node")
    begin(ros_runtime, "turtlesim", "draw_square")
    ros_runtime.sleep(2.1)

    place = ros_runtime.world.node("turtlesim").turtles["turtle1"].place
    assert place.x == pytest.approx(7.448, abs=0.03)


@pytest.mark.parametrize(
    ("package", "executable", "words", "expected"),
    [
        (
            "turtle_tf2_py",
            "static_turtle_tf2_broadcaster",
            ["child", "1", "2", "3", "0", "0", "1.5"],
            ("world", "child", (1.0, 2.0, 3.0), (0.0, 0.0, math.sin(0.75), math.cos(0.75))),
        ),
        (
            "tf2_ros",
            "static_transform_publisher",
            ["0", "0", "3", "0", "0", "3.14", "A", "B"],
            ("A", "B", (0.0, 0.0, 3.0), (math.sin(1.57), 0.0, 0.0, math.cos(1.57))),
        ),
        (
            "tf2_ros",
            "static_transform_publisher",
            ["1", "0", "0", "0", "0", "1", "0", "A", "B"],
            ("A", "B", (1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0)),
        ),
        (
            "tf2_ros",
            "static_transform_publisher",
            ["--x", "1", "--yaw", "1.5", "--frame-id", "A", "--child-frame-id", "B"],
            ("A", "B", (1.0, 0.0, 0.0), (0.0, 0.0, math.sin(0.75), math.cos(0.75))),
        ),
        (
            "tf2_ros",
            "static_transform_publisher",
            ["--qz", "1", "--qw", "0", "--frame-id", "A", "--child-frame-id", "B"],
            ("A", "B", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0)),
        ),
    ],
)
def test_static_transforms_are_published(ros_runtime, package, executable, words, expected):
    begin(ros_runtime, package, executable, *words)
    ros_runtime.sleep(0.1)
    parent, child, place, rotation = expected
    found = ros_runtime.world.buffer.lookup_transform(parent, child).transform

    assert found.translation == pytest.approx(place)
    assert found.rotation == pytest.approx(rotation)


@pytest.mark.parametrize(
    ("package", "executable", "words", "told"),
    [
        ("turtle_tf2_py", "static_turtle_tf2_broadcaster", ["a"], "Invalid number of parameters"),
        (
            "turtle_tf2_py",
            "static_turtle_tf2_broadcaster",
            ["world", *"123456"],
            'cannot be "world"',
        ),
        (
            "turtle_tf2_py",
            "static_turtle_tf2_broadcaster",
            ["a", "one", *"23456"],
            "'one' is not a finite number",
        ),
        (
            "tf2_ros",
            "static_transform_publisher",
            ["1"],
            "8 words are needed .x y z yaw pitch roll",
        ),
        (
            "tf2_ros",
            "static_transform_publisher",
            ["--frame", "A"],
            "There is no --frame. Did you mean --frame-id",
        ),
        ("tf2_ros", "static_transform_publisher", ["--x", "1"], "Name the parent with --frame-id"),
        (
            "tf2_ros",
            "static_transform_publisher",
            [*"12345", "nan", "A", "B"],
            "not a finite number",
        ),
        (
            "tf2_ros",
            "static_transform_publisher",
            ["--qx", "1", "--yaw", "1", "--frame-id", "A", "--child-frame-id", "B"],
            "Cannot specify both quaternion and Euler",
        ),
    ],
)
def test_wrong_arguments_are_refused_with_what_is_wanted(
    ros_runtime, package, executable, words, told
):
    with pytest.raises(UsageError, match=told):
        begin(ros_runtime, package, executable, *words)


def test_where_packages_are_can_be_asked():
    from tests.ros.tutorial import TUTORIAL
    from tftool.ros.host.workspace import Workspace, use_workspace
    from tftool.ros.launch import packages

    use_workspace(Workspace(TUTORIAL))

    assert packages.get_package_share_directory("pkg_tf") == str(TUTORIAL)
    assert packages.get_package_prefix("pkg_tf") == str(TUTORIAL)
    assert packages.get_package_share_path("pkg_tf") == TUTORIAL
    assert packages.get_packages_with_prefixes() == {"pkg_tf": str(TUTORIAL)}
    with pytest.raises(packages.PackageNotFoundError, match="there is no package 'pkg'"):
        packages.get_package_share_directory("pkg")


def test_launched_commands_run_beside_the_nodes_on_the_wall_clock(tmp_path, capsys, monkeypatch):
    from tftool.app.main import main

    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.setenv("TFTOOL_SESSION_DIR", str(tmp_path / "session"))
    file = tmp_path / "a.launch.py"
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import ExecuteProcess, RegisterEventHandler, EmitEvent\n"
        "from launch.event_handlers import OnProcessExit\n"
        "from launch.events import Shutdown\n"
        "def generate_launch_description():\n"
        "    first = ExecuteProcess(cmd=['echo', 'hello'])\n"
        "    return LaunchDescription([first, ExecuteProcess(cmd=['sleep', '60']),\n"
        "        ExecuteProcess(cmd=['no-such-command-here']),\n"
        "        RegisterEventHandler(OnProcessExit(target_action=first,\n"
        "            on_exit=EmitEvent(event=Shutdown(reason='done'))))])\n"
    )

    status = main(["launch", "--host", str(file)])
    told = capsys.readouterr().err

    assert "[echo-1] hello" in told
    assert "[INFO] [launch]: shutting down: done" in told
    assert "[INFO] [sleep-2]: process has finished cleanly" in told
    assert "[no-such-command-here-3]: process has died" in told
    assert "cannot run 'no-such-command-here': No such file or directory" in told
    assert status == 1


def test_a_commands_lines_may_be_of_any_length(monkeypatch):
    import asyncio

    from tftool.ros.launch import commands

    monkeypatch.setattr(commands, "LONGEST_LINE", 300_000)

    async def read():
        stream = asyncio.StreamReader()
        stream.feed_data(b"a\n" + b"b" * 200_000 + b"\n\n" + b"c" * 400_000 + b"\nd\xff")
        stream.feed_eof()
        return [line async for line in commands.read_lines(stream)]

    first, long, empty, *pieces, last = asyncio.run(read())

    assert (first, long, empty, last) == ("a", "b" * 200_000, "", "d\ufffd")
    assert "".join(pieces) == "c" * 400_000


def test_a_command_that_will_not_end_is_made_to(tmp_path, capsys, monkeypatch):
    from tftool.app.main import main
    from tftool.ros.launch import commands

    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.setenv("TFTOOL_SESSION_DIR", str(tmp_path / "session"))
    monkeypatch.setattr(commands, "PATIENCE", 1.0)
    file = tmp_path / "a.launch.py"
    # The shell and its command ignore the first signal; the command also ignores the second one. No
    # signal is sent before both have reported this.
    file.write_text(
        "from launch import LaunchDescription\nfrom launch.actions import *\n"
        "from launch.event_handlers import OnProcessIO\n"
        "heard = []\n"
        "def hear(event):\n"
        "    heard.append(event)\n"
        "    return Shutdown(reason='enough') if len(heard) == 2 else None\n"
        "def command(name, signals):\n"
        "    words = f\"trap '' {signals}; echo ready; sleep 60\"\n"
        "    return ExecuteProcess(cmd=[words], shell=True, name=name)\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([\n"
        "        RegisterEventHandler(OnProcessIO(on_stdout=hear)),\n"
        "        command('deaf', 'INT'), command('deafer', 'INT TERM')])\n"
    )

    assert main(["launch", "--host", str(file)]) == 1
    told = capsys.readouterr().err
    assert "[deaf-1]: process has finished cleanly" in told
    assert "[deafer-2]: process has died, exit status -9" in told


def test_a_nodes_file_imports_its_own_package_by_name(ros_runtime, tmp_path):
    package = tmp_path / "own_package"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "words.py").write_text("WORD = 'from beside'\n")
    (package / "speaker.py").write_text(
        "import rclpy\n"
        "from own_package.words import WORD\n"
        "from .words import WORD as BY_A_DOT\n"
        "rclpy.init()\n"
        "rclpy.create_node('speaker').get_logger().info(WORD)\n"
    )

    ros_runtime.start(package / "speaker.py")
    ros_runtime.sleep(1.0)

    assert ros_runtime.log("speaker") == ["from beside"]


def test_a_nodes_file_finds_its_package_beside_a_file_of_the_same_name(ros_runtime, tmp_path):
    package = tmp_path / "garden"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "words.py").write_text("WORD = 'from the package'\n")
    (package / "garden.py").write_text("from .words import WORD\n")
    (package / "speaker.py").write_text(
        "import rclpy\n"
        "from .garden import WORD\n"
        "rclpy.init()\n"
        "rclpy.create_node('speaker').get_logger().info(WORD)\n"
    )

    ros_runtime.start(package / "speaker.py")
    ros_runtime.sleep(1.0)

    assert ros_runtime.log("speaker") == ["from the package"]


def test_a_nodes_file_imports_from_a_folder_without_init(ros_runtime, tmp_path):
    for name in ("first", "second"):
        (tmp_path / name / "parts" / "deep").mkdir(parents=True)
        (tmp_path / name / "parts" / "deep" / "words.py").write_text(f"WORD = 'from the {name}'\n")
        (tmp_path / name / f"{name}.py").write_text(
            "import rclpy\n"
            "from parts.deep.words import WORD\n"
            "rclpy.init()\n"
            f"rclpy.create_node('{name}').get_logger().info(WORD)\n"
        )
        ros_runtime.start(tmp_path / name / f"{name}.py")
        ros_runtime.sleep(1.0)

    assert ros_runtime.log("first") == ["from the first"]
    assert ros_runtime.log("second") == ["from the second"]


def test_a_file_with_zero_bytes_is_no_python_text(tmp_path):
    from tftool.base.errors import InputError
    from tftool.ros.host.user_code import compile_file

    file = tmp_path / "node.pyc"
    file.write_bytes(b"a = 1\0")
    with pytest.raises(InputError, match=r"node\.pyc' is not valid Python: source code"):
        compile_file(file)
