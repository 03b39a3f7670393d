"""Exceptions of rclpy."""

from collections.abc import Iterable

from tftool.base.near_names import did_you_mean


class NotInitializedException(Exception):
    """rclpy.init() was not called, or the context is shut down."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.init() has not been called", *args)


class ROSInterruptException(Exception):
    """A sleep was cut short by shutdown."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.shutdown() has been called", *args)


class ExternalShutdownException(Exception):
    """The context was shut down while an executor was spinning."""

    def __init__(self, *args: object) -> None:
        super().__init__("context has been shut down", *args)


class ShutdownException(Exception):
    """The executor was shut down."""


class TimeoutException(Exception):
    """An executor was asked to wait with a timeout, and it passed."""


class ConditionReachedException(Exception):
    """An executor's condition came true."""


class NoTypeSupportImportedException(Exception):
    """Something that is no message, service or action type is used as one."""

    def __init__(self, *args: object) -> None:
        super().__init__("no type_support imported", *args)


class NameValidationException(ValueError):
    """A name is not valid; shown with a caret below the place."""

    def __init__(self, name_type: str, name: str, error_msg: str, invalid_index: int) -> None:
        caret = " " * invalid_index + "^"
        super().__init__(f"Invalid {name_type}: {error_msg}:\n  '{name}'\n   {caret}")


class InvalidNamespaceException(NameValidationException):
    """A namespace is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("namespace", name, error_msg, invalid_index)


class InvalidNodeNameException(NameValidationException):
    """A node's name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("node name", name, error_msg, invalid_index)


class InvalidTopicNameException(NameValidationException):
    """A topic's name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("topic name", name, error_msg, invalid_index)


class InvalidServiceNameException(NameValidationException):
    """A service's name is not valid."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("service name", name, error_msg, invalid_index)


class InvalidHandle(Exception):
    """Something is used that was destroyed."""


class ParameterException(Exception):
    """A parameter cannot be used as asked."""

    def __init__(self, text: str, parameters: "str | Iterable[str]" = ()) -> None:
        super().__init__(text)
        self.parameters = [parameters] if isinstance(parameters, str) else list(parameters)


class ParameterNotDeclaredException(ParameterException):
    """A parameter is used before it is declared."""

    def __init__(self, parameters: "str | Iterable[str]", known: Iterable[str] = ()) -> None:
        names = [parameters] if isinstance(parameters, str) else list(parameters)
        text = f"Invalid access to undeclared parameter(s): {names}"
        for name in names:
            text += did_you_mean(name, known)
        super().__init__(text, names)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter is declared twice."""

    def __init__(self, parameters: "str | Iterable[str]") -> None:
        names = [parameters] if isinstance(parameters, str) else list(parameters)
        super().__init__(f"Parameter(s) already declared: {names}", names)


class InvalidParameterException(ParameterException):
    """A parameter's name is not valid."""


class InvalidParameterTypeException(ParameterException):
    """A parameter is given a value of another type."""


class InvalidParameterValueException(ParameterException):
    """A parameter is given a value that is refused."""

    def __init__(self, parameter: str, value: object, reason: str) -> None:
        text = f"Invalid parameter value ({value!r}) for parameter '{parameter}'"
        super().__init__(f"{text}. Reason: {reason}" if reason else text, parameter)


class ParameterImmutableException(ParameterException):
    """A read-only parameter is set."""

    def __init__(self, parameters: "str | Iterable[str]") -> None:
        names = [parameters] if isinstance(parameters, str) else list(parameters)
        super().__init__(f"Attempted to modify read-only parameter(s): {names}", names)


class ParameterUninitializedException(ParameterException):
    """A parameter that was declared by type alone is read before it has a value."""

    def __init__(self, parameter: str) -> None:
        super().__init__(f"The parameter '{parameter}' is not initialized", parameter)
