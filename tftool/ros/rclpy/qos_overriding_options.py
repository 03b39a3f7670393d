"""rclpy.qos_overriding_options: a topic's QoS set by its node's parameters."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from tftool.ros.rclpy.qos import QoSPolicyKind, QoSProfile
from tftool.ros.rclpy.time import Duration

_DEFAULT = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)


class InvalidQosOverridesError(Exception):
    """Error for a refused profile from parameters."""


@dataclass(slots=True)
class QosCallbackResult:
    """Result of a callback that checks a profile."""

    successful: bool = False
    reason: str = ""


class QoSOverridingOptions:
    """Policies of a topic that parameters may set, and the callback that checks the result."""

    def __init__(
        self,
        policy_kinds: Sequence[QoSPolicyKind],
        *,
        callback: Callable[[QoSProfile], QosCallbackResult] | None = None,
        entity_id: str | None = None,
    ) -> None:
        self.policy_kinds = tuple(policy_kinds)
        self.callback = callback
        self.entity_id = entity_id

    @classmethod
    def with_default_policies(
        cls,
        *,
        callback: Callable[[QoSProfile], QosCallbackResult] | None = None,
        entity_id: str | None = None,
    ) -> "QoSOverridingOptions":
        """Return options for history, depth and reliability."""
        return cls(_DEFAULT, callback=callback, entity_id=entity_id)


def _get_qos_policy_parameter(qos: QoSProfile, policy: QoSPolicyKind) -> Any:
    """Return a policy's value as a parameter: a lower-case name, or a number."""
    value = getattr(qos, policy.name.lower())
    if isinstance(value, Duration):
        return value.nanoseconds
    return value if policy is QoSPolicyKind.DEPTH else value.name.lower()


def declare_overrides(
    node: Any, sort: str, topic: str, qos: QoSProfile, options: QoSOverridingOptions
) -> None:
    """Declare the parameters of a topic's policies, and apply their values to the profile.

    Raises:
        InvalidQosOverridesError: If a value is none of its policy, or the callback refuses.
    """
    which = f"{sort}_{options.entity_id}" if options.entity_id else sort
    for policy in options.policy_kinds:
        name = f"qos_overrides.{topic}.{which}.{policy.name.lower()}"
        default = _get_qos_policy_parameter(qos, policy)
        if node.has_parameter(name):
            value = node.get_parameter(name).value
        else:
            value = node.declare_parameter(name, default).value
        field = policy.name.lower()
        before = getattr(qos, field)
        try:
            if isinstance(before, Duration):
                setattr(qos, field, Duration(nanoseconds=value))
            elif policy is QoSPolicyKind.DEPTH:
                qos.depth = value
            else:
                setattr(qos, field, type(before)[str(value).upper()])
        except (KeyError, TypeError, ValueError) as error:
            raise InvalidQosOverridesError(f"'{value}' is no value of {name}: {error}") from error
    if options.callback is not None:
        result = options.callback(qos)
        if not result.successful:
            raise InvalidQosOverridesError(f"qos_overrides of {topic}: {result.reason}")


def _declare_qos_parameters(
    entity_type: Any, node: Any, topic: str, qos: QoSProfile, options: QoSOverridingOptions
) -> None:
    """Declare the parameters, called as in rclpy with the class of the topic's endpoint."""
    sort = "publisher" if "Publisher" in entity_type.__name__ else "subscription"
    declare_overrides(node, sort, topic, qos, options)
