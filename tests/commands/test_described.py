import json

import pytest

from tests.recordings.writers import SECOND, Sent, numbers, write_mcap

ROBOT = """<robot name="post">
  <link name="foot"/><link name="arm"/><link name="lamp"/>
  <joint name="turn" type="revolute">
    <origin xyz="0 0 2"/><parent link="foot"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="bolt" type="fixed">
    <origin xyz="1 0 0"/><parent link="arm"/><child link="lamp"/>
  </joint>
</robot>"""


@pytest.fixture
def robot(tmp_path):
    path = tmp_path / "post.urdf"
    path.write_text(ROBOT)
    return path


def test_tree_shows_the_links_of_a_description(tftool, robot):
    result = tftool("tree", str(robot))

    assert result.status == 0
    assert "└── arm" in result.out
    assert "└── lamp" in result.out
    assert (
        f"Default positions are used for 1 joint: 'tftool info {robot}' shows them." in result.err
    )


def test_echo_answers_between_two_links(tftool, robot):
    result = tftool("echo", "foot", "lamp", str(robot), "--once")

    assert result.status == 0
    assert "- Translation: [1.000, 0.000, 2.000]" in result.out


def test_a_mistake_in_a_description_is_shown_with_its_line(tftool, robot):
    robot.write_text(ROBOT.replace('child link="lamp"', 'child link="lmap"'))

    result = tftool("tree", str(robot))

    assert result.status == 3
    assert "post.urdf:8:" in result.err
    assert "did you mean 'lamp'?" in result.err


def test_info_shows_joints_with_their_limits(tftool, robot):
    result = tftool("info", str(robot))

    assert result.status == 0
    assert "3 links, 2 joints, 1 of them moves" in result.out
    assert "Root: foot" in result.out
    (turn,) = [line for line in result.out.splitlines() if line.startswith("  turn ")]
    assert "arm in foot" in turn
    assert "-1 rad … 1 rad" in turn


def test_info_fails_for_a_mistake_with_which_the_description_is_read(tftool, robot):
    robot.write_text(ROBOT.replace('lower="-1"', 'lower="9"'))
    fault = "post.urdf:5:12: joint 'turn' has no valid position: its lower limit, 9, is above"

    one, two = tftool("info", robot), tftool("info", robot, robot)

    assert (one.status, two.status) == (3, 3)
    assert fault in one.out
    assert two.err.count(fault) == 2
    assert tftool("tree", robot).status == 0


def test_info_for_programs_holds_the_same(tftool, robot):
    told = json.loads(tftool("info", str(robot), "--json").out)

    assert told["root"] == "foot"
    assert [(one["name"], one["upper"]) for one in told["joints"]] == [
        ("turn", 1.0),
        ("bolt", None),
    ]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["doctor"], "without published transforms"),
        (["monitor"], "which sends no messages"),
        (["demo"], "name a scenario instead"),
    ],
)
def test_commands_that_need_more_than_frames_refuse_a_description(tftool, robot, words, told):
    result = tftool(*words, str(robot))

    assert result.status == 2
    assert told in result.err
    assert "Traceback" not in result.err


def test_a_joint_is_where_the_command_line_puts_it(tftool, robot):
    result = tftool("echo", "foot", "lamp", str(robot), "--joint", "turn=90deg")

    assert result.status == 0
    assert result.out.count("- Translation: [0.000, 1.000, 2.000]") == 1
    assert "1.571 rad is beyond its limits, -1 to 1" in result.err
    assert "at rest" not in result.err


def test_tree_marks_joints_that_move_and_says_where_they_are(tftool, robot):
    result = tftool("tree", str(robot), "--joint", "turn=0.5")

    (arm,) = [line for line in result.out.splitlines() if "arm" in line]
    (lamp,) = [line for line in result.out.splitlines() if "lamp" in line]
    assert arm.split(maxsplit=2)[2] == "moving  turn (revolute, 0.5 rad)"
    assert lamp.split(maxsplit=2)[2] == "fixed   bolt (fixed)"


def test_tree_tells_programs_which_frames_move(tftool, robot):
    told = json.loads(tftool("tree", str(robot), "--format", "json").out)

    assert {one["frame"]: one["moves"] for one in told["frames"]} == {
        "foot": False,
        "arm": True,
        "lamp": False,
    }


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--joint", "turm=1"], "has no joint 'turm'; did you mean 'turn'?"),
        (["--joint", "elbow=1"], "has no joint 'elbow'; the movable joints are turn, slide"),
        (["--joint", "bolt=1"], "joint 'bolt' is fixed, so it has no position"),
        (["--joint", "slide=20deg"], "joint 'slide' is prismatic, so its position is a length"),
        (["--joint", "turn"], "write NAME=VALUE"),
        (["--joint", "turn=fast"], "write NAME=VALUE"),
        (["--joint", "turn=nan"], "write NAME=VALUE"),
        (["size:=2"], "contains no xacro, so it has no arguments: leave out size:=2"),
        (["--argument", "size=2"], "write NAME:=VALUE"),
    ],
)
def test_a_description_refuses_unknown_joints_and_wrong_values(tftool, robot, words, told):
    slide = '<joint name="slide" type="prismatic"><parent link="foot"/><child link="tray"/>'
    limit = (
        '<limit lower="0" upper="1" effort="1" velocity="1"/></joint><link name="tray"/></robot>'
    )
    robot.write_text(ROBOT.replace("</robot>", slide + limit))

    result = tftool("tree", str(robot), *words)

    assert result.status == 2
    assert told in result.err


def test_a_scenario_takes_no_joint_positions(tftool):
    result = tftool("tree", "turtles", "--joint", "turn=1")

    assert result.status == 2
    assert "'turtles' is neither a robot description nor a recording: leave out --joint turn=1" in (
        result.err
    )


def test_words_with_an_assignment_are_arguments_of_xacro(tftool, tmp_path):
    pytest.importorskip("xacrodoc")
    path = tmp_path / "post.urdf.xacro"
    path.write_text(
        ROBOT.replace('name="post"', 'name="post" xmlns:xacro="http://www.ros.org/wiki/xacro"')
        .replace("<link", '<xacro:arg name="height" default="2"/><link', 1)
        .replace("0 0 2", "0 0 $(arg height)")
    )

    assert "[1.000, 0.000, 2.000]" in tftool("echo", "foot", "lamp", str(path)).out
    assert "[1.000, 0.000, 7.500]" in tftool("echo", "foot", "lamp", str(path), "height:=7.5").out
    for words in (["echo", "foot", "lamp"], ["tree"], ["info"]):
        told = tftool(*words, str(path), "heigth:=7.5", "zzz:=1")
        assert told.status == 0
        assert "has no xacro argument 'heigth'; did you mean 'height'?\n" in told.err + told.out
        assert "has no xacro argument 'zzz', and ignores its value.\n" in told.err + told.out


@pytest.fixture
def recording(tmp_path):
    """Write a recording of the post's joint, without its description."""
    from tests.recordings.writers import SECOND, Sent, write_mcap

    start = 1_750_000_000 * SECOND
    moves = [
        Sent(stamp, "/joint_states", joints=(stamp, ("turn",), (0.1 * tick,)))
        for tick, stamp in enumerate(range(start, start + SECOND, SECOND // 10))
    ]
    return write_mcap(tmp_path / "run.mcap", moves)


def test_a_recording_takes_the_description_it_lacks(tftool, recording, robot):
    result = tftool("echo", "foot", "arm", recording, "--urdf", robot, "--at", "0.5")

    assert result.status == 0
    assert "- Rotation: in RPY (radian) [0.000, -0.000, 0.500]" in result.out
    assert "The robot's description added 2 frames that are not in tf" in result.err
    assert "joint states move 1 of these frames" in result.err
    assert "Robot: description of 'post'" in tftool("info", recording, "--urdf", robot).out


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["--joint", "turn=1"], 2, "The joints of a recording cannot be set"),
        (["a:=b"], 2, "xacro arguments need a robot description"),
        (["--urdf", "none.urdf"], 3, "cannot read 'none.urdf'"),
    ],
)
def test_a_recording_refuses_joints_and_xacro_arguments(tftool, recording, words, status, told):
    result = tftool("tree", recording, *words)

    assert result.status == status
    assert told in result.err


def test_a_description_takes_no_other(tftool, robot):
    result = tftool("tree", robot, "--urdf", robot)

    assert result.status == 2
    assert "--urdf is only allowed for a recording" in result.err


def test_info_of_a_text_file_and_of_a_scenario_by_its_name(tftool, tmp_path):
    notes = tmp_path / "notes.txt"
    notes.write_text("Buy a second laser.\n")

    unreadable = tftool("info", str(notes))
    misused = tftool("info", "turtles")

    assert unreadable.status == 3
    assert misused.status == 2
    assert "neither a recording (MCAP, rosbag2, ROS 1 bag)" in unreadable.err
    assert "is a scenario, not a recording or robot description" in misused.err


@pytest.mark.parametrize("words", [["view", "-o", "page.html"], ["tree"], ["echo", "map", "base"]])
def test_a_recorded_description_with_elements_of_xacro_is_not_run(
    tftool, tmp_path, monkeypatch, words
):
    monkeypatch.chdir(tmp_path)
    text = (
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="base"/>'
        "<xacro:property name='x' value='${open(\"trap\", \"w\")}'/></robot>"
    )
    base = ((SECOND, "map", "base", numbers(1)),)
    sent = [Sent(SECOND, "/robot_description", text=text), Sent(SECOND, "/tf", base)]
    write_mcap(tmp_path / "run.mcap", sent)

    result = tftool(*words, "run.mcap")

    assert result.status == 3
    assert "still has elements of xacro: expand the original file first" in result.err
    assert [one.name for one in tmp_path.iterdir()] == ["run.mcap"]
