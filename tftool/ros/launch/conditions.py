"""Conditions of ROS's launch, which decide whether an action is executed."""

from collections.abc import Callable
from typing import Any

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import describe, is_true, perform


class InvalidConditionExpressionError(UsageError):
    """Error for a condition whose text is neither "true" or "1", nor "false" or "0"."""


class Condition:
    """Condition of an action, computed by a predicate function; false without a predicate."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether the condition is true in a launch context."""
        return self._predicate is not None and self._predicate(context)

    def describe(self) -> str:
        """Return the condition as text."""
        return f"{type(self).__name__}()"


def evaluate_condition_expression(context: LaunchContext, expression: Any) -> bool:
    """Return True if the expression's text is "true" or "1", and False if it is "false" or "0".

    Raises:
        InvalidConditionExpressionError: If the expression has another text.
    """
    text = perform(context, expression)
    try:
        return is_true(text)
    except UsageError as error:
        raise InvalidConditionExpressionError(str(error)) from None


class _TextCondition(Condition):
    wanted = True

    def __init__(self, predicate_expression: Any) -> None:
        super().__init__(
            predicate=lambda context: (
                evaluate_condition_expression(context, predicate_expression) is self.wanted
            )
        )
        self._expression = predicate_expression

    def describe(self) -> str:
        """Return the condition as text, such as "IfCondition('expression')"."""
        return f"{type(self).__name__}({describe(self._expression)})"


class IfCondition(_TextCondition):
    """Condition that is true if a text is "true" or "1"."""


class UnlessCondition(_TextCondition):
    """Condition that is true if a text is "false" or "0"."""

    wanted = False


class LaunchConfigurationEquals(Condition):
    """Condition that is true if a launch argument has a given value."""

    def __init__(self, launch_configuration_name: str, expected_value: Any) -> None:
        name = launch_configuration_name

        def equal(context: LaunchContext) -> bool:
            value = context.launch_configurations.get(name)
            if expected_value is None:
                return value is None
            return value == perform(context, expected_value)

        super().__init__(predicate=equal)


class LaunchConfigurationNotEquals(Condition):
    """Condition that is true unless a launch argument has a given value."""

    def __init__(self, launch_configuration_name: str, expected_value: Any) -> None:
        same = LaunchConfigurationEquals(launch_configuration_name, expected_value)
        super().__init__(predicate=lambda context: not same.evaluate(context))
