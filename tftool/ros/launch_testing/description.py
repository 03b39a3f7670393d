"""Actions, decorators and markers of launch_testing that describe a launch test."""

import functools
import sys
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from tftool.base.stamps import seconds
from tftool.ros.host import program
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action
from tftool.ros.launch.events import (
    Event,
    OnProcessExit,
    OnProcessIO,
    ProcessIO,
    ShutdownProcess,
    matches_action,
)
from tftool.ros.launch.processes import ExecuteProcess, seconds_of

READY_WITHIN = 15.0
"""Default limit in seconds until the tests must be ready to start."""


class ReadyToTest(Action):
    """Action that starts the tests of a launch by calling the functions in `callbacks`."""

    def __init__(self) -> None:
        super().__init__()
        self.callbacks: list[Callable[[], object]] = []

    def execute(self, context: LaunchContext) -> Any:
        """Start the tests."""
        for callback in self.callbacks:
            callback()


def ready_actions(entities: Iterable[Any]) -> Iterator[ReadyToTest]:
    """Yield the ReadyToTest actions in a launch description, including those in nested actions."""
    for entity in entities:
        if isinstance(entity, ReadyToTest):
            yield entity
        if hasattr(entity, "describe_sub_entities"):
            yield from ready_actions(entity.describe_sub_entities())
            for _, inside in entity.describe_conditional_sub_entities():
                yield from ready_actions(inside)


class Test(ExecuteProcess):
    """Action that runs a test as a process, which is ended after `timeout` seconds."""

    __test__ = False  # for pytest, which collects classes of that name

    def __init__(self, *, timeout: Any = None, kill_timeout: Any = 5.0, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.timeout = timeout

    def execute(self, context: LaunchContext) -> Any:
        """Start the test's process, and the timer that ends the process at the timeout."""
        following = super().execute(context)
        if self.timeout is not None:
            # Not a TimerAction, which would keep the launch alive after the process's end.
            launch, clock = context.launch, context.launch.clock
            limit = seconds_of(context, self.timeout, "a test's timeout")
            timer = clock.timer(clock.now() + seconds(limit))
            end = ShutdownProcess(process_matcher=matches_action(self))
            timer.add_done_callback(lambda done: done.cancelled() or launch.emit(end))
            over = OnProcessExit(target_action=self, on_exit=lambda *_: timer.cancel() and None)
            launch.handlers.append(over)
        return following


class GTest(Test):
    """Action that runs the executable at `path`, which contains GoogleTest tests."""

    def __init__(self, *, path: Any, **kwargs: Any) -> None:
        super().__init__(cmd=[path], **kwargs)
        self.path = path


class PyTest(Test):
    """Action that runs the tests in the file at `path` with pytest."""

    def __init__(self, *, path: Any, **kwargs: Any) -> None:
        super().__init__(cmd=[sys.executable, "-m", "pytest", path], **kwargs)
        self.path = path


class KeepAliveProc(ExecuteProcess):
    """Action that starts a process without end, which keeps the launch running until shutdown."""

    def __init__(self) -> None:
        super().__init__(cmd=[sys.executable, "-c", "import signal; signal.pause()"])

    def execute(self, context: LaunchContext) -> Any:
        """Start a program that waits until the launch is shut down."""
        self.handle_exit(context)
        context.launch.start_function(self, self.cmd, _wait_for_end)


def _wait_for_end() -> None:
    owner = program.current()
    while not owner.interrupted:
        owner.sleep(seconds(3600.0))


class StdoutReadyListener(OnProcessIO):
    """Event handler that executes actions when a process prints a line containing `ready_txt`."""

    def __init__(self, *, target_action: Any = None, ready_txt: str, actions: Any) -> None:
        def check(event: Event) -> Any:
            assert isinstance(event, ProcessIO)
            return actions if ready_txt in event.text.decode() else None

        super().__init__(target_action=target_action, on_stdout=check)
        self.entities = list(actions)


class ReadyAggregator:
    """Counter that calls a function after `num_to_aggregate` calls of its method `ready_fn`."""

    def __init__(self, ready_fn: Callable[[], object], num_to_aggregate: int) -> None:
        self._ready, self._left = ready_fn, num_to_aggregate

    def ready_fn(self) -> None:
        """Count this call; after the last expected call, call the function given to `__init__`."""
        self._left -= 1
        if self._left == 0:
            self._ready()


def post_shutdown_test() -> Callable[[type], type]:
    """Return a decorator for a test class whose tests run after the end of the launch."""

    def decorate(test_class: type) -> type:
        if not isinstance(test_class, type):
            raise TypeError("post_shutdown_test() can decorate only classes of tests")
        test_class.__post_shutdown_test__ = True  # type: ignore[attr-defined]
        return test_class

    return decorate


def keep_alive(description: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a function that describes a launch, so that the launch outlives its processes."""
    markers = {**getattr(description, "__markers__", {}), "keep_alive": True}
    description.__markers__ = markers  # type: ignore[attr-defined]
    return description


def ready_to_test_action_timeout(timeout: float) -> Callable[[Any], Any]:
    """Return a decorator that sets how many seconds a launch may need until its tests start."""

    def decorate(description: Any) -> Any:
        description.__ready_to_test_action_timeout__ = timeout
        return description

    return decorate


def parametrize(argnames: str, argvalues: Iterable[Any]) -> Callable[[Any], Any]:
    """Return a decorator that runs a launch and its tests once for each set of values.

    `argnames` contains the names of the parameters, separated by commas. `argvalues` contains a
    value, or a tuple of values, for each launch.
    """
    names = [name.strip() for name in argnames.split(",") if name.strip()]
    sets = [value if isinstance(value, tuple) else (value,) for value in argvalues]

    def decorate(description: Any) -> Any:
        @functools.wraps(description)
        def each() -> Iterator[tuple[Any, dict[str, Any]]]:
            for values in sets:
                given = dict(zip(names, values, strict=False))
                one = functools.partial(description, **given)
                yield functools.update_wrapper(one, description), given

        each.__parametrized__ = True  # type: ignore[attr-defined]
        return each

    return decorate


def retry_on_failure(*, times: int, delay: float | None = None) -> Callable[[Any], Any]:
    """Return a decorator that repeats a test as long as an assertion in the test fails.

    The test runs at most `times` times, with a pause of `delay` seconds between two runs.
    """

    def decorate(test: Any) -> Any:
        @functools.wraps(test)
        def repeated(self: Any, *args: Any, **kwargs: Any) -> Any:
            for _ in range(times - 1):
                try:
                    return test(self, *args, **kwargs)
                except AssertionError:
                    program.current().sleep(seconds(delay or 0.0))
            return test(self, *args, **kwargs)

        return repeated

    return decorate
