"""Commands `ros2 service`, `param`, `node` and `action`, and a lookup of a command's function."""

import argparse
import textwrap
from collections.abc import Callable
from typing import Any

from tftool.base.errors import UsageError
from tftool.ros.host import parameter_files, rosidl_runtime
from tftool.ros.rclpy.action_client import ActionClient, GoalStatus
from tftool.ros.rclpy.executors import spin_until_future_complete
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.node_graph import (
    get_action_client_names_and_types_by_node,
    get_action_server_names_and_types_by_node,
)
from tftool.ros.rclpy.parameter import Parameter, Type, parameter_dict_from_yaml_file
from tftool.ros.rclpy.parameter_client import AsyncParameterClient
from tftool.ros.rclpy.validation import topic_or_service_is_hidden
from tftool.ros.ros2 import topic_verbs
from tftool.ros.ros2.topic_verbs import (
    PATIENCE,
    Print,
    discover,
    full_name,
    list_names,
    names_and_types,
    show_lines,
)
from tftool.world.node_parameters import value_of

UNKNOWN = 1
"""Exit status if the given node, topic or parameter does not exist."""

Verb = Callable[[Node, argparse.Namespace, Print], int | None]


def verb_of(args: argparse.Namespace) -> Verb:
    """Return the function of a command: `_topic_echo` for `ros2 topic echo`.

    Commands of different nouns may share a function: `_type` is the function of both
    `ros2 topic type` and `ros2 service type`.
    """
    known = {"_list": list_names, **vars(topic_verbs), **globals()}
    found: Verb = known.get(f"_{args.noun}_{args.verb}") or known[f"_{args.verb}"]
    return found


def _type(node: Node, args: argparse.Namespace, show: Print) -> int:
    kinds = dict(names_and_types(node, args)).get(full_name(getattr(args, args.noun)), [])
    for kind in kinds:
        show(kind)
    return 0 if kinds else UNKNOWN


def _find(node: Node, args: argparse.Namespace, show: Print) -> None:
    """Print the names of all topics or services that have the type given in `args`.

    The type is "package/msg/Name" or "package/Name".
    """
    kind = args.type
    for name, kinds in names_and_types(node, args):
        if any(kind in (one, "/".join(one.split("/")[::2])) for one in kinds):
            show(name)


# Services, parameters, nodes, actions


def _service_info(node: Node, args: argparse.Namespace, show: Print) -> int:
    full = full_name(args.service)
    kinds = dict(names_and_types(node, args)).get(full, [])
    show(f"Type: {', '.join(kinds) or 'unknown'}")
    show(f"Clients count: {node.count_clients(full)}")
    show(f"Services count: {node.count_services(full)}")
    return 0 if kinds else UNKNOWN


def _service_call(node: Node, args: argparse.Namespace, show: Print) -> None:
    client = node.create_client(args.kind, args.service)
    if not client.service_is_ready():
        show("waiting for service to become available...")
        client.wait_for_service()
    rate = None if args.rate is None else node.create_rate(args.rate)
    while True:
        show(f"requester: making request: {args.message!r}")
        show("")
        response = client.call(args.message)
        show("response:")
        show(repr(response))
        if rate is None or not node.context.ok():
            return
        rate.sleep()


def _parameters(node: Node, name: str) -> AsyncParameterClient:
    """Return a client for the parameters of the node named `name`.

    Raises:
        UsageError: If the node's parameter services do not appear in time.
    """
    client = AsyncParameterClient(node, full_name(name))
    if not client.wait_for_services(PATIENCE):
        raise UsageError(
            f"Node '{full_name(name)}' does not exist, or has no parameters: 'tftool ros2 node "
            "list' lists the nodes."
        )
    return client


def _answer(node: Node, future: Any) -> Any:
    spin_until_future_complete(node, future)
    return future.result()


def _names_of_parameters(node: Node, client: AsyncParameterClient) -> list[str]:
    return sorted(_answer(node, client.list_parameters()).result.names)


def _param_list(node: Node, args: argparse.Namespace, show: Print) -> None:
    def each(owner: str) -> None:
        client = _parameters(node, owner)
        known = _names_of_parameters(node, client)
        if not args.param_type:
            show_lines("\n".join(f"  {name}" for name in known), show)
            return
        for one in _answer(node, client.describe_parameters(known)).descriptors:
            show(f"  {one.name} (type: {_type_name(one.type)})")

    if args.node is not None:
        each(args.node)
        return
    discover()
    for name, kinds in node.get_service_names_and_types():
        owner, _, service = name.rpartition("/")
        if service == "list_parameters" and kinds == ["rcl_interfaces/srv/ListParameters"]:
            show(f"{owner}:")
            each(owner)


_WORDS = {bool: "Boolean", int: "Integer", float: "Double", str: "String"}


def _values_of(node: Node, client: AsyncParameterClient, wanted: list[str]) -> list[Any]:
    return [value_of(one) for one in _answer(node, client.get_parameters(wanted)).values]


def _param_get(node: Node, args: argparse.Namespace, show: Print) -> int:
    client = _parameters(node, args.node)
    (value,) = _values_of(node, client, [args.name]) or [None]
    if value is None:
        show("Parameter not set")
        return UNKNOWN
    shown = "" if args.hide_type else f"{_WORDS.get(type(value), 'Array')} value is: "
    show(f"{shown}{value}")
    return 0


def _param_set(node: Node, args: argparse.Namespace, show: Print) -> int:
    client, value = _parameters(node, args.node), parameter_files.yaml_value(args.value)
    future = client.set_parameters([Parameter(args.name, value=value)])
    return _changed(node, future, show, "Set parameter successful", "Setting")


def _param_delete(node: Node, args: argparse.Namespace, show: Print) -> int:
    future = _parameters(node, args.node).delete_parameters([args.name])
    return _changed(node, future, show, "Deleted parameter successfully", "Deleting")


def _changed(node: Node, future: Any, show: Print, done: str, verb: str) -> int:
    (result,) = _answer(node, future).results
    show(done if result.successful else f"{verb} parameter failed: {result.reason}")
    return 0 if result.successful else UNKNOWN


def _param_dump(node: Node, args: argparse.Namespace, show: Print) -> None:
    client = _parameters(node, args.node)
    known = _names_of_parameters(node, client)
    whole: dict[str, Any] = {}
    for name, value in zip(known, _values_of(node, client, known), strict=True):
        *folders, last = name.split(".")
        below = whole
        for folder in folders:
            below = below.setdefault(folder, {})
        below[last] = value
    dumped = {full_name(args.node): {"ros__parameters": whole}}
    show_lines(rosidl_runtime.as_yaml(dumped), show)


def _param_describe(node: Node, args: argparse.Namespace, show: Print) -> None:
    client = _parameters(node, args.node)
    for one in _answer(node, client.describe_parameters(args.names)).descriptors:
        show(f"Parameter name: {one.name}")
        show(f"  Type: {_type_name(one.type)}")
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


def _type_name(number: int) -> str:
    return Type(number).name.lower().replace("_", " ").replace("bool", "boolean")


def _param_load(node: Node, args: argparse.Namespace, show: Print) -> int:
    """Set a node's parameters from a file; print whether the node accepts each parameter.

    Raises:
        UsageError: If the file cannot be read, or has no parameters for the node.
    """
    client = _parameters(node, args.node)
    try:
        given = parameter_dict_from_yaml_file(
            args.file, not args.no_use_wildcard, target_nodes=[full_name(args.node)]
        )
    except OSError as error:
        raise UsageError(str(error)) from None
    if not given:
        raise UsageError(
            f"'{args.file}' contains no parameters of {full_name(args.node)}: write them below "
            "the name of the node"
        )
    results = _answer(node, client.set_parameters(list(given.values()))).results
    for name, result in zip(given, results, strict=True):
        outcome = "successful" if result.successful else f"failed: {result.reason}"
        show(f"Set parameter {name} {outcome}")
    return 0 if all(result.successful for result in results) else UNKNOWN


def _node_list(node: Node, args: argparse.Namespace, show: Print) -> None:
    discover()
    known = sorted(node.get_node_names_and_namespaces(), key=lambda one: one[::-1])
    seen = [one for one in known if args.all or not topic_or_service_is_hidden(one[0])]
    if args.count_nodes:
        show(str(len(seen)))
        return
    for name, namespace in seen:
        show(f"{namespace.rstrip('/')}/{name}")


def _node_info(node: Node, args: argparse.Namespace, show: Print) -> int:
    full = full_name(args.node)
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
            if args.include_hidden or not topic_or_service_is_hidden(one):
                show(f"    {one}: {', '.join(kinds)}")
    return 0


def _action_info(node: Node, args: argparse.Namespace, show: Print) -> None:
    discover()
    full = full_name(args.action)
    show(f"Action: {full}")
    for title, find in (
        ("clients", get_action_client_names_and_types_by_node),
        ("servers", get_action_server_names_and_types_by_node),
    ):
        ends = [
            (f"{namespace.rstrip('/')}/{name}", kinds)
            for name, namespace in node.get_node_names_and_namespaces()
            if (kinds := dict(find(node, name, namespace)).get(full)) is not None
        ]
        show(f"Action {title}: {len(ends)}")
        for name, kinds in sorted(ends):
            show(f"    {name} [{', '.join(kinds)}]" if args.show_types else f"    {name}")


def _action_send_goal(node: Node, args: argparse.Namespace, show: Print) -> int:
    def dump(message: Any) -> None:
        text = rosidl_runtime.as_yaml(rosidl_runtime.plain(message))
        show_lines(textwrap.indent(text, "    "), show)

    early: list[Any] = []
    accepted = False

    def on_feedback(message: Any) -> None:
        # Feedback may arrive before the response that accepts the goal; it is shown afterwards.
        if not accepted:
            early.append(message)
            return
        show("Feedback:")
        dump(message.feedback)

    client = ActionClient(node, args.kind, args.action)
    if not client.server_is_ready():
        show("Waiting for an action server to become available...")
        client.wait_for_server()
    show("Sending goal:")
    dump(args.message)
    feedback = on_feedback if args.feedback else None
    handle = _answer(node, client.send_goal_async(args.message, feedback_callback=feedback))
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
    status = GoalStatus(wrapped.status).name.removeprefix("STATUS_")
    show(f"Goal finished with status: {status}")
    return 0
