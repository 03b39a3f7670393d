"""What `ros2 topic`, `service`, `param`, `node`, `action`, `interface` and `pkg` do, as a program.

It is a program of the world like any node: `tftool ros2 …` starts it, and launch files that
execute `ros2` get it without a process of its own.
"""

import argparse
import itertools
import statistics
from collections.abc import Callable, Sequence
from typing import Any

from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES
from tftool.messages.parameter_values import value_of
from tftool.messages.turtle_messages import interface_name
from tftool.ros.host import names, program, ros2_words
from tftool.ros.host.workspace import Workspace
from tftool.ros.rclpy import core
from tftool.ros.rclpy.action_client import ActionClient
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.parameter_client import AsyncParameterClient
from tftool.ros.rclpy.parameters import Parameter
from tftool.ros.rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from tftool.ros.rclpy.validation import topic_or_service_is_hidden

Print = Callable[[str], object]

NAME = "_ros2cli"
"""The node's name; a leading underscore hides it from lists, as in ROS."""

SETTLE = seconds(0.5)
"""How long the graph is listened to before it is listed, as ROS's own command does."""

PATIENCE = 10.0
"""Seconds to wait for a node or a topic that is named."""

UNKNOWN = 1
"""Exit status when what was named is not there."""


def body(words: Sequence[str], workspace: Workspace, show: Print) -> Callable[[], None]:
    """What runs `ros2 WORDS`, for a `Program`; it prints by `show`.

    Raises:
        UsageError: If the words are no command, or a type they name is not known.
    """
    asked = ros2_words.parse(words)
    run: Callable[[Node, argparse.Namespace, Print], object] | None
    if (asked.noun, asked.verb) == ("interface", "show"):
        text = ros2_words.definition(asked.type)
        return lambda: _show_lines(text, show)
    if (asked.noun, asked.verb) == ("pkg", "list"):
        known = sorted({*workspace.packages, *INTERFACES.packages()})
        return lambda: _show_lines("\n".join(known), show)
    run = _COMMANDS[asked.noun, asked.verb]
    if "values" in asked:
        asked.message = _message(asked)

    def work() -> None:
        core.init()
        node = core.create_node(NAME, start_parameter_services=False, use_global_arguments=False)
        try:
            status = run(node, asked, show)
        finally:
            node.destroy_node()
        if status:
            raise SystemExit(status)

    return work


def _show_lines(text: str, show: Print) -> None:
    for line in text.rstrip("\n").splitlines():
        show(line)


def _message(asked: argparse.Namespace) -> Any:
    """What is to be sent, made of its YAML text.

    Raises:
        UsageError: If it does not fit its type.
    """
    kind = {"topic": "msg", "service": "srv", "action": "action"}[asked.noun]
    asked.kind = ros2_words.interface(asked.type, kind)
    part = {"msg": asked.kind}.get(kind) or getattr(
        asked.kind, "Request" if kind == "srv" else "Goal"
    )
    made = part()
    ros2_words.fill(made, names.yaml_value(asked.values))
    return made


def _listen(node: Node) -> None:
    program.current().sleep(SETTLE)


def _full(name: str) -> str:
    return f"/{name.strip('/')}"


def _list(pairs: Any, asked: argparse.Namespace, show: Print, *, hidden: bool) -> None:
    for name, kinds in pairs:
        if hidden or not topic_or_service_is_hidden(name):
            show(f"{name} [{', '.join(kinds)}]" if asked.show_types else name)


# Topics


def _topic_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    pairs = node.get_topic_names_and_types()
    _list(pairs, asked, show, hidden=asked.include_hidden_topics)


def _type_of_topic(node: Node, topic: str) -> str:
    """A topic's type, waited for.

    Raises:
        UsageError: If the topic does not appear.
    """

    def found() -> str:
        kinds = dict(node.get_topic_names_and_types()).get(_full(topic), [])
        return kinds[0] if kinds else ""

    _wait_until(found)
    if not found():
        raise UsageError(
            f"There is no topic '{_full(topic)}' after {PATIENCE:g} s: 'tftool ros2 topic list' "
            "lists them."
        )
    return found()


def _wait_until(found: Callable[[], object]) -> None:
    owner = program.current()
    limit = owner.now() + seconds(PATIENCE)
    while not found() and owner.now() < limit and not owner.interrupted:
        owner.sleep(SETTLE // 5)


def _heard(node: Node, asked: argparse.Namespace, callback: Callable[[Any], None]) -> None:
    """Subscribe to a topic as those who publish it do."""
    name = getattr(asked, "type", None) or _type_of_topic(node, asked.topic)
    ends = [one.qos_profile for one in node.get_publishers_info_by_topic(_full(asked.topic))]
    latched = bool(ends) and all(one.durability is DurabilityPolicy.TRANSIENT_LOCAL for one in ends)
    reliable = all(one.reliability is ReliabilityPolicy.RELIABLE for one in ends)
    profile = QoSProfile(
        depth=100 if latched else 10,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if latched or _full(asked.topic) == "/tf_static"
        else DurabilityPolicy.VOLATILE,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
    )
    # What a topic carries behind an action or a service is no message of its own file.
    is_derived = "/action/" in name or "/srv/" in name
    kind = INTERFACES.part(name) if is_derived else ros2_words.interface(name, "msg")
    node.create_subscription(kind, _full(asked.topic), callback, profile)


def _topic_echo(node: Node, asked: argparse.Namespace, show: Print) -> None:
    import yaml

    heard: list[Any] = []

    def echo(message: Any) -> None:
        heard.append(None)
        if asked.once and len(heard) > 1:
            return
        _show_lines(yaml.safe_dump(ros2_words.plain(message), sort_keys=False), show)
        show("---")

    _heard(node, asked, echo)
    while core.ok() and not (asked.once and heard):
        core.spin_once(node)


def _topic_hz(node: Node, asked: argparse.Namespace, show: Print) -> None:
    owner = program.current()
    moments: list[int] = []
    _heard(node, asked, lambda _: moments.append(owner.now()))

    def tell() -> None:
        gaps = [(b - a) / 1e9 for a, b in itertools.pairwise(moments)]
        del moments[:-10_000]
        if not gaps:
            return
        show(f"average rate: {1.0 / max(statistics.fmean(gaps), 1e-9):.3f}")
        show(
            f"\tmin: {min(gaps):.3f}s max: {max(gaps):.3f}s "
            f"std dev: {statistics.pstdev(gaps):.5f}s window: {len(moments)}"
        )

    node.create_timer(1.0, tell)
    core.spin(node)


def _topic_info(node: Node, asked: argparse.Namespace, show: Print) -> None:
    kind = _type_of_topic(node, asked.topic)
    full = _full(asked.topic)
    show(f"Type: {kind}")
    for role, count, infos in (
        ("Publisher", node.count_publishers(full), node.get_publishers_info_by_topic(full)),
        ("Subscription", node.count_subscribers(full), node.get_subscriptions_info_by_topic(full)),
    ):
        show(f"{role} count: {count}")
        for one in infos if asked.verbose else ():
            show(f"  Node: {one.node_namespace.rstrip('/')}/{one.node_name} ({one.topic_type})")


def _topic_type(node: Node, asked: argparse.Namespace, show: Print) -> None:
    show(_type_of_topic(node, asked.topic))


def _topic_pub(node: Node, asked: argparse.Namespace, show: Print) -> None:
    times = 1 if asked.once else asked.times
    wanted = asked.wait_matching_subscriptions
    if wanted is None:
        wanted = 1 if times else 0
    publisher = node.create_publisher(asked.kind, asked.topic, 10)
    if publisher.get_subscription_count() < wanted:
        show(f"Waiting for at least {wanted} matching subscription(s)...")
        while publisher.get_subscription_count() < wanted and core.ok():
            program.current().sleep(SETTLE // 5)
    show("publisher: beginning loop")
    sent = 0

    def publish() -> None:
        nonlocal sent
        sent += 1
        show(f"publishing #{sent}: {asked.message!r}")
        publisher.publish(asked.message)

    publish()
    rate = node.create_rate(asked.rate)
    while core.ok() and not (times and sent >= times):
        rate.sleep()
        publish()
    # What is on its way to another process is given time to arrive.
    _listen(node)


# Services, parameters, nodes, actions


def _service_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    pairs = node.get_service_names_and_types()
    _list(pairs, asked, show, hidden=asked.include_hidden_services)


def _service_type(node: Node, asked: argparse.Namespace, show: Print) -> int:
    _listen(node)
    kinds = dict(node.get_service_names_and_types()).get(_full(asked.service), [])
    for kind in kinds:
        show(kind)
    return 0 if kinds else UNKNOWN


def _service_call(node: Node, asked: argparse.Namespace, show: Print) -> None:
    client = node.create_client(asked.kind, asked.service)
    if not client.service_is_ready():
        show("waiting for service to become available...")
        client.wait_for_service()
    show(f"requester: making request: {asked.message!r}")
    show("")
    response = client.call(asked.message)
    show("response:")
    show(repr(response))


def _parameters(node: Node, name: str) -> AsyncParameterClient:
    """What asks a node for its parameters.

    Raises:
        UsageError: If the node does not answer.
    """
    client = AsyncParameterClient(node, _full(name))
    if not client.wait_for_services(PATIENCE):
        raise UsageError(f"Node '{_full(name)}' is not there, or has no parameters.")
    return client


def _answer(node: Node, future: Any) -> Any:
    core.spin_until_future_complete(node, future)
    return future.result()


def _names_of_parameters(node: Node, client: AsyncParameterClient) -> list[str]:
    return sorted(_answer(node, client.list_parameters()).result.names)


def _param_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    if asked.node is not None:
        for name in _names_of_parameters(node, _parameters(node, asked.node)):
            show(f"  {name}")
        return
    _listen(node)
    for name, kinds in node.get_service_names_and_types():
        owner, _, service = name.rpartition("/")
        if service == "list_parameters" and kinds == ["rcl_interfaces/srv/ListParameters"]:
            show(f"{owner}:")
            for parameter in _names_of_parameters(node, _parameters(node, owner)):
                show(f"  {parameter}")


_WORDS = {
    bool: "Boolean",
    int: "Integer",
    float: "Double",
    str: "String",
}


def _values_of(node: Node, client: AsyncParameterClient, wanted: list[str]) -> list[Any]:
    return [value_of(one) for one in _answer(node, client.get_parameters(wanted)).values]


def _param_get(node: Node, asked: argparse.Namespace, show: Print) -> int:
    client = _parameters(node, asked.node)
    (value,) = _values_of(node, client, [asked.name]) or [None]
    if value is None:
        show("Parameter not set")
        return UNKNOWN
    show(f"{_WORDS.get(type(value), 'Array')} value is: {value}")
    return 0


def _param_set(node: Node, asked: argparse.Namespace, show: Print) -> int:
    client = _parameters(node, asked.node)
    value = names.yaml_value(asked.value)
    (result,) = _answer(node, client.set_parameters([Parameter(asked.name, value=value)])).results
    if result.successful:
        show("Set parameter successful")
        return 0
    show(f"Setting parameter failed: {result.reason}")
    return UNKNOWN


def _param_dump(node: Node, asked: argparse.Namespace, show: Print) -> None:
    import yaml

    client = _parameters(node, asked.node)
    known = _names_of_parameters(node, client)
    whole: dict[str, Any] = {}
    for name, value in zip(known, _values_of(node, client, known), strict=True):
        *folders, last = name.split(".")
        below = whole
        for folder in folders:
            below = below.setdefault(folder, {})
        below[last] = value
    dumped = {_full(asked.node): {"ros__parameters": whole}}
    _show_lines(yaml.safe_dump(dumped, sort_keys=False), show)


def _node_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    for name, namespace in sorted(node.get_node_names_and_namespaces(), key=lambda one: one[::-1]):
        if asked.all or not topic_or_service_is_hidden(name):
            show(f"{namespace.rstrip('/')}/{name}")


def _node_info(node: Node, asked: argparse.Namespace, show: Print) -> int:
    full = _full(asked.node)
    if not node.wait_for_node(full, PATIENCE):
        raise UsageError(f"There is no node '{full}': 'tftool ros2 node list' lists them.")
    namespace, _, name = full.rpartition("/")
    of = (name, namespace or "/")
    show(full)
    for title, pairs in (
        ("Subscribers", node.get_subscriber_names_and_types_by_node(*of)),
        ("Publishers", node.get_publisher_names_and_types_by_node(*of)),
        ("Service Servers", node.get_service_names_and_types_by_node(*of)),
        ("Service Clients", node.get_client_names_and_types_by_node(*of)),
    ):
        show(f"  {title}:")
        for one, kinds in pairs:
            show(f"    {one}: {', '.join(kinds)}")
    return 0


def _action_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    world = program.current().world
    offers = program.current().ask(lambda: [(k, v.kind) for k, v in world.actions().items()])
    pairs = [(f"/{name}", [interface_name(kind)]) for name, kind in sorted(offers)]
    _list(pairs, asked, show, hidden=False)


def _action_send_goal(node: Node, asked: argparse.Namespace, show: Print) -> int:
    import yaml

    def dump(message: Any) -> None:
        text = yaml.safe_dump(ros2_words.plain(message), sort_keys=False)
        for line in text.rstrip("\n").splitlines():
            show(f"    {line}")

    def on_feedback(message: Any) -> None:
        show("Feedback:")
        dump(message.feedback)

    client = ActionClient(node, asked.kind, asked.action)
    if not client.server_is_ready():
        show("Waiting for an action server to become available...")
        client.wait_for_server()
    show("Sending goal:")
    dump(asked.message)
    feedback = on_feedback if asked.feedback else None
    handle = _answer(node, client.send_goal_async(asked.message, feedback_callback=feedback))
    if not handle.accepted:
        show("Goal was rejected.")
        return UNKNOWN
    show("Goal accepted")
    wrapped = _answer(node, handle.get_result_async())
    show("Result:")
    dump(wrapped.result)
    show(f"Goal finished with status: {_STATUSES.get(wrapped.status, wrapped.status)}")
    return 0


_STATUSES = {4: "SUCCEEDED", 5: "CANCELED", 6: "ABORTED"}

_COMMANDS: dict[tuple[str, str], Callable[[Node, argparse.Namespace, Print], object]] = {
    ("topic", "list"): _topic_list,
    ("topic", "echo"): _topic_echo,
    ("topic", "hz"): _topic_hz,
    ("topic", "info"): _topic_info,
    ("topic", "type"): _topic_type,
    ("topic", "pub"): _topic_pub,
    ("service", "list"): _service_list,
    ("service", "type"): _service_type,
    ("service", "call"): _service_call,
    ("param", "list"): _param_list,
    ("param", "get"): _param_get,
    ("param", "set"): _param_set,
    ("param", "dump"): _param_dump,
    ("node", "list"): _node_list,
    ("node", "info"): _node_info,
    ("action", "list"): _action_list,
    ("action", "send_goal"): _action_send_goal,
}
