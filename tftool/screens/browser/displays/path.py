"""`nav_msgs/Path`: a line through its poses, all taken in the frame of the path."""

from typing import Any, Final

import numpy as np

from tftool.screens.browser.displays.shapes import DrawnMessage, drawn

TYPE: Final = "nav_msgs/msg/Path"
KIND: Final = "line"


def draw(message: Any, most: int) -> DrawnMessage:
    """Return the positions of its poses, in order."""
    places = [
        (one.pose.position.x, one.pose.position.y, one.pose.position.z) for one in message.poses
    ]
    return drawn(message.header, np.array(places, dtype=np.float64).reshape(-1, 3), most)
