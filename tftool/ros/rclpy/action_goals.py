"""Facts about a goal known at both ends of an action."""

from enum import IntEnum

from tftool.world.action_parts import ENDED


class GoalStatus(IntEnum):
    """Status of a goal, with action_msgs' numbers."""

    STATUS_UNKNOWN = 0
    STATUS_ACCEPTED = 1
    STATUS_EXECUTING = 2
    STATUS_CANCELING = 3
    STATUS_SUCCEEDED = 4
    STATUS_CANCELED = 5
    STATUS_ABORTED = 6


STATUS: dict[str, GoalStatus] = {name: GoalStatus(number) for name, number in ENDED.items()}
