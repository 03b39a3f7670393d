"""launch's substitutions that say true or false, or choose by it."""

import math
from typing import Any

from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import Substitution, is_true, perform


class _Logic(Substitution):
    def __init__(self, left: Any, right: Any) -> None:
        self.left, self.right = left, right


class EqualsSubstitution(_Logic):
    """Whether two texts are equal; numbers compare as numbers, truths as truths."""

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        left, right = perform(context, self.left), perform(context, self.right)
        try:
            equal = math.isclose(float(left), float(right))
        except ValueError:
            truths = {"true", "false"}
            low = (left.lower(), right.lower())
            equal = low[0] == low[1] if set(low) <= truths else left == right
        return str(equal).lower()


class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two texts differ."""

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        return str(super().perform(context) == "false").lower()


class AndSubstitution(_Logic):
    """Whether both are true."""

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        both = is_true(perform(context, self.left)) and is_true(perform(context, self.right))
        return str(both).lower()


class OrSubstitution(_Logic):
    """Whether one is true."""

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        one = is_true(perform(context, self.left)) or is_true(perform(context, self.right))
        return str(one).lower()


class NotSubstitution(Substitution):
    """Whether something is false."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        return str(not is_true(perform(context, self.value))).lower()


class IfElseSubstitution(Substitution):
    """One text or another."""

    def __init__(self, condition: Any, if_value: Any = "", else_value: Any = "") -> None:
        self.condition, self.if_value, self.else_value = condition, if_value, else_value

    def perform(self, context: LaunchContext) -> str:
        """The text chosen."""
        chosen = is_true(perform(context, self.condition))
        return perform(context, self.if_value if chosen else self.else_value)


class AnySubstitution(Substitution):
    """Whether one of several is true."""

    def __init__(self, *args: Any) -> None:
        self.args = args

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        return str(any(is_true(perform(context, one)) for one in self.args)).lower()


class AllSubstitution(AnySubstitution):
    """Whether all of several are true."""

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        return str(all(is_true(perform(context, one)) for one in self.args)).lower()
