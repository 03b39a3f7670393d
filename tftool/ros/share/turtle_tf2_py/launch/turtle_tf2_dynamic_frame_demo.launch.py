"""Launch file of the turtle demo in which turtle2 follows a moving point, the frame carrot1."""

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Describe two turtles and the moving frame carrot1, which turtle2 follows."""
    demo = PathJoinSubstitution([ThisLaunchFileDir(), "turtle_tf2_demo.launch.py"])
    return LaunchDescription(
        [
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(demo),
                launch_arguments={"target_frame": "carrot1"}.items(),
            ),
            Node(
                package="turtle_tf2_py",
                executable="dynamic_frame_tf2_broadcaster",
                name="dynamic_broadcaster",
            ),
        ]
    )
