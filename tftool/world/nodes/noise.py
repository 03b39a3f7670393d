"""A sensor that is not quite where it says: a frame with seeded noise and drift."""

import math
from typing import ClassVar

from tftool.base.errors import UsageError
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform
from tftool.world.clock import Phase
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import require_period
from tftool.world.world import World


class Noise(Node):
    """Broadcast a frame beside another one, off by noise and by a drift that adds up.

    Each broadcast is off by an error of its own, normally distributed in each coordinate and
    about each axis. The drift is a random walk in the plane: after t seconds it is normally
    distributed too, with the square root of t times what is said of one second. The same seed
    gives the same errors on every machine.
    """

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(
        self,
        world: World,
        name: str = "noise",
        *,
        parent: str,
        child: str,
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
        position: float = 0.01,
        angle: float = 0.01,
        drift: float = 0.0,
        turn_drift: float = 0.0,
        seed: int = 0,
        period: Duration = seconds(0.1),
    ) -> None:
        """Join the world.

        Args:
            world: Where to live.
            name: The node's name.
            parent: The frame it hangs from.
            child: The frame that is broadcast.
            offset: Where it truly is in the parent, in metres.
            position: Standard deviation of each coordinate, in metres.
            angle: Standard deviation about each axis, in radians.
            drift: Standard deviation of x and y after one second of drift, in metres.
            turn_drift: The same about z, in radians.
            seed: Which errors.
            period: Nanoseconds between two broadcasts.

        Raises:
            UsageError: If a deviation is negative.
        """
        # Imported here: few scenarios have noise, and all import this module.
        from random import Random

        super().__init__(world, name)
        if min(position, angle, drift, turn_drift) < 0:
            raise UsageError("a deviation is zero or more; noise has no other sign")
        self.parent, self.child = parent, child
        self.period = require_period(period)
        self._true = Transform(offset)
        self._position, self._angle = position, angle
        step = math.sqrt(as_seconds(self.period))
        self._drift, self._turn_drift = drift * step, turn_drift * step
        self._random = Random(seed)

    async def run(self) -> None:
        """Broadcast until the end."""
        off = self._random.gauss
        walked = (0.0, 0.0, 0.0)
        async for now in self.every(self.period, immediately=True):
            x, y, yaw = walked
            error = Transform(
                (
                    x + off(0.0, self._position),
                    y + off(0.0, self._position),
                    off(0.0, self._position),
                ),
                quaternion_from_rpy(
                    off(0.0, self._angle), off(0.0, self._angle), yaw + off(0.0, self._angle)
                ),
            )
            self.broadcast(TransformStamped(now, self.parent, self.child, self._true @ error))
            walked = (
                x + off(0.0, self._drift),
                y + off(0.0, self._drift),
                yaw + off(0.0, self._turn_drift),
            )
