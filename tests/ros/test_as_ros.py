"""Tests of refusals and orders in rclpy and launch that are easy to overlook."""

import sys

import pytest


def test_the_executor_runs_a_futures_callbacks_after_the_answer_is_set(node):
    import rclpy
    from std_srvs.srv import Trigger

    seen = []
    node.create_service(Trigger, "ask", lambda request, response: response)
    client = node.create_client(Trigger, "ask")
    future = client.call_async(Trigger.Request())
    future.add_done_callback(lambda done: seen.append(done.result()))

    rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
    assert seen == []
    rclpy.spin_once(node, timeout_sec=0.0)
    assert len(seen) == 1


def test_a_future_without_an_executor_calls_back_at_once():
    from tftool.ros.rclpy.futures import Future

    seen, future = [], Future()
    future.add_done_callback(seen.append)
    future.set_result(1)
    future.add_done_callback(seen.append)

    assert seen == [future, future]


def test_a_thread_that_sleeps_by_a_rate_wakes_a_main_loop_of_spin_once(tftool, tmp_path):
    file = tmp_path / "rated.py"
    file.write_text(
        "import threading\nimport rclpy\nrclpy.init()\nnode = rclpy.create_node('rated')\n"
        "def pace():\n    rate = node.create_rate(2)\n"
        "    for _ in range(4):\n        rate.sleep()\n"
        "thread = threading.Thread(target=pace)\nthread.start()\n"
        "while thread.is_alive():\n    rclpy.spin_once(node)\n"
        "node.get_logger().info('left the loop')\n"
    )

    run = tftool("run", "--simulated", "--for", "10", str(file))
    assert "[1002.000000000] [rated]: left the loop" in run.err


def test_a_parameter_cannot_be_declared_to_have_no_type(node):
    from rcl_interfaces.msg import ParameterDescriptor
    from rclpy.parameter import Parameter

    with pytest.raises(ValueError, match="NOT_SET"):
        node.declare_parameter("plain", Parameter.Type.NOT_SET)
    with pytest.raises(ValueError, match="dynamic_typing"):
        node.declare_parameter(
            "both", Parameter.Type.STRING, ParameterDescriptor(dynamic_typing=True)
        )
    assert node.declare_parameter("any", descriptor=ParameterDescriptor(dynamic_typing=True))


def test_parameters_are_listed_to_no_negative_depth(node):
    with pytest.raises(ValueError, match="-1"):
        node.list_parameters([], -1)


ISATTY = "import sys; print('terminal' if sys.stdout.isatty() else 'pipe')"


@pytest.mark.parametrize("simulated", [True, False])
def test_a_process_writes_to_a_terminal_where_one_is_emulated(tftool, tmp_path, simulated):
    file = tmp_path / "tty.launch.py"
    file.write_text(
        "from launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\n"
        "def generate_launch_description():\n"
        f"    cmd = [{sys.executable!r}, '-c', {ISATTY!r}]\n"
        "    return LaunchDescription([ExecuteProcess(cmd=cmd, name='with', emulate_tty=True),\n"
        "                              ExecuteProcess(cmd=cmd, name='without')])\n"
    )

    options = ("--simulated", "--for", "1") if simulated else ("--host",)
    run = tftool("launch", *options, str(file))
    assert run.status == 0, run.err
    assert "[with-1] terminal\n" in run.err
    assert "[without-2] pipe\n" in run.err


@pytest.mark.parametrize(
    ("words", "shell"),
    [
        (["python3", "node.py", "a"], False),
        ([sys.executable, "-u", "-B", "by_module.py", "a"], False),
        (["python3", "-m", "by_module", "a"], False),
        (["python3 node.py", "a"], True),
        (["bash", "-c", "python3 node.py a"], False),
    ],
)
def test_a_python_command_of_a_node_finds_rclpy(tftool, tmp_path, words, shell):
    (tmp_path / "node.py").write_text(
        "import sys\nimport rclpy\ndef main():\n    rclpy.init()\n"
        "    rclpy.create_node('given').get_logger().info(' '.join(sys.argv[1:]))\n"
        "if __name__ == '__main__':\n    main()\n"
    )
    (tmp_path / "by_module.py").write_text("from node import main\nmain()\n")
    file = tmp_path / "commands.launch.py"
    file.write_text(
        "import os\nfrom launch import LaunchDescription\n"
        "from launch.actions import ExecuteProcess\n"
        "def generate_launch_description():\n    here = os.path.dirname(__file__)\n"
        f"    one = ExecuteProcess(cmd={words!r}, cwd=here, shell={shell})\n"
        "    return LaunchDescription([one])\n"
    )

    run = tftool("launch", "--simulated", "--for", "1", str(file))
    assert run.status == 0, run.err
    assert "[given]: a\n" in run.err


def test_a_process_of_its_own_without_rclpy_is_told_how_to_have_it(tftool, tmp_path):
    file = tmp_path / "commands.launch.xml"
    file.write_text(f"""<launch><executable cmd="{sys.executable} -c 'import rclpy'"/></launch>""")

    run = tftool("launch", "--simulated", "--for", "1", str(file))
    assert run.status == 1
    assert "without tftool's rclpy: start the node's file by python3 FILE" in run.err


@pytest.mark.parametrize(("word", "expected"), [("yes", "new:old"), ("off", "old:new")])
def test_a_flag_of_xml_may_be_any_word_that_yaml_takes_for_one(tftool, tmp_path, word, expected):
    file = tmp_path / "env.launch.xml"
    file.write_text(
        '<launch><set_env name="SHAPES" value="old"/>'
        f'<append_env name="SHAPES" value="new" prepend="{word}"/>'
        '<log message="$(env SHAPES)"/></launch>'
    )

    run = tftool("launch", "--simulated", "--for", "1", str(file))
    assert expected in run.err, run.err


def test_a_time_source_moves_its_clocks_and_tells_of_jumps(node):
    import rclpy
    from builtin_interfaces.msg import Time as TimeMessage
    from rclpy.clock import ClockChange, JumpThreshold, ROSClock
    from rclpy.duration import Duration
    from rclpy.parameter import Parameter
    from rclpy.time_source import TimeSource
    from rosgraph_msgs.msg import Clock

    source, clock, told = TimeSource(node=node), ROSClock(), []
    source.attach_clock(clock)
    assert not clock.ros_time_is_active

    def register(name, **threshold):
        limits = {"min_forward": None, "min_backward": None, "on_clock_change": False} | threshold
        return clock.create_jump_callback(
            JumpThreshold(**limits),
            pre_callback=lambda: told.append((name, "before", clock.now().nanoseconds)),
            post_callback=lambda jump: told.append(
                (name, jump.clock_change, jump.delta.nanoseconds)
            ),
        )

    register("change", on_clock_change=True)
    forward = register("forward", min_forward=Duration(seconds=2))
    register("backward", min_backward=Duration(seconds=-2))
    node.set_parameters([Parameter("use_sim_time", Parameter.Type.BOOL, True)])
    assert clock.ros_time_is_active
    assert clock.now().nanoseconds == 0
    assert [one[:2] for one in told] == [
        ("change", "before"),
        ("change", ClockChange.ROS_TIME_ACTIVATED),
    ]

    told.clear()
    publisher = node.create_publisher(Clock, "/clock", 1)
    for second in (5, 6, 3):
        publisher.publish(Clock(clock=TimeMessage(sec=second)))
        rclpy.spin_once(node, timeout_sec=1.0)
        assert clock.now().nanoseconds == second * 10**9
        forward.unregister()
    unchanged = ClockChange.ROS_TIME_NO_CHANGE
    assert told == [
        ("forward", "before", 0),
        ("forward", unchanged, 5 * 10**9),
        ("backward", "before", 6 * 10**9),
        ("backward", unchanged, -3 * 10**9),
    ]

    told.clear()
    node.set_parameters([Parameter("use_sim_time", Parameter.Type.BOOL, False)])
    assert told[-1][:2] == ("change", ClockChange.ROS_TIME_DEACTIVATED)
    assert clock.now().nanoseconds >= 1000 * 10**9


def test_the_lifespan_of_an_endpoint_is_told_to_the_nanosecond(node):
    from rclpy.duration import Duration
    from rclpy.qos import QoSProfile
    from std_msgs.msg import String

    lifespan = Duration(seconds=20, nanoseconds=9887665)
    node.create_publisher(String, "words", QoSProfile(depth=1, lifespan=lifespan))

    (info,) = node.get_publishers_info_by_topic("/words")
    assert info.qos_profile.lifespan == lifespan
    assert info.qos_profile.liveliness.name == "AUTOMATIC"


def test_a_node_names_the_executor_that_took_it_whatever_its_class(node):
    class Own:
        def __init__(self, takes):
            self.takes, self.nodes = takes, []

        def add_node(self, node):
            self.nodes.append(node)
            return self.takes

        def remove_node(self, node):
            self.nodes.remove(node)

    first, refusing = Own(True), Own(False)
    node.executor = first
    assert (node.executor, first.nodes) == (first, [node])
    node.executor = refusing
    assert (node.executor, first.nodes) == (None, [])
    node.executor = None
    assert node.executor is None


def test_a_sleep_on_a_clock_with_a_time_source_ends_at_its_time_or_with_the_source(
    tftool, tmp_path
):
    file = tmp_path / "sleeps.py"
    file.write_text(
        "import threading, time\nimport rclpy\nfrom rclpy.clock import ROSClock\n"
        "from rclpy.duration import Duration\nfrom rclpy.time import Time\n"
        "rclpy.init()\nnode = rclpy.create_node('sleeps')\n"
        "def slept(then):\n    clock, answers = ROSClock(), []\n"
        "    clock._set_ros_time_is_active(True)\n"
        "    work = lambda: answers.append(clock.sleep_for(Duration(seconds=10)))\n"
        "    thread = threading.Thread(target=work)\n    thread.start()\n    time.sleep(20.0)\n"
        "    assert answers == []\n    then(clock)\n    thread.join()\n"
        "    node.get_logger().info(f'slept: {answers}')\n"
        "kind = ROSClock().clock_type\n"
        "slept(lambda clock: clock.set_ros_time_override(Time(seconds=10, clock_type=kind)))\n"
        "slept(lambda clock: clock._set_ros_time_is_active(False))\n"
    )

    run = tftool("run", "--simulated", "--for", "60", str(file))
    assert "[1020.000000000] [sleeps]: slept: [True]" in run.err
    assert "[1040.000000000] [sleeps]: slept: [False]" in run.err


def test_a_throttle_counts_by_the_clock_that_it_is_given(node):
    from rclpy.clock import ROSClock
    from rclpy.time import Time

    clock = ROSClock()
    clock._set_ros_time_is_active(True)

    def passes(second):
        clock.set_ros_time_override(Time(seconds=second, clock_type=clock.clock_type))
        return node.get_logger().info(
            "word", throttle_duration_sec=2.0, throttle_time_source_type=clock
        )

    assert [passes(second) for second in range(6)] == [False, False, True, False, True, False]
