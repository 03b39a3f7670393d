"""Tests of launch files and scripts of static transforms, read without running them."""

import pytest

from tftool import InputError
from tftool.recordings.find import Kind, find
from tftool.robots.static_publishers import load_statics

NEW = "--x 1 --y -2 --z 0.5 --qz 1 --qw 0 --frame-id base --child-frame-id laser"

FILES = {
    "script.sh": f"""#!/bin/sh
# ros2 run tf2_ros static_transform_publisher 0 0 0 0 0 0 nothing here
ros2 run tf2_ros static_transform_publisher {NEW} &
wait
""",
    "broken_over_lines.sh": """ros2 run tf2_ros static_transform_publisher \\
  --x 1 --y -2 --z 0.5 \\
  --qz 1 --qw 0 --frame-id base --child-frame-id laser > /dev/null
""",
    "ros1.sh": "rosrun tf2_ros static_transform_publisher 1 -2 0.5 0 0 1 0 base laser\n",
    "ros1.launch": """<launch>
  <arg name="unused" default="$(find nothing)"/>
  <group><node pkg="tf" type="static_transform_publisher" name="a"
     args="1 -2 0.5 0 0 1 0 base laser 100"/></group>
</launch>
""",
    "file.launch.xml": f"""<?xml version="1.0"?>
<!-- a comment -->
<launch><node pkg="tf2_ros" exec="static_transform_publisher" args="{NEW}"/></launch>
""",
    "file.launch.yaml": f"""launch:
- arg: {{name: a, default: b}}
- group:
  - node:
      pkg: tf2_ros
      exec: static_transform_publisher
      args: "{NEW}"
""",
    "file.launch.py": f"""from launch import LaunchDescription
from launch_ros.actions import Node
raise SystemExit("this is never run")

def generate_launch_description():
    return LaunchDescription([Node(
        package="tf2_ros", executable="static_transform_publisher",
        arguments={NEW.split()!r})])
""",
    "numbers.launch.py": """from launch_ros.actions import Node
def generate_launch_description():
    return [Node(package="tf2_ros", node_executable="static_transform_publisher",
        arguments=[1, -2, 0.5, 0, 0, 1, 0, "base", "laser"])]
""",
}


@pytest.mark.parametrize("name", FILES)
def test_the_link_is_read_whatever_file_publishes_it(tmp_path, name):
    path = tmp_path / name
    path.write_text(FILES[name])

    assert find(str(path)).kind is Kind.STATICS
    found = load_statics(path)

    assert found.notes == ()
    held = found.buffer.lookup_transform("base", "laser").transform
    assert held.translation == (1.0, -2.0, 0.5)
    assert abs(held.rotation.z) == 1.0


def test_a_publisher_with_computed_arguments_is_ignored_with_a_note(tmp_path):
    path = tmp_path / "some.launch.py"
    path.write_text(
        FILES["numbers.launch.py"]
        + "    x = Node(executable='static_transform_publisher', arguments=[A, 'b'])\n"
    )

    found = load_statics(path)

    assert len(found.links) == 1
    assert "some.launch.py:5: a static_transform_publisher was ignored" in found.notes[0]


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("a.launch.xml", "<launch><node", "not XML"),
        ("a.launch.xml", '<!DOCTYPE x [<!ENTITY a "b">]><launch>&a;</launch>', "DOCTYPE"),
        ("a.launch.xml", "<launch/>", "The file has no static_transform_publisher"),
        ("a.launch.yaml", "launch: [", "not YAML"),
        ("a.launch.py", "def generate_launch_description():\n    (", "not Python"),
        ("a.sh", "static_transform_publisher 1 2 3\n", "8 words"),
        ("a.launch.xml", '<launch><node exec="static_transform_publisher" args="$(v)"/></launch>',
         "computed at run time"),
    ],
)  # fmt: skip
def test_a_file_without_readable_transforms_is_refused_with_the_reason(tmp_path, name, text, told):
    path = tmp_path / name
    path.write_text(text)

    with pytest.raises(InputError, match=told):
        load_statics(path)


def test_degrees_in_a_launch_file_are_noted(tmp_path):
    path = tmp_path / "a.sh"
    path.write_text("static_transform_publisher 0 0 0 90 0 0 a b\n")

    found = load_statics(path)

    assert len(found.links) == 1
    assert "a.sh:1: Angles are radians, and 90 is more than a full turn" in found.notes[0]


def test_a_scenario_may_speak_of_the_publisher(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text("about: as static_transform_publisher does\nduration: 1 s\nnodes: []\n")

    assert find(str(path)).kind is Kind.SCENARIO


def test_a_launch_file_is_asked_like_any_frames(tmp_path, capsys):
    from tftool.app.main import main

    path = tmp_path / "file.launch.xml"
    path.write_text(FILES["file.launch.xml"])

    assert main(["echo", "base", "laser", str(path)]) == 0
    assert main(["doctor", str(path)]) == 2
    capsys.readouterr()
    assert main(["info", str(path)]) == 0
    assert capsys.readouterr().out == f"{path}: file of static transforms, 1 static transform\n"
    assert main(["tree", str(path), "--joint", "a=1"]) == 2
