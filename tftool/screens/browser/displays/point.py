"""Display of `geometry_msgs/PointStamped`: a ball at the point's position."""

from typing import Any, Final

import numpy as np

from tftool.screens.browser.displays.shapes import Arrival, DrawnMessage, drawn

TYPES: Final = ("geometry_msgs/msg/PointStamped",)


def draw(message: Any, arrival: Arrival) -> DrawnMessage:
    """Return a ball at the point's position."""
    point = message.point
    return drawn("ball", message.header, np.array([(point.x, point.y, point.z)]), arrival.most)
