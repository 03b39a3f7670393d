"""Tests of errors in launch files, and of arguments that a launch file does not take."""

import pytest

from tests.ros.test_launch import described
from tests.ros.tutorial import TUTORIAL, launch
from tftool.base.errors import InputError, NodeFailed, UsageError


@pytest.mark.parametrize(
    ("action", "told"),
    [
        ("Node(package='turtlesm', executable='x')", "no package 'turtlesm'.*mean 'turtlesim'"),
        ("Node(package='turtlesim', executable='turtlesim')", "did you mean 'turtlesim_node'"),
        ("Node(package='pkg_tf', executable='follow')", "package 'pkg_tf' has no executable"),
        ("Node(executable='x')", "there is no file 'x' to run; .* package="),
        (
            "Node(executable='sleep')",
            "/sleep' is not a Python file: run it by ExecuteProcess",
        ),
        ("Node(package='turtlesim', executable='turtlesim_node', name='a b')", "'a b' cannot be"),
        ("LogInfo(msg=LaunchConfiguration('x'))", "launch configuration 'x' does not exist"),
        ("DeclareLaunchArgument('x')", "launch argument 'x' .* has no default: pass x:="),
        ("DeclareLaunchArgument('x', default_value='c', choices=['a'])", "one of a, not 'c'"),
        ("LogInfo(msg='', condition=IfCondition('maybe'))", "'true', 'false', '1' or '0', not"),
        ("LogInfo(msg=PythonExpression('1 +'))", r"cannot evaluate the expression '1 \+'"),
        (
            "EmitEvent(event=Shutdown())",
            "EmitEvent needs an event, not a Shutdown of launch.actions",
        ),
        (
            "LogInfo(msg=LocalSubstitution('event.reason'))",
            "'event.reason' has no value here, because there is no 'event'",
        ),
        ("LogInfo(msg=EnvironmentVariable('NO_SUCH'))", "variable 'NO_SUCH' does not exist"),
        ("LogInfo(msg=FindExecutable(name='no-such'))", "no command 'no-such'"),
        (
            "LogInfo(msg=Command('sh -c \\'echo oh >&2\\''))",
            r"wrote to its standard error: oh \(on_stderr='ignore' permits this\)",
        ),
        (
            "LogInfo(msg=Command('true', on_stderr='shout'))",
            "on_stderr must be one of 'fail', 'warn', 'ignore', 'capture', not 'shout'",
        ),
        ("LogInfo(msg=Command('false'))", r"the command \['false'\] failed"),
        ("TimerAction(period='soon', actions=[])", "period must be seconds from 0 .*, not 'soon'"),
        (
            "Node(package='turtlesim', executable='turtlesim_node', parameters=["
            "{'a': ParameterValue(TextSubstitution(text='x'), value_type=int)}])",
            "must be int, not 'x'",
        ),
    ],
)
def test_a_wrong_launch_action_is_a_usage_error_with_its_reason(tmp_path, action, told):
    with pytest.raises((NodeFailed, UsageError), match=told) as refused:
        described(tmp_path, action)

    cause = refused.value.__cause__ or refused.value
    assert isinstance(cause, UsageError)


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("a.py", "x = (", r"a\.py:1:5: SyntaxError: '\(' was never closed\n    x = \(\n        \^"),
        ("a.py", "x = 1", "no function generate_launch_description"),
        ("a.py", "def generate_launch_description(): pass", "must return a LaunchDescription"),
        ("a.py", "import nonesuch", "No module named 'nonesuch'"),
        ("a.py", "from launch.actions import Nod", "'Nod' of launch.actions is not supported"),
        ("a.py", "import launch_testing.junitxml", "launch_testing.junitxml is not supported"),
        (
            "a.py",
            "from launch.actions import LogInfo\ndef generate_launch_description():\n"
            "    return LogInfo(message='x')",
            r"TypeError: .*did you mean 'msg' by 'message'\?\n.*a\.py:3",
        ),
        ("a.launch.xml", "<launch>\n<nod/></launch>", r"xml:2: there is no 'nod'.*mean 'node'"),
        ("a.launch.xml", "<launch>\n<node/></launch>", r"xml:2: 'node' needs the attribute 'exec'"),
        (
            "a.launch.xml",
            '<launch><arg name="a" defualt="1"/></launch>',
            r"xml:1: 'arg' has no attribute 'defualt'; did you mean 'default'",
        ),
        ("a.launch.xml", "<launch>\n<node>", r"xml:2:7: no element found"),
        ("a.launch.xml", "<group/>", "root must be 'launch', not 'group'"),
        (
            "a.launch.xml",
            '<!DOCTYPE a [<!ENTITY b "c">]><launch/>',
            "XML entities are not supported",
        ),
        ("a.launch.xml", '<launch><log message="$(vra x)"/></launch>', r"mean '\$\(var …\)'"),
        ("a.launch.xml", '<launch><log message="$(var"/></launch>', r"not closed by '\)'"),
        ("a.launch.xml", '<launch><log message="$()"/></launch>', "is empty: write a name in it"),
        ("a.launch.xml", '<launch><log message="$(not)"/></launch>', "wrong number of arguments"),
        ("a.launch.xml", '<launch><log message="$(eval \'1)"/></launch>', "quote .* not closed"),
        ("a.launch.yaml", "launch: [", r"yaml:1:10: "),
        ("a.launch.yaml", "node: {}", "one top-level key, 'launch'"),
        ("a.launch.yaml", "launch: {}", "'launch' must be a list of actions"),
        ("a.launch.yaml", "launch:\n- a\n", r"yaml:2: an action must be one key"),
        ("a.launch.yaml", "launch:\n- log: 5\n", r"yaml:2: 'log' needs attributes"),
    ],
)
def test_a_wrong_launch_file_is_refused_with_its_line(tmp_path, name, text, told):
    file = tmp_path / name
    file.write_text(text)

    with pytest.raises(InputError, match=told):
        launch(file, seconds=1)


@pytest.mark.parametrize("name", ["gone.launch.py", "gone.launch.xml", "gone.launch.yaml"])
def test_a_launch_file_that_is_not_there_is_said_so(tmp_path, name):
    with pytest.raises(InputError, match=r"cannot read '.*gone.*': No such file"):
        launch(tmp_path / name, seconds=1)


def test_arguments_nobody_declared_are_refused():
    file = TUTORIAL / "launch" / "turtle_following.launch.py"

    with pytest.raises(UsageError, match="'sourceframe'; did you mean 'source_frame:=…'"):
        launch(file, seconds=1, arguments={"sourceframe": "a"})
    with pytest.raises(UsageError, match=r"no argument 'xyz' \(it declares source_frame\)"):
        launch(file, seconds=1, arguments={"xyz": "a"})


def test_an_argument_the_file_only_mentions_may_be_passed(tmp_path):
    done = described(
        tmp_path,
        "LogInfo(msg=LaunchConfiguration('colour', default='red'))",
        arguments={"colour": "blue"},
    )

    assert done.said("launch") == ["blue"]


def test_an_error_of_a_later_action_ends_the_launch(tmp_path):
    done = described(
        tmp_path,
        "Node(package='turtlesim', executable='turtlesim_node')",
        "TimerAction(period='1.0', actions=[LogInfo(msg=LaunchConfiguration('gone'))])",
        seconds=10,
    )

    assert done.failed == ["launch"]
    assert done.elapsed == 1
    assert "launch configuration 'gone' does not exist" in done.said("launch")[-1]
