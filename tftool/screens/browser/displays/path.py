"""Display of `nav_msgs/Path`: a line through the poses, in the frame of the path."""

from typing import Any, Final

import numpy as np

from tftool.screens.browser.displays.shapes import Arrival, DrawnMessage, drawn

TYPES: Final = ("nav_msgs/msg/Path",)


def draw(message: Any, arrival: Arrival) -> DrawnMessage:
    """Return a line through the positions of the path's poses."""
    places = [
        (one.pose.position.x, one.pose.position.y, one.pose.position.z) for one in message.poses
    ]
    return drawn(
        "line", message.header, np.array(places, dtype=np.float64).reshape(-1, 3), arrival.most
    )
