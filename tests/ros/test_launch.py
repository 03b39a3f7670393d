"""Tests of launch files on simulated time."""

import pytest

from tests.ros.tutorial import TUTORIAL, Launched, launch
from tftool.base.errors import NodeFailed
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace
from tftool.ros.launch.arguments import show_arguments

HEAD = """
import launch, launch.actions, launch.conditions, launch.event_handlers, launch.events
import launch.substitutions, launch_ros.actions, launch_ros.parameter_descriptions
import launch_ros.substitutions, launch_ros.events, launch_ros.events.lifecycle
import launch_ros.event_handlers, launch.events.process
for module in (launch, launch.actions, launch.conditions, launch.event_handlers,
               launch.substitutions, launch_ros.actions, launch_ros.parameter_descriptions,
               launch_ros.substitutions, launch_ros.event_handlers, launch_ros.events,
               launch_ros.events.lifecycle):
    globals().update({k: getattr(module, k) for k in dir(module) if not k.startswith('_')})
"""


def described(tmp_path, *actions, seconds=2.0, arguments=None, start=TUTORIAL) -> Launched:
    """Launch a Python file with these actions."""
    file = tmp_path / "some.launch.py"
    body = ",\n        ".join(actions)
    file.write_text(
        f"{HEAD}\ndef generate_launch_description():\n    return LaunchDescription([\n"
        f"        {body}\n    ])\n"
    )
    return launch(file, seconds=seconds, arguments=arguments, start=start)


@pytest.mark.parametrize(
    "name", ["turtle_following.launch.py", "carrot.launch.xml", "carrot.launch.yaml"]
)
def test_the_tutorials_launch_files_run_the_same_every_time(name):
    first, second = (launch(TUTORIAL / "launch" / name, seconds=6) for _ in range(2))

    assert "Successfully spawned turtle2" in first.texts("listener")
    assert first.failed == []
    assert first.lines == second.lines
    assert first.places == second.places


def test_a_carrot_is_followed_when_the_argument_says_so():
    plain = launch(TUTORIAL / "launch" / "turtle_following.launch.py", seconds=15)
    carrot = launch(TUTORIAL / "launch" / "carrot.launch.xml", seconds=15)

    assert plain.places["turtle2"][1] == pytest.approx(5.54, abs=0.01)
    assert carrot.places["turtle2"][1] == pytest.approx(7.54, abs=0.02)


def test_arguments_events_groups_includes_and_timers_work_together():
    done = launch(
        TUTORIAL / "launch" / "events.launch.py", seconds=60, arguments={"heading": "-1.5708"}
    )

    assert done.said("launch") == [
        "turning",
        "pkg_tf",
        "good bye",
        "shutting down: all is done",
    ]
    assert "Result: 1.5520 after 98 feedbacks" in done.texts("turner")
    assert "turned -1.5708" in done.said("echo-7")
    assert any("/other/sim" in text for text in done.texts("other/sim"))
    assert done.elapsed < 5


def test_show_args_tells_names_descriptions_defaults_and_choices():
    with ros_free():
        workspace = Workspace(TUTORIAL)
        shown = show_arguments(TUTORIAL / "launch" / "turtle_following.launch.py", workspace)
        more = show_arguments(TUTORIAL / "launch" / "events.launch.py", workspace)
        none = show_arguments(workspace.share("turtlesim") / "launch/multisim.launch.py", workspace)

    assert shown == (
        "Arguments (pass arguments as '<name>:=<value>'):\n\n"
        "    'source_frame':\n        Target frame name.\n        (default: 'turtle1')"
    )
    assert "Valid choices are: ['true', 'false']" in more
    assert "'target_frame':" in more
    assert "No arguments." in none


@pytest.mark.parametrize(
    ("name", "started"),
    [
        ("turtle_tf2_demo", "turtle_tf2_listener-4"),
        ("turtle_tf2_fixed_frame_demo", "fixed_frame_tf2_broadcaster-5"),
        ("turtle_tf2_dynamic_frame_demo", "dynamic_frame_tf2_broadcaster-5"),
        ("turtle_tf2_sensor_message", "turtle_tf2_message_broadcaster-4"),
    ],
)
def test_the_demos_own_launch_files_start_our_nodes(name, started):
    folder = Workspace(TUTORIAL).share("turtle_tf2_py") / "launch"
    done = launch(folder / f"{name}.launch.py", seconds=3)

    assert done.said(started) == ["process started", "process has finished cleanly"]
    assert len(done.places) == 2


def test_two_simulators_live_in_namespaces():
    folder = Workspace(TUTORIAL).share("turtlesim") / "launch"
    done = launch(folder / "multisim.launch.py", seconds=1)

    assert {"turtlesim1/turtle1/pose", "turtlesim2/turtle1/pose"} <= set(done.topics)


# Effects of actions


def test_parameters_of_the_scope_the_file_and_the_node_are_set(tmp_path):
    (tmp_path / "p.yaml").write_text("/**:\n  ros__parameters:\n    background_g: 5\n")
    done = described(
        tmp_path,
        "SetParameter('background_r', 3)",
        "Node(package='turtlesim', executable='turtlesim_node', name='sim', parameters=["
        f"ParameterFile(r'{tmp_path}/p.yaml'), r'{tmp_path}/p.yaml', "
        "{'background_b': LaunchConfiguration('blue', default='7'), "
        "'holonomic': ParameterValue(['tr', 'ue'], value_type=bool)}])",
    )

    assert done.nodes["sim"].parameters.values() == {
        "background_r": 3,
        "background_g": 5,
        "background_b": 7,
        "holonomic": True,
    }


def test_a_misspelt_parameter_of_our_nodes_is_named(tmp_path):
    done = described(
        tmp_path,
        "Node(package='turtle_tf2_py', executable='turtle_tf2_broadcaster', name='b', "
        "parameters=[{'turtlname': 'turtle1'}])",
    )

    assert any("did you mean 'turtlename'?" in text for text in done.texts("b"))


def test_topics_are_renamed_by_the_node_and_by_the_scope(tmp_path):
    done = described(
        tmp_path,
        "SetRemap('/turtle1/cmd_vel', '/elsewhere')",
        "Node(package='pkg_tf', executable='tunable', name='t', "
        "remappings=[('nothing', 'something')])",
    )

    assert done.topics["elsewhere"].count == 4
    assert "turtle1/cmd_vel" not in done.topics


def test_scopes_end_and_conditions_choose(tmp_path):
    done = described(
        tmp_path,
        "SetLaunchConfiguration('x', '1')",
        "GroupAction([SetLaunchConfiguration('x', '2'), LogInfo(msg=LaunchConfiguration('x')), "
        "TimerAction(period=1.0, actions=[LogInfo(msg=['later ', LaunchConfiguration('x')])])], "
        "launch_configurations={'y': '5'})",
        "LogInfo(msg=LaunchConfiguration('x'))",
        "GroupAction([SetLaunchConfiguration('x', '3')], scoped=False)",
        "LogInfo(msg='three', condition=LaunchConfigurationEquals('x', '3'))",
        "LogInfo(msg='not three', condition=LaunchConfigurationNotEquals('x', '3'))",
        "UnsetLaunchConfiguration('x')",
        "LogInfo(msg='unset', condition=LaunchConfigurationEquals('x', None))",
    )

    assert done.said("launch") == ["2", "1", "three", "unset", "later 2"]


def test_substitutions_give_texts(tmp_path, monkeypatch):
    monkeypatch.setenv("COLOUR", "red")
    asked = {
        "EnvironmentVariable('COLOUR')": "red",
        "EnvironmentVariable('NO_SUCH', default_value='none')": "none",
        "PathJoinSubstitution(['a', TextSubstitution(text='b')])": "a/b",
        "PathSubstitution(TextSubstitution(text='a')) / 'b' / ['c', 'd']": "a/b/cd",
        "TextSubstitution(text='a') / 'b'": "a/b",
        "StringJoinSubstitution(['a', 'b'], delimiter='-')": "a-b",
        "PythonExpression(['2 * ', '21'])": "42",
        "ThisLaunchFileDir()": str(tmp_path),
        "ThisLaunchFile()": str(tmp_path / "some.launch.py"),
        "Command(['echo -n ', 'hello'])": "hello",
        "FindExecutable(name='sh')": "/",
        "EqualsSubstitution('1', '1.0')": "true",
        "EqualsSubstitution('True', 'true')": "true",
        "NotEqualsSubstitution('a', 'b')": "true",
        "AndSubstitution('true', '0')": "false",
        "OrSubstitution('false', '1')": "true",
        "NotSubstitution('true')": "false",
        "IfElseSubstitution('true', 'yes', 'no')": "yes",
        "AnonName('node')": "node_1",
    }
    done = described(tmp_path, *(f"LogInfo(msg={text})" for text in asked))

    for said, wanted in zip(done.said("launch"), asked.values(), strict=True):
        assert said == wanted or (wanted == "/" and said.endswith("sh"))


def test_a_command_may_complain_only_where_that_is_said(tmp_path):
    script = tmp_path / "complain.sh"
    script.write_text("echo oh >&2\necho fine\n")
    done = described(
        tmp_path,
        *(
            f"LogInfo(msg=Command('sh {script}', on_stderr='{what}'))"
            for what in ("ignore", "capture", "warn")
        ),
    )

    complaint = f"the command ['sh', '{script}'] wrote to its standard error: oh"
    assert done.said("launch") == ["fine\n", "oh\nfine\n", complaint, "fine\n"]


def test_environment_and_folder_reach_a_process(tmp_path):
    done = described(
        tmp_path,
        "SetEnvironmentVariable('COLOUR', 'green')",
        "SetEnvironmentVariable('SHAPE', 'round')",
        "UnsetEnvironmentVariable('SHAPE')",
        f"ExecuteProcess(cmd=['echo $COLOUR $SHAPE $SIZE; pwd'], cwd=r'{tmp_path}', shell=True, "
        "additional_env={'SIZE': 'big'}, on_exit=LogInfo(msg='over'))",
    )

    assert done.said("echo-1")[1:3] == ["green big", str(tmp_path)]
    assert done.said("launch") == ["over"]


@pytest.mark.parametrize(("status", "failed"), [(0, []), (4, ["launch"])])
def test_a_handler_that_exits_ends_the_launch_with_its_status(tmp_path, status, failed):
    done = described(
        tmp_path,
        f"ExecuteProcess(cmd=['true'], on_exit=lambda event, context: exit({status}))",
        "TimerAction(period=1.5, actions=[LogInfo(msg='late')])",
    )

    assert done.failed == failed
    assert "late" not in done.said("launch")


def test_an_argument_as_on_exit_fails_only_when_the_process_ends(tmp_path):
    done = described(
        tmp_path,
        "LogInfo(msg='begun')",
        "ExecuteProcess(cmd=['sleep', '9'], on_exit=LaunchConfiguration('on_exit'))",
    )

    assert done.said("launch")[0] == "begun"


def test_handlers_hear_of_starts_and_can_be_taken_away(tmp_path):
    done = described(
        tmp_path,
        "(h := RegisterEventHandler(OnProcessStart(on_start=lambda event, context: "
        "LogInfo(msg=event.process_name))))",
        "ExecuteProcess(cmd=['true'])",
        "TimerAction(period=0.5, actions=[UnregisterEventHandler(h.event_handler)])",
        "TimerAction(period=1.0, actions=[ExecuteProcess(cmd=['true'], name='second')])",
        "RegisterEventHandler(OnExecutionComplete(target_action=(last := LogInfo(msg='last')), "
        "on_completion=[Shutdown(reason='enough')]))",
        "TimerAction(period=1.5, actions=[last])",
    )

    assert done.said("launch") == ["true-1", "last", "shutting down: enough"]


def test_an_exit_handler_registered_after_its_process_is_still_called(tmp_path):
    done = described(
        tmp_path,
        "(first := ExecuteProcess(cmd=['true']))",
        "RegisterEventHandler(OnProcessExit(target_action=first, on_exit=LogInfo(msg='next')))",
    )

    assert done.said("launch") == ["next"]


@pytest.mark.parametrize(
    "started",
    [
        "ExecuteProcess(cmd=['true'])",
        "Node(package='turtlesim', executable='turtlesim_node')",
        "Node(package='pkg_tf', executable='turtle_tf_broadcaster')",
    ],
)
def test_a_start_handler_registered_after_its_process_is_still_called(tmp_path, started):
    done = described(
        tmp_path,
        f"(first := {started})",
        "LogInfo(msg='listed')",
        "RegisterEventHandler(OnProcessStart(target_action=first, on_start=LogInfo(msg='next')))",
    )

    assert done.said("launch") == ["listed", "next"]


@pytest.mark.parametrize(
    ("action", "elapsed"),
    [
        ("ExecuteProcess(cmd=['true'])", 0),
        ("TimerAction(period=1.5, actions=[])", 1.5),
        ("Node(package='pkg_tf', executable='rotate', arguments=['0.5'])", 0.5),
    ],
)
def test_a_completion_handler_is_called_when_its_process_or_timer_ends(tmp_path, action, elapsed):
    done = described(
        tmp_path,
        f"RegisterEventHandler(OnExecutionComplete(target_action=(first := {action}), "
        "on_completion=[LogInfo(msg='done'), Shutdown()]))",
        "first",
        "TimerAction(period=0.2, actions=[LogInfo(msg='meanwhile')])",
        "Node(package='turtlesim', executable='turtlesim_node')",
    )

    meanwhile = ["meanwhile"] if elapsed else []
    assert done.said("launch") == [*meanwhile, "done", "shutting down: reason not given"]
    assert done.elapsed == pytest.approx(elapsed, abs=0.01)


def test_a_completion_handler_registered_after_its_action_is_reported(tmp_path):
    done = described(
        tmp_path,
        "(first := ExecuteProcess(cmd=['true']))",
        "RegisterEventHandler("
        "OnExecutionComplete(target_action=first, on_completion=[Shutdown()]))",
    )

    assert done.said("launch") == [
        "this OnExecutionComplete is never called, as in ROS 2: its target_action, of type "
        "ExecuteProcess, was executed earlier. Register the handler before that action"
    ]


def test_handlers_that_set_each_other_off_without_end_are_found_out(tmp_path):
    with pytest.raises(NodeFailed, match="trigger each other without end"):
        described(
            tmp_path, "RegisterEventHandler(OnExecutionComplete(on_completion=LogInfo(msg='x')))"
        )


def test_a_shutdown_comes_after_what_is_listed_below_it(tmp_path):
    done = described(
        tmp_path,
        "Shutdown(reason='enough')",
        "RegisterEventHandler(OnShutdown(on_shutdown=LogInfo(msg='over')))",
    )

    assert done.said("launch") == ["over", "shutting down: enough"]


def test_a_handlers_own_code_that_raises_ends_the_launch_with_its_line(tmp_path):
    done = described(
        tmp_path,
        "ExecuteProcess(cmd=['true'], on_exit=lambda event, context: 1 / 0)",
        "Node(package='turtlesim', executable='turtlesim_node')",
    )

    assert done.failed == ["launch"]
    assert "ZeroDivisionError: division by zero" in done.said("launch")[-1]
    assert "some.launch.py" in done.said("launch")[-1]


def test_a_process_that_fails_is_named_with_its_status(tmp_path):
    done = described(tmp_path, "ExecuteProcess(cmd=['sh', '-c', 'exit 3'])")

    assert done.failed == ["sh-1"]
    assert done.said("sh-1")[-1] == "process has died, exit status 3"


def test_a_node_that_fails_does_not_stop_the_others(tmp_path):
    bad = tmp_path / "pkg" / "scripts"
    bad.mkdir(parents=True)
    (tmp_path / "pkg" / "package.xml").write_text("<package><name>pkg</name></package>")
    (bad / "bad.py").write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('bad')\n"
        "def on_timer():\n    undefined\nnode.create_timer(1.0, on_timer)\nrclpy.spin(node)\n"
    )
    file = tmp_path / "a.launch.yaml"
    file.write_text(
        "launch:\n- node: {pkg: pkg, exec: bad.py}\n"
        "- node: {pkg: turtlesim, exec: turtlesim_node}\n"
    )
    done = launch(file, seconds=3, start=tmp_path)

    assert done.failed == ["bad.py-1"]
    told = done.said("bad.py-1")[-1]
    assert told.startswith("process has died, exit status 1: NameError: name 'undefined'")
    assert "bad.py:5, in on_timer: undefined" in told
    assert done.elapsed == 3


def test_a_node_may_be_a_file_of_no_package(tmp_path):
    file = tmp_path / "alone.py"
    file.write_text(
        "import rclpy, sys\nrclpy.init()\nnode = rclpy.create_node('alone')\n"
        "node.declare_parameter('x', 0)\n"
        "node.get_logger().info(f\"{sys.argv[:2]} {node.get_parameter('x').value}\")\n"
    )
    done = described(
        tmp_path,
        f"Node(executable=r'{file}', name='renamed', arguments=['a'], parameters=[{{'x': 3}}])",
    )

    assert done.texts("renamed") == [f"['{file}', 'a'] 3"]
    assert done.said("alone.py-1") == ["process started", "process has finished cleanly"]


def test_actions_of_an_event_handler_can_substitute_fields_of_its_event(tmp_path):
    done = described(
        tmp_path,
        "(fails := ExecuteProcess(cmd=['sh', '-c', 'exit 3']))",
        "RegisterEventHandler(OnProcessExit(target_action=fails, on_exit=["
        "LogInfo(msg=['exit ', LocalSubstitution('event.returncode')]),"
        "TimerAction(period=1.0, actions=["
        "EmitEvent(event=launch.events.Shutdown(reason='it was')), "
        "LogInfo(msg=['of ', LocalSubstitution('event.process_name')])])]))",
        "RegisterEventHandler(OnShutdown("
        "on_shutdown=[LogInfo(msg=['asked to: ', LocalSubstitution('event.reason')])]))",
    )

    assert done.said("launch") == [
        "exit 3",
        "of sh-1",
        "asked to: it was",
        "shutting down: it was",
    ]


def test_every_element_of_xml_has_its_meaning(tmp_path):
    (tmp_path / "params.yaml").write_text("sim:\n  ros__parameters:\n    background_r: 9\n")
    file = tmp_path / "all.launch.xml"
    file.write_text(
        """<launch>
  <arg name="who" default="x"><choice value="x"/><choice value="y"/></arg>
  <let name="word" value="$(eval '1 + 1')"/>
  <set_env name="COLOUR" value="blue"/>
  <unset_env name="NO_SUCH"/>
  <log message="$(var word) $(env COLOUR) $(anon n) $(not true) $(or false true)"/>
  <log message="$(var other fallback) $(filename)" unless="$(equals a b)"/>
  <group scoped="true">
    <push-ros-namespace namespace="space"/>
    <set_parameter name="background_b" value="4"/>
    <set_remap from="a" to="b"/>
    <node pkg="turtlesim" exec="turtlesim_node" name="sim" output="screen">
      <param from="$(dirname)/params.yaml"/>
      <param name="background_g" value="7" type="int"/>
    </node>
  </group>
  <node pkg="pkg_tf" exec="rotate" name="turner" args="0.5 --x $(var word)" if="false"/>
  <executable cmd="echo one $(var word)" name="told"/>
  <timer period="0.5"><log message="later"/></timer>
  <timer period="1.0"><shutdown reason="end"/></timer>
</launch>
"""
    )
    done = launch(file, seconds=5, start=tmp_path)

    assert done.said("launch") == [
        "2 blue n_1 false true",
        f"fallback {file}",
        "later",
        "shutting down: end",
    ]
    assert done.said("told-2")[1] == "one 2"
    values = done.nodes["space/sim"].parameters.values()
    assert (values["background_g"], values["background_b"]) == (7, 4)
    assert done.elapsed == 1


def test_the_tutorial_runs_live_too():
    import asyncio

    from tftool.messages.turtle_messages import Twist
    from tftool.ros.host.workspace import use_workspace
    from tftool.ros.launch.engine import Launch
    from tftool.world.clock import WallClock, run
    from tftool.world.supervisor import live
    from tftool.world.world import World

    async def until_driven(world):
        driven = asyncio.Event()
        world.topic("turtle2/cmd_vel", Twist).subscribe(lambda twist: driven.set())
        living = asyncio.ensure_future(live(world))
        waiting = asyncio.ensure_future(driven.wait())
        await asyncio.wait({living, waiting}, return_when=asyncio.FIRST_COMPLETED)
        for task in (living, waiting):
            task.cancel()
        await asyncio.gather(living, waiting, return_exceptions=True)
        return world.topic("turtle2/cmd_vel", Twist).latest

    with ros_free():
        workspace = Workspace(TUTORIAL)
        use_workspace(workspace)
        world = World(WallClock())
        Launch(world, TUTORIAL / "launch" / "turtle_following.launch.py", workspace=workspace)
        first = run(world.clock, until_driven(world))

    # This is the tutorial's first command, for the turtles' initial poses.
    assert first.linear.x == pytest.approx(1.933157795, abs=1e-6)
    assert first.angular.z == pytest.approx(1.159866862, abs=1e-4)


def test_a_parameter_file_that_does_not_exist_only_causes_a_warning(tmp_path):
    done = described(
        tmp_path,
        "Node(package='turtlesim', executable='turtlesim_node', name='sim', "
        "parameters=['none.yaml', {'background_r': 7}])",
    )

    assert done.failed == []
    assert done.nodes["sim"].parameters.values()["background_r"] == 7
    assert "Parameter file path is not a file: none.yaml" in done.said("launch")
