"""Command `tftool teleop`: drive a turtle with arrow keys."""

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Ascii, Light, argument, option


class TeleopOptions(Command, hosts_turtles=True):
    """Drive a turtle with the arrow keys (ros2 run turtlesim turtle_teleop_key).

    One press moves the turtle for a second. The eight letters around f turn the turtle in the
    direction of the key, seen from f: t is north-east. f cancels a turn, q quits.

    tftool teleop
    tftool teleop turtle2
    tftool teleop --keys "up up left up"
    """

    turtle: str = argument("Turtle to drive.", default="turtle1", metavar="[TURTLE]")
    keys: str | None = option(
        'Press these keys in turn, without reading the keyboard: "up up left g".',
        "--keys",
        metavar="KEYS",
    )
    ascii_only: Ascii = False
    light: Light = False
