"""Commands `ros2 topic …`, and functions that the other `ros2` commands use too."""

import argparse
import itertools
import re
import statistics
from collections.abc import Callable, Sequence
from copy import copy
from typing import Any

from tftool.base.errors import UsageError
from tftool.base.plain_text import did_you_mean
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES
from tftool.ros.host import program, rosidl_runtime
from tftool.ros.host.values import stamp_of
from tftool.ros.rclpy import executors
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.node_graph import get_action_names_and_types
from tftool.ros.rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)
from tftool.ros.rclpy.topics import serialize_message
from tftool.ros.rclpy.validation import topic_or_service_is_hidden

Print = Callable[[str], object]

SETTLE = seconds(0.5)
"""Time in nanoseconds to discover nodes and topics before listing them, as ROS's command does."""

PATIENCE = 10.0
"""Seconds to wait until the given node or topic appears."""


def show_lines(text: str, show: Print) -> None:
    """Call `show` with each line of a text."""
    for line in text.rstrip("\n").splitlines():
        show(line)


def discover() -> None:
    """Wait long enough to discover the nodes and topics of other processes."""
    program.current().sleep(SETTLE)


def full_name(name: str) -> str:
    """Return a name with a leading slash and without a trailing slash."""
    return f"/{name.strip('/')}"


_NAMES_AND_TYPES: dict[str, Callable[[Node], Any]] = {
    "topic": Node.get_topic_names_and_types,
    "service": Node.get_service_names_and_types,
    "action": get_action_names_and_types,
}


def names_and_types(node: Node, args: argparse.Namespace) -> Any:
    """Wait for discovery; return (name, types) of all topics, or of all services or actions."""
    discover()
    return _NAMES_AND_TYPES[args.noun](node)


def list_names(node: Node, args: argparse.Namespace, show: Print) -> None:
    """Print the names of all topics, services or actions; with `--count-…`, only their number."""
    hidden = getattr(args, f"include_hidden_{args.noun}s", False)
    pairs = names_and_types(node, args)
    seen = [one for one in pairs if hidden or not topic_or_service_is_hidden(one[0])]
    if getattr(args, f"count_{args.noun}s"):
        show(str(len(seen)))
        return
    for name, kinds in seen:
        show(f"{name} [{', '.join(kinds)}]" if args.show_types else name)


def _topic_list(node: Node, args: argparse.Namespace, show: Print) -> None:
    if not args.verbose:
        list_names(node, args, show)
        return
    pairs = names_and_types(node, args)
    for title, role, count in (
        ("Published", "publisher", node.count_publishers),
        ("\nSubscribed", "subscriber", node.count_subscribers),
    ):
        show_lines(f"{title} topics:", show)
        for name, kinds in pairs:
            hidden = topic_or_service_is_hidden(name) and not args.include_hidden_topics
            if not hidden and (number := count(name)):
                ends = f"{number} {role}{'s' if number > 1 else ''}"
                show(f" * {name} [{', '.join(kinds)}] {ends}")


def _type_of_topic(node: Node, topic: str) -> str:
    """Wait until a topic exists, and return the name of its message type.

    Raises:
        UsageError: If the topic does not appear in `PATIENCE` seconds.
    """

    def found() -> str:
        kinds = dict(node.get_topic_names_and_types()).get(full_name(topic), [])
        return kinds[0] if kinds else ""

    _wait_until(found)
    if not found():
        raise UsageError(
            f"There is no topic '{full_name(topic)}' after {PATIENCE:g} s: 'tftool ros2 topic "
            "list' lists the topics that exist."
        )
    return found()


def _wait_until(found: Callable[[], object]) -> None:
    owner = program.current()
    limit = owner.now() + seconds(PATIENCE)
    while not found() and owner.now() < limit and not owner.interrupted:
        owner.sleep(SETTLE // 5)


def _chosen_quality(args: argparse.Namespace, default: QoSProfile) -> QoSProfile:
    """Return the QoS profile that the options `--qos-…` describe.

    Settings without an option come from the profile `default`.
    """
    profile = default
    if args.qos_profile:
        profile = copy(QoSPresetProfiles[args.qos_profile.upper()].value)
    if args.qos_depth:
        profile.depth = args.qos_depth
    for name, policy in _POLICIES.items():
        wanted = getattr(args, f"qos_{name}")
        if wanted:
            setattr(profile, name, policy[wanted.upper()])
    return profile


_POLICIES: dict[str, Any] = {
    "history": HistoryPolicy,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
}


def _subscribe(node: Node, args: argparse.Namespace, callback: Callable[[Any], None]) -> None:
    """Subscribe to a topic; call `callback` with each message that passes the option --filter.

    The options `--qos-…` set the QoS profile; the default is compatible with all publishers.
    """
    name = getattr(args, "type", None) or _type_of_topic(node, args.topic)
    ends = [one.qos_profile for one in node.get_publishers_info_by_topic(full_name(args.topic))]
    latched = bool(ends) and all(one.durability is DurabilityPolicy.TRANSIENT_LOCAL for one in ends)
    reliable = all(one.reliability is ReliabilityPolicy.RELIABLE for one in ends)
    profile = QoSProfile(
        depth=100 if latched else 10,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if latched or full_name(args.topic) == "/tf_static"
        else DurabilityPolicy.VOLATILE,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
    )
    if "qos_profile" in args:
        profile = _chosen_quality(args, profile)
    # The types of topics that belong to an action or a service have no message file of their own.
    is_derived = "/action/" in name or "/srv/" in name
    kind = INTERFACES.part(name) if is_derived else rosidl_runtime.interface(name, "msg")

    def take(message: Any) -> None:
        try:
            if args.wanted is not None and not args.wanted(message):
                return
        except Exception as error:
            raise UsageError(f"the expression of --filter fails for a message: {error}") from error
        callback(message)

    node.create_subscription(kind, full_name(args.topic), take, profile)


def _topic_echo(node: Node, args: argparse.Namespace, show: Print) -> None:
    heard: list[Any] = []
    length = None if args.full_length else args.truncate_length
    short = {"truncate_length": length, "no_arr": args.no_arr, "no_str": args.no_str}

    def echo(message: Any) -> None:
        heard.append(None)
        if args.once and len(heard) > 1:
            return
        value = message if args.field is None else _field(message, args.field)
        shown = rosidl_runtime.plain(value, **short)
        if args.csv:
            show(rosidl_runtime.as_csv(shown))
            return
        show_lines(rosidl_runtime.as_yaml(shown, flow_style=args.flow_style), show)
        show("---")

    _subscribe(node, args, echo)
    while node.context.ok() and not (args.once and heard):
        executors.spin_once(node)


def _field(message: Any, path: str) -> Any:
    """Return the field of a message at a path such as "points[0].x".

    Raises:
        UsageError: If the message has no such field.
    """
    found = message
    for step in re.findall(r"[^.\[\]]+", path):
        try:
            found = found[int(step)] if step.isdecimal() else getattr(found, step)
        except (AttributeError, IndexError, TypeError):
            known = getattr(found, "fields__", ())
            hint = did_you_mean(step, [one.name for one in known])
            raise UsageError(f"{type(message).__name__} has no field '{path}'{hint}") from None
    return found


def _measure(
    node: Node,
    args: argparse.Namespace,
    measure: Callable[[Any], Any],
    report: Callable[[list[Any]], None],
) -> None:
    """Call `measure` with each message on a topic, and `report` with the results each second.

    `report` gets only the results for the last `--window` messages.
    """
    values: list[Any] = []
    _subscribe(node, args, lambda message: values.append(measure(message)))

    def each_second() -> None:
        del values[: -args.window]
        if values:
            report(values)

    node.create_timer(1.0, each_second)
    executors.spin(node)


def _spread(seconds_of_each: Sequence[float], window: int) -> str:
    return (
        f"\tmin: {min(seconds_of_each):.3f}s max: {max(seconds_of_each):.3f}s "
        f"std dev: {statistics.pstdev(seconds_of_each):.5f}s window: {window}"
    )


def _topic_hz(node: Node, args: argparse.Namespace, show: Print) -> None:
    owner = program.current()

    def tell(moments: list[int]) -> None:
        gaps = [(b - a) / 1e9 for a, b in itertools.pairwise(moments)]
        if gaps:
            show(f"average rate: {1.0 / max(statistics.fmean(gaps), 1e-9):.3f}")
            show(_spread(gaps, len(moments)))

    _measure(node, args, lambda _: owner.now(), tell)


def _topic_bw(node: Node, args: argparse.Namespace, show: Print) -> None:
    owner = program.current()

    def tell(heard: list[tuple[int, int]]) -> None:
        sizes = [size for _, size in heard]
        lasted = (owner.now() - heard[0][0]) / 1e9
        rate = sum(sizes) / max(lasted, 1e-9)
        show(f"{_bytes(rate)}/s from {len(sizes)} messages")
        show(
            f"\tMessage size mean: {_bytes(statistics.fmean(sizes))} "
            f"min: {_bytes(min(sizes))} max: {_bytes(max(sizes))}"
        )

    _measure(node, args, lambda message: (owner.now(), len(serialize_message(message))), tell)


def _bytes(number: float) -> str:
    for limit, unit in ((1e6, "MB"), (1e3, "KB")):
        if number >= limit:
            return f"{number / limit:.2f} {unit}"
    return f"{number:.0f} B"


def _topic_delay(node: Node, args: argparse.Namespace, show: Print) -> None:
    owner = program.current()

    def delay(message: Any) -> float:
        if not hasattr(message, "header"):
            raise UsageError(
                f"{type(message).__name__} has no header with a stamp, so its delay is unknown"
            )
        return float(owner.now() - stamp_of(message.header.stamp)) / 1e9

    def tell(delays: list[float]) -> None:
        show(f"average delay: {statistics.fmean(delays):.3f}")
        show(_spread(delays, len(delays)))

    _measure(node, args, delay, tell)


def _topic_info(node: Node, args: argparse.Namespace, show: Print) -> None:
    kind = _type_of_topic(node, args.topic)
    full = full_name(args.topic)
    after = [""] if args.verbose else []
    lines = [f"Type: {kind}", *after]
    for role, count, infos in (
        ("Publisher", node.count_publishers(full), node.get_publishers_info_by_topic(full)),
        ("Subscription", node.count_subscribers(full), node.get_subscriptions_info_by_topic(full)),
    ):
        lines += [f"{role} count: {count}", *after]
        for one in infos if args.verbose else ():
            lines += [*str(one).splitlines(), ""]
    for line in lines:
        show(line)


def _topic_type(node: Node, args: argparse.Namespace, show: Print) -> None:
    show(_type_of_topic(node, args.topic))


def _topic_pub(node: Node, args: argparse.Namespace, show: Print) -> None:
    times = 1 if args.once else args.times
    wanted = args.wait_matching_subscriptions
    if wanted is None:
        wanted = 1 if times else 0
    publisher = node.create_publisher(
        args.kind, args.topic, _chosen_quality(args, QoSProfile(depth=10))
    )
    if publisher.get_subscription_count() < wanted:
        show(f"Waiting for at least {wanted} matching subscription(s)...")
        while publisher.get_subscription_count() < wanted and node.context.ok():
            program.current().sleep(SETTLE // 5)
    show("publisher: beginning loop")
    sent = 0

    def publish() -> None:
        nonlocal sent
        sent += 1
        if sent % args.each == 0:
            show(f"publishing #{sent}: {args.message!r}")
        publisher.publish(args.message)

    publish()
    rate = node.create_rate(args.rate or 1.0)
    while node.context.ok() and not (times and sent >= times):
        rate.sleep()
        publish()
    # Give messages to other processes time to arrive.
    discover()
