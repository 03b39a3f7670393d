"""Something seen once, remembered in two ways: one outlives the cache, one does not."""

from typing import ClassVar

from tftool.errors import TransformException
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.runtime.clock import Phase
from tftool.runtime.node import Node
from tftool.runtime.world import World
from tftool.stamps import Duration, seconds


class Sighting(Node):
    """See a thing from a moving frame, once, and store it twice.

    Stored as it was seen, hanging from the observer, it can be placed in the fixed
    frame only while the buffer remembers where the observer was. Turned into the
    fixed frame at once, it can be placed for ever.
    """

    phase: ClassVar[Phase] = Phase.CONSUME

    def __init__(
        self,
        world: World,
        name: str = "sighting",
        *,
        observer: str = "turtle1",
        fixed_frame: str = "world",
        after: Duration = seconds(2),
        offset: tuple[float, float, float] = (1.0, 0.0, 0.0),
        as_seen: str = "thing_as_seen",
        in_fixed_frame: str = "thing_in_world",
    ) -> None:
        """Join the world.

        Args:
            world: Where to live.
            name: The node's name.
            observer: The frame it is seen from.
            fixed_frame: The frame that does not move.
            after: Nanoseconds from the start to the sighting.
            offset: Where the thing is in the observer's frame, in metres.
            as_seen: Frame of the thing as a dynamic child of the observer, sent once.
            in_fixed_frame: Frame of the thing as a static child of the fixed frame.
        """
        super().__init__(world, name)
        self.observer, self.fixed_frame = observer, fixed_frame
        self.after, self.offset = after, offset
        self.as_seen, self.in_fixed_frame = as_seen, in_fixed_frame

    async def run(self) -> None:
        """Wait for the moment, look, store, and be done."""
        await self.clock.sleep(self.after, self.phase, self.rank)
        try:
            seen_from = self.buffer.lookup_transform(self.fixed_frame, self.observer)
        except TransformException as refusal:
            self.warn(f"Nothing was seen from {self.observer}: {refusal}")
            return
        thing = Transform(self.offset)
        moment = seen_from.stamp
        self.broadcast(TransformStamped(moment, self.observer, self.as_seen, thing))
        self.broadcast_static(
            TransformStamped(
                moment, self.fixed_frame, self.in_fixed_frame, seen_from.transform @ thing
            )
        )
        self.info(f"Saw a thing from {self.observer}, and stored it in {self.fixed_frame} too")
