"""A server of another library: foxglove-sdk's, in this process, on a free local port."""

import contextlib
import itertools
import threading
import time

import pytest

from tests.world.link.conftest import new_world
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import encode_transforms
from tftool.world.link.foxglove.reach import FoxgloveReach
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.link.session_world import shared
from tftool.world.world import World

foxglove = pytest.importorskip("foxglove", reason="pip install foxglove-sdk")

TF = "tf2_msgs/msg/TFMessage"


def transform(parent, child, stamp=1, x=1.0):
    return TransformStamped(stamp, parent, child, Transform((x, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0)))


class Robot(foxglove.websocket.ServerListener):
    """Server that stores messages for late subscribers, as foxglove_bridge does."""

    def __init__(self, port=0, capabilities=None, **options):
        self.context = foxglove.Context()
        self.kept = {}
        self.subscribed = []
        self.channels = {}
        self.lock = threading.Lock()
        self.server = foxglove.start_server(
            host="127.0.0.1",
            port=port,
            name="bridge",
            server_listener=self,
            context=self.context,
            capabilities=capabilities,
            **options,
        )
        self.port = self.server.port
        self.address = f"ws://127.0.0.1:{self.port}"

    def on_subscribe(self, client, channel):
        # The SDK calls this a moment before messages of the channel reach the client.
        threading.Thread(target=self.subscribe, args=(channel.id,), daemon=True).start()

    def subscribe(self, number):
        for _ in range(10_000):
            if number in self.channels and self.channels[number].has_sinks():
                break
            time.sleep(0.001)  # noqa: TID251
        topic = self.channels[number].topic()
        with self.lock:
            self.subscribed.append(topic)
            for channel, payload in self.kept.get(topic, ()):
                channel.log(payload)

    def topic(self, name, ros_type=TF, *, encoding="cdr", definition="", schema_encoding="ros2msg"):
        schema = foxglove.Schema(name=ros_type, encoding=schema_encoding, data=definition.encode())
        return self.offer(
            foxglove.Channel(name, message_encoding=encoding, schema=schema, context=self.context)
        )

    def offer(self, channel):
        self.channels[channel.id()] = channel
        return channel

    def keep(self, topic, payload):
        # A client may subscribe before or after this line; either way it gets the message once.
        with self.lock:
            self.kept.setdefault(topic.topic(), []).append((topic, payload))
            if topic.topic() in self.subscribed:
                topic.log(payload)

    def stop(self):
        self.server.stop()


@pytest.fixture
def robots():
    """Return a function that starts servers, which all stop at the end of the test."""
    started = []

    def start(**options):
        started.append(Robot(**options))
        return started[-1]

    yield start
    for one in started:
        one.stop()


@pytest.fixture
def moving(robots):
    """Start a robot whose base moves along x in odom by a millimetre per 10 ms, with a laser."""
    robot = robots()
    statics = robot.topic("/tf_static")
    robot.keep(statics, encode_transforms([transform("base", "laser", 0, 0.5)]))
    tf = robot.topic("/tf")
    ended = threading.Event()

    def move():
        for number in itertools.count():
            sample = transform("odom", "base", time.time_ns(), number * 0.001)
            tf.log(encode_transforms([sample]))
            if ended.wait(0.01):
                return

    thread = threading.Thread(target=move)
    thread.start()
    yield robot
    ended.set()
    thread.join()


@contextlib.contextmanager
def joined(address, clock=None):
    """Yield a world that reads a robot; a followed clock is set to the robot's time."""
    world = new_world() if clock is None else World(clock)
    link = Link(Options("test", 0, FoxgloveReach(address), read_only=True))
    with link, shared(link, world, Role.GUEST):
        yield world, link
