"""Tests of whole files in different styles; each logs what it would log in ROS 2."""

import pytest

COMPOSED = """
#!/usr/bin/env python3
import math, time
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from tf2_ros import Buffer, LookupException, TransformBroadcaster, TransformListener

class Wheel(Node):
    def __init__(self):
        super().__init__('wheel')
        self.world = 'base'
        self.br = TransformBroadcaster(self)
        self.t0 = time.time()
        self.timer = self.create_timer(0.1, self.tick)
        self.srv = self.create_service(Trigger, 'brake', self.brake)

    def tick(self):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = self.world
        t.child_frame_id = 'rim'
        t.transform.translation.x = time.time() - self.t0
        self.br.sendTransform(t)

    def brake(self, request, response):
        self.timer.cancel()
        time.sleep(0.2)
        response.success, response.message = True, 'stands'
        return response

class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.group = ReentrantCallbackGroup()
        self.buffer = Buffer()
        TransformListener(self.buffer, self, spin_thread=True)
        self.client = self.create_client(Trigger, 'brake', callback_group=self.group)
        self.create_timer(1.0, self.look, callback_group=self.group)

    def look(self):
        try:
            t = self.buffer.lookup_transform('base', 'rim', rclpy.time.Time())
        except LookupException as ex:
            self.get_logger().error(f'{ex}')
            return
        self.get_logger().info('rim at %.1f' % t.transform.translation.x)
        if t.transform.translation.x > 1.5:
            answer = self.client.call(Trigger.Request())
            self.get_logger().fatal(answer.message)
            raise ExternalShutdownException()

def main(args=None):
    rclpy.init(args=args)
    executor = MultiThreadedExecutor(num_threads=3)
    nodes = [Wheel(), Driver()]
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        for node in nodes:
            node.destroy_node()
        rclpy.try_shutdown()

if __name__ == '__main__':
    main()
"""

SCRIPT = """
import threading
import rclpy
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node('counter')
thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
thread.start()
heard = []
node.create_subscription(Int32, 'count', lambda m: heard.append(m.data), 10)
publisher = node.create_publisher(Int32, 'count', 10)
rate = node.create_rate(2)
try:
    for number in range(4):
        publisher.publish(Int32(data=number))
        rate.sleep()
except KeyboardInterrupt:
    pass
node.get_logger().info(f'{heard} after {len(heard) / 2:g} s')
rclpy.shutdown()
thread.join()
"""

AWAITING = """
import rclpy
from rclpy.node import Node
from turtlesim.srv import Spawn, TeleportAbsolute

class Mover(Node):
    def __init__(self):
        super().__init__('mover')
        self.spawn = self.create_client(Spawn, 'spawn')
        while not self.spawn.wait_for_service(timeout_sec=1.0):
            self.get_logger().info('nobody spawns yet', once=True)
        self.timer = self.create_timer(0.5, self.move)

    async def move(self):
        self.timer.cancel()
        turtle = await self.spawn.call_async(Spawn.Request(x=1.0, y=1.0, name='bob'))
        teleport = self.create_client(TeleportAbsolute, f'{turtle.name}/teleport_absolute')
        await teleport.call_async(TeleportAbsolute.Request(x=2.0, y=3.0))
        self.get_logger().info(f'{turtle.name} was moved')
        raise SystemExit(3)

with rclpy.init():
    rclpy.spin(Mover())
"""

POLLING = """
import sys
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data
from rclpy.wait_for_message import wait_for_message
from turtlesim.msg import Pose

def main():
    try:
        with rclpy.init(args=sys.argv):
            node = rclpy.create_node('poller', parameter_overrides=[
                rclpy.Parameter('seconds', Parameter.Type.DOUBLE, 2.5)])
            limit = node.declare_parameter('seconds', 5.0).get_parameter_value().double_value
            seen = []
            node.create_subscription(Pose, '/turtle1/pose', seen.append, qos_profile_sensor_data)
            end = node.get_clock().now() + rclpy.duration.Duration(seconds=limit)
            while rclpy.ok() and node.get_clock().now() < end:
                rclpy.spin_once(node, timeout_sec=0.1)
            node.get_logger().info(f'{len(seen) // 10} tens of poses')
            found, pose = wait_for_message(Pose, node, 'turtle1/pose', time_to_wait=1)
            node.get_logger().info(f'{found} {pose.x:.2f}')
            raise ExternalShutdownException()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass

main()
"""


@pytest.mark.parametrize(
    ("text", "status", "said"),
    [
        (
            COMPOSED,
            0,
            ["INFO rim at 1.0", "INFO rim at 2.0", "FATAL stands"],
        ),
        (SCRIPT, 0, ["INFO [0, 1, 2, 3] after 2 s"]),
        (AWAITING, 3, ["INFO nobody spawns yet", "INFO bob was moved"]),
        (POLLING, 0, ["INFO 6 tens of poses", "INFO True 5.54"]),
    ],
)
def test_a_file_runs_as_it_is_written(ros_runtime, tmp_path, text, status, said):
    from tftool.world.nodes.turtlesim import Turtlesim

    file = tmp_path / "node.py"
    file.write_text(text)
    ended = []
    program = ros_runtime.start(file, on_exit=ended.append)
    ros_runtime.sleep(1.5)
    ros_runtime.ask(lambda: Turtlesim(ros_runtime.world, "turtlesim") and None)
    ros_runtime.sleep(10.0)
    lines = [
        f"{record.level} {record.text}"
        for record in ros_runtime.world.log.records
        if record.node != "turtlesim"
    ]

    assert ended == [program]
    assert program.status == status
    assert lines == said


RASH = """
import rclpy
rclpy.init()
node = rclpy.create_node('rash')
def tick():
    raise KeyboardInterrupt
node.create_timer(0.1, tick)
rclpy.spin(node)
"""


def test_a_callback_that_raises_keyboard_interrupt_is_the_programs_failure(ros_runtime, tmp_path):
    file = tmp_path / "rash.py"
    file.write_text(RASH)

    program = ros_runtime.start(file, on_exit=lambda _: None)
    ros_runtime.sleep(1.0)

    assert program.status == 1
    assert isinstance(program.failure, KeyboardInterrupt)


UNCALLED = """
import rclpy
from rclpy.node import Node
from rclpy.time import Duration, Time


def main():
    rclpy.init()
    node = Node('shy')
    then = Time(seconds=7) - Duration(seconds=5.0)
    node.get_logger().info(f'called, {then.nanoseconds}')
"""


def test_a_file_made_for_a_console_script_has_its_main_called(ros_runtime, tmp_path):
    file = tmp_path / "listing.py"
    file.write_text(UNCALLED)

    program = ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    assert ros_runtime.log("shy") == ["called, 2000000000"]
    assert program.status == 0


@pytest.mark.parametrize("more", ["main()\n", "rclpy.init()\n"])
def test_a_main_is_not_called_where_the_file_has_come_to_rclpy(ros_runtime, tmp_path, more):
    file = tmp_path / "script.py"
    file.write_text(UNCALLED + more)

    ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    assert len(ros_runtime.log("shy")) == more.count("main")


def test_a_main_that_the_file_calls_itself_is_called_once(ros_runtime, tmp_path):
    file, told = tmp_path / "script.py", tmp_path / "told"
    file.write_text(
        "import pathlib\n"
        f"def main():\n    with pathlib.Path({str(told)!r}).open('a') as file:\n"
        "        file.write('called ')\n"
        "if __name__ == '__main__':\n    main()\n"
    )

    program = ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    assert told.read_text() == "called "
    assert program.status == 0


def test_a_file_that_makes_no_node_says_so(ros_runtime, tmp_path):
    file = tmp_path / "nothing.py"
    file.write_text("from math import pi as main\n")

    program = ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    assert ros_runtime.log(program.name) == [
        "'nothing.py' has ended without calling rclpy.init(), so it ran no node: "
        "call rclpy.init() and spin a node"
    ]
    assert program.status == 0
