"""launch's Action."""

import sys
from typing import Any, ClassVar

from tftool.ros.host.fibers import user_line
from tftool.ros.host.missing_names import near_keyword
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import LaunchDescriptionEntity
from tftool.ros.launch.events import ExecutionComplete


class Action(LaunchDescriptionEntity):
    """One step of a launch: `execute` returns further actions, or None.

    Long work is passed to the launch (`context.launch`).

    Attributes:
        condition: Whether it is done at all; None for always.
        where: "file:line" where the launch file says it.
        takes_time: Whether it is done only some time after `execute`; the launch says when.
        is_begun: Whether it was carried out.
        is_awaited: Whether a handler waited for its end when it began.
    """

    takes_time: ClassVar[bool] = False
    is_begun = False
    is_awaited = False

    def __init__(self, *, condition: Any = None, **kwargs: Any) -> None:
        self.condition = condition
        place = user_line(sys._getframe(1))
        self.where = "" if place is None else f"{place.file}:{place.line}"
        if kwargs:
            hint = near_keyword(next(iter(kwargs)), type(self))
            named = ", ".join(map(repr, kwargs))
            raise TypeError(f"{type(self).__name__} takes no argument {named} here{hint}")

    def visit(self, context: LaunchContext) -> Any:
        """Execute the action if its condition is true; return the next actions."""
        if self.condition is not None and not self.condition.evaluate(context):
            return None
        following = self.execute(context)
        # As in ROS 2: who begins to wait for it later is not told.
        self.is_begun = True
        if context.launch is None:
            return following
        self.is_awaited = context.launch.is_awaited(ExecutionComplete(action=self))
        if not self.takes_time:
            context.launch.complete(self)
        return following

    @classmethod
    def parse(cls, entity: Any, parser: Any) -> tuple[Any, dict[str, Any]]:
        """Parse an XML or YAML element of a user's own action class.

        The launch reads the condition of every class.
        """
        return cls, {}

    def execute(self, context: LaunchContext) -> Any:
        """Execute the action."""
        return None

    def describe(self) -> str:
        """Return its text form."""
        return f"{type(self).__name__}()"
