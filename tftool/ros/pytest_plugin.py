"""pytest plugin for tests of ROS nodes without ROS.

The fixture `ros_runtime` is a `tftool.ros.testing.RosRuntime`: a simulated world. With `pytest
--ros-free` every test runs in such a world, and test files may `import rclpy` at their top. If a
fixture with the scope of a class, a module or the session uses rclpy, all tests that use the
fixture share one world.
"""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

_imports: list[Any] = []
"""The open block of `ros_imports`, if any."""
_set_up: list[Any] = []
"""Fixtures that are being set up, the innermost last."""
_shared: list[Any] = []
"""Runtimes of fixtures whose scope is larger than one test."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options `--ros-free` and `--launch-args` to pytest."""
    parser.getgroup("tftool").addoption(
        "--ros-free",
        action="store_true",
        help="run tests of ROS nodes without ROS, on tftool's runtime and simulated time",
    )
    parser.getgroup("tftool").addoption(
        "--launch-args",
        action="append",
        nargs="*",
        default=[],
        help="arguments of launch tests, name:=value",
    )


@pytest.hookimpl(tryfirst=True)
def pytest_load_initial_conftests(early_config: pytest.Config) -> None:
    """Make ROS 2's modules importable before the first conftest.py, if `--ros-free` is given."""
    if getattr(early_config.known_args_namespace, "ros_free", False):
        _provide(early_config.rootpath)


def pytest_configure(config: pytest.Config) -> None:
    """Register the plugin for launch tests, if `--ros-free` is given."""
    if config.getoption("--ros-free"):
        from tftool.ros import launch_plugin

        config.pluginmanager.register(launch_plugin, "tftool-launch-tests")
        for mark in (*launch_plugin.MARKS, "launch"):
            config.addinivalue_line("markers", f"{mark}: a test that runs during or after a launch")
        _provide(config.rootpath)


def _provide(root: Path) -> None:
    """Make ROS 2's modules and the packages of a workspace importable."""
    if not _imports:
        from tftool.ros.testing import ros_imports

        imports = ros_imports(root, _program_of_fixture)
        imports.__enter__()
        _imports.append(imports)


def pytest_unconfigure(config: pytest.Config) -> None:
    """Remove ROS 2's modules and the workspace's folders from Python's imports."""
    while _imports:
        _imports.pop().__exit__(None, None, None)


@pytest.hookimpl(hookwrapper=True)
def pytest_make_collect_report(collector: pytest.Collector) -> Iterator[None]:
    """Prepare and report the import of a test file.

    Unload another test file of the same name before the import. Add a hint to the report if `import
    rclpy` fails.
    """
    if _imports and isinstance(collector, pytest.Module):
        # Packages made from one template have test files of the same name. pytest imports a test
        # file by its name alone, and would reuse the first module.
        known = getattr(sys.modules.get(collector.path.stem), "__file__", None)
        if known and Path(known).name == collector.path.name and Path(known) != collector.path:
            del sys.modules[collector.path.stem]
    outcome: Any = yield
    report = outcome.get_result()
    if not _imports and report.failed and "No module named 'rclpy" in report.longreprtext:
        report.sections.append(
            ("tftool", "pytest --ros-free lets test files import rclpy at their top, without ROS.")
        )


@pytest.hookimpl(hookwrapper=True)
def pytest_fixture_setup(fixturedef: Any) -> Iterator[None]:
    """Remember which fixture is being set up, for `_program_of_fixture`."""
    _set_up.append(fixturedef)
    yield
    _set_up.pop()


def _program_of_fixture() -> Any:
    """Create a world for the fixture that is being set up; return the program of that world.

    Return None if no fixture is being set up.
    """
    if not _set_up:
        return None
    from tftool.ros.testing import RosRuntime

    runtime = RosRuntime()
    runtime.__enter__()
    _shared.append(runtime)

    def close() -> None:
        _shared.remove(runtime)
        runtime.__exit__(None, None, None)

    # Registered before the fixture's own finalizer, so this one runs after it.
    _set_up[-1].addfinalizer(close)
    return runtime.program


@pytest.fixture
def ros_runtime() -> Iterator[Any]:
    """Yield a simulated world in which the test may use rclpy.

    The world is new, unless a fixture of the test has already created a world.
    """
    from tftool.ros.testing import RosRuntime

    if _shared:
        yield _shared[-1]
        return
    with RosRuntime() as runtime:
        yield runtime


@pytest.fixture(autouse=True)
def _ros_free(request: pytest.FixtureRequest) -> None:
    """Use the fixture `ros_runtime` in every test, if `--ros-free` is given."""
    if request.config.getoption("--ros-free"):
        request.getfixturevalue("ros_runtime")
