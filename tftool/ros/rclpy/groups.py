"""rclpy's callback groups: which callbacks may run concurrently."""

from typing import Any


class CallbackGroup:
    """Callbacks with a common rule."""

    def __init__(self) -> None:
        self.busy = 0

    def add_entity(self, entity: Any) -> None:
        """Do nothing: entities know their group."""

    def has_entity(self, entity: Any) -> bool:
        """Return whether an entity belongs to it."""
        return getattr(entity, "callback_group", None) is self

    def can_execute(self, entity: Any) -> bool:
        """Return whether a callback of this group may start."""
        raise NotImplementedError

    def beginning_execution(self, entity: Any) -> bool:
        """Record the start of a callback; return False if another one prevents it."""
        if not self.can_execute(entity):
            return False
        self.busy += 1
        return True

    def ending_execution(self, entity: Any) -> None:
        """Record the end of a callback."""
        self.busy -= 1


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """Group of callbacks of which one runs at a time."""

    def can_execute(self, entity: Any) -> bool:
        """Return whether no other callback of the group is running."""
        return self.busy == 0


class ReentrantCallbackGroup(CallbackGroup):
    """Group of callbacks that may all run concurrently."""

    def can_execute(self, entity: Any) -> bool:
        """Return True."""
        return True
