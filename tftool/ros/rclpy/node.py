"""Class Node of rclpy, the base class of users' nodes."""

import copy
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from tftool.messages.classes import INTERFACES, Message
from tftool.ros.host import names, program
from tftool.ros.host.fibers import CodeLine, user_line
from tftool.ros.rclpy.context import Context, get_default_context
from tftool.ros.rclpy.entities import (
    CallbackGroup,
    GuardCondition,
    MutuallyExclusiveCallbackGroup,
    NodeEntity,
    RateTimer,
    Timer,
    required,
)
from tftool.ros.rclpy.exceptions import NotInitializedException, NoTypeSupportImportedException
from tftool.ros.rclpy.logging import LoggingSeverity, RcutilsLogger, logger_services
from tftool.ros.rclpy.node_graph import NodeGraph
from tftool.ros.rclpy.node_parameters import NodeParameters, services_of
from tftool.ros.rclpy.node_state import NodeState
from tftool.ros.rclpy.qos import (
    QoSOverridingOptions,
    QoSProfile,
    declare_qos_parameters,
    profile_of,
    qos_profile_rosout_default,
)
from tftool.ros.rclpy.qos_events import EndpointWatch
from tftool.ros.rclpy.services import Client, Service
from tftool.ros.rclpy.time import Clock, Duration, Rate, ROSClock
from tftool.ros.rclpy.time_source import TimeSource
from tftool.ros.rclpy.topics import Publisher, RosoutPublisher, Subscription
from tftool.ros.rclpy.validation import validate_namespace, validate_node_name

E = TypeVar("E", bound=NodeEntity)


class Node(NodeGraph, NodeParameters):
    """ROS 2 node with the methods of rclpy's Node, which rclpy's documentation describes."""

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
        owner = program.current()
        self._context = context or get_default_context()
        if not self._context.ok():
            raise NotInitializedException
        options = self._context.options if use_global_arguments else names.RosOptions()
        if cli_args:
            options = _with_arguments(options, cli_args)
        name = options.name or node_name
        validate_node_name(name)
        given = namespace if options.namespace is None else options.namespace
        place = (given or "").strip("/")
        validate_namespace(f"/{place}")
        self._default_callback_group = MutuallyExclusiveCallbackGroup()
        self._clock = ROSClock()
        self._logger = RcutilsLogger(names.join(place, name).replace("/", "."))
        for logger, level in options.levels.items():
            owner.log_levels[logger] = int(LoggingSeverity[level])
        self._tftool = NodeState(owner, name, place, options, self._context, self)
        self._start_parameters(
            self._tftool,
            options.parameters_for(name, place),
            parameter_overrides or (),
            allow_undeclared_parameters,
            automatically_declare_parameters_from_overrides,
        )
        if not owner.world.has_own_time:
            self._time_source = TimeSource(node=self)
            self._time_source.attach_clock(self._clock)
        if enable_rosout and options.logs_to_rosout:
            profile = rosout_qos_profile or qos_profile_rosout_default
            kind = INTERFACES.message("rcl_interfaces/Log")
            rosout = self._tftool.keep(RosoutPublisher, kind, "/rosout", "rosout", profile)
            rosout.logger = self._logger.name
            self._tftool.rosout = rosout
        if start_parameter_services:
            self._serve_own(partial(services_of, self))
        if enable_logger_service:
            self._serve_own(logger_services)

    if not TYPE_CHECKING:  # a type checker would accept every name

        def __getattr__(self, name: str) -> Any:
            sentence = f"'{type(self).__name__}' object has no attribute '{name}'"
            if "_tftool" not in self.__dict__:
                sentence += ": call super().__init__('its_name') before you use the node"
            raise AttributeError(sentence)

    # Names, clock and executor

    def get_name(self) -> str:
        """Return the node's name."""
        return self._tftool.name

    def get_namespace(self) -> str:
        """Return the node's namespace, with a leading slash."""
        return f"/{self._tftool.namespace}"

    def get_fully_qualified_name(self) -> str:
        """Return the node's full name: namespace and name with a leading slash."""
        return f"/{names.join(self._tftool.namespace, self._tftool.name)}"

    def get_logger(self) -> RcutilsLogger:
        """Return the node's logger."""
        return self._logger

    def get_clock(self) -> Clock:
        """Return the node's clock."""
        return self._clock

    @property
    def context(self) -> Context:
        """Context in which the node was created."""
        return self._context

    @property
    def executor(self) -> Any:
        """Executor that the node was added to; None if there is none."""
        return self._tftool.executor

    @executor.setter
    def executor(self, executor: Any) -> None:
        before = self._tftool.executor
        if before is executor:
            return
        if before is not None:
            before.remove_node(self)
        # An executor class of the user may not know that the executor has this node from now on.
        self._tftool.executor = (
            executor if executor is not None and executor.add_node(self) else None
        )

    @property
    def default_callback_group(self) -> CallbackGroup:
        """Callback group of timers, subscriptions and the like that were given no group."""
        return self._default_callback_group

    @property
    def handle(self) -> AbstractContextManager[None]:
        """Context manager that raises InvalidHandle if the node was destroyed."""
        return required(self._tftool.require)

    def __enter__(self) -> "Node":
        return self

    def __exit__(self, *args: object) -> None:
        self.destroy_node()

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return a topic's full name after remapping; with `only_expand`, before remapping."""
        return f"/{self._tftool.full(topic, remap=not only_expand)}"

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Return a service's full name after remapping; with `only_expand`, before remapping."""
        return f"/{self._tftool.full(service, remap=not only_expand, is_service=True)}"

    # Publishers, timers and other entities

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
        """Create a publisher on a topic."""
        check_is_valid_msg_type(msg_type)
        full = self._tftool.full(topic)
        profile = self.__profile(Publisher, full, qos_profile, qos_overriding_options)
        make = publisher_class or Publisher
        made: Publisher = self._tftool.keep(make, msg_type, topic, full, profile)
        self.__watch(made, callback_group, event_callbacks)
        return made

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
        """Create a subscription that calls `callback` with every message on a topic."""
        check_is_valid_msg_type(msg_type)
        _require_callable(callback)
        full = self._tftool.full(topic)
        group = callback_group or self._default_callback_group
        profile = self.__profile(Subscription, full, qos_profile, qos_overriding_options)
        made: Subscription = self._tftool.keep(
            Subscription, msg_type, topic, full, callback, profile, group, raw
        )
        self.__watch(made, group, event_callbacks)
        return made

    def __profile(
        self,
        entity_class: Any,
        full_name: str,
        profile_or_depth: QoSProfile | int,
        options: QoSOverridingOptions | None,
    ) -> QoSProfile:
        """Return the QoS profile for a new publisher or subscription.

        With `options`, also declare parameters with which the user can change the profile.
        """
        profile = profile_of(profile_or_depth)
        if options is not None:
            profile = copy.copy(profile)
            declare_qos_parameters(entity_class, self, f"/{full_name}", profile, options)
        return profile

    def __watch(self, endpoint: Any, group: Any, callbacks: Any) -> None:
        """Register the user's event callbacks of a new publisher or subscription, if any."""
        if callbacks is None:
            return
        group = group or self._default_callback_group
        endpoint.event_watch = self._tftool.keep(EndpointWatch, group, endpoint.endpoint, callbacks)

    def create_timer(
        self,
        timer_period_sec: Any,
        callback: Callable[..., Any] | None,
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Create a timer that calls `callback` once per period.

        If `callback` is None, the timer calls nothing.
        """
        if callback is None:
            self._warn_of_missing_callback(user_line(sys._getframe(1)))
        else:
            _require_callable(callback)
        period = _period_of(timer_period_sec)
        if period < 0:
            raise ValueError("timer period must not be negative")
        group = callback_group or self._default_callback_group
        goes_by = clock or self._clock
        return self._tftool.keep(Timer, callback, period, group, goes_by, autostart)

    def _warn_of_missing_callback(self, place: CodeLine | None) -> None:
        # rclpy accepts None for a timer without a callback, but in a learner's node None is a
        # mistake.
        if place is not None:
            self.get_logger().warning(
                "the callback of this timer is None, so the timer calls nothing: write "
                f"self.callback, not self.callback(), at {place}"
            )

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: Any = None,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Create a client of a service."""
        check_is_valid_srv_type(srv_type)
        full = self._tftool.full(srv_name, is_service=True)
        group = callback_group or self._default_callback_group
        return self._tftool.keep(Client, srv_type, srv_name, full, group)

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: Any = None,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Create a service that calls `callback(request, response)`."""
        check_is_valid_srv_type(srv_type)
        _require_callable(callback)
        full = self._tftool.full(srv_name, is_service=True)
        group = callback_group or self._default_callback_group
        return self._tftool.keep(Service, srv_type, srv_name, full, callback, group)

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Create a guard condition that calls `callback` after each trigger."""
        group = callback_group or self._default_callback_group
        return self._tftool.keep(GuardCondition, callback, group)

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Create a rate, whose method `sleep` makes a loop run `frequency` times per second.

        Raises:
            InvalidHandle: If the node is destroyed.
            ValueError: If the frequency is not above 0.
        """
        self._tftool.require()
        if frequency <= 0:
            raise ValueError("frequency must be greater than 0")
        period, goes_by = _period_of(1.0 / frequency), clock or self._clock
        timer = self._tftool.keep(RateTimer, None, period, None, goes_by)
        return Rate(self._tftool, timer)

    def destroy_rate(self, rate: Rate) -> bool:
        """Destroy a rate; return False if the rate does not belong to this node."""
        return self._tftool.forget(rate.timer)

    def _serve_own(
        self,
        services: Callable[[], Iterable[tuple[str, Any, Callable[[Any, Any], Any]]]],
        callback_group: CallbackGroup | None = None,
    ) -> None:
        """Create services that every ROS 2 node has, such as the services for its parameters.

        The services are created when a program first looks up a service in the world. A service is
        not created if another node of the same name already offers this service.

        `services` returns tuples (name below the node's name, type, handler).
        """
        state = self._tftool
        group = callback_group or self._default_callback_group

        def offer() -> None:
            for below, kind, answer in services():
                full = state.full(f"~/{below}", is_service=True)
                if not state.world.has_service(full):
                    state.add(Service, kind, f"~/{below}", full, answer, group)

        state.program.ask(partial(state.world.serve_later, state.node, offer))

    def __destroy(self, entity: Any) -> bool:
        return self._tftool.forget(entity)

    destroy_publisher = destroy_subscription = destroy_timer = __destroy
    destroy_client = destroy_service = destroy_guard_condition = __destroy

    def destroy_node(self) -> None:
        """Destroy the node and all its publishers, subscriptions, timers, clients and services."""
        self._tftool.destroy_node()

    @property
    def publishers(self) -> Iterator[Publisher]:
        """Publishers of the node; as in ROS 2, without the publisher of log messages on /rosout."""
        rosout = self._tftool.rosout
        yield from (one for one in self.__all(Publisher) if one is not rosout)

    @property
    def services(self) -> Iterator[Service]:
        """Services of the node."""
        self._tftool.program.ask(self._tftool.world.services)  # which creates the node's own ones
        yield from self.__all(Service)

    def __all(self, kind: type[E]) -> Iterator[E]:
        yield from [one for one in self._tftool.entities if isinstance(one, kind)]

    subscriptions = property(partial(__all, kind=Subscription))
    clients = property(partial(__all, kind=Client))
    timers = property(partial(__all, kind=Timer))
    guards = property(partial(__all, kind=GuardCondition))


def _with_arguments(options: names.RosOptions, cli_args: Sequence[str]) -> names.RosOptions:
    words = cli_args if "--ros-args" in cli_args else ["--ros-args", *cli_args]
    own, _ = names.parse(words)
    own.remaps += options.remaps
    own.parameters = options.parameters + own.parameters
    return own


def _require_callable(callback: object) -> None:
    if not callable(callback):
        raise TypeError(f"a callback must be callable, not {type(callback).__name__}")


def _period_of(seconds_or_duration: Any) -> int:
    """Return the nanoseconds in a timer's period, which is given in seconds or as a Duration."""
    if isinstance(seconds_or_duration, Duration):
        return seconds_or_duration.nanoseconds
    return int(float(seconds_or_duration) * 1_000_000_000)


def create_node(node_name: str, **kwargs: Any) -> Node:
    """Return a new `Node` with the given name; `kwargs` are further arguments of `Node`."""
    return Node(node_name, **kwargs)


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Check that a class is a message, service or action type.

    Raises:
        AttributeError: If the class is not generated from an interface definition.
        NoTypeSupportImportedException: If tftool does not know the definition.
    """
    if not (isinstance(msg_or_srv_type, type) and hasattr(msg_or_srv_type, "interface__")):
        _ = type(msg_or_srv_type)._TYPE_SUPPORT
        raise NoTypeSupportImportedException


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Check that a class is a message type.

    Raises:
        RuntimeError: If the class is not a message type.
    """
    if not (isinstance(msg_type, type) and issubclass(msg_type, Message)):
        raise RuntimeError(
            f"expected a message class such as std_msgs.msg.String, got {msg_type!r}"
        )


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Check that a class is a service type.

    Raises:
        RuntimeError: If the class is not a service type.
    """
    if not (hasattr(srv_type, "Request") and hasattr(srv_type, "Response")):
        raise RuntimeError(f"expected a service class such as std_srvs.srv.Empty, got {srv_type!r}")
