"""Tests of names and modules that programs import from the same places as in ROS 2."""

import importlib
import os
import subprocess
import sys

import pytest

from tftool.ros.host.importing import ros_free


@pytest.mark.parametrize(
    ("module", "names"),
    [
        ("tf2_ros", "TransformStamped TFMessage Time Duration Node"),
        ("rclpy.time", "CONVERSION_CONSTANT"),
        ("rclpy.service", "Service ServiceIntrospectionState"),
        ("rclpy.client", "Client ServiceIntrospectionState"),
        ("std_msgs.msg._string", "String"),
        ("sensor_msgs.msg._point_cloud2", "PointCloud2"),
        ("std_srvs.srv._set_bool", "SetBool SetBool_Request SetBool_Response"),
        ("example_interfaces.action._fibonacci", "Fibonacci_Goal Fibonacci_Feedback"),
        ("launch.actions.execute_process", "ExecuteProcess"),
        ("launch.actions.declare_launch_argument", "DeclareLaunchArgument"),
        ("launch.substitutions.launch_configuration", "LaunchConfiguration"),
        ("launch.conditions.if_condition", "IfCondition"),
        ("launch.event_handlers.on_process_exit", "OnProcessExit"),
        ("launch.events.process.process_exited", "ProcessExited"),
        ("launch_ros.actions.node", "Node"),
        ("launch_ros.events.lifecycle", "ChangeState matches_node_name"),
        ("launch_ros.actions.push_ros_namespace", "PushRosNamespace"),
        ("launch_ros.substitutions.find_package", "FindPackageShare"),
        ("launch.launch_description", "LaunchDescription DeclareLaunchArgument LaunchContext"),
        ("launch.actions.shutdown_action", "Shutdown"),
        ("rclpy.node", "QoSProfile Publisher Timer ParameterDescriptor SetParametersResult"),
        ("rclpy.action.server", "qos_profile_services_default GoalStatus"),
        ("rclpy.executors", "Future Task"),
        ("launch.actions.opaque_function", "LaunchContext Action"),
        ("launch_ros.actions.node", "SomeSubstitutionsType perform_substitutions"),
        ("launch.events.matchers", "matches_action"),
        ("launch.some_entities_type", "SomeEntitiesType"),
        ("launch.substitutions.boolean_substitution", "AndSubstitution NotSubstitution"),
        ("launch.utilities.perform_substitutions_impl", "perform_substitutions"),
        ("launch_ros.events.lifecycle.change_state", "ChangeState"),
        ("launch_ros.utilities.evaluate_parameters", "evaluate_parameters"),
        ("launch_yaml.launch_description_sources.yaml_launch_description_source", ""),
        ("rclpy", "Future List Optional"),
        ("rclpy.impl.rcutils_logger", "RcutilsLogger SkipFirst"),
        ("tf2_ros.transform_listener", "DEFAULT_TF_TOPIC DEFAULT_STATIC_TF_TOPIC"),
        ("ament_index_python.resources", "get_resource get_resources has_resource"),
        ("rosidl_runtime_py.convert", "message_to_ordereddict message_to_yaml"),
    ],
)
def test_names_are_where_ros_has_them_too(module, names):
    with ros_free():
        found = importlib.import_module(module)
        for name in names.split():
            assert hasattr(found, name)


def test_names_that_are_re_exported_are_the_same_ones():
    with ros_free():
        import geometry_msgs.msg
        import std_msgs.msg
        import tf2_ros
        from std_msgs.msg._string import String
        from std_srvs.srv import Trigger
        from std_srvs.srv._trigger import Trigger_Request

        assert tf2_ros.TransformStamped is geometry_msgs.msg.TransformStamped
        assert String is std_msgs.msg.String
        assert Trigger_Request is Trigger.Request


@pytest.mark.parametrize(
    ("module", "name"),
    [("rclpy.qos", "Node"), ("launch.actions", "LaunchContext"), ("launch", "LogInfo")],
)
def test_a_module_that_does_not_import_a_name_in_ros_lacks_this_name(module, name):
    with ros_free(), pytest.raises(AttributeError, match=f"'{name}' of {module} is not supported"):
        getattr(importlib.import_module(module), name)


@pytest.mark.parametrize(
    "use",
    [
        "import launch; launch.actions.TimerAction; launch.substitutions.PathJoinSubstitution; "
        "launch.conditions.IfCondition; launch.events.Shutdown; launch.event_handlers.OnShutdown",
        "import launch_ros; launch_ros.actions.Node; launch_ros.substitutions.FindPackageShare",
        "import tf2_ros; tf2_ros.transform_listener.TransformListener; tf2_ros.buffer.Buffer",
        "import rclpy; rclpy.qos.QoSProfile; rclpy.time.Time",
    ],
)
def test_a_packages_modules_are_there_after_no_more_than_importing_it(use):
    code = f"from tftool.ros.host.importing import ros_free\nwith ros_free():\n    {use}\n"

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)

    assert done.stderr == ""
    assert done.returncode == 0


@pytest.mark.parametrize(
    ("package", "kind"),
    [
        ("tf2_geometry_msgs", "geometry_msgs.msg.PointStamped"),
        ("tf2_sensor_msgs", "sensor_msgs.msg.PointCloud2"),
    ],
)
def test_an_import_alone_lets_buffers_transform_a_packages_messages(package, kind):
    # The import runs in a new process, because a registration lasts as long as its process.
    code = (
        "from tftool.ros.host.importing import ros_free\n"
        "with ros_free():\n"
        f"    import {package}, {kind.rpartition('.')[0]}, tf2_ros\n"
        f"    print(tf2_ros.TransformRegistration().get({kind}).__name__)\n"
    )

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)

    assert (done.stderr, done.stdout[:13]) == ("", "do_transform_")


def test_our_own_modules_are_no_package_of_interfaces(ros_runtime):
    from tftool.messages.classes import INTERFACES

    # The turtle simulator contains interfaces of its own.
    from tftool.world.nodes.trail import KIND

    assert KIND.interface__.startswith("tftool_interfaces/srv/")
    assert "tftool" not in INTERFACES.packages()


def test_messages_become_mappings_yaml_and_csv():
    with ros_free():
        from geometry_msgs.msg import PointStamped
        from rosidl_runtime_py import (
            message_to_csv,
            message_to_ordereddict,
            message_to_yaml,
            set_message_fields,
        )
        from rosidl_runtime_py.utilities import get_message

        message = get_message("geometry_msgs/msg/PointStamped")()
        set_message_fields(message, {"header": {"frame_id": "map"}, "point": {"x": 1.5}})

        with pytest.raises(AttributeError, match="'Point' object has no attribute 'w'"):
            set_message_fields(message, {"point": {"w": 1.0}})
        assert isinstance(message, PointStamped)
        assert message_to_ordereddict(message)["point"] == {"x": 1.5, "y": 0.0, "z": 0.0}
        assert "frame_id: map" in message_to_yaml(message)
        assert message_to_csv(message) == "0,0,map,1.5,0.0,0.0"


def test_interfaces_are_found_by_the_argument_named_identifier():
    with ros_free():
        from geometry_msgs.msg import PointStamped
        from rosidl_runtime_py.utilities import get_action, get_message, get_service
        from std_srvs.srv import Trigger
        from turtlesim.action import RotateAbsolute

        assert get_message(identifier="geometry_msgs/msg/PointStamped") is PointStamped
        assert get_service(identifier="std_srvs/srv/Trigger") is Trigger
        assert get_action(identifier="turtlesim/action/RotateAbsolute") is RotateAbsolute


def test_the_distribution_is_set_for_programs_and_is_no_sourced_ros(monkeypatch):
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    ask = (
        "import os; from tftool.ros.host.importing import real_ros; "
        "print(os.environ['ROS_DISTRO'], repr(real_ros()))"
    )
    with ros_free():
        done = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True)

    assert done.stdout == "jazzy ''\n"
    assert "ROS_DISTRO" not in os.environ


@pytest.mark.skipif(os.name == "nt", reason="it is a shell script")
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["interface", "package", "std_srvs"], "std_srvs/srv/Trigger"),
        (["run", "--help"], "tftool run"),
    ],
)
def test_child_processes_of_programs_have_the_command_ros2(words, said):
    path = os.environ["PATH"]
    with ros_free():
        done = subprocess.run(["ros2", *words], capture_output=True, text=True)

    assert done.returncode == 0
    assert said in done.stdout
    assert os.environ["PATH"] == path


def test_a_virtual_environment_beside_a_file_keeps_pythons_own_threads(
    ros_runtime, tmp_path, monkeypatch
):
    packages = tmp_path / ".venv/lib/python3/site-packages"
    for folder, module in ((packages / "installed", "inner"), (tmp_path / "own", "part")):
        folder.mkdir(parents=True)
        (folder / "__init__.py").touch()
        (folder / f"{module}.py").write_text("import threading\nKIND = threading.Lock.__module__\n")
    monkeypatch.syspath_prepend(str(packages))
    file = tmp_path / "node.py"
    file.write_text(
        "import rclpy\nimport installed.inner\nimport own.part\nrclpy.init()\n"
        "node = rclpy.create_node('probe')\n"
        "node.get_logger().info(f'{installed.inner.KIND} {own.part.KIND}')\n"
    )

    ros_runtime.start(file)
    ros_runtime.sleep(1)

    inside, ours = ros_runtime.log("probe")[0].split()
    assert inside == "_thread"
    assert ours != "_thread"


def test_names_of_a_package_are_loaded_when_they_are_used(ros_runtime):
    import sys

    import rclpy
    import sensor_msgs.msg

    assert "Imu" not in vars(sensor_msgs.msg)
    assert {"Imu", "LaserScan"} <= set(dir(sensor_msgs.msg))
    assert sensor_msgs.msg.Imu is sensor_msgs.msg.Imu
    everything = {}
    exec("from sensor_msgs.msg import *", everything)
    assert everything["Imu"] is sensor_msgs.msg.Imu
    assert rclpy.time.Time(seconds=1).nanoseconds == 10**9
    assert "rclpy.time_source" not in sys.modules
    with pytest.raises(AttributeError, match="did you mean 'LaserScan'"):
        _ = sensor_msgs.msg.LaserScann


def test_our_own_files_import_none_of_the_names_of_ros():
    import ast
    from pathlib import Path

    import tftool
    from tftool.ros.host import import_table

    theirs = {name.partition(".")[0] for name in import_table.table()}
    for file in Path(tftool.__file__).parent.rglob("*.py"):
        if "share" not in file.parts:
            for node in ast.walk(ast.parse(file.read_text())):
                if isinstance(node, ast.Import):
                    assert not theirs & {one.name.partition(".")[0] for one in node.names}, file
                elif isinstance(node, ast.ImportFrom) and not node.level:
                    assert (node.module or "").partition(".")[0] not in theirs, file


def test_one_class_has_one_name_and_child_processes_have_no_rclpy():
    ask = [sys.executable, "-c", "import rclpy"]
    with ros_free():
        import rclpy.node

        assert rclpy.node.Node.__module__ == "tftool.ros.rclpy.node"
        done = subprocess.run(ask, capture_output=True, text=True, check=False)

    assert "No module named 'rclpy'" in done.stderr
    assert "rclpy" not in sys.modules


def test_beside_a_sourced_ros_its_own_modules_are_back_after_a_forced_run(tmp_path, monkeypatch):
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").write_text("REAL = True\n")
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    monkeypatch.syspath_prepend(str(tmp_path))
    real = importlib.import_module("rclpy")
    try:
        with ros_free(force=True):
            assert not hasattr(importlib.import_module("rclpy"), "REAL")
        assert sys.modules["rclpy"] is real
    finally:
        del sys.modules["rclpy"]
