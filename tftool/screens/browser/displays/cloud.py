"""Display of `sensor_msgs/PointCloud2`: the points with the fields x, y and z."""

from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError
from tftool.screens.browser.displays.shapes import Arrival, DrawnMessage, drawn

TYPES: Final = ("sensor_msgs/msg/PointCloud2",)

_FORMATS: Final = {7: "f4", 8: "f8"}


def draw(message: Any, arrival: Arrival) -> DrawnMessage:
    """Return the cloud's points, as points to draw.

    Raises:
        InputError: If x, y and z are not floats, or bytes are missing for the width and height.
    """
    fields = {field.name: field for field in message.fields}
    order = ">" if message.is_bigendian else "<"
    formats, offsets = [], []
    for name in "xyz":
        field = fields.get(name)
        if field is None or field.datatype not in _FORMATS:
            raise InputError(f"the cloud has no field '{name}' of floats")
        formats.append(order + _FORMATS[field.datatype])
        offsets.append(field.offset)
    step, width, height = message.point_step, message.width, message.height
    data = bytes(message.data)
    ends = [start + int(kind[-1]) for start, kind in zip(offsets, formats, strict=True)]
    row = message.row_step if height > 1 else step * width
    if step < max(ends) or row < step * width or row * (height - 1) + step * width > len(data):
        raise InputError("the point cloud has fewer bytes than its width and height require")
    kind = np.dtype(
        {"names": ["x", "y", "z"], "formats": formats, "offsets": offsets, "itemsize": step}
    )
    points = np.ndarray((height, width), kind, data, strides=(row, step)).reshape(-1)
    places = np.stack([points[name] for name in "xyz"], axis=1)
    return drawn("points", message.header, places, arrival.most)
