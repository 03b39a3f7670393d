"""Components of launch_ros: C++ nodes that are loaded into the process of a container.

tftool cannot run components. If a container runs in this session, even in another process, the
launch asks the container to load the components. If this launch starts the container, the request
waits until the container is ready. Without a container, the launch logs a warning and continues
without the components.
"""

from collections.abc import Iterable
from functools import partial
from typing import Any

from tftool.base.errors import TftoolError, UsageError
from tftool.messages.classes import INTERFACES
from tftool.ros.host.names import RosOptions
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action
from tftool.ros.launch.nodes import Node, python_file
from tftool.ros.launch.parameters import normalize_parameters, read_all
from tftool.ros.launch.scope import (
    add_node_name,
    namespace_in,
    normalize_remap_rules,
    parameters_in,
    remaps_in,
)
from tftool.ros.launch.substitutions import perform
from tftool.ros.rclpy.parameter import Parameter


class ComposableNode:
    """Description of a component: a node to load into a container's process."""

    def __init__(
        self,
        *,
        package: Any,
        plugin: Any,
        name: Any = None,
        namespace: Any = None,
        parameters: Any = None,
        remappings: Any = None,
        extra_arguments: Any = None,
        condition: Any = None,
    ) -> None:
        self.package, self.node_plugin = package, plugin
        self.node_name, self.node_namespace = name, namespace
        self.parameters = normalize_parameters(parameters or [])
        self.remappings = list(normalize_remap_rules(remappings or ()))
        self.extra_arguments = normalize_parameters(extra_arguments or [])
        self._condition = condition

    def condition(self) -> Any:
        """Return the condition for loading the component; None to load it always."""
        return self._condition


def get_composable_node_load_request(
    composable_node_description: ComposableNode, context: LaunchContext
) -> Any:
    """Return the service request that asks a container to load a component.

    Return None if the component's condition is false.
    """
    node = composable_node_description
    condition = node.condition()
    if condition is not None and not condition.evaluate(context):
        return None
    name = perform(context, node.node_name)
    namespace = namespace_in(context, node.node_namespace) or ""

    def messages(given: Any) -> list[Any]:
        meant = RosOptions(parameters=given).parameters_for(name, namespace)
        return [Parameter(key, value=one).to_parameter_msg() for key, one in meant.items()]

    def all_messages(given: Iterable[Any]) -> list[Any]:
        return [message for one in given for message in messages(read_all(context, [one]))]

    scope = (messages([one]) for one in parameters_in(context))
    return INTERFACES.find("composition_interfaces", "srv", "LoadNode").Request(
        package_name=perform(context, node.package),
        plugin_name=perform(context, node.node_plugin),
        node_name=name,
        node_namespace=namespace,
        remap_rules=[f"{old}:={new}" for old, new in remaps_in(context, node.remappings)],
        parameters=[*(one for found in scope for one in found), *all_messages(node.parameters)],
        extra_arguments=all_messages(node.extra_arguments),
    )


class LoadComposableNodes(Action):
    """Action that loads components into a running container."""

    def __init__(
        self, *, composable_node_descriptions: Iterable[Any], target_container: Any, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.composable_node_descriptions = list(composable_node_descriptions)
        self.target_container = target_container

    def execute(self, context: LaunchContext) -> Any:
        """Send a request to the container for each component, one after the other."""
        made = (
            get_composable_node_load_request(one, context)
            for one in self.composable_node_descriptions
        )
        requests = [request for request in made if request is not None]
        if not requests:
            return
        target = self.target_container
        container = target.node_name if isinstance(target, Node) else perform(context, target)
        service = f"{container.strip('/')}/_container/load_node"

        def go_on(is_there: bool) -> None:
            if is_there:
                context.launch.send_requests(service, requests, partial(self._loaded, context))
                return
            plugins = ", ".join(request.plugin_name for request in requests)
            context.launch.warn(
                f"not loaded: {plugins}: tftool cannot run components, which are C++ libraries, "
                f"and no container '{container}' runs in this session"
            )

        context.launch.when_served(service, f"/{container.strip('/')}", go_on)

    def _loaded(self, context: LaunchContext, request: Any, answer: Any) -> None:
        if isinstance(answer, TftoolError) or not answer.success:
            reason = answer if isinstance(answer, TftoolError) else answer.error_message
            context.launch.warn(f"{request.plugin_name} was not loaded: {reason}")
            return
        add_node_name(context, answer.full_node_name)
        context.launch.info(f"loaded {request.plugin_name} as '{answer.full_node_name}'")


class ComposableNodeContainer(Node):
    """Action that starts a container, a program that loads components."""

    def __init__(
        self,
        *,
        name: Any,
        namespace: Any,
        composable_node_descriptions: Iterable[Any] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.composable_node_descriptions = list(composable_node_descriptions or ())

    def execute(self, context: LaunchContext) -> Any:
        """Start the container if it is a Python program; return the action that loads components.

        Return None if the container has no components.
        """
        self._perform_substitutions(context)
        reason = self._missing(context)
        if reason:
            context.launch.warn(f"not started: the container {self.node_name}: {reason}")
        else:
            super().execute(context)
        if not self.composable_node_descriptions:
            return None
        return LoadComposableNodes(
            composable_node_descriptions=self.composable_node_descriptions,
            target_container=self.node_name,
        )

    def _missing(self, context: LaunchContext) -> str:
        """Return the reason why tftool cannot start the container; "" if tftool can start it."""
        package = None if self.package is None else perform(context, self.package)
        try:
            if package is None:
                python_file(perform(context, self.executable))
            else:
                context.workspace.package(package)
        except UsageError as error:
            if package is None:
                return str(error)
            return (
                f"'{package}' is not a package of this workspace, and containers are C++ programs"
            )
        return ""
