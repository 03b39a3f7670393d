"""launch_testing's runs: a launch, tests beside it, and tests after its end."""

import asyncio
import copy
import functools
import inspect
import sys
import unittest
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, cast

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import seconds
from tftool.ros.host import program, user_code
from tftool.ros.launch.actions import IncludeLaunchDescription, RegisterEventHandler
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.events import OnProcessExit, OnProcessIO, OnProcessStart
from tftool.ros.launch.service import LaunchService
from tftool.ros.launch_testing.description import READY_WITHIN, ready_actions
from tftool.ros.launch_testing.records import IoHandler, ProcInfoHandler

MAKES = "generate_test_description"
"""The function that a file of launch tests defines."""

STOPPED = "Launch stopped before the active tests finished."


class TestResult(unittest.TextTestResult):
    """Result of a run, with its test cases."""

    __test__ = False

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.testCases: list[Any] = []

    def startTest(self, test: Any) -> None:
        """Record the test."""
        self.testCases.append(test)
        super().startTest(test)

    def append(self, other: "TestResult") -> None:
        """Add the tests of another result."""
        self.testCases += other.testCases
        self.testsRun += other.testsRun
        for name in ("failures", "errors", "skipped", "expectedFailures", "unexpectedSuccesses"):
            getattr(self, name).extend(getattr(other, name))


class _Loader(unittest.TestLoader):
    """Loader of the test classes that run before the end of the launch, or after it."""

    def __init__(self, *, after_end: bool) -> None:
        super().__init__()
        self._after_end = after_end

    def loadTestsFromTestCase(self, testCaseClass: Any) -> unittest.TestSuite:
        """Return the tests of a class if it belongs to that time."""
        if getattr(testCaseClass, "__post_shutdown_test__", False) != self._after_end:
            return unittest.TestSuite()
        # A class of its own for each launch, which gets that launch's values.
        own = {"__module__": testCaseClass.__module__, "__qualname__": testCaseClass.__qualname__}
        return super().loadTestsFromTestCase(type(testCaseClass.__name__, (testCaseClass,), own))


def _cases(tests: Any) -> Iterator[Any]:
    if isinstance(tests, unittest.TestSuite):
        for inside in tests:
            yield from _cases(inside)
    else:
        yield tests


def _given(function: Callable[..., Any], values: Mapping[str, Any]) -> Callable[..., Any]:
    """Return a function with those of its arguments that have a value of that name."""
    wanted = inspect.signature(function).parameters
    return functools.partial(function, **{k: v for k, v in values.items() if k in wanted})


class TestRun:
    """A launch with its tests.

    Attributes:
        name: Name of the run.
        param_args: Values of the parameters.
        pre_shutdown_tests: Tests that run beside the launch.
        post_shutdown_tests: Tests that run after the launch's end.
        timeout: Seconds that its processes have to start.
        markers: Markers of the description.
    """

    __test__ = False

    def __init__(
        self,
        name: str,
        test_description_function: Callable[..., Any],
        param_args: Mapping[str, Any],
        pre_shutdown_tests: unittest.TestSuite,
        post_shutdown_tests: unittest.TestSuite,
    ) -> None:
        self.name, self.param_args = name, dict(param_args)
        self._function = test_description_function
        self.pre_shutdown_tests = pre_shutdown_tests
        self.post_shutdown_tests = post_shutdown_tests
        self.timeout = float(
            getattr(test_description_function, "__ready_to_test_action_timeout__", READY_WITHIN)
        )
        self.markers = getattr(test_description_function, "__markers__", {})
        for case in self.all_cases() if param_args else ():
            # A name that says what it was launched with.
            old = case._testMethodName
            case._testMethodName = f"{old}{self._values()}"
            setattr(case, case._testMethodName, getattr(case, old))

    def __str__(self) -> str:
        return f"{self.name}{self._values()}"

    def _values(self) -> str:
        return f"[{', '.join(map(str, self.param_args.values()))}]" if self.param_args else ""

    def all_cases(self) -> Iterator[Any]:
        """Yield the tests of the run."""
        yield from _cases(self.pre_shutdown_tests)
        yield from _cases(self.post_shutdown_tests)

    def normalized_test_description(
        self, *, ready_fn: Callable[[], object]
    ) -> tuple[LaunchDescription, dict[str, Any]]:
        """Return the launch description, and the values for the tests.

        Args:
            ready_fn: Called when the tests may start.

        Raises:
            UsageError: If the description has no ReadyToTest action.
        """
        made = self._function()
        description, values = made if isinstance(made, tuple) else (made, {})
        ready = next(ready_actions(description.entities), None)
        if ready is None:
            raise UsageError(
                f"{MAKES} functions must return a LaunchDescription containing a ReadyToTest "
                "action, which says when the tests start"
            )
        ready.callbacks.append(ready_fn)
        return description, values

    def get_launch_description(self) -> LaunchDescription:
        """Return the launch description, to be displayed."""
        return self.normalized_test_description(ready_fn=lambda: None)[0]

    def check(self) -> None:
        """Check that its description takes what it is parametrized with.

        Raises:
            UsageError: If a test's arguments do not match.
        """
        takes = inspect.getfullargspec(inspect.unwrap(self._function))
        names = {*takes.args, *takes.kwonlyargs}
        for name in sorted(self.param_args.keys() - names):
            raise UsageError(
                f"Could not find an argument in {MAKES} matching parametrized argument '{name}'"
            )
        for name in sorted(names - self.param_args.keys()):
            raise UsageError(f"{MAKES} has unexpected extra argument '{name}'")

    def run(self, arguments: Mapping[str, str], preamble: Sequence[Any] = ()) -> TestResult:
        """Launch the description, and run its tests.

        Args:
            arguments: Values for the arguments of the launch.
            preamble: Actions before it.
        """
        ready = asyncio.Event()
        description, values = self.normalized_test_description(ready_fn=ready.set)
        service = LaunchService()
        info, output = ProcInfoHandler(), IoHandler()
        known = {"proc_info": info, "proc_output": output, "test_args": dict(arguments)}
        given = {**values, **self.param_args, **known}
        handlers = (
            OnProcessStart(on_start=lambda event, _: info.append(event)),
            OnProcessExit(on_exit=lambda event, _: info.append(event)),
            OnProcessIO(on_stdout=output.append, on_stderr=output.append),
        )
        include = IncludeLaunchDescription(description, launch_arguments=list(arguments.items()))
        watched = [*preamble, *map(RegisterEventHandler, handlers), include]
        service.include_launch_description(LaunchDescription(watched))
        launch = service.begin(keep_alive=bool(self.markers.get("keep_alive")))
        failure = f"Timed out after {self.timeout:g} s waiting for processes to start up."
        result = None
        try:
            if wait_for_first((ready, launch.ended), self.timeout) is ready:
                beside = {**given, "launch_service": service}
                result = _run(self.pre_shutdown_tests, beside, {**known, "launch_service": service})
            stopped = launch.ended.is_set()
        finally:
            service.shutdown(force_sync=True)
            program.current().ask(launch.ended.wait)
        if result is None or stopped:
            told = "\n".join((STOPPED if stopped else failure, *service.errors))
            for text in _last_words(info, output):
                sys.stdout.write(text)
            return _failed(list(self.all_cases()), told)
        result.append(_run(self.post_shutdown_tests, given, known))
        return result


def wait_for_first(
    events: Sequence[asyncio.Event], timeout: float | None = None
) -> asyncio.Event | None:
    """Wait for the first of some events of the world; return it, or None after `timeout` s."""
    owner = program.current()

    async def wait() -> None:
        waits = [asyncio.ensure_future(event.wait()) for event in events]
        end = None if timeout is None else owner.clock.now() + seconds(timeout)
        try:
            await owner.first_of(*waits, until=end)
        finally:
            for one in waits:
                one.cancel()

    owner.ask(wait)
    return next((event for event in events if event.is_set()), None)


def _run(
    tests: unittest.TestSuite, given: Mapping[str, Any], attributes: Mapping[str, Any]
) -> TestResult:
    """Run tests; pass values as arguments, and some as attributes too."""
    tests = copy.deepcopy(tests)
    classes = dict.fromkeys(type(case) for case in _cases(tests))
    for test_class in classes:
        for name, value in attributes.items():
            setattr(test_class, name, value)
        for name in ("setUpClass", "tearDownClass"):
            setattr(test_class, name, _given(getattr(test_class, name), given))
    for case in _cases(tests):
        for name in (case._testMethodName, "setUp", "tearDown"):
            setattr(case, name, _given(getattr(case, name), given))
    runner = unittest.TextTestRunner(verbosity=2, resultclass=TestResult)
    return cast(TestResult, runner.run(tests))


def _failed(cases: Sequence[Any], reason: str) -> TestResult:
    """Return the result of tests that could not run to their end."""
    stream = unittest.runner._WritelnDecorator(sys.stderr)
    result = TestResult(stream, descriptions=True, verbosity=0)
    stream.writeln(reason)
    for case in cases:
        result.startTest(case)
        # Without a traceback: the lines of this module say nothing.
        result.addFailure(case, cast(Any, (AssertionError, AssertionError(reason), None)))
    return result


def _last_words(info: ProcInfoHandler, output: IoHandler) -> Iterator[str]:
    """Yield the output of each process that has failed."""
    for event in info:
        status = getattr(event, "returncode", 0)
        if status:
            yield f"Process '{event.process_name}' exited with {status}\n"
            yield from (line.text.decode(errors="replace") for line in output[event.action])


class LaunchTestRunner:
    """Runner of launches with their tests."""

    def __init__(
        self,
        test_runs: Sequence[TestRun],
        launch_file_arguments: Sequence[str] = (),
        debug: bool = False,
    ) -> None:
        self._runs, self._arguments = list(test_runs), list(launch_file_arguments)

    def generate_preamble(self) -> list[Any]:
        """Return actions for the beginning of every launch."""
        return []

    def validate(self) -> None:
        """Check the descriptions.

        Raises:
            UsageError: If one has other arguments than it is given.
        """
        for run in self._runs:
            run.check()

    def run(self) -> dict[TestRun, Any]:
        """Launch each with its tests; return the results.

        Raises:
            UsageError: If an argument of the launch is malformed.
        """
        arguments = parse_launch_arguments(self._arguments)
        results: dict[TestRun, Any] = {}
        for run in self._runs:
            if len(self._runs) > 1:
                sys.stdout.write(f"\nStarting test run {run}\n")
            try:
                results[run] = run.run(dict(arguments), self.generate_preamble())
            except unittest.SkipTest as skipped:
                sys.stdout.write(f"{run} is skipped: {skipped}\n")
                results[run] = unittest.TestResult()
                for case in run.all_cases():
                    results[run].startTest(case)
                    results[run].addSkip(case, str(skipped))
        return results


def parse_launch_arguments(launch_arguments: Sequence[str]) -> list[tuple[str, str]]:
    """Return the names and values of `name:=value` words; the last of a name counts.

    Raises:
        RuntimeError: If one is malformed.
    """
    found = {}
    for word in launch_arguments:
        name, is_pair, value = word.partition(":=")
        if not (name and is_pair and value):
            raise RuntimeError(
                f"malformed launch argument '{word}', expected format '<name>:=<value>'"
            )
        found[name] = value
    return list(found.items())


def LoadTestsFromPythonModule(module: Any, *, name: str = "launch_tests") -> list[TestRun]:
    """Return the runs of a file of launch tests: several if its description is parametrized.

    Raises:
        InputError: If the module has no description.
    """
    function = getattr(module, MAKES, None)
    if function is None:
        raise InputError(f"'{module.__file__}' is no file of launch tests: it has no {MAKES}()")
    runs = function() if hasattr(function, "__parametrized__") else [(function, {})]
    return [
        TestRun(
            name,
            description,
            values,
            _Loader(after_end=False).loadTestsFromModule(module),
            _Loader(after_end=True).loadTestsFromModule(module),
        )
        for description, values in runs
    ]


def load_tests(path: Path, arguments: Sequence[str]) -> LaunchTestRunner:
    """Return the runner of a file of launch tests, in the program that runs.

    Args:
        path: The file.
        arguments: Values for the arguments of its launch, `name:=value`.

    Raises:
        InputError: If the file cannot be read or has no description.
        UsageError: If the description has other arguments than those given.
    """
    module = user_code.load_module(path)
    runner = LaunchTestRunner(LoadTestsFromPythonModule(module, name=path.stem), arguments)
    runner.validate()
    return runner


def run_tests(path: Path, arguments: Sequence[str]) -> None:
    """Run a file of launch tests as a program's body; it ends with status 1 if one fails.

    Raises:
        InputError: If the file cannot be read or has no description.
        UsageError: If the description has other arguments than those given.
        SystemExit: If a test fails.
    """
    results = load_tests(path, arguments).run().values()
    if not all(result.wasSuccessful() for result in results):
        raise SystemExit(1)
