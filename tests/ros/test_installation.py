"""Tests of parts of a package that ROS 2 would not find after a build."""

import json
import shutil

import pytest


@pytest.fixture
def package(tftool, tmp_path, monkeypatch):
    """Create a package with `tftool new`, in the src folder of a workspace."""
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path / "src")
    tftool("new", "chase")
    return tmp_path / "src" / "chase"


def change(file, old, new=""):
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def faults(result):
    return [one["found"] for one in json.loads(result.out)[0]["expectations"] if not one["ok"]]


ENTRY = '            "turtle_follower = chase.turtle_follower:main",\n'
NO_ENTRY = "add 'turtle_follower = chase.turtle_follower:main' to console_scripts in setup.py"
NO_DEPENDENCY = (
    "package.xml names no dependency on tf2_ros, which chase/turtle_broadcaster.py imports: add "
    "<exec_depend>tf2_ros</exec_depend>"
)
NO_LAUNCH = (
    "setup.py does not install launch/follower.launch.py: add ('share/chase/launch', "
    "['launch/follower.launch.py']) to data_files"
)


@pytest.mark.parametrize("example", ["static", "carrot", "time_travel"])
def test_the_packages_that_new_makes_are_found_whole(tftool, package, example):
    tftool("new", "second", "--example", example)

    result = tftool("check", "--as-ros", "chase", "--as-ros", "second")

    assert result.status == 0
    assert "2 packages, none failed: " in result.out


def test_every_part_that_ros_would_not_find_is_listed(tftool, package):
    change(package / "setup.py", ENTRY)
    change(package / "setup.py", 'glob("launch/*.launch.py")', "[]")
    change(package / "package.xml", "  <exec_depend>tf2_ros</exec_depend>\n")
    (package / "resource" / "chase").unlink()
    (package / "setup.cfg").unlink()

    result = tftool("check", "--as-ros", "chase", "--json")

    assert result.status == 1
    found = faults(result)
    assert found[0].startswith(
        "ament's index does not contain the package: add an empty file 'resource/chase'"
    )
    assert "'install_scripts=$base/lib/chase'" in found[1]
    assert found[2].endswith(NO_ENTRY)
    assert found[3:] == [NO_LAUNCH, NO_DEPENDENCY]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("chase.turtle_follower:main", "chase.turtle_folower:main",
         "names module 'chase.turtle_folower', which does not exist; did you mean "
         "'chase.turtle_follower'?"),
        ("chase.turtle_follower:main", "chase.turtle_follower:mian",
         "names function 'mian', which turtle_follower.py lacks; did you mean 'main'?"),
    ],
)  # fmt: skip
def test_a_wrong_entry_point_is_told_with_the_near_name(tftool, package, old, new, told):
    change(package / "setup.py", old, new)

    assert any(told in fault for fault in faults(tftool("check", "--as-ros", "chase", "--json")))


def test_a_launch_file_that_cmake_does_not_install_is_told(tftool, package):
    (package / "setup.py").unlink()
    make = package / "CMakeLists.txt"
    make.write_text("project(chase)\nament_package()\n")
    assert "add install(DIRECTORY launch" in tftool("check", "--as-ros", "chase").out

    make.write_text("install(DIRECTORY launch\n  DESTINATION share/${PROJECT_NAME})\n")
    assert "install(" not in tftool("check", "--as-ros", "chase").out


def test_data_files_computed_by_a_function_in_setup_py_are_not_judged(tftool, package):
    change(package / "setup.py", 'glob("launch/*.launch.py")', "list_launch_files()")

    assert tftool("check", "--as-ros", "chase").status == 0


@pytest.mark.parametrize(
    ("words", "file", "old", "told"),
    [
        (["run", "chase", "turtle_follower"], "setup.py", ENTRY, NO_ENTRY),
        (["run", "chase", "turtle_broadcaster"], "package.xml",
         "  <exec_depend>tf2_ros</exec_depend>\n", NO_DEPENDENCY),
        (["launch", "chase", "follower.launch.py"], "setup.py", 'glob("launch/*.launch.py")',
         NO_LAUNCH),
        (["launch", "chase", "follower.launch.py"], "setup.py", ENTRY, NO_ENTRY),
    ],
)  # fmt: skip
def test_run_and_launch_say_in_one_line_what_ros_would_not_find(
    tftool, package, words, file, old, told
):
    command, *rest = words
    whole = tftool(command, "--simulated", "--for", "0.1", *rest)
    change(package / file, old, "[]" if "glob" in old else "")
    result = tftool(command, "--simulated", "--for", "0.1", *rest)

    assert "ROS 2" not in whole.err
    lines = [line for line in result.err.splitlines() if "ROS 2 would not find " in line]
    assert [told in line for line in lines] == [True]
    assert lines[0].endswith("'tftool check --as-ros chase' lists all")


def test_a_package_is_named_by_its_folder_and_a_missing_one_by_the_nearest(tftool, package):
    shutil.move(package, package.with_name("folder"))

    assert tftool("check", "--as-ros", "folder").status == 0
    missing = tftool("check", "--as-ros", "chaes")
    assert missing.status == 2
    assert "did you mean 'chase'?" in missing.err
    assert "or a package as --as-ros PACKAGE" in tftool("check").err
