"""launch's substitutions for truth values, and choices by them."""

import math
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import Substitution, SubstitutionFailure, is_true, perform

_TRUTHS = {"true": True, "1": True, "false": False, "0": False}


def _holds(context: LaunchContext, value: Any) -> bool:
    """Return whether a text means true.

    Raises:
        SubstitutionFailure: If the text is neither true nor false.
    """
    try:
        return is_true(perform(context, value))
    except UsageError as error:
        raise SubstitutionFailure(str(error)) from None


class EqualsSubstitution(Substitution):
    """Whether two texts are equal; numbers compare as numbers, truths as truths."""

    def __init__(self, left: Any, right: Any) -> None:
        self.left, self.right = left, right

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        left, right = perform(context, self.left), perform(context, self.right)
        try:
            equal = math.isclose(float(left), float(right))
        except ValueError:
            # As in ROS 2, '1' and '0' are truths beside one that is written out.
            truths = [_TRUTHS.get(text.lower(), text) for text in (left, right)]
            equal = truths[0] == truths[1]
        return str(equal).lower()


class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two texts differ."""

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        return str(super().perform(context) == "false").lower()


class _Several(Substitution):
    """Judgement of several truths."""

    judge: ClassVar[Any]

    def __init__(self, *args: Any) -> None:
        self.args = args

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'; as in ROS 2 all are evaluated."""
        return str(self.judge([_holds(context, value) for value in self.args])).lower()


class AnySubstitution(_Several):
    """Whether one of several is true."""

    judge = any


class AllSubstitution(_Several):
    """Whether all of several are true."""

    judge = all


class _Both(_Several):
    def __init__(self, left: Any, right: Any) -> None:
        super().__init__(left, right)
        self.left, self.right = left, right


class AndSubstitution(_Both):
    """Whether both are true."""

    judge = all


class OrSubstitution(_Both):
    """Whether one is true."""

    judge = any


class NotSubstitution(Substitution):
    """Whether something is false."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def perform(self, context: LaunchContext) -> str:
        """'true' or 'false'."""
        return str(not _holds(context, self.value)).lower()


class IfElseSubstitution(Substitution):
    """One text or another."""

    def __init__(self, condition: Any, if_value: Any = "", else_value: Any = "") -> None:
        """Make a choice by a condition.

        Raises:
            RuntimeError: If there is nothing to choose.
        """
        if not if_value and not else_value:
            raise RuntimeError("an IfElseSubstitution needs an if_value or an else_value")
        self.condition, self.if_value, self.else_value = condition, if_value, else_value

    def perform(self, context: LaunchContext) -> str:
        """Return the chosen text."""
        word = perform(context, self.condition).strip().lower()
        chosen = _holds(
            context, {"on": "true", "yes": "true", "off": "false", "no": "false"}.get(word, word)
        )
        return perform(context, self.if_value if chosen else self.else_value)
