"""Functions of launch_pytest that wait until a process starts, ends or prints a text.

Each coroutine has a synchronous version with the suffix `_sync`. The arguments are the launch
context, the action that starts the process, a function that checks the output, and a timeout in
seconds.
"""

import asyncio
from collections.abc import Callable
from typing import Any

from tftool.base.stamps import as_seconds, seconds
from tftool.ros.host import program
from tftool.ros.host.shims import SLICE

Condition = Callable[[Any, Any], Any]
"""Function that takes an action and a user's function and returns whether the wait is over."""


def _limit(timeout: float | None) -> Callable[[], bool]:
    """Start a timeout; return a function that returns whether the timeout has passed."""
    clock = program.current().clock
    end = None if timeout is None else clock.now() + seconds(timeout)
    return lambda: end is not None and clock.now() >= end


def _wait_functions(
    condition: Condition, at_timeout: Callable[[Any, Any], object]
) -> tuple[Any, Any]:
    """Return a coroutine function that waits for a condition, and its synchronous version.

    `at_timeout` is called if the condition is still false at the timeout.
    """

    async def wait(context: Any, action: Any, check: Any, timeout: float | None = None) -> bool:
        is_over = _limit(timeout)
        while not (holds := bool(condition(action, check))) and not is_over():
            # This runs in the event loop of a user's test, whose time is the world's.
            await asyncio.sleep(as_seconds(SLICE))  # noqa: TID251
        if not holds:
            at_timeout(action, check)
        return holds

    def wait_sync(context: Any, action: Any, check: Any, timeout: float | None = None) -> bool:
        is_over = _limit(timeout)
        while not (holds := bool(condition(action, check))) and not is_over():
            program.current().sleep(SLICE)
        if not holds:
            at_timeout(action, check)
        return holds

    return wait, wait_sync


def _wait_functions_for_action(condition: Callable[[Any], bool]) -> tuple[Any, Any]:
    """Return a coroutine function that waits for a condition on an action, and a synchronous one.

    Unlike the functions that `_wait_functions` returns, these functions do not check output.
    """
    wait_checked, wait_checked_sync = _wait_functions(
        lambda action, _: condition(action), lambda *_: None
    )

    async def wait(context: Any, action: Any, timeout: float | None = None) -> Any:
        return await wait_checked(context, action, None, timeout)

    def wait_sync(context: Any, action: Any, timeout: float | None = None) -> Any:
        return wait_checked_sync(context, action, None, timeout)

    return wait, wait_sync


def _passes(check: Callable[[str], object], output: str) -> bool:
    """Return whether the assertions in the function `check` accept an output."""
    try:
        check(output)
    except AssertionError:
        return False
    return True


wait_for_start, wait_for_start_sync = _wait_functions_for_action(
    lambda one: one.process_details is not None
)
wait_for_exit, wait_for_exit_sync = _wait_functions_for_action(
    lambda one: one.return_code is not None
)
wait_for_output, wait_for_output_sync = _wait_functions(
    lambda action, check: check(action.get_stdout()), lambda *_: None
)
wait_for_stderr, wait_for_stderr_sync = _wait_functions(
    lambda action, check: check(action.get_stderr()), lambda *_: None
)
assert_output, assert_output_sync = _wait_functions(
    lambda action, check: _passes(check, action.get_stdout()),
    lambda action, check: check(action.get_stdout()),
)
assert_stderr, assert_stderr_sync = _wait_functions(
    lambda action, check: _passes(check, action.get_stderr()),
    lambda action, check: check(action.get_stderr()),
)
