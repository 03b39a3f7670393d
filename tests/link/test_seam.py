"""The link over another middleware than zenoh: a class and one line are enough."""

from pathlib import Path

import pytest

from tests.link import memory
from tests.link.conftest import new_world, until
from tests.link.test_session import play
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.interfaces.classes import INTERFACES
from tftool.link import session
from tftool.link.graph import Role
from tftool.link.options import Options
from tftool.link.seam import MIDDLEWARES
from tftool.link.session import Link
from tftool.messages import Pose2D, Spawn, Spawned

FIBONACCI = INTERFACES.find("example_interfaces", "action", "Fibonacci")


class Pair:
    """Two worlds, linked by what is in memory."""

    def __enter__(self):
        self.one, self.other = new_world(), new_world()
        self.links = [Link(Options(name, middleware="memory")) for name in ("one", "other")]
        self.links[0].attach(self.one, role=Role.HOST)
        self.links[1].attach(self.other, role=Role.GUEST)
        return self

    def __exit__(self, *error):
        for link in self.links:
            link.close()


@pytest.fixture(autouse=True)
def _by_memory(monkeypatch):
    monkeypatch.setitem(MIDDLEWARES, "memory", f"{memory.__name__}:MemoryMiddleware")
    monkeypatch.setattr(memory.MemoryMiddleware, "members", [])


def test_transforms_and_topics_cross_whatever_carries_them():
    async def cross():
        with Pair() as pair:
            pair.one.broadcast([TransformStamped(5, "a", "b", Transform((1.0, 0.0, 0.0)))], "node")
            fixed = TransformStamped(0, "b", "c", Transform((2.0, 0.0, 0.0)))
            pair.one.broadcast([fixed], "node", static=True)
            await until(lambda: pair.other.buffer.can_transform("a", "c", 5))

            heard = []
            pair.other.topic("turtle1/pose", Pose2D).subscribe(heard.append)
            pose = Pose2D(1.0, 2.0, 0.5)
            topic = pair.one.topic("turtle1/pose", Pose2D)
            await until(lambda: topic.far_subscribers)
            topic.publish(pose)
            await until(lambda: heard)
            assert heard == [pose]

    play(cross())


def test_services_and_actions_answer_whatever_carries_them():
    async def ask():
        with Pair() as pair:
            pair.one.serve("spawn", lambda request: Spawned(request.name), Spawn)
            await until(lambda: "spawn" in pair.other.services())
            answer = await pair.other.call("spawn", Spawn(1.0, 1.0, 0.0, "turtle9"))
            assert answer == Spawned("turtle9")

            goals = []
            pair.one.serve_action("count", goals.append, FIBONACCI)
            await until(lambda: "count" in pair.other.actions())
            fed = []
            goal = await pair.other.send_goal("count", FIBONACCI.Goal(order=3), fed.append)
            await until(lambda: goals)
            goals[0].publish_feedback(FIBONACCI.Feedback(sequence=[1]))
            goals[0].finish("succeeded", FIBONACCI.Result(sequence=[1, 2]))
            ended = await goal.result()
            assert (ended.status, list(ended.value.sequence)) == ("succeeded", [1, 2])
            assert [list(one.sequence) for one in fed] == [[1]]

    play(ask())


def test_who_comes_and_goes_is_seen_whatever_carries_it():
    async def come_and_go():
        with Pair() as pair:
            assert [str(one.role) for one in pair.links[1].graph.processes()] == ["host"]
            pair.links[0].close()
            await until(lambda: pair.links[1].graph.is_empty)

    play(come_and_go())


def test_nothing_of_the_link_but_its_own_folder_knows_zenoh():
    folder = Path(session.__file__).parent
    knowing = {
        path.name
        for path in folder.glob("*.py")
        if "link.zenoh" in path.read_text(encoding="utf-8")
    }
    assert knowing == {"seam.py"}
