"""rclpy's Node."""

import asyncio
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

from tftool.interfaces.classes import Message
from tftool.ros import names, program
from tftool.ros.client.context import Context, context_of
from tftool.ros.client.entities import (
    Entity,
    GuardCondition,
    Publisher,
    Subscription,
    Timer,
    period_of,
)
from tftool.ros.client.exceptions import NotInitializedException
from tftool.ros.client.futures import Future
from tftool.ros.client.groups import CallbackGroup, MutuallyExclusiveCallbackGroup
from tftool.ros.client.logging import LoggingSeverity, RcutilsLogger
from tftool.ros.client.node_parameters import NodeParameters
from tftool.ros.client.qos import QoSProfile, profile_of
from tftool.ros.client.services import Client, Service
from tftool.ros.client.time import Clock, Rate, ROSClock
from tftool.ros.program import Program, ProgramNode
from tftool.runtime.clock import Phase
from tftool.runtime.world import TransformMessage, World
from tftool.stamps import Stamp

E = TypeVar("E", bound=Entity)


class Graph:
    """Who publishes and subscribes what in one world, and what late subscribers get."""

    def __init__(self) -> None:
        self.publishers: dict[str, list[Publisher]] = {}
        self.subscriptions: dict[str, list[Subscription]] = {}
        self.latched: dict[str, list[Any]] = {}


_graphs: "WeakKeyDictionary[World, Graph]" = WeakKeyDictionary()


class Node(NodeParameters):
    """A node as rclpy knows it; see rclpy's own documentation for each method."""

    def __init__(
        self,
        node_name: str,
        *,
        context: Context | None = None,
        cli_args: Sequence[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        rosout_qos_profile: Any = None,
        start_parameter_services: bool = True,
        parameter_overrides: Sequence[Any] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        self.program: Program = program.current()
        self.world: World = self.program.world
        self.context = context or context_of(self.program)
        if not self.context.ok():
            raise NotInitializedException
        self.executor: Any = None
        self.timers: list[Timer] = []
        self._entities: list[Entity] = []
        self._publishers: list[Publisher] = []
        self._destroyed = False
        self._default_group = MutuallyExclusiveCallbackGroup()
        self._options = self.context.options if use_global_arguments else names.RosOptions()
        if cli_args:
            own, _ = names.parse(
                cli_args if "--ros-args" in cli_args else ["--ros-args", *cli_args]
            )
            own.remaps += self._options.remaps
            own.parameters = self._options.parameters + own.parameters
            self._options = own
        self._name = self._options.name or node_name
        names.check_node_name(self._name)
        given = namespace if self._options.namespace is None else self._options.namespace
        self._namespace = (given or "").strip("/")
        self._clock = ROSClock()
        self._logger = RcutilsLogger(names.join(self._namespace, self._name).replace("/", "."))
        for logger, level in self._options.levels.items():
            self.program.log_levels[logger] = int(LoggingSeverity[level])
        self.graph, self._node = self.program.ask(self._join)
        self.authority = self._node.name
        self._start_parameters(
            self._options.parameters_for(self._name, self._namespace),
            parameter_overrides or (),
            allow_undeclared_parameters,
            automatically_declare_parameters_from_overrides,
        )
        self.program.nodes.append(self)
        if start_parameter_services:
            self._serve_parameters()

    def _join(self) -> tuple[Graph, ProgramNode]:
        graph = _graphs.setdefault(self.world, Graph())
        name = names.join(self._namespace, self._name)
        wanted, number = name, 1
        while any(other.name == name for other in self.world.nodes if other is not self.program):
            number += 1
            name = f"{wanted}_{number}"
        if name != wanted:
            self.world.log.warn(
                name,
                f"a node named '{wanted}' is here already; this one is shown as '{name}'. "
                f"Give it a name of its own: --ros-args -r __node:=…",
            )
        if self.program.name == name:
            # The executable and its node share a name, as they often do.
            self.program.name = f"{name} (program)"
        return graph, ProgramNode(self.program, name)

    # Who it is

    def get_name(self) -> str:
        """Its name."""
        return self._name

    def get_namespace(self) -> str:
        """Its namespace, with a leading slash."""
        return f"/{self._namespace}"

    def get_fully_qualified_name(self) -> str:
        """Namespace and name."""
        return f"/{names.join(self._namespace, self._name)}"

    def get_logger(self) -> RcutilsLogger:
        """Its logger."""
        return self._logger

    def get_clock(self) -> Clock:
        """Its clock."""
        return self._clock

    @property
    def default_callback_group(self) -> CallbackGroup:
        """The group of callbacks that name none."""
        return self._default_group

    @property
    def handle(self) -> "Node":
        """Itself."""
        return self

    def __enter__(self) -> "Node":
        return self

    def __exit__(self, *args: object) -> None:
        self.destroy_node()

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """A topic's full name, after remapping."""
        return f"/{self._full(topic, remap=not only_expand)}"

    resolve_service_name = resolve_topic_name

    def _full(self, name: str, *, remap: bool = True) -> str:
        full = names.expand(name, self._name, self._namespace)
        return self._options.remapped(full, self._name, self._namespace) if remap else full

    # What it has

    def create_publisher(
        self,
        msg_type: Any,
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: Any = None,
        qos_overriding_options: Any = None,
        publisher_class: Any = None,
    ) -> Publisher:
        """Something to send messages with."""
        _require_message(msg_type)
        profile, full = profile_of(qos_profile), self._full(topic)
        publisher: Publisher = self._make(lambda: Publisher(self, msg_type, topic, full, profile))
        self._publishers.append(publisher)
        return publisher

    def create_subscription(
        self,
        msg_type: Any,
        topic: str,
        callback: Callable[[Any], Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: Any = None,
        qos_overriding_options: Any = None,
        raw: bool = False,
        content_filter_options: Any = None,
    ) -> Subscription:
        """Have `callback` called with every message of a topic."""
        _require_message(msg_type)
        _require_callable(callback)
        profile, full = profile_of(qos_profile), self._full(topic)
        group = callback_group or self._default_group
        return self._keep(
            lambda: Subscription(self, msg_type, topic, full, callback, profile, group)
        )

    def create_timer(
        self,
        timer_period_sec: Any,
        callback: Callable[[], Any],
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Have `callback` called on a grid, first one period from now."""
        _require_callable(callback)
        period = period_of(timer_period_sec)
        if period < 0:
            raise ValueError("timer period must not be negative")
        group = callback_group or self._default_group
        timer: Timer = self._keep(lambda: Timer(self, callback, period, group, autostart))
        self.program.ask(lambda: self.timers.append(timer))
        return timer

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: Any = None,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Something to ask a service with."""
        _require_service(srv_type)
        full = self._full(srv_name)
        group = callback_group or self._default_group
        return self._keep(lambda: Client(self, srv_type, srv_name, full, group))

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: Any = None,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Answer a service by `callback(request, response)`."""
        _require_service(srv_type)
        _require_callable(callback)
        full = self._full(srv_name)
        group = callback_group or self._default_group
        return self._keep(lambda: Service(self, srv_type, srv_name, full, callback, group))

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Something that calls back when triggered."""
        group = callback_group or self._default_group
        return self._keep(lambda: GuardCondition(self, callback, group))

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Something to pace a loop with."""
        return Rate(frequency, self.program, lambda rate: None)

    def add_entity(self, entity: Any) -> None:
        """Have executors serve one more thing (on the loop's thread)."""
        self._entities.append(entity)

    def _make(self, make: Callable[[], Any]) -> Any:
        return self.program.ask(make)

    def _keep(self, make: Callable[[], E]) -> E:
        def made() -> E:
            entity = make()
            self._entities.append(entity)
            self.wake()
            return entity

        kept: E = self.program.ask(made)
        return kept

    def forget(self, entity: Entity) -> None:
        """Withdraw one of its things."""

        def drop() -> None:
            entity.withdraw()
            for held in (self._entities, self._publishers, self.timers):
                if entity in held:
                    held.remove(entity)  # type: ignore[arg-type]

        self.program.ask(drop)

    def _destroy(self, entity: Any) -> bool:
        self.forget(entity)
        return True

    destroy_publisher = destroy_subscription = destroy_timer = _destroy
    destroy_client = destroy_service = destroy_guard_condition = destroy_rate = _destroy

    def destroy_node(self) -> None:
        """Withdraw everything."""
        if not self._destroyed:
            self.program.ask(self.withdraw)
            if self in self.program.nodes:
                self.program.nodes.remove(self)

    @property
    def publishers(self) -> Iterable[Publisher]:
        """Its publishers."""
        yield from self._publishers

    @property
    def subscriptions(self) -> Iterable[Subscription]:
        """Its subscriptions."""
        yield from (one for one in self._entities if isinstance(one, Subscription))

    @property
    def clients(self) -> Iterable[Client]:
        """Its clients."""
        yield from (one for one in self._entities if isinstance(one, Client))

    @property
    def services(self) -> Iterable[Service]:
        """Its services."""
        yield from (one for one in self._entities if isinstance(one, Service))

    # On the loop's thread

    def entities(self) -> Iterable[Entity]:
        """Everything that can become ready, in the order an executor serves it."""
        return [*self.timers, *(one for one in self._entities if not isinstance(one, Timer))]

    def wake(self) -> None:
        """Tell whoever spins this node to look."""
        if self.executor is not None:
            self.executor.wake()

    def withdraw(self) -> None:
        """Leave the world."""
        if self._destroyed:
            return
        self._destroyed = True
        for entity in [*self._entities, *self._publishers]:
            entity.withdraw()
        self._entities.clear()
        self._publishers.clear()
        self.timers.clear()
        self.world.remove(self._node)

    def clock_now(self) -> Stamp:
        """The moment it is."""
        return self.program.clock.now()

    def late(self, full: str) -> list[Any]:
        """What a subscriber that keeps up with the past gets at once."""
        if full == "tf_static":
            transforms = self.world.static_transforms()
            return [TransformMessage(transforms, "")] if transforms else []
        return [value for kept in self.graph.latched.get(full, []) for value in kept]

    # Waiting and looking round

    def wait_for(self, future: Future, timeout_sec: float | None) -> None:
        """Block until a future is done."""
        from tftool.ros.client.executors import wait_for

        wait_for(self, future, timeout_sec)

    def wait_until(self, there: Callable[[], bool], timeout_sec: float | None) -> bool:
        """Block until something that comes and goes in the world is there; whether it is."""
        if timeout_sec is not None and timeout_sec <= 0:
            timeout_sec = 0.0
        return bool(self.program.ask(lambda: self._appears(there, timeout_sec)))

    async def _appears(self, there: Callable[[], bool], timeout_sec: float | None) -> bool:
        clock = self.program.clock
        timer = None
        if timeout_sec is not None:
            timer = clock.timer(clock.now() + int(timeout_sec * 1e9), Phase.WATCH)
        changed = asyncio.Event()
        stop = self.world.watch(changed.set)
        try:
            while not there() and self.context.ok() and (timer is None or not timer.done()):
                changed.clear()
                waiting: set[asyncio.Future[Any]] = {asyncio.ensure_future(changed.wait())}
                if timer is not None:
                    waiting.add(timer)
                try:
                    await asyncio.wait(waiting, return_when=asyncio.FIRST_COMPLETED)
                finally:
                    for one in waiting - {timer}:
                        one.cancel()
            return there()
        finally:
            stop()
            if timer is not None:
                timer.cancel()

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Block until a node is there."""
        wanted = fully_qualified_node_name.strip("/")
        return self.wait_until(
            lambda: any(one.name == wanted for one in self.world.nodes if one.is_shown), timeout
        )

    def get_node_names(self) -> list[str]:
        """The names of all nodes."""

        def names_of() -> list[str]:
            return [one.name for one in self.world.nodes if one.is_shown]

        found: list[str] = self.program.ask(names_of)
        return found

    def get_topic_names_and_types(self, no_demangle: bool = False) -> list[tuple[str, list[str]]]:
        """Every topic, and what ROS nodes exchange on it."""

        def topics() -> list[tuple[str, list[str]]]:
            found = []
            for name in sorted(self.world.topics()):
                ends = [*self.graph.publishers.get(name, []),
                        *self.graph.subscriptions.get(name, [])]  # fmt: skip
                kinds = {end.msg_type.interface__ for end in ends}
                found.append((f"/{name}", sorted(kinds) or [_ros_name(self.world, name)]))
            return found

        listed: list[tuple[str, list[str]]] = self.program.ask(topics)
        return listed

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Every service."""

        def services() -> list[tuple[str, list[str]]]:
            return [(f"/{name}", []) for name in sorted(self.world.services())]

        listed: list[tuple[str, list[str]]] = self.program.ask(services)
        return listed

    def count_publishers(self, topic_name: str) -> int:
        """How many ROS nodes publish a topic."""
        return len(self.graph.publishers.get(self._full(topic_name), []))

    def count_subscribers(self, topic_name: str) -> int:
        """How many listen to a topic."""
        full = self._full(topic_name)

        def count() -> int:
            topic = self.world.topics().get(full)
            return 0 if topic is None else topic.subscribers

        return int(self.program.ask(count))


def _ros_name(world: World, topic: str) -> str:
    kind = world.topics()[topic].kind.__name__
    return {
        "Pose2D": "turtlesim/msg/Pose",
        "Twist2D": "geometry_msgs/msg/Twist",
        "Color": "turtlesim/msg/Color",
        "TransformMessage": "tf2_msgs/msg/TFMessage",
        "PointStamped": "geometry_msgs/msg/PointStamped",
    }.get(kind, kind)


def _require_callable(callback: object) -> None:
    if not callable(callback):
        raise TypeError(f"a callback must be callable, not {type(callback).__name__}")


def _require_message(kind: object) -> None:
    if not (isinstance(kind, type) and issubclass(kind, Message)):
        raise TypeError(f"expected a message class such as std_msgs.msg.String, got {kind!r}")


def _require_service(kind: Any) -> None:
    if not (hasattr(kind, "Request") and hasattr(kind, "Response")):
        raise TypeError(f"expected a service class such as std_srvs.srv.Empty, got {kind!r}")
