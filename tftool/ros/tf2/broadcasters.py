"""Transform listeners and broadcasters of tf2_ros.

A listener inserts each transform into its buffer on arrival, even while its node does not spin.
"""

import math
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from tftool.base.stamps import Stamp, as_seconds, seconds
from tftool.buffer.callbacks import Watch
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import INTERFACES
from tftool.ros.host import values
from tftool.ros.rclpy.entities import NodeEntity, Work
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.node_state import NodeState, state_of
from tftool.ros.tf2.buffer import Buffer
from tftool.world.clock import Phase
from tftool.world.world import TransformMessage

_TOLERANCE = 10e-3
"""Largest difference from 1 of a quaternion's squared length that tf2 accepts."""

SILENT = seconds(5.0)
"""Nanoseconds without a transform after which a warning about a broadcaster is logged."""

MOVES = 3
"""Changes of parent after which a frame counts as having two alternating parents."""

AUTHORITY = "default_authority"
"""Authority (sender) of transforms that were sent before the listener existed."""

DEFAULT_TF_TOPIC = "/tf"
DEFAULT_STATIC_TF_TOPIC = "/tf_static"


class TransformListener:
    """Listener that inserts the transforms on `/tf` and `/tf_static` into a buffer.

    Static transforms that were sent before the listener existed are inserted too.
    """

    def __init__(
        self,
        buffer: Buffer,
        node: Node,
        *,
        spin_thread: bool = False,
        qos: Any = None,
        static_qos: Any = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
        static_only: bool = False,
    ) -> None:
        self.buffer = buffer
        self.node = node
        self._stops: list[Callable[[], None]] = []
        self._member = state_of(node)
        self._member.program.listens = True
        buffer.hints.has_listener = True
        self._member.keep(self._listen, static_only)

    def _listen(self, state: NodeState, static_only: bool) -> NodeEntity:
        world, program = state.world, state.program
        arrivals = _Arrivals(state, self._stop)
        # The clock jumps back if a recording is played again or a simulation starts again.
        watch = Watch(
            lambda: self.buffer.frames.clear(),
            lambda _, text: program.say("WARN", program.name, text),
        )

        def insert(message: TransformMessage, *, static: bool) -> None:
            watch.read(_time_of_stamps(self._member))
            arrivals.note()
            # Read the attribute each time, because a program may give the listener another buffer.
            frames = self.buffer.frames
            insert_one = frames.set_transform_static if static else frames.set_transform
            for sample in message.transforms:
                insert_one(sample, message.authority)

        for sample in world.static_transforms():
            self.buffer.frames.set_transform_static(sample, AUTHORITY)
            arrivals.note()
        owner = state.authority
        self._stops = [world.tf_static.subscribe(partial(insert, static=True), owner)]
        if not static_only:
            self._stops.append(world.tf.subscribe(partial(insert, static=False), owner))
        return arrivals

    def _stop(self) -> None:
        for stop in self._stops:
            stop()
        self._stops.clear()

    def unregister(self) -> None:
        """Unsubscribe from `/tf` and `/tf_static`; the buffer then gets no further transforms."""
        self._member.program.ask(self._stop)


def _time_of_stamps(state: NodeState) -> Stamp:
    """Return the present time, in nanoseconds, for transforms that arrive at a node.

    Without `/clock`, this is the time of the node's clock. With `/clock`, it is the time in the
    last `/clock` message, even if the node's clock does not show this time yet. The clock is set
    only when an executor spins the node, but transforms may arrive earlier, for example after a
    jump back.
    """
    clock = state.ros_node.get_clock()
    if not clock.is_overridden:
        return int(clock.reading())
    message: Any = state.world.topic("clock", INTERFACES.message("rosgraph_msgs/Clock")).latest
    return 0 if message is None else values.stamp_of(message.clock)


class StaticTransformListener(TransformListener):
    """Listener that inserts the transforms on `/tf_static` into a buffer."""

    def __init__(self, buffer: Buffer, node: Node, **kwargs: Any) -> None:
        super().__init__(buffer, node, static_only=True, **kwargs)


class _Arrivals(NodeEntity):
    """Entity of a node that lets `spin_once` return when transforms arrive, as in ROS 2.

    The transforms are inserted into the buffer without this entity.
    """

    only_ends_spin_once = True

    def __init__(self, state: NodeState, stop: Callable[[], None]) -> None:
        super().__init__(state, None)
        self._stop = stop
        self._any = False

    def note(self) -> None:
        """Record that transforms have arrived; call this in the event loop's thread."""
        self._any = True
        executor = self.node_state.executor
        if executor is not None and executor.spins_once:
            executor.wake()

    def ready(self) -> bool:
        """Return whether transforms have arrived since the last call of `take`."""
        return self._any

    def take(self) -> Work:
        """Return a function that does nothing, because the buffer already has the transforms."""
        self._any = False
        return lambda: None

    def withdraw(self) -> None:
        """Unsubscribe from the topics with transforms."""
        self._stop()


class TransformBroadcaster:
    """Broadcaster that publishes transforms on `/tf`."""

    _static = False

    def __init__(self, node: Node, qos: Any = None) -> None:
        self.node = node
        self._told: set[tuple[str, str]] = set()
        self._turns: dict[str, int] = {}
        self._member = state_of(node)
        self._member.program.broadcasts = True
        self._has_sent = False
        self._member.program.ask(self._watch_silence)

    def _watch_silence(self) -> None:
        clock = self._member.world.clock
        timer = clock.timer(clock.now() + SILENT, Phase.WATCH)
        timer.add_done_callback(lambda _: self._warn_of_silence())

    def _warn_of_silence(self) -> None:
        """Log a warning if the broadcaster has sent nothing although its node was spun."""
        lives = self._member in self._member.program.nodes
        if not self._has_sent and self._member.was_served and lives:
            kind = type(self).__name__
            self._member.program.say(
                "WARN",
                self._member.authority,
                f"this node's {kind} has sent nothing for {as_seconds(SILENT):g} s: call "
                "sendTransform in the callback of a timer or a subscription, and check that this "
                "callback is called",
            )

    def sendTransform(self, transform: Any) -> None:  # noqa: N802
        """Publish a TransformStamped message, or several in a list."""
        several = transform if isinstance(transform, Iterable) else [transform]
        kind = INTERFACES.message("geometry_msgs/TransformStamped")
        sent = []
        for one in several:
            if not isinstance(one, kind):
                raise TypeError(f"expected a TransformStamped, got {type(one).__name__}")
            sample = values.pack_transform(one)
            self._check_sample(sample)
            sent.append(sample)
        self._has_sent = True
        self._member.program.ask(partial(self._broadcast, sent))

    def _broadcast(self, sent: list[TransformStamped]) -> None:
        state = self._member
        for sample in sent:
            self._check_parent(sample.frame_id, sample.child_frame_id)
        state.world.broadcast(sent, state.authority, static=self._static)

    def _check_parent(self, parent: str, child: str) -> None:
        """Log a warning if a parent and child are swapped, or a child frame has two parents.

        Each child frame causes at most one warning.
        """
        above = self._member.world.buffer.parent
        before = above(child)
        if above(parent) == child != parent:
            fault = (
                f"frame_id '{parent}' and child_frame_id '{child}' are exchanged: '{child}' is "
                f"already the parent of '{parent}'. frame_id must be the parent"
            )
        elif before not in (None, parent):
            # A frame may move to another parent once and remain there.
            self._turns[child] = self._turns.get(child, 0) + 1
            fault = (
                f"'{child}' has two alternating parents, '{before}' and '{parent}': a frame "
                "can have only one parent"
            )
            if self._turns[child] < MOVES:
                return
        else:
            return
        if ("parent", child) not in self._told:
            self._told.add(("parent", child))
            self._member.program.say("WARN", self._member.authority, fault)

    def _check_sample(self, sample: TransformStamped) -> None:
        """Log a warning, once per child frame, if the stamp is 0 or the rotation looks wrong."""
        now = self.node.get_clock().reading()
        if not (self._static or sample.stamp) and now > seconds(1.0):
            self._report_once(
                "stamp",
                sample.child_frame_id,
                "header.stamp of '{}' is 0, so lookups at any time but the latest fail: "
                "write self.get_clock().now().to_msg()",
            )
        turn = sample.transform.rotation
        length = math.hypot(*turn)
        # The buffer refuses NaN with tf2's text, so no warning is needed here.
        if math.isnan(length):
            return
        if abs(length * length - 1.0) <= _TOLERANCE:
            # If the rotation is computed from an angle, w is not exactly 0.
            if tuple(turn) == (1.0, 0.0, 0.0, 0.0):
                self._report_once(
                    "rotation",
                    sample.child_frame_id,
                    "the rotation of '{}' is half a turn about x, because x is 1.0 and w is 0.0: "
                    "write w = 1.0 if no rotation is meant; the order is x, y, z, w",
                )
            return
        if not length:
            fault = "is all zeros, which every buffer rejects: write w = 1.0 for no rotation"
        else:
            fault = f"has length {length:.4g}, not 1: ROS 2 refuses it, tftool scales it"
            if max(map(abs, turn)) > 1.5:
                fault += "; x, y, z and w are no angles: use quaternion_from_euler for radians"
        self._report_once("rotation", sample.child_frame_id, f"the rotation of '{{}}' {fault}")

    def _report_once(self, what: str, child: str, fault: str) -> None:
        if (what, child) not in self._told:
            self._told.add((what, child))
            self.node.get_logger().warning(fault.format(child))


class StaticTransformBroadcaster(TransformBroadcaster):
    """Broadcaster that publishes transforms on `/tf_static`, which later listeners receive too."""

    _static = True
