"""The tutorial's static_turtle_tf2_broadcaster: a turtle that hangs in the world for ever."""

import math
from collections.abc import Sequence

from tftool.base.errors import NodeArgumentsError
from tftool.buffer.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform

USAGE = "static_turtle_tf2_broadcaster child_frame_name x y z roll pitch yaw"


def static_turtle(arguments: Sequence[str]) -> TransformStamped:
    """Read the seven arguments of the tutorial's program.

    Mind the order: roll, pitch, yaw, unlike static_transform_publisher's.

    Args:
        arguments: child_frame_name x y z roll pitch yaw.

    Returns:
        The link from `world`, stamped 0: to be stamped when it is broadcast.

    Raises:
        NodeArgumentsError: If there are not seven (status 1), the child is `world`, or a
            number is none (status 2).
    """
    if len(arguments) != 7:
        raise NodeArgumentsError(f"Invalid number of parameters. Usage: \n$ {USAGE}", status=1)
    child, *texts = arguments
    if child == "world":
        raise NodeArgumentsError('Your static turtle name cannot be "world"', status=2)
    x, y, z, roll, pitch, yaw = (_number(text) for text in texts)
    return TransformStamped(
        0, "world", child, Transform((x, y, z), quaternion_from_rpy(roll, pitch, yaw))
    )


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise NodeArgumentsError(f"{text!r} is not a finite number. Usage: {USAGE}", status=2)
    return number
