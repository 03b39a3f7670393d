"""Launch file of two turtle simulators side by side."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Describe two simulators, each in a namespace of its own."""
    return LaunchDescription(
        [
            Node(package="turtlesim", executable="turtlesim_node", namespace=f"turtlesim{number}")
            for number in (1, 2)
        ]
    )
