"""What a world knows of a service or an action that somebody answers."""

from dataclasses import dataclass
from typing import Any, Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Offer(Generic[T]):
    """A service or an action.

    Attributes:
        take: What answers requests, or takes goals.
        kind: What is asked: the type of our own requests or goals, or the ROS class of the
            service or action. None where nobody says; it stays inside the process then.
        node: The node that answers, "" where nobody says.
        is_remote: Whether another process answers. Whoever wants to answer here goes first.
    """

    take: T
    kind: Any = None
    node: str = ""
    is_remote: bool = False
