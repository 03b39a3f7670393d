import math

import pytest

from tftool.frames.sample import TransformStamped
from tftool.geometry.planar import heading
from tftool.geometry.rigid import Transform
from tftool.messages import Clear, Color
from tftool.runtime.clock import run
from tftool.runtime.node import Node
from tftool.screens.scene import Scene
from tftool.stamps import seconds


class At(Node):
    """Does something at a second."""

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
    assert moment.stamp == now
    assert moment.behind == 0
    assert moment.elapsed == seconds(14)
    assert {t.name: (t.x, t.y, t.theta) for t in moment.picture.turtles} == {
        name: (pose.x, pose.y, pose.theta) for name, pose in poses.items()
    }
    assert moment.pair.found == danced.world.buffer.lookup_transform("turtle2", "turtle1")
    assert moment.picture.strokes[-1] == danced.simulator.trail.segments[-1]


def test_an_earlier_moment_is_what_the_buffer_remembers(danced):
    at = danced.world.clock.now() - seconds(3.3)

    moment = danced.moment(at, "turtle2", "turtle1")

    lookup = danced.world.buffer.lookup_transform
    there = lookup("world", "turtle1", at).transform
    shown = moment.picture.turtles[0]
    assert (shown.x, shown.y) == pytest.approx(there.translation[:2], abs=1e-12)
    assert shown.theta == pytest.approx(heading(there), abs=1e-12)
    assert moment.pair.found == lookup("turtle2", "turtle1", at)
    assert moment.behind == seconds(3.3)


def test_an_earlier_trail_ends_where_its_turtle_was(danced):
    at = danced.world.clock.now() - seconds(3.0)

    moment = danced.moment(at, "turtle2", "turtle1")

    ends = [
        min(math.hypot(x1 - t.x, y1 - t.y) for _, _, x1, y1, _, _ in moment.picture.strokes[-6:])
        for t in moment.picture.turtles
    ]
    # As far as a turtle comes between two looks.
    assert max(ends) < 0.15
    assert len(moment.picture.strokes) < len(danced.simulator.trail.segments)


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

    after = scene.moment(None, "world", "turtle1").picture
    before = scene.moment(now - seconds(4), "world", "turtle1").picture

    assert (len(after.strokes), after.wipes) == (0, 1)
    assert len(before.strokes) == 63
    assert before.wipes == 0


def _clear(world):
    return world.call("clear", Clear())


def test_a_wiped_trail_is_forgotten_with_the_buffer(turtles):
    scene = turtles(16.0, ((1.0, "up"),), followed=False, extra=lambda world: At(world, 5, _clear))

    assert scene.moment(scene.oldest(), "world", "turtle1").picture.wipes == 1


@pytest.mark.parametrize(
    ("key", "side"), [("g", "right"), ("d", "left"), ("r", "top"), ("v", "bottom")]
)
def test_a_wall_lights_up_while_a_turtle_runs_into_it(turtles, key, side):
    ups = tuple((5.0 + 0.5 * n, "up") for n in range(9))

    pushing = turtles(9.4, ((0.5, key), *ups), followed=False)
    done = turtles(12.0, ((0.5, key), *ups), followed=False)

    assert pushing.moment(None, "", "").picture.walls == {side}
    assert done.moment(None, "", "").picture.walls == frozenset()


def test_other_frames_are_marks_until_they_are_dead(turtles):
    def carrot(world):
        pose = Transform((0.0, 2.0, 0.0))
        world.broadcast(
            [TransformStamped(world.clock.now(), "turtle1", "carrot1", pose)], "b", static=True
        )

    scene = turtles(2.0, (), followed=False, extra=lambda world: At(world, 1, carrot))

    (mark,) = scene.moment(None, "", "").picture.marks
    assert mark.name == "carrot1"
    assert (mark.x, mark.y) == pytest.approx((5.544445, 7.544445), abs=1e-6)


def test_without_a_simulator_the_view_fits_the_frames_and_only_grows(frames):
    scene = frames({"base": ("map", -3.0, 1.0), "laser": ("base", 0.5, 0.0)})

    first = scene.moment(None, "map", "laser").picture
    scene.look()

    assert {mark.name: (mark.x, mark.y) for mark in first.marks} == {
        "map": (0.0, 0.0),
        "base": (-3.0, 1.0),
        "laser": (-2.5, 1.0),
    }
    assert (first.left, first.bottom, first.size) == (-4.0, -1.0, 5.0)

    far = TransformStamped(seconds(1000), "map", "far", Transform((9.0, 0.0, 0.0)))
    scene.world.broadcast([far], "me", static=True)
    grown = scene.moment(None, "map", "laser").picture

    assert (grown.left, grown.size) == (-4.0, 14.0)
    assert scene.moment(None, "map", "laser").picture == grown


@pytest.mark.parametrize("x", [math.inf, 1e9])
def test_a_frame_far_beyond_the_map_is_not_drawn(frames, x):
    scene = frames({"a": ("map", 1.0, 1.0), "b": ("map", 0.0, 0.0)})
    far = TransformStamped(seconds(1000), "map", "b", Transform((x, 0.0, 0.0)))
    scene.world.broadcast([far], "me", static=True)

    names = {mark.name for mark in scene.moment(None, "map", "a").picture.marks}

    assert "a" in names
    assert "b" not in names or math.isinf(x)


def test_age_counts_from_when_a_stamp_last_changed(turtles):
    class Late(Node):
        """Sends an old stamp, then nothing."""

        async def run(self):
            old = self.clock.now() - seconds(5)
            self.broadcast(TransformStamped(old, "world", "late", Transform()))

    scene = turtles(1.0, (), followed=False, extra=lambda world: Late(world, "late"))
    # The screen looked at it while it was fresh.
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

    assert danced.moment(at, "", "").ages["turtle1"] == 0.0


def test_the_background_is_the_simulators(turtles):
    def paint(world):
        world.node("turtlesim").set_parameter("background_r", 1)

    scene = turtles(2.0, (), followed=False, extra=lambda world: At(world, 1, paint))

    assert scene.moment(None, "", "").picture.background == Color(1, 86, 255)


def test_looking_costs_a_bounded_memory(turtles):
    scene = turtles(30.0, (), followed=False)

    assert len(scene._seen) <= 10 / 0.05 + 2


def test_a_scene_can_begin_before_its_world(turtles):
    scene = turtles(1.0, (), followed=False)
    fresh = Scene(scene.world, scene.simulator)

    assert fresh.moment(None, "", "").picture.turtles == ()
