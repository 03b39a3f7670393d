import pytest


@pytest.fixture
def node(ros_runtime):
    """A node for the test itself, in a world that has begun."""
    import rclpy

    rclpy.init()
    return rclpy.create_node("probe")
