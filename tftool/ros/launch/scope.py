"""Settings for all nodes started in a scope of a launch file: namespace, remappings, parameters.

As in ROS 2, these settings are stored among the launch arguments, so they end with the scope.
"""

from collections.abc import Iterable
from typing import Any

from tftool.base.errors import UsageError
from tftool.ros.host import names
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action
from tftool.ros.launch.parameters import ParameterFile, normalize_parameters, read_all
from tftool.ros.launch.substitutions import (
    Substitution,
    SubstitutionFailure,
    normalize_to_list_of_substitutions,
    perform,
)

_NAMESPACE, _REMAPS, _PARAMETERS = "ros_namespace", "ros_remaps", "global_params"


def is_namespace_absolute(ns: str) -> bool:
    """Return whether a namespace begins with a slash."""
    return ns.startswith("/")


def is_root_namespace(ns: str) -> bool:
    """Return whether a namespace is the root, "/"."""
    return ns == "/"


def make_namespace_absolute(ns: str | None) -> str | None:
    """Return a namespace with a leading slash; return None for None."""
    return ns if ns is None or is_namespace_absolute(ns) else f"/{ns}"


def prefix_namespace(base_ns: str | None, ns: str | None) -> str | None:
    """Join the namespaces `base_ns` and `ns`; return `ns` alone if `ns` is absolute.

    If one namespace is None, return the other namespace.
    """
    if base_ns is None or ns is None:
        joined = base_ns if ns is None else ns
    elif is_namespace_absolute(ns) or not base_ns:
        joined = ns
    else:
        joined = f"{base_ns.rstrip('/')}/{ns}" if ns else base_ns
    return joined if joined is None or is_root_namespace(joined) else joined.rstrip("/")


def namespace_in(context: LaunchContext, node_namespace: Any) -> str | None:
    """Return the absolute namespace of a node that is started in the current scope.

    Returns:
        The namespace; None if neither the scope nor the node has one.

    Raises:
        UsageError: If ROS 2 does not accept the namespace.
    """
    given = None if node_namespace is None else perform(context, node_namespace)
    base = context.launch_configurations.get(_NAMESPACE)
    namespace = make_namespace_absolute(prefix_namespace(base, given))
    if namespace is not None:
        names.check_namespace(namespace)
    return namespace


def normalize_remap_rule(remap_rule: Any) -> tuple[Any, Any]:
    """Convert a remapping rule, a pair of texts, to a pair of lists of substitutions.

    Raises:
        TypeError: If the rule is not a pair.
    """
    if not isinstance(remap_rule, tuple) or len(remap_rule) != 2:
        raise TypeError(f"a remapping is a pair like ('old', 'new'), not {remap_rule!r}")
    old, new = remap_rule
    return normalize_to_list_of_substitutions(old), normalize_to_list_of_substitutions(new)


def normalize_remap_rules(remap_rules: Iterable[Any]) -> Iterable[tuple[Any, Any]]:
    """Convert remapping rules, pairs of texts, to pairs of lists of substitutions.

    Raises:
        TypeError: If a rule is not a pair.
    """
    return (normalize_remap_rule(rule) for rule in remap_rules)


def remaps_in(
    context: LaunchContext, node_rules: Iterable[tuple[Any, Any]]
) -> list[tuple[str, str]]:
    """Return the remapping rules of the current scope and then those of a node, as (old, new)."""
    return [
        *_kept(context, _REMAPS),
        *((perform(context, old), perform(context, new)) for old, new in node_rules),
    ]


def parameters_in(context: LaunchContext) -> list[tuple[str, str, Any]]:
    """Return the current scope's parameters as tuples (node pattern, name, value).

    The node pattern "" matches every node.
    """
    found: list[tuple[str, str, Any]] = []
    for kept in _kept(context, _PARAMETERS):
        if isinstance(kept, str):
            found += ParameterFile(kept).read(context)
        else:
            found.append(kept if len(kept) == 3 else ("", *kept))
    return found


def add_node_name(context: LaunchContext, node_name: str) -> None:
    """Count one more started node with the full name `node_name`."""
    context.node_names[node_name] += 1


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """Return the number of started nodes with the full name `node_name`."""
    return context.node_names[node_name]


def _kept(context: LaunchContext, name: str) -> Any:
    kept: Any = context.launch_configurations.get(name, [])
    if isinstance(kept, str):
        raise UsageError(
            f"'{name}' cannot be a launch argument, because launch_ros stores settings of a "
            "scope under this name: rename the launch argument"
        )
    return kept


def _keep(context: LaunchContext, name: str, *more: Any) -> None:
    # Create a new list, because the outer scope must not change.
    configurations: dict[str, Any] = context.launch_configurations
    configurations[name] = [*_kept(context, name), *more]


class PushRosNamespace(Action):
    """Action that sets a namespace for the nodes started later in the scope."""

    def __init__(self, namespace: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.namespace = namespace

    def execute(self, context: LaunchContext) -> Any:
        """Set the scope's namespace; join a relative namespace to the present namespace."""
        namespace = namespace_in(context, self.namespace)
        if namespace is not None:
            context.launch_configurations[_NAMESPACE] = namespace


class SetRemap(Action):
    """Action that adds a remapping for the nodes started later in the scope."""

    def __init__(self, src: Any, dst: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.src, self.dst = src, dst

    def execute(self, context: LaunchContext) -> Any:
        """Add the remapping to the scope."""
        _keep(context, _REMAPS, (perform(context, self.src), perform(context, self.dst)))


class SetParameter(Action):
    """Action that sets a parameter for the nodes started later in the scope."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        given = tuple(name) if isinstance(name, list) else name  # a key cannot be a list
        (self._normalized,) = normalize_parameters([{given: value}])
        ((key, self.value),) = self._normalized.items()
        self.name = list(key)

    def execute(self, context: LaunchContext) -> Any:
        """Set the parameter in the scope."""
        found = read_all(context, [self._normalized])
        _keep(context, _PARAMETERS, *((name, value) for _, name, value in found))


class SetUseSimTime(SetParameter):
    """Action that sets the parameter use_sim_time for the nodes started later in the scope."""

    def __init__(self, value: Any, **kwargs: Any) -> None:
        super().__init__("use_sim_time", value, **kwargs)


class SetParametersFromFile(Action):
    """Action that sets the parameters in a file for the nodes started later in the scope."""

    def __init__(self, filename: Any, node_name: Any = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.filename, self.node_name = filename, node_name

    def execute(self, context: LaunchContext) -> Any:
        """Set the file's parameters in the scope.

        The parameters apply to the node `node_name`, or by default to the nodes named in the file.
        """
        path = perform(context, self.filename)
        if self.node_name is None:
            _keep(context, _PARAMETERS, path)
            return
        only = perform(context, self.node_name)
        found = ParameterFile(path).read(context)
        _keep(context, _PARAMETERS, *((only or node, *rest) for node, *rest in found))


class ParameterSubstitution(Substitution):
    """Substitution for the value of a parameter that is set in the scope."""

    def __init__(self, name: Any, *, default: Any = None) -> None:
        self.name, self.default = name, default

    def perform(self, context: LaunchContext) -> str:
        """Return the parameter's present value in the scope, or the default.

        Raises:
            SubstitutionFailure: If the scope does not set the parameter, and there is no default.
        """
        name = perform(context, self.name)
        for node, set_name, value in reversed(parameters_in(context)):
            if set_name == name and not node:
                return str(value)
        if self.default is None:
            raise SubstitutionFailure(
                f"no SetParameter of this scope sets parameter '{name}': give a default"
            )
        return perform(context, self.default)
