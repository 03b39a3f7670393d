from functools import partial

import pytest

from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.commands.shared.on_screen import driver_of, run_app
from tftool.commands.teleop.command import press_there
from tftool.messages.turtle_messages import Pose, Twist
from tftool.screens.terminal.scene import scene_of
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.world_app import WorldApp
from tftool.world.clock import SimClock, run
from tftool.world.nodes.turtle_drivers import BANNER
from tftool.world.world import World


def test_without_a_terminal_teleop_asks_for_keys(tftool):
    result = tftool("teleop")

    assert result.status == 2
    assert result.err == (
        "tftool: teleop reads keys from a terminal, and stdin is not a terminal. "
        'Give the keys on the command line instead: --keys "up up left".\n'
    )


@pytest.mark.parametrize(
    ("keys", "place"),
    [
        ("up", "x 7.560, y 5.544, heading 0.0°"),
        ("up down", "x 5.544, y 5.544, heading 0.0°"),
        ("left", "x 5.544, y 5.544, heading 115.5°"),
        ("RIGHT", "x 5.544, y 5.544, heading -115.5°"),
        ("t", "x 5.544, y 5.544, heading 44.0°"),
        ("r,up", "x 5.582, y 7.560, heading 88.9°"),
        ("up q up", "x 7.560, y 5.544, heading 0.0°"),
        ("f", "x 5.544, y 5.544, heading 0.0°"),
    ],
)
def test_keys_on_the_command_line_are_pressed_one_after_the_other(tftool, keys, place):
    result = tftool("teleop", "--keys", keys)

    assert result.status == 0
    assert result.out == f"turtle1 is at {place}.\n"


def test_another_turtle_can_be_driven(tftool):
    assert tftool("teleop", "turtle2", "--keys", "g").out.startswith("turtle2 is at x ")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (
            ["--keys", "up sideways"],
            "'sideways' is not a key of teleop; the keys are up, down, left",
        ),
        (["--keys", " "], "--keys needs at least one key"),
        (["bob", "--keys", "up"], "There is no turtle 'bob' here; there are turtle1, turtle2."),
        (["no name", "--keys", "up"], "'no name' cannot be a turtle's name"),
    ],
)
def test_invalid_keys_and_unknown_turtles_are_refused_with_a_sentence(tftool, words, sentence):
    result = tftool("teleop", *words)

    assert result.status == 2
    assert sentence in result.err


def test_a_turtle_that_is_not_in_the_joined_session_is_told_with_those_that_are():
    world = World(SimClock())
    world.topic("turtle1/pose", Pose)
    world.topic("turtle2/pose", Pose)

    with pytest.raises(UsageError, match="no turtle 'bob' here; there are turtle1, turtle2"):
        run(world.clock, press_there(world, "bob", ["up"]))


@pytest.fixture
def pressing(monkeypatch):
    """Return a function that replaces the terminal by one that sends some keys and q."""
    apps = []

    def press(*keys):
        async def see(app, life, **how):
            async def pilot(one):
                await one.pause()
                await one.press(*keys)
                app.redraw()
                await one.pause()
                await one.press("q")

            apps.append(app)
            app.run_async = partial(app.run_async, auto_pilot=pilot)
            await shown(app, life, headless=True)

        shown = WorldApp.run_with_world
        monkeypatch.setattr("tftool.commands.teleop.command.screen_lacks", lambda: "")
        monkeypatch.setattr(WorldApp, "run_with_world", see)
        return apps

    return press


def test_on_a_terminal_the_banner_comes_first_and_the_keys_drive(tftool, pressing):
    apps = pressing("up")

    result = tftool("teleop")

    (app,) = apps
    assert result.status == 0
    assert result.out == "\n".join(BANNER) + "\n"
    assert app.scene.simulator.turtles["turtle1"].pose.linear_velocity >= 0.0
    assert app.scene.world.topic("turtle1/cmd_vel", Twist).latest.linear.x == 2.0


def test_a_turtle_that_is_not_there_is_told_when_a_key_is_pressed(tftool, pressing):
    apps = pressing("up")

    assert tftool("teleop", "bob").status == 0

    (app,) = apps
    (told,) = [one.text for one in app.scene.world.log.records if one.node == "screen"]
    assert told.startswith("there is no turtle 'bob' here; there are: ")


def test_once_a_missed_turtle_is_there_the_newest_line_says_so(monkeypatch):
    world = World(SimClock())
    scene = scene_of(world)

    async def see(app, life):
        life.close()
        await world.clock.sleep(seconds(2))
        app.action_drive("up")
        scene.look()
        told.extend(one.text for one in world.log.records)
        world.topic("turtle1/pose", Pose).publish(Pose())
        await world.clock.sleep(seconds(0.1))
        for _ in range(2):
            scene.look()

    told = []
    monkeypatch.setattr(WorldApp, "run_with_world", see)
    run_app(scene, world.clock.sleep(0), driver_of(world, "turtle1"), Setting())

    assert told == ["there is no turtle 'turtle1' here; there are: none"]
    later = [one.text for one in world.log.records][1:]
    assert later == ["turtle1 is here now: the keys drive it"]
