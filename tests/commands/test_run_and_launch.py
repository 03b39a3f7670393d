"""Tests of `tftool run` and `tftool launch` as users type them, in the tutorial's workspace."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tftool.app.main import main

TUTORIAL = Path(__file__).parent.parent / "tutorial"
pytestmark = pytest.mark.usefixtures("in_tutorial")
SIMULATED = ["--simulated", "--for", "5"]


def test_a_file_is_run_beside_a_simulator(capsys):
    status = main(
        ["run", *SIMULATED, "pkg_tf/pkg_tf/turtle_following.py", "--ros-args", "-r", "__node:=f"]
    )
    told = capsys.readouterr().err

    assert status == 0, told
    assert "[INFO] [1002.000000000] [f]: Successfully spawned turtle2" in told
    assert 'Could not transform turtle2 to turtle1: "turtle2" passed to lookupTransform' in told


@pytest.mark.parametrize(
    ("code", "hosts"),
    [
        ("", False),
        ("from geometry_msgs.msg import Twist\nnode.create_timer(0.1, print)\n", False),
        ("from turtlesim.msg import Pose\n", True),
        ("def late():\n    import turtlesim.srv\nnode.create_timer(1.0, late)\n", True),
        (
            "from geometry_msgs.msg import Twist\n"
            "node.create_publisher(Twist, '/turtle1/cmd_vel', 10)\n",
            True,
        ),
    ],
)
def test_only_a_program_that_means_turtles_gets_a_turtlesim(tmp_path, capsys, code, hosts):
    file = tmp_path / "mine.py"
    file.write_text(
        f"import rclpy\nrclpy.init()\nnode = rclpy.create_node('mine')\n{code}rclpy.spin(node)\n"
    )

    assert main(["run", *SIMULATED, str(file)]) == 0
    told = capsys.readouterr().err
    assert told.count("[turtlesim]: Starting turtlesim with node name /turtlesim") == hosts
    assert "failed" not in told


def test_a_program_reads_its_own_arguments(tmp_path, capsys):
    file = tmp_path / "asks.py"
    file.write_text(
        "import argparse, copy, rclpy, sys\n"
        "parser = argparse.ArgumentParser()\nparser.add_argument('where')\n"
        "where = parser.parse_args().where\nrclpy.init()\n"
        "log = rclpy.create_node('asks').get_logger()\n"
        "log.info(f'{where} {sys.argv[1:]} {sys.argv[0][-7:]}')\n"
        "log.info(f'{(sys.argv + [1])[1:]} {([0] + sys.argv)[2:]} {(2 * sys.argv)[1::2]}')\n"
        "log.info(f'{copy.copy(sys.argv)[1:]} {sys.argv.copy()[1:]}')\n"
    )

    assert main(["run", *SIMULATED, str(file), "here"]) == 0
    told = capsys.readouterr().err
    assert "[asks]: here ['here'] asks.py\n" in told
    assert "[asks]: ['here', 1] ['here'] ['here', 'here']\n" in told
    assert "[asks]: ['here'] ['here']\n" in told


@pytest.mark.parametrize("where", [".", "pkg_tf", "pkg_tf/launch"])
def test_a_packages_console_script_is_found_from_anywhere_in_the_workspace(
    monkeypatch, capsys, where
):
    monkeypatch.chdir(TUTORIAL / where)
    status = main(["run", *SIMULATED, "pkg_tf", "rotate", "0.7854"])

    assert status == 0
    assert "[rotate]: Result: -0.7680 after 49 feedbacks" in capsys.readouterr().err


def test_our_own_executables_run_too(capsys):
    status = main(
        ["run", *SIMULATED, "turtlesim", "turtlesim_node", "--ros-args", "-r", "__node:=sim"]
    )

    assert status == 0
    assert "Starting turtlesim with node name /sim" in capsys.readouterr().err


def test_a_nodes_own_exit_status_is_the_commands(capsys):
    assert main(["run", *SIMULATED, "pkg_tf", "static_turtle", "a"]) == 1
    assert "[logger]: Usage: static_turtle" in capsys.readouterr().err
    assert main(["run", *SIMULATED, "pkg_tf", "static_turtle", "world", *"123456"]) == 2


def test_a_launch_file_is_launched_by_its_package_or_its_path(capsys):
    assert main(["launch", "pkg_tf", "turtle_following.launch.py", *SIMULATED]) == 0
    first = capsys.readouterr().err
    file = "pkg_tf/launch/turtle_following.launch.py"
    assert main(["launch", file, "source_frame:=turtle1", *SIMULATED]) == 0

    assert capsys.readouterr().err == first
    assert "[INFO] [turtle_following-4]: process started" in first
    assert "[turtle_following-4] [INFO] [1002.000000000] [listener]: Successfully" in first
    assert "[turtlesim_node-1] [INFO] [1000.000000000] [turtlesim]: Starting" in first


def test_show_args_prints_what_a_file_takes(capsys):
    assert main(["launch", "pkg_tf", "turtle_following.launch.py", "--show-args"]) == 0

    told = capsys.readouterr().out
    assert told.startswith("Arguments (pass arguments as '<name>:=<value>'):")
    assert "(default: 'turtle1')" in told


@pytest.mark.parametrize(
    ("argv", "status", "told"),
    [
        (["run", "gone.py"], 3, "cannot read 'gone.py': No such file"),
        (["run", "--simulated", "x.py"], 2, "add --for SECONDS"),
        (
            ["run", "pkg_tf"],
            2,
            "write the name of an executable after package 'pkg_tf'. (dynamic_carrot",
        ),
        (["run", "pkg_tff", "x"], 2, "did you mean 'pkg_tf'?"),
        (["run", "pkg_tf", "turtle_folowing"], 2, "did you mean 'turtle_following'?"),
        (["run", "turtlesim", "turtle_teleop_key"], 2, "teleop reads keys from a terminal"),
        (["run", "--for", "2", "turtlesim", "turtle_teleop_key"], 2, "until q is pressed"),
        (
            ["run", "turtlesim", "turtle_teleop_key", "--ros-args", "-r", "turtle1/cmd_vel:=out"],
            2,
            "'out' is not the cmd_vel topic of a turtle: write --remap turtle1/cmd_vel:=",
        ),
        (
            ["run", "pkg_tf", "rotate", "--ros-args", "-q"],
            2,
            "'-q' is not an option after --ros-args",
        ),
        (["run", "pkg_tf", "rotate", "--ros-args", "-p"], 2, "'-p' after --ros-args needs a value"),
        (["run", "pkg_tf", "rotate", "--ros-args", "-p", "x"], 2, "write name:=value"),
        (["run", "pkg_tf", "rotate", "--ros-args", "-r", "x"], 2, "write old:=new"),
        (["run", "pkg_tf", "rotate", "--ros-args", "--params-file", "no"], 3, "cannot read the"),
        (
            ["launch", "pkg_tf"],
            2,
            "write the name of a launch file after package 'pkg_tf'. The package has carrot.launch",
        ),
        (["launch", "pkg_tf", "x.launch.py"], 2, "has no launch file 'x.launch.py'"),
        (["launch", "gone.launch.py"], 3, "cannot read 'gone.launch.py'"),
        (
            ["run", *SIMULATED, "pkg_tf"],
            2,
            "write the name of an executable after package 'pkg_tf'. (",
        ),
        (["run", *SIMULATED, "."], 2, "'.' is a folder: give a node's file, or PACKAGE EXECUTABLE"),
        (["launch", "nothing", "x"], 2, "there is no package 'nothing' below"),
        (["launch", "learning_robots", "x"], 2, "; there are learning_tf, pkg_tf"),
        (["launch", "pkg_tf", "carrot.launch.xml", "x"], 2, "'x' is not a launch argument"),
        (["launch", "pkg_tf", "carrot.launch.xml", "sorce_frame:=x"], 2, "mean 'source_frame"),
        (["launch", "pkg_tf", "carrot.launch.xml", "--simulated"], 2, "add --for SECONDS"),
    ],
)
def test_run_and_launch_refuse_invalid_arguments_without_a_traceback(capsys, argv, status, told):
    assert main(argv) == status

    said = capsys.readouterr()
    assert told in said.err
    assert "Traceback" not in said.err


@pytest.mark.parametrize("words", [["nothing", "talker"], ["turtlesim", "turtlesim_nod"]])
def test_nothing_is_hosted_for_an_executable_that_there_is_not(capsys, words):
    assert main(["run", *words]) == 2

    (said,) = capsys.readouterr().err.splitlines()
    assert words[0] in said
    assert said.startswith("tftool: ")


NODE = "import rclpy\nrclpy.init()\nnode = rclpy.create_node('mine')\n"


@pytest.mark.parametrize(
    ("code", "status", "told"),
    [
        ("x = (\n", 3, "bad.py:1:5: SyntaxError: '(' was never closed\n    x = (\n        ^"),
        ("1 / 0\n", 1, "ZeroDivisionError: division by zero\n    {file}:1, in <module>: 1 / 0"),
        (
            NODE + "def tick():\n    node.nope\nnode.create_timer(1.0, tick)\nrclpy.spin(node)\n",
            1,
            "AttributeError: 'Node' object has no attribute 'nope'\n    {file}:5, in tick: node",
        ),
        (
            NODE + "from geometry_msgs.msg import Point\nPoint(x=1)\n",
            1,
            "AssertionError: The 'x' field must be of type 'float', not 'int': write 1.0",
        ),
        (
            "import rclpy.waitable\n",
            1,
            "rclpy.waitable is not supported. The page 'Supported parts of ROS'",
        ),
        (
            "from rclpy.node import ActionClient\n",
            1,
            "'ActionClient' of rclpy.node is not supported; rclpy.action has it. The page",
        ),
        (
            "from geometry_msgs.msg import Pose3\n",
            1,
            "geometry_msgs.msg is not supported; did you mean",
        ),
        (
            "from std_msgs.msg import Foo\n",
            1,
            "'Foo' of std_msgs.msg is not supported. Interfaces need a definition: put",
        ),
        ("import rclpi\n", 1, "No module named 'rclpi'; did you mean 'rclpy'?\n"),
        ("import tf2_kdl.x\n", 1, "named 'tf2_kdl'; the package is not installed in the Python"),
        (
            "from nav2_msgs.action import NavigateToPose\n",
            1,
            "did you mean 'nav_msgs'? If not, tftool has no definitions of nav2_msgs",
        ),
        (
            "from interfaces.msg import Telemetry\n",
            1,
            "did you mean 'rcl_interfaces'? If not, tftool has no definitions of interfaces",
        ),
        ("from my_types.srv import Add\n", 1, "tftool has no definitions of my_types"),
        (
            "import os\nos.environ['AMENT_PREFIX_PATH']\n",
            1,
            "'AMENT_PREFIX_PATH'; a setup file of ROS 2 sets this variable: set it yourself",
        ),
        ("import my_msgs.msg\n", 1, "put the package with its .msg, .srv and .action files into"),
        ("import rclpy\nrclpy.nope\n", 1, "'nope' of rclpy is not supported"),
        ("import cv_bridge\n", 1, "No module named 'cv_bridge'"),
        ("import sys\nsys.exit(7)\n", 7, ""),
        ("raise SystemExit('that is all')\n", 1, "that is all"),
        (
            NODE + "node.declare_parameter('speed', 1.0)\nnode.get_parameter('sped')\n",
            1,
            "Invalid access to undeclared parameter(s): ['sped']; did you mean 'speed'?",
        ),
        (
            NODE + "node.declare_parameter('speed', 1.0)\nnode.declare_parameter('given', 1.0)\n",
            1,
            "Trying to set parameter 'given' to '2' of type 'INTEGER', expecting type 'DOUBLE'"
            ": write 2.0",
        ),
    ],
)
def test_a_failing_node_is_reported_without_a_traceback(tmp_path, capsys, code, status, told):
    file = tmp_path / "bad.py"
    file.write_text(code)

    found = main(["run", *SIMULATED, str(file), "--ros-args", "-p", "given:=2"])

    said = capsys.readouterr().err
    assert found == status
    assert told.replace("{file}", str(file)) in said
    assert "Traceback" not in said


def test_an_endless_loop_is_named_by_node_and_line(tmp_path, capsys, monkeypatch):
    from tftool.ros.host import fibers

    # The limit is more than a second, because the code before the loop is slow on a busy machine.
    monkeypatch.setattr(fibers, "PATIENCE", 1.5)
    monkeypatch.setattr(fibers, "GIVE_UP", 3.0)
    file = tmp_path / "endless.py"
    file.write_text(
        NODE + "def tick():\n    while True:\n        pass\n"
        "node.create_timer(1.0, tick)\nrclpy.spin(node)\n"
    )

    assert main(["run", *SIMULATED, str(file)]) == 1

    said = capsys.readouterr().err
    assert "'mine' has been busy for 1.5 s and simulated time waits for it" in said
    assert "endless.py:5, in tick: while True:" in said or "endless.py:6, in tick: pass" in said
    assert "'endless' has computed for 3 s without waiting" in said
    assert "run it without --simulated" in said


@pytest.mark.skipif(sys.platform == "win32", reason="the C library has another name")
def test_a_library_may_load_slowly_on_simulated_time(tmp_path, capsys, monkeypatch):
    from tftool.ros.host import fibers

    monkeypatch.setattr(fibers, "PATIENCE", 0.5)
    monkeypatch.setattr(fibers, "GIVE_UP", 2.0)
    (tmp_path / "library.py").write_text("import ctypes\nctypes.CDLL(None).sleep(3)\n")
    file = tmp_path / "slow.py"
    file.write_text("import library\n" + NODE + "print('loaded')\n")

    assert main(["run", *SIMULATED, str(file)]) == 0
    assert capsys.readouterr().out == "loaded\n"


@pytest.mark.parametrize("swallows", [False, True])
def test_a_busy_program_that_the_end_of_for_breaks_off_is_named_and_fails(
    tmp_path, capsys, swallows
):
    file = tmp_path / "busy.py"
    # If the world gives up first, the loop still ends, so that it does not slow down later tests.
    end = "import time\nend = time.monotonic() + 20\n"
    loop = "while time.monotonic() < end:\n    pass\n"
    if swallows:
        loop = (
            "try:\n    while time.monotonic() < end:\n        pass\n"
            "except KeyboardInterrupt:\n    pass\n"
        )
    file.write_text(NODE + end + loop)

    assert main(["run", "--for", "0.5", str(file)]) == 1

    said = capsys.readouterr().err
    # The second text occurs if the machine is too slow to interrupt the program before the world
    # gives up.
    told = ("'busy' did not end with the run and was stopped: ", "has not returned 2 s")
    assert any(words in said for words in told)


def test_where_a_real_ros_is_sourced_we_stand_back_unless_told(tmp_path, capsys, monkeypatch):
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").write_text("")
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    monkeypatch.syspath_prepend(tmp_path)

    assert main(["launch", "pkg_tf", "turtle_following.launch.py", *SIMULATED]) == 2
    assert "a real ROS 2 is sourced" in capsys.readouterr().err
    assert main(["launch", "pkg_tf", "turtle_following.launch.py", *SIMULATED, "--ros-free"]) == 0


PAGE = (TUTORIAL.parent.parent / "docs" / "do" / "nodes.md").read_text(encoding="utf-8")
LINES = [
    command
    for row in re.findall(r"^\| `.*\| (.*) \|$", PAGE, re.MULTILINE)
    for command in re.findall(r"`(tftool [^`]*)`", row)
]


# These commands run until a person ends them; test_live.py and screens/test_tmux.py run them.
STAYING = {"tftool teleop", "tftool run turtlesim turtle_teleop_key", "tftool view"}


@pytest.mark.parametrize("line", [line for line in LINES if line not in STAYING])
def test_every_line_of_the_pages_table_works(line, tftool, simulated):
    command, *words = shlex.split(line)[1:]
    if command in ("run", "launch") and "--show-args" not in words:
        words = [*SIMULATED, *words]

    assert tftool(command, *words).status == 0


def test_the_table_has_its_lines():
    assert len(LINES) > 15
    assert set(LINES) >= STAYING


def test_a_package_imports_from_its_neighbour_in_the_workspace(tmp_path, capsys, monkeypatch):
    for name, module, code in (
        (
            "talks",
            "node",
            "from shared.words import WORD\n" + NODE + "node.get_logger().info(WORD)\n",
        ),
        ("shared", "words", "WORD = 'from next door'\n"),
    ):
        folder = tmp_path / "src" / name
        (folder / name).mkdir(parents=True)
        (folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
        (folder / name / "__init__.py").touch()
        (folder / name / f"{module}.py").write_text(code)
        (folder / "setup.py").write_text(
            f"setup(name='{name}', entry_points={{'console_scripts': ['go = {name}.{module}']}})"
        )
    monkeypatch.chdir(tmp_path)

    main(["run", *SIMULATED, "talks", "go"])
    assert "[mine]: from next door" in capsys.readouterr().err
    assert main(["run", *SIMULATED, "src/talks/talks/node.py"]) == 0
    assert "[mine]: from next door" in capsys.readouterr().err


def test_a_node_can_be_put_into_a_scenario(tmp_path, capsys):
    file = tmp_path / "where.py"
    file.write_text(
        NODE + "from tf2_ros import Buffer, TransformListener\n"
        "buffer = Buffer()\nlistener = TransformListener(buffer, node)\n"
        "def look():\n"
        "    found = buffer.lookup_transform('map', 'laser_link', rclpy.time.Time())\n"
        "    node.get_logger().info(f'laser in {found.header.frame_id}')\n"
        "node.create_timer(4.0, look)\nrclpy.spin(node)\n"
    )

    assert main(["run", "--in", "robot", *SIMULATED, str(file)]) == 0
    assert "[mine]: laser in map" in capsys.readouterr().err


@pytest.mark.skipif(os.name == "nt", reason="the command ros2 is a shell script")
def test_the_command_ros2_of_a_child_process_is_refused_on_simulated_time(tmp_path, capfd):
    file = tmp_path / "parent.py"
    file.write_text(
        NODE + "import subprocess\n"
        "for words in (['topic', 'list'], ['interface', 'show', 'std_msgs/msg/Bool']):\n"
        "    print(subprocess.call(['ros2', *words]))\n"
    )
    assert main(["run", *SIMULATED, str(file)]) == 0

    out, err = capfd.readouterr()
    assert out.splitlines() == ["2", "bool data", "0"]
    assert "'ros2 topic' would join a session" in err


def interrupted(folder, line, *words):
    """Interrupt a command once it has printed a line; return its status and output."""
    environment = {**os.environ, "TFTOOL_SESSION_DIR": str(folder / "session")}
    command = subprocess.Popen(
        [sys.executable, "-m", "tftool", *words],
        stderr=subprocess.PIPE,
        text=True,
        env={**environment, "PYTHONPATH": str(TUTORIAL.parent.parent)},
    )
    with command:
        for said in command.stderr:
            if line in said:
                command.send_signal(signal.SIGINT)
                break
        rest = command.stderr.readlines()
    # On a busy machine, an end may take longer than the limit for a message, and a timer may be
    # late.
    slow = ("has not returned", "behind its own timer")
    told = [said for said in rest if not any(words in said for words in slow)]
    return command.returncode, "".join(told)


def test_ctrl_c_ends_a_launch_as_ros2_launch_ends(tmp_path):
    file = tmp_path / "some.launch.py"
    file.write_text(
        "from launch import LaunchDescription\nfrom launch.actions import *\n"
        "from launch.event_handlers import *\nfrom launch_ros.actions import Node\n"
        "def generate_launch_description():\n"
        "    sim = Node(package='turtlesim', executable='turtlesim_node')\n"
        "    return LaunchDescription([\n"
        "        sim, ExecuteProcess(cmd=['sh', '-c', 'echo ready; sleep 60']),\n"
        "        RegisterEventHandler(OnProcessExit(target_action=sim, on_exit=[\n"
        "            LogInfo(msg='sim is over'), ExecuteProcess(cmd=['echo', 'another'])])),\n"
        "        RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: [\n"
        "            LogInfo(msg=f'ends: {event.reason}')]))])\n"
    )
    status, said = interrupted(tmp_path, "[sh-2] ready", "launch", "--ros-free", str(file))

    assert status == 130
    lines = said.splitlines()
    # The operating system decides when another process ends.
    lines.remove("[INFO] [sh-2]: process has finished cleanly")
    assert lines == [
        "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)",
        "[INFO] [launch]: ends: ctrl-c (SIGINT)",
        "[INFO] [turtlesim_node-1]: process has finished cleanly",
        "[INFO] [launch]: sim is over",
    ]


def test_ctrl_c_runs_destroy_node_and_ends_the_command_as_interrupted(tmp_path):
    file = tmp_path / "ends.py"
    file.write_text(
        "import rclpy\nfrom rclpy.node import Node\n"
        "class Ends(Node):\n"
        "    def destroy_node(self):\n"
        "        self.get_logger().info('destroyed')\n"
        "        super().destroy_node()\n"
        "rclpy.init()\nnode = Ends('ends')\nnode.get_logger().info('ready')\nrclpy.spin(node)\n"
    )
    status, rest = interrupted(tmp_path, "[ends]: ready", "run", "--host", str(file))

    assert status == 130
    assert "[ends]: destroyed" in rest
    assert "Traceback" not in rest


@pytest.mark.parametrize(
    "wait",
    [
        "thread.join(timeout=60)",
        "over.wait(60)",
        "[time.sleep(0.1) for _ in range(600) if thread.is_alive()]",
    ],
)
def test_a_program_can_wait_for_its_thread_after_ctrl_c(tmp_path, wait):
    file = tmp_path / "waits.py"
    file.write_text(
        "import threading, time\nimport rclpy\n"
        "def spin():\n    try:\n        rclpy.spin(node)\n    finally:\n        over.set()\n"
        "over = threading.Event()\nrclpy.init()\nnode = rclpy.create_node('waits')\n"
        "thread = threading.Thread(target=spin, daemon=True)\nthread.start()\n"
        "node.get_logger().info('ready')\n"
        "try:\n    time.sleep(100)\nexcept KeyboardInterrupt:\n    rclpy.try_shutdown()\n"
        f"{wait}\nnode.get_logger().info(f'spun to the end: {{over.is_set()}}')\n"
    )
    _, rest = interrupted(tmp_path, "[waits]: ready", "run", "--host", str(file))

    assert "spun to the end: True" in rest


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_first_signal_ends_an_endless_loop_on_simulated_time_too(tmp_path, number):
    file = tmp_path / "endless.py"
    file.write_text(
        NODE + "def tick():\n    node.get_logger().info('ticked')\n    while True:\n        pass\n"
        "node.create_timer(1.0, tick)\nrclpy.spin(node)\n"
    )
    command = subprocess.Popen(
        [sys.executable, "-m", "tftool", "run", *SIMULATED, str(file)],
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(TUTORIAL.parent.parent)},
    )
    with command:
        for line in command.stderr:
            if "[mine]: ticked" in line:
                command.send_signal(number)
                break
        rest = command.stderr.read()

    assert command.returncode == 130
    assert "did not come to rest" not in rest
    assert "Traceback" not in rest


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["nope.py"], 3, "cannot read 'nope.py'"),
        (["pkg_tf"], 2, "write the name of an executable after package 'pkg_tf'."),
        (["pkg_tf", "rotate", "--ros-args", "-p", "a=5"], 2, "a=5"),
        (["pkg_tf/pkg_tf/turtle_following.py", "--ros-args", "-p", "a=5"], 2, "a=5"),
    ],
)
def test_a_wrong_command_line_is_refused_before_a_world_is_hosted(capsys, words, status, told):
    assert main(["run", *SIMULATED, *words]) == status
    said = capsys.readouterr().err
    assert told in said
    assert "hosting" not in said
    assert "Starting turtlesim" not in said


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--domain", "1"], "'--domain' after FILE is passed to the node: write tftool's own"),
        (["--listen=tcp/[::]:0"], "'--listen' after FILE is passed to the node: write"),
        (["-p", "a:=b"], "'-p a:=b' is passed to the node unchanged: write ROS 2's arguments"),
        (["--rate", "5", "--ros-args", "-p", "a:=b"], ""),
    ],
)
def test_misplaced_options_are_passed_to_the_node_with_a_notice(tmp_path, capsys, words, told):
    file = tmp_path / "says.py"
    file.write_text("import sys\n" + NODE + "node.get_logger().info(f'{sys.argv[1:]}')\n")

    assert main(["run", *SIMULATED, str(file), *words]) == 0

    said = capsys.readouterr().err
    assert told in said
    assert ("to the node" in said) is bool(told)
    assert f"[mine]: {words}" in said


def test_ros2s_words_ask_the_session_and_are_refused_with_a_sentence(capsys):
    assert main(["ros2", "interface", "show", "std_srvs/srv/Trigger"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "---"
    assert main(["ros2", "topik", "list"]) == 2
    assert "invalid choice: 'topik'" in capsys.readouterr().err
    assert main(["ros2", "run", "turtlesim", "turtlesim_node"]) == 2
    assert (
        capsys.readouterr().err == "tftool: 'tftool ros2' has no command 'run': use 'tftool run'.\n"
    )
    assert main(["ros2", "bag", "info", "run.mcap"]) == 2
    assert (
        capsys.readouterr().err
        == "tftool: 'tftool ros2' has no command 'bag info': use 'tftool info'.\n"
    )
    assert main(["run", "joint_state_publisher_gui", "joint_state_publisher_gui"]) == 2
    assert "run 'tftool robot FILE' in another" in capsys.readouterr().err


def test_a_viewer_of_ros_runs_the_command_of_the_same_purpose(tmp_path, tftool, monkeypatch):
    echo = tftool("run", "tf2_ros", "tf2_echo", "world", "turtle1", "--once")
    assert (echo.status, echo.out.splitlines()[1]) == (0, "- Translation: [5.544, 5.544, 0.000]")
    assert "Without ROS this is 'tftool echo world turtle1 --once'." in echo.err

    monkeypatch.chdir(tmp_path)
    words = ["tf2_tools", "view_frames", "--ros-args", "-r", "a:=b"]
    for file, more in (
        ("frames.pdf", []),
        ("frames.pdf", []),
        ("own.pdf", ["--output", "own.pdf"]),
    ):
        assert tftool("run", *words[:2], *more, *words[2:]).status == 0
        assert (tmp_path / file).read_bytes().startswith(b"%PDF")

    misplaced = tftool("run", "--for", "1", "rviz2", "rviz2")
    assert (misplaced.status, "is replaced by 'tftool view'" in misplaced.err) == (2, True)
    lacking = tftool("run", "tf2_ros", "tf2_echo", "world")
    assert (lacking.status, "Missing argument 'SOURCE'" in lacking.err) == (2, True)


def test_a_loop_that_polls_simulated_time_is_named_with_its_line(tmp_path, tftool, monkeypatch):
    monkeypatch.setattr("tftool.ros.host.fibers.GIVE_UP", 0.02)
    file = tmp_path / "polls.py"
    file.write_text(
        "import time\nimport rclpy\nrclpy.init()\nrclpy.create_node('polls')\n"
        "while time.time() < 1e9:\n    pass\n"
    )

    run = tftool("run", "--simulated", "--for", "60", str(file))
    assert run.err.count("has polled for 0.02 s") == 1
    assert "polls.py:5, in <module>: while time.time() < 1e9:" in run.err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ["topic", "echo", "/nothing"],
            "There is no topic '/nothing' after 10 s: "
            "'tftool ros2 topic list' lists the topics that exist.",
        ),
        (
            ["param", "get", "/nobody", "x"],
            "Node '/nobody' does not exist, or has no parameters: "
            "'tftool ros2 node list' lists the nodes.",
        ),
        (
            ["node", "info", "/nobody"],
            "There is no node '/nobody': 'tftool ros2 node list' lists the nodes.",
        ),
    ],
)
@pytest.mark.usefixtures("simulated")
def test_of_what_ros2s_words_do_not_find_that_alone_is_said(tftool, words, told):
    result = tftool("ros2", *words)

    assert (result.status, result.err.splitlines()[-1]) == (1, f"tftool: {told}")


@pytest.mark.parametrize(
    ("words", "told"),
    [(["topic"], "list, echo, find, hz, bw, delay"), (["topic", "echo"], "--once")],
)
def test_a_word_of_ros2s_has_help_as_there(capsys, words, told):
    with pytest.raises(SystemExit) as ended:
        main(["ros2", *words, "--help"])

    assert ended.value.code == 0
    assert told in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["launch"], "Show this session from another terminal: tftool demo --join · tftool view\n"),
        (["launch", "--domain", "3"], "tftool demo --join --domain 3 · tftool view --domain 3\n"),
        (["launch", "--simulated"], None),
    ],
)
def test_a_person_is_told_once_where_to_look(capsys, monkeypatch, words, said):
    def run(*, is_terminal):
        monkeypatch.setattr(sys.stderr, "isatty", lambda: is_terminal)
        file = ["pkg_tf", "carrot.launch.yaml", "--for", "0.1"]
        assert main([words[0], *file, *words[1:]]) == 0
        return capsys.readouterr().err

    assert "another terminal" not in run(is_terminal=False)
    shown = run(is_terminal=True)
    assert shown.count("another terminal") == (said is not None)
    assert (said or "") in shown


@pytest.mark.parametrize(
    ("words", "near"),
    [
        (["run", "pkg_tf/pkg_tf/turtle_following.py"], "src/pkg_tf/pkg_tf/turtle_following.py"),
        (["run", "turtle_following.py"], "src/pkg_tf/pkg_tf/turtle_following.py"),
        (["launch", "carrot.launch.xml"], "src/pkg_tf/launch/carrot.launch.xml"),
        (
            ["check", "turtles", "--run", "follower=pkg_tf/pkg_tf/turtle_following.py"],
            "src/pkg_tf/pkg_tf/turtle_following.py",
        ),
    ],
)
def test_a_path_that_is_right_from_another_folder_of_the_workspace_is_told(
    tmp_path, monkeypatch, capfd, words, near
):
    (tmp_path / "src").mkdir()
    shutil.copytree(TUTORIAL / "pkg_tf", tmp_path / "src" / "pkg_tf")
    monkeypatch.chdir(tmp_path)

    assert main(words) == 3
    assert f"No such file or directory; did you mean '{near}'?" in "".join(capfd.readouterr())


def test_ros2s_answers_are_json_on_request(capsys):
    assert main(["ros2", "--json", "interface", "show", "geometry_msgs/msg/Vector3"]) == 0
    assert json.loads(capsys.readouterr().out) == ["float64 x", "float64 y", "float64 z"]
    assert main(["ros2", "--json", "--in", "turtles", "topic", "info", "/turtle1/pose"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["Type"] == "turtlesim/msg/Pose"
    assert told["Publisher count"] == 1
