"""Tests of actions and parameters that only some launch files use, on simulated time."""

import pytest

from tests.ros.test_launch import described
from tests.ros.tutorial import TUTORIAL, launch


@pytest.fixture
def brief(tmp_path):
    """Create a package with a node that logs its parameters and ends after 0.7 s."""
    nodes = tmp_path / "mine" / "scripts"
    nodes.mkdir(parents=True)
    (tmp_path / "mine" / "package.xml").write_text("<package><name>mine</name></package>")
    (nodes / "brief.py").write_text(
        "import rclpy\nrclpy.init()\n"
        "node = rclpy.create_node('brief', automatically_declare_parameters_from_overrides=True)\n"
        "own = ('use_sim_time', 'start_type_description_service')\n"
        "told = sorted(f'{name}={one.value}' for name, one in\n"
        "              node.get_parameters_by_prefix('').items() if name not in own\n"
        "              or one.value is True and name == 'use_sim_time')\n"
        "node.get_logger().info(' '.join(told))\n"
        "node.create_timer(0.7, rclpy.shutdown)\nrclpy.spin(node)\n"
    )
    return tmp_path


def test_a_node_that_ended_is_started_again(brief):
    done = described(
        brief,
        "Node(package='mine', executable='brief.py', respawn=True, respawn_delay=2.0)",
        seconds=6,
        start=brief,
    )

    started = [record.stamp - 1000 * 10**9 for record in done.records if record.node == "brief"]
    assert started == [0, 2_700_000_000, 5_400_000_000]
    assert done.said("brief.py-1").count("process started") == 3
    assert done.failed == []


def test_a_command_that_ends_at_once_is_not_started_for_ever(tmp_path):
    done = described(tmp_path, "ExecuteProcess(cmd=['true'], respawn=True)", seconds=1)

    assert done.said("true-1").count("process started: true") == 10 + 1


def test_a_node_that_ended_may_end_the_launch(brief):
    done = described(
        brief,
        "Node(package='mine', executable='brief.py', respawn=True, "
        "on_exit=[LogInfo(msg='over'), Shutdown(reason=['that ', 'was it'])])",
        seconds=6,
        start=brief,
    )

    assert done.said("launch") == ["over", "shutting down: that was it"]
    assert done.elapsed == 0.7


def test_parameters_of_each_kind_and_place_arrive(brief):
    (brief / "one.yaml").write_text("brief:\n  ros__parameters:\n    late: $(var who)\n")
    (brief / "all.yaml").write_text("/**:\n  ros__parameters:\n    everywhere: 1.5\n")
    done = described(
        brief,
        "SetLaunchConfiguration('who', 'me')",
        "SetUseSimTime(True)",
        f"SetParametersFromFile(r'{brief}/all.yaml')",
        "Node(package='mine', executable='brief.py', parameters=["
        "{'a': 1, 'b': {'c': 2.5}, 'names': ['x', 'y'], 'flag': True, "
        "'one': ['x', LaunchConfiguration('who')]}, "
        f"ParameterFile(r'{brief}/one.yaml', allow_substs=True)])",
        start=brief,
    )

    assert done.texts("brief") == [
        "a=1 b.c=2.5 everywhere=1.5 flag=True late=me names=['x', 'y'] one=xme use_sim_time=True"
    ]


def test_a_node_that_needs_its_own_terminal_is_not_started_and_a_command_is_named(tmp_path):
    done = described(
        tmp_path,
        "Node(package='rviz2', executable='rviz2', arguments=['-d', 'a.rviz'])",
        "Node(package='turtlesim', executable='turtle_teleop_key', prefix='xterm -e')",
        "Node(package='turtlesim', executable='turtlesim_node', namespace='there')",
    )

    assert done.said("launch") == [
        "not started: 'rviz2 rviz2' needs a terminal of its own: run 'tftool view' in another "
        "terminal.",
        "prefix of a Node has no effect here",
        "not started: 'turtlesim turtle_teleop_key' needs a terminal of its own: run 'tftool "
        "teleop' in another terminal.",
    ]
    assert [str(one) for one in done.records if "Starting" in one.text] == [
        "[INFO] [1000.000000000] [there.turtlesim]: "
        "Starting turtlesim with node name /there/turtlesim"
    ]
    assert done.failed == []


def test_node_options_without_effect_in_one_process_are_reported(brief):
    done = described(
        brief,
        "Node(package='mine', executable='brief.py', prefix='xterm -e', cwd='/', output='screen', "
        "emulate_tty=True)",
        start=brief,
    )

    assert done.said("launch") == ["prefix and cwd of a Node have no effect here"]


def test_a_group_forwards_what_it_is_told_to(tmp_path):
    done = described(
        tmp_path,
        "SetLaunchConfiguration('who', 'me')",
        "GroupAction([LogInfo(msg=[LaunchConfiguration('who', default='nobody'), ' ', "
        "LaunchConfiguration('given')])], forwarding=False, "
        "launch_configurations={'given': LaunchConfiguration('who')})",
        "ResetLaunchConfigurations({'left': LaunchConfiguration('who')})",
        "LogInfo(msg=[LaunchConfiguration('left'), LaunchConfiguration('who', default=' alone')])",
    )

    assert done.said("launch") == ["nobody me", "me alone"]


def test_rarer_substitutions_give_texts_too(tmp_path):
    asked = {
        "AnySubstitution('false', 'true')": "true",
        "AllSubstitution('false', 'true')": "false",
        "PythonExpression([\"os.path.basename('/a/b')\"], python_modules=['os.path'])": "b",
        "FindPackageShare('pkg_tf').find('pkg_tf')": str(TUTORIAL),
    }
    done = described(
        tmp_path,
        "AppendEnvironmentVariable('SHAPES', 'round', separator=',')",
        "AppendEnvironmentVariable('SHAPES', 'flat', prepend=True, separator=',')",
        *(f"LogInfo(msg={text})" for text in asked),
        "LogInfo(msg=EnvironmentVariable('SHAPES'))",
        "OpaqueFunction(function=lambda context: LogInfo("
        "msg=context.perform_substitution(EnvironmentVariable('SHAPES'))))",
    )

    assert done.said("launch") == [*asked.values(), "flat,round", "flat,round"]


PARAMETERS = {
    "xml": """<launch>
  <set_use_sim_time value="true"/>
  <set_parameters_from_file filename="$(dirname)/all.yaml"/>
  <node pkg="mine" exec="brief.py" args="--ros-args -p last:=2" ros_args="--log-level info">
    <param name="outer">
      <param name="one" value="1.5"/><param name="two" value="x" type="str"/>
    </param>
    <param name="digits" value="007" type="str"/>
    <param from="$(dirname)/one.yaml" allow_substs="true"/>
    <env name="A" value="b"/>
  </node>
</launch>""",
    "yaml": """launch:
- set_use_sim_time: {value: true}
- set_parameters_from_file: {filename: $(dirname)/all.yaml}
- node:
    pkg: mine
    exec: brief.py
    args: --ros-args -p last:=2
    ros_args: --log-level info
    env: [{name: A, value: b}]
    param:
    - name: outer
      param: [{name: one, value: 1.5}, {name: two, value: x}]
    - {name: digits, value: '007', type: str}
    - {from: $(dirname)/one.yaml, allow_substs: true}
""",
}


@pytest.mark.parametrize("ending", PARAMETERS)
def test_parameters_are_given_in_xml_and_yaml_alike(brief, ending):
    (brief / "all.yaml").write_text("/**:\n  ros__parameters:\n    everywhere: [1, 2]\n")
    (brief / "one.yaml").write_text("brief:\n  ros__parameters:\n    here: $(dirname)\n")
    file = brief / f"a.launch.{ending}"
    file.write_text(PARAMETERS[ending])
    done = launch(file, seconds=2, start=brief)

    assert done.texts("brief") == [
        f"digits=007 everywhere=[1, 2] here={brief} last=2 outer.one=1.5 outer.two=x "
        "use_sim_time=True"
    ]
    assert done.said("launch") == ["additional_env of a Node has no effect here"]


def test_a_list_that_a_scope_sets_is_a_list_in_nodes_and_texts(brief):
    file = brief / "in.launch.xml"
    file.write_text(
        '<launch><set_parameter name="read" value="[3, 4]"/>'
        '<node pkg="mine" exec="brief.py"/><log message="$(param read)"/></launch>'
    )
    done = described(
        brief,
        "SetParameter('given', [1, 2])",
        "SetParameter('words', ['a', 'b c'])",
        f"IncludeLaunchDescription({str(file)!r})",
        "LogInfo(msg=launch_ros.substitutions.Parameter('given'))",
        start=brief,
    )

    assert done.texts("brief") == ["given=[1, 2] read=[3, 4] words=['a', 'b c']"]
    assert done.said("launch") == ["[3, 4]", "[1, 2]"]


def test_values_of_a_given_type_are_of_that_type(brief):
    done = described(
        brief,
        "Node(package='mine', executable='brief.py', parameters=[{"
        "'a': ParameterValue(3), 'b': ParameterValue('5', value_type=str), "
        "'c': ParameterValue(TextSubstitution(text='5'), value_type=float)}])",
        start=brief,
    )

    assert done.texts("brief") == ["a=3 b=5 c=5.0"]


def test_a_lifecycle_node_begins_unconfigured_and_others_bring_it_on(tmp_path):
    nodes = tmp_path / "mine" / "scripts"
    nodes.mkdir(parents=True)
    (tmp_path / "mine" / "package.xml").write_text("<package><name>mine</name></package>")
    (nodes / "camera.py").write_text(
        "import rclpy\nfrom rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn\n"
        "class Camera(LifecycleNode):\n"
        "    def on_configure(self, state):\n"
        "        self.get_logger().info(f'from {state.label}')\n"
        "        return TransitionCallbackReturn.SUCCESS\n"
        "rclpy.init()\nrclpy.spin(Camera('x'))\n"
    )
    (nodes / "manager.py").write_text(
        "import rclpy\nfrom lifecycle_msgs.srv import ChangeState\nrclpy.init()\n"
        "node = rclpy.create_node('manager')\n"
        "client = node.create_client(ChangeState, '/front/camera/change_state')\n"
        "client.wait_for_service()\nrequest = ChangeState.Request()\n"
        "request.transition.id = 1\nclient.call(request)\n"
    )
    done = described(
        tmp_path,
        "LifecycleNode(package='mine', executable='camera.py', name='camera', namespace='front')",
        "Node(package='mine', executable='manager.py')",
        start=tmp_path,
    )

    assert done.texts("front.camera") == ["from unconfigured"]


def test_a_node_asked_to_end_before_it_was_made_has_not_failed(tmp_path):
    nodes = tmp_path / "mine" / "scripts"
    nodes.mkdir(parents=True)
    (tmp_path / "mine" / "package.xml").write_text("<package><name>mine</name></package>")
    (nodes / "slow.py").write_text(
        "import time, rclpy\nrclpy.init()\ntime.sleep(2.0)\nrclpy.create_node('slow')\n"
    )
    done = described(
        tmp_path,
        "Node(package='mine', executable='slow.py')",
        "TimerAction(period=1.0, actions=[Shutdown()])",
        start=tmp_path,
    )

    assert done.said("slow.py-1")[-1] == "process has finished cleanly"
    assert done.failed == []


def test_a_shutdown_ends_the_nodes_that_run(brief):
    (brief / "mine" / "scripts" / "long.py").write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('long')\n"
        "try:\n    rclpy.spin(node)\nfinally:\n    node.get_logger().info('good bye')\n"
    )
    done = described(
        brief,
        "Node(package='mine', executable='long.py')",
        "TimerAction(period=1.0, actions=[Shutdown(reason='enough')])",
        seconds=9,
        start=brief,
    )

    assert done.texts("long") == ["good bye"]
    assert done.said("long.py-1") == ["process started", "process has finished cleanly"]
    assert done.failed == []
    assert done.elapsed == 1
