"""rclpy's callback groups: which callbacks may run while another is in progress."""

from typing import Any


class CallbackGroup:
    """Callbacks that share a rule."""

    def __init__(self) -> None:
        self.busy = 0

    def add_entity(self, entity: Any) -> None:
        """Nothing to do: entities know their group."""

    def has_entity(self, entity: Any) -> bool:
        """Whether an entity belongs to it."""
        return getattr(entity, "callback_group", None) is self

    def can_execute(self, entity: Any) -> bool:
        """Whether a callback of this group may start now."""
        raise NotImplementedError

    def beginning_execution(self, entity: Any) -> bool:
        """Note that a callback starts; False where it must not, while another is in progress."""
        if not self.can_execute(entity):
            return False
        self.busy += 1
        return True

    def ending_execution(self, entity: Any) -> None:
        """Note that a callback ended."""
        self.busy -= 1


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """One at a time."""

    def can_execute(self, entity: Any) -> bool:
        """Whether no other callback of the group is in progress."""
        return self.busy == 0


class ReentrantCallbackGroup(CallbackGroup):
    """Any number at a time."""

    def can_execute(self, entity: Any) -> bool:
        """Always."""
        return True
