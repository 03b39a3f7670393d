"""Tests of `use_sim_time` where a run has the time of the machine."""

import pytest

SIMULATOR = """
import threading, time
import rclpy
from builtin_interfaces.msg import Time as Stamp
from rclpy.clock import Clock, ClockChange, JumpThreshold
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.time import Time
from rosgraph_msgs.msg import Clock as ClockMessage

rclpy.init()
simulator = rclpy.create_node("simulator")
publisher = simulator.create_publisher(ClockMessage, "/clock", 10)
spinner = SingleThreadedExecutor()

def with_time(name, value=True):
    node = rclpy.create_node(name, parameter_overrides=[Parameter("use_sim_time", value=value)])
    spinner.add_node(node)
    return node

def spin_until(condition):
    while not condition():
        spinner.spin_once(0.1)

def reading(node):
    return node.get_clock().now().nanoseconds / 1e9

def send(second, node):
    nanosec = round(second % 1 * 1e9)
    publisher.publish(ClockMessage(clock=Stamp(sec=int(second), nanosec=nanosec)))
    spin_until(lambda: reading(node) == second)

def is_machine_time(moment):
    return abs(moment - Clock().now().nanoseconds / 1e9) < 60.0
"""


@pytest.fixture
def printed(tftool, tmp_path):
    """Return a function that runs code beside a simulator, and returns what it prints."""

    def run(code, *words, options=("--host",)):
        file = tmp_path / "simulated.py"
        file.write_text(SIMULATOR + code)
        result = tftool("run", *options, str(file), *words)
        assert result.status == 0, result.err
        return result.out.splitlines(), result.err

    return run


def test_a_node_with_use_sim_time_has_the_time_of_the_last_message_on_clock(printed):
    out, _ = printed("""
node, other, calls = with_time("node"), with_time("other", False), []
node.create_timer(1.0, lambda: calls.append(reading(node)))
print(reading(node), node.get_clock().ros_time_is_active)
print(is_machine_time(reading(other)), other.get_clock().ros_time_is_active)
for second in (100.5, 100.75, 101.25, 50.0):
    send(second, node)
    for _ in range(3):
        spinner.spin_once(0.0)
print(reading(node), calls)
print(is_machine_time(reading(other)), is_machine_time(time.time()))
""")

    assert out == [
        "0.0 True",
        "True False",
        "50.0 [100.5, 101.25]",
        "True True",
    ]


def test_use_sim_time_can_be_switched_later(printed):
    out, _ = printed("""
node, jumps = with_time("node", False), []
clock = node.get_clock()
clock.create_jump_callback(
    JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1)),
    post_callback=lambda jump: jumps.append((jump.clock_change.name, jump.delta.nanoseconds)),
)
node.set_parameters([Parameter("use_sim_time", value=True)])
print(reading(node), clock.ros_time_is_active, len(list(node.subscriptions)))
send(20.0, node)
send(12.0, node)
node.set_parameters([Parameter("use_sim_time", value=False)])
print(is_machine_time(reading(node)), clock.ros_time_is_active, len(list(node.subscriptions)))
print(jumps)
print(node.set_parameters([Parameter("use_sim_time", value=7)])[0].successful)
""")

    assert out == [
        "0.0 True 1",
        "True False 0",
        "[('ROS_TIME_ACTIVATED', 0), ('ROS_TIME_NO_CHANGE', -8000000000), "
        "('ROS_TIME_DEACTIVATED', 0)]",
        "False",
    ]


def test_sleeps_and_rates_of_a_node_follow_clock(printed):
    out, _ = printed("""
node, woken = with_time("node"), []
send(10.0, node)
rate = node.create_rate(2.0)
def sleep():
    time.sleep(0.001)
    node.get_clock().sleep_until(Time(seconds=11, clock_type=node.get_clock().clock_type))
    woken.append(reading(node))
    for _ in range(5):
        rate.sleep()
        woken.append(reading(node))
thread = threading.Thread(target=sleep)
thread.start()
second = 10.0
while thread.is_alive():
    spinner.spin_once(0.02)
    second += 0.5
    send(second, node)
# On a busy machine the thread reads the clock late. The next two sleeps may then be over at that
# time already, but not a third: each sleep takes one tick at least, and ticks are 0.5 s apart.
later = [late - early for early, late in zip(woken[1:], woken[4:])]
print(woken[0] >= 11.0, min(later) >= 0.5, len(woken))
""")

    assert out == ["True True 6"]


@pytest.mark.parametrize("words", [("-p", "use_sim_time:=true"), ("--params-file", "given.yaml")])
def test_use_sim_time_can_be_given_to_run(printed, tmp_path, monkeypatch, words):
    (tmp_path / "given.yaml").write_text("/**:\n  ros__parameters:\n    use_sim_time: true\n")
    monkeypatch.chdir(tmp_path)
    out, _ = printed("print(reading(simulator))\n", "--ros-args", *words)

    assert out == ["0.0"]


@pytest.mark.parametrize(
    "actions",
    [
        "SetParameter('use_sim_time', True), Node(executable=here)",
        "SetUseSimTime(True), Node(executable=here)",
        "Node(executable=here, parameters=[{'use_sim_time': True}])",
        "Node(executable=here, arguments=['--ros-args', '-p', 'use_sim_time:=true'])",
    ],
)
def test_use_sim_time_can_be_given_by_a_launch(tftool, tmp_path, actions):
    (tmp_path / "told.py").write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('told')\n"
        "print(f'begins at {node.get_clock().now().nanoseconds}')\n"
    )
    file = tmp_path / "told.launch.py"
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch_ros.actions import Node, SetParameter, SetUseSimTime\n"
        "def generate_launch_description():\n"
        f"    here = {str(tmp_path / 'told.py')!r}\n"
        f"    return LaunchDescription([{actions}])\n"
    )

    run = tftool("launch", "--host", str(file))
    assert "begins at 0\n" in run.out + run.err


def test_nodes_of_tftool_follow_clock_too(printed):
    robot = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'>"
    robot += "<parent link='a'/><child link='b'/></joint></robot>"
    out, err = printed(f"""
from launch import LaunchDescription, LaunchService
from launch_ros.actions import Node
from sensor_msgs.msg import JointState

stamps = []
spinner.add_node(simulator)
keep = lambda message: stamps.append(message.header.stamp)
simulator.create_subscription(JointState, "joint_states", keep, 10)
launched = Node(
    package="joint_state_publisher",
    executable="joint_state_publisher",
    parameters=[{{"use_sim_time": True, "robot_description": "{robot}", "rate": 2.0}}],
)
service = LaunchService()
service.include_launch_description(LaunchDescription([launched]))
thread = threading.Thread(target=service.run)
thread.start()
second = 50.0
while len(stamps) < 3:
    second += 0.5
    publisher.publish(ClockMessage(clock=Stamp(sec=int(second), nanosec=round(second % 1 * 1e9))))
    spinner.spin_once(0.1)
print(all(50 <= one.sec <= second for one in stamps))
service.shutdown()
thread.join()
""")

    assert out == ["True"]
    assert "behind its own timer" not in err


ALONE = """
for name in ("first", "second"):
    rclpy.create_node(name, parameter_overrides=[Parameter("use_sim_time", value=True)])
simulator.destroy_publisher(publisher)
time.sleep(3.0)
print(reading(simulator))
"""


def test_nodes_that_wait_for_clock_in_vain_are_warned_about_once(printed):
    _, err = printed(ALONE)
    assert err.count("no node publishes /clock") == 1


def test_a_publisher_of_clock_needs_no_warning(printed):
    _, err = printed(ALONE.replace("simulator.destroy_publisher(publisher)\n", ""))
    assert "no node publishes /clock" not in err


@pytest.mark.parametrize("options", [("--simulated", "--for", "9"), ("--in", "robot", "--host")])
def test_where_the_world_is_a_simulation_use_sim_time_changes_nothing(printed, options):
    code = ALONE.replace("time.sleep(3.0)", "time.sleep(2.5)")
    code = code.replace("simulator)", "with_time('third'))")
    out, err = printed(code, options=options)

    assert float(out[0]) > 1000.0
    assert "/clock" not in err


LOOKUPS = """
from geometry_msgs.msg import TransformStamped
from rclpy.time import Time
from tf2_ros import Buffer, TransformBroadcaster, TransformListener

node, buffer = with_time("node", {value}), Buffer()
listener = TransformListener(buffer, node)

def transform(second):
    sent = TransformStamped(child_frame_id="b")
    sent.header.frame_id, sent.header.stamp = "a", Stamp(sec=second)
    TransformBroadcaster(simulator).sendTransform(sent)

transform(30)
print(buffer.can_transform("a", "b", Time()))
buffer.lookup_transform("a", "b", Time())
"""


@pytest.mark.parametrize(("value", "told"), [(False, 1), (True, 0)])
def test_lookups_beside_a_clock_that_the_nodes_ignore_are_warned_about_once(printed, value, told):
    out, err = printed(LOOKUPS.format(value=value))

    assert out == ["True"]
    assert err.count("set use_sim_time, as with --ros-args -p use_sim_time:=true") == told


def test_a_buffer_is_cleared_where_the_time_on_clock_falls_back(printed):
    out, err = printed(
        LOOKUPS.format(value=True)
        + "send(30.0, node)\ntransform(30)\nsend(25.0, node)\ntransform(25)\n"
        + "print([buffer.can_transform('a', 'b', Time(seconds=one)) for one in (30, 25)])\n"
    )

    assert out[-1] == "[False, True]"
    assert err.count("Detected jump back in time. Clearing tf buffer.") == 1


def test_a_shutdown_ends_a_sleep_on_a_clock_that_stands_still(printed):
    out, _ = printed("""
node, answers = with_time("node"), []
def sleep():
    answers.append(node.get_clock().sleep_for(Duration(seconds=1)))
thread = threading.Thread(target=sleep)
thread.start()
time.sleep(0.2)
rclpy.shutdown()
thread.join()
print(answers)
""")

    assert out == ["[False]"]
