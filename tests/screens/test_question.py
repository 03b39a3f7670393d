"""Tests of the pair that a screen shows first if its usual pair does not exist."""

from tftool import Transform, TransformStamped, seconds
from tftool.screens.terminal.question import SceneQuestion
from tftool.screens.terminal.scene import Scene
from tftool.world.clock import SimClock, run
from tftool.world.world import World


def pairs_shown(*links):
    """Return the shown pair after each edge: seconds after the start, parent, child."""
    world = World(SimClock())
    clock, begin = world.clock, world.clock.now()
    scene = Scene(world)
    scene.start = begin
    question = SceneQuestion(scene, ("turtle2", "turtle1"))
    shown = []

    async def story():
        for moment, parent, child in links:
            await clock.sleep_until(begin + seconds(moment))
            pose = Transform((1.0, 0.0, 0.0))
            world.broadcast([TransformStamped(clock.now(), parent, child, pose)], "me")
            scene.look()
            question.ask()
            shown.append((question.target, question.source))

    run(clock, story())
    return shown


def test_a_replaced_pair_leads_to_a_root_that_comes_a_little_later():
    links = [(0.0, "odom", "base_link"), (0.1, "map", "odom")]

    assert pairs_shown(*links) == [("odom", "base_link"), ("map", "base_link")]


def test_base_link_is_shown_in_place_of_the_pair_though_another_frame_came_first():
    links = [(0.0, "base_link", "laser"), (0.1, "odom", "base_link"), (0.2, "map", "odom")]

    assert pairs_shown(*links)[1:] == [("odom", "base_link"), ("map", "base_link")]


def test_a_root_may_come_later_however_late_the_first_link_came():
    links = [(30.0, "odom", "base_link"), (30.1, "map", "odom")]

    assert pairs_shown(*links)[-1] == ("map", "base_link")


def test_a_pair_that_was_shown_for_a_while_stays():
    links = [(0.0, "map", "base_link"), (20.0, "earth", "map")]

    assert pairs_shown(*links) == [("map", "base_link"), ("map", "base_link")]


def test_the_pair_asked_for_is_shown_once_its_frames_have_come():
    links = [(0.0, "world", "turtle1"), (9.0, "world", "turtle2")]

    assert pairs_shown(*links)[-1] == ("turtle2", "turtle1")
