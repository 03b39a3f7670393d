"""Tests of the recording of a session by a guest: the received bytes, and their senders."""

import pytest

from tests.world.link.conftest import until
from tests.world.link.memory import MemoryReach
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES
from tftool.messages.transforms import decode_transforms
from tftool.world.clock import WallClock, run
from tftool.world.endpoints import Quality
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.nodes.recorder import Recorder
from tftool.world.world import World

pytestmark = pytest.mark.usefixtures("by_memory")

TEXT = INTERFACES.message("std_msgs/String")


class Taken:
    """Writer that stores its messages."""

    def __init__(self):
        self.messages = []

    def take(self, channel, log_time, payload, transforms=0):
        self.messages.append((channel, payload, transforms))

    def of(self, topic):
        return [one for one in self.messages if one[0].topic == topic]


def sample(stamp, parent, child, rotation=(0.0, 0.0, 0.0, 1.0)):
    return TransformStamped(stamp, parent, child, Transform((1.0, 2.0, 3.0), rotation))


def test_a_guest_records_statics_sent_before_it_came_and_topics_that_come_up_later():
    async def session():
        host, guest = World(WallClock()), World(WallClock())
        links = [Link(Options(name, reach=MemoryReach())) for name in ("demo", "record")]
        links[0].attach(host, role=Role.HOST)
        host.broadcast([sample(0, "base", "laser")], "mounts", static=True)
        links[1].attach(guest, role=Role.GUEST)
        taken = Taken()
        recorder = Recorder(guest, taken, link=links[1], names=["notes", "never"])
        try:
            await until(lambda: taken.of("/tf_static"))
            host.broadcast([sample(seconds(5), "odom", "base")], "driver")
            await until(lambda: taken.of("/tf"))

            assert recorder.missing == ["never", "notes"]
            publisher = host.publisher("writer", "notes", TEXT, Quality(is_latched=True))
            words = TEXT()
            words.data = "words"
            publisher.publish(words)

            def heard():
                recorder.refresh()
                return taken.of("/notes")

            await until(heard)
        finally:
            recorder.close()
            for link in links:
                link.close()
        return taken, recorder

    taken, recorder = run(WallClock(), session())

    (static, payload, count), *_ = taken.of("/tf_static")
    assert decode_transforms(payload) == (sample(0, "base", "laser"),)
    assert (static.extra("callerid"), count) == ("/mounts", 1)
    (moving, payload, count), *_ = taken.of("/tf")
    assert decode_transforms(payload) == (sample(seconds(5), "odom", "base"),)
    assert (moving.extra("callerid"), count) == ("/driver", 1)
    assert [one[0].type for one in taken.of("/notes")] == ["std_msgs/msg/String"]
    assert recorder.missing == ["never"]
