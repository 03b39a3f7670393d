"""Tests of launch_ros's parameters, scopes and components, after its own tests."""

import io
from pathlib import Path

import pytest

from tests.ros.test_launch import described
from tests.ros.test_launch_live import launch_live, package
from tests.ros.tutorial import launch
from tftool.base.errors import NodeFailed
from tftool.ros.host.importing import ros_free


def evaluated(*parameters):
    """Return a node's parameters when the launch runs."""
    with ros_free():
        from launch import LaunchContext
        from launch_ros.utilities import evaluate_parameters, normalize_parameters

        return evaluate_parameters(LaunchContext(), normalize_parameters(list(parameters)))


def text(*parts):
    with ros_free():
        from launch.substitutions import TextSubstitution

        return [TextSubstitution(text=part) for part in parts]


@pytest.mark.parametrize(
    ("given", "there"),
    [
        ({"a": {"b": 1, "c": {"d": "x"}}}, {"a.b": 1, "a.c.d": "x"}),
        ({"said": "7", "made": text("7"), "joined": text("1", "2")},
         {"said": "7", "made": 7, "joined": 12}),
        ({"each": [text("1"), text("2")]}, {"each": (1, 2)}),
        ({"mixed": ["a", *text("b")]}, {"mixed": "ab"}),
        ({"texts": ["True", "1"], "list": text("[1.5, 2.0]")},
         {"texts": ("True", "1"), "list": (1.5, 2.0)}),
        ({"empty": text("")}, {"empty": ""}),
    ],
)  # fmt: skip
def test_parameters_become_dotted_names_and_what_substitutions_give_is_read_as_yaml(given, there):
    assert evaluated(given) == (there,)


def test_whole_numbers_beside_others_become_floats_and_files_become_paths(tmp_path):
    numbers, path = evaluated({"n": [1, 2.5]}, str(tmp_path / "a.yaml"))

    assert [type(one) for one in numbers["n"]] == [float, float]
    assert path == tmp_path / "a.yaml"


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({5: "x"}, "expected a text, a substitution or a list of these, not 5"),
        ({"a": {1, 2}}, "{1, 2} cannot be a parameter's value"),
        ({"a": [1, [2]]}, r"not \[2\]"),
        ({"a": [True, 2]}, "Expected a non-empty sequence of bool, int, float or str alone"),
        ({"a": []}, "parameter 'a': Expected a non-empty sequence"),
        ({"a": text("{b: 1}")}, "Allowed value types .* not dict"),
        ({"a": text("b: c: d")}, "Unable to parse 'b: c: d' as YAML.*value_type=str"),
        (5.0, "not 5.0"),
    ],
)
def test_an_invalid_parameter_is_refused_as_ros_refuses_it(given, told):
    with pytest.raises(TypeError, match=told):
        evaluated(given)


def test_a_node_refuses_a_mapping_of_parameters_and_a_list_of_remappings():
    with ros_free():
        from launch_ros.actions import Node

        with pytest.raises(TypeError, match="parameters must be a list of mappings and files"):
            Node(executable="e", parameters={"a": 1})
        with pytest.raises(TypeError, match="a remapping is a pair"):
            Node(executable="e", remappings=[["a", "b"]])


def test_a_value_of_a_given_type_is_of_it_from_the_beginning_or_refused():
    with ros_free():
        from launch import LaunchContext
        from launch_ros.parameter_descriptions import Parameter, ParameterValue

        context = LaunchContext()
        made = Parameter("who", [text("1"), "x"], value_type=list[str])

        assert made.evaluate(context) == ("who", ["1", "x"])
        assert (made.name, made.value_type) == ("who", list[str])
        assert ParameterValue(text("2"), value_type=float).evaluate(context) == 2.0
        with pytest.raises(TypeError, match="must be int, not '1'"):
            ParameterValue("1", value_type=int)
        with pytest.raises(ValueError, match="must be int, not 'x'"):
            ParameterValue(text("x"), value_type=int).evaluate(context)


def test_a_parameter_file_with_substitutions_is_copied_without_them_and_cleaned_up(tmp_path):
    file = tmp_path / "some.yaml"
    file.write_text("$(var who):\n  ros__parameters: {a: 1}\n")
    with ros_free():
        from launch import LaunchContext
        from launch_ros.descriptions import ParameterFile

        context = LaunchContext()
        context.launch_configurations["who"] = "talker"
        described_file = ParameterFile(str(file), allow_substs=True)
        copy = described_file.evaluate(context)

        assert copy == described_file.param_file != file
        assert copy.read_text() == "talker:\n  ros__parameters: {a: 1}\n"
        described_file.cleanup()
        assert not copy.exists()
        assert ParameterFile(file).evaluate(context) == file


def test_a_scope_is_kept_among_the_launch_configurations_and_ends_with_them():
    with ros_free():
        import launch_ros.actions as ros
        from launch import LaunchContext
        from launch.actions import PopLaunchConfigurations, PushLaunchConfigurations
        from launch_ros.substitutions import Parameter

        context = LaunchContext()
        PushLaunchConfigurations().execute(context)
        ros.PushRosNamespace("one").execute(context)
        ros.PushRosNamespace("two").execute(context)
        ros.SetRemap("a", "b").execute(context)
        ros.SetParameter("x", text("3")).execute(context)
        ros.SetParametersFromFile("some.yaml").execute(context)
        node = ros.Node(executable="e", name="n", namespace="own", remappings=[("c", "d")])
        node._perform_substitutions(context)

        assert context.launch_configurations == {
            "ros_namespace": "/one/two",
            "ros_remaps": [("a", "b")],
            "global_params": [("x", 3), "some.yaml"],
        }
        assert node.node_name == "/one/two/own/n"
        assert node.is_node_name_fully_specified()
        assert node.expanded_remapping_rules == [("a", "b"), ("c", "d")]
        PopLaunchConfigurations().execute(context)
        assert context.launch_configurations == {}
        ros.SetParameter("x", 3).execute(context)
        assert Parameter("x").perform(context) == "3"
        assert Parameter("y", default="none").perform(context) == "none"


@pytest.mark.parametrize(
    "action",
    [
        "SetParameter('x', 1)",
        "SetRemap('a', 'b')",
        "launch_ros.actions.Node(package='turtlesim', executable='turtlesim_node')",
    ],
)
def test_an_argument_may_not_have_the_name_of_what_a_scope_keeps(tmp_path, action):
    arguments = [
        f"DeclareLaunchArgument('{name}', default_value='x')"
        for name in ("global_params", "ros_remaps")
    ]

    with pytest.raises(NodeFailed, match="cannot be a launch argument, because launch_ros stores"):
        described(tmp_path, *arguments, action)


@pytest.mark.parametrize(
    ("base", "own", "there"),
    [
        (None, None, None),
        (None, "a", "a"),
        ("/a", None, "/a"),
        ("a", "b/", "a/b"),
        ("/", "b", "/b"),
        ("/a", "/b", "/b"),
        ("a", "", "a"),
        ("", "b", "b"),
        (None, "/", "/"),
    ],
)
def test_a_namespace_goes_into_another_unless_it_begins_at_the_root(base, own, there):
    with ros_free():
        from launch_ros.utilities import make_namespace_absolute, prefix_namespace

        assert prefix_namespace(base, own) == there
        assert make_namespace_absolute(there) in (there, f"/{there}")


CONTAINER = """
import rclpy
from composition_interfaces.srv import LoadNode
rclpy.init()
node = rclpy.create_node('box')
def load(request, response):
    node.get_logger().info(
        f'{request.plugin_name} {request.node_namespace} {request.node_name} '
        f'{request.remap_rules} {[(p.name, p.value.integer_value) for p in request.parameters]}')
    response.success = request.package_name == 'good'
    response.error_message = 'there is no such library'
    response.full_node_name = f'{request.node_namespace}/{request.node_name}'
    return response
node.create_service(LoadNode, '~/_container/load_node', load)
rclpy.spin(node)
"""


def test_a_container_that_answers_is_asked_to_load_components(tmp_path):
    (tmp_path / "box.py").write_text(CONTAINER)
    (tmp_path / "p.yaml").write_text(
        "/**:\n  ros__parameters: {a: 1, b: 2}\n/s/c:\n  ros__parameters: {b: 3}\n"
    )
    component = (
        "launch_ros.descriptions.ComposableNode(package='{}', plugin='P', name='c', "
        "namespace='s', remappings=[('x', 'y')], parameters=[{!r}, {{'z': 4}}], condition={})"
    )
    each = ", ".join(
        component.format(package, str(tmp_path / "p.yaml"), condition)
        for package, condition in [("good", "None"), ("bad", "None"), ("no", "IfCondition('0')")]
    )
    done = described(
        tmp_path,
        f"Node(executable={str(tmp_path / 'box.py')!r})",
        "SetRemap('i', 'j')",
        "TimerAction(period=0.5, actions=[LoadComposableNodes(target_container='/box', "
        f"composable_node_descriptions=[{each}])])",
    )

    asked = "P /s c ['i:=j', 'x:=y'] [('a', 1), ('b', 3), ('z', 4)]"
    assert done.texts("box") == [asked, asked]
    assert done.said("launch") == [
        "loaded P as '/s/c'",
        "P was not loaded: there is no such library",
    ]


def container_launch(tmp_path, code, *more):
    """Write a launch file with a container, a program of a package, and a component to load."""
    package(tmp_path, box=code)
    file = tmp_path / "own.launch.xml"
    file.write_text(
        "<launch><node_container pkg='pkg' exec='box.py' name='c' namespace='s'>"
        "<composable_node pkg='good' plugin='P' name='one'/></node_container>"
        "<load_composable_node target='s/c'><composable_node pkg='good' plugin='Q' name='two'/>"
        f"</load_composable_node>{''.join(more)}</launch>"
    )
    return file


def test_the_container_that_a_launch_starts_is_waited_for(tmp_path):
    late = CONTAINER.replace("rclpy.init()", "import time\ntime.sleep(1.5)\nrclpy.init()")
    done = launch(container_launch(tmp_path, late), seconds=4, start=tmp_path)

    assert done.texts("s.c") == ["P  one [] []", "Q  two [] []"]
    assert done.said("launch") == ["loaded P as '/one'", "loaded Q as '/two'"]


def test_the_container_that_a_launch_starts_is_waited_for_live_too(tmp_path):
    brief = (
        CONTAINER.replace(
            "rclpy.spin(node)",
            "for _ in range(200):\n    if len(told) < 2:\n"
            "        rclpy.spin_once(node, timeout_sec=0.05)",
        )
        .replace("def load", "told = []\ndef load")
        .replace("    return", "    told.append(1)\n    return")
    )
    done = launch_live(container_launch(tmp_path, brief), tmp_path)

    assert sorted(done.texts("s.c")) == ["P  one [] []", "Q  two [] []"]
    assert not [
        text for text in done.said("launch") if "not loaded" in text or "not started" in text
    ]


@pytest.mark.parametrize("live", [False, True])
def test_a_container_that_ends_without_its_service_is_waited_for_no_longer(tmp_path, live):
    code = "import rclpy\nrclpy.init()\nrclpy.create_node('box')\n"
    file = container_launch(tmp_path, code)
    done = launch_live(file, tmp_path) if live else launch(file, seconds=4, start=tmp_path)

    left_out = done.said("launch")
    assert [text.split(": ")[:2] for text in left_out] == [["not loaded", "P"], ["not loaded", "Q"]]
    assert done.failed == []


def test_a_container_that_dies_while_it_loads_is_told(tmp_path):
    dies = CONTAINER.replace("    return response", "    raise SystemExit(3)")
    done = launch(container_launch(tmp_path, dies), seconds=4, start=tmp_path)

    assert sorted(done.said("launch")) == [
        "P was not loaded: the node that served 's/c/_container/load_node' has ended",
        "Q was not loaded: the node that served 's/c/_container/load_node' has ended",
    ]
    assert done.elapsed < 4


def test_a_launch_ends_while_it_waits_for_a_container(tmp_path):
    code = "import rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('box'))\n"
    over = "<timer period='1.0'><shutdown reason='enough'/></timer>"
    done = launch(container_launch(tmp_path, code, over), seconds=4, start=tmp_path)

    assert done.said("launch") == ["shutting down: enough"]
    assert done.said("box.py-1")[-1] == "process has finished cleanly"
    assert done.elapsed == 1


COMPONENTS = {
    "xml": (
        "<launch><node_container pkg='rclcpp_components' exec='component_container' name='box' "
        "namespace='s'><composable_node pkg='p' plugin='p::Talker' name='t'>"
        "<param name='a' value='1'/><extra_arg name='b' value='true'/></composable_node>"
        "</node_container><load_composable_node target='box'><composable_node pkg='p' "
        "plugin='p::Other' if='false'/></load_composable_node><log message='on'/></launch>"
    ),
    "yaml": (
        "launch:\n- node_container:\n    pkg: rclcpp_components\n    exec: component_container\n"
        "    name: box\n    namespace: s\n    composable_node:\n"
        "    - {pkg: p, plugin: 'p::Talker', name: t, param: [{name: a, value: 1}]}\n"
        "- load_composable_node:\n    target: box\n    composable_node:\n"
        "    - {pkg: p, plugin: 'p::Other', if: 'false'}\n- log: {message: 'on'}\n"
    ),
}


@pytest.mark.parametrize("ending", COMPONENTS)
def test_components_are_left_out_with_a_line_and_the_rest_is_launched(tmp_path, ending):
    file = tmp_path / f"some.launch.{ending}"
    file.write_text(COMPONENTS[ending])
    done = described(tmp_path, f"IncludeLaunchDescription({str(file)!r})")

    container, component, rest = done.said("launch")
    assert container.startswith("not started: the container /s/box: 'rclcpp_components' is not a")
    assert component.startswith("not loaded: p::Talker: tftool cannot run components")
    assert "no container '/s/box' runs" in component
    assert rest == "on"


def test_a_container_may_be_a_file_of_no_package(tmp_path):
    (tmp_path / "box.py").write_text(
        "import rclpy\nrclpy.init()\nrclpy.create_node('b').get_logger().info('here')\n"
    )
    (tmp_path / "box.sh").write_text("#!/bin/sh\n")
    file = tmp_path / "some.launch.xml"
    file.write_text(
        "<launch>"
        + "".join(
            f"<node_container exec='{tmp_path / name}' name='c' namespace=''/>"
            for name in ("box.py", "box.sh")
        )
        + "</launch>"
    )
    done = described(tmp_path, f"IncludeLaunchDescription({str(file)!r})")

    assert done.texts("c") == ["here"]
    (left_out,) = done.said("launch")
    fault = f"the container /c: '{tmp_path / 'box.sh'}' is not a Python file"
    assert left_out.startswith(f"not started: {fault}")


@pytest.mark.parametrize(
    "said",
    [
        "<launch><set_parameter name='a' value='1'/><let name='b' value='$(param a)'/></launch>",
        "launch:\n- set_parameter: {name: a, value: '1'}\n"
        "- let: {name: b, value: $(param a none)}\n",
    ],
)
def test_a_parser_reads_an_open_launch_file_for_a_service_to_run(ros_runtime, said):
    from launch import LaunchService
    from launch.frontend import Parser

    root, parser = Parser.load(io.StringIO(said))
    service = LaunchService()
    service.include_launch_description(parser.parse_description(root))

    assert service.run() == 0
    assert service.context.launch_configurations["b"] == "1"


def test_a_service_that_cannot_launch_says_so_and_the_program_goes_on(ros_runtime, capfd):
    from launch import LaunchDescription, LaunchService
    from launch_ros.actions import Node

    service = LaunchService()
    service.include_launch_description(
        LaunchDescription([Node(package="nonesuch", executable="e")])
    )

    assert service.run() == 1
    assert "there is no package 'nonesuch'" in capfd.readouterr().err


def test_a_service_runs_beside_other_coroutines(ros_runtime, tmp_path, capfd):
    file = tmp_path / "beside.py"
    file.write_text(
        "import asyncio\nimport launch\nfrom launch.actions import LogInfo, TimerAction\n"
        "service = launch.LaunchService()\n"
        "service.include_launch_description(launch.LaunchDescription([\n"
        "    TimerAction(period=1.0, actions=[LogInfo(msg='launched')])]))\n"
        "async def both():\n"
        "    running = asyncio.create_task(service.run_async())\n"
        "    await asyncio.sleep(0.5)\n"
        "    print('beside', running.done())\n"
        "    print('ended', await running)\n"
        "asyncio.run(both())\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(2.0)

    assert program.status == 0
    captured = capfd.readouterr()
    assert captured.out == "beside False\nended 0\n"
    assert "launched" in captured.err


SHUT_DOWN = """
import asyncio
import threading
import launch
from launch.actions import LogInfo, OpaqueFunction, TimerAction

service = launch.LaunchService()
print('before', service.shutdown())


def from_a_thread():
    print('thread', service.shutdown())


def inside(context):
    print('inside', asyncio.iscoroutine(told := service.shutdown()))
    told.close()


def begin(*actions):
    global service
    service = launch.LaunchService()
    late = TimerAction(period=9.0, actions=[LogInfo(msg='too late')])
    service.include_launch_description(launch.LaunchDescription([late, *actions]))


async def beside():
    running = asyncio.create_task(service.run_async())
    await asyncio.sleep(0.5)
    await asyncio.create_task(service.shutdown())
    print('ended', await running, service.shutdown())


begin(OpaqueFunction(function=inside))
print('run', service.run())
begin()
asyncio.run(beside())
begin()
threading.Timer(0.5, from_a_thread).start()
print('run', service.run())
begin()
loop = asyncio.new_event_loop()
running = loop.create_task(service.run_async())
loop.run_until_complete(asyncio.sleep(0.5))
loop.create_task(service.shutdown())
print('between', loop.run_until_complete(running))
"""


def test_a_services_shutdown_is_awaited_in_its_loop_and_done_elsewhere(
    ros_runtime, tmp_path, capfd
):
    file = tmp_path / "ends.py"
    file.write_text(SHUT_DOWN)
    program = ros_runtime.start(file)
    ros_runtime.sleep(5.0)

    captured = capfd.readouterr()
    assert captured.out.splitlines() == [
        "before None",
        "inside True",
        "run 0",
        "ended 0 None",
        "thread None",
        "run 0",
        "between 0",
    ]
    assert "too late" not in captured.err
    assert program.status == 0


def test_cancelling_the_coroutine_of_a_launch_service_ends_its_launch(ros_runtime, tmp_path, capfd):
    (tmp_path / "stay.py").write_text(
        "import rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('stay'))\n"
    )
    file = tmp_path / "cancels.py"
    file.write_text(
        "import asyncio\nimport launch\nimport launch_ros.actions\n"
        "from launch.actions import LogInfo, TimerAction\n"
        "service = launch.LaunchService()\n"
        "service.include_launch_description(launch.LaunchDescription([\n"
        f"    launch_ros.actions.Node(executable={str(tmp_path / 'stay.py')!r}),\n"
        "    TimerAction(period=1.0, actions=[LogInfo(msg='too late')])]))\n"
        "async def briefly():\n"
        "    try:\n"
        "        await asyncio.wait_for(service.run_async(), 0.5)\n"
        "    except asyncio.TimeoutError:\n"
        "        print('cancelled')\n"
        "    await asyncio.sleep(2.0)\n"
        "asyncio.run(briefly())\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(4.0)

    assert program.status == 0
    captured = capfd.readouterr()
    assert captured.out == "cancelled\n"
    assert "process has finished cleanly" in captured.err
    assert "too late" not in captured.err


def test_a_launch_that_ends_in_the_instant_in_which_a_node_begins_ends_the_node_too(tmp_path):
    (tmp_path / "stay.py").write_text(
        "import rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('stay'))\n"
    )
    done = described(
        tmp_path, f"Node(executable={str(tmp_path / 'stay.py')!r})", "Shutdown(reason='at once')"
    )

    assert done.said("stay.py-1") == ["process started", "process has finished cleanly"]


def test_a_launch_says_that_it_starts_two_nodes_of_one_name(tmp_path):
    (tmp_path / "stay.py").write_text(
        "import rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('stay'))\n"
    )
    node = f"Node(executable={str(tmp_path / 'stay.py')!r}, name='twin', namespace='s')"
    done = described(tmp_path, node, node)

    assert done.said("launch") == [
        "/s/twin is started 2 times by this launch; give each node a name or a namespace of its own"
    ]


def test_the_folder_for_logs_is_set_for_commands(tmp_path):
    done = described(
        tmp_path,
        "SetEnvironmentVariable('ROS_LOG_DIR', '/logs')",
        "SetROSLogDir('mine')",
        "ExecuteProcess(cmd=['sh', '-c', 'echo $ROS_LOG_DIR'])",
    )

    assert str(Path("/logs/mine")) in done.said("sh-1")


def test_a_value_of_another_type_is_refused_with_its_line(tmp_path):
    file = tmp_path / "some.launch.xml"
    file.write_text(
        "<launch><node pkg='turtlesim' exec='turtlesim_node'>\n"
        "<param name='a' value='1, x' value-sep=', ' type='list_of_int'/></node></launch>"
    )

    with pytest.raises(NodeFailed, match=r"some\.launch.xml:1: parameter 'a': .* int, not 'x'"):
        described(tmp_path, f"IncludeLaunchDescription({str(file)!r})")
