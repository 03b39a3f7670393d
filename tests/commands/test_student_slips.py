"""Slips of people who learn: each is named where it happens."""

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
        (tmp_path / "node.py").write_text(text, encoding="utf-8")
        return "node.py"

    return write


def test_a_timer_given_a_call_in_place_of_a_callback_is_named_with_its_line(tftool, program):
    result = tftool("run", "--simulated", "--for", "1", program(TIMER))

    assert "this timer has no callback and calls nothing" in result.err
    assert "node.py:8" in result.err
    assert "self.create_timer(0.1, self.tick())" in result.err


def test_a_buffer_that_nothing_fills_is_named_once(tftool, program):
    result = tftool("run", "--simulated", "--for", "2", program(UNFILLED))

    assert result.err.count("keep a TransformListener(buffer, node) beside it") == 1


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
    assert "the folder 'zed' holds package 'chase': name that" in result.err


def test_a_single_file_of_limited_length_is_recorded_with_for(tftool, tmp_path):
    result = tftool("record", "--max-duration", "3", "-o", tmp_path / "run.mcap", "--in", "static")

    assert result.status == 2
    assert "To stop after so long: --for SECONDS" in result.err
