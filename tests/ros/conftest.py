import pytest


@pytest.fixture
def node(ros_runtime):
    """Create a node for the test itself, in a world that is running."""
    import rclpy

    rclpy.init()
    return rclpy.create_node("probe")
