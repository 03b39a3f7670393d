"""launch's actions that set arguments and environment variables."""

import os
from collections.abc import Mapping, Sequence
from typing import Any

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action
from tftool.ros.launch.substitutions import describe, is_true, perform


class DeclareLaunchArgument(Action):
    """Declares an argument of the launch file."""

    def __init__(
        self,
        name: str,
        *,
        default_value: Any = None,
        description: str | None = None,
        choices: Sequence[str] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.name = name
        self.default_value = default_value
        self.choices = None if choices is None else list(choices)
        self.description = description or "no description given"
        if self.choices is not None:
            end = "" if self.description.endswith(".") else "."
            self.description += f"{end} Valid choices are: {self.choices}"

    def execute(self, context: LaunchContext) -> Any:
        """Set the default unless a value was given.

        Raises:
            UsageError: If there is neither, or the value is none of the choices.
        """
        configurations = context.launch_configurations
        if self.name not in configurations:
            if self.default_value is None:
                raise UsageError(
                    f"launch argument '{self.name}' ({self.description}) has no default: pass "
                    f"{self.name}:=…"
                )
            configurations[self.name] = perform(context, self.default_value)
        value = configurations[self.name]
        if self.choices is not None and value not in self.choices:
            raise UsageError(
                f"launch argument '{self.name}' is one of {', '.join(self.choices)}, not '{value}'"
            )
        return None

    def shown_default(self) -> str | None:
        """Return the default as --show-args displays it."""
        return None if self.default_value is None else describe(self.default_value)


class SetLaunchConfiguration(Action):
    """Sets an argument."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set the argument."""
        context.launch_configurations[perform(context, self.name)] = perform(context, self.value)


class UnsetLaunchConfiguration(Action):
    """Removes an argument."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Remove the argument."""
        context.launch_configurations.pop(perform(context, self.name), None)


class ResetLaunchConfigurations(Action):
    """Removes all arguments, or replaces them."""

    def __init__(
        self, launch_configurations: Mapping[Any, Any] | None = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.kept = dict(launch_configurations or {})

    def execute(self, context: LaunchContext) -> Any:
        """Reset the arguments."""
        given = {perform(context, key): perform(context, one) for key, one in self.kept.items()}
        context.launch_configurations = given


class SetEnvironmentVariable(Action):
    """Sets an environment variable for later processes."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set the variable."""
        context.environment[perform(context, self.name)] = perform(context, self.value)


class SetLogFolder(Action):
    """Sets the log folder: used by other programs, since nodes here write no logs."""

    def __init__(self, new_log_dir: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.new_log_dir = new_log_dir

    def execute(self, context: LaunchContext) -> Any:
        """Set the folder, inside the present one unless it is absolute."""
        before = context.environment.get("ROS_LOG_DIR", "")
        folder = os.path.join(before, perform(context, self.new_log_dir))
        context.environment["ROS_LOG_DIR"] = folder


class AppendEnvironmentVariable(Action):
    """Appends to an environment variable, or prepends."""

    def __init__(
        self,
        name: Any,
        value: Any,
        prepend: Any = False,
        separator: Any = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value
        self.prepend, self.separator = prepend, separator

    def execute(self, context: LaunchContext) -> Any:
        """Extend the variable."""
        name, value = perform(context, self.name), perform(context, self.value)
        before = context.environment.get(name)
        parts = [value] if before is None else [before, value]
        if is_true(perform(context, self.prepend)):
            parts.reverse()
        context.environment[name] = perform(context, self.separator).join(parts)


class UnsetEnvironmentVariable(Action):
    """Removes an environment variable."""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context: LaunchContext) -> Any:
        """Remove the variable."""
        context.environment.pop(perform(context, self.name), None)


class PushEnvironment(Action):
    """Saves the environment variables for a PopEnvironment."""

    def execute(self, context: LaunchContext) -> Any:
        """Save the variables."""
        context.environments.append(dict(context.environment))


class PopEnvironment(Action):
    """Restores the environment variables of the last PushEnvironment."""

    def execute(self, context: LaunchContext) -> Any:
        """Restore the variables.

        Raises:
            UsageError: If there was none.
        """
        if not context.environments:
            raise UsageError("there is no PushEnvironment before this PopEnvironment")
        context.environment = context.environments.pop()


class ResetEnvironment(Action):
    """Restores the environment variables of the launch's beginning."""

    def execute(self, context: LaunchContext) -> Any:
        """Restore the variables."""
        context.environment = dict(os.environ)


class Push(Action):
    """Opens a scope."""

    def execute(self, context: LaunchContext) -> Any:
        """Open a scope."""
        context.push()


class Pop(Action):
    """Closes a scope."""

    def execute(self, context: LaunchContext) -> Any:
        """Close the scope."""
        context.pop()
