"""Exceptions of rclpy."""

from collections.abc import Iterable
from typing import ClassVar

from tftool.base.plain_text import did_you_mean


class NotInitializedException(Exception):
    """Error for using rclpy before `rclpy.init()` or after `rclpy.shutdown()`."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.init() has not been called", *args)


class ROSInterruptException(Exception):
    """Error for a sleep that the shutdown of rclpy interrupted."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.shutdown() has been called", *args)


class NoTypeSupportImportedException(Exception):
    """Error for a type that is not a message, service or action."""

    def __init__(self, *args: object) -> None:
        super().__init__("no type_support imported", *args)


class NameValidationException(ValueError):
    """Error for an invalid name; a caret in the text points to the first wrong character."""

    def __init__(self, name_type: str, name: str, error_msg: str, invalid_index: int) -> None:
        caret = " " * invalid_index + "^"
        super().__init__(f"Invalid {name_type}: {error_msg}:\n  '{name}'\n   {caret}")


class _NamedKind(NameValidationException):
    kind: ClassVar[str]

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__(self.kind, name, error_msg, invalid_index)


class InvalidNamespaceException(_NamedKind):
    """Error for an invalid namespace."""

    kind = "namespace"


class InvalidNodeNameException(_NamedKind):
    """Error for an invalid node name."""

    kind = "node name"


class InvalidTopicNameException(_NamedKind):
    """Error for an invalid topic name."""

    kind = "topic name"


class InvalidServiceNameException(_NamedKind):
    """Error for an invalid service name."""

    kind = "service name"


class InvalidHandle(Exception):
    """Error for using a destroyed node, publisher, timer or the like."""


def _names(parameters: "str | Iterable[str]") -> list[str]:
    return [parameters] if isinstance(parameters, str) else list(parameters)


class ParameterException(Exception):
    """Error for a parameter that cannot be used as requested."""

    def __init__(self, text: str, parameters: "str | Iterable[str]" = ()) -> None:
        super().__init__(text)
        self.parameters = _names(parameters)


class ParameterNotDeclaredException(ParameterException):
    """Error for a parameter used before its declaration."""

    def __init__(self, parameters: "str | Iterable[str]", known: Iterable[str] = ()) -> None:
        names = _names(parameters)
        hints = "".join(did_you_mean(name, known) for name in names)
        super().__init__(f"Invalid access to undeclared parameter(s): {names}{hints}", names)


class ParameterAlreadyDeclaredException(ParameterException):
    """Error for a parameter declared twice."""

    def __init__(self, parameters: "str | Iterable[str]") -> None:
        names = _names(parameters)
        super().__init__(f"Parameter(s) already declared: {names}", names)


class InvalidParameterException(ParameterException):
    """Error for an invalid parameter name."""


class InvalidParameterTypeException(ParameterException):
    """Error for a parameter's value of the wrong type."""


class InvalidParameterValueException(ParameterException):
    """Error for a parameter's value that the node rejects."""

    def __init__(self, parameter: str, value: object, reason: str) -> None:
        text = f"Invalid parameter value ({value!r}) for parameter '{parameter}'"
        super().__init__(f"{text}. Reason: {reason}" if reason else text, parameter)


class ParameterImmutableException(ParameterException):
    """Error for setting a read-only parameter."""

    def __init__(self, parameters: "str | Iterable[str]") -> None:
        names = _names(parameters)
        super().__init__(f"Attempted to modify read-only parameter(s): {names}", names)


class ParameterUninitializedException(ParameterException):
    """Error for reading a parameter that was declared with a type but has no value."""

    def __init__(self, parameter: str) -> None:
        super().__init__(f"The parameter '{parameter}' is not initialized", parameter)
