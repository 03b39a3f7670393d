"""Records of processes and their output in launch tests, and assertions about the records."""

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from typing import Any

from tftool.ros.host.locks import StateMonitor
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.events import (
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    RunningProcessEvent,
    ShutdownProcess,
    matches_action,
)
from tftool.ros.launch.processes import Startable
from tftool.ros.launch_testing.text import build_text_match, without_escapes

EXIT_OK, EXIT_SIGINT, EXIT_SIGQUIT, EXIT_SIGKILL, EXIT_SIGSEGV = 0, 130, 131, 137, 139

NO_CMD_ARGS = object()
"""Value of `cmd_args` for a process without arguments."""


class NoMatchingProcessException(Exception):
    """Error for a process that has no event in a record."""


class _Record:
    """List of events about processes, in order of arrival; tests can wait for events."""

    def __init__(self) -> None:
        self._state = StateMonitor()
        self._events: list[Any] = []

    def append(self, event: RunningProcessEvent) -> None:
        """Append an event, and wake the tests that wait."""
        with self._state.changing():
            self._events.append(event)

    def __iter__(self) -> Iterator[Any]:
        return iter(list(self._events))

    def processes(self) -> list[Any]:
        """Return the actions that started the processes in this record."""
        return list(dict.fromkeys(event.action for event in self))

    def process_names(self) -> list[str]:
        """Return the names of the processes in this record."""
        return list(dict.fromkeys(event.process_name for event in self))

    def wait_for(self, check: Callable[[], bool], timeout: float | None) -> bool:
        """Wait until `check` returns True; return False after `timeout` seconds."""

        def holds() -> bool:
            try:
                return check()
            except NoMatchingProcessException:  # not yet
                return False

        return self._state.wait(holds, timeout)


class ProcInfoHandler(_Record):
    """Record with the newest event of each process: ProcessStarted or ProcessExited."""

    def __iter__(self) -> Iterator[Any]:
        return iter({event.action: event for event in list(self._events)}.values())

    def __getitem__(self, key: Any) -> Any:
        """Return the newest event of a process.

        The key is the action that started the process, or a part of the process's name.

        Raises:
            KeyError: If there is no event.
        """
        for event in self:
            if event.action is key or (isinstance(key, str) and key in event.process_name):
                return event
        raise KeyError(key)

    def assertWaitForShutdown(
        self, process: Any, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Wait until a process has ended; for the arguments see `resolveProcesses`.

        Raises:
            AssertionError: If the process has not ended after `timeout` seconds.
        """

        def has_ended() -> bool:
            found = resolveProcesses(self, process=process, cmd_args=cmd_args)[0]
            return isinstance(self[found], ProcessExited)

        assert self.wait_for(has_ended, timeout), (
            f"Timed out waiting for process '{process}' to finish"
        )

    def assertWaitForStartup(
        self, process: Any, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Wait until a process has started; for the arguments see `resolveProcesses`.

        Raises:
            AssertionError: If the process has not started after `timeout` seconds.
        """
        assert self.wait_for(
            lambda: bool(resolveProcesses(self, process=process, cmd_args=cmd_args)), timeout
        ), f"Timed out waiting for process '{process}' to start"


class IoHandler(_Record):
    """Record of the lines that processes have printed."""

    def track(self, process_name: str) -> None:
        """Do nothing; in ROS 2, tests call this method for processes that may print nothing."""

    def __getitem__(self, key: Any) -> list[ProcessIO]:
        """Return the lines that a process has printed, as ProcessIO events.

        The key is the action that started the process, or the process's name.
        """
        return [event for event in self if key in (event.action, event.process_name)]

    def waitFor(
        self,
        expected_output: Any,
        process: Any = None,
        cmd_args: Any = None,
        *,
        timeout: float | None = 10,
        **options: Any,
    ) -> bool:
        """Wait until a matching process has printed a text; return False at the timeout.

        Args:
            expected_output: Text, pattern, or list of texts and patterns in order.
            process: Action of the process, or a part of its name; None for all processes.
            cmd_args: Arguments of the process, to choose among processes of one name.
            timeout: Longest wait in seconds.
            options: Further options of `assertInStream`.

        Raises:
            NoMatchingProcessException: If no matching process prints anything before the timeout.
        """

        def is_there() -> bool:
            try:
                assertInStream(self, expected_output, process, cmd_args, **options)
            except AssertionError:
                return False
            return True

        found = self.wait_for(is_there, timeout)
        if not found:
            resolveProcesses(self, process=process, cmd_args=cmd_args, strict_proc_matching=False)
        return found

    def assertWaitFor(self, *args: Any, **kwargs: Any) -> None:
        """Wait until a matching process has printed a text; for the arguments see `waitFor`.

        Raises:
            AssertionError: If the text has not been printed before the timeout.
        """
        assert self.waitFor(*args, **kwargs), "Waiting for output timed out"


ActiveProcInfoHandler, ActiveIoHandler = ProcInfoHandler, IoHandler


def _described(action: Any) -> str:
    if (details := action.process_details) is not None:
        return " ".join((details["name"], *details["cmd"][1:]))
    words = getattr(action, "cmd", [None])
    is_known = all(isinstance(word, str) for word in words)
    return " ".join(words) if is_known else "Unknown - Process not launched yet"


def resolveProcesses(
    info_obj: Any, *, process: Any = None, cmd_args: Any = None, strict_proc_matching: bool = True
) -> list[Any]:
    """Return the actions that started the processes with a given name and arguments.

    Args:
        info_obj: Record of processes.
        process: Action, or part of a process's name; None for all processes.
        cmd_args: Arguments that a process found by name must have; NO_CMD_ARGS for no arguments.
        strict_proc_matching: Whether a name that matches several processes is an error.

    Raises:
        NoMatchingProcessException: If no process matches.
        ValueError: If a name matches several processes and `strict_proc_matching` is true.
        TypeError: If `process` has another type.
    """
    known = info_obj.processes()
    if process is None or isinstance(process, Startable):
        found = [one for one in known if process in (None, one)]
        if not found:
            whose = "any process" if process is None else f"proc {_described(process)}"
            raise NoMatchingProcessException(f"No data recorded for {whose}")
        return found
    if not isinstance(process, str):
        raise TypeError(
            f"a process must be given as an action or a part of its name, not {process!r}"
        )
    wanted = [cmd_args] if isinstance(cmd_args, str) else cmd_args

    def fits(action: Any) -> bool:
        arguments = action.process_details["cmd"][1:]
        if cmd_args is NO_CMD_ARGS:
            return not arguments
        return cmd_args is None or all(one in arguments for one in wanted)

    found = [one for one in known if process in one.process_details["name"] and fits(one)]
    names = ", ".join(sorted(map(_described, known)))
    if not found:
        raise NoMatchingProcessException(
            f"Did not find any processes matching name '{process}' and args '{cmd_args}'. "
            f"Procs: {names}"
        )
    if strict_proc_matching and len(found) > 1:
        raise ValueError(
            f"Found multiple processes matching name '{process}' and cmd_args '{cmd_args}'. "
            f"Procs: {names}"
        )
    return found


def assertExitCodes(
    proc_info: Any,
    allowable_exit_codes: Collection[int] = (EXIT_OK,),
    process: Any = None,
    cmd_args: Any = None,
    *,
    strict_proc_matching: bool = True,
) -> None:
    """Check the exit statuses of processes.

    For the last three arguments see `resolveProcesses`; without `process`, all are checked.

    Raises:
        AssertionError: If an exit status is not allowed.
    """
    for code in allowable_exit_codes:
        assert isinstance(code, int), f"Provided exit code {code} is not an int"
    for action in resolveProcesses(
        proc_info, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    ):
        event = proc_info[action]
        assert event.returncode in allowable_exit_codes, (
            f"Proc {event.process_name} exited with code {event.returncode}"
        )


def assertInStream(
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Callable[[str], str] | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
    stream: str = "stderr",
) -> None:
    """Check that a process has written a text to one of its output streams.

    Args:
        proc_output: Record of the output.
        expected_output: Text, pattern, or list of texts and patterns in order.
        process: Action of the process, or a part of its name.
        cmd_args: Arguments of the process, to choose among processes of one name.
        output_filter: Function that changes the output before it is compared.
        strict_proc_matching: Whether a name that matches several processes is an error.
        strip_ansi_escape_sequences: Whether to remove colours before the comparison.
        stream: "stdout" or "stderr".

    Raises:
        AssertionError: If no matching process has written the text.
        ValueError: If there is no such stream.
    """
    if stream not in ("stdout", "stderr"):
        raise ValueError(f"a stream must be 'stdout' or 'stderr', not {stream!r}")
    match = build_text_match(expected_output)
    found = resolveProcesses(
        proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    )
    for action in found:
        written = (line for line in proc_output[action] if line.from_stdout == (stream == "stdout"))
        text = "".join(line.text.decode() for line in written)
        if strip_ansi_escape_sequences:
            text = without_escapes(text)
        if match(text if output_filter is None else output_filter(text)) is not None:
            return
    names = ", ".join(sorted(action.process_details["name"] for action in found))
    raise AssertionError(
        f"Did not find '{expected_output}' in output for any of the matching processes: {names}"
    )


def assertInStdout(
    proc_output: Any, expected_output: Any, process: Any, cmd_args: Any = None, **options: Any
) -> None:
    """Check that a process has printed a text on its standard output; see `assertInStream`."""
    assertInStream(proc_output, expected_output, process, cmd_args, **options, stream="stdout")


def assertInStderr(
    proc_output: Any, expected_output: Any, process: Any, cmd_args: Any = None, **options: Any
) -> None:
    """Check that a process has printed a text on its standard error; see `assertInStream`."""
    assertInStream(proc_output, expected_output, process, cmd_args, **options, stream="stderr")


def assertDefaultStream() -> str:
    """Return the name of the stream that `assertInStream` checks by default, "stderr"."""
    return "stderr"


class SequentialTextChecker:
    """Checker that finds texts in an output, each after the text found before."""

    def __init__(self, output: list[str]) -> None:
        """Prepare a search from the beginning of an output.

        A text that spans two lines of the output is not found.
        """
        self._output = output
        self._piece = self._column = 0

    def assertInStdout(self, msg: str) -> None:
        """Check that the output contains a text after the text of the previous check.

        Raises:
            AssertionError: If the rest of the output does not contain the text.
        """
        column = self._column
        for piece in range(self._piece, len(self._output)):
            at = self._output[piece].find(msg, column)
            if at >= 0:
                self._piece, self._column = piece, at + len(msg)
                return
            column = 0
        raise AssertionError(
            f"'{msg}' not found in sequence after previous match.  "
            f"The output near the last matched line:\n{self.get_nearby_lines()}"
        )

    assertInText = assertInStdout

    def get_nearby_lines(self) -> str:
        """Return the line of the text found last, with two lines before and two lines after it."""
        lines = "".join(self._output).splitlines()
        before = "".join(self._output[: self._piece])
        before += "".join(self._output[self._piece : self._piece + 1])[: self._column]
        at = before.count("\n")
        return "\n".join(lines[max(0, at - 2) : at + 3])


@contextmanager
def assertSequentialStdout(
    proc_output: Any, process: Any, cmd_args: Any = None
) -> Iterator[SequentialTextChecker]:
    """Yield a checker for several texts that a process must have printed one after the other."""
    (action,) = resolveProcesses(proc_output, process=process, cmd_args=cmd_args)
    yield SequentialTextChecker([line.text.decode() for line in proc_output[action]])


class ProcessProxy:
    """State and output of one process, for tests."""

    def __init__(
        self,
        process_action: Any,
        proc_info: ProcInfoHandler,
        proc_output: IoHandler,
        *,
        output_filter: Callable[[str], str] | None = None,
    ) -> None:
        self.target_process_action = process_action
        self._info, self._output, self._filter = proc_info, proc_output, output_filter

    def wait_for_shutdown(self, timeout: float | None = None) -> bool:
        """Wait until the process has ended; return False after `timeout` seconds."""
        return self._info.wait_for(lambda: self.terminated, timeout)

    def wait_for_output(
        self, condition: Callable[[str], bool] = lambda _: True, timeout: float | None = None
    ) -> bool:
        """Wait until `condition` accepts the process's output; return False at the timeout."""
        return self._output.wait_for(lambda: self.running and condition(self.output), timeout)

    def _text(self, *streams: bool) -> str:
        lines = self._output[self.target_process_action]
        text = "".join(line.text.decode() for line in lines if line.from_stdout in streams)
        return text if self._filter is None else self._filter(text)

    @property
    def stdout(self) -> str:
        """Standard output of the process so far."""
        return self._text(True)

    @property
    def stderr(self) -> str:
        """Standard error of the process so far."""
        return self._text(False)

    @property
    def output(self) -> str:
        """Standard output and standard error of the process so far."""
        return self._text(True, False)

    def _is(self, state: type) -> bool:
        known = {event.action: event for event in self._info}
        return isinstance(known.get(self.target_process_action), state)

    @property
    def running(self) -> bool:
        """Whether the process has started and not ended."""
        return self._is(ProcessStarted)

    @property
    def terminated(self) -> bool:
        """Whether the process has ended."""
        return self._is(ProcessExited)

    @property
    def exit_code(self) -> int:
        """Exit status of the process, which must have ended."""
        return int(self._info[self.target_process_action].returncode)


@contextmanager
def launch_process(
    launch_service: Any,
    process_action: Any,
    proc_info: ProcInfoHandler,
    proc_output: IoHandler,
    **options: Any,
) -> Iterator[ProcessProxy]:
    """Run a process during the `with` block; yield a `ProcessProxy` for the process.

    `options` are further arguments of `ProcessProxy`.
    """
    launch_service.include_launch_description(LaunchDescription([process_action]))
    try:
        yield ProcessProxy(process_action, proc_info, proc_output, **options)
    finally:
        matcher = matches_action(process_action)
        launch_service.emit_event(ShutdownProcess(process_matcher=matcher))
