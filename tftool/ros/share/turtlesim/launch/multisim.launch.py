"""Two simulators side by side."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """One in each namespace."""
    return LaunchDescription(
        [
            Node(package="turtlesim", executable="turtlesim_node", namespace=f"turtlesim{number}")
            for number in (1, 2)
        ]
    )
