"""A user's program, which passes mypy --strict and runs."""

from pathlib import Path

import numpy as np
import numpy.typing as npt

import tftool
from tftool import (
    Buffer,
    LookupException,
    Node,
    Quaternion,
    SimClock,
    Transform,
    TransformArray,
    TransformStamped,
    Vector3,
    World,
    seconds,
)


class Circling(Node):
    """Node that broadcasts a frame on a circle about the origin."""

    radius: float = 2.0

    async def run(self) -> None:
        """Broadcast the frame twenty times a second."""
        async for now in self.every(seconds(0.05)):
            angle = (now - self.world.clock.epoch) / seconds(1)
            turn = Quaternion.from_rpy(0.0, 0.0, angle)
            place = Transform((0.0, 0.0, 0.0), turn).apply(Vector3(self.radius, 0.0, 0.0))
            self.broadcast(TransformStamped(now, "map", "car", Transform(place, turn)))


def driven() -> Buffer:
    """Return the buffer of a world in which the node has run for two seconds."""
    world = World(SimClock())
    Circling(world, "circling")
    world.run(seconds(2))
    return world.buffer


def farthest(path: TransformArray) -> float:
    """Return the largest distance from the origin."""
    distances: npt.NDArray[np.float64] = np.linalg.norm(path.translations, axis=1)
    return float(distances.max())


def main(folder: Path) -> dict[str, float]:
    """Run the node, write a recording, read it, and measure."""
    buffer = driven()
    latest: TransformStamped = buffer.lookup_transform("map", "car")
    written = tftool.export(buffer, path=folder / "run.mcap")
    with tftool.open(str(folder / "run.mcap")) as frames:
        if frames.start is None or frames.end is None:
            raise ValueError("nothing was recorded")
        stamps = np.linspace(frames.start, frames.end, 9).astype(np.int64)
        path = frames.buffer.lookup_transforms("map", "car", stamps)
    try:
        buffer.lookup_transform("map", "lorry")
        refused = 0.0
    except LookupException:
        refused = 1.0
    back = Transform.from_matrix(latest.transform.matrix())
    length = (back.inverse() @ latest.transform).translation.norm()
    return {
        "farthest": farthest(path),
        "count": float(written.count),
        "error": length,
        "refused": refused,
    }
