"""rclpy's parameters: named, typed values."""

import array
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import Any, ClassVar

from tftool.messages.classes import INTERFACES
from tftool.messages.parameter_values import SCALARS, value_message, value_of
from tftool.ros.host import names


class ParameterType(IntEnum):
    """Type of a parameter."""

    NOT_SET = 0
    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    BYTE_ARRAY = 5
    BOOL_ARRAY = 6
    INTEGER_ARRAY = 7
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9

    @classmethod
    def from_parameter_value(cls, value: Any) -> "ParameterType":
        """Return the type of a Python value.

        Raises:
            TypeError: If it can be no parameter.
        """
        if value is None:
            return cls.NOT_SET
        for kind, number in SCALARS.items():  # bool before int, which it is as well
            if isinstance(value, kind):
                return cls(number)
        if isinstance(value, list | tuple | array.array):
            kinds = {
                cls.BYTE_ARRAY if isinstance(one, bytes) else cls.from_parameter_value(one)
                for one in value
            }
            if kinds <= {cls.BYTE_ARRAY}:
                return cls.BYTE_ARRAY
            if len(kinds) == 1 and cls.BOOL <= (only := kinds.pop()) <= cls.STRING:
                return cls(only + 5)
        raise TypeError(f"The given value is not one of the allowed types: {value!r}")

    def check(self, value: Any) -> bool:
        """Return whether a value is of this type."""
        if self >= ParameterType.BYTE_ARRAY and isinstance(value, list | tuple) and not len(value):
            return True
        try:
            return ParameterType.from_parameter_value(value) is self
        except TypeError:
            return False


@dataclass(slots=True)
class Parameter:
    """One parameter's name, type and value; the type follows from the value unless given."""

    Type: ClassVar[type[ParameterType]] = ParameterType

    name: str
    type_: ParameterType = None  # type: ignore[assignment]
    value: Any = None

    def __post_init__(self) -> None:
        if self.type_ is None:
            self.type_ = ParameterType.from_parameter_value(self.value)
        if not isinstance(self.type_, ParameterType):
            raise TypeError("type must be an instance of 'Parameter.Type'")
        if self.value is not None and not self.type_.check(self.value):
            raise ValueError(f"Type '{self.type_}' and value '{self.value}' do not agree")

    def get_parameter_value(self) -> Any:
        """Return it as an rcl_interfaces ParameterValue."""
        return value_message(self.value, int(self.type_))

    def to_parameter_msg(self) -> Any:
        """Return it as an rcl_interfaces Parameter."""
        return INTERFACES.message("rcl_interfaces/Parameter")(
            name=self.name, value=self.get_parameter_value()
        )

    @classmethod
    def from_parameter_msg(cls, param_msg: Any) -> "Parameter":
        """Return the Parameter of an rcl_interfaces Parameter."""
        return cls(param_msg.name, ParameterType(param_msg.value.type), value_of(param_msg.value))


def parameter_value_to_python(parameter_value: Any) -> Any:
    """Return the Python value of a ParameterValue; None if it is not set.

    Raises:
        RuntimeError: If its type is not a type of a parameter.
    """
    try:
        return value_of(parameter_value)
    except ValueError as error:
        raise RuntimeError(str(error)) from None


def get_parameter_value(string_value: str) -> Any:
    """Return a text as a ParameterValue, parsed as YAML; else the text itself."""
    value = names.yaml_value(string_value)
    return Parameter("", value=string_value if value is None else value).get_parameter_value()


PARAMETER_SEPARATOR_STRING = "."


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: list[str] | None = None,
    namespace: str = "",
) -> dict[str, Any]:
    """Return the parameters in a file as messages, by name.

    Args:
        parameter_file: Its path.
        use_wildcard: Whether entries under `/**` count, too.
        target_nodes: The nodes whose parameters are wanted, all without any.
        namespace: Prefix of the parameters' names.

    Raises:
        FileNotFoundError: If there is no such file.
        InputError: If it cannot be read, is not YAML, or is laid out otherwise.
    """
    if not Path(parameter_file).exists():
        raise FileNotFoundError(f"there is no parameter file '{parameter_file}'")
    wanted = {one.strip("/") for one in target_nodes or ()}
    found = {}
    for node, name, value in names.read_parameters(Path(parameter_file)):
        plain = node.strip("/")
        chosen = use_wildcard if plain == "**" else not wanted or plain in wanted
        if chosen:
            full = f"{namespace}{PARAMETER_SEPARATOR_STRING}{name}" if namespace else name
            found[full] = Parameter(full, value=value).to_parameter_msg()
    return found
