"""Tests of sessions over another middleware than zenoh, which is one class and one line."""

import re
from pathlib import Path

import pytest

import tftool
from tests.world.link.conftest import new_world, until
from tests.world.link.memory import MemoryReach
from tests.world.link.two import play
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES, build
from tftool.messages.codec import codec
from tftool.messages.turtle_messages import Pose, Spawn
from tftool.world.endpoints import PUBLISHER, Quality, conflict
from tftool.world.link import session
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link

pytestmark = pytest.mark.usefixtures("by_memory")

TYPE = "std_msgs/msg/String"
STRING = INTERFACES.message("std_msgs/String")
FIBONACCI = INTERFACES.find("example_interfaces", "action", "Fibonacci")


class Pair:
    """Two worlds that the memory middleware connects."""

    def __enter__(self):
        self.one, self.other = new_world(), new_world()
        self.links = [Link(Options(name, reach=MemoryReach())) for name in ("one", "other")]
        self.links[0].attach(self.one, role=Role.HOST)
        self.links[1].attach(self.other, role=Role.GUEST)
        return self

    def __exit__(self, *error):
        for link in self.links:
            link.close()


async def turns_of_the_loop(count=10):
    """Run the loop's pending callbacks, and their follow-up callbacks."""
    left = iter(range(count))
    await until(lambda: next(left) == count - 1)


def test_transforms_and_topics_cross_whatever_carries_them():
    async def cross():
        with Pair() as pair:
            pair.one.broadcast([TransformStamped(5, "a", "b", Transform((1.0, 0.0, 0.0)))], "node")
            fixed = TransformStamped(0, "b", "c", Transform((2.0, 0.0, 0.0)))
            pair.one.broadcast([fixed], "node", static=True)
            await until(lambda: pair.other.buffer.can_transform("a", "c", 5))

            heard = []
            pair.other.topic("turtle1/pose", Pose).subscribe(heard.append)
            pose = build(Pose, 1.0, 2.0, 0.5)
            topic = pair.one.topic("turtle1/pose", Pose)
            await until(lambda: topic.subscribers)
            topic.publish(pose)
            await until(lambda: heard)
            assert heard == [pose]

    play(cross())


def test_a_message_that_comes_with_the_word_of_its_publisher_names_it():
    async def send():
        with Pair() as pair:
            topic = pair.other.topic("chatter", STRING)
            senders = []
            topic.subscribe(lambda message: senders.append(topic.sender))
            await until(lambda: pair.links[0].graph.entities("subscription", name="chatter"))

            await turns_of_the_loop()

            # Both messages are received one after the other, before the world is updated.
            outlet = pair.links[0].middleware.publisher("talker", "chatter", TYPE, Quality(3))
            outlet.put(codec(STRING).encode(STRING(data="first")), 1)
            await until(lambda: senders)

            (sender,) = senders
            assert (sender.node, sender.quality, sender.is_remote) == ("talker", Quality(3), True)
            await until(lambda: pair.other.endpoints.of("chatter", PUBLISHER))
            assert pair.other.endpoints.of("chatter", PUBLISHER) == [sender]

    play(send())


def test_a_message_that_overtakes_its_publishers_announcement_is_from_elsewhere():
    async def send():
        with Pair() as pair:
            topic = pair.other.topic("chatter", STRING)
            senders = []
            topic.subscribe(lambda message: senders.append(topic.sender))
            await until(lambda: pair.links[0].graph.entities("subscription", name="chatter"))

            outlet = pair.links[0].middleware.publisher("talker", "chatter", TYPE, Quality(3))
            outlet.hide()
            outlet.put(codec(STRING).encode(STRING(data="first")), 1)
            await until(lambda: senders)

            (sender,) = senders
            assert sender.node == f"publisher_{outlet.entity.gid[:4].hex()}"
            assert (sender.topic, sender.interface, sender.is_remote) == ("chatter", TYPE, True)
            # All subscriptions receive the message, because the publisher's quality is unknown and
            # may fit.
            for asked in (Quality(), Quality(is_latched=True), Quality(is_reliable=False)):
                assert conflict(sender.quality, asked) == ""

    play(send())


def test_services_and_actions_answer_whatever_carries_them():
    async def ask():
        with Pair() as pair:
            pair.one.serve("spawn", lambda request: build(Spawn.Response, request.name), Spawn)
            await until(lambda: "spawn" in pair.other.services())
            answer = await pair.other.call("spawn", build(Spawn.Request, 1.0, 1.0, 0.0, "turtle9"))
            assert answer == build(Spawn.Response, "turtle9")

            goals = []
            pair.one.serve_action("count", goals.append, FIBONACCI)
            await until(lambda: "count" in pair.other.actions())
            fed = []
            goal = pair.other.send_goal("count", FIBONACCI.Goal(order=3), fed.append)
            await until(lambda: goals)
            goals[0].publish_feedback(FIBONACCI.Feedback(sequence=[1]))
            goals[0].finish("succeeded", FIBONACCI.Result(sequence=[1, 2]))
            ended = await goal.result()
            assert (ended.status, list(ended.value.sequence)) == ("succeeded", [1, 2])
            assert [list(one.sequence) for one in fed] == [[1]]

    play(ask())


def test_a_process_is_in_the_graph_until_its_link_closes_over_another_middleware():
    async def come_and_go():
        with Pair() as pair:
            assert [str(one.role) for one in pair.links[1].graph.processes()] == ["host"]
            pair.links[0].close()
            await until(lambda: pair.links[1].graph.is_empty)

    play(come_and_go())


def test_the_table_alone_names_dds_outside_its_folder():
    package = Path(tftool.__file__).parent
    named = re.compile(r"\bdds\b|dds_", re.IGNORECASE)
    # zenoh's keys write names of types as DDS does.
    apart = ("link/dds", "link/zenoh/keys.py")
    found = {
        path.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if not any(one in path.as_posix() for one in apart)
        and named.search(path.read_text(encoding="utf-8"))
    }
    assert found == {"world/link/link_options.py"}


def test_nothing_of_the_link_but_its_own_folder_and_the_table_knows_zenoh():
    folder = Path(session.__file__).parent
    knowing = {
        path.name
        for path in folder.glob("*.py")
        if "link.zenoh" in path.read_text(encoding="utf-8")
    }
    assert knowing == {"link_options.py"}
