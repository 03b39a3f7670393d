"""Table of commands, and the help of `tftool` that lists the commands.

The list of commands does not need typer, which is imported when a command runs.
"""

import os
import re
import shutil
import signal
import sys
import textwrap
from collections.abc import Iterator
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tftool.commands.shared.declaration import Command

# In the order of the help. The text is here because reading it from the commands would import
# all of them. Each command is declared in the module of its name.
GROUPS = {
    "Learn": {
        "demo": "Show turtle2 following turtle1.",
        "teleop": "Drive a turtle with the arrow keys.",
        "follow": "Let FOLLOWER follow LEADER (the tutorial's turtle_following).",
        "static": "Publish where CHILD is in PARENT (static_transform_publisher).",
    },
    "Ask": {
        "echo": "Print where SOURCE is in TARGET (ros2 run tf2_ros tf2_echo).",
        "tree": "Show the tree of frames (rqt_tf_tree, view_frames).",
        "doctor": "Say what is wrong with the frames, and how to fix it.",
        "explain": "Say why a lookup fails: which link, by how much.",
        "monitor": "Show how often and how late transforms arrive (tf2_monitor).",
        "convert": "Write one rotation, or pose, in every notation.",
        "ros2": "Run commands of ROS 2's command line on a session, without ROS.",
    },
    "Look": {
        "view": "Show the frames in 3-D, in a browser (rviz2 with its TF display).",
        "plot": "Plot where SOURCE is in TARGET over time.",
        "robot": "Publish a robot, and move its joints (robot_state_publisher).",
    },
    "Work with files": {
        "info": "Show what a recording or robot description contains.",
        "play": "Play a recording as a live session (ros2 bag play).",
        "record": "Record a session (ros2 bag record).",
        "edit": "Change the frames of a recording; repair, join, cut, convert.",
        "export": "Write trajectories or transforms to files of other tools.",
        "diff": "Say what differs between two sets of frames, link by link.",
        "calibrate": "Find a sensor's mounting pose and clock offset from motion.",
        "mcp": "Answer an AI agent's questions about recordings (MCP).",
    },
    "Run your own nodes": {
        "run": "Run a node written for ROS 2, unmodified, without ROS (ros2 run).",
        "launch": "Run a ROS 2 launch file without ROS (ros2 launch).",
        "new": "Create a package with example nodes (ros2 pkg create).",
        "session": "Show the running session's processes, nodes and topics.",
    },
    "Check": {
        "check": "Play scenarios on simulated time and check their expectations.",
    },
    "Help": {
        "help": "Show the list of commands, or the help of one command (man).",
    },
}
"""Commands by purpose, the most used first, each with its line in the help."""

COMMANDS = {name: summary for group in GROUPS.values() for name, summary in group.items()}


def load(name: str) -> "type[Command]":
    """Import and return the class that declares the command `name`.

    The list of all commands needs no import: only a command to be run, described or completed is
    imported.
    """
    # `help` is declared outside of `commands`, because it uses the other commands.
    home = "tftool.app.command_line" if name == "help" else f"tftool.commands.{name}"
    command: type[Command] = getattr(import_module(home), f"{name.capitalize()}Options")
    return command


OPTIONS = {
    ("--version", "-V"): "Print the version, and stop.",
    ("--install-completion",): "Let Tab complete in the shell (bash, zsh, fish).",
    ("--show-completion",): "Print the completion script of the shell.",
    ("--help", "-h"): "Show this message and exit.",
}
"""Options of `tftool` itself, each with its line in the help."""

ABOUT = (
    "TF2 without ROS: learn coordinate frames with two turtles, and ask the same tool about a "
    "real robot.",
    "Start with 'tftool demo', then 'tftool echo turtle2 turtle1'.",
    "Exit status: 0 done; 1 an expectation or a node failed, or a check found something; 2 wrong "
    "usage; 3 the input cannot be read; 4 the transform is not available; 130 interrupted.",
)


def overview() -> str:
    """Return the help text of `tftool` with the general options and the commands by group."""
    # The width at which typer formats the help of a command.
    width = max(min(shutil.get_terminal_size().columns, 80) - 2, 50)
    paragraphs = [textwrap.fill(one, width, initial_indent="  ", subsequent_indent="  ")
                  for one in ABOUT]  # fmt: skip
    options = [(", ".join(sorted(names, key=len)), words) for names, words in OPTIONS.items()]
    widest = max(len(name) for name in COMMANDS)
    lists = [
        (title, [(name.ljust(widest), words) for name, words in group.items()])
        for title, group in GROUPS.items()
    ]
    lists.append(("Options", options))
    parts = ["Usage: tftool [OPTIONS] COMMAND [ARGS]...", *paragraphs]
    parts += [f"{title}:\n" + "\n".join(_rows(rows, width)) for title, rows in lists]
    return "\n\n".join(parts)


def _rows(rows: list[tuple[str, str]], width: int) -> Iterator[str]:
    indent = max(len(first) for first, _ in rows) + 4
    for first, second in rows:
        yield textwrap.fill(
            second,
            width,
            initial_indent=f"  {first}".ljust(indent),
            subsequent_indent=" " * indent,
        )


def show_help(text: str) -> None:
    """Print a help text; on a terminal, use colours, and show a long text in a pager."""
    if sys.stdout.isatty() and os.environ.get("TERM") != "dumb":
        is_long = text.count("\n") + 2 > shutil.get_terminal_size().lines
        if not os.environ.get("NO_COLOR"):
            text = painted(text)
        if is_long and sys.stdin.isatty() and _page(text):
            return
    sys.stdout.write(f"{text}\n")


def _page(text: str) -> bool:
    """Show a text in the pager $PAGER or less; return False if the pager is not installed."""
    import shlex
    import subprocess

    command = shlex.split(os.environ.get("PAGER") or "less")
    if shutil.which(command[0]) is None:
        return False
    # Ctrl-C is left to the pager: if this process ended first, the shell and the pager would
    # both read the keyboard.
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        # -R shows colours; -X leaves the text on the screen after q.
        environment = {"LESS": "-RX", **os.environ}
        subprocess.run(command, input=f"{text}\n", text=True, env=environment, check=False)
    finally:
        signal.signal(signal.SIGINT, before)
    return True


def painted(text: str) -> str:
    """Add colours to a help text: headings, options, commands and examples."""
    head, colon, lists = text.partition("\n\nArguments:")
    for title in ("Options", *GROUPS):
        if not colon:
            head, colon, lists = text.partition(f"\n\n{title}:")
    name = r"^(  )((?:-[^ ]|\[|[A-Z]).*?|[a-z][\w-]*)(?=\s{2,}\S|$)"
    lists = re.sub(name, "\\1\x1b[36m\\2\x1b[0m", colon + lists, flags=re.MULTILINE)
    head = re.sub(r"^(  tftool .*)$", "\x1b[32m\\1\x1b[0m", head, flags=re.MULTILINE)
    text = re.sub(r"^(\S[^:\n]*:)$", "\x1b[1;33m\\1\x1b[0m", head + lists, flags=re.MULTILINE)
    return text.replace("Usage:", "\x1b[1mUsage:\x1b[0m", 1)
