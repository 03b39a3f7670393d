"""Substitutions of ROS's launch that compare texts or combine truth values."""

import math
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import Substitution, SubstitutionFailure, is_true, perform

_TRUTHS = {"true": True, "1": True, "false": False, "0": False}


def _truth(context: LaunchContext, value: Any) -> bool:
    """Evaluate substitutions: return True for the text "true" or "1", False for "false" or "0".

    Raises:
        SubstitutionFailure: If the text is none of these four.
    """
    try:
        return is_true(perform(context, value))
    except UsageError as error:
        raise SubstitutionFailure(str(error)) from None


class EqualsSubstitution(Substitution):
    """Substitution with the text 'true' if two texts are equal, else 'false'.

    Numbers are compared by value. The text '1' equals 'true', and '0' equals 'false'.
    """

    def __init__(self, left: Any, right: Any) -> None:
        self.left, self.right = left, right

    def perform(self, context: LaunchContext) -> str:
        """Return 'true' if the two texts are equal, else 'false'."""
        left, right = perform(context, self.left), perform(context, self.right)
        try:
            equal = math.isclose(float(left), float(right))
        except ValueError:
            # As in ROS 2, '1' equals 'true' and '0' equals 'false' if the other text is a word.
            truths = [_TRUTHS.get(text.lower(), text) for text in (left, right)]
            equal = truths[0] == truths[1]
        return str(equal).lower()


class NotEqualsSubstitution(EqualsSubstitution):
    """Substitution with the text 'true' if two texts differ, else 'false'."""

    def perform(self, context: LaunchContext) -> str:
        """Return 'true' if the two texts differ, else 'false'."""
        return str(super().perform(context) == "false").lower()


class _Several(Substitution):
    """Base class of substitutions that combine several truth values to 'true' or 'false'."""

    judge: ClassVar[Any]

    def __init__(self, *args: Any) -> None:
        self.args = args

    def perform(self, context: LaunchContext) -> str:
        """Return 'true' or 'false' for the combined truth values.

        As in ROS 2, all values are evaluated, even if the first value decides.
        """
        return str(self.judge([_truth(context, value) for value in self.args])).lower()


class AnySubstitution(_Several):
    """Substitution with the text 'true' if at least one of several texts is true."""

    judge = any


class AllSubstitution(_Several):
    """Substitution with the text 'true' if all of several texts are true."""

    judge = all


class _Both(_Several):
    def __init__(self, left: Any, right: Any) -> None:
        super().__init__(left, right)
        self.left, self.right = left, right


class AndSubstitution(_Both):
    """Substitution with the text 'true' if both of two texts are true."""

    judge = all


class OrSubstitution(_Both):
    """Substitution with the text 'true' if at least one of two texts is true."""

    judge = any


class NotSubstitution(Substitution):
    """Substitution with the text 'true' if a text is false, else 'false'."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def perform(self, context: LaunchContext) -> str:
        """Return 'true' if the given text is false, else 'false'."""
        return str(not _truth(context, self.value)).lower()


class IfElseSubstitution(Substitution):
    """Substitution with the text `if_value` if a condition is true, else `else_value`."""

    def __init__(self, condition: Any, if_value: Any = "", else_value: Any = "") -> None:
        """Store the condition and the two texts; a missing text is empty.

        Raises:
            RuntimeError: If both texts are missing.
        """
        if not if_value and not else_value:
            raise RuntimeError("an IfElseSubstitution needs an if_value or an else_value")
        self.condition, self.if_value, self.else_value = condition, if_value, else_value

    def perform(self, context: LaunchContext) -> str:
        """Return `if_value` if the condition is true, else `else_value`."""
        word = perform(context, self.condition).strip().lower()
        chosen = _truth(
            context, {"on": "true", "yes": "true", "off": "false", "no": "false"}.get(word, word)
        )
        return perform(context, self.if_value if chosen else self.else_value)
