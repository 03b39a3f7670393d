"""What both ends of an action know of a goal."""

import itertools
from enum import IntEnum
from typing import Any

from tftool.interfaces.classes import INTERFACES

_numbers = itertools.count(1)


class GoalStatus(IntEnum):
    """How far a goal is, as action_msgs numbers it."""

    STATUS_UNKNOWN = 0
    STATUS_ACCEPTED = 1
    STATUS_EXECUTING = 2
    STATUS_CANCELING = 3
    STATUS_SUCCEEDED = 4
    STATUS_CANCELED = 5
    STATUS_ABORTED = 6


STATUS: dict[str, GoalStatus] = {
    "succeeded": GoalStatus.STATUS_SUCCEEDED,
    "canceled": GoalStatus.STATUS_CANCELED,
    "aborted": GoalStatus.STATUS_ABORTED,
}


def new_id() -> Any:
    """A goal's id; they are counted, so that two runs are the same run."""
    number = next(_numbers)
    kind = INTERFACES.message("unique_identifier_msgs/UUID")
    return kind(uuid=list(number.to_bytes(16, "big")))
