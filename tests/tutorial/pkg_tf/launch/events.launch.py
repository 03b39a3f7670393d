import os

from ament_index_python.packages import get_package_share_directory

from launch import LaunchDescription
from launch.actions import (DeclareLaunchArgument, EmitEvent, ExecuteProcess, GroupAction,
                            IncludeLaunchDescription, LogInfo, OpaqueFunction,
                            RegisterEventHandler, TimerAction)
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnProcessExit, OnShutdown
from launch.events import Shutdown
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (LaunchConfiguration, PathJoinSubstitution, PythonExpression,
                                  TextSubstitution)
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    heading = LaunchConfiguration('heading')
    rotate = Node(package='pkg_tf', executable='rotate', arguments=[heading], name='turner')
    demo = PathJoinSubstitution([
        FindPackageShare('turtle_tf2_py'), 'launch', 'turtle_tf2_demo.launch.py'])
    return LaunchDescription([
        DeclareLaunchArgument('heading', default_value=TextSubstitution(text='1.5708')),
        DeclareLaunchArgument('loud', default_value='false', choices=['true', 'false']),
        LogInfo(msg=['turning to ', heading], condition=IfCondition(LaunchConfiguration('loud'))),
        LogInfo(msg='turning', condition=UnlessCondition(
            PythonExpression(["'", LaunchConfiguration('loud'), "' == 'true'"]))),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(demo)),
        GroupAction([
            PushRosNamespace('other'),
            Node(package='turtlesim', executable='turtlesim_node', name='sim'),
        ]),
        OpaqueFunction(function=lambda context: [LogInfo(msg=os.path.basename(
            get_package_share_directory('pkg_tf')))]),
        TimerAction(period=1.0, actions=[rotate]),
        RegisterEventHandler(OnProcessExit(
            target_action=rotate,
            on_exit=[
                ExecuteProcess(cmd=['echo', 'turned', heading]),
                EmitEvent(event=Shutdown(reason='all is done')),
            ])),
        RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg='good bye')])),
    ])
