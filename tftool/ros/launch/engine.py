"""Execution of a launch description; all its nodes run in one process and one event loop."""

import asyncio
import os
import shlex
import signal
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from tftool.base.errors import InputError, TftoolError, UsageError
from tftool.base.stamps import seconds
from tftool.ros.host import executables, importing, program
from tftool.ros.host.error_text import error_sentence
from tftool.ros.host.program import Program, exit_status
from tftool.ros.host.workspace import Workspace
from tftool.ros.launch import commands
from tftool.ros.launch.arguments import declared_arguments, refuse_unknown
from tftool.ros.launch.commands import SystemCommand
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.events import (
    Event,
    EventQueue,
    ExecutionComplete,
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    Shutdown,
    ShutdownProcess,
)
from tftool.ros.launch.frontend import load_file
from tftool.ros.launch.processes import Executable
from tftool.ros.rclpy.exceptions import NotInitializedException
from tftool.ros.ros2 import ros2_program
from tftool.world.clock import SimClock
from tftool.world.log import LogRecord
from tftool.world.node import Node
from tftool.world.world import World

Say = Callable[[str, str, str], object]
"""Function called with a log line: level, program (such as "launch" or "listener-4"), text."""


SOONEST = 0.1
"""Shortest delay in seconds before a program is started again, so that simulated time advances."""


_ENDS = (signal.SIGINT, signal.SIGTERM, signal.SIGABRT)


class Launch(Node):
    """Node that executes a launch description, starts its programs and watches them.

    Attributes:
        failed: Names (as in log lines) of the programs whose exit status was not 0.
        ended: Event that is set when everything that the launch started has ended.
        handlers: Registered event handlers.
        labels: Names (as in log lines) of tftool's built-in nodes, by node name.
    """

    is_shown: ClassVar[bool] = False

    def __init__(
        self,
        world: World,
        source: Path | LaunchDescription,
        *,
        workspace: Workspace | None = None,
        arguments: Mapping[str, str] | None = None,
        say: Say = lambda level, who, text: None,
        context: LaunchContext | None = None,
        name: str = "launch",
        contained: bool = False,
        keep_alive: bool = False,
    ) -> None:
        """Read the launch file, if `source` is a path; the method `run` executes the description.

        Args:
            world: World in which the nodes run.
            source: Path of a launch file, or a launch description.
            workspace: Workspace in which packages are searched; None for the current workspace.
            arguments: Values of the arguments that the launch file declares.
            say: Function called with level, program and text of each log line of the launch.
            context: State of the launch; None for a new state.
            name: Name of the launch's own node.
            contained: Whether a user's program started this launch. If true, an error in the
                description ends only the launch, not the world, and simulated time advances with
                real time while a system command runs.
            keep_alive: Whether the launch continues after its last process has ended.

        Raises:
            InputError: If the file cannot be read.
            UsageError: If `arguments` has a name that the file does not declare.
        """
        self.context = context or LaunchContext(workspace)
        self.context.load, self.context.launch = load_file, self
        if isinstance(source, Path):
            # Launch files import modules of the workspace's packages, too.
            importing.search_last(self.context.workspace.module_folders)
            self.description = load_file(source)
            self.context.enter_file(source)
            refuse_unknown(
                source, arguments or {}, declared_arguments(self.description, self.context)
            )
        else:
            self.description = source
        self.context.launch_configurations.update(arguments or {})
        self.failed: list[str] = []
        self.ended = asyncio.Event()
        self.handlers: list[Any] = []
        self.labels: dict[str, str] = {}
        self._say = say
        self._running: dict[str, Callable[[], object]] = {}  # each ends a program
        self._timers: set[asyncio.Task[None]] = set()
        self._watches: set[asyncio.Task[None]] = set()
        self._respawns: dict[str, tuple[float, Callable[[], None], int]] = {}
        self._count = 0
        self._closing = False
        self._contained, self._keep_alive = contained, keep_alive
        self._events = EventQueue(self._handle)
        self._over: asyncio.Future[None] | None = None
        self._actions: dict[str, Any] = {}  # by label
        super().__init__(world, name)
        stops_time = isinstance(self.clock, SimClock) and not contained
        self._commands = commands.CommandRunner(self, self.warn, stops_time=stops_time)
        world.log.listen(self._logged, name)

    async def run(self) -> None:
        """Execute the description; wait until all programs have ended or a Shutdown is emitted.

        Raises:
            UsageError: If an action of the description cannot be executed.
        """
        self._over = asyncio.get_running_loop().create_future()
        try:
            if self._contained:
                self._guarded(lambda: self.do([self.description]))
            else:
                self.do([self.description])
            self._look_round()
            await self._over
        finally:
            self._closing = True
            for timer in self._timers:
                timer.cancel()
            for end in list(self._running.values()):
                end()
            await asyncio.gather(*self._timers, *self._watches, return_exceptions=True)
        while self._running:
            self._over = asyncio.get_running_loop().create_future()
            await self._over
        self.ended.set()

    # Methods for actions

    def do(self, entities: Any) -> None:
        """Execute actions, and the actions that they return, one after the other.

        Raises:
            UsageError: If an action cannot be executed; the text gives its line in the launch file.
            InputError: If Python code in the launch file raises an exception.
        """
        with self._events.delayed():
            for entity in entities if isinstance(entities, Iterable) else [entities]:
                following = self._visit(entity)
                if following:
                    self.do(following)

    def _visit(self, entity: Any) -> Any:
        if not hasattr(entity, "visit"):
            raise UsageError(f"a launch description must contain actions, not {entity!r}")
        where = getattr(entity, "where", "")
        try:
            return entity.visit(self.context)
        except (UsageError, InputError) as error:
            kind = UsageError if isinstance(error, UsageError) else InputError
            raise kind(f"{where}: {error}" if where else f"{error}") from error
        except TftoolError:
            raise
        except Exception as error:
            raise InputError(f"{where}: {error_sentence(error)}") from error

    def emit(self, event: Event) -> None:
        """Pass an event to the event handlers after the current action."""
        self._events.add(event)

    def _handle(self, event: Event) -> None:
        for handler in list(self.handlers):
            if handler.matches(event):
                self.context.push_locals()
                try:
                    entities = handler.handle(event, self.context)
                except SystemExit as error:
                    self.failed += ["launch"] if exit_status(error) else []
                    entities = None
                    self._end()
                except Exception as error:
                    raise InputError(error_sentence(error)) from error
                self.do(entities or ())
                self.context.pop_locals()
        if isinstance(event, ShutdownProcess):
            for label, action in self._actions.items():
                if label in self._running and event.process_matcher(action):
                    self._signal(label, getattr(event, "signal", signal.SIGINT))
        if isinstance(event, Shutdown) and not self._closing:
            self._closing = True
            self._say("INFO", "launch", f"shutting down: {event.reason}")
            self._end()

    def _signal(self, label: str, number: int) -> None:
        """Send a signal to a process.

        A program inside tftool's process ends at SIGINT, SIGTERM and SIGABRT, and ignores other
        signals.
        """
        pid = (self._actions[label].process_details or {}).get("pid")
        if pid is not None and number != signal.SIGINT:
            os.kill(pid, number)
        elif number in _ENDS:
            self._running[label]()
        else:
            name = signal.Signals(number).name
            self.warn(f"{name} for {label} has no effect: {label} runs in tftool's own process")

    def watch_topic(self, topic: str, kind: type[Any], callback: Callable[[Any], object]) -> None:
        """Call `callback` with every message on a topic; end the launch if `callback` raises."""
        self.subscribe(topic, kind, lambda message: self._guarded(lambda: callback(message)))

    def _wrote(self, label: str, line: str, *, to_stdout: bool) -> None:
        """Store a line of output if the action caches output, and emit ProcessIO."""
        action: Any = self._actions.get(label)
        if getattr(action, "cached_output", False):
            action.output_lines.append((to_stdout, f"{line}\n"))
        event = ProcessIO(
            text=f"{line}\n".encode(), fd=1 if to_stdout else 2, **self._event_arguments(label)
        )
        if self.is_awaited(event):
            self._guarded(lambda: self.emit(event))

    def _logged(self, record: LogRecord) -> None:
        if record.program in self._actions:
            line = f"[{record.level}] [{record.node}]: {record.text}"
            self._wrote(record.program, line, to_stdout=False)

    def _line(self, label: str, line: str, is_stdout: bool = True) -> None:
        self._say("", label, line)
        if line.endswith("No module named 'rclpy'"):
            self.warn(
                f"{label} runs in a process of its own, without tftool's rclpy: "
                "start the node's file by python3 FILE, or by Node(executable=FILE)"
            )
        self._wrote(label, line, to_stdout=is_stdout)

    def _printed(self, label: str, text: str, is_stdout: bool) -> None:
        """Handle the lines that a program has printed; call this in the program's thread."""
        for line in text.splitlines():
            program.current().ask(partial(self._wrote, label, line, to_stdout=is_stdout))

    def _event_arguments(self, label: str) -> dict[str, Any]:
        """Return the keyword arguments of a `RunningProcessEvent` for the process named `label`."""
        action = self._actions.get(label)
        details = getattr(action, "process_details", None) or {"name": label}
        return {"action": action, **details}

    def _report_start(self, label: str, words: Sequence[str], **details: Any) -> None:
        """Log that a process has started, and emit a `ProcessStarted` event."""
        self._actions[label].process_details = {"name": label, "cmd": list(words), **details}
        shown = f": {shlex.join(words)}" if details else ""  # not for nodes
        self._say("INFO", label, f"process started{shown}")
        self.emit(ProcessStarted(**self._event_arguments(label)))

    def is_awaited(self, event: Event) -> bool:
        """Return whether a registered handler matches an event."""
        return any(handler.matches(event) for handler in self.handlers)

    def complete(self, action: Any) -> None:
        """Emit the event that an action has ended, if a handler waits for this event."""
        if action.is_awaited:
            self.emit(ExecutionComplete(action=action))

    def interrupt(self) -> None:
        """Begin to shut the launch down, as the first Ctrl-C in `ros2 launch` does."""
        self._closing = True
        self._say("WARNING", "launch", "user interrupted with ctrl-c (SIGINT)")
        self._commands.end()
        event = Shutdown(reason="ctrl-c (SIGINT)", due_to_sigint=True)
        self._guarded(lambda: self.emit(event))

    def shut_down(self, reason: str) -> None:
        """End all programs that the launch started, then the launch itself."""
        self._guarded(lambda: self.emit(Shutdown(reason=reason)))

    def info(self, text: str) -> None:
        """Log a message of the launch with level INFO."""
        self._say("INFO", "launch", text)

    def warn(self, text: str) -> None:
        """Log a message of the launch with level WARNING."""
        self._say("WARNING", "launch", text)

    def when_served(self, service: str, node_name: str, callback: Callable[[bool], object]) -> None:
        """Wait for a service, then call a function.

        If this launch runs no node named `node_name`, the wait ends without the service.

        The callback is called with True if the service exists, else False. During this call, the
        launch has the arguments and environment of the scope that requested the wait.
        """

        def is_settled() -> bool:
            running = (self._actions.get(label) for label in self._running)
            return self.world.has_service(service) or not any(
                getattr(action, "node_name", None) == node_name for action in running
            )

        if is_settled():
            callback(self.world.has_service(service))
            return
        state = self.context.copy_state()

        async def wait() -> None:
            changed = asyncio.Event()
            stop = self.world.watch(changed.set)
            try:
                while not is_settled():
                    await changed.wait()
                    changed.clear()
            finally:
                stop()
            with self.context.use_state(state):
                self._guarded(lambda: callback(self.world.has_service(service)))

        self._start_task(wait(), self._timers)

    def send_requests(
        self, service: str, requests: Iterable[Any], callback: Callable[[Any, Any], object]
    ) -> None:
        """Send requests to a service, each after the response to the previous request.

        The callback is called after each request, with the request and either the response or the
        error of the call.
        """

        async def work() -> None:
            for request in requests:
                try:
                    answer = await self.world.call(service, request)
                except TftoolError as error:
                    answer = error
                self._guarded(partial(callback, request, answer))

        self._start_task(work(), self._watches)

    def execute_later(self, action: Any, period: float, actions: Sequence[Any]) -> None:
        """Execute the actions of a timer after a delay, with the arguments of the present scope.

        `period` is the delay in seconds. The timer, `action`, ends after its inner actions.
        """
        state = self.context.copy_state()

        async def wait() -> None:
            await self.clock.sleep(seconds(period), self.phase, self.rank)
            with self.context.use_state(state):
                self._guarded(lambda: self.do(actions))
                self._guarded(lambda: self.complete(action))

        self._start_task(wait(), self._timers)

    def start_node(self, action: Any, executable: Executable, respawn: float | None) -> None:
        """Start a program of a package, or a file, as a node of the world.

        Args:
            action: Action that starts the program; events name this action.
            executable: Program to start, with its arguments.
            respawn: Seconds between the end and a new start of the program; None to start it once.
        """

        def start(label: str) -> None:
            try:
                workspace = self.context.workspace
                node = executables.start(
                    self.world,
                    executables.find(workspace, executable.package, executable.name),
                    label=label,
                    argv=executable.argv or executable.launched_argv(),
                    arguments=executable.arguments,
                    options=executable.options,
                    on_exit=partial(self._program_ended, label),
                )
            except executables.HasItsOwnCommand as error:
                # The launch goes on without this program.
                self.warn(f"not started: {error}")
                return
            if isinstance(node, Program):
                node.on_print = partial(self._printed, label)
                self._running[label] = partial(self._remove, label, node)
            else:
                self.labels[node.name] = label
                # The program runs as long as the world, which ends with the launch.
                self._running[label] = partial(self._ended, label, 0, "")
            self._report_start(label, [executable.name, *executable.arguments])

        self._start(action, executable.label, start, respawn)

    def start_process(
        self, action: Any, name: str, command: SystemCommand, respawn: float | None
    ) -> None:
        """Start a system command as a child process.

        Simulated time stops until the command ends, at most for `LONGEST_HOLD` real seconds, unless
        the launch is `contained`.

        For the arguments see `start_node`; a number is added to `name`, the name in log lines.
        """

        def start(label: str) -> None:
            env, cwd = dict(command.environment), command.cwd
            self._report_start(label, command.words, cwd=cwd, env=env)
            self._start_task(self._watch(label, command), self._watches)

        self._start(action, name, start, respawn)

    def start_ros2(self, action: Any, words: Sequence[str], respawn: float | None) -> None:
        """Run a command `ros2 WORDS` as a program of the world, in tftool's process.

        For the arguments see `start_node`; `words` are the words after `ros2`.

        Raises:
            UsageError: If tftool does not have this command of ROS 2.
        """
        show: list[Callable[[str], object]] = []
        body = ros2_program.body(words, self.context.workspace, lambda line: show[0](line))
        label = self.start_function(action, ["ros2", *words], body, respawn)
        show.append(lambda line: program.current().ask(lambda: self._line(label, line)))

    def start_function(
        self,
        action: Any,
        argv: Sequence[str],
        function: Callable[[], None],
        respawn: float | None = None,
    ) -> str:
        """Run a Python function as a program of the world; return the program's name in log lines.

        For the arguments see `start_node`; the first word of `argv` becomes the name in log lines.
        """

        def start(label: str) -> None:
            ended = partial(self._program_ended, label)
            started = Program(self.world, label, function, argv=argv, on_exit=ended)
            self._running[label] = partial(self._remove, label, started)
            self._report_start(label, argv, cwd=None)

        return self._start(action, Path(argv[0]).name, start, respawn)

    def _start(
        self, action: Any, name: str, start: Callable[[str], None], respawn: float | None
    ) -> str:
        """Start a program of `action` by `start(label)`, and return the label.

        The label is the program's name in log lines: `name` and a number. While the launch shuts
        down, `start` is not called.
        """
        self._count += 1
        # A launch inside this one may have a program of the same name and number.
        label = self.world.free_name(f"{name}-{self._count}")
        self._actions[label] = action
        # The end of one program may start another one.
        if not self._closing:
            if respawn is not None:
                most = getattr(action, "respawn_max_retries", -1)
                self._respawns[label] = (max(respawn, SOONEST), partial(start, label), most)
            start(label)
        return label

    async def _watch(self, label: str, command: SystemCommand) -> None:
        def on_start(process: asyncio.subprocess.Process) -> None:
            self._actions[label].process_details["pid"] = process.pid
            self._running[label] = partial(commands.interrupt, process)
            if self._closing:
                commands.interrupt(process)

        status, reason = 127, ""
        try:
            status = await self._commands.run(command, label, on_start, partial(self._line, label))
        except UsageError as error:
            reason = str(error)
        self._ended(label, status, reason)

    # Ends of programs

    def _remove(self, label: str, node: Program) -> None:
        if node.is_begun:
            self.world.remove(node)
        else:
            # A program that was started in this instant does not report its end.
            self._program_ended(label, node)

    def _program_ended(self, label: str, ended: Program) -> None:
        # The node's name is free, so that the program may be started again.
        self.world.remove(ended)
        reason = "" if ended.failure is None else error_sentence(ended.failure)
        if isinstance(ended.failure, SystemExit):
            reason = ""
        # A program that must end before it creates its node finds rclpy shut down.
        too_late = ended.interrupted and isinstance(ended.failure, NotInitializedException)
        interrupted = ended.status == 130 or too_late
        self._ended(label, 0 if interrupted else ended.status or 0, reason)

    def _ended(self, label: str, status: int, reason: str) -> None:
        action = self._actions[label]
        self._running.pop(label, None)
        stopped = self._closing and status in (-signal.SIGINT, -signal.SIGTERM, 130)
        if status == 0 or stopped:
            self._say("INFO", label, "process has finished cleanly")
        else:
            self.failed.append(label)
            told = f": {reason}" if reason else ""
            self._say("ERROR", label, f"process has died, exit status {status}{told}")
            for line in reason.splitlines():
                self._wrote(label, line, to_stdout=False)
        action.return_code = status
        event = ProcessExited(returncode=status, **self._event_arguments(label))
        self._guarded(lambda: self.emit(event))
        if not self._respawn(label):
            self._guarded(lambda: self.complete(action))
        self._look_round()

    def _respawn(self, label: str) -> bool:
        if label not in self._respawns or self._closing:
            return False
        delay, start, left = self._respawns[label]
        if left == 0:
            return False
        self._respawns[label] = (delay, start, left - 1)  # a negative number never becomes 0

        async def wait() -> None:
            await self.clock.sleep(seconds(delay), self.phase, self.rank)
            self._guarded(start)

        self._start_task(wait(), self._timers)
        return True

    def _guarded(self, work: Callable[[], object]) -> None:
        """Call a function; if it raises an exception, log the exception and end the launch."""
        try:
            work()
        except Exception as error:
            ours = isinstance(error, TftoolError)
            self._say("ERROR", "launch", str(error) if ours else error_sentence(error))
            self.failed.append("launch")
            self._end()

    def _look_round(self) -> None:
        runs = self._keep_alive or self._running or self._timers or self._watches
        if self._closing or not runs:
            self._end()

    def _end(self) -> None:
        if self._over is not None and not self._over.done():
            self._over.set_result(None)

    def _start_task(self, coroutine: Any, tasks: "set[asyncio.Task[None]]") -> None:
        task = asyncio.get_running_loop().create_task(coroutine)
        tasks.add(task)

        def ended(task: "asyncio.Task[None]") -> None:
            tasks.discard(task)
            self._look_round()

        task.add_done_callback(ended)

    def label_of(self, record: LogRecord) -> str:
        """Return the name, in the launch's log lines, of the program that wrote a log record."""
        if record.program:
            return record.program
        for one in self.world.nodes:
            if isinstance(one, Program) and record.node in (node.authority for node in one.nodes):
                return one.label
        return self.labels.get(record.node, "launch")
