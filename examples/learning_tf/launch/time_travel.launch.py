from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="turtlesim", executable="turtlesim_node"),
        Node(
            package="learning_tf",
            executable="turtle_broadcaster",
            name="broadcaster1",
            parameters=[{"turtle": "turtle1"}],
        ),
        Node(
            package="learning_tf",
            executable="turtle_broadcaster",
            name="broadcaster2",
            parameters=[{"turtle": "turtle2"}],
        ),
        Node(package="learning_tf", executable="time_traveller"),
    ])
