"""pytest: test ROS nodes without ROS.

The fixture `ros_runtime` is a `tftool.ros.testing.RosRuntime`. With `pytest --ros-free`
every test has one, and test files may say `import rclpy` at their top.
"""

from collections.abc import Iterator
from typing import Any

import pytest

_imports: list[Any] = []


def pytest_addoption(parser: pytest.Parser) -> None:
    """Offer `--ros-free`."""
    parser.getgroup("tftool").addoption(
        "--ros-free",
        action="store_true",
        help="run tests of ROS nodes without ROS, on tftool's runtime and simulated time",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Answer to ROS 2's modules before test files are imported."""
    if config.getoption("--ros-free"):
        from tftool.ros.importing import ros_free

        imports = ros_free(insist=True)
        imports.__enter__()
        _imports.append(imports)


def pytest_unconfigure(config: pytest.Config) -> None:
    """Give the imports back."""
    while _imports:
        _imports.pop().__exit__(None, None, None)


@pytest.fixture
def ros_runtime() -> Iterator[Any]:
    """A world on simulated time; the test is a program in it and may use rclpy."""
    from tftool.ros.testing import RosRuntime

    with RosRuntime() as runtime:
        yield runtime


@pytest.fixture(autouse=True)
def _ros_free(request: pytest.FixtureRequest) -> None:
    """With `--ros-free`, every test has a runtime."""
    if request.config.getoption("--ros-free"):
        request.getfixturevalue("ros_runtime")
