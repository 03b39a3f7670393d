"""Display of `sensor_msgs/LaserScan`: the end points of the rays, in the plane of the sensor."""

from typing import Any, Final

import numpy as np

from tftool.screens.browser.displays.shapes import Arrival, DrawnMessage, drawn

TYPES: Final = ("sensor_msgs/msg/LaserScan",)


def draw(message: Any, arrival: Arrival) -> DrawnMessage:
    """Return the end points of all rays with a valid range, as points to draw."""
    ranges = np.asarray(message.ranges, dtype=np.float64)
    angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
    hit = (ranges >= message.range_min) & (ranges <= message.range_max)
    ranges, angles = ranges[hit], angles[hit]
    places = np.stack((ranges * np.cos(angles), ranges * np.sin(angles), 0.0 * ranges), axis=1)
    return drawn("points", message.header, places, arrival.most)
