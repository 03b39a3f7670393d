from launch import LaunchDescription
from launch.actions import (
    AppendEnvironmentVariable,
    DeclareLaunchArgument,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
)
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import (
    EnvironmentVariable,
    EqualsSubstitution,
    LaunchConfiguration,
    PathJoinSubstitution,
    PythonExpression,
    TextSubstitution,
    ThisLaunchFileDir,
)
from launch_ros.actions import Node, PushROSNamespace, SetParameter, SetRemap


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "colour", default_value="7", choices=["7", "9"], description="How blue"
            ),
            DeclareLaunchArgument("second", default_value="true"),
            SetLaunchConfiguration(
                "twice", PythonExpression(["2 * ", LaunchConfiguration("colour")])
            ),
            SetEnvironmentVariable("SHAPE", "round"),
            AppendEnvironmentVariable("SHAPE", "flat", separator=","),
            GroupAction(
                [
                    PushROSNamespace("one"),
                    SetParameter("background_r", 3),
                    SetRemap("turtle1/cmd_vel", "turtle1/other"),
                    Node(
                        package="turtlesim",
                        executable="turtlesim_node",
                        name="sim",
                        parameters=[
                            [ThisLaunchFileDir(), "/background.yaml"],
                            {"background_b": LaunchConfiguration("colour")},
                        ],
                    ),
                ]
            ),
            Node(
                package="turtlesim",
                executable="turtlesim_node",
                name="sim",
                namespace="two",
                condition=IfCondition(LaunchConfiguration("second")),
                output="screen",
            ),
            Node(
                package="pkg_tf",
                executable="rotate",
                name="turner",
                arguments=["0.5"],
                remappings=[("/turtle1/rotate_absolute", "/one/turtle1/rotate_absolute")],
                condition=UnlessCondition(EqualsSubstitution(LaunchConfiguration("colour"), "9")),
            ),
            IncludeLaunchDescription(
                AnyLaunchDescriptionSource(
                    PathJoinSubstitution([ThisLaunchFileDir(), "part.launch.xml"])
                ),
                launch_arguments={"what": LaunchConfiguration("twice")}.items(),
            ),
            ExecuteProcess(cmd=["echo", "shape", EnvironmentVariable("SHAPE")], name="told"),
            TimerAction(
                period=1.5, actions=[LogInfo(msg=["late ", TextSubstitution(text="news")])]
            ),
            TimerAction(period=3.0, actions=[Shutdown(reason="enough")]),
        ]
    )
