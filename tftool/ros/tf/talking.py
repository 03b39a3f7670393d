"""tf2_ros's listener and broadcasters.

A listener's transforms go straight into its buffer, whoever spins.
"""

from collections.abc import Callable, Iterable
from typing import Any

from tftool.interfaces.classes import INTERFACES
from tftool.ros import values
from tftool.ros.client.entities import Entity
from tftool.ros.client.member import Member, member_of
from tftool.ros.client.node import Node
from tftool.ros.tf.buffer import Buffer
from tftool.runtime.world import TransformMessage

AUTHORITY = "default_authority"
"""Who sent what was sent before one listened; of later transforms the sender is known."""


class TransformListener:
    """Fills a buffer from `/tf` and `/tf_static`; statics sent before are there at once."""

    def __init__(
        self,
        buffer: Buffer,
        node: Node,
        *,
        spin_thread: bool = False,
        qos: Any = None,
        static_qos: Any = None,
        tf_topic: str = "/tf",
        tf_static_topic: str = "/tf_static",
        static_only: bool = False,
    ) -> None:
        self.buffer = buffer
        self.node = node
        self._stops: list[Callable[[], None]] = []
        self._member = member_of(node)
        self._member.program.listens = True
        self._member.keep(lambda: self._listen(static_only))

    def _listen(self, static_only: bool) -> Entity:
        world, frames = self._member.world, self.buffer.frames

        def moving(message: TransformMessage) -> None:
            for sample in message.transforms:
                frames.set_transform(sample, message.authority)

        def fixed(message: TransformMessage) -> None:
            for sample in message.transforms:
                frames.set_transform_static(sample, message.authority)

        for sample in world.static_transforms():
            frames.set_transform_static(sample, AUTHORITY)
        self._stops = [world.tf_static.subscribe(fixed)]
        if not static_only:
            self._stops.append(world.tf.subscribe(moving))
        return _Stopper(self._member, self._stop)

    def _stop(self) -> None:
        for stop in self._stops:
            stop()
        self._stops.clear()

    def unregister(self) -> None:
        """Listen no more."""
        self._member.program.ask(self._stop)


class StaticTransformListener(TransformListener):
    """Fills a buffer from `/tf_static` alone."""

    def __init__(self, buffer: Buffer, node: Node, **kwargs: Any) -> None:
        super().__init__(buffer, node, static_only=True, **kwargs)


class _Stopper(Entity):
    """Ends a listener together with its node; the buffer is filled without an executor."""

    def __init__(self, member: Member, stop: Callable[[], None]) -> None:
        super().__init__(member, None)
        self._stop = stop

    def withdraw(self) -> None:
        """Listen no more."""
        self._stop()


class TransformBroadcaster:
    """Sends moving transforms."""

    _static = False

    def __init__(self, node: Node, qos: Any = None) -> None:
        self.node = node
        self._member = member_of(node)
        self._member.program.broadcasts = True

    def sendTransform(self, transform: Any) -> None:  # noqa: N802
        """Send one transform, or several."""
        several = transform if isinstance(transform, Iterable) else [transform]
        kind = INTERFACES.message("geometry_msgs/TransformStamped")
        sent = []
        for one in several:
            if not isinstance(one, kind):
                raise TypeError(f"expected a TransformStamped, got {type(one).__name__}")
            sent.append(values.pack_transform(one))
        member, static = self._member, self._static
        member.program.ask(lambda: member.world.broadcast(sent, member.authority, static=static))


class StaticTransformBroadcaster(TransformBroadcaster):
    """Sends transforms that hold for all time; late listeners get them too."""

    _static = True
