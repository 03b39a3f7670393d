"""Tests of screens in a real terminal, tmux, whose contents a test can read."""

import re
import shutil
import signal

import pytest

from tests.terminals import Terminal
from tests.world.link.processes import Process

pytestmark = pytest.mark.skipif(
    shutil.which("tmux") is None, reason="needs tmux, a terminal that can be asked"
)

CRASH = """\
import sys
from tftool.app.main import main
from tftool.world.nodes.broadcasters import Broadcaster

async def run(self):
    await self.clock.sleep(500_000_000)
    raise ValueError("out of [bold]paint[/]")

Broadcaster.run = run
sys.exit(main(["demo"]))
"""


@pytest.fixture
def terminal(tmp_path):
    started = []

    def start(width, height, *words, **environment):
        started.append(Terminal(tmp_path, width, height, words, environment))
        return started[-1]

    yield start
    for one in started:
        one.tmux("kill-server")


DEMO = ("-m", "tftool", "demo", "--still")


def apart(screen):
    """Return the distance from turtle1 to turtle2 on the echo."""
    found = re.search(r"(\d+\.\d{3}) m\b", screen)
    return float(found[1]) if found else None


def marked(screen):
    """Return the name of the marked scenario in the list; None while no row is marked."""
    found = re.search(r"│▸ (\w+)", screen)
    return found and found[1]


def together(screen):
    distance = apart(screen)
    # None means no distance on the screen; 0, which is also false, is the smallest distance.
    return distance is not None and distance < 0.1


def scale_of(screen):
    """Return the numbers below the picture, without the changing time beside them."""
    lines = [line for line in screen.splitlines() if line.startswith("│ m ")]
    return lines[0].partition("││")[0] if lines else ""


@pytest.mark.parametrize(("width", "height"), [(60, 20), (200, 60)])
def test_the_demo_shows_turtle2_reaching_turtle1_and_obeys_the_keys(terminal, width, height):
    demo = terminal(width, height, *DEMO, "--rate", "8")

    # Panels are painted one after the other; a large terminal gets several writes.
    parts = ("Frames in", "├─ turtle1")
    screen = demo.until(
        lambda text: apart(text) is not None and all(part in text for part in parts),
        "a distance, beside the tree and the picture",
    )
    assert all(len(line) <= width for line in screen.splitlines())

    demo.until(together, "turtle2 at turtle1")
    # The turtle drives in circles until the test sees the distance: turtle2 could catch up between
    # two looks.
    demo.until(
        lambda text: (apart(text) or 0.0) > 0.5,
        "turtle1 driving off",
        pressing=("Up", "Up", "Left"),
    )
    demo.until(together, "turtle2 at turtle1 again")

    demo.press("[", "{")
    demo.shows(" ago")
    demo.press("l")
    demo.shows("● live ×8")

    demo.press("Tab", "k")
    demo.shows("world in turtle2")

    demo.press("q")
    demo.ended(0)


def test_a_demo_that_was_stopped_is_drawn_as_a_whole_when_it_goes_on(terminal):
    demo = terminal(80, 24, *DEMO)
    demo.until(lambda text: apart(text) is not None, "a distance")

    demo.press("C-z")
    demo.until(lambda _: demo.facts()[0] == "0", "the terminal as it was")
    demo.stops()
    demo.signal(signal.SIGCONT)

    demo.until(
        lambda text: "╭─ Tree" in text and "q quit" in text, "the borders and the keys again"
    )


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        (("plot", "turtle2", "turtle1", "--host"), "distance, m"),
        (("echo", "turtle2", "turtle1", "--host"), "Translation"),
    ],
)
def test_a_live_picture_leaves_the_terminal_while_stopped_and_then_returns(terminal, words, shown):
    live = terminal(90, 30, "-m", "tftool", *words)
    live.shows(shown)
    drawn_on = live.facts()

    live.press("C-z")
    live.stops()
    assert live.facts() == ["0", "1", "0"], "the terminal as it was, with its cursor"
    live.signal(signal.SIGCONT)

    live.until(lambda text: shown in text and live.facts() == drawn_on, "the picture again")


def test_two_trees_that_are_joined_are_drawn_where_the_echo_says(terminal, tmp_path):
    # Like the scenario `two_trees`, but the trees are joined only after the test has seen both.
    file = tmp_path / "two.yaml"
    file.write_text(
        "duration: 10 s\nnodes: [turtlesim, broadcaster: {turtle: turtle1},\n"
        "  static: {parent: map, child: station, x: 1 m, y: 2 m, yaw: 90 deg}]\n"
    )
    demo = terminal(110, 30, *DEMO, str(file), "--host")

    demo.shows("apart: map, 2 frames")
    with Process("static", "--x", "10", "--frame-id", "map", "--child-frame-id", "world"):
        demo.until(lambda text: "Frames in map" in text and "apart" not in text, "one tree")
    # Soon the echo shows the turtle in its root, which is map if the trees are joined early.
    demo.until(lambda text: re.search("turtle1 in (world|map)", text), "turtle1 in its root")
    # Measured from map: 10 m to world, with the turtle in the centre.
    demo.press("k", "Enter", "k", "k", "k", "Enter", "j", "j", "j")
    demo.until(
        lambda text: "turtle1 in map" in text and re.search(r"15\.544 +5\.544", text),
        "turtle1 in map",
    )
    scale = next(line for line in demo.screen().splitlines() if line.startswith("│ m "))
    row = next(line for line in demo.screen().splitlines() if "▐→▌" in line)
    # Its arrow is between the numbers on either side of 15.5 m.
    assert scale.index("15") < row.index("→") < scale.index("20")

    demo.press("q")
    demo.ended(0)


def test_left_alone_turtle1_draws_by_itself_until_a_key_is_pressed(terminal):
    demo = terminal(100, 30, "-m", "tftool", "demo", "--rate", "4")

    screen = demo.shows("turtle1 draws by itself; a key stops it")
    assert "turtle1" in screen
    demo.press("?")
    demo.until(lambda text: "a key stops it" not in text and "close these keys" in text, "the keys")
    demo.press("Escape")
    demo.shows("turtle1 draws by itself; a key stops it")

    demo.press("q")
    demo.ended(0)


def test_one_fixes_a_frame_zooms_and_shows_another_scenario(terminal):
    demo = terminal(100, 30, *DEMO)
    demo.until(lambda text: apart(text) is not None, "a distance")

    demo.press("F")
    demo.shows("Frames in turtle1 (fixed)")
    demo.press("F")
    demo.shows("Frames in world ─")
    # The title changes before the picture, so wait for the picture's scale.
    demo.until(lambda text: " 10 " in scale_of(text), "the whole field")
    demo.press("+", "+", "+", "+")
    demo.until(lambda text: " 10 " not in scale_of(text), "a part of the field")
    demo.press("0")
    demo.until(lambda text: " 10 " in scale_of(text), "the whole field again")

    demo.press("o")
    demo.shows("A robot with drifting odometry")
    # One key at a time, because further keys would move past the wanted row. Only the marked row is
    # compared, since the clock above the list changes.
    while (row := marked(demo.shows("▸"))) != "robot":
        demo.press("Down")
        demo.until(lambda text, row=row: marked(text) not in (None, row), "the next row")
    demo.press("Enter")
    demo.until(lambda text: "demo robot" in text and "laser_point" in text, "the robot")
    demo.shows("base_link in map")

    demo.press("q")
    demo.ended(0)


def test_letters_turn_to_the_heading_at_which_they_lie(terminal, tmp_path):
    alone = tmp_path / "alone.yaml"
    alone.write_text("duration: 1 s\nnodes: [turtlesim, broadcaster: {turtle: turtle1}]\n")
    demo = terminal(60, 20, *DEMO, str(alone), "--rate", "8")
    demo.shows("▐→▌")

    for key, arrow in zip("trdcb", "↗↑←↙↘", strict=True):
        demo.press(key)
        demo.shows(f"▐{arrow}▌")
    # The key is pressed repeatedly: in a world at 8 times real time, one press may be a short turn.
    demo.until(
        lambda text: any(f"▐{arrow}▌" in text for arrow in "→↗↑↖"),
        "a turn to the left",
        pressing=("Left",),
    )

    demo.press("q")
    demo.ended(0)


def test_a_terminal_that_changes_its_size_is_filled_anew(terminal):
    demo = terminal(100, 30, *DEMO)
    demo.shows("Echo")

    demo.tmux("resize-window", "-x", "20", "-y", "5")
    demo.shows("30x10 or more.")
    demo.tmux("resize-window", "-x", "120", "-y", "40")
    demo.until(lambda text: "Echo" in text and "q quit" in text, "the whole screen")

    demo.press("q")
    demo.ended(0)


@pytest.mark.parametrize("number", [2, 15], ids=["SIGINT", "SIGTERM"])
def test_a_signal_ends_it_with_the_terminal_restored(terminal, number):
    demo = terminal(80, 24, *DEMO)
    demo.shows("turtle1")

    demo.signal(number)

    assert "Traceback" not in demo.ended(130)


def test_control_c_ends_it_like_a_signal(terminal):
    demo = terminal(80, 24, *DEMO)
    demo.shows("turtle1")

    demo.press("C-c")

    demo.ended(130)


def test_a_node_that_fails_is_named_on_the_restored_terminal(terminal, tmp_path):
    script = tmp_path / "crash.py"
    script.write_text(CRASH)

    screen = terminal(80, 24, str(script)).ended(1)

    assert "tftool: node 'broadcaster1' failed: ValueError: out of [bold]paint[/]" in screen
    assert "Traceback" not in screen


def test_without_colour_none_is_sent(terminal):
    demo = terminal(80, 24, *DEMO, NO_COLOR="1")
    demo.shows("turtle1")

    painted = demo.tmux("capture-pane", "-p", "-e")
    colours = re.findall(r"\x1b\[[\d;]*\b(?:3[0-8]|4[0-8]|9\d|10\d)\b[\d;]*m", painted)
    assert colours == []

    demo.press("q")
    demo.ended(0)


def test_teleop_says_its_banner_and_drives(terminal):
    teleop = terminal(100, 30, "-m", "tftool", "teleop")
    screen = teleop.shows("'q' to quit.")
    assert "Use arrow keys to move the turtle." in screen
    teleop.until(lambda text: "turtle1" in text and "Frames" in text, "the field")

    teleop.press("Up")
    teleop.until(lambda text: re.search("[⠁-⣿]{6}", text), "a trail")

    teleop.press("q")
    assert "Reading from keyboard" in teleop.ended(0)


def test_bytes_that_are_no_text_are_dropped_and_the_keys_go_on(terminal):
    demo = terminal(100, 30, *DEMO)
    demo.until(lambda text: apart(text) is not None, "a distance")

    demo.tmux("send-keys", "-H", "ff")
    # A key that is read together with such bytes is a key: here "?", which opens the help.
    demo.tmux("send-keys", "-H", "c3", "28", "3f")
    # The help is open when it shows a text that no footer has, and closed when this text is gone.
    demo.shows("swap the two frames")
    demo.press("?")
    demo.until(lambda text: "swap the two frames" not in text, "the screen without its help")
    demo.press("q")

    screen = demo.shows("ended with 0")
    assert "Traceback" not in screen
    assert "UnicodeDecodeError" not in screen


def test_the_words_of_ros2_for_teleop_drive_too(terminal):
    remap = ("--ros-args", "--remap", "turtle1/cmd_vel:=turtle2/cmd_vel")
    teleop = terminal(100, 30, "-m", "tftool", "run", "turtlesim", "turtle_teleop_key", *remap)
    teleop.shows("'q' to quit.")
    teleop.shows("teleop turtle2")

    teleop.press("q")
    assert "Reading from keyboard" in teleop.ended(0)


def test_q_leaves_a_live_plot_and_gives_the_terminal_back(terminal):
    plot = terminal(80, 24, "-m", "tftool", "plot", "turtle2", "turtle1", "--host")

    plot.until(lambda screen: "distance, m" in screen and "q quit" in screen, "a plot")
    plot.press("x", "q")
    plot.ended(0)
