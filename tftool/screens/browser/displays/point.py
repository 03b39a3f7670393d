"""`geometry_msgs/PointStamped`: a position as a ball."""

from typing import Any, Final

import numpy as np

from tftool.screens.browser.displays.shapes import DrawnMessage, drawn

TYPE: Final = "geometry_msgs/msg/PointStamped"
KIND: Final = "ball"


def draw(message: Any, most: int) -> DrawnMessage:
    """Return the position."""
    point = message.point
    return drawn(message.header, np.array([(point.x, point.y, point.z)]), most)
