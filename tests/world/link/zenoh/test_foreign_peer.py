"""Tests with an independent implementation of ROS 2 over zenoh as the other end."""

import asyncio
import json
import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from tests.messages.definitions import SERVICES
from tests.patience import PATIENCE
from tests.world.link.conftest import new_world, until
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES
from tftool.world.clock import WallClock, run
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.link.zenoh.reach import ZenohReach
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live

pytest.importorskip("zenoh_ros2_sdk", reason="zenoh-ros2-sdk, of the extra 'test', is missing")

STRING = INTERFACES.message("std_msgs/String")
HERE = Path(__file__).parent

DEFINITIONS = {
    "builtin_interfaces/msg/Time.msg": "int32 sec\nuint32 nanosec\n",
    "std_msgs/msg/Header.msg": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "geometry_msgs/msg/Vector3.msg": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Quaternion.msg": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
    "geometry_msgs/msg/Transform.msg": "Vector3 translation\nQuaternion rotation\n",
    "geometry_msgs/msg/TransformStamped.msg": (
        "std_msgs/Header header\nstring child_frame_id\nTransform transform\n"
    ),
    "geometry_msgs/msg/Twist.msg": "Vector3 linear\nVector3 angular\n",
    "tf2_msgs/msg/TFMessage.msg": "geometry_msgs/TransformStamped[] transforms\n",
    "service_msgs/msg/ServiceEventInfo.msg": (
        "uint8 event_type\nbuiltin_interfaces/Time stamp\nchar[16] client_gid\n"
        "int64 sequence_number\n"
    ),
    "std_msgs/msg/String.msg": "string data\n",
    "rosgraph_msgs/msg/Clock.msg": "builtin_interfaces/Time clock\n",
    "sensor_msgs/msg/LaserScan.msg": (
        "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
        "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
        "float32[] ranges\nfloat32[] intensities\n"
    ),
    "rcl_interfaces/msg/ParameterValue.msg": (
        "uint8 type\nbool bool_value\nint64 integer_value\nfloat64 double_value\n"
        "string string_value\nbyte[] byte_array_value\nbool[] bool_array_value\n"
        "int64[] integer_array_value\nfloat64[] double_array_value\nstring[] string_array_value\n"
    ),
    "rcl_interfaces/msg/Parameter.msg": "string name\nParameterValue value\n",
    "rcl_interfaces/msg/SetParametersResult.msg": "bool successful\nstring reason\n",
    "rcl_interfaces/srv/GetParameters.srv": (
        "string[] names\n---\nrcl_interfaces/ParameterValue[] values\n"
    ),
    "rcl_interfaces/srv/SetParameters.srv": (
        "rcl_interfaces/Parameter[] parameters\n---\nrcl_interfaces/SetParametersResult[] results\n"
    ),
    "turtlesim/srv/Spawn.srv": "\n---\n".join(SERVICES["turtlesim/srv/Spawn"]) + "\n",
}


def definitions(folder):
    for name, text in DEFINITIONS.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


class Foreign:
    """The other implementation, in a separate process."""

    def __init__(self, port, folder, program="sdk_peer.py"):
        self.said = []
        self._heard = threading.Condition()
        self._silent = False
        self.process = subprocess.Popen(
            [sys.executable, str(HERE / program), str(port), str(definitions(folder))],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "GIT_PYTHON_REFRESH": "quiet"},
        )
        self.errors = []
        self._threads = [
            threading.Thread(target=self._read, daemon=True),
            threading.Thread(target=self._read_errors, daemon=True),
        ]
        for thread in self._threads:
            thread.start()

    def _read(self):
        for line in self.process.stdout:
            if line.startswith("{"):
                with self._heard:
                    self.said.append(json.loads(line))
                    self._heard.notify_all()
        with self._heard:
            self._silent = True
            self._heard.notify_all()

    def _read_errors(self):
        self.errors.extend(self.process.stderr)

    def with_key(self, key, **fields):
        return [
            one
            for one in self.said
            if key in one and all(one.get(name) == value for name, value in fields.items())
        ]

    def until(self, condition):
        """Check `condition()` after each line of the peer, until it is true or the peer ends."""
        with self._heard:
            self._heard.wait_for(lambda: condition() or self._silent, PATIENCE)
        assert not self._silent or self.check()
        return condition()

    def check(self):
        if self.process.poll() is not None:
            raise AssertionError(f"the foreign peer ended: {''.join(self.errors)[-2000:]}")
        return True

    def close(self):
        self.process.kill()
        self.process.wait()
        for thread in self._threads:
            thread.join(PATIENCE)
        self.process.stdout.close()
        self.process.stderr.close()


def test_a_foreign_ros_2_peer_hears_us_and_is_heard(tmp_path):
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]

    async def meet():
        with Link(Options("demo", reach=ZenohReach(listen=(f"tcp/127.0.0.1:{port}",)))) as link:
            world = new_world()
            simulator = Turtlesim(world)
            link.attach(world, role=Role.HOST)
            living = asyncio.ensure_future(live(world))
            # The transform is sent before the peer joins, so it must be sent again later.
            static = TransformStamped(0, "world", "fixed", Transform((4.5, 0.0, 0.0)))
            world.broadcast([static], "static_publisher", static=True)
            foreign = Foreign(port, tmp_path)
            try:
                # The peer's transforms arrive in tftool's buffer, under the name of the peer's
                # node.
                await until(lambda: foreign.check() and world.buffer.frame_exists("foreign"))
                found = world.buffer.lookup_transform("world", "foreign")
                assert found.transform.translation == (1.5, -2.5, 3.5)
                assert found.transform.rotation == pytest.approx((0.0, 0.0, 0.6, 0.8))
                info = world.buffer.snapshot(world.clock.now()).frame("foreign")
                assert info.authority == "foreign_broadcaster"

                # tftool's transforms arrive at the peer, also static ones sent earlier.
                def ours():
                    stamp = world.clock.now()
                    mine = TransformStamped(stamp, "world", "ours", Transform((0.25, 0.0, 0.0)))
                    world.broadcast([mine], "broadcaster")
                    return foreign.check() and foreign.with_key("topic", child="ours", x=0.25)

                await until(ours)
                await until(lambda: foreign.check() and foreign.with_key("topic", child="fixed"))
                assert foreign.with_key("topic", child="fixed")[0] == {
                    "topic": "tf_static", "parent": "world", "child": "fixed", "x": 4.5, "w": 1.0,
                }  # fmt: skip

                # The peer's Twist drives the turtle.
                await until(lambda: simulator.turtles["turtle1"].pose.linear_velocity == 1.0)
                assert simulator.turtles["turtle1"].pose.angular_velocity == 0.5

                # The peer sees tftool's graph, and a service of tftool responds to the peer.
                await until(lambda: foreign.check() and foreign.with_key("topics"))
                (graph,) = foreign.with_key("topics")
                assert graph["topics"]["/turtle1/pose"] == ["turtlesim/msg/Pose"]
                assert graph["services"]["/spawn"] == ["turtlesim/srv/Spawn"]
                await until(lambda: foreign.check() and foreign.with_key("spawned"))
                assert foreign.with_key("spawned") == [{"spawned": "sdk_turtle"}]
                assert "sdk_turtle" in simulator.turtles
                assert {one.node for one in link.graph.entities("publisher", name="tf")} == {
                    "foreign_broadcaster"
                }

                # Messages of a user's type arrive in both directions.
                heard = []
                world.topic("words", STRING).subscribe(heard.append)

                def said():
                    world.topic("chatter", STRING).publish(STRING(data="Hello ☺"))
                    return foreign.check() and heard and foreign.with_key("chatter")

                await until(said)
                assert heard[0] == STRING(data="größe")
                assert foreign.with_key("chatter")[0] == {"chatter": "Hello ☺"}
                assert foreign.with_key("topics")[0]["topics"]["/tf"] == ["tf2_msgs/msg/TFMessage"]

                # The peer sets and reads the simulator's parameters; an invalid value is refused.
                await until(lambda: foreign.check() and foreign.with_key("parameters"))
                accepted, refused = foreign.with_key("set")
                assert accepted == {"set": 255, "successful": True, "reason": ""}
                assert refused["successful"] is False
                assert "from 0 to 255, not 256" in refused["reason"]
                assert foreign.with_key("parameters") == [{"parameters": [[2, 255], [1, 0]]}]
                assert simulator.background.r == 255
                assert link.refused == 0
            finally:
                living.cancel()
                await asyncio.gather(living, return_exceptions=True)
                foreign.close()

    run(WallClock(), asyncio.wait_for(meet(), 2 * PATIENCE))
