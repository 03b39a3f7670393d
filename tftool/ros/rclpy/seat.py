"""A node's connection to the world, shared by its publishers, timers and services.

A node's class belongs to the user, who may use the attributes `world`, `graph` or `entities` as
well: so tftool's state is in one attribute, `_tftool`. The node's own attributes, such as its clock
and parameters, are private as in rclpy.
"""

import asyncio
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

from tftool.ros.host import names
from tftool.ros.host.program import Program, ProgramNode
from tftool.ros.rclpy.exceptions import InvalidHandle
from tftool.ros.rclpy.validation import validate_topic_name
from tftool.world.clock import Phase
from tftool.world.endpoints import PUBLISHER, Endpoint
from tftool.world.world import TransformMessage, World

T = TypeVar("T")


class NodeSeat:
    """A program's node as its entities and its executor use it.

    Attributes:
        program: Program of the node.
        world: World.
        name: Name after renaming.
        namespace: Namespace, without slashes at the ends.
        options: Options of `--ros-args` for it.
        context: rclpy's context of the node.
        ros_node: The node as the user holds it.
        executor: Executor of the node; None without one.
        was_served: Whether an executor has ever served it.
        rosout: Publisher of its log messages, None without one.
        entities: Entities that can become ready, in the order of creation.
        authority: Authority of its transforms.
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
        self._node: ProgramNode = program.ask(self._join)
        self.authority: str = self._node.name
        program.nodes.append(self)

    def _join(self) -> ProgramNode:
        name = names.join(self.namespace, self.name)
        wanted, number = name, 1
        while any(other.name == name for other in self.world.nodes if other is not self.program):
            number += 1
            name = f"{wanted}_{number}"
        if name != wanted:
            self.program.say(
                "WARN",
                name,
                f"a node named '{wanted}' exists already; this one is shown as '{name}'. "
                f"Give it a name of its own: --ros-args -r __node:=…",
            )
        elif name in self.world.far_nodes and not self.name.startswith("_"):
            # Hidden ones are tools, and there may be many: 'ros2 topic echo' in two terminals.
            self.program.say("WARN", name, names.named_twice(name))
        if self.program.name == name:
            # The executable and its node share a name, as they often do.
            self.program.name = f"{name} (program)"
        return ProgramNode(self.program, name)

    def full(self, name: str, *, remap: bool = True, is_service: bool = False) -> str:
        """Return a topic's or service's full name, without leading slash.

        Raises:
            NameValidationException: If ROS 2 refuses the name.
        """
        validate_topic_name(name, is_service=is_service)
        full = names.expand(name, self.name, self.namespace)
        return self.options.remapped(full, self.name, self.namespace) if remap else full

    # What it has

    def require_of(self, entity: Any) -> None:
        """Check that an entity still belongs to it.

        Raises:
            InvalidHandle: If that is destroyed.
        """
        if entity not in self.entities:
            raise InvalidHandle(f"a {type(entity).__name__} of '{self.name}' is destroyed")

    def require(self) -> None:
        """Check that it may get new entities.

        Raises:
            InvalidHandle: If the node is destroyed.
        """
        if self._destroyed:
            raise InvalidHandle(f"node '{self.name}' is destroyed: it can have nothing new")

    def keep(self, make: Callable[..., T], *args: Any) -> T:
        """Call `make` in the loop's thread, and add the new entity to executors.

        Raises:
            InvalidHandle: If the node is destroyed.
        """
        self.require()
        entity: T = self.program.ask(partial(self.add, make, *args))
        return entity

    def add(self, make: Callable[..., T], *args: Any) -> T:
        """Make an entity (in the loop's thread)."""
        entity = make(*args)
        self.entities.append(entity)
        self.wake()
        return entity

    def forget(self, entity: Any) -> bool:
        """Close an entity; return whether it belonged to the node."""

        def drop() -> bool:
            if entity not in self.entities:
                return False
            self.entities.remove(entity)
            entity.withdraw()
            return True

        return bool(self.program.ask(drop))

    def leave(self) -> None:
        """Close everything, called in the program's thread."""
        if not self._destroyed:
            self.program.unserved.append((self.name, self.unserved()))
            self.program.ask(self.withdraw)
            if self in self.program.nodes:
                self.program.nodes.remove(self)

    def unserved(self) -> int:
        """Return how many callbacks wait for an executor that never came."""
        return 0 if self.was_served else sum(one.is_a_callback for one in self.entities)

    # On the loop's thread

    def wake(self) -> None:
        """Wake the executor that spins the node."""
        if self.executor is not None:
            self.executor.wake()

    def withdraw(self) -> None:
        """Leave the world."""
        if self._destroyed:
            return
        self._destroyed = True
        for entity in self.entities:
            entity.withdraw()
        self.entities.clear()
        self.world.remove(self._node)

    def late(self, full: str) -> list[tuple[Any, Endpoint | None]]:
        """Return this process's latched messages for a new subscription, with their senders."""
        if full == "tf_static":
            transforms = self.world.static_transforms()
            return [(TransformMessage(transforms, ""), None)] if transforms else []
        return [
            (value, publisher)
            for publisher in self.world.endpoints.of(full, PUBLISHER)
            for value in publisher.kept or ()
        ]

    # Waiting

    def wait_until(self, there: Callable[[], bool], timeout_sec: float | None) -> bool:
        """Block until something exists in the world; return whether it does."""
        if timeout_sec is not None and timeout_sec <= 0:
            timeout_sec = 0.0
        return bool(self.program.ask(lambda: self._appears(there, timeout_sec)))

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
                waiting = asyncio.ensure_future(changed.wait())
                try:
                    in_time = await self.program.first_of(waiting, until=end, phase=Phase.WATCH)
                finally:
                    waiting.cancel()
            return there()
        finally:
            stop()


def seat_of(node: Any) -> NodeSeat:
    """Return the seat of a user's node.

    Raises:
        TypeError: If the object is no node, or its `__init__` did not call `super().__init__`.
    """
    seat = getattr(node, "_tftool", None)
    if not isinstance(seat, NodeSeat):
        raise TypeError(
            f"expected a node, got {type(node).__name__}: a class derived from Node calls "
            "super().__init__('its_name') first"
        )
    return seat
