import sys
from pathlib import Path

import pytest

import tftool
from tftool.base.errors import NodeFailed
from tftool.world.nodes.turtlesim import Turtlesim


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
            told = r"(?s)ValueError: broken node.*test_pytest_plugin\.py:\d+, in main"
            with pytest.raises(NodeFailed, match=told):
                runtime.sleep(1)

    test()  # the failure was raised already, so its end is quiet


def test_a_failure_the_test_never_waits_for_is_told_at_its_end():
    from tftool.ros.testing import RosRuntime

    def main():
        raise ValueError("broken node")

    with pytest.raises(NodeFailed, match="ValueError: broken node"), RosRuntime() as runtime:
        runtime.start(main)


def test_a_test_file_may_use_ros_at_its_top_with_ros_free(pytester, monkeypatch):
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    pytester.makepyfile(
        """
        import os

        import rclpy
        from std_msgs.msg import String

        assert os.environ["ROS_DISTRO"]

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


def test_tests_sleep_and_start_threads_in_the_nodes_time_with_ros_free(pytester):
    pytester.makepyfile(
        robot="""
        import time
        from rclpy.node import Node

        class Robot(Node):
            def __init__(self):
                super().__init__("robot")
                self.started = time.monotonic()
                self.ticks = 0
                self.create_timer(60.0, self.tick)

            def tick(self):
                self.ticks += 1
        """,
        test_robot="""
        import threading
        import time
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from robot import Robot

        EARLY = time.time()
        LATE = threading.Event()

        def test_it_ticks_every_minute(ros_runtime):
            rclpy.init()
            robot, executor = Robot(), SingleThreadedExecutor()
            executor.add_node(robot)
            thread = threading.Thread(target=executor.spin, daemon=True)
            thread.start()
            time.sleep(3601.0)
            assert robot.ticks == 60
            assert time.monotonic() - robot.started == 3601.0 == ros_runtime.elapsed()
            assert not LATE.wait(timeout=1.0)
            executor.shutdown()
            thread.join(timeout=1.0)
            assert not thread.is_alive()
            assert time.time() < EARLY
        """,
    )

    result = pytester.runpytest("--ros-free", "-p", "tftool.ros.pytest_plugin")

    result.assert_outcomes(passed=1)


def test_a_tests_event_loop_sleeps_in_the_nodes_time_with_ros_free(pytester):
    test = """
        import asyncio
        import pytest

        @pytest.mark.parametrize("count", range(2))
        def test_ten_minutes_pass(ros_runtime, count):
            asyncio.get_event_loop().run_until_complete(asyncio.sleep(600.0))
            assert ros_runtime.elapsed() == pytest.approx(600.0, abs=1.0)
        """
    pytester.makepyfile(test)

    result = pytester.runpytest("--ros-free", "-p", "tftool.ros.pytest_plugin")

    result.assert_outcomes(passed=2)


def test_a_test_file_with_a_second_dot_sleeps_in_the_nodes_time(pytester):
    file = pytester.path / "talker.test.py"
    file.write_text(
        "import time\nimport rclpy\n\ndef test_time():\n    rclpy.init()\n"
        "    clock = rclpy.create_node('talker').get_clock()\n    before = clock.now()\n"
        "    time.sleep(100_000)\n"
        "    assert (clock.now() - before).nanoseconds == 100_000_000_000_000\n"
    )

    words = ("--ros-free", "-p", "tftool.ros.pytest_plugin", "--import-mode=importlib")
    pytester.runpytest(*words, file).assert_outcomes(passed=1)


def test_two_packages_have_test_files_of_one_name(pytester):
    for name in ("one", "other"):
        (pytester.path / name).mkdir()
        (pytester.path / name / "test_node.py").write_text(
            "import rclpy\n\ndef test_it(ros_runtime):\n    rclpy.init()\n"
            f"    assert rclpy.create_node('{name}').get_name() in __file__\n"
        )

    result = pytester.runpytest("--ros-free", "-p", "tftool.ros.pytest_plugin")

    result.assert_outcomes(passed=2)


def test_a_fixture_for_many_tests_shares_its_runtime_with_them(pytester):
    pytester.makepyfile(
        """
        import unittest
        import pytest
        import rclpy

        @pytest.fixture(scope="module")
        def node():
            rclpy.init()
            node = rclpy.create_node("shared")
            yield node
            node.destroy_node()
            rclpy.shutdown()

        def test_one(node, ros_runtime):
            ros_runtime.sleep(3.0)

        def test_two(node, ros_runtime):
            assert ros_runtime.elapsed() == 3.0
            assert node.get_name() == "shared"

        class TestThree(unittest.TestCase):
            @classmethod
            def setUpClass(cls):
                cls.context = rclpy.Context()
                rclpy.init(context=cls.context)

            @classmethod
            def tearDownClass(cls):
                rclpy.shutdown(context=cls.context)

            def test_it(self):
                node = rclpy.create_node("other", context=self.context)
                assert rclpy.ok(context=self.context)
                node.destroy_node()
        """
    )
    pytester.makepyfile(
        test_another="""
        import rclpy

        def test_the_next_file_begins_anew(ros_runtime):
            assert ros_runtime.elapsed() == 0.0
            rclpy.init()
        """
    )

    result = pytester.runpytest("--ros-free", "-p", "tftool.ros.pytest_plugin")

    result.assert_outcomes(passed=4)


def test_workers_of_xdist_have_it_too(pytester, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(Path(tftool.__file__).parent.parent))
    pytester.makepyfile(
        """
        import rclpy

        def test_hello():
            rclpy.init()
            assert rclpy.ok()
        """
    )

    result = pytester.runpytest_subprocess(
        "--ros-free", "-n1", "-p", "tftool.ros.pytest_plugin", "-p", "no:cacheprovider"
    )

    result.assert_outcomes(passed=1)


def test_without_the_fixture_rclpy_is_nobodys():
    with pytest.raises(ModuleNotFoundError):
        import rclpy  # noqa: F401


def test_an_import_of_rclpy_that_fails_names_the_option_it_needs(pytester):
    pytester.makepyfile("import rclpy")

    result = pytester.runpytest("-p", "tftool.ros.pytest_plugin")

    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines("*pytest --ros-free lets test files import rclpy at their top*")


def test_tests_know_the_workspaces_own_interfaces_with_ros_free(pytester):
    from tftool.messages.classes import INTERFACES

    shapes = pytester.mkdir("my_balls")
    (shapes / "package.xml").write_text("<package><name>my_balls</name></package>")
    (shapes / "msg").mkdir()
    (shapes / "msg" / "Ball.msg").write_text("float64 radius 2.5\n")
    pytester.makepyfile(
        """
        from ament_index_python.packages import get_package_share_directory
        from my_balls.msg import Ball

        def test_it():
            assert Ball().radius == 2.5
            assert get_package_share_directory("my_balls").endswith("my_balls")
        """
    )
    try:
        result = pytester.runpytest("--ros-free", "-p", "tftool.ros.pytest_plugin")
    finally:
        INTERFACES.add("my_balls", {})

    result.assert_outcomes(passed=1)


def test_tests_import_the_modules_of_the_workspaces_packages_with_ros_free(pytester):
    package = pytester.mkdir("my_shelf")
    (package / "setup.py").write_text("from setuptools import setup\nsetup(name='my_shelf')\n")
    (package / "my_shelf").mkdir()
    (package / "my_shelf" / "__init__.py").write_text("")
    (package / "my_shelf" / "heights.py").write_text("HEIGHT = 1.5\n")
    (package / "test").mkdir()
    (package / "test" / "test_heights.py").write_text(
        "from my_shelf.heights import HEIGHT\n\ndef test_it():\n    assert HEIGHT == 1.5\n"
    )
    before = list(sys.path)
    try:
        result = pytester.runpytest("--ros-free", "-p", "tftool.ros.pytest_plugin")
    finally:
        for name in [one for one in sys.modules if one.startswith("my_shelf")]:
            del sys.modules[name]

    result.assert_outcomes(passed=1)
    assert sys.path == before
