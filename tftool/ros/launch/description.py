"""Launch descriptions (lists of actions), their sources, and the base class of actions."""

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.ros.host.error_text import near_keyword
from tftool.ros.host.fibers import user_line
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.events import ExecutionComplete
from tftool.ros.launch.substitutions import perform

SomeEntitiesType = Any
"""Type of an action or a list of actions, for annotations."""


class LaunchDescriptionEntity:
    """Base class of actions and launch descriptions."""

    def visit(self, context: LaunchContext) -> Any:
        """Execute this action or description; return the actions to execute next."""
        return None

    def describe(self) -> str:
        """Return this action or description as text."""
        raise NotImplementedError

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the inner actions, which the launch searches for declared arguments."""
        return []

    def describe_conditional_sub_entities(self) -> Sequence[tuple[str, Sequence[Any]]]:
        """Return (condition as text, actions) for the inner actions that depend on a condition."""
        return []

    def get_asyncio_future(self) -> Any:
        """Return a future that is done when the action ends; None if the action ends at once."""
        return None


class LaunchDescription(LaunchDescriptionEntity):
    """List of the actions of a launch.

    The description is deprecated if `deprecated_reason` is not None.
    """

    def __init__(
        self, initial_entities: Iterable[Any] | None = None, *, deprecated_reason: str | None = None
    ) -> None:
        self.entities: list[Any] = list(initial_entities or ())
        self.deprecated_reason = deprecated_reason

    @property
    def deprecated(self) -> bool:
        """Whether the description is deprecated, that is, has a `deprecated_reason`."""
        return self.deprecated_reason is not None

    def describe(self) -> str:
        """Return the description as text."""
        return f"{type(self).__name__}()"

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the actions of the description."""
        return self.entities

    def add_action(self, action: Any) -> None:
        """Append an action to the description."""
        self.entities.append(action)

    add_entity = add_action

    def visit(self, context: LaunchContext) -> Sequence[Any]:
        """Return the actions of the description."""
        return self.entities


class LaunchDescriptionSource:
    """Source of a launch description: the object itself, or the path of a launch file."""

    def __init__(self, launch_description: Any = None, location: Any = "") -> None:
        self.description = launch_description
        self.location = location

    def load(self, context: LaunchContext) -> tuple[LaunchDescription, Path | None]:
        """Return (description, path of its file); the path is None for a description object."""
        if self.description is not None:
            return self.description, None
        path = Path(perform(context, self.location))
        if context.load is None:
            raise UsageError(f"'{path}' cannot be included: no launch is running")
        return context.load(path), path


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """Source of a launch description: the path of a Python launch file."""

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path)


XMLLaunchDescriptionSource = YAMLLaunchDescriptionSource = PythonLaunchDescriptionSource
AnyLaunchDescriptionSource = FrontendLaunchDescriptionSource = PythonLaunchDescriptionSource


class Action(LaunchDescriptionEntity):
    """Base class of a launch's actions; `execute` does the work and may return further actions.

    For an action that takes long, such as a process, `execute` only starts the work; the launch
    (`context.launch`) then continues the work.

    Attributes:
        condition: Condition for executing the action; None to execute it always.
        where: "file:line" of the action in the launch file.
        takes_time: Whether the action may end after `execute` returns. The launch then emits the
            event of the action's end.
        is_begun: Whether the action was executed.
        is_awaited: Whether a handler for the action's end existed when the action began.
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
            raise TypeError(f"{type(self).__name__} has no argument {named}{hint}")

    def visit(self, context: LaunchContext) -> Any:
        """Execute the action if its condition is true; return the actions to execute next."""
        if self.condition is not None and not self.condition.evaluate(context):
            return None
        following = self.execute(context)
        # As in ROS 2, a handler registered later is not notified of the end.
        self.is_begun = True
        if context.launch is None:
            return following
        self.is_awaited = context.launch.is_awaited(ExecutionComplete(action=self))
        if not self.takes_time:
            context.launch.complete(self)
        return following

    def execute(self, context: LaunchContext) -> Any:
        """Execute the action; return the actions to execute next, or None."""
        return None

    def describe(self) -> str:
        """Return the action as text."""
        return f"{type(self).__name__}()"
