"""Tests of `tftool new`: the created packages and scenarios fulfil their own tests."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import tftool as package

STEPS = ("static", "broadcaster", "follower", "carrot", "orbit", "time_travel")


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def files(path):
    return {str(one.relative_to(path)) for one in path.rglob("*") if one.is_file()}


@pytest.mark.parametrize("step", STEPS)
def test_a_new_package_fulfils_its_own_scenario(tftool, place, step):
    assert tftool("new", "my_frames", "--example", step).status == 0

    result = tftool(
        "check",
        f"my_frames/scenarios/{step}.yaml",
        "--launch",
        f"my_frames/launch/{step}.launch.py",
    )
    assert result.status == 0, result.out
    assert "ok" in result.out


@pytest.mark.parametrize("step", STEPS)
def test_the_scenario_holds_with_the_built_in_nodes_too(tftool, place, step):
    tftool("new", "my_frames", "--example", step)

    assert tftool("check", f"my_frames/scenarios/{step}.yaml").status == 0


def test_without_an_example_there_is_a_broadcaster_and_a_listener(tftool, place):
    result = tftool("new", "my_frames")

    assert files(place / "my_frames") == {
        "package.xml",
        "setup.cfg",
        "setup.py",
        "resource/my_frames",
        "my_frames/__init__.py",
        "my_frames/turtle_broadcaster.py",
        "my_frames/turtle_follower.py",
        "launch/follower.launch.py",
        "test/test_follower.py",
        "scenarios/follower.yaml",
    }
    assert "tftool launch my_frames/launch/follower.launch.py" in result.out


def test_the_package_is_called_by_its_name_everywhere(tftool, place):
    tftool("new", "src/my_frames", "--example", "carrot")

    texts = [one.read_text() for one in (place / "src").rglob("*") if one.is_file()]
    assert not [text for text in texts if "learning_tf" in text]
    setup = (place / "src/my_frames/setup.py").read_text()
    assert "fixed_carrot = my_frames.fixed_carrot:main" in setup
    assert "time_traveller" not in setup


def test_the_tests_of_every_step_pass_without_ros(tmp_path):
    examples = Path(package.__file__).parents[1] / "examples"
    if not examples.is_dir():
        examples = Path(package.__file__).parent / "examples"

    told = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "tftool.ros.pytest_plugin",
         "-p", "no:cacheprovider", "--ros-free", str(examples / "learning_tf")],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip

    assert f"{len(STEPS)} passed" in told.stdout


def test_a_scenario_is_made_and_holds(tftool, place):
    result = tftool("new", "mine", "--scenario")

    assert "mine.yaml" in result.out
    assert tftool("check", "mine.yaml").status == 0


@pytest.mark.parametrize("words", [["my_frames"], ["mine.yaml", "--scenario"]])
def test_new_refuses_to_overwrite_an_existing_file(tftool, place, words):
    (place / words[0]).write_text("mine")

    result = tftool("new", *words)

    assert result.status == 2
    assert "exists already" in result.err
    assert (place / words[0]).read_text() == "mine"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["Bad-Name"], "is not a valid package name"),
        (["import"], "of Python"),
        (["random"], "of Python"),
        (["my_frames", "--example", "carot"], "there is no example 'carot'"),
        (["rclpy"], "a package of ROS 2"),
        (["geometry_msgs"], "a package of ROS 2"),
        (["mine.yaml"], "With --scenario, the name is that of a scenario file."),
    ],
)
def test_a_name_that_would_not_do_is_refused(tftool, place, words, said):
    result = tftool("new", *words)

    assert result.status == 2
    assert said in result.err
    assert files(place) == set()


def test_a_folder_that_cannot_be_written_is_said(tftool, place):
    (place / "file").write_text("")

    result = tftool("new", "file/my_frames")

    assert result.status == 3
    assert "cannot be created" in result.err


@pytest.mark.parametrize("step", STEPS)
def test_an_exercise_fails_its_scenario_until_its_lines_are_written(tftool, place, step):
    made = tftool("new", "mine", "--example", step, "--exercise")
    tftool("new", "solved", "--example", step)
    judge = ("check", f"mine/scenarios/{step}.yaml", "--launch", f"mine/launch/{step}.launch.py")

    assert (made.status, "Write the lines marked TODO." in made.out) == (0, True)
    blank = [one for one in (place / "mine").rglob("*.py") if "TODO" in one.read_text()]
    solved = [place / "solved" / "solved" / one.name for one in blank]
    assert blank
    assert all(one.parent == place / "mine" / "mine" for one in blank)
    assert tftool(*judge).status == 1

    for one, solution in zip(blank, solved, strict=True):
        one.write_text(solution.read_text())
    assert tftool(*judge).status == 0


def test_a_package_of_one_empty_node_runs_by_its_name_and_builds(tftool, place):
    made = tftool("new", "pkg_tf", "--node-name", "turtle_tf_broadcaster")

    assert made.status == 0
    assert files(place / "pkg_tf") == {
        "package.xml",
        "setup.cfg",
        "setup.py",
        "resource/pkg_tf",
        "pkg_tf/__init__.py",
        "pkg_tf/turtle_tf_broadcaster.py",
    }
    setup = (place / "pkg_tf" / "setup.py").read_text()
    assert '"turtle_tf_broadcaster = pkg_tf.turtle_tf_broadcaster:main",' in setup
    assert "learning_tf" not in setup
    ran = subprocess.run(
        [sys.executable, "-m", "tftool", "run", "pkg_tf", "turtle_tf_broadcaster"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ran.returncode, ran.stdout) == (0, "Hi from pkg_tf.\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("a", "--node-name", "my-node"), "is not a valid node name"),
        (("a", "--node-name", "class"), "is not a valid node name"),
        (("a", "--node-name", "b", "--exercise"), "--exercise and --node-name exclude each other"),
        (("a", "--scenario", "--exercise"), "--scenario makes a file, not a package"),
    ],
)
def test_words_that_make_no_package_are_refused(tftool, place, words, said):
    result = tftool("new", *words)

    assert result.status == 2
    assert said in result.err
    assert list(place.iterdir()) == []


def test_json_lists_the_files_and_the_next_commands(tftool, place):
    result = tftool("new", "my_frames", "--json")

    told = json.loads(result.out)
    assert set(told["files"]) == files(place / "my_frames")
    assert "tftool launch my_frames/launch/follower.launch.py" in [
        one["command"] for one in told["next"]
    ]
