"""Tests of `tftool check --run` and `--launch`: a scenario judges a learner's own nodes."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

TUTORIAL = Path(__file__).parent.parent / "tutorial"
pytestmark = pytest.mark.usefixtures("in_tutorial")
LISTENER = TUTORIAL / "pkg_tf" / "pkg_tf" / "turtle_following.py"
BROADCASTER = TUTORIAL / "pkg_tf" / "pkg_tf" / "turtle_tf_broadcaster.py"

ROOT = TUTORIAL.parent.parent
PAGE = (ROOT / "docs" / "do" / "nodes.md").read_text(encoding="utf-8")
EXERCISE = re.findall(
    r"^```yaml\n(about: Write the listener.*?)^```$",
    (ROOT / "scenarios" / "README.md").read_text(encoding="utf-8"),
    re.MULTILINE | re.DOTALL,
)[0]


@pytest.fixture
def broken(tmp_path):
    """Return a function that writes the tutorial's listener with one line replaced."""

    def change(line, other):
        text = LISTENER.read_text()
        assert line in text
        file = tmp_path / "listener.py"
        file.write_text(text.replace(line, other))
        return file

    return change


@pytest.mark.parametrize(
    "words",
    [
        ["turtles", "--run", f"follower={LISTENER}"],
        ["turtles", "--run", "follower=pkg_tf turtle_following"],
        [
            "turtles",
            *("--run", f"broadcaster1={BROADCASTER} --ros-args -p turtlename:=turtle1"),
            *("--run", f"broadcaster2={BROADCASTER} --ros-args -p turtlename:=turtle2"),
            *("--run", f"follower={LISTENER}"),
        ],
        ["turtles", "--launch", "pkg_tf turtle_following.launch.py"],
        ["carrot", "--launch", "pkg_tf carrot.launch.xml"],
        ["carrot", "--launch", "pkg_tf turtle_following.launch.py source_frame:=carrot1",
         "--run", "pkg_tf fixed_carrot"],
        ["static", "--run", "static=tf2_ros static_transform_publisher 0 0 3 0 0 3.14 A B"],
    ],
)  # fmt: skip
def test_the_tutorials_own_files_pass(tftool, words):
    result = tftool("check", *words)

    assert result.status == 0, result.out
    assert f"{words[0]}  ok  " in result.out


def test_an_exercise_without_the_node_is_judged_with_the_learners(tftool, tmp_path):
    (tmp_path / "exercise.yaml").write_text(EXERCISE)

    without = tftool("check", tmp_path / "exercise.yaml")
    passed = tftool("check", tmp_path / "exercise.yaml", "--run", LISTENER)

    assert (without.status, passed.status) == (1, 0)
    assert "exercise  ok  2 of 2 expectations held" in passed.out
    assert "[INFO] [1002.000000000] [turtle_following]: Successfully spawned turtle2" in passed.err


def test_a_listener_that_looks_the_wrong_way_round_fails_with_what_was_found(tftool, broken):
    file = broken("from_frame_rel,\n", "from_frame_rel[::-1],\n")
    result = tftool("check", "turtles", "--run", f"follower={file}")

    shown = " ".join(result.out.split())
    assert result.status == 1
    assert "turtles FAILED" in shown
    assert (
        "at 10 s: distance from turtle2 to turtle1 is 0.041481 m ± 1e-05 m found at 10 s: " in shown
    )
    assert "at 3 s: distance" not in shown


def test_the_readme_shows_what_a_wrong_listener_is_told(tftool, broken):
    file = broken("math.atan2", "-math.atan2")
    result = tftool("check", "turtles", "--run", f"follower={file}")
    shown = re.findall(r"^```text\n(turtles  FAILED.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)

    assert result.status == 1
    assert [result.out.startswith(block) for block in shown] == [True]


def test_a_listener_that_raises_fails_with_its_own_line(tftool, broken, tmp_path):
    file = broken("msg = Twist()", "msg = Twist(linear=3)")
    result = tftool("check", "turtles", "--run", f"follower={file}", "--junit", tmp_path / "r.xml")

    assert result.status == 1
    assert "'follower' failed: AssertionError: The 'linear' field must be" in result.out
    assert re.search(r"listener\.py:\d+, in on_timer: msg = Twist\(linear=3\)", result.out)
    assert "Traceback" not in result.out + result.err
    suite = ElementTree.parse(tmp_path / "r.xml").getroot()
    assert suite.attrib["errors"] == "1"


@pytest.mark.parametrize(
    ("line", "status", "told"),
    [("import sys; sys.exit(3)", 1, "'follower' ended with exit status 3"), ("x = (", 3, "x = (")],
)
def test_a_listener_that_gives_up_or_is_no_python_fails(tftool, broken, line, status, told):
    file = broken("import math\n", f"{line}\n")
    result = tftool("check", "turtles", "--run", f"follower={file}")

    assert result.status == status
    assert told in result.out + result.err


def test_a_launched_node_that_dies_is_named_by_its_label(tftool, tmp_path, monkeypatch):
    nodes = tmp_path / "mine" / "nodes"
    nodes.mkdir(parents=True)
    (tmp_path / "mine" / "package.xml").write_text("<package><name>mine</name></package>")
    (nodes / "bad.py").write_text("import rclpy\nrclpy.init()\n1 / 0\n")
    (tmp_path / "a.launch.yaml").write_text("launch:\n- node: {pkg: mine, exec: bad.py}\n")
    monkeypatch.chdir(tmp_path)
    result = tftool("check", "two_trees", "--launch", "a.launch.yaml")

    assert result.status == 1
    assert "bad.py-1: process has died, exit status 1: ZeroDivisionError" in result.out


def test_a_launched_command_that_does_not_end_is_ended_with_the_scenario(
    tftool, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tftool.ros.launch.commands.LONGEST_HOLD", 0.1)
    Path("a.launch.yaml").write_text("launch:\n- executable: {cmd: sleep 1000}\n")
    Path("short.yaml").write_text("duration: 0.5\nexpect: []\n")

    result = tftool("check", "short.yaml", "--launch", "a.launch.yaml")

    assert result.status == 0
    assert "sleep-1" not in result.out


def test_a_launch_file_that_asks_for_what_is_not_there_fails_with_its_line(tftool, tmp_path):
    file = tmp_path / "a.launch.xml"
    file.write_text("<launch>\n<node pkg='pkg_tf' exec='folow'/></launch>")
    result = tftool("check", "turtles", "--launch", file)

    assert result.status == 1
    assert f"{file}:2: package 'pkg_tf' has no executable 'folow'" in result.out
    assert "UsageError" not in result.out


def test_the_output_of_programs_goes_to_stderr_and_not_into_the_json(tftool, broken):
    file = broken("import math\n", "import math\nprint('hello')\n")
    result = tftool("check", "turtles", "--run", f"follower={file}", "--json")

    assert json.loads(result.out)[0]["ok"]
    assert "hello\n" in result.err


def test_a_program_named_like_a_node_lives_beside_it(tftool, broken):
    file = broken("import math\n", "import math\n")
    file = file.rename(file.with_name("follower.py"))

    result = tftool("check", "turtles", "--run", file)

    assert f"'{file}' runs in addition to the scenario's own nodes" in result.err
    assert "[turtle_following]: Successfully spawned\n" in result.err
    assert "A turtle named [turtle2] already exists" in result.err


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["--run", "folower=x.py"], 2, "has no node 'folower'; did you mean 'follower'? (it has"),
        (["--run", "follower=x.py", "--launch", "pkg_tf carrot.launch.xml"], 2,
         "no node 'follower' (it has none that can be replaced"),
        (["--run", "follower=gone.py"], 3, "cannot read 'gone.py': No such file"),
        (["--run", "follower=pkg_tf nothing"], 2, "package 'pkg_tf' has no executable 'nothing'"),
        (["--run", 'a "b'], 2, "no closing quotation"),
        (["--run", " "], 2, "--run is empty: give the words that follow 'tftool run'"),
        (["--launch", "gone.launch.py"], 3, "cannot read 'gone.launch.py'"),
        (["--launch", "pkg_tf carrot.launch.xml sorce_frame:=x"], 2, "mean 'source_frame:=…'"),
    ],
)  # fmt: skip
def test_check_refuses_invalid_run_and_launch_options_with_a_reason(tftool, words, status, told):
    result = tftool("check", "turtles", *words)

    assert result.status == status
    assert told in result.err
    assert "Traceback" not in result.err


def test_where_a_real_ros_is_sourced_it_stands_back_unless_told(tftool, tmp_path, monkeypatch):
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").write_text("")
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    monkeypatch.syspath_prepend(tmp_path)
    words = ["check", "turtles", "--run", f"follower={LISTENER}"]

    assert tftool(*words).status == 2
    assert tftool(*words, "--ros-free").status == 0


def test_a_script_stops_a_learners_program_with_its_node(tftool, tmp_path):
    (tmp_path / "stopped.yaml").write_text(
        EXERCISE.replace("expect:", "  - follower\nscript:\n  - {at: 5 s, stop: follower}\nexpect:")
        + "  - {during: [9 s, 20 s], pose: turtle2, value: {linear: 0}}\n"
    )
    result = tftool("check", tmp_path / "stopped.yaml", "--run", f"follower={LISTENER}")

    # The turtle stopped before it reached the goal.
    assert "stopped  FAILED  2 of 3 expectations held" in result.out
    assert "failed:" not in result.out


def test_two_judgements_are_the_same(tftool):
    words = ["check", "turtles", "--launch", "pkg_tf turtle_following.launch.py", "--json"]

    assert tftool(*words) == tftool(*words)


SQUARE = """
launch:
- node: {pkg: turtlesim, exec: turtlesim_node}
- node: {pkg: turtlesim, exec: draw_square}
"""
STILL_THERE = """
duration: 60 s
nodes: [turtlesim]
expect:
- {turtles: [turtle1], at: 50 s}
"""


@pytest.fixture
def drawn(tmp_path):
    (tmp_path / "square.launch.yaml").write_text(SQUARE)
    (tmp_path / "there.yaml").write_text(STILL_THERE)
    return ("check", str(tmp_path / "there.yaml"), "--launch", str(tmp_path / "square.launch.yaml"))


def test_equal_lines_are_shown_once_and_counted_and_others_each(tftool, drawn):
    told = tftool(*drawn)
    whole = tftool(*drawn, "--verbose")

    assert told.status == whole.status == 0
    goals = whole.err.count("] [draw_square]: New goal [")
    assert goals > 10
    shown = re.findall(r"\[draw_square\]: (New goal .*)", told.err)
    assert len(set(shown)) == len(shown) > 4
    counted = re.findall(r"\[draw_square\]: (\d+) more times 'New goal", told.err)
    assert len(shown) + sum(map(int, counted)) + told.err.count("once more 'New goal") == goals
    assert " more" not in whole.err


@pytest.mark.parametrize("command", ["launch", "check"])
def test_an_unreadable_package_in_a_workspace_is_reported_only_with_verbose(
    tftool, drawn, tmp_path, monkeypatch, command
):
    (tmp_path / "odd").mkdir()
    (tmp_path / "odd" / "package.xml").write_bytes(b"<name>\xff</name>")
    monkeypatch.chdir(tmp_path)
    words = ("launch", drawn[-1], "--simulated", "--for", "1") if command == "launch" else drawn

    assert "is skipped" not in tftool(*words).err
    assert "odd' is skipped: cannot read" in tftool(*words, "--verbose").err
