import pytest

from tests.commands.test_described import ROBOT


@pytest.fixture
def robot(tmp_path):
    path = tmp_path / "post.urdf"
    path.write_text(ROBOT)
    return path


def test_a_robot_is_published_without_a_screen(tftool, simulated, robot):
    result = tftool("robot", robot, "--no-screen", "--joint", "turn=0.5", "--for", "2")

    assert result.status == 0
    assert (
        result.out == "Publishing robot 'post': 3 links, 1 moving joint, positions from --joint.\n"
    )
    resting = tftool("robot", robot, "--no-screen", "--for", "2")
    assert resting.out.endswith("1 moving joint, positions at rest.\n")


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        ([], 2, "The sliders need a terminal, and stdin is not a terminal: add --no-screen."),
        (["--no-screen", "--follow", "--joint", "turn=1"], 2, "leave out --joint"),
        (["--no-screen", "--joint", "turm=1"], 2, "did you mean 'turn'?"),
        (["--no-screen", "--link", "lmap"], 2, "has no link 'lmap'; did you mean 'lamp'?"),
        (["--no-screen", "--read-only"], 2, "--read-only publishes nothing"),
    ],
)
def test_robot_refuses_invalid_options_with_a_reason(tftool, simulated, robot, words, status, told):
    result = tftool("robot", robot, *words)

    assert result.status == status
    assert told in result.err


@pytest.mark.parametrize(
    ("name", "status", "told"),
    [
        ("turtles", 2, "'turtles' is a scenario: name a robot description"),
        ("none.urdf", 3, "no file or folder 'none.urdf'"),
    ],
)
def test_only_descriptions_are_taken(tftool, simulated, name, status, told):
    result = tftool("robot", name, "--no-screen")

    assert result.status == status
    assert told in result.err


def test_the_publisher_runs_by_its_ros_name_without_turtles(tftool, robot):
    words = ["robot_state_publisher", "robot_state_publisher", robot]
    result = tftool("run", "--simulated", "--for", "1", *words)

    assert result.status == 0
    assert "turtles" not in result.err


def test_a_robot_whose_joints_are_in_no_order_is_drawn_into_a_file(tftool, tmp_path):
    joint = '<joint name="{1}" type="fixed"><parent link="{0}"/><child link="{1}"/></joint>'
    joints = joint.format("b", "c") + joint.format("a", "b")
    links = "".join(f'<link name="{name}"/>' for name in "abc")
    (tmp_path / "x.urdf").write_text(f'<robot name="x">{links}{joints}</robot>')

    result = tftool("robot", tmp_path / "x.urdf", "-o", tmp_path / "x.svg")

    assert result.status == 0
    # The tip and the root are named; the link between them is at the same place.
    assert ">c, a +1</text>" in (tmp_path / "x.svg").read_text()
