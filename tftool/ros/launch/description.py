"""launch's descriptions: lists of actions, and where they come from."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from tftool.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import perform


class LaunchDescription:
    """What a launch consists of."""

    def __init__(self, initial_entities: Iterable[Any] | None = None, **kwargs: Any) -> None:
        self.entities: list[Any] = list(initial_entities or ())

    def add_action(self, action: Any) -> None:
        """Append an action."""
        self.entities.append(action)

    add_entity = add_action

    def visit(self, context: LaunchContext) -> Sequence[Any]:
        """Its actions."""
        return self.entities


LaunchDescriptionEntity = LaunchDescription


class LaunchDescriptionSource:
    """Where a description comes from."""

    def __init__(self, launch_description: Any = None, location: Any = "") -> None:
        self.description = launch_description
        self.location = location

    def load(self, context: LaunchContext) -> tuple[LaunchDescription, Path | None]:
        """The description, and its file."""
        if self.description is not None:
            return self.description, None
        path = Path(perform(context, self.location))
        if context.load is None:
            raise UsageError(f"'{path}' is included where nothing is launched")
        return context.load(path), path


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python."""

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path)


XMLLaunchDescriptionSource = YAMLLaunchDescriptionSource = PythonLaunchDescriptionSource
AnyLaunchDescriptionSource = FrontendLaunchDescriptionSource = PythonLaunchDescriptionSource
