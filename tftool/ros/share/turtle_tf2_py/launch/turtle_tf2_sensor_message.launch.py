"""Launch file in which turtle3 drives in a circle and publishes its position in frame world."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Describe the inputs of the message filter, which users start themselves."""
    package = "turtle_tf2_py"
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "target_frame", default_value="turtle1", description="Target frame name."
            ),
            Node(package="turtlesim", executable="turtlesim_node", name="sim"),
            Node(
                package=package,
                executable="turtle_tf2_broadcaster",
                name="broadcaster1",
                parameters=[{"turtlename": "turtle1"}],
            ),
            Node(
                package=package,
                executable="turtle_tf2_broadcaster",
                name="broadcaster2",
                parameters=[{"turtlename": "turtle3"}],
            ),
            Node(
                package=package,
                executable="turtle_tf2_message_broadcaster",
                name="message_broadcaster",
            ),
        ]
    )
