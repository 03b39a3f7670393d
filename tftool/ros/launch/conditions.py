"""launch's conditions."""

from collections.abc import Callable
from typing import Any

from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import is_true, perform


class Condition:
    """Whether an action is carried out."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool]) -> None:
        self._predicate = predicate

    def evaluate(self, context: LaunchContext) -> bool:
        """Whether it holds."""
        return self._predicate(context)


class IfCondition(Condition):
    """If a text is true."""

    def __init__(self, predicate_expression: Any) -> None:
        super().__init__(predicate=lambda c: is_true(perform(c, predicate_expression)))


class UnlessCondition(Condition):
    """If a text is false."""

    def __init__(self, predicate_expression: Any) -> None:
        super().__init__(predicate=lambda c: not is_true(perform(c, predicate_expression)))


class LaunchConfigurationEquals(Condition):
    """If an argument has a value."""

    def __init__(self, launch_configuration_name: str, expected_value: Any) -> None:
        name = launch_configuration_name

        def equal(context: LaunchContext) -> bool:
            value = context.launch_configurations.get(name)
            if expected_value is None:
                return value is None
            return value == perform(context, expected_value)

        super().__init__(predicate=equal)


class LaunchConfigurationNotEquals(Condition):
    """If an argument has another value."""

    def __init__(self, launch_configuration_name: str, expected_value: Any) -> None:
        same = LaunchConfigurationEquals(launch_configuration_name, expected_value)
        super().__init__(predicate=lambda context: not same.evaluate(context))
