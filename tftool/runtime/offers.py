"""What a world knows of a service or an action that is served."""

from dataclasses import dataclass
from typing import Any, Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Offer(Generic[T]):
    """A service or an action.

    Attributes:
        take: What answers requests, or takes goals.
        kind: The ROS class of the service or action. None where it is not stated; it stays inside
            the process then, and takes anything.
        node: The node that answers, "" where it is not stated.
        is_remote: Whether another process answers; a server here takes its place.
    """

    take: T
    kind: Any = None
    node: str = ""
    is_remote: bool = False
