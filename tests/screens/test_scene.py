import math

import pytest

from tftool.base.color import Color
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.drawing import theme
from tftool.geometry.rigid import Transform, heading
from tftool.messages.turtle_messages import Empty
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description
from tftool.screens.terminal import frames_picture as frames_seen
from tftool.screens.terminal.scene import Scene, scene_of
from tftool.screens.terminal.space_panel import space_picture
from tftool.world.clock import SimClock, run
from tftool.world.node import Node
from tftool.world.nodes.joints import RobotStatePublisher
from tftool.world.world import World


class At(Node):
    """Node that does something at a second."""

    def __init__(self, world, second, what):
        super().__init__(world, f"at{second}")
        self.second, self.what = second, what

    async def run(self):
        await self.clock.sleep(seconds(self.second))
        outcome = self.what(self.world)
        if outcome is not None:
            await outcome


def test_the_present_is_what_the_simulator_and_the_buffer_say(danced):
    now = danced.world.clock.now()

    moment = danced.moment(None, "turtle2", "turtle1")

    poses = {name: turtle.pose for name, turtle in danced.simulator.turtles.items()}
    frames = {one.name: one for one in moment.picture.frames}
    assert moment.stamp == now
    assert moment.behind == 0
    assert moment.elapsed == seconds(14)
    assert moment.picture.fixed == "world"
    for name, pose in poses.items():
        shown = frames[name]
        assert shown.is_turtle
        assert (shown.x, shown.y) == pytest.approx((pose.x, pose.y), abs=1e-12)
        assert math.remainder(shown.theta - pose.theta, math.tau) == pytest.approx(0, abs=1e-9)
    assert moment.pair.found == danced.world.buffer.lookup_transform("turtle2", "turtle1")
    assert moment.picture.pen.strokes[-1][:4] == danced.simulator.trail.segments[-1][:4]
    # Two turtles draw; each one has a colour of its own.
    inks = {stroke[4] for stroke in moment.picture.pen.strokes}
    assert inks == {theme.of_name("turtle1"), theme.of_name("turtle2")}


def test_an_earlier_moment_is_what_the_buffer_remembers(danced):
    at = danced.world.clock.now() - seconds(3.3)

    moment = danced.moment(at, "turtle2", "turtle1")

    lookup = danced.world.buffer.lookup_transform
    there = lookup("world", "turtle1", at).transform
    shown = next(one for one in moment.picture.frames if one.name == "turtle1")
    assert (shown.x, shown.y) == pytest.approx(there.translation[:2], abs=1e-12)
    assert shown.theta == pytest.approx(heading(there), abs=1e-12)
    assert moment.pair.found == lookup("turtle2", "turtle1", at)
    assert moment.behind == seconds(3.3)


def test_an_earlier_trail_ends_where_its_turtle_was(danced):
    at = danced.world.clock.now() - seconds(3.0)

    moment = danced.moment(at, "turtle2", "turtle1")

    ends = [
        min(
            math.hypot(x1 - t.x, y1 - t.y) for _, _, x1, y1, _, _ in moment.picture.pen.strokes[-6:]
        )
        for t in moment.picture.frames
        if t.is_turtle
    ]
    # A trail may lack the distance that its turtle moves between two looks.
    assert max(ends) < 0.15
    assert len(moment.picture.pen.strokes) < len(danced.simulator.trail.segments)


def test_one_can_go_back_as_far_as_the_buffer_reaches(danced):
    oldest = danced.oldest()

    assert danced.world.clock.now() - oldest == pytest.approx(seconds(10), abs=seconds(0.02))
    assert danced.moment(oldest, "world", "turtle1").pair.found is not None


def test_another_pair_of_a_kept_moment_needs_no_buffer(danced):
    at = danced.world.clock.now() - seconds(2.0)
    kept = danced.moment(at, "turtle2", "turtle1")

    other = danced.again(kept, "turtle1", "turtle2").pair.found

    assert other.stamp == at
    expected = danced.world.buffer.lookup_transform("turtle1", "turtle2", at).transform
    assert other.transform.translation == pytest.approx(expected.translation, abs=1e-12)
    assert (
        danced.again(kept, "turtle1", "nobody").pair.refusal == "there was no frame 'nobody' then"
    )


def test_a_kept_moment_says_when_two_frames_were_not_connected(frames):
    scene = frames({"a": ("one", 0, 0), "b": ("two", 0, 0)})
    kept = scene.moment(None, "one", "a")

    assert "not connected" in scene.again(kept, "a", "b").pair.refusal


def test_a_pair_that_cannot_be_said_comes_with_tf2s_reason(danced):
    refusal = danced.moment(None, "turtle2", "carrot1").pair.refusal

    assert refusal.startswith('"carrot1" passed to lookupTransform argument source_frame')


def test_without_frames_there_is_no_pair(frames):
    assert frames({}).moment(None, "", "").pair.refusal == "there are no frames yet"


def test_a_wiped_trail_can_be_gone_back_to(turtles):
    scene = turtles(8.0, ((1.0, "up"),), followed=False, extra=lambda world: At(world, 5, _clear))
    now = scene.world.clock.now()

    after = scene.moment(None, "world", "turtle1").picture.pen
    before = scene.moment(now - seconds(4), "world", "turtle1").picture.pen

    assert (len(after.strokes), after.edition) == (0, 1)
    assert len(before.strokes) == 63
    assert before.edition == 0


def _clear(world):
    return world.call("clear", Empty.Request())


def test_a_wiped_trail_is_forgotten_with_the_buffer(turtles):
    scene = turtles(16.0, ((1.0, "up"),), followed=False, extra=lambda world: At(world, 5, _clear))

    assert scene.moment(scene.oldest(), "world", "turtle1").picture.pen.edition == 1


@pytest.mark.parametrize(
    ("key", "side"), [("g", "right"), ("d", "left"), ("r", "top"), ("v", "bottom")]
)
def test_a_wall_lights_up_while_a_turtle_runs_into_it(turtles, key, side):
    ups = tuple((5.0 + 0.5 * n, "up") for n in range(9))

    pushing = turtles(9.4, ((0.5, key), *ups), followed=False)
    done = turtles(12.0, ((0.5, key), *ups), followed=False)

    assert pushing.moment(None, "", "").picture.field.walls == {side}
    assert done.moment(None, "", "").picture.field.walls == frozenset()


def test_other_frames_stand_in_the_same_picture(turtles):
    def carrot(world):
        pose = Transform((0.0, 2.0, 0.0))
        world.broadcast(
            [TransformStamped(world.clock.now(), "turtle1", "carrot1", pose)], "b", static=True
        )

    scene = turtles(2.0, (), followed=False, extra=lambda world: At(world, 1, carrot))

    frames = {one.name: one for one in scene.moment(None, "", "").picture.frames}
    assert set(frames) == {"world", "turtle1", "carrot1"}
    assert (frames["carrot1"].x, frames["carrot1"].y) == pytest.approx((5.544445, 7.544445))
    assert frames["carrot1"].parent == pytest.approx((5.544445, 5.544445))
    assert not frames["carrot1"].is_turtle


def test_every_frame_stands_where_a_lookup_in_the_fixed_frame_says(danced):
    """Check this for every fixed frame, at present and in the past."""
    buffer = danced.world.buffer
    past = danced.world.clock.now() - seconds(2.7)

    for fixed in ("world", "turtle1", "turtle2"):
        for at in (None, past):
            picture = danced.moment(at, "turtle2", "turtle1", fixed).picture
            assert picture.fixed == fixed
            assert {one.name for one in picture.frames} == {"world", "turtle1", "turtle2"}
            for one in picture.frames:
                there = buffer.lookup_transform(fixed, one.name, at or 0).transform
                assert (one.x, one.y) == pytest.approx(there.translation[:2], abs=1e-9)
                ahead = there.rotate((1.0, 0.0, 0.0))
                assert one.axes[0] == pytest.approx(ahead[:2], abs=1e-9)


def test_the_field_lies_where_its_frame_lies(danced):
    picture = danced.moment(None, "turtle2", "turtle1", "turtle1").picture

    there = danced.world.buffer.lookup_transform("turtle1", "world").transform
    corner = there.apply((11.088889122009277, 0.0, 0.0))
    assert (picture.field.x, picture.field.y) == pytest.approx(there.translation[:2], abs=1e-9)
    assert picture.field.corners()[1] == pytest.approx(corner[:2], abs=1e-9)


def test_without_a_choice_the_picture_is_in_the_root_of_the_pairs_tree(frames):
    scene = frames({"a": ("one", 1, 0), "b": ("two", 0, 2), "c": ("two", 1, 1)})

    def fixed(target, source, chosen=""):
        return scene.moment(None, target, source, chosen).picture.fixed

    assert fixed("one", "a") == "one"
    assert fixed("b", "c") == "two"
    assert fixed("a", "b") == "two"
    assert fixed("a", "b", "a") == "a"
    assert fixed("a", "b", "gone") == "two"
    assert frames({}).moment(None, "", "").picture.fixed == ""


def test_trees_that_nothing_joins_are_apart(frames):
    scene = frames({"a": ("one", 1, 0), "b": ("two", 0, 2), "c": ("two", 1, 1)})

    picture = scene.moment(None, "two", "b").picture

    assert {one.name for one in picture.frames} == {"two", "b", "c"}
    (other,) = picture.apart
    assert other.fixed == "one"
    assert {(one.name, one.x, one.y) for one in other.frames} == {("one", 0, 0), ("a", 1, 0)}


def test_two_trees_that_are_joined_are_one_picture_that_agrees_with_the_lookup():
    from tftool.opener import scenario_named
    from tftool.scenario.play import build, left_to_a_person
    from tftool.world.clock import SimClock
    from tftool.world.nodes.turtlesim import simulator_of

    play = build(left_to_a_person(scenario_named("two_trees")), SimClock())
    scene = Scene(play.world, simulator_of(play.world))
    run(play.world.clock, play.live(play.world.clock.now() + seconds(10)))
    scene.look()

    picture = scene.moment(None, "turtle2", "turtle1").picture

    # The scenario's own expectation: 10 m from map to world, with the turtle in the centre
    places = {one.name: (one.x, one.y) for one in picture.frames}
    assert picture.fixed == "map"
    assert places["turtle1"] == pytest.approx((15.544445, 5.544445))
    assert places["world"] == pytest.approx((10.0, 0.0))
    assert places["station"] == pytest.approx((1.0, 2.0))
    assert (picture.field.x, picture.field.y) == pytest.approx((10.0, 0.0))
    assert picture.apart == ()


class Circling(Node):
    """Node that broadcasts a frame on a circle of two metres, one turn in four seconds."""

    async def run(self):
        async for now in self.every(seconds(0.05)):
            angle = math.tau * (now - self.clock.epoch) / seconds(4)
            place = (2.0 * math.cos(angle), 2.0 * math.sin(angle), 0.0)
            self.broadcast(TransformStamped(now, "map", "drone", Transform(place)))


def test_a_frame_that_moves_leaves_a_trail_by_lookup(turtles):
    scene = turtles(6.0, (), followed=False, extra=lambda world: Circling(world, "circling"))

    live = scene.moment(None, "map", "drone").picture.trails
    earlier = scene.moment(scene.world.clock.now() - seconds(3), "map", "drone").picture.trails
    own = scene.moment(None, "map", "drone", "drone").picture

    ends = live.ends[:, 1, :2].tolist()
    assert len(ends) > 50
    assert [math.hypot(x, y) for x, y in ends] == pytest.approx([2.0] * len(ends), abs=0.01)
    assert live.ends.min((0, 1)) == pytest.approx([-2, -2, 0], abs=0.02)
    assert live.ends.max((0, 1)) == pytest.approx([2, 2, 0], abs=0.02)
    assert len(earlier.ends) < len(ends) - 25
    # Seen from itself, the frame does not move, and map moves on a circle.
    inks = [(ink >> 16, ink >> 8 & 255, ink & 255) for ink in own.trails.colors.tolist()]
    away = [math.dist(ink, theme.of_name("map")) for ink in inks]
    # The trail fades with its age; its newest part has the frame's own colour.
    assert away[-1] < 10 < away[0]
    assert away == sorted(away, reverse=True)


class Climbing(Node):
    """Node that sends the pose of `drone`, which rises over `map` by a metre per second."""

    async def run(self):
        async for now in self.every(seconds(0.05)):
            height = Transform((0.0, 0.0, (now - self.clock.epoch) / seconds(1)))
            self.broadcast(TransformStamped(now, "map", "drone", height))


def test_in_space_a_trail_is_as_high_as_its_frame_was(turtles):
    scene = turtles(3.0, (), followed=False, extra=lambda world: Climbing(world, "climbing"))

    moment = scene.moment(None, "map", "drone")
    heights = space_picture(moment).lines.ends[:, 1, 2].tolist()

    assert heights == sorted(heights)
    assert heights[-1] == pytest.approx(3.0, abs=0.11)
    assert heights[0] < 0.3


def test_a_demo_draws_the_robot_that_is_described_on_its_session():
    ball = '<link name="ball"><visual><geometry><sphere radius="1"/></geometry></visual></link>'
    world = World(SimClock())
    scene = scene_of(world)
    RobotStatePublisher(world, robot=Robot(parse_description(f'<robot name="b">{ball}</robot>')))

    world.run(world.clock.now() + seconds(1))

    assert scene.solids.frames == ("ball",)
    assert space_picture(scene.moment(None, "ball", "ball"), scene.solids).solids is scene.solids


def test_a_frame_on_a_static_link_has_no_trail_of_its_own(frames):
    scene = frames({"arm": ("base", 1.0, 0.0)})
    for second in range(1000, 1003):
        place = Transform((float(second), 0.0, 0.0))
        scene.world.broadcast([TransformStamped(seconds(second), "map", "base", place)], "me")

    snapshot = scene.world.buffer.snapshot(seconds(1003))

    assert frames_seen.moving(snapshot, "map") == ["base"]
    assert frames_seen.moving(snapshot, "arm") == ["base", "map"]


@pytest.mark.parametrize("x", [math.inf, 1e12])
def test_a_frame_far_beyond_the_map_is_said_and_not_drawn(frames, x):
    scene = frames({"a": ("map", 1.0, 1.0), "b": ("map", 0.0, 0.0)})
    far = TransformStamped(seconds(1000), "map", "b", Transform((x, 0.0, 0.0)))
    scene.world.broadcast([far], "me", static=True)

    picture = scene.moment(None, "map", "a").picture

    names = [one.name for one in picture.frames]
    assert "a" in names
    assert "b" not in names
    assert picture.nowhere == ("b",)


def test_age_counts_from_when_a_stamp_last_changed(turtles):
    class Late(Node):
        """Node that sends an old stamp, then nothing."""

        async def run(self):
            old = self.clock.now() - seconds(5)
            self.broadcast(TransformStamped(old, "world", "late", Transform()))

    scene = turtles(1.0, (), followed=False, extra=lambda world: Late(world, "late"))
    # The screen looked at the frame while it was fresh.
    assert scene.moment(None, "", "").ages["late"] == pytest.approx(6.0)

    world = scene.world
    clock = world.clock
    at = clock.now()
    world.broadcast([TransformStamped(at - seconds(5), "world", "late", Transform())], "late")
    world.broadcast([TransformStamped(at - seconds(4), "world", "late", Transform())], "late")
    assert scene.moment(None, "", "").ages["late"] == 0.0

    run(clock, _pass(clock, 7.0))

    ages = scene.moment(None, "", "").ages
    assert ages["late"] == pytest.approx(7.0)
    assert ages["world"] == 0.0


async def _pass(clock, second):
    await clock.sleep(seconds(second))


def test_in_the_past_age_counts_from_the_stamp(danced):
    at = danced.world.clock.now() - seconds(1)

    stamps = danced.world.buffer.samples("turtle1").stamps.tolist()
    newest = max(stamp for stamp in stamps if stamp <= at)
    assert danced.moment(at, "", "").ages["turtle1"] == (at - newest) / 1e9


def test_the_background_is_the_simulators(turtles):
    def paint(world):
        world.node("turtlesim").set_parameter("background_r", 1)

    scene = turtles(2.0, (), followed=False, extra=lambda world: At(world, 1, paint))

    assert scene.moment(None, "", "").picture.field.color == Color(1, 86, 255)


def test_a_background_color_older_than_the_buffer_is_forgotten(turtles):
    def paint(world):
        world.node("turtlesim").set_parameter("background_r", 1)

    scene = turtles(15.0, (), followed=False, extra=lambda world: At(world, 3, paint))

    # At 2 s it had another colour, but the buffer begins at 5 s.
    long_ago = scene.start + seconds(2)
    assert scene.oldest() > long_ago
    assert scene.moment(long_ago, "", "").picture.field.color == Color(1, 86, 255)


def test_a_scene_can_begin_before_its_world(turtles):
    scene = turtles(1.0, (), followed=False)
    fresh = Scene(scene.world, scene.simulator)

    assert fresh.moment(None, "", "").picture.field is None
