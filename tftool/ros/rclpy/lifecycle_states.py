"""State machine of a lifecycle node, as in design.ros2.org and lifecycle_msgs."""

from enum import IntEnum
from typing import NamedTuple


class TransitionCallbackReturn(IntEnum):
    """Result of a transition's callback."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def to_label(self) -> str:
        """Return the name of the transition that follows."""
        return f"transition_{self.name.lower()}"


class LifecycleState(NamedTuple):
    """Name and number of a state."""

    label: str
    state_id: int


class Transition(NamedTuple):
    """Transition between two states."""

    number: int
    label: str
    start: str
    goal: str


STATES = {
    "unknown": 0,
    "unconfigured": 1,
    "inactive": 2,
    "active": 3,
    "finalized": 4,
    "configuring": 10,
    "cleaningup": 11,
    "shuttingdown": 12,
    "activating": 13,
    "deactivating": 14,
    "errorprocessing": 15,
}

CALLBACKS = {
    "configuring": "on_configure",
    "cleaningup": "on_cleanup",
    "activating": "on_activate",
    "deactivating": "on_deactivate",
    "shuttingdown": "on_shutdown",
    "errorprocessing": "on_error",
}
"""The callback of each state that lasts as long as one."""

_REQUESTS = (
    Transition(1, "configure", "unconfigured", "configuring"),
    Transition(2, "cleanup", "inactive", "cleaningup"),
    Transition(3, "activate", "inactive", "activating"),
    Transition(4, "deactivate", "active", "deactivating"),
    Transition(5, "shutdown", "unconfigured", "shuttingdown"),
    Transition(6, "shutdown", "inactive", "shuttingdown"),
    Transition(7, "shutdown", "active", "shuttingdown"),
)

# Where success, failure and an error lead, in the order of their numbers.
_OUTCOMES = {
    "configuring": ("inactive", "unconfigured", "errorprocessing"),
    "cleaningup": ("unconfigured", "inactive", "errorprocessing"),
    "activating": ("active", "inactive", "errorprocessing"),
    "deactivating": ("inactive", "active", "errorprocessing"),
    "shuttingdown": ("finalized", "finalized", "errorprocessing"),
    "errorprocessing": ("unconfigured", "finalized", "finalized"),
}

GRAPH = _REQUESTS + tuple(
    Transition(10 * tens + ones, result.to_label(), start, goal)
    for tens, (start, goals) in enumerate(_OUTCOMES.items(), 1)
    for ones, (result, goal) in enumerate(zip(TransitionCallbackReturn, goals, strict=True))
)
"""Every transition."""


class StateMachine:
    """State of a lifecycle node."""

    def __init__(self) -> None:
        self.state = LifecycleState("unconfigured", STATES["unconfigured"])

    @property
    def current_state(self) -> tuple[int, str]:
        """Number and name of the state."""
        return self.state.state_id, self.state.label

    @property
    def available_transitions(self) -> list[Transition]:
        """Return the transitions possible from here."""
        return [one for one in GRAPH if one.start == self.state.label]

    def take(self, wanted: str | int) -> Transition:
        """Start a transition by its name or number.

        Raises:
            RuntimeError: If it does not begin here.
        """
        for one in self.available_transitions:
            if wanted in (one.label, one.number):
                self.state = LifecycleState(one.goal, STATES[one.goal])
                return one
        possible = ", ".join(one.label for one in self.available_transitions) or "none"
        raise RuntimeError(
            f"no transition '{wanted}' from state '{self.state.label}'; possible: {possible}"
        )
