"""Tests of parts of launch and launch_ros that official tutorials and larger systems use."""

import pytest

from tests.ros.test_launch import described
from tests.ros.tutorial import launch
from tftool.base.errors import InputError, NodeFailed, TftoolError, UsageError
from tftool.ros.host.importing import ros_free

ECHO = "ExecuteProcess(cmd=['echo', 'hello there'])"


def test_output_of_a_command_calls_the_on_stdout_handler(tmp_path):
    done = described(
        tmp_path,
        "RegisterEventHandler(OnProcessIO(on_stdout=lambda event: "
        "LogInfo(msg=f'{event.process_name} wrote {event.text.decode().strip()}')))",
        ECHO,
    )

    assert "echo-1 wrote hello there" in done.said("launch")


def test_a_log_message_of_a_node_calls_the_on_stderr_handler(tmp_path):
    (tmp_path / "talk.py").write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('talk')\n"
        "node.get_logger().info('ready')\nrclpy.spin(node)\n"
    )
    done = described(
        tmp_path,
        f"node := Node(executable={str(tmp_path / 'talk.py')!r})",
        "RegisterEventHandler(OnProcessIO(target_action=node, on_stdout=[LogInfo(msg='no')], "
        "on_stderr=lambda event: Shutdown(reason='it is ready') if b'ready' in event.text "
        "else None))",
        "TimerAction(period=9.0, actions=[])",
        seconds=10.0,
    )

    assert done.said("launch") == ["shutting down: it is ready"]


def test_a_process_is_ended_by_an_event_that_matches_its_action(tmp_path):
    (tmp_path / "stay.py").write_text(
        "import rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('stay'))\n"
    )
    done = described(
        tmp_path,
        f"node := Node(executable={str(tmp_path / 'stay.py')!r})",
        "TimerAction(period=1.0, actions=[EmitEvent(event=launch.events.process.ShutdownProcess("
        "process_matcher=launch.events.matches_action(node)))])",
        seconds=10.0,
    )

    assert done.said("stay.py-1")[-1] == "process has finished cleanly"
    assert done.elapsed < 2.0


LIFECYCLE = """
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn


class Machine(LifecycleNode):
    def on_configure(self, state):
        self.get_logger().info('configured')
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        self.get_logger().info('activated')
        return super().on_activate(state)


rclpy.init()
rclpy.spin(Machine('machine'))
"""


@pytest.mark.parametrize(
    "how",
    [
        "LifecycleTransition(lifecycle_node_names=['/machine'], transition_labels=['configure', "
        "'activate'])",
        "GroupAction([RegisterEventHandler(OnStateTransition(target_lifecycle_node=node, "
        "goal_state='inactive', entities=[EmitEvent(event=ChangeState("
        "lifecycle_node_matcher=launch.events.matches_action(node), transition_id=3))])), "
        "EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_node_name('/machine'), "
        "transition_id=1))])",
    ],
)
def test_a_node_with_a_life_cycle_is_configured_and_activated(tmp_path, how):
    (tmp_path / "machine.py").write_text(LIFECYCLE)
    done = described(
        tmp_path,
        f"node := LifecycleNode(executable={str(tmp_path / 'machine.py')!r}, name='machine', "
        "namespace='')",
        how,
        seconds=5.0,
    )

    assert done.texts("machine") == ["configured", "activated"]


def test_a_transition_that_does_not_exist_is_named(tmp_path):
    with pytest.raises(NodeFailed, match="no transition 'activated': use one of create, configure"):
        described(
            tmp_path,
            "LifecycleTransition(lifecycle_node_names=['x'], transition_labels=['activated'])",
        )


def test_a_context_of_ones_own_makes_texts():
    with ros_free():
        import launch
        from launch.substitutions import EnvironmentVariable, LaunchConfiguration

        context = launch.LaunchContext()
        context.launch_configurations["name"] = "value"
        context.environment["TFTOOL_TEST"] = "here"

        assert context.perform_substitution(LaunchConfiguration("name")) == "value"
        assert EnvironmentVariable("TFTOOL_TEST").perform(context) == "here"
        launch.actions.SetLaunchConfiguration("name", "other").visit(context)
        assert context.launch_configurations["name"] == "other"


def test_a_program_may_launch_by_itself(ros_runtime, tmp_path, capfd):
    file = tmp_path / "service.py"
    file.write_text(
        "import sys\nimport launch\nimport launch.logging\n"
        "service = launch.LaunchService(argv=sys.argv[1:])\n"
        "service.include_launch_description(launch.LaunchDescription([\n"
        "    launch.actions.TimerAction(period=3.0, actions=[\n"
        "        launch.actions.LogInfo(msg='three seconds')])]))\n"
        "launch.logging.get_logger('mine').info('before')\n"
        "sys.exit(service.run())\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(2.0)
    assert program.status is None
    ros_runtime.sleep(2.0)

    assert program.status == 0
    captured = capfd.readouterr()
    assert "[INFO] [launch]: three seconds" in captured.err
    assert captured.out == "[INFO] [mine]: before\n"


def test_the_loggers_of_launch_say_and_write_what_is_set(ros_runtime, tmp_path, capsys):
    import launch.logging
    from launch.substitutions import LaunchLogDir

    config = launch.logging.launch_config
    launch.logging.reset()
    config.log_dir = str(tmp_path)
    config.level = "WARNING"
    logger = launch.logging.get_logger("outer.inner")
    assert launch.logging.get_logger("outer") is not logger
    logger.addHandler(config.get_log_file_handler())
    logger.info("too little")
    logger.warning("once")
    config.set_screen_format("{message} of {name}")
    config.set_log_format("{name}: {message}")
    logger.error("again")

    assert capsys.readouterr().out == "[WARNING] [outer.inner]: once\nagain of outer.inner\n"
    first, second = (tmp_path / "launch.log").read_text().splitlines()
    assert first.partition(" ")[2] == "[WARNING] [outer.inner]: once"
    assert second == "outer.inner: again"
    assert LaunchLogDir().perform(launch.LaunchContext()) == str(tmp_path)
    with pytest.raises(ValueError, match="does not exist"):
        config.log_dir = str(tmp_path / "none")
    with pytest.raises(ValueError, match="mixes styles"):
        config.set_screen_format("default", screen_style="%")
    launch.logging.reset()
    assert launch.logging.get_logger("outer").getEffectiveLevel() == config.level == 20


@pytest.mark.parametrize("kind", ["SCREEN", "LOG"])
def test_a_format_in_the_environment_is_taken_or_refused_with_its_name(
    ros_runtime, monkeypatch, capsys, kind
):
    import launch.logging

    name = f"OVERRIDE_LAUNCH_{kind}_FORMAT"
    monkeypatch.setenv(name, "%(message)s")
    with pytest.raises(UsageError, match=rf"{name} must be .*, not '%\(message\)s'"):
        launch.logging.reset()
    monkeypatch.setenv(name, "said {message}")
    launch.logging.reset()
    launch.logging.get_logger("one").info("this")
    said = {"SCREEN": "said this", "LOG": "[INFO] [one]: this"}[kind]
    assert capsys.readouterr().out == f"{said}\n"
    monkeypatch.delenv(name)
    launch.logging.reset()


def test_a_logger_of_launch_writes_by_a_handler_of_one_s_own(ros_runtime, tmp_path):
    import launch.logging
    import launch.logging.handlers

    written = []

    class Kept(launch.logging.handlers.Handler):
        def emit(self, record):
            written.append(self.format(record))

    launch.logging.reset()
    config = launch.logging.launch_config
    config.log_dir = str(tmp_path)
    config.log_handler_factory = lambda path, encoding=None: Kept()
    config.set_log_format("{message}")
    logger = launch.logging.get_logger("kept")
    logger.addHandler(config.get_log_file_handler("own.log"))
    logger.info("this")
    launch.logging.reset()

    assert written == ["this"]
    assert not (tmp_path / "own.log").exists()


@pytest.mark.parametrize("way", ["default", "ROS_LOG_DIR", "ROS_HOME"])
def test_the_folder_of_logs_is_ros_2_s(ros_runtime, monkeypatch, tmp_path, way):
    import launch.logging
    from launch.frontend.parse_substitution import parse_substitution

    for name in ("ROS_LOG_DIR", "ROS_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    if way != "default":
        monkeypatch.setenv(way, str(tmp_path))
    expected = {"default": "home/.ros/log", "ROS_LOG_DIR": "", "ROS_HOME": "log"}[way]
    (found,) = parse_substitution("$(log_dir)")

    assert found.perform(launch.LaunchContext()) == str(tmp_path / expected)


def test_xml_keeps_resets_and_reads_files(tmp_path):
    (tmp_path / "text.txt").write_text("of the file")
    file = tmp_path / "a.launch.xml"
    file.write_text(
        "<launch><let name='a' value='1'/><let name='b' value='2'/>"
        "<group forwarding='false'><keep name='a' value='$(var a)'/>"
        '<log message="a $(var a) b $(var b none)"/></group>'
        "<reset><keep name='b' value='$(var b)'/></reset>"
        '<log message="a $(var a none) b $(var b)"/>'
        f'<log message="text $(file-content {tmp_path}/text.txt)"/></launch>'
    )
    done = launch(file, seconds=1)

    assert done.said("launch") == ["a 1 b none", "a none b 2", "text of the file"]


def test_yaml_gives_a_command_its_environment(tmp_path):
    file = tmp_path / "a.launch.yaml"
    file.write_text(
        "launch:\n- executable:\n    cmd: sh -c 'echo $WHAT'\n"
        "    env:\n    - name: WHAT\n      value: this\n"
    )
    done = launch(file, seconds=1)

    assert "this" in done.said("sh-1")


def test_an_executable_in_a_package_is_found(tmp_path):
    scripts = tmp_path / "mine" / "scripts"
    scripts.mkdir(parents=True)
    (tmp_path / "mine" / "package.xml").write_text("<package><name>mine</name></package>")
    (scripts / "tool.py").write_text("print('tool')\n")
    text = "LogInfo(msg=ExecutableInPackage(package='mine', executable='{}'))"
    done = described(tmp_path, text.format("tool.py"), start=tmp_path)

    assert done.said("launch") == [str(scripts / "tool.py")]
    with pytest.raises(NodeFailed, match="package 'mine' has no executable 'other'"):
        described(tmp_path, text.format("other"), start=tmp_path)


SAYS_WORDS = (
    "import sys\nimport rclpy\ndef main():\n    rclpy.init()\n"
    "    rclpy.create_node('talker').get_logger().info(' '.join(sys.argv[1:]))\n"
)


@pytest.mark.parametrize("executable", ["console", "file.py"])
@pytest.mark.parametrize("way", ["ExecutableInPackage", "ros2 run"])
def test_a_package_s_executable_runs_as_a_process_with_its_own_words(tmp_path, executable, way):
    place = tmp_path / "mine" / "mine"
    place.mkdir(parents=True)
    (tmp_path / "mine" / "package.xml").write_text("<package><name>mine</name></package>")
    (tmp_path / "mine" / "setup.py").write_text(
        "from setuptools import setup\nsetup(name='mine', entry_points={'console_scripts': "
        "['console = mine.file:main']})\n"
    )
    (place / "__init__.py").touch()
    (place / "file.py").write_text(SAYS_WORDS)
    begin = (
        "'ros2', 'run', 'mine', '{}'"
        if way == "ros2 run"
        else "ExecutableInPackage(package='mine', executable='{}')"
    )
    done = described(
        tmp_path,
        f"ExecuteProcess(cmd=[{begin.format(executable)}, 'a', '--b=c'])",
        start=tmp_path,
    )

    assert done.texts("talker") == ["a --b=c"]


def test_environments_are_pushed_popped_and_reset(tmp_path):
    done = described(
        tmp_path,
        "PushEnvironment()",
        "SetEnvironmentVariable('TFTOOL_X', 'inner')",
        "LogInfo(msg=EnvironmentVariable('TFTOOL_X'))",
        "PopEnvironment()",
        "LogInfo(msg=EnvironmentVariable('TFTOOL_X', default_value='gone'))",
        "SetEnvironmentVariable('TFTOOL_X', 'again')",
        "ResetEnvironment()",
        "LogInfo(msg=EnvironmentVariable('TFTOOL_X', default_value='gone'))",
    )

    assert done.said("launch") == ["inner", "gone", "gone"]
    with pytest.raises((NodeFailed, InputError), match="add a PushEnvironment before"):
        described(tmp_path, "PopEnvironment()")


EXTENDED = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.frontend import expose_substitution
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitution import Substitution
from launch.substitutions import ThisLaunchFileDir
from launch.utilities import perform_substitutions


class Shout(Substitution):
    def __init__(self, text):
        self.text = text

    @classmethod
    def parse(cls, data):
        return cls, {"text": data[0]}

    def perform(self, context):
        return perform_substitutions(context, self.text).upper()


expose_substitution("shout-for-the-test")(Shout.parse)


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(
            AnyLaunchDescriptionSource([ThisLaunchFileDir(), "/own.launch.xml"])
        )
    ])
"""


def test_people_may_have_substitutions_of_their_own(tmp_path):
    (tmp_path / "own.launch.xml").write_text(
        '<launch><log message="$(shout-for-the-test moon)"/></launch>'
    )
    (tmp_path / "own.launch.py").write_text(EXTENDED)

    assert launch(tmp_path / "own.launch.py", seconds=5).said("launch") == ["MOON"]


@pytest.mark.parametrize(
    ("text", "made"),
    [
        (r'$(eval "len(\"ab\")")', "2"),
        (r"""$(eval "math.ceil(1.3) + len(sys.argv[:0])" " math,sys ")""", "2"),
        (r"$(eval 1 + 2)", "3"),
        (r"$(env NOT_SET_AT_ALL 'a b')\\", "a b\\"),
    ],
)
def test_texts_are_escaped_and_evaluated_as_in_ros(text, made):
    with ros_free(force=True):
        from launch import LaunchContext
        from launch.frontend.parse_substitution import parse_substitution
        from launch.utilities import perform_substitutions

        assert perform_substitutions(LaunchContext(), parse_substitution(text)) == made


def test_conditions_and_truths_are_those_of_ros():
    with ros_free(force=True):
        from launch import Condition, LaunchContext
        from launch.conditions import (
            IfCondition,
            InvalidConditionExpressionError,
            evaluate_condition_expression,
        )
        from launch.substitutions import (
            AndSubstitution,
            EqualsSubstitution,
            IfElseSubstitution,
            OrSubstitution,
            SubstitutionFailure,
            ThisLaunchFile,
        )

        context = LaunchContext()
        assert not Condition().evaluate(context)
        assert IfCondition("1").describe() == "IfCondition('1')"
        assert evaluate_condition_expression(context, "TRUE")
        with pytest.raises(InvalidConditionExpressionError, match="not 'typo'"):
            IfCondition("typo").evaluate(context)
        for kind in (AndSubstitution, OrSubstitution):
            assert kind("1", "true").perform(context) == "true"
            assert kind("0", "false").perform(context) == "false"
            with pytest.raises(SubstitutionFailure, match="not 'typo'"):
                kind("1", "typo").perform(context)
            with pytest.raises(SubstitutionFailure, match="not 'typo'"):
                kind("0", "typo").perform(context)
        assert EqualsSubstitution("True", "1").perform(context) == "true"
        assert EqualsSubstitution("False", "10").perform(context) == "false"
        assert IfElseSubstitution("on", "a", "b").perform(context) == "a"
        with pytest.raises(RuntimeError, match="if_value or an else_value"):
            IfElseSubstitution("true")
        with pytest.raises(SubstitutionFailure, match="no current launch file"):
            ThisLaunchFile().perform(context)


def test_a_launchs_function_may_register_a_handler(tmp_path):
    (tmp_path / "own.launch.py").write_text(
        "from launch import Event, EventHandler, LaunchDescription\n"
        "from launch.actions import EmitEvent, LogInfo, OpaqueFunction\n"
        "class Met(Event):\n"
        "    name = 'met'\n"
        "def meet(context):\n"
        "    hears = EventHandler(matcher=lambda e: e.name == 'met', entities=LogInfo(msg='hi'))\n"
        "    context.register_event_handler(hears)\n"
        "    return [EmitEvent(event=Met())]\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([OpaqueFunction(function=meet)])\n"
    )

    assert launch(tmp_path / "own.launch.py", seconds=1).said("launch") == ["hi"]


def test_a_handlers_target_must_be_an_action():
    with ros_free(force=True):
        from launch import LaunchContext
        from launch.actions import LogInfo
        from launch.event_handlers import OnProcessExit
        from launch.events.process import ProcessExited

        action = LogInfo(msg="x")
        exited = ProcessExited(action=action, name="ls-1", cmd=["ls"], pid=7, returncode=2)
        handler = OnProcessExit(target_action=action, on_exit=action)

        assert (exited.cmd, exited.pid, exited.cwd) == (["ls"], 7, None)
        assert handler.matches(exited)
        assert handler.handle(exited, LaunchContext()) == [action]
        with pytest.raises(TypeError, match="target_action of OnProcessExit must be an action"):
            OnProcessExit(target_action=3, on_exit=action)


def test_a_python_file_that_imports_rclpy_runs_though_it_is_started_as_a_command(tmp_path):
    (tmp_path / "talk.py").write_text(
        "import sys\nimport rclpy\nrclpy.init()\nnode = rclpy.create_node('talk')\n"
        "node.get_logger().info(f'ready {sys.argv[1:]}')\n"
    )
    done = described(
        tmp_path, f"ExecuteProcess(cmd=['python3', {str(tmp_path / 'talk.py')!r}, 'now'])"
    )

    assert "process has finished cleanly" in done.said("talk.py-1")
    assert done.failed == []


def test_xacro_is_found_by_find_executable_without_ros(tmp_path):
    (tmp_path / "box.urdf").write_text("<robot name='box'><link name='base'/></robot>")
    done = described(
        tmp_path,
        "LogInfo(msg=Command([FindExecutable(name='xacro'), ' ', "
        f"{str(tmp_path / 'box.urdf')!r}]))",
    )

    assert any("<link name='base'" in line for line in done.said("launch"))


def test_launch_arguments_as_a_dictionary_are_refused_with_the_remedy(tmp_path):
    with pytest.raises(TftoolError, match=r"pairs, not a dictionary: write .*\.items\(\)"):
        described(
            tmp_path,
            "IncludeLaunchDescription('other.launch.py', launch_arguments={'speed': '2'})",
        )
