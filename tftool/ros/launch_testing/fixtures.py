"""Fixtures of launch_pytest that start a launch, and conversion of launch tests for pytest."""

import asyncio
import functools
import inspect
import sys
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tftool.ros.host import program
from tftool.ros.host.shims import UserEventLoop
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.service import LaunchService
from tftool.ros.launch_testing.description import ReadyToTest, ready_actions
from tftool.ros.launch_testing.runner import wait_for_first


class LaunchedService(LaunchService):
    """Launch service of a launch_pytest fixture; the launch runs during the tests.

    Attributes:
        event_loop: Event loop for tests that are coroutines; None once the launch has ended.
        auto_shutdown: Whether to shut the launch down after its tests.
        waiting: Test generators that continue after the end of the launch, by test function.
    """

    def __init__(self) -> None:
        super().__init__()
        self.event_loop: asyncio.AbstractEventLoop | None = None
        self.auto_shutdown = True
        self.waiting: dict[Any, Any] = {}

    def start(self, description: LaunchDescription, *, keep_alive: bool) -> None:
        """Start a launch, and wait until the tests may start or the launch has ended.

        With `keep_alive`, the launch continues after its last process has ended.

        Raises:
            AssertionError: If the description has several ReadyToTest actions.
        """
        program.current()  # create the program of a fixture for several tests
        self.event_loop = UserEventLoop()
        if not (found := list(ready_actions(description.entities))):
            description.add_action(action := ReadyToTest())
            found = [action]
        if len(found) > 1:
            raise AssertionError(
                "launch_pytest fixtures must return a LaunchDescription containing only one "
                "ReadyToTest action"
            )
        ready = asyncio.Event()
        found[0].callbacks.append(ready.set)
        self.include_launch_description(description)
        launch = self.begin(keep_alive=keep_alive)
        wait_for_first((ready, launch.ended))

    def finish(self) -> None:
        """Wait for the end of the launch; shut the launch down first if `auto_shutdown` is set.

        Raises:
            AssertionError: If the launch itself has failed.
        """
        if self.event_loop is None:
            return
        if self.auto_shutdown:
            self.shutdown(force_sync=True)
        self.event_loop = None
        self.wait()
        # As in ROS 2, the tests decide about a failed process.
        if self.failed_itself:
            raise AssertionError("the launch has failed: its log lines above give the reason")

    def _is_idle(self) -> bool:
        """Return whether the launch has ended; examples of launch_pytest call this method."""
        return self.event_loop is None


def service_fixture(scope: Any) -> Any:
    """Return the pytest fixture `launch_service` for a scope such as "module"."""

    @pytest.fixture(scope=scope, name="launch_service")
    def launch_service() -> Iterator[LaunchedService]:
        """Yield the launch service for a launch_pytest fixture; end the launch after the tests."""
        service = LaunchedService()
        yield service
        service.finish()

    return launch_service


def _part_of_service(name: str, part: str) -> Callable[[Any], Any]:
    """Return a function that creates the fixture `name` for a given pytest scope.

    The value of the fixture is the attribute `part` of the test's launch service.
    """

    def make(scope: Any) -> Any:
        @pytest.fixture(scope=scope, name=name)
        def given(launch_service: LaunchedService) -> Any:
            return getattr(launch_service, part)

        return given

    return make


context_fixture = _part_of_service("launch_context", "context")
loop_fixture = _part_of_service("event_loop", "event_loop")

SHARED = {
    "launch_service": service_fixture,
    "launch_context": context_fixture,
    "event_loop": loop_fixture,
}


def fixture(
    decorated: Any = None,
    *args: Any,
    shutdown_when_idle: bool = True,
    auto_shutdown: bool = True,
    **kwargs: Any,
) -> Any:
    """Turn the decorated function into a fixture that starts a launch.

    The function returns the launch description, or a sequence whose first item is the description.

    Args:
        decorated: Function that returns the description.
        args: Arguments of `pytest.fixture`.
        shutdown_when_idle: Whether the launch ends after its last process has ended.
        auto_shutdown: Whether to shut the launch down after its tests.
        kwargs: Keyword arguments of `pytest.fixture`.
    """
    scope = kwargs.get("scope", "function")
    if scope != "function":
        # The shared fixtures must have the scope of this fixture.
        module = sys._getframe(1).f_globals
        for name, made in SHARED.items():
            module.setdefault(name, made(scope))

    def declare(function: Any) -> Any:
        function.launch_options = (shutdown_when_idle, auto_shutdown)
        made: Any = pytest.fixture(*args, **kwargs)(function)
        made.launch_fixture = (function.__name__, scope)
        return made

    return declare if decorated is None else declare(decorated)


def launched(name: str, options: tuple[bool, bool], service: LaunchedService, value: Any) -> None:
    """Start the launch whose description a launch_pytest fixture has returned.

    `options` are the values of `shutdown_when_idle` and `auto_shutdown`; see `fixture`.

    Raises:
        AssertionError: If the value is not a launch description.
    """
    description = value[0] if isinstance(value, tuple | list) and value else value
    if not isinstance(description, LaunchDescription):
        raise AssertionError(
            f"When running launch_pytest fixture '{name}': return value must be either a launch "
            "description or a sequence which first item is a launch description"
        )
    shutdown_when_idle, service.auto_shutdown = options
    service.start(description, keep_alive=not shutdown_when_idle)


def as_function(test: Any, *, after_end: bool, after_yield: bool = False) -> Callable[..., None]:
    """Convert a launch test to an ordinary test function for pytest.

    With `after_end`, the test runs after the end of the launch; with `after_yield`, only the part
    of a generator after its `yield` runs.
    """
    takes = inspect.signature(test)
    wants_service = "launch_service" in takes.parameters

    @functools.wraps(test)
    def run(*args: Any, **given: Any) -> None:
        service = given["launch_service"] if wants_service else given.pop("launch_service")
        if after_yield:
            if (generator := service.waiting.pop(test, None)) is None:
                pytest.skip("the part of this test before its yield has failed")
            service.finish()
            _end(generator, test)
            return
        if after_end and is_generator(test):
            raise AssertionError(
                "generator or async generator based launch test items cannot be marked with "
                "shutdown=True"
            )
        loop = service.event_loop or UserEventLoop()
        if after_end:
            service.finish()
        made = test(*args, **given)
        if inspect.iscoroutine(made):
            loop.run_until_complete(made)
        elif inspect.isgenerator(made) or inspect.isasyncgen(made):
            steps = _steps(made, loop)
            next(steps)
            if scope_of(test) == "function":
                service.finish()
                _end(steps, test)
            else:
                service.waiting[test] = steps

    own = list(takes.parameters.values())
    if not wants_service:
        own.append(inspect.Parameter("launch_service", inspect.Parameter.KEYWORD_ONLY))
    run.__signature__ = takes.replace(parameters=own)  # type: ignore[attr-defined]
    return run


def scope_of(test: Any) -> str:
    """Return the pytest scope of the launch fixture that a test uses, such as "module"."""
    return str(fixture_of(test)[1])


def fixture_of(test: Any) -> tuple[str, str]:
    """Return name and pytest scope of the launch fixture that a test uses.

    The result is ("", "function") if the test has no mark `launch` that names a fixture.
    """
    for mark in getattr(test, "pytestmark", ()):
        if mark.name == "launch" and (named := mark.kwargs.get("fixture")) is not None:
            if hasattr(named, "launch_fixture"):
                return named.launch_fixture  # type: ignore[no-any-return]
            return named.__name__, "function"
    return "", "function"


def is_generator(test: Any) -> bool:
    """Return whether a test is a generator function, synchronous or asynchronous."""
    return inspect.isgeneratorfunction(test) or inspect.isasyncgenfunction(test)


def _steps(generator: Any, loop: asyncio.AbstractEventLoop) -> Iterator[None]:
    """Advance a synchronous or asynchronous generator; yield after each of its steps.

    The event loop `loop` runs an asynchronous generator.
    """
    if inspect.isgenerator(generator):
        yield from generator
        return
    while True:
        try:
            loop.run_until_complete(anext(generator))
        except StopAsyncIteration:
            return
        yield


def _end(steps: Iterator[None], test: Any) -> None:
    """Run the part of a test generator after its `yield`.

    Raises:
        AssertionError: If the generator yields again.
    """
    if next(steps, steps) is not steps:
        kind = "a generator" if inspect.isgeneratorfunction(test) else "an async gen"
        raise AssertionError(
            f"launch tests using {kind} function must stop iteration after yielding once"
        )
