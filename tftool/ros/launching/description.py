"""launch's descriptions: lists of actions, from Python, XML or YAML."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from tftool.errors import InputError
from tftool.ros import users
from tftool.ros.launching.context import LaunchContext
from tftool.ros.launching.substitutions import perform


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
        return load_file(path), path


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python."""

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path)


XMLLaunchDescriptionSource = YAMLLaunchDescriptionSource = PythonLaunchDescriptionSource
AnyLaunchDescriptionSource = FrontendLaunchDescriptionSource = PythonLaunchDescriptionSource


def load_file(path: Path) -> LaunchDescription:
    """The description in a launch file.

    Raises:
        InputError: If it cannot be read, is none, or raises; the user's own line is shown.
    """
    if path.suffix == ".xml":
        from tftool.ros.launching.frontends import from_xml

        return from_xml(path)
    if path.suffix in (".yaml", ".yml"):
        from tftool.ros.launching.frontends import from_yaml

        return from_yaml(path)
    return _from_python(path)


def _from_python(path: Path) -> LaunchDescription:
    code = users.compile_file(path)
    module = ModuleType("launch_file")
    module.__file__ = str(path)
    try:
        exec(code, module.__dict__)
        make = module.__dict__.get("generate_launch_description")
        if make is None:
            raise InputError(
                f"'{path}' is no launch file: it has no function generate_launch_description()"
            )
        description = make()
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"{path}: {users.sentence_of(error)}") from error
    if not isinstance(description, LaunchDescription):
        raise InputError(
            f"{path}: generate_launch_description() must return a LaunchDescription, not "
            f"{type(description).__name__}"
        )
    return description
