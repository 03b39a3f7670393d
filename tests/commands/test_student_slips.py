"""Tests that learners' mistakes are reported at the right place."""

import linecache

import pytest

TIMER = """
import rclpy
from rclpy.node import Node

class Ticker(Node):
    def __init__(self):
        super().__init__("ticker")
        self.create_timer(0.1, self.tick())

    def tick(self):
        pass

rclpy.init()
rclpy.spin(Ticker())
"""

UNFILLED = """
import rclpy
from rclpy.node import Node
from tf2_ros import Buffer, TransformException

class Asker(Node):
    def __init__(self):
        super().__init__("asker")
        self.buffer = Buffer()
        self.create_timer(0.1, self.tick)

    def tick(self):
        try:
            self.buffer.lookup_transform("map", "laser", rclpy.time.Time())
        except TransformException:
            pass

rclpy.init()
rclpy.spin(Asker())
"""


@pytest.fixture
def program(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def write(text):
        linecache.clearcache()
        (tmp_path / "node.py").write_text(text, encoding="utf-8")
        return "node.py"

    return write


def test_a_timer_given_a_call_in_place_of_a_callback_is_named_with_its_line(tftool, program):
    result = tftool("run", "--simulated", "--for", "1", program(TIMER))

    assert "the callback of this timer is None, so the timer calls nothing" in result.err
    assert "node.py:8" in result.err
    assert "self.create_timer(0.1, self.tick())" in result.err


def test_a_buffer_that_nothing_fills_is_named_once(tftool, program):
    result = tftool("run", "--simulated", "--for", "2", program(UNFILLED))

    assert result.err.count("create and store a TransformListener(buffer, node)") == 1


def test_options_after_the_file_are_refused_with_their_place(tftool, program):
    file = program(UNFILLED)

    result = tftool("run", file, "--simulated", "--for", "3")

    assert result.status == 2
    assert "put --simulated and --for before FILE" in result.err


def test_options_that_the_program_reads_itself_are_its_own(tftool, program):
    file = program("import sys\nassert '--for' in sys.argv\nprint(sys.argv[1:])\n")

    assert tftool("run", "--for", "1", file, "--for", "3").status == 0


def test_words_after_two_dashes_are_the_programs(tftool, program):
    file = program("import sys\nprint(sys.argv[1:])\n")

    result = tftool("run", "--for", "1", file, "--", "--for", "3")

    assert result.status == 0


def test_a_folder_named_unlike_its_package_tells_the_packages_name(tftool, tmp_path, monkeypatch):
    folder = tmp_path / "src" / "zed"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(
        '<package format="3"><name>chase</name><version>0.0.0</version></package>'
    )
    monkeypatch.chdir(tmp_path)

    result = tftool("run", "zed", "node")

    assert result.status == 2
    assert "the package in folder 'zed' is called 'chase': use this name" in result.err


def test_a_single_file_of_limited_length_is_recorded_with_for(tftool, tmp_path):
    result = tftool("record", "--max-duration", "3", "-o", tmp_path / "run.mcap", "--in", "static")

    assert result.status == 2
    assert "To stop after some time, use --for SECONDS" in result.err


NODE = """
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import (
    Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformException, TransformListener
)

class Slip(Node):
    def __init__(self):
        super().__init__("slip")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.sender = TransformBroadcaster(self)
        self.fixed = StaticTransformBroadcaster(self)
        self.create_timer(0.1, self.tick)
        self.begin()

    def begin(self):
        pass

    def send(self, parent, child, sender=None):
        link = TransformStamped(child_frame_id=child)
        link.header.frame_id = parent
        link.header.stamp = self.get_clock().now().to_msg()
        (sender or self.sender).sendTransform(link)

    def look(self, target, source, time=rclpy.time.Time()):
        try:
            self.buffer.lookup_transform(target, source, time)
        except TransformException as error:
            self.get_logger().info(f"no: {error}")

    def tick(self):
        pass
"""


@pytest.fixture
def slip(program):
    """Return a function that writes a node with some code in `begin` and in each tick."""

    def write(tick="pass", begin="pass"):
        return program(
            f"{NODE}\nclass Own(Slip):\n    def begin(self):\n        {begin}\n"
            f"    def tick(self):\n        {tick}\n\nrclpy.init()\nrclpy.spin(Own())\n"
        )

    return write


def said(result, text):
    """Return how many warnings of the log contain a text."""
    return sum(text in line for line in result.err.splitlines() if line.startswith("[WARN]"))


def test_a_broadcaster_that_never_sends_is_named_after_five_seconds(tftool, slip):
    silent = "this node's TransformBroadcaster has sent nothing for 5 s: call sendTransform in"
    file = slip(begin="self.fixed_sent = self.send('map', 'base', self.fixed)")

    early = tftool("run", "--simulated", "--for", "4", file)
    late = tftool("run", "--simulated", "--for", "20", file)

    assert (said(early, silent), said(late, silent)) == (0, 1)
    assert said(late, "StaticTransformBroadcaster has sent nothing") == 0


def test_a_wrong_frame_name_is_named_once_with_the_near_one(tftool, slip):
    file = slip("self.send('world', 'turtle1'); self.look('world', 'turtel1')")

    result = tftool("run", "--simulated", "--for", "8", file)

    assert said(result, "'turtel1' has arrived yet; did you mean 'turtle1'?") == 1


def test_a_frame_that_comes_up_late_is_no_wrong_name(tftool, slip):
    file = slip(
        "self.look('world', 'turtle2'); self.send('world', 'turtle1'); "
        "self.get_clock().now().nanoseconds > 1002e9 and self.send('world', 'turtle2')"
    )

    result = tftool("run", "--simulated", "--for", "8", file)

    assert said(result, "turtle2") == 0


def test_a_frame_sent_once_is_named_with_the_static_broadcaster(tftool, slip):
    file = slip("self.look('map', 'base', self.get_clock().now())", "self.send('map', 'base')")

    result = tftool("run", "--simulated", "--for", "8", file)

    assert said(result, "'base' was sent once, at 1000.000 s: send a transform that never") == 1


def test_exchanged_ends_of_a_link_are_named_once(tftool, slip):
    file = slip("self.send('base', 'map')", "self.send('map', 'base', self.fixed)")

    result = tftool("run", "--simulated", "--for", "2", file)

    assert said(result, "frame_id 'base' and child_frame_id 'map' are exchanged") == 1


def test_two_parents_of_a_frame_are_named_once(tftool, slip):
    file = slip("self.send('map', 'base'); self.send('odom', 'base')")

    result = tftool("run", "--simulated", "--for", "2", file)

    assert said(result, "'base' has two alternating parents, 'map' and 'odom'") == 1


def test_a_frame_that_moves_to_another_parent_for_good_is_no_slip(tftool, slip):
    file = slip(
        "self.send('hand' if self.get_clock().now().nanoseconds > 1001e9 else 'table', 'cup')"
    )

    assert said(tftool("run", "--simulated", "--for", "2", file), "alternating parents") == 0


def test_lookups_at_now_are_summed_up_after_a_simulated_run(tftool, slip):
    file = slip("self.look('world', 'turtle1', self.get_clock().now())")

    result = tftool("run", "--simulated", "--for", "2", "--in", "turtles", file)

    assert "Time(), the latest time, or give a timeout" in result.err


def test_links_that_turn_round_nothing_are_no_slip(tftool, slip):
    file = slip("self.send('map', 'base'); self.send('base', 'lens')")

    assert said(tftool("run", "--simulated", "--for", "2", file), "exchanged") == 0


@pytest.mark.parametrize(
    ("time", "told"),
    [
        ("self.get_clock().now()", "Time(), the latest time, or give a timeout"),
        ("rclpy.time.Time()", ""),
    ],
)
def test_lookups_at_now_are_a_warning_of_check(tftool, slip, time, told):
    file = slip(f"self.look('world', 'turtle1', {time})")

    result = tftool("check", "turtles", "--run", file)

    assert result.status == 0
    assert ("ok, 1 warning" in result.out) == bool(told)
    assert told in result.err
    assert tftool("check", "turtles", "--strict", "--run", file).status == bool(told)


def test_check_says_first_which_node_has_failed(tftool, slip):
    file = slip("assert self.buffer is None, 'first of all'")
    words = ("check", "turtles", "--run", f"follower={file}")

    rows = tftool(*words).out.splitlines()
    whole = tftool(*words, "--verbose").out

    assert "'follower' failed: AssertionError: first of all" in rows[1]
    assert whole.index("first of all") < whole.index("turtle1 in turtle2")


def test_check_hides_no_line_of_another_name(tftool, slip):
    told = tftool("check", "turtles", "--run", slip("self.get_logger().info('tick 3')")).err

    assert "Spawning turtle [turtle1]" in told
    assert "Spawning turtle [turtle2]" in told
    assert told.count("] [slip]: tick 3") == 1


@pytest.fixture
def chase(tftool, tmp_path, monkeypatch):
    """Create a package with `tftool new`."""
    monkeypatch.chdir(tmp_path)
    tftool("new", "chase")
    return tmp_path / "chase"


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("Node(\n", "Node(pakage='chase',\n", "did you mean 'package'?"),
        ('executable="turtle_broadcaster"', 'exectuable="turtle_broadcaster"',
         "did you mean 'executable' by 'exectuable'?"),
        ("Node(\n", "Nod(\n", "name 'Nod' is not defined; did you mean 'Node'?"),
        ("def generate_launch_description", "def generate_launch_descripton",
         "rename its function 'generate_launch_descripton'"),
        ("LaunchDescription([", "LaunchDescription(initial_entites=[]) or ([",
         "did you mean 'initial_entities'?"),
    ],
)  # fmt: skip
def test_a_misspelt_keyword_or_function_of_a_launch_file_is_told_with_the_near_name(
    tftool, chase, old, new, told
):
    file = chase / "launch" / "follower.launch.py"
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new, 1))

    result = tftool("launch", "--simulated", "--for", "1", file)

    assert result.status == 3
    assert told in result.err


@pytest.mark.parametrize(
    ("wrong", "near"),
    [
        ("chase.turtle_folower:main", "chase.turtle_follower"),
        ("chase.turtle_follower:mian", "main"),
    ],
)
def test_a_wrong_entry_point_is_refused_with_the_near_name(tftool, chase, wrong, near):
    setup = chase / "setup.py"
    setup.write_text(setup.read_text().replace("chase.turtle_follower:main", wrong))

    result = tftool("run", "--simulated", "--for", "1", "chase", "turtle_follower")

    assert result.status == 1
    assert f"; did you mean '{near}'?" in result.err


def test_check_tells_a_person_how_far_a_long_run_has_come(tftool, monkeypatch, capsys):
    monkeypatch.setattr("tftool.commands.check.command.PATIENCE", 0)
    assert "played" not in tftool("check", "robot").err

    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    told = tftool("check", "robot").err.splitlines()

    assert [line for line in told if line.startswith("robot: 12 of ")]
    assert told[-1].endswith(" s played")


def test_a_forgotten_stamp_is_named_once_for_each_frame(tftool, slip):
    link = "link = TransformStamped(child_frame_id='base'); link.header.frame_id = 'map'"
    file = slip(f"{link}; self.sender.sendTransform(link); self.fixed.sendTransform(link)")

    result = tftool("run", "--simulated", "--for", "2", file)

    assert said(result, "header.stamp of 'base' is 0, so lookups at any time but") == 1


@pytest.mark.parametrize(("x", "w", "count"), [("1.0", "0.0", 1), ("0.0", "1.0", 0)])
def test_a_quaternion_with_w_first_is_named(tftool, slip, x, w, count):
    turn = f"link.transform.rotation.x = {x}; link.transform.rotation.w = {w}"
    file = slip(
        f"link = TransformStamped(child_frame_id='base'); {turn}; link.header.frame_id = 'map'; "
        "link.header.stamp = self.get_clock().now().to_msg(); self.sender.sendTransform(link)"
    )

    result = tftool("run", "--simulated", "--for", "2", file)

    assert said(result, "write w = 1.0 if no rotation is meant") == count


def test_a_lookup_in_a_buffer_of_its_own_without_listener_is_named(tftool, slip):
    look = "self.second.can_transform('map', 'base', rclpy.time.Time())"
    file = slip(f"self.send('map', 'base'); {look}", begin="self.second = Buffer()")

    result = tftool("run", "--simulated", "--for", "1", file)

    assert said(result, "nothing fills this buffer: create and store a TransformListener") == 1


def test_a_frame_sent_once_is_no_lookup_at_a_wrong_moment(tftool, slip):
    file = slip(
        "self.send('map', 'base'); "
        "self.look('map', 'lens', self.get_clock().now() - rclpy.duration.Duration(seconds=0.3))",
        begin="self.send('base', 'lens')",
    )

    result = tftool("run", "--simulated", "--for", "4", file)

    assert said(result, "'lens' was sent once") == 1
    assert "not yet known" not in result.err


def test_a_node_destroyed_without_being_spun_is_named(tftool, program):
    last = "rclpy.spin(Asker())"
    file = program(UNFILLED.replace(last, "Asker().destroy_node()\nrclpy.shutdown()"))

    result = tftool("run", "--simulated", "--for", "1", file)

    assert (
        said(result, "'asker' has ended without being spun, so its callback was never called") == 1
    )


@pytest.mark.parametrize(
    ("tick", "told"),
    [
        ("self.count = self.countt + 1", "object has no attribute 'countt'"),
        ("TransformStamped().transform.translation.x = 1", "not 'int': write 1.0"),
    ],
)
def test_a_failure_in_a_callback_is_named_with_its_line(tftool, slip, tick, told):
    result = tftool("run", "--simulated", "--for", "1", slip(tick))

    assert result.status == 1
    assert told in result.err
    assert f", in tick: {tick}" in result.err


def test_degrees_are_named_with_their_line(tftool, slip):
    file = slip("from tf_transformations import quaternion_from_euler as e; e(0, 0, 90)")

    result = tftool("run", "--simulated", "--for", "1", file)

    assert said(result, "takes radians, and 90 looks like degrees: math.radians(90)") == 1


def test_a_callback_that_never_returns_is_named_with_its_line(tftool, slip, monkeypatch):
    monkeypatch.setattr("tftool.ros.host.fibers.PATIENCE", 0.2)
    monkeypatch.setattr("tftool.ros.host.fibers.GIVE_UP", 0.5)

    result = tftool("run", "--simulated", "--for", "1", slip("while True: pass"))

    assert result.status == 1
    assert said(result, "'slip' has been busy for 0.2 s and simulated time waits for it") == 1
    assert ", in tick: while True: pass" in result.err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["run", "chase", "turtle_folower"], "did you mean 'turtle_follower'?"),
        (["run", "chaes", "turtle_follower"], "did you mean 'chase'?"),
        (["launch", "chase", "folower.launch.py"], "The package has follower.launch.py."),
        (["launch", "chaes", "follower.launch.py"], "did you mean 'chase'?"),
    ],
)
def test_a_wrong_executable_package_or_launch_file_is_named(tftool, chase, words, told):
    result = tftool(words[0], "--simulated", "--for", "1", *words[1:])

    assert result.status == 2
    assert told in result.err


def test_a_package_elsewhere_is_refused_with_the_folder_that_was_searched(
    tftool, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)

    result = tftool("run", "--simulated", "--for", "1", "chase", "turtle_follower")

    assert result.status == 2
    assert f"there is no package 'chase' below {tmp_path}" in result.err
