"""Tests of one launch file in Python, XML and YAML, and of errors in each format."""

import re
from pathlib import Path

import pytest

from tests.ros.test_launch import described
from tests.ros.tutorial import TUTORIAL, launch
from tftool.base.errors import InputError, NodeFailed, TftoolError
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace
from tftool.ros.launch.arguments import show_arguments

FILES = Path(__file__).parent / "launch_files"
FORMATS = ["py", "xml", "yaml"]


def whole(ending, **arguments):
    return launch(FILES / f"whole.launch.{ending}", seconds=10, arguments=arguments)


@pytest.mark.parametrize("ending", FORMATS)
def test_a_file_says_the_same_in_each_language(ending):
    done = whole(ending)

    assert done.lines == whole("py").lines
    assert done.said("launch") == ["part: 14", "late news", "shutting down: enough"]
    assert done.said("told-4")[1] == "shape round,flat"
    assert done.nodes["one/sim"].parameters.values() == {
        "background_r": 3,
        "background_g": 5,
        "background_b": 7,
        "holonomic": False,
    }
    assert "Result: -0.4800 after 31 feedbacks" in done.texts("turner")
    assert "two/sim" in done.nodes
    assert done.failed == []
    assert done.elapsed == 3


@pytest.mark.parametrize("ending", FORMATS)
def test_conditions_and_arguments_mean_the_same_in_each_language(ending):
    done = whole(ending, colour="9", second="false")

    assert done.said("launch")[0] == "part: 18"
    assert "two/sim" not in done.nodes
    assert done.said("rotate-2") == []
    assert done.said("told-2")[0] == "process started: echo shape round,flat"


@pytest.mark.parametrize(
    ("cmd", "shell", "written"),
    [
        ("printf [%s] 'one two' three", "false", "[one two][three]"),
        ("printf [%s]  a$(var b)c $(var b)  'd'e ''", "false", "[ax yc][x y][de][]"),
        ("$(var p) [%s] a", "false", "[a]"),
        ("printf [%s] 'one two' $(var b)", "true", "[one two][x][y]"),
    ],
)
def test_a_command_line_is_parted_as_a_shell_does(tmp_path, cmd, shell, written):
    file = tmp_path / "a.launch.xml"
    file.write_text(
        '<launch><let name="b" value="x y"/><let name="p" value="printf"/>'
        f'<executable name="it" cmd="{cmd}" shell="{shell}"/></launch>'
    )

    assert launch(file, seconds=1).said("it-1")[1] == written


def test_a_command_in_xml_may_complain_where_that_is_said(tmp_path):
    file = tmp_path / "a.launch.xml"
    script = tmp_path / "complain.sh"
    script.write_text("echo oh >&2\necho fine\n")
    said = f"<launch><log message=\"$(command 'sh {script}'{{}})\"/></launch>"

    file.write_text(said.format(" ignore"))
    assert launch(file, seconds=1).said("launch") == ["fine\n"]

    file.write_text(said.format(""))
    with pytest.raises(TftoolError, match="wrote to its standard error: oh"):
        launch(file, seconds=1)


@pytest.mark.parametrize("ending", FORMATS)
def test_show_args_is_laid_out_as_ros2_launch_does(ending):
    with ros_free():
        shown = show_arguments(FILES / f"whole.launch.{ending}", Workspace(TUTORIAL))

    # Arguments that are passed to the included file are not arguments of this file.
    assert shown == (
        "Arguments (pass arguments as '<name>:=<value>'):\n\n"
        "    'colour':\n        How blue. Valid choices are: ['7', '9']\n        (default: '7')\n\n"
        "    'second':\n        no description given\n        (default: 'true')"
    )


def test_show_args_shows_defaults_that_are_still_to_be_made(tmp_path):
    file = tmp_path / "a.launch.py"
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import DeclareLaunchArgument\n"
        "from launch.substitutions import EnvironmentVariable, LaunchConfiguration\n"
        "from launch.substitutions import PathJoinSubstitution\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([\n"
        "        DeclareLaunchArgument('a', default_value=LaunchConfiguration('colour')),\n"
        "        DeclareLaunchArgument('b', default_value=PathJoinSubstitution(\n"
        "            [EnvironmentVariable('ART'), 'logs'])),\n"
        "        DeclareLaunchArgument('d', default_value=''),\n"
        "        DeclareLaunchArgument('c', description='Said.', choices=['x'])])\n"
    )
    with ros_free():
        shown = show_arguments(file, Workspace(tmp_path))

    assert "(default: LaunchConfig('colour'))" in shown
    assert "(default: PathJoinSubstitution('EnvVar('ART'), 'logs''))" in shown
    assert "'d':\n        no description given\n        (default: '')" in shown
    assert shown.endswith("    'c':\n        Said. Valid choices are: ['x']")


WRONG = {
    "py": "from launch import LaunchDescription\nfrom launch.actions import LogInfo\n"
    "from launch.substitutions import LaunchConfiguration\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n        LogInfo(msg=LaunchConfiguration('gone'))])\n",
    "xml": "<launch>\n\n\n\n\n<log message='$(var gone)'/></launch>",
    "yaml": "launch:\n\n\n\n\n- log: {message: $(var gone)}\n",
}


@pytest.mark.parametrize("ending", FORMATS)
def test_an_error_while_a_launch_runs_is_reported_with_the_line_of_its_action(tmp_path, ending):
    file = tmp_path / f"a.launch.{ending}"
    file.write_text(WRONG[ending])

    with pytest.raises(NodeFailed) as refused:
        launch(file, seconds=1)

    assert str(refused.value.__cause__) == (
        f"{file}:6: launch configuration 'gone' does not exist here: declare it with "
        "DeclareLaunchArgument before its first use, or pass gone:=…"
    )


@pytest.mark.parametrize(
    ("action", "told"),
    [
        (
            "OpaqueFunction(function=lambda context: context.launch_configurations['gone'])",
            r"some\.launch\.py:\d+: KeyError: 'gone'\n.*some\.launch\.py:\d+, in <lambda>: Opaque",
        ),
        (
            "RegisterEventHandler(OnExecutionComplete(on_completion=lambda event, context: 1 / 0))",
            r"ZeroDivisionError: division by zero\n.*some\.launch\.py:\d+, in <lambda>",
        ),
        ("'turtlesim'", "a launch description must contain actions, not 'turtlesim'"),
        ("OpaqueFunction(function=lambda context: ['x'])", "must contain actions, not 'x'"),
    ],
)
def test_an_error_in_launch_file_code_ends_the_launch_with_an_explanation(tmp_path, action, told):
    with pytest.raises(NodeFailed) as refused:
        described(tmp_path, action)

    assert isinstance(refused.value.__cause__, TftoolError)
    assert re.search(told, str(refused.value.__cause__))


@pytest.mark.parametrize("ending", ["py", "xml"])
def test_a_file_that_includes_itself_is_found_out(tmp_path, ending):
    file = tmp_path / f"a.launch.{ending}"
    file.write_text(
        {
            "xml": "<launch><include file='$(filename)'/></launch>",
            "py": "from launch import LaunchDescription\n"
            "from launch.actions import IncludeLaunchDescription\n"
            "def generate_launch_description():\n"
            "    return LaunchDescription([IncludeLaunchDescription(__file__)])\n",
        }[ending]
    )

    with pytest.raises(NodeFailed, match="is nested in 50 included launch files: check"):
        launch(file, seconds=1)


def test_a_file_is_included_from_beside_the_one_that_includes_it(tmp_path):
    below = tmp_path / "below"
    below.mkdir()
    (tmp_path / "a.launch.xml").write_text(
        "<launch><include file='$(dirname)/below/b.launch.xml'/><log message='$(filename)'/>"
        "</launch>"
    )
    (below / "b.launch.xml").write_text(
        "<launch><include file='$(dirname)/c.launch'>"
        "<arg name='from' value='$(filename)'/></include></launch>"
    )
    (below / "c.launch").write_text(
        "<launch><arg name='deep' default='1'/><log message='$(var deep) $(var from)'/></launch>"
    )
    file = tmp_path / "a.launch.xml"
    done = launch(file, seconds=1, arguments={"deep": "2"})

    assert done.said("launch") == [f"2 {below / 'b.launch.xml'}", str(file)]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("<node pkg='p' exec='e'>\n<parm name='a' value='1'/></node>",
         ":3: 'node' cannot contain 'parm'; did you mean 'param'?"),
        ("<node pkg='p' exec='e'>\n<param name='a' vale='1' value='1'/></node>",
         ":3: 'param' has no attribute 'vale'; did you mean 'value'?"),
        ("<node pkg='p' exec='e'><remap frm='a' to='b'/></node>",
         ":2: 'remap' needs the attribute 'from'"),
        ("<node pkg='p' exec='e'><param name='a' value='1' type='itn'/></node>",
         "list_of_bool, not 'itn'; did you mean 'int'?"),
        ("<node pkg='p' exec='e' on_exit='stop'/>", "on_exit must be 'shutdown', not 'stop'"),
        ("<node_container pkg='p' exec='e' namespace=''/>",
         ":2: 'node_container' needs the attribute 'name'"),
        ("<load_composable_node targt='x'/>",
         ":2: 'load_composable_node' needs the attribute 'target'"),
        ("<node pkg='p' exec='e'>\n<param name='a' value='1,x' value-sep=',' type='lst_of_int'/>"
         "</node>", "not 'lst_of_int'; did you mean 'list_of_int'?"),
        ("<arg name='a'><choise value='1'/></arg>", "contain 'choise'; did you mean 'choice'?"),
        ("<log message='$(find-pkg-shar x)'/>", "mean '$(find-pkg-share …)'?"),
        ("<group scoped='ture'/>", ":2: 'scoped' of 'group' must be true or false, not 'ture'"),
        ("<executable cmd=\"echo 'a\"/>", ":2: a quote in 'echo 'a' is not closed"),
    ],
)  # fmt: skip
def test_a_mistake_in_xml_is_told_with_its_line_and_the_nearest_word(tmp_path, text, told):
    file = tmp_path / "a.launch.xml"
    file.write_text(f"<launch>\n{text}\n</launch>")

    with pytest.raises(InputError) as refused:
        launch(file, seconds=1)

    assert str(file) in str(refused.value)
    assert told in str(refused.value)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("from launch.actions import OpaqueCoroutine", "of launch.actions is not supported"),
        ("from launch.actions import GroupActon", "is not supported; did you mean 'GroupAction'?"),
        (
            "import launch_ros.remap_rules",
            "launch_ros.remap_rules is not supported",
        ),
    ],
)
def test_an_unsupported_name_is_named_with_where_to_look(tmp_path, line, told):
    file = tmp_path / "a.launch.py"
    file.write_text(f"{line}\n")

    with pytest.raises(InputError) as refused:
        launch(file, seconds=1)

    assert told in str(refused.value)
    assert "page 'Supported parts of ROS' in tftool's docs" in str(refused.value)
    assert f"a.launch.py:1, in <module>: {line}" in str(refused.value)


def test_an_encoding_that_does_not_exist_is_named(tmp_path):
    file = tmp_path / "a.launch.xml"
    file.write_text('<?xml version="1.0" encoding="klingon"?><launch/>')

    with pytest.raises(InputError, match=r"a\.launch\.xml:1: unknown encoding: klingon; save"):
        launch(file, seconds=1)


def test_a_launch_file_that_is_run_as_a_node_names_the_command_for_it(tmp_path):
    from tftool.base.errors import UsageError
    from tftool.ros.host.workspace import Workspace
    from tftool.ros.running import find_program

    with pytest.raises(UsageError, match=r"x\.launch\.py' is a launch file: 'tftool launch x"):
        find_program(Workspace(tmp_path), "x.launch.py", [])


def test_every_tag_of_the_table_belongs_to_an_action_or_a_substitution():
    from tftool.ros.host.import_table import tagged
    from tftool.ros.host.importing import load
    from tftool.ros.launch.description import Action
    from tftool.ros.launch.substitutions import Substitution

    assert {"node", "set_env", "$var", "$find-pkg-share"} <= tagged().keys()
    for tag, name in tagged().items():
        assert issubclass(load(name), Substitution if tag.startswith("$") else Action), tag
