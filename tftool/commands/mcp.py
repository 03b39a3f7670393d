"""Command `tftool mcp`: MCP server through which AI agents query the recordings of a folder."""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from functools import wraps
from itertools import islice
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError, TftoolError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import argument
from tftool.opener import named
from tftool.recordings.find import Kind


class McpOptions(Command, shares=False):
    """Answer an AI agent's questions about recordings (MCP).

    The server communicates over stdin and stdout. Tools: info, tree, echo, explain, doctor, plot,
    each for a file below ROOT. Nothing is written, no session is joined, no scenario is played, no
    xacro is expanded, and no symbolic link out of ROOT is followed. An answer is the JSON output of
    the command, cut to 4,000 characters.

    tftool mcp ~/bags
    """

    root: Path = argument(
        "Folder with the files that the agent may ask about.", default=..., metavar="ROOT"
    )


MOST_CHARACTERS: Final = 4000
"""Most characters of a response, because an agent pays for reading all of it."""

TIMEOUT: Final = 120.0
"""Longest time in seconds that a command may take."""

MOST_POINTS = 20
"""Most points of each curve of a plot, to keep the response short."""

MOST_ENTRIES: Final = 10_000
"""Most entries of a folder that are examined."""

SUFFIXES: Final = (".mcap", ".db3", ".bag", ".urdf", ".launch.py", ".launch.xml", ".launch.yaml")

INSTRUCTIONS: Final = """Coordinate frames (TF2) of robots, in recordings and robot descriptions.
Call info first, without a source for the list of files. Frames: the transform of source_frame in
target_frame. Moments: seconds since the recording began, or a stamp in seconds. A long list ends
with how many are missing: `part` names one key of an answer, `skip` leaves out its first items."""


def run(options: McpOptions) -> ExitStatus:
    """Run `tftool mcp`: serve the tools over stdin and stdout until stdin is closed."""
    if not options.root.is_dir():
        raise InputError(f"'{options.root}' is not a folder: name the folder with the recordings.")
    try:
        # An optional package of 40 MB, which only this command needs.
        from mcp.server import MCPServer
        from mcp.server.mcpserver.exceptions import ToolError
        from mcp.types import ToolAnnotations
    except ImportError as missing:
        raise UsageError("'mcp' needs a package: pip install 'tftool-tf2[mcp]'") from missing

    def answered(question: Callable[..., str]) -> Callable[..., str]:
        """Wrap a tool so that tftool's errors become the protocol's error responses."""

        @wraps(question)
        def answer(**words: Any) -> str:
            try:
                return question(**words)
            except TftoolError as error:
                raise ToolError(str(error)) from error

        return answer

    server = MCPServer("tftool", instructions=INSTRUCTIONS, version=_version(), log_level="ERROR")
    with tempfile.TemporaryDirectory(prefix="tf") as sessions:
        questions = Questions(options.root.resolve(), sessions)
        for name in ("info", "tree", "echo", "explain", "doctor", "plot"):
            look = ToolAnnotations(read_only_hint=True, open_world_hint=False)
            server.add_tool(
                answered(getattr(questions, name)), annotations=look, structured_output=False
            )
        server.run("stdio")
    return ExitStatus.DONE


class Questions:
    """Tools for the files below one folder: a method for each tool, whose docstring is the help."""

    def __init__(self, root: Path, sessions: str) -> None:
        """Serve files to an agent.

        Args:
            root: Folder of the files.
            sessions: Empty folder used as the session folder, so that no running session is found.
        """
        self._root = root
        self._environment = {**os.environ, "TFTOOL_SESSION_DIR": sessions, "NO_COLOR": "1"}

    def info(self, source: str = "", part: str = "", skip: int = 0) -> str:
        """Return a file's contents: topics, edges with rates and publishers, damage, URDF joints.

        Args:
            source: A recording or robot description below the root; empty to list the files there.
            part: One key of the answer, such as "topics" or "edges"; the whole answer if empty.
            skip: Number of items to leave out at the beginning of the list in `part`.
        """
        if source:
            return self._run("info", source, part=part, skip=skip)
        names = [path.relative_to(self._root).as_posix() for path in self._files()]
        return fitted(names[skip:])

    def tree(self, source: str, at: str = "", part: str = "", skip: int = 0) -> str:
        """Return the tree of frames: each frame's parent, with rates, ages and transforms.

        Args:
            source: A recording, robot description or launch file below the root.
            at: The moment; the end if empty.
            part: One key of the answer, such as "roots" or "frames"; the whole answer if empty.
            skip: Number of items to leave out at the beginning of the list in `part`.
        """
        return self._run("tree", source, *_option("at", at), part=part, skip=skip)

    def echo(self, target_frame: str, source_frame: str, source: str, at: str = "") -> str:
        """Return source_frame's pose in target_frame: translation, quaternion, roll, pitch, yaw.

        Args:
            target_frame: The frame in which the pose is given.
            source_frame: The frame whose pose is returned.
            source: A recording, robot description or launch file below the root.
            at: The moment; the newest transform if empty.
        """
        when = _option("at", at) or ["--once"]
        return self._run("echo", source, *when, frames=(target_frame, source_frame))

    def explain(self, target_frame: str, source_frame: str, source: str, at: str = "") -> str:
        """Return why a lookup succeeds or fails, frame by frame, and a remedy for a failed lookup.

        Args:
            target_frame: The target frame of the lookup.
            source_frame: The source frame of the lookup.
            source: A recording, robot description or launch file below the root.
            at: The moment; the end if empty.
        """
        frames = (target_frame, source_frame)
        return self._run("explain", source, *_option("at", at), frames=frames)

    def doctor(
        self, source: str, check: str = "", urdf: str = "", part: str = "", skip: int = 0
    ) -> str:
        """Return what is wrong with the frames of a recording: cause, evidence, consequence, fix.

        Args:
            source: A recording below the root.
            check: Ids of the checks to run, separated by commas: "split-tree,gap"; all if empty.
            urdf: A robot description below the root to compare with.
            part: One key of the answer, such as "findings" or "summary"; the whole answer if empty.
            skip: Number of items to leave out at the beginning of the list in `part`.
        """
        options = _option("select", check)
        if urdf:
            options.append(f"--urdf={self._file(urdf)}")
        return self._run("doctor", source, *options, part=part, skip=skip)

    def plot(
        self,
        target_frame: str,
        source_frame: str,
        source: str,
        begin: str = "",
        end: str = "",
        only: str = "",
    ) -> str:
        """Return position, rotation, distance and speed of source_frame in target_frame over time.

        Each curve has its minimum, maximum and last value, and some of its points.

        Args:
            target_frame: The frame in which the motion is given.
            source_frame: The frame that moves.
            source: A recording below the root.
            begin: First moment of the plot; the start if empty.
            end: Last moment of the plot; the end if empty.
            only: Quantities to draw, separated by commas: x,y,z,roll,pitch,yaw,distance,speed.
        """
        options = [*_option("from", begin), *_option("to", end), *_option("only", only)]
        frames = (target_frame, source_frame)
        return self._run("plot", source, *options, frames=frames)

    def _run(
        self,
        command: str,
        source: str,
        *options: str,
        frames: tuple[str, ...] = (),
        part: str = "",
        skip: int = 0,
    ) -> str:
        """Run a command on a file; return the output within the size limits.

        Raises:
            InputError: If reading the file is not permitted, or the command fails.
        """
        file = self._file(source)
        cached = [] if file.endswith(".urdf") or command == "doctor" else ["--no-cache"]
        # -P: otherwise Python would import modules from the current folder.
        words = [sys.executable, "-P", "-m", "tftool", command, "--json", *cached, *options]
        try:
            done = subprocess.run(
                [*words, "--", *frames, file],
                cwd=self._root,
                env=self._environment,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                encoding="utf-8",
                errors="replace",
                timeout=TIMEOUT,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise InputError(
                f"'{command}' took more than {TIMEOUT:g} s and was stopped: ask for a shorter "
                "span or a smaller file."
            ) from None
        if not done.stdout.strip():
            told = {"refused": done.stderr.strip()}
            if done.returncode == ExitStatus.NO_TRANSFORM:
                return fitted(told)
            raise InputError(fitted(told["refused"]))
        answer = json.loads(done.stdout)
        if command == "plot":
            for curve in (one for panel in answer["panels"] for one in panel["curves"]):
                step = -(-len(curve["values"]) // MOST_POINTS) or 1
                curve["times_s"] = [round(one, 3) for one in curve["times_s"][::step]]
                curve["values"] = curve["values"][::step]
        if part:
            if not isinstance(answer, dict) or part not in answer:
                keys = ", ".join(answer) if isinstance(answer, dict) else "none"
                raise UsageError(f"The answer has no part '{part}'; its parts are: {keys}.")
            answer = answer[part]
        return fitted(answer[skip:] if isinstance(answer, list) else answer)

    def _file(self, source: str) -> str:
        """Check that a file may be read; return the path below the root with a leading "./".

        With the leading "./", a file name such as "--help" is not parsed as an option.

        Raises:
            InputError: If `source`, or a file read with it, is outside the root; or if `source` is
                missing, is xacro or is a scenario.
        """
        try:
            path = (self._root / source).resolve(strict=True)
        except (OSError, ValueError, RuntimeError) as error:
            raise InputError(
                f"'{source}' does not exist in the folder that the server was started with."
            ) from error
        if not self._stays_inside(path):
            raise InputError(
                f"'{source}' is outside of the folder, or a symbolic link that leads out of the "
                "folder: the server reads only files in the folder that it was started with."
            )
        word = f"./{path.relative_to(self._root)}"
        if path.suffix == ".xacro" or source.endswith(".xacro"):
            raise InputError(
                f"'{source}' is xacro, which may run code: first expand it to a URDF file."
            )
        if named(str(path)).kind is Kind.SCENARIO:
            raise InputError(
                f"'{source}' is a scenario, but 'tftool mcp' reads only recordings and "
                "descriptions."
            )
        return word

    def _stays_inside(self, path: Path) -> bool:
        """Return whether a file, and all further files that a command reads, are below the root."""
        places = (path, *_read_with(path.resolve()))
        return all(one.resolve().is_relative_to(self._root) for one in places)

    def _files(self) -> Iterator[Path]:
        """Yield the files and rosbag2 folders below the root that a tool can read."""
        for path in islice(_below(self._root), MOST_ENTRIES):
            is_bag = path.is_dir() and (path / "metadata.yaml").exists()
            if (is_bag or path.name.endswith(SUFFIXES)) and self._stays_inside(path):
                yield path


def _below(folder: Path) -> Iterator[Path]:
    """Yield every entry below a folder in alphabetical order; links to folders are not followed."""
    for entry in sorted(folder.iterdir()):
        yield entry
        if entry.is_dir() and not entry.is_symlink():
            yield from _below(entry)


def _read_with(path: Path) -> list[Path]:
    """Return further files that a command reads with `path`.

    For a folder, these are the entries of the folder; for a file, the settings files beside the
    file.

    Raises:
        InputError: If a folder has more than `MOST_ENTRIES` entries.
    """
    if not path.is_dir():
        from tftool.scenario.doctor_expectations import ENDING

        return [path.with_name(f"{name}{ENDING}") for name in (path.name, path.stem)]
    found = list(islice(_below(path), MOST_ENTRIES + 1))
    if len(found) > MOST_ENTRIES:
        raise InputError(f"'{path.name}' has more than {MOST_ENTRIES} entries: name one file.")
    return found


def _option(name: str, value: str) -> list[str]:
    return [f"--{name}={value}"] if value else []


def _version() -> str:
    # Subpackages do not import the package itself, so its version is read from `sys.modules`.
    found: str = sys.modules["tftool"].__version__
    return found


# Responses within the size limit


def fitted(answer: Any, most: int = MOST_CHARACTERS) -> str:
    """Convert a command's output to JSON of at most `most` characters; count the omitted items.

    Deeply nested lists are shortened first: the list of findings matters more than the evidence of
    one finding.
    """
    sizes = [(outer, inner) for outer in (200, 20) for inner in (20, 8, 3, 1)]
    sizes += [(outer, inner) for outer in (12, 8, 5, 3, 2, 1) for inner in (3, 1, 0)]
    for outer, inner in ((MOST_ENTRIES, MOST_ENTRIES), *sizes):
        text = json.dumps(_cut(answer, outer, inner, 0), ensure_ascii=False)
        if len(text) <= most:
            return text
    missing = len(text) - most + 100
    while len(json.dumps({"cut": text[:-missing], "missing_characters": missing})) > most:
        missing += 100
    return json.dumps({"cut": text[:-missing], "missing_characters": missing})


def _cut(value: Any, outer: int, inner: int, depth: int) -> Any:
    """Shorten the lists and texts in a value, and append the number of omitted items.

    Lists on the first two levels get at most `outer` items, and deeper lists at most `inner` items.
    """
    keep = outer if depth < 2 else inner
    if isinstance(value, dict):
        return {key: _cut(one, outer, inner, depth + 1) for key, one in value.items()}
    if isinstance(value, list):
        found = [_cut(one, outer, inner, depth + 1) for one in value[:keep]]
        return found + ([f"{len(value) - keep} more"] if len(value) > keep else [])
    longest = 80 * max(keep, 3)
    if isinstance(value, str) and len(value) > longest and outer < MOST_ENTRIES:
        return f"{value[:longest]}… {len(value) - longest} characters more"
    return value
