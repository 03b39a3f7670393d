"""Table of commands: the groups of the help, one line about each command, and its declaration."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tftool.commands.shared.declaration import Declaration

# In the order of the help, with the line it has for each: reading that from the commands
# themselves would import them all. Each is declared in a module of its own name.
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
        "calibrate": "Find a sensor's mount and clock offset from motion.",
        "diff": "Say what differs between two sets of frames, link by link.",
        "edit": "Change the frames of a recording; repair, join, cut, convert.",
        "mcp": "Answer questions of an agent about recordings (MCP).",
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
"""A line of the help for each command, by purpose."""

COMMANDS = {name: summary for group in GROUPS.values() for name, summary in group.items()}


def load(name: str) -> "Declaration":
    """Import the declaration of a command.

    Help and completion list every command, but import only the commands they describe in detail.
    """
    # Only `help` asks for other commands.
    home = "tftool.app.help" if name == "help" else f"tftool.commands.{name}"
    declaration: Declaration = getattr(import_module(home), name)
    return declaration
