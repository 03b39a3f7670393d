"""Names and modules that people import from where ROS 2 has them too."""

import importlib
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
        ("std_srvs.srv._set_bool", "SetBool"),
        ("launch.actions.execute_process", "ExecuteProcess"),
        ("launch.actions.declare_launch_argument", "DeclareLaunchArgument"),
        ("launch.substitutions.launch_configuration", "LaunchConfiguration"),
        ("launch.conditions.if_condition", "IfCondition"),
        ("launch.event_handlers.on_process_exit", "OnProcessExit"),
        ("launch.events.process.process_exited", "ProcessExited"),
        ("launch_ros.actions.node", "Node"),
        ("launch_ros.actions.push_ros_namespace", "PushRosNamespace"),
        ("launch_ros.substitutions.find_package", "FindPackageShare"),
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

        assert tf2_ros.TransformStamped is geometry_msgs.msg.TransformStamped
        assert String is std_msgs.msg.String


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


def test_our_own_modules_are_no_package_of_interfaces(ros_runtime):
    from tftool.messages.classes import INTERFACES

    # The simulator of the turtles brings interfaces of its own with it.
    from tftool.world.nodes.drawings import KIND

    assert KIND.interface__.startswith("tftool_interfaces/srv/")
    assert "tftool" not in INTERFACES.packages()
