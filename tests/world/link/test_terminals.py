"""Tests of the tutorial's terminals: the demo, teleop, and echo in a third terminal."""

import itertools
import re
import shutil
import signal

import pytest

from tests.terminals import Terminal

pytestmark = pytest.mark.skipif(
    shutil.which("tmux") is None, reason="needs tmux, a terminal that can be asked"
)


@pytest.fixture
def terminal(tmp_path):
    opened = []

    def open_terminal(*words, width=110, height=34):
        place = tmp_path / str(len(opened))
        place.mkdir()
        opened.append(Terminal(place, width, height, ["-m", "tftool", *words], {}))
        return opened[-1]

    yield open_terminal
    for each in opened:
        each.tmux("kill-server")


def distance(screen):
    """Return the distance from turtle1 to turtle2 in the last answer on an echo's screen."""
    found = re.findall(r"Distance: ([\d.]+)", screen)
    return float(found[-1]) if found else None


def test_three_terminals_play_the_tutorial(terminal):
    demo = terminal("demo")
    demo.shows("q quit")

    echo = terminal("echo", "turtle2", "turtle1", "--distance", "--rate", "5")
    echo.has_shown("Joined the session of 'tftool demo'")
    # turtle2 has caught up, because the leader does not move.
    echo.until(lambda screen: (distance(screen) or 9) < 0.3, "turtle2 beside turtle1")

    teleop = terminal("teleop")
    teleop.shows("q quit")
    # turtle1 drives in circles until the test sees the distance: turtle2 could catch up between two
    # looks.
    keys = itertools.cycle(["Up", "Up", "Left"])
    echo.until(
        lambda screen: teleop.press(next(keys)) or (distance(screen) or 0) > 0.5,
        "turtle1 driven away",
    )
    # A letter turns the turtle with the action. The demo's log shows the end of this turn. L opens
    # the whole log, because other lines may follow.
    demo.press("L")
    teleop.press("r")
    demo.until(lambda screen: "Rotation goal completed" in screen, "a turn")

    demo.press("q")
    demo.shows("ended with 0")
    echo.has_shown("which hosted, has left")
    echo.has_shown("Waiting for turtle1 in turtle2")
    teleop.shows("has left; its last transforms stay.")
    told = "there is no turtle 'turtle1' here"
    teleop.until(lambda screen: teleop.press("Up") or told in screen, told)
    teleop.press("q")
    teleop.shows("ended with 0")
    echo.signal(signal.SIGINT)
    echo.shows("ended with 130")


def test_the_order_does_not_matter(terminal):
    teleop = terminal("teleop", "turtle1")
    teleop.shows("q quit")
    demo = terminal("demo")
    demo.shows("in the session of 'tftool teleop'")
    demo.until(lambda screen: "turtle2" in screen, "the frames of the host")
    echo = terminal("echo", "world", "turtle1", "--precision", "1", "--rate", "5")
    echo.shows("- Translation: [5.5, 5.5, 0.0]")
    teleop.press("Up")
    # The turtle drives two metres, or less if a busy machine omits ticks.
    echo.until(
        lambda screen: (re.findall(r"- Translation: \[([\d.]+), 5.5", screen) or ["0"])[-1] > "6.0",
        "turtle1 driven by the other terminal's keys",
    )
