"""Actions of ROS's launch that start processes."""

import itertools
import re
import shlex
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.ros.host import names
from tftool.ros.host.names import RosOptions
from tftool.ros.launch.commands import SystemCommand
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action
from tftool.ros.launch.events import OnProcessExit
from tftool.ros.launch.substitutions import ROS2, is_true, perform

SHELLS = ("sh", "bash", "dash", "zsh")

_PYTHON_FLAG = re.compile(r"-[bBdEiIOPqsSuv]+")
"""Flags of the Python interpreter that have no value."""

_IMPORT = re.compile(
    r"^\s*(?:from|import)\s+(?P<module>[\w.]+)(?:\s+import\s+(?P<name>\w+))?", re.M
)

LONGEST = 1e9
"""Longest allowed delay in seconds, about thirty years."""


@dataclass(frozen=True, slots=True)
class Executable:
    """Program of a package, or file, for an action of a launch file to start.

    Attributes:
        package: Name of the package; None for a file.
        name: Name of the program in the package, or path of the file.
        arguments: The program's arguments, without the part after `--ros-args`.
        options: Options after `--ros-args`.
        label: Name of the program in log lines, to which a number is added.
        argv: Command line; None for the command line that launch_ros would use for a node.
    """

    package: str | None
    name: str
    arguments: Sequence[str]
    options: RosOptions
    label: str
    argv: Sequence[str] | None = None

    def launched_argv(self) -> list[str]:
        """Return the command line that launch_ros would use for this node."""
        options = self.options
        argv = [self.name, *self.arguments, "--ros-args"]
        if options.name:
            argv += ["-r", f"__node:={options.name}"]
        if options.namespace:
            argv += ["-r", f"__ns:=/{options.namespace.strip('/')}"]
        return argv + [
            word for _, name, value in options.parameters for word in ("-p", f"{name}:={value}")
        ]


class Startable(Action):
    """Base class of actions that start a process and can restart the process after its end.

    Attributes:
        process_details: Keyword arguments for events about the process, such as its name and
            command line; None before the process is started.
        return_code: Exit status; None before the process has ended.
        output_lines: Tuples (whether from standard output, line) for the lines of the process's
            output; empty unless `cached_output` is set.
    """

    takes_time: ClassVar[bool] = True

    def __init__(
        self,
        *,
        on_exit: Any = None,
        respawn: Any = False,
        respawn_delay: Any = None,
        respawn_max_retries: int = -1,
        prefix: Any = None,
        output: Any = "log",
        **kwargs: Any,
    ) -> None:
        # These arguments concern the end and the output of processes.
        self.emulate_tty = kwargs.pop("emulate_tty", False)
        self.cached_output = kwargs.pop("cached_output", False)
        for name in ("sigterm_timeout", "sigkill_timeout", "log_cmd", "output_format"):
            kwargs.pop(name, None)
        super().__init__(**kwargs)
        self.process_details: dict[str, Any] | None = None
        self.return_code: int | None = None
        self.output_lines: list[tuple[bool, str]] = []
        self.on_exit, self.prefix, self.output = on_exit, prefix, output
        self.respawn, self.respawn_delay = respawn, respawn_delay
        self.respawn_max_retries = respawn_max_retries

    def get_stdout(self) -> str:
        """Return the standard output so far; "" unless `cached_output` is set."""
        return "".join(line for is_stdout, line in self.output_lines if is_stdout)

    def get_stderr(self) -> str:
        """Return the standard error so far; "" unless `cached_output` is set."""
        return "".join(line for is_stdout, line in self.output_lines if not is_stdout)

    def get_output(self) -> str:
        """Return standard output and standard error so far; "" unless `cached_output` is set."""
        return "".join(line for _, line in self.output_lines)

    def handle_exit(self, context: LaunchContext) -> None:
        """Register a handler that executes the actions `on_exit` each time the process ends."""
        if self.on_exit is not None:
            once = self.respawn_after(context) is None
            context.launch.handlers.append(
                OnProcessExit(target_action=self, on_exit=self.on_exit, handle_once=once)
            )

    def respawn_after(self, context: LaunchContext) -> float | None:
        """Return the seconds between the end and a new start of the process; None for no new start.

        Raises:
            UsageError: If the delay in the launch file is not a number.
        """
        if not is_true(perform(context, self.respawn)):
            return None
        return seconds_of(context, self.respawn_delay or 0.0, "a respawn_delay")

    def warn_of_unused(self, context: LaunchContext, *names: str) -> None:
        """Log a warning if the launch file sets arguments that tftool ignores.

        The ignored argument `prefix` is always checked, together with `names`.
        """
        given = [name for name in ("prefix", *names) if getattr(self, name)]
        if given:
            verb = "has" if len(given) == 1 else "have"
            what = f"{' and '.join(given)} of a {type(self).__name__}"
            context.launch.warn(f"{what} {verb} no effect here")


def seconds_of(context: LaunchContext, value: Any, duration_name: str) -> float:
    """Return the duration in a launch file, in seconds.

    The value is a number, a text or substitutions; `duration_name` is for the error text.

    Raises:
        UsageError: If the value is not a number of seconds.
    """
    text = perform(context, value)
    try:
        found = float(text)
    except ValueError:
        found = -1.0
    if not 0.0 <= found <= LONGEST:
        raise UsageError(f"{duration_name} must be seconds from 0 to {LONGEST:g}, not '{text}'")
    return found


class ExecuteProcess(Startable):
    """Action that runs a system command."""

    def __init__(
        self,
        *,
        cmd: Iterable[Any],
        name: Any = None,
        cwd: Any = None,
        env: Mapping[Any, Any] | None = None,
        additional_env: Mapping[Any, Any] | None = None,
        shell: Any = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.cmd = list(cmd)
        self.process_name = name
        self.cwd, self.env, self.additional_env = cwd, env, additional_env
        self.shell = shell

    def execute(self, context: LaunchContext) -> Any:
        """Start the command as a process.

        A Python program that uses rclpy does not get a process: it runs inside tftool.
        """
        words = [perform(context, word) for word in self.cmd]
        if not words or not words[0].strip():
            raise UsageError("ExecuteProcess needs a command: pass cmd=[…]")
        environment = dict(context.environment)
        if self.env is not None:
            environment = _environment(context, self.env)
        environment.update(_environment(context, self.additional_env or {}))
        cwd = None if self.cwd is None else perform(context, self.cwd)
        if self.process_name is None:
            name = Path(words[0].split()[0]).name
        else:
            name = perform(context, self.process_name)
        self.handle_exit(context)
        self.warn_of_unused(context)
        shell = is_true(perform(context, self.shell))
        if (ros2 := _ros2_words(words, shell)) is not None:
            return self._execute_ros2(context, ros2)
        for package in context.workspace.packages.values():
            # Only tftool can run this program: a separate process would lack rclpy.
            if not shell and (found := package.executable_at(Path(words[0]))) is not None:
                return self._execute_ros2(context, ["run", package.name, found, *words[1:]])
        if (node := _rclpy_program(words, shell, cwd, context)) is not None:
            # A separate Python process would find no rclpy.
            file, argv = node
            options, arguments = names.parse(argv[1:])
            started = Executable(None, str(file), arguments, options, file.name, argv)
            context.launch.start_node(self, started, self.respawn_after(context))
            return None
        if shell:
            words = ["/bin/sh", "-c", " ".join(words)]
        # As in ROS 2, the launch configuration of that name overrides the action's argument.
        wanted = context.launch_configurations.get("emulate_tty", self.emulate_tty)
        command = SystemCommand(words, environment, cwd, is_true(perform(context, wanted)))
        context.launch.start_process(self, name, command, self.respawn_after(context))
        return None

    def _execute_ros2(self, context: LaunchContext, words: Sequence[str]) -> Any:
        """Run `ros2 WORDS` inside tftool: start a node, start a launch, or run another command."""
        if words[:1] == ["run"] and len(words) > 2:
            options, arguments = names.parse(words[3:])
            options.namespace = options.namespace or context.launch_configurations.get(
                "ros_namespace"
            )
            started = Executable(words[1], words[2], arguments, options, words[2], words[2:])
            context.launch.start_node(self, started, self.respawn_after(context))
            return None
        if words[:1] == ["launch"] and len(words) > 1:
            # Imported here, because the service needs this module.
            from tftool.ros.launch.service import run_launch_file

            body = partial(run_launch_file, context.workspace, words[1:])
            context.launch.start_function(self, ["ros2", *words], body, self.respawn_after(context))
            return None
        context.launch.start_ros2(self, words, self.respawn_after(context))
        return None


def _plain_words(words: Sequence[str], shell: bool) -> list[str]:
    """Split a command line into words as a shell does; return [] if only a shell can execute it.

    If `shell` is true, a shell would execute the words, joined by spaces.
    """
    if not shell and len(words) == 3 and words[1] == "-c" and Path(words[0]).name in SHELLS:
        words, shell = words[2:], True
    if shell:
        try:
            lexer = shlex.shlex(" ".join(words), posix=True, punctuation_chars=True)
            lexer.whitespace_split = True
            words = list(lexer)
        except ValueError:
            return []
        if any(word and not word.strip("();<>|&") for word in words):
            return []
    return list(words)


def _ros2_words(words: Sequence[str], shell: bool) -> list[str] | None:
    """Return the words after `ros2` in a command line; None for any other command."""
    words = _plain_words(words, shell)
    return words[1:] if words and Path(words[0]).name == ROS2 else None


def is_python(word: str) -> bool:
    """Return whether `word`, the first word of a command line, is a Python interpreter."""
    return re.fullmatch(r"python(3(\.\d+)?)?", Path(word).name) is not None


def _rclpy_program(
    words: Sequence[str], shell: bool, cwd: str | None, context: LaunchContext
) -> tuple[Path, list[str]] | None:
    """Return the file and arguments of a Python command that uses rclpy; None for other commands.

    Such a command is `python3 FILE …` or `python3 -m MODULE …`, with or without Python's own flags.
    """
    words = _plain_words(words, shell)
    if not words or not is_python(words[0]):
        return None
    words = list(itertools.dropwhile(_PYTHON_FLAG.fullmatch, words[1:]))
    folder = Path(cwd or "")
    roots = [folder, *map(Path, context.workspace.module_folders())]
    if len(words) > 1 and words[0] == "-m":
        file = next(_module_files(words[1], roots), None)
        words = words[1:]
    else:
        file = folder / words[0] if words and (folder / words[0]).is_file() else None
    if file is None or not _uses_rclpy(file, [file.parent, *roots], set()):
        return None
    return file, list(words)


def _module_files(module: str, roots: Iterable[Path]) -> Iterator[Path]:
    """Yield the existing source files of a module, searched in the folders `roots`."""
    for root in roots:
        place = root.joinpath(*module.split("."))
        for file in (place.with_name(f"{place.name}.py"), place / "__init__.py"):
            if file.is_file():
                yield file


def _uses_rclpy(file: Path, roots: Sequence[Path], seen: set[Path]) -> bool:
    """Return whether a file, or any file below `roots` that the file imports, mentions rclpy."""
    if file in seen:
        return False
    seen.add(file)
    text = file.read_text(encoding="utf-8", errors="replace")
    if "rclpy" in text:
        return True
    modules = {found["module"] for found in _IMPORT.finditer(text)}
    modules |= {f"{found['module']}.{found['name']}" for found in _IMPORT.finditer(text)}
    return any(
        _uses_rclpy(other, roots, seen)
        for module in modules
        for other in _module_files(module, roots)
    )


def _environment(context: LaunchContext, variables: Any) -> dict[str, str]:
    """Return the environment variables in a mapping or in pairs, with substitutions evaluated."""
    pairs = variables.items() if isinstance(variables, Mapping) else variables
    return {perform(context, key): perform(context, value) for key, value in pairs}
