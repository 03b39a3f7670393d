"""launch's descriptions: lists of actions, their sources, and the base class of actions."""

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


class LaunchDescriptionEntity:
    """Base of actions and descriptions."""

    def visit(self, context: LaunchContext) -> Any:
        """Execute the entity; return the next actions."""
        return None

    def describe(self) -> str:
        """Return the entity as text."""
        raise NotImplementedError

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the entities inside, to search for arguments."""
        return []

    def describe_conditional_sub_entities(self) -> Sequence[tuple[str, Sequence[Any]]]:
        """Return the conditional entities inside, with their conditions."""
        return []

    def get_asyncio_future(self) -> Any:
        """Return the future of its end; None if it ends at once."""
        return None


class LaunchDescription(LaunchDescriptionEntity):
    """List of actions of a launch.

    Attributes:
        entities: Actions.
        deprecated_reason: Why it should be used no more, None where it may be.
    """

    def __init__(
        self,
        initial_entities: Iterable[Any] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        self.entities: list[Any] = list(initial_entities or ())
        self.deprecated_reason = deprecated_reason

    @property
    def deprecated(self) -> bool:
        """Whether the description is deprecated."""
        return self.deprecated_reason is not None

    def describe(self) -> str:
        """Return the description as text."""
        return f"{type(self).__name__}()"

    def describe_sub_entities(self) -> Sequence[Any]:
        """Return the actions of the description."""
        return self.entities

    def add_action(self, action: Any) -> None:
        """Append an action."""
        self.entities.append(action)

    add_entity = add_action

    def visit(self, context: LaunchContext) -> Sequence[Any]:
        """Return the actions of the description."""
        return self.entities


class LaunchDescriptionSource:
    """Source of a description."""

    def __init__(self, launch_description: Any = None, location: Any = "") -> None:
        self.description = launch_description
        self.location = location

    def load(self, context: LaunchContext) -> tuple[LaunchDescription, Path | None]:
        """Return the description, and its file."""
        if self.description is not None:
            return self.description, None
        path = Path(perform(context, self.location))
        if context.load is None:
            raise UsageError(f"'{path}' is included outside of a launch")
        return context.load(path), path


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """A Python launch file."""

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path)


XMLLaunchDescriptionSource = YAMLLaunchDescriptionSource = PythonLaunchDescriptionSource
AnyLaunchDescriptionSource = FrontendLaunchDescriptionSource = PythonLaunchDescriptionSource


class Action(LaunchDescriptionEntity):
    """One step of a launch: `execute` returns further actions, or None.

    Long work is passed to the launch (`context.launch`).

    Attributes:
        condition: Condition for executing the action; None for always.
        where: "file:line" where the launch file says it.
        takes_time: Whether the action ends some time after `execute`; the launch reports the end.
        is_begun: Whether the action was executed.
        is_awaited: Whether a handler for the action's end existed when it began.
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
        """Return the action as text."""
        return f"{type(self).__name__}()"
