"""pytest plugin for tests with launch_testing and launch_pytest, enabled by `--ros-free`."""

import unittest
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tftool.ros.launch_testing import fixtures
from tftool.ros.launch_testing.runner import MAKES, LaunchTestRunner, LoadTestsFromPythonModule
from tftool.ros.testing import RosRuntime

MARKS = ("launch_test", "rostest")
"""Names of the pytest marks for a function that describes a launch with tests."""

launch_service = fixtures.service_fixture("function")
launch_context = fixtures.context_fixture("function")
event_loop = fixtures.loop_fixture("function")


class LaunchTestFailure(Exception):
    """Error that lists the failed tests of one file of launch tests."""

    def __init__(self, failures: Iterable[tuple[Any, str]]) -> None:
        super().__init__("\n\n".join(f"{case}\n{text}" for case, text in failures))


class LaunchTestItem(pytest.Item):
    """pytest item for a file of launch tests; running the item runs all launches of the file."""

    def runtest(self) -> None:
        """Run the launches and their tests in a new world on simulated time.

        Raises:
            LaunchTestFailure: If a test fails.
        """
        module: Any = self.getparent(LaunchTestModule)
        arguments = [word for words in self.config.getoption("--launch-args") for word in words]
        with RosRuntime():
            runs = LoadTestsFromPythonModule(module.obj, name=module.obj.__name__)
            runner = LaunchTestRunner(runs, arguments)
            runner.validate()
            results: list[unittest.TestResult] = list(runner.run().values())
        if all(result.testsRun == len(result.skipped) for result in results) and results:
            reasons = [reason for result in results for _, reason in result.skipped]
            if reasons:
                pytest.skip(reasons[0])
        failures = [one for result in results for one in (*result.errors, *result.failures)]
        if failures or not all(result.wasSuccessful() for result in results):
            raise LaunchTestFailure(failures)

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """Return pytest's report of the failed tests, without lines of this plugin's code."""
        if isinstance(excinfo.value, LaunchTestFailure):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Return file, line number and name of the item for pytest's report."""
        return self.path, 0, f"launch tests: {self.name}"


class LaunchTestModule(pytest.Module):
    """pytest collector for a Python file that contains the text `generate_test_description`."""

    def collect(self) -> Iterable[Any]:
        """Return a `LaunchTestItem` if the file has a launch test, else the file's other tests."""
        function = getattr(self.obj, MAKES, None)
        marks = {mark.name for mark in getattr(function, "pytestmark", ())}
        if marks.isdisjoint(MARKS):
            return super().collect()
        item = LaunchTestItem.from_parent(self, name=self.obj.__name__)
        for mark in function.pytestmark:  # type: ignore[union-attr]
            item.add_marker(getattr(pytest.mark, mark.name)(*mark.args, **mark.kwargs))
        return [item]


def pytest_pycollect_makemodule(module_path: Path, parent: Any) -> pytest.Module | None:
    """Return a `LaunchTestModule` for a file that may contain a launch test; otherwise None."""
    if MAKES.encode() not in module_path.read_bytes():
        return None
    return LaunchTestModule.from_parent(parent, path=module_path)


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> Any:
    """Return the pytest items for a test with the mark `launch`; None for any other test.

    A generator test gets two items if its launch runs for several tests. The second item runs the
    code after the `yield`, when the launch has ended.
    """
    marks = [mark for mark in getattr(obj, "pytestmark", ()) if mark.name == "launch"]
    if not marks or not collector.funcnamefilter(name) or hasattr(obj, "launch_key"):
        return None
    fixture, scope = fixtures.fixture_of(obj)
    after_end = bool(marks[0].kwargs.get("shutdown"))
    tests: list[tuple[str, Any, bool]] = [
        (name, fixtures.as_function(obj, after_end=after_end), after_end)
    ]
    if scope != "function" and fixtures.is_generator(obj):
        rest = fixtures.as_function(obj, after_end=True, after_yield=True)
        tests.append((f"{name}[shutdown_test]", rest, True))
    items: list[Any] = []
    for shown, test, is_after in tests:
        test.launch_key = (fixture, is_after)
        if fixture:
            test = pytest.mark.usefixtures("launch_service", fixture)(test)
        else:
            reason = '"fixture" keyword argument is required in a pytest.mark.launch() decorator'
            collector.warn(pytest.PytestCollectionWarning(f"{name}: {reason}"))
            test = pytest.mark.skip(reason)(test)
        # pytest gets a test as an attribute of its module or class.
        setattr(collector.obj, shown, test)
        items += collector.ihook.pytest_pycollect_makeitem(
            collector=collector, name=shown, obj=test
        )
    return items


def _launch_of(item: Any) -> tuple[Any, ...] | None:
    """Return a key that is equal for all tests that share one launch.

    Return None for a test without a launch, or with a launch that no other test uses.
    """
    key = getattr(getattr(item, "obj", None), "launch_key", None)
    if key is None or fixtures.scope_of(item.obj) == "function":
        return None
    callspec = getattr(item, "callspec", None)
    indices = {} if callspec is None else callspec.indices
    return item.getparent(pytest.Module), key[0], indices.get(key[0])


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[Any]) -> None:
    """Move tests that run after the end of a launch behind the tests that run during the launch."""
    late = [one for one in items if _launch_of(one) is not None and one.obj.launch_key[1]]
    for one in late:
        launch = _launch_of(one)
        others = [at for at, item in enumerate(items) if _launch_of(item) == launch]
        items.remove(one)
        items.insert(others[-1], one)


@pytest.hookimpl(wrapper=True, trylast=True)
def pytest_fixture_setup(fixturedef: Any, request: Any) -> Iterator[None]:
    """Start the launch whose description a launch_pytest fixture returns."""
    options = getattr(fixturedef.func, "launch_options", None)
    service: Any = None if options is None else request.getfixturevalue("launch_service")
    value = yield
    if options is not None:
        try:
            fixtures.launched(fixturedef.argname, options, service, value)
        finally:
            # Finalizers run in reverse order: this one must run before the fixture's world ends.
            fixturedef.addfinalizer(service.finish)
    return value
