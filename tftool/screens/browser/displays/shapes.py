"""Result of every display: positions in one frame at one time."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS, Stamp

Places = npt.NDArray[np.float32]
"""Metres in the frame of the message, shape (n, 3)."""

MOST_POINTS = 200_000
"""Points of one message that are drawn; of more, every second one, or every third."""


@dataclass(frozen=True, slots=True, eq=False)
class DrawnMessage:
    """One message in drawable form.

    Attributes:
        stamp: Its moment, nanoseconds.
        frame: Frame of its positions.
        places: Their positions, all finite.
    """

    stamp: Stamp
    frame: str
    places: Places


def thinned(places: Places, most: int) -> Places:
    """Return at most `most` positions: all, every second, every third, and so on."""
    return places[:: max(1, -(-len(places) // most))]


def drawn(header: Any, places: npt.NDArray[Any], most: int = MOST_POINTS) -> DrawnMessage:
    """Return the finite positions, thinned to at most `most`."""
    places = np.asarray(places, dtype=np.float32).reshape(-1, 3)
    places = places[np.isfinite(places).all(axis=1)]
    places = thinned(places, most)
    stamp = header.stamp.sec * NANOSECONDS + header.stamp.nanosec
    return DrawnMessage(stamp, header.frame_id.removeprefix("/"), places)
