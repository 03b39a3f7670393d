"""Quality-of-service profiles of rclpy.

Within one process, only depth and durability have an effect.
"""

from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass
from enum import Enum, IntEnum
from typing import Any

from tftool.ros.rclpy.time import Duration, Infinite
from tftool.world.endpoints import Quality, Timing, conflict


class _Policy(IntEnum):
    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the names of all values of this policy in lower case, such as "reliable"."""
        return [policy.name.lower() for policy in cls]

    @property
    def short_key(self) -> str:
        """Name of this value in lower case."""
        return self.name.lower()

    @classmethod
    def get_from_short_key(cls, name: str) -> int:
        """Return the number of the value with the lower-case name `name`."""
        return cls[name.upper()].value


class HistoryPolicy(_Policy):
    """Rule for a queue: store all messages, or only the newest ones up to the queue's depth."""

    SYSTEM_DEFAULT = 0
    RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = 1
    KEEP_ALL = 2
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = 2
    UNKNOWN = 3


class ReliabilityPolicy(_Policy):
    """Rule for delivery: deliver every message, or allow the loss of messages."""

    SYSTEM_DEFAULT = 0
    RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT = 0
    RELIABLE = 1
    RMW_QOS_POLICY_RELIABILITY_RELIABLE = 1
    BEST_EFFORT = 2
    RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class DurabilityPolicy(_Policy):
    """Rule for late subscribers: send stored messages and new messages, or only new messages."""

    SYSTEM_DEFAULT = 0
    RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = 1
    VOLATILE = 2
    RMW_QOS_POLICY_DURABILITY_VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class LivelinessPolicy(_Policy):
    """Rule for how a publisher shows that it is alive: automatically, or by its messages."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


QoSHistoryPolicy = HistoryPolicy
QoSReliabilityPolicy = ReliabilityPolicy
QoSDurabilityPolicy = DurabilityPolicy
QoSLivelinessPolicy = LivelinessPolicy


class QoSPolicyKind(IntEnum):
    """Policy of a QoS profile, with the numbers of ROS 2."""

    INVALID = 1
    DURABILITY = 2
    DEADLINE = 4
    LIVELINESS = 8
    RELIABILITY = 16
    HISTORY = 32
    LIFESPAN = 64
    DEPTH = 128
    LIVELINESS_LEASE_DURATION = 256
    AVOID_ROS_NAMESPACE_CONVENTIONS = 512


class InvalidQoSProfileException(Exception):
    """Error for an incomplete or contradictory QoS profile."""

    def __init__(self, *args: object) -> None:
        super().__init__("Invalid QoSProfile", *args)


class QoSProfile:
    """Quality-of-service settings of a publisher or subscription."""

    def __init__(self, **kwargs: Any) -> None:
        known = ("history", "depth", "reliability", "durability", "lifespan", "deadline",
                 "liveliness", "liveliness_lease_duration",
                 "avoid_ros_namespace_conventions")  # fmt: skip
        wrong = [key for key in kwargs if key not in known]
        if wrong:
            raise TypeError(f"QoSProfile has no setting {wrong[0]!r}; it has {', '.join(known)}")
        if "history" not in kwargs and "depth" not in kwargs:
            raise InvalidQoSProfileException("History and/or depth settings are required.")
        self.history = HistoryPolicy(kwargs.get("history", HistoryPolicy.KEEP_LAST))
        if self.history is HistoryPolicy.KEEP_LAST and "depth" not in kwargs:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        self.depth = int(kwargs.get("depth", 0))
        if self.depth < 0:
            raise ValueError("depth must be greater than or equal to zero")
        self.reliability = ReliabilityPolicy(kwargs.get("reliability", ReliabilityPolicy.RELIABLE))
        self.durability = DurabilityPolicy(kwargs.get("durability", DurabilityPolicy.VOLATILE))
        self.liveliness = LivelinessPolicy(
            kwargs.get("liveliness", LivelinessPolicy.SYSTEM_DEFAULT)
        )
        self.lifespan = kwargs.get("lifespan", Duration())
        self.deadline = kwargs.get("deadline", Duration())
        self.liveliness_lease_duration = kwargs.get("liveliness_lease_duration", Duration())
        self.avoid_ros_namespace_conventions = bool(
            kwargs.get("avoid_ros_namespace_conventions", False)
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, QoSProfile) and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"QoSProfile({', '.join(f'{key}={value}' for key, value in vars(self).items())})"


def quality_of(profile: QoSProfile, *, offered: bool) -> Quality:
    """Convert a QoS profile to tftool's class for quality of service.

    Args:
        profile: Profile of a publisher or subscription.
        offered: Whether the profile belongs to a publisher. "Best available" then means the
            strictest setting; for a subscription it means the least strict setting.
    """
    reliability, durability = profile.reliability, profile.durability
    asks_little = reliability is ReliabilityPolicy.BEST_AVAILABLE and not offered
    keeps = durability is DurabilityPolicy.BEST_AVAILABLE and offered
    return Quality(
        profile.depth,
        is_reliable=reliability is not ReliabilityPolicy.BEST_EFFORT and not asks_little,
        is_latched=durability is DurabilityPolicy.TRANSIENT_LOCAL or keeps,
        keeps_all=profile.history is HistoryPolicy.KEEP_ALL,
        timing=Timing(
            _limit(profile.deadline),
            _limit(profile.liveliness_lease_duration),
            profile.liveliness is LivelinessPolicy.MANUAL_BY_TOPIC,
            _limit(profile.lifespan),
        ),
    )


def _limit(duration: Duration) -> int | None:
    length = duration.nanoseconds
    return None if length in (0, Infinite.nanoseconds) else length


class QoSCompatibility(IntEnum):
    """Result of the comparison of a publisher's profile with a subscription's profile."""

    OK = 0
    WARNING = 1
    ERROR = 2


def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> tuple[QoSCompatibility, str]:
    """Compare a publisher's profile with a subscription's profile.

    Returns:
        (OK, "") for compatible profiles; otherwise (ERROR, reason).
    """
    policy = conflict(
        quality_of(publisher_qos, offered=True), quality_of(subscription_qos, offered=False)
    )
    if not policy:
        return QoSCompatibility.OK, ""
    return QoSCompatibility.ERROR, f"ERROR: {_UNFIT[policy]};"


_UNFIT = {
    "RELIABILITY": "Best effort publisher and reliable subscription",
    "DURABILITY": "Volatile publisher and transient local subscription",
    "DEADLINE": "Publisher's deadline is longer than the subscription's",
    "LIVELINESS": "Publisher promises less liveliness than the subscription asks for",
}


def _time(length: int | None) -> Duration:
    return Infinite if length is None else Duration(nanoseconds=length)


def profile_from(quality: Quality) -> QoSProfile:
    """Convert tftool's class for quality of service to a QoS profile.

    Deadline, lifespan and liveliness get default values if `quality` has no timing.
    """
    timing = quality.timing or Timing()
    manual = timing.is_manual
    return QoSProfile(
        deadline=_time(timing.deadline),
        liveliness_lease_duration=_time(timing.lease),
        lifespan=_time(timing.lifespan),
        liveliness=LivelinessPolicy.MANUAL_BY_TOPIC if manual else LivelinessPolicy.AUTOMATIC,
        depth=quality.depth,
        history=HistoryPolicy.KEEP_ALL if quality.keeps_all else HistoryPolicy.KEEP_LAST,
        reliability=ReliabilityPolicy.RELIABLE
        if quality.is_reliable
        else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if quality.is_latched
        else DurabilityPolicy.VOLATILE,
    )


def profile_of(profile_or_depth: "QoSProfile | int") -> QoSProfile:
    """Return a QoS profile unchanged; for a depth, return the default profile with this depth.

    Raises:
        TypeError: If the argument is neither a profile nor an integer.
        ValueError: If the depth is negative.
    """
    if isinstance(profile_or_depth, QoSProfile):
        return profile_or_depth
    if not isinstance(profile_or_depth, int):
        raise TypeError(f"Expected QoSProfile or int, but received {type(profile_or_depth)!r}")
    return QoSProfile(depth=profile_or_depth)


qos_profile_default = QoSProfile(depth=10)
qos_profile_system_default = QoSProfile(depth=10)
qos_profile_sensor_data = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
qos_profile_services_default = QoSProfile(depth=10)
qos_profile_parameters = QoSProfile(depth=1000)
qos_profile_parameter_events = QoSProfile(depth=1000)
qos_profile_rosout_default = QoSProfile(
    depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=Duration(seconds=10)
)
qos_profile_action_status_default = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


qos_profile_unknown = QoSProfile(
    history=HistoryPolicy.UNKNOWN,
    reliability=ReliabilityPolicy.UNKNOWN,
    durability=DurabilityPolicy.UNKNOWN,
    liveliness=LivelinessPolicy.UNKNOWN,
)
qos_profile_best_available = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_AVAILABLE,
    durability=DurabilityPolicy.BEST_AVAILABLE,
    liveliness=LivelinessPolicy.BEST_AVAILABLE,
)


class QoSPresetProfiles(Enum):
    """Predefined QoS profiles of rclpy; the attribute `value` is the profile."""

    UNKNOWN = qos_profile_unknown
    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the names of the predefined profiles in lower case."""
        return [state.lower() for state in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile:
        """Return the predefined profile with the lower-case name `name`."""
        return cls[name.upper()].value


class InvalidQosOverridesError(Exception):
    """Error for parameters that make a QoS profile invalid, or that a callback rejects."""


@dataclass(slots=True)
class QosCallbackResult:
    """Result of a user's callback that accepts or rejects a QoS profile."""

    successful: bool = False
    reason: str = ""


@dataclass(slots=True)
class QoSOverridingOptions:
    """QoS policies that parameters can change, and a callback that checks the changed profile."""

    policy_kinds: Sequence[QoSPolicyKind]
    _: KW_ONLY
    callback: Callable[[QoSProfile], QosCallbackResult] | None = None
    entity_id: str | None = None

    @classmethod
    def with_default_policies(cls, **options: Any) -> "QoSOverridingOptions":
        """Return options that let parameters change history, depth and reliability."""
        kinds = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(kinds, **options)


def qos_policy_parameter(qos: QoSProfile, policy: QoSPolicyKind) -> Any:
    """Return a policy of a QoS profile as the value of a parameter.

    The value is a lower-case name, a number of messages, or a number of nanoseconds.
    """
    value = getattr(qos, policy.name.lower())
    if isinstance(value, Duration):
        return value.nanoseconds
    return value if policy is QoSPolicyKind.DEPTH else value.name.lower()


def declare_qos_parameters(
    entity_type: Any, node: Any, topic: str, qos: QoSProfile, options: QoSOverridingOptions
) -> None:
    """Declare a parameter for each QoS policy in `options`; set `qos` to the parameters' values.

    Raises:
        InvalidQosOverridesError: If a parameter's value is invalid, or the callback in `options`
            rejects the profile.
    """
    sort = "publisher" if "Publisher" in entity_type.__name__ else "subscription"
    which = f"{sort}_{options.entity_id}" if options.entity_id else sort
    for policy in options.policy_kinds:
        name = f"qos_overrides.{topic}.{which}.{policy.name.lower()}"
        default = qos_policy_parameter(qos, policy)
        known = node.has_parameter(name)
        value = (node.get_parameter(name) if known else node.declare_parameter(name, default)).value
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
            raise InvalidQosOverridesError(
                f"'{value}' is not a valid value of {name}: {error}"
            ) from error
    if options.callback is not None:
        result = options.callback(qos)
        if not result.successful:
            raise InvalidQosOverridesError(f"qos_overrides of {topic}: {result.reason}")
