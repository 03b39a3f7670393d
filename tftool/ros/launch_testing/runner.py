"""Runner of launch tests: a launch, tests during the launch, and tests after the launch's end."""

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
from tftool.ros.host import importing, program, user_code
from tftool.ros.host.workspace import current
from tftool.ros.launch.actions import IncludeLaunchDescription, RegisterEventHandler
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.events import OnProcessExit, OnProcessIO, OnProcessStart
from tftool.ros.launch.service import LaunchService
from tftool.ros.launch_testing.description import READY_WITHIN, ready_actions
from tftool.ros.launch_testing.records import IoHandler, ProcInfoHandler

MAKES = "generate_test_description"
"""Name of the function that a file of launch tests defines."""

STOPPED = "Launch stopped before the active tests finished."


class TestResult(unittest.TextTestResult):
    """Result of unittest with a list of the test cases that were run."""

    __test__ = False

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.testCases: list[Any] = []

    def startTest(self, test: Any) -> None:
        """Add a test case to the list of test cases, and start the test case."""
        self.testCases.append(test)
        super().startTest(test)

    def append(self, other: "TestResult") -> None:
        """Add the test cases, counts and failures of the result `other` to this result."""
        self.testCases += other.testCases
        self.testsRun += other.testsRun
        for name in ("failures", "errors", "skipped", "expectedFailures", "unexpectedSuccesses"):
            getattr(self, name).extend(getattr(other, name))


class _Loader(unittest.TestLoader):
    """Loader of the test classes that run during a launch; with `after_end`, after the launch."""

    def __init__(self, *, after_end: bool) -> None:
        super().__init__()
        self._after_end = after_end

    def loadTestsFromTestCase(self, testCaseClass: Any) -> unittest.TestSuite:
        """Return the tests of a class; an empty suite if this loader does not load the class."""
        if getattr(testCaseClass, "__post_shutdown_test__", False) != self._after_end:
            return unittest.TestSuite()
        # Each launch needs its own copy of the class, which gets the launch's values.
        own = {"__module__": testCaseClass.__module__, "__qualname__": testCaseClass.__qualname__}
        return super().loadTestsFromTestCase(type(testCaseClass.__name__, (testCaseClass,), own))


def _cases(tests: Any) -> Iterator[Any]:
    if isinstance(tests, unittest.TestSuite):
        for inside in tests:
            yield from _cases(inside)
    else:
        yield tests


def _bind(function: Callable[..., Any], values: Mapping[str, Any]) -> Callable[..., Any]:
    """Return `function` with arguments bound to `values` of the same names."""
    wanted = inspect.signature(function).parameters
    return functools.partial(function, **{k: v for k, v in values.items() if k in wanted})


class TestRun:
    """Launch with its tests and the values of its parameters.

    Attributes:
        name: Name of the run.
        param_args: Values of the parameters, by name.
        pre_shutdown_tests: Tests that run during the launch.
        post_shutdown_tests: Tests that run after the launch's end.
        timeout: Longest time in seconds from the launch's start until the tests may start.
        markers: Markers that decorators have set on the function that describes the launch.
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
            # Add the values of the parameters to the test's name.
            old = case._testMethodName
            case._testMethodName = f"{old}{self._values()}"
            setattr(case, case._testMethodName, getattr(case, old))

    def __str__(self) -> str:
        return f"{self.name}{self._values()}"

    def _values(self) -> str:
        return f"[{', '.join(map(str, self.param_args.values()))}]" if self.param_args else ""

    def all_cases(self) -> Iterator[Any]:
        """Yield the test cases that run during the launch, then those that run after its end."""
        yield from _cases(self.pre_shutdown_tests)
        yield from _cases(self.post_shutdown_tests)

    def normalized_test_description(
        self, *, ready_fn: Callable[[], object]
    ) -> tuple[LaunchDescription, dict[str, Any]]:
        """Return the launch description, and a mapping from argument names of tests to values.

        `ready_fn` is called when the tests may start.

        Raises:
            UsageError: If the description has no ReadyToTest action.
        """
        made = self._function()
        description, values = made if isinstance(made, tuple) else (made, {})
        ready = next(ready_actions(description.entities), None)
        if ready is None:
            raise UsageError(
                f"{MAKES} functions must return a LaunchDescription containing a ReadyToTest "
                "action, which starts the tests"
            )
        ready.callbacks.append(ready_fn)
        return description, values

    def get_launch_description(self) -> LaunchDescription:
        """Return only the launch description, for callers that run no tests."""
        return self.normalized_test_description(ready_fn=lambda: None)[0]

    def check(self) -> None:
        """Check that `generate_test_description` has exactly the arguments of `parametrize`.

        Raises:
            UsageError: If an argument is missing or superfluous.
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
        """Launch the description, run the tests, and return the tests' result.

        The actions in `preamble` are executed before the description.
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
    """Wait until one of several events is set; return that event, or None at the timeout.

    The events belong to the loop of tftool's world; `timeout` is in seconds, None for no limit.
    """
    owner = program.current()
    end = None if timeout is None else owner.clock.now() + seconds(timeout)
    owner.ask(lambda: owner.first_of(*events, until=end))
    return next((event for event in events if event.is_set()), None)


def _run(
    tests: unittest.TestSuite, arguments: Mapping[str, Any], attributes: Mapping[str, Any]
) -> TestResult:
    """Run tests and return their result.

    Args:
        tests: The tests.
        arguments: Values for arguments of test methods, `setUp` and the like, by argument name.
        attributes: Values that become attributes of the test classes.
    """
    tests = copy.deepcopy(tests)
    classes = dict.fromkeys(type(case) for case in _cases(tests))
    for test_class in classes:
        for name, value in attributes.items():
            setattr(test_class, name, value)
        for name in ("setUpClass", "tearDownClass"):
            setattr(test_class, name, _bind(getattr(test_class, name), arguments))
    for case in _cases(tests):
        for name in (case._testMethodName, "setUp", "tearDown"):
            setattr(case, name, _bind(getattr(case, name), arguments))
    runner = unittest.TextTestRunner(verbosity=2, resultclass=TestResult)
    return cast(TestResult, runner.run(tests))


def _failed(cases: Sequence[Any], reason: str) -> TestResult:
    """Return a result in which each of the test cases has failed for the same reason."""
    stream = unittest.runner._WritelnDecorator(sys.stderr)
    result = TestResult(stream, descriptions=True, verbosity=0)
    stream.writeln(reason)
    for case in cases:
        result.startTest(case)
        # The traceback is omitted, because lines of this module do not help users.
        result.addFailure(case, cast(Any, (AssertionError, AssertionError(reason), None)))
    return result


def _last_words(info: ProcInfoHandler, output: IoHandler) -> Iterator[str]:
    """Yield the output of each process whose exit status was not 0, below a heading."""
    for event in info:
        status = getattr(event, "returncode", 0)
        if status:
            yield f"Process '{event.process_name}' exited with {status}\n"
            yield from (line.text.decode(errors="replace") for line in output[event.action])


class LaunchTestRunner:
    """Runner of a list of launches with their tests."""

    def __init__(
        self,
        test_runs: Sequence[TestRun],
        launch_file_arguments: Sequence[str] = (),
        debug: bool = False,
    ) -> None:
        self._runs, self._arguments = list(test_runs), list(launch_file_arguments)

    def generate_preamble(self) -> list[Any]:
        """Return actions to execute before every launch; subclasses may override this method."""
        return []

    def validate(self) -> None:
        """Check that `generate_test_description` has exactly the arguments of `parametrize`.

        Raises:
            UsageError: If an argument is missing or superfluous.
        """
        for run in self._runs:
            run.check()

    def run(self) -> dict[TestRun, Any]:
        """Run each launch with its tests; return a mapping from run to result.

        Raises:
            RuntimeError: If a launch argument is malformed.
            UsageError: If a launch description has no ReadyToTest action.
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
    """Parse launch arguments `name:=value` to pairs (name, value); the last value of a name counts.

    Raises:
        RuntimeError: If an argument is malformed.
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
    """Return the runs that a file of launch tests describes: one for each set of parameters.

    Raises:
        InputError: If the module has no function `generate_test_description`.
    """
    function = getattr(module, MAKES, None)
    if function is None:
        raise InputError(
            f"'{module.__file__}' is not a file of launch tests: it has no function {MAKES}()"
        )
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


def run_tests(path: Path, arguments: Sequence[str]) -> None:
    """Run a file of launch tests inside the calling program.

    Raises:
        InputError: If the file cannot be read, or has no `generate_test_description`.
        UsageError: If `parametrize` does not match the arguments of `generate_test_description`.
        SystemExit: With status 1, if a test fails.
    """
    # Tests import modules of the workspace's packages, too.
    importing.search_last(current().module_folders)
    module = user_code.load_module(path)
    runner = LaunchTestRunner(LoadTestsFromPythonModule(module, name=path.stem), arguments)
    runner.validate()
    results = runner.run().values()
    if not all(result.wasSuccessful() for result in results):
        raise SystemExit(1)
