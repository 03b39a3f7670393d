"""`tf` and `tf_static` of a world, joined with those of the other processes."""

from typing import Final

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import Stamp, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.messages.transforms import decode_columns, decode_transforms, encode_transforms
from tftool.world.clock import FollowedClock
from tftool.world.endpoints import SUBSCRIPTION, TF, TF_STATIC
from tftool.world.link.clock_follower import is_clock_shown
from tftool.world.link.link_context import LinkContext
from tftool.world.link.seam import Arrived, WirePublisher
from tftool.world.topics import Topic
from tftool.world.world import TransformMessage

LARGE: Final = 256 * 1024
"""Bytes from which a message of transforms may be taken in as arrays: whole paths at once."""

LONG: Final = 64
"""How many samples a link has in it on the average, at least, for that to pay."""

TRANSFORMS: Final = TransformMessage.interface__

YEAR: Final = seconds(365.25 * 24 * 3600)

AHEAD: Final = seconds(2)
"""So far in the future no clock that agrees with ours can stamp anything."""


class TransformBridge:
    """`tf`: transforms of many nodes, each of them a publisher of its own."""

    quality = TF

    def __init__(self, link: LinkContext, topic: Topic[TransformMessage]) -> None:
        self._link = link
        self._topic = topic
        self._senders: dict[str, WirePublisher] = {}
        self._nodes: set[str] = set()
        self._inbound: TransformMessage | None = None
        topic.relay = self._publish
        self._stops = [
            link.middleware.listen(
                topic.name, TRANSFORMS, self._arrived, is_latched=self.quality.is_latched
            ),
            link.middleware.subscription(link.main_node, topic.name, TRANSFORMS, self.quality),
        ]
        self.refresh()

    def refresh(self) -> None:
        """Count the subscribers of other processes; the buffer always listens."""
        others = self._link.graph.entities(SUBSCRIPTION, name=self._topic.name)
        self._topic.far_subscribers = len(others)
        self._dismiss()

    def _dismiss(self) -> None:
        """Close the senders of nodes that have left; some authorities were never nodes."""
        for gone in self._nodes - self._node_names():
            self._nodes.remove(gone)
            self._senders.pop(gone).close()

    def _node_names(self) -> set[str]:
        return {node.name for node in self._link.world.nodes}

    def close(self) -> None:
        """Neither send nor listen any more."""
        self._topic.relay = None
        self._topic.far_subscribers = 0
        for stop in self._stops:
            stop()
        for sender in self._senders.values():
            sender.close()

    def _publish(self, message: TransformMessage) -> None:
        if message is self._inbound or self._link.options.read_only:
            return
        sender = self._senders.get(message.authority)
        if sender is None:
            sender = self._senders[message.authority] = self._link.middleware.publisher(
                message.authority, self._topic.name, TRANSFORMS, self.quality
            )
            if message.authority in self._node_names():
                self._nodes.add(message.authority)
        if not sender.is_wanted:
            return
        try:
            sender.put(encode_transforms(message.transforms), self._link.now())
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)

    def _arrived(self, message: Arrived) -> None:
        link = self._link
        authority = link.authority(message.sender, self._topic.name)
        try:
            if self._takes_paths(message.payload, authority):
                link.received += 1
                return
            transforms = decode_transforms(message.payload)
        except MalformedMessage as refusal:
            link.refuse(self._topic.name, refusal)
            return
        link.received += 1
        accepted = self._store(transforms, authority)
        if accepted:
            self._inbound = TransformMessage(accepted, authority)
            try:
                self._topic.publish(self._inbound)
            finally:
                self._inbound = None

    def _takes_paths(self, payload: bytes, authority: str) -> bool:
        """Take in long paths of few links at once; False where that would not be faster.

        Raises:
            MalformedMessage: If the bytes are no transforms.
        """
        # A subscriber of the topic gets every single one, so they are made anyway.
        listened_to = self._topic.near_subscribers > 0
        if self.quality.is_latched or len(payload) < LARGE or listened_to:
            return False
        columns = decode_columns(payload)
        paths: dict[tuple[str, str], list[int]] = {}
        for row, link in enumerate(zip(columns.parents, columns.children, strict=True)):
            paths.setdefault(link, []).append(row)
        moves = len({child for _, child in paths}) < len(paths)
        if moves or len(columns) < LONG * len(paths):
            return False
        self._compare_clocks(int(columns.stamps[0]), authority)
        for (parent, child), rows in paths.items():
            self._link.world.buffer.set_transforms(
                parent,
                child,
                columns.stamps[rows],
                columns.translations[rows],
                columns.rotations[rows],
                authority,
            )
        self._link.world.memory.note(len(columns))
        return True

    def _store(
        self, transforms: tuple[TransformStamped, ...], authority: str
    ) -> tuple[TransformStamped, ...]:
        if transforms:
            self._compare_clocks(transforms[0].stamp, authority)
        store = self._link.world.buffer.set_transform
        self._link.world.memory.note(len(transforms))
        return tuple(one for one in transforms if store(one, authority))

    def _compare_clocks(self, stamp: Stamp, authority: str) -> None:
        clock, graph = self._link.world.clock, self._link.graph
        if isinstance(clock, FollowedClock) and not clock.is_told and is_clock_shown(graph):
            return  # what time it is will be told in a moment
        ahead = stamp - clock.now()
        if -YEAR < ahead < AHEAD:
            return
        if 0 < ahead < YEAR:
            self._link.say_once(
                "clock ahead",
                f"'{authority}' stamps its transforms {as_seconds(ahead):.1f} s after this "
                "machine's clock, which is slow then, or that one is fast (demo --rate): ages, and "
                "answers about the present or some seconds ago, are off by as much.",
            )
            return
        self._link.say_once(
            f"clock {authority}",
            f"'{authority}' stamps its transforms {as_seconds(abs(ahead)) / as_seconds(YEAR):.1f} "
            f"years {'after' if ahead > 0 else 'before'} this machine's clock: ages and waits "
            "mean little until both clocks agree (or one of them is simulated).",
        )


class StaticBridge(TransformBridge):
    """`tf_static`: a late subscriber gets all statics of every process that is there."""

    quality = TF_STATIC

    def _dismiss(self) -> None:
        """Close none: what a node said for all time is sent to late listeners when it has left."""

    def _arrived(self, message: Arrived) -> None:
        super()._arrived(message)
        self._link.heard_statics.add(message.sender)

    def _store(
        self, transforms: tuple[TransformStamped, ...], authority: str
    ) -> tuple[TransformStamped, ...]:
        return self._link.world.receive_static(transforms, authority)
