"""Every command: what the help says of it, which options it has, and where it is."""

from collections.abc import Callable
from functools import wraps
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Providers

# As the help shows them, with what it says of each: reading that from the commands themselves
# would import them all. Each is a function of its own name in a module of that name.
GROUPS = {
    "Learn": {
        "demo": "Show turtle2 following turtle1.",
        "teleop": "Drive a turtle with the arrow keys.",
        "follow": "Let FOLLOWER follow LEADER (the tutorial's turtle_following).",
        "static": "Publish where CHILD is in PARENT (static_transform_publisher).",
    },
    "Ask": {
        "echo": "Print where SOURCE is in TARGET (ros2 run tf2_ros tf2_echo).",
        "tree": "Show which frame hangs from which (rqt_tf_tree, view_frames).",
        "monitor": "Show how often and how late transforms arrive (tf2_monitor).",
        "explain": "Say why a lookup refuses: which link, by how much.",
        "doctor": "Say what is wrong with the frames, and what mends it.",
        "convert": "Write one rotation, or pose, in every notation.",
        "ros2": "Ask a session in the words of ROS 2's command line, without ROS.",
    },
    "Look": {
        "view": "Show the frames in 3-D, in a browser (rviz2 with its TF display).",
        "plot": "Plot where SOURCE is in TARGET over time.",
        "robot": "Bring a robot description alive (robot_state_publisher).",
    },
    "Work with files": {
        "info": "Show what a recording or robot description holds.",
        "play": "Play a recording as a live session (ros2 bag play).",
        "record": "Record a session (ros2 bag record).",
        "export": "Write a pair over time, or links, to files of other tools.",
        "diff": "Say what differs between two sets of frames, link by link.",
        "edit": "Change the frames of a recording; repair, join, cut or convert it.",
    },
    "Run your own nodes": {
        "new": "Make a package of nodes to begin with (ros2 pkg create).",
        "run": "Run a node written for ROS 2, unmodified, without ROS (ros2 run).",
        "launch": "Launch what a ROS 2 launch file says, without ROS (ros2 launch).",
        "session": "Show who shares the session that runs here.",
    },
    "Check": {
        "check": "Play scenarios on simulated time and judge what they expect.",
    },
    "Help": {
        "help": "Show the list of commands, or the help of one (man).",
    },
}
"""What the help says of each command, by what one wants."""

COMMANDS = {name: summary for group in GROUPS.values() for name, summary in group.items()}

# What differs from click's reading of a command line.
SETTINGS = {
    # A frame may lie at a negative place: -1 is a number there, not an option.
    "static": {"ignore_unknown_options": True},
    # Nor is it one in a rotation; static_transform_publisher's own options may be pasted, too.
    "convert": {"ignore_unknown_options": True},
    # What follows a node's file is the node's own.
    "run": {"allow_interspersed_args": False},
    # And what follows these words are ROS 2's own options.
    "ros2": {"allow_interspersed_args": False},
}

ALONE = ("check", "convert", "edit", "help", "new")
"""Commands that share no session."""


DESCRIBING = ("echo", "tree", "view", "info", "robot", "export", "diff", "explain")
"""Commands whose FROM may be a robot description."""


RECORDED_ROBOTS = ("echo", "tree", "view", "info", "doctor", "export", "diff")
"""Commands whose FROM may be a recording without the description of its robot."""


RECORDED = ("demo", "echo", "explain", "export", "info", "monitor", "play", "plot", "tree", "view")
"""Commands whose FROM may be a recording."""


def _running(name: str, declared: Callable[..., Any]) -> Callable[..., Any]:
    """Return what a declaration of options stands for: its command's `run`, imported when called.

    Help and completion need the options alone, and pay for no more.
    """

    @wraps(declared)
    def run(*args: Any, **options: Any) -> Any:
        return import_module(f"tftool.commands.{name}.command").run(*args, **options)

    return run


def load(name: str, providers: "Providers | None") -> Callable[..., Any]:
    """Import a command, and give it all its options."""
    from tftool.commands.shared.connection_options import (
        RECORDING_OPTIONS,
        ROBOT_OPTIONS,
        URDF_OPTION,
        with_connection,
    )

    # Only `help` asks for other commands.
    home = "tftool.app.help" if name == "help" else f"tftool.commands.{name}.options"
    command: Callable[..., Any] = getattr(import_module(home), name)
    if name != "help":
        command = _running(name, command)
    if name in ALONE:
        return command
    options = {
        **(ROBOT_OPTIONS if name in DESCRIBING else {}),
        **(URDF_OPTION if name in RECORDED_ROBOTS else {}),
        **(RECORDING_OPTIONS if name in RECORDED else {}),
    }
    return with_connection(command, providers, options)
