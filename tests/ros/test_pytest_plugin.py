import pytest

from tftool.errors import NodeFailed, TftoolError
from tftool.nodes.turtlesim import Turtlesim


def test_a_test_is_a_node_program_and_time_passes_only_when_it_waits(ros_runtime):
    import rclpy

    rclpy.init()
    node = rclpy.create_node("probe")
    fired = []
    node.create_timer(0.5, lambda: fired.append(ros_runtime.elapsed()))
    before = node.get_clock().now()
    while len(fired) < 3:
        rclpy.spin_once(node)

    assert fired == [0.5, 1.0, 1.5]
    assert (node.get_clock().now() - before).nanoseconds == 1_500_000_000


def test_a_spin_that_finds_nothing_ends_at_its_timeout(ros_runtime):
    import rclpy

    rclpy.init()
    node = rclpy.create_node("probe")
    rclpy.spin_once(node, timeout_sec=2.5)

    assert ros_runtime.elapsed() == 2.5


def test_our_simulator_and_a_users_subscription_meet(ros_runtime):
    import rclpy
    from turtlesim.msg import Pose

    ros_runtime.ask(lambda: Turtlesim(ros_runtime.world))
    rclpy.init()
    node = rclpy.create_node("probe")
    poses = []
    node.create_subscription(Pose, "/turtle1/pose", poses.append, 1)
    rclpy.spin_once(node)

    assert poses[0].x == pytest.approx(5.544445)
    assert isinstance(poses[0], Pose)


def test_a_program_beside_the_test_that_fails_fails_the_test():
    from tftool.ros.testing import RosRuntime

    def main():
        raise ValueError("broken node")

    def test():
        with RosRuntime() as runtime:
            runtime.start(main)
            with pytest.raises(TftoolError, match="the world has ended"):
                runtime.sleep(1)

    with pytest.raises(NodeFailed, match="ValueError: broken node"):
        test()


def test_a_test_file_may_import_rclpy_at_its_top_with_ros_free(pytester):
    pytester.makepyfile(
        """
        import rclpy
        from std_msgs.msg import String

        def test_hello():
            rclpy.init()
            node = rclpy.create_node("probe")
            heard = []
            node.create_subscription(String, "chatter", heard.append, 10)
            node.create_publisher(String, "chatter", 10).publish(String(data="hello"))
            rclpy.spin_once(node, timeout_sec=1.0)
            assert heard == [String(data="hello")]
        """
    )

    result = pytester.runpytest("--ros-free", "-p", "tftool.ros.pytest_plugin")

    result.assert_outcomes(passed=1)


def test_without_the_fixture_rclpy_is_nobodys():
    with pytest.raises(ModuleNotFoundError):
        import rclpy  # noqa: F401
