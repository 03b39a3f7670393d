"""Parameters of rclpy nodes: named, typed values, with their services and change events."""

import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from tftool.messages.classes import INTERFACES
from tftool.ros.host import names, values
from tftool.ros.host.error_text import undeclared
from tftool.ros.rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from tftool.ros.rclpy.node_state import NodeState
from tftool.ros.rclpy.parameter import Parameter, Type
from tftool.ros.rclpy.qos import qos_profile_parameter_events
from tftool.ros.rclpy.time import Clock
from tftool.ros.rclpy.topics import Publisher
from tftool.ros.rclpy.validation import validate_parameter_name
from tftool.world.node_parameters import Answer, list_result, parameter_services, value_of

PARAMETER_EVENTS = "/parameter_events"

Setter = Callable[[list[Parameter]], Any]


class NodeParameters:
    """Methods of a node that declare, read and set its parameters."""

    _clock: Clock

    def _start_parameters(
        self,
        state: NodeState,
        given: Mapping[str, Any],
        overrides: Iterable[Parameter],
        undeclared: bool,
        automatic: bool,
    ) -> None:
        kind: Any = INTERFACES.message("rcl_interfaces/ParameterEvent")
        topic, profile = PARAMETER_EVENTS, qos_profile_parameter_events
        self.__events: Publisher = state.keep(Publisher, kind, topic, topic[1:], profile)
        self._parameters: dict[str, Parameter] = {}
        self._descriptors: dict[str, Any] = {}
        self._parameter_overrides: dict[str, Any] = {one.name: one.value for one in overrides}
        self._parameter_overrides.update(given)
        self._unused_parameters = dict(given)
        self._allow_undeclared_parameters = undeclared
        self._pre_set_parameters_callbacks: list[Callable[..., Any]] = []
        self._on_set_parameters_callbacks: list[Setter] = []
        self._post_set_parameters_callbacks: list[Callable[..., Any]] = []
        self.__declare_one("use_sim_time", False, None, False)
        # ROS's own nodes have this parameter, and `ros2 param list` shows it.
        self.__declare_one("start_type_description_service", True, None, False)
        if automatic:
            for name, value in self._parameter_overrides.items():
                if name not in self._parameters:
                    self.__declare_one(name, value, None, False)

    def __publish_event(
        self,
        *,
        new: Sequence[Parameter] = (),
        changed: Sequence[Parameter] = (),
        deleted: Sequence[Parameter] = (),
    ) -> None:
        """Publish a parameter event, unless nobody subscribes to these events."""
        if self.__events.is_heard:
            state = self.__events.node_state
            self.__events.publish(
                self.__events.msg_type(
                    stamp=values.time_message(self._clock.reading()),
                    node=f"/{names.join(state.namespace, state.name)}",
                    new_parameters=[one.to_parameter_msg() for one in new],
                    changed_parameters=[one.to_parameter_msg() for one in changed],
                    deleted_parameters=[one.to_parameter_msg() for one in deleted],
                )
            )

    # Declaring

    def declare_parameter(
        self, name: str, value: Any = None, descriptor: Any = None, ignore_override: bool = False
    ) -> Parameter:
        """Declare a parameter; a value from the command line or launch file replaces `value`.

        Args:
            name: Name of the parameter.
            value: Default value, or a `Parameter.Type` for a parameter without a default.
            descriptor: ParameterDescriptor message; None for an empty one.
            ignore_override: Whether to ignore a value from the command line or launch file.

        Raises:
            ParameterAlreadyDeclaredException: If the parameter is declared already.
            ValueError: If the type is NOT_SET, or a type is given with `dynamic_typing`.
            InvalidParameterTypeException: If the value is not of the declared type.
        """
        return self.__declare_one(name, value, descriptor, ignore_override)

    def declare_parameters(
        self, namespace: str, parameters: Sequence[tuple[Any, ...]], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declare several parameters.

        Args:
            namespace: Prefix that a dot joins to each name; "" for no prefix.
            parameters: Tuples (name, value, descriptor); value and descriptor may be missing.
            ignore_override: Whether to ignore values from the command line or launch file.

        Warns:
            UserWarning: If a tuple contains only a name, so that values of any type are accepted.
        """
        prefix = f"{namespace}." if namespace else ""
        for one in parameters:
            if len(one) == 1:
                warnings.warn(
                    f"parameter '{prefix}{one[0]}' is declared without a value: give a default, "
                    "or a Parameter.Type",
                    stacklevel=2,
                )
        return [
            self.__declare_one(
                prefix + one[0],
                one[1] if len(one) > 1 else None,
                one[2] if len(one) > 2 else None,
                ignore_override,
            )
            for one in parameters
        ]

    def __declare_one(
        self, name: str, value: Any, descriptor: Any, ignore_override: bool
    ) -> Parameter:
        if not isinstance(name, str):
            raise TypeError(f"a parameter's name must be a string, not {type(name).__name__}")
        validate_parameter_name(name)
        if name in self._parameters:
            raise ParameterAlreadyDeclaredException(name)
        wanted: Any = INTERFACES.message("rcl_interfaces/ParameterDescriptor")
        if descriptor is None:
            descriptor = wanted()
        if not isinstance(descriptor, wanted):
            raise TypeError(
                f"a descriptor must be a ParameterDescriptor, not {type(descriptor).__name__}"
            )
        kind, value = _kind_and_value(name, value, descriptor)
        self._unused_parameters.pop(name, None)
        if not ignore_override and name in self._parameter_overrides:
            value = self._parameter_overrides[name]
            dynamic = descriptor.dynamic_typing or kind is Type.NOT_SET
            if not dynamic and not kind.check(value):
                raise InvalidParameterTypeException(
                    f"Trying to set parameter '{name}' to '{value}' of type "
                    f"'{_word(value)}', expecting type '{kind.name}'{_hint(kind, value)}",
                    name,
                )
        descriptor.name = name
        descriptor.type = int(kind)
        fits = value is not None and kind.check(value)
        parameter = Parameter(name, kind if fits else Type.from_parameter_value(value), value)
        self._descriptors[name] = descriptor
        reason = self.__range_fault(parameter) or self.__refusal([parameter])
        if reason is not None:
            del self._descriptors[name]
            raise InvalidParameterValueException(name, value, reason or "refused by a callback")
        self._parameters[name] = parameter
        self.__publish_event(new=[parameter])
        return parameter

    def undeclare_parameter(self, name: str) -> None:
        """Remove a declared parameter."""
        self.__known(name)
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        self.__publish_event(deleted=[self._parameters[name]])
        del self._parameters[name], self._descriptors[name]

    # Reading

    def has_parameter(self, name: str) -> bool:
        """Return whether a parameter is declared."""
        return name in self._parameters

    def get_parameter(self, name: str) -> Parameter:
        """Return a declared parameter.

        Raises:
            ParameterNotDeclaredException: If no such parameter is declared; the text names similar
                ones.
        """
        if name not in self._parameters and self._allow_undeclared_parameters:
            return Parameter(name, Type.NOT_SET, None)
        self.__known(name)
        parameter = self._parameters[name]
        if parameter.type_ is Type.NOT_SET and self._descriptors[name].type:
            raise ParameterUninitializedException(name)
        return parameter

    def get_parameters(self, names: Iterable[str]) -> list[Parameter]:
        """Return several declared parameters."""
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: Parameter | None = None) -> Parameter:
        """Return the parameter if it is declared and has a value; otherwise the alternative.

        If the alternative is None, return a parameter whose type is NOT_SET.
        """
        found = self._parameters.get(name)
        if found is not None and found.type_ is not Type.NOT_SET:
            return found
        return alternative_value or found or Parameter(name, Type.NOT_SET, None)

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Return the parameters below a prefix, by their names without the prefix and its dot."""
        start = f"{prefix}." if prefix else ""
        return {
            name.removeprefix(start): parameter
            for name, parameter in self._parameters.items()
            if name.startswith(start)
        }

    def get_parameter_types(self, names: Iterable[str]) -> list[Type]:
        """Return the types of declared parameters."""
        return [self.get_parameter_type(name) for name in names]

    def get_parameter_type(self, name: str) -> Type:
        """Return the type of a declared parameter."""
        return self.get_parameter(name).type_

    def describe_parameter(self, name: str) -> Any:
        """Return the ParameterDescriptor message of a parameter.

        For a node that allows undeclared parameters, the descriptor of an undeclared parameter is
        empty.
        """
        if name not in self._parameters and self._allow_undeclared_parameters:
            return INTERFACES.message("rcl_interfaces/ParameterDescriptor")()
        self.__known(name)
        return self._descriptors[name]

    def describe_parameters(self, names: Iterable[str]) -> list[Any]:
        """Return the ParameterDescriptor messages of several parameters."""
        return [self.describe_parameter(name) for name in names]

    def list_parameters(self, prefixes: Sequence[str], depth: int = 0) -> Any:
        """Return the names of parameters in a ListParametersResult message.

        Args:
            prefixes: Prefixes of the names to list; [] for all names.
            depth: Number of levels, separated by dots, to list below a prefix; 0 for all levels.

        Raises:
            TypeError: If `prefixes` is not a list or tuple of strings, or `depth` not an integer.
            ValueError: If the depth is negative.
        """
        if not isinstance(prefixes, (list, tuple)) or not all(
            isinstance(one, str) for one in prefixes
        ):
            raise TypeError("the prefixes must be a list of strings")
        if not isinstance(depth, int):
            raise TypeError(f"the depth must be an integer, not {type(depth).__name__}")
        if depth < 0:
            raise ValueError(f"the depth must be 0 or more levels, not {depth}")
        return list_result(self._parameters, prefixes, depth)

    def __known(self, name: str) -> None:
        if name not in self._parameters:
            raise ParameterNotDeclaredException(name, self._parameters)

    # Setting

    def set_parameters(self, parameter_list: Sequence[Parameter]) -> list[Any]:
        """Set parameters one by one; return a SetParametersResult message for each parameter.

        Raises:
            ParameterNotDeclaredException: If a parameter is not declared; only the
                parameters before it in the list are then set.
            TypeError: If an item of the list is not a Parameter.
        """
        return [self.set_parameters_atomically([one]) for one in parameter_list]

    def set_parameters_atomically(self, parameter_list: Sequence[Parameter]) -> Any:
        """Set all parameters in the list, or none of them if one is rejected.

        Returns:
            A SetParametersResult message.

        Raises:
            ParameterNotDeclaredException: If a parameter, given or added by a callback, is not
                declared.
            TypeError: If an item of the list is not a Parameter.
        """
        self.__settable(parameter_list)
        changes = list(parameter_list)
        for before in self._pre_set_parameters_callbacks:
            changes = before(changes)
            if not changes:
                # The words are rclpy's, which programs compare.
                return set_result(
                    False,
                    "parameter list cannot be empty, this might be due to "
                    "pre_set_parameters_callback modifying the original parameters list.",
                )
        self.__settable(changes)
        for one in changes:
            reason = self.__fault(one)
            if reason:
                return set_result(False, reason)
        refusal = self.__refusal(changes)
        if refusal is not None:
            return set_result(False, refusal)
        self.__apply(changes)
        return set_result(True, "")

    def __settable(self, parameters: Iterable[Parameter]) -> None:
        for one in parameters:
            if not isinstance(one, Parameter):
                raise TypeError(f"{one!r} is not a Parameter")
            if not self._allow_undeclared_parameters:
                self.__known(one.name)

    def __apply(self, changes: list[Parameter]) -> None:
        new = [one for one in changes if one.name not in self._parameters]
        deleted = [one for one in changes if one.type_ is Type.NOT_SET]
        for one in changes:
            if one.type_ is Type.NOT_SET:
                # As in ROS, setting a parameter to nothing undeclares it.
                self._parameters.pop(one.name, None)
                self._descriptors.pop(one.name, None)
                continue
            self._parameters[one.name] = one
            if one.name not in self._descriptors:
                self._descriptors[one.name] = INTERFACES.message(
                    "rcl_interfaces/ParameterDescriptor"
                )(name=one.name, type=int(one.type_), dynamic_typing=True)
        new = [one for one in new if one not in deleted]
        changed = [one for one in changes if one not in new and one not in deleted]
        self.__publish_event(new=new, changed=changed, deleted=deleted)
        for after in self._post_set_parameters_callbacks:
            after(changes)

    def set_descriptor(self, name: str, descriptor: Any, alternative_value: Any = None) -> Any:
        """Replace the descriptor of a declared parameter, except its name and type.

        Args:
            name: Name of the parameter.
            descriptor: New descriptor.
            alternative_value: ParameterValue to set if the new descriptor excludes the old value.

        Returns:
            The parameter's value after this call, a ParameterValue message.

        Raises:
            ParameterNotDeclaredException: If the parameter is not declared.
            ParameterImmutableException: If the parameter is read-only.
            InvalidParameterValueException: If the new descriptor excludes both the old and the
                alternative value; nothing is changed then.
        """
        if name not in self._parameters and self._allow_undeclared_parameters:
            return Parameter(name, Type.NOT_SET, None).get_parameter_value()
        self.__known(name)
        before, current = self._descriptors[name], self._parameters[name]
        if before.read_only:
            raise ParameterImmutableException(name)
        descriptor.name, descriptor.type = name, before.type
        self._descriptors[name] = descriptor
        candidates = [current]
        if alternative_value is not None:
            candidates.append(Parameter(name, value=value_of(alternative_value)))
        fault = ""
        for one in candidates:
            fault = self.__range_fault(one)
            if not fault:
                self._parameters[name] = one
                return one.get_parameter_value()
        self._descriptors[name] = before
        raise InvalidParameterValueException(name, candidates[-1].value, fault)

    def __fault(self, parameter: Parameter) -> str:
        name = parameter.name
        descriptor = self._descriptors.get(name)
        if descriptor is None:
            return ""
        if descriptor.read_only:
            return f"Trying to set a read-only parameter: {name}."
        wanted = Type(descriptor.type)
        if not descriptor.dynamic_typing and wanted is not Type.NOT_SET:
            if parameter.type_ is Type.NOT_SET:
                # The words are rclpy's, which programs compare.
                return "Static parameter cannot be undeclared"
            if parameter.type_ is not wanted:
                return (
                    f"Wrong parameter type, parameter {{{name}}} is of type {{{wanted.name}}}, "
                    f"setting it to {{{parameter.type_.name}}} is not allowed"
                    f"{_hint(wanted, parameter.value)}"
                )
        return self.__range_fault(parameter)

    def __range_fault(self, parameter: Parameter) -> str:
        descriptor, value = self._descriptors[parameter.name], parameter.value
        if parameter.type_ is Type.INTEGER:
            ranges = descriptor.integer_range
        elif parameter.type_ is Type.DOUBLE:
            ranges = descriptor.floating_point_range
        else:
            return ""
        for one in ranges:
            if not one.from_value <= value <= one.to_value:
                return (
                    f"Parameter {parameter.name} out of range. Min: {one.from_value}, "
                    f"Max: {one.to_value}, value: {value}"
                )
            if not _is_on_step(value, one):
                return (
                    f"The parameter value for {parameter.name} is not a valid step. "
                    f"Min: {one.from_value}, max: {one.to_value}, value: {value}, step: {one.step}"
                )
        return ""

    def __refusal(self, changes: list[Parameter]) -> str | None:
        """Return the reason why a callback rejects changes; None if no callback rejects them."""
        for callback in reversed(self._on_set_parameters_callbacks):
            result = callback(changes)
            if not result.successful:
                return str(result.reason)
        return None

    def add_on_set_parameters_callback(self, callback: Setter) -> None:
        """Register a callback that accepts or rejects changes; newer callbacks are called first."""
        self._on_set_parameters_callbacks.append(callback)

    def remove_on_set_parameters_callback(self, callback: Setter) -> None:
        """Remove a callback registered with `add_on_set_parameters_callback`."""
        self._on_set_parameters_callbacks.remove(callback)

    def remove_pre_set_parameters_callback(self, callback: Callable[..., Any]) -> None:
        """Remove a callback registered with `add_pre_set_parameters_callback`."""
        self._pre_set_parameters_callbacks.remove(callback)

    def remove_post_set_parameters_callback(self, callback: Callable[..., Any]) -> None:
        """Remove a callback registered with `add_post_set_parameters_callback`."""
        self._post_set_parameters_callbacks.remove(callback)

    def add_pre_set_parameters_callback(self, callback: Callable[..., Any]) -> None:
        """Register a callback that can rewrite a list of changes before the changes are checked."""
        self._pre_set_parameters_callbacks.append(callback)

    def add_post_set_parameters_callback(self, callback: Callable[..., Any]) -> None:
        """Register a callback that is called with the changed parameters after a change."""
        self._post_set_parameters_callbacks.append(callback)


def _is_on_step(value: float, limits: Any) -> bool:
    """Return whether a value is allowed by the step of a range.

    Allowed values are `from_value` plus a multiple of `step`, and `to_value`.
    """
    if not limits.step or value == limits.to_value:
        return True
    if isinstance(value, int):
        return bool((value - limits.from_value) % limits.step == 0)
    steps = (value - limits.from_value) / limits.step
    return math.isclose(steps, round(steps), rel_tol=1e-9, abs_tol=1e-9)


def warn_of_unused(node: Any) -> None:
    """Log a warning for each parameter that was set at the node's start but never declared."""
    for name in node._unused_parameters:
        node.get_logger().warning(undeclared(name, node._parameters), once=False)


def set_result(successful: bool, reason: str) -> Any:
    """Return a SetParametersResult message with `successful` and the reason of a rejection."""
    kind = INTERFACES.message("rcl_interfaces/SetParametersResult")
    return kind(successful=successful, reason=reason)


def _kind_and_value(name: str, declared: Any, descriptor: Any) -> tuple[Type, Any]:
    """Return the type and the default value of a parameter to declare.

    If a type is declared, the default value is None.

    Raises:
        ValueError: If `declared` is not possible with this descriptor.
    """
    if isinstance(declared, INTERFACES.message("rcl_interfaces/ParameterValue")):
        if not descriptor.dynamic_typing:
            raise ValueError(
                "a ParameterValue is not a default value: give the value itself, or a "
                "Parameter.Type"
            )
        declared = value_of(declared)
    if isinstance(declared, Type):
        if declared is Type.NOT_SET:
            raise ValueError(
                f"parameter '{name}' cannot have the type NOT_SET: leave it out, or give a "
                "descriptor with dynamic_typing=True"
            )
        if descriptor.dynamic_typing:
            raise ValueError(
                f"parameter '{name}' has both a type and dynamic_typing=True: leave one of them out"
            )
        return declared, None
    if isinstance(declared, Parameter):
        return declared.type_, declared.value
    return Type.from_parameter_value(declared), declared


def _word(value: Any) -> str:
    try:
        return Type.from_parameter_value(value).name
    except TypeError:
        return type(value).__name__


def _hint(wanted: Type, value: Any) -> str:
    if wanted is Type.DOUBLE and type(value) is int:
        return f": write {value}.0"
    if wanted is Type.STRING and isinstance(value, bool | int | float):
        return f": write '\"{value}\"' to pass a text"
    return ""


def services_of(node: NodeParameters) -> Iterator[tuple[str, Any, Answer]]:
    """Yield (name, type, handler) of the services that read and set a node's parameters."""

    def values(names: Sequence[str]) -> list[Any]:
        # As in ROS 2, return no values if one parameter has none.
        try:
            return [one.get_parameter_value() for one in node.get_parameters(names)]
        except (ParameterNotDeclaredException, ParameterUninitializedException):
            return []

    def change(parameters: Sequence[Any]) -> Any:
        # A request may contain an invalid type, or a value of another type.
        try:
            changes = [Parameter.from_parameter_msg(one) for one in parameters]
            return node.set_parameters_atomically(changes)
        except (ParameterNotDeclaredException, ValueError, TypeError) as error:
            return set_result(False, str(error))

    return parameter_services(
        values=values,
        descriptors=lambda names: node.describe_parameters(filter(node.has_parameter, names)),
        listed=node.list_parameters,
        change=change,
    )
