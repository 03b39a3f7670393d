"""Commands `ros2 topic`, `service`, `param`, `node`, `action`, `interface` and `pkg`.

`ros2` is a program of tftool's world like any node: `tftool ros2 …` starts it, and launch files
that execute `ros2` run it without a separate process.
"""

import argparse
import itertools
import re
import statistics
import textwrap
from collections.abc import Callable, Sequence
from copy import copy
from typing import Any

from tftool.base.errors import UsageError
from tftool.base.plain_text import did_you_mean
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES
from tftool.ros.host import executables, names, program, ros2_words, rosidl_runtime
from tftool.ros.host.package_files import read_text
from tftool.ros.host.values import stamp_of
from tftool.ros.host.workspace import Workspace
from tftool.ros.rclpy import core
from tftool.ros.rclpy.action_client import ActionClient
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.node_graph import (
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)
from tftool.ros.rclpy.parameter import Parameter, parameter_dict_from_yaml_file
from tftool.ros.rclpy.parameter_client import AsyncParameterClient
from tftool.ros.rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)
from tftool.ros.rclpy.topics import serialize_message
from tftool.ros.rclpy.validation import topic_or_service_is_hidden
from tftool.world.node_parameters import value_of

Print = Callable[[str], object]

NAME = "_ros2cli"
"""Name of the command's own node; as in ROS, the underscore hides it from lists."""

SETTLE = seconds(0.5)
"""Time in nanoseconds to discover nodes and topics before listing them, as ROS's command does."""

PATIENCE = 10.0
"""Seconds to wait until the given node or topic appears."""

_STATUSES = {4: "SUCCEEDED", 5: "CANCELED", 6: "ABORTED"}

UNKNOWN = 1
"""Exit status if the given node, topic or parameter does not exist."""


def body(words: Sequence[str], workspace: Workspace, show: Print) -> Callable[[], None]:
    """Return the function of a `Program` that runs `ros2 WORDS` and prints lines by calling `show`.

    Raises:
        UsageError: If there is no such command, or a type in the words is not known.
    """
    asked = ros2_words.parse(words)
    # A command is the function of its name here: `_topic_list` is `ros2 topic list`.
    run: Any = globals()[f"_{asked.noun}_{asked.verb}"]
    if asked.noun in ros2_words.SESSIONLESS:
        text = run(asked, workspace)
        return lambda: _show_lines(text, show)
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
    """Create the message that a command line describes by a type and YAML text.

    Raises:
        UsageError: If the YAML text does not describe a message of the type.
    """
    kind = {"topic": "msg", "service": "srv", "action": "action"}[asked.noun]
    asked.kind = rosidl_runtime.interface(asked.type, kind)
    part = {"msg": asked.kind}.get(kind) or getattr(
        asked.kind, "Request" if kind == "srv" else "Goal"
    )
    made = part()
    rosidl_runtime.fill(made, names.yaml_value(asked.values))
    return made


def _listen(node: Node) -> None:
    program.current().sleep(SETTLE)


def _full(name: str) -> str:
    return f"/{name.strip('/')}"


def _list(pairs: Any, asked: argparse.Namespace, show: Print, *, hidden: bool) -> None:
    seen = [(name, kinds) for name, kinds in pairs
            if hidden or not topic_or_service_is_hidden(name)]  # fmt: skip
    if getattr(asked, f"count_{asked.noun}s"):
        show(str(len(seen)))
        return
    for name, kinds in seen:
        show(f"{name} [{', '.join(kinds)}]" if asked.show_types else name)


# Topics


def _topic_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    pairs = node.get_topic_names_and_types()
    if not asked.verbose:
        _list(pairs, asked, show, hidden=asked.include_hidden_topics)
        return
    for title, role, count in (
        ("Published", "publisher", node.count_publishers),
        ("\nSubscribed", "subscriber", node.count_subscribers),
    ):
        _show_lines(f"{title} topics:", show)
        for name, kinds in pairs:
            hidden = topic_or_service_is_hidden(name) and not asked.include_hidden_topics
            if not hidden and (number := count(name)):
                ends = f"{number} {role}{'s' if number > 1 else ''}"
                show(f" * {name} [{', '.join(kinds)}] {ends}")


def _type_of_topic(node: Node, topic: str) -> str:
    """Wait until a topic exists, and return the name of its type.

    Raises:
        UsageError: If the topic does not appear in time.
    """

    def found() -> str:
        kinds = dict(node.get_topic_names_and_types()).get(_full(topic), [])
        return kinds[0] if kinds else ""

    _wait_until(found)
    if not found():
        raise UsageError(
            f"There is no topic '{_full(topic)}' after {PATIENCE:g} s: 'tftool ros2 topic list' "
            "lists the topics that exist."
        )
    return found()


def _wait_until(found: Callable[[], object]) -> None:
    owner = program.current()
    limit = owner.now() + seconds(PATIENCE)
    while not found() and owner.now() < limit and not owner.interrupted:
        owner.sleep(SETTLE // 5)


def _wanted_quality(asked: argparse.Namespace, otherwise: QoSProfile) -> QoSProfile:
    """Return the QoS profile of the `--qos-…` options; `otherwise` gives the other settings."""
    profile = otherwise
    if asked.qos_profile:
        profile = copy(QoSPresetProfiles[asked.qos_profile.upper()].value)
    if asked.qos_depth:
        profile.depth = asked.qos_depth
    for name, policy in _POLICIES.items():
        wanted = getattr(asked, f"qos_{name}")
        if wanted:
            setattr(profile, name, policy[wanted.upper()])
    return profile


_POLICIES: dict[str, Any] = {
    "history": HistoryPolicy,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
}


def _heard(node: Node, asked: argparse.Namespace, callback: Callable[[Any], None]) -> None:
    """Subscribe to a topic; call `callback` with each message that passes --filter.

    The QoS profile is that of the `--qos-…` options; without options, it fits the publishers.
    """
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
    if "qos_profile" in asked:
        profile = _wanted_quality(asked, profile)
    # What a topic carries behind an action or a service is no message of its own file.
    is_derived = "/action/" in name or "/srv/" in name
    kind = INTERFACES.part(name) if is_derived else rosidl_runtime.interface(name, "msg")

    def take(message: Any) -> None:
        try:
            if asked.wanted is not None and not asked.wanted(message):
                return
        except Exception as error:
            raise UsageError(f"the expression of --filter fails for a message: {error}") from error
        callback(message)

    node.create_subscription(kind, _full(asked.topic), take, profile)


def _topic_echo(node: Node, asked: argparse.Namespace, show: Print) -> None:
    heard: list[Any] = []
    length = None if asked.full_length else asked.truncate_length
    short = {"truncate_length": length, "no_arr": asked.no_arr, "no_str": asked.no_str}

    def echo(message: Any) -> None:
        heard.append(None)
        if asked.once and len(heard) > 1:
            return
        value = message if asked.field is None else _field(message, asked.field)
        shown = rosidl_runtime.plain(value, **short)
        if asked.csv:
            show(rosidl_runtime.as_csv(shown))
            return
        _show_lines(rosidl_runtime.as_yaml(shown, flow_style=asked.flow_style), show)
        show("---")

    _heard(node, asked, echo)
    while core.ok() and not (asked.once and heard):
        core.spin_once(node)


def _field(message: Any, path: str) -> Any:
    """Return a message's field, given by a path such as "points[0].x".

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


def _measured(
    node: Node,
    asked: argparse.Namespace,
    value: Callable[[Any], Any],
    tell: Callable[[list[Any]], None],
) -> None:
    """Compute `value` for each message of a topic; once a second, call `tell` with the values.

    Only the last `--window` values are used.
    """
    values: list[Any] = []
    _heard(node, asked, lambda message: values.append(value(message)))

    def each_second() -> None:
        del values[: -asked.window]
        if values:
            tell(values)

    node.create_timer(1.0, each_second)
    core.spin(node)


def _spread(seconds_of_each: Sequence[float], window: int) -> str:
    return (
        f"\tmin: {min(seconds_of_each):.3f}s max: {max(seconds_of_each):.3f}s "
        f"std dev: {statistics.pstdev(seconds_of_each):.5f}s window: {window}"
    )


def _topic_hz(node: Node, asked: argparse.Namespace, show: Print) -> None:
    owner = program.current()

    def tell(moments: list[int]) -> None:
        gaps = [(b - a) / 1e9 for a, b in itertools.pairwise(moments)]
        if gaps:
            show(f"average rate: {1.0 / max(statistics.fmean(gaps), 1e-9):.3f}")
            show(_spread(gaps, len(moments)))

    _measured(node, asked, lambda _: owner.now(), tell)


def _topic_bw(node: Node, asked: argparse.Namespace, show: Print) -> None:
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

    _measured(node, asked, lambda message: (owner.now(), len(serialize_message(message))), tell)


def _bytes(number: float) -> str:
    for limit, unit in ((1e6, "MB"), (1e3, "KB")):
        if number >= limit:
            return f"{number / limit:.2f} {unit}"
    return f"{number:.0f} B"


def _topic_delay(node: Node, asked: argparse.Namespace, show: Print) -> None:
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

    _measured(node, asked, delay, tell)


def _find(pairs: Any, kind: str, show: Print) -> None:
    """Print the names whose types include `kind`: "package/msg/Name" or "package/Name"."""
    parts = kind.split("/")
    for name, kinds in pairs:
        if any(kind == one or parts == [one.split("/")[0], one.split("/")[-1]] for one in kinds):
            show(name)


def _topic_find(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    _find(node.get_topic_names_and_types(), asked.type, show)


def _topic_info(node: Node, asked: argparse.Namespace, show: Print) -> None:
    kind = _type_of_topic(node, asked.topic)
    full = _full(asked.topic)
    after = [""] if asked.verbose else []
    lines = [f"Type: {kind}", *after]
    for role, count, infos in (
        ("Publisher", node.count_publishers(full), node.get_publishers_info_by_topic(full)),
        ("Subscription", node.count_subscribers(full), node.get_subscriptions_info_by_topic(full)),
    ):
        lines += [f"{role} count: {count}", *after]
        for one in infos if asked.verbose else ():
            lines += [*str(one).splitlines(), ""]
    for line in lines:
        show(line)


def _topic_type(node: Node, asked: argparse.Namespace, show: Print) -> None:
    show(_type_of_topic(node, asked.topic))


def _topic_pub(node: Node, asked: argparse.Namespace, show: Print) -> None:
    times = 1 if asked.once else asked.times
    wanted = asked.wait_matching_subscriptions
    if wanted is None:
        wanted = 1 if times else 0
    publisher = node.create_publisher(
        asked.kind, asked.topic, _wanted_quality(asked, QoSProfile(depth=10))
    )
    if publisher.get_subscription_count() < wanted:
        show(f"Waiting for at least {wanted} matching subscription(s)...")
        while publisher.get_subscription_count() < wanted and core.ok():
            program.current().sleep(SETTLE // 5)
    show("publisher: beginning loop")
    sent = 0

    def publish() -> None:
        nonlocal sent
        sent += 1
        if sent % asked.each == 0:
            show(f"publishing #{sent}: {asked.message!r}")
        publisher.publish(asked.message)

    publish()
    rate = node.create_rate(asked.rate or 1.0)
    while core.ok() and not (times and sent >= times):
        rate.sleep()
        publish()
    # Messages on their way to another process are given time to arrive.
    _listen(node)


# Services, parameters, nodes, actions


def _service_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    pairs = node.get_service_names_and_types()
    _list(pairs, asked, show, hidden=asked.include_hidden_services)


def _show_types(pairs: Any, name: str, show: Print) -> int:
    kinds = dict(pairs).get(_full(name), [])
    for kind in kinds:
        show(kind)
    return 0 if kinds else UNKNOWN


def _service_type(node: Node, asked: argparse.Namespace, show: Print) -> int:
    _listen(node)
    return _show_types(node.get_service_names_and_types(), asked.service, show)


def _service_info(node: Node, asked: argparse.Namespace, show: Print) -> int:
    _listen(node)
    full = _full(asked.service)
    kinds = dict(node.get_service_names_and_types()).get(full, [])
    show(f"Type: {', '.join(kinds) or 'unknown'}")
    show(f"Clients count: {node.count_clients(full)}")
    show(f"Services count: {node.count_services(full)}")
    return 0 if kinds else UNKNOWN


def _service_find(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    _find(node.get_service_names_and_types(), asked.type, show)


def _service_call(node: Node, asked: argparse.Namespace, show: Print) -> None:
    client = node.create_client(asked.kind, asked.service)
    if not client.service_is_ready():
        show("waiting for service to become available...")
        client.wait_for_service()
    rate = None if asked.rate is None else node.create_rate(asked.rate)
    while True:
        show(f"requester: making request: {asked.message!r}")
        show("")
        response = client.call(asked.message)
        show("response:")
        show(repr(response))
        if rate is None or not core.ok():
            return
        rate.sleep()


def _parameters(node: Node, name: str) -> AsyncParameterClient:
    """Return a client for the parameters of a node.

    Raises:
        UsageError: If the node's parameter services do not appear in time.
    """
    client = AsyncParameterClient(node, _full(name))
    if not client.wait_for_services(PATIENCE):
        raise UsageError(
            f"Node '{_full(name)}' does not exist, or has no parameters: 'tftool ros2 node list' "
            "lists the nodes."
        )
    return client


def _answer(node: Node, future: Any) -> Any:
    core.spin_until_future_complete(node, future)
    return future.result()


def _names_of_parameters(node: Node, client: AsyncParameterClient) -> list[str]:
    return sorted(_answer(node, client.list_parameters()).result.names)


def _param_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    def each(owner: str) -> None:
        client = _parameters(node, owner)
        known = _names_of_parameters(node, client)
        if not asked.param_type:
            _show_lines("\n".join(f"  {name}" for name in known), show)
            return
        for one in _answer(node, client.describe_parameters(known)).descriptors:
            show(f"  {one.name} (type: {_TYPES.get(one.type, 'not set')})")

    if asked.node is not None:
        each(asked.node)
        return
    _listen(node)
    for name, kinds in node.get_service_names_and_types():
        owner, _, service = name.rpartition("/")
        if service == "list_parameters" and kinds == ["rcl_interfaces/srv/ListParameters"]:
            show(f"{owner}:")
            each(owner)


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
    shown = "" if asked.hide_type else f"{_WORDS.get(type(value), 'Array')} value is: "
    show(f"{shown}{value}")
    return 0


def _param_set(node: Node, asked: argparse.Namespace, show: Print) -> int:
    client = _parameters(node, asked.node)
    value = names.yaml_value(asked.value)
    (result,) = _answer(node, client.set_parameters([Parameter(asked.name, value=value)])).results
    failed = f"Setting parameter failed: {result.reason}"
    show("Set parameter successful" if result.successful else failed)
    return 0 if result.successful else UNKNOWN


def _param_delete(node: Node, asked: argparse.Namespace, show: Print) -> int:
    client = _parameters(node, asked.node)
    (result,) = _answer(node, client.delete_parameters([asked.name])).results
    failed = f"Deleting parameter failed: {result.reason}"
    show("Deleted parameter successfully" if result.successful else failed)
    return 0 if result.successful else UNKNOWN


def _param_dump(node: Node, asked: argparse.Namespace, show: Print) -> None:
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
    _show_lines(rosidl_runtime.as_yaml(dumped), show)


def _param_describe(node: Node, asked: argparse.Namespace, show: Print) -> None:
    client = _parameters(node, asked.node)
    for one in _answer(node, client.describe_parameters(asked.names)).descriptors:
        show(f"Parameter name: {one.name}")
        show(f"  Type: {_TYPES.get(one.type, 'not set')}")
        if one.description:
            show(f"  Description: {one.description}")
        show("  Constraints:")
        if one.read_only:
            show("    Read only: true")
        for span in [*one.integer_range, *one.floating_point_range]:
            show(f"    Min value: {span.from_value}")
            show(f"    Max value: {span.to_value}")
            show(f"    Step: {span.step}")
        if one.additional_constraints:
            show(f"    Additional constraints: {one.additional_constraints}")


_TYPES = {
    1: "boolean", 2: "integer", 3: "double", 4: "string", 5: "byte array",
    6: "boolean array", 7: "integer array", 8: "double array", 9: "string array",
}  # fmt: skip


def _param_load(node: Node, asked: argparse.Namespace, show: Print) -> int:
    """Set a node's parameters from a file; print each, with the reason if it is rejected.

    Raises:
        UsageError: If the file cannot be read, or has no parameters for the node.
    """
    client = _parameters(node, asked.node)
    try:
        given = parameter_dict_from_yaml_file(
            asked.file, not asked.no_use_wildcard, target_nodes=[_full(asked.node)]
        )
    except OSError as error:
        raise UsageError(str(error)) from None
    if not given:
        raise UsageError(
            f"'{asked.file}' contains no parameters of {_full(asked.node)}: write them below the "
            "name of the node"
        )
    results = _answer(node, client.set_parameters(list(given.values()))).results
    for name, result in zip(given, results, strict=True):
        outcome = "successful" if result.successful else f"failed: {result.reason}"
        show(f"Set parameter {name} {outcome}")
    return 0 if all(result.successful for result in results) else UNKNOWN


def _node_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    known = sorted(node.get_node_names_and_namespaces(), key=lambda one: one[::-1])
    seen = [one for one in known if asked.all or not topic_or_service_is_hidden(one[0])]
    if asked.count_nodes:
        show(str(len(seen)))
        return
    for name, namespace in seen:
        show(f"{namespace.rstrip('/')}/{name}")


def _node_info(node: Node, asked: argparse.Namespace, show: Print) -> int:
    full = _full(asked.node)
    if not node.wait_for_node(full, PATIENCE):
        raise UsageError(f"There is no node '{full}': 'tftool ros2 node list' lists the nodes.")
    namespace, _, name = full.rpartition("/")
    of = (name, namespace or "/")
    show(full)
    for title, pairs in (
        ("Subscribers", node.get_subscriber_names_and_types_by_node(*of)),
        ("Publishers", node.get_publisher_names_and_types_by_node(*of)),
        ("Service Servers", node.get_service_names_and_types_by_node(*of)),
        ("Service Clients", node.get_client_names_and_types_by_node(*of)),
        ("Action Servers", get_action_server_names_and_types_by_node(node, *of)),
        ("Action Clients", get_action_client_names_and_types_by_node(node, *of)),
    ):
        show(f"  {title}:")
        for one, kinds in pairs:
            if asked.include_hidden or not topic_or_service_is_hidden(one):
                show(f"    {one}: {', '.join(kinds)}")
    return 0


def _action_list(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    _list(get_action_names_and_types(node), asked, show, hidden=False)


def _action_type(node: Node, asked: argparse.Namespace, show: Print) -> int:
    _listen(node)
    return _show_types(get_action_names_and_types(node), asked.action, show)


def _action_info(node: Node, asked: argparse.Namespace, show: Print) -> None:
    _listen(node)
    full = _full(asked.action)
    show(f"Action: {full}")
    for title, names_and_types in (
        ("clients", get_action_client_names_and_types_by_node),
        ("servers", get_action_server_names_and_types_by_node),
    ):
        ends = [
            (f"{namespace.rstrip('/')}/{name}", kinds)
            for name, namespace in node.get_node_names_and_namespaces()
            if (kinds := dict(names_and_types(node, name, namespace)).get(full)) is not None
        ]
        show(f"Action {title}: {len(ends)}")
        for name, kinds in sorted(ends):
            show(f"    {name} [{', '.join(kinds)}]" if asked.show_types else f"    {name}")


def _action_send_goal(node: Node, asked: argparse.Namespace, show: Print) -> int:
    def dump(message: Any) -> None:
        text = rosidl_runtime.as_yaml(rosidl_runtime.plain(message))
        _show_lines(textwrap.indent(text, "    "), show)

    early: list[Any] = []
    accepted = False

    def on_feedback(message: Any) -> None:
        # Feedback can be there before the answer that accepts the goal: it is shown after it.
        if not accepted:
            early.append(message)
            return
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
    show(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}")
    accepted = True
    for message in early:
        on_feedback(message)
    wrapped = _answer(node, handle.get_result_async())
    show("Result:")
    dump(wrapped.result)
    show(f"Goal finished with status: {_STATUSES.get(wrapped.status, wrapped.status)}")
    return 0


def _pkg_executables(asked: argparse.Namespace, workspace: Workspace) -> str:
    found = executables.names(workspace)
    if asked.package is not None and asked.package not in {package for package, _ in found}:
        workspace.package(asked.package)
    return "\n".join(
        str(path) if asked.full_path and path else f"{package} {name}"
        for (package, name), path in sorted(found.items())
        if asked.package in (None, package)
    )


def _pkg_prefix(asked: argparse.Namespace, workspace: Workspace) -> str:
    known = workspace.packages.get(asked.package)
    return str(workspace.share(asked.package) if known is None or asked.share else known.path)


def _pkg_xml(asked: argparse.Namespace, workspace: Workspace) -> str:
    """Return the text of a package's package.xml, or of one of its tags.

    Raises:
        UsageError: If the package has no package.xml, or that file has no such tag.
    """
    file = workspace.package(asked.package).path / "package.xml"
    if not file.is_file():
        raise UsageError(f"package '{asked.package}' has no package.xml")
    text = read_text(file)
    if asked.tag is None:
        return text
    tag = re.escape(asked.tag)
    found = re.findall(rf"<{tag}(?:\s[^>]*)?>\s*(.*?)\s*</{tag}>", text, re.DOTALL)
    if not found:
        raise UsageError(f"package.xml of '{asked.package}' has no tag '{asked.tag}'")
    return "\n".join(found)


def _interface_list(asked: argparse.Namespace, workspace: Workspace) -> str:
    wanted = [kind for kind in rosidl_runtime.KINDS if getattr(asked, f"only_{kind}s")]
    lines = []
    for kind in wanted or rosidl_runtime.KINDS:
        found = rosidl_runtime.interfaces(kinds=[kind])
        lines += [f"{rosidl_runtime.KINDS[kind]}:", *(f"    {one}" for one in found)]
    return "\n".join(lines)


def _interface_proto(asked: argparse.Namespace, workspace: Workspace) -> str:
    shown = rosidl_runtime.plain(rosidl_runtime.prototype(asked.type))
    text = rosidl_runtime.as_yaml(shown) if shown else ""
    return text if asked.no_quotes else f'"{text}"'


def _interface_show(asked: argparse.Namespace, workspace: Workspace) -> str:
    return rosidl_runtime.definition(asked.type)


def _interface_package(asked: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(rosidl_runtime.interfaces(asked.package))


def _interface_packages(asked: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(sorted(INTERFACES.packages()))


def _pkg_list(asked: argparse.Namespace, workspace: Workspace) -> str:
    return "\n".join(sorted({*workspace.packages, *INTERFACES.packages()}))
