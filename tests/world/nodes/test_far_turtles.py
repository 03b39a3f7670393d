"""Tests of a simulator in another process."""

import pytest

from tftool.base.color import Color
from tftool.base.errors import LinkError
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES, build
from tftool.messages.turtle_messages import Empty, Pose, SetPen, TeleportAbsolute, Twist, twist
from tftool.world.clock import SimClock, run
from tftool.world.node import Node
from tftool.world.nodes.remote_turtles import MOST, FarTurtles
from tftool.world.nodes.trail import MOST_STROKES, DrawingService, FarDrawing, Segment, Trail
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World


class Script(Node):
    """Node that calls functions at given seconds."""

    def __init__(self, world, *steps):
        super().__init__(world, "script")
        self.steps = steps

    async def run(self):
        start = self.clock.now()
        for second, step in self.steps:
            await self.clock.sleep_until(start + seconds(second))
            step()


@pytest.fixture
def world():
    return World(SimClock())


def lived(world, duration):
    run(world.clock, live(world, until=world.clock.now() + seconds(duration)))


def pose(x, y=5.0):
    return build(Pose, x, y, 0.0, 0.0, 0.0)


def test_far_turtles_have_the_pose_trail_and_background_of_the_simulator(world):
    simulator, far = Turtlesim(world), FarTurtles(world)
    drive = world.topic("turtle1/cmd_vel", Twist)
    Script(world, (1, lambda: drive.publish(twist(2.0, 1.8))))

    lived(world, 3)

    assert list(far.turtles) == ["turtle1"]
    assert far.turtles["turtle1"].pose == simulator.turtles["turtle1"].pose
    assert far.background == simulator.background
    assert len(far.trail.segments) == len(simulator.trail.segments) > 50
    for ours, theirs in zip(far.trail.segments, simulator.trail.segments, strict=True):
        assert ours[:4] == pytest.approx(theirs[:4], abs=1e-6)
        assert ours[4:] == theirs[4:]


def test_the_picture_changes_only_when_a_turtle_moves(world):
    far = FarTurtles(world)
    topic = world.topic("turtle1/pose", Pose)

    topic.publish(pose(1.0))
    first = far.revision
    topic.publish(pose(1.0))
    assert far.revision == first
    topic.publish(pose(1.5))
    assert far.revision > first


def test_a_silent_turtle_is_removed_and_draws_no_line_when_it_returns_elsewhere(world):
    far = FarTurtles(world)
    one, two = (world.topic(f"turtle{number}/pose", Pose) for number in (1, 2))
    there = []
    Script(
        world,
        (0, lambda: one.publish(pose(1.0))),
        (0.5, lambda: two.publish(pose(2.0))),
        (1.2, lambda: there.extend(far.turtles)),
        (1.4, lambda: two.publish(pose(2.0))),
        (2.0, lambda: one.publish(pose(9.0))),
    )

    lived(world, 2.1)

    assert there == ["turtle2"]
    assert list(far.turtles) == ["turtle1", "turtle2"]
    assert len(far.trail.segments) == 0


def test_of_a_crowd_only_the_first_are_listened_to(world):
    far = FarTurtles(world)
    topics = [world.topic(f"turtle{number}/pose", Pose) for number in range(MOST + 10)]
    for topic in topics:
        topic.publish(pose(1.0))

    assert len(far.turtles) == MOST
    assert sum(topic.near_subscribers for topic in world.topics().values()) == MOST


def test_one_that_has_ended_listens_to_nobody(world):
    far = FarTurtles(world)
    first = world.topic("turtle1/pose", Pose)
    first.publish(pose(1.0))
    far.close()
    first.publish(pose(2.0))
    world.topic("turtle2/pose", Pose).publish(pose(3.0))

    assert {name: one.pose.x for name, one in far.turtles.items()} == {"turtle1": 1.0}
    assert all(topic.near_subscribers == 0 for topic in world.topics().values())


def test_another_simulator_begins_on_an_empty_sheet(world):
    far = FarTurtles(world)
    topic = world.topic("turtle1/pose", Pose)
    before = []
    Script(
        world,
        (0.0, lambda: topic.publish(pose(1.0))),
        (0.1, lambda: topic.publish(pose(2.0))),
        (4.0, lambda: before.extend(far.trail.segments)),
        (5.0, lambda: topic.publish(pose(5.0))),
        (5.1, lambda: topic.publish(pose(6.0))),
    )

    lived(world, 6)

    # The line does not change until the next line arrives.
    assert [(one.x0, one.x1) for one in before] == [(1.0, 2.0)]
    assert [(one.x0, one.x1) for one in far.trail.segments] == [(5.0, 6.0)]


def strokes(trail):
    """Return the drawn lines, with ends as the 32-bit floats of messages."""
    return [
        (*(pytest.approx(end, abs=1e-5) for end in one[:4]), *one[4:]) for one in trail.segments
    ]


def seen_after(world, *steps, look_at):
    """Return the view of another process that first looks at the simulator at a given second."""
    simulator, seen = Turtlesim(world), []
    called = [
        (second, lambda step=step: script.start_soon(world.call(*step))) for second, step in steps
    ]
    script = Script(world, *called, (look_at, lambda: seen.append(FarTurtles(world))))
    lived(world, look_at + 2)
    return simulator, seen[0]


def to(x, y):
    return "turtle1/teleport_absolute", build(TeleportAbsolute.Request, x, y, 0.0)


def test_pens_and_what_was_drawn_before_the_first_look_are_seen(world):
    simulator, far = seen_after(
        world,
        (1, to(1.0, 1.0)),
        (2, ("turtle1/set_pen", build(SetPen.Request, 255, 0, 7, 9, 0))),
        (3, to(9.0, 1.0)),
        (4, ("turtle1/set_pen", build(SetPen.Request, 0, 0, 0, 0, 1))),
        (5, to(5.0, 5.0)),
        (8, ("turtle1/set_pen", build(SetPen.Request, 0, 255, 0, 2, 0))),
        (8.5, to(5.0, 9.0)),
        look_at=7,
    )

    assert [one.color for one in far.trail.segments] == [
        Color(179, 184, 255),
        Color(255, 0, 7),
        Color(0, 255, 0),
    ]
    assert list(map(tuple, far.trail.segments)) == strokes(simulator.trail)


def test_a_wiped_sheet_is_wiped_here_too(world):
    _, far = seen_after(world, (1, to(1.0, 1.0)), (4, ("clear", Empty.Request())), look_at=3)

    assert len(far.trail.segments) == 0


def test_a_background_that_is_changed_is_seen(world):
    simulator, far = Turtlesim(world, background=Color(1, 2, 3)), FarTurtles(world)
    first = []
    Script(
        world,
        (2, lambda: first.append(far.background)),
        (3, lambda: simulator.set_parameter("background_g", 200)),
    )

    lived(world, 5)

    assert first == [Color(1, 2, 3)]
    assert far.background == Color(1, 200, 3)


class StrangeSimulator(Node):
    """Simulator like ROS 2's: it sends poses and has parameters, but publishes no lines."""

    async def run(self):
        kind = INTERFACES.find("rcl_interfaces", "srv", "GetParameters")
        value = INTERFACES.message("rcl_interfaces/ParameterValue")
        channels = {"background_r": 10, "background_g": 20, "background_b": 30}
        self.serve(
            "strange/get_parameters",
            lambda asked: kind.Response(
                values=[value(type=2, integer_value=channels[name]) for name in asked.names]
            ),
            kind,
        )
        start = self.clock.now()
        async for now in self.every(seconds(0.5)):
            self.publish("turtle1/pose", pose(1.0 if now < start + seconds(2) else 4.0))


def test_of_another_simulator_the_background_is_seen_and_trails_by_the_poses(world):
    StrangeSimulator(world, "strange")
    far = FarTurtles(world)

    lived(world, 4)

    assert far.background == Color(10, 20, 30)
    assert [tuple(one) for one in far.trail.segments] == [
        (1.0, 5.0, 4.0, 5.0, Color(179, 184, 255), 3)
    ]


def test_beside_one_that_tells_its_strokes_another_is_drawn_by_the_poses(world):
    Turtlesim(world, "a/sim", namespace="a", background=Color(9, 9, 9))
    Turtlesim(world, "b/sim", namespace="b")
    far = FarTurtles(world)
    ahead, back = (world.topic(f"{one}/turtle1/cmd_vel", Twist) for one in "ab")
    Script(
        world,
        (1, lambda: ahead.publish(twist(1.0))),
        (1, lambda: back.publish(twist(-1.0))),
    )

    lived(world, 4)

    ends = [one.x1 for one in far.trail.segments]
    assert far.background == Color(9, 9, 9)
    # The turtle drives for 63 updates of 16 ms in each direction.
    assert (max(ends), min(ends)) == pytest.approx((5.544445 + 1.008, 5.544445 - 1.008), abs=1e-4)
    assert len(ends) == 2 * 63


def test_a_simulator_that_refuses_to_answer_is_drawn_as_it_begins(world):
    strange, far = StrangeSimulator(world, "strange"), FarTurtles(world)

    def refuse(_):
        raise LinkError("no server answered within 5 s")

    strange.serve = lambda name, _, kind: world.serve(name, refuse, kind, node="strange")

    lived(world, 4)

    assert list(far.turtles) == ["turtle1"]
    assert far.background == Color(69, 86, 255)


def test_a_long_drawing_comes_in_several_answers_and_a_new_host_begins_anew(world):
    theirs, ours = Trail(), Trail()
    for number in range(2 * MOST_STROKES + 5):
        theirs.draw(Segment(float(number), 0.0, 0.0, 0.0, Color(1, 2, 3), 4))
    host, far = Node(world, "host"), FarDrawing(ours)
    DrawingService(host, theirs)
    lengths = []

    async def ask(service):
        far.take(await world.call(service, far.request()))
        lengths.append((len(ours.segments), far.is_whole))

    for _ in range(3):
        run(world.clock, ask("host/_drawing"))
    assert lengths == [
        (MOST_STROKES, False),
        (2 * MOST_STROKES, False),
        (2 * MOST_STROKES + 5, True),
    ]
    assert [one.x0 for one in ours.segments] == [float(n) for n in range(2 * MOST_STROKES + 5)]

    run(world.clock, world.clock.sleep_until(world.clock.now() + 1))
    other = Trail()
    other.draw(Segment(7.0, 0.0, 0.0, 0.0, Color(1, 2, 3), 4))
    DrawingService(Node(world, "other"), other)
    run(world.clock, ask("other/_drawing"))
    assert list(map(tuple, ours.segments)) == strokes(other)
