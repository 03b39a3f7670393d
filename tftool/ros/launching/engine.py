"""Carries a launch description out: all its nodes in one process, on one loop."""

import asyncio
import shlex
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from difflib import get_close_matches
from pathlib import Path
from typing import Any, ClassVar

from tftool.errors import TftoolError, UsageError
from tftool.ros import executables, users
from tftool.ros.launching.actions import DeclareLaunchArgument, IncludeLaunchDescription
from tftool.ros.launching.context import LaunchContext
from tftool.ros.launching.description import LaunchDescription, load_file
from tftool.ros.launching.events import Event, ProcessExited, ProcessStarted, Shutdown
from tftool.ros.names import RosOptions
from tftool.ros.program import Program
from tftool.ros.workspace import Workspace
from tftool.runtime.clock import SimClock
from tftool.runtime.node import Node
from tftool.runtime.world import World
from tftool.stamps import seconds

Say = Callable[[str, str, str], object]
"""Is told level, who speaks ("launch", "listener-4") and a line."""


class Launch(Node):
    """What `ros2 launch` is: starts what a description says, and watches it.

    Attributes:
        failed: Labels of programs that ended with another exit status than 0.
        ended: Set once everything it started has ended.
        handlers: Who waits for events.
        labels: What each node of ours is called in log lines, by the node's name.
    """

    is_shown: ClassVar[bool] = False

    def __init__(
        self,
        world: World,
        path: Path,
        *,
        workspace: Workspace,
        arguments: Mapping[str, str] | None = None,
        say: Say = lambda level, who, text: None,
    ) -> None:
        """Read a launch file.

        Raises:
            InputError: If it cannot be read.
            UsageError: If an argument is passed that it does not declare.
        """
        self.description = load_file(path)
        self.context = LaunchContext(workspace, self)
        self.context.locals = _locals(path)
        _refuse_unknown(path, arguments or {}, declared(self.description, self.context))
        self.context.launch_configurations.update(arguments or {})
        self.failed: list[str] = []
        self.ended = asyncio.Event()
        self.handlers: list[Any] = []
        self.labels: dict[str, str] = {}
        self._path = path
        self._say = say
        self._running: dict[str, Program | asyncio.subprocess.Process | Node] = {}
        self._timers: set[asyncio.Task[None]] = set()
        self._watches: set[asyncio.Task[None]] = set()
        self._count = 0
        self._closing = False
        self._over: asyncio.Future[None] | None = None
        super().__init__(world, "launch")

    async def run(self) -> None:
        """Launch, and stay until everything has ended or a Shutdown is emitted.

        Raises:
            UsageError: If something cannot be started as the description says.
        """
        self._over = asyncio.get_running_loop().create_future()
        try:
            self.do([self.description])
            self._look_round()
            await self._over
        finally:
            for timer in self._timers:
                timer.cancel()
            for running in list(self._running.values()):
                if isinstance(running, Program):
                    self.world.remove(running)
                elif isinstance(running, asyncio.subprocess.Process):
                    _interrupt(running)
            await asyncio.gather(*self._timers, *self._watches, return_exceptions=True)
        while any(isinstance(one, Program) for one in self._running.values()):
            self._over = asyncio.get_running_loop().create_future()
            await self._over
        self.ended.set()

    # What actions ask for

    def do(self, entities: Any) -> None:
        """Carry out entities, and what they give, one after the other."""
        for entity in entities if isinstance(entities, Iterable) else [entities]:
            following = entity.visit(self.context)
            if following:
                self.do(following)

    def emit(self, event: Event) -> None:
        """Tell an event to whoever waits for it."""
        for handler in list(self.handlers):
            if handler.matches(event):
                if handler.handle_once:
                    self.handlers.remove(handler)
                self.context.event = event
                self.do(handler.handle(event, self.context) or ())
        if isinstance(event, Shutdown) and not self._closing:
            self._closing = True
            self._say("INFO", "launch", f"shutting down: {event.reason}")
            self._end()

    def info(self, text: str) -> None:
        """Say something."""
        self._say("INFO", "launch", text)

    def later(self, period: float, actions: Sequence[Any]) -> None:
        """Carry actions out after so many seconds, in the scope of now."""
        kept = self.context.kept()

        async def wait() -> None:
            await self.clock.sleep(seconds(period), self.phase, self.rank)
            with self.context.back_to(kept):
                self._guarded(lambda: self.do(actions))

        self._start_task(wait(), self._timers)

    def start_node(
        self,
        action: Any,
        package: str,
        executable: str,
        arguments: Sequence[str],
        options: RosOptions,
        exec_name: str | None,
    ) -> None:
        """Start a package's executable."""
        label = self._label(exec_name or executable)
        argv = [executable, *arguments, "--ros-args"]
        if options.name:
            argv += ["-r", f"__node:={options.name}"]
        if options.namespace:
            argv += ["-r", f"__ns:=/{options.namespace.strip('/')}"]
        argv += [
            word for _, name, value in options.parameters for word in ("-p", f"{name}:={value}")
        ]
        node = executables.start(
            self.world,
            self.context.workspace,
            package,
            executable,
            label=label,
            argv=argv,
            arguments=arguments,
            options=options,
            on_exit=lambda program: self._program_ended(action, label, program),
        )
        if not isinstance(node, Program):
            self.labels[node.name] = label
        self._running[label] = node
        self._say("INFO", label, "process started")
        self.emit(ProcessStarted(action=action, process_name=label))

    def start_process(
        self,
        action: Any,
        name: str,
        words: Sequence[str],
        environment: Mapping[str, str],
        cwd: str | None,
        shell: bool,
    ) -> None:
        """Start a command of the system; on simulated time it takes no time."""
        label = self._label(name)
        words = list(words) if not shell else ["/bin/sh", "-c", " ".join(words)]
        self._say("INFO", label, f"process started: {shlex.join(words)}")
        self.emit(ProcessStarted(action=action, process_name=label))
        if isinstance(self.clock, SimClock):
            try:
                done = subprocess.run(
                    words,
                    env=dict(environment),
                    cwd=cwd,
                    capture_output=True,
                    text=True,
                    check=False,
                )
            except OSError as error:
                raise UsageError(f"cannot run '{words[0]}': {error.strerror}") from None
            for line in done.stdout.splitlines():
                self._say("", label, line)
            self._ended(action, label, done.returncode, "")
            return
        self._start_task(self._watch(action, label, words, environment, cwd), self._watches)

    async def _watch(
        self,
        action: Any,
        label: str,
        words: Sequence[str],
        environment: Mapping[str, str],
        cwd: str | None,
    ) -> None:
        try:
            process = await asyncio.create_subprocess_exec(
                *words,
                env=dict(environment),
                cwd=cwd,
                stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.STDOUT,
            )
        except OSError as error:
            self._ended(action, label, 127, f"cannot run '{words[0]}': {error.strerror}")
            return
        self._running[label] = process
        if self._closing:
            _interrupt(process)
        if process.stdout is not None:
            async for line in process.stdout:
                self._say("", label, line.decode(errors="replace").rstrip("\n"))
        status = await process.wait()
        self._ended(action, label, status, "")

    # What ends

    def _program_ended(self, action: Any, label: str, program: Program) -> None:
        reason = "" if program.failure is None else users.sentence_of(program.failure)
        if isinstance(program.failure, SystemExit):
            reason = ""
        interrupted = program.status == 130
        self._ended(action, label, 0 if interrupted else program.status or 0, reason)

    def _ended(self, action: Any, label: str, status: int, reason: str) -> None:
        self._running.pop(label, None)
        stopped = self._closing and status in (-signal.SIGINT, -signal.SIGTERM)
        if status == 0 or stopped:
            self._say("INFO", label, "process has finished cleanly")
        else:
            self.failed.append(label)
            told = f": {reason}" if reason else ""
            self._say("ERROR", label, f"process has died, exit status {status}{told}")
        event = ProcessExited(action=action, process_name=label, returncode=status)
        self._guarded(lambda: self.emit(event))
        self._look_round()

    def _guarded(self, work: Callable[[], object]) -> None:
        """Do something later than the launch began: what is wrong ends the launch."""
        try:
            work()
        except TftoolError as error:
            self._say("ERROR", "launch", str(error))
            self.failed.append("launch")
            self._end()

    def _look_round(self) -> None:
        if self._closing or not (self._running or self._timers or self._watches):
            self._end()

    def _end(self) -> None:
        if self._over is not None and not self._over.done():
            self._over.set_result(None)

    def _start_task(self, coroutine: Any, kept: "set[asyncio.Task[None]]") -> None:
        task = asyncio.get_running_loop().create_task(coroutine)
        kept.add(task)

        def ended(task: "asyncio.Task[None]") -> None:
            kept.discard(task)
            self._look_round()

        task.add_done_callback(ended)

    def _label(self, name: str) -> str:
        self._count += 1
        return f"{name}-{self._count}"

    def label_of(self, name: str) -> str:
        """Which process a line of the log comes from."""
        for node in self.world.nodes:
            if (
                name == node.name
                or name.startswith(f"{node.name}.")
                or (name.replace(".", "/") == node.name)
            ):
                program = getattr(node, "program", None)
                if program is not None:
                    return str(program.name)
                return self.labels.get(node.name, node.name)
        return self.labels.get(name, "launch")


def _interrupt(process: asyncio.subprocess.Process) -> None:
    """End a process as Ctrl-C would."""
    if process.returncode is None:
        with suppress(ProcessLookupError):
            process.send_signal(signal.SIGINT if sys.platform != "win32" else signal.SIGTERM)


def _locals(path: Path) -> dict[str, str]:
    return {
        "current_launch_file_path": str(path),
        "current_launch_file_directory": str(path.parent),
    }


def declared(description: LaunchDescription, context: LaunchContext) -> list[DeclareLaunchArgument]:
    """The arguments a description declares, those of files it includes too."""
    found: dict[str, DeclareLaunchArgument] = {}

    def look(entities: Iterable[Any]) -> None:
        for entity in entities:
            if isinstance(entity, DeclareLaunchArgument):
                found.setdefault(entity.name, entity)
                if entity.default_value is not None:
                    context.launch_configurations.setdefault(entity.name, "")
            elif isinstance(entity, IncludeLaunchDescription):
                passed = {str(name) for name, _ in entity.launch_arguments}
                before = set(found)
                try:
                    inner, _ = entity.source.load(context)
                except TftoolError:
                    continue  # it is said when the file is really included
                look(inner.entities)
                for name in set(found) - before & passed:
                    del found[name]
            elif isinstance(entity, LaunchDescription):
                look(entity.entities)
            else:
                look(entity.describe_sub_entities())

    kept = dict(context.launch_configurations)
    look(description.entities)
    context.launch_configurations = kept
    return list(found.values())


def _refuse_unknown(
    path: Path, given: Mapping[str, str], known: Sequence[DeclareLaunchArgument]
) -> None:
    names = [one.name for one in known]
    for name in given:
        if name not in names:
            near = get_close_matches(name, names, n=1)
            if near:
                raise UsageError(
                    f"{path.name} declares no argument '{name}'; did you mean '{near[0]}:=…'?"
                )
            there = ", ".join(names) if names else "none"
            raise UsageError(f"{path.name} declares no argument '{name}' (it declares {there})")


def shown_arguments(arguments: Sequence[DeclareLaunchArgument]) -> str:
    """What --show-args prints, laid out as `ros2 launch` does."""
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    if not arguments:
        lines += ["", "  No arguments."]
    for one in arguments:
        choices = "" if one.choices is None else f" Valid choices are: {one.choices}"
        default = one.shown_default()
        lines += [
            "",
            f"    '{one.name}':",
            f"        {one.description}.{choices}" if choices else f"        {one.description}",
        ]
        if default is not None:
            lines.append(f"        (default: {default})")
    return "\n".join(lines)
