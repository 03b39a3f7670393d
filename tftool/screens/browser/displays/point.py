"""`geometry_msgs/PointStamped`: a position as a ball."""

from typing import Any, Final

import numpy as np

from tftool.screens.browser.displays.shapes import Arrival, DrawnMessage, drawn

TYPES: Final = ("geometry_msgs/msg/PointStamped",)


def draw(message: Any, arrival: Arrival) -> DrawnMessage:
    """Return the position."""
    point = message.point
    return drawn("ball", message.header, np.array([(point.x, point.y, point.z)]), arrival.most)
