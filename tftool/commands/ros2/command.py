"""Implementation of `tftool ros2`: commands of ROS 2's command line, for tftool's sessions."""

import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import typer
import yaml

from tftool.base.errors import NodeFailed, TftoolError, UsageError
from tftool.commands.ros2 import Ros2Options
from tftool.commands.shared.connection import NO_SESSION, Connection
from tftool.commands.shared.hosting import open_empty_session, open_session
from tftool.commands.shared.notices import tell_record
from tftool.ros import running
from tftool.ros.host import user_code
from tftool.ros.host.importing import ros_free
from tftool.ros.host.program import Program
from tftool.ros.host.workspace import Workspace, use_workspace
from tftool.ros.ros2 import ros2_program

_ELSEWHERE = {
    "run": "run",
    "launch": "launch",
    "bag info": "info",
    "bag play": "play",
    "bag record": "record",
    "bag convert": "edit",
    "doctor": "doctor",
    "wtf": "doctor",
    "pkg create": "new",
}
"""Commands of ROS 2 that are separate commands of tftool, with the names there."""


class _JsonLines:
    """Printer that converts each YAML document of a command to one line of JSON."""

    def __init__(self, words: Sequence[str]) -> None:
        self._lines: list[str] = []
        # These commands run until stopped, and print lines that are not YAML.
        self._is_endless = words[1:2] in (["hz"], ["bw"], ["delay"])

    def __call__(self, line: str) -> None:
        """Add a printed line to the document; the line `---` ends the document."""
        if line != "---":
            self._lines.append(line)
        if line == "---" or self._is_endless:
            self.finish()

    def finish(self) -> None:
        """Print the last document, if the command did not end the document by `---`."""
        if not self._lines:
            return
        try:
            found = yaml.safe_load("\n".join(self._lines))
        except yaml.YAMLError:
            found = None
        # Lists of names are not printed as YAML lists: each line is an element.
        if not isinstance(found, dict | list | int | float):
            found = self._lines
        typer.echo(json.dumps(found, default=str))
        self._lines = []


def run(connection: Connection, options: Ros2Options) -> int:
    """Run `tftool ros2`: run a command of ROS 2's command line, and return its exit status."""
    words = options.words
    for length in (2, 1):
        asked = " ".join(words[:length])
        if asked in _ELSEWHERE:
            raise UsageError(
                f"'tftool ros2' has no command '{asked}': use 'tftool {_ELSEWHERE[asked]}'."
            )
    if words[0] == "test":
        return _run_launch_tests(connection, words[1:])
    workspace = Workspace(Path.cwd())
    lines = _JsonLines(words)
    if options.as_json and words[:2] == ["topic", "echo"]:
        words = [*words, "--full-length"]
    body = ros2_program.body(words, workspace, lines if options.as_json else typer.echo)
    if words[0] in ("interface", "pkg"):
        body()
        lines.finish()
        return 0
    session = open_session(connection, options.place, because=NO_SESSION)
    world = session.world
    world.log.listen(
        lambda record: tell_record(record) if record.level in ("WARN", "ERROR") else None, "console"
    )
    ending = running.Ending()

    async def work() -> None:
        Program(world, world.free_name("ros2"), body, argv=words, on_exit=ending)
        await running.until(world, ending.over, options.run_for)

    try:
        session.run(work())
    finally:
        lines.finish()
    try:
        return running.status_of(ending.program)
    except NodeFailed as failed:
        # Not a failed program of the user, but a name that does not exist.
        if isinstance(failed.__cause__, UsageError):
            raise TftoolError(str(failed.__cause__)) from failed
        raise


def _run_launch_tests(connection: Connection, words: list[str]) -> int:
    """Run `tftool ros2 test FILE [name:=value …]` in a new session, in real time.

    Raises:
        UsageError: If no file is named.
    """
    if not words or ":=" in words[0] or words[0].startswith("-"):
        raise UsageError("'ros2 test' needs a file of launch tests, then name:=value arguments")
    # Imported here: only launch tests need launch files and the test runner.
    from tftool.ros.launch.arguments import parse_arguments
    from tftool.ros.launch_testing.runner import run_tests

    path, arguments = Path(words[0]), words[1:]
    user_code.compile_file(path)
    parse_arguments(arguments)
    workspace = Workspace(Path.cwd(), path)
    with ros_free():
        use_workspace(workspace)
        session = open_empty_session(connection)
        world = session.world
        ending = running.Ending()

        async def work() -> None:
            body = partial(run_tests, path, arguments)
            # Tests read the name of ROS's command from sys.argv.
            argv = ["launch_test", *words]
            Program(world, world.free_name("launch_test"), body, argv=argv, on_exit=ending)
            await ending.over.wait()

        session.run(work())
        return running.status_of(ending.program)
