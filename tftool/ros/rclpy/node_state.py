"""tftool's state of each rclpy node, which publishers, timers and services of the node share.

A node's class belongs to the user, who may choose attribute names such as `world`, `graph` or
`entities`. tftool therefore stores its state in one attribute, `_tftool`. The node's own
attributes, such as its clock and parameters, are private as in rclpy.
"""

import asyncio
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

from tftool.ros.host import names
from tftool.ros.host.program import Program
from tftool.ros.rclpy.exceptions import InvalidHandle
from tftool.ros.rclpy.validation import validate_topic_name
from tftool.world.clock import Phase
from tftool.world.endpoints import PUBLISHER, Endpoint
from tftool.world.node import Node
from tftool.world.world import TransformMessage, World

T = TypeVar("T")


class NodeState:
    """tftool's state of one rclpy node, for its publishers, timers and services, and its executor.

    Attributes:
        program: User's program that created the node.
        world: World in which the node's topics and services are.
        name: Name of the node, after renaming by `__node`.
        namespace: Namespace of the node, without slashes at its ends.
        options: Options of `--ros-args` for the node.
        context: rclpy's context of the node.
        ros_node: The user's `Node` object.
        executor: Executor that the node was added to; None if there is none.
        was_served: Whether the node was ever added to an executor.
        rosout: Publisher of the node's log messages; None if there is none.
        entities: The node's publishers, subscriptions, timers and the like, oldest first.
        node: Node of tftool's world for this node.
        authority: Name of the node as the sender of transforms.
    """

    def __init__(
        self,
        program: Program,
        name: str,
        namespace: str,
        options: names.RosOptions,
        context: Any,
        ros_node: Any,
    ) -> None:
        self.program = program
        self.world: World = program.world
        self.name = name
        self.namespace = namespace
        self.options = options
        self.context = context
        self.ros_node = ros_node
        self.executor: Any = None
        self.was_served = False
        self.rosout: Any = None
        self.entities: list[Any] = []
        self._destroyed = False
        self.node: Node = program.ask(self._join)
        self.authority: str = self.node.name
        program.nodes.append(self)

    def _join(self) -> Node:
        wanted = names.join(self.namespace, self.name)
        if self.program.name == wanted:
            # The executable and its node often have the same name, so the program gets another one.
            self.program.name = f"{wanted} (program)"
        name = self.world.free_name(wanted)
        # Hidden nodes are tools, of which several may run: two terminals with 'ros2 topic echo'.
        is_tool = self.name.startswith("_")
        if name != wanted and not is_tool:
            self.program.say(
                "WARN",
                name,
                f"a node named '{wanted}' exists already; this node is shown as '{name}'. "
                "Rename this node: --ros-args -r __node:=…",
            )
        elif name in self.world.far_nodes and not is_tool:
            self.program.say("WARN", name, names.named_twice(name))
        return Node(self.world, name)

    def full(self, name: str, *, remap: bool = True, is_service: bool = False) -> str:
        """Return the full name of a topic or service, without leading slash.

        With `remap`, the node's remapping rules are applied.

        Raises:
            NameValidationException: If ROS 2 refuses the name.
        """
        validate_topic_name(name, is_service=is_service)
        full = names.expand(name, self.name, self.namespace)
        return self.options.remapped(full, self.name, self.namespace) if remap else full

    # Entities of the node

    def require_of(self, entity: Any) -> None:
        """Check that a publisher, timer or other entity has not been destroyed.

        Raises:
            InvalidHandle: If the entity is destroyed.
        """
        if entity not in self.entities:
            raise InvalidHandle(
                f"a {type(entity).__name__} of '{self.name}' is destroyed, so it cannot be used"
            )

    def require(self) -> None:
        """Check that the node has not been destroyed.

        Raises:
            InvalidHandle: If the node is destroyed.
        """
        if self._destroyed:
            raise InvalidHandle(
                f"node '{self.name}' is destroyed: create its publishers, timers and so on "
                "before destroy_node()"
            )

    def keep(self, make: Callable[..., T], *args: Any) -> T:
        """Create an entity of the node, as `add` does, in the event loop's thread.

        Raises:
            InvalidHandle: If the node is destroyed.
        """
        self.require()
        entity: T = self.program.ask(partial(self.add, make, *args))
        return entity

    def add(self, make: Callable[..., T], *args: Any) -> T:
        """Call `make(self, *args)`, and add the resulting entity, such as a timer, to the node.

        Call this in the event loop's thread.
        """
        entity = make(self, *args)
        self.entities.append(entity)
        self.wake()
        return entity

    def forget(self, entity: Any) -> bool:
        """Close an entity and remove it from the node; return False if it was removed before."""

        def drop() -> bool:
            if entity not in self.entities:
                return False
            self.entities.remove(entity)
            entity.withdraw()
            return True

        return bool(self.program.ask(drop))

    def destroy_node(self) -> None:
        """Destroy the node with all its entities; call this in the program's thread."""
        if not self._destroyed:
            self.program.unserved.append((self.name, self.unserved()))
            self.program.ask(self.withdraw)
            if self in self.program.nodes:
                self.program.nodes.remove(self)

    def unserved(self) -> int:
        """Return the number of callbacks of a node that was never spun; 0 for other nodes."""
        return 0 if self.was_served else sum(one.is_a_callback for one in self.entities)

    # On the loop's thread

    def wake(self) -> None:
        """Wake the node's executor, so that the executor looks for work."""
        if self.executor is not None:
            self.executor.wake()

    def withdraw(self) -> None:
        """Remove the node from the world; call this in the event loop's thread."""
        if self._destroyed:
            return
        self._destroyed = True
        for entity in self.entities:
            entity.withdraw()
        self.entities.clear()
        self.world.remove(self.node)

    def stored_messages(self, full_name: str) -> list[tuple[Any, Endpoint | None]]:
        """Return the stored messages that a new TRANSIENT_LOCAL subscription to a topic receives.

        Returns:
            Tuples (message, publisher) for the publishers of this process; the publisher of static
            transforms is None.
        """
        if full_name == "tf_static":
            transforms = self.world.static_transforms()
            return [(TransformMessage(transforms, ""), None)] if transforms else []
        return [
            (value, publisher)
            for publisher in self.world.endpoints.of(full_name, PUBLISHER)
            for value in publisher.kept or ()
        ]

    # Waiting

    def wait_until(self, condition: Callable[[], bool], timeout_sec: float | None) -> bool:
        """Block until `condition()` is True; return False at the timeout."""
        if timeout_sec is not None and timeout_sec <= 0:
            timeout_sec = 0.0
        return bool(self.program.ask(lambda: self._appears(condition, timeout_sec)))

    async def _appears(self, there: Callable[[], bool], timeout_sec: float | None) -> bool:
        end = None
        if timeout_sec is not None:
            end = self.world.clock.now() + int(timeout_sec * 1e9)
        changed = asyncio.Event()
        stop = self.world.watch(changed.set)
        in_time = True
        try:
            while in_time and not there() and self.context.ok():
                changed.clear()
                in_time = await self.program.first_of(changed, until=end, phase=Phase.WATCH)
            return there()
        finally:
            stop()


def state_of(node: Any) -> NodeState:
    """Return tftool's state of a user's node.

    Raises:
        TypeError: If `node` is not a node, or its `__init__` did not call `super().__init__`.
    """
    state = getattr(node, "_tftool", None)
    if not isinstance(state, NodeState):
        raise TypeError(
            f"expected a node, got {type(node).__name__}: in a class derived from Node, first "
            "call super().__init__('its_name')"
        )
    return state
